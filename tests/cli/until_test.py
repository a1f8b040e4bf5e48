#!/usr/bin/env python3
"""`until` of a simulation: where the run says that it has ended, sweeps over a stopping distance, resumed runs, real time. Set
FLOATFRAME_BINARY or give its path."""
import csv
import unittest

from report_page import text_of
from run_case import RunCase

# A car that brakes with mu g: it stands after v / (mu g), v^2 / (2 mu g).
BRAKING = """\
floatframe: 1
name: braking
parameters: {speed: 20, friction: 0.8, duration: 10}
bodies: {car: {rigid: {mass: 1500, centre_of_mass: [0, 0, 0], inertia: [500, 2000, 2000]}}}
joints: {road: {type: prismatic, child: car, at: [0, 0, 0], axis: x, velocity: "${speed}"}}
forces: {brake: {type: force, body: car, direction: -x, magnitude: "${friction * 1500 * g0}"}}
outputs:
  way: {joint_position: road}
  half: {first_crossing: "rate(road) - speed / 2", direction: falling}
simulation: {step: 0.01, duration: "${duration}", until: "rate(road)"}
"""


class Until(RunCase):
    def setUp(self):
        super().setUp()
        (self.folder / "braking.yaml").write_text(BRAKING)

    def test_says_when_the_run_has_ended(self):
        done = self.program("run", "braking.yaml", "--out", "out")
        exact = 20 / (0.8 * 9.80665)
        until = self.summary("out")["until"]
        self.assertTrue(until["reached"])
        self.assertAlmostEqual(until["time_s"], exact, delta=1e-9)
        self.assertIn(until["sentence"], done.stdout)
        self.assertIn("crosses zero", until["sentence"])
        self.assertIn(f"It {until['sentence']}.", text_of(self.folder / "out" / "report.html"))
        with open(self.folder / "out" / "results.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(float(rows[-1]["time [s]"]), until["time_s"])
        self.assertAlmostEqual(float(rows[-1]["way [m]"]), 0.5 * 20 * exact, delta=1e-7)
        self.assertEqual(rows[0]["half [s]"], "nan")
        self.assertAlmostEqual(float(rows[-1]["half [s]"]), 0.5 * exact, delta=1e-9)

    def test_ends_with_the_duration_without_a_crossing(self):
        done = self.program("run", "braking.yaml", "--out", "out", "--set", "duration=1")
        until = self.summary("out")["until"]
        self.assertEqual((until["reached"], until["time_s"]), (False, None))
        self.assertIn("did not cross zero", done.stdout)
        self.assertEqual(self.summary("out")["duration_s"], 1)

    def test_a_sweep_over_the_stopping_distance(self):
        self.program("sweep", "braking.yaml", "--vary", "speed=10:30:3", "--out", "study", "--measure", "way:final")
        with open(self.folder / "study" / "sweep.csv", newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                speed = float(row["speed"])
                self.assertAlmostEqual(float(row["way final [m]"]), speed ** 2 / (2 * 0.8 * 9.80665), delta=1e-6)
                self.assertAlmostEqual(float(row["time reached [s]"]), speed / (0.8 * 9.80665), delta=1e-9)

    def test_real_time_ignores_it_with_a_note(self):
        done = self.program("realtime", "braking.yaml", "--duration", "0.05")
        self.assertIn("until is ignored here", done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
