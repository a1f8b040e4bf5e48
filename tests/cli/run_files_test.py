#!/usr/bin/env python3
"""The files of `floatframe run` while it runs, when it is interrupted, and where they cannot be written."""
import os
import re
import resource
import signal
import unittest

from run_case import MODEL, RunCase
from report_page import text_of


def fingerprint(data):
    """128-bit FNV-1a of the length and the bytes."""
    value = 0x6c62272e07bb014262b821756295c58d
    for byte in len(data).to_bytes(8, "little") + data:
        value = (value ^ byte) * ((1 << 88) + 0x13b) % (1 << 128)
    return f"{value:032x}".encode()


class Growing(RunCase):
    def test_rows_come_while_the_run_goes_on(self):
        process = self.begin("run", "m.yaml", "--out", "out")
        self.wait_for(self.has_rows("out", 100), process)
        summary = self.summary("out")
        self.assertEqual(summary["status"], "running")
        self.assertNotIn("duration_s", summary)
        self.assertFalse((self.folder / "out/report.html").exists())
        before = self.rows("out")
        self.wait_for(self.has_rows("out", before + 100), process)
        code, _, err = self.end(process, signal.SIGKILL)
        self.assertEqual((code, err), (-signal.SIGKILL, ""))
        self.assertGreater(self.rows("out"), before)
        self.assertEqual(self.summary("out")["status"], "running")
        # The folder is free again, and what is there afterwards is of the new run alone.
        self.program("run", "m.yaml", "--out", "out", "--set", "duration=0.2", "--quiet")
        self.program("run", "m.yaml", "--out", "other", "--set", "duration=0.2", "--quiet")
        self.same_files("out", "other")
        self.assertEqual(sorted(p.name for p in (self.folder / "out").iterdir()),
                         ["report.html", "results.csv", "states.ffr", "summary.json"])

    def test_signals_end_a_run_with_its_files(self):
        for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
            (self.folder / "out").mkdir(exist_ok=True)
            (self.folder / "out/results.csv").unlink(missing_ok=True)
            process = self.begin("run", "m.yaml", "--out", "out")
            self.wait_for(self.has_rows("out"), process)
            returned, out, err = self.end(process, number)
            self.assertEqual(returned, code, err)
            self.assertIn("then it was interrupted", out)
            self.assertRegex(err, r"interrupted at t = [\d.]+ s of 1000 s\n.*kept in out and marked as partial\n$")
            summary = self.summary("out")
            self.assertEqual(summary["status"], "interrupted")
            self.assertEqual(summary["steps"] + 1, self.rows("out"))
            self.assertTrue((self.folder / "out/results.csv").read_bytes().endswith(b"\n"))
            self.assertAlmostEqual(summary["duration_s"], 1e-3 * summary["steps"], 9)
            page = text_of(self.folder / "out/report.html")
            self.assertIn("This run was interrupted: the results are partial.", page)
            self.assertEqual(sorted(p.name for p in (self.folder / "out").iterdir()),
                             ["report.html", "results.csv", "states.ffr", "summary.json"])

    def test_one_run_at_a_time_in_a_folder(self):
        process = self.begin("run", "m.yaml", "--out", "out")
        self.wait_for(self.has_rows("out"), process)
        done = self.program("run", "m.yaml", "--out", "./out", "--set", "duration=0.1", code=2)
        self.assertEqual(done.stderr, f"floatframe: the folder './out' is in use: a run of process {process.pid} "
                                      "writes there; give another --out, or wait for its end\n")
        self.program("run", "m.yaml", "--out", "else", "--set", "duration=0.1", "--quiet")
        rows = self.rows("out")
        self.wait_for(self.has_rows("out", rows + 1), process)  # the first one does not notice
        self.assertEqual(self.end(process, signal.SIGINT)[0], 130)
        self.program("run", "m.yaml", "--out", "out", "--set", "duration=0.1", "--quiet")

    def test_a_run_does_not_write_into_a_run_of_a_study(self):
        self.program("sweep", "m.yaml", "--vary", "mass=1,2", "--set", "duration=0.05", "--keep-results", "--out",
                     "study", "--quiet")
        kept = (self.folder / "study/runs/2/results.csv").read_bytes()
        self.program("run", "m.yaml", "--set", "mass=2", "--set", "duration=0.05", "--out", "single", "--quiet")
        self.assertEqual(kept, (self.folder / "single/results.csv").read_bytes())
        (self.folder / "study/runs/2/results.csv").unlink()
        process = self.begin("run", "m.yaml", "--out", "study/runs/2")
        self.wait_for(self.has_rows("study/runs/2"), process)
        done = self.program("sweep", "m.yaml", "--vary", "mass=1,2", "--set", "duration=0.05", "--keep-results", "--out",
                            "study", "--quiet", "--fresh", code=2)
        self.assertIn("is in use", done.stderr)
        self.assertEqual(self.end(process, signal.SIGTERM)[0], 143)
        self.assertEqual(self.summary("study/runs/2")["status"], "interrupted")


