# shellcheck shell=bash disable=SC2154
# Checks of the code under other compilers, options and tools, each with a build of its own.

# -fcheck=all, signalling NaN, floating-point traps; warnings are errors, also in the tests
debug_tests() {
  EK_BUILD=build/ci/debug tools/test.sh debug -DEK_WERROR=ON
}

# The debug tests again with the kernels that OpenBLAS uses on other processors: floating-point traps are for our
# code, not for the BLAS. An old OpenBLAS uses Prescott on a processor that it does not know. The longest tests are left out: they
# repeat the same calls many thousand times.
debug_tests_on_other_processors() {
  local core own seen='' wrong=0
  if ! ldd build/ci/debug/bin/elastokin | grep openblas >/dev/null; then
    skip "the BLAS is not OpenBLAS"
    return
  fi
  own=$(OPENBLAS_VERBOSE=2 build/ci/debug/bin/elastokin --version 2>&1 | sed -n 's/^Core: //p')     # had its turn in debug_tests
  for core in Prescott:pni Haswell:avx2 Zen:avx2 SkylakeX:avx512f; do     # pni: SSE3 in /proc/cpuinfo
    if ! grep -qw "${core#*:}" /proc/cpuinfo || [ "${core%:*}" = "$own" ]; then continue; fi
    seen="$seen ${core%:*}"
    OPENBLAS_CORETYPE=${core%:*} timeout 1800 sh tests/support/run_tests.sh build/ci/debug --parallel "$EK_JOBS" \
      --exclude-regex '^test_(locks|stops_of_library|study_.*)$' || wrong=1
  done
  echo "remark:$seen"
  return $wrong
}

# The program at -O3 with warnings as errors. The tests are excluded: there the optimiser's warnings about uninitialized
# variables (temporaries of matmul) are wrong, and differ between versions of gfortran. Nor does the program need an executable stack.
release_without_warnings() {
  local folder=build/ci/without_warnings
  EK_BUILD=$folder tools/build.sh release elastokin -DEK_WERROR=ON || return 1
  readelf -lW $folder/bin/elastokin | grep GNU_STACK
  ! readelf -lW $folder/bin/elastokin | grep 'GNU_STACK.*RWE' >/dev/null
}

# Address and undefined-behaviour sanitizers; also leaks, where the machine permits leak detection
sanitized_tests() {
  local leaks=1
  printf 'end\n' >"$logs/empty.f90"
  gfortran -fsanitize=address -o "$logs/empty" "$logs/empty.f90"
  ASAN_OPTIONS=detect_leaks=1 "$logs/empty" || leaks=0
  ASAN_OPTIONS=detect_leaks=$leaks:abort_on_error=0 UBSAN_OPTIONS=print_stacktrace=1 run_tests build/ci/asan || return 1
  [ $leaks -eq 1 ] || skip "leaks, leak detection cannot run here"
}

# No variable of the program is shared by two threads. The sanitizer does not see what OpenMP hands over at its start and end, nor
# its critical sections: what a study does one thread at a time is named to it.
threads_share_nothing() {
  local shared program=build/ci/threads/tests/test_threads
  printf 'end\n' >"$logs/empty.f90"
  if ! gfortran -fsanitize=thread -fopenmp -o "$logs/empty" "$logs/empty.f90" || ! "$logs/empty"; then
    skip "the thread sanitizer cannot run here"
    return
  fi
  cmake -S . -B build/ci/threads -DCMAKE_BUILD_TYPE=Threads -DEK_IPO=OFF \
    -DCMAKE_Fortran_FLAGS_THREADS='-O1 -g -fsanitize=thread' || return 1
  TSAN_OPTIONS='detect_deadlocks=0 exitcode=0' cmake --build build/ci/threads --target test_threads --parallel "$EK_JOBS" || return 1
  nm "$program" | grep GOMP_parallel || { skip "no OpenMP"; return; }
  # one thread at a time runs these: in a critical region, which the sanitizer does not see in libgomp
  printf 'race:%s\n' complete_design put_chunk take_chunk write_tables begin_words >"$logs/one_at_a_time.txt"
  TSAN_OPTIONS="detect_deadlocks=0 exitcode=0 suppressions=$logs/one_at_a_time.txt" OPENBLAS_NUM_THREADS=1 "$program" \
    >"$logs/threads.txt" 2>&1
  tail -n 2 "$logs/threads.txt"
  grep -q 'test_threads: 2 passed, 0 failed' "$logs/threads.txt" || return 1
  shared=$(grep "Location is global '[^<]" "$logs/threads.txt")
  echo "$shared"
  [ -z "$shared" ]
}

