#!/usr/bin/env python3
"""study_laws.py PROGRAM [STUDIES [SEED]]: laws of studies, with random studies of the decks of the library.

Each study has random factors, responses, kinds and sizes. At least one factor (the height of the centre of gravity) changes
no response, and at least one response (the toe or camber of the deck, a driven travel) cannot move. Laws:
- a study ends with its page and figures, also if a response is constant;
- a factor that cannot change a response has no share, index or effect, and a response that cannot move has no share, index,
  interval or deviation;
- two factors of equal influence have equal shares;
- a design whose response touches a limit is within this limit;
- Morris' effects of `values` are exact for a linear response;
- plain Sobol' points are in the middle of their cells.
Single laws that fail are printed with the study. The last line is `N passed, N failed`.
"""
import csv
import json
import math
import os
import random
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import NormalDist

TOP = Path(__file__).resolve().parents[2]
AXLES = ["mcpherson_axle", "double_wishbone_axle", "five_link_axle", "formula_student_axle", "integral_link_axle",
         "mcpherson_split_link_axle", "semi_trailing_arm_axle", "trailing_arm_axle", "twist_beam_axle"]
KINDS = ["saltelli", "tolerance", "morris", "one_at_a_time", "latin_hypercube", "sobol", "monte_carlo", "grid"]
IDLE = "cg"          # the factor that changes no response below
WITHIN = "lower = {0!r}, upper = {1!r}"


class Study:
    """One random study: its text, and what is known of its results."""

    def __init__(self, rng, number):
        self.rng = rng
        name = rng.choice(AXLES)
        self.deck = TOP / "input" / name / f"{name}.nml"
        text = self.deck.read_text()
        self.kind = KINDS[number % len(KINDS)]
        points = re.findall(r"&point\s+name\s*=\s*'(\w+)'", text)
        points = [p for p in points if not re.search(r"wheel|contact|patch|spindle|corner", p)]
        bushings = re.findall(r"&bushing\s+name\s*=\s*'(\w+)'", text)
        self.factors = [(IDLE, "axle.cg_height", "change = 'delta', lower = -20, upper = 20")]
        for k in range(rng.choice([1, 1, 2])):
            if bushings and rng.random() < 0.4:
                self.factors.append((f"f{k}", f"bushing.{rng.choice(bushings)}.kt({rng.choice([1, 2])})",
                                     "change = 'scale', lower = 0.85, upper = 1.15"))
            else:
                self.factors.append((f"f{k}", f"point.{rng.choice(points)}.{rng.choice('yz')}",
                                     "change = 'delta', lower = -1.5, upper = 1.5"))
        if len({path for _, path, _ in self.factors}) < len(self.factors):
            self.factors.pop()
        rng.shuffle(self.factors)
        self.factors = self.factors[:2] if self.kind == "grid" else self.factors
        if IDLE not in [f[0] for f in self.factors]:
            self.factors[0] = (IDLE, "axle.cg_height", "change = 'delta', lower = -20, upper = 20")
        self.constant = rng.choice(["left_toe_deg", "right_camber_deg", "left_wheel_travel_mm"])
        at = rng.choice([-20, 12.5, 20]) if "travel" in self.constant else 0
        self.moving = rng.choice(["left_bump_steer_deg_per_m", "left_wheel_rate_n_per_mm", "roll_centre_height_mm",
                                  "left_bump_camber_deg_per_m", "left_track_change_mm"])
        where = rng.choice([0, 15])
        self.responses = [("fixed", f"column = '{self.constant}', at = {at}"),
                          ("moving", f"column = '{self.moving}', at = {where}"),
                          ("moving_too", f"column = '{self.moving}', at = {where}"),
                          ("same", "of = 'difference', responses = 'moving', 'moving_too'")]
        self.settings = {"grid": f"levels = {rng.choice([2, 3])}", "one_at_a_time": f"levels = {rng.choice([2, 3])}",
                         "morris": f"samples = {rng.choice([3, 5])}, levels = {rng.choice([2, 4, 6])}",
                         "saltelli": f"samples = {rng.choice([4, 8])}"}.get(self.kind, f"samples = {rng.choice([12, 16])}")
        self.columns = rng.random() < 0.3

    def write(self, path, limits=""):
        lines = [f"&study name = 's', kind = '{self.kind}', deck = '{self.deck}', case = 'parallel_travel', increments = 8,",
                 f"  {self.settings}, plot = 'none.gp'" + (f", columns = '{self.constant}'" if self.columns else "") + " /"]
        lines += [f"&factor name = '{n}', path = '{p}', {s} /" for n, p, s in self.factors]
        lines += [f"&response name = '{n}', {s}{', ' + limits if n == 'fixed' and limits else ''} /" for n, s in self.responses]
        path.write_text("\n".join(lines) + "\n")


