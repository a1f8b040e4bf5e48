"""Runs with a controller, and simulations that are recorded, give results as any other run."""

import json
import subprocess
from pathlib import Path

import floatframe as ff
import numpy as np
import pytest
from cart import cart_pole, soft_beam


def folder_of(res, tmp_path):
    res.save(tmp_path / "out")
    for name in ("results.csv", "states.ffr", "summary.json"):
        assert (tmp_path / "out" / name).stat().st_size > 0
    return tmp_path / "out"


def has_page(folder):
    page = folder / "report.html"
    return not page.exists() or page.stat().st_size > 100_000  # built without the viewer


@pytest.mark.parametrize("interval", [None, 0.01])
def test_a_function_that_changes_nothing_leaves_every_bit(tmp_path, interval):
    text = Path(ff.example("quarter_car")).read_text()
    assert ", output_interval: 0.005}" in text
    text = text.replace(", output_interval: 0.005}", "}" if interval is None else f", output_interval: {interval}}}")
    (tmp_path / "model.yaml").write_text(text)
    subprocess.run([ff.program(), "run", tmp_path / "model.yaml", "--duration", "1", "--quiet", "--no-report", "--out", tmp_path / "run"], check=True)
    calls = []
    res = ff.run(ff.Model.load(tmp_path / "model.yaml"), duration=1, on_step=lambda time, outputs, inputs: calls.append(time))
    assert res.to_csv() == (tmp_path / "run" / "results.csv").read_text()
    assert len(calls) == res.summary["steps"] and calls[0] == 0.0


def test_a_map_sets_inputs_as_the_array_does():
    def in_place(time, outputs, inputs):
        inputs[0] = -3.0 * outputs[0]

    a = ff.run(cart_pole(0.1), duration=0.2, on_step=in_place)
    b = ff.run(cart_pole(0.1), duration=0.2, on_step=lambda time, outputs, inputs: {"F": -3.0 * outputs[0]})
    sim = ff.Simulation(cart_pole(0.1))
    sim.on_step(lambda time, outputs, inputs: {"F": -3.0 * outputs[0]})
    for _ in range(200):
        sim.step()
    assert np.array_equal(a.table, b.table) and a["x"][-1] == sim.outputs["x"] != ff.run(cart_pole(0.1), duration=0.2)["x"][-1]


@pytest.mark.parametrize("returned", [1.0, "F", [1.0], np.zeros(1), {"G": 1.0}, {"F": "x"}, {"F": float("nan")}, {3: 1.0}])
def test_any_other_result_raises(returned):
    with pytest.raises(ff.InputError, match="on_step|input 'F'"):
        ff.run(cart_pole(), duration=0.01, on_step=lambda *_: returned)
    sim = ff.Simulation(cart_pole())
    sim.on_step(lambda *_: returned)
    with pytest.raises((ff.InputError, ff.StepError)):
        sim.step()


def test_what_a_controller_raises_comes_through():
    def broken(time, outputs, inputs):
        if time > 0.005:
            raise ZeroDivisionError("here")

    with pytest.raises(ZeroDivisionError, match="here"):
        ff.run(cart_pole(), duration=0.1, on_step=broken)
    with pytest.raises(ff.InputError, match="on_step"):
        ff.run(cart_pole(), duration=0.1, on_step=3)
    with pytest.raises(ff.InputError, match="verify"):
        ff.run(cart_pole(), duration=0.1, on_step=broken, verify=True)


def test_a_period():
    times, called = [], []
    ff.run(cart_pole(), duration=0.1, on_step=lambda time, *_: times.append(time), period=0.01)
    np.testing.assert_allclose(times, 0.01 * np.arange(10), atol=1e-12)
    sim = ff.Simulation(cart_pole())
    sim.on_step(lambda time, *_: called.append(time), period=0.01)
    for _ in range(100):
        sim.step()
    assert called == times
    for period in (0.0015, 0, -1.0, "x"):
        with pytest.raises(ff.InputError, match="period"):
            ff.run(cart_pole(), duration=0.1, on_step=lambda *_: None, period=period)


def test_state_feedback_is_a_run_with_a_page(tmp_path):
    K = np.array([-1.0, -2.5, -25.0, -6.0])
    res = ff.run(cart_pole(0.05), on_step=lambda time, outputs, inputs: {"F": -K @ outputs}, period=2e-3)
    assert res.summary["status"] == "completed" and abs(res["angle"][-1]) < 0.01 < np.abs(res["angle"]).max()
    assert has_page(folder_of(res, tmp_path))
    assert res.summary["energy"]["balance"]["largest_remainder_J"] < 1e-3


