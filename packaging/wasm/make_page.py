#!/usr/bin/env python3
"""make_page.py FOLDER: writes FOLDER/elastokin.html, with FOLDER/elastokin.wasm, the library of decks and all licences inside, and
FOLDER/LICENCES.txt, for tools/wasm.sh. EK_LLVM and EK_LAPACK name the folders with the sources of what the program is linked with,
EK_EDITOR names the folder with the editor component.
"""
import base64
import gzip
import html
import json
import os
import re
import sys
from pathlib import Path

here = Path(__file__).resolve().parent
top = here.parents[1]
folder = Path(sys.argv[1])
largest = 5_000_000
documents, common = Path("/usr/share/doc"), Path("/usr/share/common-licenses")

licences = [
    ("elastokin", top / "LICENSE"),
    ("Fortran runtime and C++ library of LLVM", Path(os.environ["EK_LLVM"]) / "flang-rt/LICENSE.TXT"),
    ("wasi-libc, with musl", documents / "wasi-libc/copyright"),
    ("CC0 1.0, named above", common / "CC0-1.0"),
    ("Apache License 2.0, named above", common / "Apache-2.0"),
    ("LAPACK and BLAS", Path(os.environ["EK_LAPACK"]) / "LICENSE"),
    ("CodeMirror, the editor of elastokin.html, and the packages that it uses", Path(os.environ["EK_EDITOR"]) / "LICENCES.txt"),
]


def licence_texts():
    module = (top / "src/math/ek_sobol_numbers.f90").read_text()
    numbers = re.search(r"!> Copyright.*?direct.*?possibility of such damage\.\n", module, re.S)
    if not numbers:
        sys.exit("make_page: src/math/ek_sobol_numbers.f90: its licence was not found")
    texts = [(title, path.read_text()) for title, path in licences]
    texts.insert(1, ("Numbers of Sobol sequences, by Kuo and Joe", re.sub(r"(?m)^!> ?", "", numbers.group())))
    return "\n".join(f"{'=' * 100}\n{title}\n{'=' * 100}\n\n{text.strip()}\n" for title, text in texts)


def decks():
    """The models of the library, each with the files of its folder."""
    found = []
    for path in sorted((top / "input").glob("*/*.nml")):
        text = path.read_text()
        model = re.search(r"(?im)^\s*&model\b[^/]*", text)
        if not model:
            continue
        title = re.search(r"title\s*=\s*'((?:[^']|'')*)'", model.group())
        near = [other for other in sorted(path.parent.iterdir()) if other.suffix in (".nml", ".csv")]
        found.append({"name": path.stem, "deck": path.name, "title": title.group(1).replace("''", "'") if title else "",
                      "files": [[other.name, other.read_text()] for other in near]})
    return found


def in_script(text):
    """A text inside a script element: it must not end the element."""
    return text.replace("</", "<\\/").replace("<!--", "<\\!--")


def source(name):
    return (here / "page" / name).read_text()


def editor():
    """The editor component as the content of a script element."""
    text = (Path(os.environ["EK_EDITOR"]) / "editor.js").read_text()
    if re.search(r"</script|<!--", text, re.I):
        sys.exit("make_page: the editor component cannot be put into a script element")
    return text


texts = licence_texts()
(folder / "LICENCES.txt").write_text(texts)
program = base64.b64encode(gzip.compress((folder / "elastokin.wasm").read_bytes(), 9, mtime=0)).decode()
parts = {
    "STYLE": source("page.css"),
    "VERSION": re.search(r"project\(elastokin VERSION ([0-9.]+)", (top / "CMakeLists.txt").read_text()).group(1),
    "LICENCES": html.escape(texts),
    "DECKS": in_script(json.dumps(decks(), ensure_ascii=False)),
    "EDITOR": editor(),
    # one script: a worker of a page without a server loads no other
    "WORKER": re.sub(r"(?m)^export ", "", source("wasi.mjs")) + source("library.js") + source("worker.js"),
    "SCRIPT": "".join(source(f"{name}.js") for name in ("page", "deck", "editor", "workbench", "views", "tables", "curves", "ask", "compare", "start")),
}
frame = re.sub(r"@([A-Z]+)@", lambda found: parts.get(found.group(1), found.group()), source("page.html"))
page = frame.replace("@FOLDER@", "null").replace("@PROGRAM@", program)
size = len(page.encode())
if size > largest:
    sys.exit(f"make_page: the page has {size} bytes, more than {largest}")
(folder / "workbench.html").write_text(frame)          # without the program, for the Python package
(folder / "elastokin.html.new").write_text(page)
(folder / "elastokin.html.new").rename(folder / "elastokin.html")
