#!/usr/bin/env python3
"""Cost of a Newton iteration of a vehicle with solid parts when only the mesh of the parts changes.

    bench/part_cost.py [--program build/floatframe] [--sizes 17,9,6] [--repeat 5] [--arm-modes 4]

Meshes the front A-arm of examples/iltis_solid with Gmsh (must be installed) at several element sizes [mm], reduces each once
(results are cached) and runs the vehicle with each in turn, `--repeat` times; every size has the same number of modes. The
figure is processor time over Newton iterations, the minimum of the repetitions, relative to the first size.
"""
import argparse
import gzip
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]


def mesh(folder, size):
    """Writes the mesh of one element size; returns its name and its number of nodes."""
    name = folder / f"front_arm_{size:g}.msh"
    subprocess.run(["gmsh", "-3", str(ROOT / "examples/iltis_solid/front_arm.geo"), "-setnumber", "size", f"{size:g}",
                    "-o", str(name)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    lines = name.read_text().splitlines()
    nodes = int(lines[lines.index("$Nodes") + 1].split()[1])
    packed = name.with_suffix(".msh.gz")
    packed.write_bytes(gzip.compress(name.read_bytes(), mtime=0))
    return packed, nodes


def run(program, packed, modes, folder):
    out = folder / "out"
    done = subprocess.run([str(program), "run", str(folder / "iltis_solid/iltis_solid.yaml"), "--set", f"arm_mesh={packed}",
                           "--set", f"arm_modes={modes}", "--no-report", "--quiet", "--out", str(out)],
                          capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"the run with {packed.name} failed:\n{done.stdout}{done.stderr}")
    return json.loads((out / "summary.json").read_text())


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/floatframe")
    parser.add_argument("--sizes", default="17,9,6", help="element sizes [mm]")
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--arm-modes", type=int, default=4)
    options = parser.parse_args()
    if shutil.which("gmsh") is None:
        sys.exit("gmsh is not installed: apt-get install gmsh")
    sizes = [float(size) for size in options.sizes.split(",")]
    program = options.program.resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for example in ("iltis", "iltis_solid"):
            shutil.copytree(ROOT / "examples" / example, folder / example)
        meshes = [mesh(folder, size) for size in sizes]
        for packed, _ in meshes:  # reduced here, not in the timed runs
            run(program, packed, options.arm_modes, folder)
        runs = [[] for _ in meshes]
        for _ in range(options.repeat):
            for index, (packed, _) in enumerate(meshes):
                runs[index].append(run(program, packed, options.arm_modes, folder))
        best = [min(r["cpu_s"] / r["iterations"] for r in variant) for variant in runs]
        print(f"{'size [mm]':>9}  {'nodes':>7}  {'iterations':>10}  {'us per iteration':>15}  {'ratio':>6}")
        for size, (_, nodes), variant, cost in zip(sizes, meshes, runs, best):
            print(f"{size:9g}  {nodes:7d}  {variant[0]['iterations']:10d}  {1e6 * cost:15.2f}  {cost / best[0]:6.3f}")


if __name__ == "__main__":
    main()
