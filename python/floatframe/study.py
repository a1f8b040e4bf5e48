"""Parameter studies, by the engine of `floatframe sweep`."""

from __future__ import annotations

import math
import os
import re
import signal
import subprocess
import tempfile
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .arrays import function_or_flag, number, path, texts, whole
from .build import program
from .errors import ErrorEntry, InputError, OutputError, RunError, tell, worded
from .function_study import rows_of_runs
from .model import Model, built, parameter_text
from .progress import Bar
from .run import Controller
from .yaml import plain

if TYPE_CHECKING:
    import pandas


def sweep(
    model: Model,
    *,
    processes: int | None = None,
    measure: Sequence[str] = (),
    runs: Iterable[Mapping[str, Any]] | None = None,
    folder: str | os.PathLike[str] | None = None,
    fresh: bool = False,
    step: float | None = None,
    duration: float | None = None,
    coordinates: str | None = None,
    inertia: str | None = None,
    case_timeout: float | None = None,
    progress: bool | Callable[[float], object] = False,
    series: bool = False,
    on_step: Controller | None = None,
    period: float | None = None,
    vary: Mapping[str, Iterable[Any]] | None = None,
    **variations: Iterable[Any],
) -> pandas.DataFrame:
    """Runs a model with all combinations of values of parameters or simulation options; the last one named changes fastest.
    Returns a pandas table, one row per run: values, "status", and figures of outputs such as "tip.x max [m]".

    >>> ff.sweep(model, speed=np.linspace(3, 8, 11), processes=4)

    vary: the same as a map, for names that are not Python identifiers: options ("simulation.step"), and any value of a model with
    `data` by its path ("bodies.arm.rigid.mass", "points.tip.0"). runs: instead of all combinations,
    one map of values per run. measure: outputs in the table, "tip.x" or "tip.x:max"; none: all. processes: number of
    simultaneous runs, each in a separate process; None: the number of processors. folder: location of sweep.csv and its
    journal, from which an interrupted study continues; None: temporary. case_timeout [s]: longer runs are counted as failed. A
    run that fails or crashes is a row whose "status" and "message" give the reason. progress: True for a bar, in notebooks too, or
    a function of the fraction done. series: `table.attrs["series"]` has the samples of each run by its number, as pandas tables.
    Runs that left the range of the method are told as warnings (`ff.RunWarning`).

    on_step, period: a controller of all runs, as of `run`. Such a study, and one of a model with functions as laws, is made in
    this process, one run after the other, without a journal. Raises InputError for invalid input.
    """
    import pandas  # noqa: F401  before hours of computing

    built(model)  # raises its errors
    out_folder = None if folder is None else path("folder", folder)
    fixed = _options(processes, step, duration, coordinates, inertia, case_timeout)
    if vary is not None and not isinstance(vary, Mapping):
        raise InputError(f"vary: found {type(vary).__name__}, expected a map of names and values")
    function_or_flag("progress", progress)
    rows = _all_rows({**(vary or {}), **variations}, runs)
    model, parameters = with_paths(model, list(rows[0]))
    paths = {parameter: path for path, parameter in parameters.items()}
    rows = [{parameters.get(name, name): value for name, value in row.items()} for row in rows]
    figures = texts("measure", measure)
    if on_step is not None or model.functions:
        if out_folder is not None or case_timeout is not None:
            raise InputError("folder, case_timeout: found a study with functions of Python, which has neither")
        given = {"step": step, "duration": duration, "coordinates": coordinates, "inertia": inertia}
        table, found = rows_of_runs(model, rows, given, on_step, period, figures, progress)
        if series:
            table.attrs["series"] = {run: result.to_pandas() for run, result in found.items()}
        return table.rename(columns=paths)
    with tempfile.TemporaryDirectory() as scratch:
        out = out_folder or os.path.join(scratch, "study")
        arguments = [program(), "sweep", *_model_file(model, out_folder or scratch), "--out", out, *fixed, "--quiet"]
        arguments += _written(rows, scratch)
        for name, text in model.parameters.items():
            arguments += ["--set", f"{name}={text}"]
        for figure in figures:
            arguments += ["--measure", figure]
        arguments += [option for option, on in (("--fresh", fresh), ("--keep-results", series)) if on]
        with Bar(progress) as bar:
            _run(arguments, Path(out, "sweep.journal"), len(rows), bar.show)
        table = _table(Path(out, "sweep.csv")).rename(columns=paths)
        if series:
            table.attrs["series"] = {run: _samples(Path(out, "runs", str(run), "results.csv")) for run in table.index}
        return table


