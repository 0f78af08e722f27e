#!/usr/bin/env python3
"""Every caller gives the same outcome of a number: a value, or the same reason. usage: one_outcome.py PROGRAM LIBRARY [DECKS [PROBLEMS [SEED]]].

Part 1: decks of input/ and tests/decks/ with seeded changes, so that numbers have no value on purpose: tests that end early (ranges
times 5, a stop or its clearance in the window), tests of one side, a window with few increments, springs without rate, one wheel
instead of two, paths by arc length, a load table, coarse recursive paths. For each K&C metric: the report (key_numbers.csv, and the
note of gradients.csv), `run --responses`, the C interface by ctypes (ek_numbers), the Python package (Model.numbers), and the begin
of `solve --for NAME=keep`.
- A value is the same to 1e-9 of its size, or of 10 in its unit (numbers that are zero by symmetry).
- A number without a value has none for any caller. C and Python give NaN; key_numbers.csv has nan for a slope, whose reason is in
  gradients.csv, and no row for another number; `run` writes FAIL. The reason has the same words, with these exceptions:
  where a path ends within a window, the report names the states that there are, and the other callers the state at which the path
  ended; `solve` refuses a case without derivatives (method recursive, follow = 'arc'); for `solve`, the name of a column is that of a
  column of the first case, whose range is an error of the command line.
Part 2: `solve`, `fit` and `study` with seeded problems: the table printed, the set file or table written, and a fresh run with the
set file give the same values.
Exit status 1 if a law is broken; each breach is printed with its deck and command."""
import csv
import ctypes
import math
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import warnings
from pathlib import Path

PROGRAM, LIBRARY = (str(Path(word).resolve()) for word in sys.argv[1:3])
DECKS, PROBLEMS, SEED = (int(word) for word in (sys.argv[3:] + ['40', '20', '1'][len(sys.argv) - 3:]))
os.environ['EK_LIBRARY'] = LIBRARY
import elastokin  # noqa: E402  (reads EK_LIBRARY)

ROOT = Path(__file__).resolve().parents[2]
SOURCES = sorted(path for path in ROOT.glob('input/*/*.nml') if '&model' in path.read_text(encoding='utf-8')
                 and 'solid_axle/axle' not in str(path))
SOURCES += [ROOT / 'tests/decks' / f'{name}.nml' for name in (
    'coarse_travel', 'dead_centre', 'leaves_its_stop', 'load_state', 'trailing_arm', 'two_arms_on_rubber', 'level_links',
    'semi_trailing_arm', 'push_rod_axle', 'three_link_axle', 'half_axle', 'whole_axle', 'shod_wishbone')]
NUMBER = r'[-+]?[0-9.]+(?:[Ee][-+]?[0-9]+)?'
broken = 0
compared = {'values': 0, 'without a value': 0, 'reasons': 0, 'begin values': 0, 'responses': 0}


def breach(what, *words):
    global broken
    broken += 1
    print(f"broken: {what}\n  elastokin {' '.join(map(str, words))}", flush=True)


def run(*words, folder=None):
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, cwd=folder, timeout=120, check=False)


def same(one, other, digits=9, least=1.0):
    """Equal to the digits of the larger value; values below `least` are compared with it, because 0 has no size of its own."""
    return abs(one - other) <= 10.0 ** -digits * max(abs(one), abs(other), least)


# ---- part 1: decks that lack numbers on purpose ----------------------------------------------------

def records(text, group):
    """Spans of the records of a group."""
    return [match.span() for match in re.finditer(rf"^[ \t]*&{group}\b(?:'[^']*'|![^\n]*|[^/'!])*/", text, re.M)]


def each(text, group, change):
    """Changes all records of a group."""
    for start, end in reversed(records(text, group)):
        text = text[:start] + change(text[start:end]) + text[end:]
    return text


def key(record, name, value):
    """Sets a key of a record."""
    pattern = rf"(\b{name}\s*=\s*)('[^']*'|{NUMBER})"
    if re.search(pattern, record):
        return re.sub(pattern, lambda match: match[1] + value, record)
    return record[:record.rindex('/')] + f", {name} = {value} /"


def range_of(record):
    found = [re.search(rf"\b{name}\s*=\s*({NUMBER})", record) for name in ('from', 'to')]
    return [float(match[1]) for match in found] if all(found) else None


