# ek_build_facts.f90: what elastokin --version says of this build.

# The commit, if this folder is a clone; packagers may give it: -DEK_COMMIT=…
set(EK_COMMIT "" CACHE STRING "Commit of the sources, for elastokin --version; empty: asked of git")
set(ek_commit "${EK_COMMIT}")
find_package(Git QUIET)
if(NOT ek_commit AND GIT_FOUND AND EXISTS ${PROJECT_SOURCE_DIR}/.git)
  execute_process(COMMAND ${GIT_EXECUTABLE} describe --always --dirty --abbrev=12 --exclude=*
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE ek_commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  # a new commit configures and links the programs again, nothing else
  execute_process(COMMAND ${GIT_EXECUTABLE} rev-parse --git-path logs/HEAD
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE ek_head OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  get_filename_component(ek_head "${ek_head}" ABSOLUTE BASE_DIR ${PROJECT_SOURCE_DIR})
  if(EXISTS ${ek_head})
    set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${ek_head})
  endif()
endif()

string(TOUPPER "${CMAKE_BUILD_TYPE}" ek_type)
get_directory_property(ek_options COMPILE_OPTIONS)
string(REGEX REPLACE "\\$<\\$<COMPILE_LANGUAGE:Fortran>:([^>]*)>" "\\1" ek_options "${ek_options}")
string(JOIN " " ek_options ${CMAKE_Fortran_FLAGS} ${CMAKE_Fortran_FLAGS_${ek_type}} ${ek_options})
set(ek_options "${CMAKE_BUILD_TYPE} (${ek_options})")
string(REPLACE "'" "\"" ek_options "${ek_options}")
string(REPEAT "." 90 ek_line)
string(REGEX REPLACE "(${ek_line})" "\\1&\n         &" ek_options "${ek_options}")
set(ek_compiler "${CMAKE_Fortran_COMPILER_ID} ${CMAKE_Fortran_COMPILER_VERSION}")
string(REPLACE "GNU" "gfortran" ek_compiler "${ek_compiler}")
foreach(fact openmp ipo)
  set(ek_${fact}_fact .false.)
endforeach()
if(OpenMP_Fortran_FOUND)
  set(ek_openmp_fact .true.)
endif()
if(ek_has_kernel)
  set(ek_ipo_fact .true.)
endif()
configure_file(${CMAKE_CURRENT_SOURCE_DIR}/ek_build_facts.f90.in ${CMAKE_CURRENT_BINARY_DIR}/ek_build_facts.f90 @ONLY)
