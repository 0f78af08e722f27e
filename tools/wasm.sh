#!/usr/bin/env bash
# wasm.sh [sources | runtime | program]: compiles elastokin to WebAssembly: build/wasm/elastokin.wasm, one file that runs in any browser
# and in every WASI program, build/wasm/elastokin.html, a page with all of it that opens without a server and without a network, and a
# Python wheel with the command line for every system.
#
# Uses the compilers of Debian (packaging/wasm/versions.sh), and the sources of the Fortran runtime and of LAPACK. These are downloaded
# from the archive that apt uses, examined by their SHA-256, and unpacked in a cache: EK_WASM_CACHE, by default
# $XDG_CACHE_HOME/elastokin/wasm. Put a source archive there by hand where there is no network; the message says which. The cache also
# contains the compiled runtime, and the editor component of the page. npm installs the latter by the versions and checksums of
# packaging/wasm/editor/package-lock.json; no script of a package is run. EK_BUILD sets another folder than build/wasm, EK_JOBS the number of compilers at the same time.
# `sources`, `runtime` or `program` stop after this step. About 15 minutes on one processor, 10 of them for the program; a second
# run compiles what has changed.
set -euo pipefail
cd "$(dirname "$0")/.."
top=$PWD
kit=$top/packaging/wasm
# shellcheck source=packaging/wasm/versions.sh
. "$kit/versions.sh"
last=${1:-page}
case $last in sources | runtime | program | page) ;; *) echo "usage: wasm.sh [sources | runtime | program]" >&2; exit 1 ;; esac
folder=${EK_BUILD:-build/wasm}
cache=${EK_WASM_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/elastokin/wasm}
export EK_JOBS=${EK_JOBS:-$(nproc)}
mkdir -p "$folder" "$cache"
folder=$(realpath "$folder")
log=$folder/build.log
: >"$log"

fail() { echo "wasm: $1" >&2; exit 1; }
said() { # said STEP: what the step took
  echo "wasm: $1 ($((SECONDS - begun)) s)"
  begun=$SECONDS
}
begun=$SECONDS

# ---- tools ---------------------------------------------------------------------------------------

find_tools() {
  local found program
  tools/setup.sh "${packages[@]}" python3 patch xz-utils || fail "these Debian packages are needed: ${packages[*]}"
  for program in flang-22 clang-22 clang++-22 llvm-ar-22 llvm-nm-22 llvm-ranlib-22 wasm-ld-22; do
    command -v "$program" >/dev/null || fail "$program was not found"
  done
  found=$(flang-22 --version | sed -n 's/.*version \([0-9.]*\).*/\1/p' | head -n 1)
  [ "$found" = "$llvm_version" ] || fail "flang-22 is version $found, but the runtime in packaging/wasm/versions.sh is $llvm_version.
  The runtime must be that of the compiler: set llvm_version and the two sums there, then run .ci/deep wasm."
}

# ---- sources -------------------------------------------------------------------------------------

tree_sum() { (cd "$1" && find . -type f -print0 | LC_ALL=C sort -z | xargs -0 sha256sum | sha256sum | cut -d ' ' -f 1); }
has_sum() { [ -f "$1" ] && [ "$(sha256sum <"$1" | cut -d ' ' -f 1)" = "$2" ]; }

# download ARCHIVE POOL SUM: into the cache, from the archives of Debian that this machine uses. No index is asked: indexes of other
# releases than the installed one may be absent or name files that are gone. The file is the same for every release
download() {
  local archive=$1 pool=$2 sum=$3 address part
  command -v apt-get >/dev/null || return 1
  while read -r address; do
    for part in pool pool/updates; do
      /usr/lib/apt/apt-helper -o APT::Sandbox::User=root download-file "${address%/}/$part/$pool/$archive" "$cache/$archive.part" \
        "SHA256:$sum" >>"$log" 2>&1 || continue
      has_sum "$cache/$archive.part" "$sum" || continue
      mv "$cache/$archive.part" "$cache/$archive"
      return
    done
  done < <(addresses)
  return 1
}

# addresses: the archives of this machine. apt-get names only those of which it has lists; without any it makes lists here
# shellcheck disable=SC2016     # apt-get replaces $(REPO_URI)
addresses() {
  local lists=$folder/apt_lists found
  named() { { apt-get "$@" indextargets --format '$(REPO_URI)' 'Created-By: Packages' || true; } 2>>"$log" | sort -u; }
  found=$(named)
  if [ -z "$found" ]; then
    mkdir -p "$lists/partial"
    apt-get -o Dir::State::Lists="$lists" -o APT::Sandbox::User=root update >>"$log" 2>&1 || true
    found=$(named -o Dir::State::Lists="$lists")
    rm -rf "$lists"
  fi
  echo "$found"
}

