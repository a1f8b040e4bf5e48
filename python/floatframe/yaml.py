"""Model files from nested Python data: the same names as in docs/model-file.md."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from .errors import InputError
from .parts import Part
from .values import of_package

_PLAIN = re.compile(r"[A-Za-z_][A-Za-z0-9_.\-/]*")
_WORDS = {"true", "false", "yes", "no", "on", "off", "null", "y", "n"}
_WIDTH = 100
_DEEPEST = 50
_FIRST_TOKEN = 0xF0000  # of a private plane of Unicode


def to_yaml(data: Mapping[str, Any], file_of: Callable[[Part], str] | None = None) -> str:
    """The text of a model file. Raises InputError for values that it cannot contain, with their path in `data`. Parts are named
    by the file that `file_of` returns, or "NAME.ffb" for that of the body NAME; the lines are the same for both."""
    content = plain(data)
    parts = dict(parts_of(content))
    text = "".join(line + "\n" for line in _block(content, "", {id(part): f"{name}.ffb" for name, part in parts.items()}))
    if file_of is None or not parts:
        return text
    # Placeholders as long as the names: lines break at the same places.
    tokens = {name: chr(_FIRST_TOKEN + k) * (len(name) + 4) for k, name in enumerate(parts)}
    text = "".join(line + "\n" for line in _block(content, "", {id(part): tokens[name] for name, part in parts.items()}))
    for name, part in parts.items():
        text = text.replace(json.dumps(tokens[name], ensure_ascii=False), json.dumps(file_of(part), ensure_ascii=False))
    return text


def parts_of(content: Mapping[str, Any]) -> Iterator[tuple[str, Part]]:
    """Parts that are values, by a name for each: that of the first body that has it."""
    seen = set()
    bodies = content.get("bodies", {})
    for name, body in bodies.items() if isinstance(bodies, Mapping) else ():
        for key in ("flexible", "part"):
            part = body.get(key) if isinstance(body, Mapping) else None
            if isinstance(part, Part) and id(part) not in seen:
                seen.add(id(part))
                yield re.sub(r"[^\w.-]", "_", name) if key == "flexible" else re.sub(r"[^\w.-]", "_", name) + "_part", part


def plain(value: Any, path: str = "", depth: int = 0) -> Any:
    """Copies maps, lists, texts, numbers and booleans, converting numpy types to Python types."""
    if depth > _DEEPEST:
        raise InputError(f"{path}: found more than {_DEEPEST} levels (or a map within itself)")
    own = of_package(value, path)
    if own is not None:
        return own
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


Names = Mapping[int, str]
"""Files of parts, by their identity."""


def _scalar(value: Any, names: Names) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, Part):
        return json.dumps(names[id(value)], ensure_ascii=False)
    if callable(value):  # by its name; the function itself is given beside the text
        value = str(getattr(value, "__name__", type(value).__name__))
    if _PLAIN.fullmatch(value) and value.lower() not in _WORDS:
        return str(value)
    return json.dumps(value, ensure_ascii=False)


def _flow(value: Any, names: Names) -> str:
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_scalar(k, names)}: {_flow(v, names)}" for k, v in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(_flow(v, names) for v in value) + "]"
    return _scalar(value, names)


def _block(data: Mapping[str, Any], indent: str, names: Names) -> Iterator[str]:
    for key, value in data.items():
        name = f"{indent}{_scalar(key, names)}:"
        line = f"{name} {_flow(value, names)}"
        # A map of entities is a block, an entity a single line if it fits.
        block = isinstance(value, Mapping) and value and (not indent or len(line) > _WIDTH)
        if block:
            yield name
            yield from _block(value, indent + "  ", names)
        elif isinstance(value, list) and value and len(line) > _WIDTH:
            yield name
            for item in value:
                yield f"{indent}  - {_flow(item, names)}"
        else:
            yield line
