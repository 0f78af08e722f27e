#!/usr/bin/env python3
"""check_release.py FOLDER: what tools/release.sh wrote: every kind of file, equal metadata of both wheels, no file of one wheel that
contradicts the other, the sources of the commit, and an SBOM that names every file. Exit status 1 with a line per failure.
"""
import hashlib
import json
import re
import sys
import tarfile
import zipfile
from pathlib import Path

top = Path(__file__).resolve().parents[2]
folder = Path(sys.argv[1])
failures = []


def require(is_good, text):
    if not is_good:
        failures.append(text)


def only(pattern):
    found = sorted(folder.glob(pattern))
    require(len(found) == 1, f"{pattern}: {[path.name for path in found]}")
    return found[0] if found else None


version = re.search(r"project\(elastokin VERSION ([0-9.]+)", (top / "CMakeLists.txt").read_text()).group(1)
page, sbom, source = only("elastokin.html"), only("*.cdx.json"), only(f"elastokin-{version}.tar.gz")
wheels = {"any": only(f"elastokin-{version}-py3-none-any.whl"), "native": only(f"elastokin-{version}-py3-none-manylinux*.whl")}
programs = only(f"elastokin-{version}-Linux-*.tar.gz")
require(page is not None and page.stat().st_size < 5e6, "the page has more than 5 MB")
require(len(list(folder.glob("*.deb"))) >= 4, "Debian packages are missing")

parts = {}
for kind, path in wheels.items():
    if path:
        with zipfile.ZipFile(path) as archive:
            require(archive.testzip() is None, f"{path.name} is damaged")
            parts[kind] = {name: archive.read(name) for name in archive.namelist()}
if len(parts) == 2:
    facts = f"elastokin-{version}.dist-info"
    for name in ("METADATA", "entry_points.txt"):
        found = [[line for line in contents[f"{facts}/{name}"].decode().splitlines() if line] for contents in parts.values()]
        require(found[0] == found[1], f"{name} of both wheels: {[line for line in found[0] + found[1] if (line in found[0]) != (line in found[1])]}")
    for name in parts["any"].keys() & parts["native"].keys():
        require(not name.endswith(".py") or parts["any"][name] == parts["native"][name], f"{name} is not the same in both wheels")
    require("elastokin/elastokin.wasm" in parts["any"], "no elastokin.wasm in the wheel for all systems")
    require(any("libelastokin" in name for name in parts["native"]), "no library in the native wheel")

for path in (source, programs):
    if path:
        with tarfile.open(path) as archive:
            names = archive.getnames()
        wanted = "CMakeLists.txt" if path == source else "bin/elastokin"
        require(any(name.endswith(f"/{wanted}") for name in names), f"{path.name} has no {wanted}")
if sbom:
    components = json.loads(sbom.read_text())["components"]
    known = {part["name"]: part["hashes"][0]["content"] for part in components if part["type"] == "file"}
    files = [path for path in folder.iterdir() if path.name not in ("SHA256SUMS", sbom.name)]
    require(set(known) == {path.name for path in files}, f"the SBOM names {sorted(known)}")
    for path in files:
        require(known.get(path.name) == hashlib.sha256(path.read_bytes()).hexdigest(), f"the SBOM has another checksum of {path.name}")
    require(all(part["version"] and part["licenses"] for part in components if part["type"] != "file"), "a part without version or licence")
for text in failures:
    print(f"FAILED: {text}")
print(f"a release of {len(list(folder.iterdir()))} files: {len(failures)} failures")
sys.exit(bool(failures))
