#!/usr/bin/env python3
"""Hints of `floatframe check`: forty models that are right print none, models with the usual mistakes each print theirs, and
the table of bending says how a section lies. Unstable equilibria in statics and runs. Set FLOATFRAME_BINARY."""
import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

BINARY = str(pathlib.Path(os.environ.get("FLOATFRAME_BINARY", "build/floatframe")).resolve())
ROOT = pathlib.Path(__file__).resolve().parents[2]
HINTS = ROOT / "tests" / "data" / "hints"
EXAMPLES, RANGE, GOOD = ROOT / "examples", ROOT / "tests" / "data" / "range", ROOT / "tests" / "data" / "good_models"

# Models that are right, with parameters; those of a model file and its options each count once.
RIGHT = [
    *[(EXAMPLES / "iltis" / "iltis.yaml", options) for options in (
        [], ["flexible=false"], ["road=bump"], ["road=flat"], ["tyre_law=radial"], ["mass_model=hermite"], ["mass_model=six_dof"],
        ["start=given"], ["flexible=false", "road=bump", "speed=10"], ["compensated=false"])],
    *[(EXAMPLES / "active_damper" / "active_damper.yaml", options) for options in ([], ["flexible=false"])],
    *[(EXAMPLES / "iltis_solid" / "iltis_solid.yaml", options) for options in ([], ["flexible_arm=false"], ["flexible=false"])],
    *[(EXAMPLES / "flexible_pendulum" / "flexible_pendulum.yaml", options) for options in (
        [], ["mass_model=hermite"], ["mass_model=six_dof"])],
    *[(EXAMPLES / "slider_crank" / "slider_crank.yaml", options) for options in (
        [], ["mass_model=hermite"], ["mass_model=six_dof"], ["angle=3"])],
    *[(EXAMPLES / "spin_up" / "spin_up.yaml", options) for options in ([], ["stiffening=false"], ["ne=8"])],
    *[(EXAMPLES / "rotor" / "rotor.yaml", options) for options in (
        [], ["speed=500"], ["section_inertia=false"], ["stiffening=false"])],
    (EXAMPLES / "rotor" / "lalanne_ferraris.yaml", []),
    *[(EXAMPLES / "quarter_car" / "quarter_car.yaml", options) for options in ([], ["class=A"], ["tyre_stiffness=1e5"])],
    *[(RANGE / f"{name}.yaml", []) for name in (
        "cantilever", "driven_arm", "massless", "pendulum", "springs", "spinning_beam", "tyre", "set_point_step", "free_top")],
    (GOOD / "inputs.yaml", []),
    (HINTS / "rolling_tyre.yaml", []),
]
HINTS = ROOT / "tests" / "data" / "hints"
EXAMPLES, RANGE, GOOD = ROOT / "examples", ROOT / "tests" / "data" / "range", ROOT / "tests" / "data" / "good_models"

# Models that are right, with parameters; those of a model file and its options each count once.
RIGHT = [
    *[(EXAMPLES / "iltis" / "iltis.yaml", options) for options in (
        [], ["flexible=false"], ["road=bump"], ["road=flat"], ["tyre_law=radial"], ["mass_model=hermite"], ["mass_model=six_dof"],
        ["start=given"], ["flexible=false", "road=bump", "speed=10"], ["compensated=false"])],
    *[(EXAMPLES / "active_damper" / "active_damper.yaml", options) for options in ([], ["flexible=false"])],
    *[(EXAMPLES / "iltis_solid" / "iltis_solid.yaml", options) for options in ([], ["flexible_arm=false"], ["flexible=false"])],
    *[(EXAMPLES / "flexible_pendulum" / "flexible_pendulum.yaml", options) for options in (
        [], ["mass_model=hermite"], ["mass_model=six_dof"])],
    *[(EXAMPLES / "slider_crank" / "slider_crank.yaml", options) for options in (
        [], ["mass_model=hermite"], ["mass_model=six_dof"], ["angle=3"])],
    *[(EXAMPLES / "spin_up" / "spin_up.yaml", options) for options in ([], ["stiffening=false"], ["ne=8"])],
    *[(EXAMPLES / "rotor" / "rotor.yaml", options) for options in (
        [], ["speed=500"], ["section_inertia=false"], ["stiffening=false"])],
    (EXAMPLES / "rotor" / "lalanne_ferraris.yaml", []),
    *[(EXAMPLES / "quarter_car" / "quarter_car.yaml", options) for options in ([], ["class=A"], ["tyre_stiffness=1e5"])],
    *[(RANGE / f"{name}.yaml", []) for name in (
        "cantilever", "driven_arm", "massless", "pendulum", "springs", "spinning_beam", "tyre", "set_point_step", "free_top")],
    (GOOD / "inputs.yaml", []),
    (HINTS / "rolling_tyre.yaml", []),
    *[(EXAMPLES / "iltis" / "handling.yaml", options) for options in ([], ["tyre_law=calspan"], ["road=rough"], ["speed=5"])],
    *[(EXAMPLES / "small_car" / "small_car.yaml", options) for options in ([], ["tyre=tmeasy"], ["tyre=mf"], ["road=rough"])],
]
HINT = re.compile(r"unusual|angles are in radians|no inertia|is clamped at|wheel centre|unstable|slips by|in mm")
CARS = [
    *[(EXAMPLES / "iltis" / "handling.yaml", options) for options in ([], ["tyre_law=calspan"], ["road=rough"], ["speed=5"])],
    *[(EXAMPLES / "small_car" / "small_car.yaml", options) for options in ([], ["tyre=tmeasy"], ["tyre=mf"], ["road=rough"])],
]



