#!/usr/bin/env python3
"""What `floatframe info` proposes, and that a shell and `reduce` take it as it is printed."""

import json
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

BINARY = os.environ["FLOATFRAME_BINARY"]
DECKS = Path(os.environ["FLOATFRAME_TEST_DATA"]) / "fe"

# Two bricks along z. TOP of the upper one is tied to node 20 by a rigid spider.
HEAD = """*NODE
1, 0,0,0
2, 1,0,0
3, 1,1,0
4, 0,1,0
5, 0,0,1
6, 1,0,1
7, 1,1,1
8, 0,1,1
9, 0,0,2
10, 1,0,2
11, 1,1,2
12, 0,1,2
20, 0.5,0.5,2.5
*ELEMENT, TYPE=C3D8, ELSET=LOW
1, 1,2,3,4,5,6,7,8
*ELEMENT, TYPE=C3D8, ELSET=HIGH
2, 5,6,7,8,9,10,11,12
*MATERIAL, NAME=STEEL
*ELASTIC
210000., 0.3
*DENSITY
7.85e-9
*MATERIAL, NAME=ALU
*ELASTIC
70000., 0.33
*DENSITY
2.7e-9
*SOLID SECTION, ELSET=LOW, MATERIAL=STEEL
*SOLID SECTION, ELSET=HIGH, MATERIAL=ALU
*NSET, NSET=TOP
9, 10, 11, 12
"""
SETS = """*NSET, NSET=FOOT
1, 2, 3, 4
*NSET, NSET=FOOT AGAIN
4, 3, 2, 1
*NSET, NSET=FOOT AND ONE
1, 2, 3, 4, 5
*NSET, NSET=CORNER
1
*NSET, NSET=EDGE
1, 2
*SURFACE, NAME=SFOOT
1, S1
*SURFACE, NAME=STOP
2, S2
"""
SPIDER = "*RIGID BODY, NSET=TOP, REF NODE=20\n"


