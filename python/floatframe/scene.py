"""The bodies of a run as meshes of pyvista."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from .arrays import number

if TYPE_CHECKING:
    import pyvista


class RunScene:
    """Grids of a run at its recorded instants. Cells are the same at all of them."""

    def __init__(self, core: _core.Scene) -> None:
        self._core = core
        self._cells: Any = None

    def at(self, time: float | None) -> pyvista.UnstructuredGrid:
        """The recorded instant nearest to `time` [s]; None: the last."""
        import pyvista

        instant = self._core.instants - 1 if time is None else self._core.nearest(number("time", time))
        made: tuple[Any, ...] = self._core.at(instant)
        points, point_data, connectivity, ends, types, cell_data, texts, t = made
        if self._cells is None:
            starts = np.concatenate([[0], ends[:-1]]) if len(ends) else ends
            self._cells = np.insert(connectivity.astype(np.int64), starts, np.diff(ends, prepend=0))
        grid = pyvista.UnstructuredGrid(self._cells, types, points)
        for name, values in point_data.items():
            grid.point_data.set_array(values, name)
        for name, values in cell_data.items():
            grid.cell_data.set_array(values, name)
        for name, words in texts.items():
            grid.field_data.set_array(words, name)
        grid.field_data.set_array([t], "TimeValue")
        return grid
