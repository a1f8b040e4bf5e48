#!/usr/bin/env python3
"""Decks are a component: a copy of the program without it does all but them, and says so. Set FLOATFRAME_BINARY."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

BINARY = pathlib.Path(os.environ.get("FLOATFRAME_BINARY", "build/floatframe")).resolve()
ROOT = pathlib.Path(__file__).resolve().parents[2]
DECK = ROOT / "tests" / "data" / "fe" / "aarm_coarse_free.inp"
COMPONENT = "libfloatframe_decks.so"


class DecksComponent(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.binary = self.folder / BINARY.name
        shutil.copy(BINARY, self.binary)
        shutil.copytree(BINARY.parent / "lib", self.folder / "lib", symlinks=True)

    def program(self, *arguments):
        return subprocess.run([self.binary, *map(str, arguments)], capture_output=True, text=True, timeout=120, cwd=self.folder)

    def test_a_copy_without_it_does_all_but_decks(self):
        component = self.folder / "lib" / COMPONENT
        if component.exists():
            mesh = self.folder / "arm.msh"
            self.assertEqual(self.program("convert", DECK, mesh).returncode, 0)
            component.unlink()
            self.assertIn("2785", self.program("info", mesh).stdout)
        for command in (("info", DECK), ("reduce", DECK, "--format", "abaqus", "--units", "mm-t-s", "--out", "x.ffb")):
            done = self.program(*command)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn("decks (.inp, .bdf, .cdb, .unv, ...) need a build with FLOATFRAME_DECKS", done.stderr)
        for ending in ("pch", "op4"):  # their nodes are cards
            shutil.copy(DECK.with_name(f"beam_superelement.{ending}"), self.folder)
            done = self.program("info", f"beam_superelement.{ending}")
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn("expected nodes as a table (.csv) or a mesh; decks", done.stderr)
        (self.folder / "nodes.csv").write_text("node,x,y,z\n1,0,0,0\n2,2,0,0\n", encoding="utf-8")
        self.assertIn("12 rows", self.program("info", "beam_superelement.pch", "--nodes", "nodes.csv").stdout)
        done = self.program("run", ROOT / "examples" / "iltis" / "iltis.yaml", "--duration", "0.1", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_damaged_component_is_an_error_in_one_sentence(self):
        (self.folder / "lib" / COMPONENT).write_bytes(b"no library")
        done = self.program("info", DECK)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("decks cannot be read: ", done.stderr)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)


if __name__ == "__main__":
    unittest.main()
