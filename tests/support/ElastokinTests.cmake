# Unit tests in .pf files: with pFUnit where find_package finds one, else with the stand-in here.
#
#   ek_add_test(name SOURCES file.pf [LINK lib...] [OTHER_SOURCES f90...] [WORKING_DIRECTORY dir])
#
# One test program and one ctest test per .pf file. The working directory is made if need be; the
# default is a directory per test, as tests run in parallel and may write files of the same name.
# Include from a CMakeLists.txt below one that has called enable_testing().

include_guard(GLOBAL)

set(EK_TEST_SUPPORT_DIR ${CMAKE_CURRENT_LIST_DIR})
find_package(PFUNIT 4 QUIET)

if(PFUNIT_FOUND)
  message(STATUS "Unit tests: pFUnit ${PFUNIT_VERSION} in ${PFUNIT_DIR}")
else()
  message(STATUS "Unit tests: the stand-in in tests/support, as find_package(PFUNIT) found none")
  include(${EK_TEST_SUPPORT_DIR}/stand_in.cmake)
endif()

function(ek_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "WORKING_DIRECTORY" "SOURCES;LINK;OTHER_SOURCES")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "ek_add_test(${name}): unknown argument ${arg_UNPARSED_ARGUMENTS}")
  endif()
  list(LENGTH arg_SOURCES n_sources)
  if(NOT n_sources EQUAL 1)
    # pFUnit does not run a file that joins a target of a configured build directory.
    message(FATAL_ERROR "ek_add_test(${name}): SOURCES takes one .pf file, found ${n_sources}")
  endif()

  # pFUnit would write beside a source given by its absolute path, and beside the build directory
  # for one given as ../x.pf.
  cmake_path(ABSOLUTE_PATH arg_SOURCES NORMALIZE OUTPUT_VARIABLE pf_file)
  cmake_path(RELATIVE_PATH pf_file BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} OUTPUT_VARIABLE relative)
  if(NOT EXISTS ${pf_file} OR relative MATCHES "^\\.\\.")
    message(FATAL_ERROR "ek_add_test(${name}): no file ${arg_SOURCES} below ${CMAKE_CURRENT_SOURCE_DIR}")
  endif()
  if(NOT arg_WORKING_DIRECTORY)
    set(arg_WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/run/${name})
  endif()
  file(MAKE_DIRECTORY ${arg_WORKING_DIRECTORY})

  if(PFUNIT_FOUND)
    add_pfunit_ctest(${name} TEST_SOURCES ${relative} OTHER_SOURCES ${arg_OTHER_SOURCES}
      LINK_LIBRARIES ${arg_LINK} WORKING_DIRECTORY ${arg_WORKING_DIRECTORY} LABELS unit)
    set(all_well "\\([0-9]+ tests?[,)]")
  else()
    ek_add_stand_in_test(${name} ${pf_file} ${arg_WORKING_DIRECTORY} "${arg_OTHER_SOURCES}" "${arg_LINK}")
    set(all_well "[0-9]+ passed, 0 failed")
  endif()
  # A test that links without the object of the kernel would be optimised across files again, for minutes
  if(CMAKE_Fortran_COMPILER_ID STREQUAL "GNU")
    target_link_options(${name} PRIVATE -fno-lto)
  endif()
  # A test's time goes into the library; its own text compiles five times quicker without optimisation. gfortran then warns
  # that descriptors of unallocated components are uninitialised.
  target_compile_options(${name} PRIVATE -O0 $<$<Fortran_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>
    $<$<Fortran_COMPILER_ID:GNU>:-Wno-uninitialized>)
  # The sanitizers watch the program; with them a long test compiles fifteen times slower. Reads and writes of the program in the
  # memory of a test, and leaks, are still found.
  target_compile_options(${name} PRIVATE $<$<AND:$<CONFIG:Asan>,$<Fortran_COMPILER_ID:GNU>>:-fno-sanitize=all>)

  # Under the sanitizers the longest test takes five times as long, beside another one more than 600 s.
  set(limit 600)
  if(CMAKE_BUILD_TYPE STREQUAL Asan)
    set(limit 1800)
  endif()
  # The summary is demanded: a `stop` in the code under test would else end the program with status 0.
  # It overrides the exit status, of which only a sanitizer's complaint would then go unseen.
  set_tests_properties(${name} PROPERTIES LABELS unit TIMEOUT ${limit}
    PASS_REGULAR_EXPRESSION "${all_well}"
    FAIL_REGULAR_EXPRESSION "Encountered 1 or more failures;Sanitizer: ")
  # One BLAS thread: the matrices are small, and threads that wait for each other take a hundred times as long on a busy machine.
  # LC_ALL: messages of the system and decimal points as the tests expect them
  set_property(TEST ${name} APPEND PROPERTY ENVIRONMENT OPENBLAS_NUM_THREADS=1 LC_ALL=C)
endfunction()

if(NOT PFUNIT_FOUND)
  ek_add_support_tests()
endif()
