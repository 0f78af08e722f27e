"""The parameters of a deck as a mapping."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Parameter(NamedTuple):
    """One parameter of the deck."""

    value: float
    """Current value in `unit`."""
    unit: str
    """Unit of the deck, as "N/mm"; "" if the number is dimensionless."""
    is_given: bool
    """Whether the deck gives the number. If not, the value is the default."""
    left: str | None
    """For a number of the right side of a mirrored axle: path of the corresponding number of the left side. Otherwise None."""


class Parameters(Mapping[str, Parameter]):
    """Mapping from the path of each parameter of a deck to its current value and its unit. Change numbers with the model."""

    def __init__(
        self, paths: tuple[str, ...], units: tuple[str, ...], given: tuple[bool, ...], left: tuple[int, ...],
        values: Callable[[], NDArray[np.float64]],
    ) -> None:
        self.paths = paths
        """The paths, in the order of `Model.x`."""
        self.units = units
        """The units, in the order of `Model.x`."""
        self._given = given
        self._left = left
        self._values = values
        self._index = {path: k for k, path in enumerate(paths)}

    @property
    def common_paths(self) -> dict[str, tuple[str, str]]:
        """For a mirrored axle: each path that stands for both sides (`spring.coil.rate`), with the paths of its left and right numbers."""
        pairs: dict[str, tuple[str, str]] = {}
        for k, j in enumerate(self._left):
            group, _, rest = self.paths[j].partition(".")
            if j >= 0 and rest.startswith("left_"):
                pairs[f"{group}.{rest.removeprefix('left_')}"] = self.paths[j], self.paths[k]
        return pairs

    def index(self, path: str) -> int:
        """Index of a number in `Model.x`. Raises KeyError if there is no such path."""
        return self._index[path]

    def __getitem__(self, path: str) -> Parameter:
        k = self._index[path]
        left = self._left[k]
        return Parameter(float(self._values()[k]), self.units[k], self._given[k], self.paths[left] if left >= 0 else None)

    def __iter__(self) -> Iterator[str]:
        return iter(self.paths)

    def __len__(self) -> int:
        return len(self.paths)

    def __repr__(self) -> str:
        return f"<Parameters: {len(self.paths)} numbers>"
