"""What tests of long runs share: a model, the program, and what may be on disk at any moment."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

from report_page import without_clock

BINARY = os.environ.get("FLOATFRAME_BINARY") or (
    sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else "build/floatframe")
BINARY = str(pathlib.Path(BINARY).resolve())

# A crank turns a disc on a spring that counts turns; a beam swings; a loop closed by a rod.
MODEL = """\
floatframe: 1
name: long
parameters: {mass: 1, duration: 1000}
points: {p: [0, 1, 0], tip: [0.6, 1, 0]}
bodies:
  crank: {rigid: {mass: "${mass}", centre_of_mass: [0.05, 0, 0], inertia: [0.001, 0.002, 0.002]}}
  slider: {rigid: {mass: 2, centre_of_mass: [0.5, 0, 0], inertia: [0.01, 0.01, 0.01]}}
  disc: {rigid: {mass: 1, centre_of_mass: [0, 2, 0], inertia: [0.02, 0.02, 0.02]}}
  beam:
    flexible:
      material: {young: 7e10, poisson: 0.3, density: 2700}
      bars: {one: {from: p, to: tip, elements: 4, section: {round: 0.01}}}
      clamped: [p]
      static_modes: [{point: tip, dofs: [y, z]}]
      normal_modes: 2
      damping: 0.01
joints:
  drive: {type: revolute, child: crank, at: [0, 0, 0], axis: z, motion: {polynomial: [0.3, 20]}}
  guide: {type: prismatic, child: slider, at: [0.5, 0, 0], axis: x}
  spin: {type: revolute, child: disc, at: [0, 2, 0], axis: z, position: 14}
  hinge: {type: revolute, child: beam, at: p, axis: y, position: 0.4}
rods:
  tie: {from: {body: crank, at: [0.1, 0, 0]}, to: {body: slider, at: [0.5, 0, 0]}}
forces:
  coil: {type: joint_spring, joint: spin, spring: 3}
outputs:
  drive: {joint_position: drive}
  spin: {joint_position: spin}
  slider: {acceleration: slider, axis: x}
  tip: {position: {body: beam, node: tip}}
  guide: {joint_force: guide}
  root: {joint_torque: hinge, axis: y}
  motor: {motion_force: drive}
simulation: {step: 1.0e-3, duration: "${duration}", spectral_radius: 0.9}
"""


class RunCase(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="floatframe_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        (self.folder / "m.yaml").write_text(MODEL)

    def program(self, *arguments, code=0, **more):
        done = subprocess.run([BINARY, *arguments], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True, timeout=600, check=False, **more)
        if code is not None:  # else the caller looks at it
            self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def begin(self, *arguments, **more):
        process = subprocess.Popen([BINARY, *arguments], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True, **more)

        def stop():
            if process.poll() is None:
                process.kill()
                process.communicate()
        self.addCleanup(stop)
        return process

    def end(self, process, signal_number):
        process.send_signal(signal_number)
        out, err = process.communicate(timeout=120)
        return process.returncode, out, err

    def wait_for(self, ready, process=None):
        """At most two minutes: the machine may be busy."""
        for _ in range(12000):
            if ready():
                return
            if process and process.poll() is not None:
                self.fail("the program ended: " + "".join(process.communicate()))
            time.sleep(0.01)
        self.fail("nothing happened for two minutes")

    def rows(self, folder):
        """Whole lines of the results, each with as many numbers; the header is not counted."""
        data = (self.folder / folder / "results.csv").read_bytes()
        lines = data[:data.rfind(b"\n") + 1].split(b"\n")[:-1]
        for line in lines[1:]:
            self.assertEqual(line.count(b","), lines[0].count(b","))
            for number in line.split(b","):
                float(number)
        return len(lines) - 1

    def has_rows(self, folder, count=1):
        path = self.folder / folder / "results.csv"
        return lambda: path.exists() and path.read_bytes().count(b"\n") > count

    def summary(self, folder):
        return json.loads((self.folder / folder / "summary.json").read_text())

    def same_files(self, one, two):
        """Equal results; summary and report but for what was measured with a clock."""
        read = lambda folder, name: (self.folder / folder / name).read_bytes()
        self.assertEqual(read(one, "results.csv"), read(two, "results.csv"))
        a, b = self.summary(one), self.summary(two)
        for key in ("cpu_s", "real_time_factor", "step_times"):
            del a[key], b[key]
        self.assertEqual(a, b)
        self.assertEqual(*(without_clock(self.folder / folder / "report.html") for folder in (one, two)))
