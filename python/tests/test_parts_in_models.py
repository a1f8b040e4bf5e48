"""Parts, bodies, materials and places as values in models; results of such models are complete wherever they are saved."""

import os
import pathlib
import pickle
import subprocess

import floatframe as ff
import numpy as np
import pytest


def bar(thickness=0.05):
    points = np.array([[x, y, z] for x in np.linspace(0, 0.5, 11) for y in (0, 0.03) for z in (0, thickness)])
    cells = np.array([[4 * k + i for i in (0, 4, 6, 2, 1, 5, 7, 3)] for k in range(10)])
    mesh = ff.Mesh(points, [("hex8i", cells)], {"A": points[:, 0] < 1e-6, "B": points[:, 0] > 0.5 - 1e-6})
    places = {"A": ff.set("A"), "B": ff.set("B")}
    return ff.reduce(mesh, material=ff.Material(2.1e11, 0.3, 7850), interfaces=places, modes=4, projection=True)


@pytest.fixture(scope="module")
def part():
    return bar()


def pendulum(value, name="arm"):
    model = ff.Model("pendulum")
    model.bodies.add(name, flexible=value)
    model.joints.revolute("hinge", child=name, child_node="A", axis="y")
    model.outputs.add("tip", position={"body": name, "node": "B"})
    model.simulation.update(step=1e-3, duration=0.05)
    return model


def test_a_part_is_its_body_file(part, tmp_path):
    part.save(tmp_path / "arm.ffb")
    by_file = ff.Model.from_yaml(pendulum(part).to_yaml(), folder=tmp_path)
    assert 'flexible: "arm.ffb"' in pendulum(part).to_yaml()
    expected = ff.run(by_file).table
    for model in (pendulum(part), pendulum(part.body), pendulum(part).copy(), pickle.loads(pickle.dumps(pendulum(part)))):
        assert np.array_equal(ff.run(model).table, expected)


def test_another_part_of_the_same_name_is_seen(part):
    model = pendulum(part)
    before = ff.run(model)["tip"].copy()
    model.bodies["arm"] = {"flexible": bar(thickness=0.04)}
    assert not np.array_equal(ff.run(model)["tip"], before)


@pytest.mark.parametrize("where", ["relative", "absolute"])
def test_results_have_their_bodies(part, where, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = ff.run(pendulum(part, name="an_arm"))
    folder = result.save("run" if where == "relative" else tmp_path / "run")
    assert {"model.yaml", "an_arm.ffb", "states.ffr"} <= set(os.listdir(folder))
    os.rename("run", "moved")
    monkeypatch.chdir(os.sep)
    moved = tmp_path / "moved"
    for command in (["stress", moved], ["export", moved, "--npz", tmp_path / "x.npz", "--stress"], ["run", moved / "model.yaml", "--out", tmp_path / "again"]):
        done = subprocess.run([ff.program(), *command], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
    assert (tmp_path / "again" / "results.csv").read_bytes() == (moved / "results.csv").read_bytes()
    grid = pytest.importorskip("pyvista") and ff.Result.load(moved).to_pyvista()
    assert np.linalg.norm(np.asarray(grid.points) - result["tip"][-1], axis=1).min() < 1e-9
    assert np.nanmax(grid.point_data["von_mises"]) > 0.0


def test_lines_of_errors_are_those_of_the_text(part):
    model = pendulum(part)
    model.joints.weld("wrong", child="nowhere", at=[0, 0, 0])
    with pytest.raises(ff.InputError) as caught:
        model.core
    line = model.to_yaml().splitlines()[caught.value.errors[0].line - 1]
    assert "nowhere" in line and line[caught.value.errors[0].column - 1 :].startswith("nowhere")


def test_studies_and_fmus_take_models_with_parts(part, tmp_path):
    model = pendulum(part)
    model.data["parameters"] = {"g": 9.81}
    model.data["gravity"] = [0, 0, "${-g}"]
    pytest.importorskip("pandas")
    table = ff.sweep(model, g=[0.0, 9.81], measure=["tip.z:min"], folder=tmp_path / "study", processes=1)
    assert len(table) == 2 and table["tip.z min [m]"].nunique() == 2
    assert pathlib.Path(ff.export_fmu(model, tmp_path / "pendulum.fmu").file).stat().st_size > 1000


def test_rigid_bodies_from_integrals():
    model = ff.Model("top")
    inertia = np.array([[1.0, 0.1, 0.0], [0.1, 2.0, 0.2], [0.0, 0.2, 2.5]])
    model.bodies.add("top", rigid=ff.Invariants.rigid(2.0, [0, 0, 1], inertia))
    model.joints.free("free", child="top")
    assert ff.mass_properties(model).mass == 2.0
    J = model.bodies["top"]["rigid"]["inertia"]
    np.testing.assert_allclose(J, [1.0, 2.0, 2.5, 0.1, 0.0, 0.2], atol=1e-12)


def test_materials_and_places_are_those_of_the_file(tmp_path):
    folder = pathlib.Path(ff.example("iltis_solid")).parent
    model = ff.Model("arm", folder=folder)
    model.bodies.add("arm", flexible={
        "file": "front_arm.msh.gz", "units": "mm-t-s", "material": ff.Material(210000, 0.3, 7.85e-9), "modes": 2, "free_check": False,
        "interfaces": {"HINGE": ff.set("HINGE", at=[0, 0, 0]), "BALL": ff.set("BALL", at=[0, 313, -73], dofs="xyz")},
        "markers": {"DAMPER": ff.nearest([75, 241, -61], residual=True)}})
    flexible = model.bodies["arm"]["flexible"]
    assert flexible["material"] == {"young": 210000.0, "poisson": 0.3, "density": 7.85e-9}
    assert flexible["interfaces"]["BALL"] == {"set": "BALL", "at": [0.0, 313.0, -73.0], "dofs": ["x", "y", "z"]}
    assert flexible["markers"]["DAMPER"] == {"nearest": [75.0, 241.0, -61.0], "residual": True}
    cylinder = ff.cylinder([0, 0, 0], "-z", 4.0, length=2.0, type="mean", tolerance=0.1)
    flexible["interfaces"]["EYE"] = cylinder
    again = model.to_yaml()
    assert "cylinder: {point: [0.0, 0.0, 0.0], axis: [0.0, 0.0, -1.0], radius: 4.0, length: 2.0}" in again.replace("-0.0", "0.0")
