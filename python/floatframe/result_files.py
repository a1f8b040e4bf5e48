"""Results as pictures, tables of other programs and bytes; what notebooks show of them."""

from __future__ import annotations

import html
import importlib
import json
import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from .arrays import Array, path
from .errors import OutputError
from .saved import SavedRun
from .scene import RunScene

if TYPE_CHECKING:
    import pyvista

    from .run import Result

_VECTORS = (("x", "y", "z"), ("roll", "pitch", "yaw"))
_ROWS = 40


def vector_names(columns: Mapping[str, int]) -> dict[str, list[int]]:
    """Columns of outputs with three components, by the name of the output: "chassis" for chassis.x, chassis.y, chassis.z."""
    out: dict[str, list[int]] = {}
    for components in _VECTORS:
        for name in columns:
            stem, dot, last = name.rpartition(".")
            if dot and last == components[0] and stem not in columns and stem not in out:
                found = [columns[f"{stem}.{c}"] for c in components if f"{stem}.{c}" in columns]
                if len(found) == len(components):
                    out[stem] = found
    return out


def columns_of(table: Array, places: list[int]) -> Array:
    """Columns of a table, shape (samples, columns): a view if they stand side by side."""
    first = places[0]
    if places == list(range(first, first + len(places))):
        return table[:, first : first + len(places)]
    return table[:, places]


def module(name: str, what: str) -> Any:
    """A module that only one method needs; ImportError says which."""
    try:
        return importlib.import_module(name)
    except ImportError as error:
        package = name.partition(".")[0]
        raise ImportError(f"{what} needs {package}, which cannot be imported ({error}): pip install {package}", name=name) from None


def scene_of(result: Result) -> RunScene:
    """What draws the bodies of a run."""
    model = result.model
    return RunScene(_core.Scene(model.core, states_of(result), f"the run of '{result.name}'"))


def states_of(result: Result) -> bytes:
    """Content of states.ffr; empty: none were recorded."""
    core = result._core
    if isinstance(core, SavedRun):
        return core.states or b""
    model = result.model
    return _core.states_of_run(model.core, core, model.file)


def saved_run(result: Result) -> SavedRun:
    """The content of its files, without the page, for pickling."""
    core = result._core
    if isinstance(core, SavedRun):
        return core
    return SavedRun(core.results_csv, core.summary_json, states_of(result) or None, core.state, None, f"the run of '{result.name}'")


def to_mat(result: Result, file: object) -> str:
    io = module("scipy.io", "to_mat")
    where = path("file", file)
    names = list(result)
    content = {
        "table": np.asarray(result.table),
        "names": np.array(names, dtype=object),
        "units": np.array([result.units[name] for name in names], dtype=object),
        "model": result.name,
        "summary": json.dumps(result.summary),
    }
    with _writing(where):
        io.savemat(where, content, oned_as="column", do_compression=True)
    return where


def to_hdf5(result: Result, file: object) -> str:
    h5py = module("h5py", "to_hdf5")
    where = path("file", file)
    with _writing(where), h5py.File(where, "w") as out:
        out.attrs["model"] = result.name
        out.attrs["summary"] = json.dumps(result.summary)
        for name in result:
            data = out.create_dataset(name.replace("/", "_"), data=result[name])
            data.attrs["unit"] = result.units[name]
            if name != "time":
                data.dims[0].label = "time"
    return where


def to_parquet(result: Result, file: object) -> str:
    pyarrow, parquet = module("pyarrow", "to_parquet"), module("pyarrow.parquet", "to_parquet")
    where = path("file", file)
    fields = [pyarrow.field(name, pyarrow.float64(), metadata={"unit": result.units[name]}) for name in result]
    schema = pyarrow.schema(fields, metadata={"model": result.name, "summary": json.dumps(result.summary)})
    columns = [pyarrow.array(np.ascontiguousarray(result[name])) for name in result]
    with _writing(where):
        parquet.write_table(pyarrow.Table.from_arrays(columns, schema=schema), where)
    return where


class _writing:
    """OutputError for what other libraries raise while they write a file."""

    def __init__(self, file: str) -> None:
        self._file = file

    def __enter__(self) -> None:
        folder = os.path.dirname(os.path.abspath(self._file))
        if not os.path.isdir(folder):
            raise OutputError(f"{self._file}: the folder does not exist")

    def __exit__(self, kind: object, error: object, trace: object) -> None:
        if isinstance(error, OSError):
            raise OutputError(f"{self._file}: the file cannot be written: {error}") from None


def as_html(result: Result) -> str:
    """The table that a notebook shows."""
    s = result.summary
    facts = [f"{len(result.table)} samples"]
    if len(result.table):
        facts.append(f"{result.time[0]:g} to {result.time[-1]:g} s")
    if s.get("steps") is not None:
        facts.append(f"{s['steps']} steps of {s.get('step_s', 0):g} s in {s.get('cpu_s', 0):.3g} s")
    lines = [f"<p><b>{html.escape(result.name)}</b>: {html.escape(str(s.get('status', '')))}; {', '.join(facts)}</p>"]
    warnings = s.get("warnings") or []
    lines += [f"<p>&#9888; {html.escape(str(w))}</p>" for w in warnings]
    names = [name for name in result if name != "time"]
    lines.append("<table><tr><th>output</th><th>unit</th><th>first</th><th>least</th><th>largest</th><th>last</th></tr>")
    for name in names[:_ROWS]:
        x = result[name]
        values = [x[0], x.min(), x.max(), x[-1]] if len(x) else []
        cells = "".join(f"<td>{value:.6g}</td>" for value in values)
        lines.append(f"<tr><td>{html.escape(name)}</td><td>{html.escape(result.units[name])}</td>{cells}</tr>")
    lines.append("</table>")
    if len(names) > _ROWS:
        lines.append(f"<p>and {len(names) - _ROWS} more</p>")
    return "\n".join(lines)
