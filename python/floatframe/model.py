"""Models: from files, texts, Python data, or built step by step."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any, Union

from . import _core
from .arrays import path as path_of
from .builders import Bodies, Constraints, Controllers, Couplings, Forces, Inputs, Joints, Outputs, SimulationSection
from .errors import InputError, OutputError
from .sections import Section
from .values import body_file
from .yaml import parts_of, plain, to_yaml

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


class Model:
    """A multibody system: the content of a model file (docs/model-file.md), checked and built by the C++ library on use.

    From a file:    `Model.load("iltis.yaml", road="bump", speed=10)`
    From its text:  `Model.from_yaml(text)`
    From data:      `Model.from_dict({"bodies": {...}, ...})`
    Step by step:   `model = Model("pendulum"); model.bodies.add("arm", rigid={...}); ...`

    Its description is `data`, nested maps and lists with the names of model files; sections (`bodies`, `joints`, ...) are views
    of it. It is built again when the description has changed. Errors name the entity, and lines and columns are those of
    `to_yaml()`, or of the file while nothing of it was changed.
    """

    def __init__(self, name: str = "model", *, folder: PathLike | None = None) -> None:
        """folder: base of relative file names in the model; the working folder if not given."""
        if not isinstance(name, str):
            raise InputError(f"name: found {type(name).__name__}, expected a text")
        self._data: dict[str, Any] | None = {"floatframe": 1, "name": plain(name, "name")}
        self._path: str | None = None  # of a model file
        self._home = os.getcwd()  # base of relative paths
        self._text: str | None = None  # of the file, or given
        self._original: str | None = None  # how `_text` reads when it is written from data
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
        model._data = None
        model._give(parameters)
        model.core  # raises errors in this call
        try:
            model._text = Path(model.file).read_text(encoding="utf-8")
        except UnicodeDecodeError:
            pass  # a packed model, which has no text
        except OSError as error:
            raise InputError(f"{model.file}: the file cannot be read: {error}") from None
        return model

    @classmethod
    def from_yaml(cls, text: str, /, *, folder: PathLike | None = None, **parameters: Any) -> Model:
        """The model of the text of a model file."""
        if not isinstance(text, str):
            raise InputError(f"found {type(text).__name__}, expected the text of a model file")
        model = cls(folder=folder)
        model._text = text
        model._data = None
        model._give(parameters)
        model.core
        return model

    @classmethod
    def from_dict(cls, data: Mapping[str, Any], /, *, folder: PathLike | None = None, **parameters: Any) -> Model:
        """The model of nested data with the names of model files. `floatframe: 1` is not needed."""
        if not isinstance(data, Mapping):
            raise InputError(f"found {type(data).__name__}, expected a map")
        model = cls(folder=folder)
        model._data = {"floatframe": 1, **plain(data)}
        model._give(parameters)
        model._check_and_take_parameters()
        model.core
        return model

    def with_parameters(self, **parameters: Any) -> Model:
        """A copy with other values of these parameters, built anew. Raises InputError."""
        model = self.copy()
        model._give({**self.parameters, **parameters})
        model._built = None
        if self.filled_in:
            model._check_and_take_parameters()
        elif self._text is not None:
            model._data = None
        model.core
        return model

    def _check_and_take_parameters(self) -> None:
        if self._parameters:  # unknown ones are an error of the reader
            text = self._written(body_file)
            _core.read_model(text, self.file, list(self._parameters.items()), dict(self.functions))
            self._take_parameters(self.data)

    def _give(self, parameters: Mapping[str, Any]) -> None:
        self._parameters = {name: parameter_text(value) for name, value in parameters.items()}

    def _take_parameters(self, data: dict[str, Any]) -> None:
        """Puts the values given into a description."""
        for name, text in self._parameters.items():
            number = _as_written(text)
            entries = data.setdefault("parameters", {})
            if isinstance(entries.get(name), dict):
                entries[name]["value"] = number
            else:
                entries[name] = number

    @property
    def data(self) -> dict[str, Any]:
        """Its description: nested maps and lists with the names of model files, to be read and changed. That of a loaded model
        is filled from the file, with the parameter values given; expressions are texts ("${2 * m}")."""
        if self._data is None:
            if self._text is None:
                raise InputError(f"{self.file}: found a packed model, which has no description to change, expected its model file")
            values = _core.model_values(self._text, self.file)
            data: dict[str, Any] = plain(values if isinstance(values, dict) else {})
            self._take_parameters(data)
            self._original = to_yaml(data)
            self._data = data
        return self._data

    @data.setter
    def data(self, value: Mapping[str, Any]) -> None:
        if not isinstance(value, Mapping):
            raise InputError(f"data: found {type(value).__name__}, expected a map")
        if self._text is not None:
            self.data  # how the file reads, for comparison
        self._data = plain(value)

    @property
    def filled_in(self) -> bool:
        """True if its description is `data`: it was made in Python, or changed since it was loaded."""
        if self._data is None:
            return False
        return self._text is None or to_yaml(self._data) != self._original or bool(self._functions(self._data))

    @property
    def core(self) -> _core.LoadedModel:
        """The built model of the C++ library."""
        parameters = list(self._parameters.items())
        if not self.filled_in:
            if self._built is None or self._built[0] is not None:
                if self._path is not None:
                    self._built = None, _core.load_model(self.file, parameters)
                else:
                    self._built = None, _core.read_model(self._text or "", self.file, parameters, {})
            return self._built[1]
        text, functions = self._written(body_file), self.functions
        if self._built is None or self._built[0] != (text, functions):
            self._built = (text, functions), _core.read_model(text, self.file, [], dict(functions))
        return self._built[1]

    @staticmethod
    def _functions(data: Mapping[str, Any]) -> dict[str, Callable[..., Any]]:
        forces = data.get("forces", {})
        laws = {name: f.get("law") for name, f in forces.items() if isinstance(f, Mapping)} if isinstance(forces, Mapping) else {}
        return {name: law for name, law in laws.items() if callable(law)}

    @property
    def functions(self) -> dict[str, Callable[..., Any]]:
        """Functions of forces of the type `force_law`, by the names of the forces. They are not in `to_yaml()`, which has their
        names: only this program can build the model."""
        return {} if self._data is None else self._functions(self._data)

    @property
    def file(self) -> str:
        """The model file; of a model that was made or changed in Python a substitute in messages, "FOLDER/<model>"."""
        if self._path is not None and not self.filled_in:
            return self._at_home(self._path)
        folder = self._folder if self._path is None else os.path.dirname(self._path)
        return os.path.join(self._at_home(folder), "<model>")

    def _at_home(self, path: str) -> str:
        return path if os.getcwd() == self._home else os.path.join(self._home, path)

    @property
    def parameters(self) -> Mapping[str, str]:
        """Parameter values given when it was loaded, to be read; those changed in `data["parameters"]` since are left out."""
        if self._data is None:
            return MappingProxyType(dict(self._parameters))
        entries = self._data.get("parameters", {})
        kept = {}
        for name, text in self._parameters.items():
            value = entries.get(name) if isinstance(entries, dict) else None
            value = value.get("value") if isinstance(value, dict) else value
            if isinstance(value, (bool, int, float, str)) and parameter_text(value) == text:
                kept[name] = text
        return MappingProxyType(kept)

    def to_yaml(self) -> str:
        """The text of its model file, which `floatframe run` reads, with the parameter values given. A loaded model without any
        has the text of its file. Parts that are values are named "BODY.ffb": `save` writes them beside it."""
        if self._text is not None and not self._parameters and not self.filled_in:
            return self._text
        return self._written(None)

    def _written(self, file_of: Callable[[Any], str] | None) -> str:
        return to_yaml(self.data, file_of)

    def save(self, path: PathLike) -> str:
        """Writes its model file, and beside it a body file for each Part that is a value. Other files that it refers to stay
        where they are, and the model file has their absolute paths. Returns the path.

        >>> model.save("out/arm.yaml")

        Raises InputError for a model with functions, which no file holds, and OutputError."""
        if self.functions:
            raise InputError(f"forces.{next(iter(self.functions))}.law: found a function, which no model file holds, expected a table or a formula")
        return self._save(path_of("path", path))

    def _save(self, path: str, absolute: bool = False) -> str:
        """absolute: the names of body files are too."""
        folder = os.path.dirname(os.path.abspath(path))
        files = {os.path.abspath(file) for file in self.core.files}
        base = os.path.dirname(os.path.abspath(self.file))
        content = _resolved(plain(self.data), base, files)
        names = {id(part): os.path.join(folder if absolute else "", f"{name}.ffb") for name, part in parts_of(content)}
        try:
            os.makedirs(folder, exist_ok=True)
            for name, part in parts_of(content):
                part.save(os.path.join(folder, f"{name}.ffb"))
            Path(path).write_text(to_yaml(content, lambda part: names[id(part)]), encoding="utf-8")
        except OSError as error:
            raise OutputError(f"the model cannot be written: {error}") from None
        return path

    def _view(self) -> dict[str, Any]:
        return self.data

    @property
    def points(self) -> Section:
        """`model.points.add("tip", [1, 0, 0])`: design configuration [m]."""
        return Section(self._view, "points")

    @property
    def bodies(self) -> Bodies:
        """`model.bodies.add("arm", rigid={...})`, or `flexible=part` with a `Part`."""
        return Bodies(self._view, "bodies")

    @property
    def joints(self) -> Joints:
        """`model.joints.revolute("knee", parent="thigh", child="shank", at="knee", axis="y")`."""
        return Joints(self._view, "joints")

    @property
    def rods(self) -> Section:
        """Massless rods of constant or driven length."""
        return Section(self._view, "rods")

    @property
    def constraints(self) -> Constraints:
        """Points and directions that are held on other bodies."""
        return Constraints(self._view, "constraints")

    @property
    def couplings(self) -> Couplings:
        """Gears, belts, cams, sums of joint coordinates."""
        return Couplings(self._view, "couplings")

    @property
    def controllers(self) -> Controllers:
        """What turns signals into values that forces read."""
        return Controllers(self._view, "controllers")

    @property
    def forces(self) -> Forces:
        """`model.forces.spring_damper("spring", from_={"body": "arm"}, to={"body": "ground"}, spring=1e4)`."""
        return Forces(self._view, "forces")

    @property
    def roads(self) -> Section:
        """Heights below tyres."""
        return Section(self._view, "roads")

    @property
    def inputs(self) -> Inputs:
        """Numbers from outside."""
        return Inputs(self._view, "inputs")

    @property
    def outputs(self) -> Outputs:
        """`model.outputs.add("tip.z", position={"body": "arm", "at": "tip"}, axis="z")`."""
        return Outputs(self._view, "outputs")

    @property
    def measures(self) -> Outputs:
        """What formulas read."""
        return Outputs(self._view, "measures")

    @property
    def tables(self) -> Section:
        """Laws and grids of formulas."""
        return Section(self._view, "tables")

    @property
    def subsystems(self) -> Section:
        """Models within the model."""
        return Section(self._view, "subsystems")

    @property
    def initial(self) -> Section:
        """Initial modal amplitudes."""
        return Section(self._view, "initial")

    @property
    def simulation(self) -> SimulationSection:
        """Options of runs: `model.simulation["step"] = 1e-3`."""
        return SimulationSection(self._view, "simulation")

    @property
    def name(self) -> str:
        """Name of the model, also of its result folder."""
        return str(self.data["name"]) if self.filled_in and "name" in self.data else self.core.name

    @name.setter
    def name(self, value: str) -> None:
        if not isinstance(value, str):
            raise InputError(f"name: found {type(value).__name__}, expected a text")
        self.data["name"] = plain(value, "name")

    def __setattr__(self, name: str, value: Any) -> None:
        if name in _SECTIONS:
            if not isinstance(value, Mapping):
                raise InputError(f"{name}: found {type(value).__name__}, expected a map of names")
            self.data[name] = plain(dict(value), name)
        elif name.startswith("_") or name in ("data", "name"):
            object.__setattr__(self, name, value)
        else:
            raise AttributeError(f"a model has no '{name}' to set, expected one of name, data, {', '.join(_SECTIONS)}; other keys are in data")

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
        other._data = None if self._data is None else plain(self._data)
        other._parameters = dict(self._parameters)
        return other

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_built": None}


_SECTIONS = (
    "points",
    "bodies",
    "joints",
    "rods",
    "constraints",
    "couplings",
    "controllers",
    "forces",
    "roads",
    "inputs",
    "outputs",
    "measures",
    "tables",
    "subsystems",
    "initial",
    "simulation",
)


@contextlib.contextmanager
def part_cache(folder: str) -> Iterator[None]:
    """In its scope, parts are taken from the cache of models in a folder: they are not reduced again for a copy elsewhere."""
    if "FLOATFRAME_CACHE" in os.environ or not os.access(folder, os.W_OK):
        yield
        return
    os.environ["FLOATFRAME_CACHE"] = os.path.join(folder, ".floatframe-cache")
    try:
        yield
    finally:
        del os.environ["FLOATFRAME_CACHE"]


def _as_written(text: str) -> Any:
    """The value of a parameter given as a text: numbers and truth values as model files have them."""
    try:
        values = _core.model_values(f"v: {text}", "")
    except InputError:
        return text
    value = values.get("v") if isinstance(values, dict) else None
    return value if isinstance(value, (bool, int, float)) else text


def _resolved(value: Any, base: str, files: set[str]) -> Any:
    """A description whose names of files, relative to `base`, are absolute."""
    if isinstance(value, dict):
        return {key: _resolved(v, base, files) for key, v in value.items()}
    if isinstance(value, list):
        return [_resolved(v, base, files) for v in value]
    if isinstance(value, str) and value and "\0" not in value:
        file = os.path.normpath(os.path.join(base, value))
        return file if file in files else value
    return value


def built(model: Model) -> _core.LoadedModel:
    """The built model of the C++ library; InputError for other objects."""
    if not isinstance(model, Model):
        raise InputError(f"found {type(model).__name__}, expected a floatframe.Model")
    return model.core
