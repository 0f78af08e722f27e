# shellcheck shell=bash disable=SC2154
# Hostile input, kills, mutated files.

# Hostile input, full disks and resource limits, each as a small scenario
attacks() {
  tests/attacks/attacks.sh build/release/bin/elastokin
}

# The deck as used gives the same bytes: random axes, preloads and settings of 200 variants of the library
written_decks_are_the_same() {
  python3 tests/support/written_decks.py build/release/bin/elastokin 200
}

# Commands that write are killed 300 times: no incomplete file, and the next run gives the same bytes
kills() {
  tests/attacks/kills.sh build/release/bin/elastokin
}

# Readers of other programs' files: mutated texts under the sanitizers (EK_MUTATIONS of each file, by default 2000)
readers_under_mutation() {
  tests/attacks/readers.sh build/ci/asan "${EK_MUTATIONS:-2000}" | tee "$logs/readers.txt" || return 1
  echo "remark: $(tail -n 1 "$logs/readers.txt")"
}
