"""Sections of a model: the entities of one kind, by name."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Iterator, Mapping, MutableMapping
from typing import Any

from .errors import InputError, UnknownNameError
from .yaml import plain


class Section(MutableMapping[str, Any]):
    """The entities of one kind, by name: `model.bodies["arm"]`, `model.bodies.add("arm", rigid={...})`, `del model.bodies["arm"]`.

    It is a view: `data()` returns the description of the model that it belongs to."""

    def __init__(self, data: Callable[[], dict[str, Any]], key: str) -> None:
        self._data = data
        self._key = key

    def _entities(self) -> dict[str, Any]:
        entities = self._data().get(self._key)
        if entities is None:
            return {}
        if not isinstance(entities, dict):
            raise InputError(f"{self._key}: found {type(entities).__name__}, expected a map of names")
        return entities

    def _name(self, name: object) -> str:
        if not isinstance(name, str) or not name:
            raise InputError(f"{self._key}: found the name {name!r}, expected a text")
        return name

    def add(self, name: str, value: Any = None, /, **values: Any) -> str:
        """Adds an entity with the keys of model files; a trailing underscore avoids Python keywords (`from_`). A value that is
        not a map (a point, a table) comes second: `points.add("tip", [1, 0, 0])`. Parts, bodies, materials and places may be values. Returns the name."""
        if self._name(name) in self._entities():
            raise InputError(f"{self._key}.{name}: there is one of this name already")
        if value is not None and values:
            raise InputError(f"{self._key}.{name}: found a value and keys, expected one of them")
        self[name] = value if value is not None else {key.removesuffix("_"): v for key, v in values.items()}
        return name

    def __getitem__(self, name: str) -> Any:
        entities = self._entities()
        if name not in entities:
            raise UnknownNameError(f"{self._key}: found no {name!r}, expected one of {', '.join(map(str, entities)) or 'none'}")
        return entities[name]

    def __setitem__(self, name: str, value: Any) -> None:
        made = plain(value, f"{self._key}.{self._name(name)}")
        self._entities()  # of a model whose section is none
        self._data().setdefault(self._key, {})[name] = made

    def __delitem__(self, name: str) -> None:
        self[name]  # the error lists the existing ones
        del self._entities()[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._entities())

    def __len__(self) -> int:
        return len(self._entities())

    def _ipython_key_completions_(self) -> list[str]:
        return list(self)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self._entities()})"


def expect_keys(path: str, given: Mapping[str, Any], known: list[str]) -> None:
    """UnknownNameError for a key that is none of `known`."""
    for key in given:
        if key not in known:
            near = difflib.get_close_matches(key, known, 1)
            hint = f", did you mean '{near[0]}'?" if near else f", expected one of {', '.join(known)}"
            raise UnknownNameError(f"{path}: unknown key '{key}'{hint}")
