#!/usr/bin/env python3
"""compare_programs.py PROGRAM RUNNER FOLDER: the native program and the WebAssembly program run the same commands, in node with
page/wasi.mjs (RUNNER: elastokin.wasm), in headless Chromium (RUNNER: elastokin.html, needs playwright), or as the program `elastokin` of
the wheel (RUNNER: this program).

Commands: `check`, `run`, `report`, and in node also `explain`, for every deck of the library; in node `check` of every deck in
tests/decks, most of which have an error; and one or two of each other command. FOLDER receives the files of both programs.

Required of each command: the exit status, the messages, and standard output are equal but for digits; those of `check` are equal.
Each has the same tables, with equal strings and flags, and iterations that differ by at most one where a state converged. Numbers
may differ by 1e-10 of the largest number of their kind (unit) in the table, which counts as at least 1 for the units in
`counts_as_one` and without a unit; or more for a command in `tolerances` and a column in `cancelled`. Prints the largest
difference per command; exit status 1 with a line per failure.
"""
import csv
import json
import math
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

top = Path(__file__).resolve().parents[2]
program, runner, folder = (Path(word).absolute() for word in sys.argv[1:4])
in_browser, in_node = runner.suffix == ".html", runner.suffix == ".wasm"
failures = []

number = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
# a unit at the end of a column heading
unit = re.compile(r"_((?:deg|rad|mm|m|kn|n|nm|knm|percent|hz|kg|s)(?:_per_[a-z0-9_]+)?)$")
tolerances = {"derivatives": 1e-6, "fit": 1e-6, "solve": 1e-6, "explain": 1e-9}
ordinary = 1e-10
# forces, moments, displacements and slopes that are zero but for rounding
counts_as_one = {"n", "nm", "mm", "N", "N m", "deg/m"}
# Forces that cancel, (table, column), and by how many N they may differ: the clamps of a twist beam carry the bending of a stiff beam
cancelled = {(r"^twist_beam_axle/\w+/(twist_beam_axle_)?aligning_torque", r"\w+_beam_f[xyz]_n"): 1e-6,
             (r"^twist_beam_axle/report/windows/", r"\w+_beam_f[xyz]_n"): 1e-6}       # five states near design: small forces
# checksums of files with other digits; orders and numbers of terms of equal size, which rounding decides
not_compared = re.compile(r".*-files\.csv|_contributions\.csv|explain/.*")
# where a curve has its largest difference: at several points of the same size, rounding decides
not_compared_columns = {"at"}


fit = """&fit    name = 'bump', deck = 'input/mcpherson_axle/mcpherson_axle.nml', case = 'parallel_travel' /
&factor name = 'rod_z', path = 'point.tie_rod_inner.z', lower = -75.0, upper = -50.0 /
&target name = 'steer', quantity = 'left_bump_steer', value = 1.0, deviation = 0.2 /
"""
mechanism = """&model name = 'loose' /
&point name = 'a', at = 0, 0, 0 /
&point name = 'b', at = 0, 500, 0 /
&body name = 'arm' /
&joint name = 'ball', type = 'spherical', bodies = 'chassis', 'arm', at = 'a' /
&load name = 'weight', body = 'arm', at = 'b', force = 0, 0, 100, factor = 'case' /
&case name = 'sweep', load = 'weight', from = 0, to = 1 /
"""


def deck_files():
    return [p.relative_to(top) for p in sorted((top / "input").glob("*/*.nml")) if re.search(r"(?im)^\s*&model\b", p.read_text())]


