"""Models: from files, texts, Python data, or built step by step."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterator, Mapping, MutableMapping
from pathlib import Path
from typing import Any, Union

from . import _core
from .arrays import path as path_of
from .errors import InputError, UnknownNameError
from .yaml import plain, to_yaml

PathLike = Union[str, "os.PathLike[str]"]


def parameter_text(value: object) -> str:
    """A value as accepted by the reader of model files."""
    if isinstance(value, bool) or type(value).__name__ == "bool":
        return "true" if value else "false"
    if isinstance(value, str):
        return value
    if isinstance(value, int):
        return str(value)
    if hasattr(value, "__float__"):
        try:
            number = float(value)
            # In the notation of studies: 3 for 3.0.
            whole = number.is_integer() and abs(number) < 1e15 and str(number) != "-0.0"
            return str(int(number)) if whole else repr(number)
        except (TypeError, ValueError, OverflowError):
            pass
    raise InputError(f"found {type(value).__name__}, expected a number, a text or a truth value")


class Section(MutableMapping[str, Any]):
    """The entities of one kind, by name: `model.bodies["arm"]`, `model.bodies.add("arm", rigid={...})`."""

    def __init__(self, model: Model, key: str) -> None:
        self._model = model
        self._key = key

    def _entities(self) -> dict[str, Any]:
        entities = self._model.data.setdefault(self._key, {})
        if not isinstance(entities, dict):
            raise InputError(f"{self._key}: found {type(entities).__name__}, expected a map of names")
        return entities

    def add(self, name: str, /, value: Any = None, **values: Any) -> str:
        """Adds an entity with the keys of model files; a trailing underscore avoids Python keywords (`from_`). A value that is
        not a map (a point, a parameter) is given as `value`. Returns the name."""
        if not isinstance(name, str):
            raise InputError(f"{self._key}: found the name {name!r}, expected a text")
        if name in self._entities():
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
        self._entities()[name] = plain(value, f"{self._key}.{name}")

    def __delitem__(self, name: str) -> None:
        self[name]  # the error lists the existing ones
        del self._entities()[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._entities())

    def __len__(self) -> int:
        return len(self._entities())

    def __repr__(self) -> str:
        return f"Section({self._entities()})"


class Model:
    """A multibody system: the content of a model file (docs/model-file.md), checked and built by the C++ library on use.

    From a file:    `Model.load("iltis.yaml", road="bump", speed=10)`
    From its text:  `Model.from_yaml(text)`
    From data:      `Model.from_dict({"bodies": {...}, ...})`
    Step by step:   `model = Model("pendulum"); model.bodies.add("arm", rigid={...}); ...`

    A model built step by step has its description in `data`, nested maps and lists with the names of model files; sections
    (`bodies`, `joints`, ...) are views of it. It is built again when the description has changed. Errors name the entity, and
    lines and columns are those of `to_yaml()`.
    """

    def __init__(self, name: str = "model", *, folder: PathLike | None = None) -> None:
        """folder: base of relative file names in the model; the working folder if not given."""
        self.data: dict[str, Any] = {"floatframe": 1, "name": name}
        self._path: str | None = None  # of a model file
        self._home = ""  # working folder at that time
        self._text: str | None = None  # of a model from a text
        self._folder = path_of("folder", folder) if folder is not None else ""
        self._parameters: dict[str, str] = {}
        # What it was built from: text and functions.
        self._built: tuple[tuple[str, dict[str, Callable[..., Any]]] | None, _core.LoadedModel] | None = None

    @classmethod
    def load(cls, path: PathLike, /, **parameters: Any) -> Model:
        """The model of a file, with changed values of its parameters. Raises InputError with every error of the file: file,
        line, column, sentence."""
        model = cls()
        model._path = path_of("path", path)
        model._home = os.getcwd()
        return model._with(parameters)

    @classmethod
    def from_yaml(cls, text: str, /, *, folder: PathLike | None = None, **parameters: Any) -> Model:
        """The model of the text of a model file."""
        if not isinstance(text, str):
            raise InputError(f"found {type(text).__name__}, expected the text of a model file")
        model = cls(folder=folder)
        model._text = text
        return model._with(parameters)

    @classmethod
    def from_dict(cls, data: Mapping[str, Any], /, *, folder: PathLike | None = None, **parameters: Any) -> Model:
        """The model of nested data with the names of model files. `floatframe: 1` is not needed."""
        if not isinstance(data, Mapping):
            raise InputError(f"found {type(data).__name__}, expected a map")
        model = cls(folder=folder)
        model.data = {"floatframe": 1, **plain(data)}
        return model._with(parameters)

    def _with(self, parameters: Mapping[str, Any]) -> Model:
        self._parameters = {name: parameter_text(value) for name, value in parameters.items()}
        self.core  # raises errors in this call
        return self

    @property
    def filled_in(self) -> bool:
        """True if it has `data`, i.e. it is not from a file or a text."""
        return self._path is None and self._text is None

    @property
    def core(self) -> _core.LoadedModel:
        """The built model of the C++ library."""
        parameters = list(self._parameters.items())
        if self._path is not None:
            if self._built is None:
                self._built = None, _core.load_model(self.file, parameters)
            return self._built[1]
        text, functions = self.to_yaml(), self.functions
        if self._built is None or self._built[0] != (text, functions):
            self._built = (text, functions), _core.read_model(text, self.file, parameters, dict(functions))
        return self._built[1]

    @property
    def functions(self) -> dict[str, Callable[..., Any]]:
        """Functions of forces of the type `force_law`, by the names of the forces. They are not in `to_yaml()`, which has their
        names: only this program can build the model."""
        forces = self.data.get("forces", {}) if self.filled_in else {}
        laws = {name: f.get("law") for name, f in forces.items() if isinstance(f, Mapping)} if isinstance(forces, Mapping) else {}
        return {name: law for name, law in laws.items() if callable(law)}

    @property
    def file(self) -> str:
        """The model file, or its substitute in messages."""
        if self._path is None:
            return os.path.join(self._folder, "<model>")
        return self._path if os.getcwd() == self._home else os.path.join(self._home, self._path)

    @property
    def parameters(self) -> dict[str, str]:
        """Parameter values given when it was loaded."""
        return dict(self._parameters)

    def to_yaml(self) -> str:
        """The text of its model file, which `floatframe run` reads; for a loaded model, the text of the file, in which
        parameters have the values of the file (given values are in `parameters`)."""
        if self._path is not None:
            return Path(self.file).read_text(encoding="utf-8")
        return self._text if self._text is not None else to_yaml(self.data)

    def _section(self, key: str) -> Section:
        if not self.filled_in:
            raise InputError(f"a model from a file is changed by its parameters; {key} are filled in by Model() and Model.from_dict")
        return Section(self, key)

    @property
    def points(self) -> Section:
        """`model.points.add("tip", [1, 0, 0])`: design configuration [m]."""
        return self._section("points")

    @property
    def bodies(self) -> Section:
        return self._section("bodies")

    @property
    def joints(self) -> Section:
        return self._section("joints")

    @property
    def rods(self) -> Section:
        return self._section("rods")

    @property
    def constraints(self) -> Section:
        return self._section("constraints")

    @property
    def couplings(self) -> Section:
        return self._section("couplings")

    @property
    def controllers(self) -> Section:
        return self._section("controllers")

    @property
    def forces(self) -> Section:
        return self._section("forces")

    @property
    def roads(self) -> Section:
        return self._section("roads")

    @property
    def inputs(self) -> Section:
        return self._section("inputs")

    @property
    def outputs(self) -> Section:
        return self._section("outputs")

    @property
    def measures(self) -> Section:
        return self._section("measures")

    @property
    def tables(self) -> Section:
        return self._section("tables")

    @property
    def subsystems(self) -> Section:
        return self._section("subsystems")

    @property
    def initial(self) -> Section:
        return self._section("initial")

    @property
    def simulation(self) -> Section:
        """Options of runs: `model.simulation["step"] = 1e-3`."""
        return self._section("simulation")

    @property
    def name(self) -> str:
        return str(self.data["name"]) if self.filled_in and "name" in self.data else self.core.name

    @property
    def units(self) -> dict[str, str]:
        """Units of the outputs of the built model, by name."""
        return dict(self.core.output_units)

    def __repr__(self) -> str:
        return f"<floatframe.Model '{self.name}'>"

    def __deepcopy__(self, memo: dict[int, Any]) -> Model:
        return self.copy()

    def __copy__(self) -> Model:
        return self.copy()

    def copy(self) -> Model:
        """An independent model with the same description; the built system is shared."""
        other = Model.__new__(type(self))
        other.__dict__.update(self.__dict__)
        other.data = plain(self.data)
        other._parameters = dict(self._parameters)
        return other

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_built": None}


def built(model: Model) -> _core.LoadedModel:
    """The built model of the C++ library; InputError for other objects."""
    if not isinstance(model, Model):
        raise InputError(f"found {type(model).__name__}, expected a floatframe.Model")
    return model.core
