"""Meshes for the tests of parts."""

from pathlib import Path

import floatframe as ff
import numpy as np

DATA = Path(__file__).resolve().parents[2] / "tests" / "data" / "fe"
ARM = DATA / "aarm_coarse.msh.gz"
STEEL_MM = ff.Material(200000.0, 0.3, 7.85e-9)
STEEL = ff.Material(2e11, 0.3, 7850.0)


def box(n=(6, 2, 2), size=(0.6, 0.1, 0.1)):
    """Points and hexahedra of a block."""
    axes = [np.linspace(0.0, s, k + 1) for s, k in zip(size, n, strict=True)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    index = np.arange(len(points)).reshape([k + 1 for k in n])
    corner = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    cells = [index[i : i + n[0], j : j + n[1], k : k + n[2]].ravel() for i, j, k in corner]
    return points, np.stack(cells, axis=1)


def mesh(**sets):
    points, cells = box()
    return ff.Mesh(points, [("hex8i", cells)], sets)


ENDS = {"A": ff.plane([0, 0, 0], "x"), "B": ff.plane([0.6, 0, 0], "x")}
QUICK = {"material": STEEL, "modes": 3, "free_check": False}
