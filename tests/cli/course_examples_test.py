#!/usr/bin/env python3
"""The numbers that the READMEs of the examples of the course give, against closed forms, in both formulations."""
import csv
import os
import pathlib
import subprocess
import tempfile
import unittest
from math import asin, atan2, cos, degrees, hypot, isnan, pi, radians, sin, tan

BINARY = str(pathlib.Path(os.environ.get("FLOATFRAME_BINARY", "build/floatframe")).resolve())
EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"
G = 9.81
BOTH = ("relative", "absolute")


def run(name, coordinates, *settings):
    """The columns of a run of an example."""
    with tempfile.TemporaryDirectory() as folder:
        options = [word for setting in settings for word in ("--set", setting)]
        done = subprocess.run([BINARY, "run", str(EXAMPLES / name / f"{name}.yaml"), "--coordinates", coordinates, "--out", folder,
                               "--no-report", "--record", "none", "--quiet", *options], capture_output=True, text=True, timeout=120, check=False)
        if done.returncode != 0:
            raise AssertionError(done.stderr)
        with open(pathlib.Path(folder) / "results.csv", encoding="utf-8") as file:
            heads, *rows = csv.reader(file)
    return {head.split(" [")[0]: [float(row[k]) for row in rows] for k, head in enumerate(heads)}


class CourseExamples(unittest.TestCase):
    def test_four_bar_is_two_circles(self):
        crank, coupler, rocker, ground = 0.1, 0.3, 0.25, 0.32
        def angle(q):  # of the rocker, from D to C
            x, z = crank * sin(q), crank * cos(q)
            d, to = hypot(ground - x, z), atan2(-z, ground - x)
            lean = (d * d + coupler * coupler - rocker * rocker) / (2 * d * coupler)
            at = to + atan2((1 - lean * lean) ** 0.5, lean)
            return atan2(z + coupler * sin(at), x + coupler * cos(at) - ground)
        for coordinates in BOTH:
            found = run("four_bar", coordinates)
            for q, r in zip(found["crank"], found["rocker"]):
                turned = degrees(angle(0.0) - angle(radians(q)))
                self.assertAlmostEqual(r, turned, delta=1e-6)
            self.assertAlmostEqual(max(found["rocker"]) - min(found["rocker"]), 49.56, delta=0.01)

    def test_gear_train_by_the_energy_of_its_turns(self):
        ratio, planets = 3.0, 4.0
        inertia = 0.004 * (ratio * planets) ** 2 + 0.02 * planets**2 + 0.8  # at the drum
        rate = (4.0 * ratio * planets - 35.0) / inertia
        mesh = 0.004 * rate * ratio * planets - 4.0
        for coordinates in BOTH:
            found = run("gear_train", coordinates)
            # Absolute coordinates turn quick wheels by a rule of second order.
            self.assertAlmostEqual(-found["drum"][-1] * 2 * pi / 60 / (0.6 * rate), 1.0, delta=1e-9 if coordinates == "relative" else 1e-3)
            self.assertAlmostEqual(found["mesh"][-1], mesh, delta=1e-8)
            radius = 0.004 * 18 / 2
            self.assertAlmostEqual(abs(found["bearing"][-1]), -mesh / radius * tan(radians(20)), delta=1e-6)
            self.assertAlmostEqual(found["bearing_z"][-1] - 2 * G, -mesh / radius, delta=1e-6)

    def test_cam_follows_its_polynomial(self):
        for coordinates in BOTH:
            found = run("cam", coordinates)
            width, speed, lift = radians(70), 2700 * 2 * pi / 60, 0.009
            # s'' of 35 u^4 - 84 u^5 + 70 u^6 - 20 u^7
            for t, a in zip(found["time"], found["acceleration"]):
                u = speed * t / width
                if u < 1:
                    self.assertAlmostEqual(-a, lift * (speed / width) ** 2 * u * u * (420 - 1680 * u + 2100 * u * u - 840 * u**3), delta=1e-3)
            self.assertGreater(min(found["contact"]), 50.0)
            self.assertTrue(isnan(found["lifts_off"][-1]))
            self.assertAlmostEqual(run("cam", coordinates, "speed=3000")["lifts_off"][-1], 2.5255e-3, delta=1e-7)

    def test_robot_arm_sags_as_beams_do(self):
        def tube(outer, inner):
            return 70e9 * pi * (outer**4 - inner**4) / 64, 2700 * pi * (outer**2 - inner**2) / 4
        (b_1, m_1), (b_2, m_2), l_1, l_2, load = tube(0.05, 0.044), tube(0.04, 0.036), 0.8, 0.7, 3 * G
        w_1, w_2 = G * m_1, G * m_2
        force, moment = load + w_2 * l_2, load * l_2 + w_2 * l_2**2 / 2  # on the end of the upper link
        end = force * l_1**3 / (3 * b_1) + w_1 * l_1**4 / (8 * b_1) + moment * l_1**2 / (2 * b_1)
        tilt = force * l_1**2 / (2 * b_1) + w_1 * l_1**3 / (6 * b_1) + moment * l_1 / b_1
        sag = 1000 * (end + tilt * l_2 + load * l_2**3 / (3 * b_2) + w_2 * l_2**4 / (8 * b_2))
        for coordinates in BOTH:
            found = run("robot_arm", coordinates)
            self.assertAlmostEqual(-found["sag"][0] / sag, 1.0, delta=0.01)  # beams that give by shear, too
            self.assertAlmostEqual(found["shoulder"][-1], degrees(0.8), delta=0.01)
            self.assertAlmostEqual(found["sag"][-1], -3.722, delta=0.005)

    def test_scissor_lift_by_virtual_work(self):
        # The platform rises twice as fast as the cylinder between B and D, above each other; slow ends have no inertia.
        force = G * (2 * (500 + 5) + 40 * (2 * 0.5 + 2 * 1.5) + 10)
        for coordinates in BOTH:
            found = run("scissor_lift", coordinates)
            self.assertAlmostEqual(1000 * found["force"][0], force, delta=0.5)
            self.assertAlmostEqual(1000 * found["force"][-1], force, delta=0.5)
            self.assertAlmostEqual(found["height"][-1] - found["height"][0], 600.0, delta=1e-4)
            self.assertAlmostEqual(found["arm"][-1], -degrees(asin(1.3 / 2) - asin(0.5)), delta=1e-6)

    def test_girder_sags_below_its_trolley(self):
        length, stiffness, weight, force = 20.0, 2.1e11 * 1.2e-3, G * 157, G * 2400
        def sag(x, a):  # of the girder under a force at a, from its end to x <= a
            own = weight * x * (length**3 - 2 * length * x**2 + x**3) / (24 * stiffness)
            return own + force * (length - a) * x * (length**2 - (length - a) ** 2 - x**2) / (6 * length * stiffness)
        for coordinates in BOTH:
            found = run("crane_with_trolley", coordinates)
            # The girder is shorter between its ends by what it bends, and gives by shear, too.
            self.assertAlmostEqual(-found["trolley_z"][0] / sag(3.0, 3.0), 1.0, delta=0.01)
            self.assertAlmostEqual(found["travel"][-1], 17.0, delta=1e-6)
            self.assertGreater(max(map(abs, found["swing"])), 0.02)


if __name__ == "__main__":
    unittest.main()
