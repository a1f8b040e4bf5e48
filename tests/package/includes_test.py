"""scripts/check_includes.py finds arrows that point the wrong way."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "check_includes.py"


class CheckIncludes(unittest.TestCase):
    def check(self, files, inside=""):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in files.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            result = subprocess.run([sys.executable, "-B", str(SCRIPT), str(root / inside)], capture_output=True, text=True)
            return result.returncode, result.stderr.replace(folder + "/", "")

    def test_allowed_arrows_pass(self):
        self.assertEqual(self.check({"inertia/a.hpp": '#include "floatframe/body/b.hpp"\n#include <vector>\n'}), (0, ""))

    def test_an_arrow_that_points_back_is_an_error_with_its_line(self):
        code, text = self.check({"model/a.hpp": '#pragma once\n#include "floatframe/integrator/b.hpp"\n'})
        self.assertEqual(code, 1)
        self.assertTrue(text.startswith("model/a.hpp:2: 'model' must not use 'integrator'; it may use "), text)

    def test_no_room_of_the_library_uses_a_tool(self):
        for room, tool in (("run", "results"), ("stepping", "realtime"), ("rotors", "analyses"), ("model_file", "sweep")):
            code, text = self.check({f"{room}/a.cpp": f'#include "floatframe/{tool}/b.hpp"\n'})
            self.assertEqual(code, 1)
            self.assertIn(f"{room}/a.cpp:1: '{room}' must not use '{tool}'", text)

    def test_nor_may_the_table_allow_it(self):
        with tempfile.TemporaryDirectory() as folder:
            wrong = pathlib.Path(folder) / SCRIPT.name
            wrong.write_text(SCRIPT.read_text().replace('"run": DYNAMICS | {', '"run": DYNAMICS | {"results", '))
            result = subprocess.run([sys.executable, "-B", str(wrong), folder], capture_output=True, text=True)
        self.assertEqual(result.returncode, 1)
        self.assertIn("'run' must not be allowed results: of the library floatframe_tools", result.stderr)

    def test_headers_of_the_library_do_not_use_the_tools(self):
        files = {"history.hpp": '#include "floatframe/page/a.hpp"\n', "page/a.hpp": ""}
        self.assertEqual(self.check(files), (0, ""))
        for used in ("page/a.hpp", "history.hpp"):
            self.assertEqual(self.check({**files, "model.hpp": f'#include "floatframe/{used}"\n'}),
                             (1, f"model.hpp:1: the public header model.hpp is of floatframe, and must not use {used} of floatframe_tools\n"))

    def test_a_type_that_is_only_declared_counts_as_used(self):
        files = {"formulation/f.hpp": "class Formulation {\n};\n", "start/s.hpp": "class Formulation;\n"}
        self.assertEqual(self.check(files), (0, ""))
        files["model/a.hpp"] = "#pragma once\nclass Formulation;\n"
        self.assertEqual(self.check(files), (1, "model/a.hpp:2: 'model' must not declare Formulation of 'formulation'\n"))

    def test_public_headers_reach_nothing_foreign(self):
        files = {"model.hpp": '#include "floatframe/model/a.hpp"\n', "model/a.hpp": "#include <vector>\n#include <Eigen/Core>\n"}
        self.assertEqual(self.check(files), (0, ""))
        files["model/a.hpp"] += "#include <fmt/format.h>\n"
        self.assertEqual(self.check(files), (1, "model/a.hpp:3: the public header model.hpp must not reach <fmt/format.h>: "
                                                "only the standard library and Eigen\n"))

    def test_comments_of_installed_headers_name_only_those(self):
        files = {"model.hpp": '#include "floatframe/model/a.hpp"\n', "model/a.hpp": "// The list is in model.hpp.\n",
                 "model/b.hpp": "// As c.hpp says.\n"}
        self.assertEqual(self.check(files), (0, ""))
        files["model/a.hpp"] += "int a;  // see b.hpp\n"
        code, text = self.check(files)
        self.assertEqual(code, 1)
        self.assertTrue(text.startswith("model/a.hpp:2: a comment names b.hpp, which is not installed"), text)

    def test_public_headers_stay_out_of_private_rooms(self):
        code, text = self.check({"a.hpp": '#include "floatframe/model/a.hpp"\n', "integrator/a.hpp": "",
                                 "model/a.hpp": "", "b.hpp": '\n#include "floatframe/integrator/a.hpp"\n'})
        self.assertEqual((code, text), (1, "b.hpp:2: the public header b.hpp must not reach integrator/a.hpp\n"))

    def test_rooms_do_not_use_public_headers(self):
        code, text = self.check({"model.hpp": "", "sweep/a.cpp": '#include "floatframe/model.hpp"\n'})
        self.assertEqual((code, text), (1, "sweep/a.cpp:1: 'sweep' must not use the public header model.hpp; "
                                           "include the header of its room\n"))

    def test_public_headers_reach_no_library_with_a_hyphen(self):
        code, text = self.check({"model.hpp": "#include <yaml-cpp/yaml.h>\n"})
        self.assertEqual(code, 1)
        self.assertIn("must not reach <yaml-cpp/yaml.h>", text)

    def test_headers_are_named_in_full(self):
        for odd in ("nlohmann/json.hpp", "../run/run.hpp", "floatframe/core/../run/run.hpp"):
            code, text = self.check({"core/a.cpp": f'#include "{odd}"\n'})
            self.assertEqual(code, 1, odd)
            self.assertIn(f'core/a.cpp:1: found "{odd}"', text)

    def test_modules_use_one_header(self):
        code, text = self.check({"floatframe/sweep/ranks.hpp": "", "mpi/a.cpp": '#include "floatframe/sweep/ranks.hpp"\n'
                                                                               '#include "floatframe/sweep/sweep.hpp"\n'},
                                inside="floatframe")
        self.assertEqual(code, 1)
        self.assertIn("mpi/a.cpp:2: 'mpi' must not use sweep/sweep.hpp; it may use sweep/ranks.hpp", text)

    def test_a_folder_that_is_no_room_is_an_error(self):
        code, text = self.check({"util/a.hpp": ""})
        self.assertEqual(code, 1)
        self.assertIn("the folder 'util' is not a room", text)


if __name__ == "__main__":
    unittest.main()
