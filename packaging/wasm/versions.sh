# shellcheck shell=bash disable=SC2034
# Sources, packages and flags of the WebAssembly build, for tools/wasm.sh and build_runtime.sh.
# Compiler and Fortran runtime must be of one version: the runtime reads data that the compiler lays out.

llvm_version=22.1.8
llvm_archive=llvm-toolchain-22_$llvm_version.orig.tar.xz
llvm_pool=main/l/llvm-toolchain-22
llvm_sum=b49b9277aef97616320b2da259e1f8174c65b0ce2fbe2e8629644a97693402fe
# what is used of it, and the sum of these files (tree_sum of tools/wasm.sh)
llvm_parts=(flang-rt/LICENSE.TXT flang-rt/include flang-rt/lib/runtime flang/lib/Decimal
  flang/include/flang/Common flang/include/flang/Decimal flang/include/flang/Runtime flang/include/flang/ISO_Fortran_binding.h)
llvm_parts_sum=0c676b93bff78aafb8dc5bfd5c05350bbea7af4a2413539768731f836f0ad704

lapack_version=3.11.0
lapack_archive=lapack_$lapack_version.orig.tar.gz
lapack_pool=main/l/lapack
lapack_sum=4b9ba79bfd4921ca820e83979db76ab3363155709444a787979e81c22285ffa9
lapack_parts=(LICENSE SRC BLAS/SRC INSTALL)
lapack_parts_sum=2fad610475c14217a73b0da593ba5792417e92950ad97b0e9203f73f19d19c77

packages=(flang-22 clang-22 lld-22 llvm-22 wasi-libc libclang-rt-22-dev-wasm32 libc++-22-dev-wasm32 libc++abi-22-dev-wasm32)

# what the program calls; build_lapack.py adds what these routines call
lapack_routines=(dsytrf dsytrs dsytrs2 dlacn2 dsysv dgesv dsyev dgesvd dgelsd dpotrf dgetrf dgetrs dgemm)

c_flags=(--target=wasm32-wasi -Wno-deprecated -O2)     # the folder of wasi-libc has this name, not that of wasm32-wasip1
runtime_flags=(--target=wasm32-wasi -O2 -std=c++17 -fno-exceptions -fno-rtti -w -Wno-c++11-narrowing
  -D_WASI_EMULATED_GETPID -D_WASI_EMULATED_SIGNAL -D_WASI_EMULATED_PROCESS_CLOCKS -DFLANG_LITTLE_ENDIAN=1)