def with_range(change):
    def apply(record):
        ends = range_of(record)
        if ends is None:
            return record
        low, high = change(*ends)
        return key(key(record, 'from', repr(low)), 'to', repr(high))
    return apply


def wide(source, text):
    """Ranges times 5: a test ends early, by a lock or a limit point."""
    return each(text, 'case', with_range(lambda low, high: (5 * low, 5 * high)))


def from_zero(source, text):
    return each(text, 'case', with_range(lambda low, high: (0.0, high)))


def to_zero(source, text):
    return each(text, 'case', with_range(lambda low, high: (low, 0.0)))


def away(source, text):
    """Ranges that do not contain design."""
    share = source.choice([0.01, 0.2, 0.5])
    return each(text, 'case', with_range(lambda low, high: (share * high, high)))


def no_rate(source, text):
    """Coil springs and bars without rate: nothing carries the wheels but bushings."""
    text = each(text, 'spring', lambda record: key(record, 'rate', '0.0') if 'rate' in record else record)
    return each(text, 'torsion', lambda record: key(record, 'rate', '0.0') if 'rate' in record else record)


def no_spring(source, text):
    return each(text, 'spring', lambda record: '')


def few(source, text):
    many = source.choice(['4', '7', '3'])
    return each(text, 'case', lambda record: key(record, 'increments', many))


def arc(source, text):
    return each(text, 'case', lambda record: key(record, 'follow', "'arc'"))


def recursive(source, text):
    many = source.choice(['5', '9'])
    return each(text, 'case', lambda record: key(key(record, 'increments', many), 'method', "'recursive'"))


def stop_in_window(source, text):
    """Stops with a clearance inside the windows of the slopes, hard: the path may end there."""
    gap = source.choice(['0.5', '4.0', '9.0'])
    return each(text, 'stop', lambda record: key(record, 'clearance', gap))


def load_table(source, text):
    """A load table as the only case."""
    text = each(text, 'case', lambda record: '')
    return text + "\n&case test = 'table', file = 'rows.csv' /\n"


def no_mirror(source, text):
    """One wheel of two, where the half is a model."""
    text = each(text, 'mirror', lambda record: '')
    return each(text, 'axle', lambda record: '')


def no_cases(source, text):
    return each(text, 'case', lambda record: '')


CHANGES = [wide, from_zero, to_zero, away, no_rate, no_spring, few, arc, recursive, stop_in_window, load_table, no_mirror, no_cases]


def make_deck(source, change, folder):
    """A changed deck in a folder of its own; the first that is accepted."""
    for _ in range(60):
        path = source.choice(SOURCES)
        text = path.read_text(encoding='utf-8')
        changed = change(source, text)
        names = [change.__name__]
        if source.random() < 0.5:
            other = source.choice(CHANGES)
            changed = other(source, changed)
            names.append(other.__name__)
        if changed == text:
            continue
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(path.parent, folder) if path.parent.name != 'decks' else folder.mkdir()
        deck = folder / f'{path.stem}.nml'
        deck.write_text(changed, encoding='utf-8')
        sides = ('left_', 'right_') if '&mirror' in changed else ('',)
        lines = [','.join(side + column for side in sides for column in ('fx_n', 'fy_n'))]
        lines += [','.join([str(-200 * row), str(500 * row)] * len(sides)) for row in range(4)]
        (folder / 'rows.csv').write_text('\n'.join(lines) + '\n', encoding='utf-8')
        try:
            with elastokin.Model.from_file(deck) as model:
                if len(model.number_names) > 0:
                    return deck, names
        except elastokin.ElastokinError:
            continue
    raise SystemExit(f'no deck for {change.__name__}')


def numbers_by_c(deck, names):
    """Values, message and status of ek_numbers."""
    lib = numbers_by_c.lib
    handle = ctypes.c_void_p()
    lib.ek_message.restype = ctypes.c_char_p
    lib.ek_message.argtypes = [ctypes.c_void_p]
    lib.ek_open_file.argtypes = [ctypes.c_char_p, ctypes.POINTER(ctypes.c_void_p)]
    lib.ek_numbers.argtypes = [ctypes.c_void_p, ctypes.c_int, ctypes.POINTER(ctypes.c_char_p), ctypes.POINTER(ctypes.c_double)]
    lib.ek_close.argtypes = [ctypes.c_void_p]
    status = lib.ek_open_file(str(deck).encode(), ctypes.byref(handle))
    values = (ctypes.c_double * len(names))(*[math.nan] * len(names))
    if status == 0:
        wanted = (ctypes.c_char_p * len(names))(*[name.encode() for name in names])
        status = lib.ek_numbers(handle, len(names), wanted, values)
    message = (lib.ek_message(handle) or b'').decode() if status else ''
    lib.ek_close(handle)
    return list(values), message, status


