#!/usr/bin/env python3
"""make_wheel.py FOLDER: writes FOLDER/elastokin-<version>-py3-none-any.whl, the Python package with FOLDER/elastokin.wasm in place of
the compiled library, for every system that has Python and wasmtime. Its metadata are those of the wheel with the library, which pip
prefers where it fits. The same files give the same bytes.
"""
import base64
import hashlib
import re
import sys
import tomllib
import zipfile
from pathlib import Path

top = Path(__file__).resolve().parents[2]
folder = Path(sys.argv[1])
version = re.search(r"project\(elastokin VERSION ([0-9.]+)", (top / "CMakeLists.txt").read_text()).group(1)
facts = f"elastokin-{version}.dist-info"
project = tomllib.loads((top / "python/pyproject.toml").read_text())["project"]


def metadata():
    """METADATA as scikit-build-core writes it; .ci/deep compares both."""
    lines = [f"Metadata-Version: 2.1\nName: {project['name']}\nVersion: {version}\nSummary: {project['description']}"]
    lines.append(f"License: {project['license']['text']}")
    lines += [f"Classifier: {word}" for word in project["classifiers"]]
    lines.append(f"Requires-Python: {project['requires-python']}")
    lines += [f"Requires-Dist: {word}" for word in project["dependencies"]]
    for extra, words in project["optional-dependencies"].items():
        lines += [f"Provides-Extra: {extra}", *(f'Requires-Dist: {word}; extra == "{extra}"' for word in words)]
    return "\n".join([*lines, "Description-Content-Type: text/markdown", "", (top / "python" / project["readme"]).read_text()])


sources = sorted((top / "python/src").glob("elastokin*/*.py"))
contents = {f"{path.parent.name}/{path.name}": path.read_bytes() for path in sources}
contents |= {
    "elastokin/py.typed": b"",
    "elastokin/LICENSE": (top / "LICENSE").read_bytes(),
    "elastokin/workbench.html": (folder / "workbench.html").read_bytes(),
    "elastokin/elastokin.wasm": (folder / "elastokin.wasm").read_bytes(),
    f"{facts}/licenses/LICENCES.txt": (folder / "LICENCES.txt").read_bytes(),
    f"{facts}/METADATA": metadata().encode(),
    f"{facts}/WHEEL": b"Wheel-Version: 1.0\nGenerator: make_wheel.py\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
    f"{facts}/entry_points.txt": "".join(["[console_scripts]\n", *(f"{k} = {v}\n" for k, v in project["scripts"].items())]).encode(),
}


def sum_of(content):
    return base64.urlsafe_b64encode(hashlib.sha256(content).digest()).decode().rstrip("=")


record = f"{facts}/RECORD"
lines = [f"{path},sha256={sum_of(content)},{len(content)}" for path, content in contents.items()]
contents[record] = "\n".join([*lines, f"{record},,", ""]).encode()
wheel = folder / f"elastokin-{version}-py3-none-any.whl"
with zipfile.ZipFile(wheel.with_suffix(".new"), "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
    for path, content in contents.items():
        entry = zipfile.ZipInfo(path)
        entry.compress_type = zipfile.ZIP_DEFLATED
        entry.external_attr = 0o644 << 16
        archive.writestr(entry, content)
wheel.with_suffix(".new").rename(wheel)
print(wheel)
