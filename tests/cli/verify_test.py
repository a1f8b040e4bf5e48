#!/usr/bin/env python3
"""`floatframe run --verify`: the order and the error of a run on the terminal, in summary.json and in the report, and that its other files
are those of a run without. Set FLOATFRAME_BINARY or give its path."""
import pathlib
import signal
import unittest

from report_page import page_of
from run_case import RunCase

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"
# A block between springs, the right one with a stop.
STOP = """\
floatframe: 1
name: stop
parameters: {locate: false}
bodies: {block: {position: [0, 0, 0], rigid: {mass: 1, inertia: [0.01, 0.01, 0.01]}}}
joints: {slide: {type: prismatic, child: block, at: [0, 0, 0], axis: x, position: 0.1}}
gravity: [0, 0, 0]
forces: {s: {type: joint_spring, joint: slide, spring: {table: [[-1, -100], [0, 0], [0.05, 5], [0.051, 105]]}}}
outputs: {x: {joint_position: slide}}
simulation: {step: 1.0e-4, duration: 1, locate_edges: "${locate}"}
"""
# A torsion spring that can hold no more than 2.5 N m, at 0.5 s.
FAILING = """\
floatframe: 1
name: failing
bodies:
  arm: {rigid: {mass: 0, centre_of_mass: [1, 0, 0]}}
  stone: {rigid: {mass: 1, centre_of_mass: [0, 0, 2], inertia: [0.1, 0.1, 0.1]}}
joints: {hinge: {type: revolute, child: arm, at: [0, 0, 0], axis: y}}
forces:
  spring: {type: joint_spring, joint: hinge, spring: {polynomial: [0, 10, -10]}}
  load: {type: torque, body: arm, direction: y, magnitude: {polynomial: [0, 5]}}
outputs: {x: {joint_position: hinge}}
simulation: {step: 0.01, duration: 1}
"""


