"""elastokin.wasm: the command line and the functions of include/elastokin.h as a WebAssembly program, on the package wasmtime.

The program sees the files of this computer under their own names. On Windows it sees the drive of the working folder; a path that
begins with this drive is passed on without it, and `\\` becomes `/`. No other program can be started, so there are no figures by
gnuplot, and a study uses one processor.

wasmtime compiles the program for this processor when it is used for the first time, and the result is stored in the cache of the user
(EK_CACHE sets another folder). If it cannot be stored, every process compiles.
"""

from __future__ import annotations

import atexit
import ctypes
import hashlib
import importlib
import os
import platform
import signal
import sys
import threading
from collections.abc import Callable, Sequence
from ctypes import c_char_p, c_int
from importlib import metadata
from pathlib import Path, PureWindowsPath
from typing import Any

import numpy as np

from . import errors
from ._cache import cache_folder

try:
    wasmtime: Any = importlib.import_module("wasmtime")
except ImportError as reason:
    raise ImportError(f"elastokin runs here on the package wasmtime, which is missing ({reason}); install it: pip install wasmtime") from None

stopped_by_error = 70
_POINTER = 8                # bytes of an address in a list, and of the place of a handle
_ADDRESS = 32               # bits of a handle that give its address; the others give the instance


# ---- the program ----------------------------------------------------------------------------------------------------------------


def compiled(engine: Any, program: Path) -> Any:
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


def drive_of(folder: str) -> str:
    """The drive that the program sees as its root: on Windows that of a folder, else empty."""
    return PureWindowsPath(folder).drive if sys.platform == "win32" else ""


def seen_path(text: str, drive: str) -> str:
    """An argument or folder as the program sees it. `drive`: that of the working folder on Windows, else empty."""
    if not drive:
        return text
    if text.upper().startswith((f"{drive}\\".upper(), f"{drive}/".upper())):
        text = text[len(drive):]
    return text.replace("\\", "/")


def configured(arguments: Sequence[str], folder: str, drive: str) -> Any:
    """What the program sees of this computer: arguments, environment, standard streams, and the files of one drive."""
    wasi = wasmtime.WasiConfig()
    wasi.argv = ["elastokin", *(seen_path(word, drive) for word in arguments)]
    wasi.env = [(name, value) for name, value in os.environ.items() if name != "PWD"] + [("PWD", seen_path(folder, drive))]
    wasi.inherit_stdin()
    wasi.inherit_stdout()
    wasi.inherit_stderr()
    wasi.preopen_dir(f"{drive}/", "/")
    return wasi


def reason_of(error: Exception) -> str:
    """The last line of what wasmtime says."""
    lines = str(error).strip().splitlines()
    return lines[-1] if lines else type(error).__name__


# ---- the command line -------------------------------------------------------------------------------------------------------------


