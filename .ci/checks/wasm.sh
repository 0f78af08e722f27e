# shellcheck shell=bash disable=SC2154
# The check of the program for WebAssembly.

# What compiler and runtime for WebAssembly must agree on, by two programs: features of Fortran as flang gives them for this machine, and
# laws of LAPACK. A type with a procedure pointer is rejected
wasm_toolchain() {
  local work=$logs/wasm_toolchain compiler=$top/packaging/wasm/fortran.py status
  export EK_WASM_RUNTIME=$top/build/wasm/support
  rm -rf "$work"
  mkdir -p "$work/native" "$work/wasm" || return 1
  (cd "$work/native" && flang-22 -O1 -o language "$top/tests/wasm/language.f90" && ulimit -s unlimited && EK_TEST=abcd ./language one >../native.txt; [ $? -eq 3 ]) ||
    { echo "the native test program did not end with status 3"; return 1; }
  (cd "$work" && "$compiler" -O2 -o language.wasm "$top/tests/wasm/language.f90" &&
    "$compiler" -O2 -o linear_algebra.wasm "$top/tests/wasm/linear_algebra.f90" "$EK_WASM_RUNTIME/liblapack.a") || return 1
  EK_TEST=abcd node packaging/wasm/run.mjs "$work/language.wasm" "$work/wasm" one >"$work/wasm.txt"
  status=$?
  diff "$work/native.txt" "$work/wasm.txt" || return 1
  [ $status -eq 3 ] || { echo "the test program ended with status $status, not 3"; return 1; }
  node packaging/wasm/run.mjs "$work/linear_algebra.wasm" "$work/wasm" || return 1
  printf '%s\n' 'module m' 'implicit none' 'type :: t' 'procedure(), pointer, nopass :: p => null()' 'end type' 'type(t) :: x' 'end module' >"$work/pointer.f90"
  (cd "$work" && ! "$compiler" -c pointer.f90 2>pointer.txt && grep 'has a procedure pointer' pointer.txt) ||
    { echo "accepted: a procedure pointer"; return 1; }
}

