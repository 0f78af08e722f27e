# shellcheck shell=bash
# What the gate (.ci/run) and the deep checks (.ci/deep) share; both source it in the top folder. A check is a function in .ci/checks:
# status 0 is passed, 77 is skipped (the function skip gives the reason), any other is failed. A line "remark: ..." of its output is
# printed beside its result.

set -uo pipefail
exec </dev/null
top=$PWD
logs=$top/build/ci                # output of each check, and what the checks write
mkdir -p "$logs"
export OPENBLAS_NUM_THREADS=1     # the matrices are small: threads would only wait for each other
export EK_JOBS=${EK_JOBS:-2}

# ---- what checks use ----------------------------------------------------------------------------

skip() { # skip REASON
  echo "skipped: $1"
  return 77
}

tree_state() { # git status of the tree; empty outside a clone
  git status --porcelain 2>/dev/null || true
}

run_tests() { # run_tests BUILD_FOLDER: every test of a build
  sh tests/support/run_tests.sh "$1" --parallel "$EK_JOBS"
}

python_with() { # python_with NAME PACKAGE...: a Python environment build/ci/NAME with packages from PyPI
  local folder=$logs/$1
  shift
  [ -x "$folder/bin/python" ] || python3 -m venv "$folder" || return 1
  "$folder/bin/pip" install --quiet --disable-pip-version-check "$@"
}

# ---- builds: `need NAME` makes each at most once in a run ---------------------------------------

build_release() { tools/build.sh release all; }
build_debug() { EK_BUILD=build/ci/debug tools/build.sh debug all -DEK_WERROR=ON; }
build_asan() { EK_BUILD=build/ci/asan tools/build.sh asan all; }
# Static archives, because for any shared library the system's alternatives select OpenBLAS where it is installed.
# Optimised for a quick build, not for speed. All layers at -O1, where gfortran warns of what may be uninitialised.
build_reference() {
  EK_BUILD=build/ci/reference_lapack tools/build.sh release all -DCMAKE_Fortran_FLAGS_RELEASE=-O1 -DCMAKE_C_FLAGS_RELEASE=-O1 -DEK_IPO=OFF -DEK_WERROR=ON \
    -DBLA_VENDOR=Generic \
    -DBLAS_blas_LIBRARY="$(dpkg -L libblas-dev | grep '/libblas\.a$')" -DLAPACK_lapack_LIBRARY="$(dpkg -L liblapack-dev | grep '/liblapack\.a$')"
}
# the installed library with its header, for the checks that compile against it
build_prefix() { need release && rm -rf "$logs/prefix" && cmake --install build/release --prefix "$logs/prefix"; }
build_reports() { need release && make_reports; }

declare -A built=()
need() { # need BUILD
  [ -n "${built[$1]:-}" ] || { "build_$1" >"$logs/build_$1.log" 2>&1 && built[$1]=yes; } ||
    { tail -n 40 "$logs/build_$1.log"; echo "the build '$1' failed: $logs/build_$1.log"; return 1; }
}

# ---- results ------------------------------------------------------------------------------------

remarks_of() { sed -n 's/^remark: / - /p' "$logs/$1.log"; }

print_log() { # print_log NAME: the output of a check that failed
  local log=$logs/$1.log
  { if [ "$(wc -l <"$log")" -le 60 ]; then cat "$log"; else head -n 30 "$log"; echo '[...]'; tail -n 30 "$log"; fi; } | sed 's/^/    /'
}

for file in .ci/checks/*.sh; do
  # shellcheck disable=SC1090
  . "$file"
done
