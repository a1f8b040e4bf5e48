"""The programs of docs/c-interface.md: compiled, as strictly as it goes, and run. They print the same."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIB = pathlib.Path(os.environ["FLOATFRAME_BINARY"]).parent / "lib"
HEADER = ROOT / "src" / "floatframe" / "c_interface"
MODEL = ROOT / "examples" / "active_damper" / "active_damper.yaml"
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```", re.MULTILINE | re.DOTALL)
EXPECTED = re.compile(r"t = 0?\.500 s, vz = +(-?[\d.eE+-]+) m/s")


def program(language):
    blocks = [text for kind, text in BLOCK.findall((ROOT / "docs" / "c-interface.md").read_text()) if kind == language]
    assert blocks, language
    return blocks[0]


@unittest.skipIf(os.environ.get("FLOATFRAME_SANITIZE"), "programs of other compilers come without the sanitizer")
class Recipes(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def velocity(self, *command):
        done = subprocess.run([str(c) for c in command], capture_output=True, text=True, cwd=self.folder.name,
                              env={**os.environ, "LD_LIBRARY_PATH": str(LIB)})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertRegex(done.stdout, EXPECTED)
        return float(EXPECTED.search(done.stdout)[1])

    def compiled(self, compilers, language, suffix, *options):
        found = next((c for c in compilers if shutil.which(c)), None)
        if not found:
            self.skipTest(f"no {compilers[0]} here")
        source = pathlib.Path(self.folder.name) / f"first{suffix}"
        source.write_text(program(language))
        output = source.with_suffix(".out")
        done = subprocess.run([found, source, "-o", output, *options], capture_output=True, text=True, cwd=self.folder.name)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return output

    def in_c(self):
        options = ["-pedantic", "-Wall", "-Wextra", "-Werror", f"-I{HEADER}", f"-L{LIB}", "-lfloatframe"]
        return self.velocity(self.compiled(["cc", "gcc"], "c", ".c", "-std=c99", *options), MODEL)

    def test_c_and_cpp(self):
        velocity = self.in_c()
        options = ["-std=c++11", "-pedantic", "-Wall", "-Wextra", "-Werror", f"-I{HEADER}", f"-L{LIB}", "-lfloatframe"]
        self.assertEqual(self.velocity(self.compiled(["c++", "g++"], "c", ".cpp", *options), MODEL), velocity)

    def test_python(self):
        source = pathlib.Path(self.folder.name) / "first.py"
        source.write_text(program("python"))
        self.assertEqual(self.velocity(sys.executable, source, "libfloatframe.so", MODEL), self.in_c())

    def test_fortran(self):
        options = ["-Wall", f"-L{LIB}", "-lfloatframe"]
        velocity = self.velocity(self.compiled(["gfortran"], "fortran", ".f90", *options), MODEL)
        self.assertAlmostEqual(velocity, self.in_c(), delta=1e-8)

    def test_rust(self):
        if shutil.which("rustc") and subprocess.run(["rustc", "--version"], capture_output=True).returncode:
            self.skipTest("rustc does not run here")
        velocity = self.velocity(self.compiled(["rustc"], "rust", ".rs", "-L", f"native={LIB}"), MODEL)
        self.assertAlmostEqual(velocity, self.in_c(), delta=1e-8)


if __name__ == "__main__":
    unittest.main()
