"""Simulations: the steps of `run`, inputs and outputs, saved states, callbacks, failures, threads."""

import copy
import gc
import os
import pickle
import threading
import weakref

import floatframe as ff
import numpy as np
import pytest


@pytest.fixture(scope="module")
def model():
    return ff.Model.load(ff.example("active_damper"))


@pytest.fixture
def sim(model):
    return ff.Simulation(model, step=1e-3)


def steps(sim, count, name="chassis.az"):
    return [(sim.step(), sim.outputs[name])[1] for _ in range(count)]


def test_steps_are_those_of_run(model, sim):
    res = ff.run(model, step=1e-3, duration=0.05)
    samples = [sim.outputs.array]
    for _ in range(50):
        sim.step()
        samples.append(sim.outputs.array)
    assert np.array_equal(np.array(samples), res.table[:, 1:])
    assert sim.time == res.time[-1] and sim.counters["steps"] == 50


def test_inputs_and_outputs_are_mappings(sim):
    assert list(sim.inputs) == ["front_left", "front_right", "rear_left", "rear_right"] and len(sim.outputs) == 9
    sim.inputs["front_left"] = np.float64(300)
    sim.inputs.update(rear_left=-20, rear_right=5)
    assert dict(sim.inputs) == {"front_left": 300.0, "front_right": 0.0, "rear_left": -20.0, "rear_right": 5.0}
    sim.step()
    assert sim.outputs["front_left.actuator"] != 0.0 and "chassis.az" in sim.outputs
    taken = sim.outputs.array
    taken[:] = 7  # a copy
    assert sim.outputs["chassis.az"] != 7


@pytest.mark.parametrize("value", [float("nan"), float("inf"), 1e9])
def test_inputs_out_of_their_limits(sim, value):
    with pytest.raises(ff.InputError, match="expected a number from -8000 to 8000"):
        sim.inputs["front_left"] = value


def test_unknown_names(sim):
    with pytest.raises(KeyError, match="found no input 'frnt', expected one of front_left"):
        sim.inputs["frnt"] = 1.0
    with pytest.raises(KeyError, match="found no output"):
        sim.outputs["frnt"]
    with pytest.raises(ff.InputError):
        sim.inputs["front_left"] = "much"
    with pytest.raises(ff.InputError):
        del sim.inputs["front_left"]


def test_saved_states(model, sim):
    steps(sim, 5)
    saved = sim.save()
    after = steps(sim, 20)
    sim.restore(saved)
    assert steps(sim, 20) == after
    other = ff.Simulation(model, step=1e-3)
    for state in (pickle.loads(pickle.dumps(saved)), copy.deepcopy(saved), ff.SimulationState.from_bytes(saved.to_bytes())):
        other.restore(state)
        assert other.time == saved.time and steps(other, 20) == after


def test_states_of_others_are_refused(model, sim):
    other = ff.Simulation(ff.Model.load(ff.example("slider_crank")))
    with pytest.raises(ff.InputError):
        sim.restore(other.save())
    data = bytearray(sim.save().to_bytes())
    data[40] ^= 1
    with pytest.raises(ff.InputError):
        ff.SimulationState.from_bytes(bytes(data))
    with pytest.raises(ff.InputError):
        sim.restore(ff.SimulationState.from_bytes(b""))


def test_a_state_by_names_is_a_start(model, sim, tmp_path):
    steps(sim, 10)
    state = sim.state()
    assert state.time == sim.time and state.bodies["chassis"]["position"].shape == (3,)
    (tmp_path / "state.json").write_text(state.to_json())
    for start in (state, ff.State.load(str(tmp_path / "state.json"))):
        other = ff.Simulation(model, step=1e-3, start=start, coordinates="absolute")
        assert other.time == sim.time
        np.testing.assert_allclose(other.state().bodies["chassis"]["position"], state.bodies["chassis"]["position"], atol=1e-9)


def test_on_step_sets_inputs(model, sim):
    def control(time, outputs, inputs):
        assert outputs.shape == (9,) and inputs.shape == (4,)
        inputs[0] = -900.0 * outputs[0]

    sim.on_step(control)
    by_callback = steps(sim, 50)
    sim.on_step(None)
    other = ff.Simulation(model, step=1e-3)
    by_hand = []
    for _ in range(50):
        other.inputs["front_left"] = -900.0 * other.outputs["front_left.vz"]
        other.step()
        by_hand.append(other.outputs["chassis.az"])
    assert by_callback == by_hand
    third = ff.Simulation(model, step=1e-3)
    third.law("front_left", lambda time, v: -900.0 * v, of=["front_left.vz"])
    assert steps(third, 50) == by_hand


def pushed_mass(spring=0.0):
    """1 kg on a slide at 0.1 m, an input in newtons."""
    m = ff.Model("pushed")
    m.data["gravity"] = [0, 0, 0]
    m.points.update(a=[0, 0, 0])
    m.bodies.add("b", rigid=dict(mass=1, centre_of_mass="a", inertia=[1] * 3))
    m.joints.add("z", type="prismatic", child="b", at="a", axis="z", position=0.1)
    m.inputs.add("F", unit="N")
    m.forces.add("f", type="force", body="b", direction="z", magnitude={"input": "F"})
    m.forces.add("s", type="joint_spring", joint="z", spring=spring)
    m.outputs.add("z", joint_position="z")
    m.outputs.add("v", joint_velocity="z")
    return m


