"""The programs `elastokin` and `elastokin-lsp` of the package elastokin: the command line, and the language server for editors.

This module does not import the package, so that a command does not wait for NumPy and the library.
"""

from __future__ import annotations

import importlib.util
import os
import sys
from pathlib import Path


def main() -> None:
    """Runs the command line of this process, with the compiled program of the package, else with elastokin.wasm."""
    package = importlib.util.find_spec("elastokin")
    if package is None or not package.submodule_search_locations:
        sys.exit("elastokin: the package elastokin is not installed: install it with pip")
    folder = Path(package.submodule_search_locations[0])
    program = folder / "bin" / "elastokin"
    if program.exists():
        os.execv(program, [str(program), *sys.argv[1:]])
    program = folder / "elastokin.wasm"
    if not program.exists():
        sys.exit(f"elastokin: the program is not in {folder}: install the package with pip")
    try:
        from elastokin._wasm import run
    except ImportError as reason:
        sys.exit(f"elastokin: {reason}")
    sys.exit(run(program, sys.argv[1:]))


def serve() -> None:
    """Runs the language server. Without pygls, the message names the command that installs it."""
    try:
        from elastokin.lsp import main as run_server
    except ModuleNotFoundError as reason:
        sys.exit(f'elastokin-lsp: {reason}; install it with: pip install "elastokin[lsp]"')
    run_server()
