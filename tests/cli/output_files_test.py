#!/usr/bin/env python3
"""Files that are written: never waited for, never one that is read or that the same command writes too."""
import os
import pathlib
import subprocess
import tempfile
import unittest

BINARY = os.path.abspath(os.environ.get("FLOATFRAME_BINARY", "build/floatframe"))
DECKS = pathlib.Path(os.environ["FLOATFRAME_TEST_DATA"]) / "fe"

MODEL = """\
floatframe: 1
name: slide
parameters: {v: 1}
bodies:
  b: {position: [0, 0, 0], rigid: {mass: 1, inertia: [1, 1, 1]}}
joints:
  j: {type: prismatic, child: b, at: [0, 0, 0], axis: x}
forces:
  f: {type: joint_spring, joint: j, spring: 10}
  g: {type: joint_spring, joint: j, spring: {table: results.csv}}
outputs:
  x: {joint_position: j}
simulation: {step: 0.01, duration: 0.05}
"""
TABLE = "x [m],force [N]\n-1,-1\n1,1\n"
REDUCE = ("reduce", "part.inp", "--units", "mm-t-s", "--interface", "A=set:END_A", "--interface", "B=set:END_B",
          "--modes", "2", "--quiet")


class OutputFiles(unittest.TestCase):
    def setUp(self):
        self.holder = tempfile.TemporaryDirectory(prefix="floatframe-outputs-")
        self.folder = pathlib.Path(self.holder.name)
        (self.folder / "m.yaml").write_text(MODEL.replace("  g: {type: joint_spring, joint: j, spring: "
                                                          "{table: results.csv}}\n", ""))
        (self.folder / "part.inp").write_bytes((DECKS / "beam_b31_free.inp").read_bytes())
        (self.folder / "beam_b31_mesh.inp").write_bytes((DECKS / "beam_b31_mesh.inp").read_bytes())
        os.mkfifo(self.folder / "pipe")

    def tearDown(self):
        self.holder.cleanup()

    def start(self, *arguments, code, stdout=subprocess.PIPE):
        done = subprocess.run([BINARY, *arguments], cwd=self.folder, stdout=stdout, stderr=subprocess.PIPE,
                              text=True, timeout=300, check=False)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def refused(self, *arguments, message):
        before = {p.name: p.read_bytes() for p in self.folder.iterdir() if p.is_file()}
        self.assertIn(message, self.start(*arguments, code=2).stderr)
        for name, content in before.items():
            self.assertEqual((self.folder / name).read_bytes(), content, name)

    def test_pipes_are_not_waited_for(self):
        pipe = "the file 'pipe' cannot be written: this is a named pipe, expected a regular file"
        self.refused("run", "m.yaml", "--write-state", "pipe", message=pipe)
        self.refused("statics", "m.yaml", "--write-state", "pipe", message=pipe)
        self.refused("realtime", "m.yaml", "--no-pace", "--report", "pipe", message=pipe)
        for option in ("-o", "--sid", "--report"):
            self.refused(*REDUCE, option, "pipe", message=pipe)
        for command in ("step", "chain", "scaling", "iltis"):
            self.refused("bench", command, "--json", "pipe", message=pipe)
        (self.folder / "out").mkdir(exist_ok=True)
        for name in ("results.csv", "report.html", "summary.json"):
            os.mkfifo(self.folder / "out" / name)
            self.refused("run", "m.yaml", "--out", "out", message=name + "' cannot be written: this is a named pipe")
            (self.folder / "out" / name).unlink()
        os.mkfifo(self.folder / "out" / "sweep.csv")
        self.refused("sweep", "m.yaml", "--vary", "v=1,2", "--out", "out", message="sweep.csv' cannot be written")

    def test_what_cannot_be_written_is_said_before_the_run(self):
        self.refused("run", "m.yaml", "--write-state", "no/where.json", "--out", "out", message="No such file")
        self.assertFalse((self.folder / "out" / "results.csv").exists())
        self.refused("statics", "m.yaml", "--write-state", ".", message="Is a directory")

    def test_standard_output_and_null_devices_take_files(self):
        done = self.start("statics", "m.yaml", "--write-state", "/dev/stdout", code=0)
        self.assertIn('"floatframe_state": 1', done.stdout)
        self.start("run", "m.yaml", "--write-state", "/dev/null", code=0)
        self.start(*REDUCE, "--report", "/dev/null", "--sid", "/dev/null", code=0)

    def test_inputs_are_not_overwritten(self):
        os.link(self.folder / "m.yaml", self.folder / "hard.yaml")
        os.symlink("m.yaml", self.folder / "soft.yaml")
        for name in ("m.yaml", "./m.yaml", "hard.yaml", "soft.yaml"):
            read = f"found '{name}', which this command reads; expected another file"
            self.refused("run", "m.yaml", "--write-state", name, message="--write-state: " + read)
            self.refused("statics", "m.yaml", "--write-state", name, message="--write-state: " + read)
            self.refused("realtime", "m.yaml", "--no-pace", "--log", name, message="--log: " + read)
            self.refused("realtime", "m.yaml", "--no-pace", "--report", name, message="--report: " + read)
            self.refused("bench", "step", "m.yaml", "--json", name, message="--json: " + read)
        for option in ("-o", "--sid", "--report"):
            self.refused(*REDUCE, option, "part.inp", message=option + ": found 'part.inp', which this command reads")

    def test_files_that_inputs_name_are_not_overwritten(self):
        (self.folder / "results.csv").write_text(TABLE)
        (self.folder / "t.yaml").write_text(MODEL)
        self.refused("run", "t.yaml", "--out", ".", message="--out: found './results.csv', which this command reads")
        self.refused(*REDUCE, "-o", "beam_b31_mesh.inp", "--overwrite", message="-o: found 'beam_b31_mesh.inp', which this command")
        (self.folder / "sweep.csv").write_text("v\n1\n2\n")
        self.refused("sweep", "m.yaml", "--table", "sweep.csv", "--out", ".", message="sweep.csv', which this command")

    def test_two_outputs_are_two_files(self):
        (self.folder / "out").mkdir(exist_ok=True)
        for name in ("new.json", "./new.json"):
            self.refused("realtime", "m.yaml", "--no-pace", "--log", "new.json", "--report", name,
                         message=f"--log and --report: found '{name}' for both, expected two files")
            self.refused(*REDUCE, "-o", "new.json", "--sid", name, message=f"-o and --sid: found '{name}' for both")
        self.refused("run", "m.yaml", "--out", "out", "--write-state", "out/results.csv",
                     message="--write-state and --out: found 'out/results.csv' for both")
        self.start("realtime", "m.yaml", "--no-pace", "--log", "log.csv", "--report", "report.json", code=0)


if __name__ == "__main__":
    unittest.main()
