#!/usr/bin/env python3
"""What an FMU costs: instructions of doStep beside those of Simulation::step, allocations, times of loading, creation and
start, sizes of files.

usage: bench/fmu_cost.py [--program build/floatframe] [--case NAME ...] [--steps 40] [--no-times] [--json FILE]

Writes FMUs of the Iltis (FMI 2.0, relative coordinates), unpacks them and steps each through dlopen by the functions of the
standard; the program of bench/fmu/step_costs.cpp, which is compiled against the build folder, steps the model.ffm inside by
`Simulation::step`. callgrind counts nothing but these steps, in the runtime that is in the FMU, and every call of the heap in
them. Times are the least of several, of this machine. Exit code 1: a step takes memory from the heap, or fails.
"""
import argparse
import json
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
import zipfile

from count_instructions import HEAP

ROOT = pathlib.Path(__file__).resolve().parents[1]
COUNTED = "floatframe_counted_steps"
# name -> arguments of `floatframe fmu`
CASES = {
    "Iltis, flexible": ["examples/iltis/iltis.yaml", "--set", "coordinates=relative"],
    "Iltis, rigid": ["examples/iltis/iltis.yaml", "--set", "coordinates=relative", "--set", "flexible=false"],
}
TIMES = {"read": "checks the bytes of the .ffm", "describe": "reads its description", "build": "reads it and builds the model",
         "create": "fmi2Instantiate, all of these", "start": "initialisation, with its equilibrium", "step": "doStep, mean of 1000"}


def fail(message):
    sys.exit(f"fmu_cost: {message}")


def output_of(command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, cwd=ROOT, **options)
    if done.returncode:
        fail(f"`{' '.join(map(str, command))}` failed:\n{done.stderr[-2000:]}")
    return done.stdout


def flags_of(build):
    """Definitions and folders of headers that the program itself was compiled with."""
    entries = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    words = shlex.split(next(e["command"] for e in entries if e["file"].endswith("/src/main/main.cpp")))
    flags = [word for word in words if word.startswith(("-D", "-I", "-std="))]
    return flags + [f"-isystem{folder}" for word, folder in zip(words, words[1:]) if word == "-isystem"]


def compiled(build, folder):
    driver = folder / "step_costs"
    output_of([os.environ.get("CXX", "c++"), *flags_of(build), "-O1", ROOT / "bench/fmu/step_costs.cpp", "-o", driver,
               f"-L{build / 'lib'}", f"-Wl,-rpath,{build / 'lib'}", "-lfloatframe", "-ldl"])
    return driver


class Fmu:
    """An FMU of FMI 2.0, written and unpacked into a folder."""

    def __init__(self, program, arguments, folder):
        self.file = folder / "vehicle.fmu"
        output_of([program, "fmu", *arguments, "-o", self.file, "--fmi", "2", "--overwrite", "--quiet"])
        with zipfile.ZipFile(self.file) as archive:
            archive.extractall(folder / "fmu")
            self.packed_sizes = {entry.filename: entry.compress_size for entry in archive.infolist()}
        self.library = next((folder / "fmu/binaries/linux64").iterdir())
        self.model = folder / "fmu/resources/model.ffm"
        described = ElementTree.parse(folder / "fmu/modelDescription.xml").getroot()
        self.token = described.get("guid")
        self.step = described.find("DefaultExperiment").get("stepSize")

    def words(self, steps):
        return [self.library, f"file://{self.model.parent}", self.token, self.step, steps]


def counted(command, folder):
    """Instructions of all steps, and calls of the heap in them by the function that calls."""
    out = folder / "callgrind.out"
    output_of(["valgrind", "--tool=callgrind", "--compress-strings=no", "--compress-pos=no", f"--toggle-collect={COUNTED}",
               f"--callgrind-out-file={out}", *command], env={**os.environ, "LD_BIND_NOW": "1"})
    total = heap = 0
    called, function = "", ""
    for line in out.read_text(encoding="utf-8", errors="replace").splitlines():
        key, _, value = line.partition("=")
        if key == "fn":
            function = value
        elif key == "cfn":
            called = value
        elif key == "calls" and HEAP.search(called) and not HEAP.search(function):
            heap += int(value.split()[0])
        elif line.startswith(("totals:", "summary:")):
            total = int(line.split()[1])
    return total, heap


def instructions(program, arguments, steps, driver, folder):
    fmu = Fmu(program, arguments, folder)
    in_fmu, heap = counted([driver, "fmu", *fmu.words(steps)], folder)
    in_program, more = counted([driver, "program", fmu.model, steps], folder)
    return fmu, {"doStep": in_fmu / steps, "Simulation::step": in_program / steps, "ratio": in_fmu / in_program,
                 "calls of the heap in doStep": heap, "calls of the heap in Simulation::step": more}


def measure(program, name, options, driver, folder):
    fmu, figures = instructions(program, CASES[name], options.steps, driver, folder)
    print(f"{name}: doStep {figures['doStep']:.0f} instructions, Simulation::step {figures['Simulation::step']:.0f}, ratio "
          f"{figures['ratio']:.4f}; calls of the heap in {options.steps} steps {figures['calls of the heap in doStep']}")
    if not options.no_times:
        lines = output_of([driver, "times", *fmu.words(1000), fmu.model]).splitlines()
        figures["times_s"] = {line.split()[0]: float(line.split()[1]) for line in lines}
        for key, about in TIMES.items():
            print(f"  {1e3 * figures['times_s'][key]:9.3f} ms  {key}: {about}")
    figures["sizes"] = {fmu.file.name: fmu.file.stat().st_size, **fmu.packed_sizes}
    for file in (fmu.library, fmu.model):
        entry = str(file.relative_to(folder / "fmu"))
        print(f"  {file.stat().st_size / 1e6:9.3f} MB  {entry}, {fmu.packed_sizes[entry] / 1e6:.3f} MB compressed")
    print(f"  {fmu.file.stat().st_size / 1e6:9.3f} MB  the FMU")
    return figures


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/floatframe")
    parser.add_argument("--case", choices=list(CASES), action="append")
    parser.add_argument("--steps", type=int, default=40)
    parser.add_argument("--no-times", action="store_true")
    parser.add_argument("--json", type=pathlib.Path)
    options = parser.parse_args()
    if not shutil.which("valgrind"):
        fail("valgrind not found; Debian package: valgrind")
    program, results = options.program.resolve(), {}
    with tempfile.TemporaryDirectory(prefix="floatframe-fmu-") as name:
        driver = compiled(program.parent, pathlib.Path(name))
        for case in options.case or CASES:
            with tempfile.TemporaryDirectory(prefix="floatframe-fmu-") as folder:
                results[case] = measure(program, case, options, driver, pathlib.Path(folder))
    if options.json:
        options.json.write_text(json.dumps(results, indent=1) + "\n", encoding="utf-8")
    return 1 if any(figures["calls of the heap in doStep"] for figures in results.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
