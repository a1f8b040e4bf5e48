#!/usr/bin/env python3
"""bench/history.py: comparison of recorded runs."""
import copy
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "bench" / "history.py"
ROW = {"coordinates": "relative", "inertia": "preprocessing"}
RUN = {
    "date": "2026-01-02T03:04:05Z", "commit": "0123456789", "changed_files": False, "subject": "a subject",
    "build": "a build", "cpu": "a processor", "dense_llt_98_us": 20.0,
    "chain": {"dense_llt_98_us": 20.0, "rows": [{**ROW, "links": 4, "modes": 8, "us_per_step_min": 10.0, "failure": None}]},
    "iltis": {"dense_llt_98_us": 20.0, "rel_p_iteration_us": 15.0,
              "rows": [{**ROW, "elements_per_bar": 5, "cpu_s_min": 0.04, "steps": 800}]},
    "instructions": {"build": "a build", "cases": {"a case": {"instructions_per_step": 1000.0}}},
}


class Compare(unittest.TestCase):
    def compare(self, new, *options):
        with tempfile.TemporaryDirectory(prefix="floatframe-history-") as folder:
            files = []
            for name, run in (("new", new), ("old", RUN)):
                files.append(pathlib.Path(folder) / f"{name}.json")
                files[-1].write_text(json.dumps(run))
            return subprocess.run([sys.executable, "-B", str(SCRIPT), "compare", *map(str, files), *options],
                                  capture_output=True, text=True, check=False)

    def test_ratios_are_of_llts_and_of_instructions(self):
        new = copy.deepcopy(RUN)
        new["chain"]["dense_llt_98_us"] = 40.0  # a machine of half the speed ...
        new["chain"]["rows"][0]["us_per_step_min"] = 30.0  # ... and a step of 3 times the time: ratio 1.5
        new["instructions"]["cases"]["a case"]["instructions_per_step"] = 900.0
        done = self.compare(new, "--fail-above", "1.0")
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = {line.split(":")[0]: line for line in done.stdout.splitlines()}
        self.assertIn("1.500  slower", lines["chain 4 links, 8 modes, Rel+P"])
        self.assertIn("1.000", lines["Iltis 5 elements per bar, Rel+P"])
        self.assertIn("0.900  faster", lines["a case"])

    def test_more_instructions_than_allowed(self):
        new = copy.deepcopy(RUN)
        new["instructions"]["cases"]["a case"]["instructions_per_step"] = 1100.0
        self.assertEqual(self.compare(new).returncode, 0)
        self.assertEqual(self.compare(new, "--fail-above", "1.2").returncode, 0)
        done = self.compare(new, "--fail-above", "1.02")
        self.assertEqual(done.returncode, 1)
        self.assertIn("1.100 times the instructions", done.stdout)

    def test_what_is_not_there_is_one_sentence(self):
        done = subprocess.run([sys.executable, "-B", str(SCRIPT), "compare", "no_such_run"], capture_output=True, text=True,
                              check=False)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertIn("no_such_run", done.stderr)


if __name__ == "__main__":
    unittest.main()
