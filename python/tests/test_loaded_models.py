"""Loaded models are models: their description is read, changed and written; the bits stay where nothing was changed."""

import copy
import os
import pathlib
import pickle
import subprocess
import sys

import floatframe as ff
import numpy as np
import pytest
from floatframe.builders import TABLES

EXAMPLES = sorted(p.stem for p in pathlib.Path(ff.example("iltis")).parents[1].glob("*/*.yaml") if p.stem == p.parent.name)
QUICK = [name for name in EXAMPLES if name not in ("iltis_solid", "washing_machine")]


@pytest.mark.parametrize("name", EXAMPLES)
def test_the_description_is_that_of_the_file(name):
    path = pathlib.Path(ff.example(name))
    model = ff.Model.load(path)
    again = ff.Model.from_dict(model.data, folder=path.parent)
    assert not model.filled_in and model.file == str(path)
    for section, table in TABLES.items():
        entities = getattr(model, section)
        for entity, value in entities.items():
            entities[entity] = value  # the checks of keys know all of them
            assert value.get("type", "coupling") in table["types"]
    if name in QUICK:
        runs = [ff.run(m, duration=0.02) for m in (model, again, ff.Model.from_yaml(again.to_yaml(), folder=path.parent))]
        assert all(np.array_equal(run.table, runs[0].table, equal_nan=True) for run in runs)


def test_the_text_has_the_values_given():
    path = pathlib.Path(ff.example("quarter_car"))
    model = ff.Model.load(path, speed=20, **{"class": "A"})
    assert model.data["parameters"]["speed"] == 20 and model.data["parameters"]["class"] == "A"
    again = ff.Model.from_yaml(model.to_yaml(), folder=path.parent)
    assert np.array_equal(ff.run(model, duration=0.2).table, ff.run(again, duration=0.2).table)
    assert not np.array_equal(ff.run(again, duration=0.2).table, ff.run(ff.Model.load(path), duration=0.2).table)
    assert ff.Model.load(path).to_yaml() == path.read_text(encoding="utf-8")


def test_entities_are_added_changed_and_removed():
    model = ff.Model.load(ff.example("quarter_car"), speed=20)
    before = ff.run(model, duration=0.2)
    model.outputs.add("body.z", position={"body": "body"}, axis="z")
    added = ff.run(model, duration=0.2)
    assert model.filled_in and list(added)[: len(before)] == list(before) and "body.z" in added
    for name in before:
        assert np.array_equal(added[name], before[name])
    del model.outputs["body.z"]
    assert not model.filled_in and np.array_equal(ff.run(model, duration=0.2).table, before.table)
    model.data["parameters"]["body_mass"] = 600
    changed = ff.run(model, duration=0.2)
    assert "body_mass" not in model.parameters and model.parameters["speed"] == "20"
    by_parameter = ff.run(ff.Model.load(ff.example("quarter_car"), speed=20, body_mass=600), duration=0.2)
    assert np.array_equal(changed.table, by_parameter.table) and not np.array_equal(changed.table, before.table)


def test_a_given_parameter_that_is_changed_later_is_no_longer_given():
    model = ff.Model.load(ff.example("quarter_car"), speed=20)
    model.data["parameters"]["speed"] = 5
    assert "speed" not in model.parameters
    other = ff.run(ff.Model.load(ff.example("quarter_car"), speed=5), duration=0.1)
    assert np.array_equal(ff.run(model, duration=0.1).table, other.table)


def test_changed_models_are_saved_with_what_they_refer_to(tmp_path, monkeypatch):
    model = ff.Model.load(ff.example("iltis"), speed=8)
    model.simulation["duration"] = 0.02
    result = ff.run(model)
    monkeypatch.chdir(tmp_path)
    for folder in ("relative", tmp_path / "absolute"):
        result.save(folder)
        for command in (["stress", folder], ["export", folder, "--csv", tmp_path / "motion.csv", "--overwrite"]):
            done = subprocess.run([ff.program(), *command], capture_output=True, text=True)
            assert done.returncode == 0, done.stderr
    saved = ff.Model.load(model.save("own/model.yaml"))
    assert np.array_equal(ff.run(saved).table, result.table)
    assert copy.deepcopy(model).data == model.data == pickle.loads(pickle.dumps(model)).data


def test_a_working_folder_that_changes(tmp_path, monkeypatch):
    (tmp_path / "here").mkdir()
    (tmp_path / "here" / "model.yaml").write_text(ff.Model.load(ff.example("four_bar")).to_yaml())
    monkeypatch.chdir(tmp_path)
    model = ff.Model.load("here/model.yaml")
    text = ff.Model.from_yaml(model.to_yaml(), folder="here")
    monkeypatch.chdir(os.sep)
    model.simulation["duration"] = 0.01
    text.simulation["duration"] = 0.01
    assert np.array_equal(ff.run(model).table, ff.run(text).table)
    assert model.file == text.file == str(tmp_path / "here" / "<model>")


def test_packed_models_run_and_say_that_they_have_no_description(tmp_path):
    subprocess.run([ff.program(), "pack", ff.example("four_bar"), "-o", tmp_path / "model.ffm"], check=True, capture_output=True)
    model = ff.Model.load(tmp_path / "model.ffm")
    assert np.array_equal(ff.run(model, duration=0.02).table, ff.run(ff.Model.load(ff.example("four_bar")), duration=0.02).table)
    for use in (lambda: model.data, lambda: model.bodies["x"], model.to_yaml, lambda: model.save(tmp_path / "x.yaml")):
        with pytest.raises(ff.InputError, match="packed"):
            use()


def test_what_is_no_name_of_a_model_is_not_set():
    model = ff.Model.load(ff.example("four_bar"))
    for name in ("bodys", "gravity", "step", "parameters", "core", "file"):
        with pytest.raises(AttributeError, match=name):
            setattr(model, name, 1)
    with pytest.raises(TypeError):
        model.parameters["speed"] = "3"
    model.simulation = {"step": 1e-3, "duration": 0.01}
    model.name = "other"
    assert ff.run(model).name == "other" and dict(model.simulation) == {"step": 1e-3, "duration": 0.01}


def test_builders_name_a_misspelt_key_at_once():
    model = ff.Model()
    with pytest.raises(ff.UnknownNameError, match="forces.s: unknown key 'sprng', did you mean 'spring'"):
        model.forces.spring_damper("s", from_={"body": "a"}, to={"body": "b"}, sprng=1)
    with pytest.raises(ff.UnknownNameError, match="found the type 'revolut', expected one of weld, revolute"):
        model.joints.add("j", type="revolut")
    assert len(model.forces) == len(model.joints) == 0
    model.couplings.coupling("c", terms=[{"joint": "j", "factor": 1}], value=0.5)  # one of its keys is `value`
    assert model.couplings["c"]["value"] == 0.5
    model.joints.revolute("j", child="a", at=[0, 0, 0], axis="y")
    assert model.joints["j"] == {"type": "revolute", "child": "a", "at": [0, 0, 0], "axis": "y"}
    assert "axis: " in ff.Model.joints.fget(model).revolute.__doc__ and "required" in model.forces.joint_spring.__doc__


def test_the_key_tables_are_those_of_the_document():
    script = pathlib.Path(ff.__file__).resolve().parents[2] / "scripts" / "write_python_keys.py"
    if not script.exists():
        pytest.skip("the package is not that of the source tree")
    done = subprocess.run([sys.executable, str(script), "--check"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout
