"""FMUs: what FMPy 0.3.32 says of them - schemas, names, units, structure - and runs by FMPy against those of the package."""

import re
import struct
import subprocess
import zipfile

import floatframe as ff
import numpy as np
import pytest

fmpy = pytest.importorskip("fmpy")

# Names, units and texts that XML, the grammar of names and FMI allow only in another form.
HOSTILE = """\
floatframe: 1
name: "a <model> & 'more'"
parameters: {mass: 2, stiffness: 300}
bodies:
  block: {rigid: {mass: "${mass}", centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}
joints:
  slide: {type: prismatic, child: block, at: [0, 0, 0], axis: x, position: 0.1}
inputs:
  push: {unit: N, min: -5, max: 5, initial: 1}
  odd: {unit: "furlong & <more>"}
  kmh: {unit: km/h}
forces:
  coil: {type: joint_spring, joint: slide, spring: "${stiffness}", actuator: {input: push}}
outputs:
  x: {joint_position: slide}
  push: {joint_velocity: slide}
  "a b.c": {position: block, axis: x, unit: mm}
  "größe ' <b>": {joint_position: slide}
  "1st": {joint_position: slide}
  "der(x)": {joint_velocity: slide}
  stiffness: {joint_position: slide}
simulation: {step: 0.001, duration: 0.1}
"""


@pytest.fixture(scope="module")
def write(tmp_path_factory):
    """Writes a model as an FMU by the command; returns the file and what was printed."""
    folder = tmp_path_factory.mktemp("fmu")

    def run(text, version, *options):
        model, out = folder / "model.yaml", folder / f"out{version}.fmu"
        model.write_text(text, encoding="utf-8")
        command = [ff.program(), "fmu", str(model), "-o", str(out), "--fmi", str(version), *options]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if "the runtime of FMUs" in done.stderr:
            pytest.skip("built without the runtime of FMUs")
        assert done.returncode == 0, done.stderr
        return str(out), done.stdout + done.stderr

    return run


@pytest.mark.parametrize("version", [2, 3])
def test_fmpy_finds_no_problem(write, version):
    from fmpy.validation import validate_fmu

    assert validate_fmu(write(HOSTILE, version)[0]) == []


@pytest.mark.parametrize("version", [2, 3])
def test_names_units_and_limits(write, version):
    file, said = write(HOSTILE, version)
    description = fmpy.read_model_description(file, validate=True)
    by_name = {v.name: v for v in description.modelVariables}
    assert by_name["push"].causality == "input" and (by_name["push"].min, by_name["push"].max) == ("-5", "5")
    assert by_name["outputs.push"].causality == "output"
    assert by_name["odd"].unit == "furlong & <more>"
    assert by_name["'gr{U+00F6}{U+00DF}e \\' <b>'"].valueReference == 0x20003
    assert by_name["'1st'"].unit == "m"
    assert by_name["'der(x)'"].unit == "m/s"
    assert by_name["parameters.stiffness"].causality == "parameter" or "stiffness" in said
    assert by_name["'a b'.c"].unit == "mm"
    assert "outputs.push" in said and "U+00F6" in said
    units = {u.name: u.baseUnit for u in description.unitDefinitions}
    assert units["furlong & <more>"] is None
    assert units["km/h"].factor == pytest.approx(1 / 3.6, rel=1e-15) and (units["km/h"].m, units["km/h"].s) == (1, -1)
    assert float(description.defaultExperiment.stepSize) == 0.001


def test_a_packed_model_keeps_its_parameters(write, tmp_path):
    write(HOSTILE, 2)  # or this is skipped
    model, packed = tmp_path / "model.yaml", tmp_path / "model.ffm"
    model.write_text(HOSTILE, encoding="utf-8")
    subprocess.run([ff.program(), "pack", str(model), "-o", str(packed), "--quiet"], capture_output=True, check=True)
    report = ff.export_fmu(ff.Model.load(packed), tmp_path / "packed.fmu")
    assert report.parameters == ff.export_fmu(ff.Model.load(model), tmp_path / "model.fmu").parameters == 2
    with pytest.raises(ff.InputError, match="model.ffm"):
        ff.export_fmu(ff.Model.load(packed, mass=3), tmp_path / "packed.fmu")


