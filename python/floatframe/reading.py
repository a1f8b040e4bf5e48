"""Reading of finite-element files: Python arguments as options of the C++ library."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .errors import InputError
from .meshes import Material

Path = str | os.PathLike[str]
Density = float | Mapping[str, float]
Thickness = float | Mapping[str, float]
Damping = float | Sequence[float] | Mapping[str, Any]


def expect_texts(options: dict[str, Any], names: tuple[str, ...]) -> None:
    for name in names:
        if options[name] is not None and not isinstance(options[name], str):
            raise InputError(f"{name}: found {options[name]!r}, expected a text")


def reading_options(
    format: object,
    dialect: object,
    contact: object,
    temperature: object,
    density: object,
    thickness: object,
    nodes: object = None,
    mass: object = None,
    dofs: object = None,
    damping_matrix: object = None,
) -> dict[str, Any]:
    """Reading options of a file, for the C++ library."""
    options: dict[str, Any] = {"format": format, "dialect": dialect, "contact": contact, "temperature": None}
    expect_texts(options, ("format", "dialect", "contact"))
    for name, file in (("nodes", nodes), ("mass", mass), ("dofs", dofs), ("damping_matrix", damping_matrix)):
        options[name] = None if file is None else path_text(name, file)
    if temperature is not None:
        T = plain(temperature)
        if isinstance(T, bool) or not isinstance(T, (int, float)) or not math.isfinite(T):
            raise InputError(f"temperature: found {temperature!r}, expected a number")
        options["temperature"] = repr(float(T))
    options["density"] = named_numbers("density", density, "a number or numbers by the names of materials")
    options["thickness"] = named_numbers("thickness", thickness, "a number or numbers by the names of groups")
    return options


def damping_text(damping: object) -> str | None:
    """A damping given by the keys of model files, as text for the command line."""
    if damping is None:
        return None

    def wrong() -> InputError:
        return InputError(
            f"damping: found {damping!r}, expected a fraction of critical damping, a list of them, or a dict with one of fraction, "
            "fractions, bands and rayleigh"
        )

    def number(value: object) -> str:
        x = plain(value)
        if isinstance(x, bool) or not isinstance(x, (int, float)) or not math.isfinite(x):
            raise wrong()
        return repr(float(x))

    def items(value: object) -> list[Any]:
        if isinstance(value, (str, bytes)) or not hasattr(value, "__iter__"):
            raise wrong()
        return list(value)

    if not isinstance(damping, Mapping):
        return ",".join(number(x) for x in items(damping)) if hasattr(damping, "__len__") else number(damping)
    ways = [key for key in ("fraction", "fractions", "bands", "rayleigh") if damping.get(key) is not None]
    if len(ways) != 1 or not set(damping) <= {*ways, "reference", "frequency"}:
        raise wrong()
    value = damping[ways[0]]
    if ways[0] == "fraction":
        text = number(value)
    elif ways[0] == "fractions":
        text = ",".join(number(x) for x in items(value))
    elif ways[0] == "rayleigh":
        text = "rayleigh:" + ",".join(number(x) for x in items(value))
    elif isinstance(value, str) and value == "usual":
        text = "bands:usual"
    else:
        bands = [items(band) if hasattr(band, "__len__") else [band] for band in items(value)]
        if any(len(band) not in (1, 2) for band in bands):
            raise wrong()
        text = "bands:" + ",".join("=".join(number(x) for x in band) for band in bands)
    if damping.get("reference") is not None:
        text += f",reference={damping['reference']}"
    if damping.get("frequency") is not None:
        text += f",frequency={number(damping['frequency'])}"
    return text


def named_numbers(name: str, value: object, expected: str) -> list[str] | None:
    """A number for all, or numbers by name, as texts for the command line."""
    if value is None:
        return None
    texts = []
    for key, number in value.items() if isinstance(value, Mapping) else [("", value)]:
        x = plain(number)
        if isinstance(x, bool) or not isinstance(x, (int, float)) or not isinstance(key, str):
            raise InputError(f"{name}: found {value!r}, expected {expected}")
        texts.append(f"{key}={float(x)!r}" if key else repr(float(x)))
    return texts


def material_option(material: object) -> dict[str, Any]:
    if material is None:
        return {}
    if not isinstance(material, Material):
        raise InputError(f"material: found {material!r}, expected floatframe.Material(young, poisson, density)")
    return {"material": ",".join(repr(x) for x in material.checked())}


def plain(value: Any) -> Any:
    """Converts numpy numbers to Python numbers; the C++ library checks them."""
    return value.item() if isinstance(value, np.generic) else value


def path_text(name: str, value: object) -> str:
    try:
        path = os.fspath(value)  # type: ignore[call-overload]
    except TypeError:
        raise InputError(f"{name}: found {type(value).__name__}, expected the path of a file") from None
    if not isinstance(path, str) or not path or "\0" in path:
        raise InputError(f"{name}: found {path!r}, expected the path of a file")
    return path
