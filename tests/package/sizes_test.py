"""scripts/check_sizes.py finds lines, functions and files that are too long."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "check_sizes.py"


class CheckSizes(unittest.TestCase):
    def check(self, name, text):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / name
            (pathlib.Path(folder) / "src").mkdir()
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
            result = subprocess.run([sys.executable, "-B", str(SCRIPT), folder], capture_output=True, text=True)
            return result.returncode, result.stderr

    def test_lines_of_more_than_100_columns(self):
        for folder in ("src/core", "tests/core", "examples/cpp", "fuzz"):
            for name in ("a.cpp", "a.hpp"):
                self.assertEqual(self.check(f"{folder}/{name}", "// \u00e4" + 96 * "x" + "\n"), (0, ""))
                self.assertEqual(self.check(f"{folder}/{name}", "\n// " + 98 * "x" + "\n"),
                                 (1, f"{folder}/{name}:2: 101 columns; expected at most 100\n"))

    def test_functions_of_more_than_80_lines(self):
        def function(lines):
            return "int f() {\n" + (lines - 2) * "  g();\n" + "}\n"
        self.assertEqual(self.check("src/core/a.cpp", function(80)), (0, ""))
        self.assertEqual(self.check("src/core/a.cpp", function(81)),
                         (1, "src/core/a.cpp:1: f has 81 lines; expected at most 80\n"))

    def test_files_of_more_lines_than_can_be_read_in_one_go(self):
        for folder, longest in (("src/core", 400), ("tests/core", 450)):
            self.assertEqual(self.check(f"{folder}/a.cpp", longest * "\n"), (0, ""))
            code, text = self.check(f"{folder}/a.cpp", (longest + 1) * "\n")
            self.assertEqual((code, text.split(":")[0]), (1, f"{folder}/a.cpp"))


if __name__ == "__main__":
    unittest.main()
