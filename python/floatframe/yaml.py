"""Model files from nested Python data: the same names as in docs/model-file.md."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from .errors import InputError

_PLAIN = re.compile(r"[A-Za-z_][A-Za-z0-9_.\-/]*")
_WORDS = {"true", "false", "yes", "no", "on", "off", "null", "y", "n"}
_WIDTH = 100
_DEEPEST = 50


def to_yaml(data: Mapping[str, Any]) -> str:
    """The text of a model file. Raises InputError for values that it cannot contain, with their path in `data`."""
    return "".join(line + "\n" for line in _block(plain(data), ""))


def plain(value: Any, path: str = "", depth: int = 0) -> Any:
    """Copies maps, lists, texts, numbers and booleans, converting numpy types to Python types."""
    if depth > _DEEPEST:
        raise InputError(f"{path}: found more than {_DEEPEST} levels (or a map within itself)")
    if hasattr(value, "tolist"):  # numpy
        value = value.tolist()
    if isinstance(value, Mapping):
        for key in value:
            if not isinstance(key, str):
                raise InputError(f"{path or 'the model'}: found the key {key!r}, expected a name")
        return {key: plain(v, f"{path}.{key}" if path else key, depth + 1) for key, v in value.items() if v is not None}
    if isinstance(value, str):
        if not value.isprintable() and any("\ud800" <= c <= "\udfff" for c in value):
            raise InputError(f"{path}: found a text that is no Unicode")
        return str(value)
    if isinstance(value, bool):
        return value
    if isinstance(value, int):
        return int(value)
    if isinstance(value, float):
        if not math.isfinite(value):
            raise InputError(f"{path}: found {value}, expected a finite number")
        return float(value)
    if callable(value) and path.startswith("forces.") and path.endswith(".law"):
        return value  # of a force_law
    if isinstance(value, Sequence) and not isinstance(value, (bytes, bytearray)):
        return [plain(v, f"{path}[{k}]", depth + 1) for k, v in enumerate(value)]
    raise InputError(f"{path or 'the model'}: found {type(value).__name__}, expected a map, a list, a text, a number or a truth value")


def _scalar(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if callable(value):  # by its name; the function itself is given beside the text
        value = str(getattr(value, "__name__", type(value).__name__))
    if _PLAIN.fullmatch(value) and value.lower() not in _WORDS:
        return str(value)
    return json.dumps(value, ensure_ascii=False)


def _flow(value: Any) -> str:
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_scalar(k)}: {_flow(v)}" for k, v in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(_flow(v) for v in value) + "]"
    return _scalar(value)


def _block(data: Mapping[str, Any], indent: str) -> Iterator[str]:
    for key, value in data.items():
        name = f"{indent}{_scalar(key)}:"
        line = f"{name} {_flow(value)}"
        # A map of entities is a block, an entity a single line if it fits.
        block = isinstance(value, Mapping) and value and (not indent or len(line) > _WIDTH)
        if block:
            yield name
            yield from _block(value, indent + "  ")
        elif isinstance(value, list) and value and len(line) > _WIDTH:
            yield name
            for item in value:
                yield f"{indent}  - {_flow(item)}"
        else:
            yield line
