#!/usr/bin/env python3
"""validation_page.py [--check] PROGRAM: writes docs/validation.md and docs/validation/*.csv, or checks that they are up to date.

PROGRAM is validation_numbers of a build (cmake --build build/release --target validation_numbers); it is run in the
top folder of the repository and prints all comparisons. With --check nothing is written; the status is 1 if a file
differs: in its text, or in a number by more than two units of its last digit and 2e-9.
"""
import csv
import re
import subprocess
import sys
from math import ceil, log10
from pathlib import Path

top = Path(__file__).resolve().parents[2]
page = top / "docs/validation.md"

intro = """# Validation against published numbers

This page compares elastokin with published numbers of other programs and of a textbook, and with solutions computed
outside elastokin for published hardpoints. Each number is also a test. The page has the definitions and the largest
differences, and the table of each source is a CSV file. `tests/support/validation_page.py` writes both:

    tools/build.sh release validation_numbers
    tests/support/validation_page.py build/release/tests/validation_numbers

The decks are in `tests/validation/decks`, the published numbers in `tests/validation/numbers` and in the sources of
the tests (`tests/validation`). The frames, signs and units of the tables are those of each source.

## Largest differences

"""

# name, heading, test, whether the table lists every number, text; of the quantities in `shown` the page has the rows, too
sources = [
    ("Adams/Car", "Adams/Car", "test_adams.pf", True, """\
Source: the front double wishbone of the shared database of Adams/Car 2024.1, published in the repository
1191415541/open-kinematics (commit b940230e). Decks: `adams_double_wishbone.nml`, `adams_bushings.nml`.

- Camber and toe are those of `--definitions adams`. In the repository x is forward, y to the right, z up, and toe is
  positive for toe-out, against the sign of Adams/Car. The published state at design differs from the hardpoints by
  up to 9e-8 mm and 3e-8 deg. This offset is subtracted at every other state, so the design state is not compared.
- The wheel centre is the hardpoint plus the displacement of elastokin, because its axes are those of the repository.
  The rotation per force is an entry of the compliance, for which no definition is a column.
- Compliance: the four inner pivots are isotropic bushings (1e4 N/mm, 1e7 N mm/rad). The rotation is the component
  along y of the rotation vector of the carrier. Adams/Car gives it at -100 N. The rows marked Newton are from
  an independent solver of the same model, not from Adams/Car: smaller forces, and all rates times a factor.
"""),
    ("IPGKinematics", "IPGKinematics", "test_ipg.pf", False, """\
Source: seven axles of Formula Student cars, computed with IPGKinematics 3.6.7 and published with their inputs in
the repository SDS-RC-FEE-CTU-in-Prague/FormulaCarMaker. Only the numbers are used. They have 7 digits; the
compliances beside design have 5. Decks: `fse04_front.nml` to `pltka_rear.nml`. The table has the largest difference
of each quantity over all axles and states; these are the rows of the pose of the wheel.

- The pose of the wheel (R = Rz(rz) Rx(rx) Ry(ry), x forward, y left), caster, kingpin inclination, hub offsets,
  trail, scrub radius, track change and loads are those of `--definitions ipg`. Neither deck nor case has another option for
  them.
- Compliance: the difference of two states under ±1000 N or ±100 N m at the wheel centre, divided by twice the load,
  with the road held. elastokin solves the same states. Each entry is divided by √(Cii Cjj). For z, 1e-5 m/N takes the
  place of the diagonal. The matrix is unsymmetric by up to 5 % of an entry, because its rotations are differences of
  Cardan angles. The matrix of elastokin has the same asymmetry.
- Vertical stiffness of the tyre: the published heights and loads show that the tyre deflects as if its contact point
  were at 0.6 of the radius below the wheel centre, while its force acts at the whole radius. elastokin has one contact
  point, at the whole radius. So the road height in these decks is the published height plus 0.4 times the rise of
  the contact point relative to the wheel centre. The test checks this rule at every state.
- The point at 0.6 of the radius is fixed in the carrier. From the published poses, heights and loads alone, its height
  is that of the source within 1e-5 mm, the last published digit. The lowest point of a torus whose crown is 0.4 of the
  radius differs by up to 0.128 mm, that of a disc by 0.313 mm, and the point of the carrier at the whole radius by
  0.100 mm; this order holds for every axle. So the decks, and the decks of `elastokin import`, have no `crown_radius`.
- Trail, scrub radius, hub offsets and track: IPGKinematics measures them in the direction of the wheel, with a
  contact point that does not turn with the carrier about the spin axis. The lateral position of this contact point is
  known to 2.4e-3 mm, which limits scrub radius and track. The published track change is not zero at design, but up to
  2e-3 mm.
- Forces at design: elastokin and IPGKinematics share the x-force of an arm differently between its two bushings. So
  the sum of both is compared, from the columns of elastokin.
- Steering: at the published heights of the wheel centres. The wheel load acts at the contact point of the carrier in
  elastokin, and at a contact point that does not turn with the carrier in IPGKinematics.

Not compared:

| published | reason |
|---|---|
| roll centre height (`rc`), `anti_brake`, `anti_drive`, Ackermann percentage | the definition is not published and differs: the roll centre of the FSE04 rear axle at design is 17.7 mm high in the source, 26.0 mm here |
| rack force | depends on the contact point of the wheel load (see above) |
| compliance by Fz below a wheel load of 1000 N | the published numbers contain a tyre that lifts off |
| compliances of the Pltka rear axle at -18 mm | the wheel load is 2.6 N, so the published numbers contain a tyre that lifts off |
"""),
    ("OptimumKinematics", "OptimumKinematics", "test_published_optimum.pf", True, """\
Source: case study of a Formula Student car (OptimumG, May 2015), with one digit after the point. Decks:
`optimum_front.nml`, `optimum_rear.nml`.

- The numbers are those of `--definitions optimumk`: the front view swing arm is measured from the contact point.
- All numbers round to the printed ones, except the swing arm of the front axle: 921.38 mm, printed as 921.3.
"""),
    ("Lotus", "Lotus Suspension Analysis", "test_published_lotus.pf", True, """\
Source: listings of Lotus Suspension Analysis with the hardpoints and static values of two front double wishbones
(4x4V23.shk, v4.03; bat.shk, v5.01), with two digits after the point. Decks: `lotus_4x4.nml`, `lotus_bat.nml`.

- The numbers are those of `--definitions lotus`.
- All numbers are within one unit of the last printed digit, except the roll centre, which differs by up to 0.06 mm.
"""),
    ("Rill", "Rill", "test_published_rill.pf", True, """\
Source: G. Rill, Road Vehicle Dynamics (2012), listing 5.6: four numbers that its program prints at design, and six
states by the same construction, computed outside elastokin. Deck: `rill.nml`. Heights and rack displacements are
prescribed. Camber is positive with the top outward. `tests/quantities/test_rill.pf` contains eleven further states.
"""),
    ("Boxster", "A McPherson axle in closed form", "test_published_boxster.pf", True, """\
Source: a McPherson front axle as entered in a racing game. The curve was computed outside elastokin by closed forms.
Deck: `boxster.nml`. The strut axis passes through the ball joint.
"""),
    ("open-kinematics", "open-kinematics", "test_published_open_kinematics.pf", False, """\
Source: nickmccleery/open-kinematics (commit 3cfc66af, Apache-2.0), nine states of a double wishbone in which rack
and wheel height change together. Its solver leaves residuals of up to 3.4e-6 mm. Deck: `open_kinematics.nml`. The
table has the largest difference of each quantity.

- Camber is that of the spin axis in the y-z plane. The contact point is the lowest point of the wheel disc. The
  scrub radius is measured along the spin axis and is positive with the steering axis inboard.
- The slopes are difference quotients over ±0.05 mm.
"""),
]

