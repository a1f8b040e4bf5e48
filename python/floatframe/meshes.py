"""Meshes from other programs: converts arrays of points, cells and sets to a finite-element model. `meshio.Mesh` and
`pyvista.UnstructuredGrid` are accepted directly; neither is imported here."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from .arrays import Array, Whole, number, numbers, text, truths, whole_numbers
from .errors import InputError

AnyMesh = Any
"""`floatframe.Mesh`, `meshio.Mesh`, or a mesh of pyvista: UnstructuredGrid, StructuredGrid, ImageData, PolyData, ..."""


@dataclass(frozen=True)
class Material:
    """Linear elastic, isotropic, in the units of the part: young [Pa], poisson [-], density [kg/m3]."""

    young: float
    poisson: float
    density: float

    def checked(self) -> tuple[float, float, float]:
        return (
            number("material: young", self.young, positive=True),
            number("material: poisson", self.poisson, low=-1.0, high=0.5),
            number("material: density", self.density, positive=True),
        )


@dataclass(frozen=True)
class BeamSection:
    """Section of beams: area A [m2], second moments Iy, Iz [m4] about the local y and z, torsion constant J [m4], in the units
    of the part. `reference`, shape (3,): the local y is in the plane of the axis and this vector."""

    A: float
    Iy: float
    Iz: float
    J: float
    reference: Sequence[float] = (0.0, 0.0, 1.0)


@dataclass(frozen=True)
class Mesh:
    """Points, shape (nodes, 3); cells: pairs of an element type and indices of points from 0, shape (cells, nodes of the type),
    corners first as in VTK and Abaqus; node sets by name, indices or masks.

    Types: tet4, tet10, hex8, hex8i, hex8r, hex20, hex20r, wedge6, wedge15, pyramid5, pyramid13 (solids), tri3, quad4, tri6,
    quad8 (shells: with `thickness`), beam2, beam3 (with `section`).
    """

    points: npt.ArrayLike
    cells: Sequence[tuple[str, npt.ArrayLike]]
    sets: Mapping[str, npt.ArrayLike] = field(default_factory=dict)


# Nodes and dimension of each element.
_ELEMENTS = {
    "beam2": (2, 1),
    "beam3": (3, 1),
    "tri3": (3, 2),
    "quad4": (4, 2),
    "tri6": (6, 2),
    "quad8": (8, 2),
    "tet4": (4, 3),
    "tet10": (10, 3),
    "hex8": (8, 3),
    "hex8i": (8, 3),
    "hex8r": (8, 3),
    "hex20": (20, 3),
    "hex20r": (20, 3),
    "wedge6": (6, 3),
    "wedge15": (15, 3),
    "pyramid5": (5, 3),
    "pyramid13": (13, 3),
}
_MESHIO = {
    "line": "beam2",
    "triangle": "tri3",
    "quad": "quad4",
    "triangle6": "tri6",
    "quad8": "quad8",
    "tetra": "tet4",
    "tetra10": "tet10",
    "hexahedron": "hex8",
    "hexahedron20": "hex20",
    "wedge": "wedge6",
    "wedge15": "wedge15",
    "pyramid": "pyramid5",
    "pyramid13": "pyramid13",
}
# Cells that bound others and may have names: their dimension. They are not elements.
_MESHIO_OTHERS = {"vertex": 0, "line3": 1, "triangle7": 2, "quad9": 2}
_VTK = {3: "line", 5: "triangle", 9: "quad", 10: "tetra", 12: "hexahedron", 13: "wedge"}
_VTK |= {14: "pyramid", 22: "triangle6", 23: "quad8", 24: "tetra10", 25: "hexahedron20", 26: "wedge15", 27: "pyramid13"}
_VTK_OTHERS = {1: "vertex", 21: "line3", 28: "quad9", 34: "triangle7"}
# A brick along the axes, in the order of its coordinates.
_VOXEL, _VOXEL_CORNERS = 11, (0, 1, 3, 2, 4, 5, 7, 6)
# A wedge of VTK has the opposite orientation to other programs; writers disagree, so each is oriented by its geometry.
_MIRRORED = {"wedge6": (0, 2, 1, 3, 5, 4), "wedge15": (0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13)}


@dataclass
class _Cells:
    """Elements of one type; `word` is empty for those that only have names."""

    word: str
    name: str
    dimension: int
    nodes: Whole


def _is_meshio(mesh: object) -> bool:
    return all(hasattr(mesh, name) for name in ("points", "cells", "point_sets", "cell_sets"))


def _is_pyvista(mesh: object) -> bool:
    return all(hasattr(mesh, name) for name in ("points", "cells_dict", "celltypes"))


def _is_grid(mesh: object) -> bool:
    """A structured grid or surface of pyvista, which is converted to cells."""
    return hasattr(mesh, "cast_to_unstructured_grid") and not _is_pyvista(mesh)


def is_mesh(mesh: object) -> bool:
    """True for a mesh of a supported kind."""
    return isinstance(mesh, Mesh) or _is_pyvista(mesh) or _is_grid(mesh) or _is_meshio(mesh)


def _cells(name: str, word: str, dimension: int, nodes: object, columns: int | str) -> _Cells:
    return _Cells(word, name, dimension, whole_numbers(f"cells of the type '{name}'", nodes, "cells", columns))


def _of_meshio_name(name: str, nodes: object) -> _Cells:
    if name in _MESHIO:
        word = _MESHIO[name]
        return _cells(name, word, _ELEMENTS[word][1], nodes, _ELEMENTS[word][0])
    if name in _MESHIO_OTHERS:
        return _cells(name, "", _MESHIO_OTHERS[name], nodes, "nodes")
    raise InputError(f"cells: found the type '{name}', expected one of {', '.join(_MESHIO)}")


def _of_mesh(mesh: Mesh) -> list[_Cells]:
    out = []
    try:
        blocks = [(word, nodes) for word, nodes in mesh.cells]
    except (TypeError, ValueError):
        raise InputError("cells: expected a list of pairs of an element type and its nodes") from None
    for word, nodes in blocks:
        if word not in _ELEMENTS:
            raise InputError(f"cells: found the type {word!r}, expected one of {', '.join(_ELEMENTS)}")
        out.append(_cells(word, word, _ELEMENTS[word][1], nodes, _ELEMENTS[word][0]))
    return out


def _of_pyvista(mesh: Any, points: Array) -> list[_Cells]:
    out = []
    for kind, nodes in mesh.cells_dict.items():
        if int(kind) == _VOXEL:
            out.append(_of_meshio_name("hexahedron", nodes[:, _VOXEL_CORNERS]))
            continue
        name = _VTK.get(int(kind)) or _VTK_OTHERS.get(int(kind))
        if name is None:
            raise InputError(f"cells: found the VTK type {int(kind)}, expected one of {', '.join(_VTK.values())}")
        cells = _of_meshio_name(name, nodes)
        if cells.word in _MIRRORED:
            _turn(cells, points)
        out.append(cells)
    return out


def _turn(cells: _Cells, points: Array) -> None:
    if cells.nodes.size and (cells.nodes.min() < 0 or cells.nodes.max() >= len(points)):
        return  # reported with the others
    a, b, c, d, e, f = (points[cells.nodes[:, k]] for k in range(6))
    height = np.einsum("ij,ij->i", np.cross(b - a, c - a), d + e + f - a - b - c)
    wrong = height < 0.0
    cells.nodes[wrong] = cells.nodes[wrong][:, _MIRRORED[cells.word]]


def _mask_or_indices(name: str, value: object, count: int) -> Whole:
    mask = truths(value)
    if mask is not None:
        if mask.shape != (count,):
            raise InputError(f"{name}: found a mask of the shape {mask.shape}, expected ({count},)")
        return np.flatnonzero(mask).astype(np.int64)
    indices = whole_numbers(name, value, "nodes")
    if indices.size and (indices.min() < 0 or indices.max() >= count):
        worst = indices.min() if indices.min() < 0 else indices.max()
        raise InputError(f"{name}: found the node {worst}, expected 0 to {count - 1}")
    return indices


def _sets(mesh: Any, cells: list[_Cells], count: int) -> dict[str, Whole]:
    """Node sets, and the nodes of sets of cells."""
    out: dict[str, Whole] = {}
    given = mesh.sets if isinstance(mesh, Mesh) else getattr(mesh, "point_sets", None) or {}
    if not isinstance(given, Mapping):
        raise InputError(f"sets: found {type(given).__name__}, expected names with their nodes")
    for name, which in given.items():
        out[text("sets: a name", name)] = _mask_or_indices(f"the node set '{name}'", which, count)
    for name, blocks in (getattr(mesh, "cell_sets", None) or {}).items():
        if name.startswith("gmsh:") or name in out:
            continue
        found = [np.zeros(0, dtype=np.int64)]
        for block, which in zip(cells, blocks, strict=False):
            if which is not None and len(which):
                found.append(block.nodes[np.asarray(which, dtype=np.int64)].ravel())
        out[text("cell_sets: a name", name)] = np.unique(np.concatenate(found))
    return out


def _used(cells: list[_Cells], thickness: float | None, section: BeamSection | None) -> list[_Cells]:
    """Cells that become elements: surfaces and lines of a solid only if they have a section."""
    full = [c for c in cells if len(c.nodes)]
    highest = max((c.dimension for c in full), default=0)
    out = []
    for c in full:
        missing = {1: section is None, 2: thickness is None}.get(c.dimension, False)
        if c.dimension == 0 or (missing and c.dimension < highest):
            continue
        if missing:
            raise InputError(f"cells: found the type '{c.name}': {'section' if c.dimension == 1 else 'thickness'} is missing")
        if not c.word:
            raise InputError(f"cells: found the type '{c.name}', expected one of {', '.join(_MESHIO)}")
        out.append(c)
    if not out:
        raise InputError("cells: found no solids, shells or beams, expected some")
    return out


def fe_model(
    mesh: AnyMesh,
    material: Material | None,
    thickness: float | None = None,
    section: BeamSection | None = None,
    more_sets: Mapping[str, object] | None = None,
) -> _core.FeModel:
    """The model of a mesh; `more_sets`: indices or masks of nodes by the names of new sets."""
    if not is_mesh(mesh):
        raise InputError(
            f"found {type(mesh).__name__}, expected a floatframe.Mesh, a meshio.Mesh or a mesh of pyvista"
        )
    if _is_grid(mesh):
        mesh = mesh.cast_to_unstructured_grid()
    if not isinstance(material, Material):
        raise InputError(f"material: found {material!r}, expected floatframe.Material(young, poisson, density)")
    if section is not None and not isinstance(section, BeamSection):
        raise InputError(f"section: found {section!r}, expected floatframe.BeamSection(A, Iy, Iz, J)")
    points = numbers("points", mesh.points, "nodes", 3)
    if isinstance(mesh, Mesh):
        cells = _of_mesh(mesh)
    elif _is_pyvista(mesh):
        cells = _of_pyvista(mesh, points)
    else:
        cells = [_of_meshio_name(block.type, block.data) for block in mesh.cells]
    sets = _sets(mesh, cells, len(points))
    for name, which in (more_sets or {}).items():
        sets[name] = _mask_or_indices(f"nodes of {name}", which, len(points))
    shells, sections, reference = [], [], numbers("reference", (0.0, 0.0, 1.0), 3)
    if thickness is not None:
        shells.append(number("thickness", thickness, positive=True))
    if section is not None:
        sections.append(tuple(number(f"section: {k}", getattr(section, k), positive=True) for k in ("A", "Iy", "Iz", "J")))
        reference = numbers("section: reference", section.reference, 3)
    blocks = [(c.word, c.nodes, 0, 0, reference) for c in _used(cells, thickness, section)]
    return _core.make_mesh(points, blocks, list(sets.items()), [material.checked()], shells, sections)