def with_paths(model: Model, names: Sequence[str]) -> tuple[Model, dict[str, str]]:
    """A model in which the values at these paths of its data are parameters, and the parameters by path. Names that are no paths
    stay."""
    paths = [name for name in names if "." in name and not name.startswith("simulation.") and _holder(model.data, name) is not None]
    if not paths:
        return model, {}
    data = plain(model.data)
    parameters = {path: f"varied_{k}" for k, path in enumerate(paths, start=1)}
    for path, parameter in parameters.items():
        holder = _holder(data, path)
        assert holder is not None
        into, key = holder
        data.setdefault("parameters", {})[parameter] = into[key]
        into[key] = f"${{{parameter}}}"
    return Model.from_dict(data, folder=os.path.dirname(os.path.abspath(model.file)), **model.parameters), parameters


def _holder(data: Any, path: str) -> tuple[Any, Any] | None:
    """The map or list that has the value at a path, and its key; None if there is none that is a number, a word or a truth value."""
    *ways, last = path.split(".")
    for way in ways:
        data = _item(data, way)
    value = _item(data, last)
    if value is None or isinstance(value, (dict, list, tuple)):
        return None
    return data, int(last) if isinstance(data, list) else last


def _item(data: Any, key: str) -> Any:
    if isinstance(data, dict):
        return data.get(key)
    if isinstance(data, list) and key.isdigit() and int(key) < len(data):
        return data[int(key)]
    return None


def _options(
    processes: object, step: object, duration: object, coordinates: object, inertia: object, case_timeout: object
) -> list[str]:
    """Settings of all runs, as accepted by the command."""
    given: dict[str, str] = {}
    if processes is not None:
        given["threads"] = str(whole("processes", processes, 1, 4096))
    for name, value in (("step", step), ("duration", duration), ("case_timeout", case_timeout)):
        if value is not None:
            given[name.replace("_", "-")] = repr(number(name, value, positive=True))
    for name, word, words in (
        ("coordinates", coordinates, ("relative", "absolute")),
        ("inertia", inertia, ("preprocessing", "projection")),
    ):
        if word is not None and word not in words:
            raise InputError(f"{name}: found {word!r}, expected one of {', '.join(words)}")
        if word is not None:
            given[name] = str(word)
    return [text for name, value in given.items() for text in (f"--{name}", value)]


def _model_file(model: Model, folder: str) -> list[str]:
    """Writes a model that is not from a file to a file, with what it refers to."""
    if not model.file.endswith("<model>"):
        return [model.file]
    try:
        os.makedirs(folder, exist_ok=True)
        file = Path(folder, "model.yaml")
        model._save(str(file), absolute=True)
    except OSError as error:
        raise OutputError(f"the model of the study cannot be written: {error}") from None
    return [str(file), "--files-in", os.path.dirname(os.path.abspath(model.file))]


def _all_rows(vary: Mapping[str, Iterable[Any]], runs: Iterable[Mapping[str, Any]] | None) -> list[dict[str, Any]]:
    """The values of each run."""
    if runs is None:
        if not vary:
            raise InputError("found nothing to vary, expected values of a parameter: sweep(model, speed=[3, 4, 5])")
        # A table of all combinations may contain any text; the last name changes fastest.
        rows: list[dict[str, Any]] = [{}]
        for name, values in vary.items():
            if not isinstance(name, str):
                raise InputError(f"vary: found the name {name!r}, expected a text")
            if isinstance(values, (str, bytes)) or not hasattr(values, "__iter__"):
                raise InputError(f"{name}: found {values!r}, expected a list of values")
            taken = list(values)
            if not taken:
                raise InputError(f"{name}: found no values")
            rows = [{**row, name: value} for row in rows for value in taken]
    elif vary:
        raise InputError("found variations and runs, expected one of them")
    else:
        rows = _rows(runs)
    if not rows or any(list(row) != list(rows[0]) for row in rows) or not rows[0]:
        raise InputError("runs: expected at least one map of values, all with the same names")
    return rows


