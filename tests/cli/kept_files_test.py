#!/usr/bin/env python3
"""Nothing is lost by a slip: unfinished and completed runs, files of other programs, links, what stands behind /dev/stdout."""
import json
import os
import resource
import signal
import subprocess
import unittest

from run_case import BINARY, MODEL, RunCase

SHORT = ("--set", "duration=0.05", "--quiet")
# A heavy point on nothing: there is no equilibrium to start from.
FALL = """\
floatframe: 1
name: fall
bodies: {b: {rigid: {mass: 1, inertia: [1, 1, 1], centre_of_mass: [0, 0, 0]}}}
joints: {j: {type: prismatic, child: b, at: [0, 0, 0], axis: z}}
outputs: {z: {joint_position: j}}
simulation: {step: 0.01, duration: 0.1, start: equilibrium}
"""
FOREIGN = "my,own,numbers\n1,2,3\n"


class KeptCase(RunCase):
    def files(self, folder="out"):
        return {str(p.relative_to(self.folder)): p.read_bytes() for p in (self.folder / folder).rglob("*")
                if p.is_file() and p.name != "run.lock"}

    def unfinished(self, *arguments):
        """A run that a signal has ended between two checkpoints."""
        process = self.begin("run", "m.yaml", "--out", "out", "--checkpoint-every", "0.1", *arguments)
        self.wait_for((self.folder / "out/run.checkpoint").exists, process)
        self.assertEqual(self.end(process, signal.SIGTERM)[0], 143)

    def refused(self, message, *arguments, folder="out"):
        before = self.files(folder)
        done = self.program(*arguments, code=2)
        self.assertIn(message, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertEqual(self.files(folder), before)


class Runs(KeptCase):
    def test_an_unfinished_run_is_not_discarded(self):
        self.unfinished()
        sentence = (r"the folder 'out' holds an unfinished run, which has reached [\d.]+ s: --resume continues it, "
                    r"--overwrite begins anew\n$")
        before = self.files()
        for arguments in ((), ("--checkpoint-every", "0.1"), ("--set", "duration=0.1"), ("--no-report",)):
            done = self.program("run", "m.yaml", "--out", "out", *arguments, code=2)
            self.assertRegex(done.stderr, sentence)
            self.assertEqual(self.files(), before)
        self.program("run", "m.yaml", "--out", "out", *SHORT, "--overwrite")
        self.assertFalse((self.folder / "out/run.checkpoint").exists())
        self.assertEqual(self.summary("out")["status"], "completed")

    def test_a_checkpoint_that_cannot_be_read_is_kept(self):
        self.unfinished()
        (self.folder / "out/run.checkpoint").write_bytes(b"ffcheck\nnonsense")
        self.refused("the folder 'out' holds an unfinished run: --resume", "run", "m.yaml", "--out", "out", *SHORT)

    def test_a_run_that_cannot_start_leaves_all_as_it_was(self):
        (self.folder / "fall.yaml").write_text(FALL)
        self.program("run", "m.yaml", "--out", "out", *SHORT)
        before = self.files()
        done = self.program("run", "fall.yaml", "--out", "out", code=1)
        self.assertIn("the completed run in out is left as it was", done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertEqual(self.files(), before)
        self.unfinished()
        before = self.files()
        done = self.program("run", "fall.yaml", "--out", "out", "--overwrite", code=1)
        self.assertIn("the unfinished run in out is left as it was", done.stderr)
        self.assertEqual(self.files(), before)
        # Without anything to keep there are files that say so.
        for _ in range(2):
            self.program("run", "fall.yaml", "--out", "new", code=1)
        self.assertEqual(self.summary("new")["status"], "failed")

    def test_a_completed_run_is_kept_until_the_new_one_is_complete(self):
        self.program("run", "m.yaml", "--out", "out", *SHORT)
        before = {name.replace("out/", "out/previous/"): data for name, data in self.files().items()}
        process = self.begin("run", "m.yaml", "--out", "out")
        self.wait_for(self.has_rows("out", 100), process)
        self.assertEqual(self.files("out/previous"), before)
        self.end(process, signal.SIGKILL)
        self.assertEqual(self.files("out/previous"), before)
        (self.folder / "out/results.csv").unlink()
        process = self.begin("run", "m.yaml", "--out", "out")  # again: what was killed is not complete
        self.wait_for(self.has_rows("out", 100), process)
        err = self.end(process, signal.SIGTERM)[2]
        self.assertIn("the completed run that was there before is kept in out/previous", err)
        self.assertEqual(self.files("out/previous"), before)
        (self.folder / "out/previous/mine.txt").write_text("mine")
        self.program("run", "m.yaml", "--out", "out", *SHORT)
        self.assertEqual(list(self.files("out/previous")), ["out/previous/mine.txt"])
        (self.folder / "out/previous/mine.txt").unlink()
        self.program("run", "m.yaml", "--out", "out", *SHORT)
        self.assertFalse((self.folder / "out/previous").exists())

    def test_signals_that_end_as_sigterm_does(self):
        for number in (signal.SIGHUP, signal.SIGXCPU):
            folder = f"out{number}"
            process = self.begin("run", "m.yaml", "--out", folder)
            self.wait_for(self.has_rows(folder, 100), process)
            code, _, err = self.end(process, number)
            self.assertEqual(code, 128 + number, err)
            self.assertEqual(self.summary(folder)["status"], "interrupted")
        # The system's own: repeated every second of processor time while the report is written.
        done = self.program("run", "m.yaml", "--out", "out", code=152,
                            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (1, 60)))
        self.assertIn("interrupted at t = ", done.stderr)
        self.assertTrue((self.folder / "out/report.html").exists())

    def test_a_hangup_that_is_ignored_stays_ignored(self):
        process = self.begin("run", "m.yaml", "--out", "out",
                             preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        self.wait_for(self.has_rows("out", 100), process)
        process.send_signal(signal.SIGHUP)
        rows = self.rows("out")
        self.wait_for(self.has_rows("out", rows + 100), process)
        self.assertEqual(self.end(process, signal.SIGTERM)[0], 143)

    def test_names_of_any_script_have_folders_of_their_own(self):
        for name in ("車両", "車輪", "мост", "τροχός", "a b"):
            (self.folder / "m.yaml").write_text(MODEL.replace("name: long", f"name: {name}"))
            self.program("run", "m.yaml", *SHORT)
        self.assertEqual({p.name for p in (self.folder / "out").iterdir()}, {"車両", "車輪", "мост", "τροχός", "a_b"})


class Foreign(KeptCase):
    def test_files_in_the_folder_of_a_run(self):
        (self.folder / "out").mkdir()
        for name in ("results.csv", "states.ffr", "report.html", "summary.json", "run.checkpoint"):
            for content in (FOREIGN, "time [s],x [m]\n0,1\n", "{\"status\": \"completed\"}", MODEL):
                (self.folder / "out" / name).write_text(content)
                self.refused(f"the file 'out/{name}' was not written by this program; give another --out, or --overwrite",
                             "run", "m.yaml", "--out", "out", *SHORT)
            (self.folder / "out" / name).unlink()
        for name in ("notes.txt", "results.csv.part-mine", "report.html.part-1", "data.part-1-2"):
            (self.folder / "out" / name).write_text("mine")
        (self.folder / "out/results.csv.part-12-3").write_text("of a run that was killed")
        self.program("run", "m.yaml", "--out", "out", *SHORT)
        self.assertEqual(sorted(self.files()),
                         sorted("out/" + n for n in ("notes.txt", "results.csv.part-mine", "report.html.part-1", "data.part-1-2",
                                                     "results.csv", "states.ffr", "report.html", "summary.json")))
        (self.folder / "out/report.html").write_text("<html>mine</html>")
        self.program("run", "m.yaml", "--out", "out", *SHORT, "--overwrite")
        self.assertIn("Floatframe", (self.folder / "out/report.html").read_text()[:1024])

    def test_files_that_options_name(self):
        self.program("run", "m.yaml", "--out", "out", *SHORT)
        commands = [(("run", "m.yaml", "--out", "new", *SHORT), "--write-state"),
                    (("statics", "m.yaml", "--set", "duration=1"), "--write-state"),
                    (("modes", "m.yaml"), "--report"), (("linearize", "m.yaml"), "--csv"), (("linearize", "m.yaml"), "--npz"),
                    (("linearize", "m.yaml"), "--mat"), (("check", "m.yaml"), "--report"),
                    (("realtime", "m.yaml", "--no-pace", "--duration", "0.01", "--quiet"), "--log"),
                    (("realtime", "m.yaml", "--no-pace", "--duration", "0.01", "--quiet"), "--report"),
                    (("export", "out"), "--csv"), (("export", "out"), "--npz"), (("export", "out"), "--glb"),
                    (("compare", "out", "out"), "--report"),
                    (("bench", "step", "m.yaml", "--duration", "0.01"), "--json")]
        for command, option in commands:
            with self.subTest(command=command, option=option):
                for content in (FOREIGN, MODEL, '{"a": 1}', "PK\x03\x04 no archive"):
                    (self.folder / "file").write_text(content)
                    self.refused(f"{option}: the file 'file' was not written by this program; expected another name, or "
                                 "--overwrite", *command, option, "file", folder=".")
                # With the option, then again without it: by now it is one of this program.
                for more in (("--overwrite",), ()):
                    code = 1 if command[0] == "statics" else 0
                    done = self.program(*command, option, "file", *more, code=None)
                    self.assertIn(done.returncode, (0, code), done.stderr)
                (self.folder / "file").unlink()
                (self.folder / "file").touch()  # nothing is lost of an empty file
                self.assertNotEqual(self.program(*command, option, "file", code=None).returncode, 2)

    def test_folders_of_other_commands(self):
        self.program("run", "m.yaml", "--out", "out", *SHORT)
        for command, name in ((("export", "out", "--vtk", "new"), "motion.pvd"),
                              (("export", "out", "--vtk", "new"), "motion_000001.vtu"),
                              (("stress", "out", "--out", "new"), "hot_spots.csv"),
                              (("rainflow", "out", "--out", "new"), "equivalent.csv"),
                              (("rainflow", "out", "--out", "new"), "spin.history.csv"),
                              (("sweep", "m.yaml", "--vary", "mass=1,2", *SHORT, "--out", "new"), "sweep.csv"),
                              (("sweep", "m.yaml", "--vary", "mass=1,2", *SHORT, "--fresh", "--out", "new"), "sweep.journal")):
            with self.subTest(command=command, name=name):
                (self.folder / "new").mkdir(exist_ok=True)
                (self.folder / "new" / name).write_text(FOREIGN)
                self.refused(f"the file 'new/{name}' was not written by this program", *command, folder="new")
                self.program(*command, "--overwrite")
                self.program(*command)
                for file in (self.folder / "new").iterdir():
                    file.unlink()

    def test_a_run_of_a_study_that_was_killed_before_its_summary_is_its_own(self):
        study = ("sweep", "m.yaml", "--vary", "mass=1,2", *SHORT, "--keep-results", "--out", "study")
        self.program(*study)
        for name in ("summary.json", "states.ffr"):
            (self.folder / "study/runs/1" / name).unlink(missing_ok=True)
        self.program(*study)
        (self.folder / "study/sweep.journal").unlink()
        self.refused("the file 'study/runs/1/results.csv' was not written by this program", *study, folder="study")

    def test_the_table_of_a_study_stays_until_there_is_a_new_one(self):
        self.program("sweep", "m.yaml", "--vary", "mass=1,2", *SHORT, "--out", "study")
        table = (self.folder / "study/sweep.csv").read_bytes()
        process = self.begin("sweep", "m.yaml", "--vary", "mass=1:2:50", "--set", "duration=5", "--out", "study", "--fresh")
        self.wait_for(lambda: (self.folder / "study/sweep.journal").read_bytes().count(b"\n") > 3, process)
        self.end(process, signal.SIGTERM)
        self.assertEqual((self.folder / "study/sweep.csv").read_bytes(), table)


class Places(KeptCase):
    """The links and the pipes are those of the test's own folder: what a fault would replace is there too."""

    def state(self, target, code=0, **more):
        return self.program("run", "m.yaml", "--out", "out", *SHORT, "--write-state", target, code=code, **more)

    def test_links_are_followed_and_stay(self):
        (self.folder / "far").mkdir()
        (self.folder / "near").symlink_to("far/state.json")  # nothing there yet
        (self.folder / "nearer").symlink_to("near")
        for _ in range(2):
            self.state("nearer")
            self.assertEqual(json.loads((self.folder / "far/state.json").read_text())["floatframe_state"], 1)
            self.assertEqual((os.readlink(self.folder / "nearer"), os.readlink(self.folder / "near")), ("near", "far/state.json"))
        self.assertEqual([p.name for p in (self.folder / "far").iterdir()], ["state.json"])
        (self.folder / "round").symlink_to("round")
        self.assertIn("Too many levels of symbolic links", self.state("round", code=2).stderr)

    def test_the_files_of_a_run_behind_links(self):
        names = ("results.csv", "states.ffr", "report.html", "summary.json", "run.checkpoint")
        for folder in ("out", "disk"):
            (self.folder / folder).mkdir()
        for name in names:
            (self.folder / "out" / name).symlink_to("../disk/" + name)
        self.unfinished("--set", "duration=3")
        self.assertEqual({p.name for p in (self.folder / "disk").iterdir()}, set(names))
        self.program("run", "m.yaml", "--out", "out", "--set", "duration=3", "--quiet", "--resume")
        self.program("run", "m.yaml", "--out", "whole", "--set", "duration=3", "--quiet")
        self.same_files("out", "whole")
        self.program("run", "m.yaml", "--out", "out", "--set", "duration=3", "--quiet")
        self.same_files("out", "whole")
        for name in names:
            self.assertEqual(os.readlink(self.folder / "out" / name), "../disk/" + name)
        self.assertEqual({p.name for p in (self.folder / "disk").iterdir()}, set(names) - {"run.checkpoint"})

    def test_standard_output_is_written_in_place_whatever_it_is(self):
        (self.folder / "link").symlink_to("/dev/stdout")
        for target in ("link", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"):
            with open(self.folder / "caught", "wb") as caught:
                subprocess.run([BINARY, "statics", "m.yaml", "--write-state", target], cwd=self.folder, stdout=caught,
                               stderr=subprocess.PIPE, check=False, timeout=60)
                identity = os.fstat(caught.fileno())
            text = (self.folder / "caught").read_text()
            self.assertEqual(text.count('"floatframe_state"'), 1, target)
            self.assertIn("\nlong", "\n" + text[text.index("floatframe_state"):], target)  # what is printed follows
            self.assertTrue(os.path.samestat(identity, os.stat(self.folder / "caught")))
            self.assertEqual(os.readlink(self.folder / "link"), "/dev/stdout")
        # Behind what is there already, not over it.
        (self.folder / "caught").write_text("before\n")
        with open(self.folder / "caught", "ab") as caught:
            subprocess.run([BINARY, "run", "m.yaml", "--out", "out", *SHORT, "--write-state", "link"], cwd=self.folder,
                           stdout=caught, check=True, timeout=60)
        self.assertTrue((self.folder / "caught").read_text().startswith("before\n{"))

    def test_descriptors_take_regular_files_and_pipes(self):
        with open(self.folder / "caught", "wb") as caught:
            self.state(f"/dev/fd/{caught.fileno()}", pass_fds=(caught.fileno(),))
            self.assertTrue(os.path.samestat(os.fstat(caught.fileno()), os.stat(self.folder / "caught")))
        self.assertIn('"floatframe_state"', (self.folder / "caught").read_text())
        os.mkfifo(self.folder / "pipe")
        self.assertIn("this is a named pipe", self.state("pipe", code=2).stderr)
        reader = os.open(self.folder / "pipe", os.O_RDONLY | os.O_NONBLOCK)
        writer = os.open(self.folder / "pipe", os.O_WRONLY)
        os.set_blocking(reader, True)
        self.state(f"/dev/fd/{writer}", pass_fds=(writer,))
        os.close(writer)
        with open(reader, "rb") as pipe:
            self.assertIn(b'"floatframe_state"', pipe.read())
        with open(self.folder / "m.yaml", "rb") as closed:
            self.assertIn("Bad file descriptor", self.state("/dev/fd/77", code=2).stderr)
            self.assertIn("which this command reads", self.state(f"/dev/fd/{closed.fileno()}", code=2,
                                                                 pass_fds=(closed.fileno(),)).stderr)
        self.assertEqual((self.folder / "m.yaml").read_text(), MODEL)

    def test_results_go_to_what_is_open(self):
        (self.folder / "out").mkdir()
        with open(self.folder / "caught", "wb") as caught:
            (self.folder / "out/results.csv").symlink_to(f"/dev/fd/{caught.fileno()}")
            self.program("run", "m.yaml", "--out", "out", *SHORT, pass_fds=(caught.fileno(),))
        self.assertTrue((self.folder / "caught").read_text().startswith("time [s],drive"))
        self.assertTrue((self.folder / "out/results.csv").is_symlink())
        (self.folder / "else").mkdir()
        (self.folder / "else/states.ffr").symlink_to("/dev/null")
        self.refused("'else/states.ffr' is not a regular file", "run", "m.yaml", "--out", "else", *SHORT, folder="m.yaml")
        self.assertTrue((self.folder / "else/states.ffr").is_symlink())

    def test_a_log_goes_to_standard_output_in_place(self):
        with open(self.folder / "caught", "wb") as caught:
            subprocess.run([BINARY, "realtime", "m.yaml", "--no-pace", "--duration", "0.01", "--log", "/dev/stdout", "--quiet"],
                           cwd=self.folder, stdout=caught, check=True, timeout=60)
        self.assertEqual((self.folder / "caught").read_text().count("\n"), 12)


if __name__ == "__main__":
    unittest.main()
