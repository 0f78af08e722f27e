#!/usr/bin/env bash
# tests/attacks/study_slurm.sh PROGRAM: studies/slurm on a Slurm of one machine that this script starts and ends: a job array of four
# tasks, one of which is killed and repeated, then the merging job; and three ranks below srun. All leave the bytes of one process.
# Requires slurm-wlm and munge, and root; else it is left out with a note.
set -uo pipefail
program=$(realpath "$1")
cd "$(dirname "$0")/../../studies/slurm" || exit 1
if [ "$(id -u)" -ne 0 ] || ! command -v slurmctld >/dev/null || ! command -v slurmd >/dev/null || ! command -v munged >/dev/null; then
  echo 'remark: left out, it needs slurm-wlm, munge and root'
  exit 0
fi
work=$(mktemp -d "${TMPDIR:-/tmp}/elastokin_slurm_XXXXXX") || exit 1
# shellcheck disable=SC2317  # the trap calls it
finish() {
  local file
  for file in slurmd slurmctld munged; do [ -s "$work/$file.pid" ] && kill "$(cat "$work/$file.pid")" 2>/dev/null; done
  sleep 1
  rm -rf "$work"
}
trap finish EXIT
export ELASTOKIN=$program SLURM_CONF=$work/slurm.conf OPENBLAS_NUM_THREADS=1
failed=0
complain() { echo "FAILED: $*"; failed=1; }

mkdir "$work/state" "$work/spool" "$work/logs"
chmod 755 "$work"
dd if=/dev/urandom of="$work/key" bs=128 count=1 2>/dev/null
chmod 600 "$work/key"
port=$((20000 + RANDOM % 10000))
cat >"$SLURM_CONF" <<END
ClusterName=local
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$work/munge.socket
CryptoType=crypto/munge
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
NodeName=localhost NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=main Nodes=localhost Default=YES MaxTime=INFINITE State=UP
END
munged --force --key-file="$work/key" --socket="$work/munge.socket" --pid-file="$work/munged.pid" --log-file="$work/munged.log" \
  --seed-file="$work/munged.seed" && slurmctld -f "$SLURM_CONF" && sleep 1 && slurmd -N localhost -f "$SLURM_CONF"
for ((k = 0; k < 20; k++)); do sinfo -h -o %t 2>/dev/null | grep -q idle && break; sleep 1; done
sinfo || { echo 'remark: left out, Slurm does not start here'; exit 0; }

# the study of the folder with so many designs that a task can be met while it runs, and its table as text in any build
sed "s|samples = 5000|samples = 16000, format = 'csv'|; s|'../../|'$PWD/../../|" study.nml >"$work/study.nml"
grep -q 'samples = 16000' "$work/study.nml" || { complain 'study.nml has other words than this script looks for'; exit 1; }
study=$work/study.nml
"$program" study "$study" --out "$work/wanted" --jobs 1 --no-plots --quiet >/dev/null || complain 'one process'

# A task of the array that has finished a chunk and goes on; at most 30 s are waited for one
running_task() {
  local deadline=$((SECONDS + 30)) pid
  while [ $SECONDS -lt $deadline ]; do
    if pid=$(pgrep -f -o -- "^$program study $study --out $work/out --shard") &&
      [ -n "$(find "$work/out" -name 'chunk_*.bin' -print -quit 2>/dev/null)" ]; then
      echo "$pid"
      return 0
    fi
    sleep 0.02
  done
  return 1
}
# submit: the array, then the merging job after it; waits for both
submit() {
  local array task
  array=$(sbatch --parsable --output="$work/logs/%A_%a.log" --array=1-4 array.sbatch "$study" --out "$work/out")
  if [ "$1" = kill ]; then
    if task=$(running_task); then kill -KILL "$task"; else complain 'no task was met while it ran'; fi
  fi
  sbatch --wait --kill-on-invalid-dep=yes --output="$work/logs/merge_%j.log" --dependency="afterok:$array" merge.sbatch "$study" --out "$work/out" \
    >"$work/logs/submitted" 2>&1
}
submit kill
for ((k = 0; k < 60; k++)); do [ -z "$(squeue -h)" ] && break; sleep 1; done
[ -e "$work/out/bushing_scatter_responses.csv" ] && complain 'the merging job ran though a task was killed'
"$program" study "$study" --out "$work/out" --status
submit again || complain "the array, again: $(cat "$work"/logs/*)"
cmp "$work/wanted/bushing_scatter_responses.csv" "$work/out/bushing_scatter_responses.csv" || complain 'the array: not the same bytes'
[ -z "$(find "$work/out" -name '*.parts' -o -name '.elastokin-*')" ] || complain "left behind: $(ls -A "$work/out")"
[ -s "$work/out/bushing_scatter.html" ] || complain 'the merging job wrote no page'
grep -h 'were done before' "$work"/logs/* || complain 'the second array began anew'

if srun --mpi=list 2>&1 | grep -qw pmix && ! OMPI_COMM_WORLD_SIZE=2 "$program" study "$study" --status 2>&1 | grep -q 'without MPI'; then
  srun --mpi=pmix --overcommit --ntasks=3 "$program" study "$study" --out "$work/ranks" --no-plots --quiet >"$work/said" 2>&1 || complain "srun: $(cat "$work/said")"
  cmp "$work/wanted/bushing_scatter_responses.csv" "$work/ranks/bushing_scatter_responses.csv" || complain 'srun: not the same bytes'
else
  echo 'remark: srun left out, no pmix or no MPI'
fi
[ $failed -eq 0 ] && echo 'remark: an array of four tasks, one killed and repeated, and ranks of srun: the same to the byte'
exit $failed