def numbers_by_python(deck, names):
    with elastokin.Model.from_file(deck) as model, warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter('always')
        try:
            values = list(model.numbers(*names).values())
        except elastokin.ElastokinError as error:
            return [math.nan] * len(names), str(error)
        return values, '\n'.join(str(item.message) for item in caught if issubclass(item.category, elastokin.ConvergenceWarning))


def table_of(path):
    if not path.exists():
        return []
    with path.open(encoding='utf-8', newline='') as file:
        return list(csv.DictReader(line for line in file if not line.startswith('#')))


def reasons_of(message):
    """Names with the reason of a message; '' where a state is missing, which other lines of the message name."""
    found = {}
    for match in re.finditer(r'no value of ((?:\w+ ?)+?)(?: \((.*?)\))?$', message, re.M):
        for name in match[1].split():
            found[name] = match[2] or ''
    return found


def without_paths(message):
    return message.replace('error: ', '').strip()


def compare_deck(source, deck, changes):
    what = f"{deck} ({', '.join(changes)})"
    with elastokin.Model.from_file(deck) as model:
        names = list(model.number_names)
    by_c, message, status = numbers_by_c(deck, names)
    by_python, told = numbers_by_python(deck, names)
    if any(not (one == other or math.isnan(one) and math.isnan(other)) for one, other in zip(by_c, by_python)):
        breach(f'{what}: C and Python differ', deck)
    if told != message:
        breach(f'{what}: C says "{message}", Python says "{told}"', deck)
    reasons = reasons_of(message)
    ours = dict(zip(names, by_c))
    if status in (0, 4):
        for name, value in ours.items():
            if math.isnan(value) != (name in reasons) and reasons:
                breach(f'{what}: {name} is {value}, and the message names {sorted(reasons)}', deck)
    # the report
    out = deck.parent / 'report'
    words = ['report', deck, '--no-plots', '--quiet', '--solver', 'plan', '--out', out]
    ran = run(*words)
    rows = {row['name']: row for row in table_of(out / 'key_numbers.csv')}
    notes = {(row['test'], row['quantity'], row['side']): row['note'] for row in table_of(out / 'gradients.csv')}
    if not rows and any(math.isfinite(value) for value in by_c):
        breach(f'{what}: the report has no numbers (status {ran.returncode}: {ran.stderr[-300:]}), C has', *words)
        return
    unknown = set(rows) - set(names)
    if unknown:
        breach(f'{what}: the report has numbers that C does not list: {sorted(unknown)}', *words)
    for name in names:
        value = ours[name]
        theirs = float(rows[name]['value']) if name in rows else math.nan
        if math.isfinite(value) or math.isfinite(theirs):
            compared['values'] += 1
            if not same(value, theirs, least=10.0):
                breach(f'{what}: {name} is {value!r} in C, {theirs!r} in the report; C says: {message[-400:]}', *words)
            continue
        compared['without a value'] += 1
        if name not in rows or not reasons.get(name):
            continue
        row = rows[name]
        if not row['definition'].startswith('slope'):
            continue
        test = re.match(r"test (\S+?),", row['condition'])
        note = notes.get((test[1] if test else '', re.sub(r', (in phase|anti-phase)', '', row['quantity']), row['side']))
        if note is None:
            breach(f'{what}: {name} ({row["condition"]}) has no row in gradients.csv', *words)
            continue
        compared['reasons'] += 1
        reason = reasons[name].removeprefix(row['condition'] + ': ')
        if not note or not reason.endswith(note):
            breach(f'{what}: {name} has no value: C says "{reasons[name]}", gradients.csv "{note}"', *words)
    # single numbers
    lacking = [name for name in names if math.isnan(ours[name])]
    having = [name for name in names if not math.isnan(ours[name])]
    chosen = source.sample(lacking, min(5, len(lacking))) + source.sample(having, min(2, len(having)))
    for name in chosen:
        words = ['run', deck, '--quiet', '--solver', 'plan', '--responses', name]
        ran = run(*words)
        (value,), single, _ = numbers_by_c(deck, [name])
        compared['responses'] += 1
        if not (math.isnan(value) and math.isnan(ours[name]) or same(value, ours[name], 12)):
            breach(f'{what}: {name} is {value!r} alone and {ours[name]!r} among all', *words)
        if math.isnan(value):
            if ran.returncode == 0 or 'FAIL' not in ran.stdout.upper() and 'nan' not in ran.stdout:
                breach(f'{what}: {name} is nan in C ("{single}"), `run --responses` has status {ran.returncode}: {ran.stdout}', *words)
            elif without_paths(single) not in without_paths(ran.stderr):
                breach(f'{what}: {name}: C says "{single}", run says "{ran.stderr}"', *words)
        elif ran.returncode != 0 or not same(float(ran.stdout.split()[0]), value):
            breach(f'{what}: {name} is {value!r} in C, `run --responses` has status {ran.returncode}: {ran.stdout} {ran.stderr}', *words)
        path = next((f"point.{match[1]}.z={float(match[2]) - 5.0}:{float(match[2]) + 5.0}" for match in re.finditer(
            rf"&point\s+name\s*=\s*'(\w+)'\s*,\s*at\s*=\s*{NUMBER}\s*,\s*{NUMBER}\s*,\s*({NUMBER})", deck.read_text(encoding='utf-8'))), None)
        if path is None:
            continue
        words = ['solve', deck, '--quiet', '--out', out, '--vary', path, '--for', f'{name}=keep']
        ran = run(*words)
        begun = re.search(rf'^.*\b{name}\b.* = .*$', ran.stdout, re.M)
        compared['begin values'] += 1
        if os.environ.get('SHOW'):
            print(name, value, '|', ran.returncode, begun[0] if begun else '', '|', ran.stderr.strip()[-300:], '| C:', single)
        if math.isnan(value):
            # a name that is also a column of the first case is this column for solve: its range is an error of the command line.
            # A path without derivatives is refused
            alone = reasons_of(single).get(name)
            if ran.returncode == 0:
                breach(f'{what}: {name} is nan in C ("{single}"), solve says: {ran.stdout}', *words)
            elif alone and alone.split(': ')[-1] not in ran.stderr and not re.search(
                    r"case '\w+' (goes from .* to .*, found 0|has method|has follow)", ran.stderr):
                breach(f'{what}: {name}: C says "{alone}", solve says "{ran.stderr}"', *words)
            elif not ran.stderr.startswith('error') and 'error' not in ran.stderr:
                breach(f'{what}: {name}: solve has status {ran.returncode} and says "{ran.stderr}"', *words)
        elif ran.returncode == 0 and begun and f'{name} = ' in begun[0]:
            shown = re.search(rf'{name}(?: of [^=]*)? = ({NUMBER})', begun[0])
            if shown is None or not same(float(shown[1]), value, 8, least=10.0):
                breach(f'{what}: {name} is {value!r} in C, solve begins with "{begun[0]}"', *words)


