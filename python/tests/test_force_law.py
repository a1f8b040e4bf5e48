"""Functions of Python as forces that are evaluated in every iteration."""

import copy
import pickle
import threading

import pytest

import floatframe as ff


def hertz(z, v, t):
    return -1e7 * max(0.0, -0.5 - z) ** 1.5


def hertz_slopes(z, v, t):
    d = max(0.0, -0.5 - z)
    return -1e7 * d**1.5, 1.5e7 * d**0.5, 0.0


def ball(law, **places):
    model = ff.Model("ball")
    model.points.add("c", [0, 0, 0.5])
    model.bodies.add("ball", rigid={"mass": 1, "centre_of_mass": "c", "inertia": [1e-3] * 3})
    model.joints.add("z", type="prismatic", child="ball", at="c", axis="z")
    model.forces.add("contact", type="force_law", law=law, **(places or {"joint": "z"}))
    model.outputs.add("z", joint_position="z")
    model.outputs.add("f", force="contact")
    model.simulation.update(step=1e-3, duration=1)
    return model


@pytest.mark.parametrize("law", [hertz, hertz_slopes])
def test_a_contact_keeps_its_energy(law):
    result = ff.run(ball(law))
    assert result["z"][result.time > 0.4].max() == pytest.approx(0.0, abs=3.5e-4)  # 0.0003 m, rounded
    assert not result.summary["warnings"]
    sim = ff.Simulation(ball(law))
    for z in result["z"][1:]:
        sim.step()
        assert sim.outputs["z"] == z


def test_it_is_the_spring_of_its_polynomial():
    table = ball(hertz)
    del table.forces["contact"]
    table.forces.add("contact", type="spring_damper", from_={"body": "ground", "at": [0, 0, 3]}, to={"body": "ball", "at": "c"}, spring=40, damper=3)
    law = ball(lambda x, v, t: (40 * (x - 2.5) + 3 * v, 40.0, 3.0), from_={"body": "ground", "at": [0, 0, 3]}, to={"body": "ball", "at": "c"})
    assert ff.run(law)["z"] == pytest.approx(ff.run(table)["z"], abs=1e-12)
    a, b = ff.linear_system(law).A, ff.linear_system(table).A
    assert a == pytest.approx(b, abs=1e-9)


def test_what_it_raises_is_the_cause():
    broken = False

    def law(z, v, t):
        if broken:
            raise ZeroDivisionError("no more")
        return -10 * z

    model = ball(law)
    sim = ff.Simulation(model)
    sim.step()
    saved, z = sim.save(), sim.outputs["z"]
    broken = True
    with pytest.raises(ff.StepError, match="the law of 'contact' threw an exception at t = 0.001 s: ZeroDivisionError: no more") as error:
        sim.step()
    assert isinstance(error.value.__cause__, ZeroDivisionError)
    assert (error.value.status, error.value.where) == ("law_failed", "force 'contact'")
    assert (sim.time, sim.outputs["z"]) == (0.001, z)
    for start in (lambda: ff.Simulation(model), lambda: ff.run(model), lambda: ff.statics(model)):
        with pytest.raises(ff.RunError, match="ZeroDivisionError: no more") as error:
            start()
        assert isinstance(error.value.__cause__, ZeroDivisionError)
    broken = False
    sim.restore(saved)
    sim.step()


def test_what_it_raises_ends_a_run():
    def law(z, v, t):
        if t > 0.1:
            raise KeyError("z")
        return 0.0

    with pytest.raises(ff.RunError, match="KeyError: 'z'") as error:
        ff.run(ball(law))
    assert isinstance(error.value.__cause__, KeyError)


def test_interrupts_come_through():
    def law(z, v, t):
        if t > 0.01:
            raise KeyboardInterrupt
        return 0.0

    sim = ff.Simulation(ball(law))
    with pytest.raises(KeyboardInterrupt):
        for _ in range(20):
            sim.step()


@pytest.mark.parametrize("value", ["much", None, (1.0, 2.0), [1.0, 2.0, 3.0]])
def test_wrong_values_are_refused(value):
    with pytest.raises(ff.RunError, match="law of 'contact'.*found .*expected a number, or three"):
        ff.Simulation(ball(lambda z, v, t: value))


def test_a_force_that_is_no_number_is_named():
    sim = ff.Simulation(ball(lambda z, v, t: float("nan") if t > 0.01 else 0.0))
    with pytest.raises(ff.StepError, match="'contact'"):
        for _ in range(20):
            sim.step()
    with pytest.raises(ff.RunError, match="contact"):
        ff.Simulation(ball(lambda z, v, t: float("nan")))


def test_threads_step_side_by_side():
    model = ball(hertz_slopes)
    expected = list(ff.run(model)["z"][1:])
    found = [[] for _ in range(4)]

    def step(values):
        sim = ff.Simulation(model)
        for _ in range(1000):
            sim.step()
            values.append(sim.outputs["z"])

    threads = [threading.Thread(target=step, args=(values,)) for values in found]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert all(values == expected for values in found)


def test_files_and_other_processes_refuse_it(tmp_path):
    model = ball(hertz)
    text = model.to_yaml()
    assert "law: hertz" in text
    with pytest.raises(ff.InputError, match="hertz") as error:
        ff.Model.from_yaml(text)
    assert [(e.path, e.code) for e in error.value.errors] == [("forces.contact.law", "unsupported")]
    table = ff.sweep(model, vary={"simulation.step": [1e-3, 2e-3]})  # in this process
    assert list(table["status"]) == ["completed"] * 2
    with pytest.raises((AttributeError, pickle.PicklingError)):
        pickle.dumps(ball(lambda z, v, t: 0.0))
    folder = ff.run(model).save(tmp_path / "run")
    assert (tmp_path / "run" / "results.csv").exists(), folder
    with pytest.raises(ff.InputError, match="function"):
        model.bodies.add("other", rigid=hertz)
    assert ff.run(copy.copy(model), duration=0.01)["z"][-1] < 0.0


def test_states_belong_to_the_function_or_its_label():
    def labelled(label, k):
        def law(z, v, t):
            return k * z

        law.label = label
        return law

    def saved(law):
        sim = ff.Simulation(ball(law))
        sim.step()
        return sim.save()

    ff.Simulation(ball(labelled("a", 1.0))).restore(saved(labelled("a", 1.0)))
    for law in (labelled("b", 1.0), hertz):
        with pytest.raises(ff.InputError):
            ff.Simulation(ball(law)).restore(saved(labelled("a", 1.0)))
    with pytest.raises(ff.InputError):
        ff.Simulation(ball(hertz)).restore(saved(hertz))
