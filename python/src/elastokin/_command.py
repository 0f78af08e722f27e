"""The program `elastokin` of this package: the command line."""

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
