#!/usr/bin/env bash
# gate.sh: the gate on the last commit. Clones HEAD into an empty folder, runs .ci/run there and, if everything passed, writes
# `COMMIT SECONDS` to build/ci/passed of this folder. Status and output are those of .ci/run. What is not committed does not count.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 1
commit=$(git rev-parse HEAD) || exit 1
[ -z "$(git status --porcelain)" ] || echo "gate: there are changes that are not committed; they are not in the clone" >&2
folder=$(mktemp -d "${TMPDIR:-/tmp}/elastokin_gate_XXXXXX") || exit 1
git clone --quiet --no-hardlinks . "$folder/elastokin" && git -C "$folder/elastokin" checkout --quiet --detach "$commit" || exit 1
start=$SECONDS
bash "$folder/elastokin/.ci/run" </dev/null
status=$?
seconds=$((SECONDS - start))
if [ $status -eq 0 ]; then
  mkdir -p build/ci
  echo "$commit $seconds" >build/ci/passed
  rm -rf "$folder"
  echo "gate: $commit passed in $seconds s"
else
  echo "gate: $commit failed after $seconds s; the logs are in $folder/elastokin/build" >&2
fi
exit $status