def run(program, study, out, options=()):
    return subprocess.run([program, "study", str(study), "--quiet", "--out", str(out), *options], capture_output=True,
                          text=True, timeout=300, check=False)


def rows_of(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if line.strip() and not line.startswith("#")))


def tables_of(page, section):
    """The rows of a section of the page, also of folded tables, as lists of strings; the headings of groups are strings alone."""
    sections = json.loads(page.split('<script type="application/json" id="sections">', 1)[1].split("</script>", 1)[0])
    blocks, rows = [block for own in sections if own.get("id") == section for block in own["blocks"]], []
    for block in blocks:
        blocks += block["blocks"] if "fold" in block else []
        for row in block.get("table", []):
            rows.append([row] if isinstance(row, str) else [cell if isinstance(cell, str) else cell.get("text", "") for cell in row])
    return rows


def number(cell):
    match = re.match(r"^−?[0-9.]+(?:E[+-]?\d+)?", cell.strip())
    return float(match[0].replace("−", "-")) if match else math.nan


def bars_of(script, response):
    """The rows of a data block `$bars<response>`, by the name of the factor."""
    found = re.search(rf"\$bars{response} << EOD\n(.*?)EOD", script, flags=re.S)
    bars = {}
    for line in (found[1] if found else "").splitlines():
        cells = line.split()
        bars[cells[-1].strip('"')] = [float(cell) for cell in cells[1:-1]]
    return bars


def is_nothing(values):
    return all(math.isnan(value) or value == 0 for value in values)


def check_random(program, study, folder, faults):
    """Laws of one random study. False if the deck rejects it."""
    path, out = folder / "study.nml", folder / "out"
    study.write(path)
    done = run(program, path, out)
    if done.returncode in (2, 3):
        return False
    if done.returncode not in (0, 4):
        faults.append(f"status {done.returncode}: {done.stderr[-400:]}")
        return True
    rows = rows_of(out / "s_responses.csv")
    heads = list(rows[0])
    fixed = next(h for h in heads if h.startswith("fixed"))
    page = (out / "s.html").read_text()
    statistics = {r[0].split(" ")[0]: r for r in tables_of(page, "responses") if len(r) > 4}
    for name in ("fixed", "same"):
        if name in statistics and number(statistics[name][3]) != 0:
            faults.append(f"deviation of {name}: {statistics[name][3]}")
    scripts = {p.stem.split("_")[1]: p.read_text() for p in (out / "figures").glob("s_*.gp")}
    if study.kind in ("saltelli", "tolerance") and "sobol" in scripts:
        for response, idle in ((1, None), (2, IDLE), (3, IDLE), (4, None)):
            for factor, values in bars_of(scripts["sobol"], response).items():
                if (idle in (None, factor)) and not is_nothing(values):
                    faults.append(f"indices of {factor} on response {response}: {values}")
    if "tornado" in scripts:
        for response, idle in ((1, None), (2, IDLE), (3, IDLE), (4, None)):
            for factor, values in bars_of(scripts["tornado"], response).items():
                if idle in (None, factor) and len({v for v in values if not math.isnan(v)}) > 1:
                    faults.append(f"span of {factor} on response {response}: {values}")
    if study.kind == "tolerance":
        for row in rows_of(out / "s_shares.csv"):
            constant = not row["response"].startswith("moving")
            if constant or row["factor"] == IDLE:
                values = [float(row[key]) for key in ("slope", "effect", "curvature", "first", "total")]
                if not is_nothing(values):
                    faults.append(f"shares of {row['factor']} on {row['response']}: {values}")
        for row in rows_of(out / "s_moments.csv"):
            values = [float(row[key]) for key in ("deviation", "deviation_half_95", "mean_half_95", "skewness")]
            if not row["response"].startswith("moving") and not is_nothing(values):
                faults.append(f"moments of {row['response']}, {row['method']}: {values}")
    if study.kind in ("morris", "one_at_a_time"):
        response = ""
        for row in tables_of(page, "effects"):
            if len(row) == 1:
                response = row[0]
            elif row[0] == IDLE or not response.startswith("moving"):
                if row[0] != "Factor" and response and not is_nothing([number(row[1])]) and study.kind == "morris":
                    faults.append(f"effect of {row[0]} on {response}: {row[1]}")
    # a limit that is touched
    value = float(rows[0][fixed])
    study.write(path, WITHIN.format(round(value, 9), round(value, 9) + 0.3))
    if run(program, path, out, ["--no-plots"]).returncode in (0, 4):
        rows = [row for row in rows_of(out / "s_responses.csv") if row["status"] == "0"]
        if any(row["within"] != "1" for row in rows):
            faults.append(f"{sum(row['within'] == '1' for row in rows)} of {len(rows)} within a limit that is touched")
    return True


