"""The library, shared or as WebAssembly, and the prototypes of its functions (include/elastokin.h)."""

from __future__ import annotations

import ctypes
import os
import sys
from ctypes import POINTER, c_char_p, c_double, c_int, c_void_p
from pathlib import Path
from typing import Any

from . import errors


class _Doubles:
    """An array of doubles of numpy, in C order; None is a null pointer."""

    @classmethod
    def from_param(cls, array: Any) -> Any:
        """The address of the array, for ctypes."""
        return None if array is None else c_void_p(array.ctypes.data)


_TEXTS = POINTER(c_char_p)

# name: (result, arguments)
_PROTOTYPES: dict[str, tuple[Any, list[Any]]] = {
    "ek_version": (c_char_p, []),
    "ek_use_one_thread": (c_int, []),
    "ek_open_file": (c_int, [c_char_p, POINTER(c_void_p)]),
    "ek_open_text": (c_int, [c_char_p, c_char_p, POINTER(c_void_p)]),
    "ek_copy": (c_int, [c_void_p, POINTER(c_void_p)]),
    "ek_file_count": (c_int, [c_void_p]),
    "ek_file_path": (c_char_p, [c_void_p, c_int]),
    "ek_file_text": (c_char_p, [c_void_p, c_int]),
    "ek_open_files": (c_int, [c_int, _TEXTS, _TEXTS, POINTER(c_void_p)]),
    "ek_deck_as_used": (c_char_p, [c_void_p]),
    "ek_close": (None, [c_void_p]),
    "ek_message": (c_char_p, [c_void_p]),
    "ek_name": (c_char_p, [c_void_p]),
    "ek_checksum": (c_char_p, [c_void_p]),
    "ek_wheel_count": (c_int, [c_void_p]),
    "ek_model_remarks": (c_int, [c_void_p, POINTER(c_int)]),
    "ek_model_remark_text": (c_char_p, [c_void_p, c_int]),
    "ek_model_remark_severity": (c_char_p, [c_void_p, c_int]),
    "ek_parameter_count": (c_int, [c_void_p]),
    "ek_parameter_path": (c_char_p, [c_void_p, c_int]),
    "ek_parameter_unit": (c_char_p, [c_void_p, c_int]),
    "ek_parameter_is_given": (c_int, [c_void_p, c_int]),
    "ek_parameter_twin": (c_int, [c_void_p, c_int]),
    "ek_get_all": (c_int, [c_void_p, c_int, _Doubles]),
    "ek_set_all": (c_int, [c_void_p, c_int, _Doubles]),
    "ek_get": (c_int, [c_void_p, c_char_p, POINTER(c_double)]),
    "ek_set": (c_int, [c_void_p, c_char_p, c_double]),
    "ek_set_text": (c_int, [c_void_p, c_char_p, c_char_p]),
    "ek_reset": (c_int, [c_void_p]),
    "ek_case_count": (c_int, [c_void_p]),
    "ek_case_name": (c_char_p, [c_void_p, c_int]),
    "ek_case_is_of_deck": (c_int, [c_void_p, c_int]),
    "ek_solve": (c_int, [c_void_p, c_char_p, c_int, _TEXTS]),
    "ek_row_count": (c_int, [c_void_p]),
    "ek_define": (c_int, [c_void_p, c_char_p]),
    "ek_column_count": (c_int, [c_void_p]),
    "ek_column_name": (c_char_p, [c_void_p, c_int]),
    "ek_column_unit": (c_char_p, [c_void_p, c_int]),
    "ek_column_title": (c_char_p, [c_void_p, c_int]),
    "ek_column_sign": (c_char_p, [c_void_p, c_int]),
    "ek_values": (c_int, [c_void_p, c_int, _Doubles]),
    "ek_remark_count": (c_int, [c_void_p]),
    "ek_remark_text": (c_char_p, [c_void_p, c_int]),
    "ek_remark_severity": (c_char_p, [c_void_p, c_int]),
    "ek_compliance": (c_int, [c_void_p, c_int, c_int, _Doubles]),
    "ek_derivatives": (c_int, [c_void_p, c_int, c_int, _TEXTS, c_int, _TEXTS, _Doubles, _Doubles]),
    "ek_numbers": (c_int, [c_void_p, c_int, _TEXTS, _Doubles]),
    "ek_number_count": (c_int, [c_void_p]),
    "ek_number_name": (c_char_p, [c_void_p, c_int]),
    "ek_number_unit": (c_char_p, [c_void_p, c_int]),
    "ek_number_definition": (c_char_p, [c_void_p, c_int]),
}


def _path() -> str:
    """Path of the library: the environment variable EK_LIBRARY, otherwise the library or elastokin.wasm in this package."""
    named = os.environ.get("EK_LIBRARY")
    if named:
        return named
    pattern = {"darwin": "libelastokin*.dylib", "win32": "*elastokin*.dll"}.get(sys.platform, "libelastokin.so*")
    folder = Path(__file__).parent
    found = sorted(folder.glob(pattern)) or sorted(folder.glob("elastokin.wasm"))
    if not found:
        raise ImportError(
            f"the elastokin library is not in {folder}: install the package with pip, "
            "or set the environment variable EK_LIBRARY to the path of libelastokin.so.0 or elastokin.wasm"
        )
    return str(found[0])


def _load() -> Any:
    """Loads the library, or the WebAssembly program, which has the same functions."""
    path = _path()
    if not path.endswith(".wasm"):
        return _load_shared(path)
    from ._wasm import Library

    return Library(Path(path), _PROTOTYPES, _Doubles)


def _load_shared(path: str) -> ctypes.CDLL:
    """Loads the shared library. If this also loads OpenBLAS, OpenBLAS uses one thread, because the matrices are small."""
    variable = "OPENBLAS_NUM_THREADS"
    is_ours = variable not in os.environ
    if is_ours:
        os.environ[variable] = "1"
    try:
        library = ctypes.CDLL(path)
    finally:
        if is_ours:
            del os.environ[variable]
    for name, (result, arguments) in _PROTOTYPES.items():
        try:
            function = getattr(library, name)
        except AttributeError:
            raise ImportError(f"{library._name} has no function {name}: it belongs to another version of elastokin") from None
        function.restype = result
        function.argtypes = arguments
    return library


lib: Any = _load()


def text_of(text: bytes | None) -> str:
    """Converts a string of the library; '' for a null pointer."""
    return "" if text is None else text.decode("utf-8", "replace")


def bytes_for(text: str, what: str) -> bytes:
    """Converts a string for the library. Raises UsageError if it contains NUL. `what` names the string in the message, as "a path"."""
    if not isinstance(text, str):
        raise TypeError(f"{what} must be a str, found {type(text).__name__}")
    return without_nul(text.encode("utf-8", "surrogateescape"), what)


def without_nul(text: bytes, what: str) -> bytes:
    """Returns the bytes unchanged. Raises UsageError if they contain NUL. `what` names them in the message."""
    if b"\0" in text:
        raise errors.UsageError(f"{what} must not contain a NUL character, found {text[:60]!r}")
    return text


def texts_for(texts: list[str], what: str = "a text") -> Any:
    """Converts strings to an array of C strings for the library."""
    return (c_char_p * len(texts))(*(bytes_for(text, what) for text in texts))
