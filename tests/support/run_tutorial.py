#!/usr/bin/env python3
"""run_tutorial.py [--renew] PAGE.md: follows a page letter by letter in an empty folder, with `elastokin` from the PATH.

A block after `<!-- file: NAME -->` is saved as NAME. In a block ```console a line that begins with `$ ` is a command; the lines up to the
next one are what it must print, in a terminal. A line `…` stands for any lines. Numbers may differ by 1e-6 of their size, or by 1e-9,
which is rounding; everything else must be the same. Every command must end with status 0.

With --renew what is shown is replaced by what is printed, except after a command whose output contains `…`.
"""
import os
import pty
import re
import subprocess
import sys
import tempfile

number = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


def run(command, folder):
    """What a command prints on a terminal, as lines, and its status."""
    ours, theirs = pty.openpty()
    process = subprocess.Popen(["sh", "-c", command], cwd=folder, stdin=subprocess.DEVNULL, stdout=theirs, stderr=theirs)
    os.close(theirs)
    text = b""
    while True:
        try:
            piece = os.read(ours, 65536)
        except OSError:      # the other end is closed
            break
        if not piece:
            break
        text += piece
    os.close(ours)
    return text.decode("utf-8").replace("\r\n", "\n").splitlines(), process.wait()


def same_line(shown, found):
    if number.sub("#", shown) != number.sub("#", found):
        return False
    pairs = zip(number.findall(shown), number.findall(found), strict=True)
    return all(abs(float(a) - float(b)) <= max(1e-9, 1e-6 * abs(float(a))) for a, b in pairs)


def same(shown, found):
    if not shown:
        return not found
    if shown[0] == "…":
        return any(same(shown[1:], found[k:]) for k in range(len(found) + 1))
    return bool(found) and same_line(shown[0], found[0]) and same(shown[1:], found[1:])


def main():
    renew = sys.argv[1] == "--renew"
    page = os.path.abspath(sys.argv[-1])
    lines = open(page, encoding="utf-8").read().split("\n")
    result, wrong, commands, k = [], 0, 0, 0
    with tempfile.TemporaryDirectory() as folder:
        while k < len(lines):
            line = lines[k]
            result.append(line)
            k += 1
            name = re.match(r"<!-- file: ([\w.]+) -->$", line)
            if name:
                assert lines[k].startswith("```"), f"line {k + 1}: a block must follow"
                end = lines.index("```", k + 1)
                with open(os.path.join(folder, name[1]), "w", encoding="utf-8") as file:
                    file.write("\n".join(lines[k + 1:end]) + "\n")
                result += lines[k:end + 1]
                k = end + 1
            elif line == "```console":
                while lines[k] != "```":
                    assert lines[k].startswith("$ "), f"line {k + 1}: a command must follow"
                    at, command = k + 1, lines[k][2:]
                    k += 1
                    shown = []
                    while lines[k] != "```" and not lines[k].startswith("$ "):
                        shown.append(lines[k])
                        k += 1
                    found, status = run(command, folder)
                    commands += 1
                    result += ["$ " + command] + (shown if "…" in shown else found)
                    if status != 0:
                        print(f"{page}:{at}: status {status}: {command}", *found, sep="\n    ")
                        wrong += 1
                    elif not renew and not same(shown, found):
                        print(f"{page}:{at}: {command}", "  shown:", *shown, "  found:", *found, sep="\n    ")
                        wrong += 1
    if renew:
        with open(page, "w", encoding="utf-8") as file:
            file.write("\n".join(result))
    print(f"{os.path.basename(page)}: {commands} commands, {wrong} wrong")
    return 1 if wrong or not commands else 0


sys.exit(main())
