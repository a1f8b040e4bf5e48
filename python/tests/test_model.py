"""Models filled in by programs: the same reader, the same sentences, the same bits."""

import copy
import pickle

import floatframe as ff
import numpy as np
import pytest


def pendulum():
    model = ff.Model("pendulum")
    model.points.add("hinge", [0, 0, 0])
    model.points.add("end", np.array([0.6, 0, 0]))
    model.bodies.add("lever", rigid={"mass": np.float64(2), "centre_of_mass": (0.3, 0, 0), "inertia": [1e-7, 0.06, 0.06]})
    model.joints.add("hinge", type="revolute", parent="ground", child="lever", at="hinge", axis="y")
    model.outputs.add("end.z", position={"body": "lever", "at": "end"}, axis="z")
    model.simulation.update(step=1e-3, duration=0.5)
    return model


def test_the_text_is_a_model_file(tmp_path):
    model = pendulum()
    (tmp_path / "pendulum.yaml").write_text(model.to_yaml())
    by_file = ff.run(ff.Model.load(tmp_path / "pendulum.yaml"))
    for other in (model, ff.Model.from_yaml(model.to_yaml()), ff.Model.from_dict(model.data), copy.deepcopy(model),
                  pickle.loads(pickle.dumps(model))):
        assert np.array_equal(ff.run(other).table, by_file.table) and other.to_yaml() == model.to_yaml()


def test_the_period_is_that_of_the_formula():
    model = pendulum()
    frequency = ff.modes(model, start="equilibrium")[0].frequency
    inertia = 0.06 + 2 * 0.3**2
    assert frequency == pytest.approx(np.sqrt(2 * 9.81 * 0.3 / inertia) / (2 * np.pi), rel=1e-9)


def test_a_change_is_seen_and_errors_have_the_lines_of_the_text():
    model = pendulum()
    before = ff.run(model)["end.z"]
    model.bodies["lever"]["rigid"]["mass"] = -1
    with pytest.raises(ff.InputError, match="bodies.lever.rigid.mass: found -1") as caught:
        ff.run(model)
    entry = caught.value.errors[0]
    assert "lever" in model.to_yaml().splitlines()[entry.line - 1] and entry.column > 0
    model.bodies["lever"]["rigid"]["mass"] = 3
    model.bodies["lever"]["rigid"]["centre_of_mass"] = [0.2, 0, 0]
    assert not np.array_equal(ff.run(model)["end.z"], before)


def test_parameters_of_texts():
    model = ff.Model.from_dict({"parameters": {"m": 1}, **pendulum().data, "bodies": {
        "lever": {"rigid": {"mass": "${m}", "centre_of_mass": [0.3, 0, 0], "inertia": [0, 0.06, 0.06]}}}}, m=5)
    assert ff.mass_properties(model).mass == 5.0


@pytest.mark.parametrize("text", ["yes", "10", "a: b", "# no", "{", "äöü", "", "'", '"', "- x", "true", "1e3", "y", "null"])
def test_texts_stay_texts(text):
    from floatframe.yaml import to_yaml
    data = pendulum().data
    data["outputs"] = {"end.z": {"position": {"body": text, "at": "end"}, "axis": "z"}}
    with pytest.raises(ff.InputError) as caught:
        ff.Model.from_yaml(to_yaml(data))
    assert any("body" in e.message for e in caught.value.errors)
    assert not any("syntax" in e.message for e in caught.value.errors)


def test_long_entities_are_blocks():
    model = pendulum()
    model.roads.add("hills", profile={"points": [[float(k), 0.125 * (k % 2)] for k in range(40)]})
    assert all(len(line) <= 1000 for line in model.to_yaml().splitlines())


class Endless(dict):
    pass


endless = Endless()
endless["a"] = endless


@pytest.mark.parametrize("data", [{"bodies": {1: 2}}, {"a": float("nan")}, {"a": float("inf")}, {"a": object()}, {"a": b"x"}, {"a": 1j}, 3,
                                  None, endless, {"bodies": "none"}, {"bodies": {"a": np.ones((2, 2, 2))}}, {"floatframe": 2}, {}, {"a\nb": 1},
                                  {"bodies": {"x": {"rigid": {"mass": 10**400}}}}, {"name": "\0"}, {"name": "\ud800"}])
def test_what_is_no_model(data):
    with pytest.raises((ff.InputError, UnicodeError)):
        ff.Model.from_dict(data)


def test_names_are_taken_once():
    model = pendulum()
    with pytest.raises(ff.InputError, match="bodies.lever: there is one"):
        model.bodies.add("lever", rigid={})
    with pytest.raises(ff.InputError, match="a value and keys"):
        model.bodies.add("x", 3, rigid={})
    assert list(model.joints) == ["hinge"] and len(model.outputs) == 1
    del model.outputs["end.z"]
    assert "end.z" not in model.to_yaml()


def test_saved_runs_are_those_of_the_command_line(tmp_path):
    import json
    import subprocess
    path = ff.example("slider_crank")
    subprocess.run([ff.program(), "run", path, "--quiet", "--out", tmp_path / "a"], check=True)
    res = ff.run(ff.Model.load(path))
    res.save(tmp_path / "b")
    files = [sorted(p.name for p in (tmp_path / k).iterdir() if p.name != "run.lock") for k in "ab"]
    assert files[0] == files[1]
    assert (tmp_path / "a/results.csv").read_bytes() == (tmp_path / "b/results.csv").read_bytes()
    a, b = (json.loads((tmp_path / k / "summary.json").read_text()) for k in "ab")
    assert a["energy"] == b["energy"] and a["status"] == b["status"] == "completed"
    told = subprocess.run([ff.program(), "compare", tmp_path / "a", tmp_path / "b"], capture_output=True, text=True)
    assert told.returncode == 0, told.stdout + told.stderr
    page = res.view()
    assert page.html.startswith("<!") and "iframe" in page._repr_html_() and len(page.html) > 10000
    with pytest.raises(ff.Error):
        res.save("/proc/none")


def test_plots():
    import matplotlib
    matplotlib.use("agg")
    res = ff.run(ff.Model.load(ff.example("quarter_car")), duration=0.5)
    axes = res.plot()
    assert sum(len(ax.lines) for ax in axes) == len(res) - 1
    assert np.array_equal(axes[0].lines[0].get_ydata(), res[list(res)[1]])
    with pytest.raises(KeyError, match="found no output"):
        res.plot(["nowhere"])
