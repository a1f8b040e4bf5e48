"""Studies: the table of `floatframe sweep`."""

import subprocess
import sys

import floatframe as ff
import numpy as np
import pytest
from cart import soft_beam


def test_the_table_is_that_of_the_command_line(tmp_path):
    path = ff.example("active_damper")
    subprocess.run([ff.program(), "sweep", path, "--vary", "simulation.step=0.001,0.002", "--duration", "0.2", "--quiet", "--out", tmp_path / "a",
                    "--measure", "chassis.az:max"], check=True)
    table = ff.sweep(ff.Model.load(path), vary={"simulation.step": [0.001, np.float64(0.002)]}, duration=0.2, processes=2, folder=tmp_path / "b",
                     measure=["chassis.az:max"])
    header, *rows = (line.split(",") for line in (tmp_path / "a/sweep.csv").read_text().splitlines())
    assert ["run", *table.columns] == header
    for row, expected in zip(table.itertuples(), rows):
        assert [float(x) for x in (*row[:2], *row[5:])] == [float(x) for x in (*expected[:2], *expected[5:])]  # every bit
    assert (tmp_path / "a/sweep.csv").read_bytes() == (tmp_path / "b/sweep.csv").read_bytes()
    run = ff.run(ff.Model.load(path), step=0.002, duration=0.2)
    assert table["chassis.az max [m/s2]"][2] == run["chassis.az"].max()


def model():
    m = ff.Model.from_dict({
        "parameters": {"m": 1, "word": "a, \"b\""}, "points": {"hinge": [0, 0, 0], "end": [1, 0, 0]},
        "bodies": {"arm": {"rigid": {"mass": "${m}", "centre_of_mass": [0.5, 0, 0], "inertia": [0, 0.1, 0.1]}}},
        "joints": {"hinge": {"type": "revolute", "parent": "ground", "child": "arm", "at": "hinge", "axis": "y"}},
        "outputs": {"end.z": {"position": {"body": "arm", "at": "end"}, "axis": "z"}},
        "simulation": {"step": 1e-3, "duration": 0.1}})
    return m


def test_a_model_that_was_filled_in():
    table = ff.sweep(model(), m=[1, 2], vary={"simulation.duration": [0.1, 0.2]}, processes=2)
    assert list(table["m"]) == [1, 2, 1, 2] and list(table["simulation.duration"]) == [0.1, 0.1, 0.2, 0.2]
    assert list(table["status"]) == ["completed"] * 4 and list(table["message"]) == [""] * 4


def test_errors_of_values():
    with pytest.raises(ff.InputError, match="mass: found .* = -1, expected a number >= 0") as caught:
        ff.sweep(model(), m=[1, -1])
    assert caught.value.errors[0].line > 0


def test_runs_one_by_one():
    table = ff.sweep(model(), runs=[{"m": 1, "simulation.step": 1e-3}, {"m": 3, "simulation.step": 2e-3}], measure="end.z")
    assert list(table["m"]) == [1, 3] and table.filter(like="end.z").shape[1] == 6


@pytest.mark.parametrize("options", [{}, {"m": []}, {"m": 3}, {"m": "abc"}, {"nowhere": [1]}, {"m": [object()]}, {"m": ["a\nb"]}, {"m": [1], "runs": []},
                                     {"runs": []}, {"runs": [{}]}, {"runs": [{"m": 1}, {"k": 2}]}, {"m": [1], "measure": ["x:y"]},
                                     {"m": [1], "processes": -1}, {"m": [1], "processes": "x"}, {"m": [1], "step": -1}])
def test_what_is_not_valid(options):
    with pytest.raises(ff.InputError, match="found|expected|nowhere"):
        ff.sweep(model(), **options)


def test_without_pandas_nothing_is_run(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match="pandas"):
        ff.sweep(ff.Model.load(ff.example("quarter_car"), duration=0.1), speed=[10], folder=tmp_path / "study")
    assert not (tmp_path / "study").exists()


