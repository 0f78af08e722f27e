"""The result of a case: one row per state, one column per quantity."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import errors

if TYPE_CHECKING:
    from .model import Model

Heading = tuple[str, str, str]      # unit, title, sign of a column


class Remark(NamedTuple):
    """A note, warning or failure of a solution."""

    severity: str
    """"note", "warning" or "failure"."""
    text: str


class Derivatives(NamedTuple):
    """Derivatives of columns with respect to numbers at a state."""

    values: NDArray[np.float64]
    """Columns x numbers, unit of the column per unit of the number. NaN: no convergence, no value at the state, or not changeable."""
    errors: NDArray[np.float64]
    """Estimates of the errors of `values`; large where the column has a corner (a stop at contact, a point of a curve)."""


class Result:
    """States of one case of a model. A change of the model does not change the result."""

    case: str
    """Name of the case."""
    columns: tuple[str, ...]
    """Names of the columns. A name ends with the unit, as "left_toe_deg"."""
    values: NDArray[np.float64]
    """States x columns. NaN if the state did not converge or the quantity is not defined at the state."""
    remarks: tuple[Remark, ...]
    """Notes, warnings and failures of the solution."""
    status: int
    """0, or 4 if some states did not converge."""

    def __init__(
        self, model: Model, serial: int, case: str, columns: tuple[str, ...], headings: tuple[Heading, ...],
        values: NDArray[np.float64], remarks: tuple[Remark, ...], status: int,
    ) -> None:
        self.case = case
        self.columns = columns
        self.values = values
        self.remarks = remarks
        self.status = status
        self._headings = headings
        self._model: Model | None = model
        self._serial = serial
        self._matrices: dict[int, NDArray[np.float64]] = {}

    # ---- columns ----

    def __getitem__(self, column: str) -> NDArray[np.float64]:
        """The values of a column, one per state."""
        try:
            return self.values[:, self.columns.index(column)]
        except ValueError:
            raise errors.UsageError(f"case '{self.case}' has no column '{column}'") from None

    def __contains__(self, column: object) -> bool:
        return column in self.columns

    def __len__(self) -> int:
        """Number of states."""
        return len(self.values)

    @property
    def units(self) -> dict[str, str]:
        """Unit of each column by name, as "deg"; "" if the column is dimensionless."""
        return {name: heading[0] for name, heading in zip(self.columns, self._headings)}

    @property
    def titles(self) -> dict[str, str]:
        """Title of each column by name, as "Toe"; "" if it has no title."""
        return {name: heading[1] for name, heading in zip(self.columns, self._headings)}

    @property
    def signs(self) -> dict[str, str]:
        """Meaning of positive values of each column by name, as "+ front edge inward"; "" if it has no sign."""
        return {name: heading[2] for name, heading in zip(self.columns, self._headings)}

    @property
    def converged(self) -> bool:
        """Whether every state converged. `result["converged"]` has 1 or 0 for each state."""
        return self.status == errors.OK

    # ---- compliance ----

    def compliance(self, row: int) -> NDArray[np.float64]:
        """Compliance matrix at a state; both dimensions are 6 x wheels.

        Rows are displacement [m] and rotation [rad] of each wheel centre (x y z, rx ry rz). Columns are force [N] and moment [N m] at each
        wheel centre. Both are in the frame of the deck. The vertical forces on all wheels are held. The matrix is available until the model
        solves its next case. Matrices already read, and all matrices after `solve(..., compliance=True)`, stay available.
        """
        k = range(len(self.values))[row]
        if k not in self._matrices:
            if self._model is None:
                raise errors.UsageError("a copied result has only the compliance matrices that were computed before; "
                                        "solve with compliance=True")
            self._matrices[k] = self._model._compliance(self._serial, k)
        return self._matrices[k]

    def derivatives(self, columns: Sequence[str], numbers: Sequence[str], row: int) -> Derivatives:
        """Exact derivatives of columns with respect to parameters of the deck at a state. No solution is repeated.

        `columns`: columns of the case, or entries of its compliance matrix (names as in `elastokin run --compliance`); for a result with
        `definitions`, also its columns ("left Toe Angle [deg]"). `numbers`: paths;
        each stands for one number, or for this number on both sides of a mirrored axle. Derivatives account for the change of the
        state, of the static equilibrium and of the trimmed preloads (balance). They are available until the model solves its next
        case. Raises UsageError, also for a case with a method other than "equilibrium".
        """
        if self._model is None:
            raise errors.UsageError("a copied result has no derivatives; solve with a model")
        wanted = [columns] if isinstance(columns, str) else list(columns)
        paths = [numbers] if isinstance(numbers, str) else list(numbers)
        k = range(len(self.values))[row]
        return Derivatives(*self._model._derivatives(self._serial, k, wanted, paths))

    # ---- tables of other packages ----

    def to_dataframe(self) -> Any:
        """A pandas DataFrame with one row per state; `attrs["units"]` has the units. Requires pandas."""
        frame = import_module("pandas").DataFrame(self.values, columns=list(self.columns))
        frame.attrs.update(case=self.case, units=self.units)
        return frame

    def to_xarray(self) -> Any:
        """An xarray Dataset over the dimension `state`; variables have the attributes `units`, `long_name`, `sign`. Requires xarray."""
        data: dict[str, Any] = {}
        for k, (name, heading) in enumerate(zip(self.columns, self._headings)):
            attributes = {key: text for key, text in zip(("units", "long_name", "sign"), heading) if text}
            data[name] = ("state", self.values[:, k].copy(), attributes)
        coordinate = data.pop("state", ("state", np.arange(1, len(self.values) + 1), {}))
        dataset = import_module("xarray").Dataset(data, coords={"state": coordinate}, attrs={"case": self.case})
        return dataset.set_coords([name for name in ("factor",) if name in dataset])

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_model": None}

    def __repr__(self) -> str:
        lost = "" if self.converged else f", {int(np.count_nonzero(self['converged'] != 1))} not converged"
        return f"<Result of '{self.case}': {self.values.shape[0]} states{lost}, {self.values.shape[1]} columns>"
