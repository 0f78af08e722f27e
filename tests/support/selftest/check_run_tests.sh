#!/bin/sh
# check_run_tests.sh ADD_UP.awk: the sum over made-up output of ctest, with programs of the stand-in and
# of pFUnit that passed, failed, crashed, and ended without a summary.
set -u
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT

block() { printf '1/9 Testing: %s\n1/9 Test: %s\nOutput:\n------\n%s\n<end of output>\n' "$1" "$1" "$2"; }
result() { printf '%s/9 Test #%s: %s ........%s  0.01 sec\n' "$1" "$1" "$2" "$3"; }

{
  block test_good '  running a
test_good: 12 passed, 0 failed, 1 skipped'
  block test_bad 'test_bad: 2 passed, 3 failed'
  block test_crashed 'Segmentation fault'
  block test_leaks 'test_leaks: 4 passed, 0 failed'
  block pfunit_good ' OK
 (7 tests, 2 disabled)'
  block pfunit_one ' OK
 (1 test)'
  block pfunit_bad 'Tests run: 9, Failures: 2, Errors: 1
, Disabled: 1'
  block command_good '5 passed'
} >"$work/log"
{
  result 1 test_good '   Passed  '
  result 2 test_bad '***Failed  '
  result 3 test_crashed '***Exception: SegFault'
  result 4 test_leaks '***Failed  '
  result 5 pfunit_good '   Passed  '
  result 6 pfunit_one '   Passed  '
  result 7 pfunit_bad '***Failed  '
  result 8 command_good '   Passed  '
  result 9 never_built '***Not Run '
  echo 'ctest status 8'
} >"$work/results"

expect() {
  if [ "$found" != "$1" ]; then printf 'expected:\n%s\n\nfound:\n%s\n' "$1" "$found"; exit 1; fi
}
# passed 12 + 2 + 0 + 4 + 7 + 1 + 6 + 1, failed 0 + 3 + 1 + 1 + 0 + 0 + 3 + 0 + 1
found=$(awk -f "$1" "$work/results" "$work/log"; echo "status $?")
expect '4 skipped
33 passed, 9 failed
status 1'

result 1 test_good '   Passed  ' >"$work/results"
echo 'ctest status 0' >>"$work/results"
found=$(awk -f "$1" "$work/results" "$work/log"; echo "status $?")
expect '1 skipped
12 passed, 0 failed
status 0'

echo 'ctest status 0' >"$work/results"
found=$(awk -f "$1" "$work/results" "$work/log"; echo "status $?")
expect 'no test ran
0 passed, 0 failed
status 1'