def test_a_model_of_texts_and_data_finds_its_files(tmp_path):
    (tmp_path / "models/parts").mkdir(parents=True)
    description = model().data
    part = tmp_path / "models/parts/arm.ffb"
    from blocks import ENDS, QUICK, mesh
    ff.reduce(mesh(), **QUICK, interfaces=ENDS).save(part)
    description["bodies"]["rod"] = {"flexible": "../models/parts/arm.ffb"}
    description["joints"]["rod"] = {"type": "free", "parent": "ground", "child": "rod", "at": "rod"}
    description["points"]["rod"] = [0, 0.05, 0.05]
    for made in (ff.Model.from_dict(description, folder=tmp_path / "models"), ff.Model.from_yaml(ff.Model.from_dict(description, folder=tmp_path / "models").to_yaml(), folder=str(tmp_path / "models"))):
        for folder in (None, tmp_path / f"study{made.filled_in}"):
            table = ff.sweep(made, m=[1, 2], duration=0.01, measure="end.z:final", folder=folder)
            assert list(table["status"]) == ["completed"] * 2
            run = ff.run(made.copy(), duration=0.01)
            assert table["end.z final [m]"][1] == run["end.z"][-1]


def test_whole_numbers_are_written_alike(tmp_path):
    path = ff.example("iltis")
    tables = []
    for k, speeds in enumerate((np.linspace(3, 5, 3), [3, 4, 5], [3.0, "4", np.float32(5)])):
        ff.sweep(ff.Model.load(path), speed=speeds, duration=0.02, folder=tmp_path / str(k))
        tables.append((tmp_path / str(k) / "sweep.csv").read_bytes())
    subprocess.run([ff.program(), "sweep", path, "--vary", "speed=3:5:3", "--duration", "0.02", "--quiet", "--out", tmp_path / "c"], check=True)
    assert {*tables} == {(tmp_path / "c/sweep.csv").read_bytes()}


def test_any_value_varies_by_its_path():
    path = "bodies.arm.rigid.centre_of_mass.0"
    table = ff.sweep(model(), vary={path: [0.4, 0.5]}, m=[1, 2], measure=["end.z:min"])
    assert list(table[path]) == [0.4, 0.4, 0.5, 0.5] and list(table["m"]) == [1, 2, 1, 2]
    expected = []
    for place in (0.4, 0.5):
        changed = model()
        changed.bodies["arm"]["rigid"]["centre_of_mass"][0] = place
        expected += [ff.run(changed)["end.z"].min()] * 2
    assert table["end.z min [m]"][1] == expected[0] and table["end.z min [m]"][3] == expected[2]
    with pytest.raises(ff.InputError, match="bodies.nobody"):
        ff.sweep(model(), vary={"bodies.nobody.rigid.mass": [1.0]})


def test_series_and_progress():
    seen = []
    table = ff.sweep(model(), m=[1, 2], series=True, progress=seen.append)
    series = table.attrs["series"]
    assert sorted(series) == [1, 2] and seen[-1] == 1.0
    assert np.array_equal(series[1]["end.z"], ff.run(model())["end.z"])


def driven():
    m = model()
    m.inputs.add("T")
    m.forces.add("motor", type="torque", body="arm", direction="y", magnitude={"input": "T"})
    return m


def test_functions_in_studies():
    table = ff.sweep(driven(), m=[1, 2], vary={"simulation.duration": [0.05, 0.1]}, on_step=lambda time, outputs, inputs: {"T": 3.0}, series=True)
    plain = ff.sweep(driven(), m=[1, 2], vary={"simulation.duration": [0.05, 0.1]})
    assert list(table["m"]) == list(plain["m"]) and set(table["status"]) == {"completed"}
    figures = [name for name in plain.columns if name.startswith("end.z ")]
    assert figures and set(figures) <= set(table.columns)
    assert not np.allclose(table["end.z final [m]"], plain["end.z final [m]"], atol=1e-6)
    still = ff.sweep(driven(), m=[1, 2], vary={"simulation.duration": [0.05, 0.1]}, on_step=lambda *_: None)
    for name in figures:
        np.testing.assert_allclose(still[name], plain[name], rtol=1e-12, atol=1e-15)
    assert len(table.attrs["series"][4]) == 101


def test_studies_tell_what_left_the_range():
    with pytest.warns(ff.RunWarning, match="left the range"):
        ff.sweep(soft_beam(), vary={"simulation.step": [1e-3, 2e-3]})
