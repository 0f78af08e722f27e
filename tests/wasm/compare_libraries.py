#!/usr/bin/env python3
"""compare_libraries.py LIBRARY: the Python package on the WebAssembly program of this environment and on the native LIBRARY: opening,
numbers, cases, all columns of every case, K&C metrics, compliance and derivatives of every deck of the library, in two processes.

Names, units, flags and messages are equal but for digits. Numbers may differ by 1e-10 of the largest number of their unit in the table
(at least 1), forces on the clamps of the twist beam, which cancel, by 1e-6 N; K&C metrics by 1e-9, derivatives by 1e-6. Exit status 1 with a line per failure.
"""
import json
import os
import re
import subprocess
import sys
import warnings
from pathlib import Path

top = Path(__file__).resolve().parents[2]
number = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


def facts_of(deck):
    """What the package says of a deck, as lists."""
    import elastokin

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        model = elastokin.Model.from_file(deck)
        facts = {"name": model.name, "checksum": model.checksum, "cases": model.cases, "paths": model.parameters.paths, "x": model.x.tolist(),
                 "units": model.number_units, "remarks": model.remarks, "numbers": model.key_numbers(), "tables": {}}
        for case in model.cases[:4]:
            result = model.solve(case)
            facts["tables"][case] = [result.columns, list(result.units.values()), result.values.T.tolist(), [str(r) for r in result.remarks]]
        result = model.solve(model.cases[0], ["*toe_deg"])
        facts["compliance"] = result.compliance(0).tolist()
        path = next(path for path in model.parameters.paths if path.startswith("point."))
        if model.cases[0] in model.deck_cases:
            facts["derivatives"] = result.derivatives([c for c in result.columns if c.endswith("toe_deg")], [path], 1).values.tolist()
    return facts


def table_differences(where, one, other):
    """Where two tables differ."""
    yield from differences(f"{where} heads", [*one[:2], one[3]], [*other[:2], other[3]], 0.0)
    size = {}
    for unit, column in zip(one[1], one[2]):
        size[unit] = max([size.get(unit, 1.0), *(abs(value) for value in column if value == value)])
    for name, unit, column, twin in zip(one[0], one[1], one[2], other[2]):
        if name == "iterations":        # of a state at the edge of one more
            column, twin = ([0.0 if abs(a - b) <= 1.0 else a for a, b in zip(column, twin)], [0.0 if abs(a - b) <= 1.0 else b for a, b in zip(column, twin)])
        bound = 1e-6 if re.match(r"(left|right)_beam_f[xyz]_n$", name) else 1e-10 * size[unit]
        for k, (a, b) in enumerate(zip(column, twin)):
            if (a != a) != (b != b) or abs(a - b) > bound:
                yield f"{where} {name} {k}: {a!r} and {b!r}, {unit} up to {size[unit]:g}"
                break


def differences(where, one, other, bound):
    """Where two values differ."""
    if isinstance(one, dict):
        if list(one) != list(other):
            yield f"{where}: {list(one)[:3]} and {list(other)[:3]}"
            return
        for key in one:
            yield from differences(f"{where} {key}", one[key], other[key], bound)
    elif isinstance(one, list):
        if len(one) != len(other):
            yield f"{where}: {len(one)} and {len(other)} values"
        elif all(isinstance(value, (int, float)) for value in one) and one:
            size = max([1.0, *(abs(value) for value in one if value == value)])
            for k, (a, b) in enumerate(zip(one, other)):
                if (a != a) != (b != b) or abs(a - b) > bound * size:
                    yield f"{where}, {k}: {a!r} and {b!r}"
                    return
        else:
            for k, (a, b) in enumerate(zip(one, other)):
                yield from differences(f"{where} {k}", a, b, bound)
    elif isinstance(one, str):
        if number.sub("0", one) != number.sub("0", other):
            yield f"{where}: {one} and {other}"
    elif (one != one) != (other != other) or abs(one - other) > bound * max(1.0, abs(one)):
        yield f"{where}: {one!r} and {other!r}"


if len(sys.argv) == 3 and sys.argv[1] == "--facts":
    print(json.dumps(facts_of(sys.argv[2])))
    sys.exit()
decks = [p for p in sorted((top / "input").glob("*/*.nml")) if re.search(r"(?im)^\s*&model\b", p.read_text())]
failures, count = [], 0
for deck in decks:
    found = []
    for library in (sys.argv[1], ""):
        environment = {**os.environ, "EK_LIBRARY": str(Path(library).resolve())} if library else os.environ
        made = subprocess.run([sys.executable, __file__, "--facts", deck], env=environment, text=True, capture_output=True)
        if made.returncode != 0:
            sys.exit(f"{deck}: {made.stderr}")
        found.append(json.loads(made.stdout))
    native, wasm = found
    count += len(native["x"]) + len(native["numbers"]) + sum(len(column) for table in native["tables"].values() for column in table[2])
    derivatives, tables = ([facts.pop(key, none) for facts in found] for key, none in (("derivatives", []), ("tables", {})))
    failures += differences(deck.stem, native, wasm, 1e-9)
    for case in tables[0]:
        failures += table_differences(f"{deck.stem} {case}", *(facts[case] for facts in tables))
    failures += differences(f"{deck.stem} derivatives", *derivatives, 1e-6)
for text in failures:
    print(f"FAILED: {text}")
print(f"{count} numbers of {len(decks)} decks by the package on WebAssembly and on the native library: {len(failures)} failures")
sys.exit(bool(failures))
