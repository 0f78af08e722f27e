# These tests run the built program, which they find by this variable, under either test runner.
foreach(name test_program test_report test_report_trouble test_inputs)
  if(TEST ${name})
    set_property(TEST ${name} APPEND PROPERTY ENVIRONMENT "EK_PROGRAM=$<TARGET_FILE:elastokin>")
    add_dependencies(${name} elastokin)
  endif()
endforeach()
