#!/usr/bin/env python3
"""From a finite-element deck to a running model: `floatframe reduce` and `info`, `flexible: arm.ffb`, the same as a
block in the model file with its cache, and the switch between rigid and flexible."""
import csv
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

BINARY = os.environ["FLOATFRAME_BINARY"]
DECKS = pathlib.Path(os.environ["FLOATFRAME_TEST_DATA"]) / "fe"
DECK = DECKS / "aarm_coarse_free.inp"   # steel wishbone, mm-t-s; includes the mesh

# The arm swings about the axis through its bushings.
MODEL = """\
floatframe: 1
name: swing
parameters: {{flex: true}}
bodies:
  arm:
{arm}
joints:
  front: {{type: spherical, child: arm, child_node: BUSH_F}}
rods:
  rear: {{from: {{body: ground, at: [0.15, 0.3, 0.2]}}, to: {{body: arm, node: BUSH_R}}}}
outputs:
  ball: {{position: {{body: arm, node: BALL}}}}
simulation: {{step: 0.002, duration: 0.1, spectral_radius: 0.8}}
"""

BLOCK = """\
    part:
      file: deck.inp
      units: mm-t-s
      interfaces:
        BUSH_F: {set: BUSH_F}
        BUSH_R: {set: BUSH_R}
        BALL: {set: BALL}
      modes: 5
      damping: 0.02
      free_check: false
    flexible: ${flex}
"""


