#!/usr/bin/env bash
# demo.sh: from a fresh clone to the report of an axle and the paper's figures.
#
# Sets up, compiles, runs the McPherson front axle on the rig and writes its report; then sweeps the McPherson strut over
# its stroke with all three methods, runs the study of the number of increments, and draws toe, camber, lateral
# movement, and the error over the number of increments, as in
#
#     J. S. Kang, Elastokinematic analysis of a suspension system with linear recursive formula,
#     International Journal of Automotive Technology 6(4), 2005
#
# Results and pictures: out/demo. Files that are up to date are not made again.
set -euo pipefail
cd "$(dirname "$0")/.."
export LC_ALL=C.UTF-8     # a decimal point in every number, and no gnuplot warning about characters

elastokin=build/release/bin/elastokin
deck=input/mcpherson/mcpherson.nml
sweep=mcpherson_vertical_sweep.csv
axle=input/mcpherson_axle/mcpherson_axle.nml
page=out/demo/report/report.html
study=studies/step_size/out/step_size.csv
paper=studies/paper

is_current() { # is_current MADE FROM...: MADE exists and is newer than all FROM
  local made=$1 from
  shift
  [ -s "$made" ] || return 1
  for from in "$@"; do [ "$made" -nt "$from" ] || return 1; done
}

[ -x $elastokin ] || echo "demo: compiling, a minute or so"
tools/build.sh release elastokin

mkdir -p out/demo
if ! is_current $page $elastokin $axle; then
  echo "demo: the McPherson front axle on the rig"
  $elastokin report $axle --out "$(dirname $page)" --quiet >/dev/null
fi
for method in recursive corrected equilibrium; do
  folder=out/demo/$method
  is_current "$folder/$sweep" $elastokin $deck && continue
  echo "demo: sweeping the McPherson strut, method $method"
  $elastokin run $deck --case vertical_sweep --method $method --out "$folder" --quiet >/dev/null
done

if ! is_current $study $elastokin $deck studies/step_size/study.nml; then
  echo "demo: running the study of the number of increments"
  $elastokin study studies/step_size/study.nml --out "$(dirname $study)" --quiet >/dev/null
fi

pictures=(toe camber lateral increments)
sources=("$paper"/plot.gp "$paper"/*.awk "$study" out/demo/*/"$sweep")
for picture in "${pictures[@]}"; do
  if ! is_current "out/demo/$picture.png" "${sources[@]}" || ! is_current "out/demo/$picture.svg" "${sources[@]}"; then
    echo "demo: drawing the figures"
    gnuplot $paper/plot.gp
    break
  fi
done

echo
awk -f $paper/key_numbers.awk out/demo/{recursive,corrected,equilibrium}/$sweep
echo
echo "Report of the McPherson front axle (open it in a browser):"
echo "  $page"
echo "The paper's figures (also as .svg):"
for picture in "${pictures[@]}"; do echo "  out/demo/$picture.png"; done
echo "Tables:"
for method in recursive corrected equilibrium; do echo "  out/demo/$method/$sweep"; done
echo "  $study"
