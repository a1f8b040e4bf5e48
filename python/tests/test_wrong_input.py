"""Whatever is wrong with what is given is an InputError, in words of Python."""

import floatframe as ff
import numpy as np
import pytest
from blocks import ENDS, QUICK, mesh

STEP = {"vary": {"simulation.step": [1e-3]}}
NAN = float("nan")


@pytest.fixture(scope="module")
def model():
    return ff.Model.load(ff.example("active_damper"))


@pytest.fixture(scope="module")
def rotor():
    return ff.Model.load(ff.example("rotor"))


def refused(call, words=""):
    with pytest.raises(ff.InputError) as caught:
        call()
    assert isinstance(caught.value, ValueError) and words in str(caught.value)
    assert "--" not in str(caught.value) and "runs.csv" not in str(caught.value)
    return caught.value


@pytest.mark.parametrize("options", [{"coordinates": "abs"}, {"coordinates": 3}, {"inertia": "x"}, {"start": 3}, {"start": "x"}, {"step": "x"}, {"step": True},
                                     {"step": np.bool_(True)}, {"duration": "x"}, {"duration": True}, {"duration": NAN}, {"max_iterations": 1.5},
                                     {"max_iterations": 10**30}, {"locate_edges": 1}, {"locate_edges": "x"}, {"progress": "x"}, {"progress": 1},
                                     {"tolerance": []}])
def test_options_of_runs(model, options):
    refused(lambda: ff.run(model, **{"duration": 0.01, **options}), "found")


def test_truth_values_of_numpy(model):
    for word in (np.True_, np.False_, True):
        assert ff.run(model, duration=0.01, locate_edges=word).summary["status"] == "completed"


def test_wrong_keywords_are_those_of_python(model):
    for call in (lambda: ff.run(model, stp=1), lambda: ff.modes(model, stp=1), lambda: ff.Simulation(model, stp=1), lambda: ff.advise(model, stp=1)):
        with pytest.raises(TypeError, match="stp"):
            call()


@pytest.mark.parametrize("call, words", [
    (lambda: ff.Model.load(3), "path: found int"), (lambda: ff.Model.load("a\0"), "path"), (lambda: ff.Model(folder=3), "folder: found int"),
    (lambda: ff.Model(folder="a\0"), "folder"), (lambda: ff.Model.load(ff.example("iltis"), speed="a b"), "iltis.yaml: speed: found 'a b'"),
    (lambda: ff.Model.load(ff.example("iltis"), speeed=3), "unknown parameter 'speeed', did you mean 'speed'?"),
    (lambda: ff.Model.load(ff.example("iltis"), speed=[1]), "found list"), (lambda: ff.example(3), "found int"), (lambda: ff.State.load(3), "path: found 3"),
    (lambda: ff.SimulationState.from_bytes(3), "data: found int"), (lambda: ff.statics(None), "expected a floatframe.Model"),
])
def test_models(call, words):
    refused(call, words)


@pytest.mark.parametrize("text", ["s.step('x')", "s.step(True)", "s.step(s)", "s.on_step(3)", "s.law('front_left', 3)", "s.law('front_left', lambda t: 0, of=[3])",
                                  "s.law('front_left', lambda t: 0, of=3)", "s.restore(3)", "s.inputs.__setitem__('front_left', 'x')",
                                  "s.inputs.__setitem__('front_left', True)", "s.inputs.__setitem__(3, 1.0)", "s.outputs[3]",
                                  "(s.law('front_left', lambda t: 'x'), s.step())"])
def test_simulations(model, text):
    refused(lambda: eval(text, {"s": ff.Simulation(model, step=1e-3)}), "expected")


@pytest.mark.parametrize("text", ["s.inputs['nope']", "s.inputs.__setitem__('nope', 1.0)", "s.outputs['nope']", "s.law('nope', None)",
                                  "s.law('front_left', abs, of='nope')", "ff.run(s.model, duration=0.01)['nope']", "ff.Model().bodies['nope']"])
def test_unknown_names_are_key_errors_too(model, text):
    error = refused(lambda: eval(text, {"s": ff.Simulation(model, step=1e-3), "ff": ff}), "found no ")
    assert isinstance(error, KeyError) and isinstance(error, ff.UnknownNameError) and error.errors[0].message == str(error)


