#!/usr/bin/env python3
"""check_said.py PROGRAM DECK...: recomputes what a report says of its numbers.

For each deck, a report is written. Each K&C metric of key_numbers.csv is computed again from the table that its condition names, by
its definition alone: column, abscissa, factors of the left and right wheel, window. Each gradient of gradients.csv is
the number of the same name. On the page, each number that is named beside another one has the relation that its label gives: slope at
design and fitted slope have one sign and size, an inverse is one, a steer angle is toe times -1 on the left wheel. Each word on both
wheels ('both wheels to the left', 'toe-in on both') agrees with the numbers.

Status 0 and `N sentences checked` if all agree; else each difference on a line, and status 1.
"""
import csv
import json
import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROUNDING = 1e-9          # of the number: the tables have 15 digits
LOCAL = 0.30             # a slope at design and a slope fitted over the window differ by the curvature of the curve


def rows_of(path):
    """The rows of a CSV file below its header lines, as dictionaries."""
    with open(path, encoding='utf-8', newline='') as file:
        return list(csv.DictReader(line for line in file if not line.startswith('#')))


def number(text):
    """A number with the minus sign of the page; nan for a dash."""
    text = text.replace('−', '-').strip()
    return math.nan if text in ('', '–', 'nan', '-') else float(text)


class Table:
    """A table of a test: its rows that converged on the branch through design."""

    def __init__(self, path):
        self.name = path.stem
        self.rows = rows_of(path)

    def column(self, side, name):
        for head in (f'{side}_{name}', name, f'left_{name}'):
            if self.rows and head in self.rows[0]:
                return [number(row[head]) if row['converged'] == '1' else math.nan for row in self.rows]
        raise KeyError(name)

    def design(self):
        good = [k for k, row in enumerate(self.rows) if row['converged'] == '1']
        at = min(good, key=lambda k: abs(float(self.rows[k]['factor'])), default=None)
        return at if at is not None and abs(float(self.rows[at]['factor'])) <= 1e-9 else None


INNER = math.sqrt(3 / 7)                                        # inner points of Gauss and Lobatto
POINTS = ((-1, 1 / 10), (-INNER, 49 / 90), (0, 32 / 45), (INNER, 49 / 90), (1, 1 / 10))


def polynomial(x, y, at):
    """The value at a place of the polynomial through points."""
    value = 0.0
    for k, own in enumerate(x):
        share = y[k]
        for j, other in enumerate(x):
            if j != k:
                share *= (at - other) / (own - other)
        value += share
    return value


def slope(x, y, half):
    """The slope of the least-squares line of y over |x| <= half, y the polynomial through five states; nan without the states."""
    if len(x) != 5 or any(math.isnan(v) for v in (*x, *y)):
        return math.nan
    along = sum(weight * half * point * polynomial(x, y, half * point) for point, weight in POINTS)
    return along / sum(weight * (half * point) ** 2 for point, weight in POINTS)


def folds(table):
    """Whether a path turns back: then the branch through design is not known here."""
    factor = [float(row['factor']) for row in table.rows]
    return any((b - a) * (c - b) < 0 for a, b, c in zip(factor, factor[1:], factor[2:]))


