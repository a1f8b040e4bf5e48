#!/usr/bin/env python3
"""floatframe fmu: what it writes, prints and refuses. FMPy looks at its XML in python/tests/test_fmu.py."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
import zipfile

BINARY = os.environ.get("FLOATFRAME_BINARY", "build/floatframe")
EXAMPLES = pathlib.Path(os.environ.get("FLOATFRAME_EXAMPLES", "examples"))
CAR = EXAMPLES / "quarter_car" / "quarter_car.yaml"
RUNTIME = pathlib.Path(BINARY).resolve().parent / "lib" / "fmu" / "linux64" / "floatframe_fmu.so"


PACED = """\
floatframe: 1
name: paced
parameters: {pace: 0.01, stiffness: 300, pull: 0.1, span: 0.1}
bodies:
  block: {rigid: {mass: 2, centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}
joints:
  slide: {type: prismatic, child: block, at: [0, 0, 0], axis: x, position: "${pull}"}
forces:
  coil: {type: joint_spring, joint: slide, spring: "${stiffness}"}
outputs:
  x: {joint_position: slide}
simulation: {step: "${pace}", duration: "${span}"}
"""


def program(*arguments, folder=None):
    return subprocess.run([str(pathlib.Path(BINARY).resolve()), *map(str, arguments)], capture_output=True, text=True,
                          timeout=280, cwd=folder, check=False)


@unittest.skipUnless(RUNTIME.is_file(), "built without the runtime of FMUs")
class FmuCommand(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="floatframe_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def written(self, *options):
        out = self.folder / "car.fmu"
        done = program("fmu", CAR.resolve(), "-o", out, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return out, done

    def description(self, *options):
        out, _ = self.written(*options)
        with zipfile.ZipFile(out) as archive:
            self.assertIsNone(archive.testzip())
            return ElementTree.fromstring(archive.read("modelDescription.xml"))

    def test_summary_counts_what_the_file_holds(self):
        out, done = self.written()
        for words in ("car.fmu: FMI 2.0 for co-simulation", "inputs      1", "outputs     3", "platforms   linux64"):
            self.assertIn(words, done.stdout)
        with zipfile.ZipFile(out) as archive:
            self.assertEqual(archive.namelist()[0], "modelDescription.xml")
            self.assertIn("binaries/linux64/quarter_car.so", archive.namelist())
            self.assertEqual(archive.read("binaries/linux64/quarter_car.so"), RUNTIME.read_bytes())

    def test_version_three_has_its_own_folders(self):
        out, _ = self.written("--fmi", "3")
        with zipfile.ZipFile(out) as archive:
            self.assertLessEqual({"binaries/x86_64-linux/quarter_car.so", "terminalsAndIcons/terminalsAndIcons.xml",
                                  "terminalsAndIcons/icon.png"}, set(archive.namelist()))

    def test_settings_reach_the_model(self):
        root = self.description("--set", "step=0.002", "--set", "body_mass=250")
        self.assertEqual(root.find("DefaultExperiment").get("stepSize"), "0.002")
        self.assertNotEqual(root.get("guid"), self.description().get("guid"))

    def test_outputs_are_chosen(self):
        root = self.description("--outputs", "tyre,travel")
        names = [v.get("name") for v in root.iter("ScalarVariable") if v.get("causality") == "output"]
        self.assertEqual(names, ["tyre", "travel"])

    def test_parameters_of_the_step_and_of_the_start_are_fixed(self):
        model = self.folder / "paced.yaml"
        model.write_text(PACED)
        out = self.folder / "paced.fmu"
        done = program("fmu", model, "-o", out, "--quiet")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        with zipfile.ZipFile(out) as archive:
            root = ElementTree.fromstring(archive.read("modelDescription.xml"))
        found = {v.get("name"): v.get("variability") for v in root.iter("ScalarVariable") if v.get("causality") == "parameter"}
        self.assertEqual(found, {"pace": "fixed", "stiffness": "tunable", "pull": "fixed", "span": "fixed"})

    def test_a_packed_model_gives_the_same_file(self):
        packed = self.folder / "car.ffm"
        self.assertEqual(program("pack", CAR.resolve(), "-o", packed, "--small").returncode, 0)
        out = self.folder / "of_packed.fmu"
        self.assertEqual(program("fmu", packed, "-o", out).returncode, 0)
        with zipfile.ZipFile(out) as a, zipfile.ZipFile(self.written()[0]) as b:
            self.assertEqual(a.read("resources/model.ffm"), b.read("resources/model.ffm"))
            self.assertEqual(a.read("modelDescription.xml"), b.read("modelDescription.xml"))
        done = program("fmu", packed, "-o", out, "--outputs", "tyre")
        self.assertEqual(done.returncode, 2)
        self.assertIn("with a packed model", done.stderr)

    def test_errors_leave_nothing_behind(self):
        for options in (["--outputs", "nothing"], ["--set", "nothing=1"], ["--fmi", "1"], ["--kind", "me"]):
            done = program("fmu", CAR.resolve(), "-o", self.folder / "x.fmu", *options)
            self.assertEqual(done.returncode, 2, options)
            self.assertEqual(list(self.folder.iterdir()), [], options)

    def test_only_own_files_are_replaced(self):
        out, _ = self.written()
        self.assertEqual(program("fmu", CAR.resolve(), "-o", out).returncode, 0)
        out.write_text("of somebody else")
        self.assertEqual(program("fmu", CAR.resolve(), "-o", out).returncode, 2)
        self.assertEqual(out.read_text(), "of somebody else")
        self.assertEqual(program("fmu", CAR.resolve(), "-o", out, "--overwrite").returncode, 0)
        done = program("check", out)
        self.assertEqual(done.returncode, 2)
        self.assertIn("zip archive", done.stderr)

    def test_the_model_is_not_overwritten(self):
        model = self.folder / "car.yaml"
        model.write_text(CAR.read_text())
        self.assertEqual(program("fmu", model, "-o", model, "--overwrite").returncode, 2)
        self.assertEqual(model.read_text(), CAR.read_text())

    def test_the_default_name_is_that_of_the_model(self):
        self.assertEqual(program("fmu", CAR.resolve(), "--quiet", folder=self.folder).returncode, 0)
        self.assertTrue((self.folder / "quarter_car.fmu").is_file())


if __name__ == "__main__":
    if len(sys.argv) > 1 and not sys.argv[1].startswith("-"):
        BINARY = sys.argv.pop(1)
    unittest.main()
