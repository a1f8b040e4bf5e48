"""One call, one result: counts, equilibrium, mass, linear systems, modes, responses, rotors, advice.

Results are plain objects; their arrays share the memory of the result, are read-only, and keep it alive. Options are those of
`Options`. All raise InputError for invalid input and RunError if a start or a result cannot be found.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from . import _core
from .arrays import number, numbers as array, text, texts, whole
from .model import Model, built
from .options import Array, Coordinates, Inertia, Options, as_dict

if TYPE_CHECKING:
    from typing_extensions import Unpack


def check(model: Model) -> _core.ModelCounts:
    """Bodies, joints, coordinates and constraints of both formulations, degrees of freedom."""
    return _core.check(built(model))


def statics(model: Model) -> _core.StaticsResult:
    """The static equilibrium: forces, reactions, positions; runs can start from its `state`."""
    return _core.statics(built(model))


def mass_properties(model: Model, **options: Unpack[Options]) -> _core.ModelMass:
    """Mass [kg], centre of mass [m] and inertia [kg m2] of the whole model and of its bodies, at the start."""
    return _core.mass_properties(built(model), as_dict(options))


def linearize(model: Model, **options: Unpack[Options]) -> _core.Linearization:
    """M, C, K, J of the motion near the start, in the coordinates of the options."""
    return _core.linearize(built(model), as_dict(options))


def linear_system(model: Model, **options: Unpack[Options]) -> _core.LinearSystem:
    """zdot = A z near the start, also for a moving model, with as many z as there are degrees of freedom."""
    return _core.linear_system(built(model), as_dict(options))


def modes(model: Model, *, number: int | None = None, **options: Unpack[Options]) -> list[_core.Mode]:
    """Vibrations near the start, ascending by |eigenvalue|, pairs once: all, or the given number. A few modes of a model of
    more than 400 degrees of freedom take seconds, all of them minutes; their `z` has no physical meaning."""
    count = 0 if number is None else whole("number", number, 1, 1000)
    return _core.modes(built(model), count, as_dict(options))


def linear_inputs(model: Model) -> list[str]:
    """Possible inputs of `linear_model`: inputs, prescribed motions, roads."""
    return _core.linear_inputs(built(model))


def linear_model(
    model: Model, inputs: Sequence[str] = (), outputs: Sequence[str] = (), **options: Unpack[Options]
) -> _core.LinearModel:
    """The linear system between inputs and outputs (none named: all). `state_space()` gives A, B, C, D, `response` the
    frequency response."""
    return _core.linear_model(built(model), texts("inputs", inputs), texts("outputs", outputs), as_dict(options))


def frequency_response(
    model: Model, frequencies: npt.ArrayLike, inputs: Sequence[str] = (), outputs: Sequence[str] = (), **options: Unpack[Options]
) -> npt.NDArray[np.complex128]:
    """G at frequencies [Hz] of shape (n,): complex, shape (n, outputs, inputs)."""
    return linear_model(model, inputs, outputs, **options).response(numbers(frequencies))


def road_response(
    model: Model,
    outputs: Sequence[str],
    frequencies: npt.ArrayLike,
    *,
    speed: float,
    roughness: float = 256e-6,
    waviness: float = 2.0,
    band: tuple[float, float] = (0.1, 50.0),
    **options: Unpack[Options],
) -> _core.RoadResponse:
    """Spectral densities of outputs at frequencies [Hz], and rms values in the band [Hz], on a random road at a speed
    [m/s]. roughness: G0 at 0.1 cycles/m [m3] (class C)."""
    low, high = array("band", band, 2)
    road = number("speed", speed), number("roughness", roughness), number("waviness", waviness), (float(low), float(high))
    return _core.road_response(built(model), texts("outputs", outputs), numbers(frequencies), *road, as_dict(options))


def campbell(
    model: Model,
    joint: str,
    from_: float,
    to: float,
    step: float,
    *,
    axis: Sequence[float] | None = None,
    orders: Sequence[float] = (1.0,),
    modes: int = 12,
) -> _core.CampbellDiagram:
    """Vibrations over the speed of a rotor [rad/s] that rotates in `joint`; critical speeds of the orders; onset of
    instability. axis: of a free joint, shape (3,); None: the symmetry axis of the rotor, or the axis of its bearings."""
    along = None if axis is None else tuple(float(c) for c in array("axis", axis, 3))
    speeds = number("from_", from_), number("to", to), number("step", step)
    multiples = [float(n) for n in array("orders", orders, "orders")]
    return _core.campbell(built(model), text("joint", joint), *speeds, along, multiples, whole("modes", modes, 1, 10**6))


def advise(
    model: Model,
    *,
    drop_share: float = 1e-3,
    static_ratio: float = 0.05,
    tolerance: float = 0.01,
    repeat: int = 1,
    step: float | None = None,
    coordinates: Coordinates | None = None,
    inertia: Inertia | None = None,
) -> _core.ModeAdviceReport:
    """Modes that the model does not need, verified by runs. tolerance: of the range of every output."""
    options: dict[str, object] = {"step": step, "coordinates": coordinates, "inertia": inertia}
    limits = number("drop_share", drop_share), number("static_ratio", static_ratio), number("tolerance", tolerance)
    return _core.advise(built(model), options, *limits, whole("repeat", repeat, 1, 10**6))


def model_order(model: Model, below: float, tolerance: float = 0.01) -> _core.ModelOrder:
    """Number of modes of each body needed for the vibrations below a frequency [Hz], verified; tolerance: of frequencies."""
    return _core.model_order(built(model), number("below", below), number("tolerance", tolerance))


def numbers(values: npt.ArrayLike) -> Array:
    """Frequencies as an array of one dimension; a single number becomes one element."""
    return array("frequencies", [values] if np.ndim(values) == 0 else values, "frequencies")
