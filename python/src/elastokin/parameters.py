"""The numbers of a deck as a mapping."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Parameter(NamedTuple):
    """One number of the deck."""

    value: float
    """In `unit`."""
    unit: str
    """Of the deck, as "N/mm"; "" without dimension."""
    is_given: bool
    """Whether the deck gives the number; otherwise it has its default."""
    left: str | None
    """On a mirrored axle, for a number of the right side: path of the same number on the left side."""


class Parameters(Mapping[str, Parameter]):
    """All numbers of a deck, from path to value and unit, with their present values. Numbers are changed through the model."""

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
        """On a mirrored axle: paths that lead to both sides (`spring.coil.rate`), with the paths of the left and of the right number."""
        pairs: dict[str, tuple[str, str]] = {}
        for k, j in enumerate(self._left):
            group, _, rest = self.paths[j].partition(".")
            if j >= 0 and rest.startswith("left_"):
                pairs[f"{group}.{rest.removeprefix('left_')}"] = self.paths[j], self.paths[k]
        return pairs

    def index(self, path: str) -> int:
        """Position of a number in `Model.x`. Raises KeyError."""
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
