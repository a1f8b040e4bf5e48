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


def block():
    """3 x 3 x 6 bricks of steel, the set and surface TOP, and node 900 above it."""
    count, lines = (3, 3, 6), ["*NODE", "900, 15, 15, 150"]

    def number(i, j, k):
        return 1 + i + 4 * (j + 4 * k)

    corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
    places = [(i, j, k) for k in range(7) for j in range(4) for i in range(4)]
    lines += [f"{number(i, j, k)}, {10 * i}, {11 * j}, {20 * k}" for i, j, k in places]
    lines.append("*ELEMENT, TYPE=C3D8, ELSET=E")
    cells = [p for p in places if all(a < n for a, n in zip(p, count))]
    for e, (i, j, k) in enumerate(cells, 1):
        lines.append(f"{e}, " + ", ".join(str(number(i + a, j + b, k + c)) for a, b, c in corners))
    lines += ["*MATERIAL, NAME=S", "*ELASTIC", "210000., 0.3", "*DENSITY", "7.85e-9", "*SOLID SECTION, ELSET=E, MATERIAL=S"]
    lines += ["*NSET, NSET=TOP", *(str(number(*p)) for p in places if p[2] == 6), "*SURFACE, NAME=TOP, TYPE=NODE", "TOP"]
    return "\n".join(lines) + "\n"


def frames():
    """Two frames of two legs of 0.6 m, the second 0.1 m above the first, their corners the nodes 13 and 113."""
    lines = ["*NODE"]
    for s in (0, 100):
        lines += [f"{s + k + 1}, {0.05 * min(k, 12)}, {0.05 * max(k - 12, 0)}, {s / 1000}" for k in range(25)]
    lines.append("*ELEMENT, TYPE=B32, ELSET=E")
    lines += [f"{s + e + 1}, {s + 2 * e + 1}, {s + 2 * e + 2}, {s + 2 * e + 3}" for s in (0, 100) for e in range(12)]
    lines += ["*MATERIAL, NAME=M", "*ELASTIC", "2.1e11, .3", "*DENSITY", "7800.",
              "*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=RECT", ".02, .03", "0., 0., 1."]
    return "\n".join(lines) + "\n"


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

    def modes_of_calculix(self, deck, modes, *options):
        """Frequencies [Hz] that CalculiX finds in the deck as it is written."""
        (self.path / "given.inp").write_text(deck)
        code, text, errors = self.convert("given.inp", "written.inp", "--dialect", "calculix", "--modes", modes, *options)
        self.assertEqual((code, errors), (0, ""))
        done = subprocess.run(["ccx", "written"], capture_output=True, text=True, cwd=self.path)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:])
        table = (self.path / "written.dat").read_text().split("P A R T I C I P A T I O N")[0]
        rows = [line.split() for line in table.splitlines()]
        return sorted(float(row[3]) for row in rows if len(row) == 5 and row[0].isdigit()), text

    @unittest.skipUnless(shutil.which("ccx"), "CalculiX is not installed")
    def test_a_coupling_of_some_directions(self):
        # The top follows node 900 in x and y alone: its turn about x says nothing more than its y. With both free CalculiX
        # printed 722, 736, 765, 4597 Hz; of the written deck Floatframe finds these.
        for directions, expected in (("1,2", (10499.993, 11087.562, 12916.755)), ("2,2", (10498.249, 11086.491, 12915.550))):
            found, text = self.modes_of_calculix(block() + f"*COUPLING, REF NODE=900, SURFACE=TOP, CONSTRAINT NAME=C\n*KINEMATIC\n"
                                                 f"{directions}\n", 9)
            self.assertIn("held of nodes without elements", text)
            self.assertLess(max(found[:6]), 1.0)
            for frequency, other in zip(found[6:], expected):
                self.assertAlmostEqual(frequency / other, 1.0, delta=1e-5)
        # A spring at the reference resists nothing, as its turn gives way. CalculiX stopped at its motion along z.
        spring = "*ELEMENT, TYPE=SPRING2, ELSET=SP\n9500, 900, 1\n*SPRING, ELSET=SP\n2, 2\n1000.\n"
        coupling = "*COUPLING, REF NODE=900, SURFACE=TOP, CONSTRAINT NAME=C\n*KINEMATIC\n1, 2\n"
        found, text = self.modes_of_calculix(block() + coupling + spring, 9)
        self.assertAlmostEqual(found[6] / 10499.993, 1.0, delta=1e-5)

    @unittest.skipUnless(shutil.which("ccx"), "CalculiX is not installed")
    def test_turns_of_nodes_where_beams_meet(self):
        # Two frames whose corners turn together by equations, and by springs; Floatframe's beams have 46.5, 46.5, 69.1 and 6.65,
        # 7.21, 8.52 Hz. CalculiX makes solids of beams; given as it is, the second deck has turned freely there.
        places = "".join(f"*EQUATION\n2\n113,{k},1.,13,{k},-1.\n" for k in (1, 2, 3))
        turns = "".join(f"*EQUATION\n2\n113,{k},1.,13,{k},-1.\n" for k in (4, 5, 6))
        springs = "".join(f"*ELEMENT,TYPE=SPRING2,ELSET=S{k}\n90{k},13,113\n*SPRING,ELSET=S{k}\n{k},{k}\n{2 * k - 5}00.\n"
                          for k in (4, 5, 6))
        for ties, expected in ((turns, (46.526, 46.526)), (springs, (6.645, 7.214, 8.523))):
            found, text = self.modes_of_calculix(frames() + places + ties, 10)
            self.assertLess(max(found[:6]), 0.1)
            for frequency, other in zip(found[6:], expected):
                self.assertAlmostEqual(frequency / other, 1.0, delta=0.03)

    def test_names_that_are_written_otherwise_are_said(self):
        deck = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4,ELSET=E\n7,1,2,3,4\n*NSET,NSET=E\n1,2\n"
        (self.path / "part.inp").write_text(deck)
        code, text, errors = self.convert("part.inp", "other.inp", "--material", "210000,0.3,7.85e-9")
        self.assertEqual((code, errors), (0, ""))
        self.assertIn("1 name is written otherwise (letters, digits, '_' and '-', at most 60, each once): 'E' as E_2\n", text)

    def test_faults_are_sentences_and_nothing_is_written(self):
        deck = self.path / "part.inp"
        deck.write_text("*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4,ELSET=E\n7,1,2,3,4\n")
        for arguments, sentence in (
                ((deck, "part.stl"), "part.stl: found the ending '.stl', "),
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
