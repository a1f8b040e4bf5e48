"""scripts/build_times.py on the log of a build that was made up."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "build_times.py"
NINJA = """\
build src/CMakeFiles/lib_fe.dir/Unity/unity_0_cxx.cxx.o: CXX a | b
build src/CMakeFiles/lib_fe.dir/floatframe/fe/beam2.cpp.o: CXX b
build lib/libfloatframe.so.0.1.0: LINK c
"""
LOG = """\
# ninja log v5
0\t9000\t1\tsrc/CMakeFiles/lib_fe.dir/floatframe/fe/beam2.cpp.o\tx
0\t60000\t1\tsrc/CMakeFiles/lib_old.dir/floatframe/fe/gone.cpp.o\tx
0\t4000\t1\tsrc/CMakeFiles/lib_fe.dir/Unity/unity_0_cxx.cxx.o\tx
0\t3000\t1\tsrc/CMakeFiles/lib_fe.dir/floatframe/fe/beam2.cpp.o\tx
3000\t3500\t1\tlib/libfloatframe.so.0.1.0\tx
"""


class BuildTimes(unittest.TestCase):
    def run_script(self, folder):
        return subprocess.run([sys.executable, "-B", SCRIPT, folder], capture_output=True, text=True)

    def test_targets_and_dearest(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            unity = folder / "src/CMakeFiles/lib_fe.dir/Unity/unity_0_cxx.cxx"
            unity.parent.mkdir(parents=True)
            unity.write_text('#include "/x/floatframe/fe/mesh.cpp"\n#include "/x/floatframe/fe/surface.cpp"\n')
            (folder / "build.ninja").write_text(NINJA)
            (folder / ".ninja_log").write_text(LOG)
            done = self.run_script(folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("7.0 s  lib_fe\n", done.stdout)
            self.assertIn("4.0 s  lib_fe: fe/mesh.cpp and 1 more", done.stdout)
            self.assertIn("3.0 s  lib_fe: fe/beam2.cpp", done.stdout)  # the last run counts
            self.assertIn("7.5 s  in all, 3 commands", done.stdout)
            self.assertNotIn("gone", done.stdout)

    def test_a_folder_without_a_log(self):
        with tempfile.TemporaryDirectory() as name:
            done = self.run_script(name)
            self.assertEqual(done.returncode, 1)
            self.assertIn("not built with ninja", done.stderr)


if __name__ == "__main__":
    unittest.main()
