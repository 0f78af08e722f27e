"""The class Model: a deck with its current numbers, and the solution of its cases."""

from __future__ import annotations

import ctypes
import os
import threading
import warnings
from collections.abc import Iterator, Sequence
from ctypes import byref, c_double, c_void_p
from types import TracebackType
from typing import Any, Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import errors
from ._library import bytes_for, lib, text_of, texts_for, without_nul
from .parameters import Parameters
from .result import Heading, Remark, Result

# A change of the deck: (path, number), (path, text), or ("", all numbers). A model keeps those that a copy of it needs, in order
_Change = tuple[str, Any]


class Model:
    """The model of a suspension: a deck with its current numbers.

    Open a model with `Model.from_file` or `Model.from_text`. Several threads may use one model; its calls then wait for each other.
    Different models are solved at the same time. A model can be copied and pickled, for instance for `multiprocessing`. The copy
    contains the changes, and the files with their contents at the time of opening.
    """

    def __init__(self) -> None:
        raise TypeError("open a model with Model.from_file or Model.from_text")

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Model:
        """Reads a deck from a file. Raises FileError, DeckError, ModelError. Issues one ModelWarning if there are `remarks`."""
        name = os.fspath(path)
        handle = c_void_p()
        code = lib.ek_open_file(without_nul(os.fsencode(name), "a file name"), byref(handle))
        model = cls._opened(handle, code, os.path.abspath(name))
        model._warn()
        return model

    @classmethod
    def from_text(cls, text: str, name: str = "deck.nml") -> Model:
        """Reads a deck from a string. `name` is its file name in messages; included files are relative to the folder of `name`.

        Raises FileError, DeckError, ModelError. Issues one ModelWarning if there are `remarks`.
        """
        model = cls._from_text(text, name)
        model._warn()
        return model

    @classmethod
    def _from_text(cls, text: str, name: str) -> Model:
        handle = c_void_p()
        content, file = bytes_for(text, "a deck"), without_nul(os.fsencode(name), "a file name")
        return cls._opened(handle, lib.ek_open_text(content, file, byref(handle)), name)

    @classmethod
    def _opened(cls, handle: c_void_p, code: int, source: str) -> Model:
        model = cls.__new__(cls)
        model._handle = handle.value
        model._lock = threading.RLock()
        model._source = source
        model._changes = []
        model._serial = 0
        model._columns = {}
        model._paths = set()
        model._parameters = None
        try:
            model._check(code)
        except errors.ElastokinError:
            model.close()
            raise
        return model

    _handle: int | None
    _lock: threading.RLock      # held during a call and until its texts and values are copied
    _source: str                # path of the deck, or name of the text
    _changes: list[_Change]
    _serial: int                # of the last solution
    _columns: dict[tuple[str | None, ...], tuple[tuple[str, ...], tuple[Heading, ...]]]     # of a case with these columns
    _paths: set[str]            # set as numbers since then
    _parameters: Parameters | None

    # ---- end ----

    def close(self) -> None:
        """Frees the model, which cannot be used afterwards. Results stay valid."""
        handle, self._handle = getattr(self, "_handle", None), None
        if handle:
            lib.ek_close(handle)

    def __del__(self, _close: Callable[[Model], None] = close) -> None:
        _close(self)

    def __enter__(self) -> Model:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        with self._lock:
            self.close()

    # ---- calls ----

    @property
    def _open(self) -> int:
        if self._handle is None:
            raise errors.UsageError("the model is closed")
        return self._handle

    def _check(self, code: int) -> None:
        if code != errors.OK:
            raise errors.error_of(code, text_of(lib.ek_message(self._handle)))

    def _texts(self, function: Any, n: int) -> tuple[str, ...]:
        handle = self._open
        return tuple([function(handle, k).decode() for k in range(n)])

    def _warn(self) -> None:
        """Issues a warning if there are remarks. Call it directly in from_file or from_text: the warning names their caller."""
        try:
            remarks = self.remarks
        except BaseException:
            self.close()
            raise
        if remarks:
            warnings.warn("\n".join(remarks), errors.ModelWarning, stacklevel=3)

    # ---- description ----

    @property
    def name(self) -> str:
        """Name of the model."""
        with self._lock:
            return text_of(lib.ek_name(self._open))

    @property
    def checksum(self) -> str:
        """Checksum of the deck with its current numbers, 16 hexadecimal digits, as in the headers of result files."""
        with self._lock:
            return text_of(lib.ek_checksum(self._open))

    @property
    def deck(self) -> str:
        """The deck with its current numbers as one string. A model opened from this string gives the same results.

        The string contains the contents of included files, hardpoints and property files, both sides of a mirrored axle, and all
        changes. Load tables are given by absolute paths. Raises DeckError if the numbers do not define a valid model.
        """
        with self._lock:
            text: bytes | None = lib.ek_deck_as_used(self._open)
            if text is None:
                raise errors.DeckError(text_of(lib.ek_message(self._handle)))
        return text.decode("utf-8", "surrogateescape")

    @property
    def wheels(self) -> int:
        """Number of wheels: 0, 1 or 2. The left wheel comes first."""
        with self._lock:
            return int(lib.ek_wheel_count(self._open))

    @property
    def cases(self) -> tuple[str, ...]:
        """Names of the cases of the deck, then names of the standard tests that the deck does not define."""
        with self._lock:
            return self._texts(lib.ek_case_name, lib.ek_case_count(self._open))

    @property
    def deck_cases(self) -> tuple[str, ...]:
        """Names of the cases that the deck defines, without standard tests."""
        with self._lock:
            return tuple([name for k, name in enumerate(self.cases) if lib.ek_case_is_of_deck(self._open, k)])

    @property
    def remarks(self) -> list[str]:
        """Warnings on the model with its current numbers, as printed by the command line before it solves a case.

        They report missing springs, contact points that do not match the wheel, incomplete balance and implausible values
        ("plausible? …"). If no case can be solved, they give the reason. The list is empty if there are no warnings. `Result.remarks`
        lists the remarks on a solution.
        """
        count = ctypes.c_int()
        with self._lock:
            self._check(lib.ek_model_remarks(self._open, byref(count)))
            severities = self._texts(lib.ek_model_remark_severity, count.value)
            texts = self._texts(lib.ek_model_remark_text, count.value)
        return [text for text, severity in zip(texts, severities) if severity != "note"]

    def __repr__(self) -> str:
        if self._handle is None:
            return f"<Model of {self._source}, closed>"
        return f"<Model '{self.name}' of {self._source}: {lib.ek_parameter_count(self._handle)} numbers, {len(self.cases)} cases>"

    # ---- parameters of the deck ----

    def __getitem__(self, path: str) -> float:
        """A parameter of the deck in the unit of the deck; NaN if the path stands for different numbers."""
        value = c_double()
        with self._lock:
            self._check(lib.ek_get(self._open, bytes_for(path, "a path"), byref(value)))
        return value.value

    def __setitem__(self, path: str, value: float | str) -> None:
        """Changes a number, in the unit of the deck. The path is as for --set: `*` stands for any letters, and on a mirrored axle a path
        without a side stands for both sides.

        A string is a string value of the deck or a relative change: "*1.1" scales the current number, "+2" adds to it. After a string, the
        deck is read again, which takes some milliseconds. A number outside its legal range raises DeckError and changes nothing. Legal
        numbers that together do not define a valid model are reported by the next solution.
        """
        name = bytes_for(path, "a path")
        with self._lock:
            if isinstance(value, str):
                self._check(lib.ek_set_text(self._open, name, bytes_for(value, "a value")))
                self._forget()
            else:
                value = float(value)
                self._check(lib.ek_set(self._open, name, value))
                if path not in self._paths:     # the library may have read the deck again with it
                    self._forget()
                    self._paths.add(path)
            is_relative = isinstance(value, str) and value.lstrip()[:1] in ("*", "+", "-")
            if not is_relative:     # earlier changes of this path have no effect any more
                self._changes = [change for change in self._changes if change[0] != path]
            self._changes.append((path, value))

    def __delitem__(self, path: str) -> None:
        """Reverses the changes made with this path; other changes stay. Raises KeyError if no change was made with this path."""
        with self._lock:
            others = [change for change in self._changes if change[0] != path]
            if len(others) == len(self._changes):
                raise KeyError(path)
            self.reset()
            self._make(others)
            self._changes = others

    def __contains__(self, path: object) -> bool:
        if not isinstance(path, str) or "\0" in path:
            return False
        value = c_double()
        with self._lock:
            return bool(lib.ek_get(self._open, path.encode(), byref(value)) == errors.OK)

    def __iter__(self) -> Iterator[str]:
        return iter(self.parameters)

    def reset(self) -> None:
        """Reverses all changes: numbers and strings have the values of the deck as opened."""
        with self._lock:
            self._check(lib.ek_reset(self._open))
            self._changes.clear()
            self._forget()

    def _forget(self) -> None:
        """Empties the stored lists of parameters and columns."""
        self._parameters = None
        self._columns.clear()
        self._paths.clear()

    def _make(self, changes: list[_Change]) -> None:
        """Repeats earlier changes of the deck, made on this model or on the model of which this is a copy."""
        for path, value in changes:
            if path == "":
                self._check(lib.ek_set_all(self._open, len(value), value))
            elif isinstance(value, str):
                self._check(lib.ek_set_text(self._open, path.encode(), value.encode()))
            else:
                self._check(lib.ek_set(self._open, path.encode(), value))

    @property
    def parameters(self) -> Parameters:
        """All parameters of the deck with their units: a mapping from path to value and unit."""
        with self._lock:
            if self._parameters is None:
                n = lib.ek_parameter_count(self._open)
                self._parameters = Parameters(
                    self._texts(lib.ek_parameter_path, n),
                    self._texts(lib.ek_parameter_unit, n),
                    tuple([bool(lib.ek_parameter_is_given(self._open, k)) for k in range(n)]),
                    tuple([int(lib.ek_parameter_twin(self._open, k)) for k in range(n)]),
                    lambda: self.x,
                )
            return self._parameters

    @property
    def x(self) -> NDArray[np.float64]:
        """All parameters of the deck in its units, in the order of `parameters.paths`. Assign an array to change them.

        The array is a copy and is read-only: `x = model.x.copy(); x[k] = 3; model.x = x`.
        """
        with self._lock:
            x = np.empty(lib.ek_parameter_count(self._open))
            self._check(lib.ek_get_all(self._open, x.size, x))
        x.flags.writeable = False
        return x

    @x.setter
    def x(self, values: ArrayLike) -> None:
        x = np.array(values, dtype=np.float64, order="C")
        if x.ndim != 1:
            raise errors.UsageError(f"x needs one dimension, found {x.ndim}")
        with self._lock:
            n = lib.ek_parameter_count(self._open)
            if x.size != n:
                raise errors.UsageError(f"x needs {n} numbers, one for each of parameters.paths, found {x.size}")
            self._check(lib.ek_set_all(self._open, x.size, x))
            self._changes = [change for change in self._changes if isinstance(change[1], str)]
            self._changes.append(("", x))

    # ---- solving ----

    def solve(
        self, case: str | None = None, columns: Sequence[str] | None = None, compliance: bool = False, definitions: str | None = None
    ) -> Result:
        """Solves a case with the current numbers.

        `case`: name of the case; default: the first case. `columns`: names of the columns to compute, in which `*` stands for any letters;
        default: all columns. The result always has `state`, `factor` and the columns on convergence, in the order of the program's tables.
        `compliance`: whether to compute the compliance matrix of every state for `Result.compliance`. `definitions`: the columns have the
        definitions, signs, units and names of another program ("adams", "motionview", "ipg", "optimumk", "lotus", "mathworks", "sae"); not
        with `columns`.

        States that do not converge do not raise an error. Their rows are NaN, `converged` is false, and a ConvergenceWarning is issued.
        Raises UsageError, DeckError, ModelError, FileError.
        """
        if columns is not None and definitions is not None:
            raise errors.UsageError("columns are names of elastokin, and cannot be given with definitions")
        if isinstance(columns, str):
            columns = [columns]
        wanted = list(columns) if columns is not None else []
        name = bytes_for(case, "the name of a case") if case is not None else b""
        heads = texts_for(wanted, "the name of a column") if wanted else None
        with self._lock:
            handle = self._open
            self._serial += 1
            status = lib.ek_solve(handle, name, len(wanted), heads)
            message = ""
            if status == errors.CONVERGENCE:
                message = text_of(lib.ek_message(handle))
            else:
                self._check(status)
            if definitions is not None:
                self._check(lib.ek_define(handle, bytes_for(definitions, "the name of a program")))
            n = lib.ek_column_count(handle)
            values = np.empty((lib.ek_row_count(handle), n))
            self._check(lib.ek_values(handle, values.size, values))
            names, headings = self._columns_of((case, definitions, *wanted), n)
            remarks = tuple([
                Remark(text_of(lib.ek_remark_severity(handle, k)), text_of(lib.ek_remark_text(handle, k)))
                for k in range(lib.ek_remark_count(handle))
            ])
            result = Result(self, self._serial, case or self.cases[0], names, headings, values, remarks, status)
            if compliance:
                for row in range(len(values)):
                    result.compliance(row)
        if message:
            warnings.warn(message, errors.ConvergenceWarning, stacklevel=2)
        return result

    def _columns_of(self, key: tuple[str | None, ...], n: int) -> tuple[tuple[str, ...], tuple[Heading, ...]]:
        """Names and headings of the n columns of the last solution, stored for the next solution of this case with these columns."""
        if key not in self._columns or len(self._columns[key][0]) != n:
            handle = self._open
            names = self._texts(lib.ek_column_name, n)
            headings = [
                (text_of(lib.ek_column_unit(handle, k)), text_of(lib.ek_column_title(handle, k)), text_of(lib.ek_column_sign(handle, k)))
                for k in range(n)
            ]
            self._columns[key] = names, tuple(headings)
        return self._columns[key]

    def _compliance(self, serial: int, row: int) -> NDArray[np.float64]:
        with self._lock:
            if serial != self._serial:
                raise errors.UsageError("the model has solved another case since; solve with compliance=True to keep the matrices")
            n = 6 * lib.ek_wheel_count(self._open)
            matrix = np.empty((n, n))
            self._check(lib.ek_compliance(self._open, row, n * n, matrix))
        return matrix

    def _derivatives(self, serial: int, row: int, columns: list[str], numbers: list[str]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        slopes = np.empty((len(columns), len(numbers)))
        doubts = np.empty_like(slopes)
        with self._lock:
            if serial != self._serial:
                raise errors.UsageError("the model has solved another case since; solve again before derivatives are read")
            self._check(
                lib.ek_derivatives(
                    self._open, row, len(columns), texts_for(columns, "the name of a column"), len(numbers),
                    texts_for(numbers, "a path"), slopes, doubts
                )
            )
        return slopes, doubts

    # ---- K&C metrics ----

    def numbers(self, *names: str) -> dict[str, float]:
        """K&C metrics with these names, as in key_numbers.csv of the report. Solves only the tests that these numbers require.

        On an axle, the name of a number of one wheel begins with `left_` or `right_`; the name of an axle number does not. A number is NaN
        if it requires a state that did not converge, or if the model does not define it. States outside the window of a slope are not
        required. A ConvergenceWarning names all numbers that are NaN. The other numbers are valid.
        """
        if not names:
            raise TypeError("numbers() needs at least one name, as in numbers('left_bump_toe'); key_numbers() returns all numbers")
        wanted = texts_for(list(names), "the name of a K&C metric")
        values = np.empty(len(names))
        with self._lock:
            code = lib.ek_numbers(self._open, len(names), wanted, values)
            message = ""
            if code == errors.CONVERGENCE:
                message = text_of(lib.ek_message(self._handle))
            else:
                self._check(code)
        if message:
            warnings.warn(message, errors.ConvergenceWarning, stacklevel=2)
        return dict(zip(names, values.tolist()))

    def key_numbers(self) -> dict[str, float]:
        """All K&C metrics of this model by name."""
        names = self.number_names
        return self.numbers(*names) if names else {}

    @property
    def number_names(self) -> tuple[str, ...]:
        """Names of all K&C metrics. No case is solved, so the value of a listed number may be NaN."""
        with self._lock:
            return self._texts(lib.ek_number_name, lib.ek_number_count(self._open))

    @property
    def number_units(self) -> dict[str, str]:
        """Unit of each K&C metric by name."""
        with self._lock:
            return dict(zip(self.number_names, self._texts(lib.ek_number_unit, lib.ek_number_count(self._open))))

    @property
    def number_definitions(self) -> dict[str, str]:
        """Definition of each K&C metric by name."""
        with self._lock:
            return dict(zip(self.number_names, self._texts(lib.ek_number_definition, lib.ek_number_count(self._open))))

    # ---- copies ----

    def copy(self) -> Model:
        """A new model with the same deck and the same changes, for instance for another thread. No file is read again."""
        handle = c_void_p()
        with self._lock:
            code = lib.ek_copy(self._open, byref(handle))
            model = Model._opened(handle, code, self._source)
            model._changes = list(self._changes)
        return model

    __copy__ = copy

    def __deepcopy__(self, memo: dict[int, Any]) -> Model:
        return self.copy()

    def __reduce__(self) -> tuple[Any, ...]:
        with self._lock:
            handle = self._open
            files = [(lib.ek_file_path(handle, k), lib.ek_file_text(handle, k)) for k in range(lib.ek_file_count(handle))]
            return _from_files, (files, self._source, list(self._changes))


def _from_files(files: list[tuple[bytes, bytes]], source: str, changes: list[_Change]) -> Model:
    """Opens a model from the contents of its files and repeats its changes; used to unpickle."""
    handle = c_void_p()
    n = len(files)
    paths, texts = ((ctypes.c_char_p * n)(*column) for column in zip(*files))
    model = Model._opened(handle, lib.ek_open_files(n, paths, texts, byref(handle)), source)
    model._make(changes)
    model._changes = changes
    return model


def _copy_of(text: str, name: str, changes: list[_Change]) -> Model:
    """Raises UsageError. Pickles of earlier versions call this function; they do not contain the included files."""
    raise errors.UsageError(f"{name}: this model was pickled by an earlier version of elastokin; open its deck and pickle it again")
