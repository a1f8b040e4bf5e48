#!/usr/bin/env python3
"""`floatframe bench` from outside: figures, JSON, bad options. Set FLOATFRAME_BINARY. Times are never judged."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

BINARY = str(pathlib.Path(os.environ.get("FLOATFRAME_BINARY", "build/floatframe")).resolve())


class Bench(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="floatframe-bench-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def bench(self, *arguments, code=0):
        done = subprocess.run([BINARY, "bench", *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              timeout=240, check=False)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def files(self):
        return sorted(p.name for p in self.folder.iterdir())


class Help(Bench):
    def test_every_benchmark_explains_itself(self):
        for name in ("chain", "scaling", "step", "iltis"):
            done = self.bench(name, "--help")
            self.assertIn("Usage: floatframe bench " + name, done.stdout)
            self.assertEqual(done.stderr, "")


class Chain(Bench):
    def test_long_chains_run_in_all_four_combinations(self):
        self.bench("chain", "--links", "64,256", "--duration", 0.002, "--elements", 4, "--repeat", 1, "--seconds", 0.01,
                   "--json", "long.json")
        rows = json.loads((self.folder / "long.json").read_text())["rows"]
        self.assertEqual(len(rows), 8)
        for row in rows:
            self.assertIsNone(row["failure"])
            self.assertEqual(row["substeps"], 0)
            self.assertGreaterEqual(row["steps"], 1)
            self.assertTrue(1 <= row["iterations_per_step"] <= 4, row)
            self.assertTrue(0 <= row["energy_drift"] < 1e-5, row)

    def test_table_and_json_hold_the_four_combinations(self):
        done = self.bench("chain", "--links", "1,2", "--duration", 0.05, "--elements", 4, "--repeat", 2, "--seconds", 0.01,
                          "--json", "chain.json")
        self.assertEqual(done.stderr, "")
        for part in ("Rel. + P", "Rel. + B", "Abs. + P", "Abs. + B", "one dense LLT", "processor"):
            self.assertIn(part, done.stdout)
        figures = json.loads((self.folder / "chain.json").read_text())
        rows = figures["rows"]
        self.assertEqual([(r["links"], r["coordinates"], r["inertia"]) for r in rows],
                         [(n, c, i) for n in (1, 2) for c in ("relative", "absolute")
                          for i in ("preprocessing", "projection")])
        for row in rows:
            self.assertEqual(row["modes"], 8)
            self.assertIn(row["steps"], range(1, 51))
            self.assertLessEqual(row["us_per_step_min"], row["us_per_step_median"])
            self.assertGreater(row["us_per_step_min"], 0)
            self.assertTrue(1 <= row["iterations_per_step"] <= 20, row)
            self.assertTrue(0 <= row["energy_drift"] < 1e-2, row)
            self.assertIsNone(row["tip_error_m"])  # the run ends before 1 s
            self.assertIsNone(row["failure"])
        self.assertGreater(figures["dense_llt_98_us"], 0)
        for key in ("build", "cpu"):
            self.assertTrue(figures[key])
        self.assertEqual(self.files(), ["chain.json"])

    def test_tip_at_one_second(self):
        self.bench("chain", "--links", 1, "--coordinates", "relative", "--inertia", "projection", "--elements", 4,
                   "--duration", 1, "--repeat", 1, "--seconds", 0.5, "--json", "chain.json")
        (row,) = json.loads((self.folder / "chain.json").read_text())["rows"]
        self.assertEqual((row["coordinates"], row["inertia"], row["freedoms"]), ("relative", "projection", 9))
        if row["steps"] == 1000:  # a slow machine may not get there in the seconds it is given
            self.assertTrue(0 < row["tip_error_m"] < 1e-3, row)
        self.assertIsNone(row["tip_to_published_m"])  # that is known of four links only

    def test_lists_of_modes(self):
        self.bench("chain", "--links", 1, "--modes", "4,8", "--coordinates", "relative", "--inertia", "preprocessing",
                   "--duration", 0.02, "--repeat", 1, "--seconds", 0.01, "--json", "chain.json")
        rows = json.loads((self.folder / "chain.json").read_text())["rows"]
        self.assertEqual([(r["modes"], r["freedoms"]) for r in rows], [(4, 5), (8, 9)])

    def test_a_run_that_fails_is_told_and_the_others_shown(self):
        done = self.bench("chain", "--links", "1,2", "--tolerance", 1e-300, "--duration", 0.002, "--repeat", 1,
                          "--seconds", 0.001, "--coordinates", "relative", "--inertia", "preprocessing", code=1)
        self.assertIn("Failed:", done.stdout)
        self.assertIn("2 links, Rel. + P: step failed at t = 0 s", done.stdout)

    def test_bad_options_are_one_sentence(self):
        for arguments, message in (
                (("--links", "0"), "--links"),
                (("--links", "1,x"), "--links"),
                (("--links", "5000"), "--links"),
                (("--modes", "0"), "--modes"),
                (("--modes", "8,200"), "--modes: found 200, expected at most 40 with 20 elements per link"),
                (("--modes", "9", "--elements", "1"), "--modes: found 9, expected at most 1 with 1 element per link"),
                (("--elements", "0"), "--elements"),
                (("--step", "0"), "--step: found '0', expected a positive number"),
                (("--step", "nan"), "--step: found 'nan'"),
                (("--step", "3"), "--duration: found 2 s, expected at least one step of 3 s"),
                (("--step", "1e-9"), "--step: found 1e-09 s, expected at most 10 million steps"),
                (("--duration", "-1"), "--duration: found '-1'"),
                (("--tolerance", "0"), "--tolerance: found '0', expected a number above 0 and up to 1"),
                (("--tolerance", "1e-6x"), "--tolerance: found '1e-6x'"),
                (("--spectral-radius", "1.5"), "--spectral-radius: found '1.5'"),
                (("--coordinates", "natural"), "--coordinates"),
                (("--inertia", "both"), "--inertia"),
                (("--repeat", "0"), "--repeat"),
                (("--json", "no/such/folder/f.json"), "no/such/folder"),
                (("--json", "."), "."),
                (("more",), "more")):
            with self.subTest(arguments):
                done = self.bench("chain", *arguments, code=2)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                self.assertTrue(done.stderr.startswith("floatframe: "), done.stderr)
                self.assertIn(message, done.stderr)
                self.assertEqual(done.stdout, "")
        self.assertEqual(self.files(), [])


class Scaling(Bench):
    def test_a_sweep(self):
        done = self.bench("scaling", "--sweep", "modes", "--steps", 5, "--repeat", 1, "--seconds", 0.001, "--coordinates",
                          "relative", "--json", "scaling.json")
        self.assertIn("Modes per link", done.stdout)
        self.assertNotIn("Links (", done.stdout)
        rows = json.loads((self.folder / "scaling.json").read_text())["rows"]
        self.assertEqual([r["value"] for r in rows], [4, 8, 16, 32, 64])
        self.assertEqual([r["iteration_ratio"] for r in rows if r["value"] == 8], [1.0])
        for row in rows:
            self.assertEqual((row["sweep"], row["links"], row["finite_element_dofs"]), ("modes", 4, 246))
            self.assertGreater(row["us_per_iteration_min"], 0)

    def test_bad_options_are_one_sentence(self):
        for arguments in (("--sweep", "wheels"), ("--steps", "0"), ("--seconds", "0"), ("--step", "x"),
                          ("--inertia", "none"), ("--json", "no/such/folder/f.json")):
            with self.subTest(arguments):
                done = self.bench("scaling", *arguments, code=2)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                self.assertEqual(done.stdout, "")


class Step(Bench):
    def test_counts(self):
        done = self.bench("step", "--duration", 0.05, "--links", 2, "--json", "step.json")
        self.assertIn("50 steps of 1 ms", done.stdout)
        facts = json.loads((self.folder / "step.json").read_text())
        self.assertEqual((facts["model"], facts["steps"]), ("chain_2", 50))
        self.assertGreaterEqual(facts["iterations"], 50)

    def test_full_iterations(self):
        self.bench("step", "--iterations", 3, "--json", "step.json")
        facts = json.loads((self.folder / "step.json").read_text())
        self.assertEqual((facts["steps"], facts["full_iterations"]), (0, 3))

    def test_bricks(self):
        self.assertIn("chain_4", self.bench("step", "--bricks", 1, "--duration", 0.002).stdout)

    def test_bad_options_are_one_sentence(self):
        for arguments, message in ((("nowhere.yaml",), "nowhere.yaml"), (("--bricks", "2"), "--bricks"),
                                   (("--modes", "100"), "--modes: found 100"), (("--step", "-1"), "--step"),
                                   (("--duration", "x"), "--duration")):
            with self.subTest(arguments):
                done = self.bench("step", *arguments, code=2)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                self.assertIn(message, done.stderr)


if __name__ == "__main__":
    unittest.main()
