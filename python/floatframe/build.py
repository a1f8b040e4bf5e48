"""Version of this package, and files installed with it."""

from __future__ import annotations

from pathlib import Path
from typing import TypedDict

from . import _core
from .errors import InputError

_HERE = Path(__file__).resolve().parent
# In a wheel everything is below the package; in the source tree next to it.
_PLACES = (Path(_core.__file__).parent, _HERE, _HERE.parents[1])


class BuildInfo(TypedDict):
    """See `build_info`."""

    version: str
    build: str
    instruction_set: str
    processor: str
    mumps: bool
    library: str


def build_info() -> BuildInfo:
    """Version, build and loaded library: `instruction_set` is that of the loaded copy of the library ("x86-64" or "x86-64-v3"),
    `library` its file; `mumps`: MUMPS factorises large sparse matrices (otherwise Eigen)."""
    info = _core.build_info()
    return {**info, "library": _library()}  # type: ignore[typeddict-item]


def _library() -> str:
    with open("/proc/self/maps", encoding="utf-8") as maps:
        for line in maps:
            if "/libfloatframe.so" in line:
                return line.split(maxsplit=5)[5].strip()
    return ""


def program() -> str:
    """Path of the command line program `floatframe` installed with the package."""
    for folder in (_PLACES[0] / "bin", _PLACES[0].parents[1]):
        if (folder / "floatframe").is_file():
            return str(folder / "floatframe")
    raise InputError("the program 'floatframe' is not in this package")


def example(name: str) -> str:
    """Path of the model file of an example: "iltis", "quarter_car", ..."""
    if not isinstance(name, str):
        raise InputError(f"found {type(name).__name__}, expected the name of an example")
    folders = [place / "examples" for place in _PLACES if (place / "examples").is_dir()]
    for folder in folders:
        if name and (folder / name / f"{name}.yaml").is_file():
            return str(folder / name / f"{name}.yaml")
    known = sorted({p.parent.name for f in folders for p in f.glob("*/*.yaml") if p.stem == p.parent.name})
    raise InputError(f"found the example '{name}', expected one of {', '.join(known)}")