# ---- part 2: what is printed, what is written, and a fresh run ----------------------------------

AXLES = ['mcpherson_axle', 'double_wishbone_axle', 'five_link_axle', 'trailing_arm_axle', 'semi_trailing_arm_axle', 'integral_link_axle']
KEYS = ['left_bump_toe', 'left_bump_camber', 'left_bump_caster', 'left_wheel_rate', 'left_half_track_change', 'roll_rate',
        'left_wheel_roll_camber']
COLUMNS = ['left_toe_deg', 'left_camber_deg', 'left_caster_deg', 'left_track_change_mm', 'left_vertical_force_n']


def settings_of(path):
    lines = [line.split(' = ') for line in path.read_text(encoding='utf-8').splitlines() if line and not line.startswith('#')]
    return {name: float(value) for name, value in lines}


def points_of(deck):
    """Paths of the coordinates of points outside the middle plane, with their values."""
    found = {}
    text = re.sub(r'!.*', '', deck.read_text(encoding='utf-8'))
    for match in re.finditer(rf"&point\s+name\s*=\s*'(\w+)'\s*,\s*at\s*=\s*({NUMBER})\s*,\s*({NUMBER})\s*,\s*({NUMBER})", text):
        if abs(float(match[3])) > 1.0 and match[1] not in ('wheel_centre', 'contact_patch'):
            found.update({f'point.{match[1]}.x': float(match[2]), f'point.{match[1]}.z': float(match[4])})
    return found


