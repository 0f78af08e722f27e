#!/usr/bin/env bash
# build.sh [PRESET [TARGET [CMAKE-ARGUMENT...]]]: sets up, configures and compiles into build/PRESET.
#
# PRESET: release (default), debug or asan, see CMakePresets.json. TARGET: the target to compile, default all.
# The output of CMake and the compiler goes to build/PRESET/build.log; its end is printed when they fail.
# EK_BUILD sets another folder, so that one preset can be built with different arguments.
set -euo pipefail
cd "$(dirname "$0")/.."

preset=${1:-release}
target=${2:-all}
shift $(($# < 2 ? $# : 2))
folder=${EK_BUILD:-build/$preset}
jobs=${EK_JOBS:-$(nproc)}

tools/setup.sh
mkdir -p "$folder"
log=$folder/build.log
if ! cmake --preset "$preset" -B "$folder" "$@" >"$log" 2>&1; then
  tail -n 40 "$log" >&2
  echo "build: CMake failed; its output is in $log" >&2
  exit 1
fi
grep '^-- Unit tests:' "$log" | sed 's/^-- //' || true
# --keep-going: compile as much as possible, so that those tests run
if ! cmake --build "$folder" --parallel "$jobs" --target "$target" -- --keep-going --output-sync=target >>"$log" 2>&1; then
  grep -A 6 -E '^[^ ]+:[0-9]+:[0-9]+:|Error' "$log" | tail -n 60 >&2
  echo "build: compilation failed; the complete output is in $log" >&2
  exit 1
fi
