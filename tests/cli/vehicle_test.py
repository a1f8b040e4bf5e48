#!/usr/bin/env python3
"""floatframe vehicle: figures, files and messages, with the single-track model of tests/data/vehicle."""
import csv
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

BINARY = os.environ.get("FLOATFRAME_BINARY") or (
    sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else "build/floatframe")
BINARY = str(pathlib.Path(BINARY).resolve())
ROOT = pathlib.Path(__file__).resolve().parents[2]
MODEL = ROOT / "tests" / "data" / "vehicle" / "single_track.yaml"


def vehicle(*arguments):
    return subprocess.run([BINARY, "vehicle", *map(str, arguments)], capture_output=True, text=True, timeout=280)


class Vehicle(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def test_step_steer(self):
        found = vehicle(MODEL, "--manoeuvre", "step-steer", "--speed", "80km/h", "--set", "hold=1e5", "--json",
                        "--out", self.folder / "out")
        self.assertEqual((found.returncode, found.stderr), (0, ""))
        figures = json.loads(found.stdout)
        # Half of the table's step of 2 deg, whose steady yaw rate is 10.66593737 deg/s.
        self.assertAlmostEqual(figures["responses"]["yaw_rate"]["steady"], 10.66593737 / 2, delta=1e-3)
        self.assertLess(figures["first_second_yaw_rate_deg_s"], 1e-4)
        self.assertLess(figures["first_second_drift_m_s"], 1e-4)
        files = sorted(path.name for path in (self.folder / "out").iterdir())
        self.assertIn("results.csv", files)
        self.assertIn("summary.json", files)
        header = (self.folder / "out" / "results.csv").read_text().splitlines()[0]
        self.assertIn("vehicle.yaw_rate [rad/s]", header)
        self.assertIn("inputs.steer [rad]", header)

    def test_units_of_the_speed(self):
        for speed in ("22.222222222222222m/s", "80 km/h"):
            found = vehicle(MODEL, "--speed", speed, "--right")
            self.assertEqual(found.returncode, 0, found.stderr)
            self.assertIn("from 80.00 km/h", found.stdout)

    def test_entry_has_the_speed_asked_for(self):
        found = vehicle(MODEL, "--speed", "36km/h")
        self.assertEqual(found.returncode, 0, found.stderr)
        self.assertIn("from 36.00 km/h", found.stdout)

    def test_messages(self):
        for arguments, sentence in (
                (["--speed", "fast"], "--speed: found 'fast', expected a positive number with km/h or m/s"),
                (["--speed", "80mph"], "--speed: found '80mph', expected a positive number with km/h or m/s"),
                (["--speed", "0"], "--speed: found '0', expected a positive number with km/h or m/s"),
                (["--speed", "80"], "--speed: found '80', expected a unit: 80km/h or 80m/s"),
                (["--angle", "1", "--lateral-acceleration", "4"], "--lateral-acceleration: found it with --angle"),
                (["--lateral-acceleration", "-4"], "--lateral-acceleration: found '-4', expected a positive number [m/s2]"),
                (["--manoeuvre", "steady-circle", "--lateral-acceleration", "4"], "expected it with step-steer"),
                (["--manoeuvre", "steady-circle", "--radius", "0"], "--radius: found '0', expected a positive number [m]"),
                (["--manoeuvre", "steady-circle", "--radius", "-9"], "--radius: found '-9', expected a positive number [m]"),
                (["--radius", "50"], "--radius: found it with --manoeuvre step-steer, expected it with steady-circle"),
                (["--angle", "89"], "--angle: found '89', expected a positive number up to 40 [deg]"),
                (["--manoeuvre", "double-lane-change", "--right"], "--right: found it with --manoeuvre double-lane-change"),
                (["--torque", "100"], "--torque: found it with --manoeuvre step-steer, expected it with straight-stop"),
                (["--travel", "0.1"], "--travel: found it with --manoeuvre step-steer, expected it with --rig k-and-c"),
                (["--rig", "k-and-c", "--speed", "50km/h"], "--speed: found it with --rig k-and-c"),
                (["--rig", "k-and-c", "--travel", "0"], "--travel: found '0', expected a positive number [m]"),
                (["--rig", "k-and-c"], "vehicle.axles.front.left: found the wheel 'fl' welded to the chassis"),
                (["--manoeuvre", "straight-stop"], "vehicle: found no 'brake', expected it for straight-stop"),
                (["--manoeuvre", "slalom"], "--manoeuvre: found 'slalom', expected steady-circle, step-steer")):
            with self.subTest(arguments):
                found = vehicle(MODEL, *arguments)
                self.assertEqual(found.returncode, 2, found.stdout)
                self.assertIn(sentence, found.stderr)
                self.assertEqual(len(found.stderr.splitlines()), 1, found.stderr)
        found = vehicle(MODEL, "--set", "hold=1e5", "--speed", "40km/h")
        self.assertEqual(found.returncode, 1)
        self.assertIn("expected 11.1111 m/s: the force of its drive is at its limit of -10000 N", found.stderr)

    def test_step_of_a_lateral_acceleration(self):
        found = vehicle(MODEL, "--speed", "80km/h", "--set", "hold=1e5", "--lateral-acceleration", "2", "--right", "--json")
        self.assertEqual((found.returncode, found.stderr), (0, ""))
        figures = json.loads(found.stdout)
        # A linear vehicle: the yaw rate of 2 deg is 10.66593737 deg/s, so the second run finds it.
        v = 80 / 3.6
        angle = -2.0 * 2.0 / (v * math.radians(10.66593737))
        self.assertEqual((figures["found"], figures["runs"]), (True, 2))
        self.assertAlmostEqual(figures["responses"]["lateral_acceleration"]["steady"], -2.0, delta=0.02)
        self.assertAlmostEqual(figures["steering_deg"], angle, delta=0.01 * abs(angle))

    def test_files_of_the_rig(self):
        text = (ROOT / "tests" / "data" / "vehicle" / "swing_axle.yaml").read_text()
        model = self.folder / "swing.yaml"
        model.write_text(text)
        found = vehicle(model, "--rig", "k-and-c", "--travel", "0.02", "--out", self.folder / "rig")
        self.assertEqual((found.returncode, found.stderr), (0, ""))
        self.assertIn("+ is bump", found.stdout)
        self.assertIn("input [rad]", found.stdout)
        self.assertIn("only, steer: the steering input does not move it\n", found.stdout)
        self.assertIn("compliance at the height of the design", found.stdout)
        files = sorted(path.name for path in (self.folder / "rig").iterdir() if path.name != "run.lock")
        self.assertEqual(files, ["roll.csv", "steer.csv", "summary.json", "travel.csv"])
        with open(self.folder / "rig" / "travel.csv", newline="") as file:
            header, *rows = csv.reader(file)
        self.assertEqual(len(rows), 13)
        column = header.index("only.left.camber [rad]")
        # The arm is at the angle s with 0.5 sin s = z.
        for row in rows:
            self.assertAlmostEqual(float(row[column]), -math.asin(float(row[0]) / 0.5), delta=1e-9)
        self.assertEqual(json.loads((self.folder / "rig" / "summary.json").read_text())["rig"], "k-and-c")

    def test_roads_that_are_not_flat(self):
        iltis = ROOT / "examples" / "iltis" / "handling.yaml"
        for road, manoeuvre, sentence in (
                ("rough", "step-steer", "roads.rough: found heights between "),
                ("split", "steady-circle", "roads.split: found patches of friction, expected a road of the same friction everywhere")):
            with self.subTest(road):
                found = vehicle(iltis, "--set", f"road={road}", "--manoeuvre", manoeuvre)
                self.assertEqual(found.returncode, 2, found.stdout)
                self.assertIn(sentence, found.stderr)
                self.assertEqual(len(found.stderr.splitlines()), 1, found.stderr)

    def test_no_word_of_stability_for_wheels_that_roll(self):
        iltis = ROOT / "examples" / "iltis" / "handling.yaml"
        done = subprocess.run([BINARY, "run", str(iltis), "--duration", "0.01", "--out", str(self.folder / "run"), "--no-report"],
                              capture_output=True, text=True, timeout=280)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("the equilibrium is unstable", done.stdout + done.stderr)

    def test_the_iltis_passes_the_double_lane_change(self):
        found = vehicle(ROOT / "examples" / "iltis" / "handling.yaml", "--manoeuvre", "double-lane-change", "--speed", "60km/h")
        self.assertEqual(found.returncode, 0, found.stderr)
        self.assertIn("(ISO 3888-2), passed", found.stdout)
        self.assertIn("speed 60.00 km/h at the entry", found.stdout)

    def test_what_the_section_lacks(self):
        text = MODEL.read_text()
        short = self.folder / "short.yaml"
        short.write_text(text[:text.index("vehicle:\n")] + text[text.index("simulation:"):])
        found = vehicle(short)
        self.assertEqual(found.returncode, 2)
        self.assertIn("step-steer: found no section 'vehicle'", found.stderr)


if __name__ == "__main__":
    unittest.main()
