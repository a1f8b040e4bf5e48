"""A hundred wrong calls on models, parts and results: each raises one clear sentence, and the objects go on working."""

import os

import floatframe as ff
import numpy as np
import pytest

NAN, INF = float("nan"), float("inf")
EXAMPLE = ff.example("four_bar")


@pytest.fixture(scope="module")
def part():
    points = np.array([[x, y, z] for x in np.linspace(0, 0.5, 5) for y in (0, 0.03) for z in (0, 0.05)])
    cells = np.array([[4 * k + i for i in (0, 4, 6, 2, 1, 5, 7, 3)] for k in range(4)])
    mesh = ff.Mesh(points, [("hex8i", cells)], {"A": points[:, 0] < 1e-6})
    return ff.reduce(mesh, material=ff.Material(2.1e11, 0.3, 7850), interfaces={"A": ff.set("A")}, modes=2)


@pytest.fixture(scope="module")
def result():
    return ff.run(ff.Model.load(EXAMPLE), duration=0.01)


@pytest.fixture
def model():
    return ff.Model.load(EXAMPLE)


def assign(model, section, name, value):
    getattr(model, section)[name] = value


def built(model, change):
    change(model)
    return model.core


# Name of the call -> (a function of model, result, part and an empty folder; a word that the sentence has).
CALLS = {
    "load nothing": (lambda m, r, p, d: ff.Model.load(None), "path"),
    "load a number": (lambda m, r, p, d: ff.Model.load(3), "path"),
    "load bytes": (lambda m, r, p, d: ff.Model.load(b"x"), "path"),
    "load an empty name": (lambda m, r, p, d: ff.Model.load(""), "path"),
    "load a folder": (lambda m, r, p, d: ff.Model.load(d), ""),
    "load what is not there": (lambda m, r, p, d: ff.Model.load(d / "no.yaml"), "not exist"),
    "load a NUL": (lambda m, r, p, d: ff.Model.load("a\0b"), "path"),
    "load a body file": (lambda m, r, p, d: (p.save(d / "a.ffb"), ff.Model.load(d / "a.ffb")), ""),
    "load another parameter": (lambda m, r, p, d: ff.Model.load(EXAMPLE, nowhere=1), "nowhere"),
    "load a parameter of None": (lambda m, r, p, d: ff.Model.load(ff.example("iltis"), speed=None), "NoneType"),
    "load a parameter of a list": (lambda m, r, p, d: ff.Model.load(ff.example("iltis"), speed=[1]), "list"),
    "load a parameter of NaN": (lambda m, r, p, d: ff.Model.load(ff.example("iltis"), speed=NAN), "speed"),
    "text of a number": (lambda m, r, p, d: ff.Model.from_yaml(3), "int"),
    "text of a list": (lambda m, r, p, d: ff.Model.from_yaml("- 1"), ""),
    "data of a list": (lambda m, r, p, d: ff.Model.from_dict([1]), "list"),
    "data of a text": (lambda m, r, p, d: ff.Model.from_dict("x"), "str"),
    "data with a number as key": (lambda m, r, p, d: ff.Model.from_dict({1: 2}), "1"),
    "data with a set": (lambda m, r, p, d: ff.Model.from_dict({"points": {"a": {1}}}), "points.a"),
    "data with bytes": (lambda m, r, p, d: ff.Model.from_dict({"name": b"x"}), "name"),
    "data with NaN": (lambda m, r, p, d: ff.Model.from_dict({"points": {"a": [NAN, 0, 0]}}), "points.a"),
    "data with a parameter that is none": (lambda m, r, p, d: ff.Model.from_dict(m.data, nowhere=1), "nowhere"),
    "folder of a number": (lambda m, r, p, d: ff.Model("a", folder=3), "folder"),
    "name of a number": (lambda m, r, p, d: ff.Model(3), "name"),
    "name set to None": (lambda m, r, p, d: setattr(m, "name", None), "name"),
    "data set to a list": (lambda m, r, p, d: setattr(m, "data", [1]), "data"),
    "bodys": (lambda m, r, p, d: m.bodys, "bodys"),
    "bodys set": (lambda m, r, p, d: setattr(m, "bodys", {}), "bodys"),
    "step set": (lambda m, r, p, d: setattr(m, "step", 1), "step"),
    "bodies set to a number": (lambda m, r, p, d: setattr(m, "bodies", 3), "bodies"),
    "parameters changed": (lambda m, r, p, d: assign(m, "parameters", "x", "1"), "mappingproxy"),
    "a body that is none": (lambda m, r, p, d: m.bodies["nowhere"], "nowhere"),
    "a joint that is none removed": (lambda m, r, p, d: m.joints.__delitem__("nowhere"), "nowhere"),
    "a force popped": (lambda m, r, p, d: m.forces.pop("nowhere"), "nowhere"),
    "a body twice": (lambda m, r, p, d: (m.bodies.add("b", rigid={}), m.bodies.add("b", rigid={})), "bodies.b"),
    "a name of a number": (lambda m, r, p, d: m.bodies.add(3, rigid={}), "3"),
    "a name of nothing": (lambda m, r, p, d: m.bodies.add("", rigid={}), "''"),
    "a name assigned that is none": (lambda m, r, p, d: assign(m, "bodies", None, {}), "None"),
    "a value and keys": (lambda m, r, p, d: m.bodies.add("b", {}, rigid={}), "a value and keys"),
    "a key that is none": (lambda m, r, p, d: m.joints.revolute("j", chld="b"), "child"),
    "a type that is none": (lambda m, r, p, d: m.joints.add("j", type="hinge"), "hinge"),
    "a type in a method": (lambda m, r, p, d: m.joints.revolute("j", type="weld"), "type"),
    "a method that is none": (lambda m, r, p, d: m.forces.sprng("s"), "sprng"),
    "an object as a value": (lambda m, r, p, d: m.points.add("a", object()), "points.a"),
    "a function as a value": (lambda m, r, p, d: m.points.add("a", len), "points.a"),
    "a complex number": (lambda m, r, p, d: m.points.add("a", [1j, 0, 0]), "points.a"),
    "an infinite number": (lambda m, r, p, d: m.points.add("a", [INF, 0, 0]), "points.a"),
    "an array of NaN": (lambda m, r, p, d: m.points.add("a", np.full(3, NAN)), "points.a"),
    "a surrogate": (lambda m, r, p, d: m.points.add("a", "\ud800"), "points.a"),
    "a map within itself": (lambda m, r, p, d: (m.data.__setitem__("x", m.data), m.core), "levels"),
    "an unknown section": (lambda m, r, p, d: built(m, lambda m: m.data.__setitem__("bodys", {})), "bodys"),
    "a section of a text": (lambda m, r, p, d: built(m, lambda m: m.data.__setitem__("rods", "none")), "rods"),
    "a section that is read of a text": (lambda m, r, p, d: (m.data.__setitem__("joints", "none"), list(m.joints)), "joints"),
    "an option that is none": (lambda m, r, p, d: built(m, lambda m: m.simulation.update(stepp=1)), "stepp"),
    "a step of zero": (lambda m, r, p, d: built(m, lambda m: m.simulation.update(step=0)), "step"),
    "a mass below zero": (lambda m, r, p, d: built(m, lambda m: m.bodies.add("b", rigid={"mass": -1, "centre_of_mass": [0, 0, 0]})), "mass"),
    "a joint to nowhere": (lambda m, r, p, d: built(m, lambda m: m.joints.weld("w", child="nowhere", at=[0, 0, 0])), "nowhere"),
    "a description without bodies": (lambda m, r, p, d: built(m, lambda m: setattr(m, "data", {"floatframe": 1})), "bodies"),
    "a part as a joint": (lambda m, r, p, d: m.joints.weld("w", child=p), "joints.w.child"),
    "a part as a point": (lambda m, r, p, d: m.points.add("a", p), "points.a"),
    "a part as a rigid body": (lambda m, r, p, d: m.bodies.add("b", rigid=p), "bodies.b.rigid"),
    "a body as a force": (lambda m, r, p, d: m.forces.force("f", body=p.body), "forces.f.body"),
    "integrals with modes as a rigid body": (lambda m, r, p, d: m.bodies.add("b", rigid=p.invariants), "modes"),
    "a material below zero": (lambda m, r, p, d: m.bodies.add("b", flexible={"material": ff.Material(-1, 0.3, 1)}), "young"),
    "a material of texts": (lambda m, r, p, d: m.bodies.add("b", flexible={"material": ff.Material("a", 0.3, 1)}), "young"),
    "a place as a body": (lambda m, r, p, d: m.bodies.add("b", ff.set("A")), "bodies.b"),
    "a place of a mesh": (lambda m, r, p, d: m.bodies.add("b", flexible={"interfaces": {"A": ff.nodes([1])}}), "mesh"),
    "a place with other dofs": (lambda m, r, p, d: m.bodies.add("b", flexible={"interfaces": {"A": ff.set("A", dofs="up")}}), "dofs"),
    "a place at NaN": (lambda m, r, p, d: m.bodies.add("b", flexible={"interfaces": {"A": ff.nearest([NAN, 0, 0])}}), "nearest"),
    "an interface with loads": (lambda m, r, p, d: m.bodies.add("b", flexible={"interfaces": {"A": ff.set("A", residual=True)}}), "residual"),
    "a beam section": (lambda m, r, p, d: m.bodies.add("b", flexible={"bars": ff.BeamSection(1, 1, 1, 1)}), "BeamSection"),
    "save to a number": (lambda m, r, p, d: m.save(3), "path"),
    "save to a folder": (lambda m, r, p, d: m.save(d), "irectory"),
    "save below a file": (lambda m, r, p, d: ((d / "f").write_text(""), m.save(d / "f" / "m.yaml")), "cannot be written"),
    "save a function": (lambda m, r, p, d: (m.forces.force_law("f", joint="x", law=len), m.save(d / "m.yaml")), "function"),
    "run None": (lambda m, r, p, d: ff.run(None), "NoneType"),
    "run a path": (lambda m, r, p, d: ff.run(EXAMPLE), "str"),
    "run a class": (lambda m, r, p, d: ff.run(ff.Model), "type"),
    "run an option that is none": (lambda m, r, p, d: ff.run(m, stepp=1), "stepp"),
    "run to NaN": (lambda m, r, p, d: ff.run(m, duration=NAN), "duration"),
    "run backwards": (lambda m, r, p, d: ff.run(m, duration=-1), "duration"),
    "run a text as step": (lambda m, r, p, d: ff.run(m, step="small"), "step"),
    "an output that is none": (lambda m, r, p, d: r["nowhere"], "nowhere"),
    "an output of a number": (lambda m, r, p, d: r[3], "3"),
    "an output of a slice": (lambda m, r, p, d: r[1:2], "slice"),
    "an output of an array": (lambda m, r, p, d: r[np.zeros(2)], "array"),
    "results are not assigned": (lambda m, r, p, d: r.__setitem__("time", 1), "__setitem__"),
    "save results to None": (lambda m, r, p, d: r.save(None), "folder"),
    "save results below a file": (lambda m, r, p, d: ((d / "g").write_text(""), r.save(d / "g" / "x")), "g"),
    "results of nothing": (lambda m, r, p, d: ff.Result.load(None), "folder"),
    "results of no folder": (lambda m, r, p, d: ff.Result.load(d / "no"), "no folder"),
    "results of an empty folder": (lambda m, r, p, d: ff.Result.load(d), "results.csv"),
    "results of a broken table": (lambda m, r, p, d: ((d / "results.csv").write_text("time [s],a\n1,x\n"), (d / "summary.json").write_text("{}"),
                                                      ff.Result.load(d)), "table"),
    "results of a broken summary": (lambda m, r, p, d: ((d / "results.csv").write_text("time [s]\n1\n"), (d / "summary.json").write_text("{"),
                                                        ff.Result.load(d)), "summary"),
    "results of another model": (lambda m, r, p, d: ff.Result.load(r.save(d / "r"), model=3), "model"),
    "results with the wrong model": (lambda m, r, p, d: ff.Result.load(r.save(d / "s"), model=ff.Model.load(ff.example("cam"))).to_pyvista(), "model"),
    "a picture at NaN": (lambda m, r, p, d: r.to_pyvista(NAN), "time"),
    "a picture at a text": (lambda m, r, p, d: r.to_pyvista("now"), "time"),
    "MATLAB to a number": (lambda m, r, p, d: r.to_mat(3), "file"),
    "MATLAB to no folder": (lambda m, r, p, d: r.to_mat(d / "no" / "x.mat"), "folder"),
    "HDF5 to a folder": (lambda m, r, p, d: r.to_hdf5(d), ""),
    "Parquet to nothing": (lambda m, r, p, d: r.to_parquet(""), "file"),
    "plot an output that is none": (lambda m, r, p, d: r.plot("nowhere"), "nowhere"),
    "an FMU of None": (lambda m, r, p, d: ff.export_fmu(None, d / "x.fmu"), "NoneType"),
    "an FMU to a number": (lambda m, r, p, d: ff.export_fmu(m, 3), "file"),
    "an example of None": (lambda m, r, p, d: ff.example(None), "NoneType"),
    "an example that is none": (lambda m, r, p, d: ff.example("nowhere"), "nowhere"),
}


