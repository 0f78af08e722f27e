#!/usr/bin/env python3
"""Random solves and fits of the axles in input/, checked by laws. usage: solve_and_fit_laws.py PROGRAM [RUNS [SEED]].

A solve never ends with a larger sum of squares than it began with; what it calls reached is reached, by a run with its settings; a
number without effect has not moved, and no parameter of a deck that satisfies all conditions; numbers are between their bounds;
settings, table and records give the same numbers.
A fit never ends with a larger sum of squares; a factor without effect or not determined keeps its value and is not learned; a factor
at a bound has an interval that begins or ends there; no interval is empty; settings and table give the same numbers.
Exit status 1 if a law is broken; each breach is printed with its command."""
import csv
import random
import re
import subprocess
import sys
import tempfile
from pathlib import Path

KEYS = ['left_bump_toe', 'left_bump_camber', 'left_bump_steer', 'left_wheel_rate', 'left_ride_steer', 'roll_rate', 'left_roll_camber']
COLUMNS = ['left_toe_deg', 'left_camber_deg', 'left_track_change_mm', 'left_wheelbase_change_mm', 'left_caster_deg',
           'roll_centre_height_mm', 'left_wheel_rate_n_per_mm', 'left_braking_load_held_deflection_mm_per_kn']
FITTED = ['left_toe_deg', 'left_camber_deg', 'left_track_change_mm', 'left_wheelbase_change_mm']
CASES = ['parallel_travel', 'lateral_force', 'braking', 'aligning_torque']
NUMBER = r'[-+0-9.Ee]+'


class Laws:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder
        self.broken = 0

    def run(self, *words):
        self.words = [str(word) for word in words]
        return subprocess.run([self.program, *self.words], capture_output=True, text=True, cwd=self.folder, timeout=300, check=False)

    def law(self, holds, what):
        if not holds:
            self.broken += 1
            print(f"broken: {what}\n  elastokin {' '.join(repr(word) if '(' in word or ' ' in word else word for word in self.words)}")


def same(one, other, digits=8):
    return abs(one - other) <= 10.0 ** -digits * max(abs(one), abs(other), 1e-30)


def numbers_of(deck):
    """Paths of a deck with their values: coordinates of points, rates of bushings and springs."""
    text = re.sub(r'!.*', '', deck.read_text(encoding='utf-8'))
    paths = {}
    for name, at in re.findall(r"&point\s+name\s*=\s*'(\w+)',\s*at\s*=([-+0-9.,\s]+)", text):
        values = [float(value) for value in at.strip(' ,\n').split(',')[:3]]
        for axis, value in zip('xyz', values):
            if axis != 'y' or abs(value) > 1.0:
                paths[f'point.{name}.{axis}'] = value
    for name, kt in re.findall(r"&bushing\s+name\s*=\s*'(\w+)'[^/]*?\bkt\s*=\s*([0-9.]+\s*,\s*[0-9.]+\s*,\s*[0-9.]+)", text):
        for place, value in enumerate(kt.split(','), 1):
            paths[f'bushing.{name}.kt({place})'] = float(value)
    for name, rate in re.findall(r"&spring\s+name\s*=\s*'(\w+)'[^/]*?\brate\s*=\s*([0-9.]+)", text):
        paths[f'spring.{name}.rate'] = float(rate)
    return paths


def bounds_of(source, path, value):
    """Bounds around a value; now and then the value is a bound, or outside the bounds."""
    size = source.uniform(5.0, 40.0) if path.startswith('point') else abs(value) * source.uniform(0.2, 0.8)
    low, high = value - size * source.uniform(0.1, 1.0), value + size * source.uniform(0.1, 1.0)
    kind = source.random()
    if kind < 0.08:
        low = value
    elif kind < 0.16:
        high = value
    elif kind < 0.2:
        low = value + 0.1 * size
    return low, high


def settings_of(path):
    """Settings of a file for --set-file."""
    lines = [line for line in path.read_text(encoding='utf-8').splitlines() if line and not line.startswith('#')]
    return {line.split(' = ')[0]: float(line.split(' = ')[1]) for line in lines}


