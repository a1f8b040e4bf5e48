"""A script of a user that uses the whole interface passes `mypy --strict`."""

import os
import pathlib
import subprocess
import sys

import floatframe as ff
import pytest

SCRIPT = '''
import numpy as np
import numpy.typing as npt
import floatframe as ff

Array = npt.NDArray[np.float64]

model: ff.Model = ff.Model.load(ff.example("iltis"), speed=10)
filled = ff.Model("pendulum", folder=".")
filled.points.add("hinge", [0, 0, 0])
filled.simulation.update(step=1e-3)
text: str = filled.to_yaml()
exported: ff.FmuReport = ff.export_fmu(model, "vehicle.fmu", fmi=3, outputs=["chassis"])
platforms: tuple[str, ...] = exported.platforms
copies = ff.Model.from_yaml(text), ff.Model.from_dict({"bodies": {}})

filled.bodies.add("lever", rigid={"mass": "${2 * m}", "centre_of_mass": [0.3, 0, 0]})
filled.bodies.add("bar", flexible={"file": "bar.inp", "units": "mm-t-s", "material": ff.Material(2e5, 0.3, 7.85e-9), "interfaces": {"A": ff.set("A")}})
filled.joints.revolute("hinge", child="lever", at="hinge", axis="y")
filled.joints.add("hold", type="weld", child="bar", child_node="A", when=True)
filled.forces.spring_damper("spring", from_={"body": "lever"}, to={"body": "ground"}, spring=1e4)
filled.outputs.add("tip", position={"body": "lever"}, axis="z")
filled.data["gravity"] = [0, 0, -1.62]
filled.name = "moon"
written: str = filled.save("moon.yaml")

result: ff.Result = ff.run(model, step=0.01, duration=1.0, progress=print, start="equilibrium", locate_edges=True)
z: Array = result["chassis.z"]
largest: float = float(z.max())
status: object = result.summary["status"]
folder: str = result.save("out")
again = ff.run(model, start=result.state)
loaded: ff.Result = ff.Result.load(folder, model=result.model)
names_of_files: list[str] = [loaded.to_mat("a.mat"), loaded.to_hdf5("a.h5"), loaded.to_parquet("a.parquet")]

sim = ff.Simulation(model, step=1e-3, coordinates="absolute", inertia="projection")
report: ff.StepReport = sim.step()
sim.step(2e-3)
sim.inputs["damper"] = 300.0
value: float = sim.outputs["chassis.z"] + sim.time + report.time


def controller(time: float, outputs: Array, inputs: Array) -> None:
    inputs[0] = -900.0 * outputs[0]


sim.on_step(controller)
sim.law("damper", lambda time, v: -900.0 * v, of=["chassis.z"])
saved: ff.SimulationState = sim.save()
sim.restore(ff.SimulationState.from_bytes(saved.to_bytes()))
state: ff.State = sim.state()
controlled = ff.run(model, on_step=lambda time, outputs, inputs: {"damper": -900.0 * float(outputs[0])}, period=1e-2)
recording: ff.Recording = sim.record(every=10, keep=1000)
recorded: ff.Result = recording.result()
sim.set(q={"knee": 0.5, "arm": [0.0, 1e-3]}, v={"knee": 1.0})
sim.change(speed=12)
sim.reset()
states: list[ff.StateName] = sim.states
lm = sim.linear_model(["damper"])
feedback: Array = lm.B.T @ sim.values([ff.StateName(*state) for state in lm.states])
x: Array = sim.x - sim.values(states)
said: list[str] = sim.warnings
category: type[Warning] = ff.RunWarning
position: Array = state.bodies["chassis"]["position"]
sim.restore(saved)

M = ff.linearize(model).M
a: Array = np.asarray(ff.linear_system(model).A)
frequencies: list[float] = [mode.frequency for mode in ff.modes(model)]
g: npt.NDArray[np.complex128] = ff.frequency_response(model, [1.0, 2.0], ["a"], ["b"])
A = ff.linear_model(model, ["a"], ["b"]).state_space().A
rms: float = ff.road_response(model, ["chassis.z"], np.linspace(1, 10, 5), speed=10.0).outputs[0].rms
line = ff.campbell(model, "motor", 0.0, 100.0, 10.0, axis=(0, 0, 1), orders=[1.0]).lines[0].eigenvalues
force = ff.statics(model).joints[0].force
mass: float = ff.mass_properties(model).mass
counts: int = ff.check(model).degrees_of_freedom
bodies = ff.advise(model).bodies, ff.model_order(model, below=30.0).bodies
names: list[str] = ff.linear_inputs(model)
road = ff.Road.of(model, "stairs"), ff.Road.read("block.crg", interpolation="cubic", border_u="none", begin="origin")
above: Array = road[0].height([1.0, 2.0], 0.5)
table = ff.sweep(model, speed=np.linspace(3, 8, 11), processes=4, measure=["chassis.z:max"], folder="study")
runs = ff.sweep(model, runs=[{"speed": 3}])

points: Array = np.zeros((8, 3))
mesh = ff.Mesh(points, [("hex8i", np.arange(8)[None])], {"END": points[:, 0] < 1e-6})
steel = ff.Material(2.1e11, 0.3, 7850.0)
places = {"A": ff.set("A"), "B": ff.plane([0, 0, 0], "x"), "C": ff.cylinder([0, 0, 0], "z", 1.0, dofs="xyz"), "D": ff.sphere([0, 0, 0], 1.0),
          "E": ff.nodes(points[:, 0] < 1e-6)}
marks = {"M": ff.nearest([0, 0, 0], residual=True), "N": ff.node(3)}
part: ff.Part = ff.reduce(mesh, material=steel, interfaces=places, markers=marks, modes=10, progress=True)
part.save("part.ffb")
own: Array = part.frequencies
heaviest: float = ff.read_body("part.ffb").invariants.m
shape: Array = part.mode_shapes
inertia, forces = part.body.inertia(np.eye(3), np.zeros(3), np.zeros(3), np.zeros(3), method="projection", coordinates="absolute")
body = ff.Body(ff.Invariants.rigid(1.0, [0, 0, 0], np.eye(3)))
p = ff.Projection(points, np.zeros((8, 3, 2)), np.eye(8))
k: Array = ff.Body(p.invariants(), K=np.eye(2), projection=p).K
summary: str = str(ff.info("part.ffb"))
converted: str = ff.convert("arm.bdf", "arm.inp", modes=0, contact="tied")
health: str = str(part.report)
version: str = ff.version() + ff.__version__ + ff.build_info()["version"] + ff.program()

try:
    ff.run(model)
except ff.UnknownNameError as unknown:
    print(unknown.errors[0].message)
except ff.InputError as error:
    for entry in error.errors:
        print(entry.file, entry.line + entry.column, entry.message)
except (ff.RunError, ff.OutputError):
    pass
except ff.StepError as failed:
    print(failed.status, failed.where, failed.time)
'''


