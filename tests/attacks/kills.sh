#!/usr/bin/env bash
# tests/attacks/kills.sh PROGRAM [KILLS]: the commands that write are killed at random moments (TERM, INT, KILL), some 300 times.
# Whatever lies in their folders then is whole: a table, a page or a picture has its end, a part ends with a whole row.
# Then each command is run once more, to its end: its folder holds the same bytes as one that was never disturbed, and
# nothing else. Columns of a study that hold times of the clock are left out of that.
set -uo pipefail
program=$(realpath "$1")
kills=${2:-300}
cd "$(dirname "$0")/../.." || exit 1
work=$(mktemp -d "${TMPDIR:-/tmp}/elastokin_kills_XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
export SOURCE_DATE_EPOCH=1700000000 OPENBLAS_NUM_THREADS=1 LC_ALL=C
failed=0

complain() { echo "FAILED: $*"; failed=1; }

cat >"$work/sweep.nml" <<END
&study name = 'grid', deck = '$PWD/input/mcpherson/mcpherson.nml', kind = 'sweep', case = 'vertical_sweep', chunk = 2,
       columns = 'wheel_travel_mm', 'toe_deg', plot = 'plot.gp' /
&factor path = 'bushing.lca_front.kt(1)', name = 'kf', values = 500, 1000, 2000, 4000, 8000 /
&factor path = 'bushing.lca_rear.kt(1)', name = 'kr', values = 500, 1000, 2000, 4000 /
&response name = 'toe', column = 'toe_deg', of = 'span' /
END
cat >"$work/plot.gp" <<'END'
set datafile separator comma
do for [format in 'png svg'] {
  if (format eq 'png') { set terminal pngcairo size 600, 400 }
  if (format eq 'svg') { set terminal svg size 600, 400 }
  set output sprintf('%s/toe.%s', out, format)
  plot out.'/grid_curves.csv' using 'toe_deg':'wheel_travel_mm' with lines
  unset output
}
END

# command NAME FOLDER: one of the commands that write, into that folder
command_of() {
  case $1 in
    run) "$program" run tests/decks/tiny.nml --plot --out "$2" ;;
    long_run) "$program" run input/mcpherson/mcpherson.nml --increments 2000 --out "$2" ;;
    report) "$program" report tests/decks/tiny.nml --animate --out "$2" ;;
    compare) "$program" compare "$work/a" "$work/b" --out "$2" ;;
    study) "$program" study "$work/sweep.nml" --out "$2" ;;
    step_size) "$program" study studies/step_size/study.nml --out "$2" ;;
  esac
}
names=(run long_run report compare study step_size)

# Everything in a folder but times of the clock, and the pictures and the page that show them
digest() {
  (cd "$1" && find . \( -type f -o -type l \) ! -name 'convergence.*' ! -name 'work_precision.*' ! -name step_size.html | sort | while read -r file; do
    case $file in
      */step_size.csv) cut -d, -f1-6,8- "$file" ;;
      */step_size-files.csv) cut -d, -f1 "$file" ;;      # the checksum of that table
      # gnuplot 5.4 writes two lines of one colour as one path or as two, at random
      *.svg | *.html) sed -zE "s#  '/>\s*<path stroke='[^']*'  d='# #g" "$file" ;;
      *) cat "$file" ;;
    esac | md5sum | sed "s|-|$file|"
  done)
}

