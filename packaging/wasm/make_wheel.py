#!/usr/bin/env python3
"""make_wheel.py FOLDER: writes FOLDER/elastokin_wasm-<version>-py3-none-any.whl, the command line of FOLDER/elastokin.wasm for every
system that has Python and wasmtime. The same files give the same bytes.
"""
import base64
import hashlib
import re
import sys
import zipfile
from pathlib import Path

here = Path(__file__).resolve().parent
top = here.parents[1]
folder = Path(sys.argv[1])
version = re.search(r"project\(elastokin VERSION ([0-9.]+)", (top / "CMakeLists.txt").read_text()).group(1)
name = "elastokin_wasm"
facts = f"{name}-{version}.dist-info"

contents = {
    f"{name}/__init__.py": (here / "wheel/__init__.py").read_bytes(),
    f"{name}/__main__.py": (here / "wheel/__main__.py").read_bytes(),
    f"{name}/elastokin.wasm": (folder / "elastokin.wasm").read_bytes(),
    f"{facts}/licenses/LICENCES.txt": (folder / "LICENCES.txt").read_bytes(),
    f"{facts}/METADATA": f"""Metadata-Version: 2.1
Name: elastokin-wasm
Version: {version}
Summary: Kinematics and compliance of vehicle suspensions: the command line for every system
License: BSD-3-Clause, and those of LICENCES.txt
Requires-Python: >=3.9
Requires-Dist: wasmtime>=30
Description-Content-Type: text/plain

The program elastokin as WebAssembly. `elastokin --help` describes it.
""".encode(),
    f"{facts}/WHEEL": b"Wheel-Version: 1.0\nGenerator: make_wheel.py\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
    f"{facts}/entry_points.txt": f"[console_scripts]\nelastokin = {name}:main\n".encode(),
}


def sum_of(content):
    return base64.urlsafe_b64encode(hashlib.sha256(content).digest()).decode().rstrip("=")


record = f"{facts}/RECORD"
lines = [f"{path},sha256={sum_of(content)},{len(content)}" for path, content in contents.items()]
contents[record] = "\n".join([*lines, f"{record},,", ""]).encode()
wheel = folder / f"{name}-{version}-py3-none-any.whl"
with zipfile.ZipFile(wheel.with_suffix(".new"), "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
    for path, content in contents.items():
        entry = zipfile.ZipInfo(path)
        entry.compress_type = zipfile.ZIP_DEFLATED
        entry.external_attr = 0o644 << 16
        archive.writestr(entry, content)
wheel.with_suffix(".new").rename(wheel)
print(wheel)
