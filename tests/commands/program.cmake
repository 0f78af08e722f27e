# The tests of commands run the built program, which they find by this variable, under either test runner.
file(GLOB ek_command_tests CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/test_*.pf)
foreach(file IN LISTS ek_command_tests)
  get_filename_component(name ${file} NAME_WE)
  set_property(TEST ${name} APPEND PROPERTY ENVIRONMENT "EK_PROGRAM=$<TARGET_FILE:elastokin>")
  add_dependencies(${name} elastokin)
endforeach()
