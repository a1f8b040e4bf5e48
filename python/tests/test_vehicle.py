"""A handling model in Python: slips and forces of rolling tyres, steering by a callback and by inputs, the road below a tyre."""

from pathlib import Path

import floatframe as ff
import numpy as np
import pytest

WHEELS = ("front_left", "front_right", "rear_left", "rear_right")
VALUES = ("slip_angle", "longitudinal_slip", "lateral_force", "longitudinal_force", "contact_x", "contact_y", "contact_z")


def car(**parameters):
    """The Iltis with Magic Formula tyres, and all values of each tyre as outputs."""
    file = Path(ff.example("iltis")).with_name("handling.yaml")
    channels = "".join(f"  {wheel}.{name}: {{force: {wheel}.mf, output: {name}}}\n" for wheel in WHEELS for name in VALUES)
    return ff.Model.from_yaml(file.read_text(encoding="utf-8").replace("\noutputs:\n", "\noutputs:\n" + channels), folder=file.parent, **parameters)


@pytest.fixture(scope="module")
def model():
    return car(speed=15)


def ramp(time):
    return 0.5 * min(time / 0.3, 1.0)


def test_slips_and_forces_of_a_steady_turn(model):
    sim = ff.Simulation(model, step=1e-3)
    while sim.time < 2.0:
        sim.inputs["steering"] = ramp(sim.time)
        sim.step()
    out = dict(sim.outputs)
    lateral = sum(out[f"{wheel}.lateral_force"] for wheel in WHEELS)
    across = -out["acceleration.x"] * np.sin(out["yaw"]) + out["acceleration.y"] * np.cos(out["yaw"])
    for wheel in WHEELS:
        assert -0.1 < out[f"{wheel}.slip_angle"] < 0.0 < out[f"{wheel}.lateral_force"]  # ISO-W: opposite signs, to the left
        assert abs(out[f"{wheel}.longitudinal_slip"]) < 0.01
    # Of the wheels in their own axes: the front ones are steered by 1.5 degrees.
    assert lateral == pytest.approx(ff.mass_properties(model).mass * across, rel=0.01)
    assert sum(out[f"{wheel}.load"] for wheel in WHEELS) == pytest.approx(9.81 * ff.mass_properties(model).mass, rel=0.005)


def test_a_callback_steers_as_inputs_do(model):
    by_hand, called = ff.Simulation(model, step=1e-3), ff.Simulation(model, step=1e-3)
    steering = list(called.inputs).index("steering")

    def driver(time, outputs, inputs):
        inputs[steering] = ramp(time)

    called.on_step(driver)
    for _ in range(200):
        by_hand.inputs["steering"] = ramp(by_hand.time)
        by_hand.step()
        called.step()
    assert dict(by_hand.outputs) == dict(called.outputs)
    assert by_hand.outputs["front_left.slip_angle"] < 0.0


def test_a_braked_wheel_slips_backwards():
    res = ff.run(car(speed=15, brake=600, duration=1.0))
    for wheel in ("front_left", "front_right"):
        assert res[f"{wheel}.longitudinal_slip"][-1] < -0.002
        assert res[f"{wheel}.longitudinal_force"][-1] < -500.0
    assert res["speed"][-1] < 13.0


def test_the_road_below_the_tyres():
    model = car(speed=15, road="rough", duration=2.0)
    res, road = ff.run(model), ff.Road.of(model, "rough")
    for wheel in WHEELS:
        x, y, z = (res[f"{wheel}.contact_{axis}"] for axis in "xyz")
        assert np.ptp(z) > 1e-3
        np.testing.assert_allclose(road.height(x, y), z, rtol=0.0, atol=1e-4)
