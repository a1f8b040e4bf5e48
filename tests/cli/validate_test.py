#!/usr/bin/env python3
"""floatframe validate: tables, exit codes, places of errors, the page."""
import html.parser
import json
import math
import unittest

from run_case import RunCase

# A mass that falls: z = -g t^2 / 2, which the trapezoidal rule hits exactly; and a mass on a spring.
FALL = """\
floatframe: 1
parameters: {g: 10, k: 400}
gravity: [0, 0, "${-g}"]
bodies:
  stone: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}
  cart: {rigid: {mass: 1, centre_of_mass: [1, 0, 0], inertia: [1, 1, 1]}}
joints:
  down: {type: prismatic, child: stone, at: [0, 0, 0], axis: z}
  along: {type: prismatic, child: cart, at: [1, 0, 0], axis: x, position: 0.1}
forces:
  coil: {type: joint_spring, joint: along, spring: "${k}"}
outputs:
  z: {joint_position: down}
  x: {joint_position: along}
simulation: {step: 0.01, duration: 1, output_interval: 0.1}
"""
GOOD = """\
floatframe: 1
title: A stone and a cart
source: closed forms
model: fall.yaml
checks:
  - {quantity: fall, output: z, reference: [[0.5, -1.25], [1, -5]], absolute: 1.0e-9}
  - {output: x, reference: {file: cart.csv, column: x, scale: 0.1}, relative: 0.3}
  - {vibration: 1, value: "${20 / (2 * pi)}", relative: 1.0e-9}
"""


