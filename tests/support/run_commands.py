#!/usr/bin/env python3
"""run_commands.py PAGE.md...: every `elastokin` or `elastokin-bench` command in the blocks of these pages ends with status 0, with `elastokin` from the PATH.

The commands run in a temporary folder, where `input` and `tests` are those of the repository. DECK, axle.nml and front.nml are the deck of
the McPherson front axle, params.in has one setting, and points.csv is a table of hardpoints. Commands with files that a user writes (STUDY.nml, FIT.nml) or with another
placeholder in capitals are left out and counted.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile

top = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def commands(page):
    """Indented commands of a page, with their lines; a line that ends with a backslash or a bar continues."""
    lines = open(page, encoding="utf-8").read().split("\n")
    k = 0
    while k < len(lines):
        first, text = k + 1, lines[k]
        while text.startswith(("    elastokin ", "    elastokin-bench ")) and text.rstrip().endswith(("\\", "|")):
            k += 1
            text = text.rstrip().rstrip("\\") + " " + lines[k].strip()
        if text.startswith(("    elastokin ", "    elastokin-bench ")):
            yield first, text.strip()
        k += 1


def main():
    wrong = done = omitted = 0
    with tempfile.TemporaryDirectory() as folder:
        for name in ("input", "tests"):
            os.symlink(os.path.join(top, name), os.path.join(folder, name))
        deck = os.path.join(top, "input/mcpherson_axle/mcpherson_axle.nml")
        for name in ("DECK", "axle.nml", "front.nml"):
            shutil.copy(deck, os.path.join(folder, name))
        shutil.copy(os.path.join(top, "tests/formats/files/corners.csv"), os.path.join(folder, "points.csv"))
        with open(os.path.join(folder, "params.in"), "w", encoding="utf-8") as file:
            file.write("spring.coil.rate = 31\n")
        for page in sys.argv[1:]:
            for line, command in commands(page):
                if re.search(r"\b(?!DECK\b|DIR\b)[A-Z]{3,}\b", command.split("#")[0].replace("EK_", "")) or "mpirun" in command:
                    omitted += 1
                    continue
                run = subprocess.run(["bash", "-o", "pipefail", "-c", command], cwd=folder, capture_output=True, text=True, check=False)
                done += 1
                if run.returncode != 0:
                    wrong += 1
                    print(f"{page}:{line}: status {run.returncode}: {command}", run.stderr, sep="\n")
    print(f"{done} commands, {wrong} wrong, {omitted} omitted")
    return 1 if wrong or not done else 0


sys.exit(main())
