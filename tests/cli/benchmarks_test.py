#!/usr/bin/env python3
"""The benchmarks of examples/benchmarks in both formulations, with a margin of two to every tolerance."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

BINARY = str(pathlib.Path(os.environ.get("FLOATFRAME_BINARY", "build/floatframe")).resolve())
ROOT = pathlib.Path(__file__).resolve().parents[2]


class Benchmarks(unittest.TestCase):
    def test_all_of_them(self):
        with tempfile.TemporaryDirectory() as cache:
            done = subprocess.run([BINARY, "validate", "--json"], cwd=ROOT, capture_output=True, text=True, timeout=280, check=False,
                                  env={**os.environ, "FLOATFRAME_CACHE": cache})
        self.assertEqual(done.returncode, 0, done.stderr)
        benchmarks = json.loads(done.stdout)["benchmarks"]
        self.assertGreaterEqual(len(benchmarks), 52)
        for benchmark in benchmarks:
            frequencies = all(c["output"] is None for c in benchmark["runs"][0]["checks"])
            self.assertEqual(len(benchmark["runs"]), 1 if benchmark["name"].startswith("rotating") else 2)
            self.assertTrue(frequencies or len(benchmark["runs"]) == 2)
            for run in benchmark["runs"]:
                for check in run["checks"]:
                    with self.subTest(benchmark=benchmark["name"], coordinates=run["coordinates"], quantity=check["quantity"]):
                        self.assertLessEqual(2.0 * check["error"], check["tolerance"])

    def test_references_are_the_closed_forms(self):
        script = ROOT / "examples" / "benchmarks" / "closed_forms.py"
        done = subprocess.run([sys.executable, str(script), "--check"], capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
