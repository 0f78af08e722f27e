#!/usr/bin/env bash
# tests/attacks/readers.sh BUILD [MUTATIONS]: the readers of other programs' files under the address and undefined-behaviour sanitizers.
# BUILD: a build folder of the preset asan, which is made if it does not exist. MUTATIONS: of each file, default 2000.
# They are always the same: a number found bad is found again. A text that breaks a reader is left in BUILD/mutation.txt.
set -uo pipefail
shopt -s extglob
cd "$(dirname "$0")/../.." || exit 1
top=$PWD
build=$1
mutations=${2:-2000}
[ -f "$build/CMakeCache.txt" ] || cmake -S . -B "$build" -DCMAKE_BUILD_TYPE=Asan >/dev/null || exit 1
cmake --build "$build" --target readers --parallel "${EK_JOBS:-2}" >"$build/readers.log" 2>&1 || { tail -n 30 "$build/readers.log"; exit 1; }
build=$(realpath "$build")
cd "$build" || exit 1
ASAN_OPTIONS=detect_leaks=0:abort_on_error=0 UBSAN_OPTIONS=print_stacktrace=1 timeout "${EK_LIMIT:-3600}" \
  tests/readers "$mutations" "$top"/tests/formats/files/!(*_*)     # names with _: the decks that are expected of these files