def commands():
    """The command lines, with the name of each folder of results."""
    found = []
    for deck in map(str, deck_files()):
        name = Path(deck).stem
        found += [["check", deck], ["run", deck, "--increments", "20", "--out", f"out/{name}/run"],
                  ["report", deck, "--no-plots", "--increments", "20", "--out", f"out/{name}/report"]]
        if in_browser:
            continue
        found.append(["explain", deck, "--increments", "4", "--out", f"out/{name}/explain"])
    if in_browser:
        return found
    found += [["check", f"tests/decks/{p.name}"] for p in sorted((top / "tests/decks").glob("*.nml"))]
    corner, axle = "input/mcpherson/mcpherson.nml", "input/mcpherson_axle/mcpherson_axle.nml"
    for study in ("hardpoint_tolerance", "what_matters"):
        found.append(["study", f"studies/{study}/study.nml", "--samples", "16", "--out", f"out/{study}/study"])
    for name in ("run_tie_rod", "snap_truss", "coarse_travel", "leaves_its_stop", "split"):     # lost and unstable states
        found.append(["run", f"tests/decks/{name}.nml", "--json", "--out", f"out/{name}/run"])
    vary = ["--vary", "point.tie_rod_inner.z=-80:-50"]
    found += [["derivatives", corner, "--out", "out/corner/derivatives"],
              ["solve", axle, *vary, "--for", "left_bump_steer=0"], ["solve", axle, *vary, "--for", "left_bump_steer=1000"],
              ["fit", "fit.nml", "--no-plots", "--out", "out/corner/fit"], ["check", "mechanism.nml"], ["run", "mechanism.nml"],
              ["export", axle, "--to", "csv", "--out", "out/corner/export"],
              ["report", corner, "--no-plots", "--set", "point.tie_rod_outer.z=+5", "--out", "out/softer/report"],
              ["compare", "out/mcpherson/report", "out/softer/report", "--no-plots", "--out", "out/softer/compare"],
              ["run", axle, "--increments", "20", "--json", "--out", "out/json/run"],
              ["check", "nowhere.nml"], ["run", corner, "--unknown"], ["--version"], ["run", "--help"]]
    return found


def run_program(lines, place, path=program):
    results = []
    environment = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "PATH": "/nonexistent", "EK_CACHE": str(folder / "cache")}
    if path != program:
        subprocess.run([path, "--version"], env=environment, capture_output=True, check=True)     # compiles
    for words in lines:
        done = subprocess.run([path, *words], cwd=place, capture_output=True, text=True, check=False, env=environment)
        results.append({"status": done.returncode, "output": done.stdout, "messages": done.stderr, "trap": None})
    return results


def run_in_node(lines, place):
    listed, made = place.parent / "commands.json", place.parent / "results.json"
    listed.write_text(json.dumps(lines))
    subprocess.run(["node", top / "packaging/wasm/run.mjs", runner, place, "--list", listed, made], check=True)
    return json.loads(made.read_text())


def run_in_browser(lines, place):
    """Through the function of the page that its buttons use, from file://, without a request."""
    from playwright.sync_api import sync_playwright

    results, asked, said = [], [], []
    files = {str(p.relative_to(place)): p.read_text() for p in place.rglob("*.nml")}
    with sync_playwright() as tool:
        path = next(p for p in map(shutil.which, ("chromium", "chromium-browser", "google-chrome")) if p)
        browser = tool.chromium.launch(executable_path=path, args=["--no-sandbox"])
        page = browser.new_page()
        page.on("request", lambda r: asked.append(r.url) if not r.url.startswith(("file:", "blob:", "data:")) else None)
        page.on("console", lambda m: said.append(m.text))
        page.on("pageerror", lambda e: said.append(str(e)))
        page.goto(runner.as_uri())
        for words in lines:
            result = page.evaluate("([words, files]) => elastokin.command(words, files)", [words, files])
            for name, text in result.pop("files").items():
                (place / name).parent.mkdir(parents=True, exist_ok=True)
                (place / name).write_text(text)
            results.append(result)
        browser.close()
    expect(not asked, f"the page requested {asked[:3]}")
    expect(not said, f"the page wrote to the console: {said[:3]}")
    return results


def expect(is_good, text):
    if not is_good:
        failures.append(text)


def shape(text):
    """A text without its numbers, and without the numbers of blanks that align them."""
    return re.sub(r"\s+", " ", number.sub("#", text))


def read_table(path):
    with path.open(newline="") as file:
        return list(csv.reader(line for line in file if not line.startswith("#")))


def kind_of(heading):
    found = unit.search(heading)
    return found.group(1) if found else heading