# unpack NAME ARCHIVE POOL SUM PARTS_SUM PART...: the parts of a source archive, in $cache/NAME-<sum>
unpack() {
  local name=$1 archive=$2 pool=$3 sum=$4 parts_sum=$5 target found given=yes
  shift 5
  target=$cache/$name-${sum:0:12}
  if [ -d "$target" ]; then
    [ "$(tree_sum "$target")" = "$parts_sum" ] && return
    echo "wasm: $target has been changed, it is unpacked again"
    rm -rf "$target"
  fi
  if ! has_sum "$cache/$archive" "$sum"; then
    [ ! -e "$cache/$archive" ] || echo "wasm: $cache/$archive does not have the sum $sum, it is downloaded again"
    rm -f "$cache/$archive"
    given=no
    download "$archive" "$pool" "$sum" || fail "$archive could not be downloaded (the attempts are in $log).
  Put this file, of the Debian source package ${pool##*/} (every release with this version has the same file), into
      $cache/
  Its SHA-256 must be
      $sum"
  fi
  rm -rf "$target.new"
  mkdir -p "$target.new"
  found=$(tar -tf "$cache/$archive" 2>/dev/null | head -n 1) || true     # tar notices that nobody reads on
  tar -xf "$cache/$archive" -C "$target.new" --strip-components=1 "${@/#/${found%%/*}/}"
  [ "$(tree_sum "$target.new")" = "$parts_sum" ] || fail "the parts of $archive have the sum $(tree_sum "$target.new"), not $parts_sum"
  mv "$target.new" "$target"
  [ $given = yes ] || rm -f "$cache/$archive"
}

get_sources() {
  unpack llvm "$llvm_archive" "$llvm_pool" "$llvm_sum" "$llvm_parts_sum" "${llvm_parts[@]}"
  unpack lapack "$lapack_archive" "$lapack_pool" "$lapack_sum" "$lapack_parts_sum" "${lapack_parts[@]}"
}

# ---- Fortran runtime, LAPACK, functions of the system ---------------------------------------------

sum_of() { sha256sum | cut -c 1-16; }

# get_runtime: the compiled Fortran runtime from the cache, where it is written if it is not there
get_runtime() {
  local key work
  key=$({ echo "$llvm_sum ${runtime_flags[*]}"
    dpkg-query -W -f '${Package} ${Version}\n' clang-22 wasi-libc libc++-22-dev-wasm32 2>/dev/null
    cat "$kit"/{build_runtime.sh,runtime.patch,system/missing.h,system/pthread.h,system/sys/wait.h}; } | sum_of)
  runtime=$cache/libfortran_runtime-$key.a
  [ ! -e "$runtime" ] || return 0
  work=$folder/runtime-$key
  "$kit/build_runtime.sh" "$cache/llvm-${llvm_sum:0:12}" "$work" >>"$log" 2>&1 ||
    { tail -n 30 "$log" >&2; fail "the Fortran runtime was not compiled; the output is in $log"; }
  cp "$work/libfortran_runtime.a" "$runtime.$$"
  mv "$runtime.$$" "$runtime"     # another run may do the same
  rm -rf "$work"
}

# get_support: what a program is linked with, in $folder/support
get_support() {
  local support=$folder/support name key
  export EK_WASM_RUNTIME=$support
  mkdir -p "$support"
  ln -sfn "$runtime" "$support/libfortran_runtime.a"
  # all warnings: these files are ours. CMake compiles elastokin_system.c again, here it is for its signatures
  for name in "$kit"/system/{entry,missing,room}.c src/os/elastokin_system.c; do
    clang-22 "${c_flags[@]}" -Wall -Wextra -Wpedantic -Werror -c "$name" -o "$support/$(basename "$name" .c).o" >>"$log" 2>&1 ||
      { tail -n 30 "$log" >&2; fail "$name was not compiled"; }
  done
  "$kit/signatures.py" /usr/lib/wasm32-wasi/libc.a "$runtime" "$support"/{missing,room,elastokin_system}.o >"$support/signatures.json"
  # make does not know that the compiler is a script
  key=$(cat "$kit"/{fortran.py,retarget.py} "$support/signatures.json" | sum_of)
  if [ "$(cat "$support/key.txt" 2>/dev/null)" != "$key" ]; then
    rm -rf "$support/lapack" "$support/liblapack.a" "$folder/program"
    echo "$key" >"$support/key.txt"
  fi
  [ -e "$support/liblapack.a" ] || "$kit/build_lapack.py" "$cache/lapack-${lapack_sum:0:12}" "$support/lapack" \
    "$support/liblapack.a" "$EK_JOBS" "${lapack_routines[@]}" >>"$log" 2>&1 ||
    { tail -n 30 "$log" >&2; fail "LAPACK was not compiled; the output is in $log"; }
}

# ---- program -------------------------------------------------------------------------------------

build_program() {
  local exported name
  # the functions of elastokin.h, for programs that call them without a new instance
  exported='-Wl,-s -Wl,--export=malloc -Wl,--export=free'
  while read -r name; do exported+=" -Wl,--export=$name"; done < <(grep -oE '\bek_[a-z_]+' src/api/elastokin.map | sort -u)
  cmake -S . -B "$folder/program" -G 'Unix Makefiles' --toolchain "$kit/toolchain.cmake" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_EXE_LINKER_FLAGS="$exported" >>"$log" 2>&1 || { tail -n 30 "$log" >&2; fail "CMake failed; its output is in $log"; }
  rm -f "$folder/program/bin/elastokin.wasm"     # linked again: make does not know what fortran.py adds
  cmake --build "$folder/program" --parallel "$EK_JOBS" --target elastokin >>"$log" 2>&1 ||
    { grep -aE 'error|cannot be compiled' "$log" | head -n 20 >&2; fail "compilation failed; the output is in $log"; }
  cp "$folder/program/bin/elastokin.wasm" "$folder/elastokin.wasm.new"
  mv "$folder/elastokin.wasm.new" "$folder/elastokin.wasm"
}

# ---- editor of the page ---------------------------------------------------------------------------

# get_editor: CodeMirror as one script with its licences in $editor, from the cache, where it is written if it is not there
get_editor() {
  local key work name
  key=$(cat "$kit"/editor/{component.js,package-lock.json} | sum_of)
  editor=$cache/editor-$key
  [ ! -e "$editor/editor.js" ] || return 0
  command -v npm >/dev/null || tools/setup.sh nodejs npm || fail "npm is needed for the editor of the page"
  work=$folder/editor
  rm -rf "$work" "$editor.$$"
  mkdir -p "$work" "$editor.$$"
  cp "$kit"/editor/{component.js,package.json,package-lock.json} "$work"
  (cd "$work" && npm ci --ignore-scripts --no-fund --no-audit --fetch-retries 1 --prefer-offline --cache "$cache/npm") >>"$log" 2>&1 || fail "npm could not install the editor component (the attempts are in $log).
  Put the folder
      $editor
  of a computer with a network there, where tools/wasm.sh or these commands in packaging/wasm/editor have made its files:
      npm ci --ignore-scripts
      npx esbuild component.js --bundle --minify --format=iife --global-name=codemirror --legal-comments=none --outfile=editor.js
      for name in \$(npm ls --all --omit=dev --parseable | tail -n +2); do cat \$name/LICENSE; done >LICENCES.txt"
  (cd "$work" && node_modules/.bin/esbuild component.js --bundle --minify --format=iife --global-name=codemirror \
    --legal-comments=none --outfile="$editor.$$/editor.js") >>"$log" 2>&1 || fail "the editor component could not be bundled; the output is in $log"
  (cd "$work" && npm ls --all --omit=dev --parseable) | tail -n +2 | sort | while read -r name; do
    echo "${name#*/node_modules/}"
    cat "$name/LICENSE"
  done >"$editor.$$/LICENCES.txt"
  mv "$editor.$$" "$editor" || [ -e "$editor/editor.js" ]     # another run may do the same
  rm -rf "$work"
}

find_tools
get_sources
said "sources in $cache"
[ "$last" != sources ] || exit 0
get_runtime
said "Fortran runtime: $runtime"
get_support
said "LAPACK and functions of the system"
[ "$last" != runtime ] || exit 0
build_program
said "$folder/elastokin.wasm: $(stat -c %s "$folder/elastokin.wasm") bytes, compressed $(gzip -9 <"$folder/elastokin.wasm" | wc -c)"
[ "$last" != program ] || exit 0
get_editor
said "editor of the page: $editor"
EK_EDITOR=$editor EK_LLVM=$cache/llvm-${llvm_sum:0:12} EK_LAPACK=$cache/lapack-${lapack_sum:0:12} "$kit/make_page.py" "$folder"
said "$folder/elastokin.html: $(stat -c %s "$folder/elastokin.html") bytes"
"$kit/make_wheel.py" "$folder" >"$folder/wheel.txt"
said "$(cat "$folder/wheel.txt"): $(stat -c %s "$(cat "$folder/wheel.txt")") bytes"
