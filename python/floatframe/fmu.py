"""Models as FMUs, for co-simulation in other programs (docs/fmu.md)."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from . import _core
from .arrays import path as path_of
from .errors import InputError
from .model import Model, built


@dataclass(frozen=True)
class FmuReport:
    """What was written by `export_fmu`."""

    file: str
    bytes: int
    """Size of the file."""
    inputs: int
    outputs: int
    parameters: int
    """Numbers of variables; parameters are those that take a new value without a build of the model."""
    platforms: tuple[str, ...]
    """"linux64", "win64"."""
    notes: tuple[str, ...]
    """Names that had to change, platforms that are missing, parameters that cannot change and why."""


def export_fmu(model: Model, file: str | os.PathLike[str], *, fmi: Literal[2, 3] = 2, outputs: Sequence[str] = ()) -> FmuReport:
    """Writes a model, with the parameter values it was loaded with, as an FMU for co-simulation of FMI 2.0 or 3.0.
    outputs: names of those to show, "chassis" for all of "chassis.x", ...; none: all. A packed model is taken as it is, without
    other values and without outputs. Raises InputError, OutputError.

    >>> ff.export_fmu(ff.Model.load("vehicle.yaml", speed=20), "vehicle.fmu", fmi=3)
    """
    built(model)
    if isinstance(outputs, str):
        raise InputError(f"outputs: found the text {outputs!r}, expected a list of names")
    where = path_of("file", file)
    with tempfile.TemporaryDirectory() as folder:
        # One that was made or changed in Python, under the name of the model.
        source = model.save(os.path.join(folder, "model.yaml")) if model.file.endswith("<model>") else model.file
        found = _core.write_fmu(source, list(model.parameters.items()), list(outputs), fmi, where)
    size, count_in, count_out, parameters, platforms, notes = found
    return FmuReport(where, size, count_in, count_out, parameters, tuple(platforms), tuple(notes))
