"""Whatever Python passes in: a result or an exception, never a crash. A crash ends the tests."""

import copy
import gc
import pickle
import subprocess
import sys

import floatframe as ff
import numpy as np
import pytest


class Liar:
    """Numbers, lengths and items that fail."""

    def __float__(self):
        raise ZeroDivisionError

    __index__ = __len__ = __iter__ = __float__

    def __getitem__(self, key):
        raise ZeroDivisionError


JUNK = [None, True, 0, -1, 10**30, float("nan"), float("inf"), -1e308, 1j, "", "x", "\0", "\ud800", "a" * 100000, b"x", bytearray(8), [], [1, "x"],
        (), {}, {"a": 1}, set(), range(3), object(), object, len, lambda *a: None, lambda: 1 / 0, Liar(), np.float32(3), np.nan, np.array([]),
        np.zeros((2, 2)), np.zeros(3, dtype=complex), np.array(["x"]), np.zeros(4, dtype=">f8"), np.arange(9)[::-2], np.array(None), ff, ff.Model,
        ff.State, ff.Model.__new__(ff.Model), ff.Simulation.__new__(ff.Simulation), ff.State.__new__(ff.State)]


@pytest.fixture(scope="module")
def model():
    return ff.Model.load(ff.example("active_damper"))


@pytest.fixture
def sim(model):
    return ff.Simulation(model, step=1e-3)


def fails_or_not(call):
    try:
        call()
    except Exception:
        pass