@pytest.mark.parametrize("coordinates", ["relative", "absolute"])
def test_inputs_are_held_over_the_whole_of_a_step(coordinates):
    h = 0.01
    for rho in (1.0, 0.8, 0.0):
        sim = ff.Simulation(pushed_mass(), step=h, spectral_radius=rho, coordinates=coordinates)
        sim.inputs["F"] = 1.0
        held = [(sim.step(), sim.outputs["v"] / sim.time)[1] for _ in range(5)]
        assert held == pytest.approx([1.0] * 5, abs=1e-10)
    ramp = ff.Simulation(pushed_mass(), step=h, input="ramp", coordinates=coordinates)
    ramp.inputs["F"] = 1.0
    assert [(ramp.step(), ramp.outputs["v"] / ramp.time)[1] for _ in range(3)] == pytest.approx([1 / 2, 3 / 4, 5 / 6])
    with pytest.raises(ff.InputError, match="input"):
        ff.Simulation(pushed_mass(), step=h, input="later")


@pytest.mark.parametrize(("part", "growth"), [(1.0, 11.79), (0.5, 3.433)])
def test_a_law_is_a_zero_order_hold(part, growth):
    """5 Hz of which `part` of the stiffness is a law: energy grows in 5 s as that of a sampled controller."""
    w2 = (2 * np.pi * 5) ** 2
    sim = ff.Simulation(pushed_mass((1 - part) * w2), step=1e-3)
    sim.law("F", lambda time, z: -part * w2 * z, of=["z"])
    for _ in range(5000):
        sim.step()
    energy = 0.5 * sim.outputs["v"] ** 2 + 0.5 * w2 * sim.outputs["z"] ** 2
    assert energy / (0.5 * w2 * 0.01) == pytest.approx(growth, rel=1e-3)


def test_what_a_callback_raises_comes_through(sim):
    before = sim.save().to_bytes()
    for law, error in ((lambda t: 1 / 0, ZeroDivisionError), (lambda t: "much", ff.InputError), (lambda t, x: x, TypeError),
                       (lambda t: float("nan"), ff.StepError), (lambda t: sim.time, RuntimeError),
                       (lambda t: sim.step(), RuntimeError)):
        sim.law("front_left", law)
        with pytest.raises(error):
            sim.step()
    sim.law("front_left", None)
    assert sim.save().to_bytes() == before
    sim.step()


def test_a_step_that_fails(model):
    sim = ff.Simulation(model, step=1e-3)
    for size in (-1.0, 0.0, float("nan")):
        with pytest.raises(ff.StepError) as caught:
            sim.step(size)
        assert caught.value.status == "invalid_step" and sim.time == 0.0
    assert isinstance(pickle.loads(pickle.dumps(caught.value)), ff.StepError)
    sim.step()


def test_cycles_are_collected(model):
    sim = ff.Simulation(model, step=1e-3)
    sim.on_step(lambda time, outputs, inputs: sim)
    sim.law("front_left", lambda time: sim.x)
    gone = weakref.ref(sim)
    del sim
    gc.collect()
    assert gone() is None


def test_arrays_of_callbacks_outlive_the_simulation(model):
    kept = []
    sim = ff.Simulation(model, step=1e-3)
    sim.on_step(lambda time, outputs, inputs: kept.extend([outputs, inputs]))
    sim.step()
    del sim
    gc.collect()
    kept[0][:] = 1.0
    assert kept[1].sum() == 0.0


def test_two_threads_at_once(model):
    sim = ff.Simulation(model, step=1e-3)
    entered, leave, errors = threading.Event(), threading.Event(), []

    def hold(time, outputs, inputs):
        entered.set()
        leave.wait(10)

    sim.on_step(hold)
    thread = threading.Thread(target=sim.step)
    thread.start()
    entered.wait(10)
    for call in (sim.step, sim.save, lambda: sim.time, lambda: sim.outputs["chassis.az"], lambda: sim.on_step(None),
                 lambda: sim.inputs.update(front_left=1.0)):
        with pytest.raises(RuntimeError, match="another thread"):
            call()
    leave.set()
    thread.join()
    sim.on_step(None)
    sim.step()


def test_many_simulations_in_threads(model):
    results = {}

    def work(k):
        results[k] = steps(ff.Simulation(model, step=1e-3), 100)

    threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert all(results[k] == results[0] for k in results)


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_fork(sim):
    steps(sim, 3)
    child = os.fork()
    if child == 0:
        steps(sim, 3)
        os._exit(0 if sim.counters["steps"] == 6 else 1)
    assert os.waitpid(child, 0)[1] == 0
    assert sim.counters["steps"] == 3


@pytest.mark.parametrize("options", [{"step": "x"}, {"step": True}, {"stp": 1}, {"start": "x"}, {"start": 3}, {"max_iterations": 1.5},
                                     {"locate_edges": 1}, {"tolerance": -1}, {"step": float("nan")}, {"coordinates": "x"}])
def test_bad_options(model, options):
    with pytest.raises((TypeError, ValueError), match="found"):
        ff.Simulation(model, **options)


@pytest.mark.filterwarnings("ignore:nanobind")
def test_what_is_no_simulation(sim):
    with pytest.raises(TypeError, match="save"):
        pickle.dumps(sim)
    with pytest.raises(TypeError, match="save"):
        copy.deepcopy(sim)
    for value in (None, 3, "iltis.yaml"):
        with pytest.raises(ff.InputError, match="expected a floatframe.Model"):
            ff.Simulation(value)

    class Half(ff.Simulation):
        def __init__(self):
            pass

    with pytest.raises(TypeError):
        Half().step()
    with pytest.raises(TypeError):
        ff.Simulation.__new__(ff.Simulation).step()
    with pytest.raises(ff.InputError):
        sim.restore(ff.SimulationState.__new__(ff.SimulationState))
