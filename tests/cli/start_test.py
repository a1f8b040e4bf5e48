#!/usr/bin/env python3
"""What check, statics, run and realtime say of the start: values that were changed, redundant joints, crashes of old."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from report_page import text_of

BINARY = os.environ.get("FLOATFRAME_BINARY") or (
    sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else "build/floatframe")
BINARY = str(pathlib.Path(BINARY).resolve())

# A four-bar linkage: two angles and two rates that do not fit together.
LINKAGE = """\
floatframe: 1
parameters: {keep: false}
bodies:
  crank: {position: [0, 0, 0], rigid: {mass: 1, centre_of_mass: [0, 0, 0.1], inertia: [.001, .001, .001]}}
  coupler: {position: [0, 0, 0.2], rigid: {mass: 1, centre_of_mass: [0.25, 0, 0.3], inertia: [.001, .001, .001]}}
  rocker: {position: [0.5, 0, 0], rigid: {mass: 1, centre_of_mass: [0.5, 0, 0.2], inertia: [.001, .001, .001]}}
joints:
  a: {type: revolute, child: crank, at: [0, 0, 0], axis: y, position: 0.3, velocity: 1, keep: "${keep}"}
  b: {type: revolute, parent: crank, child: coupler, at: [0, 0, 0.2], axis: y}
  c: {type: revolute, parent: coupler, child: rocker, at: [0.5, 0, 0.4], axis: y}
  d: {type: revolute, child: rocker, at: [0.5, 0, 0], axis: y, position: 0.3, velocity: 1}
outputs: {a: {joint_position: a}}
simulation: {step: 0.001, duration: 0.01}
"""

WELDED_TWICE = """\
floatframe: 1
bodies: {block: {position: [1, 0, 0], rigid: {mass: 10, inertia: [1, 1, 1]}}}
joints:
  weld_1: {type: weld, child: block, at: [0, 0, 0]}
  weld_2: {type: weld, child: block, at: [2, 0, 0]}
"""

# Nothing is left to move, and the point has no inertia of rotation.
DRIVEN_POINT = """\
floatframe: 1
parameters: {w: 2}
bodies: {ball: {position: [1, 0, 0], rigid: {mass: 2}}}
joints: {arm: {type: revolute, child: ball, at: [0, 0, 0], axis: y, motion: {polynomial: [0, "${w}"]}}}
outputs: {x: {position: ball, axis: x}}
simulation: {step: 0.001, duration: 0.05}
"""


class Start(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for name, text in (("linkage", LINKAGE), ("welded", WELDED_TWICE), ("point", DRIVEN_POINT)):
            (self.folder / f"{name}.yaml").write_text(text)

    def floatframe(self, code, *arguments):
        done = subprocess.run([BINARY, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def test_changed_start_values_are_reported_everywhere(self):
        sentence = "note: joint 'a': closing the loops changed the angle from the 0.3 rad given to "
        self.assertIn(sentence, self.floatframe(0, "check", "linkage.yaml").stdout)
        self.assertIn(sentence, self.floatframe(0, "realtime", "linkage.yaml", "--no-pace").stdout)
        for coordinates in ("relative", "absolute"):
            done = self.floatframe(0, "run", "linkage.yaml", "--out", "out", "--coordinates", coordinates)
            self.assertIn(sentence, done.stdout)
            start = json.loads((self.folder / "out" / "summary.json").read_text())["start"]
            self.assertEqual([(c["owner"], c["rate"]) for c in start["changes"]],
                             [("joint 'a'", False), ("joint 'd'", False), ("joint 'a'", True), ("joint 'd'", True)])
            self.assertEqual(start["changes"][0]["given"], 0.3)
            first = (self.folder / "out" / "results.csv").read_text().splitlines()[1]
            self.assertAlmostEqual(start["changes"][0]["used"], float(first.split(",")[1]), 9)
            self.assertIn("closing the loops changed the angle", text_of(self.folder / "out" / "report.html"))

    def test_kept_start_values_stay(self):
        done = self.floatframe(0, "check", "linkage.yaml", "--set", "keep=true", "--json")
        changes = json.loads(done.stdout)["start"]["changes"]
        self.assertEqual({c["owner"] for c in changes}, {"joint 'd'"})

    def test_redundant_joints_are_named(self):
        named = "joint 'weld_2': translation along x, translation along y, translation along z, rotation about"
        self.assertIn(named, self.floatframe(0, "check", "welded.yaml").stdout)
        self.assertIn(named, self.floatframe(0, "run", "welded.yaml", "--out", "out").stdout)
        text = self.floatframe(0, "statics", "welded.yaml").stdout
        self.assertIn(named, text)
        self.assertIn("49.0500*", text)
        result = json.loads(self.floatframe(0, "statics", "welded.yaml", "--json").stdout)
        for joint in result["joints"]:
            self.assertAlmostEqual(joint["force"][2], 49.05, 9)
            self.assertFalse(joint["unique"])
        self.assertEqual(len(result["redundant"]), 6)

    def test_nothing_left_to_move(self):
        for coordinates in ("relative", "absolute"):
            self.floatframe(0, "run", "point.yaml", "--out", "out", "--coordinates", coordinates)
            self.floatframe(0, "realtime", "point.yaml", "--no-pace", "--coordinates", coordinates)
        (self.folder / "absolute.yaml").write_text(DRIVEN_POINT.replace("{step", "{coordinates: absolute, step"))
        self.floatframe(0, "check", "absolute.yaml")
        self.floatframe(0, "sweep", "absolute.yaml", "--vary", "w=1:3:3", "--out", "study", "--quiet")
        self.assertNotIn("failed", (self.folder / "study" / "sweep.csv").read_text())


if __name__ == "__main__":
    unittest.main()