def check_solve(laws, source, deck):
    paths = numbers_of(deck)
    chosen = source.sample(sorted(paths), source.randint(1, 4))
    words, bounds = ['solve', deck, '--quiet', '--out', '.'], {}
    for path in chosen:
        bounds[path] = bounds_of(source, path, paths[path])
        words += ['--vary', f'{path}={bounds[path][0]!r}:{bounds[path][1]!r}']
    wanted = {}
    for _ in range(source.randint(1, 3)):
        if source.random() < 0.5:
            name = source.choice(KEYS)
        else:
            name = f"parallel_travel:{source.choice(COLUMNS)}@{source.choice([0, 0, 20, -13.7])}"
        target = source.choice(['keep', None, None, None])
        if target is None:
            target = repr(source.choice([0.0, source.uniform(-3, 3), source.uniform(-30, 30)]))
        wanted.setdefault(name, target)
    for name, target in wanted.items():
        words += ['--for', f'{name}={target}']
    settings = laws.folder / (deck.stem + '_solve.set')
    settings.unlink(missing_ok=True)
    ran = laws.run(*words)
    laws.law(ran.returncode in (0, 1, 3, 4), f'status {ran.returncode}: {ran.stderr[-300:]}')
    if not settings.exists():
        return False
    found = settings_of(settings)
    sums = re.search(rf'weight: ({NUMBER}) -> ({NUMBER})', ran.stdout)
    if ran.returncode == 4:
        laws.law(sums is not None and float(sums[2]) <= float(sums[1]) * (1 + 1e-5), 'the sum of squares has grown')
    for path, (low, high) in bounds.items():
        row = re.search(rf'^  {re.escape(path)} = ({NUMBER}).*\(before ({NUMBER}), bounds', ran.stdout, re.M)
        laws.law(row is not None and path in found, f'{path} is not in the output or not in the settings')
        if row is None or path not in found:
            continue
        laws.law(same(float(row[1]), found[path]), f'{path} is {row[1]} in the output and {found[path]} in the settings')
        slack = 1e-13 * (abs(low) + abs(high))
        laws.law(low - slack <= found[path] <= high + slack, f'{path} = {found[path]} is outside its bounds')
        if f'{path} has no effect' in ran.stdout and low <= paths[path] <= high:
            laws.law(same(found[path], paths[path], 14), f'{path} has no effect, and moved from {paths[path]} to {found[path]}')
        record = ran.stdout.split('as records of the deck:')[1]
        laws.law(any(same(float(value), found[path], 10) for value in re.findall(r'[-+]?[0-9.]+(?:E[-+]?[0-9]+)?', record)
                     if value.strip('.+-')), f'{path} = {found[path]} is not in the records')
    if ran.returncode == 0:
        # nothing moves in a deck that satisfies all conditions
        settings.rename(laws.folder / 'first.set')
        laws.run(*words, '--set-file', 'first.set')
        again = settings_of(settings) if settings.exists() else {}
        for path, (low, high) in bounds.items():
            laws.law(path in again and abs(again[path] - found[path]) <= 1e-6 * (high - low),
                     f'{path} moved from {found[path]} to {again.get(path)} where all conditions are met')
        settings = laws.folder / 'first.set'
        for name, target in wanted.items():
            if ':' in name or target == 'keep':
                continue
            again = laws.run('run', deck, '--quiet', '--set-file', settings, '--responses', name)
            if again.returncode == 0 and f'{name} was met before' not in ran.stdout:
                value = float(again.stdout.split()[0])
                laws.law(abs(value - float(target)) <= 1e-3 * max(1.0, abs(float(target))), f'{name} is {value}, reached: {target}')
    return True


