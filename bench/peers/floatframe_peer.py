"""Floatframe: model files, run by the command line. Times are those of its own summary: processor time of all steps."""
import json
import pathlib
import subprocess

import numpy as np


class Chain:
    """A model file in `folder`; runs of it."""

    def __init__(self, program, folder, name, text):
        self.program, self.file, self.out = program, pathlib.Path(folder) / f"{name}.yaml", pathlib.Path(folder) / name
        self.file.write_text(text)

    def run(self, record=None, step=1e-3, duration=1.0, tolerance=1e-9):
        """Processor seconds, and with `record` [s] the outputs (time, ...) at that period."""
        done = subprocess.run([str(self.program), "run", str(self.file), "--out", str(self.out), "--quiet", "--no-report",
                               "--record", "none", "--set", f"step={step!r}", "--set", f"duration={duration!r}",
                               "--set", f"tolerance={tolerance!r}"], capture_output=True, text=True, check=False)
        if done.returncode:
            raise RuntimeError(f"{self.file.name}: {done.stderr.strip()}")
        seconds = json.loads((self.out / "summary.json").read_text())["cpu_s"]
        if record is None:
            return seconds, None
        rows = np.loadtxt(self.out / "results.csv", delimiter=",", skiprows=1)
        return seconds, rows[::round(record / step)]


def build(program):
    """First line of `floatframe --version`, and the name of the processor."""
    text = subprocess.run([str(program), "--version"], capture_output=True, text=True, check=True).stdout
    return text.strip().splitlines()[0]
