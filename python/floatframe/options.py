"""Options of runs, simulations and analyses."""

from __future__ import annotations

from typing import Any, Literal, TypedDict

import numpy as np
import numpy.typing as npt

from ._core import State

Array = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]
Coordinates = Literal["relative", "absolute"]
Inertia = Literal["preprocessing", "projection"]
Start = Literal["given", "equilibrium"]
InputUse = Literal["held", "ramp"]


class Options(TypedDict, total=False):
    """Each given option replaces that of the model (`simulation:` of the model file, docs/model-file.md)."""

    step: float | None
    """[s]"""
    coordinates: Coordinates | None
    inertia: Inertia | None
    start: Start | State | None
    """Values as given, the static equilibrium, or a state."""
    tolerance: float | None
    spectral_radius: float | None
    max_iterations: int | None
    min_step: float | None
    """Smallest substep [s]; 0: step / 1024."""
    penalty: float | None
    position_tolerance: float | None
    """[m]"""
    velocity_tolerance: float | None
    """[m/s]"""
    locate_edges: bool | None
    input: InputUse | None
    """Course of changed inputs in the next step: constant, or a ramp from their last values."""


def as_dict(options: Any) -> dict[str, Any]:
    """Options for the C++ library."""
    return dict(options)
