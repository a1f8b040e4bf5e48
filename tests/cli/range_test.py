#!/usr/bin/env python3
"""`floatframe run` on models outside the range of the method: sentences on the terminal, in summary.json and in the report,
--strict, steps longer than the run, and what a summary says of its inputs. Set FLOATFRAME_BINARY or give its path."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from report_page import text_of

BINARY = os.environ.get("FLOATFRAME_BINARY") or (
    sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else "build/floatframe")
BINARY = str(pathlib.Path(BINARY).resolve())
MODELS = pathlib.Path(__file__).resolve().parents[1] / "data" / "range"
EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"


class Range(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_model(self, model, *arguments):
        done = subprocess.run([BINARY, "run", str(model), "--out", str(self.folder / "out"), *arguments], capture_output=True,
                              text=True, timeout=300, cwd=self.folder)
        path = self.folder / "out" / "summary.json"
        self.summary = json.loads(path.read_text()) if path.exists() else None
        return done

    def test_warnings_are_said_everywhere(self):
        for coordinates in "relative", "absolute":
            done = self.run_model(MODELS / "cantilever.yaml", "--coordinates", coordinates, "--quiet")
            self.assertEqual((done.returncode, done.stdout), (0, ""))
            warnings = self.summary["warnings"]
            self.assertEqual(len(warnings), 2)
            self.assertEqual(done.stderr, "".join(f"floatframe: warning: {w}\n" for w in warnings))
            self.assertIn("body 'beam' deforms too far for small deformations", warnings[0])
            self.assertEqual(self.summary["status"], "completed")
            report = text_of(self.folder / "out" / "report.html")
            self.assertLess(report.index("deforms too far for small deformations"), report.index("Newton iterations per step"))

    def test_strict_makes_them_errors(self):
        done = self.run_model(MODELS / "cantilever.yaml", "--strict", "--quiet")
        self.assertEqual(done.returncode, 1)
        self.assertIn("floatframe: the run failed: 2 warnings count as errors under --strict; the results are complete", done.stderr)
        self.assertEqual(self.summary["status"], "failed")
        self.assertAlmostEqual(self.summary["duration_s"], 0.3)
        self.assertEqual(len((self.folder / "out" / "results.csv").read_text().splitlines()), 302)
        report = text_of(self.folder / "out" / "report.html")
        self.assertIn("This run counts as failed", report)
        self.assertNotIn("partial", report)

    def test_strict_says_nothing_of_a_run_in_range(self):
        done = self.run_model(EXAMPLES / "flexible_pendulum" / "flexible_pendulum.yaml", "--strict", "--quiet", "--no-report")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        self.assertEqual(self.summary["warnings"], [])

    def test_an_equilibrium_out_of_range(self):
        def statics(*arguments):
            return subprocess.run([BINARY, "statics", str(MODELS / "cantilever.yaml"), *arguments], capture_output=True, text=True,
                                  timeout=300)
        done = statics("--json")
        warnings = json.loads(done.stdout)["warnings"]
        self.assertEqual(done.returncode, 0)
        self.assertEqual(len(warnings), 2)
        self.assertRegex(warnings[0], "^body 'beam' deforms too far for small deformations: in the equilibrium node 'tip' is ")
        self.assertIn("more than 10 % of its size of 1 m", warnings[0])
        self.assertRegex(warnings[1], "^body 'beam' bends too far for small rotations: in the equilibrium node 'tip' is turned by ")
        said = "".join(f"floatframe: warning: {w}\n" for w in warnings)
        self.assertEqual(done.stderr, said)
        plain, strict = statics(), statics("--strict")
        self.assertEqual((plain.returncode, plain.stderr), (0, said))
        self.assertEqual((strict.returncode, strict.stdout), (1, plain.stdout))
        self.assertEqual(strict.stderr, said + "floatframe: the equilibrium counts as failed: 2 warnings count as errors under --strict\n")
        little = statics("--set", "load=3.5", "--strict", "--json")
        self.assertEqual((little.returncode, little.stderr, json.loads(little.stdout)["warnings"]), (0, "", []))

    def test_a_paced_run_out_of_range_says_so_at_its_end(self):
        def realtime(*arguments):
            done = subprocess.run([BINARY, "realtime", str(MODELS / "cantilever.yaml"), "--no-pace", "--report", "report.json",
                                   *arguments], capture_output=True, text=True, timeout=300, cwd=self.folder)
            return done, json.loads((self.folder / "report.json").read_text())["warnings"]
        for options in ["--quiet"], ["--coordinates", "absolute"], ["--output", "udp"], ["--log", "log.csv"]:
            done, warnings = realtime(*options)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(len(warnings), 2, warnings)
            self.assertRegex(warnings[0], "^body 'beam' deforms too far for small deformations: from t = ")
            self.assertRegex(warnings[1], "^body 'beam' bends too far for small rotations: from t = ")
            said = [line for line in done.stderr.splitlines() if "warning" in line]
            self.assertEqual(said, [f"floatframe: warning: {w}" for w in warnings])
        done, warnings = realtime("--set", "load=3.5")
        self.assertEqual((done.returncode, warnings), (0, []))
        self.assertNotIn("warning", done.stderr)

    def test_advice_says_what_its_runs_left(self):
        def advise(*arguments):
            return subprocess.run([BINARY, "advise", str(MODELS / "cantilever.yaml"), "--repeat", "1", *arguments],
                                  capture_output=True, text=True, timeout=300, cwd=self.folder)
        text, done = advise(), advise("--json")
        figures = json.loads(done.stdout)
        full, reduced = figures["full"]["warnings"], figures["reduced"]["warnings"]
        self.assertRegex(full[0], "^body 'beam' deforms too far for small deformations: from t = ")
        self.assertEqual(len(reduced), 2 if figures["dropped"] else 0)
        said = "".join(f"floatframe: warning: {w}\n" for w in full) + "".join(
            f"floatframe: warning: without the modes that are dropped: {w}\n" for w in reduced)
        self.assertEqual((done.returncode, done.stderr), (0, said))
        self.assertEqual((text.returncode, text.stderr), (0, said))
        little = advise("--json", "--set", "load=3.5")
        self.assertEqual((little.stderr, json.loads(little.stdout)["full"]["warnings"]), ("", []))

    def test_balance_is_complete(self):
        self.assertEqual(self.run_model(MODELS / "springs.yaml", "--no-report").returncode, 0)
        energy = self.summary["energy"]
        balance, work = energy["balance"], energy["balance"]["work"]
        self.assertEqual(set(work), {"loads_J", "actuators_J", "dampers_J", "tyres_J", "modal_damping_J", "motions_J", "total_J"})
        self.assertAlmostEqual(sum(v for k, v in work.items() if k != "total_J"), work["total_J"], 9)
        change = energy["end"]["total_J"] - energy["start"]["total_J"]
        self.assertAlmostEqual(change - work["total_J"], balance["remainder_J"], 9)
        self.assertGreater(abs(work["total_J"]), 100 * abs(balance["remainder_J"]))

    def test_a_step_longer_than_the_run_is_refused(self):
        for command in ["run", "--out", "out"], ["realtime", "--no-pace"]:
            done = subprocess.run([BINARY, command[0], str(MODELS / "pendulum.yaml"), "--step", "1e300", *command[1:]],
                                  capture_output=True, text=True, timeout=300, cwd=self.folder)
            self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
            self.assertIn("the step of 1e+300 s is longer than the duration of 20 s", done.stderr)
        self.assertFalse((self.folder / "out").exists())

    def test_sentences_about_the_clock_say_who_gave_it(self):
        model = self.folder / "m.yaml"

        def refused(command, *arguments, simulation):
            model.write_text("floatframe: 1\nbodies: {b: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}}\n"
                             "simulation:\n" + "".join(f"  {line}\n" for line in simulation))
            done = subprocess.run([BINARY, command, "m.yaml", *arguments], capture_output=True, text=True, timeout=300,
                                  cwd=self.folder)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr)
            return done.stderr.strip()
        for command, arguments in ("run", ["--out", "out"]), ("realtime", ["--no-pace"]):
            long = ": the step of 2 s is longer than the duration of 1 s: expected at least one step"
            self.assertEqual(refused(command, *arguments, simulation=["duration: 1", "step: 2"]), "m.yaml:5:9" + long)
            self.assertEqual(refused(command, *arguments, simulation=["duration: 1e-4"]),
                             "m.yaml:4:13: the step of 0.001 s is longer than the duration of 0.0001 s: expected at least one step")
            self.assertEqual(refused(command, *arguments, "--step", "2", simulation=["duration: 1", "step: 0.1"]),
                             "floatframe: --step" + long)
            self.assertEqual(refused(command, *arguments, "--duration", "1", simulation=["duration: 3", "step: 2"]),
                             "floatframe: --duration" + long)
        many = ": a duration of 1 s with a step of 1e-14 s takes more than 1e+"
        for command, steps, arguments in ("run", "09", ["--out", "out"]), ("realtime", "12", ["--no-pace"]), ("advise", "07", []):
            self.assertIn("m.yaml:4:9" + many + steps, refused(command, *arguments, simulation=["step: 1e-14", "duration: 1"]))
            self.assertIn("floatframe: --step" + many + steps,
                          refused(command, *arguments, "--step", "1e-14", simulation=["step: 1", "duration: 1"]))
        self.assertEqual(refused("advise", simulation=["duration: 0.0001"]),
                         "m.yaml:4:13: the run is shorter than one step; give a --duration")
        self.assertEqual(refused("realtime", "--duration", "1e-8", simulation=["step: 1e-9"]),
                         "m.yaml:4:9: found a step of 1e-09 s, expected at least 1e-6 s and at most 1e6 s in step with the wall clock")
        self.assertEqual(refused("check", simulation=["tolerance: 1e300"]),
                         "m.yaml:4:14: simulation.tolerance: found 1e300, expected a number from 1e-15 to 1")

    def test_the_summary_says_what_was_read(self):
        names = {"iltis.yaml", "suspension.yaml", "body.obj"}
        for name in names:
            shutil.copy(EXAMPLES / "iltis" / name, self.folder)
        arguments = ["--set", "flexible=false", "--set", "speed=4", "--set", "speed=6", "--duration", "0.05", "--no-report", "--quiet"]
        self.assertEqual(self.run_model("iltis.yaml", *arguments).returncode, 0)
        self.assertEqual(self.summary["settings"], {"flexible": "false", "speed": "6"})
        before = self.summary["files"]
        self.assertEqual({pathlib.Path(f).name for f in before}, names)
        for value in before.values():
            self.assertRegex(value, "^[0-9a-f]{32}$")
        with open(self.folder / "suspension.yaml", "a") as file:
            file.write("# changed\n")
        self.run_model("iltis.yaml", *arguments)
        changed = {pathlib.Path(f).name for f in before if before[f] != self.summary["files"][f]}
        self.assertEqual(changed, {"suspension.yaml"})


if __name__ == "__main__":
    unittest.main(verbosity=2)