shown = {"IPGKinematics": ["x", "y", "z", "rx", "ry", "rz"]}

paper = """## The paper

J. S. Kang, *Elastokinematic analysis of a suspension system with linear recursive formula*, International Journal
of Automotive Technology 6(4), 2005. `--method recursive` is its formula, equations (25) to (29)
([derivation](theory/kkt.md#three-increments)). This repository does not contain the paper's
vehicle, so its curves are not compared.

What the paper claims is checked with `input/mcpherson`, load 0 to -3000 N (`tests/equilibrium/test_methods.pf`). Its
measure of error, the residual |Φ| of the joint constraints at the end of the sweep (equation (31)), tends to zero with
the first power of the increment. The error against the exact equilibrium under the same load does not: about 1.2 % of
the travel remains ([table](../studies/step_size/README.md), [comparison with the paper](paper.md)).

## A second program

A second program was written from the manual alone. It shares no line with elastokin and is not part of this
repository. Some of its numbers are tests: eight decks of `input` under bumps, forces and steering. The tolerance is
1e-8 of the value or 1 unit, whichever is larger, plus 1e-5 N or N m for forces and moments
(`tests/quantities/test_second_program.pf`).
"""


def read(program):
    text = subprocess.run([str(Path(program).resolve())], cwd=top, check=True, capture_output=True, text=True).stdout
    rows = list(csv.DictReader(text.splitlines(), delimiter=";"))
    for row in rows:
        for key in ("ours", "published", "tolerance"):
            row[key] = float(row[key])
        # the last bits differ between platforms and must not choose the largest difference
        row["difference"] = float(f"{row['ours'] - row['published']:.2e}")
    return rows


