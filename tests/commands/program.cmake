# The tests of commands and of elastokin-bench run the built program, which they find by this variable, under either test runner.
file(GLOB ek_command_tests CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/test_*.pf ${CMAKE_CURRENT_LIST_DIR}/../bench/test_*.pf)
foreach(file IN LISTS ek_command_tests)
  get_filename_component(name ${file} NAME_WE)
  if(NOT TEST ${name})
    continue()
  endif()
  set_property(TEST ${name} APPEND PROPERTY ENVIRONMENT "EK_PROGRAM=$<TARGET_FILE:elastokin>")
  add_dependencies(${name} elastokin)
  if(file MATCHES "/bench/")
    add_dependencies(${name} elastokin-bench)
  endif()
endforeach()

# Stores of studies are read with ncdump, where elastokin-netcdf was built
if(TEST test_study_store)
  set_property(TEST test_study_store APPEND PROPERTY ENVIRONMENT "EK_NCDUMP=${EK_NCDUMP}")
  add_dependencies(test_study_store elastokin-netcdf)
endif()