class Verify(RunCase):
    def model(self, name, text):
        (self.folder / name).write_text(text)
        return name

    def test_order_two_of_a_pendulum(self):
        model = EXAMPLES / "flexible_pendulum" / "flexible_pendulum.yaml"
        common = (str(model), "--duration", "0.2", "--step", "5e-5")
        plain = self.program("run", *common, "--out", "plain")
        done = self.program("run", *common, "--out", "verified", "--verify")
        for name in "results.csv", "states.ffr":
            self.assertEqual(*((self.folder / out / name).read_bytes() for out in ("plain", "verified")), name)
        found = self.summary("verified").pop("verification")
        self.assertNotIn("verification", self.summary("plain"))
        self.assertEqual((found["steps_s"], found["instants"], found["to_s"]), ([5e-5, 2.5e-5, 1.25e-5], 4001, 0.2))
        outputs = {o["name"]: o for o in found["outputs"]}
        for name in "tip.x", "tip.y", "hinge.angle":
            self.assertEqual(outputs[name]["convergence"], "regular")
            self.assertAlmostEqual(outputs[name]["order"], 2, delta=0.1)
            self.assertAlmostEqual(outputs[name]["error"] / outputs[name]["largest_difference"], 4 / 3, delta=0.05)
        self.assertEqual(found["sentences"], [])
        self.assertIn("verified with steps of 0.025 and 0.0125 ms, at 4001 instants from 0 to 0.2 s", done.stdout)
        self.assertIn("largest difference", done.stdout)
        self.assertNotIn("verified", plain.stdout)
        coarse = self.program("run", str(model), "--out", "coarse", "--verify", "--quiet", "--no-report").stderr
        self.assertRegex(coarse, r"converging with order .* instead of 2: .*; likely because of a step that is long for the fastest motion\n")
        page = page_of(self.folder / "verified" / "report.html")
        if page:
            self.assertEqual([t["heading"] for t in page["trust"]["tables"]], ["Dependence on the step"])
            self.assertEqual(len(page["trust"]["tables"][0]["rows"]), len(outputs))
            self.assertEqual([row[2] for row in page["trust"]["rows"] if "shorter steps" in row[0]], ["ok"])

    def test_a_corner_within_steps_is_order_one(self):
        done = self.program("run", self.model("b.yaml", STOP), "--verify", "--quiet", "--out", "out")
        found = self.summary("out")["verification"]
        self.assertAlmostEqual(found["outputs"][0]["order"], 1, delta=0.3)
        self.assertEqual(done.stdout, "")
        self.assertEqual(done.stderr, f"floatframe: verification: {found['sentences'][0]}\n")
        self.assertRegex(done.stderr, r"converging with order [01]\.\d instead of 2: output 'x'; likely because of corners and jumps of forces "
                                      r"within steps \(locate_edges: true divides steps there\)")
        page = page_of(self.folder / "out" / "report.html")
        if page:
            self.assertIn("Converging with order", page["trust"]["tables"][0]["note"])
            self.assertEqual([row[2] for row in page["trust"]["rows"] if "shorter steps" in row[0]], ["warn"])
        done = self.program("run", "b.yaml", "--set", "locate=true", "--verify", "--quiet", "--out", "located")
        self.assertEqual(done.stderr, "")
        self.assertAlmostEqual(self.summary("located")["verification"]["outputs"][0]["order"], 2, delta=0.2)

    def test_a_run_that_fails_is_compared_up_to_there(self):
        done = self.program("run", self.model("f.yaml", FAILING), "--verify", "--out", "out", code=1)
        summary = self.summary("out")
        self.assertEqual(summary["status"], "failed")
        found = summary["verification"]
        self.assertAlmostEqual(found["to_s"], 0.5, delta=0.03)
        self.assertIn(f"the run ended early: compared up to {found['to_s']:g} s", done.stderr)

    def test_rows_that_go_to_a_device(self):
        (self.folder / "out").mkdir()
        (self.folder / "out" / "results.csv").symlink_to("/dev/null")
        self.program("run", self.model("b.yaml", STOP), "--set", "locate=true", "--verify", "--record", "none", "--out", "out")
        self.assertAlmostEqual(self.summary("out")["verification"]["outputs"][0]["order"], 2, delta=0.2)

    def test_many_outputs_are_a_short_table(self):
        done = self.program("run", str(EXAMPLES / "iltis" / "iltis.yaml"), "--duration", "2", "--verify", "--no-report", "--out", "out")
        outputs = self.summary("out")["verification"]["outputs"]
        self.assertGreater(len(outputs), 12)
        self.assertIn(f"  and {len(outputs) - 12} more, ", done.stdout)
        # Twelve rows between the titles and this line.
        lines = done.stdout.splitlines()
        self.assertEqual([k for k, line in enumerate(lines) if " more, " in line][0] - [k for k, line in enumerate(lines) if "at [s]" in line][0], 13)

    def test_an_interrupt_keeps_the_run(self):
        process = self.begin("run", "m.yaml", "--set", "duration=5", "--verify", "--out", "out")
        self.wait_for(lambda: (self.folder / "out" / "report.html").exists() and self.summary("out")["status"] == "completed", process)
        code, _, err = self.end(process, signal.SIGINT)
        self.assertEqual(code, 130, err)
        self.assertRegex(err, "verification: the run at (half|a quarter of) the step was interrupted at t = ")
        summary = self.summary("out")
        self.assertEqual(summary["status"], "completed")
        self.assertGreater(len(summary["verification"]["outputs"]), 0)
        self.assertEqual(self.rows("out"), 5001)
        self.assertTrue((self.folder / "out" / "report.html").exists())

    def test_runs_that_cannot_be_verified(self):
        def refused(sentence, *arguments):
            self.assertEqual(self.program("run", *arguments, "--verify", "--out", "out", code=2).stderr, f"floatframe: {sentence}\n")
        self.model("b.yaml", STOP)
        self.model("none.yaml", STOP.replace("duration: 1", "duration: 0"))
        refused("--verify: found a duration of 0 s, expected one with steps to halve", "none.yaml")
        self.program("run", "b.yaml", "--out", "out", "--checkpoint-every", "0.1")
        refused("--verify: the run in 'out' is complete, there is nothing to continue; without --resume it is made and verified", "b.yaml",
                "--resume", "--checkpoint-every", "0.1")
        process = self.begin("run", "m.yaml", "--verify", "--out", "long")
        self.wait_for(self.has_rows("long"), process)
        code, _, err = self.end(process, signal.SIGINT)
        self.assertEqual(code, 130, err)
        self.assertIn("floatframe: --verify: the run did not come to its end, so it is not verified\n", err)
        self.assertNotIn("verification", self.summary("long"))


if __name__ == "__main__":
    unittest.main()