class Unwritable(RunCase):
    def limited(self, size, *arguments, code):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
        return self.program("run", "m.yaml", "--out", "out", "--record", "none", *arguments, code=code,
                            preexec_fn=limit)

    def test_a_file_that_cannot_grow_keeps_its_rows(self):
        done = self.limited(200_000, "--no-report", code=1)
        found = re.search(r"the run failed: at t = ([\d.]+) s the file 'out/results.csv' cannot be written: File too "
                          r"large\nfloatframe: the results up to ([\d.]+) s are kept in out and marked as partial\n",
                          done.stderr)
        self.assertTrue(found, done.stderr)
        data = (self.folder / "out/results.csv").read_bytes()
        self.assertLessEqual(len(data), 200_000)
        self.assertGreater(len(data), 199_000)
        self.assertTrue(data.endswith(b"\n"))
        last = float(data.splitlines()[-1].split(b",")[0])
        self.assertAlmostEqual(last, float(found.group(2)), 6)
        self.assertLessEqual(last, float(found.group(1)))
        summary = self.summary("out")
        self.assertEqual(summary["status"], "failed")
        self.assertIn("out/results.csv", summary["message"])

    def test_after_a_full_disk_a_run_goes_on(self):
        setting = ("--set", "duration=4")
        done = self.limited(300_000, *setting, "--checkpoint-every", "0.5", code=1)
        self.assertIn("the same command with --resume continues the run", done.stderr)
        self.program("run", "m.yaml", "--out", "out", "--record", "none", *setting, "--resume", "--quiet")
        self.program("run", "m.yaml", "--out", "whole", "--record", "none", *setting, "--quiet")
        self.same_files("out", "whole")

    def test_devices_take_results_at_the_end(self):
        (self.folder / "out").mkdir()
        os.symlink("/dev/full", self.folder / "out/results.csv")
        done = self.program("run", "m.yaml", "--out", "out", "--set", "duration=0.1", code=1)
        self.assertIn("the file 'out/results.csv' cannot be written: No space left on device", done.stderr)
        self.program("run", "m.yaml", "--out", "out", "--checkpoint-every", "1", code=2)


