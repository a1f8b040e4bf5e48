#!/usr/bin/env python3
"""`floatframe convert`: a Gmsh mesh and a deck as other programs' files, read back; the sentences of what cannot be."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from export_readers import read_vtu

BINARY = os.environ["FLOATFRAME_BINARY"]
DECKS = pathlib.Path(os.environ["FLOATFRAME_TEST_DATA"]) / "fe"


class Convert(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)

    def convert(self, *arguments):
        done = subprocess.run([BINARY, "convert", *map(str, arguments)], capture_output=True, text=True, cwd=self.path)
        return done.returncode, done.stdout, done.stderr

    def test_vtu_shows_mesh_sets_and_connections(self):
        code, text, errors = self.convert(DECKS / "aarm_coarse_rbe2_free.inp", "arm.vtu", "--dialect", "calculix")
        self.assertEqual((code, errors), (0, ""))
        self.assertTrue(text.startswith("arm.vtu: 5697 nodes, 2785 elements, as a VTK unstructured grid"), text)
        grid = read_vtu(self.path / "arm.vtu")
        kinds = [grid["texts"]["element_type_names"][k] for k in grid["cell"]["element_type"]]
        self.assertEqual(kinds.count("tet10"), 2785)
        self.assertEqual(kinds.count("spider"), len(kinds) - 2785)
        self.assertEqual(sum(grid["point"]["set_BALL"]), 130)
        self.assertEqual(grid["texts"]["material_names"], ["STEEL"])
        self.assertEqual({c[0] for c in grid["cells"][:2785]}, {24})
        self.assertEqual({c[0] for c in grid["cells"][2785:]}, {3})
        self.assertEqual(grid["cell"]["young"][0], 210000.0)

    def test_a_mesh_becomes_a_deck_of_the_same_mass(self):
        mesh = DECKS / "aarm_coarse.msh.gz"
        code, text, errors = self.convert(mesh, "arm.inp", "--material", "210000,0.3,7.85e-9", "--modes", "8")
        self.assertEqual((code, errors), (0, ""))
        self.assertIn("*FREQUENCY\n8\n", (self.path / "arm.inp").read_text())
        masses = []
        for arguments in ((mesh, "--material", "210000,0.3,7.85e-9"), ("arm.inp",)):
            shown = subprocess.run([BINARY, "info", *map(str, arguments)], capture_output=True, text=True, cwd=self.path)
            masses += [line.split()[-1] for line in shown.stdout.splitlines() if line.strip().startswith("mass ")]
        self.assertEqual(len(masses), 2)
        self.assertEqual(masses[0], masses[1])

    @unittest.skipUnless(shutil.which("ccx"), "CalculiX is not installed")
    def test_calculix_runs_what_is_written(self):
        self.assertEqual(self.convert(DECKS / "orthotropic_hex8.inp.gz", "bricks.inp")[0], 0)
        done = subprocess.run(["ccx", "bricks"], capture_output=True, text=True, cwd=self.path)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:])
        self.assertIn("E I G E N V A L U E   O U T P U T", (self.path / "bricks.dat").read_text())

    def test_faults_are_sentences_and_nothing_is_written(self):
        deck = self.path / "part.inp"
        deck.write_text("*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4,ELSET=E\n7,1,2,3,4\n")
        for arguments, sentence in (
                ((deck, "part.stl"), "part.stl: found the ending '.stl', expected one of: CalculiX deck (.inp); Gmsh mesh, format "
                                     "4.1 (.msh); VTK unstructured grid, for ParaView (.vtu)"),
                ((deck, deck), "OUT: "),
                ((deck, "missing/part.vtu"), "the file 'missing/part.vtu' cannot be written"),
                ((self.path / "none.inp", "part.vtu"), "none.inp"),
                ((deck,), "OUT"),
                ((deck, "other.inp", "--modes", "-1"), "--modes")):
            before = sorted(self.path.iterdir())
            code, text, errors = self.convert(*arguments)
            self.assertEqual((code, text), (2, ""), arguments)
            self.assertIn(sentence, errors)
            self.assertEqual(len(errors.splitlines()), 1, errors)
            self.assertEqual(sorted(self.path.iterdir()), before)


if __name__ == "__main__":
    unittest.main()
