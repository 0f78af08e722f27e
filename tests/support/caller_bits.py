"""caller_bits.py FILE DECK...: writes what a caller gets of decks, every number to the bit.

Calls the library that EK_LIBRARY names through the Python package, that is, through its C interface: of each deck the tables of all
cases at the parameters of the deck, at other numbers and at those of the deck again, K&C metrics, compliance matrix and derivatives.
"""

import sys
from pathlib import Path

import elastokin
import numpy as np


def bits(values: object) -> str:
    return " ".join(float(value).hex() for value in np.asarray(values, dtype=float).ravel())


def solve_all(model: elastokin.Model, lines: list[str]) -> None:
    for case in model.cases[:6]:
        try:
            result = model.solve(case)
        except elastokin.ElastokinError as error:
            lines.append(f"{case}: {type(error).__name__}: {error}")
            continue
        lines += [f"{case} {column}: {bits(result[column])}" for column in result.columns]
        lines.append(f"{case} compliance: {bits(result.compliance(len(result) // 2)) if model.wheels else ''}")
        numbers = list(model.parameters)[:3]
        try:
            slopes = result.derivatives([result.columns[2]], numbers, row=len(result) // 2)
            lines.append(f"{case} derivatives: {bits(slopes.values)}")
        except elastokin.ElastokinError as error:
            lines.append(f"{case} derivatives: {type(error).__name__}: {error}")
    if model.wheels:
        lines += [f"{name}: {bits(value)}" for name, value in model.key_numbers().items()]


def main() -> None:
    lines: list[str] = []
    for deck in sys.argv[2:]:
        lines.append(deck)
        with elastokin.Model.from_file(deck) as model:
            solve_all(model, lines)
            x = model.x
            model.x = x * (1.0 - 1.0e-4 * np.cos(np.arange(len(x))) ** 2)
            solve_all(model, lines)
            model.x = x
            solve_all(model, lines)
    Path(sys.argv[1]).write_text("\n".join(lines) + "\n")


main()
