#!/usr/bin/env python3
"""`floatframe sweep` from outside: threads, processes under mpirun, interrupts, messages, files."""
import csv
import json
import os
import pathlib
import signal
import subprocess
import time
import unittest

from sweep_case import BINARY, CRANK, GRID, LONG, Sweep


class Spreading(Sweep):
    def test_same_bytes_on_one_thread_two_threads_and_two_processes(self):
        self.sweep(0, CRANK, *GRID, "--threads", 1, "--out", "one")
        self.sweep(0, CRANK, *GRID, "--threads", 2, "--out", "two")
        self.assertEqual(self.table("one"), self.table("two"))
        rows = self.rows("one")
        self.assertEqual(len(rows), 12)
        self.assertEqual([row["run"] for row in rows], [str(k + 1) for k in range(12)])
        self.assertEqual([row["ne_rod"] for row in rows[:4]], ["8", "8", "4", "4"])
        self.assertEqual({row["status"] for row in rows}, {"completed"})
        # The values reach the runs: another speed, another mesh, another inertia method.
        final = [row["rod_middle.y final [m]"] for row in rows]
        self.assertEqual(len(set(final)), 12)
        for title in rows[0]:
            for word in ("cpu", "real time", "seconds"):
                self.assertNotIn(word, title)
        done = self.sweep(0, CRANK, *GRID, "--threads", 1, "--out", "ranks", **self.launcher(2))
        self.assertEqual(self.table("one"), self.table("ranks"))
        self.assertIn("12 runs in", done.stdout)
        self.assertIn("1 at a time in each of 2 processes", done.stdout)
        self.assertEqual(done.stdout.count("12 runs in"), 1)

    def test_rows_are_those_of_single_runs(self):
        self.sweep(0, CRANK, *GRID, "--out", "study", "--keep-results")
        subprocess.run([BINARY, "run", CRANK, "--set", "rate=50", "--set", "ne_rod=4", "--inertia", "projection",
                        "--duration", "0.02", "--out", "single", "--quiet"], cwd=self.folder, check=True)
        row = self.rows("study")[7]
        self.assertEqual((row["rate"], row["ne_rod"], row["inertia"]), ("50", "4", "projection"))
        kept = (self.folder / "study/runs/08/results.csv").read_bytes()
        self.assertEqual(kept, (self.folder / "single/results.csv").read_bytes())
        summary, single = (json.loads((self.folder / f"{name}/summary.json").read_text())
                           for name in ("study/runs/08", "single"))
        self.assertEqual(summary["settings"], {"simulation.duration": "0.02", "rate": "50", "ne_rod": "4",
                                               "inertia": "projection"})
        self.assertEqual(list(single["files"]), [str(CRANK)])
        self.assertEqual(summary["files"], single["files"])
        with open(self.folder / "single/results.csv", newline="", encoding="utf-8") as file:
            slider = [float(r["slider.x [m]"]) for r in csv.DictReader(file)]
        self.assertEqual(float(row["slider.x final [m]"]), slider[-1])
        self.assertEqual(float(row["slider.x min [m]"]), min(slider))
        self.assertEqual(float(row["slider.x max [m]"]), max(slider))

    def test_a_process_that_dies_ends_the_study_and_it_continues(self):
        for attempt in range(5):  # where the processors are shared all runs can be done before the blow falls
            out = f"out{attempt}"
            process, errors = self.killed_under_mpirun(out)
            if len(self.journal(out)) - 1 < 40:
                break
        self.assertNotEqual(process.returncode, 0)
        self.assertTrue(errors)
        self.assertLess(len(self.journal(out)) - 1, 40)
        done = self.sweep(0, CRANK, *LONG, "--threads", 2, "--out", out)
        self.assertRegex(done.stdout, r"\d+ were finished before")
        self.sweep(0, CRANK, *LONG, "--threads", 2, "--out", "whole", "--quiet")
        self.assertEqual(self.table(out), self.table("whole"))

    def killed_under_mpirun(self, out):
        options = self.launcher(2)
        process = subprocess.Popen([*options["launcher"], BINARY, "sweep", CRANK, *LONG, "--threads", "1", "--out",
                                    out], cwd=self.folder, env=options["environment"], text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.wait_for_runs(process, out, 4)
        children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
        if children:
            os.kill(int(children[-1]), signal.SIGKILL)
        return process, process.communicate(timeout=60)[1]

    def test_bad_input_under_mpirun_is_said_once(self):
        done = self.sweep(2, CRANK, "--vary", "rat=1,2", **self.launcher(2))
        self.assertEqual(done.stderr.count("neither a parameter"), 1, done.stderr)

    def test_help_under_the_launchers_environment_needs_no_mpi(self):
        done = subprocess.run([BINARY, "sweep", "--help"], env=dict(os.environ, OMPI_COMM_WORLD_SIZE="2"),
                              capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual(done.returncode, 0)


# Clamped at one end, loaded at the other: the second and third run bend it out of the range of the method.
CANTILEVER = pathlib.Path(__file__).resolve().parents[1] / "data" / "range" / "cantilever.yaml"
LOADS = ("--vary", "load=3.5,100,385", "--duration", "0.1")


class Warnings(Sweep):
    def test_runs_out_of_range_are_said_at_the_end(self):
        done = self.sweep(0, CANTILEVER, *LOADS, "--quiet", "--keep-results", "--out", "out")
        self.assertEqual(done.stdout, "")
        said = done.stderr.splitlines()
        self.assertEqual(said[0], "floatframe: warning: 2 of 3 runs left the range of the method")
        summaries = [json.loads((self.folder / f"out/runs/{k}/summary.json").read_text()) for k in (1, 2, 3)]
        self.assertEqual([len(s["warnings"]) for s in summaries], [0, 2, 2])
        self.assertIn("deforms too far", summaries[1]["warnings"][0])
        self.assertEqual(said[1:], [f"floatframe: warning: run 2 (and 1 more): {w}" for w in summaries[1]["warnings"]])
        rows = self.rows("out")
        self.assertEqual([(r["status"], r["message"]) for r in rows], [("completed", "")] * 3)
        self.assertFalse(any("warning" in title for title in rows[0]))
        # What is said comes from the journal: also of runs that an earlier call has made. A run without has none there.
        for line in self.journal("out")[1:]:
            self.assertEqual('"warnings"' in line, '"run":1,' not in line)
        self.assertEqual(self.sweep(0, CANTILEVER, *LOADS, "--quiet", "--keep-results", "--out", "out").stderr, done.stderr)
        self.assertEqual(self.sweep(0, CANTILEVER, "--vary", "load=1,3.5", "--duration", "0.1", "--quiet", "--out", "few").stderr, "")

    def test_strict_makes_them_failed_rows(self):
        done = self.sweep(1, CANTILEVER, *LOADS, "--quiet", "--strict", "--keep-results", "--out", "out")
        summary = json.loads((self.folder / "out/runs/2/summary.json").read_text())
        self.assertEqual((summary["status"], summary["message"]),
                         ("failed", "2 warnings count as errors under --strict; the results are complete"))
        rows = self.rows("out")
        self.assertEqual([r["status"] for r in rows], ["completed", "failed", "failed"])
        self.assertEqual(rows[1]["message"], summary["warnings"][0] + " (and 1 more)")
        self.assertEqual(float(rows[1]["time reached [s]"]), summary["duration_s"])
        self.assertIn(f"floatframe: 2 of 3 runs failed, the first is run 2: {rows[1]['message']}\n", done.stderr)


class Continuing(Sweep):
    def test_killed_study_repeats_no_finished_run(self):
        process = self.start(CRANK, *LONG, "--threads", 2, "--out", "out", "--keep-results")
        self.wait_for_runs(process, "out", 5)
        process.kill()
        process.communicate(timeout=60)
        before = self.journal("out")
        self.assertLess(len(before), 41)
        self.assertFalse((self.folder / "out/sweep.csv").exists())
        kept = {p: p.stat().st_mtime_ns for p in (self.folder / "out/runs").glob("*/results.csv")}
        done = self.sweep(0, CRANK, *LONG, "--threads", 2, "--out", "out", "--keep-results")
        after = self.journal("out")
        # What was in the journal stays, and every run is in it once.
        whole = before if before[-1] == after[len(before) - 1] else before[:-1]
        self.assertEqual(after[:len(whole)], whole)
        self.assertEqual(sorted(int(line.split('"run":')[1].split(",")[0]) for line in after[1:]), list(range(1, 41)))
        self.assertIn(f"{41 - len(whole)} runs in", done.stdout)
        finished = {int(line.split('"run":')[1].split(",")[0]) for line in whole[1:]}
        for path, time_written in kept.items():
            if int(path.parent.name) in finished:
                self.assertEqual(path.stat().st_mtime_ns, time_written, "a finished run was repeated")
        self.sweep(0, CRANK, *LONG, "--threads", 1, "--out", "whole")
        self.assertEqual(self.table("out"), self.table("whole"))
        # Nothing to do any more.
        done = self.sweep(0, CRANK, *LONG, "--out", "out", "--keep-results")
        self.assertIn("all 40 runs were finished before", done.stdout)
        self.assertEqual(self.journal("out"), after)

    def test_interrupt_ends_at_once_and_says_how_to_go_on(self):
        process = self.start(CRANK, "--vary", "rate=40:60:40", "--duration", "20", "--threads", 2, "--out", "out")
        end = time.monotonic() + 60
        while not self.journal("out") and time.monotonic() < end:
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, -signal.SIGINT)
        self.assertRegex(errors, r"floatframe: interrupted: \d+ of 40 runs finished; the same command continues\n")
        self.assertFalse((self.folder / "out/sweep.csv").exists())

    def test_another_study_is_refused(self):
        self.sweep(0, CRANK, *GRID, "--out", "out")
        before = self.table("out")
        for arguments, reason in (
                ((CRANK, "--vary", "rate=40:60:3", "--duration", "0.02"), "the varied parameters or their values differ"),
                ((CRANK, *GRID[:-1], "0.03"), "the values that are the same for all runs differ"),
                ((CRANK, *GRID, "--measure", "slider.x"), "the outputs measured differ"),
                ((CRANK, *GRID, "--keep-results"), "one keeps the results of its runs, the other does not"),
                ((CRANK, *GRID, "--strict"), "warnings count as errors in one, in the other not")):
            done = self.sweep(2, *arguments, "--out", "out")
            self.assertEqual(done.stderr, f"floatframe: 'out/sweep.journal' holds another study ({reason}); "
                                          "give another --out to keep it, or --fresh to replace it\n")
            self.assertEqual(done.stdout, "")
        self.assertEqual(self.table("out"), before)
        self.sweep(0, CRANK, *GRID[:-1], "0.03", "--out", "out", "--fresh")
        self.assertNotEqual(self.table("out"), before)


class Input(Sweep):
    def test_table_file(self):
        (self.folder / "runs.csv").write_text("rate,inertia\n40,projection\n45.5,preprocessing\n")
        self.sweep(0, CRANK, "--table", "runs.csv", "--duration", "0.01", "--out", "out", "--measure", "slider.x:max",
                   "--quiet")
        rows = self.rows("out")
        self.assertEqual([(r["rate"], r["inertia"]) for r in rows], [("40", "projection"), ("45.5", "preprocessing")])
        self.assertIn("slider.x max [m]", rows[0])
        self.assertNotIn("slider.x min [m]", rows[0])
        (self.folder / "runs.csv").write_text("rate,inertia\n40,projection\n45.5,guess\n")
        done = self.sweep(2, CRANK, "--table", "runs.csv", "--out", "other")
        self.assertEqual(done.stderr,
                         "floatframe: runs.csv:3: inertia: found 'guess', expected preprocessing or projection\n")
        self.assertFalse((self.folder / "other").exists())

    def test_bad_options_exit_2_with_one_line(self):
        for arguments, message in (
                ((CRANK,), "expected --vary or --table: what changes from run to run"),
                ((CRANK, "--vary", "rate=1,2", "--table", "x.csv"), "--vary and --table exclude each other"),
                ((CRANK, "--vary", "rate"), "--vary rate: expected NAME=LO:HI:N"),
                ((CRANK, "--vary", "rate=1:2:0"), "found '0', expected"),
                ((CRANK, "--vary", "raet=1,2"), "nor a simulation option, did you mean 'rate'?"),
                ((CRANK, "--vary", "rate=1,2", "--threads", "0"), "--threads"),
                ((CRANK, "--vary", "rate=1,2", "--set", "l_rod"), "--set: found 'l_rod', expected NAME=VALUE"),
                ((CRANK, "--vary", "rate=1,2", "--step", "-1"), "--step: found '-1', expected a positive number [s]"),
                ((CRANK, "--vary", "rate=1,2", "--measure", "slider.x:mean"), "--measure: found 'slider.x:mean'"),
                ((CRANK, "--vary", "rate=1,2", "--case-timeout", "0"),
                 "--case-timeout: found '0', expected a positive number [s]"),
                ((CRANK, "--vary", "rate=1,2", "--case-memory", "2 GB"),
                 "--case-memory: found '2 GB', expected a positive number [MB]"),
                ((CRANK, "--vary", "rate=1:2:1000000", "--vary", "l_rod=1:2:1000000"),
                 "--vary: found 1e+12 combinations, expected at most 1000000"),
                (("nowhere.yaml", "--vary", "rate=1,2"), "nowhere.yaml: "),
                ((CRANK, "--table", "nowhere.csv"), "nowhere.csv: ")):
            with self.subTest(arguments=arguments):
                done = self.sweep(2, *arguments)
                self.assertIn(message, done.stderr)
                self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
                self.assertEqual(done.stdout, "")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_errors_of_runs_that_are_not_listed_are_counted(self):
        lines = self.sweep(2, CRANK, "--vary", "step=-1:-30:30").stderr.splitlines()
        self.assertEqual(lines[0], "floatframe: --vary: step: found '-1', expected a positive number [s]")
        self.assertEqual(lines[20:], ["floatframe: and 10 more errors of other runs", "30 errors in the input"])

    def test_hostile_table_files_are_refused(self):
        os.mkfifo(self.folder / "pipe.csv")
        with open(self.folder / "huge.csv", "wb") as file:
            file.truncate(1 << 40)  # a sparse file of a terabyte
        (self.folder / "zero.csv").write_bytes(b"rate\n40\0\n")
        (self.folder / "folder.csv").mkdir()
        for name in ("pipe.csv", "huge.csv", "zero.csv", "folder.csv", "/dev/zero"):
            with self.subTest(name=name):
                done = self.sweep(2, CRANK, "--table", name, "--out", "out")
                self.assertTrue(done.stderr.startswith(name), done.stderr)
                self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertFalse((self.folder / "out").exists())

    def test_one_folder_for_one_command_at_a_time(self):
        plan = (CRANK, "--vary", "duration=1000,2000", "--threads", "1", "--out", "out")
        process = self.start(*plan)
        end = time.monotonic() + 60
        while not self.journal("out") and time.monotonic() < end:
            time.sleep(0.01)
        for more in ((), ("--fresh",)):
            done = self.sweep(2, *plan, *more)
            self.assertEqual(done.stderr, "floatframe: 'out/sweep.journal' is in use: this study is running already\n")
        process.terminate()
        process.communicate(timeout=60)

    def test_failed_runs_exit_1_with_the_first_reason(self):
        # One Newton iteration per step, and no smaller steps.
        done = self.sweep(1, CRANK, "--vary", "max_iterations=1,20", "--set", "min_step=0.0001", "--duration", "0.005",
                          "--out", "out")
        self.assertRegex(done.stderr, r"^floatframe: 1 of 2 runs failed, the first is run 1: ")
        rows = self.rows("out")
        self.assertEqual([row["status"] for row in rows], ["failed", "completed"])
        self.assertTrue(rows[0]["message"])


if __name__ == "__main__":
    unittest.main()
