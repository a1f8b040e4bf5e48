"""Results live: vectors, pickling, loading, tables of other programs, pictures."""

import json
import pickle
import time

import floatframe as ff
import numpy as np
import pytest


@pytest.fixture(scope="module")
def result():
    return ff.run(ff.Model.load(ff.example("iltis"), speed=8), duration=0.1)


def same(a, b):
    assert np.array_equal(a.table, b.table) and a.units == b.units and a.name == b.name
    saved = {"files", "settings"}  # what a summary has only in its file
    assert all(a.summary[key] == b.summary[key] for key in (a.summary.keys() | b.summary.keys()) - saved)
    assert list(a) == list(b)


def test_vectors_by_name(result):
    chassis = result["chassis"]
    assert chassis.shape == (len(result.time), 3) and "chassis" in result and "chassis" not in list(result)
    for k, axis in enumerate("xyz"):
        assert np.array_equal(chassis[:, k], result[f"chassis.{axis}"])
    assert np.shares_memory(chassis, result.table)
    with pytest.raises(KeyError, match="found no output 'chassi'"):
        result["chassi"]
    assert {"time", "chassis.z", "chassis"} <= set(result._ipython_key_completions_())


def test_components_that_stand_apart(result):
    from floatframe.result_files import columns_of, vector_names
    names = {"time": 0, "a.z": 1, "b.x": 2, "a.x": 3, "a.y": 4, "c.x": 5, "c": 6, "d.roll": 7, "d.pitch": 8, "d.yaw": 9}
    assert vector_names(names) == {"a": [3, 4, 1], "d": [7, 8, 9]}
    table = np.arange(20.0).reshape(2, 10)
    assert np.array_equal(columns_of(table, [3, 4, 1]), table[:, [3, 4, 1]])


def test_results_are_pickled(result):
    again = pickle.loads(pickle.dumps(result))
    same(again, result)
    same(pickle.loads(pickle.dumps(again)), result)
    assert pickle.dumps(again.state) == pickle.dumps(result.state)
    with pytest.raises(ff.OutputError, match="unpickled"):
        again.view()


def test_results_are_loaded(result, tmp_path):
    loaded = ff.Result.load(result.save(tmp_path / "run"))
    same(loaded, result)
    assert loaded.model.parameters == {"speed": "8"} and loaded.view().html == result.view().html
    copied = ff.Result.load(loaded.save(tmp_path / "copy"))
    same(copied, result)
    for name in ("results.csv", "states.ffr", "report.html", "summary.json"):
        assert (tmp_path / "copy" / name).read_bytes() == (tmp_path / "run" / name).read_bytes()


def test_pictures_of_restored_results_are_those_of_the_run(result, tmp_path):
    pytest.importorskip("pyvista")
    loaded = ff.Result.load(result.save(tmp_path / "run"))
    for other in (loaded, pickle.loads(pickle.dumps(result))):
        for instant in (None, 0.043):
            a, b = result.to_pyvista(instant), other.to_pyvista(instant)
            assert np.array_equal(a.points, b.points) and np.array_equal(a.cells, b.cells)
            assert all(np.array_equal(a.point_data[k], b.point_data[k], equal_nan=True) for k in a.point_data)


def test_pictures_are_those_of_the_command(result, tmp_path):
    import subprocess
    pyvista = pytest.importorskip("pyvista")
    result.save(tmp_path / "run")
    subprocess.run([ff.program(), "export", tmp_path / "run", "--vtk", tmp_path / "vtk"], check=True, capture_output=True)
    files = sorted((tmp_path / "vtk").glob("*.vtu"))
    for k in (0, 3, len(files) - 1):
        written, made = pyvista.UnstructuredGrid(files[k]), result.to_pyvista(result.time[k])
        assert np.array_equal(written.points, made.points) and np.array_equal(written.cells, made.cells)
        assert np.array_equal(written.celltypes, made.celltypes) and set(written.point_data) == set(made.point_data)
        for name in written.point_data:
            assert np.array_equal(written.point_data[name], made.point_data[name], equal_nan=True)
        for name in written.cell_data:
            assert np.array_equal(written.cell_data[name], made.cell_data[name])
        assert list(written.field_data["body_names"]) == list(made.field_data["body_names"])


def test_a_picture_comes_from_the_library(result, monkeypatch):
    pytest.importorskip("pyvista")
    import subprocess
    monkeypatch.setattr(subprocess, "run", None)  # no other program is started
    first = result.to_pyvista(0.0)
    started = time.process_time()
    frames = [result.to_pyvista(instant) for instant in result.time]
    seconds = (time.process_time() - started) / len(frames)
    assert first.n_points > 1000 and seconds < 0.1  # an order above what it takes


def test_what_a_notebook_shows(result):
    shown = result._repr_html_()
    assert "iltis" in shown and "completed" in shown and shown.count("<tr>") == len(result)
    assert f"{result['chassis.z'].max():.6g}" in shown and "<script" not in shown


def test_matlab(result, tmp_path):
    io = pytest.importorskip("scipy.io")
    content = io.loadmat(result.to_mat(tmp_path / "run.mat"), simplify_cells=True)
    assert np.array_equal(content["table"], result.table) and list(content["names"]) == list(result)
    assert list(content["units"]) == list(result.units.values()) and json.loads(content["summary"]) == result.summary


def test_hdf5(result, tmp_path):
    h5py = pytest.importorskip("h5py")
    with h5py.File(result.to_hdf5(tmp_path / "run.h5")) as content:
        assert set(content) == set(result) and content.attrs["model"] == "iltis"
        for name in result:
            assert np.array_equal(content[name][:], result[name]) and content[name].attrs["unit"] == result.units[name]
        assert json.loads(content.attrs["summary"]) == result.summary


def test_parquet(result, tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet")
    table = parquet.read_table(result.to_parquet(tmp_path / "run.parquet"))
    assert table.column_names == list(result)
    for name in result:
        assert np.array_equal(table[name].to_numpy(), result[name])
        assert table.schema.field(name).metadata[b"unit"].decode() == result.units[name]


@pytest.mark.parametrize("method, package", [("to_mat", "scipy"), ("to_hdf5", "h5py"), ("to_parquet", "pyarrow"), ("to_pyvista", "pyvista")])
def test_what_is_not_installed_is_named(result, tmp_path, monkeypatch, method, package):
    import sys
    for name in [package, *(name for name in sys.modules if name.startswith(f"{package}."))]:
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(ImportError, match=f"{method} needs {package}"):
        getattr(result, method)(*([] if method == "to_pyvista" else [tmp_path / "x"]))
    assert not list(tmp_path.iterdir())
