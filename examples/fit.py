"""fit.py DECK: fits a bushing rate to a target compliance (as fit.c and fit.f90).

The wheel of input/mcpherson_axle moves rearward by 5.76 mm per kN of braking force. Which rate of the front bushing of the control arm makes
it 6 mm? The secant method finds it. Numbers are printed with 17 digits: all three programs print the same.
"""

import sys

import elastokin

PATH = "bushing.lca_front.kt(2)"            # [N/mm]
NUMBER = "left_braking_deflection"          # [mm/kN]
TARGET = 6.0

with elastokin.Model.from_file(sys.argv[1]) as model:

    def miss(rate: float) -> float:
        model[PATH] = rate
        return model.numbers(NUMBER)[NUMBER] - TARGET

    before, rate = model[PATH], 0.9 * model[PATH]
    miss_before, miss_now = miss(before), miss(rate)
    for step in range(1, 21):
        print(f"{step:2d} {rate:.16e} {miss_now:.16e}")
        if abs(miss_now) < 1e-9:
            break
        slope = (miss_now - miss_before) / (rate - before)
        before, miss_before = rate, miss_now
        rate = rate - miss_now / slope
        miss_now = miss(rate)
    else:
        sys.exit("fit: no rate found in 20 steps")