def run(program: Path, arguments: Sequence[str]) -> int:
    """Runs a command line; the exit status. Ctrl-C ends this process at once, while WebAssembly runs, too."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    folder = os.getcwd()
    engine = wasmtime.Engine()
    module = compiled(engine, program)
    store = wasmtime.Store(engine)
    store.set_wasi(configured(arguments, folder, drive_of(folder)))
    linker = wasmtime.Linker(engine)
    linker.define_wasi()
    start = linker.instantiate(store, module).exports(store)["_start"]
    try:
        start(store)
    except wasmtime.ExitTrap as end:
        return int(end.code)
    except (wasmtime.Trap, wasmtime.WasmtimeError) as error:
        print(f"elastokin: the program was stopped by an error in it: {reason_of(error)}", file=sys.stderr)
        return stopped_by_error
    return 0


# ---- the functions ----------------------------------------------------------------------------------------------------------------


class _Instance:
    """One instance of the program with its memory. An error in the program ends the instance, with all its models."""

    def __init__(self, engine: Any, module: Any, number: int) -> None:
        self.number = number
        self.folder = ""                                          # the root
        self.drive = drive_of(os.getcwd())
        self.store = wasmtime.Store(engine)
        self.store.set_wasi(configured([], "/", self.drive))
        linker = wasmtime.Linker(engine)
        linker.define_wasi()
        self.exports = linker.instantiate(self.store, module).exports(self.store)
        self.memory = self.exports["memory"]
        self.lengths: dict[str, int] = {}
        self.exports["ek_initialize"](self.store)

    def call(self, name: str, *words: Any) -> Any:
        """Calls a function. flang adds lengths of strings as arguments, which the functions of C do not use."""
        function = self.exports[name]
        if name not in self.lengths:
            self.lengths[name] = len(function.type(self.store).params)
        return function(self.store, *words, *[0] * (self.lengths[name] - len(words)))

    def place(self, content: bytes, places: list[int]) -> int:
        """Copies bytes into the memory of the program; the address is added to `places`."""
        at: int = self.call("malloc", max(len(content), 1))
        if at == 0:
            raise MemoryError("the WebAssembly program has no memory left")
        places.append(at)
        self.memory.write(self.store, content, at)
        return at

    def place_texts(self, texts: Sequence[bytes | None], places: list[int]) -> int:
        """Copies a list of strings."""
        addresses = [0 if text is None else self.place(text + b"\0", places) for text in texts]
        return self.place(b"".join(at.to_bytes(_POINTER, "little") for at in addresses), places)

    def read(self, at: int, size: int) -> bytes:
        """Bytes of the memory."""
        return bytes(self.memory.read(self.store, at, at + size))

    def text(self, at: int) -> bytes | None:
        """A string of the program; None for a null pointer."""
        if at == 0:
            return None
        found, size = b"", 256
        while b"\0" not in found:
            found = self.read(at, min(size, self.memory.data_len(self.store) - at))
            size *= 8
        return found[: found.index(b"\0")]

    def enter(self, folder: str) -> None:
        """Makes the working folder of this process that of the program."""
        places: list[int] = []
        self.call("ek_enter", self.place(os.fsencode(seen_path(folder, self.drive)) + b"\0", places))
        self.call("free", places[0])
        self.folder = folder


class Library:
    """The functions of include/elastokin.h, called as those of a shared library loaded by ctypes. One call at a time."""

    # the arguments that are paths of files
    _PATHS = {("ek_open_file", 0), ("ek_open_text", 1), ("ek_open_files", 1)}

    def __init__(self, program: Path, prototypes: dict[str, tuple[Any, list[Any]]], doubles: Any) -> None:
        self._name = str(program)
        self._engine = wasmtime.Engine()
        self._module = compiled(self._engine, program)
        self._doubles = doubles
        self._lock = threading.RLock()
        self._instances: dict[int, _Instance] = {}
        self._count = 0
        atexit.register(self._instances.clear)                    # models that are open then are not closed by calls
        known = {export.name for export in self._module.exports}
        for name, (result, arguments) in prototypes.items():
            if name not in known:
                raise ImportError(f"{program} has no function {name}: it belongs to another version of elastokin")
            setattr(self, name, self._function(name, result, arguments))

    def _newest(self) -> _Instance:
        """The instance of new models."""
        if self._count not in self._instances:
            self._count += 1
            self._instances[self._count] = _Instance(self._engine, self._module, self._count)
        return self._instances[self._count]

    def _function(self, name: str, result: Any, arguments: list[Any]) -> Callable[..., Any]:
        """A function that copies its arguments into the memory of the program, and the results back."""
        takes_model = bool(arguments) and arguments[0] is ctypes.c_void_p

        def call(*words: Any) -> Any:
            with self._lock:
                number = (words[0] or 0) >> _ADDRESS if takes_model else 0
                if number and number not in self._instances:      # an error in the program has ended it
                    if result is None:
                        return None
                    raise errors.ElastokinError("the model is lost: the program was stopped by an error in it; open the model again")
                instance = self._instances[number] if number else self._newest()
                places: list[int] = []
                try:
                    self._follow(instance)
                    given, back = self._placed(instance, name, arguments, words, places)
                    answer = instance.call(name, *given)
                    for take in back:
                        take()
                    if result is c_char_p:
                        answer = instance.text(answer)
                    for at in places:
                        instance.call("free", at)
                    return answer
                except (wasmtime.Trap, wasmtime.ExitTrap, wasmtime.WasmtimeError) as error:
                    del self._instances[instance.number]
                    raise errors.ElastokinError(
                        f"the program was stopped by an error in it: {reason_of(error)}; all models that are open are lost"
                    ) from None

        return call

    @staticmethod
    def _follow(instance: _Instance) -> None:
        """Relative names of files start from the working folder of this process."""
        try:
            folder = os.getcwd()
        except OSError:                                           # it was deleted
            return
        if folder != instance.folder:
            instance.enter(folder)

    def _placed(
        self, instance: _Instance, name: str, arguments: list[Any], words: Sequence[Any], places: list[int]
    ) -> tuple[list[Any], list[Callable[[], None]]]:
        """The arguments of a call in the memory of the program, and what copies results back."""
        given: list[Any] = []
        back: list[Callable[[], None]] = []
        for k, (kind, word) in enumerate(zip(arguments, words)):
            is_path = (name, k) in self._PATHS
            if word is None:
                given.append(0)
            elif kind is ctypes.c_void_p:
                given.append(word & (1 << _ADDRESS) - 1)
            elif kind is c_char_p:
                given.append(instance.place(self._seen(word, instance, is_path) + b"\0", places))
            elif kind is c_int:
                given.append(int(word))
            elif kind is ctypes.c_double:
                given.append(float(word))
            elif kind is self._doubles:
                given.append(self._array_place(instance, word, places, back))
            elif kind == ctypes.POINTER(c_char_p):
                given.append(instance.place_texts([self._seen(text, instance, is_path) for text in word], places))
            else:
                given.append(self._result_place(instance, word._obj, places, back))
        return given, back

    @staticmethod
    def _array_place(instance: _Instance, array: Any, places: list[int], back: list[Callable[[], None]]) -> int:
        """The place of an array in the memory of the program."""
        at = instance.place(array.tobytes(), places)

        def take() -> None:
            array[...] = np.frombuffer(instance.read(at, array.nbytes)).reshape(array.shape)

        if array.flags.writeable:
            back.append(take)
        return at

    @staticmethod
    def _result_place(instance: _Instance, variable: Any, places: list[int], back: list[Callable[[], None]]) -> int:
        """The place of a result in the memory of the program: a handle, an integer or a number, given by byref."""
        is_handle = isinstance(variable, ctypes.c_void_p)
        at = instance.place(bytes(_POINTER), places)

        def take() -> None:
            content = instance.read(at, _POINTER)
            if is_handle:
                address = int.from_bytes(content[:4], "little")
                variable.value = (instance.number << _ADDRESS | address) if address else None
            else:
                variable.value = type(variable).from_buffer_copy(content).value

        back.append(take)
        return at

    @staticmethod
    def _seen(text: bytes, instance: _Instance, is_path: bool) -> bytes:
        return os.fsencode(seen_path(os.fsdecode(text), instance.drive)) if is_path and instance.drive else text
