#!/usr/bin/env python3
"""What tyres, added coordinates and more iterations cost in a step of the Iltis that is driven, in instructions.

    bench/vehicle_cost.py [--program build/floatframe] [--coordinates relative|absolute] [--tyre-law mf] [--json FILE]

Counts the steps of `floatframe bench step` by valgrind: of examples/iltis/handling.yaml (rigid, wheels that spin, a steering
wheel, 1 ms, 20 m/s) and, as what it is compared with, of the same vehicle with wheels that do not turn, no steering and the
vertical tyres of the paper. Tyres: everything below the laws of tyres that roll. The rest is that of the plain vehicle,
coordinates, constraints and forces that an iteration has more of, and iterations that a step has more of.
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
COUNTED = "floatframe_counted_steps"
DURATION = "0.05"
PLAIN = ["examples/iltis/iltis.yaml", "--set", "flexible=false", "--set", "road=flat", "--set", "speed=20", "--set",
         "spectral_radius=1", "--step", "0.001"]


def counted(program, model, coordinates):
    """Instructions of a step, those in tyres that roll, and iterations of a step."""
    with tempfile.TemporaryDirectory(prefix="floatframe-count-") as folder:
        out, facts = pathlib.Path(folder) / "out", pathlib.Path(folder) / "facts.json"
        command = ["valgrind", "--tool=callgrind", f"--toggle-collect={COUNTED}", f"--callgrind-out-file={out}", str(program),
                   "bench", "step", *model, "--coordinates", coordinates, "--duration", DURATION, "--json", str(facts)]
        done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT,
                              env={**os.environ, "LD_BIND_NOW": "1"})
        if done.returncode:
            sys.exit(f"vehicle_cost: `{' '.join(command)}` failed:\n{done.stderr[-2000:]}")
        total = int(re.search(r"Collected : (\d+)", done.stderr)[1])
        words = json.loads(facts.read_text(encoding="utf-8"))
        table = subprocess.run(["callgrind_annotate", "--inclusive=yes", "--threshold=100", str(out)], capture_output=True,
                               text=True, check=True).stdout
        tyres = sum(int(line.split()[0].replace(",", "")) for line in table.splitlines()
                    if re.match(r" *[\d,]+ .*:void floatframe::rolling_tyre_law<", line))
        steps = words["steps"]
        return total / steps, tyres / steps, words["iterations"] / steps


def split(program, coordinates, law):
    """Parts of the instructions of a step of the driven vehicle."""
    driven = ["examples/iltis/handling.yaml", "--set", f"tyre_law={law}"]
    total, tyres, iterations = counted(program, driven, coordinates)
    plain, _, fewer = counted(program, PLAIN, coordinates)
    each = (total - tyres) / iterations  # of an iteration, without tyres
    return {"step": total, "iterations": iterations, "plain iterations": fewer, "tyres": tyres, "plain vehicle": plain,
            "added coordinates": each * fewer - plain, "iterations more": each * (iterations - fewer),
            "share of tyres": tyres / total}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/floatframe")
    parser.add_argument("--coordinates", choices=["relative", "absolute"], action="append")
    parser.add_argument("--tyre-law", default="mf")
    parser.add_argument("--json", type=pathlib.Path)
    options = parser.parse_args()
    if not shutil.which("valgrind"):
        sys.exit("vehicle_cost: valgrind not found; Debian package: valgrind")
    program, results = options.program.resolve(), {}
    for coordinates in options.coordinates or ["relative", "absolute"]:
        parts = results[coordinates] = split(program, coordinates, options.tyre_law)
        print(f"{coordinates}: {parts['step']:.0f} instructions a step, {parts['iterations']:.2f} iterations "
              f"(plain vehicle: {parts['plain iterations']:.2f})")
        for name in ("plain vehicle", "added coordinates", "iterations more", "tyres"):
            print(f"  {name:18} {parts[name]:9.0f}  {parts[name] / parts['step']:6.1%}")
    if options.json:
        options.json.write_text(json.dumps(results, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
