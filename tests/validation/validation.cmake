# Published numbers of other programs beside those of this one: for the tests of this folder, and for docs/validation.md
# (docs/validation.py runs validation_numbers).
set(ek_validation_dir ${CMAKE_CURRENT_LIST_DIR})
add_library(ek_validation STATIC EXCLUDE_FROM_ALL
  ${ek_validation_dir}/ek_comparison.f90
  ${ek_validation_dir}/ek_published_adams.f90
  ${ek_validation_dir}/ek_published_ipg.f90
  ${ek_validation_dir}/ek_published_small.f90)
set_target_properties(ek_validation PROPERTIES
  Fortran_MODULE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/modules/validation)
target_include_directories(ek_validation PUBLIC ${CMAKE_CURRENT_BINARY_DIR}/modules/validation)
target_link_libraries(ek_validation PUBLIC ek_test_laws)
# compiled as tests are: see ElastokinTests.cmake
target_compile_options(ek_validation PRIVATE -O0 $<$<Fortran_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>
  $<$<Fortran_COMPILER_ID:GNU>:-Wno-uninitialized>)

add_executable(validation_numbers EXCLUDE_FROM_ALL ${ek_validation_dir}/validation_numbers.f90)
target_link_libraries(validation_numbers PRIVATE ${ek_program_kernel} ek_validation)
# without the object of the kernel it would be optimised across files again, for minutes
if(CMAKE_Fortran_COMPILER_ID STREQUAL "GNU")
  target_link_options(validation_numbers PRIVATE -fno-lto)
endif()
