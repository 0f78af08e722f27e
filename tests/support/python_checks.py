"""python_checks.py PROGRAM LOOP [N]: time of a changed design of the McPherson axle in Python, beside that of the library's functions alone,
of the same calls in C (LOOP, of tests/api/loop.c) and of a process per design (PROGRAM). Prints remarks; it fails only if numbers differ.

The package and the library's functions take turns, and medians are printed, because the machine may be busy."""
import csv
import io
import os
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

import elastokin
from elastokin._library import lib, texts_for

program, loop = sys.argv[1:3]
count = int(sys.argv[3]) if len(sys.argv) > 3 else 1000
DECK = 'input/mcpherson_axle/mcpherson_axle.nml'
PATH, CASE = 'bushing.lca_front.kt(1)', 'parallel_travel'
NUMBERS = ['left_bump_toe', 'left_wheel_rate']
os.environ['OPENBLAS_NUM_THREADS'] = '1'


def medians(*jobs, n=count):
    """Median time of each job(value) over n values, no two of which are equal [µs]; the jobs take turns."""
    times = [[] for _ in jobs]
    for k in range(n):
        for which, (job, list_of_job) in enumerate(zip(jobs, times)):
            start = time.perf_counter()
            job(700.0 * (1 + 1e-4 * k + 1e-5 * which))
            list_of_job.append(1e6 * (time.perf_counter() - start))
    return [statistics.median(list_of_job) for list_of_job in times]


def run(*arguments):
    return subprocess.run([program, 'run', deck, '--quiet', *arguments], check=True, capture_output=True, text=True).stdout


with tempfile.TemporaryDirectory() as folder:
    # 21 states of one case
    deck = os.path.join(folder, 'axle.nml')
    text = open(DECK).read().replace("from = -80.0,   to = 80.0 /", "from = -80.0, to = 80.0, increments = 20 /", 1)
    with open(deck, 'w') as file:
        file.write(text)
    results = os.path.join(folder, 'results.out')
    times_in_c = [float(word) for word in subprocess.run([loop, deck, PATH, CASE, str(count), *NUMBERS], check=True, capture_output=True,
                                                   text=True).stdout.split()]
    with elastokin.Model.from_file(deck) as model:
        assert len(model.solve(CASE)) == 21

        handle, values = model._handle, np.empty(10**6)
        room = values
        path, case, names = PATH.encode(), CASE.encode(), texts_for(NUMBERS)
        size = model.solve(CASE).values.size

        def table(value):
            model[PATH] = value
            return model.solve(CASE)

        def table_of_library(value):
            assert lib.ek_set(handle, path, value) + lib.ek_solve(handle, case, 0, None) + lib.ek_values(handle, size, room) == 0

        def table_of_process(value):
            return list(csv.reader(io.StringIO(run('--case', CASE, '--set', f'{PATH}={value!r}', '--out', '-'))))

        def numbers(value):
            model[PATH] = value
            return model.numbers(*NUMBERS)

        def numbers_of_library(value):
            assert lib.ek_set(handle, path, value) + lib.ek_numbers(handle, len(NUMBERS), names, room) == 0

        def numbers_of_process(value, *arguments):
            run('--set', f'{PATH}={value!r}', '--responses', ','.join(NUMBERS), '--results', results, *arguments)
            return dict(reversed(line.split()) for line in open(results))

        for what, jobs, in_c in (('whole table, 21 states', (table, table_of_library, table_of_process), times_in_c[0]),
                                 ('two K&C metrics', (numbers, numbers_of_library, numbers_of_process), times_in_c[1])):
            jobs[0](1.0)
            python, library = medians(*jobs[:2])
            process, = medians(jobs[2])
            print(f'remark: {what}, {count} designs: {python:.0f} µs in Python, of these {library:.0f} in the library '
                  f'({python - library:+.0f}); loop in C {in_c:.0f}; process {process:.0f}, {process / python:.1f} times as much')
        # The package solves by plan, a run by LAPACK unless it is told otherwise. The order of elimination is found at the first design
        # that a handle solves: a handle that solved others before differs in the thirteenth digit.
        with elastokin.Model.from_file(deck) as fresh:
            fresh[PATH] = 650.0
            found, wanted = fresh.numbers(*NUMBERS), numbers_of_process(650.0, '--solver', 'plan')
        assert all(float(f'{found[name]:.15g}') == float(wanted[name]) for name in NUMBERS), (found, wanted)
