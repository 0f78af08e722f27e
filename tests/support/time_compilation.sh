#!/usr/bin/env bash
# time_compilation.sh COMPILER ARGUMENT...: calls the compiler, and appends "SECONDS FILE" of processor time to the file that EK_TIMES
# names. CMake calls it with -DCMAKE_Fortran_COMPILER_LAUNCHER=<this file>.
TIMEFORMAT='%U %S'
exec 3>&1 4>&2
times=$({ time "$@" >&3 2>&4; } 2>&1)
status=$?
for word in "$@"; do case $word in *.f90 | *.F90) file=${word%-pp.f90} ;; esac; done     # of Ninja: x.f90-pp.f90
[ -z "${file:-}" ] || awk -v file="$file" '{printf "%.3f %s\n", $1 + $2, file}' <<<"$times" >>"$EK_TIMES"
exit $status
