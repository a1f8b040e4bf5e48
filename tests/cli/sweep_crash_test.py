#!/usr/bin/env python3
"""`floatframe sweep` from outside: runs that end their process, that take too long or too much memory."""
import os
import pathlib
import signal
import subprocess
import time
import unittest

from sweep_case import BINARY, CRANK, LONG, Sweep


# A run that takes memory until its end, which is far away: a row of results each step.
HOARDER = """
floatframe: 1
bodies:
  rod: {rigid: {mass: 2, centre_of_mass: [0.5, 0, 0], inertia: [0.01, 0.2, 0.2]}}
joints:
  hinge: {type: revolute, child: rod, at: [0, 0, 0], axis: y}
outputs:
""" + "".join(f"  tip{k}: {{position: {{body: rod, at: [1, 0, {k}]}}, axis: z}}\n" for k in range(400)) + """
simulation: {step: 0.0001, duration: 0.01}
"""


class Crashing(Sweep):
    """Runs that end their process, or have to be ended."""

    def workers(self, process):
        """Workers of a study: children of the processes that watch over them."""
        def children(pid):
            try:
                return pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
            except OSError:
                return []
        return [int(worker) for guard in children(process.pid) for worker in children(guard)]

    def run_in_work(self, process, pause=0.5):
        """The worker of a study of one run at a time, some time after that has begun."""
        end = time.monotonic() + 60
        while time.monotonic() < end:
            if self.journal("out") and self.workers(process):
                time.sleep(pause)
                return self.workers(process)[0]
            time.sleep(0.01)
        self.fail("the study does not begin")

    def test_a_run_that_takes_too_long_is_a_row(self):
        # The second run would take hours.
        plan = (CRANK, "--vary", "duration=0.01,1000,0.02", "--threads", 2, "--out", "out", "--keep-results")
        done = self.sweep(1, *plan, "--case-timeout", "3")
        reason = "stopped after 3 s (--case-timeout)"
        self.assertEqual(done.stderr, f"floatframe: 1 of 3 runs failed, the first is run 2: {reason}\n")
        rows = self.rows("out")
        self.assertEqual([row["status"] for row in rows], ["completed", "failed", "completed"])
        self.assertEqual(rows[1]["message"], reason)
        self.assertEqual(rows[1]["steps"], "")
        self.assertIn(reason, (self.folder / "out/runs/2/summary.json").read_text())
        self.assertFalse((self.folder / "out/runs/2/results.csv").exists())
        table, journal = self.table("out"), self.journal("out")
        self.assertEqual(len(journal), 4)
        # It is finished, whatever the limit; unless one asks for it.
        done = self.sweep(1, *plan)
        self.assertIn("all 3 runs were finished before", done.stdout)
        self.assertEqual((self.table("out"), self.journal("out")), (table, journal))
        done = self.sweep(1, *plan, "--case-timeout", "2.5", "--retry-failed")
        self.assertIn("1 run in", done.stdout)
        self.assertIn("2 were finished before", done.stdout)
        self.assertEqual(self.rows("out")[1]["message"], "stopped after 2.5 s (--case-timeout)")
        self.assertEqual(self.journal("out")[:4], journal)

    def test_a_run_that_needs_too_much_memory_is_a_row(self):
        (self.folder / "model.yaml").write_text(HOARDER)
        plan = ("model.yaml", "--vary", "duration=0.01,100,0.02", "--threads", 2)
        done = self.sweep(1, *plan, "--out", "out", "--case-memory", "300", "--case-timeout", "200")
        reason = "needed more than 300 MB (--case-memory)"
        self.assertEqual(done.stderr, f"floatframe: 1 of 3 runs failed, the first is run 2: {reason}\n")
        self.assertEqual([row["message"] for row in self.rows("out")], ["", reason, ""])

    def test_reading_and_building_a_model_are_part_of_the_run(self):
        (self.folder / "model.yaml").write_text(HOARDER.replace("bodies:", """
parameters: {large: false}
bodies:
  arm:
    when: ${large}
    part: {file: deck.inp, units: m-kg-s, interfaces: {A: {set: A}}}"""))
        with open(self.folder / "deck.inp", "w", encoding="utf-8") as deck:
            deck.write("*NODE\n1, 0., 0., 0.\n")
            deck.writelines(["** " + "x" * 99996 + "\n"] * 2500)  # 250 MB
        reason = "needed more than 200 MB (--case-memory) while its model was read"
        for values, messages in (("false,true,false", ["", reason, ""]), ("true,false", [reason, ""])):
            self.sweep(1, "model.yaml", "--vary", f"large={values}", "--case-memory", "200", "--out", "out", "--fresh",
                       "--threads", "2")
            self.assertEqual([row["message"] for row in self.rows("out")], messages)

    def test_a_run_whose_process_is_killed_once_is_tried_again(self):
        plan = (CRANK, "--vary", "rate=40,60", "--duration", "3", "--threads", "1")
        process = self.start(*plan, "--out", "out")
        os.kill(self.run_in_work(process, 0.02), signal.SIGSEGV)
        _, errors = process.communicate(timeout=200)
        self.assertEqual((process.returncode, errors), (0, ""))
        self.sweep(0, *plan, "--out", "undisturbed")
        self.assertEqual(self.table("out"), self.table("undisturbed"))

    def test_a_run_that_crashes_again_in_a_new_process_is_a_row(self):
        process = self.start(CRANK, "--vary", "duration=1000,0.01", "--threads", "1", "--out", "out")
        first = self.run_in_work(process)
        os.kill(first, signal.SIGSEGV)
        while self.workers(process) in ([], [first]):
            self.assertIsNone(process.poll())
            time.sleep(0.01)
        os.kill(self.workers(process)[0], signal.SIGSEGV)
        _, errors = process.communicate(timeout=200)
        self.assertEqual(process.returncode, 1)
        reason = "crashed with signal SEGV (segmentation fault)"
        self.assertEqual(errors, f"floatframe: 1 of 2 runs failed, the first is run 1: {reason}\n")
        self.assertEqual([row["message"] for row in self.rows("out")], [reason, ""])
        # The study that crashed continues, and does not crash again.
        done = self.sweep(1, CRANK, "--vary", "duration=1000,0.01", "--threads", "1", "--out", "out")
        self.assertIn("all 2 runs were finished before", done.stdout)

    def guards_and_workers(self, process):
        guards = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
        return [*map(int, guards), *self.workers(process)]

    def wait_until_gone(self, pids):
        def alive(pid):
            try:
                return pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] not in "ZX"
            except OSError:
                return False
        end = time.monotonic() + 60
        while any(map(alive, pids)):
            self.assertLess(time.monotonic(), end)
            time.sleep(0.01)

    def test_no_worker_outlives_a_killed_study(self):
        process = self.start(CRANK, "--vary", "duration=1000,2000", "--threads", "2", "--out", "out")
        self.run_in_work(process)
        everyone = self.guards_and_workers(process)
        self.assertEqual(len(everyone), 4)
        process.kill()
        process.communicate(timeout=60)
        self.wait_until_gone(everyone)

    def test_a_killed_guard_ends_the_study_with_all_processes_and_it_continues(self):
        process = self.start(CRANK, *LONG, "--threads", "2", "--out", "out")
        self.wait_for_runs(process, "out", 2)
        everyone = self.guards_and_workers(process)
        os.kill(everyone[0], signal.SIGTERM)  # is for the program to decide about
        os.kill(everyone[0], signal.SIGKILL)
        _, errors = process.communicate(timeout=60)
        self.assertEqual(errors, "floatframe: the watching process of a worker was killed\n")
        self.assertEqual(process.returncode, 1)
        self.wait_until_gone(everyone)
        done = self.sweep(0, CRANK, *LONG, "--threads", "2", "--out", "out")
        self.assertRegex(done.stdout, r"\d+ were finished before")

    def test_too_few_file_numbers_for_the_workers_are_said(self):
        done = subprocess.run(["sh", "-c", 'ulimit -n 12; exec "$@"', "sh", BINARY, "sweep", CRANK, *LONG, "--threads",
                               "40", "--out", "out"], cwd=self.folder, timeout=60, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr, "floatframe: a worker process cannot be started: Too many open files\n")
        self.assertFalse((self.folder / "out").exists())

    def test_signal_to_all_processes_of_the_group_is_an_interrupt(self):
        process = subprocess.Popen([BINARY, "sweep", CRANK, "--vary", "duration=1000,2000", "--threads", "2", "--out",
                                    "out"], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   start_new_session=True)
        self.run_in_work(process)
        os.killpg(process.pid, signal.SIGTERM)
        _, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, -signal.SIGTERM)
        self.assertEqual(errors, "floatframe: interrupted: 0 of 2 runs finished; the same command continues\n")
        self.assertEqual(len(self.journal("out")), 1)

    def test_lost_runs_of_other_processes_are_rows_too(self):
        plan = (CRANK, "--vary", "duration=0.01,1000,2000,0.02", "--case-timeout", "3")
        self.sweep(1, *plan, "--threads", "2", "--out", "one")
        self.sweep(1, *plan, "--threads", "1", "--out", "ranks", **self.launcher(2))
        self.assertEqual(self.table("one"), self.table("ranks"))
        self.assertEqual([row["status"] for row in self.rows("one")], ["completed", "failed", "failed", "completed"])


if __name__ == "__main__":
    unittest.main()
