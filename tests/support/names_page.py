#!/usr/bin/env python3
"""names_page.py [--check] PROGRAM: writes input/NAMES.md from the definitions of other programs, or checks that it is up to date.

PROGRAM is elastokin of a build. `PROGRAM list --definitions NAME --json` gives the rows of each program
(src/vocabulary/ek_definition_rows.f90).
"""
import json
import re
import subprocess
import sys
import textwrap
from pathlib import Path

page = Path(__file__).resolve().parents[2] / "input/NAMES.md"

intro = """# Names and definitions of the quantities in other programs

Use these lists to compare numbers between programs. [QUANTITIES.md](QUANTITIES.md) gives the formulas of elastokin;
[docs/EXPORT.md](../docs/EXPORT.md) describes the files that it writes for CarMaker, CarSim and MATLAB. The same lists
are printed by `elastokin list --definitions lotus`. Results in the definitions of a program are written by

    elastokin run DECK --definitions lotus

[How to compare with another program](../docs/definitions.md) explains the files. `tests/support/names_page.py` writes
this page from `src/vocabulary/ek_definition_rows.f90`.

Each list gives the name in the program, its unit, the meaning of a positive value, and the value as a formula of
columns of elastokin at the same state. In a formula, angles are in rad, lengths in m and so on: the values of the
columns in SI. A column is that of the same wheel, without its prefix; `#` is the name of an element.

| number in a formula | meaning |
|---|---|
| `side` | −1 left wheel, +1 right wheel |
| `iso` | +1 in an `iso` deck (vectors x forward, y left), else −1 |
| `height` | height of the wheel centre above the contact point |
| `centre_x`, `centre_y`, `centre_z` | position of the wheel centre, frame of the deck |
| `patch_x`, `patch_y`, `patch_z` | position of the contact point, frame of the deck |
| `foot_x`, `foot_y`, `foot_z` | contact point from the wheel centre at design: ahead, outboard, up in the wheel |
| `design_toe`, `design_camber` | static angles |
| `wheelbase`, `cg_height`, `car_mass` | of `&axle` |
| `front_brake_share`, `rear_brake_share` | share of the braking force of this axle |
| `front_drive_share`, `rear_drive_share` | share of the driving force of this axle |

Quantities that are not printed are listed with the reason:

| reason | meaning |
|---|---|
| definition not published | no document and no published number gives it |
| definition not confirmed | a description exists, but not all of it (often the sign) is known to us |
| not a function of the columns of a state | it needs several states, or entries of the compliance matrix |

## General differences

**Angles in slopes.** Slopes of elastokin are derivatives of toe, steer, camber and caster by the chain rule. Rotations
of the carrier are `…_rotation_…`. Adams/Car and MotionView use the rotation of the wheel carrier, C(4,…), C(5,…),
C(6,…). Both are equal for a wheel with zero camber and toe. IPG gives `rx`, `ry`, `rz` of the carrier.

**Vertical condition of compliances.** elastokin gives both: `load_held` and `height_held`. Adams/Car and MotionView
hold the vertical force; Adams/Car computes C with free wheels. In IPG the tyre acts in series under the contact point,
which is nearly `height_held`.

**Contact point.** In elastokin it is the contact point of the deck, fixed in the wheel carrier, or with `crown_radius`
the lowest point of the tyre. In Adams/Car it is a point below the wheel centre, at the loaded radius of the tyre. In
MotionView it is a point below the wheel centre, at the static loaded radius. Lotus and OptimumKinematics place it below
the wheel centre in the plane of the wheel: `crown_radius = 0`. In IPG the tyre force acts at a point of the wheel
carrier, and the tyre deflects like a point of the carrier at 0.6 of the radius. The fixed contact point is nearer to
IPG than any `crown_radius` ([validation](../docs/validation.md#ipgkinematics)). The formulas use the contact point of
the deck.

**Track.** elastokin uses the distance of the contact points at design, MotionView the distance of the wheel centres at
the state.

**Frame of tables.** In elastokin and Adams/Car x is rearward, y right and z up. elastokin also writes the deck's frame.
MotionView has two orientations, A and B. In IPG x is forward, y left and z up.

**Instant steering axis.** elastokin moves the rack. Without a rack it applies a moment about z.

**Solid axle.** Adams/Car's *dependent* axle is `drive_reaction = 'patch'`.

**Compliance matrix.** Adams/Car and MotionView print the matrix C at the wheel centres, IPG displacements by `L.Frc`,
`L.Trq`, `L.FrcOpp`, `L.TrqOpp`. The entries are in `compliance.csv`: C(1,9) is `centre_left_x_by_right_fz_mm_per_kn`.

"""

ending = """Next: [import a model](../docs/import.md), or [formula and sign of every column](QUANTITIES.md).
"""


def output(program, *arguments):
    return subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout


def item(words):
    """An item of a list, wrapped."""
    return textwrap.fill(words, 118, initial_indent="- ", subsequent_indent="  ", break_long_words=False,
                         break_on_hyphens=False) + "\n"


def code(formula):
    """A formula as a block of code, indented for python-markdown as well as for CommonMark, broken at operators between blanks."""
    lines = textwrap.wrap(formula, 110, break_long_words=False, break_on_hyphens=False)
    return "".join("\n        " + line for line in lines) + "\n"


def entry(row):
    words = "**" + row["name"] + "**" + (" [" + row["unit"] + "]" if row["unit"] else "")
    if row["status"] != "printed":
        words += " (`" + row["column"] + "`)"
    notes = [row["difference"]] if row["difference"] else []
    if row["status"] == "printed" and row["positive"]:
        notes.insert(0, ("positive: " if row["positive"] != "never negative" else "") + row["positive"])
    if row["errs"]:
        notes.append("the program errs: " + row["errs"])
    notes = [part for note in notes for part in note.split("; ")]
    words += "".join(". " + (note if note.startswith("elastokin") else note[0].upper() + note[1:]) for note in notes)
    words += "." if notes else ""
    if row["status"] != "printed":
        return item(words)
    if len(row["formula"]) > 80:
        return item(words) + code(row["formula"]) + "\n"
    return item(words + " `" + row["formula"].replace(" ", "\0") + "`").replace("\0", " ")


def main():
    program = sys.argv[-1]
    help_text = output(program, "list", "--help")
    names = re.search(r"--definitions NAME.*\n\s*(adams[^\n]*)", help_text).group(1).split(" | ")
    text = intro + "## Names by column\n\n"
    data = [json.loads(output(program, "list", "--definitions", name, "--json")) for name in names]
    columns = []
    for each in data:
        for row in each["rows"]:
            if row["column"] not in columns:
                columns.append(row["column"])
    for column in columns:
        cells = [each["definitions"] + " *" + row["name"] + "*" for each in data for row in each["rows"] if row["column"] == column]
        text += item("`" + column + "`: " + ", ".join(cells))
    for each in data:
        text += "\n## %s\n\n`--definitions %s`\n\n" % (each["title"], each["definitions"])
        text += "".join(entry(row) for row in each["rows"] if row["status"] == "printed").rstrip("\n") + "\n"
        others = [row for row in each["rows"] if row["status"] != "printed"]
        if others:
            text += "\nNot printed, with the nearest column and the reason:\n\n" + "".join(entry(row) for row in others)
    text += "\n" + ending
    if "--check" in sys.argv:
        if page.read_text(encoding="utf-8") != text:
            sys.exit("input/NAMES.md differs from the definitions; renew it: tests/support/names_page.py build/release/bin/elastokin")
        return
    page.write_text(text, encoding="utf-8")


main()
