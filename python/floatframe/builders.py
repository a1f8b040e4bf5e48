"""Sections whose entities have types: a method for each type, from the key tables of docs/model-file.md (keys.json).

Types and editors see builders.pyi, which has the keys of each method.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from .errors import InputError, UnknownNameError
from .sections import Section, expect_keys

Table = dict[str, dict[str, list[str]]]
TABLES: dict[str, dict[str, Any]] = json.loads(Path(__file__).with_name("keys.json").read_text(encoding="utf-8"))
_DEFAULT_TYPE = {"couplings": "coupling"}


class TypedSection(Section):
    """Entities of one kind; `type` selects the keys. A method for each type adds one of it."""

    _keys: Table = {}

    def __setitem__(self, name: str, value: Any) -> None:
        kind = value.get("type", _DEFAULT_TYPE.get(self._key)) if isinstance(value, Mapping) else None
        if isinstance(kind, str) and "${" not in kind:
            path = f"{self._key}.{name}"
            if kind not in self._keys:
                raise UnknownNameError(f"{path}: found the type '{kind}', expected one of {', '.join(self._keys)}")
            expect_keys(path, value, ["type", *self._keys[kind], "when"])
        super().__setitem__(name, value)


def _docstring(kind: str, does: str, keys: Mapping[str, list[str]]) -> str:
    lines = [f"{kind}: {does}.", ""]
    for key, (value, meaning, default) in keys.items():
        what = f"{value}; {meaning}" if value and meaning else value or meaning
        lines.append(f"{key}: {what}" + (f" ({'required' if default == 'required' else 'default ' + default})" if default not in ("", "none") else ""))
    return "\n".join([*lines, "when: false removes it", "", "Returns the name. A trailing underscore avoids words of Python: from_."])


def _method(kind: str, does: str, keys: Mapping[str, list[str]]) -> Any:
    def add(self: TypedSection, name: str, /, **values: Any) -> str:
        if "type" in values:
            raise InputError(f"{self._key}.{name}: found a type, which is '{kind}' here")
        return self.add(name, type=kind, **values)

    add.__name__ = kind
    add.__doc__ = _docstring(kind, does, keys)
    return add


def _section(name: str, key: str) -> type[Section]:
    table = TABLES[key]
    members: dict[str, Any] = {kind: _method(kind, does, table["keys"][kind]) for kind, does in table["types"].items()}
    for kind, method in members.items():
        method.__qualname__ = f"{name}.{kind}"
    members["_keys"] = table["keys"]
    members["__doc__"] = f"The {key} of a model, by name; a method for each type adds one."
    members["__module__"] = __name__
    return type(name, (TypedSection,), members)


class Bodies(Section):
    """The bodies of a model, by name."""


class Inputs(Section):
    """The inputs of a model, by name."""


class Outputs(Section):
    """The outputs of a model, by name of their columns."""


class SimulationSection(Section):
    """Options of runs: `model.simulation["step"] = 1e-3`, `model.simulation.update(step=1e-3)`."""


Joints = _section("Joints", "joints")
Constraints = _section("Constraints", "constraints")
Couplings = _section("Couplings", "couplings")
Forces = _section("Forces", "forces")
Controllers = _section("Controllers", "controllers")
