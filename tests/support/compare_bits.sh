#!/usr/bin/env bash
# compare_bits.sh BUILD OTHER: whether two build folders give the same bytes, for changes of the sources that must not change a result.
#
# Both programs run every deck of the library and every small study: `run` with all cases by both solvers, `report` with all tests,
# `export`, `derivatives`, `study` with two threads; Python, and so C, by caller_bits.py. All files are
# compared byte by byte; lines that begin with # (version, build), dates, and checksums of files that have these are left out.
# EK_PYTHON names a Python that has numpy (default: python3).
# Status 1 if a file differs, is missing, or a command ends with another status. Last line: a summary.
set -uo pipefail
cd "$(dirname "$0")/../.." || exit 1
if [ $# -ne 2 ]; then echo "usage: compare_bits.sh BUILD OTHER" >&2; exit 1; fi
export OPENBLAS_NUM_THREADS=1     # threads sum in another order
out=$(mktemp -d) || exit 1
trap 'rm -rf "$out"' EXIT

run_all() { # run_all BUILD FOLDER
  local program=$1/bin/elastokin folder=$2 deck name solver study decks=()
  status() { "$@" >/dev/null 2>>"$folder/messages.txt"; echo "$? ${*:2}" | sed "s|$folder|OUT|g" >>"$folder/statuses.txt"; }
  mkdir -p "$folder"
  for deck in input/*/*.nml; do
    grep -q '^ *&model' "$deck" || continue      # part of other decks
    name=$folder/$(basename "$deck" .nml)
    decks+=("$deck")
    for solver in lapack plan; do
      status "$program" run "$deck" --solver $solver --compliance --loads --json --quiet --out "$name.$solver"
    done
    status "$program" report "$deck" --no-plots --loads --quiet --out "$name.report"
    status "$program" derivatives "$deck" --quiet --out "$name.derivatives"
    for target in carmaker csv; do
      status "$program" export "$deck" --to $target --quiet --out "$name.$target"
    done
  done
  for study in studies/*/*.nml; do
    grep -q '^ *&study' "$study" || continue
    status "$program" study "$study" --no-plots --quiet --jobs 2 --samples 16 --out "$folder/$(basename "$study" .nml).study"
  done
  EK_LIBRARY=$1/lib/libelastokin.so.0 PYTHONPATH=python/src PYTHONDONTWRITEBYTECODE=1 "${EK_PYTHON:-python3}" -W ignore \
    tests/support/caller_bits.py "$folder/callers.txt" "${decks[@]}" || echo "caller_bits: status $?" >>"$folder/statuses.txt"
  # without the facts of the build, dates and the name of the folder
  find "$folder" -type f -exec sed -i -E "/^#/d; s|$folder|OUT|g; s/20[0-9]{2}-[0-9]{2}-[0-9]{2}.[0-9]{2}:[0-9]{2}/DATE/g" {} +
  find "$folder" -name '*-files.csv' -exec sed -i 's/,.*//' {} +     # lists of a report's or a study's files: their checksums
}

"${EK_PYTHON:-python3}" -c 'import numpy' || { echo "compare_bits: numpy is missing; set EK_PYTHON" >&2; exit 1; }
run_all "$(realpath "$1")" "$out/a"
run_all "$(realpath "$2")" "$out/b"
if diff -rq "$out/a" "$out/b" | sed "s|$out/||g"; [ "${PIPESTATUS[0]}" -ne 0 ]; then
  echo "files differ"
  exit 1
fi
echo "$(find "$out/a" -type f | wc -l) files, $(du -sm "$out/a" | cut -f 1) MB, of $(wc -l <"$out/a/statuses.txt") commands: the same bytes"
