#!/usr/bin/env bash
# build_runtime.sh SOURCES FOLDER: compiles the Fortran runtime for wasm32, for tools/wasm.sh: FOLDER/libfortran_runtime.a.
#
# SOURCES: the parts of llvm-toolchain that versions.sh names. If it is stopped, the same command resumes. EK_JOBS: compilers at the
# same time.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
sources=$(realpath "$1")
mkdir -p "$2/objects" "$2/include"
out=$(realpath "$2")
# shellcheck source=packaging/wasm/versions.sh
. "$here/versions.sh"
jobs=${EK_JOBS:-$(nproc)}

if [ ! -e "$out/llvm/patched" ]; then
  rm -rf "$out/llvm"
  cp -r "$sources" "$out/llvm"
  patch --quiet -d "$out/llvm" -p1 <"$here/runtime.patch"
  touch "$out/llvm/patched"
fi
# what CMake would find out
printf '#define HAVE_STRERROR_R 1\n#define HAVE_DECL_STRERROR_S 0\n' >"$out/include/config.h"

object_of() { echo "$out/objects/$(basename "$1" .cpp).o"; }
compile() { # compile FILE: its object, unless there is a finished one
  local object
  object=$(object_of "$1")
  [ ! -e "$object" ] || return 0
  clang++-22 "${runtime_flags[@]}" -include "$here/system/missing.h" -I"$out/include" -I"$here/system" \
    -I"$out/llvm/flang-rt/include" -I"$out/llvm/flang-rt/lib/runtime" -I"$out/llvm/flang/include" -c "$1" -o "$object.new"
  mv "$object.new" "$object"
}
files=("$out"/llvm/flang/lib/Decimal/*.cpp "$out"/llvm/flang-rt/lib/runtime/*.cpp)
for file in "${files[@]}"; do
  while [ "$(jobs -rp | wc -l)" -ge "$jobs" ]; do wait -n || exit 1; done
  compile "$file" &
done
wait
objects=()
for file in "${files[@]}"; do
  objects+=("$(object_of "$file")")
  [ -e "${objects[-1]}" ] || { echo "build_runtime: $file was not compiled" >&2; exit 1; }
done
rm -f "$out/libfortran_runtime.a"
llvm-ar-22 crs "$out/libfortran_runtime.a" "${objects[@]}"
