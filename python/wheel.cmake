# ek_install_for_python(LIBRARY PROGRAM LANES): what the native wheel contains besides the modules of Python: the library, and the command
# line, which is the program and the folder with its kernels, in the places in which they find each other
function(ek_install_for_python library program lanes)
  install(PROGRAMS ${library} DESTINATION elastokin COMPONENT python RENAME libelastokin.so.0)
  install(PROGRAMS ${program} DESTINATION elastokin/bin COMPONENT python RENAME elastokin)
  install(DIRECTORY ${lanes} DESTINATION elastokin/lib COMPONENT python OPTIONAL)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION elastokin COMPONENT python)
  find_program(EK_STRIP strip)
  mark_as_advanced(EK_STRIP)
  if(EK_STRIP)     # without debug information
    install(CODE "execute_process(COMMAND ${EK_STRIP} \"\${CMAKE_INSTALL_PREFIX}/elastokin/bin/elastokin\")" COMPONENT python)
  endif()
endfunction()
