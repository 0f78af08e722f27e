# The lanes as a shared library of the programs, compiled for several instruction sets:
#
#   lib/elastokin/libelastokin_lanes.so                              for every processor of the architecture
#   lib/elastokin/glibc-hwcaps/x86-64-v3/libelastokin_lanes.so       for those with AVX2
#
# The programs have lib/elastokin in their RUNPATH, and the loader of glibc (2.33 or newer) takes the best copy that the processor can run.
# All copies give the same bits. Programs that link ${ek_program_lanes} before the layers get the lanes from there; whatever links only
# the static layers (libelastokin, programs of others) has the copy for every processor in itself.
option(EK_HWCAPS "Compile the kernels of packs also for x86-64-v3 (AVX2), chosen by the loader of glibc when the program starts" ON)
set(ek_program_lanes "")
set(ek_why "")
if(NOT EK_HWCAPS)
  set(ek_why "EK_HWCAPS is off")
elseif(NOT CMAKE_Fortran_COMPILER_ID STREQUAL "GNU" OR NOT CMAKE_SYSTEM_NAME STREQUAL "Linux")
  set(ek_why "several need gfortran on Linux")
elseif(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|amd64|AMD64)$" OR NOT CMAKE_SIZEOF_VOID_P EQUAL 8)
  set(ek_why "there is one for ${CMAKE_SYSTEM_PROCESSOR}")
elseif(NOT CMAKE_BUILD_TYPE STREQUAL "Release")
  set(ek_why "several are for release builds")
elseif(EK_NATIVE OR CMAKE_Fortran_FLAGS MATCHES "-march=")
  set(ek_why "it is chosen by -march")
else()
  include(CheckFortranSourceCompiles)
  check_compiler_flag(Fortran "-march=x86-64-v3" ek_has_v3)
  check_fortran_source_compiles("program probe
      use, intrinsic :: iso_c_binding, only: c_ptr
      interface
        type(c_ptr) function gnu_get_libc_version() bind(c)
          import :: c_ptr
        end function
      end interface
      type(c_ptr) :: text
      text = gnu_get_libc_version()
    end program" ek_has_glibc SRC_EXT f90)
  if(NOT ek_has_v3 OR NOT ek_has_glibc)
    set(ek_why "several need glibc and -march=x86-64-v3")
  endif()
endif()
if(ek_why)
  message(STATUS "Instruction sets of packs: one, as ${ek_why}")
  return()
endif()
message(STATUS "Instruction sets of packs: x86-64 and x86-64-v3, chosen by the loader")

# A copy of the library, in its folder below lib
function(ek_loaded_copy target folder)
  add_library(${target} SHARED ${ARGN})
  set_target_properties(${target} PROPERTIES OUTPUT_NAME elastokin_lanes LINKER_LANGUAGE Fortran
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib/${folder})
  # -Bsymbolic: calls of the library to itself go nowhere else
  target_link_options(${target} PRIVATE -Wl,-Bsymbolic)
  install(TARGETS ${target} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/${folder} COMPONENT runtime)
endfunction()

# The objects alone, and none undefined: the library has no part of another layer, whose variables the program would have twice
ek_loaded_copy(ek_loaded_lanes elastokin $<TARGET_OBJECTS:ek_lanes>)
target_link_options(ek_loaded_lanes PRIVATE -Wl,-z,defs)
ek_loaded_copy(ek_loaded_lanes_v3 elastokin/glibc-hwcaps/x86-64-v3 ${ek_lane_layer})
target_compile_options(ek_loaded_lanes_v3 PRIVATE ${ek_lane_options} -march=x86-64-v3)
# the same sources, so what is linked here for its modules leaves nothing in the library either
target_link_libraries(ek_loaded_lanes_v3 PRIVATE -Wl,--as-needed ek_equilibrium ek_model ek_math ek_os ek_base)
set_target_properties(ek_loaded_lanes_v3 PROPERTIES Fortran_MODULE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/modules/lanes_v3)
add_dependencies(ek_loaded_lanes_v3 ek_lanes)     # which makes the copy of the kernels
add_dependencies(ek_loaded_lanes ek_loaded_lanes_v3)

# From the folder of the programs to that of the library
cmake_path(RELATIVE_PATH CMAKE_INSTALL_FULL_LIBDIR BASE_DIRECTORY ${CMAKE_INSTALL_FULL_BINDIR} OUTPUT_VARIABLE ek_from_bin)
set(ek_loaded_runpath "$ORIGIN/${ek_from_bin}/elastokin")
# some systems link only what is needed by what stands before it
set(ek_program_lanes -Wl,--push-state,--no-as-needed ek_loaded_lanes -Wl,--pop-state)