def _written(rows: Sequence[Mapping[str, Any]], scratch: str) -> list[str]:
    """The option with a table of the runs."""
    path = Path(scratch, "runs.csv")
    lines = [list(rows[0])] + [[parameter_text(value) for value in row.values()] for row in rows]
    path.write_text("".join(",".join(_field(text) for text in line) + "\n" for line in lines), encoding="utf-8")
    return ["--table", str(path)]


def _rows(runs: object) -> list[dict[str, Any]]:
    if isinstance(runs, (str, bytes, Mapping)) or not isinstance(runs, Iterable):
        raise InputError(f"runs: found {type(runs).__name__}, expected a list of maps of values")
    rows = []
    for row in runs:
        if not isinstance(row, Mapping) or not all(isinstance(name, str) for name in row):
            raise InputError(f"runs: found {row!r}, expected a map of names and values")
        rows.append(dict(row))
    return rows


def _field(text: str) -> str:
    if any(c in text for c in "\n\r\0"):
        raise InputError(f"found the value {text!r}, expected one line of text")
    return '"' + text.replace('"', '""') + '"' if any(c in text for c in ',"') else text


def _run(arguments: Sequence[str], journal: Path, runs: int, show: Callable[[float], object] | None) -> None:
    process = subprocess.Popen(arguments, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, start_new_session=True)
    try:
        while True:
            try:
                _, text = process.communicate(timeout=0.2)
                break
            except subprocess.TimeoutExpired:
                if show is not None:
                    show(_finished(journal, runs))
    except BaseException:
        process.send_signal(signal.SIGINT)  # the command cancels its runs and keeps the journal
        process.wait()
        raise
    if process.returncode == 2:
        raise InputError([_entry(line) for line in (text or "the study was refused").strip().splitlines()])
    if process.returncode not in (0, 1):
        raise RunError(f"the study ended with exit code {process.returncode}: {(text or '').strip()}")
    if show is not None:
        show(1.0)
    for line in text.splitlines():
        if found := re.match(r"(?:floatframe: )?warning: (.*)", line):
            tell(found[1], "study", 2)


def _finished(journal: Path, runs: int) -> float:
    """The fraction of runs that are finished: a line of the journal for each, behind its first one."""
    try:
        lines = journal.read_bytes().count(b"\n")
    except OSError:
        return 0.0
    return min(1.0, max(0, lines - 1) / runs)


def _samples(path: Path) -> pandas.DataFrame | None:
    """The samples of a run that was kept, over the time; None if it has none."""
    import pandas

    if not path.is_file():
        return None
    table = pandas.read_csv(path)
    table.columns = [re.sub(r" \[[^]]*\]$", "", name) for name in table.columns]
    return table.set_index("time")


def _entry(line: str) -> ErrorEntry:
    # Values are passed in a table made by this package: its second line is the first run.
    line = re.sub(r"\S*/runs\.csv: ", "", line.removeprefix("floatframe: "))
    line = re.sub(r"\S*/runs\.csv:(\d+)[.:] ?", lambda found: f"run {int(found[1]) - 1}: ", line)
    if place := re.match(r"(.+?):(\d+):(\d+): (.*)", line):
        return ErrorEntry(place[1], int(place[2]), int(place[3]), worded(place[4]))
    if place := re.match(r"(/\S+): (.*)", line):
        return ErrorEntry(place[1], 0, 0, worded(place[2]))
    return ErrorEntry("", 0, 0, worded(line))


def _table(path: Path) -> pandas.DataFrame:
    import pandas

    if not path.is_file():
        raise RunError("the study was interrupted: there is no table")
    table = pandas.read_csv(path, index_col="run", dtype=str, keep_default_na=False)
    table.index = table.index.astype(int)
    for name in table.columns:
        if name not in ("status", "message"):
            table[name] = _numbers(list(table[name]))
    return table


def _numbers(texts: list[str]) -> list[Any]:
    """A column as numbers if it contains only numbers; every number reads back to the same bits."""
    for kind in (int, float):
        try:
            return [kind(text) if text else math.nan for text in texts]
        except ValueError:
            pass
    return list(texts)
