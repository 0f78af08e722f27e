"""The programs `elastokin` and `elastokin-lsp` of this package: the command line, and the language server for editors."""

from __future__ import annotations

import os
import sys
from pathlib import Path


def main() -> None:
    """Runs the command line of this process, with the compiled program of this package, else with elastokin.wasm."""
    folder = Path(__file__).parent
    program = folder / "bin" / "elastokin"
    if program.exists():
        os.execv(program, [str(program), *sys.argv[1:]])
    program = folder / "elastokin.wasm"
    if not program.exists():
        sys.exit(f"elastokin: the program is not in {folder}: install the package with pip")
    try:
        from ._wasm import run
    except ImportError as reason:
        sys.exit(f"elastokin: {reason}")
    sys.exit(run(program, sys.argv[1:]))


def serve() -> None:
    """Runs the language server. Without pygls, the message names the command that installs it."""
    try:
        from .lsp import main as run_server
    except ModuleNotFoundError as reason:
        sys.exit(f'elastokin-lsp: {reason}; install it with: pip install "elastokin[lsp]"')
    run_server()
