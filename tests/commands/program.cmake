# test_program runs the built program, which it finds by this variable, under either test runner.
if(TEST test_program)
  set_property(TEST test_program APPEND PROPERTY ENVIRONMENT "EK_PROGRAM=$<TARGET_FILE:elastokin>")
  add_dependencies(test_program elastokin)
endif()