# flang compiles everything and passes the tests; its tables agree with gfortran's, and the times of increments are compared
second_compiler() {
  local flang=flang-22 wrong=0
  if ! command -v $flang >/dev/null && ! tools/setup.sh $flang; then
    skip "$flang could not be installed"
    return
  fi
  EK_BUILD=build/ci/flang tools/build.sh release all -DCMAKE_Fortran_COMPILER=$flang || wrong=1
  run_tests build/ci/flang || wrong=1
  tests/support/compare_builds.sh build/release build/ci/flang | tee "$logs/compilers.txt" || wrong=1
  echo "remark: $(tail -n 1 "$logs/compilers.txt")"
  return $wrong
}

# Every test under pFUnit itself, where CMake finds one (CMAKE_PREFIX_PATH, or a system folder); the stand-in of tests/support must not
# allow what pFUnit does not compile. A program that does not compile counts as failed.
real_pfunit() {
  local folder=build/ci/pfunit bad=0
  rm -rf "$logs/find_pfunit" && mkdir -p "$logs/find_pfunit"
  # shellcheck disable=SC2016  # CMake expands them
  printf '%s\n' 'cmake_minimum_required(VERSION 3.24)' 'project(find LANGUAGES Fortran)' 'find_package(PFUNIT 4 QUIET)' \
    'message("pFUnit: ${PFUNIT_FOUND} ${PFUNIT_VERSION}")' >"$logs/find_pfunit/CMakeLists.txt"
  if ! cmake -S "$logs/find_pfunit" -B "$logs/find_pfunit/build" 2>&1 | grep '^pFUnit: \(1\|TRUE\|ON\) '; then
    skip "CMake finds no pFUnit; set CMAKE_PREFIX_PATH to its installation"
    return
  fi
  EK_BUILD=$folder tools/build.sh release all || bad=1
  grep '^PFUNIT_DIR:PATH=/' "$folder/CMakeCache.txt" || return 1
  run_tests "$folder" && [ $bad -eq 0 ]
}

# The reference BLAS and LAPACK in place of OpenBLAS
reference_lapack_tests() {
  if grep -qe -O3 build/ci/reference_lapack/build.ninja; then echo "CMAKE_Fortran_FLAGS_RELEASE=-O1 was overridden"; return 1; fi
  run_tests build/ci/reference_lapack || return 1
  ldd build/ci/reference_lapack/bin/elastokin
  ! ldd build/ci/reference_lapack/bin/elastokin | grep openblas >/dev/null
}

# The program under valgrind: no invalid access, nothing lost
memcheck() {
  valgrind --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=definite --show-leak-kinds=definite \
    build/ci/reference_lapack/bin/elastokin run input/mcpherson/mcpherson.nml --increments 40 --out "$logs/memcheck" &&
    test -s "$logs/memcheck/mcpherson_vertical_sweep.csv" &&
    valgrind --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=definite --show-leak-kinds=definite \
      build/ci/reference_lapack/bin/elastokin report input/mcpherson_axle/mcpherson_axle.nml --increments 20 --no-plots \
      --out "$logs/memcheck/report" &&
    test -s "$logs/memcheck/report/report.html"
}

# The number of heap allocations does not depend on the number of increments
allocations() { # allocations DECK CASE INCREMENTS
  valgrind build/ci/reference_lapack/bin/elastokin-bench "$1" --case "$2" --increments "$3" --quiet 2>&1 |
    tee -a "$logs/valgrind_bench.txt" | sed -n 's/.*total heap usage: \([0-9,]*\) allocs.*/\1/p' | tr -d ,
}

no_allocation_in_an_increment() {
  local deck case few many wrong=0
  while read -r deck case few many; do
    few=$(allocations "$deck" "$case" "$few")
    many=$(allocations "$deck" "$case" "$many")
    echo "$deck, $case: $few allocations with few increments, $many with many"
    [ -n "$few" ] && [ "$few" = "$many" ] || wrong=1
  done <<'END'
input/mcpherson/mcpherson.nml vertical_sweep 60 600
input/mcpherson_axle/mcpherson_axle.nml parallel_travel 20 100
END
  return $wrong
}

