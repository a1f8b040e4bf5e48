"""Linear models of simulations, and controllers that are found with them."""

import floatframe as ff
import numpy as np
import pytest
from cart import cart_pole, follower, four_bar


def test_a_linear_model_has_the_inputs_as_they_are():
    sim = ff.Simulation(follower())
    sim.inputs["F"] = 10.0
    expected = ff.linear_model(follower(10.0)).state_space().A
    assert expected[1, 0] == pytest.approx(-10.0 / 0.33, rel=1e-6)
    np.testing.assert_allclose(sim.linear_model().A, expected, atol=1e-6)
    assert ff.linear_model(sim.model, start=sim.state()).state_space().A[1, 0] == pytest.approx(0.0, abs=1e-6)  # those of the model


def test_states_are_named_and_x_is_in_their_order():
    sim = ff.Simulation(cart_pole(angle=0.1))
    for _ in range(50):
        sim.step()
    lm = sim.linear_model()
    assert sorted(lm.states) == sorted(ff.StateName("joint", name, 0, rate) for name in ("hinge", "slide") for rate in (False, True))
    kinds = {("slide", False): "x", ("slide", True): "x.rate", ("hinge", False): "angle", ("hinge", True): "angle.rate"}
    expected = [sim.outputs[kinds[name, rate]] for _, name, _, rate in lm.states]
    np.testing.assert_allclose(sim.x, expected, atol=1e-12)
    kind, name, index, rate = lm.states[0]
    assert (kind, index) == ("joint", 0) and sim.states == lm.states
    A, B, C, D = lm
    assert A.shape == (4, 4) and B.shape == (4, 1) and C.shape == (4, 4) and D.shape == (4, 1)
    np.testing.assert_allclose(C @ np.eye(4), [[float(kinds[n, r] == out) for _, n, _, r in lm.states] for out in sim.outputs], atol=1e-9)


def test_states_of_modes_and_loops():
    sim = ff.Simulation(ff.Model.load(ff.example("flexible_pendulum")))
    lm = sim.linear_model()
    assert {state.kind for state in lm.states} == {"joint", "mode"}
    assert len(sim.x) == len(lm.A)
    loop = ff.Simulation(four_bar())
    assert len(loop.linear_model().states) == 2 and len(loop.x) == 2
    with pytest.raises(ff.InputError):
        loop.values([ff.StateName("joint", "nowhere", 0, False)])
    with pytest.raises(ff.InputError):
        loop.values([ff.StateName("joint", "a", 7, False)])


def test_lqr_moves_the_model_as_predicted():
    """Feedback of all states, found by python-control: the nonlinear loop follows the linear one."""
    control = pytest.importorskip("control")
    model = cart_pole()
    sim = ff.Simulation(model)
    lm = sim.linear_model()
    K, _, poles = control.lqr(control.ss(*lm), np.diag([1, 10, 1, 10]), [[0.1]])
    x0 = sim.x
    sim.set(q={"hinge": 0.01})
    sim.on_step(lambda time, outputs, inputs: {"F": float((-K @ (sim.x - x0))[0])})
    x = [sim.x]
    while sim.time < 2.9995:
        sim.step()
        x.append(sim.x)
    times = 1e-3 * np.arange(len(x))
    closed = control.c2d(control.ss(lm.A, lm.B, np.eye(4), np.zeros((4, 1))), 1e-3)
    A = closed.A - closed.B @ K
    expected = [np.array(x[0]) - x0]
    for _ in times[1:]:
        expected.append(A @ expected[-1])
    assert np.real(poles).max() < 0
    np.testing.assert_allclose(np.array(x) - x0, expected, atol=2e-5)
    assert abs(sim.outputs["angle"]) < 1e-3 < np.abs(np.array(x) - x0).max()
