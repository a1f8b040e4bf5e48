"""Runs of models and their results."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

from . import _core, result_files
from .arrays import path
from .errors import InputError, OutputError, UnknownNameError, tell
from .model import Model, built, part_cache
from .progress import Bar
from .options import Array, Options, as_dict
from .saved import ModelOfRun, SavedRun, read_run
from .scene import RunScene

if TYPE_CHECKING:
    import pandas
    import pyvista
    from typing_extensions import Unpack


Controller = Callable[[float, Array, Array], Union[Mapping[str, float], None]]
"""A sampled controller: `function(time, outputs, inputs)`."""


class Result(Mapping[str, Array]):
    """Result of a run: samples of its outputs and a summary.

    `res["chassis.z"]` is the array of an output, shape (samples,), unit `res.units["chassis.z"]`; `res["chassis"]` that of its
    components x, y, z (or roll, pitch, yaw), shape (samples, 3). Arrays share the memory of the result and keep it alive.
    Results are pickled with their states, without their page.
    """

    def __init__(self, core: _core.Run | SavedRun, model: Model | None, find: Callable[[], Model] | None = None) -> None:
        self._core = core
        self._model = None if model is None else model.copy()
        self._find = find  # the model of a result that was loaded
        self._scene: RunScene | None = None
        columns = core.columns
        self.units: dict[str, str] = dict(columns)
        """Units by column name; "time" is the first."""
        self.table: Array = core.table
        """All samples, shape (samples, columns): time, then the outputs in their order."""
        self._column = {name: k for k, (name, _) in enumerate(columns)}
        self._vectors = result_files.vector_names(self._column)
        self.summary: dict[str, Any] = json.loads(core.summary_json)
        """Content of `summary.json` of the command line: status, steps, iterations, energies, violations, warnings."""
        self.name = model.name if model is not None else str(self.summary.get("model", ""))
        """Name of the model."""

    @classmethod
    def load(cls, folder: str | os.PathLike[str], *, model: Model | None = None) -> Result:
        """The result that `save` or `floatframe run` has written to a folder. model: of the run, for pictures; by default it is
        loaded from its file, when it is needed. Raises InputError.

        >>> res = ff.Result.load("out/vehicle")
        """
        where = path("folder", folder)
        if model is not None and not isinstance(model, Model):
            raise InputError(f"model: found {type(model).__name__}, expected a floatframe.Model")
        saved = read_run(where)
        try:
            return cls(saved, model, ModelOfRun(os.path.abspath(where), saved.states))
        except json.JSONDecodeError as error:
            raise InputError(f"{os.path.join(where, 'summary.json')}: found no summary of a run: {error}") from None

    @property
    def model(self) -> Model:
        """The model of the run, as it was then."""
        if self._model is None:
            if self._find is None:
                raise InputError(f"the model of '{self.name}' is not known")
            self._model = self._find()
        return self._model

    @property
    def time(self) -> Array:
        """Instants of the samples [s], shape (samples,)."""
        return self.table[:, 0]

    def __getitem__(self, name: str) -> Array:
        if name in self._column:
            return self.table[:, self._column[name]]
        if name in self._vectors:
            return result_files.columns_of(self.table, self._vectors[name])
        raise UnknownNameError(f"found no output '{name}', expected one of {', '.join([*self._column, *self._vectors])}")

    def __contains__(self, name: object) -> bool:
        return name in self._column or name in self._vectors

    def _ipython_key_completions_(self) -> list[str]:
        return [*self._column, *self._vectors]

    def __iter__(self) -> Iterator[str]:
        return iter(self._column)

    def __len__(self) -> int:
        return len(self._column)

    def to_pandas(self) -> pandas.DataFrame:
        """A pandas table with the time as its index; a copy of the data."""
        import pandas

        names = list(self._column)
        index = pandas.Index(self.time.copy(), name="time")
        return pandas.DataFrame(self.table[:, 1:].copy(), columns=names[1:], index=index)

    def to_csv(self) -> str:
        """Content of `results.csv` of the command line: every number reads back to the same bits."""
        return self._core.results_csv

    def save(self, folder: str | os.PathLike[str]) -> str:
        """Writes results.csv, states.ffr, report.html and summary.json into a folder, as `floatframe run --out` does; all
        commands for results can read these. A model made or changed in Python is written to the same folder: model.yaml, with a body
        file for each Part in it; other files that it refers to stay where they are. Returns the folder."""
        where = path("folder", folder)
        if isinstance(self._core, SavedRun):
            self._core.save(None, where, "")
            return where
        model, file = self.model.core, self.model.file
        if file.endswith("<model>"):
            model, file = self._written(where, model)
        self._core.save(model, where, file)
        return where

    def _written(self, folder: str, model: _core.LoadedModel) -> tuple[_core.LoadedModel, str]:
        """Writes the model next to the results, which then refer to it. One with functions, which no file holds, is written to be
        read by people."""
        file = self.model._save(os.path.join(folder, "model.yaml"))
        if self.model.functions:
            return model, self.model.file
        with part_cache(os.path.dirname(os.path.abspath(self.model.file))):
            return _core.load_model(file, list(self.model.parameters.items())), file

    def to_mat(self, file: str | os.PathLike[str]) -> str:
        """Writes a file of MATLAB (needs scipy): `table`, shape (samples, columns), `names` and `units` of its columns, `model`,
        `summary` as JSON. Returns the path."""
        return result_files.to_mat(self, file)

    def to_hdf5(self, file: str | os.PathLike[str]) -> str:
        """Writes a file of HDF5 (needs h5py): a dataset for each column, with the attribute `unit`; `model` and `summary` (JSON) as
        attributes of the file. Returns the path."""
        return result_files.to_hdf5(self, file)

    def to_parquet(self, file: str | os.PathLike[str]) -> str:
        """Writes a file of Parquet (needs pyarrow): a column for each output and the time, with `unit` in its metadata. Returns the
        path."""
        return result_files.to_parquet(self, file)

    def plot(self, names: Sequence[str] | str | None = None, *, axes: Any = None) -> Any:
        """Curves of outputs over the time by matplotlib, one plot per unit; returns the axes, shape (units,). names: None for
        all. axes: existing axes, one per unit, or a single one for all."""
        from .plotting import plot

        return plot(self, names, axes)

    def view(self, height: int = 640) -> Any:
        """The report of the run with its 3-D view, in a notebook; height [px]. Elsewhere `save` writes the same page."""
        from .notebook import Page

        with tempfile.TemporaryDirectory() as folder:
            self.save(folder)
            page = Path(folder, "report.html")
            if not page.exists():
                why = "a result that was unpickled has none" if isinstance(self._core, SavedRun) else "this library was built without it (Node 18 or later with npm)"
                raise OutputError(f"there is no page to view: {why}")
            return Page(page.read_text(encoding="utf-8"), height)

    def to_pyvista(self, time: float | None = None) -> pyvista.UnstructuredGrid:
        """The bodies at the recorded instant nearest to `time` [s] (None: the last), with their positions and deformations, for
        pictures and animations; needs pyvista. Point data "displacement" [m] from the design, "deformation", "velocity", and for parts with
        stress data "von_mises" [Pa]; cell data "body" (docs/export.md)."""
        result_files.module("pyvista", "to_pyvista")
        if self._scene is None:
            self._scene = result_files.scene_of(self)
        return self._scene.at(time)

    @property
    def state(self) -> _core.State | None:
        """State at the end of the run, as the start of another: `ff.run(model, start=res.state)`."""
        return self._core.state

    def __reduce__(self) -> tuple[Any, ...]:
        return Result, (result_files.saved_run(self), self._model, self._find)

    def _repr_html_(self) -> str:
        return result_files.as_html(self)

    def __repr__(self) -> str:
        count = len(self.summary.get("warnings") or ())
        limits = "" if isinstance(self._core, SavedRun) else ": " + ", ".join(limit for limit, _ in self._core.warnings)
        said = f", {count} warning{'s' if count > 1 else ''}{limits}" if count else ""
        why = f": {self.summary['message']}" if self.summary["status"] == "failed" else ""
        return f"<floatframe.Result of '{self.name}': {len(self.table)} samples, {self.summary['status']}{why}{said}>"


def run(
    model: Model,
    *,
    duration: float | None = None,
    progress: bool | Callable[[float], object] = False,
    verify: bool = False,
    on_step: Controller | None = None,
    period: float | None = None,
    **options: Unpack[Options],
) -> Result:
    """Runs a model; options not given are those of the model. The result of a run that fails contains all samples before the
    failure, and `res.summary["status"]` shows it. A failure and what left the range of the method are warnings
    (`ff.RunWarning`), with the sentences of the command line.

    duration: [s]. progress: True for a bar (of tqdm, if installed), or a function of the fraction done (0..1), called at most
    20 times a second. verify: makes the run again at a half and a quarter of the step, in about seven times the time:
    `res.summary["verification"]` has the difference, order and estimated error of each output.

    on_step: a sampled controller, `function(time, outputs, inputs)`, called at the beginning of every step, or of every `period`
    [s], a multiple of the step: time [s], outputs and inputs as arrays in the order of the model. It changes the inputs in place or
    returns a map of their names and values; they are held from then on. None as its result changes nothing; anything else raises
    InputError. What it raises comes through. It is called in a thread of its own.

    All other options are those of `Options`: step [s], coordinates, inertia, start, tolerance, ...

    Other Python threads keep running meanwhile, and Ctrl-C ends the run. Raises InputError for invalid input, RunError if the
    start cannot be found.
    """
    core = built(model)
    with Bar(progress) as bar:
        core_run = _core.run(core, duration, bar.show, verify, as_dict(options), model.file, settings_of(model), on_step, period)
    result = Result(core_run, model)
    if result.summary["status"] == "failed":
        tell(f"the run failed: {result.summary['message']}", "failed", 1)
    for limit, sentence in core_run.warnings:
        tell(sentence, limit, 1)
    return result


def settings_of(model: Model) -> list[str]:
    """The parameters of a model as they are given to the command line."""
    return [f"{name}={value}" for name, value in model.parameters.items()]


def state_again(text: str) -> _core.State:
    """Restores a pickled state."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "state.json")
        file.write_text(text, encoding="utf-8")
        return _core.State.load(str(file))
