#!/usr/bin/env bash
# tests/attacks/attacks.sh PROGRAM [ATTACK...]: what strangers, full disks and limits can do to the program, each as a small
# scene; all of them, or the named ones. One line for each; the last is `N held, N failed`.
#
# Some need root or name spaces of Linux (unshare): where these are not to be had, the line says so.
# shellcheck disable=SC2001,SC2015,SC2016  # `a && b || { say; return; }` is meant; words in single quotes are for another shell
set -uo pipefail
program=$(realpath "$1")
shift
cd "$(dirname "$0")/../.." || exit 1
top=$PWD
work=$(mktemp -d "${TMPDIR:-/tmp}/elastokin_attacks_XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
chmod 755 "$work"
export LC_ALL=C
tiny=$top/tests/decks/tiny.nml
mcpherson=$top/input/mcpherson/mcpherson.nml
bold=$'\e'

# ---- tools ------------------------------------------------------------------------------------

# run STATUS COMMAND...: the command within a minute; its words go to said.txt, its standard output to out.txt
run() {
  local wanted=$1 status
  shift
  timeout 60 "$@" >out.txt 2>said.txt </dev/null
  status=$?
  [ "$status" -eq "$wanted" ] || { echo "status $status, not $wanted: $* : $(head -c 600 said.txt)"; return 1; }
}
says() { grep -qF -- "$1" said.txt || { echo "'$1' is not in: $(head -c 600 said.txt)"; return 1; }; }
same() { cmp -s "$1" "$2" || { echo "$1 has changed"; return 1; }; }
gone() { [ ! -e "$1" ] && [ ! -L "$1" ] || { echo "$1 is there"; return 1; }; }
clean() { # no temporary file or folder below
  local left
  left=$(find "$1" -name '.elastokin-*')
  [ -z "$left" ] || { echo "left behind: $left"; return 1; }
}
not_here() { echo "remark: $*"; return 0; }
fake_gnuplot() { # fake_gnuplot WORDS...: a gnuplot of one's own in bin/
  mkdir -p bin
  printf '#!/bin/sh\n%s\n' "$*" >bin/gnuplot
  chmod +x bin/gnuplot
}
a_report() { "$program" report "$tiny" --no-plots --quiet --out "$1" "${@:2}" >/dev/null 2>&1; }
as_nobody() { # a user to whom limits apply
  if [ "$(id -u)" -eq 0 ]; then
    # a copy that is his to run, with the private library beside it
    mkdir -p nobody/bin nobody/lib
    cp "$program" nobody/bin/
    local own
    own=$(dirname "$(dirname "$program")")/lib/elastokin
    [ ! -d "$own" ] || cp -r "$own" nobody/lib/
    setpriv --reuid=65534 --clear-groups true 2>/dev/null || return 9
    setpriv --reuid=65534 --clear-groups bash -c "$1" _ "./nobody/bin/$(basename "$program")"
  else
    bash -c "$1" _ "$program"
  fi
}
in_tmpfs() { # in_tmpfs OPTIONS SCRIPT: in a small disk of its own, mounted at ./disk
  mkdir -p disk
  unshare -m true 2>/dev/null || return 9
  unshare -m bash -c "mount -t tmpfs -o $1 none disk && { $2
}" _ "$program"
}

# ---- S1, S2: a foreign report ------------------------------------------------------------------

