#!/usr/bin/env python3
"""Hostile formulas, blocks, constraints, couplings, tables and functions of time, each in an otherwise valid model (hostile_inputs.txt beside this
file): one sentence with its place, exit code 2; or, where they fail during the run, one sentence with the time, exit code 1,
and the rows before are kept. `--print` prints the sentences."""
import concurrent.futures
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
BINARY = str(pathlib.Path(os.environ.get("FLOATFRAME_BINARY") or "build/floatframe").resolve())
LIMITED = not os.environ.get("FLOATFRAME_SANITIZE")
# <place>: what a case replaces, and what stands there otherwise.
MODEL = """\
floatframe: 1
parameters: {kp: 60, fast: 3}
inputs: {u: {unit: N}}
bodies:
  arm: {rigid: {mass: 1, centre_of_mass: [0.3, 0, 0], inertia: [0.01, 0.03, 0.03]}}
  box: {position: [0, 1, 0], rigid: {mass: 1}}
  disc: {position: [0, 2, 0], rigid: {mass: 1, inertia: [0.1, 0.1, 0.1]}}
  stone: {position: [0, 3, 0], rigid: {mass: 1, inertia: [0.1, 0.1, 0.1]}}
  brick: {position: [0, 4, 0], rigid: {mass: 1, inertia: [0.1, 0.1, 0.1]}}
  lump: {position: [0, 5, 0], rigid: {mass: 1, inertia: [0.1, 0.1, 0.1]}}
  pipe: {position: [0, 6, 0], rigid: {mass: 1, inertia: [0.1, 0.1, 0.1]}}
  nut: {position: [0, 5, 0], rigid: {mass: 1, inertia: [0.1, 0.1, 0.1]}}
joints:
  hinge: {type: revolute, child: arm, at: [0, 0, 0], axis: y}
  slide: {type: prismatic, child: box, at: [0, 1, 0], axis: x}
  ball: {type: spherical, child: stone, at: [0, 3, 0.1]<onball: >}
  both: {type: revolute, child: disc, at: [0, 2, 0], axis: y, motion: <motion: 0>}
  fix: {type: weld, child: brick, at: [0, 4, 0]<onweld: >}
  rail: {type: prismatic, child: lump, at: [0, 5, 0], axis: x, stops: <stops: {upper: 1, stiffness: 1000}>,
    friction: <friction: {breakaway: 1, stiffness: 1.0e+4}>}
  tube: {type: cylindrical, child: pipe, at: [0, 6, 0], axis: x, stops: <many: {angle: {upper: 3, stiffness: 10}}>,
    friction: <rub: {displacement: {breakaway: 1, stiffness: 1.0e+4}}>}
  nut: {type: cylindrical, child: nut, at: [0, 5, 0], axis: x}
measures: {tip: {position: {body: arm, at: [0.6, 0, 0]}}, q: <measure: {joint_position: hinge}>}
tables: {gas: {table: [[0, 3], [1, 4]]}, map: {grid: {x: [0, 1], y: [0, 1], values: [[1, 2], [3, 4]]}}, bad: <table: {polynomial: [1]}>}
forces:
  motor: {type: joint_spring, joint: hinge, actuator: <actuator: 0>}
  wall: {type: force_law, joint: slide, law: {formula: <law: x>}}
  spring: {type: spring_damper, from: {body: ground, at: [0, 0, 2]}, to: {body: arm, at: [0.3, 0, 0]}, spring: 10}
  push: {type: force, body: box, direction: [1, 0, 0], magnitude: <time: 1>}
  both: <force: {type: joint_spring, joint: slide, damper: 1}>
constraints: {hold: <constraint: {when: false}>}
couplings: {tie: <coupling: {when: false}>}
controllers: {b: <controller: {type: limiter, input: 3, lower: 0}>}
outputs: {tip_z: {position: {body: arm, at: [0.6, 0, 0]}, axis: z}, calc: {formula: "tip.z"}, bad: <output: {formula: "t"}>}
simulation: {step: 1.0e-3, duration: 0.1}
"""
FORMULAS = ("actuator", "motion", "measure", "output")  # whose value is {formula: ...}
LARGE = {"NEST": lambda n: "(" * n + "t" + ")" * n, "CALLS": lambda n: "sin(" * n + "t" + ")" * n, "MINUS": lambda n: "-" * n + "t",
         "POWERS": lambda n: "t^" * n + "t", "RIGHT": lambda n: "t+(" * n + "t" + ")" * n, "SUM": lambda n: "+".join(["t"] * n),
         "CHIRPS": lambda n: "chirp(0, " * n + "1" + ", 1, 1)" * n, "NAME": lambda n: "a" * n,
         "LIST": lambda n: "[" + ", ".join(["1"] * n) + "]"}


