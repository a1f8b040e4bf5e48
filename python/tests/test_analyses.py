"""Analyses: the figures of the command line, arrays that share memory, linear systems that fit together."""

import gc
import json
import subprocess

import floatframe as ff
import numpy as np
import pytest


@pytest.fixture(scope="module")
def iltis():
    return ff.Model.load(ff.example("iltis"))


def command(*arguments):
    """The JSON of an analysis of the command line."""
    return json.loads(subprocess.run([ff.program(), *arguments, "--json"], check=True, capture_output=True, text=True).stdout)


def test_check(iltis):
    counts = ff.check(iltis)
    assert (counts.bodies, counts.flexible_bodies, counts.degrees_of_freedom) == (17, 12, 74)
    assert (counts.relative.rigid, counts.relative.elastic, counts.absolute.total) == (34, 64, 304)


def test_statics_are_those_of_the_command_line(iltis):
    statics = ff.statics(iltis)
    told = command("statics", ff.example("iltis"))
    assert told["residual"] == statics.residual  # every bit
    assert [(f["name"], f["force"], f["length"]) for f in told["forces"]] == [(f.name, f.force, f.length) for f in statics.forces]
    tyres = sum(f.force for f in statics.forces if f.type == "tyre")
    assert tyres == pytest.approx(1513.4 * 9.81, rel=1e-9)
    assert statics.joints[0].force.shape == (3,) and statics.bodies[0].amplitudes.ndim == 1
    res = ff.run(iltis, start=statics.state, step=0.01, duration=0.1)
    assert np.ptp(res["chassis.z"]) < 1e-6  # on the flat it stays


def test_mass(iltis):
    mass = ff.mass_properties(iltis)
    assert mass.mass == pytest.approx(1513.4) and mass.centre.shape == (3,)
    assert sum(b.mass for b in mass.bodies) == pytest.approx(mass.mass)
    np.testing.assert_allclose(np.linalg.eigvalsh(mass.inertia), mass.principal_moments, rtol=1e-12)


def test_matrices_share_the_memory_of_the_result(iltis):
    linear = ff.linearize(iltis, start="equilibrium")
    assert np.shares_memory(linear.M, linear.M)
    k, copy = linear.K, linear.K.copy()
    del linear
    gc.collect()
    filler = [np.ones(k.shape) for _ in range(20)]
    assert np.array_equal(k, copy) and filler


def test_modes_are_the_eigenvalues_of_the_system(iltis):
    modes = ff.modes(iltis, start="equilibrium")
    system = ff.linear_system(iltis, start="equilibrium")
    values = np.linalg.eigvals(system.A)
    for mode in modes[8:]:
        assert np.min(abs(values - mode.eigenvalue)) < 1e-6 * abs(mode.eigenvalue)
        np.testing.assert_allclose(system.A @ mode.z, mode.eigenvalue * mode.z, atol=1e-7 * abs(mode.eigenvalue))
    assert sum(modes[8].kinetic.values()) == pytest.approx(1.0)


def test_modes_of_a_pendulum():
    model = ff.Model.load(ff.example("flexible_pendulum"))
    linear = ff.linearize(model, start="equilibrium")
    modes = ff.modes(model, start="equilibrium")
    squares = np.sort(np.linalg.eigvals(np.linalg.solve(linear.M, linear.K)).real)
    assert modes[0].frequency == pytest.approx(np.sqrt(squares[0]) / (2 * np.pi), rel=1e-9)


def test_the_response_is_that_of_the_state_space(iltis):
    linear = ff.linear_model(iltis, ["road"], ["chassis.z"], start="equilibrium")
    frequencies = np.array([0.5, 1.5, 12.0])
    response = linear.response(frequencies)
    space = linear.state_space()
    assert response.shape == (3, 1, 1) and space.inputs == ["rate of road"]
    for f, g in zip(frequencies, response[:, 0, 0]):
        s = 2j * np.pi * f
        rate = space.C @ np.linalg.solve(s * np.eye(len(space.A)) - space.A, space.B) + space.D
        assert g == pytest.approx(s * rate[0, 0], rel=1e-7)
    assert np.array_equal(ff.frequency_response(iltis, frequencies, ["road"], ["chassis.z"], start="equilibrium"), response)


