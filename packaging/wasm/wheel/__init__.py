"""The command line of elastokin, as a WebAssembly program that runs wherever the package wasmtime has a wheel.

The program sees the files of this computer under their own names: arguments, folders, standard output, standard error and exit status
are those of the native program. On Windows it sees the drive of the working folder; an argument that begins with this drive is passed
on without it, and `\\` becomes `/`. No other program can be started, so there are no figures by gnuplot, and a study uses one processor.

wasmtime compiles the program for this processor when it is used for the first time, and the result is stored in the cache of the user
(EK_CACHE sets another folder). If it cannot be stored, every use compiles.
"""
import hashlib
import os
import platform
import signal
import sys
from importlib import metadata
from pathlib import Path, PureWindowsPath

import wasmtime

program = Path(__file__).with_name("elastokin.wasm")
stopped_by_error = 70


def cache_folder() -> Path:
    """The folder of compiled programs: that of EK_CACHE, or the usual one of the system."""
    if "EK_CACHE" in os.environ:
        return Path(os.environ["EK_CACHE"])
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA", Path.home() / "AppData/Local")) / "elastokin"
    if sys.platform == "darwin":
        return Path.home() / "Library/Caches/elastokin"
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "elastokin"


def compiled(engine: wasmtime.Engine) -> wasmtime.Module:
    """The program for this processor, from the cache or compiled. The name of the file changes with program, wasmtime and machine."""
    content = program.read_bytes()
    facts = f"{hashlib.sha256(content).hexdigest()} {metadata.version('wasmtime')} {platform.platform()} {platform.processor()}"
    stored = None
    try:
        stored = cache_folder() / f"program-{hashlib.sha256(facts.encode()).hexdigest()[:16]}.compiled"
        if stored.exists():
            return wasmtime.Module.deserialize(engine, stored.read_bytes())
    except wasmtime.WasmtimeError:
        pass                                                 # damaged: it is written again
    except (OSError, RuntimeError):
        stored = None                                        # no folder of the user, or one that cannot be read
    print("elastokin: compiling the program for this processor (once, some seconds)", file=sys.stderr, flush=True)
    module = wasmtime.Module(engine, content)
    if stored:
        try:
            stored.parent.mkdir(parents=True, exist_ok=True)
            new = stored.with_suffix(f".{os.getpid()}")
            new.write_bytes(module.serialize())
            new.replace(stored)
        except OSError as reason:
            print(f"elastokin: the compiled program cannot be stored, so every use compiles: {reason}", file=sys.stderr, flush=True)
    return module


def seen_path(text: str, drive: str) -> str:
    """An argument or folder as the program sees it. `drive`: that of the working folder on Windows, else empty."""
    if not drive:
        return text
    if text.upper().startswith((f"{drive}\\".upper(), f"{drive}/".upper())):
        text = text[len(drive):]
    return text.replace("\\", "/")


def run(arguments: list[str]) -> int:
    """Runs a command line; the exit status."""
    folder = os.getcwd()
    drive = PureWindowsPath(folder).drive if sys.platform == "win32" else ""
    engine = wasmtime.Engine()
    module = compiled(engine)
    wasi = wasmtime.WasiConfig()
    wasi.argv = ["elastokin", *(seen_path(word, drive) for word in arguments)]
    wasi.env = [(name, value) for name, value in os.environ.items() if name != "PWD"] + [("PWD", seen_path(folder, drive))]
    wasi.inherit_stdin()
    wasi.inherit_stdout()
    wasi.inherit_stderr()
    wasi.preopen_dir(f"{drive}/", "/")
    store = wasmtime.Store(engine)
    store.set_wasi(wasi)
    linker = wasmtime.Linker(engine)
    linker.define_wasi()
    start = linker.instantiate(store, module).exports(store)["_start"]
    assert isinstance(start, wasmtime.Func)
    try:
        start(store)
    except wasmtime.ExitTrap as end:
        return end.code
    except (wasmtime.Trap, wasmtime.WasmtimeError) as error:
        reason = str(error).strip().splitlines()
        print(f"elastokin: the program was stopped by an error in it: {reason[-1] if reason else error}", file=sys.stderr)
        return stopped_by_error
    return 0


def main() -> None:
    """The program `elastokin`. Ctrl-C ends it at once, while WebAssembly runs, too."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.exit(run(sys.argv[1:]))
