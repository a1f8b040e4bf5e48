#!/usr/bin/env python3
"""Draws figures 5, 6 and 7 of the paper with this program (docs/paper.md).

usage: bench/paper_figures.py [5] [6] [7] [--program FILE] [--recorded] [--out FOLDER]

5  height of the chassis over time, absolute and relative coordinates
6  height of the left front wheel, the same
7  processor seconds of the manoeuvre against the number of finite elements, the four combinations, with those of the paper;
   --recorded takes the newest recorded run of bench/history instead of measuring
Without a number all three are drawn.
"""
import argparse
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import history  # noqa: E402
import svg_chart  # noqa: E402

MODEL = "examples/iltis/iltis.yaml"
# Table 1 of the paper: processor seconds by elements per bar; elements of the whole vehicle.
PER_BAR = (5, 10, 50, 100)
ELEMENTS = (84, 164, 804, 1604)
PAPER = {("absolute", "projection"): (4.19, 4.48, 7.58, 12.59), ("absolute", "preprocessing"): (3.85,) * 4,
         ("relative", "projection"): (1.11, 1.48, 4.32, 8.21), ("relative", "preprocessing"): (0.79,) * 4}


def short(coordinates, inertia):
    return f"{coordinates[:3].capitalize()}. + {'P' if inertia == 'preprocessing' else 'B'}"


def floatframe(program, *arguments):
    done = subprocess.run([str(program), *map(str, arguments)], cwd=history.ROOT, check=False, capture_output=True, text=True)
    if done.returncode:
        history.fail(f"`floatframe {' '.join(map(str, arguments))}` failed: {done.stderr.strip()}")


def heights(program, folder):
    """Rows of both runs by coordinates."""
    rows = {}
    for coordinates in ("absolute", "relative"):
        out = pathlib.Path(folder) / coordinates
        floatframe(program, "run", MODEL, "--coordinates", coordinates, "--out", out, "--no-report", "--quiet")
        with open(out / "results.csv", newline="") as file:
            rows[coordinates] = list(csv.DictReader(file))
    return rows


def height_figure(rows, channel, title):
    series = [(f"{coordinates} coordinates*", [(float(r["time [s]"]), float(r[f"{channel} [m]"])) for r in of])
              for coordinates, of in rows.items()]
    return svg_chart.curves(title, "time [s]", "height [m]", series, x_log=False, y_log=False)


def time_figure(rows):
    """`rows`: those of `floatframe bench iltis --json`."""
    series = []
    for number, case in enumerate(PAPER):
        of = {r["elements_per_bar"]: r["cpu_s_min"] for r in rows if (r["coordinates"], r["inertia"]) == case}
        series.append((f"{short(*case)}, here", [(e, of[n]) for e, n in zip(ELEMENTS, PER_BAR) if n in of], number, 0))
    for number, (case, paper) in enumerate(PAPER.items()):
        series.append((f"{short(*case)}, paper*", list(zip(ELEMENTS, paper)), number, 1))
    return svg_chart.curves("Iltis manoeuvre of 8 s, steps of 10 ms", "finite elements", "processor time [s]", series)


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("usage: ")[1].split("\n")[0])
    parser.add_argument("figures", nargs="*", metavar="FIGURE")
    parser.add_argument("--program", default="build/floatframe")
    parser.add_argument("--recorded", action="store_true")
    parser.add_argument("--out", default=str(history.ROOT / "docs" / "figures"))
    a = parser.parse_args()
    wanted = a.figures or ["5", "6", "7"]
    for figure in wanted:
        if figure not in ("5", "6", "7"):
            history.fail(f"found the figure '{figure}', expected 5, 6 or 7")
    program, out = pathlib.Path(a.program).resolve(), pathlib.Path(a.out)
    if not program.is_file() and (not a.recorded or wanted != ["7"]):
        history.fail(f"{program} is not there; build it with `make build` or give another one with --program")
    out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="floatframe-figures-") as folder:
        rows = heights(program, folder) if set(wanted) & {"5", "6"} else {}
        texts = {}
        if "5" in wanted:
            texts["paper_5.svg"] = height_figure(rows, "chassis.z", "Height of the chassis")
        if "6" in wanted:
            texts["paper_6.svg"] = height_figure(rows, "front_left.wheel.z", "Height of the left front wheel")
        if "7" in wanted:
            if a.recorded:
                run = json.loads(history.load(None, 1).read_text())["iltis"]
            else:
                file = pathlib.Path(folder) / "iltis.json"
                floatframe(program, "bench", "iltis", "--json", file)
                run = json.loads(file.read_text())
            texts["paper_7.svg"] = time_figure(run["rows"])
    for name, text in texts.items():
        (out / name).write_text(text)
        print(out / name)


if __name__ == "__main__":
    main()
