#!/usr/bin/env bash
# speed.sh [PROGRAM]: measures the figures of docs/performance.md, as a table in Markdown on standard output.
#
# PROGRAM: default build/release/bin/elastokin; it is compiled. With a PROGRAM, PROGRAM-bench is used too. Takes some minutes. A busy machine changes the
# times more than the ratios; its processor and load are printed below the table.
set -euo pipefail
cd "$(dirname "$0")/.."
export LC_ALL=C.UTF-8

elastokin=${1:-build/release/bin/elastokin}
[ -n "${1:-}" ] || { tools/build.sh release elastokin && tools/build.sh release elastokin-bench; }
elastokin=$(realpath "$elastokin")
load=$(cut -d ' ' -f 1-3 /proc/loadavg 2>/dev/null || echo unknown)
samples=20000                # designs of the study
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# bench FILE DECK CASE INCREMENTS
bench() { "$elastokin-bench" "input/$2/$2.nml" --case "$3" --increments "$4" --json >"$work/$1"; }
# the value of a key; with a size, that of the chain with this matrix
value() { awk -v key="\"$2\":" -v n="${3:-}" '$1 == "\"n\":" {here = $2 + 0 == n} $1 == key && (n == "" || here) {print $2 + 0; exit}' "$work/$1"; }
figure() { printf "%.${2}f" "$1"; }
row() { echo "| $1 | $2 |"; }
per_second() { awk -v x="$1" 'BEGIN {k = int(x/1e3 + 0.5); if (k >= 1000) printf "%d %03d 000", k/1000, k%1000; else printf "%d 000", k}'; }
seconds() { local start; start=$(date +%s.%N); "$@" >/dev/null; awk -v a="$start" -v b="$(date +%s.%N)" 'BEGIN {print b - a}'; }

bench corner mcpherson vertical_sweep 600
bench axle mcpherson_axle parallel_travel 600
bench five five_link_axle parallel_travel 600
bench short_corner mcpherson vertical_sweep 60
bench short_axle mcpherson_axle parallel_travel 100
"$elastokin-bench" --growth 2000 --json >"$work/growth"
{ echo "&include file = '$PWD/input/mcpherson_axle/mcpherson_axle.nml' /"
  seq 12 | awk '{printf "&manoeuvre name = \"m%d\", vertical = %.2f, lateral = %.2f /\n", $1, 0.75 + 0.05*$1, 0.05*$1 - 0.05}'; } >"$work/manoeuvres.nml"
"$elastokin-bench" "$work/manoeuvres.nml" --set axle.mass=1500 --case manoeuvres --json >"$work/manoeuvres"

cat >"$work/study.nml" <<END
&study name = 'speed', kind = 'monte_carlo', samples = $samples, increments = 60,
       deck = '$PWD/input/mcpherson/mcpherson.nml', case = 'wheel_travel_sweep' /
&factor name = 'points', path = 'point.tie_rod_inner.z', 'point.lca_front.z', 'point.lca_rear.z', each = .true., change = 'delta',
        tolerance = 1.0, distribution = 'normal' /
&response name = 'bump_steer', column = 'toe_deg', of = 'slope' /
&response name = 'bump_camber', column = 'camber_deg', of = 'slope' /
&response name = 'toe', column = 'toe_deg', at = 60.0 /
&response name = 'camber', column = 'camber_deg', at = 60.0 /
&response name = 'caster', column = 'caster_deg', at = 60.0 /
END
study=$(seconds "$elastokin" study "$work/study.nml" --out "$work/out" --no-plots --quiet)
report=9
for _ in 1 2 3 4 5; do
  time=$(seconds "$elastokin" report input/mcpherson_axle/mcpherson_axle.nml --no-plots --quiet --out "$work/report")
  report=$(awk -v a="$report" -v b="$time" 'BEGIN {print a < b ? a : b}')
done

echo "| what | measured |"
echo "|---|---|"
row "state of a sweep of 601 states, in units of dsysv, by LAPACK: McPherson corner / axle / five-link axle" \
  "$(figure "$(value corner lapack_units)" 2) / $(figure "$(value axle lapack_units)" 2) / $(figure "$(value five lapack_units)" 2)"
row "the same by sparse" \
  "$(figure "$(value corner plan_units)" 2) / $(figure "$(value axle plan_units)" 2) / $(figure "$(value five plan_units)" 2)"
row "McPherson corner, 61 states: states per second and core, by LAPACK / by sparse / in packs" \
  "$(per_second "$(value short_corner states_per_s)") / $(per_second "$(value short_corner plan_states_per_s)") / $(per_second "$(value short_corner pack_states_per_s)")"
row "McPherson axle through both stops, 101 states: the same" \
  "$(per_second "$(value short_axle states_per_s)") / $(per_second "$(value short_axle plan_states_per_s)") / $(per_second "$(value short_axle pack_states_per_s)")"
row "study of the McPherson corner, 61 states and 5 responses per design, $(nproc) threads: time of a million designs (from $samples)" \
  "$(figure "$(awk -v t="$study" -v n="$samples" 'BEGIN {print t*1e6/n}')" 0) s"
row "compliance matrix of a state, by sparse: McPherson corner / axle" \
  "$(figure "$(value corner kandc_row_us)" 1) / $(figure "$(value axle kandc_row_us)" 1) µs"
row "the same with all K&C quantities" "$(figure "$(value corner kandc_all_us)" 1) / $(figure "$(value axle kandc_all_us)" 1) µs"
row "12 manoeuvres of the McPherson axle with the loads on all parts, by sparse" "$(figure "$(value manoeuvres loads_ms)" 1) ms"
row "increment of a chain with n = 397 / 1999, by LAPACK" \
  "$(figure "$(awk -v t="$(value growth lapack_us 397)" 'BEGIN {print t/1e3}')" 2) / $(figure "$(awk -v t="$(value growth lapack_us 1999)" 'BEGIN {print t/1e3}')" 0) ms"
row "the same by sparse" \
  "$(figure "$(awk -v t="$(value growth plan_us 397)" 'BEGIN {print t/1e3}')" 3) / $(figure "$(awk -v t="$(value growth plan_us 1999)" 'BEGIN {print t/1e3}')" 2) ms"
row "peak memory of the process with these chains, by sparse / then by LAPACK" \
  "$(figure "$(value growth plan_peak_mb 397)" 0), $(figure "$(value growth plan_peak_mb 1999)" 0) / $(figure "$(value growth lapack_peak_mb 1999)" 0) MB"
row "report of the McPherson axle with all tests, without gnuplot" "$(figure "$report" 2) s"
echo
processor=$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo 2>/dev/null | head -n 1)
echo "$(nproc) processors, ${processor:-unknown}, load $load at the beginning; $("$elastokin" --version | sed -n '1p; s/^SIMD batch  */; SIMD batch: /p' | tr -d '\n')"