evil_list() { # evil_list TEST TITLE FILE: a report whose list has these cells, beside a sound one
  a_report good && a_report evil --set spring.coil.rate=31
  printf 'test,kind,title,file\n"%s",vertical_force,"%s","%s"\n' "$1" "$2" "$3" >evil/tests.csv
}
line_end_in_a_title() {
  evil_list sweep $'x\'\nsystem "touch pwned"\n#' sweep.csv
  run 0 "$program" compare evil good --plots --out both && gone pwned && gone both/figures/pwned
}
line_end_in_a_test() {
  evil_list $'x\nsystem "touch pwned"\n#' title sweep.csv
  run 5 "$program" compare evil good --plots --out both && gone pwned && gone both/figures/pwned && says 'is not a plain file name'
}
line_end_in_a_file() {
  evil_list sweep title $'sweep.csv\nsystem "touch pwned"'
  run 5 "$program" compare evil good --plots --out both && gone pwned && says 'is not a plain file name'
}
test_that_leaves_the_folder() {
  mkdir victim && echo mine >victim/v.svg && cp victim/v.svg kept
  evil_list ../../victim/v title sweep.csv
  run 5 "$program" compare evil good --plots --out both && same victim/v.svg kept && [ "$(ls victim)" = v.svg ] && says 'is not a plain file name'
}
file_that_leaves_the_folder() {
  evil_list sweep title ../good/sweep.csv
  run 5 "$program" compare evil good --plots --out both && says 'is not a plain file name'
}
file_with_a_whole_path() {
  evil_list sweep title /etc/passwd
  run 5 "$program" compare evil good --plots --out both && says 'is not a plain file name'
}
column_that_leaves_the_folder() { # the name of a wheel becomes part of the name of a picture
  mkdir victim
  a_report good
  mkdir evil && cp good/* evil 2>/dev/null
  sed -i 's|wheel_travel_mm|/../../../victim/x_wheel_travel_mm,right_wheel_travel_mm|; s|toe_deg|/../../../victim/x_toe_deg|; /^[0-9]/s|,|,1,|2' evil/sweep.csv
  timeout 60 "$program" compare evil evil --plots --out both >out.txt 2>said.txt
  [ -z "$(ls victim)" ] && [ -z "$(find . -name '*.svg' ! -path './both/figures/*')" ]
}
column_with_a_quote() {
  a_report good
  mkdir evil && cp good/* evil 2>/dev/null
  sed -i "s|^state,factor|state',\"factor|" evil/sweep.csv
  timeout 60 "$program" compare evil good --plots --out both >out.txt 2>said.txt
  [ $? -lt 128 ] && gone pwned
}
pipe_in_a_report() { # would be waited for for ever
  a_report good && a_report evil
  rm evil/sweep.csv && mkfifo evil/sweep.csv
  run 5 "$program" compare evil good --plots --out both && says 'not a regular file' || return 1
  rm evil/tests.csv && mkfifo evil/tests.csv
  run 5 "$program" compare evil good --plots --out both && says 'not a regular file'
}
endless_table_in_a_report() {
  a_report good && a_report evil
  rm evil/gradients.csv && ln -s /dev/zero evil/gradients.csv
  run 5 "$program" compare evil good --plots --out both && says 'not a regular file'
}

# ---- S3, S4, S5 and settings of a user -----------------------------------------------------------

link_under_a_temporary_name() { # pid, as it was; nothing of it can be foreseen now
  local k
  echo mine >victim && cp victim kept && mkdir out
  for k in $(seq $$ $(($$ + 400))); do ln -s ../victim "out/tiny_sweep.csv.$k.tmp"; done
  for k in overview toe camber; do ln -s ../victim "out/tiny_sweep_$k.gp.log"; done
  run 0 "$program" run "$tiny" --plot --out out && same victim kept && [ -s out/tiny_sweep.csv ]
}
link_under_the_name_of_a_result() {
  echo mine >victim && cp victim kept && mkdir out && ln -s ../victim out/tiny_sweep.csv
  run 0 "$program" run "$tiny" --out out && same victim kept && [ ! -L out/tiny_sweep.csv ] && [ -s out/tiny_sweep.csv ]
}
link_that_looks_stale() {
  mkdir out victim && echo mine >victim/v && touch -h -d '3 days ago' victim/v
  ln -s ../victim out/.elastokin-00000000-0123456789abcdef.tmp && touch -h -d '3 days ago' out/.elastokin-*
  run 0 "$program" run "$tiny" --out out && [ -s victim/v ]
}
pipe_under_the_name_of_a_result() {
  mkdir out && mkfifo out/tiny_sweep.csv
  run 5 "$program" run "$tiny" --out out && says 'neither a file nor a device'
}
cdpath_leads_elsewhere() {
  mkdir -p elsewhere/out elsewhere/out/figures
  CDPATH=$PWD/elsewhere run 0 "$program" run "$tiny" --plot --out out && [ -s out/tiny_sweep_toe.png ] &&
    [ -z "$(find elsewhere -type f)" ]
}
control_characters_of_a_deck() {
  sed "s/name = 'tiny'/name = 'tiny', title = '${bold}]0;x${bold}[31m'/; s/'coil'/'co${bold}[2Jil'/" "$tiny" >evil.nml
  timeout 60 "$program" check evil.nml >out.txt 2>said.txt
  ! grep -q "$bold" out.txt said.txt || { echo "they reach the terminal"; return 1; }
  grep -q 'U+001B' out.txt said.txt
}
settings_of_a_user() {
  mkdir home plain && echo 'set xrange [0:5]; set terminal dumb' >home/.gnuplot
  SOURCE_DATE_EPOCH=1 HOME=$PWD/home GNUTERM=dumb run 0 "$program" report "$tiny" --out a || return 1
  SOURCE_DATE_EPOCH=1 HOME=$PWD/plain run 0 "$program" report "$tiny" --out b || return 1
  diff -r a b
}
words_for_a_shell_in_a_path() {
  local name="it's a:b \$(touch pwned) \`touch pwned\`; touch pwned"
  run 0 "$program" run "$tiny" --plot --out "$name" && [ -s "$name/tiny_sweep_toe.png" ] && gone pwned && gone "$name/pwned" &&
    run 0 "$program" study "$top/studies/step_size/study.nml" --out "$name" && [ -s "$name/convergence.png" ] && gone pwned
}
commands_in_a_title() {
  sed "s/name = 'tiny'/name = 'tiny', title = 'a\`touch pwned\`\"; system(\"touch pwned\") \\\\\\\\'/" "$tiny" >evil.nml
  run 0 "$program" run evil.nml --plot --out out && gone pwned && gone out/pwned && [ -s out/tiny_sweep_toe.png ]
}
bomb_of_includes() { # ten files that include ten each, eight deep
  local k
  for k in 1 2 3 4 5 6 7; do
    for _ in 0 1 2 3 4 5 6 7 8 9; do echo "&include file = 'level$((k + 1)).nml' /"; done >"level$k.nml"
  done
  echo "&point name = 'p', at = 0, 0, 0 /" >level8.nml
  run 2 "$program" check level1.nml && says 'more than 500 files'
}
endless_include() {
  echo "&include file = '/dev/zero' /" >zero.nml
  run 2 "$program" check zero.nml && says 'not a regular file' || return 1
  mkfifo pipe && echo "&include file = 'pipe' /" >pipe.nml
  run 2 "$program" check pipe.nml && says 'not a regular file'
}
files_that_are_too_large() { # 60 MB of what each reader reads in lines; tables beyond the memory end with a message
  local name
  for name in x.sub x.bus x.kin x.gum x.lcf x.csv; do
    yes '[MDI' | head -c 60000000 >"$name"
    run 5 "$program" import "$name" && says 'it has 60 MB, expected at most 50 MB' || return 1
  done
  yes 'spring.coil.rate = 30' | head -c 60000000 >x.set
  run 5 "$program" check "$tiny" --set-file x.set && says 'it has 60 MB, expected at most 50 MB' || return 1
  head -c 1000000000 /dev/zero | tr '\0' x >line.set
  run 5 "$program" check "$tiny" --set-file line.set && says 'expected at most 50 MB' || return 1
  head -c 45000000 line.set >short.set
  run 2 timeout 60 "$program" check "$tiny" --set-file short.set || return 1
  yes 1,2,3 | head -c 60000000 >x.csv
  run 5 bash -c "ulimit -v 250000; exec '$program' compare x.csv x.csv --out out" && says 'error: not enough memory'
}
derivatives_of_everything() { # a table of 1.1 GB
  run 0 "$program" derivatives "$top/input/mcpherson_axle/mcpherson_axle.nml" --at all --out out &&
    [ "$(stat -c %s out/mcpherson_axle_parallel_travel_derivatives.csv)" -gt 1000000000 ] && clean out
}
endless_files_of_a_study() { # a log into a pipe without a reader, a device as a plot script and as a chunk, a damaged study.txt
  mkfifo silent
  run 5 timeout 20 "$program" check "$tiny" --log silent && says 'a pipe from which no program reads' || return 1
  cat >study.nml <<END
&study name = 's', kind = 'grid', levels = 3, deck = '$tiny', case = 'sweep', plot = '/dev/zero' /
&factor name = 'rate', path = 'spring.coil.rate', lower = 20, upper = 40 /
&response name = 'travel', column = 'wheel_travel_mm', at = 100 /
END
  run 5 timeout 60 "$program" study study.nml --out out && says 'is a pipe or a device, not a gnuplot script' || return 1
  rm -rf out
  mkdir -p out/s.parts && ln -s /dev/zero out/s.parts/chunk_000001.bin
  run 0 timeout 60 "$program" study study.nml --out out --no-plots && [ -s out/s_responses.csv ] && [ -c /dev/zero ] && clean out || return 1
  mkdir -p out/s.parts && head -c 300 /dev/urandom >out/s.parts/study.txt
  run 5 "$program" study study.nml --out out --no-plots && says 'study.txt is damaged' && ! LC_ALL=C grep -q '[^[:print:][:space:]]' said.txt
}
endless_files() { # a device, a pipe into which nobody writes or that never ends, and endless standard input
  local command
  for command in check run report 'export --to csv' study plot merge import 'run '"$tiny"' --set-file'; do
    # shellcheck disable=SC2086
    run 5 "$program" $command /dev/zero && says 'not a regular file or a pipe' || return 1
  done
  mkfifo silent && run 5 "$program" check silent && says 'no program writes' || return 1
  run 5 bash -c "'$program' check <(cat /dev/zero)" && says 'longer than 100 MB' || return 1
  run 5 bash -c "'$program' check - </dev/zero" && says 'longer than 50 MB'
}

# ---- gnuplot -----------------------------------------------------------------------------------

gnuplot_that_hangs() {
  fake_gnuplot 'trap "" TERM INT ALRM; sleep 300 & wait; sleep 300'
  EK_GNUPLOT_SECONDS=2 PATH=$PWD/bin:$PATH run 5 "$program" report "$tiny" --out out && says 'did not finish within 2 s' &&
    grep -q 'did not finish within 2 s' out/report.html && clean out && ! pgrep -f "$PWD/bin/gnuplot" >/dev/null
}
signals_while_gnuplot_hangs() { # report and run end by the signal, a study in order; none leaves gnuplot or a temporary file
  fake_gnuplot 'trap "" TERM INT HUP; sleep 300 & wait; sleep 300'
  cat >study.nml <<END
&study name = 's', kind = 'grid', levels = 3, deck = '$tiny', case = 'sweep', plot = 'none.gp' /
&factor name = 'rate', path = 'spring.coil.rate', lower = 20, upper = 40 /
&response name = 'travel', column = 'wheel_travel_mm', at = 100 /
END
  local command signal k began status
  for command in "report $tiny" "run $tiny --plot" 'study study.nml'; do
    for signal in TERM INT HUP QUIT USR1 XCPU; do
      rm -rf out
      # shellcheck disable=SC2086
      PATH=$PWD/bin:$PATH setsid python3 -c 'import os, signal, sys
for number in range(1, 32):
    if number not in (9, 19): signal.signal(number, signal.SIG_DFL)
os.execv(sys.argv[1], sys.argv[1:])' "$program" $command --out out >out.txt 2>said.txt &
      for k in $(seq 100); do pgrep -f "$PWD/bin/gnuplot" >/dev/null && break; sleep 0.1; done
      began=$(date +%s)
      kill -"$signal" $!
      wait $! 2>/dev/null
      status=$?
      [ $(($(date +%s) - began)) -le 3 ] || { echo "$command: $signal was not heard"; return 1; }
      if [ "$command" = 'study study.nml' ]; then
        [ $status -eq 5 ] && says 'has stopped it' && [ -s out/s_responses.csv ] || { echo "$command: status $status"; cat said.txt; return 1; }
      else
        [ $status -eq $((128 + $(kill -l $signal))) ] || { echo "$command: status $status after $signal"; return 1; }
      fi
      pgrep -f "$PWD/bin/gnuplot" >/dev/null && { echo "$command: gnuplot is left running"; return 1; }
      clean out || return 1
    done
  done
}
page_is_there_while_gnuplot_hangs() {
  fake_gnuplot 'sleep 20'
  PATH=$PWD/bin:$PATH "$program" report "$tiny" --out out >out.txt 2>said.txt &
  local k
  for k in $(seq 50); do [ -s out/report.html ] && break; sleep 0.1; done
  kill -KILL $!
  wait $! 2>/dev/null
  grep -q '</html>' out/report.html && grep -q 'has not finished' out/report.html
}
gnuplot_that_draws_nothing() {
  fake_gnuplot 'exit 0'
  PATH=$PWD/bin:$PATH run 5 "$program" run "$tiny" --plot --out out && says 'has not completed' && [ -s out/tiny_sweep.csv ] &&
    PATH=$PWD/bin:$PATH run 5 "$program" report "$tiny" --out report && grep -q '</html>' report/report.html
}
gnuplot_that_draws_half() {
  run 0 "$program" run "$tiny" --plot --out out || return 1
  cp out/tiny_sweep_toe.svg kept
  fake_gnuplot 'for s in "$@"; do case $s in *.gp) n=${s##*/}; n=${n%.gp}; echo "<svg>" >"$n.svg"; echo x >"$n.png";; esac; done'
  PATH=$PWD/bin:$PATH run 5 "$program" run "$tiny" --plot --out out && same out/tiny_sweep_toe.svg kept && clean out
}
# The drawings in a page, without bars and sparklines, which the page draws itself
gnuplot_that_fails() { # pictures of before stay, the page is without
  run 0 "$program" report "$tiny" --out out || return 1
  cp out/picture.svg kept
  fake_gnuplot 'echo no terminal here; exit 3'
  PATH=$PWD/bin:$PATH run 5 "$program" report "$tiny" --out out && says 'no terminal here' && same out/picture.svg kept &&
    ! grep -q -e '"picture": ' -e 'data:image' out/report.html
}

