#!/bin/sh
# run_tests.sh BUILD_DIR [ctest argument...]: run ctest and end with the line `N passed, N failed`.
#
# Counted are single tests, not programs; a program that crashed, hung or was not built counts as one
# failure. Status 0 if every test passed, 1 if one failed or none ran.
set -u
here=$(dirname "$0")
if [ $# -lt 1 ] || [ ! -d "$1" ]; then echo "usage: run_tests.sh BUILD_DIR [ctest argument...]" >&2; exit 1; fi
build=$1
shift

log=$build/Testing/Temporary/LastTest.log
results=$build/Testing/results.txt
mkdir -p "$build/Testing/Temporary"
# what ctest keeps is counted below: a second run in the same folder waits for the first
if command -v flock >/dev/null; then
  exec 9>"$build/Testing/lock"
  flock 9
fi
rm -f "$log"
{ ctest --test-dir "$build" --output-on-failure "$@" 2>&1; echo "ctest status $?"; } | tee "$results" |
  grep -v '^ctest status [0-9]*$'
touch "$log"
awk -f "$here/add_up.awk" "$results" "$log"
