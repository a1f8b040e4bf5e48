#!/usr/bin/env python3
"""Masses, centres and inertia of Nastran decks here and in pyNastran, which has nothing in common with this program.

    scripts/nastran_mass_check.py [--build build] [DECK | FOLDER ...]     without decks: one of each section of PBARL and PBEAML
    scripts/nastran_mass_check.py --harvest FOLDER                       writes the models that pyNastran's own unit tests make

Mass to 1e-6, centre to 1e-6 of the size, inertia about the centre to 1e-6. pyNastran puts the mass of an element at its centre; here
it is spread as in the stiffness, or lumped at the nodes: inertia agrees where the mass is in point masses. --require NUMBER: exit code 1
if fewer agree in mass and centre. Skips with a sentence where pyNastran is not installed.
"""
import argparse
import hashlib
import importlib
import io
import json
import os
import pkgutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SECTIONS = {
    "ROD": "2.", "TUBE": "2.,1.", "BAR": "2.,3.", "BOX": "4.,6.,.5,.25", "BOX1": "4.,6.,.5,.6,.2,.3",
    "I": "8.,4.,6.,.5,.7,.9", "I1": "3.,.5,5.,6.", "T": "4.,5.,.6,.5", "T1": "4.,5.,.6,.5",
    "T2": "4.,5.,.6,.5", "CHAN": "3.,6.,.4,.5", "CHAN1": "3.,.4,5.,6.", "CHAN2": ".4,.5,3.,6.",
    "Z": "2.,.4,5.,6.", "H": "3.,1.,6.,.5", "CROSS": "3.,.5,6.,.4", "HAT": "4.,.5,6.,2.",
    "L": "4.,6.,.5,.4", "TUBE2": "2.,.5"}
SUFFIXES = (".bdf", ".nas", ".dat", ".blk", ".bulk")
TOLERANCE = 1e-6


def section_decks(folder):
    """One deck for each section of bars and beams."""
    for bar, card in (("CBAR", "PBARL"), ("CBEAM", "PBEAML")):
        for name, dimensions in SECTIONS.items():
            if bar == "CBAR" and name in ("L", "TUBE2"):  # pyNastran has no such PBARL
                continue
            file = Path(folder) / f"{bar}_{name}.bdf"
            file.write_text("CEND\nBEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,10.,0.,0.\nMAT1,1,100.,,.25,2.\n"
                            f"{bar},1,1,1,2,0.,1.,0.\n{card},1,1,,{name}\n,{dimensions}\nCONM2,5,2,,3.\nENDDATA\n")
            yield file


def harvest(folder):
    """Runs pyNastran's unit tests of bulk data and keeps every model that they write or check."""
    folder.mkdir(parents=True, exist_ok=True)
    folder = folder.resolve()
    os.chdir(tempfile.mkdtemp())
    import pyNastran.bdf.cards.test.utils as utils
    from pyNastran.bdf.bdf import BDF
    seen, running = set(), ["model"]
    write_bdf = BDF.write_bdf

    def keep(model):
        text = io.StringIO()
        try:
            write_bdf(model, text, size=8, close=False)
        except Exception:  # models that are made to be wrong
            return
        key = hashlib.sha256(text.getvalue().encode(errors="replace")).hexdigest()
        if key not in seen:
            seen.add(key)
            (folder / f"{running[0]}_{len(seen):03}.bdf").write_text(text.getvalue())

    def write_and_keep(model, *arguments, **options):
        keep(model)
        return write_bdf(model, *arguments, **options)

    def save_load_deck(model, *arguments, **options):
        keep(model)
        return model

    class Result(unittest.TextTestResult):
        def startTest(self, test):
            running[0] = "_".join(word.removeprefix("test_") for word in test.id().split(".")[-3::2])
            super().startTest(test)

    BDF.write_bdf, utils.save_load_deck = write_and_keep, save_load_deck
    suite = unittest.TestSuite()
    for package in ("pyNastran.bdf.cards.test", "pyNastran.bdf.mesh_utils.test", "pyNastran.bdf.bdf_interface.test"):
        for module in pkgutil.iter_modules(importlib.import_module(package).__path__):
            if module.name.startswith("test_"):
                try:
                    suite.addTests(unittest.defaultTestLoader.loadTestsFromModule(importlib.import_module(f"{package}.{module.name}")))
                except Exception as error:
                    print(f"{module.name}: ignored: {error}")
    unittest.TextTestRunner(resultclass=Result, stream=io.StringIO()).run(suite)
    print(f"{len(seen)} models in {folder}")


