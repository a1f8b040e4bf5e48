#!/usr/bin/env python3
"""The packets of the Iltis: their layout as docs/vehicle-models.md shows it, sensors of the wheels, and the antilock brake of
examples/iltis/antilock.py, which stops the vehicle over them in lock step."""
import os
import pathlib
import re
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BINARY = str(pathlib.Path(os.environ.get("FLOATFRAME_BINARY") or ROOT / "build" / "floatframe").resolve())
EXAMPLES = pathlib.Path(os.environ.get("FLOATFRAME_EXAMPLES") or ROOT / "examples") / "iltis"
sys.path[:0] = [str(EXAMPLES), str(EXAMPLES.parent / "active_damper")]
import antilock  # noqa: E402
import floatframe_link  # noqa: E402

MODEL = EXAMPLES / "handling.yaml"


class Antilock(unittest.TestCase):
    def test_the_layout_is_that_of_the_document(self):
        done = subprocess.run([BINARY, "realtime", str(MODEL), "--layout"], capture_output=True, text=True, check=True)
        printed = re.sub(r"layout 0x[0-9a-f]{16}", "layout ...", done.stdout).rstrip()
        self.assertIn("```\n" + printed + "\n```", (ROOT / "docs" / "vehicle-models.md").read_text())

    def test_a_brake_and_a_sensor_for_each_wheel(self):
        layout = floatframe_link.read_layout(BINARY, MODEL)
        inputs = {s["name"]: s["unit"] for s in layout["inputs"]["signals"]}
        outputs = {s["name"]: s["unit"] for s in layout["outputs"]["signals"]}
        for wheel in antilock.WHEELS:
            self.assertEqual((inputs[f"{wheel}.brake"], outputs[f"{wheel}.brake"], outputs[f"{wheel}.rate"]), ("N m", "N m", "rad/s"))

    def test_the_vehicle_stops_without_locked_wheels(self):
        settings = ["speed=12"]
        without = antilock.stop(BINARY, MODEL, settings, antilock=False)
        self.assertLess(abs(without["least"]), 0.02)
        found = antilock.stop(BINARY, MODEL, settings)
        self.assertGreater(found["least"], 0.5)
        # Locked wheels slide; these are held near the slip of the largest force.
        self.assertLess(found["distance"], 0.95 * without["distance"])
        self.assertEqual(found["packets"], round(1000.0 * found["time"]))


if __name__ == "__main__":
    unittest.main()
