#!/bin/sh
# renew_references.sh [BUILD_DIR]: write the kept outputs in tests/reference anew (test_reference_text), from a build of the
# program and the tests; then look through `git diff tests/reference`.
set -eu
cd "$(dirname "$0")/../.."
build=${1:-build/release}
cmake --build "$build" --target elastokin test_reference_text >/dev/null
EK_RENEW_REFERENCES=1 EK_PROGRAM=$build/bin/elastokin "$build/tests/test_reference_text"
git --no-pager diff --stat -- tests/reference