class Reduce(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory(prefix="floatframe-reduce-")
        cls.folder = pathlib.Path(cls.holder.name)
        cls.done = cls.floatframe("reduce", DECK, "--units", "mm-t-s", "--interface", "BUSH_F=set:BUSH_F", "--interface",
                                  "BUSH_R=set:BUSH_R", "--interface", "BALL=set:BALL", "--modes", "5", "--damping",
                                  "0.02", "-o", "arm.ffb", "--report", "report.json", "--sid", "arm.sid")

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    @classmethod
    def floatframe(cls, *arguments, **environment):
        return subprocess.run([BINARY, *map(str, arguments)], cwd=cls.folder, capture_output=True, text=True,
                              timeout=250, check=False, env={**os.environ, **environment})

    def expect(self, code, *arguments, out="", err="", **environment):
        done = self.floatframe(*arguments, **environment)
        self.assertEqual(done.returncode, code, done.stderr + done.stdout)
        self.assertIn(out, done.stdout)
        self.assertIn(err, done.stderr)
        return done

    def results(self, folder):
        with open(self.folder / folder / "results.csv", newline="") as file:
            return list(csv.reader(file))

    def run_model(self, name, arm, *options):
        (self.folder / f"{name}.yaml").write_text(MODEL.format(arm=arm))
        done = self.expect(0, "run", f"{name}.yaml", "--out", f"out_{name}", "--no-report", *options)
        return done, self.results(f"out_{name}")

    def test_reduce_reports_and_writes(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        report = json.loads((self.folder / "report.json").read_text())
        # Reference values of CalculiX 2.20 for this mesh: 5.504932e-3 t, centre (-4.44839, 159.06175, 1.57664) mm.
        self.assertAlmostEqual(report["from_elements"]["mass_kg"], 5.504932, delta=2e-6)
        for found, expected in zip(report["from_invariants"]["centre_m"], (-4.44839e-3, 0.15906175, 1.57664e-3)):
            self.assertAlmostEqual(found, expected, delta=3e-8)  # of its own integration
        self.assertEqual(report["nodes"], 5687)
        self.assertEqual(report["elements"], 2785)
        self.assertEqual([i["name"] for i in report["interfaces"]], ["BUSH_F", "BUSH_R", "BALL"])
        for text in ("mass [kg]", "5.50493", "free elastic mode", "BUSH_R", "arm.ffb", "static error"):
            self.assertIn(text, self.done.stdout)
        self.assertIn(" s  ", self.done.stderr)  # stages
        self.assertTrue((self.folder / "arm.sid").read_text().strip().endswith("end part"))

    def test_info(self):
        info = json.loads(self.expect(0, "info", DECK, "--json").stdout)
        self.assertEqual(info["nodes"], 5687)
        self.assertEqual(info["elements"], {"tet10": 2785})
        self.assertEqual({s["name"]: s["size"] for s in info["sets"] if s["of"] == "nodes"},
                         {"BUSH_F": 130, "BUSH_R": 130, "BALL": 130, "DAMP_F": 78, "DAMP_R": 82, "IFACE": 550, "NALL": 5687})
        self.assertIn("mm-t-s", info["likely_units"])
        self.assertAlmostEqual(info["mass"], 5.504932e-3, delta=2e-9)
        self.assertIn("set:BALL", info["possible_interfaces"])
        self.expect(0, "info", DECK, out="5687")
        body = json.loads(self.expect(0, "info", "arm.ffb", "--json").stdout)
        self.assertEqual([m["name"] for m in body["markers"]], ["BUSH_F", "BUSH_R", "BALL"])
        self.assertEqual(body["provenance"]["units"], "mm-t-s")
        self.assertEqual(body["health"]["elements"], 2785)
        self.expect(0, "info", "arm.ffb", out="Health report")
        sid = json.loads(self.expect(0, "info", "arm.sid", "--json").stdout)
        self.assertAlmostEqual(sid["mass_kg"], body["mass_kg"], delta=1e-12)
        self.assertEqual(len(sid["modes"]), len(body["modes"]))

    def test_block_and_file_give_the_same_run_and_the_cache_is_used(self):
        (self.folder / "deck.inp").write_text(DECK.read_text().replace("aarm_coarse_mesh.inp", "mesh.inp"))
        (self.folder / "mesh.inp.gz").write_bytes((DECKS / "aarm_coarse_mesh.inp.gz").read_bytes())
        _, by_file = self.run_model("file", "    part: arm.ffb\n    flexible: ${flex}")
        done, by_block = self.run_model("block", BLOCK)
        self.assertIn("bodies.arm: reducing 'deck.inp'", done.stderr)
        self.assertEqual(by_file, by_block)
        caches = list((self.folder / ".floatframe-cache").iterdir())
        self.assertEqual(len(caches), 1)
        done, again = self.run_model("block", BLOCK)
        self.assertIn("from the cache", done.stderr)
        self.assertNotIn("reducing", done.stderr)
        self.assertEqual(again, by_block)
        # Rigid: the same part, the same sockets, no modes; close to the flexible one, which is stiff.
        done, rigid = self.run_model("block", BLOCK, "--set", "flex=false")
        self.assertIn("from the cache", done.stderr)
        self.assertEqual(rigid[0], by_block[0])
        self.assertNotEqual(rigid[-1], by_block[-1])
        for a, b in zip(map(float, rigid[-1]), map(float, by_block[-1])):
            self.assertAlmostEqual(a, b, delta=1e-4)
        # Damaged files of the cache are replaced, changed inputs are seen.
        caches[0].write_bytes(caches[0].read_bytes()[:1000])
        done, _ = self.run_model("block", BLOCK)
        self.assertIn("reducing", done.stderr)
        (self.folder / "deck.inp").write_text((self.folder / "deck.inp").read_text() + "** changed\n")
        done, _ = self.run_model("block", BLOCK)
        self.assertIn("reducing", done.stderr)
        quiet, _ = self.run_model("block", BLOCK, "--quiet")
        self.assertEqual(quiet.stderr, "")
        done = self.expect(0, "check", "block.yaml", FLOATFRAME_CACHE="off", err="not kept")
        self.assertIn("  arm               17", done.stdout)

    def test_the_dialect_of_a_deck(self):
        nodes = "".join(f"{k}, {k}.\n" for k in range(1, 10))
        elements = "".join(f"{k}, {2 * k - 1}, {2 * k}, {2 * k + 1}\n" for k in range(1, 5))
        (self.folder / "rod.inp").write_text(
            f"*NODE\n{nodes}*ELEMENT, TYPE=B32, ELSET=ROD\n{elements}*MATERIAL, NAME=S\n*ELASTIC\n2.1e11, 0.3\n"
            "*DENSITY\n7850.\n*BEAM SECTION, ELSET=ROD, MATERIAL=S, SECTION=CIRC\n0.1\n")
        self.expect(2, "info", "rod.inp", err="rod.inp:21: *BEAM SECTION, SECTION=CIRC: 0.1 is a radius in Abaqus and a "
                                              "diameter in CalculiX")
        mass = {d: json.loads(self.expect(0, "info", "rod.inp", "--dialect", d, "--json").stdout)["mass"]
                for d in ("abaqus", "calculix")}
        self.assertAlmostEqual(mass["abaqus"], 4.0 * mass["calculix"], delta=1e-6 * mass["abaqus"])
        self.expect(0, "reduce", "rod.inp", "--units", "si", "--dialect", "calculix", "--interface", "A=node:1", "--modes",
                    "2", "--quiet", "-o", "rod.ffb")
        self.expect(2, "info", DECKS / "bricks.msh", "--dialect", "abaqus", err="the dialect 'abaqus' is given, but the "
                                                                               "file is no deck")
        block = ("    part: {{file: rod.inp, units: si, interfaces: {{A: {{node: 1}}}}, modes: 2, free_check: false{0}}}\n")
        model = ("floatframe: 1\nbodies:\n  rod:\n{0}joints: {{pin: {{type: revolute, child: rod, child_node: A, axis: y}}}}\n"
                 "simulation: {{step: 0.01, duration: 0.01}}\n")
        for option, code in (("", 2), (", dialect: calculix", 0), (", dialect: abaqus", 0), (", dialect: nastran", 2)):
            (self.folder / "rod.yaml").write_text(model.format(block.format(option)))
            self.expect(code, "check", "rod.yaml", FLOATFRAME_CACHE=str(self.folder / "rods"))
        # Each dialect has a reduced body of its own.
        self.assertEqual(len(list((self.folder / "rods").glob("*.ffb"))), 2)

    def test_mistakes_are_told_and_nothing_is_left(self):
        before = sorted(p.name for p in self.folder.iterdir() if p.suffix == ".ffb")
        self.expect(2, "reduce", DECK, err="--units is missing")
        self.expect(2, "reduce", DECK, err="the material looks like mm-t-s")
        self.expect(2, "reduce", DECK, "--units", "mm-t-ss", err="'mm-t-s'?")
        self.expect(2, "reduce", DECK, "--units", "mm-t-s", "--interface", "BALL=set:BAL", "-o", "no.ffb",
                    err="'BALL'")
        self.expect(2, "reduce", "nowhere.inp", "--units", "mm-t-s", err="nowhere.inp")
        self.expect(2, "reduce", DECK, "--units", "mm-t-s", "-o", "nowhere/arm.ffb", err="cannot be written")
        for argument, message in (
                ("BALL", "expected NAME=WAY:VALUE"),
                ("BALL=sets:X", "--interface BALL: unknown way 'sets', did you mean 'set'?"),
                ("BALL=node:1.5", "node: found '1.5', expected the number of a node"),
                ("BALL=nearest:1,2", "nearest: found '1,2', expected three numbers x,y,z"),
                ("BALL=cylinder:1,2,3,axis=z", "'radius' is missing for a cylinder"),
                ("BALL=set:X,tipe=mean", "unknown option 'tipe', did you mean 'type'?"),
                ("BALL=set:X,dofs=xyq", "dofs: found 'xyq'")):
            self.expect(2, "reduce", DECK, "--units", "mm-t-s", "--interface", argument, err=message)
        self.expect(2, "info", "nowhere.inp", err="nowhere.inp: ")
        after = sorted(p.name for p in self.folder.iterdir() if p.suffix == ".ffb")
        self.assertEqual(before, after)


if __name__ == "__main__":
    unittest.main()
