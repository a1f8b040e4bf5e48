"""Parts: finite-element files and meshes, reduced to flexible bodies, with a health report."""

from __future__ import annotations

import contextlib
import json
import os
import sys
import tempfile
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from . import _core
from .arrays import Array, number
from .bodies import Body, Invariants
from .errors import InputError, OutputError
from .health import Report
from .meshes import AnyMesh, BeamSection, Material, fe_model, is_mesh
from .places import Place
from .reading import Damping, Density, Path, Thickness, damping_text, expect_texts, material_option, path_text, plain, reading_options

if TYPE_CHECKING:
    import pyvista

Progress = bool | Callable[[str, float], object]
Places = Mapping[str, Place]


class Part:
    """A reduced part: the flexible body, its surface with its modes, and the report. It never changes.

    Arrays share the memory of the part, keep it alive and are read-only. SI units, part coordinates, which are the body frame.
    Copies share the same data (parts never change); parts are pickled as body files.
    """

    __slots__ = ("_held", "_frequencies", "__weakref__")
    _held: _core.Part
    _frequencies: Array

    def __init__(self) -> None:
        raise TypeError("parts are made by floatframe.reduce and floatframe.read_body")

    @classmethod
    def _of(cls, core: _core.Part) -> Part:
        self = cls.__new__(cls)
        self._held = core
        return self

    @property
    def body(self) -> Body:
        """Integrals, modal stiffness, interfaces and markers, inertia terms."""
        return Body._of(_core.part_body(self._held), self)

    @property
    def invariants(self) -> Invariants:
        """The 16 inertia integrals of the body."""
        return self.body.invariants

    @property
    def frequencies(self) -> Array:
        """Frequency of each mode alone, shape (modes,) [Hz]. Those of the free part are in `report.free_frequencies`."""
        try:
            return self._frequencies
        except AttributeError:
            self._frequencies = self.body.frequencies
            return self._frequencies

    @property
    def report(self) -> Report:
        """Masses, frequencies, interfaces, warnings."""
        return Report(self._held.report_text, self._held.report_json)

    @property
    def nodes(self) -> Array:
        """Nodes of the outer surface, shape (points, 3) [m]."""
        return self._held.nodes

    @property
    def node_indices(self) -> npt.NDArray[np.int32]:
        """Node index of each point in the file or mesh, from 0, shape (points,)."""
        return self._held.node_indices

    @property
    def mode_shapes(self) -> Array:
        """Displacements of `nodes` per modal amplitude, shape (points, 3, modes)."""
        return self._held.mode_shapes

    @property
    def triangles(self) -> npt.NDArray[np.int32]:
        """Triangles of the surface: indices into `nodes`, outward normals, shape (triangles, 3)."""
        return self._held.triangles

    @property
    def lines(self) -> npt.NDArray[np.int32]:
        """Lines of beams: indices into `nodes`, shape (lines, 2)."""
        return self._held.lines

    @property
    def provenance(self) -> dict[str, Any]:
        """Origin: source, units, options as on the command line, date, version."""
        return self._held.provenance

    def save(self, path: Path) -> None:
        """Writes a body file (.ffb) for use in model files. Raises OutputError."""
        self._held.save(path_text("path", path))

    def save_sid(self, path: Path) -> None:
        """Writes Standard Input Data (SID_FEM) for other programs. Raises OutputError."""
        _write(path_text("path", path), self._held.sid_text())

    def to_pyvista(self, mode: int | None = None, scale: float | None = None) -> pyvista.PolyData:
        """The surface, deformed by a mode (from 0), for pictures; needs pyvista. scale: modal amplitude; by default the largest
        displacement is a tenth of the part size. Point data "displacement" [m] is the displacement shown."""
        import pyvista

        points = np.array(self.nodes)
        shift = np.zeros_like(points)
        if mode is not None:
            modes = self.body.modes
            if isinstance(mode, bool) or not isinstance(mode, (int, np.integer)) or not 0 <= mode < modes:
                raise InputError(f"mode: found {mode!r}, expected 0 to {modes - 1}")
            shape = self.mode_shapes[:, :, mode]
            if scale is None:
                largest = np.linalg.norm(shape, axis=1).max(initial=0.0)
                scale = 0.1 * np.ptp(points, axis=0).max() / largest if largest > 0.0 else 0.0
            shift = number("scale", scale) * shape
        grid = pyvista.PolyData()
        grid.points = points + shift
        if len(self.triangles):
            grid.faces = np.column_stack([np.full(len(self.triangles), 3), self.triangles]).ravel()
        if len(self.lines):
            grid.lines = np.column_stack([np.full(len(self.lines), 2), self.lines]).ravel()
        grid.point_data["displacement"] = shift
        return grid

    def __copy__(self) -> Part:
        return self

    def __deepcopy__(self, memo: object) -> Part:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return _part_of_bytes, (self._held.to_bytes(),)

    def __repr__(self) -> str:
        mass = self.invariants.m
        return f"<floatframe.Part of '{self.provenance['source']}': {mass:.6g} kg, {self.body.modes} modes>"


