"""The folder of the user for files that can be made again."""

from __future__ import annotations

import os
import sys
from pathlib import Path


def cache_folder() -> Path:
    """The folder of EK_CACHE, or the usual one of the system."""
    if "EK_CACHE" in os.environ:
        return Path(os.environ["EK_CACHE"])
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA", Path.home() / "AppData/Local")) / "elastokin"
    if sys.platform == "darwin":
        return Path.home() / "Library/Caches/elastokin"
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "elastokin"