# Processor seconds of the slowest files of a clean build of elastokin, as multiples of those of ek_kkt.f90 in the same run
compile_times() {
  local folder=$logs/compile_times start=$SECONDS
  rm -rf "$folder" "$folder.txt"
  EK_TIMES=$folder.txt EK_BUILD=$folder tools/build.sh release elastokin \
    -DCMAKE_Fortran_COMPILER_LAUNCHER="$top/tests/support/time_compilation.sh" || return 1
  start=$((SECONDS - start))
  sort -rn "$folder.txt" | awk '{sub(/.*\//, "", $2); seconds[NR] = $1; name[NR] = $2; if ($2 == "ek_kkt.f90") unit = $1; sum += $1}
    END {if (!unit || NR < 300) exit 1
      for (k = 1; k <= 20; k++) printf "%6.1f  %s\n", seconds[k]/unit, name[k]
      printf "remark: %d files, %.0f s of processor time, the slowest %s: %.0f times ek_kkt.f90 (%.2f s)\n", NR, sum, name[1], seconds[1]/unit, unit}' ||
    return 1
  echo "remark: clean build of elastokin: $start s"
}

# The results are those of the commit that EK_BEFORE names, to the byte: for changes of the sources that must not change a result
same_bytes() {
  local before=$logs/before
  [ -n "${EK_BEFORE:-}" ] || { skip "EK_BEFORE names no commit to compare with"; return; }
  python_with venv_numpy numpy || { skip "numpy could not be installed from PyPI"; return; }
  [ -d "$before" ] || git clone --quiet "$top" "$before" || return 1
  git -C "$before" fetch --quiet "$top" && git -C "$before" checkout --quiet "$EK_BEFORE" || return 1
  "$before/tools/build.sh" release elastokin && cmake --build "$before/build/release" --target elastokin_c || return 1
  EK_PYTHON=$logs/venv_numpy/bin/python tests/support/compare_bits.sh build/release "$before/build/release" | sed '$s/^/remark: /'
  [ "${PIPESTATUS[0]}" -eq 0 ]
}

# The loader takes the best copy of the kernels of packs, and each gives the same bits: tables of a study, and the tests of lanes and packs.
# LD_LIBRARY_PATH selects the copy for every processor; a tunable of glibc would also change the functions of libm.
packs_on_instruction_sets() {
  local program=$top/build/release/bin/elastokin library=build/release/lib/elastokin/libelastokin_lanes.so loader base best copy name wrong=0
  [ -f "$library" ] || { skip "there is one instruction set"; return; }
  loader=$(readelf -lW "$program" | sed -n 's/.*interpreter: \(.*\)\]/\1/p')
  if ! "$loader" --help | grep 'x86-64-v3 (supported' >/dev/null; then
    skip "this processor or its loader does not support x86-64-v3"
    return
  fi
  rm -rf "$logs/instructions"
  mkdir -p "$logs/instructions/base"
  cp "$library" "$logs/instructions/base"
  base=$logs/instructions/base best=''
  # the programs and both copies have the kernels once
  nm "$program" | grep -i ' [tdb] __ek_[a-z_]*_lanes_MOD_' && { echo "the program contains kernels of packs"; wrong=1; }
  nm -D --undefined-only "$library" build/release/lib/elastokin/glibc-hwcaps/*/libelastokin_lanes.so | grep '__ek_' && wrong=1
  for copy in best base; do
    LD_LIBRARY_PATH=${!copy} "$program" --version | grep '^packs'
    LD_LIBRARY_PATH=${!copy} "$program" study studies/hardpoint_tolerance/study.nml --samples 40 --no-plots --quiet --out "$logs/instructions/$copy.out" || wrong=1
    for _ in 1 2 3; do     # the best of three: the machine has other work
      LD_LIBRARY_PATH=${!copy} "$program-bench" input/mcpherson/mcpherson.nml --case vertical_sweep --increments 60 --json
    done | sed -n 's/.*"pack_states_per_s": *\([0-9]*\).*/\1/p' | sort -n | tail -n 1 >"$logs/instructions/$copy.speed"
    [ -s "$logs/instructions/$copy.speed" ] || { echo "bench failed"; wrong=1; }
  done
  LD_LIBRARY_PATH=$best "$program" --version | grep '^packs *x86-64-v3 ' >/dev/null || { echo "the loader did not take x86-64-v3"; wrong=1; }
  LD_LIBRARY_PATH=$base "$program" --version | grep '^packs *x86-64 ' >/dev/null || { echo "LD_LIBRARY_PATH did not select x86-64"; wrong=1; }
  diff -r "$logs/instructions/best.out" "$logs/instructions/base.out" || { echo "the tables differ"; wrong=1; }
  for name in test_lanes test_lane_kernels test_pack_walk; do
    [ -x "build/release/tests/$name" ] || continue
    "build/release/tests/$name" || wrong=1
    LD_LIBRARY_PATH=$base "build/release/tests/$name" || wrong=1
  done
  echo "remark: states per second in packs: $(cat "$logs/instructions/best.speed") with AVX2, $(cat "$logs/instructions/base.speed") with SSE2"
  return $wrong
}
