#!/usr/bin/env python3
"""Loops as a designer of mechanisms draws them, from model file to results: they close as drawn, axes with few digits do not lock
them, locked and singular ones say so, reactions of many legs cost little. Set FLOATFRAME_BINARY."""
import csv
import json
import math
import os
import pathlib
import subprocess
import tempfile
import unittest

BINARY = str(pathlib.Path(os.environ.get("FLOATFRAME_BINARY", "build/floatframe")).resolve())
LOOPS = pathlib.Path(__file__).resolve().parents[1] / "data" / "loops"


def program(*arguments):
    return subprocess.run([BINARY, *map(str, arguments)], capture_output=True, text=True, timeout=120)


class Loops(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def run_model(self, name, *options):
        """Completed process, results by column, summary."""
        out = pathlib.Path(self.folder.name) / "out"
        done = program("run", LOOPS / f"{name}.yaml", "--out", out, "--overwrite", "--quiet", "--no-report", "--record", "none", *options)
        if done.returncode != 0:
            return done, {}, {}
        with open(out / "results.csv", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        columns = {name.split(" ")[0]: [float(row[k]) for row in rows[1:]] for k, name in enumerate(rows[0])}
        return done, columns, json.loads((out / "summary.json").read_text(encoding="utf-8"))

    def test_a_scotch_yoke_keeps_its_block_upright(self):
        done, x, _ = self.run_model("scotch_yoke")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertAlmostEqual(x["block.z"][0], 0.05 + 0.1 * math.sin(2.0), 9)
        for angle in ("roll", "pitch", "yaw"):
            self.assertLess(abs(x[f"turn.{angle}"][0]), 1e-9)

    def test_a_parallelogram_passes_the_flat_position(self):
        done, x, _ = self.run_model("parallelogram")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertAlmostEqual(x["d"][0], 1.7, 9)
        for half in "LR":
            self.assertLess(abs(x[f"{half}.pitch"][0]), 1e-9)

    def test_axes_of_different_digits_move(self):
        done, x, _ = self.run_model("different_digits")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertAlmostEqual(x["C.x"][-1], 2.318, 3)
        self.assertIn("degrees of freedom: 1", program("check", LOOPS / "different_digits.yaml").stdout)
        done = program("statics", LOOPS / "different_digits.yaml", "--json")
        largest = max(abs(f) for joint in json.loads(done.stdout)["joints"] for f in joint["force"])
        self.assertLess(largest, 100.0)  # of 40 N of weight

    def test_axes_of_six_decimals_move(self):
        for coordinates in ("relative", "absolute"):
            done, x, _ = self.run_model("six_decimals", "--coordinates", coordinates)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertAlmostEqual(x["d"][-1], self.aligned(), 5)

    def aligned(self):
        """The angle of the rocker at 7 s of the linkage in its plane, in closed form."""
        points = {"A": (0.0, 0.0, 0.0), "B": (0.035857, 0.071714, -0.059761), "C": (0.465341, 0.036256, -0.179284), "D": (0.357771, -0.178885, 0.0)}
        normal = [k / math.sqrt(14.0) for k in (1.0, 2.0, 3.0)]
        dot = lambda a, b: sum(p * q for p, q in zip(a, b))
        cross = lambda a, b: (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
        e1 = cross(normal, (1.0, 0.0, 0.0))
        e1 = [c / math.sqrt(dot(e1, e1)) for c in e1]
        e2 = cross(normal, e1)
        flat = {name: complex(dot(p, e1), dot(p, e2)) for name, p in points.items()}
        coupler, rocker = abs(flat["C"] - flat["B"]), abs(flat["C"] - flat["D"])
        side = ((flat["C"] - flat["B"]) / (flat["D"] - flat["B"])).imag
        turn, at = 0.0, flat["C"] - flat["D"]
        for k in range(1, 7001):
            pin = (flat["B"] - flat["A"]) * complex(math.cos(k * 1e-3), math.sin(k * 1e-3)) + flat["A"]
            d = flat["D"] - pin
            along = (coupler**2 - rocker**2 + abs(d) ** 2) / (2.0 * abs(d))
            off = math.sqrt(coupler**2 - along**2) * (1.0 if side > 0.0 else -1.0)
            now = pin + d / abs(d) * complex(along, off) - flat["D"]
            turn += math.atan2((now / at).imag, (now / at).real)
            at = now
        return turn

    def test_a_pin_a_millionth_out_of_line_moves_as_if_aligned(self):
        ends = []
        for coordinates in ("relative", "absolute"):
            done, x, _ = self.run_model("pin_out_of_line", "--coordinates", coordinates)
            self.assertEqual(done.returncode, 0, done.stderr)
            ends.append(x["D"][-1])
        text = (LOOPS / "pin_out_of_line.yaml").read_text(encoding="utf-8")
        exact = pathlib.Path(self.folder.name) / "exact.yaml"
        exact.write_text(text.replace("[0, 0.9999999999995, 9.999999999998333e-07]", "y"), encoding="utf-8")
        done, x, _ = self.run_model(exact.with_suffix(""))
        for end in ends:
            self.assertAlmostEqual(end, x["D"][-1], 5)
        self.assertIn("are made exactly parallel: by up to 7.5e-07 rad", program("check", LOOPS / "pin_out_of_line.yaml").stdout)
        text = text.replace("floatframe: 1", "floatframe: 1\nsnap: false")
        exact.write_text(text, encoding="utf-8")
        self.assertIn("0 degrees of freedom: joint 'C' is 5.73e-05 degrees out of line", program("check", exact).stdout)

    def test_a_pin_one_degree_out_of_line_is_locked(self):
        sentence = "0 degrees of freedom: joint 'C' is 1 degree out of line with 'A', 'B' and 'D'"
        done, _, _ = self.run_model("pin_one_degree_out")
        self.assertEqual(done.returncode, 1)
        self.assertIn(sentence, done.stderr)
        shown = program("check", LOOPS / "pin_one_degree_out.yaml").stdout
        self.assertIn(sentence, shown)
        self.assertNotIn("joint 'A': prescribed motion", shown)
        self.assertIn(sentence, program("statics", LOOPS / "pin_one_degree_out.yaml").stdout)

    def test_one_leg_has_no_false_alarm(self):
        for coordinates in ("relative", "absolute"):
            done, _, _ = self.run_model("one_leg", "--coordinates", coordinates, "--strict")
            self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_a_flat_scissor_lift_says_that_it_is_singular(self):
        shown = program("check", LOOPS / "scissor_lift.yaml", "--set", "a=0").stdout
        self.assertIn("is in a singular position: 3 degrees of freedom there, 1 anywhere near", shown)
        self.assertIn("14 constraints are redundant, 2 of them in this position only", shown)
        self.assertNotIn("singular", program("check", LOOPS / "scissor_lift.yaml").stdout)

    def test_a_dead_straight_toggle_has_no_equilibrium(self):
        done = program("statics", LOOPS / "toggle.yaml")
        self.assertEqual(done.returncode, 1)
        self.assertIn("no equilibrium: the loop of joints 'A', 'K' and 'B' is in a singular position", done.stderr)

    def test_a_slider_on_a_beam_that_bends_has_a_note(self):
        shown = program("check", LOOPS / "slider_on_flexible_beam.yaml").stdout
        self.assertIn("joint 's' slides along the straight tangent of body 'beam'", shown)

    def test_snap_is_a_key_of_the_model(self):
        model = pathlib.Path(self.folder.name) / "model.yaml"
        text = (LOOPS / "six_decimals.yaml").read_text(encoding="utf-8")
        for value, message in (("3", "found 3, expected true or false"), ("{angle: 1}", "expected an angle from 0 to 0.1"),
                               ("{angel: 1e-3}", "angel")):
            model.write_text(text.replace("name: cad", f"snap: {value}"), encoding="utf-8")
            done = program("check", model)
            self.assertEqual(done.returncode, 2)
            self.assertIn(message, done.stderr)

    def test_all_axes_that_lock_later_are_made_exact(self):
        """Misses of 1e-7 lock an Oldham coupling and a joint of Cardan whose cross has four hinges only after half a radian."""
        for coordinates in ("relative", "absolute"):
            done, x, _ = self.run_model("oldham", "--coordinates", coordinates)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertAlmostEqual(x["d"][-1], 6.5, 6)
            done, x, _ = self.run_model("cross_of_four_hinges", "--coordinates", coordinates)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertAlmostEqual(x["d"][-1], math.atan(math.tan(6.5) * math.cos(0.3)) + 2 * math.pi, 5)

    def test_three_ball_joints_on_a_line_turn(self):
        shown = program("check", LOOPS / "three_balls.yaml").stdout
        self.assertIn("degrees of freedom: 1", shown)
        self.assertIn("'p1', 'p2' and 'p3' are made exactly those of one line: by up to 0.000451 m (joint 'p2')", shown)

    def varied_bar(self, *changes):
        text = (LOOPS / "bar_on_ball_joint.yaml").read_text(encoding="utf-8")
        for old, new in zip(changes[::2], changes[1::2]):
            self.assertIn(old, text)
            text = text.replace(old, new)
        model = pathlib.Path(self.folder.name) / "model.yaml"
        model.write_text(text, encoding="utf-8")
        return model.with_suffix("")

    def test_soft_bars_and_bars_on_universal_joints_keep_their_energy(self):
        hooke = ("type: spherical", "type: universal, axis: x, axis_2: y", "[3, 1, 2]", "[2, 3]")
        soft = ("young: 2e9", "young: 2e8", "[3, 1, 2]", "[-2, 4, 3]")
        for changes in (soft, hooke):
            model = self.varied_bar(*changes)
            for coordinates in ("relative", "absolute"):
                options = ("--coordinates", coordinates, "--step", "0.001", "--duration", "20")
                done, _, _ = self.run_model(model, *options)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertNotIn("energy balance", done.stderr)

    def test_gained_energy_of_vibrations_names_the_spectral_radius(self):
        """With inertia about its axis the bar has no motion without mass, and steps no damping."""
        model = self.varied_bar("normal_modes: 3", "normal_modes: 3\n      mass_model: hermite\n      section_inertia: true")
        absolute = ("--coordinates", "absolute", "--step", "0.001", "--duration", "20")
        done, _, _ = self.run_model(model, *absolute)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("take a smaller step than 0.001 s, or a spectral radius of 0.8", done.stderr)
        for name, options, noted in ((model, ("--set", "spectral_radius=0.8"), False), ("bar_on_ball_joint", (), True)):
            done, _, summary = self.run_model(name, *absolute, *options)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertNotIn("energy balance", done.stderr)
            self.assertEqual("gives way to a spectral radius of 0.7" in str(summary["start"]), noted)

    def test_only_joints_that_slide_along_a_body_have_a_note(self):
        text = (LOOPS / "slider_on_flexible_beam.yaml").read_text(encoding="utf-8")
        self.assertIn("axis: x", text)
        model = pathlib.Path(self.folder.name) / "model.yaml"
        for axis, noted in (("x", True), ("z", False)):
            model.write_text(text.replace("axis: x", f"axis: {axis}"), encoding="utf-8")
            self.assertEqual("straight tangent" in program("check", model).stdout, noted, axis)

    def test_a_bar_that_comes_to_spin_without_inertia(self):
        """The angles of its universal joint lose their mass on the way."""
        done, fine, _ = self.run_model("near_spin", "--coordinates", "absolute", "--step", "0.00002")
        self.assertEqual(done.returncode, 0, done.stderr)
        for coordinates in ("absolute", "relative"):
            done, x, _ = self.run_model("near_spin", "--coordinates", coordinates)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertNotIn("energy balance", done.stderr)
            for axis in "xyz":
                self.assertAlmostEqual(x[f"b3.{axis}"][-1], fine[f"b3.{axis}"][-1], delta=0.02)


if __name__ == "__main__":
    unittest.main()