@pytest.mark.parametrize("options, words", [
    ({"folder": "a\0"}, "folder"), ({"folder": 3}, "folder"), ({"processes": -1}, "processes: found -1"), ({"processes": 2.5}, "processes: found 2.5"),
    ({"case_timeout": -1}, "case_timeout: found -1"), ({"duration": -1}, "duration: found -1"), ({"step": "x"}, "step: found 'x'"),
    ({"coordinates": "abs"}, "coordinates: found 'abs'"), ({"measure": "nope"}, "measure: "), ({"measure": 3}, "measure: found 3"),
    ({"vary": {"simulation.step": np.zeros((2, 2))}}, "found"), ({"vary": {"simulation.step": [-1]}}, "run 1: step: found '-1'"),
    ({"vary": {"nope": [1]}}, "'nope' is neither"), ({"vary": 3}, "vary: found int"), ({"vary": {3: [1]}}, "vary: found the name 3"),
    ({"vary": None, "runs": 3}, "runs: found int"), ({"vary": None, "runs": [3]}, "runs: found 3"),
])
def test_studies(model, options, words):
    refused(lambda: ff.sweep(model, **{**STEP, **options}), words)


def test_values_of_studies():
    model = ff.Model.load(ff.example("iltis"))
    error = refused(lambda: ff.sweep(model, speed=[3, "a"]), "run 2: speed: found 'a', expected a number")
    assert error.errors[0].file == ff.example("iltis")


@pytest.mark.parametrize("text", ["ff.linear_model(m, inputs=3)", "ff.linear_model(m, inputs=['nope'])", "ff.linear_model(m, outputs=[3])",
                                  "ff.frequency_response(m, 'x')", "ff.frequency_response(m, [[1.0, 2.0]])", "ff.frequency_response(m, [1j])",
                                  "ff.road_response(m, ['chassis.az'], [1.0], speed='x')", "ff.road_response(m, ['chassis.az'], [1.0], speed=1.0, band=3)",
                                  "ff.road_response(m, ['chassis.az'], [1.0], speed=1.0, band=(1, 'x'))", "ff.campbell(r, 'nope', 0, 1, 1)",
                                  "ff.campbell(r, 3, 0, 1, 1)", "ff.campbell(r, 'motor', 'a', 1, 1)", "ff.campbell(r, 'motor', 0, 100, 50, axis=(1, 2))",
                                  "ff.campbell(r, 'motor', 0, 100, -50)", "ff.campbell(r, 'motor', 0, 100, 50, axis='abc')",
                                  "ff.campbell(r, 'motor', 0, 100, 50, orders='x')", "ff.campbell(r, 'motor', 0, 100, 50, orders=3)",
                                  "ff.campbell(r, 'motor', 0, 100, 50, modes='x')", "ff.campbell(r, 'motor', 0, 100, 50, modes=10**30)",
                                  "ff.advise(m, repeat='x')", "ff.advise(m, tolerance='x')", "ff.advise(m, drop_share=float('nan'))",
                                  "ff.model_order(m, 'x')", "ff.model_order(m, -1)", "ff.modes(m, start='x')", "ff.check(3)"])
def test_analyses(model, rotor, text):
    refused(lambda: eval(text, {"m": model, "r": rotor, "ff": ff}))


def test_one_name_is_a_list_of_one(model):
    assert ff.linear_model(model, "front_left", "chassis.az").inputs == ["front_left"]


PENDULUM = """floatframe: 1
points: {o: [0, 0, 0], a: [1, 0, 0]}
bodies:
  arm: {rigid: {mass: 1, inertia: [1, 1, 1]}, position: a}
joints:
  pin: {type: revolute, child: arm, at: o, axis: y}
simulation: {step: 0.001, duration: 0.01}
"""


def test_code_and_path_say_what_and_where(tmp_path):
    file = tmp_path / "pendulum.yaml"
    file.write_text(PENDULUM.replace("mass: 1", "mass: -1").replace("child: arm", "child: arms").replace("axis: y", "axis: y, colour: red"))
    found = {(error.line, error.path, error.code) for error in refused(lambda: ff.Model.load(file)).errors}
    assert found == {(4, "bodies.arm.rigid.mass", "out_of_range"), (6, "joints.pin.child", "not_found"), (6, "joints.pin.colour", "unknown_key")}


def test_a_start_that_cannot_be_has_a_code(tmp_path):
    file = tmp_path / "falls.yaml"
    file.write_text(PENDULUM.replace("revolute", "prismatic").replace("axis: y", "axis: z"))
    with pytest.raises(ff.RunError) as caught:
        ff.statics(ff.Model.load(file))
    assert caught.value.code == "no_equilibrium"


def test_parts_beyond_all_numbers():
    error = refused(lambda: ff.reduce(mesh(), **{**QUICK, "material": ff.Material(1e308, 0.3, 7850.0), "interfaces": ENDS}), "not finite")
    assert error.errors[0].file == "Mesh"


def test_results(model):
    res = ff.run(model, duration=0.01)
    refused(lambda: res.save(3), "folder: found int")
    refused(lambda: res.save("a\0"), "folder: found")
