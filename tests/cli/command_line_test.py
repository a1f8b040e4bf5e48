#!/usr/bin/env python3
"""The program `floatframe` from outside: exit codes, messages, files. Set FLOATFRAME_BINARY or give its path."""
import csv
import html.parser
import json
import os
import pathlib
import pty
import re
import subprocess
import sys
import tempfile
import unittest

from report_page import page_of, text_of

BINARY = os.environ.get("FLOATFRAME_BINARY") or (
    sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else "build/floatframe")
BINARY = str(pathlib.Path(BINARY).resolve())

# A rod of 1 m on a hinge, level at the start.
PENDULUM = """\
floatframe: 1
name: pendulum
parameters: {mass: 2}
bodies:
  rod:
    position: [0, 0, 0]
    rigid: {mass: "${mass}", centre_of_mass: [0.5, 0, 0], inertia: [0.01, 0.2, 0.2]}
joints:
  hinge: {type: revolute, child: rod, at: [0, 0, 0], axis: y}
outputs:
  rod.z: {position: {body: rod, at: [1, 0, 0]}, axis: z}
simulation: {step: 0.01, duration: 0.5}
"""

# A slider driven along x at 1 m/s and a hanging weight on a massless rod between the two: stretched after 1 s.
DEAD_END = """\
floatframe: 1
name: dead_end
bodies:
  slider:
    rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [0.1, 0.1, 0.1]}
  crank:
    position: [1, 0, 0]
    rigid: {mass: 1, centre_of_mass: [1.25, 0, 0], inertia: [0.1, 0.1, 0.1]}
joints:
  drive: {type: prismatic, child: slider, at: [0, 0, 0], axis: x, motion: {polynomial: [0, -1]}}
  hinge: {type: revolute, child: crank, at: [1, 0, 0], axis: y}
rods:
  tie: {from: {body: slider, at: [0, 0, 0]}, to: {body: crank, at: [1, 0, 0.75]}}
outputs:
  slider.x: {position: slider, axis: x}
simulation: {step: 0.01, duration: 2}
"""


# A bar whose mass model needs inertia terms by projection.
BAR = """\
floatframe: 1
points: {a: [0, 0, 0], b: [1, 0, 0]}
bodies:
  bar:
    flexible:
      material: {young: 70e9, poisson: 0.3, density: 2700}
      bars: {b: {from: a, to: b, elements: 4, section: {round: 0.01}}}
      clamped: [a]
      static_modes: [{point: b, dofs: [y, z]}]
      mass_model: six_dof
joints:
  weld: {type: weld, child: bar, at: a}
simulation: {step: 0.01, duration: 0.5}
"""


class Page(html.parser.HTMLParser):
    """Checks that tags match and notes what the page refers to."""
    VOID = {"meta", "br", "link", "img"}

    def __init__(self):
        super().__init__(convert_charrefs=True)
        self.open, self.errors, self.tags, self.text = [], [], [], []

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.errors.append(f"unexpected </{tag}> at {self.getpos()}")

    def handle_data(self, data):
        self.text.append(data)


