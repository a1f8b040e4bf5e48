#!/usr/bin/env python3
"""What outputs of reactions cost: the flexible Iltis with the forces and torques of its 24 joints in every row, and without.

    bench/reactions.py [--program build/floatframe] [--repeat 5]

Every step of 10 ms is a row. Printed is what a row of reactions takes beyond one without, as a part of a step: processor times
of the steps, least of the repeated runs, taken in turns."""
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
    subprocess.run([program, "run", str(model), "--coordinates", coordinates, "--out", str(out), "--no-report", "--quiet"],
                   check=True)
    return json.loads((out / "summary.json").read_text())["cpu_s"]


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
        for coordinates in ("relative", "absolute"):
            without, with_them = [], []
            for _ in range(options.repeat):
                without.append(seconds(options.program, plain, coordinates, folder / "out"))
                with_them.append(seconds(options.program, asked, coordinates, folder / "out"))
            share = (min(with_them) - min(without)) / min(without)
            print(f"{coordinates}: {min(without):.4f} s without, {min(with_them):.4f} s with reactions; "
                  f"a row of them costs {share:.2f} steps")


if __name__ == "__main__":
    main()
