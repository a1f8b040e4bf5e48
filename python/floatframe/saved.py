"""Results without their run: read from the files that `Result.save` and `floatframe run` write, or unpickled."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from . import _core
from .arrays import Array
from .errors import InputError, OutputError

if TYPE_CHECKING:
    from .model import Model

_COLUMN = re.compile(r"(.*?)(?: \[(.*)\])?$", re.S)


@dataclass
class SavedRun:
    """The content of the files of a run; it has what the C++ library has of a run that was just made."""

    results_csv: str
    summary_json: str
    states: bytes | None
    """states.ffr; None: no states were recorded."""
    state: _core.State | None
    page: str | None
    """report.html; None: there is none."""
    file: str
    """What it was read from, for messages."""

    def __post_init__(self) -> None:
        self._table: Array | None = None

    def __getstate__(self) -> dict[str, object]:
        return {**self.__dict__, "_table": None}

    @property
    def columns(self) -> list[tuple[str, str]]:
        head = self.results_csv.partition("\n")[0].removesuffix("\r")
        found = (_COLUMN.match(column) for column in _cells(head))
        return [(match[1], match[2] or "") for match in found if match]

    @property
    def table(self) -> Array:
        if self._table is None:
            rows = self.results_csv.partition("\n")[2].split()
            try:
                values = [[float(cell) for cell in row.split(",")] for row in rows]
                self._table = np.array(values, dtype=np.float64).reshape(len(rows), len(self.columns))
            except ValueError as error:
                raise InputError(f"{self.file}: found a table that is not one of results: {error}") from None
        return self._table

    def save(self, model: object, folder: str, file: str) -> None:
        """Writes the files again."""
        if Path(folder, "run.checkpoint").exists():
            raise InputError(f"the folder '{folder}' holds an unfinished run (run.checkpoint), expected another one")
        try:
            os.makedirs(folder, exist_ok=True)
            for name, content in (("results.csv", self.results_csv), ("summary.json", self.summary_json), ("report.html", self.page)):
                if content is not None:
                    Path(folder, name).write_text(content, encoding="utf-8", newline="")
            if self.states is not None:
                Path(folder, "states.ffr").write_bytes(self.states)
        except OSError as error:
            raise OutputError(f"the run cannot be written: {error}") from None


def _cells(line: str) -> list[str]:
    """The cells of a line of CSV; a quote within quotes is doubled."""
    cells = re.findall(r'(?:^|,)(?:"((?:[^"]|"")*)"|([^,]*))', line)
    return [quoted.replace('""', '"') if quoted else bare for quoted, bare in cells]


def read_run(folder: str) -> SavedRun:
    """The files of a run in a folder."""
    if not os.path.isdir(folder):
        raise InputError(f"{folder}: found no folder, expected that of a run")

    def text(name: str, required: bool) -> str | None:
        path = Path(folder, name)
        if not required and not path.exists():
            return None
        try:
            with path.open(encoding="utf-8", newline="") as file:
                return file.read()
        except FileNotFoundError:
            raise InputError(f"{path}: the file does not exist, expected those of a run: results.csv and summary.json") from None
        except (OSError, UnicodeDecodeError) as error:
            raise InputError(f"{path}: the file cannot be read: {error}") from None

    states = Path(folder, "states.ffr")
    content = states.read_bytes() if states.exists() else None
    csv, summary = text("results.csv", True) or "", text("summary.json", True) or ""
    return SavedRun(csv, summary, content, None, text("report.html", False), folder)


@dataclass(frozen=True)
class ModelOfRun:
    """Finds the model of a run from what its states say."""

    folder: str
    states: bytes | None

    def __call__(self) -> Model:
        from .model import Model

        if self.states is None:
            raise InputError(f"{self.folder}: found no states, which say what the model of the run is, expected model=")
        file, from_here, settings = _core.states_origin(self.states, os.path.join(self.folder, "states.ffr"))
        beside = os.path.normpath(os.path.join(self.folder, from_here)) if from_here else ""
        path = beside if beside and os.path.exists(beside) else file
        if not path or not os.path.exists(path):
            raise InputError(f"{self.folder}: the model file '{file}' of the run does not exist any more, expected model=")
        return Model.load(path, **dict(setting.split("=", 1) for setting in settings))
