#!/usr/bin/env bash
# demo.sh: from a fresh clone to the report of an axle and the paper's figures.
#
# Sets up, compiles, runs the McPherson front axle on the rig and writes its report; then studies/paper/run.sh sweeps the McPherson
# strut over its stroke with all three methods, runs the study of the number of increments, and draws toe, camber, lateral
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
axle=input/mcpherson_axle/mcpherson_axle.nml
page=out/demo/report/report.html

[ -x $elastokin ] || echo "demo: compiling, a minute or so"
tools/build.sh release elastokin

mkdir -p out/demo
if [ ! -s $page ] || [ ! $page -nt $elastokin ] || [ ! $page -nt $axle ]; then
  echo "demo: the McPherson front axle on the rig"
  $elastokin report $axle --out "$(dirname $page)" --quiet >/dev/null
fi
ELASTOKIN=$elastokin studies/paper/run.sh out/demo

echo
echo "Report of the McPherson front axle (open it in a browser):"
echo "  $page"
echo "The paper's figures (also as .svg):"
for picture in toe camber lateral increments; do echo "  out/demo/$picture.png"; done
echo "Tables:"
for method in recursive corrected equilibrium; do echo "  out/demo/$method/mcpherson_vertical_sweep.csv"; done
echo "  out/demo/step_size/step_size.csv"
