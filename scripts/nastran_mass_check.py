#!/usr/bin/env python3
"""Masses of Nastran decks: what `floatframe info` says against pyNastran, which has nothing in common with it.

    scripts/nastran_mass_check.py build/floatframe [DECK ...]

Without decks: one of each section of PBARL and PBEAML. Skips with a sentence where pyNastran is not installed.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

SECTIONS = {
    "ROD": "2.", "TUBE": "2.,1.", "BAR": "2.,3.", "BOX": "4.,6.,.5,.25", "BOX1": "4.,6.,.5,.6,.2,.3",
    "I": "8.,4.,6.,.5,.7,.9", "I1": "3.,.5,5.,6.", "T": "4.,5.,.6,.5", "T1": "4.,5.,.6,.5",
    "T2": "4.,5.,.6,.5", "CHAN": "3.,6.,.4,.5", "CHAN1": "3.,.4,5.,6.", "CHAN2": ".4,.5,3.,6.",
    "Z": "2.,.4,5.,6.", "H": "3.,1.,6.,.5", "CROSS": "3.,.5,6.,.4", "HAT": "4.,.5,6.,2.",
    "L": "4.,6.,.5,.4", "TUBE2": "2.,.5"}


def decks(folder):
    """One deck for each section of bars and beams."""
    for bar, card in (("CBAR", "PBARL"), ("CBEAM", "PBEAML")):
        for name, dimensions in SECTIONS.items():
            if bar == "CBAR" and name in ("L", "TUBE2"):  # pyNastran has no such PBARL
                continue
            file = Path(folder) / f"{bar}_{name}.bdf"
            file.write_text("CEND\nBEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,10.,0.,0.\nMAT1,1,100.,,.25,2.\n"
                            f"{bar},1,1,1,2,0.,1.,0.\n{card},1,1,,{name}\n,{dimensions}\nCONM2,5,2,,3.\nENDDATA\n")
            yield file


def main():
    try:
        from pyNastran.bdf.bdf import BDF
        from pyNastran.bdf.mesh_utils.mass_properties import mass_properties
    except ImportError:
        print("skipped: pyNastran is not installed")
        return 0
    program = sys.argv[1]
    wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        files = [Path(name) for name in sys.argv[2:]] or list(decks(folder))
        for file in files:
            run = subprocess.run([program, "info", "--json", str(file)], capture_output=True, text=True)
            if run.returncode != 0:
                print(f"{file.name}: refused: {run.stderr.splitlines()[0] if run.stderr else '?'}")
                wrong += 1
                continue
            own = json.loads(run.stdout)["mass"]
            model = BDF(debug=None)
            model.read_bdf(str(file), xref=True)
            other = mass_properties(model)[0]
            if abs(own - other) > 1e-9 * abs(other):
                print(f"{file.name}: {own!r} here, {other!r} in pyNastran")
                wrong += 1
    print(f"{len(files) - wrong} of {len(files)} masses agree with pyNastran to 1e-9")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
