#!/usr/bin/env python3
"""How often the 95 % intervals of `elastokin fit` contain the true number: twelve hardpoint coordinates from toe, camber and track over
travel, with normal errors from many seeds. usage: fit_coverage.py PROGRAM [SEEDS]. Exit status 1 if the share is not in 93 to 97 %."""
import csv
import random
import subprocess
import sys
import tempfile
from pathlib import Path

PATHS = ['lower_ball_joint.y', 'lower_ball_joint.z', 'upper_ball_joint.y', 'upper_ball_joint.z', 'lca_front.z', 'lca_rear.z',
         'uca_front.z', 'uca_rear.z', 'tie_rod_inner.y', 'tie_rod_inner.z', 'tie_rod_outer.y', 'tie_rod_outer.z']
OFF = [3.0, -2.0, -3.0, 1.5, 2.5, -3.0, 1.0, 3.0, -2.5, 2.0, -1.0, 3.0]          # mm, at the start
DEVIATION = {'left_toe_deg': 2e-5, 'left_camber_deg': 2e-5, 'left_track_change_mm': 2e-4}


def main():
    program, seeds = Path(sys.argv[1]).resolve(), int(sys.argv[2]) if len(sys.argv) > 2 else 200
    deck = Path('input/double_wishbone_axle/double_wishbone_axle.nml').resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        run = lambda *words: subprocess.run([program, *words], check=True, capture_output=True, cwd=folder)
        run('run', deck, '--case', 'parallel_travel', '--out', '.', '--columns', ','.join(DEVIATION))
        with open(folder / 'double_wishbone_axle_parallel_travel.csv', encoding='utf-8') as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith('#')))
        lines = [f"&fit name = 'noisy', deck = '{deck}', case = 'parallel_travel' /"]
        lines += [f"&factor name = 'f{k}', path = 'point.{path}', change = 'delta' /" for k, path in enumerate(PATHS)]
        lines += [f"&target name = '{column}', quantity = '{column}', file = 'noisy.csv', deviation = {deviation} /"
                  for column, deviation in DEVIATION.items()]
        (folder / 'fit.nml').write_text('\n'.join(lines) + '\n', encoding='utf-8')
        settings = [word for path, off in zip(PATHS, OFF) for word in ('--set', f'point.{path}=+{off}')]
        inside = 0
        for seed in range(1, seeds + 1):
            source = random.Random(seed)
            with open(folder / 'noisy.csv', 'w', encoding='utf-8') as file:
                print('factor', *DEVIATION, sep=',', file=file)
                for row in rows:
                    print(row['factor'], *(float(row[column]) + source.gauss(0.0, deviation)
                                           for column, deviation in DEVIATION.items()), sep=',', file=file)
            run('fit', 'fit.nml', '--no-plots', '--quiet', '--out', '.', *settings)
            with open(folder / 'noisy_factors.csv', encoding='utf-8') as file:
                for row, off in zip(csv.DictReader(file), OFF):
                    inside += float(row['low_95']) <= -off <= float(row['high_95'])
    share = inside / (seeds * len(OFF))
    print(f'{100 * share:.2f} % of {seeds * len(OFF)} intervals of {seeds} seeds contain the true number')
    return 0 if 0.93 <= share <= 0.97 else 1


if __name__ == '__main__':
    sys.exit(main())
