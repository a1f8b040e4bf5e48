"""Files of the program as NumPy and SciPy read them; the standard library reads them in tests/cli."""

import json
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest

import floatframe as ff

ROOT = Path(__file__).resolve().parents[2]


def run(folder, *arguments):
    subprocess.run([ff.program(), *arguments], cwd=folder, check=True, capture_output=True)


def model_of(name):
    """MODEL of a script of tests/cli, which is not run."""
    text = (ROOT / "tests/cli" / name).read_text(encoding="utf-8")
    return eval(re.search(r'^MODEL = ("""\\\n.*?""")$', text, re.M | re.S)[1])


def test_linear_systems(tmp_path):
    (tmp_path / "m.yaml").write_text(model_of("linearize_test.py"), encoding="utf-8")
    run(tmp_path, "linearize", "m.yaml", "--npz", "s.npz", "--mat", "s.mat")
    arrays = np.load(tmp_path / "s.npz")
    assert arrays["A"].shape == (4, 4) and arrays["inputs"][0] == "torque"
    io = pytest.importorskip("scipy.io")
    matlab = io.loadmat(tmp_path / "s.mat", uint16_codec="utf-16-le")  # needed for units beyond ASCII only
    for name in arrays.files:
        if arrays[name].dtype.kind == "U":
            assert [str(x[0]) for x in matlab[name].ravel()] == list(arrays[name])
        else:
            assert (matlab[name].ravel() == arrays[name].ravel()).all(), name


def test_motion(tmp_path):
    (tmp_path / "m.yaml").write_text(model_of("run_case.py"), encoding="utf-8")
    run(tmp_path, "run", "m.yaml", "--out", "out", "--set", "duration=0.05", "--quiet")
    run(tmp_path, "export", "out", "--npz", "m.npz")
    with np.load(tmp_path / "m.npz") as loaded:
        assert loaded["beam/node_positions"].shape[0] == loaded["time"].size == 51


def test_states_as_the_page_reads_them(tmp_path):
    (tmp_path / "m.yaml").write_text(model_of("run_case.py"), encoding="utf-8")
    run(tmp_path, "run", "m.yaml", "--out", "out", "--set", "duration=0.05", "--quiet")
    page = (ROOT / "docs/result-file.md").read_text(encoding="utf-8")
    names = {}
    for block in re.findall(r"```python\n(.*?)```", page, re.S):
        if "def " in block:
            exec(block, names)
    header, arrays, rows, end = names["read_states"](tmp_path / "out/states.ffr")
    assert end["status"] == "completed"
    table = np.loadtxt(tmp_path / "out/results.csv", delimiter=",", skiprows=1)
    summary = json.loads((tmp_path / "out/summary.json").read_text())
    health = names["health"](header, rows)
    assert health["iterations"].sum() == summary["iterations"]
    assert health["position_violation"].max() == summary["max_position_violation"]
    assert health["remainder"][-1] == pytest.approx(summary["energy"]["balance"]["remainder_J"], abs=1e-9)
    assert 0 < health["beam.displacement"].max()
    tip = header["shapes"][header["bodies"][3]["shape"]]["nodes"].index("tip")
    places = names["positions"](header, arrays, rows, "beam")
    assert np.abs(places[:, tip] - table[:, 4:7]).max() < 1e-12


PLANT = """\
floatframe: 1
bodies: {box: {position: [0, 0, 0], rigid: {mass: 1}}}
joints: {slide: {type: prismatic, child: box, at: [0, 0, 0], axis: x}}
controllers: {plant: {type: state_space, file: FILE, inputs: [3], initial: rest}}
outputs: {y: {controller: plant, output: 2}}
simulation: {step: 1.0e-3, duration: 0.01}
"""


@pytest.mark.parametrize("file", ["s.npz", "s.mat", "packed.mat"])
def test_linear_systems_of_others(tmp_path, file):
    """At rest y = -C A^-1 B u; whole numbers and columns first as others may write them."""
    system = {"A": np.array([[-1.0, 2.0], [0.0, -4.0]], order="F"), "B": np.array([[1], [8]]), "C": np.eye(2)}
    if file == "s.npz":
        np.savez(tmp_path / file, **system)
    else:
        pytest.importorskip("scipy.io").savemat(tmp_path / file, system, do_compression=file == "packed.mat")
    (tmp_path / "m.yaml").write_text(PLANT.replace("FILE", file))
    run(tmp_path, "run", "m.yaml", "--out", "out", "--quiet", "--no-report")
    table = np.loadtxt(tmp_path / "out/results.csv", delimiter=",", skiprows=1)
    assert np.abs(table[:, 1] - 6.0).max() < 1e-12