def test_road(iltis):
    road = ff.road_response(iltis, ["chassis.z"], np.geomspace(0.22, 50, 4000), speed=20, start="equilibrium")
    spectrum = road.outputs[0]
    inside = spectrum.density > 0
    assert np.sqrt(np.trapezoid(spectrum.density[inside], road.frequencies[inside])) == pytest.approx(spectrum.rms, rel=1e-4)


def test_campbell_and_order():
    rotor = ff.Model.load(ff.example("rotor"))
    diagram = ff.campbell(rotor, "motor", 0, 400, 100, axis=[1, 0, 0], modes=6)
    assert diagram.lines[0].eigenvalues.shape == diagram.speeds.shape and diagram.critical[0].speed > 0
    order = ff.model_order(rotor, below=50.0)
    assert order.needed <= order.modes and order.change <= 0.01


def test_advice():
    advice = ff.advise(ff.Model.load(ff.example("flexible_pendulum")), step=5e-3)
    assert advice.bodies and {m.action for b in advice.bodies for m in b.modes} <= {"keep", "quasi-static", "drop"}


@pytest.mark.parametrize("call", [
    lambda m: ff.frequency_response(m, [float("nan")]), lambda m: ff.frequency_response(m, [[1.0, 2.0]]),
    lambda m: ff.frequency_response(m, "many"), lambda m: ff.frequency_response(m, [1j]),
    lambda m: ff.linear_model(m, ["nowhere"]), lambda m: ff.linear_model(m, [1]), lambda m: ff.linear_model(m, None),
    lambda m: ff.linear_model(m, outputs=["x"]), lambda m: ff.campbell(m, "x", 0, 1, 1), lambda m: ff.campbell(m, 3, 0, 1, 1),
    lambda m: ff.campbell(m, "chassis", 0, 1, 0), lambda m: ff.campbell(m, "chassis", 0, 1, 0.1, axis=[0, 0]),
    lambda m: ff.campbell(m, "chassis", 0, 1, 0.1, axis=[0, 0, float("nan")]), lambda m: ff.campbell(m, "chassis", 0, float("inf"), 1),
    lambda m: ff.road_response(m, ["chassis.z"], [1.0], speed=float("nan")), lambda m: ff.road_response(m, ["x"], [1.0], speed=1),
    lambda m: ff.model_order(m, float("nan")), lambda m: ff.model_order(m, -1), lambda m: ff.advise(m, tolerance=-1),
    lambda m: ff.mass_properties(m, start="x"), lambda m: ff.check(None), lambda m: ff.statics(m.core), lambda m: ff.modes("iltis"),
    lambda m: ff.linearize(m, step=-1), lambda m: ff.modes(m, start="given", coordinates="absolut"), lambda m: ff.advise(m, step="x"),
    lambda m: ff.modes(m, number=0), lambda m: ff.modes(m, number=2.5), lambda m: ff.modes(m, number="x"),
])
def test_what_is_not_valid(iltis, call):
    with pytest.raises((ff.Error, TypeError, ValueError)):
        call(iltis)


@pytest.mark.parametrize("options", [
    {"axis": (float("nan"), 0, 0)}, {"axis": (0, 0, 0)}, {"to": 1e160, "step": 1e159}, {"modes": 0}, {"modes": -1},
    {"orders": [float("nan")]}, {"orders": [0.0]}, {"orders": [-1.0]},
], ids=str)
def test_campbell_of_impossible_options(options):
    rotor = ff.Model.load(ff.example("rotor"))
    given = {"to": 100.0, "step": 50.0} | options
    with pytest.raises(ff.InputError):
        ff.campbell(rotor, "motor", 0.0, given.pop("to"), given.pop("step"), **given)


@pytest.mark.parametrize("options", [
    {"roughness": -1.0}, {"roughness": float("nan")}, {"waviness": float("nan")}, {"waviness": -1.0}, {"band": (-5.0, 1.0)},
    {"band": (0.1, float("inf"))},
], ids=str)
def test_road_response_of_impossible_roads(options):
    model = ff.Model.load(ff.example("quarter_car"))
    with pytest.raises(ff.InputError):
        ff.road_response(model, ["travel"], [1.0], speed=10.0, **options)