def test_there_are_a_hundred():
    assert len(CALLS) >= 100


@pytest.mark.parametrize("name", CALLS)
def test_one_clear_sentence(name, model, result, part, tmp_path):
    call, word = CALLS[name]
    if "pyvista" in name or "picture" in name or "wrong model" in name:
        pytest.importorskip("pyvista")
    for library, words in (("scipy", "MATLAB"), ("h5py", "HDF5"), ("pyarrow", "Parquet"), ("matplotlib", "plot")):
        if words in name:
            pytest.importorskip(library)
    with pytest.raises((ff.Error, TypeError, AttributeError)) as caught:
        call(model, result, part, tmp_path)
    error = caught.value
    sentence = str(error)
    assert word in sentence and sentence.strip(), sentence
    assert "\n" not in sentence and len(sentence) < 1000, sentence
    assert not isinstance(error, ff.InputError) or len(error.errors) == 1
    assert np.isfinite(result.time).all() and os.path.isdir(tmp_path)


def test_the_model_works_after_wrong_calls(model, result, part, tmp_path):
    for call, _ in CALLS.values():
        copy = model.copy()
        try:
            call(copy, result, part, tmp_path)
        except (ff.Error, TypeError, AttributeError, ImportError):
            pass
    assert np.array_equal(ff.run(model, duration=0.01).table, result.table)
