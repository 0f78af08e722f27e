# The program for WebAssembly: cmake -G 'Unix Makefiles' --toolchain packaging/wasm/toolchain.cmake, called by tools/wasm.sh, which sets
# EK_WASM_RUNTIME to the folder of the Fortran runtime and LAPACK for wasm32.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_Fortran_COMPILER ${CMAKE_CURRENT_LIST_DIR}/fortran.py)
find_program(CMAKE_C_COMPILER clang-22 REQUIRED)
set(CMAKE_C_COMPILER_TARGET wasm32-wasi)
set(CMAKE_C_FLAGS_INIT -Wno-deprecated)     # as in versions.sh
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
find_program(CMAKE_AR llvm-ar-22 REQUIRED)
find_program(CMAKE_RANLIB llvm-ranlib-22 REQUIRED)
set(CMAKE_EXECUTABLE_SUFFIX .wasm)
set(CMAKE_EXECUTABLE_SUFFIX_Fortran .wasm)
set(BLAS_LIBRARIES $ENV{EK_WASM_RUNTIME}/liblapack.a CACHE STRING "")
set(LAPACK_LIBRARIES $ENV{EK_WASM_RUNTIME}/liblapack.a CACHE STRING "")
# one thread, one process, no NetCDF; CMake prints a line for each
set(CMAKE_DISABLE_FIND_PACKAGE_OpenMP ON)
set(EK_MPI OFF CACHE BOOL "")
set(EK_NETCDF OFF CACHE BOOL "")
set(BUILD_TESTING OFF CACHE BOOL "")
