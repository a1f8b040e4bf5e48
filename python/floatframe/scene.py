"""Results as meshes of pyvista, by the engine of `floatframe export`."""

from __future__ import annotations

import os
import subprocess
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .arrays import number
from .build import program
from .errors import ErrorEntry, InputError

if TYPE_CHECKING:
    import pyvista

    from .model import Model
    from .run import Result


def scene(result: Result, model: Model, time: float | None) -> pyvista.UnstructuredGrid:
    """All bodies of a run at the recorded instant nearest to `time` [s]; None: the last."""
    import pyvista

    instants = result.time
    wanted = instants[-1] if time is None else number("time", time)
    instant = float(instants[np.argmin(np.abs(instants - wanted))])
    with tempfile.TemporaryDirectory() as folder:
        run = result.save(os.path.join(folder, "run"))
        margin = 1e-9 * max(1.0, abs(instant))
        arguments = [program(), "export", run, "--vtk", os.path.join(folder, "vtk")]
        arguments += ["--from", repr(instant - margin), "--to", repr(instant + margin)]
        if model.filled_in or model.file.endswith("<model>"):
            arguments += ["--model", _beside(model, folder)]
        done = subprocess.run(arguments, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            lines = [line.removeprefix("floatframe: ") for line in done.stderr.strip().splitlines()]
            raise InputError([ErrorEntry("", 0, 0, line) for line in lines or ["the run cannot be shown"]])
        (file,) = Path(folder, "vtk").glob("**/*.vtu")
        return pyvista.UnstructuredGrid(str(file))


def _beside(model: Model, folder: str) -> str:
    """Writes a model file for a model without one."""
    path = Path(folder, "model.yaml")
    path.write_text(model.to_yaml(), encoding="utf-8")
    return str(path)
