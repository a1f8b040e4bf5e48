#!/usr/bin/env python3
"""bench/paper_figures.py: the figures of docs/paper.md by their commands."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

BINARY = str(pathlib.Path(os.environ.get("FLOATFRAME_BINARY", "build/floatframe")).resolve())
SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "bench" / "paper_figures.py"


class PaperFigures(unittest.TestCase):
    def draw(self, *arguments):
        return subprocess.run([sys.executable, "-B", str(SCRIPT), "--program", BINARY, *arguments], capture_output=True,
                              text=True, check=False, timeout=300)

    def test_each_has_its_curves(self):
        with tempfile.TemporaryDirectory(prefix="floatframe-figures-") as folder:
            done = self.draw("--recorded", "--out", folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            for number, curves, least in ((5, 2, 801), (6, 2, 801), (7, 8, 4)):
                root = xml.etree.ElementTree.parse(pathlib.Path(folder) / f"paper_{number}.svg").getroot()
                lines = [e.get("points").split() for e in root.iter() if e.tag.endswith("polyline")]
                self.assertEqual([len(points) for points in lines], [least] * curves, number)

    def test_a_program_that_is_not_there(self):
        done = subprocess.run([sys.executable, "-B", str(SCRIPT), "5", "--program", "no_such_program"], capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("no_such_program is not there", done.stderr)


if __name__ == "__main__":
    unittest.main()
