#!/usr/bin/env bash
# draw.sh [FOLDER]: draws the figures of docs/conventions.md and docs/joints.md as SVG into FOLDER (without: beside this script),
# and with EK_PNG=1 as PNG too. Requires gnuplot.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
folder=${1:-$here}
export LC_ALL=C.UTF-8
mkdir -p "$folder"
for script in "$here"/*.gp; do
  gnuplot -e "format = 'svg'; folder = '$folder'" "$script"
  [ -z "${EK_PNG:-}" ] || gnuplot -e "format = 'png'; folder = '$folder'" "$script"
done
