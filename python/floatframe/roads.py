"""Roads: heights, slopes and friction above places, of a model or of an OpenCRG file."""

from __future__ import annotations

from typing import Literal

import numpy as np
import numpy.typing as npt

from . import _core
from .arrays import Array, numbers, text
from .arrays import path as path_of
from .errors import InputError
from .model import Model, PathLike, built

Border = Literal["none", "zero", "keep", "repeat", "reflect"]


class Road:
    """A road over x and y [m], in the axes of the model or of the file. x and y are numbers or arrays that broadcast, and what is
    returned has their shape; it is not a number where there is no road.

    `Road.of(model, "plane")`: that of a model. `Road.read("belgian_block.crg")`: a measured one.
    """

    __slots__ = ("_core",)

    def __init__(self, core: _core.Road) -> None:
        self._core = core

    @classmethod
    def of(cls, model: Model, name: str) -> Road:
        """A road of the model. Raises UnknownNameError."""
        return cls(_core.road_of(built(model), text("name", name)))

    @classmethod
    def read(
        cls,
        path: PathLike,
        *,
        interpolation: Literal["linear", "cubic"] = "linear",
        border_u: Border | None = None,
        border_v: Border | None = None,
        begin: Literal["file", "origin"] = "file",
    ) -> Road:
        """An OpenCRG file (1.2; LRFI, LDFI, KRBI, KDBI), by the keys of `crg` in docs/model-file.md. Borders not given are those
        of the file. Raises InputError."""
        return cls(_core.read_road(path_of("path", path), interpolation, border_u, border_v, begin))

    @property
    def name(self) -> str:
        """Of the road in its model, or of the file."""
        return self._core.name

    @property
    def notes(self) -> list[str]:
        """What of the file has no effect, or was filled in, a sentence each."""
        return self._core.notes

    def _points(self, x: npt.ArrayLike, y: npt.ArrayLike) -> tuple[Array, tuple[int, ...]]:
        a = numbers("x", np.ravel(x), "places").reshape(np.shape(x))
        b = numbers("y", np.ravel(y), "places").reshape(np.shape(y))
        try:
            a, b = np.broadcast_arrays(a, b)
        except ValueError:
            raise InputError(f"x, y: found the shapes {a.shape} and {b.shape}, expected shapes that broadcast") from None
        return self._core.points(np.ascontiguousarray(a.ravel()), np.ascontiguousarray(b.ravel())), a.shape

    def height(self, x: npt.ArrayLike, y: npt.ArrayLike) -> Array:
        """[m]"""
        points, shape = self._points(x, y)
        return np.ascontiguousarray(points[:, 0]).reshape(shape)

    def slope(self, x: npt.ArrayLike, y: npt.ArrayLike) -> tuple[Array, Array]:
        """dz/dx and dz/dy [-]."""
        points, shape = self._points(x, y)
        return np.ascontiguousarray(points[:, 1]).reshape(shape), np.ascontiguousarray(points[:, 2]).reshape(shape)

    def friction(self, x: npt.ArrayLike, y: npt.ArrayLike) -> Array:
        """Factor of the friction that tyres have [-]."""
        points, shape = self._points(x, y)
        return np.ascontiguousarray(points[:, 3]).reshape(shape)

    def __repr__(self) -> str:
        return f"Road({self.name!r})"
