#!/bin/sh
# check_failures.sh PROGRAM FILE.pf: the program fails each test with the `! expect:` message, gives
# the line after it as the place, and ends with status 2.
set -u
name=$(basename "$2" .pf)
expected=$(awk -v file="$name.pf" '
  /^ *! expect: / { sub(/^ *! expect: /, ""); print file ":" FNR + 1 ": " $0; n++ }
  END { print file ": 0 passed, " n " failed" }' "$2" | sed "s/^$name.pf: 0 passed/$name: 0 passed/")
found=$("$1")
status=$?
if [ "$status" -ne 2 ]; then echo "expected status 2, found $status"; exit 1; fi
if [ "$found" != "$expected" ]; then
  printf 'expected:\n%s\n\nfound:\n%s\n' "$expected" "$found"
  exit 1
fi
