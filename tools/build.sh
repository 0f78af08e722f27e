#!/usr/bin/env bash
# build.sh [PRESET [TARGET [CMAKE-ARGUMENT...]]]: sets up, configures and compiles into build/PRESET.
#
# PRESET: release (default), debug or asan, see CMakePresets.json. TARGET: the target to compile, default all.
# The output of CMake and the compiler goes to build/PRESET/build.log; its end is printed when they fail.
# EK_BUILD sets another folder, so that one preset can be built with different arguments.
# A new folder is built by Ninja with gfortran (docs/compilers.md), by make with another compiler or without Ninja. CMAKE_GENERATOR
# selects the generator. An existing folder keeps its generator.
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
if [ -e "$folder/CMakeCache.txt" ]; then
  CMAKE_GENERATOR=$(sed -n 's/^CMAKE_GENERATOR:INTERNAL=//p' "$folder/CMakeCache.txt")
elif [ -z "${CMAKE_GENERATOR:-}" ]; then
  CMAKE_GENERATOR='Unix Makefiles'
  compiler=${FC:-gfortran}
  for argument in "$@"; do
    case $argument in -DCMAKE_Fortran_COMPILER=*) compiler=${argument#*=} ;; esac
  done
  if [[ $compiler == *gfortran* ]] && command -v ninja >/dev/null; then CMAKE_GENERATOR=Ninja; fi
fi
export CMAKE_GENERATOR
# compile as much as possible, so that those tests run
case $CMAKE_GENERATOR in
  Ninja) go_on=(-k 0) ;;
  *) go_on=(--keep-going --output-sync=target) ;;
esac
# CMake configures again only if something changed that the build files do not watch themselves: arguments, environment, installed
# packages. A machine without dpkg configures each time
stamp=$folder/configured.txt
facts() {
  printf '%s\n' "$preset" "$@" "${CMAKE_PREFIX_PATH:-}" "${FC:-}" "${FFLAGS:-}" "$(pwd)"
  stat -c '%Y %n' CMakePresets.json /var/lib/dpkg/status
}
if ! now=$(facts "$@" 2>/dev/null) || [ ! -s "$folder/CMakeCache.txt" ] || [ "$now" != "$(cat "$stamp" 2>/dev/null)" ]; then
  rm -f "$stamp"
  if ! cmake --preset "$preset" -B "$folder" "$@" >"$log" 2>&1; then
    tail -n 40 "$log" >&2
    echo "build: CMake failed; its output is in $log" >&2
    exit 1
  fi
  grep '^-- Unit tests:' "$log" | sed 's/^-- //' || true
  facts "$@" >"$stamp" 2>/dev/null || rm -f "$stamp"
fi
if ! cmake --build "$folder" --parallel "$jobs" --target "$target" -- "${go_on[@]}" >"$log" 2>&1; then
  grep -A 6 -E '^[^ ]+:[0-9]+:[0-9]+:|Error' "$log" | tail -n 60 >&2
  echo "build: compilation failed; the complete output is in $log" >&2
  exit 1
fi