class Report:
    """A report of one deck, and what it says."""

    def __init__(self, program, deck, folder):
        done = subprocess.run([program, 'report', deck, '--out', folder, '--no-plots', '--quiet'], capture_output=True, text=True,
                              check=False)
        if done.returncode not in (0, 4):
            raise SystemExit(f'{deck}: report ends with {done.returncode}: {done.stderr}')
        self.program, self.deck, self.folder, self.tables = program, deck, Path(folder), {}
        self.numbers = rows_of(self.folder / 'key_numbers.csv')
        self.by_name = {row['name']: row for row in self.numbers}
        page = (self.folder / 'report.html').read_text(encoding='utf-8')
        self.data = json.loads(page.split('<script type="application/json" id="data">', 1)[1].split('</script>', 1)[0])
        self.checked, self.wrong = 0, []

    def window(self, test):
        """The states of the windows of a test."""
        return Table(self.folder / 'windows' / f'{test}.csv')

    def table(self, test):
        if test not in self.tables:
            self.tables[test] = Table(self.folder / f'{test}.csv')
        return self.tables[test]

    def where(self, table, side, column, value):
        """The state at which a column has a value, as a table: the target of a case, which the program finds in another way."""
        head = next(head for head in (f'{side}_{column}', column) if head in table.rows[0])
        out = self.folder / 'target'
        done = subprocess.run([self.program, 'run', self.deck, '--case', table.name, '--set', f'case.{table.name}.target={head}={value}',
                               '--quiet', '--out', out], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise KeyError(done.stderr)
        return Table(next(out.glob(f'*_{table.name}_target.csv')))

    def same(self, what, said, found, tolerance=ROUNDING, noise=0.0):
        self.checked += 1
        if math.isnan(said) and math.isnan(found):
            return
        if not abs(said - found) <= tolerance * max(abs(said), abs(found)) + noise:
            self.wrong.append(f'{self.deck}: {what}: said {said}, found {found}')

    def check_definitions(self):
        for row in self.numbers:
            try:
                found, noise = self.recompute(row)
            except (KeyError, AttributeError) as problem:
                self.checked += 1
                self.wrong.append(f'{self.deck}: {row["name"]}: "{row["definition"]}. {row["condition"]}" is not understood ({problem!r})')
                continue
            if found is not None:
                self.same(row['name'], number(row['value']), found, noise=noise)

    def recompute(self, row):
        """The value of a K&C metric by its text, and the noise that counts as 0."""
        text, condition, side = row['definition'], row['condition'], row['side'] or 'left'
        if condition == 'all tests':
            column = text.removeprefix('largest magnitude of ')
            return max(abs(v) for path in self.folder.glob('*.csv') if 'converged' in open(path, encoding='utf-8').read()
                       for v in self.values(Table(path), side, column)), 0.0
        table = self.table(re.match('test ([^,]+)', condition).group(1))
        if folds(table):
            return None, 0.0
        if text.startswith('slope of the least-squares line of '):
            match = re.match(r'slope of the least-squares line of (\S+) over (\w+)(?: \(1: (\S+) .*?\))?'
                             r'(?:, times (\S+)(?: \(left wheel\), (\S+) \(right wheel\))?)?(?:;|$)', text)
            times = number(match[4] or '1')
            if match[5] and side == 'right':
                times = number(match[5])
            half = number(re.search('within ±(\\S+) ', condition)[1])
            per_factor = number(match[3] or '1')
            table = self.window(table.name)
            x = [v * per_factor for v in table.column(side, match[2])]
            nodes = [min(range(len(x)), key=lambda k: abs(x[k] - point * half)) for point, _ in POINTS if x]
            y = table.column(side, match[1])
            value = slope([x[k] for k in nodes], [y[k] for k in nodes], half) * per_factor * times
            return value, 2e-2 * abs(times * per_factor) / half if number(row['value']) == 0 else 0.0
        if 'at the state with this steer angle' in text:
            found = self.where(table, side, 'steer_deg', 20.0 if side == 'left' else -20.0)
            return found.column('', text.split()[0])[0], 0.0
        if text.startswith('magnitude of the change of wheel_travel_mm'):
            gap = re.search(r'to where (\S+) is 0', text)[1]
            travel = table.column(side, 'wheel_travel_mm')
            at = self.where(table, side, gap, 0.0).column(side, 'wheel_travel_mm')[0]
            return abs(at - travel[table.design()]), 0.0
        extreme = re.match(r'(maximum|minimum) of (\w+)', text)
        if extreme:
            values = self.values(table, side, extreme[2])
            return (max if extreme[1] == 'maximum' else min)(values), 0.0
        value = table.column(side, re.match(r'\w+', text)[0])[table.design()]
        return value, 0.0

    @staticmethod
    def values(table, side, column):
        try:
            return [v for v in table.column(side, column) if not math.isnan(v)]
        except KeyError:
            return []

    def check_gradients(self):
        """A gradient has the value of the K&C metric of its name."""
        quantities = {}
        for row in self.numbers:
            if '(fitted)' in row['quantity']:
                key = (re.match('test ([^,]+)', row['condition'])[1], re.sub(', (in phase|anti-phase)', '', row['quantity']), row['side'])
                quantities[key] = row
        for row in rows_of(self.folder / 'gradients.csv'):
            key = (row['test'], row['quantity'], row['side'])
            if key in quantities:
                self.same(f'gradient {key}', number(row['value']), number(quantities[key]['value']))

    def check_relations(self):
        """The numbers that the page names beside another number."""
        numbers = self.data['numbers']
        for own in numbers:
            if 'instead' not in own:
                continue
            text = own['relation'].removesuffix(',')
            if text not in ('As slope at design', 'Its inverse', 'As a fitted slope', 'As a steer angle'):
                self.wrong.append(f'{self.deck}: {own["name"]}: "{text}" says no relation')
            self.check_relation(numbers[own['instead']]['name'], text, own['title'])

    def check_relation(self, kept, text, quantity):
        others = [row for row in self.numbers if row['quantity'] == quantity]
        if not others:
            self.wrong.append(f'{self.deck}: {kept}: {text}, {quantity}: there is no such number')
        for row in others:
            own = self.by_name.get(f'{row["side"]}_{kept}') or self.by_name.get(kept) or self.by_name.get(f'left_{kept}')
            said, value = number(row['value']), number(own['value'])
            if math.isnan(said) or math.isnan(value):
                continue
            if text == 'As a steer angle':
                self.same(f'{kept} as {row["name"]}', said, value if row['side'] == 'right' else -value)
            elif text == 'Its inverse':
                size = 1000.0 if row['unit'] == 'mm/kN' else 1.0
                self.same(f'inverse of {kept}, {row["name"]}', said * value, size, LOCAL)
            else:
                # deg, mm: a slope that is rounding has no sign
                self.same(f'{text}, {kept}, {row["name"]}', said, value, LOCAL, noise=2e-4)

    def check_sides(self):
        """The labels of both wheels."""
        for name, said in ((own['name'], own['sides']) for own in self.data['numbers'] if 'sides' in own):
            left, right = self.by_name.get(f'left_{name}'), self.by_name.get(f'right_{name}')
            if not left or not right:
                continue
            self.checked += 1
            steers = [self.steer(row, name) for row in (left, right)]
            if said == 'both wheels to the left':
                good = min(steers) > 0
            elif said == 'both wheels to the right':
                good = max(steers) < 0
            elif said == 'toe-in on both':
                good = steers[0] < 0 < steers[1]
            elif said == 'toe-out on both':
                good = steers[1] < 0 < steers[0]
            elif said.startswith('both tops to the'):
                tops = [-number(left['value']), number(right['value'])]      # outward is left on the left wheel; + right
                good = max(tops) < 0 if said.endswith('left') else min(tops) > 0
            elif said == 'both wheels':
                good = math.isclose(number(left['value']), number(right['value']), rel_tol=1e-3, abs_tol=1e-3)
            else:
                good = math.isclose(number(left['value']), -number(right['value']), rel_tol=1e-3, abs_tol=1e-3)
            if not good:
                self.wrong.append(f'{self.deck}: {name}: "{said}", but left {left["value"]}, right {right["value"]}')

    @staticmethod
    def steer(row, name):
        """The angle to the left that a number of toe or steer means."""
        value = number(row['value'])
        if 'toe' in name:
            return -value if row['side'] == 'left' else value
        return value


def main():
    program, decks = sys.argv[1], sys.argv[2:]
    checked, wrong = 0, []
    for deck in decks:
        with tempfile.TemporaryDirectory() as folder:
            report = Report(program, deck, folder)
            report.check_definitions()
            report.check_gradients()
            report.check_relations()
            report.check_sides()
            checked += report.checked
            wrong += report.wrong
    for line in wrong:
        print(line)
    print(f'{checked} sentences checked, {len(wrong)} wrong')
    return 1 if wrong or checked == 0 else 0


if __name__ == '__main__':
    sys.exit(main())
