"""elastokin: kinematics and compliance of vehicle suspensions.

    import elastokin

    model = elastokin.Model.from_file("axle.nml")
    model["bushing.lca_front.kt(1)"] = 500
    result = model.solve("parallel_travel")
    print(result["left_toe_deg"], model.numbers("left_wheel_rate"))
"""

from ._library import lib as _lib, text_of as _text_of
from .errors import (
    ConvergenceError,
    ConvergenceWarning,
    DeckError,
    ElastokinError,
    FileError,
    ModelError,
    ModelWarning,
    UsageError,
)
from .model import Model
from .parameters import Parameter, Parameters
from .result import Derivatives, Remark, Result

__version__: str = _text_of(_lib.ek_version())

__all__ = [
    "ConvergenceError",
    "ConvergenceWarning",
    "DeckError",
    "Derivatives",
    "ElastokinError",
    "FileError",
    "Model",
    "ModelError",
    "ModelWarning",
    "Parameter",
    "Parameters",
    "Remark",
    "Result",
    "UsageError",
]
