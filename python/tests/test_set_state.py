"""States of simulations that are set by names, and the way back to the start."""

import floatframe as ff
import numpy as np
import pytest
from cart import cart_pole, four_bar, soft_beam


@pytest.mark.parametrize("coordinates", ["relative", "absolute"])
def test_a_tree_is_set(coordinates):
    sim = ff.Simulation(cart_pole(), coordinates=coordinates)
    for _ in range(5):
        sim.step()
    sim.set(q={"hinge": 0.3}, v={"slide": 2.0})
    assert sim.outputs["angle"] == pytest.approx(0.3, abs=1e-12) and sim.outputs["x.rate"] == pytest.approx(2.0, abs=1e-12)
    assert sim.time == pytest.approx(5e-3)
    other = ff.Simulation(cart_pole(0.3), coordinates=coordinates)
    other.set(v={"slide": 2.0})
    for _ in range(100):
        sim.step()
        other.step()
    assert sim.outputs["angle"] == pytest.approx(other.outputs["angle"], abs=1e-9)
    turned = 7.0  # more than a turn is counted
    sim.set(q={"hinge": turned})
    assert sim.outputs["angle"] == pytest.approx(turned, abs=1e-9)


def test_a_tree_is_set_as_it_starts():
    sim, other = ff.Simulation(cart_pole()), ff.Simulation(cart_pole(0.25))
    sim.set(q={"hinge": 0.25})
    for _ in range(200):
        sim.step()
        other.step()
    np.testing.assert_allclose(sim.outputs.array, other.outputs.array, atol=1e-10)


@pytest.mark.parametrize("coordinates", ["relative", "absolute"])
@pytest.mark.parametrize("joint", ["a", "b", "c", "d"])  # one of them is cut
def test_a_loop_is_closed(coordinates, joint):
    sim = ff.Simulation(four_bar(), coordinates=coordinates)
    there = sim.outputs[f"{joint}.angle"] + 0.15
    sim.set(q={joint: there}, v={joint: 1.5})
    assert sim.outputs[f"{joint}.angle"] == pytest.approx(there, abs=1e-9)
    assert sim.outputs[f"{joint}.rate"] == pytest.approx(1.5, abs=1e-8)
    angles = [sim.outputs[f"{name}.angle"] for name in "abcd"]
    # Around the loop the angles about y sum up: ground, crank, coupler, rocker and back.
    assert angles[0] + angles[1] + angles[2] - angles[3] == pytest.approx(0.0, abs=1e-9)
    report = sim.step()
    assert report.position_violation < 1e-8


def test_what_cannot_be_closed_is_refused_with_its_gap():
    sim = ff.Simulation(four_bar())
    for _ in range(3):
        sim.step()
    before, state = sim.outputs.array, sim.save().to_bytes()
    with pytest.raises(ff.RunError, match=r"gap of [0-9.e-]+ m"):
        sim.set(q={"d": 1.5})
    with pytest.raises(ff.RunError, match=r"opens at [0-9.e-]+ m/s|off by"):
        sim.set(v={"a": 1.0, "d": 40.0})
    assert np.array_equal(sim.outputs.array, before) and sim.save().to_bytes() == state
    sim.step()


def test_modes_are_set():
    sim = ff.Simulation(soft_beam())
    sim.set(q={"beam": [0.01]}, v={"hinge": 1.0})
    assert sim.state().bodies["beam"]["amplitudes"][0] == pytest.approx(0.01, abs=1e-12)
    assert sim.values([ff.StateName("mode", "beam", 0, False)])[0] == pytest.approx(0.01, abs=1e-12)
    assert sim.values([ff.StateName("joint", "hinge", 0, True)])[0] == pytest.approx(1.0, abs=1e-12)


@pytest.mark.parametrize("q", [{"nowhere": 1.0}, {"hinge": [1.0, 2.0]}, {"hinge": "x"}, {"hinge": float("nan")}, 3, {3: 1.0}, {"hinge": None}])
def test_wrong_values(q):
    sim = ff.Simulation(cart_pole())
    with pytest.raises(ff.InputError):
        sim.set(q=q)


def test_reset_is_the_start_again():
    sim = ff.Simulation(cart_pole(0.2))
    start = sim.save().to_bytes()

    def steps():
        sim.inputs["F"] = 1.0
        out = []
        for _ in range(50):
            sim.step()
            out.append(sim.outputs.array)
        return np.array(out)

    first = steps()
    for _ in range(2):
        sim.reset()
        assert sim.time == 0.0 and sim.inputs["F"] == 0.0 and sim.save().to_bytes() == start
        assert np.array_equal(steps(), first)
    sim.set(q={"hinge": 0.1})
    sim.reset()
    assert np.array_equal(steps(), first)


def test_parameters_change_without_a_new_model():
    data = cart_pole(0.2).data
    data["parameters"] = {"mass": 0.2}
    data["bodies"]["pole"]["rigid"]["mass"] = "${mass}"
    model = ff.Model.from_dict(data)
    sim, other = ff.Simulation(model), ff.Simulation(model)
    for s in (sim, other):
        s.step()
    saved = sim.outputs.array
    sim.change(mass=2.0)
    assert np.array_equal(sim.outputs.array, saved) and sim.model.parameters["mass"] == "2"
    for _ in range(100):
        sim.step()
        other.step()
    assert sim.outputs["x"] != other.outputs["x"]
    sim.reset()
    assert sim.time == 0.0 and sim.outputs["angle"] == 0.2
    with pytest.raises(ff.InputError):
        sim.change(ff.Model.load(ff.example("slider_crank")))
    with pytest.raises(ff.InputError):
        sim.change()
