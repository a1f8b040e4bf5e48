#!/usr/bin/env python3
"""floatframe rainflow: counts, files and messages."""
import csv
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

BINARY = os.environ.get("FLOATFRAME_BINARY") or (
    sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else "build/floatframe")
BINARY = str(pathlib.Path(BINARY).resolve())

HISTORY = [-2, 1, -3, 5, -1, 3, -4, 4, -2]


def rainflow(*arguments):
    return subprocess.run([BINARY, "rainflow", *map(str, arguments)], capture_output=True, text=True, timeout=60)


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.reader(file))


class Rainflow(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.results = self.folder / "results.csv"
        lines = ["time [s],arm/top [Pa],still [-]"]
        lines += [f"{0.5 * k},{1e6 * value},7" for k, value in enumerate(HISTORY)]
        self.results.write_text("\n".join(lines) + "\n")

    def test_example_of_the_standard(self):
        found = rainflow(self.folder, "--channel", "arm/top", "--slope", 3, "--cycles", 1, "--out", self.folder / "out")
        self.assertEqual((found.returncode, found.stderr), (0, ""))
        self.assertIn("arm/top", found.stdout)
        self.assertNotIn("still", found.stdout)
        files = sorted(path.name for path in (self.folder / "out").iterdir())
        self.assertEqual(files, ["arm_top.cycles.csv", "arm_top.history.csv", "arm_top.ranges.csv", "equivalent.csv"])
        cycles = rows_of(self.folder / "out" / "arm_top.cycles.csv")
        self.assertEqual(cycles[0], ["range [Pa]", "mean [Pa]", "count [-]", "begin [s]", "end [s]"])
        counts = {}
        for row in cycles[1:]:
            counts[float(row[0]) / 1e6] = counts.get(float(row[0]) / 1e6, 0) + float(row[2])
        self.assertEqual(counts, {3: 0.5, 4: 1.5, 6: 0.5, 8: 1, 9: 0.5})
        expected = sum(n * (1e6 * r) ** 3 for r, n in counts.items()) ** (1 / 3)
        table = rows_of(self.folder / "out" / "equivalent.csv")
        self.assertEqual(table[1][0], "arm/top")
        self.assertAlmostEqual(float(table[1][7]) / expected, 1, places=12)
        history = rows_of(self.folder / "out" / "arm_top.history.csv")
        self.assertEqual(history[0], ["time [s]", "arm/top [Pa]"])
        self.assertEqual([float(row[1]) for row in history[1:]], [1e6 * x for x in HISTORY])
        ranges = rows_of(self.folder / "out" / "arm_top.ranges.csv")
        self.assertEqual(len(ranges), 65)
        self.assertEqual(sum(float(row[2]) for row in ranges[1:]), 4)

    def test_all_channels_and_one_that_stands_still(self):
        found = rainflow(self.results, "--out", self.folder / "out")
        self.assertEqual(found.returncode, 0)
        table = rows_of(self.folder / "out" / "equivalent.csv")
        self.assertEqual([row[0] for row in table[1:]], ["arm/top", "still"])
        self.assertEqual([float(x) for x in table[2][3:5]], [0, 0])
        self.assertEqual(float(table[2][7]), 0)

    def test_messages(self):
        for arguments, sentence in (
                ((self.results, "--channel", "arm/tip"), "unknown channel 'arm/tip', did you mean 'arm/top'?"),
                ((self.results, "--slope", "0"), "--slope"),
                ((self.folder / "nothing.csv",), "nothing.csv"),
                ((), "RESULT")):
            found = rainflow(*arguments)
            self.assertEqual(found.returncode, 2, arguments)
            self.assertIn(sentence, found.stderr)
        for value in ("nan", "inf"):
            (self.folder / "odd.csv").write_text(f"time [s],a [Pa]\n0,1\n1,{value}\n2,3\n")
            found = rainflow(self.folder / "odd.csv", "--out", self.folder / "none")
            self.assertEqual(found.returncode, 2)
            self.assertIn(f"odd.csv:3: channel 'a': found {value} at 1 s, expected a finite number", found.stderr)
            self.assertFalse((self.folder / "none").exists())
        (self.folder / "empty.csv").write_text("time [s],a [m]\n")
        self.assertIn("found no rows", rainflow(self.folder / "empty.csv").stderr)
        (self.folder / "clock.csv").write_text("time [s]\n0\n1\n")
        found = rainflow(self.folder / "clock.csv")
        self.assertEqual(found.returncode, 2)
        self.assertIn("clock.csv:1: found no channel but the time", found.stderr)


if __name__ == "__main__":
    unittest.main()
