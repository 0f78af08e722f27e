#!/usr/bin/env python3
"""check_json.py SCHEMAS FOLDER: every JSON file below FOLDER fits its schema, and every schema of SCHEMAS has a file.

The schema of a file follows from its name: NAME.json has NAME.schema.json, and so has <model>_NAME.json; the files of
`elastokin export` have export-NAME.schema.json, with the name of the target for <model>_kandc.json. Requires the package jsonschema.
"""
import json
import pathlib
import sys

import jsonschema

schemas = {path.name.removesuffix('.schema.json'): path for path in pathlib.Path(sys.argv[1]).glob('*.schema.json')}
targets = {'kandc': 'matlab-kc'}
used, wrong = set(), 0
for path in sorted(pathlib.Path(sys.argv[2]).rglob('*.json')):
    ending = path.stem.rsplit('_', 1)[-1]
    ending = targets.get(ending, ending)
    name = next((n for n in (path.stem, ending, 'export-' + ending) if n in schemas), None)
    if name is None:
        print(f'{path}: there is no schema for this name')
        wrong += 1
        continue
    schema = json.loads(schemas[name].read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    errors = list(jsonschema.Draft202012Validator(schema).iter_errors(json.loads(path.read_text())))
    for error in errors[:5]:
        print(f'{path}: {error.json_path}: {error.message[:200]}')
    wrong += bool(errors)
    used.add(name)
for name in sorted(set(schemas) - used):
    print(f'{schemas[name]}: no file was checked against it')
    wrong += 1
print(f'{len(used)} schemas, {wrong} wrong')
sys.exit(wrong > 0)
