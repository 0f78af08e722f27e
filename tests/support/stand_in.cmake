# The stand-in for pFUnit: its library, its preprocessor, the tests of both. Included by
# ElastokinTests.cmake only.

add_library(ek_funit STATIC
  ${EK_TEST_SUPPORT_DIR}/funit_failures.f90
  ${EK_TEST_SUPPORT_DIR}/funit_text.f90
  ${EK_TEST_SUPPORT_DIR}/funit_equal.f90
  ${EK_TEST_SUPPORT_DIR}/funit.f90
  ${EK_TEST_SUPPORT_DIR}/funit_runner.f90)
add_executable(ek_pf2f90
  ${EK_TEST_SUPPORT_DIR}/pf_text.f90
  ${EK_TEST_SUPPORT_DIR}/pf_names.f90
  ${EK_TEST_SUPPORT_DIR}/pf_check.f90
  ${EK_TEST_SUPPORT_DIR}/pf_write.f90
  ${EK_TEST_SUPPORT_DIR}/pf2f90.f90)
foreach(target ek_funit ek_pf2f90)
  set_target_properties(${target} PROPERTIES
    Fortran_MODULE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/${target}.mod)
endforeach()
target_include_directories(ek_funit INTERFACE ${CMAKE_CURRENT_BINARY_DIR}/ek_funit.mod)

# The program of one .pf file, built in a directory of its own.
function(ek_add_stand_in_test_program name pf_file other_sources link)
  cmake_path(GET pf_file STEM LAST_ONLY base)
  set(made ${CMAKE_CURRENT_BINARY_DIR}/generated/${name})
  file(MAKE_DIRECTORY ${made}/mod)
  add_custom_command(
    OUTPUT ${made}/${base}.F90 ${made}/${base}_driver.f90
    COMMAND ek_pf2f90 ${pf_file} ${made} ${EK_TEST_SUPPORT_DIR}/funit_names.txt
    DEPENDS ${pf_file} ek_pf2f90 ${EK_TEST_SUPPORT_DIR}/funit_names.txt
    COMMENT "Preprocessing ${base}.pf"
    VERBATIM)
  add_executable(${name} ${made}/${base}.F90 ${made}/${base}_driver.f90 ${other_sources})
  set_target_properties(${name} PROPERTIES Fortran_MODULE_DIRECTORY ${made}/mod)
  target_include_directories(${name} PRIVATE ${made}/mod ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${link} ek_funit)
endfunction()

function(ek_add_stand_in_test name pf_file working_directory other_sources link)
  ek_add_stand_in_test_program(${name} ${pf_file} "${other_sources}" "${link}")
  add_test(NAME ${name} COMMAND ${name} --verbose WORKING_DIRECTORY ${working_directory})
endfunction()

# The assertions, passing and failing, and what the preprocessor has to refuse.
function(ek_add_support_tests)
  set(dir ${EK_TEST_SUPPORT_DIR}/selftest)
  ek_add_stand_in_test(test_funit ${dir}/test_funit.pf ${CMAKE_CURRENT_BINARY_DIR} "" "")
  ek_add_stand_in_test_program(test_funit_failures ${dir}/test_funit_failures.pf "" "")
  add_test(NAME support_failures
    COMMAND sh ${dir}/check_failures.sh $<TARGET_FILE:test_funit_failures> ${dir}/test_funit_failures.pf)
  file(GLOB traps CONFIGURE_DEPENDS ${EK_TEST_SUPPORT_DIR}/traps/*.pf)
  foreach(trap IN LISTS traps)
    cmake_path(GET trap STEM name)
    add_test(NAME support_${name}
      COMMAND sh ${dir}/check_trap.sh $<TARGET_FILE:ek_pf2f90> ${trap}
        ${CMAKE_CURRENT_BINARY_DIR}/generated/${name} ${EK_TEST_SUPPORT_DIR}/funit_names.txt)
  endforeach()
  add_test(NAME support_run_tests
    COMMAND sh ${dir}/check_run_tests.sh ${EK_TEST_SUPPORT_DIR}/add_up.awk)
endfunction()
