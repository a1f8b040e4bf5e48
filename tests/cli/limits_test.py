#!/usr/bin/env python3
"""Little memory, a small stack, large models: every command ends, with its result or with one sentence."""
import json
import math
import os
import pathlib
import pty
import resource
import shutil
import subprocess
import unittest

from run_case import BINARY, RunCase

DATA = pathlib.Path(os.environ.get("FLOATFRAME_TEST_DATA") or pathlib.Path(__file__).resolve().parents[1] / "data")
REDUCE = ("reduce", "aarm_coarse_free.inp", "--units", "mm-t-s", "--interface", "A=set:BUSH_F", "--interface", "B=set:BALL",
          "--modes", "5", "--quiet", "--overwrite", "-o", "arm.ffb")
BAR = """floatframe: 1
name: bar
points: {a: [0, 0, 0], b: [1, 0, 0]}
bodies:
  b:
    flexible:
      material: {young: 2.1e11, poisson: 0.3, density: 7850}
      bars: {rod: {from: a, to: b, section: {round: 0.02}, elements: 1000}}
      clamped: [a]
      normal_modes: 200
"""
PROCESSOR_SECONDS = 120  # what spins takes them all; the reduction needs three


class Limits(RunCase):
    def setUp(self):
        super().setUp()
        for name in ("aarm_coarse_free.inp", "aarm_coarse_mesh.inp.gz"):
            shutil.copy(DATA / "fe" / name, self.folder)

    def limited(self, limit, size, *arguments):
        def set_limits():
            resource.setrlimit(resource.RLIMIT_CPU, (PROCESSOR_SECONDS, PROCESSOR_SECONDS + 10))
            resource.setrlimit(limit, (size, size))
        return self.program(*arguments, code=None, preexec_fn=set_limits)

    def test_addresses(self):
        """BLAS asks again without end for buffers that the process may not have: 150 to 400 MB were such limits."""
        codes = []
        for megabytes in (150, 200, 250, 300, 400, 3000):
            with self.subTest(megabytes=megabytes):
                done = self.limited(resource.RLIMIT_AS, megabytes << 20, *REDUCE)
                codes.append(done.returncode)
                self.assertIn(done.returncode, (0, 1), done.stderr)
                if done.returncode == 1:
                    self.assertRegex(done.stderr, "memory")
                    self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertEqual(codes[-1], 0)

    def write_many_links(self, count=2000):
        """So many hinged links with stiff springs."""
        bodies, joints, forces = ["bodies:"], ["joints:"], ["forces:"]
        for k in range(count):
            parent = f"parent: b{k - 1}, " if k else ""
            bodies.append(f"  b{k}: {{rigid: {{mass: 1, centre_of_mass: [{k}.5, 0, 0], inertia: [0.01, 0.1, 0.1]}}}}")
            joints.append(f"  j{k}: {{type: revolute, {parent}child: b{k}, at: [{k}, 0, 0], axis: y}}")
            forces.append(f"  s{k}: {{type: joint_spring, joint: j{k}, spring: 1e9}}")
        (self.folder / "many.yaml").write_text("\n".join(["floatframe: 1", "name: many", *bodies, *joints, *forces, ""]))

    def test_statics_of_many_bodies(self):
        """Dense linear algebra took minutes."""
        self.write_many_links()
        done = self.limited(resource.RLIMIT_CPU, 60, "statics", "many.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, "many: static equilibrium after")

    def test_modes_of_many_bodies(self):
        """All eigenvalues took two and a half minutes. The links are a beam: clamped at one end, its EI the spring times the length of a link."""
        self.write_many_links()
        done = self.limited(resource.RLIMIT_CPU, 60, "modes", "many.yaml", "--json", "--number", "5")
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)
        self.assertEqual((found["degrees_of_freedom"], found["without_mass"], found["rigid_motions"]), (2000, 0, 0))
        frequencies = [mode["frequency_Hz"] for mode in found["modes"]]
        beam = [k ** 2 * math.sqrt(1e9) / 2000 ** 2 / (2 * math.pi) for k in (1.8751041, 4.6940911, 7.8547574, 10.9955407, 14.1371684)]
        for f, exact in zip(frequencies, beam, strict=True):
            self.assertLess(abs(f / exact - 1), 2e-3)

    def test_linear_system_of_many_bodies(self):
        """All have mass, although each can fold up with 1e-10 of what the chain could have, and no eigenvalues are looked for."""
        self.write_many_links(1200)
        done = self.limited(resource.RLIMIT_CPU, 60, "linearize", "many.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, "many: 2400 states, 0 inputs, 3600 outputs")

    def test_memory_is_compared_before_it_is_taken(self):
        self.write_many_links()
        text = (self.folder / "many.yaml").read_text()
        (self.folder / "absolute.yaml").write_text(text + "simulation: {coordinates: absolute}\n")
        done = self.limited(resource.RLIMIT_AS, 4 << 30, "linearize", "absolute.yaml")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stderr, r"the linear system of 24000 coordinates and 22000 constraints takes about \d+ GB of memory, "
                                      r"of which [\d.]+ GB are free; relative coordinates are fewer")
        (self.folder / "bar.yaml").write_text(BAR)
        done = self.limited(resource.RLIMIT_AS, 500 << 20, "check", "bar.yaml")
        self.assertIn(done.returncode, (1, 2), done.stderr)
        self.assertRegex(done.stderr, r"^(bar.yaml:7:7: bodies.b: the reduction of 1001 nodes to 200 modes takes about 0.58 GB of memory, of "
                                      r"which 0.\d+ GB are free; fewer modes or elements|floatframe: there is not enough memory)")

    def test_progress_on_a_terminal(self):
        self.write_many_links(900)
        ours, theirs = pty.openpty()
        with subprocess.Popen([BINARY, "modes", "many.yaml", "--number", "3"], cwd=self.folder, stdout=subprocess.PIPE, stderr=theirs) as program:
            os.close(theirs)
            shown = b""
            try:
                while part := os.read(ours, 4096):
                    shown += part
            except OSError:  # closed by its end
                pass
            out = program.stdout.read().decode()
        os.close(ours)
        self.assertEqual(program.returncode, 0)
        self.assertRegex(shown.decode(), r"\[#*\.*\] (stiffness|damping|slowest motions)")
        self.assertTrue(shown.endswith(b"\r\x1b[K"), shown[-40:])
        self.assertIn("900 degrees of freedom", out)

    def test_stack(self):
        for kilobytes in (64, 256):
            for command in (REDUCE, ("run", "m.yaml", "--set", "duration=0.05", "--quiet", "--out", "run"),
                            ("realtime", "m.yaml", "--no-pace", "--duration", "0.01", "--quiet"),
                            ("bench", "step", "chain", "--links", "32", "--duration", "0.01"),
                            ("sweep", "m.yaml", "--vary", "mass=1,2", "--set", "duration=0.02", "--out", "study", "--quiet"),
                            ("modes", "m.yaml"), ("linearize", "m.yaml")):
                with self.subTest(kilobytes=kilobytes, command=command[0]):
                    done = self.limited(resource.RLIMIT_STACK, kilobytes << 10, *command)
                    self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