class Resumed(RunCase):
    def test_an_interrupted_run_is_continued_to_equal_files(self):
        for options in ((), ("--coordinates", "absolute", "--inertia", "projection")):
            options = ("--set", "duration=20", *options)
            self.program("run", "m.yaml", "--out", "whole", *options, "--quiet")
            process = self.begin("run", "m.yaml", "--out", "out", *options, "--checkpoint-every", "0.25")
            checkpoint = self.folder / "out/run.checkpoint"
            self.wait_for(checkpoint.exists, process)
            code, _, err = self.end(process, signal.SIGTERM)
            if code == 143:
                self.assertIn("the same command with --resume continues the run", err)
                self.program("run", "m.yaml", "--out", "out", *options, "--resume", "--quiet")
            self.same_files("out", "whole")
            self.assertFalse(checkpoint.exists())

    def test_what_cannot_be_continued_is_refused(self):
        setting = ("--set", "duration=30")
        process = self.begin("run", "m.yaml", "--out", "out", *setting, "--checkpoint-every", "0.1")
        self.wait_for((self.folder / "out/run.checkpoint").exists, process)
        self.end(process, signal.SIGKILL)

        def files():  # a file that was being written when the run was killed may go
            return {p.name: p.read_bytes() for p in (self.folder / "out").iterdir() if ".part-" not in p.name}

        def refused(*arguments, message, settings=setting):
            before = files()
            done = self.program("run", "m.yaml", "--out", "out", "--resume", *settings, *arguments, code=2)
            self.assertIn(message, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            after = files()
            before.pop("run.lock", None)
            self.assertEqual(before, after)

        made = "the checkpoint 'out/run.checkpoint' was made "
        refused("--step", "0.002", message="another value of step: found 0.001, this run has 0.002")
        refused("--duration", "31", message="another value of duration: found 30, this run has 31")
        refused("--coordinates", "absolute", message="of coordinates: found")
        refused("--inertia", "projection", message="of inertia: found")
        refused("--write-state", "end.json", message="(--write-state)")
        refused(message=made + "with other parameters: found '--set duration=30', this run has '--set duration=29'",
                settings=("--set", "duration=29"))
        path = self.folder / "m.yaml"
        path.write_text(MODEL.replace("spring: 3", "spring: 4"))
        refused(message=made + "before 'm.yaml' was changed")
        path.write_text(MODEL)
        results = self.folder / "out/results.csv"
        good = results.read_bytes()
        results.write_bytes(good.replace(b"0.001,", b"0.002,", 1))
        refused(message="'out/results.csv' cannot be continued: its content is not what was written")
        results.write_bytes(good[:1000])
        refused(message="'out/results.csv' cannot be continued: found 1000 bytes")
        results.write_bytes(good)
        kept = self.folder / "out/run.checkpoint"
        data = kept.read_bytes()
        # The copy of the program stands first, with its version: another one, with a checksum that fits.
        at = data.index(b"0.1.0")
        other = data[:at] + b"0.0.9" + data[at + 5:-32]
        kept.write_bytes(other + fingerprint(other))
        refused(message=made + "by another copy of the program (found 0.0.9")
        kept.write_bytes(data[:-1])
        refused(message="the checkpoint 'out/run.checkpoint' is damaged")
        kept.write_bytes(b"something else")
        refused(message="is not the checkpoint of a run")
        kept.unlink()
        refused(message="--resume: 'out/run.checkpoint': ")
        self.program("run", "m.yaml", "--out", "out", "--checkpoint-every", "-1", code=2)

    def test_a_complete_run_is_not_continued(self):
        run = ("run", "m.yaml", "--out", "out", "--set", "duration=0.3")
        self.program(*run, "--checkpoint-every", "0.1", "--quiet")

        def files():
            return {p.name: (p.read_bytes(), p.stat().st_mtime_ns) for p in (self.folder / "out").iterdir()}

        complete = "the run in 'out' is complete, there is nothing to continue"
        before = files()
        done = self.program(*run, "--resume", "--quiet")
        self.assertEqual((done.stdout, done.stderr), ("", f"floatframe: {complete}\n"))
        # Killed after its summary and before its checkpoint went.
        (self.folder / "out/run.checkpoint").write_bytes(b"ffcheck\nof this run")
        self.assertIn(complete, self.program(*run, "--resume").stderr)
        self.assertIn(f"--write-state: {complete}; its state at the end is not known",
                      self.program(*run, "--resume", "--write-state", "end.json", code=2).stderr)
        other = "--resume: the run in 'out' is complete, and of another model or with other options"
        path = self.folder / "m.yaml"
        for options in (("--step", "0.002"), ("--set", "duration=0.4"), ("--duration", "0.4"), ("--coordinates", "absolute")):
            self.assertIn(other, self.program(*run, *options, "--resume", code=2).stderr)
        path.write_text(MODEL.replace("spring: 3", "spring: 4"))
        self.assertIn(other, self.program(*run, "--resume", code=2).stderr)
        path.write_text(MODEL)
        self.assertEqual(files(), before)
        summary = self.folder / "out/summary.json"
        for damage in ("", "{", "[]", '{"status": 1}'):
            summary.write_text(damage)
            self.assertIn("expected a checkpoint", self.program(*run, "--resume", code=2).stderr)

    def test_a_new_run_begins_without_the_checkpoint_of_another(self):
        process = self.begin("run", "m.yaml", "--out", "out", "--checkpoint-every", "0.1")
        self.wait_for((self.folder / "out/run.checkpoint").exists, process)
        self.end(process, signal.SIGKILL)
        self.program("run", "m.yaml", "--out", "out", "--set", "duration=0.1", "--quiet", "--overwrite")
        self.assertFalse((self.folder / "out/run.checkpoint").exists())


if __name__ == "__main__":
    unittest.main()
