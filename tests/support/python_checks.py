"""python_checks.py PROGRAM LOOP [N]: time of a changed design of the McPherson axle in Python, beside the same calls in C (LOOP, of
tests/api/loop.c) and a process per design (PROGRAM). Prints remarks; it fails only if numbers differ."""
import csv
import io
import os
import subprocess
import sys
import tempfile
import time

import elastokin

program, loop = sys.argv[1:3]
count = int(sys.argv[3]) if len(sys.argv) > 3 else 1000
DECK = 'input/mcpherson_axle/mcpherson_axle.nml'
PATH, CASE = 'bushing.lca_front.kt(1)', 'parallel_travel'
NUMBERS = ['left_bump_toe', 'left_wheel_rate']
os.environ['OPENBLAS_NUM_THREADS'] = '1'


def per_design(job, n=count):
    """Mean time of job(value) over n values [µs]."""
    start = time.perf_counter()
    for k in range(n):
        job(700.0 * (1 + 1e-4 * k))
    return 1e6 * (time.perf_counter() - start) / n


def run(*arguments):
    return subprocess.run([program, 'run', deck, '--quiet', *arguments], check=True, capture_output=True, text=True).stdout


with tempfile.TemporaryDirectory() as folder:
    # 21 states of one case
    deck = os.path.join(folder, 'axle.nml')
    text = open(DECK).read().replace("from = -80.0,   to = 80.0 /", "from = -80.0, to = 80.0, increments = 20 /", 1)
    with open(deck, 'w') as file:
        file.write(text)
    results = os.path.join(folder, 'results.out')
    in_c = [float(word) for word in subprocess.run([loop, deck, PATH, CASE, str(count), *NUMBERS], check=True, capture_output=True,
                                                   text=True).stdout.split()]
    with elastokin.Model.from_file(deck) as model:
        assert len(model.solve(CASE)) == 21

        def table(value):
            model[PATH] = value
            return model.solve(CASE)

        def numbers(value):
            model[PATH] = value
            return model.numbers(*NUMBERS)

        def table_of_process(value):
            return list(csv.reader(io.StringIO(run('--case', CASE, '--set', f'{PATH}={value!r}', '--out', '-'))))

        def numbers_of_process(value):
            run('--set', f'{PATH}={value!r}', '--responses', ','.join(NUMBERS), '--results', results)
            return dict(reversed(line.split()) for line in open(results))

        table(1.0), numbers(1.0)
        for what, in_python, by_process, c in (('whole table, 21 states', table, table_of_process, in_c[0]),
                                               ('two key numbers', numbers, numbers_of_process, in_c[1])):
            python = per_design(in_python)
            process = per_design(by_process)
            print(f'remark: {what}: {python:.0f} µs per design in Python, {c:.0f} in C (difference {python - c:.0f}); '
                  f'process {process:.0f} µs, {process / python:.1f} times as much')
        found, wanted = numbers(650.0), numbers_of_process(650.0)
        assert all(found[name] == float(wanted[name]) for name in NUMBERS), (found, wanted)