CALLS = {
    "load": lambda m, s, j: ff.Model.load(j),
    "load parameter": lambda m, s, j: ff.Model.load(ff.example("iltis"), speed=j),
    "from_yaml": lambda m, s, j: ff.Model.from_yaml(j),
    "from_dict": lambda m, s, j: ff.Model.from_dict(j),
    "from_dict bodies": lambda m, s, j: ff.Model.from_dict({"bodies": j}),
    "from_dict mass": lambda m, s, j: ff.Model.from_dict({"bodies": {"a": {"rigid": {"mass": j}}}}),
    "from_dict folder": lambda m, s, j: ff.Model.from_dict({"bodies": {}}, folder=j),
    "add": lambda m, s, j: ff.Model().bodies.add(j, rigid=j),
    "core": lambda m, s, j: ff.Model(j).core,
    "run": lambda m, s, j: ff.run(j),
    "run step": lambda m, s, j: ff.run(m, step=j, duration=0.01),
    "run tolerance": lambda m, s, j: ff.run(m, tolerance=j, duration=0.01),
    "run iterations": lambda m, s, j: ff.run(m, max_iterations=j, duration=0.01),
    "run coordinates": lambda m, s, j: ff.run(m, coordinates=j, duration=0.01),
    "run start": lambda m, s, j: ff.run(m, start=j, duration=0.01),
    "run edges": lambda m, s, j: ff.run(m, locate_edges=j, duration=0.01),
    "run progress": lambda m, s, j: ff.run(m, progress=j, duration=0.01),
    "step": lambda m, s, j: s.step(j),
    "input": lambda m, s, j: s.inputs.__setitem__(j, 1.0),
    "input value": lambda m, s, j: s.inputs.__setitem__("front_left", j),
    "output": lambda m, s, j: s.outputs[j],
    "restore": lambda m, s, j: s.restore(j),
    "on_step": lambda m, s, j: (s.on_step(j), s.step()),
    "on_step value": lambda m, s, j: (s.on_step(lambda t, o, i: i.__setitem__(0, j)), s.step()),
    "law input": lambda m, s, j: s.law(j, lambda t: 0.0),
    "law": lambda m, s, j: (s.law("front_left", j), s.step()),
    "law value": lambda m, s, j: (s.law("front_left", lambda t: j), s.step()),
    "law of": lambda m, s, j: s.law("front_left", lambda *a: 0.0, of=j),
    "from_bytes": lambda m, s, j: ff.SimulationState.from_bytes(j),
    "setstate": lambda m, s, j: s.save().__setstate__(j),
    "state load": lambda m, s, j: ff.State.load(j),
    "check": lambda m, s, j: ff.check(j),
    "modes": lambda m, s, j: ff.modes(m, start=j),
    "linear_model": lambda m, s, j: ff.linear_model(m, inputs=j),
    "response": lambda m, s, j: ff.frequency_response(m, j, ["front_left"], ["chassis.az"]),
    "campbell": lambda m, s, j: ff.campbell(m, j, j, j, j, axis=j, orders=j, modes=j),
    "road speed": lambda m, s, j: ff.road_response(m, ["chassis.az"], [1.0], speed=j),
    "road band": lambda m, s, j: ff.road_response(m, ["chassis.az"], [1.0], speed=10.0, band=j),
    "order": lambda m, s, j: ff.model_order(m, below=j) if not isinstance(j, (int, float)) or not j < 1e9 else None,
    "sweep": lambda m, s, j: ff.sweep(m, nowhere=j),
    "example": lambda m, s, j: ff.example(j),
    "error": lambda m, s, j: str(ff.InputError(j)),
}


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("name", CALLS)
def test_junk(model, sim, name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for junk in JUNK:
        fails_or_not(lambda: CALLS[name](model, sim, junk))
    gc.collect()


@pytest.mark.filterwarnings("ignore")
def test_results_are_read_only_objects(model):
    linear = ff.linearize(model)
    for name in dir(linear):
        if not name.startswith("_"):
            with pytest.raises(AttributeError):
                setattr(linear, name, None)
    for copied in (copy.copy, copy.deepcopy, lambda x: pickle.loads(pickle.dumps(x))):
        for thing in (linear, ff.check(model), ff.run(model, duration=0.01), model.core):
            fails_or_not(lambda: copied(thing))
        assert np.array_equal(ff.run(copied(model), duration=0.01).table, ff.run(model, duration=0.01).table)
    for kind in (type(linear), type(ff.check(model)), type(model.core), ff.StepReport):
        fails_or_not(lambda: kind())
        fails_or_not(lambda: [getattr(kind.__new__(kind), n) for n in dir(kind)])


def test_bytes_with_one_bit_changed(sim):
    sim.step()
    data = sim.save().to_bytes()
    for place in range(0, len(data), max(1, len(data) // 200)):
        changed = bytearray(data)
        changed[place] ^= 0x10
        with pytest.raises(ff.InputError):
            sim.restore(ff.SimulationState.from_bytes(bytes(changed)))
    for length in (0, 1, 7, 8, 20, len(data) - 1):
        with pytest.raises(ff.InputError):
            ff.SimulationState.from_bytes(data[:length])
    sim.step()


def test_durations_beyond_memory(model):
    for duration in (1e15, 1e18, 1e300):
        with pytest.raises((ff.Error, ValueError, MemoryError)):
            ff.run(model, step=1e-3, duration=duration)


IN_A_PROCESS = {
    "failed start in a cycle": """
class Env(ff.Simulation):
    def __init__(self, path):
        self.reward = self.compute
        super().__init__(ff.Model.load(path), step=1e-3)
    def compute(self): return 0.0
try: Env("missing.yaml")
except ff.InputError: pass
gc.collect()""",
    "never started, in a cycle": """
s = ff.Simulation.__new__(ff.Simulation)
s.me = s
del s
gc.collect()""",
    "arrays of on_step are emptied": """
s = ff.Simulation(ff.Model.load(ff.example("active_damper")), step=1e-3)
before = dict(s.inputs)
s.on_step(lambda t, o, i: (o.__setstate__((1, (0,), np.dtype("f8"), False, b"")), i.__setstate__((1, (0,), np.dtype("f8"), False, b""))) and None)
for _ in range(100): s.step()
assert dict(s.inputs) == before
seen = []
s.on_step(lambda t, o, i: seen.append((o.size, i.size)))
s.step()
assert seen == [(len(s.outputs), len(s.inputs))]""",
    "a daemon thread steps at the end": """
s = ff.Simulation(ff.Model.load(ff.example("active_damper")), step=1e-3)
def work():
    while True: s.step()
threading.Thread(target=work, daemon=True).start()
time.sleep(0.2)""",
    "a daemon thread is called back at the end": """
s = ff.Simulation(ff.Model.load(ff.example("active_damper")), step=1e-3)
s.on_step(lambda t, o, i: None)
def work():
    while True: s.step()
threading.Thread(target=work, daemon=True).start()
time.sleep(0.2)""",
    "a daemon thread runs at the end": """
def work():
    while True: ff.run(ff.Model.load(ff.example("iltis")))
threading.Thread(target=work, daemon=True).start()
time.sleep(0.2)""",
    "a daemon thread analyses at the end": """
m = ff.Model.load(ff.example("iltis"))
def work():
    while True: ff.statics(m), ff.modes(m)
threading.Thread(target=work, daemon=True).start()
time.sleep(0.2)""",
}


@pytest.mark.parametrize("name", IN_A_PROCESS)
def test_the_interpreter_ends_well(name):
    head = "import gc, threading, time\nimport numpy as np\nimport floatframe as ff\n"
    done = subprocess.run([sys.executable, "-B", "-c", head + IN_A_PROCESS[name]], capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stderr) == (0, "")
