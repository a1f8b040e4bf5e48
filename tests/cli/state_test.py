#!/usr/bin/env python3
"""States on the command line: written by run and statics, started from, kept in fingerprints; check --json."""
import csv
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

from report_page import text_of

BINARY = os.environ.get("FLOATFRAME_BINARY", "build/floatframe")

MODEL = """\
floatframe: 1
name: swing
points: {a: [0, 0, 0], b: [1, 0, 0]}
parameters: {start: given}
bodies:
  bar:
    flexible:
      material: {young: 70e9, poisson: 0.3, density: 2700}
      bars: {b: {from: a, to: b, elements: 4, section: {round: 0.02}}}
      clamped: [a]
      static_modes: [{point: b, dofs: [y, z]}]
      normal_modes: 1
      damping: 0.02
joints:
  hinge: {type: revolute, child: bar, at: a, axis: y}
forces:
  spring: {type: joint_spring, joint: hinge, spring: 300, damper: 1}
outputs:
  z: {position: {body: bar, node: b}, axis: z}
  q: {joint_position: hinge}
simulation: {step: 0.001, duration: 0.2, start: START}
"""


class States(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name)
        self.model("given")

    def tearDown(self):
        self.folder.cleanup()

    def model(self, start):
        (self.path / "swing.yaml").write_text(MODEL.replace("START", start))

    def run_program(self, *arguments, code=0):
        result = subprocess.run([os.path.abspath(BINARY), *arguments], cwd=self.folder.name, capture_output=True,
                                text=True, timeout=300)
        self.assertEqual(result.returncode, code, result.stderr + result.stdout)
        return result

    def rows(self, folder):
        with open(self.path / folder / "results.csv", newline="") as file:
            return [[float(x) for x in row] for row in list(csv.reader(file))[1:]]

    def test_a_run_goes_on_where_another_ended(self):
        self.run_program("run", "swing.yaml", "--duration", "0.4", "--out", "whole", "--no-report")
        first = self.run_program("run", "swing.yaml", "--out", "first", "--no-report", "--write-state", "end.json")
        self.assertIn("  state    end.json\n", first.stdout)
        self.model("{state: end.json}")
        for coordinates, close in (("relative", 1e-8), ("absolute", 1e-4)):
            self.run_program("run", "swing.yaml", "--coordinates", coordinates, "--out", "second")
            whole, second = self.rows("whole"), self.rows("second")
            self.assertEqual(len(second), 201)
            self.assertAlmostEqual(second[0][0], 0.2, 12)
            for a, b in zip(whole[200:], second):
                for x, y in zip(a, b):
                    self.assertLess(abs(x - y), close)
        self.assertIn("state at 0.2 s from end.json", text_of(self.path / "second" / "report.html"))

    def test_statics_write_the_state_of_the_equilibrium(self):
        text = self.run_program("statics", "swing.yaml", "--json", "--write-state", "rest.json").stdout
        statics, state = json.loads(text), json.loads((self.path / "rest.json").read_text())
        self.assertEqual(state["floatframe_state"], 1)
        self.assertEqual(state["time"], 0)
        self.assertEqual(statics["bodies"][0]["amplitudes"], state["bodies"]["bar"]["amplitudes"])
        self.model("{state: rest.json}")
        self.run_program("run", "swing.yaml", "--out", "rest", "--no-report")
        self.assertEqual(self.rows("rest")[0][2], state["joints"]["hinge"]["position"][0])
        for row in self.rows("rest"):
            self.assertLess(abs(row[2] - state["joints"]["hinge"]["position"][0]), 1e-8)

    def test_an_offset_that_cannot_be(self):
        self.model("{equilibrium: true, offset: {bar: [0, 0, 0.1]}}")  # its origin is the hinge
        error = self.run_program("run", "swing.yaml", "--out", "out", code=1).stderr
        self.assertIn("the offset at the start is not possible: with loops closed body 'bar' stays 0.1 (m or rad)", error)
        self.model("{equilibrium: true, offset: {bar: [0, 0, 0, 0, 0.1, 0]}}")
        self.run_program("run", "swing.yaml", "--out", "out", "--no-report")

    def test_a_state_that_is_wrong_is_bad_input(self):
        self.run_program("run", "swing.yaml", "--out", "first", "--no-report", "--write-state", "end.json")
        state = (self.path / "end.json").read_text()
        (self.path / "end.json").write_text(state.replace('"hinge"', '"pin"'))
        self.model("{state: end.json}")
        error = self.run_program("run", "swing.yaml", "--out", "second", code=2).stderr
        self.assertIn("end.json: found joint 'pin' in the state, which the model does not have", error)
        (self.path / "end.json").write_text(state[:100])
        error = self.run_program("run", "swing.yaml", "--out", "second", code=2).stderr
        self.assertIn("simulation.start.state: end.json: ", error)
        self.run_program("run", "swing.yaml", "--write-state", "no/where.json", code=2)

    def test_check_compares_the_state_as_a_run_does(self):
        self.run_program("run", "swing.yaml", "--out", "first", "--no-report", "--write-state", "end.json")
        self.model("{state: end.json}")
        self.run_program("check", "swing.yaml")
        state = json.loads((self.path / "end.json").read_text())
        state["joints"] = {}
        (self.path / "end.json").write_text(json.dumps(state))
        for command in (["check", "swing.yaml"], ["run", "swing.yaml", "--out", "second"]):
            self.assertIn("found joint 'hinge' nowhere in the state", self.run_program(*command, code=2).stderr)

    def test_states_that_are_made_to_harm(self):
        self.run_program("run", "swing.yaml", "--out", "first", "--no-report", "--write-state", "end.json")
        good = json.loads((self.path / "end.json").read_text())
        self.model("{state: end.json}")
        for key in ("floatframe_state", "time", "joints", "bodies"):
            text = json.dumps({**good, key: "@@"}).replace('"@@"', "[" * 500000 + "]" * 500000)
            (self.path / "end.json").write_text(text)
            for command in (["check", "swing.yaml"], ["run", "swing.yaml", "--out", "second"]):
                self.assertIn("nests deeper than 64 levels", self.run_program(*command, code=2).stderr)
        long = "a" * 1000000
        for changed in ({"floatframe_state": long}, {"time": long}, {"joints": {long: {"type": long}}},
                        {"joints": {"hinge": {"type": long}}}, {"bodies": {long: {}}}):
            (self.path / "end.json").write_text(json.dumps({**good, **changed}))
            self.assertLess(len(self.run_program("check", "swing.yaml", code=2).stderr), 1000)

    def test_a_study_notices_that_a_state_has_changed(self):
        self.run_program("statics", "swing.yaml", "--write-state", "rest.json")
        self.model("{state: rest.json}")
        sweep = ("sweep", "swing.yaml", "--vary", "step=0.001:0.002:2", "--out", "study")
        self.run_program(*sweep)
        (self.path / "rest.json").write_text((self.path / "rest.json").read_text() + " ")
        error = self.run_program(*sweep, code=2).stderr
        self.assertIn("rest.json", error)

    def test_check_gives_modes_and_frequencies(self):
        text = self.run_program("check", "swing.yaml", "--json").stdout
        bar = json.loads(text)["flexible"][0]
        self.assertEqual((bar["name"], bar["modes"], len(bar["mode_names"])), ("bar", 3, 3))
        self.assertEqual(len(bar["frequencies_Hz"]), 1)
        self.assertGreater(len(repr(bar["frequencies_Hz"][0])), 12)  # not rounded
        shown = self.run_program("check", "swing.yaml").stdout
        self.assertIn(f"{bar['frequencies_Hz'][0]:.3f}", shown)


if __name__ == "__main__":
    unittest.main()