@pytest.fixture(scope="module")
def cache(tmp_path_factory):
    """numpy and the package take half a minute, once."""
    return tmp_path_factory.mktemp("mypy")


def mypy(tmp_path, cache, text):
    pytest.importorskip("mypy")
    (tmp_path / "script.py").write_text(text)
    source = os.path.abspath(pathlib.Path(ff.__file__).parents[1])
    source = "" if source.endswith("-packages") else source  # mypy finds what is installed
    command = [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", "--cache-dir", str(cache), "script.py"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, env={**os.environ, "MYPYPATH": source})
    return done.stdout + done.stderr


def test_a_script_of_a_user(tmp_path, cache):
    text = mypy(tmp_path, cache, SCRIPT)
    assert "Success" in text, text
    missing = [name for name in ff.__all__ if f"ff.{name}" not in SCRIPT]
    assert set(missing) <= {"BeamSection", "Error", "ErrorEntry", "FileInfo", "Node", "Options", "Place", "Report", "set"}, missing


def test_mistakes_are_found(tmp_path, cache):
    assert "arg-type" in mypy(tmp_path, cache, "import floatframe as ff\nff.run(3)\n")


MISSPELT = [
    ('model.joints.revolute("j", chld="b", axis="y")', "call-arg"),
    ('model.joints.hinge("j", child="b")', "attr-defined"),
    ('model.joints.add("j", type="weld", chld="b")', "call-arg"),
    ('model.forces.spring_damper("s", sprng=1.0)', "call-arg"),
    ('model.bodies.add("b", rigd={"mass": 1.0})', "call-arg"),
    ('model.bodies.add("b", rigid={"mas": 1.0})', "arg-type"),
    ('model.bodies.add("b", flexible={"file": "x", "unit": "mm-t-s"})', "arg-type"),
    ('model.simulation.update(stepp=1e-3)', "call-arg"),
    ('model.bodys.add("b")', "attr-defined"),
]


def test_misspelt_keys_are_found(tmp_path, cache):
    lines = ["import floatframe as ff", "model = ff.Model()", *(line for line, _ in MISSPELT)]
    told = mypy(tmp_path, cache, "\n".join(lines) + "\n").splitlines()
    for number, (line, code) in enumerate(MISSPELT, start=3):
        found = [text for text in told if text.startswith(f"script.py:{number}: error")]
        assert found and any(f"[{code}]" in text for text in found), (line, told)
