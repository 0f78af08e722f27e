# The lane copy of the kernels, one file: src/lanes, then each kernel with its numbers of type(lanes_t) in place of real(num).
#
#   cmake -DFOLDER=src -DLANES="lanes/a.f90;…" -DKERNELS="math/b.f90;…" -DOUTPUT=file -P make_lanes.cmake
#
# Each list is in the order of use. It is one file because gfortran inlines the operators of lanes only within a file.
# The rules that a kernel obeys so that this is enough are in docs/compilers.md, "How a kernel is written".

set(names)
foreach(kernel IN LISTS KERNELS)
  get_filename_component(name ${kernel} NAME_WE)
  list(APPEND names ${name})
endforeach()

set(all "! Made by src/lanes/make_lanes.cmake from the kernels in src: change these.\n")
foreach(file IN LISTS LANES)
  file(READ ${FOLDER}/${file} text)
  string(APPEND all "\n${text}")
endforeach()
foreach(file IN LISTS KERNELS)
  file(READ ${FOLDER}/${file} text)
  string(REPLACE "real(num)" "type(lanes_t)" text "${text}")
  string(REPLACE "logical(mask)" "type(mask_t)" text "${text}")
  string(REPLACE "integer(piece)" "type(piece_t)" text "${text}")
  string(REGEX REPLACE "\n( *)use ek_number,[^\n]*" "\n\\1use ek_lanes" text "${text}")
  foreach(name IN LISTS names)
    string(REGEX REPLACE "(\n *(end module|module|use)) ${name}([,\n])" "\\1 ${name}_lanes\\3" text "\n${text}")
  endforeach()
  if(NOT text MATCHES "use ek_lanes\n" OR text MATCHES "use ek_number|, *num\\)|_num[^a-z_]")
    message(FATAL_ERROR "${FOLDER}/${file}: a kernel has one line `use ek_number, only: …`, and numbers real(num) without other uses of num")
  endif()
  string(APPEND all "\n${text}")
endforeach()
file(WRITE ${OUTPUT} "${all}")
