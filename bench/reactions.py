#!/usr/bin/env python3
"""Cost of reaction outputs: the flexible Iltis with the forces and torques of its 24 joints in every row, and without; then six
legs of Jansen on one crank, whose constraints are redundant, with the force of the crank's joint.

    bench/reactions.py [--program build/floatframe] [--repeat 5]

Every step is a row. Prints the additional cost of a row with reactions over one without, as a fraction of a step: processor
times of the steps, minimum of the repeated runs, taken in turns."""
import argparse
import json
import pathlib
import shutil
import subprocess
import tempfile

TREE = pathlib.Path(__file__).resolve().parents[1]
SUBSYSTEMS = ("front_left", "front_right", "rear_left", "rear_right")
JOINTS = ("arm_hinge", "arm_ball", "link_hinge", "link_ball", "rod_inner", "rod_ball")


def seconds(program, model, coordinates, out):
    subprocess.run([program, "run", str(model), "--coordinates", coordinates, "--out", str(out), "--overwrite", "--no-report",
                    "--quiet"], check=True)
    return json.loads((out / "summary.json").read_text())["cpu_s"]


def compare(name, plain, asked, out, options):
    for coordinates in ("relative", "absolute"):
        without, with_them = [], []
        for _ in range(options.repeat):
            without.append(seconds(options.program, plain, coordinates, out))
            with_them.append(seconds(options.program, asked, coordinates, out))
        share = (min(with_them) - min(without)) / min(without)
        print(f"{name}, {coordinates}: {min(without):.4f} s without, {min(with_them):.4f} s with reactions; "
              f"a row of them costs {share:.2f} steps")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=str(TREE / "build" / "floatframe"))
    parser.add_argument("--repeat", type=int, default=5)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="floatframe-reactions-") as name:
        folder = pathlib.Path(name)
        shutil.copytree(TREE / "examples" / "iltis", folder / "iltis")
        plain = folder / "iltis" / "iltis.yaml"
        outputs = "".join(f"  {s}.{j}.{kind}: {{{kind}: {s}.{j}}}\n"
                          for s in SUBSYSTEMS for j in JOINTS for kind in ("joint_force", "joint_torque"))
        asked = folder / "iltis" / "reactions.yaml"
        asked.write_text(plain.read_text().replace("\noutputs:\n", "\noutputs:\n" + outputs, 1))
        compare("Iltis", plain, asked, folder / "out", options)
        text = (TREE / "tests" / "data" / "loops" / "six_legs.yaml").read_text()
        before, after = text[:text.index("outputs:")], "simulation: {step: 0.002, duration: 20}\n"
        plain, asked = folder / "plain.yaml", folder / "asked.yaml"
        plain.write_text(before + "outputs:\n  c: {position: crank}\n" + after)
        asked.write_text(before + "outputs:\n  c: {joint_force: crank}\n" + after)
        compare("six legs", plain, asked, folder / "out", options)


if __name__ == "__main__":
    main()
