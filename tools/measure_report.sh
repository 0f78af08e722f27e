#!/usr/bin/env bash
# measure_report.sh [PROGRAM [DECK]]: what a report costs apart from gnuplot.
#
# gnuplot draws the pictures once; in the runs that are measured a script that stands for it links them. Printed are the least processor
# time and the least time of 10 runs, both with that script, and the instructions of the program alone, counted by valgrind, which do
# not depend on the load of the machine. `solution`: in solve_case and the compliance table; `rest`: everything else, such as
# tables, charts and pages.
set -euo pipefail
export LC_ALL=C.UTF-8 OPENBLAS_NUM_THREADS=1 OPENBLAS_CORETYPE=Haswell     # a kernel of OpenBLAS that valgrind knows
program=$(realpath "${1:-build/release/bin/elastokin}")
deck=${2:-input/mcpherson_axle/mcpherson_axle.nml}

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/pictures" "$folder/bin"
"$program" report "$deck" --out "$folder/report" --quiet >/dev/null
cp "$folder"/report/picture.* "$folder/pictures"
printf '#!/bin/sh\ncp -l "%s"/* .\n' "$folder/pictures" >"$folder/bin/gnuplot"
chmod +x "$folder/bin/gnuplot"
PATH="$folder/bin:$PATH"

TIMEFORMAT='%U %S %R'
for _ in 1 2 3 4 5 6 7 8 9 10; do
  { time "$program" report "$deck" --out "$folder/report" --quiet >/dev/null 2>&1; } 2>&1
done | awk 'NR == 1 || $1 + $2 < cpu {cpu = $1 + $2} NR == 1 || $3 < wall {wall = $3}
  END {printf "least processor time %.3f s, least time %.3f s\n", cpu, wall}'

valgrind --tool=callgrind --callgrind-out-file="$folder/calls" "$program" report "$deck" --out "$folder/report" --quiet \
  >/dev/null 2>"$folder/said"
callgrind_annotate --inclusive=yes --threshold=100 "$folder/calls" | tr -d , | awk '
  /PROGRAM TOTALS/ {total = $1}
  /MOD_solve_case( |$)/ && !solve {solve = $1}
  /MOD_compliance_table( |$)/ && !table {table = $1}
  END {if (!solve) exit 1
    printf "million instructions: %.0f (solution %.0f, rest %.0f)\n", total/1e6, (solve + table)/1e6, (total - solve - table)/1e6}'
