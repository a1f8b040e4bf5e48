"""What is given, as arrays for the C++ library: shape, type and finite numbers, or InputError."""

from __future__ import annotations

import math
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
    """The same of whole numbers."""
    a = _plain(name, value, "an array of whole numbers")
    if a.size and a.dtype.kind not in "iu":
        raise InputError(f"{name}: found numbers of {a.dtype}, expected whole numbers")
    if a.dtype.kind == "u" and a.size and a.max() > np.iinfo(np.int64).max:
        raise InputError(f"{name}: found {a.max()}, expected smaller whole numbers")
    _shape(name, a, shape)
    return np.ascontiguousarray(a, dtype=np.int64)


def truths(value: object) -> npt.NDArray[np.bool_] | None:
    """A mask; None if it is something else."""
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
