#!/usr/bin/env python3
"""SIGKILL at random moments of run, sweep, reduce and of runs with checkpoints: what is on disk is readable and right, and
what is continued is equal to the bit. FLOATFRAME_KILLS is the number of moments for each, FLOATFRAME_SEED begins them."""
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import time
import unittest
import zipfile

from run_case import RunCase

KILLS = int(os.environ.get("FLOATFRAME_KILLS", "3"))
SEED = int(os.environ.get("FLOATFRAME_SEED", "1"))
DATA = pathlib.Path(os.environ.get("FLOATFRAME_TEST_DATA") or pathlib.Path(__file__).resolve().parents[1] / "data")
REDUCE = ("reduce", str(DATA / "fe" / "aarm_coarse_free.inp"), "--units", "mm-t-s", "--interface", "BUSH_F=set:BUSH_F",
          "--interface", "BUSH_R=set:BUSH_R", "--interface", "BALL=set:BALL", "--modes", "5", "--report", "report.json",
          "--quiet")


class Kill(RunCase):
    def setUp(self):
        super().setUp()
        self.random = random.Random(SEED)

    def timed(self, *arguments):
        """How long the command takes [s], at least 20 ms."""
        begin = time.monotonic()
        self.program(*arguments)
        return max(0.02, time.monotonic() - begin)

    def killed(self, seconds, *arguments):
        """True if the command was still at work after so long; then it has been killed, with all it had started."""
        process = self.begin(*arguments, start_new_session=True)
        try:
            process.communicate(timeout=seconds)
            return False
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            return True

    def moments(self, whole):
        for k in range(KILLS):
            yield k, self.random.uniform(0.0, 1.1 * whole)

    def check_beginning(self, folder, whole):
        """Results that are there are a beginning of those of the whole run: whole lines but perhaps for the last one."""
        path = self.folder / folder / "results.csv"
        if not path.exists():
            return
        data = path.read_bytes()
        self.assertTrue(whole.startswith(data), folder)
        self.rows(folder)
        if self.summary(folder)["status"] != "running":
            self.assertEqual((self.summary(folder)["status"], data), ("completed", whole))

    def members(self, file):
        """Names and contents of a body file, but for the header, which tells how long the reduction took."""
        with zipfile.ZipFile(self.folder / file) as archive:
            self.assertIsNone(archive.testzip())
            return {name: archive.read(name) for name in archive.namelist()[1:]}

    def test_run(self):
        setting = ("run", "m.yaml", "--set", "duration=12", "--quiet")
        whole = self.timed(*setting, "--out", "whole")
        expected = (self.folder / "whole/results.csv").read_bytes()
        for k, moment in self.moments(whole):
            with self.subTest(seed=SEED, kill=k, moment=moment):
                shutil.rmtree(self.folder / "out", ignore_errors=True)
                self.killed(moment, *setting, "--out", "out")
                self.check_beginning("out", expected)
                self.assertLessEqual({p.name for p in (self.folder / "out").glob("*") if ".part-" not in p.name},
                                     {"results.csv", "states.ffr", "summary.json", "report.html", "run.lock"})
        # What the killed ones have left is in nobody's way.
        self.program(*setting, "--out", "out")
        self.same_files("out", "whole")
        self.assertEqual(sorted(p.name for p in (self.folder / "out").iterdir()),
                         ["report.html", "results.csv", "states.ffr", "summary.json"])

    def test_checkpoints(self):
        for options in ((), ("--coordinates", "absolute", "--inertia", "projection")):
            setting = ("run", "m.yaml", "--set", "duration=10", *options, "--quiet")
            whole = self.timed(*setting, "--out", "whole")
            expected = (self.folder / "whole/results.csv").read_bytes()
            continued = 0
            for k, moment in self.moments(whole):
                with self.subTest(seed=SEED, options=options, kill=k, moment=moment):
                    shutil.rmtree(self.folder / "out", ignore_errors=True)
                    again = setting + ("--out", "out")
                    if k == 0:  # surely between two checkpoints
                        process = self.begin(*again, "--checkpoint-every", "0.05")
                        self.wait_for((self.folder / "out/run.checkpoint").exists, process)
                        self.end(process, signal.SIGKILL)
                    else:
                        self.killed(moment, *again, "--checkpoint-every", "0.05")
                    # Killed again and again on its way, the run ends with the files of one that nobody killed.
                    for part in range(4):
                        self.check_beginning("out", expected)
                        if not (self.folder / "out/run.checkpoint").exists():
                            break
                        continued += 1
                        if part < 3:
                            self.killed(self.random.uniform(0.0, whole), *again, "--resume")
                        else:
                            self.program(*again, "--resume")
                    if (self.folder / "out/results.csv").exists() and self.summary("out")["status"] == "completed":
                        self.same_files("out", "whole")
                        self.assertFalse((self.folder / "out/run.checkpoint").exists())
            self.assertGreater(continued, 0)

    def test_repeated_command(self):
        """The same command at random moments of a run that goes on, and after its end by SIGKILL: it is refused without a
        trace, or it replaces what was complete. What is not of the program stays in any case."""
        foreign = {"notes.txt": b"mine\n", "results.csv.part-mine": b"1,2\n", "previous/notes.txt": b"also mine\n"}
        command = ("run", "m.yaml", "--set", "duration=10", "--quiet", "--out", "out", "--checkpoint-every", "0.05")
        whole = self.timed(*command[:-4], "--out", "whole")
        expected = (self.folder / "whole/results.csv").read_bytes()
        (self.folder / "out/previous").mkdir(parents=True)
        for name, content in foreign.items():
            (self.folder / "out" / name).write_bytes(content)
        refused = 0
        for k, moment in self.moments(whole):
            with self.subTest(seed=SEED, repetition=k, moment=moment):
                process = self.begin(*command)
                time.sleep(moment)
                if process.poll() is None:
                    again = self.program(*command, code=None)
                    if again.returncode == 2:
                        self.assertRegex(again.stderr, "is in use|holds an unfinished run")
                process.kill()
                process.communicate()
                before = {p: p.read_bytes() for p in (self.folder / "out").rglob("*") if p.is_file() and p.name != "run.lock"}
                if (self.folder / "out/run.checkpoint").exists() and self.summary("out")["status"] != "completed":
                    refused += 1
                    self.assertIn("holds an unfinished run", self.program(*command, code=2).stderr)
                    after = {p: p.read_bytes() for p in (self.folder / "out").rglob("*") if p.is_file()}
                    self.assertEqual({p: c for p, c in before.items() if not re.search(r"\.part-\d+-\d+$", p.name)},
                                     {p: c for p, c in after.items() if p.name != "run.lock"})
                    self.program(*command[:-2], "--resume")
                else:
                    self.program(*command)
                self.assertEqual((self.folder / "out/results.csv").read_bytes(), expected)
                self.assertEqual(self.summary("out")["status"], "completed")
                for name, content in foreign.items():
                    self.assertEqual((self.folder / "out" / name).read_bytes(), content)
        if KILLS >= 3:
            self.assertGreater(refused, 0)

    def test_a_completed_run_survives_kills_of_the_next(self):
        command = ("run", "m.yaml", "--quiet", "--out", "out")
        self.program(*command, "--set", "duration=0.5")
        kept = (self.folder / "out/results.csv").read_bytes()
        whole = self.timed("run", "m.yaml", "--quiet", "--out", "whole", "--set", "duration=3")
        for k, moment in self.moments(whole):
            with self.subTest(seed=SEED, kill=k, moment=moment):
                killed = self.killed(moment, *command, "--set", "duration=3")
                places = [self.folder / "out" / p / "results.csv" for p in ("", "previous")]
                found = [p.read_bytes() for p in places if p.exists()]
                if killed and kept not in found:  # it was complete before the kill
                    self.assertEqual(self.summary("out")["status"], "completed")
                self.program(*command, "--set", "duration=0.5")
                self.assertEqual(places[0].read_bytes(), kept)
                self.assertFalse(places[1].exists())

    def test_sweep(self):
        setting = ("sweep", "m.yaml", "--vary", "mass=1:2:6", "--set", "duration=1.5", "--keep-results", "--threads", "2",
                   "--quiet")
        whole = self.timed(*setting, "--out", "whole")
        table = (self.folder / "whole/sweep.csv").read_bytes()
        for k, moment in self.moments(whole):
            with self.subTest(seed=SEED, kill=k, moment=moment):
                shutil.rmtree(self.folder / "out", ignore_errors=True)
                if self.killed(moment, *setting, "--out", "out") and (self.folder / "out").exists():
                    for run in (self.folder / "out").glob("runs/*/*"):
                        if run.name == "results.csv":
                            self.assertEqual(run.read_bytes(),
                                             (self.folder / "whole" / run.relative_to(self.folder / "out")).read_bytes())
                        elif run.name == "summary.json":
                            self.assertEqual(json.loads(run.read_text())["status"], "completed")
                self.program(*setting, "--out", "out")
                self.assertEqual((self.folder / "out/sweep.csv").read_bytes(), table)
                for run in (self.folder / "whole").glob("runs/*/results.csv"):
                    self.assertEqual((self.folder / "out" / run.relative_to(self.folder / "whole")).read_bytes(),
                                     run.read_bytes())

    def test_reduce(self):
        whole = self.timed(*REDUCE, "-o", "whole.ffb")
        expected = self.members("whole.ffb")
        self.assertGreater(len(expected), 5)
        for k, moment in self.moments(whole):
            with self.subTest(seed=SEED, kill=k, moment=moment):
                (self.folder / "out.ffb").unlink(missing_ok=True)
                self.killed(moment, *REDUCE, "-o", "out.ffb")
                json.loads((self.folder / "report.json").read_text())
                if (self.folder / "out.ffb").exists():
                    self.assertEqual(self.members("out.ffb"), expected)
        self.program(*REDUCE, "-o", "out.ffb")
        self.assertEqual(self.members("out.ffb"), expected)


if __name__ == "__main__":
    unittest.main()