# The wheel in an empty Python environment: installed, compared with the native program, without a cache that can be written, and
# wasmtime for other systems
wasm_wheel() {
  local folder=$logs/venv_wasm wheel system
  wheel=$(ls build/wasm/elastokin-*-py3-none-any.whl) || return 1
  rm -rf "$folder" "$logs/wasm_wheel"
  if ! python3 -m venv "$folder" || ! "$folder/bin/pip" install --quiet --disable-pip-version-check "$wheel" 'wasmtime>=30'; then
    echo "remark: the wheel was not tried, wasmtime could not be installed from PyPI"
    return
  fi
  python3 tests/wasm/compare_programs.py build/release/bin/elastokin "$folder/bin/elastokin" "$logs/wasm_wheel" | tee "$logs/wasm_wheel.txt"
  [ "${PIPESTATUS[0]}" -eq 0 ] || return 1
  echo "remark: $(tail -n 1 "$logs/wasm_wheel.txt")"
  EK_CACHE=/dev/null/nowhere "$folder/bin/elastokin" --version 2>&1 | grep 'cannot be stored' || return 1
  # a damaged cache is written again
  truncate --size=1000 "$logs"/wasm_wheel/cache/*.compiled
  EK_CACHE=$logs/wasm_wheel/cache "$folder/bin/elastokin" --version 2>&1 | grep 'compiling the program' || return 1
  ! EK_CACHE=$logs/wasm_wheel/cache "$folder/bin/elastokin" --version 2>&1 | grep 'compiling the program' || return 1
  # Ctrl-C ends it while it computes
  EK_CACHE=$logs/wasm_wheel/cache timeout --kill-after=10 --signal=INT 5 "$folder/bin/elastokin" run input/mcpherson_axle/mcpherson_axle.nml \
    --increments 100000 --out "$logs/wasm_wheel/long" --quiet
  [ $? -eq 124 ] || { echo "an interrupt did not end the program of the wheel"; return 1; }
  # the Python package on WebAssembly: its tests, and the numbers of the native library
  EK_CACHE=$logs/wasm_wheel/cache PYTHONDONTWRITEBYTECODE=1 "$folder/bin/python" -m unittest discover --start-directory python/tests || return 1
  EK_CACHE=$logs/wasm_wheel/cache "$folder/bin/python" tests/wasm/compare_libraries.py build/release/lib/libelastokin.so.0 || return 1
  # wheels of wasmtime for other systems, by the names that pip asks for
  for system in win_amd64 macosx_11_0_arm64 macosx_11_0_x86_64 manylinux_2_28_aarch64; do
    "$folder/bin/pip" download --quiet --disable-pip-version-check --no-deps --only-binary :all: --platform "$system" \
      --dest "$logs/wasm_wheel/$system" 'wasmtime>=30' || { echo "no wheel of wasmtime for $system"; return 1; }
  done
}

# The page in Firefox; where Firefox or puppeteer-core cannot be had, this is said
wasm_firefox() {
  command -v firefox-esr >/dev/null || tools/setup.sh firefox-esr || { echo "remark: the page was not opened in Firefox, which could not be installed"; return; }
  mkdir -p "$logs/node"
  (cd "$logs/node" && PUPPETEER_SKIP_DOWNLOAD=1 npm install --silent --no-fund --no-audit puppeteer-core) ||
    { echo "remark: the page was not opened in Firefox, puppeteer-core could not be installed from npm"; return; }
  node tests/wasm/page_in_firefox.mjs "$logs/node" build/wasm/elastokin.html "$logs/wasm_firefox" | tee "$logs/wasm_firefox.txt"
  [ "${PIPESTATUS[0]}" -eq 0 ] || return 1
  echo "remark: $(sed -n 's/^300 moves of a point: //p' "$logs/wasm_firefox.txt"), $(tail -n 1 "$logs/wasm_firefox.txt")"
}

# elastokin.wasm and elastokin.html by tools/wasm.sh; both against the native program, in node and in Chromium, the page in Firefox too
wasm() {
  local tools=$logs/venv_browser wrong=0
  # shellcheck source=packaging/wasm/versions.sh
  . packaging/wasm/versions.sh
  tools/setup.sh "${packages[@]}" || { skip "not all of ${packages[*]} could be installed"; return; }
  command -v node >/dev/null || tools/setup.sh nodejs || { skip "node could not be installed"; return; }
  tools/wasm.sh | tee "$logs/wasm_sizes.txt"
  [ "${PIPESTATUS[0]}" -eq 0 ] || return 1
  wasm_toolchain || return 1
  python3 tests/wasm/compare_programs.py build/release/bin/elastokin build/wasm/elastokin.wasm "$logs/wasm_node" | tee "$logs/wasm_node.txt"
  [ "${PIPESTATUS[0]}" -eq 0 ] || wrong=1
  echo "remark: $(tail -n 1 "$logs/wasm_node.txt")"
  wasm_wheel || wrong=1
  wasm_firefox || wrong=1
  if ! command -v chromium >/dev/null && ! tools/setup.sh chromium; then
    echo "remark: the page was not opened, chromium could not be installed"
    return $wrong
  fi
  python_with venv_browser playwright || { echo "remark: the page was not opened, playwright could not be installed"; return $wrong; }
  tools/check_page.sh build/wasm/elastokin.html || wrong=1
  "$tools/bin/python" tests/wasm/page_in_a_browser.py build/wasm/elastokin.html "$logs/wasm_page" | tee "$logs/wasm_page.txt"
  [ "${PIPESTATUS[0]}" -eq 0 ] || wrong=1
  echo "remark: $(tail -n 1 "$logs/wasm_page.txt")"
  "$tools/bin/python" tests/wasm/editor_in_a_browser.py build/wasm/elastokin.html build/release/bin/elastokin || wrong=1
  "$tools/bin/python" tests/wasm/drags_in_a_browser.py build/wasm/elastokin.html build/release/bin/elastokin | tee "$logs/wasm_drags.txt"
  [ "${PIPESTATUS[0]}" -eq 0 ] || wrong=1
  echo "remark: $(tail -n 1 "$logs/wasm_drags.txt")"
  "$tools/bin/python" tests/wasm/tasks_in_a_browser.py build/wasm/elastokin.html build/release/bin/elastokin "$logs/wasm_tasks" | tee "$logs/wasm_tasks.txt"
  [ "${PIPESTATUS[0]}" -eq 0 ] || wrong=1
  echo "remark: $(tail -n 1 "$logs/wasm_tasks.txt")"
  "$tools/bin/python" tests/wasm/opened_folder.py "$logs/venv_wasm/bin/python" "$logs/wasm_folder" || wrong=1
  "$tools/bin/python" tests/wasm/compare_programs.py build/release/bin/elastokin build/wasm/elastokin.html "$logs/wasm_browser" |
    tee "$logs/wasm_browser.txt"
  [ "${PIPESTATUS[0]}" -eq 0 ] || wrong=1
  echo "remark: $(tail -n 1 "$logs/wasm_browser.txt")"
  return $wrong
}
