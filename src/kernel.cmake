# Optimisation across files, once, for the layers where the time of a solution goes: ek_layer(<folder> KERNEL).
#
# Their files are compiled to the compiler's intermediate form. ek_kernel.o is made of all of them: plain code, inlined across files.
# Programs, libelastokin.so and tests link this object before the layers (${ek_program_kernel}), so that nothing is taken from the
# archives of these layers. It is compiled with -fPIE: with -fPIC an increment takes 1.4 times as long. libelastokin.so can link it
# because its version script makes these symbols local.
#
# Installed is libelastokin_kernel.a, made of the same files with -fPIC when the package is installed: plain code, which any later
# compiler and linker takes, also for a shared library. The installed targets elastokin::math, elastokin::model, ... lead to it.
#
# The other layers are compiled with ${ek_quick_build} or ${ek_plain_build}: a third of the compiler's time, and no time of a solution.
set(ek_has_kernel OFF)
set(ek_program_kernel "")
# gfortran takes 0.7 of the time with -Og that it takes with -O1; a report then has 3 % more instructions, and a study takes no longer. Without
# optimisation, and with -Og, it warns that descriptors of unallocated components are uninitialised; with -O1 (.ci) it does not.
set(ek_no_wrong_warnings -Wno-maybe-uninitialized -Wno-uninitialized)
set(ek_quick_build -Og ${ek_no_wrong_warnings})
set(ek_plain_build -O0 ${ek_no_wrong_warnings})
if(ek_has_ipo)
  include(CheckFortranSourceCompiles)
  set(CMAKE_REQUIRED_FLAGS "-flto -r -flinker-output=nolto-rel -nostdlib")
  check_fortran_source_compiles("program probe\nend program" EK_HAS_PARTIAL_LINK SRC_EXT f90)
  unset(CMAKE_REQUIRED_FLAGS)
  set(ek_has_kernel ${EK_HAS_PARTIAL_LINK})
endif()
if(ek_has_kernel)
  message(STATUS "Optimisation across files: math, model, equilibrium, rig, compliance, quantities, as one object")
  set(ek_program_kernel ek_kernel_link)
else()
  message(STATUS "Optimisation across files: none")
endif()

# A target uses a layer: its archive in the build, the target of its name where it is installed
function(ek_use_layer target layer)
  if(TARGET ek_${layer}_installed)
    target_link_libraries(${target} PUBLIC $<BUILD_INTERFACE:ek_${layer}> $<INSTALL_INTERFACE:ek_${layer}_installed>)
  else()
    target_link_libraries(${target} PUBLIC ek_${layer})
  endif()
endfunction()

# A layer becomes a part of the kernel; its modules are those of ek_<layer>
function(ek_kernel_layer layer)
  set_target_properties(ek_${layer} PROPERTIES INTERPROCEDURAL_OPTIMIZATION ON)
  add_library(ek_${layer}_installed INTERFACE)
  set_target_properties(ek_${layer}_installed PROPERTIES EXPORT_NAME ${layer})
  target_include_directories(ek_${layer}_installed INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/elastokin>)
  target_link_libraries(ek_${layer}_installed INTERFACE ek_kernel)
  install(TARGETS ek_${layer}_installed EXPORT elastokinTargets)
  set_property(GLOBAL APPEND PROPERTY ek_kernel_layers ek_${layer})
endfunction()

# The object of all kernel layers, and what links it: call it after the last of them
function(ek_make_kernel)
  if(NOT ek_has_kernel)
    return()
  endif()
  get_property(layers GLOBAL PROPERTY ek_kernel_layers)
  list(TRANSFORM layers REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>" OUTPUT_VARIABLE objects)
  foreach(form PIE PIC)
    set(${form} ${CMAKE_CURRENT_BINARY_DIR}/ek_kernel_${form}.o)
    add_custom_command(OUTPUT ${${form}}
      COMMAND ${CMAKE_Fortran_COMPILER} -O3 -g1 -f${form} -flto=auto -r -flinker-output=nolto-rel -nostdlib -o ${${form}} ${objects}
      DEPENDS ${layers}
      COMMENT "Optimising across files: ek_kernel_${form}.o"
      COMMAND_EXPAND_LISTS VERBATIM)
  endforeach()
  add_custom_target(ek_kernel_object DEPENDS ${PIE})
  add_library(ek_kernel_link INTERFACE)
  target_link_libraries(ek_kernel_link INTERFACE ${PIE})
  add_dependencies(ek_kernel_link ek_kernel_object)

  set_source_files_properties(${PIC} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
  add_library(ek_kernel STATIC EXCLUDE_FROM_ALL ${PIC})
  set_target_properties(ek_kernel PROPERTIES LINKER_LANGUAGE Fortran OUTPUT_NAME elastokin_kernel EXPORT_NAME kernel)
  target_link_libraries(ek_kernel PUBLIC ek_results ek_vocabulary ek_os ek_base $<INSTALL_INTERFACE:LAPACK::LAPACK> ${CMAKE_DL_LIBS})
  if(OpenMP_Fortran_FOUND)
    target_link_libraries(ek_kernel PRIVATE OpenMP::OpenMP_Fortran)
  endif()
  install(CODE "execute_process(COMMAND \"${CMAKE_COMMAND}\" --build \"${CMAKE_BINARY_DIR}\" --target ek_kernel OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)"
    COMPONENT dev)
  install(TARGETS ek_kernel EXPORT elastokinTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
endfunction()
