"""Parameter studies, by the engine of `floatframe sweep`."""

from __future__ import annotations

import math
import os
import re
import signal
import subprocess
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .arrays import number, path, texts, whole
from .build import program
from .errors import ErrorEntry, InputError, OutputError, RunError, worded
from .model import Model, built, parameter_text

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
    progress: bool = False,
    vary: Mapping[str, Iterable[Any]] | None = None,
    **variations: Iterable[Any],
) -> pandas.DataFrame:
    """Runs a model with all combinations of values of parameters or simulation options; the last one named changes fastest.
    Returns a pandas table, one row per run: values, "status", and figures of outputs such as "tip.x max [m]".

    >>> ff.sweep(model, speed=np.linspace(3, 8, 11), processes=4)

    vary: the same as a map, for names that are not Python identifiers ("simulation.step"). runs: instead of all combinations,
    one map of values per run. measure: outputs in the table, "tip.x" or "tip.x:max"; none: all. processes: number of
    simultaneous runs, each in a separate process; None: the number of processors. folder: location of sweep.csv and its
    journal, from which an interrupted study continues; None: temporary. case_timeout [s]: longer runs are counted as failed. A
    run that fails or crashes is a row whose "status" and "message" give the reason. Raises InputError for invalid input.
    """
    import pandas  # noqa: F401  before hours of computing

    built(model)  # raises its errors
    if model.functions:
        raise InputError(f"forces.{next(iter(model.functions))}.law: found a function, which other processes do not have, expected a table; or call run in a loop")
    out_folder = None if folder is None else path("folder", folder)
    fixed = _options(processes, step, duration, coordinates, inertia, case_timeout)
    if vary is not None and not isinstance(vary, Mapping):
        raise InputError(f"vary: found {type(vary).__name__}, expected a map of names and values")
    with tempfile.TemporaryDirectory() as scratch:
        out = out_folder or os.path.join(scratch, "study")
        arguments = [program(), "sweep", *_model_file(model, out_folder or scratch), "--out", out, *fixed]
        arguments += _values({**(vary or {}), **variations}, runs, scratch)
        for name, text in model.parameters.items():
            arguments += ["--set", f"{name}={text}"]
        for figure in texts("measure", measure):
            arguments += ["--measure", figure]
        arguments += ["--fresh"] if fresh else []
        _run(arguments if progress else [*arguments, "--quiet"], progress)
        return _table(Path(out, "sweep.csv"))


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


def _values(vary: Mapping[str, Iterable[Any]], runs: Iterable[Mapping[str, Any]] | None, scratch: str) -> list[str]:
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


def _run(arguments: Sequence[str], progress: bool) -> None:
    errors = None if progress else subprocess.PIPE
    process = subprocess.Popen(arguments, stdout=subprocess.DEVNULL, stderr=errors, text=True, start_new_session=True)
    try:
        _, text = process.communicate()
    except BaseException:
        process.send_signal(signal.SIGINT)  # the command cancels its runs and keeps the journal
        process.wait()
        raise
    if process.returncode == 2:
        raise InputError([_entry(line) for line in (text or "the study was refused").strip().splitlines()])
    if process.returncode not in (0, 1):
        raise RunError(f"the study ended with exit code {process.returncode}: {(text or '').strip()}")


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
