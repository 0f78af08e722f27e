#!/usr/bin/env python3
"""deck_as_data.py FOLDER DECK...: writes each deck as data to FOLDER/<name>_deck.json, for the schema of `elastokin schema`.

A deck as data is an object: group -> list of records, or one record for model, mirror, axle and steering. A record is key -> value,
or list of values. Included files are not read. Files without &model (parts of decks) are skipped. This reader is independent of the
program's: strings in quotes, comments, n*value, key(2) = value, key(1:3) = values.
"""
import json
import pathlib
import re
import sys

SINGLE = {'model', 'mirror', 'axle', 'steering'}
TOKEN = re.compile(r"""(?P<blank>\s+|![^\n]*)|(?P<string>'(?:[^']|'')*'|"(?:[^"]|"")*")|(?P<group>&\w+)|(?P<end>/)|(?P<comma>,)
    |(?P<key>\w+\s*(?:\(\s*\d+\s*(?::\s*\d+\s*)?\))?\s*=)|(?P<word>[^\s,/&'"=!]+)""", re.VERBOSE)


def value(word):
    """A number or a switch."""
    if word.lower() in ('.true.', '.t.', 't', 'true'):
        return True
    if word.lower() in ('.false.', '.f.', 'f', 'false'):
        return False
    number = float(word.lower().replace('d', 'e'))
    return int(word) if re.fullmatch(r'[+-]?\d+', word) else number


def records(text):
    """The records of a deck as pairs of group and {key: {subscript: value}}."""
    found, record, key, at, place = [], None, None, 0, 0
    while place < len(text):
        token = TOKEN.match(text, place)
        if not token:
            raise ValueError(f'cannot read {text[place:place + 30]!r}')
        place = token.end()
        kind, word = token.lastgroup, token.group()
        if kind == 'group':
            record = {}
            found.append((word[1:].lower(), record))
            key = None
        elif kind == 'end':
            record, key = None, None
        elif kind == 'key':
            name, first = re.match(r'(\w+)\s*(?:\(\s*(\d+))?', word).groups()
            key, at = name.lower(), int(first or 1)
            record.setdefault(key, {})
        elif kind in ('string', 'word'):
            count, one = 1, word
            if kind == 'string':
                one = word[1:-1].replace(word[0] * 2, word[0])
            else:
                repeated = re.fullmatch(r'(\d+)\*(.+)', word)
                if repeated:
                    count, one = int(repeated.group(1)), repeated.group(2)
                one = value(one)
            for _ in range(count):
                record[key][at] = one
                at += 1
    return found


def as_data(text):
    """A deck as data."""
    deck = {}
    for group, record in records(text):
        data = {key: values[1] if list(values) == [1] else [values[k] for k in sorted(values)] for key, values in record.items()}
        if group in SINGLE:
            deck[group] = data
        else:
            deck.setdefault(group, []).append(data)
    return deck


if __name__ == '__main__':
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for name in sys.argv[2:]:
        deck = as_data(pathlib.Path(name).read_text())
        if 'model' in deck:
            (folder / f'{pathlib.Path(name).stem}_deck.json').write_text(json.dumps(deck, indent=1))
