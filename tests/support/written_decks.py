#!/usr/bin/env python3
"""written_decks.py PROGRAM [DECKS [SEED]]: laws of the deck as used, with random variants of the decks of the library.

Each variant gets random marker axes and preloads of its bushings, and random settings of both sides or of one side. Laws:
- `check --write-deck` writes a deck that gives the same tables, to the last bit;
- a written deck that is written again is the same file.
A variant that is rejected counts as skipped. The last line is `N passed, N failed`.
"""
import random
import re
import subprocess
import sys
import tempfile
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]


def run(program, *arguments):
    return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, cwd=TOP, timeout=300, check=False)


def triple(values):
    return ", ".join(f"{value:.9g}" for value in values)


def direction(rng):
    way = rng.random()
    if way < 0.35:
        v = [0.0, 0.0, 0.0]
        v[rng.randrange(3)] = rng.choice([-1.0, 1.0])
        return v
    v = [rng.gauss(0, 1) for _ in range(3)]
    if way < 0.6:
        v[1] = 0.0
    return v


def axes(rng, points):
    keys = []
    for name in "zx":
        way = rng.randrange(4)
        if way == 1 and len(points) > 1:
            a, b = rng.sample(points, 2)
            keys.append(f"{name}_axis = '{a}', '{b}'")
        elif way > 1:
            keys.append(f"{name}_vector = {triple(direction(rng))}")
    return keys


def variant(text, rng):
    """The deck with random axes and preloads of its bushings."""
    points = re.findall(r"&point\s+name\s*=\s*'([^']+)'", text)

    def change(match):
        record = match.group(0)
        if rng.random() < 0.3:
            return record
        record = re.sub(r"[zx]_(axis|vector)\s*=\s*(('[^']*'|[-+.\deE]+)\s*,\s*)*('[^']*'|[-+.\deE]+)\s*,?", "", record)
        keys = axes(rng, points)
        if rng.random() < 0.5 and "preload_force" not in record:
            keys.append(f"preload_force = {triple([rng.gauss(0, 50) for _ in range(3)])}")
        if rng.random() < 0.5 and "preload_moment" not in record:
            keys.append(f"preload_moment = {triple([rng.gauss(0, 500) for _ in range(3)])}")
        head = record[: record.rindex("/")].rstrip().rstrip(",")
        return head + "".join(", " + key for key in keys) + "\n/"

    return re.sub(r"&bushing\b(?:'[^']*'|[^'/])*/", change, text)


def settings(rng, text):
    found = []
    points = re.findall(r"&point\s+name\s*=\s*'([^']+)'\s*,\s*at\s*=\s*[-+.\d]+\s*,\s*-[1-9]", text)
    bushings = re.findall(r"&bushing\s+name\s*=\s*'([^']+)'", text)
    for _ in range(rng.randrange(4)):
        side = rng.choice(["", "", "left_", "right_"])
        kind = rng.randrange(4)
        if kind == 0 and points:
            found.append(f"point.{side}{rng.choice(points)}.{rng.choice('xz')}=+{rng.uniform(-1, 1):.4f}")
        elif kind == 1 and bushings:
            found.append(f"bushing.{side}{rng.choice(bushings)}.preload_force({rng.randrange(1, 4)})={rng.uniform(-20, 20):.4f}")
        elif kind == 2:
            found.append(f"wheel.{rng.choice(['left', 'left_left', 'right'])}.camber={rng.uniform(-1, 1):.4f}")
        elif bushings:
            found.append(f"bushing.{side}{rng.choice(bushings)}.kr(2)=*{rng.uniform(0.9, 1.1):.4f}")
    return [part for setting in found for part in ("--set", setting)]


def rows(folder):
    files = sorted(Path(folder).glob("*.csv"))
    return [[line for line in file.read_text().splitlines() if not line.startswith("#")] for file in files]


def main():
    program = str(Path(sys.argv[1]).resolve())
    wanted = int(sys.argv[2]) if len(sys.argv) > 2 else 100
    rng = random.Random(int(sys.argv[3]) if len(sys.argv) > 3 else 20261129)
    library = sorted(path for path in TOP.glob("input/*/*.nml") if "&model" in path.read_text())
    passed = failed = skipped = 0
    for k in range(wanted):
        source = library[k % len(library)]
        text = variant(source.read_text(), rng)
        with tempfile.TemporaryDirectory(dir=source.parent if "&include" in text or "file" in text else None) as folder:
            folder = Path(folder)
            if folder.parent == source.parent:      # names of other files are relative to the deck
                text = re.sub(r"file\s*=\s*'(?=[^/'])", "file = '../", text)
            (folder / "deck.nml").write_text(text)
            options = settings(rng, text)
            done = run(program, "check", folder / "deck.nml", *options, "--write-deck", folder / "used.nml")
            if done.returncode != 0 or not (folder / "used.nml").exists():
                skipped += 1
                continue
            words = f"{source.relative_to(TOP)}, variant {k}, {' '.join(options)}"
            wrong = []
            for name, deck, more in (("a", "deck.nml", options), ("b", "used.nml", [])):
                run(program, "run", folder / deck, *more, "--increments", 3, "--quiet", "--out", folder / name)
            if rows(folder / "a") != rows(folder / "b") or not rows(folder / "a"):
                wrong.append("the tables differ")
            run(program, "check", folder / "used.nml", "--write-deck", folder / "again.nml")
            if (folder / "again.nml").read_text() != (folder / "used.nml").read_text():
                wrong.append("written again, the deck is another file")
            passed += not wrong
            failed += bool(wrong)
            for line in wrong:
                print(f"{words}: {line}")
    print(f"{skipped} variants were rejected")
    print(f"{passed} passed, {failed} failed")
    return failed > 0 or passed < wanted // 2


if __name__ == "__main__":
    sys.exit(main())
