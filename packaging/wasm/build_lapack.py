#!/usr/bin/env python3
"""build_lapack.py SOURCES FOLDER ARCHIVE JOBS ROUTINE...: compiles routines of the reference LAPACK by fortran.py, with all that
these call.

The objects are written to FOLDER; one that exists is not compiled again.
"""
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

compiler = str(Path(__file__).resolve().parent / "fortran.py")
sources, folder, archive, jobs = Path(sys.argv[1]), Path(sys.argv[2]), Path(sys.argv[3]), int(sys.argv[4])
routines = sys.argv[5:]
folders = [sources / "SRC", sources / "BLAS/SRC", sources / "INSTALL"]
unoptimised = {"dlamch"}          # finds out the constants of the machine by arithmetic
beside = {"dlamc3"}               # in the file of another routine


def compile_file(path):
    target = folder / f"{path.stem}.o"
    if not target.exists():
        level = "-O0" if path.stem in unoptimised else "-O2"
        new = target.with_suffix(".new")
        subprocess.run([compiler, level, "-c", str(path), "-o", str(new), "-I", str(folder), "-J", str(folder)], check=True)
        new.rename(target)
    return target


def source_of(routine):
    found = [p for f in folders for suffix in (".f", ".f90") if (p := f / (routine + suffix)).exists()]
    if not found:
        sys.exit(f"build_lapack: {sources} has no file for {routine}")
    return found[0]


def called_by(target):
    """Fortran procedures that an object calls."""
    listed = subprocess.run(["llvm-nm-22", "-u", str(target)], capture_output=True, text=True, check=True).stdout.split()
    return {name[:-1] for name in listed if name.endswith("_") and not name.startswith("_")}


folder.mkdir(parents=True, exist_ok=True)
objects = [compile_file(sources / "SRC" / name) for name in ("la_constants.f90", "la_xisnan.F90")]
wanted, known = set(routines), set(beside)
with ThreadPoolExecutor(jobs) as pool:
    while wanted:
        known |= wanted
        made = list(pool.map(compile_file, [source_of(name) for name in sorted(wanted)]))
        objects += made
        wanted = set().union(*map(called_by, made)) - known
archive.unlink(missing_ok=True)
subprocess.run(["llvm-ar-22", "crs", str(archive), *map(str, sorted(objects))], check=True)
print(f"{len(objects)} files of LAPACK")
