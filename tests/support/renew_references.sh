#!/bin/sh
# renew_references.sh [BUILD_DIR]: write the kept outputs in tests/reference anew, from a build of the
# program and of the tests that compare with them, and schema/deck.schema.json; then look through `git diff tests/reference schema`.
set -eu
cd "$(dirname "$0")/../.."
build=$(cd "${1:-build/release}" && pwd)
set -- test_reference_text test_carmaker test_export_tables test_plain_tables test_study_store
EK_NCDUMP=$(command -v ncdump)
export EK_NCDUMP
cmake --build "$build" --target elastokin "$@" >/dev/null
for program; do
  EK_RENEW_REFERENCES=1 EK_PROGRAM=$build/bin/elastokin "$build/tests/$program"
done
"$build/bin/elastokin" schema >schema/deck.schema.json
git --no-pager diff --stat -- tests/reference schema
