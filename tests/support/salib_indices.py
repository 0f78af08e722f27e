"""salib_indices.py write|compare first|second, in a folder: writes designs.csv, a Saltelli design of SALib without or with second order;
compares the indices that SALib computes from out/salib_responses.csv with those of the figure's data, out/figures/salib_sobol.gp."""
import csv
import sys

import numpy
from SALib.analyze import sobol
from SALib.sample import sobol as sampler

PROBLEM = {'num_vars': 4, 'names': ['inner', 'outer', 'front', 'rear'], 'bounds': [[-2, 2], [-2, 2], [0.7, 1.3], [0.7, 1.3]]}
second = sys.argv[2] == 'second'
if sys.argv[1] == 'write':
    with open('designs.csv', 'w', newline='') as file:
        writer = csv.writer(file)
        writer.writerow(PROBLEM['names'])
        writer.writerows(map(repr, map(float, row)) for row in sampler.sample(PROBLEM, 64, calc_second_order=second, seed=1))
    sys.exit()
rows = list(csv.DictReader(line for line in open('out/salib_responses.csv') if line[0] != '#'))
panels = open('out/figures/salib_sobol.gp').read().split(' << EOD')[1:]
worst = 0.0
for panel, name in zip(panels, ('toe_gradient_deg_per_m', 'toe_deg', 'camber_deg'), strict=True):
    wanted = sobol.analyze(PROBLEM, numpy.array([float(row[name]) for row in rows]), calc_second_order=second, seed=1)
    lines = [line.split() for line in panel.split('EOD')[0].strip().splitlines()]
    ours = {line[5].strip('"'): [float(x) for x in line[1:5]] for line in lines}
    assert sorted(ours) == sorted(PROBLEM['names']), ours
    for k, factor in enumerate(PROBLEM['names']):
        first, _, total, _ = ours[factor]
        worst = numpy.max([worst, abs(first - wanted['S1'][k]), abs(total - wanted['ST'][k])])      # NaN if one is
        print(f"{name:24} {factor:6} S1 {first:9.6f} {wanted['S1'][k]:9.6f}  ST {total:9.6f} {wanted['ST'][k]:9.6f}")
print(f'note: indices of SALib within {worst:.1e}')
assert worst < 1e-6, worst          # seven digits in the figure's data; NaN is not below