class CommandLine(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="floatframe-cli-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "pendulum.yaml").write_text(PENDULUM)

    def floatframe(self, *arguments, **options):
        return subprocess.run([BINARY, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              timeout=120, check=False, **options)

    def expect(self, code, *arguments, out="", err=""):
        done = self.floatframe(*arguments)
        self.assertEqual(done.returncode, code, done.stderr + done.stdout)
        self.assertIn(out, done.stdout)
        self.assertIn(err, done.stderr)
        return done

    def files(self, folder="."):
        return sorted(p.name for p in (self.folder / folder).rglob("*") if p.is_file())


class Help(CommandLine):
    def commands(self, *command):
        """This command and all below it, as their help lists them."""
        done = self.expect(0, *command, "--help", out="Usage: " + " ".join(("floatframe", *command)))
        self.assertEqual(done.stderr, "")
        listed = re.findall(r"^  ([a-z]+)  ", done.stdout, re.MULTILINE)
        return [command] + [found for name in listed for found in self.commands(*command, name)]

    def test_every_command_explains_itself(self):
        found = self.commands()
        for command in ((), ("run",), ("bench",), ("bench", "iltis"), ("info",)):
            self.assertIn(command, found)

    def test_help_names_units_and_exit_codes(self):
        text = self.floatframe("run", "--help").stdout
        for part in ("[s]", "SECONDS", "relative", "projection", "out/<model name>", "Exit codes", "--set NAME=VALUE"):
            self.assertIn(part, text)

    def test_version(self):
        self.expect(0, "--version", out="floatframe 0.")


class Misuse(CommandLine):
    def test_bad_options_exit_2_with_one_line(self):
        for arguments, message in (
                (("fly",), "found the command 'fly', expected run, realtime, sweep, vehicle, check, statics, advise, mass, modes, linearize, campbell, response, compare, outputs, stress, rainflow, export, reduce, info, convert, pack, fmu, validate or bench"),
                (("run",), "MODEL is required"),
                (("run", ""), "MODEL: found an empty name, expected a file"),
                (("sweep", "", "--vary", "a=1,2"), "MODEL: found an empty name, expected a file"),
                (("runn", "pendulum.yaml"), "or bench, did you mean 'run'? (see floatframe --help)"),
                (("bench", "chian"), "expected iltis, chain, scaling, start or step, did you mean 'chain'? (see floatframe bench --help)"),
                (("run", "pendulum.yaml", "--frobnicate"), "floatframe: unknown option '--frobnicate' (see floatframe run --help)"),
                (("run", "pendulum.yaml", "--stepp", "1"), "unknown option '--stepp', did you mean '--step'? (see floatframe run --help)"),
                (("run", "pendulum.yaml", "--durations=1"), "unknown option '--durations', did you mean '--duration'?"),
                (("run", "--stepp", "pendulum.yaml"), "unknown option '--stepp', did you mean '--step'?"),
                (("run", "--stepp"), "unknown option '--stepp', did you mean '--step'?"),
                (("bench", "iltis", "--repeats", "2"), "unknown option '--repeats', did you mean '--repeat'? (see floatframe bench iltis"),
                (("--json", "check", "pendulum.yaml"), "unknown option '--json'"),
                (("run", "pendulum.yaml", "rod.yaml"), "found 'rod.yaml', expected nothing more (see floatframe run --help)"),
                (("run", "pendulum.yaml", "--coordinates", "polar"), "--coordinates: found 'polar', expected relative or absolute"),
                (("run", "pendulum.yaml", "--inertia", "guess"), "--inertia: found 'guess', expected preprocessing or projection"),
                (("run", "pendulum.yaml", "--step", "-0.1"), "--step: found '-0.1', expected a positive number [s]"),
                (("run", "pendulum.yaml", "--step", "0"), "--step: found '0', expected a positive number [s]"),
                (("run", "pendulum.yaml", "--step", "nan"), "--step: found 'nan', expected a positive number [s]"),
                (("run", "pendulum.yaml", "--step", "1ms"), "--step: found '1ms', expected a positive number [s]"),
                (("run", "pendulum.yaml", "--duration", "inf"), "--duration: found 'inf'"),
                (("run", "pendulum.yaml", "--step", "1e-300"), "1e+09 steps"),
                (("run", "pendulum.yaml", "--set", "mass"), "--set: found 'mass', expected NAME=VALUE"),
                (("check", "pendulum.yaml", "--set", "=3"), "--set: found '=3', expected NAME=VALUE"),
                (("bench",), "a command is required: iltis, chain, scaling, start or step"),
                (("bench", "speed"), "found the command 'speed', expected iltis, chain, scaling, start or step"),
                (("bench", "iltis", "--repeat", "0"), "--repeat: found '0', expected a whole number from 1 to 1000"),
                (("bench", "step", "--bricks", "2"), "--bricks: found '2', expected 1, 3, 5, 7 or 9"),
                (("info", ""), "FILE: found an empty name, expected a file"),
                (("bench", "iltis", "--model", "pendulum.yaml", "--duration", "0"), "--duration: found '0'"),
                (("bench", "iltis", "--repeat", "0"), "--repeat"),
                (("bench", "iltis", "--elements", "5,x"), "--elements"),
                (("bench", "iltis", "--model", "pendulum.yaml", "--json", "."), "Is a directory")):
            with self.subTest(arguments=arguments):
                done = self.expect(2, *arguments, err=message)
                self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
                self.assertTrue(done.stderr.startswith("floatframe: "), done.stderr)
                self.assertEqual(done.stdout, "")
        self.assertEqual(self.files(), ["pendulum.yaml"])

    def test_missing_file(self):
        for command in ("run", "check", "statics"):
            self.expect(2, command, "nowhere.yaml", err="nowhere.yaml")

    def test_errors_that_are_not_listed_are_counted(self):
        keys = "".join(f"key{k}: 1\n" for k in range(100))
        inside = "".join(f"    key{k}: 1\n" for k in range(30))
        (self.folder / "bad.yaml").write_text(PENDULUM.replace("joints:\n", inside + "joints:\n") + keys)
        lines = self.expect(2, "check", "bad.yaml").stderr.splitlines()
        self.assertLess(len(lines), 130)
        self.assertEqual(lines[-1], "130 errors in bad.yaml")
        bodies = "".join(f"  b{k}: {{rigid: {{mass: -1, centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}}}\n" for k in range(200))
        (self.folder / "bad.yaml").write_text("floatframe: 1\nbodies:\n" + bodies)
        lines = self.expect(2, "check", "bad.yaml").stderr.splitlines()
        self.assertLess(len(lines), 30)
        self.assertEqual(lines[-1], "200 errors in bad.yaml")

    def test_errors_are_listed_and_counted(self):
        (self.folder / "bad.yaml").write_text(PENDULUM.replace("step: 0.01", "stepp: 0.01").replace("type: rev", "typ: rev"))
        for command in ("run", "check", "statics"):
            done = self.expect(2, command, "bad.yaml")
            lines = done.stderr.splitlines()
            self.assertGreaterEqual(len(lines), 3, done.stderr)
            self.assertEqual(lines[-1], f"{len(lines) - 1} errors in bad.yaml")
            for line in lines[:-1]:
                self.assertRegex(line, r"^bad\.yaml:\d+:\d+: ")
        self.assertEqual(self.files(), ["bad.yaml", "pendulum.yaml"])

    def test_output_folder_that_cannot_be_written(self):
        done = self.expect(2, "run", "pendulum.yaml", "--out", "pendulum.yaml/out",
                           err="the output folder 'pendulum.yaml/out' cannot be written: Not a directory")
        self.assertEqual(done.stdout, "")

    def test_state_that_cannot_be_written_is_refused_before_anything_else_is(self):
        for command in ("run", "statics"):
            done = self.expect(2, command, "pendulum.yaml", "--write-state", "no/where.json",
                               err="the file 'no/where.json' cannot be written: No such file or directory")
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertEqual([p.name for p in self.folder.iterdir()], ["pendulum.yaml"])

    def test_standard_error_that_cannot_be_written_changes_no_exit_code(self):
        (self.folder / "bad.yaml").write_text(PENDULUM.replace("step: 0.01", "stepp: 0.01"))
        for arguments, code in ((("check", "bad.yaml"), 2), (("fly",), 2),
                                (("run", "pendulum.yaml", "--strict", "--step", "0.5", "--quiet"), 1)):
            for close in ("2>/dev/full", "2>&-", "0<&- 1>&- 2>&-"):
                with self.subTest(arguments=arguments, close=close):
                    done = subprocess.run(["sh", "-c", f'exec "$@" {close}', "sh", BINARY, *arguments], cwd=self.folder,
                                          timeout=60, check=False)
                    self.assertEqual(done.returncode, code)

    def test_closed_standard_files_are_not_taken_by_others(self):
        done = subprocess.run(["sh", "-c", 'exec "$@" 1>&- 2>&-', "sh", BINARY, "sweep", "pendulum.yaml", "--vary",
                               "duration=0.02,0.03", "--out", "study"], cwd=self.folder, timeout=300, check=False)
        self.assertEqual(done.returncode, 1)  # the summary cannot be printed
        self.assertEqual(len((self.folder / "study/sweep.csv").read_text().splitlines()), 3)
        self.assertTrue(all(line[16] == " " for line in
                            (self.folder / "study/sweep.journal").read_text().splitlines()))

    def test_names_in_messages_cannot_command_the_terminal(self):
        done = self.expect(1, "run", "pendulum.yaml", "--step", "0.5", "--strict", "--out", "a\x1b[31m", "--quiet")
        self.assertNotIn("\x1b", done.stderr)
        (self.folder / "b\x1b.yaml").write_text(PENDULUM.replace("step: 0.01", "stepp: 0.01").replace("type: rev", "typ: rev"))
        done = self.expect(2, "run", "b\x1b.yaml", err="errors in b\\x1b.yaml")
        self.assertNotIn("\x1b", done.stderr)

    def test_full_standard_output(self):
        with open("/dev/full", "w", encoding="ascii") as full:
            done = subprocess.run([BINARY, "check", "pendulum.yaml"], cwd=self.folder, stdout=full,
                                  stderr=subprocess.PIPE, text=True, timeout=60, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("standard output cannot be written", done.stderr)


class Run(CommandLine):
    def read_csv(self, folder):
        with open(self.folder / folder / "results.csv", newline="", encoding="utf-8") as file:
            return list(csv.reader(file))

    def test_writes_three_files_and_says_where(self):
        done = self.expect(0, "run", "pendulum.yaml")
        for name in ("results.csv", "report.html", "summary.json"):
            self.assertIn(f"out/pendulum/{name}", done.stdout)
        self.assertRegex(done.stdout, r"times real time at steps of 10 ms\)\n")
        self.assertRegex(done.stdout, r"  wall time \S+ s, \S+ s of it for results and report\n$")
        self.assertEqual(done.stderr, "")
        self.assertEqual(self.files("out"), ["report.html", "results.csv", "states.ffr", "summary.json"])

        rows = self.read_csv("out/pendulum")
        self.assertEqual(rows[0], ["time [s]", "rod.z [m]"])
        self.assertEqual(len(rows), 52)
        times = [float(row[0]) for row in rows[1:]]
        self.assertEqual(times[0], 0.0)
        self.assertAlmostEqual(times[-1], 0.5, 12)
        # Falls from rest under gravity: a tip of a rod of 1 m that starts level sinks, first slowly.
        heights = [float(row[1]) for row in rows[1:]]
        self.assertLess(heights[-1], -0.5)
        self.assertGreaterEqual(min(heights), -1.0 - 1e-9)

        summary = json.loads((self.folder / "out/pendulum/summary.json").read_text())
        for key in ("model", "coordinates", "inertia", "step_s", "duration_s", "steps", "substeps", "iterations",
                    "factorizations", "cpu_s", "real_time_factor", "max_position_violation",
                    "max_velocity_violation", "energy", "status"):
            self.assertIn(key, summary)
        self.assertEqual(summary["status"], "completed")
        self.assertEqual(summary["steps"], 50)
        self.assertEqual(summary["coordinates"], "relative")

    def test_report_is_well_formed_and_self_contained(self):
        self.expect(0, "run", "pendulum.yaml")
        page = Page()
        page.feed((self.folder / "out/pendulum/report.html").read_text(encoding="utf-8"))
        page.close()
        self.assertEqual(page.errors, [])
        self.assertEqual(page.open, [])
        shown = page_of(self.folder / "out/pendulum/report.html")
        for tag, attributes in page.tags:
            self.assertNotIn(tag, ("img", "iframe", "object") if shown else ("script", "img", "link", "iframe", "object"))
            self.assertNotIn("src", attributes)
            self.assertNotRegex(attributes.get("href", "#"), "^[^#d]")  # a place on the page, or data
        text = text_of(self.folder / "out/pendulum/report.html")
        for part in ("pendulum", "rod.z", "total"):
            self.assertIn(part, text)
        self.assertNotIn("results are partial", text)

    def test_options_reach_the_run(self):
        self.expect(0, "run", "--set", "mass=3", "pendulum.yaml", "--coordinates", "absolute", "--step", "0.005",
                    "--duration", "0.1", "--out", "a/b", "--no-report", "--quiet")
        self.assertEqual(self.files("a/b"), ["results.csv", "states.ffr", "summary.json"])
        summary = json.loads((self.folder / "a/b/summary.json").read_text())
        self.assertEqual((summary["coordinates"], summary["step_s"], summary["steps"]), ("absolute", 0.005, 20))

    def test_quiet_prints_nothing(self):
        done = self.expect(0, "run", "pendulum.yaml", "--quiet")
        self.assertEqual(done.stdout + done.stderr, "")

    def test_runs_repeat_to_the_bit(self):
        self.expect(0, "run", "pendulum.yaml", "--out", "one", "--quiet")
        self.expect(0, "run", "pendulum.yaml", "--out", "two", "--quiet")
        self.assertEqual((self.folder / "one/results.csv").read_bytes(), (self.folder / "two/results.csv").read_bytes())

    def test_failed_run_keeps_partial_results(self):
        (self.folder / "dead_end.yaml").write_text(DEAD_END)
        done = self.expect(1, "run", "dead_end.yaml", err="floatframe: the run failed: ")
        self.assertIn("marked as partial", done.stderr)
        rows = self.read_csv("out/dead_end")
        end = float(rows[-1][0])
        self.assertTrue(0.9 < end < 1.01, end)
        self.assertTrue(all(len(row) == len(rows[0]) for row in rows))
        summary = json.loads((self.folder / "out/dead_end/summary.json").read_text())
        self.assertEqual(summary["status"], "failed")
        self.assertRegex(summary["message"], "'(tie|hinge|crank|slider|drive)'")
        report = text_of(self.folder / "out/dead_end/report.html")
        self.assertIn("This run failed: the results are partial.", report)

    def test_progress_bar_on_a_terminal_only(self):
        self.assertEqual(self.expect(0, "run", "pendulum.yaml").stderr, "")
        pid, terminal = pty.fork()
        if pid == 0:
            os.chdir(self.folder)
            os.execv(BINARY, [BINARY, "run", "pendulum.yaml"])
        shown = b""
        try:
            while chunk := os.read(terminal, 4096):
                shown += chunk
        except OSError:
            pass
        self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]), 0)
        self.assertIn(b"[########################################]", shown)