def _part_of_bytes(content: bytes) -> Part:
    return Part._of(_core.read_body_bytes(content, "pickled part"))


class FileInfo(dict[str, Any]):
    """Summary of a file; `print(info)` gives the output of `floatframe info`."""

    def __init__(self, text: str, content: dict[str, Any]) -> None:
        super().__init__(content)
        self._text = text

    def __str__(self) -> str:
        return self._text

    def __reduce__(self) -> tuple[Any, ...]:
        return FileInfo, (self._text, dict(self))


def reduce(
    source: Path | AnyMesh,
    *,
    units: str | None = None,
    interfaces: Places | None = None,
    markers: Places | None = None,
    method: Literal["craig_bampton", "free_free", "craig_chang"] | None = None,
    modes: int | None = None,
    fmax: float | None = None,
    effective_mass: float | None = None,
    reference: str | None = None,
    material: Material | None = None,
    density: Density | None = None,
    integration: Literal["exact", "ccx"] | None = None,
    damping: Damping | None = None,
    solver: Literal["auto", "mumps", "eigen"] | None = None,
    contact: str | None = None,
    temperature: float | None = None,
    free_check: bool | None = None,
    stresses: bool | None = None,
    projection: bool | None = None,
    format: str | None = None,
    dialect: Literal["abaqus", "calculix"] | None = None,
    beam_shear: Literal["by_format", "none"] | None = None,
    shell_shear: Literal["by_format", "none", "all"] | None = None,
    mass_form: Literal["by_format", "consistent", "lumped"] | None = None,
    grounded_springs: Literal["refuse", "ignore"] | None = None,
    nodes: Path | None = None,
    mass: Path | None = None,
    dofs: Path | None = None,
    damping_matrix: Path | None = None,
    thickness: Thickness | None = None,
    section: BeamSection | None = None,
    progress: Progress = False,
) -> Part:
    """Reduces a finite-element part to a flexible body, as `floatframe reduce` does; docs/parts.md explains its options.

    source: a file (Abaqus or CalculiX, Nastran, Gmsh, matrices), or a mesh: `floatframe.Mesh`, `meshio.Mesh` or
    one of pyvista, which need `material`, and `thickness` or `section` where surfaces are shells or lines are
    beams. units: "mm-t-s", "m-kg-s", ...: required for files; SI by default for meshes. interfaces: where the part is
    held or driven; markers: where loads act or outputs are taken; lengths in the units of the part.

    modes: number of normal modes (20 if nothing selects them); fmax: all below this frequency [Hz]; effective_mass: until
    this fraction is reached. reference: "mean_axis", "buckens" or "node:NAME" of an interface.
    damping: fraction of critical of its modes, a list of fractions, or a dict with one of fraction, fractions, bands ("usual" or
    [[100, 0.01], [1000, 0.1], 1.0]: below 100 Hz, below 1 kHz, above) and rayleigh ([alpha, beta]), with reference "frame", "free"
    or "mounted": {"fraction": 0.02, "reference": "mounted"}. damping_matrix: of parts given as matrices.
    free_check=False: no free modes of the full model in the report (saves a factorisation). stresses=False: no stress.
    beam_shear, shell_shear: shear deformation of beams and shells of a file; mass_form: consistent or lumped mass.
    grounded_springs="ignore": omits springs to the ground.
    projection=True: stores nodes and mass matrix for the projection method.

    material: for files without one. density: for materials without one in the file, a number or by name, {"STEEL": 7.85e-9};
    temperature: for temperature-dependent materials; all in the units of the file.
    thickness: of shells of a mesh; of surfaces of files without sections (Gmsh, UNV), which then become shells, a number or by
    group name, {"RIBS": 2.0}. contact: contact pairs of the deck: "ignore", "tied" or "tied:DISTANCE".

    progress: True prints a line for each stage, or a function of the stage and its duration [s]. Other Python threads keep
    running meanwhile; Ctrl-C ends the reduction after the current stage. Raises InputError.
    """
    mesh = is_mesh(source)
    options: dict[str, Any] = {
        "units": units if units is not None or not mesh else "m-kg-s",
        "method": method,
        "modes": plain(modes),
        "fmax": plain(fmax),
        "effective_mass": plain(effective_mass),
        "reference": reference,
        "integration": integration,
        "damping": damping_text(damping),
        "solver": solver,
        "free_check": free_check,
        "stresses": stresses,
        "projection": projection,
        "beam_shear": beam_shear,
        "shell_shear": shell_shear,
        "mass_form": mass_form,
        "grounded_springs": grounded_springs,
    }
    words = ("beam_shear", "shell_shear", "mass_form", "grounded_springs")
    expect_texts(options, ("units", "method", "reference", "integration", "solver", *words))
    surfaces = None if mesh else thickness
    options |= reading_options(format, dialect, contact, temperature, density, surfaces, nodes, mass, dofs, damping_matrix)
    chosen: dict[str, object] = {}
    for key, places in (("interfaces", interfaces), ("markers", markers)):
        if places is not None:
            options[key] = _places(key, places, mesh, chosen)
    tell = _print_stage if progress is True else progress or None
    if tell is not None and not callable(tell):
        raise InputError(f"progress: found {progress!r}, expected True, False or a function")
    if mesh:
        for name in ("format", "dialect", "contact", "temperature", "density", *words, "nodes", "mass", "dofs", "damping_matrix"):
            if options[name] is not None:
                raise InputError(f"{name} says how files are read: found it for a mesh")
        if isinstance(thickness, Mapping):
            raise InputError(f"thickness: found {thickness!r}, expected a number for a mesh")
        model = fe_model(source, material, thickness, section, chosen)
        return Part._of(_core.reduce_mesh(model, type(source).__name__, options, tell))
    if section is not None:
        raise InputError("section belongs to meshes: found it for a file, which has its own")
    options |= material_option(material)
    if not isinstance(source, (str, os.PathLike)):
        found = type(source).__name__
        raise InputError(f"source: found {found}, expected a file, a floatframe.Mesh, a meshio.Mesh or a mesh of pyvista")
    return Part._of(_core.reduce_file(path_text("source", source), options, tell))


