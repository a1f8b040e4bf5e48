#!/usr/bin/env python3
"""Makes lsim_of_noise.json beside this file: the response of a transfer function of order 6 to the noise of a formula, by
SciPy's lsim, which is exact at the nodes of a piecewise linear input. The nodes are those that the program writes.

usage: tests/data/blocks/lsim_of_noise.py build/floatframe
"""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy
import scipy.signal

SEED, INTERVAL, DURATION = 7, 0.05, 6.0
PAIRS = (3.0, 0.1), (8.0, 0.2), (15.0, 0.3)  # of poles: rad/s, damping ratio
NUMERATOR = [40.0, 900.0, 5000.0, 120000.0]
MODEL = f"""\
floatframe: 1
bodies: {{box: {{position: [0, 0, 0], rigid: {{mass: 1}}}}}}
joints: {{slide: {{type: prismatic, child: box, at: [0, 0, 0], axis: x}}}}
outputs: {{noise: {{formula: "noise({SEED}, {INTERVAL})"}}}}
simulation: {{step: {INTERVAL}, duration: {DURATION}}}
"""


def noise(program):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "noise.yaml"
        path.write_text(MODEL, encoding="utf-8")
        subprocess.run([program, "run", path, "--quiet", "--no-report", "--out", folder + "/out"], check=True)
        with open(folder + "/out/results.csv", encoding="utf-8") as file:
            return [float(row["noise [-]"]) for row in csv.DictReader(file)]


def main():
    u = noise(sys.argv[1])
    denominator = numpy.array([1.0])
    for w, damping in PAIRS:
        denominator = numpy.polymul(denominator, [1.0, 2.0 * damping * w, w * w])
    t = INTERVAL * numpy.arange(len(u))
    _, y, _ = scipy.signal.lsim((NUMERATOR, denominator), u, t, interp=True)
    lists = {"numerator": NUMERATOR, "denominator": denominator.tolist(), "noise": u, "response": y.tolist()}
    text = ",\n".join(f'"{name}": {json.dumps(value)}' for name, value in
                      ({"made_with": f"SciPy {scipy.__version__}", "seed": SEED, "interval_s": INTERVAL} | lists).items())
    pathlib.Path(__file__).with_suffix(".json").write_text("{\n" + text + "\n}\n", encoding="utf-8")


main()
