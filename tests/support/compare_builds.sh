#!/usr/bin/env bash
# compare_builds.sh BUILD OTHER: the program of two build folders (other compiler, other options) side by side.
#
# Runs every deck of the library with both and compares all tables (table_difference.awk): status 1 if one differs by more than 5e-10.
# Then times the increments of a corner and of an axle, each program five times in turn, and prints the ratio of the least
# times; no limit, as the machine may be busy. Last line: a summary.
set -uo pipefail
cd "$(dirname "$0")/../.." || exit 1
if [ $# -ne 2 ]; then echo "usage: compare_builds.sh BUILD OTHER" >&2; exit 1; fi
limit=5e-10
export OPENBLAS_NUM_THREADS=1     # threads sum in another order
out=$(mktemp -d) || exit 1
trap 'rm -rf "$out"' EXIT
wrong=0

run_all() { # run_all BUILD FOLDER: tables of every deck into FOLDER/DECK
  local deck
  for deck in input/*/*.nml; do
    grep -q '^ *&model' "$deck" || continue      # part of other decks
    "$1/bin/elastokin" run "$deck" --quiet --out "$2/$(basename "$deck" .nml)" >/dev/null || return 1
  done
  (cd "$2" && find . -name '*.csv' | sort) >"$2.txt"
}

run_all "$1" "$out/a" && run_all "$2" "$out/b" && diff "$out/a.txt" "$out/b.txt" || wrong=1
while read -r table; do
  awk -f tests/support/table_difference.awk "$out/a/$table" "$out/b/$table" | sed "s|$out/b/||"
done <"$out/a.txt" | sort -g >"$out/differences.txt"
tail -n 5 "$out/differences.txt"
# a table that differs in shape, and no tables at all, count as well
awk -v limit=$limit '$1 !~ /^[0-9]/ || $1 > limit {print "differs: " $0; wrong = 1} END {exit wrong || NR == 0}' "$out/differences.txt" ||
  wrong=1
summary="$(wc -l <"$out/differences.txt") tables agree to $(tail -n 1 "$out/differences.txt" | cut -d ' ' -f 1)"
[ $wrong -eq 0 ] || summary='tables differ'

# the times of each method, as 'BUILD METHOD MICROSECONDS'
times() { # times BUILD OTHER DECK CASE
  local build
  for _ in 1 2 3 4 5; do
    for build in "$1" "$2"; do
      "$build/bin/elastokin-bench" "input/$3/$3.nml" --case "$4" --quiet | awk -v b="$build" '/ increment .* us/ {print b, $1, $3}'
    done
  done
}
while read -r deck case; do
  ratios=$(times "$1" "$2" "$deck" "$case" | awk -v a="$1" -v b="$2" '
    !(($1, $2) in least) || $3 < least[$1, $2] {least[$1, $2] = $3; if (!($2 in known)) {known[$2]; name[++n] = $2}}
    END {for (k = 1; k <= n; k++) printf " %s %.2f", name[k], least[b, name[k]] / least[a, name[k]]}')
  [ -n "$ratios" ] || wrong=1
  summary="$summary; times of $deck:$ratios"
done <<'END'
mcpherson vertical_sweep
mcpherson_axle parallel_travel
END
echo "$summary"
exit $wrong