def number(value, row):
    """A value with one digit more than its tolerance."""
    tolerance = row["tolerance"]
    if abs(value) < 1e-3 and value and row["unit"] != "-":
        return re.sub(r"e-0", "e-", f"{value:.{max(1, ceil(log10(abs(value) / tolerance)) + 1)}e}")
    text = f"{value:.{max(0, ceil(-log10(tolerance)) + 1)}f}"
    return text[1:] if re.fullmatch(r"-0\.?0*", text) else text


def short(value):
    return re.sub(r"e([+-])0", r"e\1", f"{value:.1e}").replace("e+", "e")


def difference(row):
    return "0" if abs(row["difference"]) < 1e-6 * row["tolerance"] else short(row["difference"])


def largest(rows):
    """The row with the largest difference; the first of several."""
    return max(rows, key=lambda row: abs(row["difference"]))


def groups(rows, key):
    found = {}
    for row in rows:
        found.setdefault(key(row), []).append(row)
    return found


def kind(row):
    """The quantity of a row; all entries of a column of the compliance matrix, of both wheels, together."""
    name = row["quantity"].replace("steering, left ", "steering, ").replace("steering, right ", "steering, ")
    if name.startswith("compliance"):
        where = "at design" if row["place"] in ("road 0 mm", "design, 7 digits") else "beside design"
        name = f"{name[:-3]}, {where}"
    return name


def part(row):
    name = row["part"].replace("_", " ")
    return name[:3].upper() + name[3:] if name.startswith("fse") else name.capitalize()


def place(row, rows):
    """The state of a row; also the axle, if the source has several axles."""
    parts = {other["part"] for other in rows if other["part"] != "with bushings"}
    return f"{part(row)}, {row['place']}" if len(parts) > 1 else row["place"]


def full_table(rows):
    lines = ["| quantity | state | unit | elastokin | published | difference |", "|---|---|---|---|---|---|"]
    for row in rows:
        lines.append(f"| {row['quantity']} | {place(row, rows)} | {row['unit']} | "
                     f"{number(row['ours'], row)} | {number(row['published'], row)} | {difference(row)} |")
    return lines


def short_table(rows):
    lines = ["| quantity | numbers | unit | largest difference | at | elastokin | published |",
             "|---|---|---|---|---|---|---|"]
    for name, members in groups(rows, kind).items():
        row = largest(members)
        lines.append(f"| {name} | {len(members)} | {row['unit']} | {difference(row)} | {place(row, rows)} | "
                     f"{number(row['ours'], row)} | {number(row['published'], row)} |")
    return lines


of_value = {"rad": "of the value, rotation by force", "mm": "of the value, displacement by force (6 digits)"}


def unit_of(row):
    """The unit under which the summary counts a row."""
    if row["part"] == "with bushings":
        return of_value[row["unit"]]
    return row["unit"] if row["unit"] != "-" else "√(Cii Cjj), compliance"


