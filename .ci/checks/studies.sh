# shellcheck shell=bash disable=SC2154
# Checks of studies, and of numbers that take long.

# studies/paper from its own folder by one command: figures, table of K&C metrics, and nothing made again the second time
paper_study() {
  local picture
  rm -rf studies/paper/out
  (cd studies/paper && ./run.sh) >"$logs/paper_study.txt" 2>&1 || { cat "$logs/paper_study.txt"; return 1; }
  cat "$logs/paper_study.txt"
  for picture in toe camber lateral increments; do
    is_png "studies/paper/out/$picture.png" || { echo "no figure $picture"; return 1; }
  done
  grep -q '^equilibrium  *0\.4477' "$logs/paper_study.txt" || { echo "no K&C metrics"; return 1; }
  (cd studies/paper && ./run.sh) >"$logs/paper_study_again.txt" 2>&1 || return 1
  ! grep '^paper:' "$logs/paper_study_again.txt"
}

# 120 random studies: no share, index or interval for what cannot move, equal shares of equal factors, limits that are touched
study_laws() {
  python3 tests/support/study_laws.py build/release/bin/elastokin 120
}

# Every study from its own folder, at a small size
studies_at_small_size() {
  local folder wrong=0 program=$top/build/release/bin/elastokin options
  for folder in studies/*/; do
    [ -f "$folder/study.nml" ] || continue
    options=''
    grep -q 'samples *=' "$folder/study.nml" && options='--samples 8'
    # shellcheck disable=SC2086  # several arguments
    (cd "$folder" && "$program" study study.nml --quiet --out "$logs/studies/$(basename "$folder")" $options) || { echo "$folder failed"; wrong=1; }
  done
  return $wrong
}

# A small study by one thread, by two, and by two processes of mpirun: the same bytes
study_in_threads_and_ranks() {
  local program=$top/build/release/bin/elastokin folder=$logs/ranks
  local study=(study studies/hardpoint_tolerance/study.nml --samples 300 --no-plots --quiet)
  command -v mpirun >/dev/null || { skip "there is no mpirun"; return; }
  [ -x "$program-mpi" ] || { skip "elastokin-mpi was not built"; return; }
  rm -rf "$folder"
  "$program" "${study[@]}" --jobs 1 --out "$folder/one" && "$program" "${study[@]}" --jobs 2 --out "$folder/threads" &&
    OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -n 2 "$program" "${study[@]}" --out "$folder/ranks" ||
    return 1
  find "$folder/one" -name '*.csv' -size +1k | grep . && diff -r "$folder/one" "$folder/threads" && diff -r "$folder/one" "$folder/ranks"
}

# The store of a study: ncdump -h, and the lines of Python that the manual shows, with the deviation and the first state of the CSV
store_in_xarray() {
  local tools=$logs/venv_xarray folder=$logs/store program=$top/build/release/bin/elastokin
  if ! tools/setup.sh libnetcdff-dev netcdf-bin; then
    skip "NetCDF-Fortran could not be installed"
    return
  fi
  if ! "$tools/bin/python" -c 'import xarray, netCDF4' 2>/dev/null; then
    if ! python3 -m venv "$tools" || ! "$tools/bin/pip" install --quiet xarray netCDF4 pandas; then
      skip "xarray and netCDF4 could not be installed from PyPI"
      return
    fi
  fi
  rm -rf "$folder"
  mkdir -p "$folder"
  cat >"$folder/netcdf.nml" <<END
&study name = 'tolerance', title = 'bushing rates +-15 %', deck = '$top/input/mcpherson/mcpherson.nml', case = 'wheel_travel_sweep',
       kind = 'sobol', samples = 64, columns = 'wheel_travel_mm', 'toe_deg', format = 'netcdf' /
&factor name = 'front', path = 'bushing.lca_front.kt(1)', change = 'scale', tolerance = 0.15 /
&response name = 'toe_gradient', column = 'toe_deg', of = 'slope', at = 0.0, over = 'wheel_travel_mm' /
END
  sed "s/'netcdf'/'csv'/" "$folder/netcdf.nml" >"$folder/csv.nml"
  sed -n '/^    import xarray$/,/^$/s/^    //p' input/STUDIES.md >"$folder/snippet.py"
  cat "$folder/snippet.py"
  [ "$(wc -l <"$folder/snippet.py")" -ge 5 ] || { echo "the manual has no such lines"; return 1; }
  (
    cd "$folder" || exit 1
    "$program" study netcdf.nml --quiet && "$program" study csv.nml --out csv --quiet && ncdump -h out/tolerance.nc && "$tools/bin/python" snippet.py >said.txt || exit 1
    cat said.txt
    "$tools/bin/python" - <<'END'
import csv, math, statistics, xarray
rows = list(csv.DictReader(line for line in open("csv/tolerance_responses.csv") if line[0] != "#"))
wanted = statistics.pstdev(float(row["toe_gradient_deg_per_m"]) for row in rows)
found, checksum = open("said.txt").read().split()
assert math.isclose(wanted, float(found), rel_tol=1e-9), (wanted, found)
assert len(checksum) == 16 and len(open("band.csv").readlines()) > 20
store = xarray.open_dataset("out/tolerance.nc")
lines = csv.DictReader(line for line in open("csv/tolerance_curves.csv") if line[0] != "#" and line.strip())
for row, value in zip(lines, store.toe_deg.values.ravel(), strict=True):
    assert float(row["toe_deg"]) == float(f"{value:.15g}"), (row, value)
END
  )
}

# A list of designs by SALib, with and without second order: SALib computes the same indices from our table as we do
indices_by_salib() {
  local tools=$logs/venv_xarray folder=$logs/salib program=$top/build/release/bin/elastokin order
  [ -x "$tools/bin/python" ] || python3 -m venv "$tools" || return 1
  if ! "$tools/bin/python" -c 'import SALib' 2>/dev/null && ! "$tools/bin/pip" install --quiet SALib; then
    skip "SALib could not be installed from PyPI"
    return
  fi
  rm -rf "$folder"
  mkdir -p "$folder"
  cat >"$folder/study.nml" <<END
&study name = 'salib', kind = 'list', list = 'designs.csv', deck = '$top/input/mcpherson/mcpherson.nml',
       case = 'wheel_travel_sweep', increments = 20, plot = 'none.gp' /
&factor name = 'inner', path = 'point.tie_rod_inner.z', change = 'delta' /
&factor name = 'outer', path = 'point.tie_rod_outer.z', change = 'delta' /
&factor name = 'front', path = 'bushing.lca_front.kt(1)', change = 'scale' /
&factor name = 'rear', path = 'bushing.lca_rear.kt(2)', change = 'scale' /
&response name = 'toe_gradient', column = 'toe_deg', of = 'slope' /
&response name = 'toe', column = 'toe_deg', at = 60.0 /
&response name = 'camber', column = 'camber_deg', at = 60.0 /
END
  for order in first second; do
    (
      cd "$folder" && "$tools/bin/python" "$top/tests/support/salib_indices.py" write $order && "$program" study study.nml --quiet &&
        "$tools/bin/python" "$top/tests/support/salib_indices.py" compare $order
    ) || return 1
  done
}

# Studies of 2,000 designs are killed 50 times (threads, ranks of mpirun, shards) and resumed: the same bytes, nothing computed twice
studies_killed() {
  tests/attacks/study_kills.sh build/release/bin/elastokin
}

# A study as a job array and below srun, on a Slurm of this machine alone
study_on_slurm() {
  if ! command -v slurmctld >/dev/null && ! tools/setup.sh slurm-wlm munge; then
    skip "Slurm could not be installed"
    return
  fi
  tests/attacks/study_slurm.sh build/release/bin/elastokin
}

# 95 % intervals of a fit contain the true number in 93 to 97 % of 200 seeds
fit_intervals_cover() {
  tests/support/fit_coverage.py build/release/bin/elastokin 200
}

# Random solves and fits of the library: a sum of squares that does not grow, numbers that are not needed do not move, …
solve_and_fit_laws() {
  tests/support/solve_and_fit_laws.py build/release/bin/elastokin 300
}

# Time of an increment of a whole axle, in units of LAPACK's solution alone; reported without a limit, as the machine may be busy
bench_of_an_axle() {
  build/release/bin/elastokin-bench input/mcpherson_axle/mcpherson_axle.nml --case parallel_travel --quiet \
    >"$logs/bench_axle.txt" || return 1
  cat "$logs/bench_axle.txt"
  awk '/^LAPACK dsysv/ {unit = $4 " " $5} / increment .* units/ {list = list ", " $1 " " $5}
    END {if (list == "") exit 1; print "remark: dsysv " unit list}' "$logs/bench_axle.txt"
}

# Derivatives of all columns with respect to every number of the axles against complete runs, in six tests of the rig (tools/test.sh
# takes a part of the numbers), and what they cost; the ratios are reported without a limit
derivatives_of_every_number() {
  EK_EVERY_NUMBER=1 build/release/tests/test_derivatives || return 1
  build/release/bin/elastokin-bench input/five_link_axle/five_link_axle.nml --case parallel_travel --derivatives \
    >"$logs/bench_derivatives.txt" || return 1
  cat "$logs/bench_derivatives.txt"
  awk '/ sweeps$/ {list = list ", " $(NF - 1)} END {if (list == "") exit 1; print "remark: in sweeps by LAPACK" list}' \
    "$logs/bench_derivatives.txt"
}
