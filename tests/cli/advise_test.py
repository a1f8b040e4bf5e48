#!/usr/bin/env python3
"""`floatframe advise` from outside: text, JSON, messages."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

BINARY = os.environ.get("FLOATFRAME_BINARY") or (
    sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else "build/floatframe")
BINARY = str(pathlib.Path(BINARY).resolve())
EXAMPLES = pathlib.Path(os.environ.get("FLOATFRAME_EXAMPLES") or
                        pathlib.Path(__file__).resolve().parents[2] / "examples")
CRANK = str(EXAMPLES / "slider_crank" / "slider_crank.yaml")
ILTIS = str(EXAMPLES / "iltis" / "iltis.yaml")


class Advise(unittest.TestCase):
    def advise(self, code, *arguments):
        with tempfile.TemporaryDirectory(prefix="floatframe-advise-") as folder:
            done = subprocess.run([BINARY, "advise", *map(str, arguments)], cwd=folder, capture_output=True, text=True,
                                  timeout=200, check=False)
            self.assertEqual(list(pathlib.Path(folder).iterdir()), [], "it writes no files")
        self.assertEqual(done.returncode, code, done.stderr + done.stdout)
        return done

    def test_mechanism_that_needs_all_its_modes(self):
        done = self.advise(0, CRANK, "--duration", 0.05, "--repeat", 1)
        for part in ("slider_crank: 4 modes of 2 flexible bodies, step 0.0001 s, run for 0.05 s", "static crank_pin uy",
                     "normal 1", "No mode can be dropped."):
            self.assertIn(part, done.stdout)

    def test_vehicle_at_a_long_step(self):
        figures = json.loads(self.advise(0, ILTIS, "--duration", 1.5, "--repeat", 1, "--json").stdout)
        self.assertEqual((figures["model"], figures["step_s"], figures["modes"]), ("iltis", 0.01, 64))
        self.assertGreater(figures["dropped"], 0)
        self.assertEqual(sum(mode["action"] == "drop" for body in figures["bodies"] for mode in body["modes"]),
                         figures["dropped"])
        for body in figures["bodies"]:
            for mode in body["modes"]:
                self.assertGreater(mode["omega_h"], 3.14)
                self.assertIn(mode["action"], ("drop", "quasi-static"))
                if mode["action"] == "drop":
                    self.assertLess(mode["static_share"], 1e-3)
                    self.assertLess(mode["dynamic_share"], 1e-3)
            # The leaf-spring side carries the vehicle: static modes of the arm stay.
            if body["body"] == "front_left.arm":
                self.assertEqual([mode["action"] for mode in body["modes"]][:2], ["quasi-static"] * 2)
        for output in figures["differences"]:
            self.assertLessEqual(output["relative"], 0.01, output)
        self.assertLess(figures["reduced"]["flops_per_step"], figures["full"]["flops_per_step"])
        # At a short step the softest modes are resolved.
        short = json.loads(self.advise(0, ILTIS, "--duration", 0.05, "--step", 1e-4, "--repeat", 1, "--json").stdout)
        self.assertLess(min(mode["omega_h"] for body in short["bodies"] for mode in body["modes"]), 1)

    def test_bad_options_exit_2_with_one_line(self):
        for arguments, message in (
                (("nowhere.yaml",), "nowhere.yaml: "),
                ((CRANK, "--step", "0"), "--step: found '0', expected a positive number [s]"),
                ((CRANK, "--duration", "1e-9"), "the run is shorter than one step; give a --duration"),
                ((CRANK, "--step", "1e-12"), "takes more than 1e+07 steps; give a shorter --duration"),
                ((CRANK, "--share", "2"), "--share"),
                ((CRANK, "--tolerance", "-1"), "--tolerance")):
            with self.subTest(arguments=arguments):
                done = self.advise(2, *arguments)
                self.assertIn(message, done.stderr)
                self.assertEqual(done.stderr.count("\n"), 1, done.stderr)


if __name__ == "__main__":
    unittest.main()
