#!/usr/bin/env python3
"""`floatframe response` from outside: the quarter car by its closed form in JSON, CSV and text; misuse."""
import cmath
import csv
import io
import json
import math
import os
import pathlib
import unittest
import xml.etree.ElementTree

from run_case import RunCase

EXAMPLES = pathlib.Path(os.environ.get("FLOATFRAME_EXAMPLES") or pathlib.Path(__file__).resolve().parents[2] / "examples")
CAR = str(EXAMPLES / "quarter_car" / "quarter_car.yaml")


def acceleration(f):
    """Of the body for a unit of the road."""
    s = 2j * math.pi * f
    strut, tyre = 20000 + 1500 * s, 2e5 + 100 * s
    a = 300 * s * s + strut
    return s * s * strut * tyre / (a * (40 * s * s + strut + tyre) - strut * strut)


class Response(RunCase):
    def test_quarter_car(self):
        done = self.program("response", CAR, "--inputs", "road", "--outputs", "body.az", "--from", "0.2", "--to", "40", "--points",
                            "50", "--json", "--csv", "r.csv", "--svg", "r.svg", "--harmonic", "road=0.02@3")
        result = json.loads(done.stdout)
        curve, = result["responses"]
        self.assertEqual((curve["output"], curve["input"], curve["unit"]), ("body.az", "road", "m/s2 per m"))
        self.assertEqual(len(result["frequencies_Hz"]), 50)
        self.assertEqual((result["frequencies_Hz"][0], result["frequencies_Hz"][-1]), (0.2, 40))
        table = list(csv.reader(io.StringIO((self.folder / "r.csv").read_text())))
        self.assertEqual(table[0][:3], ["frequency [Hz]", "body.az / road magnitude [m/s2 per m]", "body.az / road phase [deg]"])
        for k, f in enumerate(result["frequencies_Hz"]):
            expected = acceleration(f)
            self.assertLess(abs(complex(curve["real"][k], curve["imaginary"][k]) - expected), 1e-6 * abs(expected))
            self.assertAlmostEqual(curve["magnitude"][k], abs(expected), delta=1e-6 * abs(expected))
            turn = curve["phase_deg"][k] - math.degrees(cmath.phase(expected))
            self.assertAlmostEqual(turn, 360 * round(turn / 360), delta=1e-4)
            row = [float(x) for x in table[k + 1]]
            self.assertAlmostEqual(row[1], curve["magnitude"][k], delta=1e-9 * row[1])
        harmonic, = result["harmonic"]
        output, = harmonic["outputs"]
        self.assertAlmostEqual(output["amplitude"], 0.02 * abs(acceleration(3)), delta=1e-6)
        self.assertAlmostEqual(output["phase_deg"], math.degrees(cmath.phase(acceleration(3))), places=4)
        root = xml.etree.ElementTree.parse(self.folder / "r.svg").getroot()
        self.assertTrue(root.tag.endswith("svg"))

    def test_road(self):
        result = json.loads(self.program("response", CAR, "--road-spectrum", "C", "--speed", "20", "--to", "60", "--json").stdout)
        self.assertEqual(result["responses"], [])
        road = result["road"]
        self.assertEqual((road["roughness_m3"], road["waviness"], road["speed_m_s"]), (256e-6, 2, 20))
        rms = {o["name"]: o["rms"] for o in road["outputs"]}
        self.assertAlmostEqual(rms["body.az"], 1.44597, places=4)
        self.assertAlmostEqual(rms["travel"], 0.0106499, places=6)
        text = self.program("response", CAR, "--road-spectrum", "0.000256", "--speed", "20", "--to", "60").stdout
        self.assertIn("from 0.22 to 56.6 Hz", text)
        self.assertIn("1.446", text)

    def test_misuse(self):
        for arguments, sentence in (
                (("--road-spectrum", "K", "--speed", "20"), "--road-spectrum: found 'K', expected a class, A to H, or the roughness"),
                (("--road-spectrum", "C"), "--road-spectrum needs --speed, a positive number [m/s]"),
                (("--speed", "20"), "--speed is of --road-spectrum, which is not given"),
                (("--harmonic", "road=1"), "--harmonic: found 'road=1', expected INPUT=AMPLITUDE@HERTZ"),
                (("--harmonic", "rad=1@2"), "unknown input 'rad', did you mean 'road'?"),
                (("--outputs", "body.ax"), "unknown output 'body.ax', did you mean 'body.az'?"),
                (("--from", "5", "--to", "2"), "--to: found 2 Hz, expected more than --from, 5 Hz")):
            done = self.program("response", CAR, *arguments, code=2)
            self.assertIn(sentence, done.stderr)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)


if __name__ == "__main__":
    unittest.main()
