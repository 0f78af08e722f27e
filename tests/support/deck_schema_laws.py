#!/usr/bin/env python3
"""deck_schema_laws.py PROGRAM DECK...: laws of the schema that `PROGRAM schema` prints. Requires the package jsonschema.

- The schema is a JSON Schema of draft 2020-12, and every deck fits it.
- A deck with one thing wrong does not fit: an unknown key or group, a missing required key, a value of another type, a word that is
  not accepted, too few or too many values, a number outside its range.
- PROGRAM check accepts a key if and only if the schema has it: an accepted key gives no message 'there is no key'.
"""
import copy
import json
import pathlib
import re
import subprocess
import sys
import tempfile

import jsonschema

from deck_as_data import SINGLE, as_data

program, decks = sys.argv[1], sys.argv[2:]
schema = json.loads(subprocess.run([program, 'schema'], capture_output=True, text=True, check=True).stdout)
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)
wrong = 0


def report(message):
    """Prints a violated law."""
    global wrong
    wrong += 1
    print(message)


def variants(deck):
    """The deck with one thing wrong, and what it is."""
    for change in ('a group', 'a key', 'a required key', 'a type', 'a word', 'few values', 'many values', 'a range'):
        other = copy.deepcopy(deck)
        point, body = other.get('point', [{}])[0], other.get('body', [{}])[0]
        if change == 'a group':
            other['springs'] = []
        elif change == 'a key':
            body['weight'] = 3
        elif change == 'a required key':
            other['model'].pop('name')
        elif change == 'a type':
            other['model']['title'] = 7
        elif change == 'a word':
            other['model']['length'] = 'furlong'
        elif change == 'a range':
            other['model']['gravity'] = -9.81
        elif 'at' not in point:
            continue
        elif change == 'few values':
            point['at'] = point['at'][:2]
        elif change == 'many values':
            point['at'] = point['at'] + [0]
        yield change, other


fitting = 0
for name in decks:
    deck = as_data(pathlib.Path(name).read_text())
    if 'model' not in deck:
        continue
    fitting += 1
    for error in list(validator.iter_errors(deck))[:3]:
        report(f'{name}: {error.json_path}: {error.message[:160]}')
    for change, other in variants(deck):
        if validator.is_valid(other):
            report(f'{name}: a wrong deck fits: {change}')

known = {(group, key): row for group, part in schema['$defs'].items() for key, row in part['properties'].items()}
if set(schema['$defs']) != set(schema['properties']):
    report('groups differ between properties and $defs')
for group, reference in schema['properties'].items():
    if ('$ref' in reference) != (group in SINGLE):
        report(f'{group}: once or several times?')
keys = {key for _, key in known}
with tempfile.TemporaryDirectory() as folder:
    deck, refused = pathlib.Path(folder) / 'all.nml', set()
    parts = [sorted(keys)[k:k + 40] for k in range(0, len(keys), 40)]      # a run prints at most 100 messages
    for group, part in [(group, part) for group in schema['$defs'] for part in parts]:
        deck.write_text(f'&{group} ' + ' '.join(f'{key} = 1' for key in part) + ' /\n')
        run = subprocess.run([program, 'check', str(deck)], capture_output=True, text=True, check=False)
        refused |= set(re.findall(r"there is no key '(\w+)' in &(\w+)", run.stdout + run.stderr))
for group in schema['$defs']:
    for key in keys:
        if ((group, key) in known) == ((key, group) in refused):
            report(f'&{group} {key}: the schema and the reader differ')
print(f'{fitting} decks, {len(known)} keys of {len(schema["$defs"])} groups, {wrong} laws violated')
sys.exit(wrong > 0 or fitting == 0)
