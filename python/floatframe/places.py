"""Places on parts: the nodes of an interface or a marker. Lengths are in the units of the part."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from .arrays import number, numbers, text
from .errors import InputError

Vector = Sequence[float] | npt.NDArray[np.float64]
Direction = Literal["x", "y", "z", "-x", "-y", "-z"] | Vector
Tie = Literal["rigid", "mean"]


@dataclass(frozen=True)
class Place:
    """Nodes of a part and their coupling to an interface or a marker. Made by `set`, `node`, `nodes`, `nearest`, `plane`,
    `cylinder` and `sphere`, all of which accept:

    at: reference point, shape (3,); without it the centre of the nodes, the axis of a bore, the centre of a sphere.
    type: "rigid" (the nodes move as a rigid body, RBE2) or "mean" (it has their mean motion, RBE3). For interfaces.
    dofs: "all", or directions such as "xyz", "x+z", "xyz+rz". For interfaces.
    residual: loads act here, so attachment modes are added. For markers.
    """

    way: str
    values: dict[str, Any] = field(default_factory=dict)
    at: Vector | None = None
    type: Tie = "rigid"
    dofs: str = "all"
    residual: bool = False
    tolerance: float | None = None

    def as_dict(self, label: str, interface: bool) -> dict[str, Any]:
        """Converted for the C++ library; InputError contains `label`."""
        if not isinstance(self.residual, bool) or (interface and self.residual):
            raise InputError(f"{label}: residual belongs to markers: found {self.residual!r}, expected False")
        if not interface and (self.type != "rigid" or self.dofs != "all"):
            raise InputError(f"{label}: type and dofs belong to interfaces; a marker follows the mean motion of its nodes")
        return {
            "way": self.way,
            "values": {key: _value(f"{label}: {key}", key, value) for key, value in self.values.items() if value is not None},
            "at": None if self.at is None else vector(f"{label}: at", self.at),
            "type": text(f"{label}: type", self.type),
            "dofs": text(f"{label}: dofs", self.dofs),
            "residual": self.residual,
            "tolerance": 0.0 if self.tolerance is None else number(f"{label}: tolerance", self.tolerance, positive=True),
        }


def vector(name: str, value: object) -> tuple[float, float, float]:
    """Three finite numbers."""
    x, y, z = numbers(name, value, 3).tolist()
    return x, y, z


def direction(name: str, value: object) -> tuple[float, float, float]:
    """ "x", "-z", ... or a vector that is not zero."""
    if isinstance(value, str):
        sign = -1.0 if value.startswith("-") else 1.0
        letter = value.removeprefix("-")
        if len(letter) != 1 or letter not in "xyz":
            raise InputError(f"{name}: found '{value}', expected x, y, z, -x, -y, -z or a vector")
        return (sign * (letter == "x"), sign * (letter == "y"), sign * (letter == "z"))
    v = vector(name, value)
    if not any(v):
        raise InputError(f"{name}: found a vector of length zero, expected a direction")
    return v


def _value(name: str, key: str, value: object) -> object:
    if key == "set":
        return text(name, value)
    if key == "node":
        if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, np.integer)) or not 0 <= value < 2**31:
            raise InputError(f"{name}: found {value!r}, expected the number of a node")
        return int(value)
    if key in ("axis", "normal"):
        return direction(name, value)
    if key in ("radius", "length"):
        return number(name, value, positive=True)
    if key == "nodes":
        return value
    return vector(name, value)


def set_(
    name: str, *, at: Vector | None = None, type: Tie = "rigid", dofs: str = "all", residual: bool = False
) -> Place:
    """Nodes of a node set, a physical group, an element set or a surface of the file; for a mesh: of `point_sets` or
    `cell_sets`."""
    return Place("set", {"set": name}, at, type, dofs, residual)


def node(number: int, *, at: Vector | None = None, type: Tie = "rigid", dofs: str = "all", residual: bool = False) -> Place:
    """One node, by its number in the file; for a mesh: by its index from 0."""
    return Place("node", {"node": number}, at, type, dofs, residual)


def nodes(
    which: npt.ArrayLike, *, at: Vector | None = None, type: Tie = "rigid", dofs: str = "all", residual: bool = False
) -> Place:
    """Nodes of a mesh: indices from 0, or a mask, shape (nodes,): `ff.nodes(mesh.points[:, 0] < 1e-6)`."""
    return Place("nodes", {"nodes": which}, at, type, dofs, residual)


def nearest(point: Vector, *, at: Vector | None = None, type: Tie = "rigid", dofs: str = "all", residual: bool = False) -> Place:
    """The node nearest to a point, shape (3,)."""
    return Place("nearest", {"nearest": point}, at, type, dofs, residual)


def plane(
    point: Vector,
    normal: Direction,
    *,
    tolerance: float | None = None,
    at: Vector | None = None,
    type: Tie = "rigid",
    dofs: str = "all",
    residual: bool = False,
) -> Place:
    """Nodes on a plane through `point`. tolerance: largest distance; default 1e-3 of the size of the part."""
    return Place("plane", {"point": point, "normal": normal}, at, type, dofs, residual, tolerance)


def cylinder(
    origin: Vector,
    axis: Direction,
    radius: float,
    *,
    length: float | None = None,
    tolerance: float | None = None,
    at: Vector | None = None,
    type: Tie = "rigid",
    dofs: str = "all",
    residual: bool = False,
) -> Place:
    """Nodes on a bore: a cylinder of `radius` with `axis` through `origin`; with `length`, within half of it on both sides of
    `origin`. tolerance: largest distance from it; default 1e-3 of the radius."""
    values = {"point": origin, "axis": axis, "radius": radius, "length": length}
    return Place("cylinder", values, at, type, dofs, residual, tolerance)


def sphere(
    centre: Vector,
    radius: float,
    *,
    tolerance: float | None = None,
    at: Vector | None = None,
    type: Tie = "rigid",
    dofs: str = "all",
    residual: bool = False,
) -> Place:
    """Nodes on a sphere. tolerance: largest distance from it; default 1e-3 of the radius."""
    return Place("sphere", {"point": centre, "radius": radius}, at, type, dofs, residual, tolerance)