def compare_tables(name, a, b, limit):
    """The largest difference of two tables, as (value, table, column)."""
    if len(a) != len(b) or any(len(x) != len(y) for x, y in zip(a, b)):
        failures.append(f"{name}: the tables have other numbers of rows or columns")
        return (0.0, name, "")
    heading = a[0]
    expect(heading == b[0], f"{name}: other columns")
    units = heading.index("unit") if "unit" in heading else None
    kinds = [kind_of(title) for title in heading]

    def size_of(kind):
        found = largest.get(kind, 0.0)
        return max(1.0, found) if kind in heading or kind in ("", "1", "-") or kind in counts_as_one else found or 1.0

    gaps, largest = {}, {}                                   # by kind: (difference, where), largest number
    for line, (row, other) in enumerate(zip(a[1:], b[1:])):
        for k, (title, x, y) in enumerate(zip(heading, row, other)):
            u = as_number(x)
            kind = kinds[k] if units is None or units >= len(row) else row[units]
            if u is not None and math.isfinite(u) and abs(u) > largest.get(kind, 0.0):
                largest[kind] = abs(u)
            if x == y or title in not_compared_columns:
                continue
            v = as_number(y)
            if u is None or v is None or not (math.isfinite(u) and math.isfinite(v)):
                expect(u is None and v is None and shape(x) == shape(y), f"{name}: row {line}, {title}: '{x[:60]}' and '{y[:60]}'")
            elif title == "iterations":
                is_lost = "converged" in heading and row[heading.index("converged")] != "1"     # it was tried in many ways
                expect(abs(u - v) <= 1 or is_lost, f"{name}: row {line}: {x} and {y} iterations")
            elif is_cancelled(name, title, abs(u - v)):
                continue
            elif abs(u - v) > gaps.get(kind, (0.0,))[0]:
                gaps[kind] = (abs(u - v), f"{title} row {line}: {x} {y}")
    worst = max(((gap/size_of(kind), name, where) for kind, (gap, where) in gaps.items()), default=(0.0, name, ""))
    expect(worst[0] <= limit, f"{name}: {worst[2]} differ by {worst[0]:.1e}")
    return worst


def is_cancelled(name, column, gap):
    """Whether this is a force that cancels, and differs by no more than is stated [N]."""
    return any(gap <= most and re.search(table, name) and re.fullmatch(pattern, column) for (table, pattern), most in cancelled.items())


def as_number(cell):
    try:
        return float(cell)
    except ValueError:
        return None


def compare(lines, first, second, places):
    worst = {}
    for words, a, b in zip(lines, first, second):
        line = " ".join(words)
        expect(b["trap"] is None, f"{line}: WebAssembly stopped the program: {b['trap']}")
        expect(a["status"] == b["status"], f"{line}: status {a['status']} and {b['status']}")
        if words == ["--version"]:
            continue
        for stream in ("messages", "output"):
            x, y = (re.sub(r"^file://.*\n", "", one[stream], flags=re.M) for one in (a, b))      # no address in the root of WebAssembly
            if (x == y if words[0] == "check" else shape(x) == shape(y)) or (words[0] == "explain" and stream == "output"):
                continue
            other = next(((p, q) for p, q in zip(x.split("\n"), y.split("\n")) if shape(p) != shape(q)), (x[-80:], y[-80:]))
            failures.append(f"{line}: {stream}: '{other[0][:150]}' and '{other[1][:150]}'")
        if "--out" not in words:
            continue
        made = [place / words[words.index("--out") + 1] for place in places]
        tables = [sorted(str(p.relative_to(m)) for p in m.rglob("*.csv")) for m in made]
        expect(tables[0] == tables[1], f"{line}: other tables: {sorted(set(tables[0]) ^ set(tables[1]))[:5]}")
        for name in sorted(set(tables[0]) & set(tables[1])):
            title = f"{made[0].parent.name}/{made[0].name}/{name}"
            if not_compared.search(title):
                continue
            found = compare_tables(title, *(read_table(m / name) for m in made), tolerances.get(words[0], ordinary))
            count[0] += 1
            worst[words[0]] = max(worst.get(words[0], found), found)
    return worst


count = [0]
places = [folder / name for name in ("native", "browser" if in_browser else "node" if in_node else "wheel")]
for place in places:
    shutil.rmtree(place, ignore_errors=True)
    for name in ("input", "studies", "tests/decks"):
        shutil.copytree(top / name, place / name, ignore=shutil.ignore_patterns("*.png", "*.svg"))
    (place / "fit.nml").write_text(fit)
    (place / "mechanism.nml").write_text(mechanism)
os.environ["SOURCE_DATE_EPOCH"] = "0"
lines = commands()
first = run_program(lines, places[0])
if in_browser:
    second = run_in_browser(lines, places[1])
elif in_node:
    second = run_in_node(lines, places[1])
else:
    second = run_program(lines, places[1], runner)
for name, (value, table, column) in sorted(compare(lines, first, second, places).items()):
    print(f"{name}: {value:.1e} {table} {column}")
for text in failures:
    print(f"differs: {text}")
where = "Chromium" if in_browser else "node" if in_node else "the wheel"
print(f"{len(lines)} commands, {count[0]} tables: the program in {where} agrees with the native one"
      if not failures else f"{len(failures)} differences")
sys.exit(bool(failures))
