"""callers_agree.py PROGRAM C FORTRAN FIT_C FIT_FORTRAN: C (callers.c), Fortran (callers.f90), Python and the command line give the same numbers.

The first three to the bit; the program writes 15 digits, so its numbers are those of C rounded to 15 digits."""
import csv
import math
import struct
import subprocess
import sys
import tempfile

import elastokin

program, in_c, in_fortran, fit_c, fit_fortran = sys.argv[1:]
JOBS = (('input/mcpherson_axle/mcpherson_axle.nml', 'bushing.lca_front.kt(1)', 500.0, 'parallel_travel'),
        ('input/mcpherson_axle/mcpherson_axle.nml', 'point.tie_rod_inner.z', -61.3, 'steering'),
        ('input/five_link_axle/five_link_axle.nml', 'spring.coil.rate', 41.7, 'roll'),
        ('input/mcpherson/mcpherson.nml', 'bushing.lca_rear.kt(2)', 1234.5, 'vertical_sweep'))
NUMBERS = ['left_bump_toe', 'left_wheel_rate', 'left_braking_deflection', 'roll_rate']


def output(*command):
    """Standard output of a program that must succeed."""
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def rows(text):
    """Column names, and rows of numbers of a table as text; an empty field is NaN."""
    lines = list(csv.reader(line for line in text.splitlines() if line and line[0] != '#'))
    return lines[0], [[float(field or 'nan') for field in line] for line in lines[1:]]


def bits(values):
    """The bits of numbers; all NaN are the same."""
    return [struct.pack('d', math.nan if math.isnan(value) else value) for value in values]


compared = 0
for deck, path, value, case in JOBS:
    with elastokin.Model.from_file(deck) as model:
        model[path] = value
        result = model.solve(case)
    for other in (in_c, in_fortran):
        names, table = rows(output(other, deck, path, repr(value), case))
        assert tuple(names) == result.columns, (other, deck)
        for state, (theirs, ours) in enumerate(zip(table, result.values, strict=True)):
            assert bits(theirs) == bits(ours), (other, deck, case, state)
    names, table = rows(output(program, 'run', deck, '--quiet', '--solver', 'plan', '--case', case, '--set', f'{path}={value!r}', '--out', '-'))
    assert set(names) <= set(result.columns), (deck, set(names) - set(result.columns))     # a case that is no test has fewer columns in the program
    where = [result.columns.index(name) for name in names]
    for state, (theirs, ours) in enumerate(zip(table, result.values[:, where], strict=True)):
        assert bits(theirs) == bits(float(f'{x:.15g}') + 0.0 for x in ours), (program, deck, case, state)
    compared += result.values.size

with tempfile.NamedTemporaryFile() as results, elastokin.Model.from_file(JOBS[0][0]) as model:
    output(program, 'run', JOBS[0][0], '--quiet', '--solver', 'plan', '--responses', ','.join(NUMBERS), '--results', results.name)
    ours = {name: float(f'{value:.15g}') for name, value in model.numbers(*NUMBERS).items()}
    theirs = {name: float(value) for value, name in (line.split() for line in open(results.name))}
    assert ours == theirs, (ours, theirs)

fits = [output(*command, JOBS[0][0]).lower().split()
        for command in ((fit_c,), (fit_fortran,), (sys.executable, 'examples/fit.py'))]
print(*fits[0][-3:])
assert len(fits[0]) >= 6 and fits[0] == fits[1] == fits[2], fits
print(f'remark: {compared} numbers of C, Fortran and Python agree to the bit, and with the tables of the program')
