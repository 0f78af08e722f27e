#!/usr/bin/env python3
"""sbom.py VERSION FOLDER: prints what the files of a release in FOLDER contain besides elastokin, as CycloneDX 1.5: versions, licences
and checksums, for tools/release.sh. Versions of parts from Debian packages are those of this machine.
"""
import hashlib
import json
import re
import subprocess
import sys
from pathlib import Path

top = Path(__file__).resolve().parents[1]
version, folder = sys.argv[1], Path(sys.argv[2])
sources = dict(re.findall(r"(?m)^(\w+)=(\S+)$", (top / "packaging/wasm/versions.sh").read_text()))


def debian(package):
    """The version of an installed package."""
    found = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", package], text=True, capture_output=True)
    if found.returncode != 0 or not found.stdout:
        sys.exit(f"sbom: the package {package} is not installed, but a file of the release contains a part of it")
    return found.stdout


page, any_wheel, native_wheel, programs = "elastokin.html", "*-py3-none-any.whl", "*manylinux*.whl", "elastokin*.deb elastokin-*-Linux-*.tar.gz"
gcc = "GPL-3.0-or-later WITH GCC-exception-3.1"
# name, version, licence, where it is from, files that contain it
parts = [
    ("Sobol numbers by Kuo and Joe", "new-joe-kuo-6", "BSD-3-Clause", None, [page, any_wheel, native_wheel, programs]),
    ("openblas", debian("libopenblas-dev"), "BSD-3-Clause", "pkg:deb/debian/libopenblas-dev", [native_wheel, programs]),
    ("libgfortran", debian("libgfortran5"), gcc, "pkg:deb/debian/libgfortran5", [native_wheel]),
    ("libquadmath", debian("libquadmath0"), "LGPL-2.1-or-later", "pkg:deb/debian/libquadmath0", [native_wheel]),
    ("libgomp", debian("libgomp1"), gcc, "pkg:deb/debian/libgomp1", [native_wheel]),
    ("flang-rt", sources["llvm_version"], "Apache-2.0 WITH LLVM-exception", "pkg:generic/flang-rt", [page, any_wheel]),
    ("libc++", debian("libc++-22-dev-wasm32"), "Apache-2.0 WITH LLVM-exception", "pkg:deb/debian/libc%2B%2B-22-dev-wasm32", [page, any_wheel]),
    ("wasi-libc", debian("wasi-libc"), "Apache-2.0 WITH LLVM-exception AND MIT", "pkg:deb/debian/wasi-libc", [page, any_wheel]),
    ("lapack", sources["lapack_version"], "BSD-3-Clause", "pkg:generic/lapack", [page, any_wheel]),
]


# the packages of the editor; those only for development make it
locked = json.loads((top / "packaging/wasm/editor/package-lock.json").read_text())["packages"]
parts += [(path.removeprefix("node_modules/"), one["version"], one["license"], "pkg:npm/" + path.removeprefix("node_modules/").replace("@", "%40"), [page, any_wheel])
          for path, one in locked.items() if path and not one.get("dev")]


def files_of(patterns):
    """The files of the release that patterns name; each pattern names at least one."""
    found = []
    for pattern in " ".join(patterns).split():
        names = sorted(path.name for path in folder.glob(pattern))
        if not names:
            sys.exit(f"sbom: {folder} has no file {pattern}")
        found += names
    return found


def component(name, number, licence, origin, patterns):
    found = {"type": "library", "bom-ref": re.sub(r"[^a-z0-9]+", "-", name.lower()), "name": name, "version": number,
             "licenses": [{"expression": licence}]}
    if origin:
        found["purl"] = f"{origin}@{number}"
    found["properties"] = [{"name": "elastokin:contained_in", "value": file} for file in files_of(patterns)]
    return found


files = [{"type": "file", "bom-ref": f"file-{path.name}", "name": path.name,
          "hashes": [{"alg": "SHA-256", "content": hashlib.sha256(path.read_bytes()).hexdigest()}]}
         for path in sorted(folder.iterdir()) if not path.name.endswith(".cdx.json")]
commit = subprocess.run(["git", "-C", top, "rev-parse", "HEAD"], text=True, capture_output=True).stdout.strip()
print(json.dumps({
    "bomFormat": "CycloneDX", "specVersion": "1.5", "version": 1,
    "metadata": {"component": {"type": "application", "bom-ref": "elastokin", "name": "elastokin", "version": version,
                               "licenses": [{"expression": "BSD-3-Clause"}], "properties": [{"name": "elastokin:commit", "value": commit}]}},
    "components": [component(*part) for part in parts] + files,
}, indent=2))
