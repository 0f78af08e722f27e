"""least_squares.py DECK: two bushing rates and a hardpoint that give an axle three wanted K&C metrics, by scipy.

Each evaluation changes the deck in memory and solves only the tests that the K&C metrics need.
"""

import sys

import numpy as np
from scipy.optimize import least_squares

import elastokin

FACTORS = {                                     # N/mm, N/mm, mm
    "bushing.lca_front.kt(2)": (200.0, 1500.0),
    "bushing.lca_rear.kt(3)": (400.0, 1600.0),
    "point.tie_rod_outer.z": (-65.0, -45.0),
}
TARGETS = {"left_braking_deflection": 5.0, "left_braking_steer": -0.135, "left_bump_steer": 1.0}     # mm/kN, deg/kN, deg/m

with elastokin.Model.from_file(sys.argv[1]) as model:
    start = np.array([model[path] for path in FACTORS])
    lower, upper = np.array(list(FACTORS.values())).T

    def miss(u: np.ndarray) -> np.ndarray:
        """Relative differences from the targets; u is each factor as a share of its range."""
        for path, value in zip(FACTORS, lower + u * (upper - lower)):
            model[path] = value
        found = model.numbers(*TARGETS)
        return np.array([found[name] / wanted - 1 for name, wanted in TARGETS.items()])

    fit = least_squares(miss, (start - lower) / (upper - lower), bounds=(0, 1), diff_step=1e-4)
    miss(fit.x)
    for path, value in zip(FACTORS, start):
        print(f"{path:28} {value:10.3f} -> {model[path]:10.3f}")
    units = model.number_units
    for name, value in model.numbers(*TARGETS).items():
        print(f"{name:28} {value:10.4f} (target {TARGETS[name]:g}) {units[name]}")
    print(f"cost {fit.cost:.3g} after {fit.nfev} steps")
