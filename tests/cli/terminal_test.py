#!/usr/bin/env python3
"""What people see who sit at a terminal, and programs that read pipes do not: colours, the line of a file under an error, tables
that fit, progress with a time to go, and help in groups.

usage: tests/cli/terminal_test.py [PROGRAM]
"""
import fcntl
import os
import pathlib
import pty
import re
import shutil
import struct
import subprocess
import tempfile
import termios
import unittest

BINARY = str(pathlib.Path(os.environ.get("FLOATFRAME_BINARY", "build/floatframe")).resolve())
STYLE = re.compile(r"\x1b\[[0-9;]*m")

MODEL = """\
floatframe: 1
name: arm
bodies:
  a_body_with_a_long_name: {rigid: {mass: 2, centre_of_mass: [0.5, 0, 0], inertia: [0.01, 0.01, 0.01]}}
joints:
  hinge: {type: revolute, child: a_body_with_a_long_name, at: [0, 0, 0], axis: y}
outputs:
  q: {joint_position: hinge}
simulation: {step: 0.001, duration: 0.5}
"""


class Terminal(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="floatframe_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        (self.folder / "arm.yaml").write_text(MODEL)

    def write(self, name, text):
        (self.folder / name).write_bytes(text if isinstance(text, bytes) else text.encode())

    def on_terminal(self, *arguments, width=0, **variables):
        """Exit code and what a terminal of this width gets of both streams; 0: it does not know its width."""
        ours, theirs = pty.openpty()
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, width, 0, 0))
        environment = {k: v for k, v in os.environ.items() if k not in ("NO_COLOR", "COLUMNS")}
        with subprocess.Popen([BINARY, *arguments], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=theirs, stderr=theirs,
                              env={**environment, "TERM": "xterm", **variables}) as program:
            os.close(theirs)
            shown = b""
            try:
                while part := os.read(ours, 4096):
                    shown += part
            except OSError:  # closed by its end
                pass
        os.close(ours)
        return program.returncode, shown.decode().replace("\r\n", "\n")

    def piped(self, *arguments, **variables):
        return subprocess.run([BINARY, *arguments], cwd=self.folder, capture_output=True, text=True, check=False,
                              env={**os.environ, **variables})


class Errors(Terminal):
    def lines_of_error(self, text, **options):
        """The lines of a terminal about the key 'mas' of a model with this text."""
        self.write("bad.yaml", text)
        code, shown = self.on_terminal("check", "bad.yaml", **options)
        self.assertEqual(code, 2, shown)
        lines = STYLE.sub("", shown).splitlines()
        return lines[next(k for k, line in enumerate(lines) if "'mas'" in line):]

    def under_caret(self, lines):
        """What stands above the caret, to the end of the line."""
        source, caret = lines[1], lines[2]
        self.assertEqual(caret.strip(" |"), "^")
        return source[caret.index("^"):]

    def test_the_line_with_a_caret(self):
        lines = self.lines_of_error(MODEL.replace("mass: 2", "mas: 2"))
        self.assertRegex(lines[0], r"^bad.yaml:4:\d+: ")
        self.assertTrue(self.under_caret(lines).startswith("mas: 2,"), lines)

    def test_letters_of_several_bytes_and_tabs_before_the_place(self):
        for before in ("'überlänge'", "\t'x'"):
            with self.subTest(before):
                lines = self.lines_of_error(MODEL.replace("name: arm", f"name: {before}").replace("{rigid: {mass: 2", f"{{part: {before}, rigid: {{mas: 2"))
                self.assertTrue(self.under_caret(lines).startswith("mas: 2,"), lines)

    def test_long_lines_are_cut_around_the_place(self):
        lines = self.lines_of_error(MODEL.replace("mass: 2", "mas: 2").replace("{rigid:", "{" + 300 * " " + "rigid:"), width=60)
        self.assertLessEqual(max(len(line) for line in lines[1:3]), 60)
        self.assertTrue(self.under_caret(lines).startswith("mas: 2"), lines)
        self.assertIn("…", lines[1])

    def test_programs_get_one_line_for_each_error(self):
        self.write("bad.yaml", MODEL.replace("mass: 2", "mas: 2"))
        told = self.piped("check", "bad.yaml").stderr
        self.assertNotIn("\x1b", told)
        self.assertNotIn("^", told)
        for line in told.splitlines()[:-1]:
            self.assertRegex(line, r"^bad.yaml:\d+:\d+: ")

    def test_files_that_are_no_text(self):
        self.write("bad.yaml", b"floatframe: 1\nname: \x00\x1b[31m\n")
        code, shown = self.on_terminal("check", "bad.yaml")
        self.assertEqual(code, 2)
        self.assertNotIn("^\n", shown)
        self.assertNotIn("\x1b[31m", shown)


