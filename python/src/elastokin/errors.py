"""What can fail: one exception per code of the library, and a warning for states that did not converge."""

from __future__ import annotations

OK, USAGE, DECK, MODEL, CONVERGENCE, FILE = range(6)


class ElastokinError(Exception):
    """Base of all errors of elastokin. `code` is the exit status of the program `elastokin` for the same fault."""

    code: int = USAGE


class UsageError(ElastokinError, ValueError):
    """An unknown path, case, column or key number, or a position outside its range."""

    code = USAGE


class DeckError(ElastokinError, ValueError):
    """Mistakes of the deck, or a value outside its legal range; the message lists all of them with file and line."""

    code = DECK


class ModelError(ElastokinError):
    """The model is a mechanism or has redundant constraints: nothing was solved."""

    code = MODEL


class ConvergenceError(ElastokinError):
    """No state converged, so there is no result."""

    code = CONVERGENCE


class FileError(ElastokinError, OSError):
    """A file cannot be read, or the memory does not suffice."""

    code = FILE


class ConvergenceWarning(UserWarning):
    """Some states did not converge. Their rows hold NaN and `converged` = 0, and key numbers that need them are NaN; the others are good."""


class ModelWarning(UserWarning):
    """A deck was read whose model may be wrong: no spring, a contact point that is not on the ground, implausible values, or a model that
    cannot be solved. The message has all of `Model.remarks`."""


_CLASSES: dict[int, type[ElastokinError]] = {
    kind.code: kind for kind in (UsageError, DeckError, ModelError, ConvergenceError, FileError)
}


def error_of(code: int, message: str) -> ElastokinError:
    """The exception for a code of the library."""
    return _CLASSES.get(code, ElastokinError)(message)
