# elastokin-bench, beside elastokin in bin: measures the solver, for docs/performance.md and the checks. It is not installed: no result
# of an axle needs it. Its modules are a library, for its tests.
set(ek_bench_folder ${PROJECT_SOURCE_DIR}/tools/bench)
add_library(ek_bench STATIC ${ek_bench_folder}/ek_bench.f90 ${ek_bench_folder}/ek_bench_derivatives.f90
  ${ek_bench_folder}/ek_bench_figures.f90 ${ek_bench_folder}/ek_bench_loads.f90
  ${ek_bench_folder}/ek_growth.f90 ${ek_bench_folder}/ek_increment_parts.f90)
set_target_properties(ek_bench PROPERTIES Fortran_MODULE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/modules/bench)
target_include_directories(ek_bench PUBLIC ${CMAKE_CURRENT_BINARY_DIR}/modules/bench)
target_link_libraries(ek_bench PUBLIC ek_commands ek_packs)
if(ek_has_kernel)
  target_compile_options(ek_bench PRIVATE ${ek_plain_build})
endif()
ek_program(elastokin-bench ${ek_bench_folder}/main.f90)
target_link_libraries(elastokin-bench PRIVATE ek_bench)
