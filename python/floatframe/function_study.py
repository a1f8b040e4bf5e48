"""Studies of runs with functions of Python, which other processes do not have: one run after the other in this one."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import Error, InputError, UnknownNameError
from .model import Model
from .options import Options
from .progress import Bar
from .run import Controller, Result, run

if TYPE_CHECKING:
    import pandas

STATISTICS = ("final", "min", "time of min", "max", "time of max", "rms")


def rows_of_runs(
    model: Model,
    rows: Sequence[Mapping[str, Any]],
    options: Mapping[str, Any],
    on_step: Controller | None,
    period: float | None,
    measure: Sequence[str],
    progress: bool | Callable[[float], object],
) -> tuple[pandas.DataFrame, dict[int, Result]]:
    """The table of `sweep`, with values, status, message, time reached and figures of outputs, and the results by run."""
    import pandas

    found, lines = {}, []
    with Bar(progress) as bar:
        for k, row in enumerate(rows, start=1):
            line: dict[str, Any] = dict(row)
            try:
                result = _one(model, row, options, on_step, period)
            except InputError:
                raise
            except Error as error:
                line.update({"status": "failed", "message": str(error)})
            else:
                found[k] = result
                line.update({"status": result.summary["status"], "message": result.summary.get("message", "") or ""})
                line["time reached [s]"] = float(result.time[-1])
                line.update(_figures(result, measure))
            lines.append(line)
            if bar.show is not None:
                bar.show(k / len(rows))
    return pandas.DataFrame(lines, index=pandas.RangeIndex(1, len(rows) + 1, name="run")), found


def _one(model: Model, row: Mapping[str, Any], options: Mapping[str, Any], on_step: Controller | None, period: float | None) -> Result:
    given = dict(options)
    parameters: dict[str, Any] = {}
    names = {"duration", *Options.__annotations__}
    for name, value in row.items():
        option = name.removeprefix("simulation.")
        if option in names and (name != option or option not in model.data.get("parameters", {})):
            given[option] = value
        else:
            parameters[name] = value
    return run(model.with_parameters(**parameters), on_step=on_step, period=period, **given)


def _figures(result: Result, measure: Sequence[str]) -> dict[str, float]:
    """`final`, `min`, ... of the outputs, as in the table of `floatframe sweep`."""
    wanted = [(name, "") for name in list(result)[1:]]
    if measure:
        wanted = [(name, statistic.replace("_", " ")) for name, _, statistic in (figure.partition(":") for figure in measure)]
    figures = {}
    for name, statistic in wanted:
        if name not in result or name == "time" or (statistic and statistic not in STATISTICS):
            raise UnknownNameError(f"measure: found '{name}:{statistic}', expected an output of the model and one of {', '.join(STATISTICS)}")
        x, t = result[name], result.time
        span = float(t[-1] - t[0])
        square = float(np.sum(0.5 * (x[1:] ** 2 + x[:-1] ** 2) * np.diff(t)))
        values = {"final": x[-1], "min": x.min(), "time of min": t[x.argmin()], "max": x.max(), "time of max": t[x.argmax()],
                  "rms": np.sqrt(square / span) if span > 0.0 else abs(x[-1])}
        for label, value in values.items():
            if statistic in ("", label):
                unit = "s" if label.startswith("time") else result.units[name]
                figures[f"{name} {label} [{unit}]" if unit else f"{name} {label}"] = float(value)
    return figures
