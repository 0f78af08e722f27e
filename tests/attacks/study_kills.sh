#!/usr/bin/env bash
# tests/attacks/study_kills.sh PROGRAM [KILLS]: a study of 2,000 designs is killed by KILL at random moments, some 50 times: a process
# with two threads, one rank of three (mpirun), a shard as in a job array. Each time it is resumed. A chunk that was finished is
# never computed again, and in the end the table holds the same bytes as one of a study that was never disturbed. Then: a full disk,
# a rank without disk, a folder that may not be written, a chunk cut in half, another study in the folder, two runs in one folder at once.
set -uo pipefail
program=$(realpath "$1")
kills=${2:-50}
cd "$(dirname "$0")/../.." || exit 1
work=$(mktemp -d "${TMPDIR:-/tmp}/elastokin_study_kills_XXXXXX") || exit 1
trap 'umount "$work/disk" 2>/dev/null; chmod -R u+w "$work"; rm -rf "$work"' EXIT
export OPENBLAS_NUM_THREADS=1 LC_ALL=C
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
failed=0
RANDOM=10

complain() { echo "FAILED: $*"; failed=1; }

cat >"$work/study.nml" <<END
&study name = 's', kind = 'monte_carlo', samples = 2000, chunk = 20, deck = '$PWD/input/mcpherson/mcpherson.nml',
       case = 'vertical_sweep', plot = 'none.gp' /
&factor name = 'front', path = 'bushing.lca_front.kt(1)', change = 'scale', tolerance = 0.15 /
&factor name = 'rear', path = 'bushing.lca_rear.kt(1)', change = 'scale', tolerance = 0.15 /
&response name = 'toe', column = 'toe_deg', of = 'span' /
&response name = 'camber', column = 'camber_deg' /
END
sed "s/samples = 2000/samples = 1990/" "$work/study.nml" >"$work/other.nml"
few=(--set case.vertical_sweep.increments=40 --no-plots)      # the table alone is compared

study() { "$program" study "$work/study.nml" "${few[@]}" --out "$@"; } # study FOLDER [OPTION...]
merge() { "$program" merge "$work/study.nml" "${few[@]}" --out "$1"; }
done_in() { "$program" study "$work/study.nml" "${few[@]}" --out "$1" --status | sed -n 's/.*: \([0-9]*\) of .*/\1/p'; }
same() { cmp "$work/wanted/s_responses.csv" "$1/s_responses.csv" || complain "$2: not the bytes of an undisturbed study"; }
only_table() { [ "$(ls -A "$1")" = s-files.csv$'\n's_responses.csv ] || complain "$2: left behind: $(ls -A "$1" "$1/s.parts")"; }
refused() { # refused STATUS WORDS COMMAND...
  local status=$1 words=$2
  shift 2
  "$@" >"$work/said" 2>&1
  local found=$?
  [ $found -eq "$status" ] || complain "$*: status $found, expected $status: $(cat "$work/said")"
  grep -q "$words" "$work/said" || complain "$*: not said: $words: $(cat "$work/said")"
}

start=$(date +%s%N)
study "$work/wanted" --jobs 1 --quiet >/dev/null || complain 'the undisturbed study'
undisturbed_us=$((($(date +%s%N) - start) / 1000))
echo "2000 designs by one thread: $undisturbed_us us"

# ---- kills --------------------------------------------------------------------------------------

