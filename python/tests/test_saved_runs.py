"""Saved runs are those of `floatframe run --out`, and its commands go on from there."""

import json
import subprocess

import floatframe as ff
import numpy as np
import pytest
from test_model import pendulum


def command(*words):
    return subprocess.run([ff.program(), *map(str, words)], capture_output=True, text=True)


def header(path):
    """The JSON at the beginning of a result file."""
    text = path.read_bytes()
    start = text.index(b'{\n "format"')  # lengths and checksums before it may hold any byte
    return json.JSONDecoder().raw_decode(text[start:].decode("latin-1"))[0]


def without_times(summary):
    return {k: without_times(v) if isinstance(v, dict) else v for k, v in summary.items() if not any(t in k for t in ("cpu", "wall", "real_time", "step_times"))}


@pytest.mark.parametrize("name, values", [("slider_crank", {}), ("iltis", {"speed": 4})])
def test_files_of_a_loaded_model(tmp_path, name, values):
    path = ff.example(name)
    sets = [word for k, v in values.items() for word in ("--set", f"{k}={v}")]
    assert command("run", path, "--duration", "0.1", "--quiet", "--out", tmp_path / "a", *sets).returncode == 0
    ff.run(ff.Model.load(path, **values), duration=0.1).save(tmp_path / "b")
    a, b = (json.loads((tmp_path / k / "summary.json").read_text()) for k in "ab")
    assert without_times(a) == without_times(b) and b["files"]
    assert header(tmp_path / "a/states.ffr") == header(tmp_path / "b/states.ffr")  # rows hold the time of each step
    origin = header(tmp_path / "b/states.ffr")["origin"]
    assert origin["files"] and origin["text"] and origin["file_from_here"]


def test_commands_go_on_from_a_model_that_was_made_in_python(tmp_path):
    res = ff.run(pendulum())
    res.save(tmp_path / "out")
    said = command("outputs", tmp_path / "out", "--add", "hinge.z: {position: {body: lever, at: hinge}, axis: z}")
    assert said.returncode == 0, said.stderr
    said = command("export", tmp_path / "out", "--vtk", tmp_path / "vtk")
    assert said.returncode == 0, said.stderr
    again = ff.run(ff.Model.load(tmp_path / "out/model.yaml"))
    assert np.array_equal(again.table, res.table)


def test_parameters_of_a_text_are_kept(tmp_path):
    model = ff.Model.from_dict({"parameters": {"m": 1}, **pendulum().data, "bodies": {
        "lever": {"rigid": {"mass": "${m}", "centre_of_mass": [0.3, 0, 0], "inertia": [0, 0.06, 0.06]}}}}, m=5)
    ff.run(model).save(tmp_path)
    assert json.loads((tmp_path / "summary.json").read_text())["settings"] == {"m": "5"}
    assert command("export", tmp_path, "--vtk", tmp_path / "vtk").returncode == 0


def test_arrays_of_analyses_cannot_be_written_to():
    model = pendulum()
    linear, system, statics, space = ff.linearize(model), ff.linear_system(model), ff.statics(model), None
    mode = ff.modes(model, start="equilibrium")[0]
    drawn = ff.linear_model(ff.Model.load(ff.example("active_damper")), "front_left", "chassis.az")
    space = drawn.state_space()
    arrays = [linear.M, linear.C, linear.K, linear.J, linear.r, system.A, system.x_of, mode.z, statics.joints[0].force, statics.bodies[0].position,
              space.A, space.B, space.C, space.D, drawn.input_values, ff.mass_properties(model).inertia, ff.mass_properties(model).centre]
    for array in arrays:
        assert not array.flags.writeable
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0.0
        with pytest.raises(ValueError):
            array.flags.writeable = True
    assert linear.M.shape == (1, 1) and linear.J.shape == (0, 1) and mode.z.shape == (2,) and mode.z.dtype == complex
    assert linear.M[0, 0] == pytest.approx(0.06 + 2 * 0.3**2)
    assert np.shares_memory(linear.M, linear.M)
    A = space.A
    reference = np.array(A)
    del space, drawn, linear
    assert np.array_equal(A, reference) and np.allclose(np.linalg.eigvals(A).real.max(), np.linalg.eigvals(reference).real.max())