# ---- L: lost data -------------------------------------------------------------------------------

limit_of_a_file_size() { # SIGXFSZ
  run 0 "$program" run "$tiny" --increments 10 --out out || return 1
  cp out/tiny_sweep.csv kept
  run 5 bash -c "ulimit -f 4; exec '$program' run '$tiny' --increments 1000 --out out" && says 'File too large' &&
    same out/tiny_sweep.csv kept && clean out
}
shared_memory_is_no_device() {
  local folder
  folder=$(mktemp -d /dev/shm/elastokin_attacks_XXXXXX) || { not_here 'no /dev/shm'; return; }
  run 0 "$program" run "$tiny" --increments 10 --out "$folder" && cp "$folder/tiny_sweep.csv" kept &&
    run 5 bash -c "ulimit -f 4; exec '$program' run '$tiny' --increments 1000 --out '$folder'" &&
    same "$folder/tiny_sweep.csv" kept && clean "$folder"
  local status=$?
  rm -rf "$folder"
  return $status
}
pictures_beyond_a_file_size() {
  run 0 "$program" run "$tiny" --plot --out out || return 1
  cp out/tiny_sweep_overview.png kept
  run 5 bash -c "ulimit -f 16; exec '$program' run '$tiny' --plot --out out" && same out/tiny_sweep_overview.png kept && clean out
}
full_disk() { # some tables are the new ones, the others those of before; all are whole
  in_tmpfs size=6m '
    "$1" report '"'$tiny'"' --out disk/r >out.txt 2>said.txt || exit 1
    cp -r disk/r kept; dd if=/dev/zero of=disk/rest bs=1k 2>/dev/null
    timeout 60 "$1" report '"'$tiny'"' --increments 1000 --out disk/r >out.txt 2>said.txt; status=$?
    for f in $(find disk/r -type f -name "*.csv" -o -name "*.json"); do [ "$(tail -c 1 $f | od -An -tu1 | tr -d " ")" = 10 ] || echo "$f is half"; done >half
    for f in $(cd disk/r && find . -name "*.svg" -o -name "*.png"); do cmp -s "disk/r/$f" "kept/$f" || echo "$f has changed"; done >>half
    find disk/r -name ".elastokin*" >>half
    cmp -s disk/r/lateral_force.csv kept/lateral_force.csv || echo "the table that did not fit has changed" >>half
    [ $status -eq 5 ] && [ ! -s half ]'
  case $? in 0) says 'No space left' ;; 9) not_here 'no tmpfs without root' ;; *) cat half said.txt; return 1 ;; esac
}
no_more_files() { # as a quota of files
  in_tmpfs nr_inodes=12 '
    "$1" run '"'$tiny'"' --increments 10 --out disk/r >out.txt 2>said.txt || exit 1
    cp disk/r/tiny_sweep.csv kept; for k in $(seq 20); do : >disk/$k; done 2>/dev/null
    timeout 60 "$1" run '"'$tiny'"' --out disk/r >out.txt 2>said.txt; [ $? -eq 5 ] && cmp disk/r/tiny_sweep.csv kept'
  case $? in 0) says 'No space left' ;; 9) not_here 'no tmpfs without root' ;; *) cat said.txt; return 1 ;; esac
}
folder_that_cannot_be_written() {
  as_nobody '"$1" run '"'$tiny'"' --out '"'$PWD/out'" >out.txt 2>said.txt
  local status=$?
  [ $status -eq 9 ] && { not_here 'no other user to be had'; return; }
  [ "$(id -u)" -ne 0 ] || { [ $status -eq 5 ] && says 'Permission denied'; }
}
two_containers_with_one_pid() {
  unshare -pf --mount-proc true 2>/dev/null || { not_here 'no name space of processes to be had'; return; }
  local k first second
  for k in 1 2 3 4 5; do
    unshare -pf --mount-proc "$program" run "$mcpherson" --increments 600 --out out >out1.txt 2>said1.txt & first=$!
    unshare -pf --mount-proc "$program" run "$mcpherson" --increments 600 --out out >out2.txt 2>said2.txt & second=$!
    wait $first || { cat said1.txt; return 1; }
    wait $second || { cat said2.txt; return 1; }
  done
  "$program" run "$mcpherson" --increments 600 --out wanted >out.txt 2>said.txt
  diff -r out wanted && clean out
}
two_runs_in_one_folder() {
  local k runs=()
  for k in 1 2 3 4; do SOURCE_DATE_EPOCH=1 "$program" report "$tiny" --out out >out$k.txt 2>said$k.txt & runs[k]=$!; done
  for k in 1 2 3 4; do wait "${runs[k]}" || { cat said$k.txt; return 1; }; done
  SOURCE_DATE_EPOCH=1 "$program" report "$tiny" --out wanted >out.txt 2>said.txt
  diff -r out wanted && clean out
}
reader_that_goes_away() {
  "$program" report "$tiny" --no-plots --quiet --out out 2>said.txt | head -n 1 >out.txt
  [ "${PIPESTATUS[0]}" -eq 0 ] && [ ! -s said.txt ] && [ -s out/report.html ] && [ -s out/gradients.json ] || { cat said.txt; return 1; }
  "$program" run "$mcpherson" --case vertical_sweep --increments 3000 --quiet --out - 2>said.txt | head -n 1 >out.txt
  [ "${PIPESTATUS[0]}" -eq 5 ] && [ ! -s said.txt ]
}
streams_that_are_closed() {
  run 5 bash -c "exec '$program' run '$tiny' --out out >&-" && says 'cannot write to standard output' && cp out/tiny_sweep.csv kept || return 1
  "$program" run "$tiny" --out out >/dev/null 2>&- || return 1
  "$program" run "$tiny" --out out >&- 2>&- <&-
  [ $? -eq 5 ] && same out/tiny_sweep.csv kept && "$program" run "$tiny" --out bare >/dev/null 2>/dev/null && same bare/tiny_sweep.csv kept || return 1
  run 0 bash -c "exec '$program' run '$tiny' --out out 2>/dev/full"
}
leavings_of_dead_runs() {
  mkdir out
  local mine other
  fake_gnuplot 'sleep 20'
  PATH=$PWD/bin:$PATH "$program" run "$tiny" --plot --out out >out.txt 2>said.txt &
  local k
  for k in $(seq 50); do mine=$(find out -type d -name '.elastokin-*.tmp'); [ -n "$mine" ] && break; sleep 0.1; done
  [ -n "$mine" ] || { echo 'no temporary folder was seen'; return 1; }
  run 0 "$program" run "$tiny" --out out && [ -d "$mine" ] || { echo 'that of a living run was taken away'; return 1; }
  kill -KILL $!
  wait $! 2>/dev/null
  other=out/.elastokin-zzzzzzzz-0123456789abcdef.tmp
  echo x >"$other" && : >"out/.elastokin-mine.tmp"
  run 0 "$program" run "$tiny" --out out && gone "$mine" && [ -e "$other" ] || return 1
  touch -d '2 days ago' "$other"
  run 0 "$program" run "$tiny" --out out && gone "$other" && [ -e out/.elastokin-mine.tmp ]
}
study_that_is_killed() {
  cat >study.nml <<END
&study name = 'grid', deck = '$mcpherson', kind = 'sweep', case = 'vertical_sweep', columns = 'toe_deg', plot = 'none.gp', chunk = 20 /
&factor path = 'bushing.lca_front.kt(1)', name = 'kf', from = 500, to = 8000, count = 200 /
&factor path = 'bushing.lca_rear.kt(1)', name = 'kr', from = 500, to = 4000, count = 200 /
&response name = 'toe', column = 'toe_deg', of = 'span' /
END
  "$program" study study.nml --out out --jobs 1 >out.txt 2>said.txt &
  local k chunks=0
  for k in $(seq 100); do
    chunks=$(find out -name 'chunk_*.bin' 2>/dev/null | wc -l)
    [ "$chunks" -ge 2 ] && break
    sleep 0.1
  done
  kill -TERM $! || { cat said.txt; return 1; }
  wait $!
  [ $? -eq 6 ] && [ "$chunks" -ge 2 ] && says 'designs are done and stored' && gone out/grid_responses.csv || { cat said.txt; return 1; }
  sed -i 's/count = 200/count = 4/' study.nml
  run 5 "$program" study study.nml --out out && says 'holds designs of another study' || return 1
  run 0 "$program" study study.nml --out other --no-plots && [ -s other/grid_responses.csv ] && clean other
}
a_study() { # a_study FORMAT: 600 designs of 21 states
  cat >study.nml <<END
&study name = 's', kind = 'monte_carlo', samples = 600, chunk = 20, deck = '$tiny', case = 'sweep', increments = 20, plot = 'none.gp',
       columns = 'wheel_travel_mm', 'camber_deg', format = '$1' /
&factor name = 'rate', path = 'spring.coil.rate', lower = 20, upper = 40 /
&response name = 'travel', column = 'wheel_travel_mm', at = 100.0 /
END
}
# The chunks fit on the disk, what is made of them does not: nothing is lost, and with more room nothing is computed again
study_whose_tables_fill_the_disk() {
  local format file status
  for format in csv netcdf; do
    [ $format = netcdf ] && [ ! -x "$program-netcdf" ] && continue
    a_study $format
    run 0 "$program" study study.nml --no-plots --out wanted || return 1
    file=wanted/s_responses.csv
    [ $format = netcdf ] && file=wanted/s.nc
    in_tmpfs size=420k "\"\$1\" study study.nml --no-plots --out disk/out >out.txt 2>said.txt; [ \$? -eq 5 ] || { cat said.txt; exit 1; }
      grep -q 'No space left on device' said.txt && [ \"\$(ls -A disk/out)\" = s.parts ] || { cat said.txt; ls -A disk/out; exit 1; }
      mount -o remount,size=9m disk && \"\$1\" study study.nml --no-plots --out disk/out >out.txt 2>said.txt || { cat said.txt; exit 1; }
      grep -q '^600 of 600 designs were done before' said.txt && cmp disk/out/$(basename "$file") $file && [ ! -e disk/out/s.parts ]"
    status=$?
    [ $status -eq 9 ] && { not_here 'no disk of its own may be mounted'; return; }
    [ $status -eq 0 ] || return 1
  done
}
# The disk has room for the results, and none for figures and page
study_whose_figures_fill_the_disk() {
  a_study csv
  run 0 "$program" study study.nml --no-plots --out wanted || return 1
  in_tmpfs size=1300k "\"\$1\" study study.nml --out disk/out >out.txt 2>said.txt; [ \$? -eq 5 ] || { cat said.txt; exit 1; }
    grep -q 'No space left on device\|gnuplot could not draw' said.txt && cmp disk/out/s_curves.csv wanted/s_curves.csv &&
    cmp disk/out/s_responses.csv wanted/s_responses.csv && mount -o remount,size=20m disk &&
    \"\$1\" plot study.nml --out disk/out >out.txt 2>said.txt && [ -s disk/out/s.html ] && [ -s disk/out/figures/s_fan.svg ] &&
    [ -z \"\$(find disk -name '.elastokin-*')\" ]"
  local status=$?
  [ $status -eq 9 ] && { not_here 'no disk of its own may be mounted'; return; }
  [ $status -eq 0 ] || { cat said.txt; return 1; }
}
study_in_shared_memory() {
  [ -w /dev/shm ] || { not_here 'no /dev/shm'; return; }
  local out
  out=$(mktemp -d /dev/shm/elastokin_attack_XXXXXX)
  a_study csv
  run 0 "$program" study study.nml --no-plots --out wanted && run 0 "$program" study study.nml --no-plots --out "$out" &&
    same "$out/s_curves.csv" wanted/s_curves.csv && clean "$out"
  local status=$?
  rm -rf "$out"
  return $status
}
# One after the other, and both at once: the second is refused while the first is unfinished
two_studies_of_one_name() {
  a_study csv
  sed 's/samples = 600/samples = 500/' study.nml >other.nml
  run 0 "$program" study study.nml --out out --shard 1/2 && run 5 "$program" study other.nml --out out &&
    says 'holds designs of another study or deck; remove that folder' || return 1
  run 0 "$program" study study.nml --out out --no-plots && [ "$(grep -c '^[0-9]' out/s_responses.csv)" -eq 600 ] &&
    run 0 "$program" study other.nml --out out --no-plots && [ "$(grep -c '^[0-9]' out/s_responses.csv)" -eq 500 ] && clean out
}
case_called_like_a_target() {
  { cat "$tiny"; echo "&case name = 'sweep_target', load = 'vertical', from = -1.0, to = 1.0 /"; } |
    sed "s/name = 'sweep',/name = 'sweep', target = 'wheel_travel_mm=1',/" >two.nml
  run 2 "$program" check two.nml && says "the results of this case would have the same file as the target of case 'sweep'"
}
same_bytes_again() {
  SOURCE_DATE_EPOCH=1700000000 run 0 "$program" report "$tiny" --out a && sleep 1 &&
    SOURCE_DATE_EPOCH=1700000000 run 0 "$program" report "$tiny" --out b && diff -r a b && grep -q '2023-11-14 22:13' a/report.html
}

# ---- limits ---------------------------------------------------------------------------------------

little_address_space() { # the library for linear algebra would ask for memory for ever
  local k
  for k in 40000 42000 44000 46000 47000 47500 48000 50000 55000 60000 80000 100000 120000 140000; do
    rm -f loader.*
    LD_DEBUG=files LD_DEBUG_OUTPUT=loader timeout 20 bash -c "ulimit -v $k; exec '$program' check '$tiny'" >out.txt 2>said.txt
    case $? in
      0) ;;
      5) says 'not enough memory' || return 1 ;;
      127) ;;      # not even its libraries can be loaded: the words are the system's
      139) if grep -F "transferring control: $program" loader.*; then echo "ulimit -v $k: the program crashed"; return 1; fi ;;
      # otherwise the system could not map the program, or a library of the compiler died before the program began
      *) echo "ulimit -v $k: status $?: $(head -c 300 said.txt)"; return 1 ;;
    esac
  done
}
threads_without_memory() { # lack of memory is no failure of a design: the study is complete, or ends with 5 and keeps its chunks
  local k complete=0
  { echo "&study name = 's', kind = 'monte_carlo', samples = 40, chunk = 5, deck = '$tiny', case = 'sweep' /"
    echo "&factor name = 'rate', path = 'spring.coil.rate', lower = 20.0, upper = 45.0 /"
    echo "&response name = 'travel', column = 'wheel_travel_mm', at = 100.0 /"; } >s.nml
  for k in 200000 210000 220000 230000 240000 250000 260000 280000 300000 350000 400000 600000; do
    timeout 60 bash -c "ulimit -v $k; exec '$program' study s.nml --jobs 2 --no-plots --out out" >out.txt 2>said.txt
    case $? in
      0) complete=$((complete + 1)) && clean out ;;
      5) says 'not enough memory' || return 1 ;;
      127) ;;
      *) echo "ulimit -v $k: status $?: $(head -c 300 said.txt)"; return 1 ;;
    esac
    ! grep -q failed said.txt || return 1
  done
  [ "$complete" -gt 3 ]
}
memory_for_forty_thousand_designs() {
  local values
  values=$(seq -s, 1 200)
  { echo "&study name = 'grid', kind = 'sweep', deck = '$tiny', case = 'sweep', columns = 'wheel_travel_mm', 'camber_deg', format = 'csv' /"
    echo "&factor name = 'rate', path = 'spring.coil.rate', values = $values /"
    echo "&factor name = 'preload', path = 'spring.coil.preload', values = $values /"; } >grid.nml
  run 0 bash -c "ulimit -v 300000; exec '$program' study grid.nml --set case.sweep.increments=2 --no-plots --out out" && clean out &&
    [ "$(grep -c '^[0-9]' out/grid_responses.csv)" -eq 40000 ]
}
memory_for_a_million_states() {
  { cat "$tiny"; echo "&case name = 'long', load = 'vertical', from = -100.0, to = 100.0, increments = 1000000 /"; } >long.nml
  run 5 bash -c "ulimit -v 400000; exec '$program' run long.nml --out out" && says 'not enough memory' &&
    [ -s out/tiny_sweep.csv ] && clean out
}
no_further_process() {
  as_nobody 'ulimit -u 1; unset OPENBLAS_NUM_THREADS; exec "$1" check '"'$tiny'" >out.txt 2>said.txt
  local status=$?
  [ $status -eq 9 ] && { not_here 'no other user to be had'; return; }
  [ $status -eq 0 ] || { echo "status $status"; cat said.txt; return 1; }
}
no_process_for_gnuplot() {
  mkdir out && chmod 777 out
  as_nobody 'ulimit -u 1; exec "$1" run '"'$tiny'"' --plot --out '"'$PWD/out'" >out.txt 2>said.txt
  local status=$?
  [ $status -eq 9 ] && { not_here 'no other user to be had'; return; }
  [ "$(id -u)" -ne 0 ] || { [ $status -eq 5 ] && says 'cannot start' && [ -s out/tiny_sweep.csv ] && clean out; }
}
few_open_files() {
  run 0 bash -c "ulimit -n 12; exec '$program' report '$tiny' --out out" && [ -s out/picture.svg ]
}

