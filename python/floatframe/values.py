"""Objects of the package as values in models: parts, bodies, materials, places, integrals."""

from __future__ import annotations

import atexit
import hashlib
import os
import re
import shutil
import tempfile
import weakref
from pathlib import Path
from typing import Any

from . import _core
from .bodies import Body, Invariants
from .errors import InputError
from .meshes import BeamSection, Material
from .parts import Part
from .places import Place, direction, vector

_PART = re.compile(r"bodies\.(.+)\.(?:flexible|part)$")
_PLACE = re.compile(r"\.(interfaces|markers)\.")
_PIECE = re.compile(r"(r?)([xyz]+)")


def of_package(value: object, path: str) -> Any:
    """The value at a path of a model ("bodies.arm.flexible") that an object of this package stands for: a Part (which stays as
    it is), or plain data with the keys of model files. None if it is no such object."""
    if isinstance(value, (Part, Body)):
        if not _PART.match(path):
            raise InputError(f"{path}: found {type(value).__name__}, expected it as 'flexible' or 'part' of a body")
        return value if isinstance(value, Part) else part_of_body(value)
    if isinstance(value, Material):
        return dict(zip(("young", "poisson", "density"), value.checked(), strict=True))
    if isinstance(value, Place):
        return _place(value, path)
    if isinstance(value, Invariants):
        return _rigid(value, path)
    if isinstance(value, BeamSection):
        raise InputError(f"{path}: found BeamSection, expected a section with the keys of model files")
    return None


def part_of_body(body: Body) -> Part:
    """The part that a body belongs to; of a body made from integrals, one without a surface."""
    if isinstance(body._part, Part):
        return body._part
    return Part._of(_core.part_of_body(body._core))


def _rigid(v: Invariants, path: str) -> dict[str, Any]:
    if v.modes > 0:
        raise InputError(f"{path}: found integrals of {v.modes} modes, expected those of a rigid body (or a Body as 'flexible')")
    J = v.inertia_about_centre
    inertia = [J[0, 0], J[1, 1], J[2, 2], J[0, 1], J[0, 2], J[1, 2]]
    return {"mass": v.m, "centre_of_mass": v.centre_of_mass.tolist(), "inertia": [float(x) for x in inertia]}


def _place(place: Place, path: str) -> dict[str, Any]:
    found = _PLACE.search(path)
    if found is None:
        raise InputError(f"{path}: found a place on a part, expected it among its interfaces or markers")
    place.as_dict(path, found[1] == "interfaces")  # checks
    values: dict[str, Any] = {key: value for key, value in place.values.items() if value is not None}
    if place.way == "nodes":
        raise InputError(f"{path}: found nodes of a mesh, expected a place in the file: set, node, nearest, plane, cylinder or sphere")
    for key, value in values.items():
        if key in ("axis", "normal"):
            values[key] = list(direction(f"{path}: {key}", value))
        elif key in ("point", "nearest"):
            values[key] = list(vector(f"{path}: {key}", value))
    out: dict[str, Any] = {place.way: values if place.way in ("plane", "cylinder", "sphere") else values[place.way]}
    if place.at is not None:
        out["at"] = list(vector(f"{path}: at", place.at))
    if place.tolerance is not None:
        out["tolerance"] = float(place.tolerance)
    if place.type != "rigid":
        out["type"] = place.type
    if place.dofs != "all":
        out["dofs"] = _dofs(path, place.dofs)
    if place.residual:
        out["residual"] = True
    return out


def _dofs(path: str, text: str) -> list[str]:
    """ "xyz+rz" as [x, y, z, rz]."""
    dofs: list[str] = []
    for piece in text.split("+"):
        match = _PIECE.fullmatch(piece)
        if match is None:
            raise InputError(f"{path}: dofs: found '{text}', expected all, or directions such as xyz, x+z or xyz+rz")
        dofs += [match[1] + letter for letter in match[2]]
    return dofs


class _Folder:
    """A folder of this process for body files of parts, which are read again as files."""

    def __init__(self) -> None:
        self.path: Path | None = None
        self.process = -1

    def get(self) -> Path:
        if self.path is None or self.process != os.getpid() or not self.path.is_dir():
            self.path = Path(tempfile.mkdtemp(prefix="floatframe-"))
            self.process = os.getpid()
        return self.path

    def remove(self) -> None:
        if self.path is not None and self.process == os.getpid():
            shutil.rmtree(self.path, ignore_errors=True)


_folder = _Folder()
atexit.register(_folder.remove)
_files: weakref.WeakKeyDictionary[Part, str] = weakref.WeakKeyDictionary()


def body_file(part: Part) -> str:
    """A body file of a part, named by its content; it exists while this process runs."""
    file = _files.get(part)
    if file is None or not file.startswith(str(_folder.get())) or not os.path.exists(file):
        content = part._held.to_bytes()
        path = _folder.get() / f"{hashlib.sha256(content).hexdigest()[:16]}.ffb"
        if not path.exists():
            path.write_bytes(content)
        file = _files[part] = str(path)
    return file