class Colours(Terminal):
    def test_errors_are_red_unless_no_colour_is_wanted(self):
        self.write("bad.yaml", MODEL.replace("mass: 2", "mas: 2"))
        self.assertIn("\x1b[1;31m", self.on_terminal("check", "bad.yaml")[1])
        for variables in ({"NO_COLOR": "1"}, {"TERM": "dumb"}):
            shown = self.on_terminal("check", "bad.yaml", **variables)[1]
            self.assertNotIn("\x1b", shown)
            self.assertIn("^", shown)
        self.assertIn("\x1b[1;31m", self.on_terminal("check", "bad.yaml", NO_COLOR="")[1])
        self.assertIn("\x1b[1;31m", self.on_terminal("frobnicate")[1])

    def test_warnings_are_yellow(self):
        self.write("fast.yaml", MODEL.replace("axis: y}", "axis: y, velocity: 900}").replace("step: 0.001", "step: 0.01"))
        code, shown = self.on_terminal("run", "fast.yaml", "--quiet", "--no-report")
        self.assertEqual(code, 0, shown)
        self.assertIn("\x1b[1;33mwarning:\x1b[0m ", shown)

    def test_headings_are_bold(self):
        self.assertIn("\x1b[1mOptions:\x1b[0m", self.on_terminal("run", "--help")[1])
        self.assertNotIn("\x1b", self.piped("run", "--help").stdout)


class Tables(Terminal):
    def test_tables_fit_into_the_terminal(self):
        wide = self.piped("mass", "arm.yaml", COLUMNS="40").stdout
        self.assertGreater(max(len(line) for line in wide.splitlines() if "a_body" in line), 50)
        for options in ({"width": 45}, {"width": 200, "COLUMNS": "45"}):
            shown = STYLE.sub("", self.on_terminal("mass", "arm.yaml", **options)[1])
            tables = [line for line in shown.splitlines() if "a_body_with_a_long_name" in line]
            self.assertGreater(len(tables), 1, shown)  # the name of a row stands in every part of its table
            self.assertLessEqual(max(map(len, tables)), 45)
            for number in re.findall(r"-?\d+\.?\d*", next(line for line in wide.splitlines() if "a_body" in line)):
                self.assertIn(number, " ".join(tables))


class Progress(Terminal):
    def test_percentage_and_time_to_go(self):
        code, shown = self.on_terminal("run", "arm.yaml", "--no-report", "--record", "none", "--duration", "60", width=100)
        self.assertEqual(code, 0, shown)
        bars = shown[:shown.rindex("\x1b[K")].split("\r")
        percentages = [int(m[1]) for bar in bars if (m := re.search(r"\] .*?, (\d+) %", bar))]
        self.assertEqual(percentages, sorted(percentages))
        self.assertEqual(percentages[-1], 100)
        self.assertGreater(len(percentages), 50)
        # A fraction of the cells is filled that is the percentage.
        for bar in bars:
            if m := re.match(r"\[(#*)(\.*)\] .*?, (\d+) %", bar):
                self.assertEqual(len(m[1] + m[2]), 40)
                self.assertLessEqual(abs(len(m[1]) / 40 - int(m[3]) / 100), 0.03)

    def test_a_bar_stays_in_its_line(self):
        shown = self.on_terminal("run", "arm.yaml", "--no-report", "--record", "none", width=30)[1]
        bars = [line.split("\x1b")[0] for line in shown.split("\r") if line.startswith("[") and "%" in line]
        self.assertGreater(len(bars), 10)
        self.assertLess(max(map(len, bars)), 30)

    def test_commands_on_results_show_theirs(self):
        self.assertEqual(self.piped("run", "arm.yaml", "--quiet", "--no-report", "--out", "out").returncode, 0)
        self.assertRegex(self.on_terminal("export", "out", "--csv", "motion.csv")[1], r"\] .*, 100 %")
        self.assertEqual(self.piped("export", "out", "--csv", "again.csv").stderr.count("%"), 0)


class Help(Terminal):
    def commands(self, text):
        return re.findall(r"^  ([a-z]+)  ", text, re.MULTILINE)

    def test_nothing_given_shows_the_help_and_counts_as_a_mistake(self):
        done = self.piped()
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertTrue(done.stderr.startswith(self.piped("--help").stdout))
        self.assertTrue(done.stderr.endswith("a command is required\n"))

    def test_commands_in_groups(self):
        text = self.piped("help").stdout
        groups = {part.split(":\n")[0]: self.commands(part) for part in text.split("\n\n") if self.commands(part)}
        self.assertGreater(len(groups), 4)
        together = [{"run", "sweep", "realtime"}, {"modes", "campbell", "statics"}, {"stress", "export", "outputs"}, {"reduce", "info"}]
        for some in together:
            self.assertEqual(sum(some <= set(group) for group in groups.values()), 1, groups)
        everything = [name for group in groups.values() for name in group]
        self.assertEqual(len(everything), len(set(everything)))

    def test_help_of_a_command(self):
        for words in (["run"], ["bench"], ["bench", "chain"]):
            asked = self.piped("help", *words)
            self.assertEqual(asked.returncode, 0)
            self.assertEqual(asked.stdout, self.piped(*words, "--help").stdout)
        self.assertEqual(self.piped("help").stdout, self.piped("--help").stdout)
        for words in (("run", "arm.yaml", "--help"), ("help", "run", "arm.yaml")):
            self.assertEqual(self.piped(*words).stdout, self.piped("run", "--help").stdout)

    def test_help_of_what_is_no_command(self):
        for words in (("help", "runn"), ("runn", "--help")):
            done = self.piped(*words)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn("did you mean 'run'?", done.stderr)


if __name__ == "__main__":
    unittest.main()
