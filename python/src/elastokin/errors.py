"""Exceptions, one for each code of the library, and warnings on states that did not converge and on models with remarks."""

from __future__ import annotations

OK, USAGE, DECK, MODEL, CONVERGENCE, FILE = range(6)


class ElastokinError(Exception):
    """Base class of all errors of elastokin. `code` is the exit status of the program `elastokin` for the same error."""

    code: int = USAGE


class UsageError(ElastokinError, ValueError):
    """An unknown path, case, column or K&C metric, or an index outside its range."""

    code = USAGE


class DeckError(ElastokinError, ValueError):
    """Errors of the deck, or values outside their legal ranges. The message lists all of them with file and line."""

    code = DECK


class ModelError(ElastokinError):
    """The model is a mechanism or has redundant constraints; no case was solved."""

    code = MODEL


class ConvergenceError(ElastokinError):
    """No state converged, so there is no result."""

    code = CONVERGENCE


class FileError(ElastokinError, OSError):
    """A file cannot be read, or memory does not suffice."""

    code = FILE


class ConvergenceWarning(UserWarning):
    """Some states did not converge. Their rows have NaN and `converged` = 0. K&C metrics that require them are NaN. Others are valid."""


class ModelWarning(UserWarning):
    """The model of an opened deck may be wrong: no spring, a contact point that does not match the wheel, implausible values, or a model
    that cannot be solved. The message contains all `Model.remarks`."""


_CLASSES: dict[int, type[ElastokinError]] = {
    kind.code: kind for kind in (UsageError, DeckError, ModelError, ConvergenceError, FileError)
}


def error_of(code: int, message: str) -> ElastokinError:
    """Returns the exception for a code of the library."""
    return _CLASSES.get(code, ElastokinError)(message)