def fresh_key(deck, settings, name):
    """A K&C metric of a new process; None without a value."""
    ran = run('run', deck, '--quiet', '--set-file', settings, '--responses', name)
    return float(ran.stdout.split()[0]) if ran.returncode == 0 else None


def fresh_columns(deck, settings, case):
    """The table of a case of a new process."""
    ran = run('run', deck, '--quiet', '--set-file', settings, '--case', case, '--out', '-')
    return list(csv.DictReader(line for line in ran.stdout.splitlines() if not line.startswith('#')))


def at_place(rows, place):
    return next((row for row in rows if abs(float(row['factor']) - place) < 1e-9 and row['converged'] == '1'), None)


def problem(source, folder):
    """A deck, two numbers that may change by some mm, a K&C metric and a column at a state of the schedule of parallel travel."""
    name = source.choice(AXLES)
    deck = ROOT / f'input/{name}/{name}.nml'
    points = points_of(deck)
    chosen = source.sample(sorted(points), 2)
    empty = folder / 'empty.set'
    empty.write_text('', encoding='utf-8')
    rows = fresh_columns(deck, empty, 'parallel_travel')
    row = source.choice([row for row in rows if abs(float(row['factor'])) < 45.0])
    column = source.choice([name for name in COLUMNS if name in row])
    key_name = source.choice(KEYS)
    return deck, {path: points[path] for path in chosen}, key_name, fresh_key(deck, empty, key_name), column, row


def check_solve(source, folder):
    deck, numbers, key_name, begin, column, row = problem(source, folder)
    if begin is None:
        return False
    place, size = float(row['factor']), abs(begin) * 0.05 + 0.01
    words = ['solve', deck, '--quiet', '--out', folder, '--for', f'{key_name}={begin + source.uniform(-size, size)!r}',
             '--for', f"parallel_travel:{column}@{place!r}={float(row[column]) + source.uniform(-0.05, 0.05)!r}"]
    for path, value in numbers.items():
        words += ['--vary', f'{path}={value - 15.0!r}:{value + 15.0!r}']
    written = folder / f'{deck.stem}_solve.set'
    written.unlink(missing_ok=True)
    ran = run(*words)
    if not written.exists():
        breach(f'solve has status {ran.returncode} and writes no settings: {ran.stderr[-300:]}', *words)
        return False
    settings = settings_of(written)
    for path in numbers:
        # nine digits are printed
        line = re.search(rf'^  {re.escape(path)} = ({NUMBER})', ran.stdout, re.M)
        if line is None or not same(float(line[1]), settings.get(path, math.nan), 8):
            breach(f'{path} is {line and line[1]} in the table and {settings.get(path)} in the settings', *words)
        digits = [float(value) for value in re.findall(NUMBER, ran.stdout.split('as records of the deck:')[-1])
                  if re.search('[0-9]', value)]
        if not any(same(value, settings.get(path, math.nan), 9) for value in digits):
            breach(f'{path} = {settings.get(path)} is not in the records: {ran.stdout}', *words)
    after = {key_name: fresh_key(deck, written, key_name)}
    fresh = at_place(fresh_columns(deck, written, 'parallel_travel'), place)
    after[column] = float(fresh[column]) if fresh else None
    for name, value in after.items():
        line = re.search(rf'^(?:not )?reached: {re.escape(name)}(?: of [^=]*)? = ({NUMBER})', ran.stdout, re.M)
        head = re.search(rf'^# {re.escape(name)} = ({NUMBER})', written.read_text(encoding='utf-8'), re.M)
        if line is None or head is None or value is None or not same(float(line[1]), value, 8) or not same(float(head[1]), value, 8):
            breach(f'{name} is {line and line[1]} in the table, {head and head[1]} in the settings, {value} in a fresh run', *words)
    return True


