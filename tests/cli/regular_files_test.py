#!/usr/bin/env python3
"""Pipes and devices in the place of every file that the program reads: refused in a sentence, at once."""
import os
import pathlib
import resource
import subprocess
import tempfile
import unittest

BINARY = os.environ["FLOATFRAME_BINARY"]
DECKS = pathlib.Path(os.environ["FLOATFRAME_TEST_DATA"]) / "fe"

HEAD = "floatframe: 1\nname: pipes\n"
TAIL = "joints:\n  hinge: {type: free, child: arm}\nsimulation: {step: 0.01, duration: 0.1}\n"
BASIS = """\
points:
  a: [0, 0, 0]
  b: [1, 0, 0]
bodies:
  arm:
    flexible:
      material: {young: 70e9, poisson: 0.3, density: 2700}
      bars:
        bar: {from: a, to: b, elements: 2, section: {area: 60e-6, Iy: 5e-10, Iz: 1.8e-10, J: 4.5e-10}, reference: y}
      basis: %s
"""


def limit_memory():
    if os.environ.get("FLOATFRAME_SANITIZE"):
        return  # the address sanitizer reserves terabytes
    resource.setrlimit(resource.RLIMIT_AS, (2 << 30, 2 << 30))


class RegularFiles(unittest.TestCase):
    def setUp(self):
        self.holder = tempfile.TemporaryDirectory(prefix="floatframe-pipes-")
        self.folder = pathlib.Path(self.holder.name)
        os.mkfifo(self.folder / "pipe")

    def tearDown(self):
        self.holder.cleanup()

    def refused(self, *arguments, message="regular file"):
        done = subprocess.run([BINARY, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              timeout=120, check=False, preexec_fn=limit_memory)
        self.assertEqual(done.returncode, 2, done.stderr + done.stdout)
        self.assertIn(message, done.stderr)

    def model(self, text):
        (self.folder / "model.yaml").write_text(HEAD + text, encoding="utf-8")
        return "model.yaml"

    def test_model_files(self):
        for name in ("pipe", "/dev/zero"):
            self.refused("check", name)
            self.refused("check", self.model("subsystems:\n  a: {file: %s}\n" % name + TAIL))
            self.refused("check", self.model(BASIS % name + TAIL))
            self.refused("sweep", name, "--vary", "a=1,2")

    def test_parts(self):
        for name in ("pipe", "/dev/zero"):
            for body in ("part: %s" % name, "part: {file: %s, units: mm-t-s, interfaces: {A: {node: 1}}}" % name):
                self.refused("check", self.model("bodies:\n  arm:\n    %s\n" % body + TAIL))
            self.refused("info", name)
            self.refused("reduce", name, "--units", "mm-t-s", "--interface", "A=node:1")

    def test_decks(self):
        (self.folder / "deck.inp").write_text("*NODE\n1, 0., 0., 0.\n*INCLUDE, INPUT=pipe\n", encoding="utf-8")
        self.refused("info", "deck.inp")
        (self.folder / "deck.bdf").write_text("BEGIN BULK\nINCLUDE 'pipe'\nENDDATA\n", encoding="utf-8")
        self.refused("info", "deck.bdf")
        for name in ("sti", "mas", "dof"):
            ending = ".gz" if name != "dof" else ""
            (self.folder / f"two.{name}{ending}").write_bytes((DECKS / f"two_bricks.{name}{ending}").read_bytes())
        (self.folder / "two.inp").write_bytes((DECKS / "two_bricks.inp").read_bytes())
        for option in ("--mass", "--dofs", "--nodes"):
            self.refused("info", "two.sti.gz", option, "pipe")

    def test_sweep_table(self):
        (self.folder / "model.yaml").write_text(HEAD + "parameters: {a: 1}\n" + TAIL, encoding="utf-8")
        self.refused("sweep", "model.yaml", "--table", "pipe")
        self.refused("sweep", "model.yaml", "--table", "/dev/zero")


if __name__ == "__main__":
    unittest.main()
