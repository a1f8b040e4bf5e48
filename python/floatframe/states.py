"""Numbers of a state by names: those that linear systems have as states, and that simulations read and set."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple, Union

import numpy as np

from .arrays import number, numbers, text
from .errors import InputError


class StateName(NamedTuple):
    """One number of a state: a coordinate of a joint, the amplitude of a mode, a state of an element, or the rate of one."""

    kind: str
    """"joint", "mode", "element"; of linear models also "input" (a derivative of one), "body" and "combination" (without a name)."""
    name: str
    """Of the joint, body, element or input."""
    index: int  # type: ignore[assignment]
    """Of the coordinate, mode or state, from 0."""
    rate: bool
    """Its derivative with respect to time."""

    def __str__(self) -> str:
        return f"{'rate of ' if self.rate else ''}{self.kind} {self.index} of '{self.name}'"


Values = Mapping[str, Union[float, Sequence[float]]]
"""A number for each joint, or a list of them; for a flexible body the amplitudes of its modes."""


def given(what: str, values: Values | None, rate: bool, joints: Sequence[str], bodies: Sequence[str]) -> list[tuple[StateName, float]]:
    """Values by the names of joints, and of bodies for their modes, one by one. A name of both is that of the joint."""
    if values is None:
        return []
    if not isinstance(values, Mapping):
        raise InputError(f"{what}: found {type(values).__name__}, expected a map of joints or bodies and values")
    out = []
    for name, value in values.items():
        kind = "mode" if text(what, name) in bodies and name not in joints else "joint"
        if np.ndim(value) == 0:
            out.append((StateName(kind, name, 0, rate), number(f"{what}['{name}']", value)))
            continue
        for k, x in enumerate(numbers(f"{what}['{name}']", value, "coordinates")):
            out.append((StateName(kind, name, k, rate), float(x)))
    return out