def test_terminals_follow_the_schema(write):
    lxml = pytest.importorskip("lxml.etree")
    import pathlib

    with zipfile.ZipFile(write(HOSTILE, 3)[0]) as archive:
        document = lxml.fromstring(archive.read("terminalsAndIcons/terminalsAndIcons.xml"))
    schema = lxml.XMLSchema(file=str(pathlib.Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3TerminalsAndIcons.xsd"))
    schema.assertValid(document)
    assert [t.get("name") for t in document.iter("Terminal")] == ["inputs", "outputs"]


@pytest.mark.parametrize("version", [2, 3])
def test_the_archive(write, version):
    file = write(HOSTILE, version)[0]
    with open(file, "rb") as first:
        before = first.read()
    with open(write(HOSTILE, version)[0], "rb") as second:
        assert second.read() == before  # equal models, equal files
    with zipfile.ZipFile(file) as archive:
        assert archive.testzip() is None
        names = archive.namelist()
        icon = archive.read("model.png" if version == 2 else "terminalsAndIcons/icon.png")
        page = archive.read("documentation/index.html").decode()
        assert {i.date_time for i in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}
    folder = "linux64" if version == 2 else "x86_64-linux"
    assert f"binaries/{folder}/a__model_____more_.so" in names
    assert {"modelDescription.xml", "resources/model.ffm", "documentation/licenses/license.txt"} < set(names)
    assert icon[:8] == b"\x89PNG\r\n\x1a\n" and struct.unpack(">II", icon[16:24]) == (128, 128)
    assert "stiffness" in page and not re.search(r"<(script|link|img)|href=|<b>", page)


@pytest.mark.parametrize("version", [2, 3])
def test_a_run_is_that_of_the_package(write, version):
    model = ff.Model.load(ff.example("quarter_car"))
    with open(ff.example("quarter_car"), encoding="utf-8") as file:
        text = file.read()
    result = fmpy.simulate_fmu(write(text, version)[0], stop_time=0.2, output_interval=0.005)
    run = ff.run(model, duration=0.2)
    for name in run:
        if name != "time":
            assert np.array_equal(result[name][: len(run.time)], run[name]), name


PACED = """\
floatframe: 1
name: paced
parameters: {pace: 0.01, stiffness: 300}
bodies:
  block: {rigid: {mass: 2, centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}
joints:
  slide: {type: prismatic, child: block, at: [0, 0, 0], axis: x, position: 0.1}
forces:
  coil: {type: joint_spring, joint: slide, spring: "${stiffness}"}
outputs:
  x: {joint_position: slide}
simulation: {step: "${pace}", duration: 0.1}
"""


@pytest.mark.parametrize("version", [2, 3])
def test_parameters_before_the_start_are_those_of_the_model(write, version, tmp_path):
    file, _ = write(PACED, version)
    found = {v.name: v.variability for v in fmpy.read_model_description(file).modelVariables if v.causality == "parameter"}
    assert found == {"pace": "fixed", "stiffness": "tunable"}
    values = {"pace": 0.005, "stiffness": 450.0}
    result = fmpy.simulate_fmu(file, start_values=values, stop_time=0.1, output_interval=0.005)
    model = tmp_path / "paced.yaml"
    model.write_text(PACED)
    run = ff.run(ff.Model.load(model, **values))
    assert np.array_equal(result["x"], run["x"])


@pytest.mark.parametrize("version", [2, 3])
def test_a_step_a_little_longer_than_that_of_the_model(write, version):
    file, _ = write(PACED, version)
    result = fmpy.simulate_fmu(file, stop_time=0.1, output_interval=0.0101)
    exact = 0.1 * np.cos(np.sqrt(150.0) * result["time"])
    assert np.abs(result["x"] - exact).max() < 1e-3


def test_a_choice_of_outputs(write):
    file, _ = write(HOSTILE, 2, "--outputs", "x,a b")
    description = fmpy.read_model_description(file)
    assert [v.name for v in description.modelVariables if v.causality == "output"] == ["x", "'a b'.c"]
    options = ["--fmi", "2", "--outputs", "y"]
    done = subprocess.run([ff.program(), "fmu", ff.example("quarter_car"), *options], capture_output=True, text=True, check=False)
    assert done.returncode == 2 and "no output of the model" in done.stderr
