"""sensitivity.py DECK [N]: which tolerances decide bump steer and braking recession? First-order and total Sobol' indices by SALib.

A study of elastokin computes such indices too (kind = 'saltelli'), on all processors; use this way for samplers and analyses that it
does not have.
"""

import sys

import numpy as np
from SALib.analyze import sobol
from SALib.sample import sobol as sampler

import elastokin

FACTORS = {"point.tie_rod_inner.z": 2.0, "point.tie_rod_outer.z": 2.0, "bushing.lca_front.kt(2)": 0.15, "bushing.lca_rear.kt(3)": 0.15}
NUMBERS = ["left_bump_steer", "left_braking_deflection"]

problem = {
    "num_vars": len(FACTORS),
    "names": list(FACTORS),
    "bounds": [[-t, t] if path.startswith("point") else [1 - t, 1 + t] for path, t in FACTORS.items()],
}
samples = sampler.sample(problem, int(sys.argv[2]) if len(sys.argv) > 2 else 64, calc_second_order=False, seed=1)
with elastokin.Model.from_file(sys.argv[1]) as model:
    nominal = {path: model[path] for path in FACTORS}
    values = []
    for sample in samples:
        for (path, number), change in zip(nominal.items(), sample):
            model[path] = number + change if path.startswith("point") else number * change     # mm, or a factor
        values.append(list(model.numbers(*NUMBERS).values()))
for name, column in zip(NUMBERS, np.array(values).T):
    indices = sobol.analyze(problem, column, calc_second_order=False, seed=1)
    print(f"{name}: {column.mean():.4g} +- {column.std():.2g}, {len(samples)} designs")
    for path, first, total in zip(FACTORS, indices["S1"], indices["ST"]):
        print(f"    {path:28} first {first:7.3f}  total {total:7.3f}")