def check_equal(program, rng, folder, faults):
    """Corresponding rates of both sides have equal shares of the roll rate."""
    name = rng.choice(["mcpherson_axle", "double_wishbone_axle", "trailing_arm_axle"])
    path, out = folder / "equal.nml", folder / "equal"
    path.write_text(f"""&study name = 's', kind = 'tolerance', samples = 8, deck = '{TOP}/input/{name}/{name}.nml', case = 'roll',
  increments = 8 /
&factor name = 'left', path = 'spring.left_coil.rate', change = 'scale', tolerance = 0.1 /
&factor name = 'right', path = 'spring.right_coil.rate', change = 'scale', tolerance = 0.1 /
&response name = 'rate', column = 'suspension_roll_rate_nm_per_deg' /
""")
    done = run(program, path, out, ["--no-plots"])
    if done.returncode != 0:
        faults.append(f"equal factors: status {done.returncode}: {done.stderr[-300:]}")
        return
    first = [float(row["first"]) for row in rows_of(out / "s_shares.csv")]
    if abs(first[0] - first[1]) > 1e-7 or first[0] < 0.4:
        faults.append(f"shares of two factors of equal influence on {name}: {first}")


def check_values(program, rng, folder, faults):
    """Morris' effects of `values` on a response that equals the factor."""
    values = [round(rng.uniform(-0.5, 0.5), 3) for _ in range(rng.randrange(2, 7))]
    if max(values) - min(values) < 0.05:
        return
    path, out = folder / "values.nml", folder / "values"
    path.write_text(f"""&study name = 's', kind = 'morris', samples = 6, levels = {rng.choice([2, 4, 6, 8])}, increments = 2,
  deck = '{TOP}/input/mcpherson_axle/mcpherson_axle.nml', case = 'parallel_travel' /
&factor name = 'toe', path = 'wheel.left.toe', values = {', '.join(map(str, values))} /
&factor name = 'camber', path = 'wheel.left.camber', lower = -1, upper = 0 /
&response name = 't', column = 'left_toe_deg' /
""")
    done = run(program, path, out)
    rows = [r for r in tables_of((out / "s.html").read_text(), "effects") if r and r[0] == "toe"] if done.returncode == 0 else []
    if not rows or abs(number(rows[0][1]) - (max(values) - min(values))) > 6e-5 or number(rows[0][2]) > 1e-9:
        faults.append(f"Morris with values {values}: {rows}, status {done.returncode}")


def check_plain(program, rng, folder, faults):
    """Plain Sobol' points of normal factors, in quantiles: the middle of cells."""
    samples = rng.choice([8, 16, 50, 64])
    path, out = folder / "plain.nml", folder / "plain"
    path.write_text(f"""&study name = 's', kind = 'sobol', samples = {samples}, scrambled = .false., increments = 2,
  deck = '{TOP}/input/mcpherson_axle/mcpherson_axle.nml', case = 'parallel_travel' /
&factor name = 'toe', path = 'wheel.left.toe', distribution = 'normal', nominal = 0.1, deviation = 0.04 /
&factor name = 'camber', path = 'wheel.left.camber', distribution = 'normal', nominal = 0.0, deviation = 0.1 /
&response name = 't', column = 'left_toe_deg' /
""")
    done = run(program, path, out, ["--no-plots"])
    if done.returncode != 0:
        faults.append(f"plain Sobol' points: status {done.returncode}: {done.stderr[-300:]}")
        return
    cells = 2 ** math.ceil(math.log2(samples))
    for row in rows_of(out / "s_responses.csv"):
        quantile = NormalDist(0.1, 0.04).cdf(float(row["toe_deg"]))*cells
        if abs(quantile % 1 - 0.5) > 1e-6:
            faults.append(f"plain Sobol' points: {row['toe_deg']} of {samples}")
            return


def main():
    program = str(Path(sys.argv[1]).resolve())
    studies = int(sys.argv[2]) if len(sys.argv) > 2 else 100
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    passed = failed = skipped = 0
    os.environ["LC_ALL"] = "C"
    for number_of in range(studies):
        rng = random.Random(f"{seed} {number_of}")
        faults = []
        with tempfile.TemporaryDirectory(prefix="elastokin_laws_") as name:
            folder = Path(name)
            study = Study(rng, number_of)
            if not check_random(program, study, folder, faults):
                skipped += 1
                continue
            if number_of % 8 == 0:
                for check in (check_equal, check_values, check_plain):
                    check(program, rng, folder, faults)
            passed += not faults
            failed += bool(faults)
            for fault in faults:
                print(f"study {number_of}: {fault}")
            if faults:
                study.write(folder / "study.nml")
                print((folder / "study.nml").read_text())
    print(f"{skipped} skipped")
    print(f"{passed} passed, {failed} failed")
    sys.exit(1 if failed or passed < studies//2 else 0)


if __name__ == "__main__":
    main()