class Validate(RunCase):
    def setUp(self):
        super().setUp()
        self.write("good/fall.yaml", FALL)
        self.write("good/cart.csv", "t,x\n" + "".join(f"{k / 10},{math.cos(2 * k)}\n" for k in range(11)))
        self.write("good/benchmark.yaml", GOOD)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)

    def other(self, *replaced):
        text = GOOD
        for old, new in replaced:
            self.assertIn(old, text)
            text = text.replace(old, new)
        self.write("good/other.benchmark.yaml", text)

    def test_what_passes(self):
        done = self.program("validate", "good")
        self.assertIn("1 benchmark, 2 runs: 6 checks within tolerance", done.stdout)
        self.assertRegex(done.stdout, r"good +absolute +fall ")
        data = json.loads(self.program("validate", "good/benchmark.yaml", "--json").stdout)
        self.assertTrue(data["passed"])
        (benchmark,) = data["benchmarks"]
        self.assertEqual([benchmark["name"], benchmark["title"]], ["good", "A stone and a cart"])
        self.assertEqual([run["coordinates"] for run in benchmark["runs"]], ["relative", "absolute"])
        for run in benchmark["runs"]:
            fall, cart, vibration = run["checks"]
            self.assertLess(fall["error"], 1e-9)
            self.assertEqual([fall["unit"], fall["instants"], cart["instants"]], ["m", 2, 11])
            self.assertAlmostEqual(cart["tolerance"], 0.03)
            # The trapezoidal rule delays the cart by omega^3 h^2 t / 12.
            self.assertLess(abs(cart["error"] - 0.1 * 8000 * 1e-4 / 12), 2e-3)
            self.assertEqual(vibration["unit"], "Hz")

    def test_settings_coordinates_and_extrapolation(self):
        self.other(("model: fall.yaml", "model: fall.yaml\nset: {g: 20, step: 0.005}\ncoordinates: [absolute]\nextrapolate: true"),
                   ("-1.25", "-2.5"), ("-5]", "-10]"), ("relative: 0.3", "relative: 0.003"))
        data = json.loads(self.program("validate", "good", "--json").stdout)
        self.assertEqual([b["name"] for b in data["benchmarks"]], ["good", "good/other"])
        self.assertEqual([run["coordinates"] for run in data["benchmarks"][1]["runs"]], ["absolute"])

    def test_what_fails(self):
        self.other(("-5]", "-5.001]"))
        done = self.program("validate", "good", code=1)
        self.assertIn("2 of 12 checks beyond tolerance", done.stdout)
        self.assertIn("good/other, relative: z is -5 m at 1 s, the reference -5.001: beyond the tolerance of 1e-09", done.stderr)
        self.assertFalse(json.loads(self.program("validate", "good", "--json", code=1).stdout)["passed"])
        # A run that cannot be made is a failure of its own; the others are reported.
        self.write("bad/fall.yaml", FALL.replace("simulation: {", "simulation: {max_iterations: 1, min_step: 0.01, tolerance: 1.0e-15, "))
        self.write("bad/cart.csv", "t,x\n0,1\n")
        self.write("bad/benchmark.yaml", GOOD)
        done = self.program("validate", "bad", "good/benchmark.yaml", code=1)
        self.assertIn("bad, absolute: failed: ", done.stderr)
        self.assertIn("inf", done.stdout)

    def test_broken_files(self):
        self.other(("output: z", "output: zz"), ("[1, -5]", "[1, -5], [1.5, -7]"), ("column: x", "column: y"))
        self.assertIn("good/other.benchmark.yaml:7:53: checks[2].reference.column: found 'y', expected one of the columns",
                      self.program("validate", "good", code=2).stderr)
        self.other(("output: z", "output: zz"), ("[1, -5]", "[1, -5], [1.5, -7]"))
        error = self.program("validate", "good", code=2).stderr
        self.assertIn("other.benchmark.yaml:6:5: checks[1]: found the output 'zz', which 'good/fall.yaml' does not have, did you mean 'z'?", error)
        self.assertIn("checks[1]: found a reference at 1.5 s, expected multiples of the output interval of 'good/fall.yaml', 0.1 s, "
                      "up to its duration, 1 s", error)
        for old, new, sentence in (
                ("absolute: 1.0e-9", "exact: 1", "checks[1]: unknown key 'exact'"),
                (", absolute: 1.0e-9", "", "checks[1]: missing key 'absolute' or 'relative', the tolerance"),
                ("output: z,", "output: z, vibration: 2,", "checks[1]: found both 'output' and 'vibration', expected one of them"),
                ("model: fall.yaml", "", "missing key 'model'"),
                ("model: fall.yaml", "model: none.yaml", "none.yaml"),
                ("model: fall.yaml", "model: fall.yaml\nset: {h: 3}", "other.benchmark.yaml:5:6: set"),
                ("model: fall.yaml", "model: fall.yaml\ncoordinates: [natural]", "coordinates[1]: found 'natural', expected relative or absolute"),
                ("floatframe: 1", "floatframe: 2", "floatframe: found 2, expected version 1")):
            self.other((old, new))
            done = self.program("validate", "good", code=2)
            self.assertIn(sentence, done.stderr)
            self.assertEqual(done.stdout, "")
        (self.folder / "good/other.benchmark.yaml").unlink()
        self.write("empty/readme", "")
        self.assertIn("empty: found no benchmark in this folder", self.program("validate", "empty", code=2).stderr)
        self.assertIn("found 'gone', expected a folder", self.program("validate", "gone", code=2).stderr)
        self.assertIn("good/benchmark.yaml", self.program("validate", "good", "--report", "good/benchmark.yaml", code=2).stderr)

    def test_the_page(self):
        self.write("good/fall.yaml", "name: a<b\n" + FALL)
        for _ in range(2):  # its own page is replaced
            self.program("validate", "good", "--report", "page.html")
        page = (self.folder / "page.html").read_text()
        html.parser.HTMLParser().feed(page)
        self.assertEqual(page.count("<figure>"), 2)
        self.assertEqual(page.count('class="dot"'), 2)
        self.assertIn("<td>vibration 1</td>", page)
        for word in ("<script", "http:", "https:", "<link"):
            self.assertNotIn(word, page)


if __name__ == "__main__":
    unittest.main()