# ---- the run --------------------------------------------------------------------------------------

all=(line_end_in_a_title line_end_in_a_test line_end_in_a_file test_that_leaves_the_folder file_that_leaves_the_folder
  file_with_a_whole_path column_that_leaves_the_folder column_with_a_quote pipe_in_a_report endless_table_in_a_report
  link_under_a_temporary_name link_under_the_name_of_a_result link_that_looks_stale pipe_under_the_name_of_a_result
  cdpath_leads_elsewhere control_characters_of_a_deck settings_of_a_user words_for_a_shell_in_a_path commands_in_a_title
  bomb_of_includes endless_include endless_files endless_files_of_a_study files_that_are_too_large derivatives_of_everything gnuplot_that_hangs signals_while_gnuplot_hangs page_is_there_while_gnuplot_hangs gnuplot_that_draws_nothing
  gnuplot_that_draws_half gnuplot_that_fails limit_of_a_file_size shared_memory_is_no_device pictures_beyond_a_file_size
  full_disk no_more_files folder_that_cannot_be_written two_containers_with_one_pid two_runs_in_one_folder
  reader_that_goes_away streams_that_are_closed leavings_of_dead_runs study_that_is_killed
  study_whose_tables_fill_the_disk study_whose_figures_fill_the_disk study_in_shared_memory two_studies_of_one_name case_called_like_a_target
  same_bytes_again little_address_space threads_without_memory memory_for_a_million_states memory_for_forty_thousand_designs no_further_process
  no_process_for_gnuplot few_open_files)
[ $# -gt 0 ] || set -- "${all[@]}"
held=0
failed=0
for attack in "$@"; do
  mkdir "$work/$attack"
  chmod 755 "$work/$attack"
  if words=$(cd "$work/$attack" && "$attack" 2>&1); then
    held=$((held + 1))
    echo "held: $attack$(sed -n 's/^remark: / - /p' <<<"$words")"
  else
    failed=$((failed + 1))
    echo "FAILED: $attack"
    sed 's/^/    /' <<<"$words" | head -n 12
  fi
  rm -rf "${work:?}/$attack"
done
echo "remark: $held attacks held"
echo "$held held, $failed failed"
[ "$failed" -eq 0 ]
