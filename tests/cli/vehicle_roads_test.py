#!/usr/bin/env python3
"""Roads and test rigs of docs/vehicle-models.md: the four-post rig against its closed form, the Iltis on each of its roads."""
import csv
import math
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BINARY = str(pathlib.Path(os.environ.get("FLOATFRAME_BINARY") or ROOT / "build" / "floatframe").resolve())
EXAMPLES = pathlib.Path(os.environ.get("FLOATFRAME_EXAMPLES") or ROOT / "examples")
DOCUMENT = (ROOT / "docs" / "vehicle-models.md").read_text()


class VehicleRoads(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="floatframe-roads-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def columns(self, model, *options):
        done = subprocess.run([BINARY, "run", str(model), *options, "--out", "out", "--overwrite", "--no-report", "--quiet"],
                              cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.folder / "out" / "results.csv", newline="") as file:
            names, *rows = csv.reader(file)
        return {name.split(" ")[0]: [float(row[k]) for row in rows] for k, name in enumerate(names)}

    def test_four_posts(self):
        """m z'' = 4 k (lift - z) without damping: of a ramp of 40 mm/s, z = 0.04 (t - sin(w t) / w)."""
        text = re.search(r"```yaml\n(floatframe: 1\nname: four_post\n.*?)```", DOCUMENT, re.DOTALL)[1]
        (self.folder / "post.yaml").write_text(text)
        c = self.columns("post.yaml")
        mass, stiffness = 1200.0, 2e5
        w = math.sqrt(4.0 * stiffness / mass)

        def rise(t):
            return t - math.sin(w * t) / w if t > 0.0 else 0.0

        for t, z, left, right in zip(c["time"], c["z"], c["front_left"], c["front_right"]):
            up = z - c["z"][0]
            self.assertAlmostEqual(up, 0.04 * (rise(t) - rise(t - 0.5)), delta=3e-6)
            mean, warp = min(0.04 * t, 0.02), 0.02 * max(t - 0.5, 0.0)
            self.assertAlmostEqual(left, mass * 9.81 / 4.0 + stiffness * (mean + warp - up), delta=1e-6)
            self.assertAlmostEqual(right, mass * 9.81 / 4.0 + stiffness * (mean - warp - up), delta=1e-6)

    def iltis(self, *options):
        return self.columns(EXAMPLES / "iltis" / "handling.yaml", *[word for o in options for word in ("--set", o)], "--duration", "1")

    def test_ice_under_the_right_wheels(self):
        """The left wheels brake alone: the vehicle turns to the left, with what friction there is on ice."""
        c = self.iltis("road=split", "brake=400")
        self.assertGreater(c["yaw"][-1], 0.005)
        self.assertLess(abs(self.iltis("brake=400")["yaw"][-1]), 1e-9)

    def test_two_random_tracks(self):
        c = self.iltis("road=rough")
        self.assertLess(abs(c["front_left.load"][0] - c["front_right.load"][0]), 1e-3)
        self.assertGreater(max(abs(a - b) for a, b in zip(c["front_left.load"], c["front_right.load"])), 100.0)

    def test_a_measured_road(self):
        """A plane that rises by 2 %, with its beginning 100 m away: moved to the origin."""
        channels = "".join(f"D:long section {k},m\n" for k in (1, 2))
        rows = "".join("%10.4f%10.4f\n" % (2 * (max(0.0, 0.01 * (k - 10)),)) for k in range(200))
        (self.folder / "hill.crg").write_text(
            "$ROAD_CRG\nREFERENCE_LINE_INCREMENT = 0.5\nREFERENCE_LINE_START_X = 100\nREFERENCE_LINE_START_Y = 50\n"
            f"LONG_SECTION_V_RIGHT = -5\nLONG_SECTION_V_LEFT = 5\n$\n$KD_Definition\n#:LRFI\n{channels}$\n$$$$\n{rows}")
        c = self.iltis("road=measured", f"road_file={self.folder / 'hill.crg'}")
        self.assertAlmostEqual(c["chassis.z"][-1] - c["chassis.z"][0], 0.02 * (c["chassis.x"][-1] - 5.0), delta=0.01)
        self.assertLess(c["pitch"][-1], c["pitch"][0] - 0.01)


if __name__ == "__main__":
    unittest.main()
