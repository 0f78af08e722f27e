"""black_box.py DECK: the fit of dakota/dakota.in by scipy, with one process per design in place of the package.

For optimisers that know programs and files only: the values go into a copy of settings.template, the K&C metrics come from a file with
lines `value name`. A design costs the start of a program and the reading of the deck in addition; fit_by_scipy.py does without.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

FACTORS = {"bushing_kt": (450.0, 200.0, 1500.0), "tie_rod_z": (-55.0, -65.0, -45.0)}        # start, lower, upper
TARGETS = {"left_braking_deflection": 6.0, "left_bump_steer": 1.0}                          # mm/kN, deg/m
TEMPLATE = (Path(__file__).parent / "settings.template").read_text()


def key_numbers(deck: str, values: dict[str, float], folder: Path) -> dict[str, float]:
    """The K&C metrics of one design, from a run of elastokin."""
    settings = TEMPLATE
    for name, value in values.items():
        settings = settings.replace("{" + name + "}", repr(float(value)))
    (folder / "settings.in").write_text(settings)
    subprocess.run(["elastokin", "run", deck, "--quiet", "--set-file", folder / "settings.in", "--responses", ",".join(TARGETS),
                    "--results", folder / "results.out"], check=True, stdout=subprocess.DEVNULL)
    lines = [line.split() for line in (folder / "results.out").read_text().splitlines()]
    return {name: float(value) for value, name in lines}


with tempfile.TemporaryDirectory() as work:
    start, lower, upper = np.array(list(FACTORS.values())).T

    def miss(x: np.ndarray) -> np.ndarray:
        found = key_numbers(sys.argv[1], dict(zip(FACTORS, x)), Path(work))
        return np.array([found[name] - wanted for name, wanted in TARGETS.items()])

    fit = least_squares(miss, start, bounds=(lower, upper), x_scale=upper - lower, diff_step=1e-5)
    for name, value in zip(FACTORS, fit.x):
        print(f"{name:28} {value:.6f}")
    print(f"cost {fit.cost:.3g} after {fit.nfev} steps")
