#!/usr/bin/env bash
# test.sh [PRESET [CMAKE-ARGUMENT...]]: sets up, compiles, runs every test; the last line is `N passed, N failed`.
#
# PRESET: release (default), debug or asan. Status 0 if every test passed. Open MPI is installed too, for the tests of studies with
# mpirun; without it they are left out.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 1

preset=${1:-release}
shift $(($# < 1 ? $# : 1))
folder=${EK_BUILD:-build/$preset}
jobs=${EK_JOBS:-$(nproc)}

# optional: without them elastokin-netcdf is left out, and its tests do nothing
tools/setup.sh libnetcdff-dev netcdf-bin || echo "test: without NetCDF"
tools/setup.sh libopenmpi-dev openmpi-bin || echo "test: without MPI, its tests are left out" >&2
built=0
tools/build.sh "$preset" all "$@" || built=$?
# a test that was not built counts as failed; without a build folder there are no tests to count
if [ ! -f "$folder/CTestTestfile.cmake" ]; then
  echo "0 passed, 1 failed"
  exit 1
fi
# one more than the processors: some tests wait, for a pipe or another process
sh tests/support/run_tests.sh "$folder" --parallel $((jobs + 1))
passed=$?
exit $((passed != 0 ? passed : built))