def check_fit(laws, source, deck):
    paths = numbers_of(deck)
    case = source.choice(CASES)
    chosen = source.sample(sorted(paths), source.randint(1, 4))
    off = {path: source.uniform(-3, 3) if path.startswith('point') else paths[path] * source.uniform(0.8, 1.25) - paths[path]
           for path in chosen}
    truth = [word for path in chosen for word in ('--set', f'{path}={paths[path] + off[path]!r}')]
    columns = source.sample(FITTED, source.randint(1, 3))
    table = laws.folder / f'{deck.stem}_{case}.csv'
    table.unlink(missing_ok=True)
    ran = laws.run('run', deck, '--quiet', '--case', case, '--out', '.', '--increments', '20', '--columns', ','.join(columns), *truth)
    if ran.returncode != 0 or not table.exists():
        return False
    rows = [row for row in csv.DictReader(line for line in table.read_text(encoding='utf-8').splitlines() if not line.startswith('#'))
            if row.get('converged', '1') == '1']
    noise = source.choice([0.0, 1e-4, 1e-2])
    with open(laws.folder / 'curve.csv', 'w', encoding='utf-8') as file:
        print('factor', *columns, sep=',', file=file)
        for row in source.sample(rows, source.choice([1, 2, 5, len(rows)])):
            print(row['factor'], *(float(row[column]) + source.gauss(0.0, noise) for column in columns), sep=',', file=file)
    lines = [f"&fit name = 'trial', deck = '{deck}', case = '{case}' /"]
    for k, path in enumerate(chosen):
        low, high = bounds_of(source, path, paths[path])
        given = source.choice([f', lower = {low!r}, upper = {high!r}'] * 3 + [''])
        prior = source.choice([''] * 5 + [f', deviation = {abs(paths[path]) * 0.05 + 0.1!r}'])
        lines.append(f"&factor name = 'f{k}', path = '{path}'{given}{prior} /")
    for column in columns:
        deviation = source.choice(['', f', deviation = {max(noise, 1e-3)!r}'])
        kind = source.choice(['', '', ", of = 'change'"])
        lines.append(f"&target name = '{column}', quantity = '{column}', file = 'curve.csv'{deviation}{kind} /")
    (laws.folder / 'fit.nml').write_text('\n'.join(lines) + '\n', encoding='utf-8')
    (laws.folder / 'trial_factors.csv').unlink(missing_ok=True)
    ran = laws.run('fit', 'fit.nml', '--quiet', '--no-plots', '--out', '.')
    laws.words.append('with\n    ' + '\n    '.join(lines))
    laws.law(ran.returncode in (0, 2, 3, 4), f'status {ran.returncode}: {ran.stderr[-300:]}')
    if not (laws.folder / 'trial_factors.csv').exists():
        return False
    sums = re.search(rf'^sum of squares: ({NUMBER}) -> ({NUMBER})', ran.stdout, re.M)
    laws.law(sums is not None and float(sums[2]) <= float(sums[1]) * (1 + 1e-5), 'the sum of squares has grown')
    laws.law('E+308' not in ran.stdout and '+- 0 ' not in ran.stdout + ' ', 'an interval or singular value that means nothing')
    found = settings_of(laws.folder / 'trial.set')
    with open(laws.folder / 'trial_factors.csv', encoding='utf-8') as file:
        factors = list(csv.DictReader(file))
    for factor, path in zip(factors, chosen):
        start, result, low, high = (float(factor[head]) for head in ('start', 'result', 'low_95', 'high_95'))
        lower, upper = float(factor['lower']), float(factor['upper'])
        laws.law(path in found and same(found[path], result), f'{path} is {result} in the table and {found.get(path)} in the settings')
        laws.law(not low > high, f'{path}: interval {low} to {high}')
        laws.law(not result < lower * (1 - 1e-14 * (lower > 0)) - 1e-12 and not result > upper + 1e-12 * abs(upper),
                 f'{path}: {result} outside {lower} to {upper}')
        inside = not start < lower and not start > upper
        if 'keeps its value' in factor['note']:
            laws.law(factor['learned'] == '0', f'{path} keeps its value and is learned')
            laws.law(not inside or same(start, result, 14), f'{path} keeps its value, {start}, and is {result}')
        if 'no effect' in factor['note']:
            laws.law(factor['half_by_targets_alone'] == 'nan', f'{path} has an interval without an effect')
            laws.law(factor['half_of_95_percent'] == 'nan' or 'prior' in factor['note'], f'{path}: interval without effect and prior')
        if factor['learned'] == '1':
            laws.law(factor['half_of_95_percent'] != 'nan' or 'unknown' in factor['note'], f'{path} is learned without an interval')
        if factor['bound']:
            laws.law(result == (lower if factor['bound'] == 'lower' else upper), f'{path} is not at its bound')
    return True


def main():
    program = Path(sys.argv[1]).resolve()
    runs = int(sys.argv[2]) if len(sys.argv) > 2 else 100
    first = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    decks = sorted(path.resolve() for path in Path('input').glob('*_axle/*_axle.nml'))
    done = {'solve': 0, 'fit': 0}
    with tempfile.TemporaryDirectory() as name:
        laws = Laws(program, Path(name))
        for seed in range(first, first + runs):
            source = random.Random(seed)
            before = laws.broken
            kind = 'solve' if seed % 2 else 'fit'
            done[kind] += (check_solve if kind == 'solve' else check_fit)(laws, source, source.choice(decks))
            if laws.broken > before:
                print(f'  seed {seed}')
    print(f"{done['solve']} solves and {done['fit']} fits of {runs} seeds, {laws.broken} laws broken")
    return 0 if laws.broken == 0 and min(done.values()) >= runs // 8 else 1


if __name__ == '__main__':
    sys.exit(main())