# The processes below one that are this program; under mpirun it becomes elastokin-mpi
runs_below() {
  local child
  while read -r child; do
    [[ $(readlink "/proc/$child/exe") == "$program"?(-mpi) ]] && echo "$child"
    runs_below "$child"
  done < <(cat /proc/"$1"/task/*/children 2>/dev/null | tr -s ' ' '\n' | grep .)
}

# Identity and time of each finished chunk
chunks_of() { find "$1/s.parts" -name 'chunk_*.bin' -printf '%f %i %T@\n' 2>/dev/null | sort; }

start_as() { # start_as WAY FOLDER
  case $1 in
    threads) study "$2" --jobs 2 ;;
    ranks) mpirun -n 3 "$program" study "$work/study.nml" "${few[@]}" --out "$2" ;;
    shard) study "$2" --shard "$((RANDOM % 4 + 1))/4" --jobs 1 ;;
  esac
}

# kill_often WAY FOLDER KILLS: kills that strike; when the study ends, another begins
struck=0
kill_often() {
  local way=$1 folder=$2 wanted=$3 hits=0 tries=0 rounds=0 share=3 victim targets before lost
  [ "$way" = shard ] && share=8
  while [ $hits -lt "$wanted" ] && [ $tries -lt $((4 * wanted)) ]; do
    tries=$((tries + 1))
    before=$(chunks_of "$folder")
    start_as "$way" "$folder" >"$work/said" 2>&1 &
    victim=$!
    sleep "0.$(printf '%06d' $(((RANDOM * 32768 + RANDOM) % (undisturbed_us / share) % 1000000)))"
    [ "$way" = ranks ] && sleep 0.1
    mapfile -t targets < <(runs_below $victim)
    if [ ${#targets[@]} -gt 0 ] && kill -KILL "${targets[RANDOM % ${#targets[@]}]}" 2>/dev/null; then hits=$((hits + 1)); fi
    wait $victim 2>/dev/null
    if [ -e "$folder/s_responses.csv" ]; then
      same "$folder" "$way, round $rounds"
      rounds=$((rounds + 1))
      rm -rf "$folder"
      continue
    fi
    lost=$(comm -23 <(echo "$before") <(chunks_of "$folder"))
    [ -z "${lost//[[:space:]]/}" ] || complain "$way: finished chunks were computed again or lost: $lost"
    if [ "$way" = shard ] && [ "$(chunks_of "$folder" | wc -l)" -eq 100 ]; then
      merge "$folder" >"$work/said" 2>&1 || complain "merge: $(cat "$work/said")"
      same "$folder" "shards, round $rounds"
      rounds=$((rounds + 1))
      rm -rf "$folder"
    fi
  done
  struck=$((struck + hits))
  # to the end, with everything that was done
  before=$(done_in "$folder")
  if [ "$way" = shard ]; then
    study "$folder" --jobs 1 >"$work/said" 2>&1 || complain "$way: $(cat "$work/said")"
  else
    start_as "$way" "$folder" >"$work/said" 2>&1 || complain "$way: $(cat "$work/said")"
  fi
  [ "$before" -eq 0 ] || grep -q "^$before of 2000 designs were done before" "$work/said" || complain "$way: $before were done: $(cat "$work/said")"
  same "$folder" "$way"
  only_table "$folder" "$way"
  echo "$way: $hits kills struck, $rounds studies ended between them, $before designs were done before the last run"
}

ways=(threads shard)
if ! command -v mpirun >/dev/null; then
  echo 'remark: ranks left out, there is no mpirun'
elif mpirun -n 2 "$program" --version >/dev/null 2>&1 && ! mpirun -n 2 "$program" study "$work/study.nml" --status 2>&1 | grep -q 'without MPI'; then
  ways+=(ranks)
else
  echo 'remark: ranks left out, the program was compiled without MPI'
fi
for way in "${ways[@]}"; do kill_often "$way" "$work/$way" $(((kills + ${#ways[@]} - 1) / ${#ways[@]})); done
[ $struck -ge $((kills * 9 / 10)) ] || complain "only $struck of $kills kills struck"

# ---- the same bytes, whoever computes -----------------------------------------------------------

for jobs in 1 2 4; do
  study "$work/jobs" --jobs $jobs --quiet >/dev/null || complain "$jobs threads"
  same "$work/jobs" "$jobs threads"
done
for k in 1 2 3 4; do study "$work/shards" --shard $k/4 --jobs 1 --quiet >/dev/null & done
wait
merge "$work/shards" >"$work/said" 2>&1 || complain "merge: $(cat "$work/said")"
same "$work/shards" 'four shards at once'
only_table "$work/shards" 'four shards at once'

# ---- stopped by the system ------------------------------------------------------------------------

for signal in TERM INT; do
  rm -rf "$work/stopped"
  setsid "$program" study "$work/study.nml" "${few[@]}" --out "$work/stopped" --jobs 1 >"$work/said" 2>&1 &
  victim=$!
  sleep "$(printf '0.%06d' $((undisturbed_us / 3 % 1000000)))"
  kill -s $signal $victim
  wait $victim
  status=$?
  if [ $status -ne 0 ]; then        # else it had already ended
    [ $status -eq 6 ] || complain "$signal: status $status"
    grep -q 'stopped: .* designs are done and stored' "$work/said" || complain "$signal: $(cat "$work/said")"
    study "$work/stopped" --quiet >/dev/null || complain "resumed after $signal"
  fi
  same "$work/stopped" "stopped by $signal"
done

# ---- what is wrong with the folder ----------------------------------------------------------------

# a file may have 1 kB: no chunk fits
refused 5 'cannot write' bash -c "ulimit -f 1; exec '$program' study '$work/study.nml' ${few[*]} --out '$work/limit' --jobs 2"
study "$work/limit" --quiet >/dev/null || complain 'resumed after a file limit'
same "$work/limit" 'after a file limit'

# one rank of three cannot write: the others go on, and what they finish is kept
if [ "${ways[*]: -1}" = ranks ]; then
  refused 5 'rank 2: cannot write' mpirun -n 2 "$program" study "$work/study.nml" "${few[@]}" --out "$work/rank" : \
    -n 1 bash -c "ulimit -f 1; exec '$program' study '$work/study.nml' ${few[*]} --out '$work/rank'"
  before=$(done_in "$work/rank")
  [ "$before" -eq 1980 ] || complain "a rank without disk: $before designs were done by the others"
  study "$work/rank" --quiet >/dev/null || complain 'resumed after a rank without disk'
  same "$work/rank" 'after a rank without disk'
fi

mkdir "$work/disk"
if mount -t tmpfs -o size=64k tmpfs "$work/disk" 2>/dev/null; then
  refused 5 'cannot write.*No space left' study "$work/disk/out" --jobs 2
  before=$(done_in "$work/disk/out")
  [ "$before" -gt 0 ] || complain 'a full disk: nothing was kept'
  mount -o remount,size=16m "$work/disk" || complain 'remount'
  study "$work/disk/out" >"$work/said" 2>&1 || complain "after a full disk: $(cat "$work/said")"
  grep -q "^$before of 2000 designs were done before" "$work/said" || complain "after a full disk: $(cat "$work/said")"
  same "$work/disk/out" 'after a full disk'
  only_table "$work/disk/out" 'after a full disk'
  umount "$work/disk"
else
  echo 'remark: full disk left out, no tmpfs may be mounted here'
fi

# A folder that may not be written, also by root: a read-only mount, or else a folder of another
mkdir "$work/closed"
if mount -t tmpfs -o ro tmpfs "$work/disk" 2>/dev/null; then
  refused 5 'Read-only file system' study "$work/disk/out"
  umount "$work/disk"
elif [ "$(id -u)" -ne 0 ]; then
  chmod a-w "$work/closed"
  refused 5 'Permission denied' study "$work/closed/out"
fi

study "$work/half" --shard 1/2 --quiet >/dev/null || complain 'a shard'
truncate -s 300 "$work/half/s.parts/chunk_000001.bin"
: >"$work/half/s.parts/chunk_000003.bin"
[ "$(done_in "$work/half")" -eq 960 ] || complain "chunks cut in half count: $(done_in "$work/half")"
refused 6 '1040 of 2000 designs are missing' merge "$work/half"
refused 5 'holds designs of another study' "$program" study "$work/other.nml" "${few[@]}" --out "$work/half"
[ "$(done_in "$work/half")" -eq 960 ] || complain 'a study that was refused has changed the folder'
study "$work/half" --quiet >/dev/null || complain 'after chunks were cut'
same "$work/half" 'after chunks were cut'
only_table "$work/half" 'after chunks were cut'

for round in 1 2 3 4 5; do
  rm -rf "$work/two"
  study "$work/two" --jobs 1 >"$work/first" 2>&1 & first=$!
  sleep "0.$((RANDOM % 4))"
  study "$work/two" --jobs 1 >"$work/second" 2>&1 & second=$!
  wait $first || complain "two at once, round $round: $(cat "$work/first")"
  wait $second || complain "two at once, round $round: $(cat "$work/second")"
  same "$work/two" "two at once, round $round"
  only_table "$work/two" "two at once, round $round"
done

[ $failed -eq 0 ] && echo "remark: $struck kills (${ways[*]}), every study resumed, the same to the byte"
exit $failed