def program(*arguments):
    done = subprocess.run([BINARY, *map(str, arguments)], capture_output=True, text=True, timeout=300)
    return done.returncode, done.stdout, done.stderr


def check(model, *options):
    code, out, errors = program("check", model, *[x for o in options for x in ("--set", o)])
    return code, [line.strip() for line in out.splitlines() if line.startswith("  note: ")], out, errors


class Hints(unittest.TestCase):
    def test_right_models_print_none(self):
        self.assertGreaterEqual(len(RIGHT), 40)
        for model, options in RIGHT:
            with self.subTest(model=model.name, options=options):
                code, notes, _, errors = check(model, *options)
                self.assertEqual((code, "warning" in errors), (0, False), errors)
                self.assertEqual([n for n in notes if HINT.search(n)], [])

    def test_wrong_models_print_theirs(self):
        for name, sentences in {
                "bars_in_millimetres": ["body 'beam': its material has a Young's modulus of 2.1e+05 Pa and a density of 7.85e-09 "
                                        "kg/m3, which is unusual; it may be in mm-t-s"],
                "millimetres": ["it may be in mm-t-s", "its points are up to 2000 m apart"],
                "section_in_millimetres": ["the section of its bar 'a' measures 60 m"],
                "density_in_g_per_cm3": ["the density may be in g/cm3"],
                "degrees": ["its position of 30 rad is 4.77 turns; angles are in radians (30 degrees are 0.5236 rad)",
                            "an angle of its orientation of 90 rad", "an entry of its motion of 45 rad",
                            "the amplitude of its motion of 20 rad", "its target of 45 rad"],
                "section_on_edge": ["it is clamped at 'r' (y, z), where no joint, rod or force acts"],
                "tyre_radius": ["tyre 'front': its wheel centre is 0.3 m above the road and its radius is 0.6 m, so that at the "
                                "start the road presses 0.3 m into it with 6e+04 N"],
                "inverted": ["the equilibrium is unstable: body 'rod'"]}.items():
            with self.subTest(model=name):
                code, notes, out, errors = check(HINTS / f"{name}.yaml")
                self.assertEqual((code, errors), (0, ""), out)
                for sentence in sentences:
                    self.assertEqual(len([n for n in notes if sentence in n]), 1, notes)
                document = json.loads(program("check", HINTS / f"{name}.yaml", "--json")[1])
                self.assertEqual(["note: " + n for n in document["start"]["notes"]], notes)

    def test_a_wheel_at_its_place(self):
        for radius, height, said in (0.3, 0.29, 0), (0.3, 0.8, 0), (0.3, 1.5, 1), (0.3, 0.1, 1):
            _, notes, _, _ = check(HINTS / "tyre_radius.yaml", f"radius={radius}", f"height={height}")
            self.assertEqual(len([n for n in notes if "wheel centre" in n]), said, (radius, height, notes))
        self.assertIn("the wheel hangs 1.2 m in the air", check(HINTS / "tyre_radius.yaml", "radius=0.3", "height=1.5")[1][0])

    def test_a_wheel_that_rolls(self):
        for options, sentence in (
                (["spin=-68"], "at the start its wheel turns backwards: the contact slips by 1"),
                (["axis=-1"], "joint 'spin' turns at 68 rad/s, and it would roll with a velocity of -6"),
                (["spin=0"], "at the start its wheel does not turn: the contact slips by 100 % of the speed of 20 m/s; joint 'spin' "
                             "turns at 0 rad/s, and it would roll with a velocity of 6"),
                (["height=0.306"], "the wheel hangs 0.006 m in the air"),
                (["height=0.23"], "the road presses 0.07 m into it"),
                (["height=0.37", "start=equilibrium"], "the wheel hangs 0.07 m in the air"),
                (["radius=300"], "its radius of 300 m is unusual; it may be in mm"),
                (["radius=3e-4"], "its radius of 0.0003 m is unusual; it may be in m and was taken for mm"),
                (["scale=1000"], "body 'carrier': points at which it is held are up to 499.8 m apart, and a wheel has a radius of 0.3 m"),
        ):
            with self.subTest(options=options):
                code, notes, out, errors = check(HINTS / "rolling_tyre.yaml", *options)
                self.assertEqual(code, 0, out + errors)
                self.assertEqual(len([n for n in notes if sentence in n]), 1, notes)
        for model, options in CARS:
            self.assertEqual([n for n in check(model, *options)[1] if re.search("wheel centre|slips by|in mm|its radius", n)], [], (model.name, options))
        for options in (["spin=0", "speed=0"], ["height=0.306", "start=equilibrium"], ["spin=90"], ["axis=-1", "spin=-68"]):
            self.assertEqual([n for n in check(HINTS / "rolling_tyre.yaml", *options)[1] if HINT.search(n)], [], options)

    def test_inertia_that_is_missing(self):
        code, _, out, errors = check(HINTS / "no_inertia.yaml")
        self.assertEqual((code, out), (1, ""))
        self.assertIn("body 'm' can move without mass, stiffness or constraint; body 'm' has no inertia: the key 'inertia' is "
                      "missing or zero, give it [kg m2], or remove the freedom", errors)
        self.assertNotIn("bar", errors)

    def test_bending_says_how_a_section_lies(self):
        def rows(*options):
            out = check(HINTS / "section_on_edge.yaml", *options)[2]
            return re.findall(r"^  beam +a, b +(\S+) +(\S+) +(\S+) +(\S+)$", out, re.MULTILINE)
        self.assertEqual(rows(), [("z", "43750", "y", "7000")])
        self.assertEqual(rows("width=0.02", "height=0.05"), [("y", "43750", "z", "7000")])
        bending = json.loads(program("check", HINTS / "section_on_edge.yaml", "--json")[1])["bending"]
        self.assertEqual([(b["body"], b["bars"]) for b in bending], [("beam", ["a", "b"])])
        self.assertEqual([s["direction"] for s in bending[0]["sides"]], [[0, 0, 1], [0, 1, 0]])
        self.assertAlmostEqual(bending[0]["sides"][0]["stiffness_N_m2"], 43750)
        self.assertRegex(check(EXAMPLES / "iltis" / "iltis.yaml")[2], r"(?m)^  front_left\.link +\S.*any +\S+$")
        self.assertNotIn("bending", check(RANGE / "pendulum.yaml")[2])

    def test_unstable_equilibria_are_said(self):
        model = HINTS / "inverted.yaml"
        code, out, errors = program("statics", model)
        self.assertEqual((code, errors), (0, ""))
        self.assertRegex(out, r"(?m)^  note: the equilibrium is unstable: body 'rod' would leave it at the smallest push, by e in "
                              r"0\.247 s;")
        self.assertEqual(len(json.loads(program("statics", model, "--json")[1])["notes"]), 1)
        with tempfile.TemporaryDirectory() as folder:
            code, out, errors = program("run", model, "--out", pathlib.Path(folder) / "out", "--no-report")
            self.assertEqual(code, 0, errors)
            self.assertIn("the equilibrium is unstable", out + errors)
            # A note is no warning.
            self.assertEqual(program("run", model, "--out", pathlib.Path(folder) / "again", "--no-report", "--strict")[0], 0)


if __name__ == "__main__":
    unittest.main(verbosity=2)