def check_fit(source, folder):
    deck, numbers, key_name, begin, column, row = problem(source, folder)
    if begin is None:
        return False
    place = float(row['factor'])
    lines = [f"&fit name = 'trial', deck = '{deck}', case = 'parallel_travel' /"]
    for k, (path, value) in enumerate(numbers.items()):
        lines.append(f"&factor name = 'f{k}', path = '{path}', lower = {value - 15.0!r}, upper = {value + 15.0!r} /")
    lines.append(f"&target name = 'key', quantity = '{key_name}', value = {begin * 1.03!r} /")
    lines.append(f"&target name = 'column', quantity = '{column}', at = {place!r}, value = {float(row[column]) + 0.02!r} /")
    (folder / 'fit.nml').write_text('\n'.join(lines) + '\n', encoding='utf-8')
    written = folder / 'trial.set'
    written.unlink(missing_ok=True)
    words = ['fit', folder / 'fit.nml', '--quiet', '--no-plots', '--out', folder]
    ran = run(*words)
    words.append('with\n    ' + '\n    '.join(lines))
    if not written.exists():
        breach(f'fit has status {ran.returncode} and writes no settings: {ran.stderr[-300:]}', *words)
        return False
    settings = settings_of(written)
    for path, factor in zip(numbers, table_of(folder / 'trial_factors.csv')):
        if not same(float(factor['result']), settings.get(path, math.nan)):
            breach(f"{path} is {factor['result']} in the table and {settings.get(path)} in the settings", *words)
    results = {row['target']: float(row['result']) for row in table_of(folder / 'trial_points.csv')}
    fresh = at_place(fresh_columns(deck, written, 'parallel_travel'), place)
    for name, value in (('key', fresh_key(deck, written, key_name)), ('column', fresh and float(fresh[column]))):
        if value is None or not same(results[name], value):
            breach(f'{name} is {results[name]} in the table and {value} in a fresh run', *words)
    return True


def check_study(source, folder):
    deck, numbers, _, _, column, row = problem(source, folder)
    place = float(row['factor'])
    lines = [f"&study name = 'st', kind = 'grid', deck = '{deck}', case = 'parallel_travel', format = 'csv' /"]
    for k, (path, value) in enumerate(numbers.items()):
        lines.append(f"&factor name = 'f{k}', path = '{path}', from = {value - 10.0!r}, to = {value + 10.0!r}, count = 2 /")
    lines.append(f"&response name = 'column', column = '{column}', at = {place!r} /")
    lines.append("&response name = 'slope', column = 'left_camber_deg', of = 'slope', over = 'left_wheel_travel_mm', at = 0.0, window = 15.0 /")
    (folder / 'st.nml').write_text('\n'.join(lines) + '\n', encoding='utf-8')
    words = ['study', folder / 'st.nml', '--quiet', '--no-plots', '--out', folder / 'study', '--jobs', '1', '--accept-failed']
    shutil.rmtree(folder / 'study', ignore_errors=True)
    ran = run(*words)
    words.append('with\n    ' + '\n    '.join(lines))
    rows = table_of(folder / 'study' / 'st_responses.csv')
    if len(rows) != 4:
        breach(f'the study has status {ran.returncode}: {ran.stderr[-300:]}', *words)
        return False
    for design in source.sample(rows, 2):
        heads = list(design)
        written = folder / 'design.set'
        written.write_text(''.join(f'{path} = {design[heads[1 + k]]}\n' for k, path in enumerate(numbers)), encoding='utf-8')
        fresh = at_place(fresh_columns(deck, written, 'parallel_travel'), place)
        key_value = fresh_key(deck, written, 'left_bump_camber')
        pairs = ((float(design[heads[3]]), fresh and float(fresh[column])), (float(design[heads[4]]), key_value))
        for (theirs, value), name in zip(pairs, heads[3:5]):
            if math.isnan(theirs) and value is None:
                continue
            if value is None or not same(theirs, value):
                breach(f"{name} of design {design['design']} is {theirs} in the table and {value} in a fresh run", *words)
    return True


def main():
    numbers_by_c.lib = ctypes.CDLL(LIBRARY)
    warnings.filterwarnings('ignore', category=elastokin.ModelWarning)
    with tempfile.TemporaryDirectory() as name:
        for k in range(DECKS):
            source = random.Random(100000 * SEED + k)
            change = CHANGES[k % len(CHANGES)]
            deck, changes = make_deck(source, change, Path(name) / f'deck_{k}')
            compare_deck(source, deck, changes)
        done = 0
        for k in range(PROBLEMS):
            source = random.Random(1000 * SEED + k)
            done += (check_solve, check_fit, check_study)[k % 3](source, Path(name))
        compared['problems'] = done
        if done < PROBLEMS * 3 // 4:
            breach(f'only {done} of {PROBLEMS} problems were solved')
    print(', '.join(f'{count} {what}' for what, count in compared.items()) + f'; {broken} broken')
    return 1 if broken else 0


sys.exit(main())