# no half file under a name of its own
check_whole() {
  local file end
  while read -r file; do
    end=$(tail -c 16 "$file" | od -An -c | tr -d ' \n')
    case $file in
      */.elastokin-*.tmp | */.elastokin-*.tmp/*) ;;
      *.csv | *.gp | *.json) [[ $end == *'\n' ]] || complain "$file has no end after $2" ;;
      *.parts/study.txt) [[ $end == *'\n' && $(tail -n 2 "$file") == 'designs 20 in chunks of 2'*'build elastokin '* ]] ||
        complain "$file has no end after $2" ;;
      *.nml) tail -n 1 "$file" | grep -q '^/$' || complain "$file has no end after $2" ;;
      *.parts/chunk_*.bin) ;;       # each has a checksum; that the last run has the same bytes shows that they are read well
      *.part) [ ! -s "$file" ] || [[ $end == *'\n' ]] || complain "$file ends within a row after $2" ;;
      *.html) tail -c 20 "$file" | grep -q '</html>' || complain "$file has no end after $2" ;;
      *.svg) tail -c 20 "$file" | grep -q '</svg>' || complain "$file has no end after $2" ;;
      *.png) tail -c 12 "$file" | grep -aq IEND || complain "$file has no end after $2" ;;
      *.gif) [ "$(tail -c 1 "$file")" = ';' ] || complain "$file has no end after $2" ;;
      *) complain "what is $file after $2" ;;
    esac
  done < <(find "$1" -type f)
}

for model in a b; do
  set=(); [ $model = b ] && set=(--set spring.coil.rate=31)
  "$program" report tests/decks/tiny.nml --no-plots --quiet "${set[@]}" --out "$work/$model" >"$work/said" 2>&1 || complain "$(cat "$work/said")"
done
declare -A lasts
for name in "${names[@]}"; do
  mkdir -p "$work/wanted/$name" "$work/hit/$name"
  start=$(date +%s%N)
  command_of "$name" "$work/wanted/$name" >"$work/said" 2>&1 || complain "$name: $(cat "$work/said")"
  lasts[$name]=$((($(date +%s%N) - start) / 1000))
  echo "$name: ${lasts[$name]} us undisturbed, $(find "$work/wanted/$name" -type f | wc -l) files"
done

# Two lanes at once, each with its share of the commands and folders of its own
lane() { # lane KILLS NAME...
  local wanted=$1 struck=0 k name signal signals=(TERM KILL INT) wait_us victim target
  shift
  RANDOM=$wanted
  for ((k = 0; struck < wanted && k < 2 * wanted; k++)); do
    name=${*:$((k % $# + 1)):1}
    signal=${signals[RANDOM % 3]}
    wait_us=$(((RANDOM * 32768 + RANDOM) % lasts[$name]))
    command_of "$name" "$work/hit/$name" >"$work/said.$1" 2>&1 &
    victim=$!
    sleep "$(printf '%d.%06d' $((wait_us / 1000000)) $((wait_us % 1000000)))"
    # the program itself, a child of the shell that runs the function
    target=$(cat "/proc/$victim/task/$victim/children" 2>/dev/null)
    if [ -n "$target" ] && kill -s "$signal" "${target%% *}" 2>/dev/null; then struck=$((struck + 1)); fi
    wait "$victim" 2>/dev/null
    check_whole "$work/hit/$name" "kill $k of $name by $signal after $wait_us us"
  done
  echo "$struck" >"$work/struck.$1"
  return $failed
}
lane $((kills / 2)) run compare study & first=$!
lane $((kills - kills / 2)) long_run report step_size & second=$!
wait $first || failed=1
wait $second || failed=1
struck=$(($(cat "$work/struck.run") + $(cat "$work/struck.long_run")))
echo "$struck of $kills kills found their command alive"
[ "$struck" -ge $((kills * 9 / 10)) ] || complain "too few kills struck"
sleep 1      # a gnuplot whose parent was killed may still be at work, in a folder that nobody looks into

for name in "${names[@]}"; do
  # parts of killed studies: nothing that was computed is lost
  if [ "$name" = study ] || [ "$name" = step_size ]; then
    echo "$name: $(find "$work/hit/$name" -name '*.part' -o -name 'chunk_*.bin' | wc -l) parts kept"
  fi
  command_of "$name" "$work/hit/$name" >"$work/said" 2>&1 || complain "$name again: $(cat "$work/said")"
  diff <(digest "$work/wanted/$name") <(digest "$work/hit/$name") || complain "$name: not the same after the kills"
  find "$work/hit/$name" -name '.elastokin*' -o -name '*.part' | sed 's/^/FAILED: left behind: /' | grep . && failed=1
done
[ $failed -eq 0 ] && echo "remark: $struck kills, no half file, reruns the same to the byte"
exit $failed
