#!/bin/sh
# check_trap.sh PF2F90 TRAP.pf DIR NAMES: the trap is refused with status 2, with the one message that its
# first line gives as `! refuse LINE: message`, and nothing is written to DIR.
set -u
expected="$2:$(sed -n '1s/^! refuse //p' "$2")"
rm -rf "$3"
mkdir -p "$3"
found=$("$1" "$2" "$3" "$4" 2>&1)
status=$?
if [ "$status" -ne 2 ]; then echo "expected status 2, found $status"; exit 1; fi
if [ "$found" != "$expected" ]; then
  printf 'expected:\n%s\n\nfound:\n%s\n' "$expected" "$found"
  exit 1
fi
if [ -n "$(ls "$3")" ]; then echo "a refused file was written"; exit 1; fi
