# Kernels for four designs at a time: a copy of each kernel below, made by src/lanes/make_lanes.cmake, module ek_x_lanes of ek_x.

# The kernels, in the order of use
set(ek_kernels
  math/ek_vector.f90
  math/ek_rotation.f90
  math/ek_curve.f90
  model/ek_law.f90
  model/ek_block.f90
  model/ek_relative_rotation.f90
  model/ek_lowest_point.f90
  model/ek_measure.f90
  model/ek_elastic.f90
  model/ek_element.f90
  model/ek_element_force.f90
  model/ek_row.f90
  model/ek_load.f90
  equilibrium/ek_motion.f90
  equilibrium/ek_kkt_terms.f90
  equilibrium/ek_plan_factors.f90)
set(ek_lane_modules
  lanes/ek_lane_numbers.f90
  lanes/ek_lane_conditions.f90
  lanes/ek_lane_functions.f90
  lanes/ek_lanes.f90)

set(ek_lane_kernels ${CMAKE_CURRENT_BINARY_DIR}/lanes/ek_lane_kernels.f90)
set(ek_lane_script ${CMAKE_CURRENT_SOURCE_DIR}/lanes/make_lanes.cmake)
set(ek_lane_sources ${ek_lane_modules} ${ek_kernels})
list(TRANSFORM ek_lane_sources PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
add_custom_command(OUTPUT ${ek_lane_kernels}
  COMMAND ${CMAKE_COMMAND} -DFOLDER=${CMAKE_CURRENT_SOURCE_DIR} "-DLANES=${ek_lane_modules}" "-DKERNELS=${ek_kernels}"
    -DOUTPUT=${ek_lane_kernels} -P ${ek_lane_script}
  DEPENDS ${ek_lane_sources} ${ek_lane_script}
  COMMENT "Making the lane copy of the kernels"
  VERBATIM)
set(ek_lane_layer ${ek_lane_kernels} lanes/ek_lane_copy.f90 lanes/ek_lane_instructions.f90)
ek_layer(lanes FAST USES equilibrium model math base SOURCES ${ek_lane_layer})

# No fused multiply-add: all instruction sets give the same bits
set(ek_lane_options -ffp-contract=off -fopenmp-simd)
if(CMAKE_Fortran_COMPILER_ID STREQUAL "GNU")
  # Kernels are large once the loops of their operators are inlined: gfortran would stop inlining them in each other,
  # and pass every vector through memory (1.7 times slower)
  # In a shared library a procedure could be replaced at load time, so gfortran would not inline it
  list(APPEND ek_lane_options -fno-semantic-interposition --param=max-inline-insns-auto=500 --param=large-function-growth=2000
    --param=inline-unit-growth=500)
  # Four lanes are copied as one AVX register: what is written in halves is read with a delay (3 times slower)
  include(CheckCompilerFlag)
  check_compiler_flag(Fortran "-mmove-max=256 -mstore-max=256" ek_has_move_max)
  if(ek_has_move_max)
    list(APPEND ek_lane_options -mmove-max=256 -mstore-max=256)
  endif()
endif()
target_compile_options(ek_lanes PRIVATE ${ek_lane_options})
include(${CMAKE_CURRENT_SOURCE_DIR}/lanes/loaded_lanes.cmake)
