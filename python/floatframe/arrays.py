"""Converts arguments to arrays for the C++ library: checks shape, type and finite numbers, or raises InputError."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable
from typing import Any

import numpy as np
import numpy.typing as npt

from .errors import InputError

Array = npt.NDArray[np.float64]
Whole = npt.NDArray[np.int64]


def _plain(name: str, value: object, expected: str) -> npt.NDArray[Any]:
    try:
        a = np.asarray(value)
    except (TypeError, ValueError) as error:
        raise InputError(f"{name}: found {type(value).__name__}, expected {expected}: {error}") from None
    if a.dtype.kind not in "fiu" and not (a.size == 0 and a.dtype.kind in "fiub"):
        raise InputError(f"{name}: found {type(value).__name__} of {a.dtype}, expected {expected}")
    return a


def _shape(name: str, a: npt.NDArray[Any], shape: tuple[int | str, ...]) -> None:
    if a.ndim != len(shape) or any(isinstance(n, int) and n != k for n, k in zip(shape, a.shape, strict=True)):
        wanted = ", ".join(str(n) for n in shape) + ("," if len(shape) == 1 else "")
        raise InputError(f"{name}: found the shape {a.shape}, expected ({wanted})")


def numbers(name: str, value: object, *shape: int | str) -> Array:
    """Finite numbers of a shape; words in it stand for any number: `numbers("S", S, 3, "modes")`."""
    a = np.asarray(_plain(name, value, "an array of numbers"), dtype=np.float64, order="C")
    _shape(name, a, shape)
    if not np.isfinite(a).all():
        raise InputError(f"{name}: found a number that is not finite, expected finite numbers")
    return a


def whole_numbers(name: str, value: object, *shape: int | str) -> Whole:
    """The same for whole numbers."""
    a = _plain(name, value, "an array of whole numbers")
    if a.size and a.dtype.kind not in "iu":
        raise InputError(f"{name}: found numbers of {a.dtype}, expected whole numbers")
    if a.dtype.kind == "u" and a.size and a.max() > np.iinfo(np.int64).max:
        raise InputError(f"{name}: found {a.max()}, expected smaller whole numbers")
    _shape(name, a, shape)
    return np.ascontiguousarray(a, dtype=np.int64)


def truths(value: object) -> npt.NDArray[np.bool_] | None:
    """A mask; None for any other value."""
    try:
        a = np.asarray(value)
    except (TypeError, ValueError):
        return None
    return a if a.dtype == np.bool_ else None


def number(name: str, value: object, *, positive: bool = False, low: float = -math.inf, high: float = math.inf) -> float:
    """A finite number, positive or between `low` and `high` (both excluded)."""
    expected = "a positive number" if positive else f"a number between {low:g} and {high:g}" if high < math.inf else "a number"
    if isinstance(value, (bool, np.bool_, str, bytes)) or not hasattr(value, "__float__"):
        raise InputError(f"{name}: found {value!r}, expected {expected}")
    try:
        x = float(value)
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{name}: found {value!r}, expected {expected}") from None
    if not math.isfinite(x) or (positive and x <= 0.0) or not low < x < high:
        raise InputError(f"{name}: found {x:g}, expected {expected}")
    return x


def text(name: str, value: object) -> str:
    """A text that is not empty."""
    if not isinstance(value, str) or not value or "\0" in value:
        raise InputError(f"{name}: found {value!r}, expected a text")
    try:
        value.encode()
    except UnicodeEncodeError:
        raise InputError(f"{name}: found {value!r}, expected a text") from None
    return value


def texts(name: str, value: object) -> list[str]:
    """Texts, or one."""
    if isinstance(value, str):
        return [text(name, value)]
    if isinstance(value, (bytes, bytearray)) or not isinstance(value, Iterable):
        raise InputError(f"{name}: found {value!r}, expected a list of names")
    return [text(name, item) for item in value]


def whole(name: str, value: object, low: int, high: int) -> int:
    """A whole number from `low` to `high`."""
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, np.integer)) or not low <= value <= high:
        raise InputError(f"{name}: found {value!r}, expected a whole number from {low} to {high}")
    return int(value)


def path(name: str, value: object) -> str:
    """Path of a file or folder."""
    try:
        given = os.fspath(value)  # type: ignore[call-overload]
    except TypeError:
        raise InputError(f"{name}: found {type(value).__name__}, expected a path") from None
    if not isinstance(given, str) or not given or "\0" in given:
        raise InputError(f"{name}: found {given!r}, expected a path")
    return given


def function_or_flag(name: str, value: object) -> None:
    """InputError unless it is True, False or a function."""
    if not isinstance(value, (bool, np.bool_)) and not callable(value):
        raise InputError(f"{name}: found {value!r}, expected True, False or a function")