def read_body(path: Path) -> Part:
    """The part in a body file (.ffb). Raises InputError with every error of the file."""
    return Part._of(_core.read_body(path_text("path", path)))


def info(
    path: Path,
    *,
    format: str | None = None,
    material: Material | None = None,
    density: Density | None = None,
    dialect: Literal["abaqus", "calculix"] | None = None,
    contact: str | None = None,
    temperature: float | None = None,
    thickness: Thickness | None = None,
    nodes: Path | None = None,
    mass: Path | None = None,
    dofs: Path | None = None,
    damping_matrix: Path | None = None,
) -> FileInfo:
    """Summary of a finite-element file, a body file or a SID_FEM file: the output of `floatframe info`, as a dict of its JSON.
    Options as those of `reduce`."""
    options = reading_options(format, dialect, contact, temperature, density, thickness, nodes, mass, dofs, damping_matrix) | material_option(material)
    text, content = _core.file_info(path_text("path", path), options)
    return FileInfo(text, json.loads(content))


def convert(
    source: Path,
    out: Path,
    *,
    modes: int = 20,
    format: str | None = None,
    material: Material | None = None,
    density: Density | None = None,
    dialect: Literal["abaqus", "calculix"] | None = None,
    contact: str | None = None,
    temperature: float | None = None,
    thickness: Thickness | None = None,
) -> str:
    """Writes a finite-element file in the format of another program, as `floatframe convert` does: a CalculiX deck (.inp, with
    a step of `modes` free modes unless it is 0), a Gmsh mesh (.msh) or a VTU file (.vtu). Returns the output of the command.
    Options as those of `reduce`. Raises InputError, OutputError."""
    count = plain(modes)
    if isinstance(count, bool) or not isinstance(count, int) or not 0 <= count <= 100000:
        raise InputError(f"modes: found {modes!r}, expected a whole number from 0 to 100000")
    options = reading_options(format, dialect, contact, temperature, density, thickness) | material_option(material)
    return _core.convert_file(path_text("source", source), path_text("out", out), count, options)


def _places(key: str, places: object, mesh: bool, chosen: dict[str, object]) -> dict[str, Any]:
    """Places by name for the C++ library. Node indices of a mesh become sets, in `chosen`."""
    if not isinstance(places, Mapping):
        raise InputError(f"{key}: found {type(places).__name__}, expected a dict of names and places")
    out = {}
    for name, place in places.items():
        if not isinstance(name, str) or not name:
            raise InputError(f"{key}: found the name {name!r}, expected a text")
        label = f"{key} '{name}'"
        if not isinstance(place, Place):
            raise InputError(f"{label}: found {place!r}, expected floatframe.set(...), cylinder(...), ...")
        d = place.as_dict(label, key == "interfaces")
        if place.way in ("nodes", "node") and (mesh or place.way == "nodes"):
            if not mesh:
                raise InputError(f"{label}: floatframe.nodes belongs to meshes; for files there is floatframe.set")
            which = d["values"][place.way]
            chosen[label] = which if place.way == "nodes" else [which]
            d = replace(place, way="set", values={"set": label}).as_dict(label, key == "interfaces")
        out[name] = d
    return out


def _print_stage(stage: str, seconds: float) -> None:
    print(f"{seconds:8.2f} s  {stage}", file=sys.stderr)


def _write(path: str, text: str) -> None:
    """Writes the file atomically."""
    folder = os.path.dirname(os.path.abspath(path))
    try:
        handle, temporary = tempfile.mkstemp(dir=folder, prefix=".floatframe-")
        try:
            with os.fdopen(handle, "w", encoding="utf-8") as file:
                file.write(text)
            os.chmod(temporary, 0o644)
            os.replace(temporary, path)
        except BaseException:
            with contextlib.suppress(OSError):
                os.unlink(temporary)
            raise
    except OSError as error:
        raise OutputError(f"{path}: cannot write: {error.strerror}") from None