def relative(row):
    """Relative difference; 0 at the smallest force, where the last bits of positions count."""
    return 0.0 if abs(row["published"]) < 1e-10 else abs(row["difference"] / row["published"])


def summary(rows):
    lines = ["| source | test | numbers | largest differences |", "|---|---|---|---|"]
    for name, heading, test, _, _ in sources:
        mine = [row for row in rows if row["program"] == name]
        parts = []
        for unit, members in groups(mine, unit_of).items():
            worst = max(relative(row) if unit in of_value.values() else abs(row["difference"]) for row in members)
            parts.append(f"{short(worst)} {unit}")
        anchor = heading.lower().replace(" ", "-").replace("/", "")
        lines.append(f"| [{heading}](#{anchor}) | `{test}` | {len(mine)} | {'; '.join(parts)} |")
    lines.append(f"| all | | {sum(len([row for row in rows if row['program'] == name]) for name, *_ in sources)} | |")
    return lines


def file_of(name):
    return f"{name.lower().replace('/', '_').replace('-', '_')}.csv"


def cells(line):
    """The cells of a line of a table, as a line of CSV."""
    return ",".join(f'"{cell}"' if "," in cell else cell for cell in line[2:-2].split(" | "))


def texts_of(rows):
    """The files and their texts: the page, and a CSV file per source."""
    found = {page: ""}
    text = intro + "\n".join(summary(rows)) + "\n"
    for name, heading, test, is_full, words in sources:
        mine = [row for row in rows if row["program"] == name]
        table = full_table(mine) if is_full else short_table(mine)
        found[page.parent / "validation" / file_of(name)] = "\n".join(cells(line) for line in table[:1] + table[2:]) + "\n"
        kept = [line for line in table[2:] if line[2:].partition(" | ")[0] in shown.get(name, [])]
        text += f"\n## {heading}\n\n{words}\nTest: `tests/validation/{test}`. Table: [{file_of(name)}](validation/{file_of(name)}).\n"
        text += "\n" + "\n".join(table[:2] + kept) + "\n" if kept else ""
    found[page] = text + "\n" + paper + "\nNext: [limits](limits.md), or [reproduce a rig test](rig_test.md).\n"
    return found


numeral = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")


def agree(a, b):
    """Whether two numerals are the same up to rounding."""
    if a == b:
        return True
    x, y = float(a), float(b)
    mantissa, _, exponent = a.partition("e")
    digit = 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
    return abs(x - y) <= max(2.0 * digit if "." in a else 0.0, 2e-9)


def compare(name, old, new):
    """The first line of a file that differs, or None."""
    before, after = old.splitlines(), new.splitlines()
    for k, (a, b) in enumerate(zip(before, after), start=1):
        numbers = numeral.findall(a), numeral.findall(b)
        if numeral.sub("#", a) != numeral.sub("#", b) or not all(map(agree, *numbers)):
            return f"{name}:{k}: found {a!r}, expected {b!r}"
    if len(before) != len(after):
        return f"{name}: found {len(before)} lines, expected {len(after)}"
    return None


def main():
    arguments = [word for word in sys.argv[1:] if word != "--check"]
    if len(arguments) != 1:
        sys.exit(__doc__)
    new = texts_of(read(arguments[0]))
    listed = set((page.parent / "validation").glob("*.csv"))
    if "--check" not in sys.argv:
        (page.parent / "validation").mkdir(exist_ok=True)
        for path in listed - set(new):
            path.unlink()
        for path, text in new.items():
            path.write_text(text, encoding="utf-8")
        return
    troubles = [f"{path.relative_to(top)}: no source has this file" for path in sorted(listed - set(new))]
    for path, text in new.items():
        name = path.relative_to(top)
        troubles.append(compare(name, path.read_text(encoding="utf-8"), text) if path.exists() else f"{name}: missing")
    troubles = [trouble for trouble in troubles if trouble]
    if troubles:
        sys.exit("\n".join(troubles) + "\nrun tests/support/validation_page.py build/release/tests/validation_numbers")


main()
