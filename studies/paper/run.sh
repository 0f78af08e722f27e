#!/usr/bin/env bash
# run.sh [FOLDER]: the paper's figures by one command, from any folder.
#
# Sweeps the McPherson strut over its stroke with all three methods, runs the study of the number of increments, draws toe,
# camber, lateral movement, and the error over the number of increments, and prints a table of K&C metrics. Everything goes to
# FOLDER (default: out, beside this script). Files that are up to date are not made again.
#
# ELASTOKIN=/path/to/elastokin uses that program; otherwise the release build is compiled first.
set -euo pipefail
export LC_ALL=C.UTF-8     # a decimal point in every number, and no gnuplot warning about characters
here=$(cd "$(dirname "$0")" && pwd)
top=$(cd "$here/../.." && pwd)
out=${1:-$here/out}
mkdir -p "$out"
out=$(cd "$out" && pwd)

deck=$top/input/mcpherson/mcpherson.nml
sweep=mcpherson_vertical_sweep.csv
study=$out/step_size/step_size.csv

is_current() { # is_current MADE FROM...: MADE exists and is newer than all FROM
  local made=$1 from
  shift
  [ -s "$made" ] || return 1
  for from in "$@"; do [ "$made" -nt "$from" ] || return 1; done
}

if [ -n "${ELASTOKIN:-}" ]; then
  elastokin=$(command -v "$ELASTOKIN") || { echo "run.sh: there is no program $ELASTOKIN" >&2; exit 1; }
else
  elastokin=$top/build/release/bin/elastokin
  [ -x "$elastokin" ] || echo "paper: compiling, a minute or so"
  "$top/tools/build.sh" release elastokin
fi

for method in recursive corrected equilibrium; do
  is_current "$out/$method/$sweep" "$elastokin" "$deck" && continue
  echo "paper: sweeping the McPherson strut, method $method"
  "$elastokin" run "$deck" --case vertical_sweep --method $method --out "$out/$method" --quiet >/dev/null
done

if ! is_current "$study" "$elastokin" "$deck" "$top/studies/step_size/study.nml"; then
  echo "paper: running the study of the number of increments"
  "$elastokin" study "$top/studies/step_size/study.nml" --out "$(dirname "$study")" --quiet >/dev/null
fi

for picture in {toe,camber,lateral,increments}.{png,svg}; do
  is_current "$out/$picture" "$here"/plot.gp "$here"/*.awk "$study" "$out"/*/"$sweep" && continue
  echo "paper: drawing the figures"
  (cd "$here" && RESULTS=$out gnuplot plot.gp)
  break
done

echo
awk -f "$here/key_numbers.awk" "$out"/{recursive,corrected,equilibrium}/"$sweep"