def here(build, file):
    """Mass, centre and inertia about it; else why not."""
    import numpy as np
    run = subprocess.run([build / "tests/deck_modes", "modes", file, "--rigid"], capture_output=True, text=True, timeout=120)
    if run.returncode != 0:
        return run.stderr.splitlines()[0] if run.stderr else f"exit code {run.returncode}"
    M = np.array(json.loads(run.stdout)["rigid_mass"]).reshape(6, 6)
    mass = M[0, 0]
    if not mass > 0.0:
        return "no mass"
    c = np.array([M[1, 5], M[2, 3], M[0, 4]]) / mass
    about = M[3:, 3:] - mass * (c @ c * np.eye(3) - np.outer(c, c))
    return mass, c, about


def there(file):
    import numpy as np
    from pyNastran.bdf.bdf import BDF
    from pyNastran.bdf.mesh_utils.mass_properties import mass_properties_nsm
    model = BDF(debug=None)
    first = [line.split("$")[0].strip().upper() for line in file.read_text(errors="replace").splitlines()]
    model.read_bdf(str(file), xref=True, punch=not any(line.startswith("BEGIN") for line in first))
    mass, c, I = mass_properties_nsm(model)
    size = max((np.linalg.norm(node.get_position()) for node in model.nodes.values()), default=1.0)
    # Ixx, Iyy, Izz, Ixy, Ixz, Iyz; products are integrals of x y
    full = np.array([[I[0], -I[3], -I[4]], [-I[3], I[1], -I[5]], [-I[4], -I[5], I[2]]])
    return mass, c, full, size


def compare(build, files):
    import numpy as np
    counts = {"decks": len(files), "compared": 0, "mass": 0, "centre": 0, "inertia": 0}
    for file in files:
        own = here(build, file)
        if isinstance(own, str):
            counts.setdefault("not read, or without mass", 0)
            counts["not read, or without mass"] += 1
            continue
        try:
            mass, c, inertia, size = there(file)
        except Exception as error:
            print(f"{file.name}: pyNastran: {type(error).__name__}: {str(error).splitlines()[0] if str(error) else ''}")
            counts.setdefault("not in pyNastran", 0)
            counts["not in pyNastran"] += 1
            continue
        counts["compared"] += 1
        apart = [abs(own[0] - mass) / max(abs(mass), 1e-300), float(np.abs(own[1] - c).max() / max(size, 1e-300)),
                 float(np.abs(own[2] - inertia).max() / max(np.abs(inertia).max(), np.abs(own[2]).max(), 1e-9 * mass * size**2))]
        good = [a < TOLERANCE for a in apart]
        counts["mass"] += good[0]
        counts["centre"] += good[0] and good[1]
        counts["inertia"] += all(good)
        if not (good[0] and good[1]):
            print(f"{file.name:50} mass {own[0]:.8g} here, {mass:.8g} there; centre {apart[1]:.1e} of the size apart")
    print("  ".join(f"{name} {count}" for name, count in counts.items()))
    return counts


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("decks", nargs="*", type=Path)
    parser.add_argument("--build", type=Path, default=Path(__file__).resolve().parents[1] / "build")
    parser.add_argument("--harvest", type=Path)
    parser.add_argument("--require", type=int, default=0)
    arguments = parser.parse_args()
    try:
        import pyNastran  # noqa: F401
    except ImportError:
        print("skipped: pyNastran is not installed")
        return 0
    if arguments.harvest:
        harvest(arguments.harvest)
        return 0
    with tempfile.TemporaryDirectory() as folder:
        files = []
        for path in arguments.decks:
            files += sorted(p for p in path.rglob("*") if p.suffix in SUFFIXES) if path.is_dir() else [path]
        counts = compare(arguments.build.resolve(), files or list(section_decks(folder)))
    return 1 if counts["centre"] < arguments.require else 0


if __name__ == "__main__":
    sys.exit(main())
