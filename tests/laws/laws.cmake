# What the tests share: random poses, difference quotients, models of the reference solutions, readings of a state,
# tables of a deck on the rig, plane linkages, a folder for files of a test, the program as its user runs it, its text against kept text,
# studies put together by a test, maps of decks for other simulators and what their files say,
# solved cases with the numbers of their decks, packs of four designs.
set(ek_laws_dir ${CMAKE_CURRENT_LIST_DIR})
add_library(ek_test_laws STATIC
  ${ek_laws_dir}/ek_orientation_matrix.f90
  ${ek_laws_dir}/ek_random.f90
  ${ek_laws_dir}/ek_differences.f90
  ${ek_laws_dir}/ek_curve_integral.f90
  ${ek_laws_dir}/ek_parts.f90
  ${ek_laws_dir}/ek_example.f90
  ${ek_laws_dir}/ek_axle.f90
  ${ek_laws_dir}/ek_reading.f90
  ${ek_laws_dir}/ek_wheel_search.f90
  ${ek_laws_dir}/ek_trial.f90
  ${ek_laws_dir}/ek_rig_table.f90
  ${ek_laws_dir}/ek_plane_linkage.f90
  ${ek_laws_dir}/ek_scratch.f90
  ${ek_laws_dir}/ek_program.f90
  ${ek_laws_dir}/ek_reference_text.f90
  ${ek_laws_dir}/ek_changed_text.f90
  ${ek_laws_dir}/ek_remarks_on.f90
  ${ek_laws_dir}/ek_small_study.f90
  ${ek_laws_dir}/ek_exported.f90
  ${ek_laws_dir}/ek_rewritten_deck.f90
  ${ek_laws_dir}/ek_probe.f90
  ${ek_laws_dir}/ek_solved_case.f90
  ${ek_laws_dir}/ek_four_designs.f90)
set_target_properties(ek_test_laws PROPERTIES
  Fortran_MODULE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/modules/laws)
target_include_directories(ek_test_laws PUBLIC ${CMAKE_CURRENT_BINARY_DIR}/modules/laws)
target_link_libraries(ek_test_laws PUBLIC ek_sensitivity ek_packs ek_study ek_export ek_plausible ek_deck ek_equilibrium)