def cases():
    """(place, whether it fails in the run, snippet, sentence)"""
    for line in (HERE / "hostile_inputs.txt").read_text(encoding="utf-8").splitlines():
        if line.strip() and not line.startswith("#"):
            what, _, rest = line.partition(" | ")
            snippet, _, sentence = rest.rpartition(" => ")
            yield what.removeprefix("run "), what.startswith("run "), snippet.strip(), sentence.strip()


def model(place, snippet):
    snippet = re.sub(r"([A-Z]+)\((\d+)\)", lambda m: LARGE[m[1]](int(m[2])) if m[1] in LARGE else m[0], snippet)
    value = snippet.removeprefix("yaml ")
    if not snippet.startswith("yaml ") and (place in FORMULAS or place == "law"):
        value = '"' + snippet.replace('"', '\\"') + '"'
        value = value if place == "law" else "{formula: " + value + "}"
    return re.sub(r"<(\w+): (.*?)>", lambda m: value if m[1] == place else m[2], MODEL)


def limit():
    resource.setrlimit(resource.RLIMIT_CPU, (60, 65))
    if LIMITED:
        resource.setrlimit(resource.RLIMIT_AS, (2 << 30, 2 << 30))


def result(case):
    """Exit code, messages, rows of the results."""
    place, runs, snippet, _ = case
    with tempfile.TemporaryDirectory(prefix="floatframe_hostile_") as folder:
        path = pathlib.Path(folder)
        (path / "m.yaml").write_text(model(place, snippet), encoding="utf-8")
        command = ["run", "m.yaml", "--quiet", "--no-report", "--out", "out"] if runs else ["check", "m.yaml"]
        done = subprocess.run([BINARY, *command], cwd=folder, capture_output=True, text=True, preexec_fn=limit, timeout=400, check=False)
        table = path / "out" / "results.csv"
        return done.returncode, done.stderr, table.read_text().count("\n") - 1 if table.exists() else 0


class HostileInputs(unittest.TestCase):
    def test_each_gives_one_sentence(self):
        all_cases = list(cases())
        self.assertGreaterEqual(len(all_cases), 200)
        self.assertEqual(len({case[:3] for case in all_cases}), len(all_cases))
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            for case, (code, said, rows) in zip(all_cases, pool.map(result, all_cases)):
                place, runs, snippet, sentence = case
                with self.subTest(place=place, snippet=snippet):
                    self.assertNotEqual(sentence, "")
                    self.assertIn(sentence, said)
                    self.assertEqual(code, 1 if runs else 2, said)
                    if not runs:
                        self.assertRegex(said, r"\Am\.yaml:\d+:\d+: [^\n]*\n\Z")
                        continue
                    failure = re.findall(r"^floatframe: the run failed: .* at t = ([0-9.e-]+) s.*$", said, re.M)
                    self.assertEqual(len(failure), 1, said)
                    # Until there the instants of the output are kept; a start that fails has none.
                    self.assertGreaterEqual(rows, int(1000 * float(failure[0]) + 1e-6) + (rows > 0), said)

    def test_the_model_without_them_is_valid(self):
        code, said, _ = result(("time", False, "1", ""))
        self.assertEqual((code, said), (0, ""))


if __name__ == "__main__":
    if "--print" in sys.argv:
        for one in cases():
            print(one, *result(one), sep="\n    ")
    else:
        unittest.main()
