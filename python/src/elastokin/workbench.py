"""python -m elastokin.workbench [FOLDER | DECK]: opens the workbench in the browser, with the decks of a folder.

The workbench is one page that contains the program. FOLDER (default: the working folder) is read with its subfolders: decks, tables
and property files. Of several decks, the first is open, or DECK. The page changes no file: "Save" in the page writes a download.
`--write FILE` writes the page to a file instead of opening it.
"""

from __future__ import annotations

import argparse
import base64
import gzip
import hashlib
import json
import sys
import tempfile
import webbrowser
from pathlib import Path

from ._cache import cache_folder

_SUFFIXES = frozenset(".nml .csv .txt .dat .json .tir .bus .spr .dpr .bum .reb .arb .kin .gum .lcf .sub .asy .set".split())
_LARGEST = 5_000_000         # bytes of all files


def files_of(folder: Path) -> list[tuple[str, str]]:
    """The files that a deck can name, with their paths in the folder and their contents. Hidden folders are left out.

    Raises ValueError if they are too large for a page.
    """
    found, size = [], 0
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder)
        if path.suffix.lower() not in _SUFFIXES or any(part.startswith(".") for part in name.parts) or not path.is_file():
            continue
        size += path.stat().st_size
        if size > _LARGEST:
            raise ValueError(f"{folder}: its decks and tables have more than {_LARGEST // 10**6} MB; name a smaller folder")
        found.append((name.as_posix(), path.read_text(encoding="utf-8", errors="replace")))
    return found


def page_of(folder: Path, deck: Path | None = None) -> str:
    """The page with the files of a folder. `deck` is listed first. Raises FileNotFoundError without the page in this package."""
    package = Path(__file__).parent
    frame = (package / "workbench.html").read_text(encoding="utf-8")
    files = files_of(folder)
    if deck is not None:
        name = deck.relative_to(folder).as_posix()
        files.sort(key=lambda file: file[0] != name)
    content = json.dumps({"name": str(folder), "files": files}) if files else "null"
    program = base64.b64encode(gzip.compress((package / "elastokin.wasm").read_bytes(), 9, mtime=0)).decode()
    # a text must not end the element
    return frame.replace("@FOLDER@", content.replace("</", "<\\/").replace("<!--", "<\\!--")).replace("@PROGRAM@", program)


def place_of(folder: Path) -> Path:
    """The same file for each folder: some browsers store an edited document with the name of the page."""
    return cache_folder() / f"workbench-{hashlib.sha256(str(folder).encode()).hexdigest()[:16]}.html"


def write(page: str, path: Path) -> Path:
    """Writes the page; to a new temporary folder if the cache cannot be written."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(page, encoding="utf-8")
    except OSError:
        if not path.is_relative_to(cache_folder()):
            raise
        path = Path(tempfile.mkdtemp(prefix="elastokin-")) / path.name
        path.write_text(page, encoding="utf-8")
    return path


def main() -> None:
    """Opens the page, or writes it."""
    parser = argparse.ArgumentParser(prog="python -m elastokin.workbench", description="Opens the workbench in the browser.")
    parser.add_argument("folder", nargs="?", default=".", help="folder with decks, or a deck (default: the working folder)")
    parser.add_argument("--write", metavar="FILE", help="write the page to FILE and do not open it")
    words = parser.parse_args()
    given = Path(words.folder).resolve()
    if not given.exists():
        sys.exit(f"elastokin: {words.folder}: there is no such folder or deck")
    folder, deck = (given, None) if given.is_dir() else (given.parent, given)
    try:
        page = page_of(folder, deck)
    except FileNotFoundError:
        sys.exit("elastokin: this installation has no workbench; tools/wasm.sh makes build/wasm/elastokin.html and the wheel with it")
    except (ValueError, OSError) as reason:
        sys.exit(f"elastokin: {reason}")
    try:
        path = write(page, Path(words.write) if words.write else place_of(folder))
    except OSError as reason:
        sys.exit(f"elastokin: the page cannot be written: {reason}")
    print(path.resolve())
    if not words.write and not webbrowser.open(path.resolve().as_uri()):
        print("elastokin: no browser was found; open this file by hand", file=sys.stderr)


if __name__ == "__main__":
    main()
