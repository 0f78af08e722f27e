#!/usr/bin/env python3
"""designs.py: writes designs.csv, a Saltelli design of SALib; designs.py --analyse OUT/from_a_list_responses.csv prints the indices.

Requires SALib (pip install SALib)."""
import csv
import sys

from SALib.analyze import sobol
from SALib.sample import sobol as sampler

PROBLEM = {
    'num_vars': 3,
    'names': ['tie_rod_inner_z', 'tie_rod_outer_z', 'lca_front_radial'],
    'bounds': [[-2.0, 2.0], [-2.0, 2.0], [0.7, 1.3]],
}


def main():
    if sys.argv[1:2] == ['--analyse']:
        import numpy
        with open(sys.argv[2], encoding='utf-8') as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith('#')))
        for name in ('bump_steer_deg_per_m', 'camber_gain_deg_per_m'):
            indices = sobol.analyze(PROBLEM, numpy.array([float(row[name]) for row in rows]), calc_second_order=False, seed=1)
            for k, factor in enumerate(PROBLEM['names']):
                print(f"{name:24} {factor:18} S1 {indices['S1'][k]:8.4f}  ST {indices['ST'][k]:8.4f}")
        return
    with open('designs.csv', 'w', encoding='utf-8', newline='\n') as file:
        file.write(','.join(PROBLEM['names']) + '\n')
        for row in sampler.sample(PROBLEM, 64, calc_second_order=False, scramble=True, seed=1):
            file.write(','.join(repr(float(x)) for x in row) + '\n')


main()
