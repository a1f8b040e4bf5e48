"""Bodies of parts that do not fit each other, and what results do when they are copied."""

import copy
import pickle

import floatframe as ff
import numpy as np
import pytest
from blocks import ENDS, QUICK, STEEL, box, mesh


@pytest.fixture(scope="module")
def part():
    return ff.reduce(mesh(), **QUICK, interfaces=ENDS, projection=True)


def projection(size):
    points, cells = box(size=size)
    X = np.random.default_rng(1).normal(size=(len(points), 3, 2))
    return ff.Projection.of_mesh(ff.Mesh(points, [("hex8", cells)]), X, material=STEEL)


def test_the_projection_is_of_the_same_body():
    own, heavier = projection((0.6, 0.1, 0.1)), projection((0.6, 0.1, 0.2))
    K = np.eye(2)
    assert ff.Body(own.invariants(), K=K, projection=own).projection is not None
    with pytest.raises(ff.InputError, match="projection: found nodes with a mass of 94.2.* kg, expected 47.1"):
        ff.Body(own.invariants(), K=K, projection=heavier)
    moved = ff.Projection(np.array(own.p) + [0.3, 0, 0], own.X, dense(own))
    with pytest.raises(ff.InputError, match="centre of mass is 0.[23].* m from"):
        ff.Body(own.invariants(), K=K, projection=moved)


def dense(projection):
    values, columns, starts = projection.mass_rows
    n = len(projection.p)
    M = np.zeros((n, n))
    for k in range(n):
        M[k, columns[starts[k]:starts[k + 1]]] = values[starts[k]:starts[k + 1]]
    return M


def test_mass_matrices_are_symmetric():
    own = projection((0.6, 0.1, 0.1))
    M = dense(own)
    assert np.array_equal(dense(ff.Projection(own.p, own.X, M)), M)
    M[0, 1] *= 1.01
    with pytest.raises(ff.InputError, match="M_s: found a matrix that is not symmetric"):
        ff.Projection(own.p, own.X, M)


def test_frequencies_are_computed_once(part):
    assert np.shares_memory(part.frequencies, part.frequencies) and not part.frequencies.flags.writeable
    body = part.body
    assert np.shares_memory(body.frequencies, body.frequencies) and np.array_equal(body.frequencies, part.frequencies)


def test_copies_of_results():
    model = ff.Model.load(ff.example("quarter_car"))
    res = ff.run(model, duration=0.01)
    for again in (copy.copy(res), copy.deepcopy(res), pickle.loads(pickle.dumps(res))):
        assert np.array_equal(again.table, res.table) and again.summary == res.summary
    for again in (copy.copy(res.state), copy.deepcopy(res.state), pickle.loads(pickle.dumps(res.state))):
        assert again.to_json() == res.state.to_json()
        assert np.array_equal(ff.run(model, start=again, duration=0.01).table, ff.run(model, start=res.state, duration=0.01).table)


def test_a_relative_path_stays_that_of_its_folder(tmp_path, monkeypatch):
    (tmp_path / "a").mkdir()
    (tmp_path / "a/car.yaml").write_text(open(ff.example("slider_crank")).read())
    monkeypatch.chdir(tmp_path / "a")
    model = ff.Model.load("car.yaml")
    assert model.file == "car.yaml"
    monkeypatch.chdir(tmp_path)
    assert "bodies" in model.to_yaml()
    assert list(ff.sweep(model, vary={"simulation.step": [1e-3]}, duration=0.01)["status"]) == ["completed"]