class CheckAndStatics(CommandLine):
    def test_check_counts(self):
        counts = json.loads(self.expect(0, "check", "pendulum.yaml", "--json").stdout)
        self.assertEqual(counts["bodies"], 1)
        self.assertEqual(counts["flexible_bodies"], 0)
        self.assertEqual(counts["joints"], 1)
        self.assertEqual(counts["cut_joints"], 0)
        self.assertEqual(counts["relative"], {"rigid": 1, "elastic": 0, "total": 1, "constraints": 0})
        self.assertEqual(counts["absolute"]["total"] - counts["absolute"]["constraints"], 1)
        self.assertEqual(counts["degrees_of_freedom"], 1)
        self.assertEqual(counts["redundant_constraints"], 0)
        self.expect(0, "check", "pendulum.yaml", out="degrees of freedom: 1")

    def test_mass_models_that_do_not_go_with_the_inertia_method_have_a_place(self):
        pathlib.Path(self.folder, "bar.yaml").write_text(BAR)
        for command in ("check", "statics", "run", "advise", "mass"):
            self.expect(2, command, "bar.yaml", err="bar.yaml:10:19: bodies.bar.flexible.mass_model: found six_dof")

    def test_statics(self):
        result = json.loads(self.expect(0, "statics", "pendulum.yaml", "--json").stdout)
        self.assertEqual(set(result), {"model", "iterations", "residual", "forces", "joints", "bodies", "redundant", "notes", "warnings"})
        self.assertEqual(result["bodies"][0]["name"], "rod")
        force = result["joints"][0]["force"]
        self.assertAlmostEqual(force[2], 2 * 9.81, 6)
        self.expect(0, "statics", "pendulum.yaml", out="hinge")

    def test_mass(self):
        result = json.loads(self.expect(0, "mass", "pendulum.yaml", "--set", "mass=3", "--json").stdout)
        self.assertEqual((result["model"], result["mass_kg"], result["time_s"]), ("pendulum", 3, 0))
        self.assertEqual(result["centre_of_mass_m"], [0.5, 0, 0])
        for row, expected in zip(result["inertia_kg_m2"], ([0.01, 0, 0], [0, 0.2, 0], [0, 0, 0.2])):
            for value, wanted in zip(row, expected):
                self.assertAlmostEqual(value, wanted, 14)
        self.assertEqual([body["name"] for body in result["bodies"]], ["rod"])
        self.expect(0, "mass", "pendulum.yaml", out="pendulum: mass 2 kg, t = 0 s\n")
        self.expect(2, "mass", "pendulum.yaml", "--set", "mass=0", err="bodies without mass")


