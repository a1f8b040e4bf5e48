"""What the tests of `floatframe sweep` share: a folder, studies and what they leave there."""
import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

BINARY = os.environ.get("FLOATFRAME_BINARY") or (
    sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else "build/floatframe")
BINARY = str(pathlib.Path(BINARY).resolve())
EXAMPLES = pathlib.Path(os.environ.get("FLOATFRAME_EXAMPLES") or
                        pathlib.Path(__file__).resolve().parents[2] / "examples")
CRANK = EXAMPLES / "slider_crank" / "slider_crank.yaml"
MPIRUN = shutil.which("mpirun")
MODULE = pathlib.Path(BINARY).parent / "lib" / "libfloatframe_mpi.so"

# Twelve runs: a parameter, one that changes a flexible body, a simulation option.
GRID = ("--vary", "rate=40:60:3", "--vary", "ne_rod=8,4", "--vary", "inertia=preprocessing,projection",
        "--duration", "0.02")
# Forty runs of some length.
LONG = ("--vary", "rate=40:60:40", "--duration", "0.1")


class Sweep(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="floatframe-sweep-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def sweep(self, code, *arguments, launcher=(), environment=None):
        done = subprocess.run([*launcher, BINARY, "sweep", *map(str, arguments)], cwd=self.folder, timeout=200,
                              capture_output=True, text=True, check=False, env=environment)
        self.assertEqual(done.returncode, code, done.stderr + done.stdout)
        return done

    def start(self, *arguments):
        return subprocess.Popen([BINARY, "sweep", *map(str, arguments)], cwd=self.folder,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def table(self, folder):
        return (self.folder / folder / "sweep.csv").read_bytes()

    def rows(self, folder):
        with open(self.folder / folder / "sweep.csv", newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def journal(self, folder):
        path = self.folder / folder / "sweep.journal"
        return path.read_text(encoding="utf-8").splitlines() if path.exists() else []

    def wait_for_runs(self, process, folder, count):
        """Until the journal holds `count` finished runs."""
        end = time.monotonic() + 120
        while len(self.journal(folder)) < count + 1:
            self.assertIsNone(process.poll(), "the study was over too early")
            self.assertLess(time.monotonic(), end)
            time.sleep(0.002)

    def launcher(self, ranks):
        """mpirun and an environment that lets it work in a container."""
        if not MPIRUN or not MODULE.exists():
            self.skipTest("mpirun is not installed or the program was built without MPI")
        environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                           OMPI_MCA_rmaps_base_oversubscribe="1")
        # OpenMPI keeps memory until the end; with a sanitizer that is not ours to judge.
        environment["ASAN_OPTIONS"] = environment.get("ASAN_OPTIONS", "") + ":detect_leaks=0"
        return {"launcher": (MPIRUN, "-n", str(ranks), "--oversubscribe"), "environment": environment}