class Info(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="floatframe_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def expect(self, code, *arguments):
        done = subprocess.run([BINARY, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def facts(self, text, *options, name="part.inp"):
        (self.folder / name).write_text(text)
        return json.loads(self.expect(0, "info", name, "--json", *options).stdout)

    def pasted(self, command, **values):
        """Runs the command as it stands, but for what it leaves to the user."""
        for word, value in values.items():
            self.assertIn(word, command)
            command = command.replace(word, value)
        program = Path(BINARY).resolve()
        bin_folder = self.folder / "bin"
        bin_folder.mkdir(exist_ok=True)
        if not (bin_folder / "floatframe").exists():
            (bin_folder / "floatframe").symlink_to(program)
        done = subprocess.run(
            ["sh", "-c", f"PATH=$PWD/bin:$PATH; {command} --quiet -o pasted.ffb"], cwd=self.folder, capture_output=True, text=True, timeout=120
        )
        self.assertEqual(done.returncode, 0, command + done.stderr)
        body = json.loads(self.expect(0, "info", "pasted.ffb", "--json").stdout)
        return [marker["name"] for marker in body["markers"]]

    def test_each_place_once_and_what_reduce_takes(self):
        facts = self.facts(HEAD + SETS + SPIDER)
        self.assertEqual(facts["possible_interfaces"], ["node:20", "set:FOOT"])
        self.assertEqual(facts["obstacle"], "")
        self.assertEqual(self.pasted(facts["command"]), ["TOP", "FOOT"])
        text = self.expect(0, "info", "part.inp").stdout
        self.assertIn("  " + facts["command"] + "\n", text)
        self.assertIn("Interfaces that `reduce` takes together: node:20, set:FOOT\n", text)

    def test_without_a_spider_the_sets(self):
        facts = self.facts(HEAD + SETS)
        # The smallest sets first, each of several with the same nodes once; the corner of a solid and an edge are none.
        self.assertEqual(facts["possible_interfaces"], ["set:FOOT", "set:TOP"])
        self.pasted(facts["command"])

    def test_mass_of_each_material(self):
        facts = self.facts(HEAD + "*ELEMENT, TYPE=MASS, ELSET=M\n3, 12\n*MASS, ELSET=M\n1e-9\n")
        self.assertEqual([m["name"] for m in facts["materials"]], ["STEEL", "ALU"])
        for material, mass in zip(facts["materials"], (7.85e-9, 2.7e-9)):
            self.assertAlmostEqual(material["mass"], mass, delta=1e-15)
        self.assertAlmostEqual(facts["point_mass"], 1e-9, delta=1e-15)
        self.assertAlmostEqual(facts["mass"], 11.55e-9, delta=1e-15)
        self.assertEqual(facts["other_mass"], 0.0)

    def test_mass_of_plies(self):
        facts = self.facts(
            "*NODE\n1,0,0,0\n2,2,0,0\n3,2,1,0\n4,0,1,0\n*ELEMENT,TYPE=S4,ELSET=E\n1,1,2,3,4\n"
            "*MATERIAL,NAME=A\n*ELASTIC\n7e10,0.3\n*DENSITY\n2000\n*MATERIAL,NAME=B\n*ELASTIC\n7e9,0.3\n*DENSITY\n1000\n"
            "*SHELL SECTION,ELSET=E,COMPOSITE\n0.01,3,A,0\n0.03,3,B,90\n"
        )
        self.assertAlmostEqual(facts["materials"][0]["mass"], 40.0, delta=1e-9)
        self.assertAlmostEqual(facts["materials"][1]["mass"], 60.0, delta=1e-9)
        self.assertAlmostEqual(facts["mass"], 100.0, delta=1e-9)

    def test_what_the_file_does_not_say_is_left_to_the_user(self):
        bare = HEAD.replace("*DENSITY\n7.85e-9\n", "").replace("*DENSITY\n2.7e-9\n", "") + SETS
        facts = self.facts(bare)
        self.assertEqual([m["mass"] for m in facts["materials"]], [None, None])
        self.pasted(facts["command"], RHO="7.85e-9")
        facts = self.facts(bare, "--density", "STEEL=7.85e-9")
        self.assertIn("--density STEEL=7.85e-09 --density RHO", facts["command"])
        facts = self.facts(bare, "--density", "7.85e-9")
        self.assertNotIn("RHO", facts["command"])
        self.pasted(facts["command"])
        mesh = bare[: bare.index("*MATERIAL")] + "*NSET, NSET=TOP\n9, 10, 11, 12\n"
        facts = self.facts(mesh)
        self.assertIn("--units UNITS", facts["command"])
        self.pasted(facts["command"].replace("E,NU,RHO", "210000,0.3,7.85e-9"), UNITS="mm-t-s")

    def test_hard_names(self):
        strange = HEAD + SETS.replace("NSET=FOOT\n", "NSET=\"it's $HOME, $(touch no) ;a\"\n")
        facts = self.facts(strange, name="it's a part.inp")
        names = self.pasted(facts["command"])
        self.assertEqual(len(names), 2)
        self.assertFalse((self.folder / "no").exists())

    def test_names_in_latin_1(self):
        deck = HEAD + "*NSET, NSET=\"Füße\"\n1, 2, 3, 4\n"
        (self.folder / "old.inp").write_bytes(deck.encode("latin-1"))
        facts = json.loads(self.expect(0, "info", "old.inp", "--json").stdout)
        self.assertIn("set:Füße", facts["possible_interfaces"])
        self.assertIn("Füße", [s["name"] for s in facts["sets"]])
        self.pasted(facts["command"])
        self.assertEqual(self.facts(deck)["possible_interfaces"], facts["possible_interfaces"])
        # As a terminal of that time gives the name.
        command = [BINARY, "reduce", "old.inp", "--units", "mm-t-s", "--modes", "2", "--quiet", "-o", "old.ffb", "--interface"]
        done = subprocess.run([*command, "A=set:Füße".encode("latin-1")], cwd=self.folder, capture_output=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_what_reduce_would_refuse(self):
        loose = HEAD.replace("2, 5,6,7,8,9,10,11,12", "2, 15,16,17,18,9,10,11,12").replace(
            "*ELEMENT, TYPE=C3D8, ELSET=LOW", "15, 0,0,1.5\n16, 1,0,1.5\n17, 1,1,1.5\n18, 0,1,1.5\n*ELEMENT, TYPE=C3D8, ELSET=LOW"
        )
        facts = self.facts(loose)
        self.assertIn("in 2 pieces", facts["obstacle"])
        text = self.expect(0, "info", "part.inp").stdout
        self.assertIn("`reduce` would refuse this: ", text)
        self.assertNotIn("floatframe reduce part.inp", text)
        done = self.expect(2, "reduce", "part.inp", "--units", "mm-t-s", "--method", "free_free")
        self.assertIn("in 2 pieces", done.stderr)
        # Inverted elements: the warning says it, no command.
        text = self.facts(HEAD.replace("1, 1,2,3,4,5,6,7,8", "1, 5,6,7,8,1,2,3,4"))
        self.assertEqual(text["bad_elements"], ["element 1 (hex8)"])
        self.assertTrue(text["bad_reason"].startswith("part.inp:16: element 1 (hex8) is inverted"), text["bad_reason"])
        self.assertNotIn("floatframe reduce part.inp", self.expect(0, "info", "part.inp").stdout)

    def test_where_it_stands(self):
        twice = self.facts(HEAD.replace("1, 1,2,3,4,5,6,7,8", "1, 1,2,3,4,5,6,7,7"))
        self.assertEqual(twice["bad_reason"], "part.inp:16: element 1 (hex8) names node 7 twice")
        mean = "*SURFACE, NAME=PAIR, TYPE=NODE\n9\n10\n*COUPLING, REF NODE=20, SURFACE=PAIR, CONSTRAINT NAME=C\n*DISTRIBUTING\n1, 3\n"
        facts = self.facts(HEAD + mean)
        self.assertRegex(facts["obstacle"], r"^part\.inp:\d+: spider 'C': its 2 nodes lie on a line or in a point")

    def test_mechanisms_are_said(self):
        # The upper brick hangs on one equation of the lower one.
        loose = HEAD.replace("2, 5,6,7,8,9,10,11,12", "2, 15,16,17,18,9,10,11,12").replace(
            "*ELEMENT, TYPE=C3D8, ELSET=LOW", "15, 0,0,1\n16, 1,0,1\n17, 1,1,1\n18, 0,1,1\n*ELEMENT, TYPE=C3D8, ELSET=LOW"
        )
        facts = self.facts(loose + "*EQUATION\n2\n15, 3, 1., 5, 3, -1.\n")
        self.assertIn("without resistance", facts["obstacle"])
        text = self.expect(0, "info", "part.inp").stdout
        self.assertNotIn("Interfaces that", text)
        self.assertNotIn("floatframe reduce part.inp", text)

    def test_a_hinge_that_interfaces_on_both_sides_hold(self):
        # Two bricks that share one edge; no fixed-interface mode shows that the one turns about it.
        hinge = HEAD.replace("2, 5,6,7,8,9,10,11,12", "2, 5,6,17,18,9,10,11,12").replace(
            "*ELEMENT, TYPE=C3D8, ELSET=LOW", "17, 1,1,1\n18, 0,1,1\n*ELEMENT, TYPE=C3D8, ELSET=LOW"
        )
        facts = self.facts(hinge + SETS)
        self.assertEqual(facts["possible_interfaces"], ["set:FOOT", "set:TOP"])
        self.assertIn("mechanism", facts["obstacle"])

    def test_a_set_of_the_whole_part_is_none(self):
        # Nodes that no element uses are not of the part.
        spare = "".join(f"{100 + k}, {k}., 9., 9.\n" for k in range(40))
        facts = self.facts(HEAD.replace("20, 0.5", spare + "20, 0.5") + "*NSET, NSET=ALL, GENERATE\n1, 12\n")
        self.assertEqual(facts["possible_interfaces"], ["set:TOP"])

    def test_a_rigid_bar_between_two_nodes_of_a_solid_is_no_interface(self):
        facts = self.facts(HEAD + "*MPC\nBEAM, 9, 11\n")
        self.assertEqual([way for way in facts["possible_interfaces"] if way.startswith("node:")], [])

    def test_invalid_bars_say_why(self):
        bars = "*NODE\n1, 0,0,0\n2, 0,0,0\n3, 0,0,1\n*ELEMENT, TYPE=B31, ELSET=B\n1, 1,2\n2, 2,3\n*MATERIAL, NAME=S\n*ELASTIC\n1., .3\n"
        self.facts(bars + "*BEAM SECTION, ELSET=B, MATERIAL=S, SECTION=RECT\n.1, .1\n0., 1., 0.\n")
        text = self.expect(0, "info", "part.inp").stdout
        self.assertIn("WARNING: 1 element is invalid: element 1 (beam2)\n  part.inp:6: element 1 (beam2) has zero length", text)

    def test_a_hinge_is_no_interface(self):
        # Two nodes that a spider holds without their rotations leave a turn free.
        facts = self.facts(HEAD.replace("9, 10, 11, 12\n", "9, 11\n") + SPIDER)
        self.assertNotIn("node:20", facts["possible_interfaces"])

    def test_a_set_that_would_take_the_nodes_of_others(self):
        # The beam lies beside its nodes, which are references; NSET S would tie two of them.
        beam = ("*NODE\n1\n2, 1.\n3, 2.\n*ELEMENT, TYPE=B32, ELSET=B\n1, 1, 2, 3\n*MATERIAL, NAME=M\n*ELASTIC\n"
                "2.1e5, .3\n*DENSITY\n7.85e-9\n*BEAM SECTION, ELSET=B, MATERIAL=M, SECTION=RECT, OFFSET1=.5\n"
                ".1, .2\n0., 1., 0.\n*NSET, NSET=S\n1, 2\n")
        # What holds the ends of the beam is no interface that a user asked for.
        facts = self.facts(beam)
        self.assertEqual((facts["possible_interfaces"], facts["spiders"], facts["beam_arms"]), (["set:S"], [], 3))
        self.assertEqual(self.pasted(facts["command"]), ["S"])
        self.assertIn("  beam arms     at 3 nodes: ends of beams or bars away from them\n", self.expect(0, "info", "part.inp").stdout)
        facts = self.facts(beam + "*RIGID BODY, NSET=S, REF NODE=9\n*NODE\n9, .5, 0., .3\n")
        self.assertEqual(facts["possible_interfaces"], ["node:9"])

    def test_offsets_and_hinges_of_nastran_bars(self):
        brick = ("BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\nGRID,5,,0.,0.,1.\n"
                 "GRID,6,,1.,0.,1.\nGRID,7,,1.,1.,1.\nGRID,8,,0.,1.,1.\nGRID,9,,0.,0.,2.\nCHEXA,1,1,1,2,3,4,5,6,+\n+,7,8\n"
                 "PSOLID,1,1\nMAT1,1,2.+11,,.3,7800.\nPBARL,2,1,,BAR,,,,,+\n+,.1,.1\n")
        facts = self.facts(brick + "CBAR,11,2,5,6,0.,1.,0.,,+\n+,,,0.,0.,.1,0.,0.,.1\nCBAR,12,2,6,7,1.,0.,0.,,+\n"
                           "+,,,0.,0.,.1,0.,0.,.1\nENDDATA\n", name="off.bdf")
        self.assertEqual((facts["possible_interfaces"], facts["beam_arms"], facts["obstacle"]), ([], 3, ""))
        # A bar that stands on a corner of a solid and turns about its hinge there.
        facts = self.facts(brick + "CBAR,11,2,5,9,0.,1.,0.,,+\n+,5\nENDDATA\n", name="hinge.bdf")
        self.assertIn("node 5, node 9 and node 10 (made for element 11 (beam2), hinge.bdf:17)", facts["obstacle"])
        done = self.expect(2, "reduce", "hinge.bdf", "--units", "si", "--interface", "A=plane:0,0,0,normal=z")
        self.assertIn("node 5 ry (element 11 (beam2), hinge.bdf:17, has a hinge or an offset there) can move", done.stderr)

    def test_springs_and_masses_alone_are_a_part(self):
        springs = ("*NODE\n1, 0,0,0\n2, 1,0,0\n3, 1,1,0\n*ELEMENT, TYPE=MASS, ELSET=M\n11, 1\n12, 2\n13, 3\n*MASS, ELSET=M\n2.\n")
        triangle = "*ELEMENT, TYPE=SPRINGA, ELSET=S\n1, 1,2\n2, 2,3\n3, 1,3\n*SPRING, ELSET=S\n\n1000.\n"
        facts = self.facts(springs + triangle)
        self.assertEqual(facts["obstacle"], "")
        self.assertNotIn("E,NU,RHO", facts["command"])
        self.assertNotIn("--material", self.expect(0, "info", "part.inp").stdout)
        self.pasted(facts["command"], UNITS="m-kg-s")
        bulk = ("BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nCONM2,5,1,,2.\nCONM2,6,2,,2.\nCONM2,7,3,,2.\n")
        facts = self.facts(bulk + "CROD,1,1,1,2\nCELAS2,2,1000.,2,2,3,2\nPROD,1,1,.1\nMAT1,1,2.+11,,.3\nENDDATA\n", name="part.bdf")
        self.assertEqual(facts["springs"], 1)
        facts = self.facts(bulk + "CELAS2,1,1000.,1,1,2,1\nENDDATA\n", name="part.bdf")
        self.assertEqual((facts["springs"], facts["point_masses"]), (1, 3))
        (self.folder / "part.bdf").write_text(bulk + "ENDDATA\n")
        self.assertIn("part.bdf: the file has no solid, shell, bar, rod or spring; of masses and rigid elements alone there is no "
                      "flexible part", self.expect(2, "info", "part.bdf").stderr)
        # Springs within a rigid body resist nothing.
        rigid = self.facts(springs + triangle + "*NSET, NSET=N\n2, 3\n*RIGID BODY, NSET=N, REF NODE=1\n")
        self.assertIn("the part has mass but no elasticity", rigid["obstacle"])

    def test_matrices(self):
        for file in DECKS.glob("two_bricks*"):
            shutil.copy(file, self.folder)
        facts = json.loads(self.expect(0, "info", "two_bricks.sti.gz", "--json").stdout)
        self.assertEqual(facts["possible_interfaces"], ["node:20", "set:FOOT"])
        self.pasted(facts["command"], UNITS="m-kg-s")

    def test_all_amplitudes_of_a_superelement(self):
        shutil.copy(DECKS / "superelement_with_modes.pch", self.folder)
        facts = json.loads(self.expect(0, "info", "superelement_with_modes.pch", "--json").stdout)
        self.assertIn(" --modes 8", facts["command"])


if __name__ == "__main__":
    unittest.main()