class Bench(CommandLine):
    def test_iltis_finds_its_model_and_writes_json(self):
        examples = pathlib.Path(os.environ.get("FLOATFRAME_EXAMPLES") or
                                pathlib.Path(__file__).resolve().parents[2] / "examples")
        model = examples / "iltis" / "iltis.yaml"
        done = self.expect(0, "bench", "iltis", "--repeat", 1, "--elements", "5,10", "--duration", 1,
                           "--json", "bench.json", "--model", model)
        for part in ("Abs. + B", "Rel. + P", "paper", "4.19", "0.79", "x real time",
                     "one dense LLT of a 98 x 98 matrix", "one full Newton iteration"):
            self.assertIn(part, done.stdout)
        figures = json.loads((self.folder / "bench.json").read_text())
        self.assertEqual(len(figures["rows"]), 8)
        for row in figures["rows"]:
            self.assertEqual(row["steps"], 100)
            self.assertGreater(row["iterations"], 0)
            self.assertGreater(row["cpu_s_min"], 0)
            self.assertGreaterEqual(row["cpu_s_median"], row["cpu_s_min"])
        self.assertEqual([row["step_s"] for row in figures["errors"]], [0.01, 0.005, 0.002, 0.001])
        for row in figures["errors"]:  # largest on the ramp, where the wheels rise first
            self.assertTrue(row["channel"].endswith(".wheel.z"), row)
            self.assertGreater(row["time_s"], 0.5)
            self.assertGreater(row["cpu_s_min"], 0)
        errors = [row["error_m"] for row in figures["errors"]]
        self.assertLess(errors[0], 0.01)
        for larger, smaller in zip(errors, errors[1:]):
            self.assertLess(smaller, larger / 1.5)
        self.assertGreater(figures["dense_llt_98_us"], 0)
        self.assertGreater(figures["rel_p_iteration_us"], 0)
        self.assertEqual(self.files(), ["bench.json", "pendulum.yaml"])


if __name__ == "__main__":
    unittest.main()