def test_computed_torque_is_a_run_with_a_page(tmp_path):
    """An arm of one link follows a sine: the torque is that of its equation of motion, with a correction."""
    m = ff.Model("arm")
    m.points.update(a=[0, 0, 0], b=[1, 0, 0])
    m.bodies.add("arm", rigid={"mass": 2, "centre_of_mass": [0.5, 0, 0], "inertia": [0.01, 0.2, 0.2]})
    m.joints.add("hinge", type="revolute", child="arm", at="a", axis="y")
    m.inputs.add("T", unit="N m")
    m.forces.add("motor", type="torque", body="arm", direction="y", magnitude={"input": "T"})
    m.outputs.add("angle", joint_position="hinge")
    m.outputs.add("rate", joint_velocity="hinge")
    m.simulation.update(step=1e-3, duration=2)
    J, gravity = 0.2 + 2 * 0.25, 2 * 9.81 * 0.5

    def torque(time, outputs, inputs):
        angle, rate = outputs
        wanted, its_rate, its_acceleration = (0.5 * f for f in (np.sin(2 * time), 2 * np.cos(2 * time), -4 * np.sin(2 * time)))
        acceleration = its_acceleration + 40.0 * (its_rate - rate) + 400.0 * (wanted - angle)
        return {"T": J * acceleration - gravity * np.cos(angle)}

    res = ff.run(m, on_step=torque)
    late = res.time > 0.5
    np.testing.assert_allclose(res["angle"][late], 0.5 * np.sin(2 * res.time[late]), atol=3e-3)
    assert has_page(folder_of(res, tmp_path))


def test_a_recording_is_a_result(tmp_path):
    run = ff.run(cart_pole(0.1), duration=0.5)
    sim = ff.Simulation(cart_pole(0.1))
    with sim.record() as recording:
        for _ in range(500):
            sim.step()
    res = recording.result()
    assert np.array_equal(res.table, run.table) and res.units == run.units and len(recording) == 501
    ours, theirs = (r.summary["energy"] for r in (res, run))
    assert ours["start"] == theirs["start"] and ours["end"] == theirs["end"]
    assert ours["balance"]["work"] == theirs["balance"]["work"]
    assert res.state is not None and res.state.time == sim.time
    folder = folder_of(res, tmp_path)
    assert has_page(folder)
    assert json.loads((folder / "summary.json").read_text())["steps"] == 500
    frames = subprocess.run([ff.program(), "outputs", folder, "--help"], capture_output=True, text=True, check=False)
    assert frames.returncode == 0


def test_a_recording_of_some_steps_and_of_the_last_ones():
    run = ff.run(cart_pole(0.1), duration=0.5)
    sim = ff.Simulation(cart_pole(0.1))
    every = sim.record(every=10)
    for _ in range(500):
        sim.step()
    assert np.array_equal(every.result().table, run.table[::10])
    ring = ff.Simulation(cart_pole(0.1))
    last = ring.record(keep=20)
    for _ in range(500):
        ring.step()
    assert np.array_equal(last.result().table, run.table[-20:])
    with pytest.raises(ff.InputError, match="ended"):
        every_again = sim.record()
        every.result()
    assert len(every_again.stop().table) == 1
    for options in ({"every": 0}, {"keep": 0}, {"every": "x"}):
        with pytest.raises(ff.InputError):
            sim.record(**options)


def test_a_recording_goes_back_with_the_simulation():
    sim = ff.Simulation(cart_pole(0.1))
    recording = sim.record()
    for _ in range(10):
        sim.step()
    saved = sim.save()
    for _ in range(10):
        sim.step()
    sim.restore(saved)
    sim.step()
    assert len(recording) == 12 and np.all(np.diff(recording.result().time) > 0)
    sim.reset()
    assert len(recording) == 1 and recording.result().time[0] == 0.0


@pytest.mark.filterwarnings("ignore::floatframe.RunWarning")
def test_a_recording_has_warnings_and_failures():
    sim = ff.Simulation(soft_beam())
    recording = sim.record()
    for _ in range(1000):
        sim.step()
    assert set(recording.result().summary["warnings"]) <= set(sim.warnings) and sim.warnings
    failing = ff.Simulation(soft_beam(), max_iterations=1, min_step=1e-3)
    recording = failing.record()
    with pytest.raises(ff.StepError) as caught:
        for _ in range(1000):
            failing.step()
    assert recording.result().summary["status"] == "failed" and recording.result().summary["message"] == str(caught.value)
