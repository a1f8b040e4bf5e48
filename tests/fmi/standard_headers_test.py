#!/usr/bin/env python3
"""Floatframe's headers of FMI 2.0 and 3.0 against those of the standard, which come with FMPy: equal types of all functions
(C lets nobody declare one twice with different types), equal enumerators, equal structures. Needs FMPy and a C compiler."""
import importlib.util
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

FMI = pathlib.Path(__file__).resolve().parents[2] / "src/fmi"
CLASSES = {"fmi2CallbackFunctions": "logger allocateMemory freeMemory stepFinished componentEnvironment",
           "fmi2EventInfo": "newDiscreteStatesNeeded terminateSimulation nominalsOfContinuousStatesChanged "
                            "valuesOfContinuousStatesChanged nextEventTimeDefined nextEventTime"}
COMPILER = shutil.which("cc") or shutil.which("gcc")


def published():
    found = importlib.util.find_spec("fmpy")
    return pathlib.Path(found.submodule_search_locations[0]) / "c-code" if found else None


def without_comments(text):
    return re.sub(r"/\*.*?\*/|//[^\n]*", " ", text, flags=re.DOTALL)


@unittest.skipUnless(published(), "FMPy is not installed")
@unittest.skipUnless(COMPILER, "no C compiler")
class StandardHeaders(unittest.TestCase):
    def compile(self, text, *options):
        with tempfile.TemporaryDirectory() as folder:
            source, program = pathlib.Path(folder) / "look.c", pathlib.Path(folder) / "look"
            source.write_text(text)
            made = subprocess.run([COMPILER, "-std=c11", "-Wall", "-Werror", f"-I{FMI}", f"-I{published()}", *options, "-o", program, source],
                                  capture_output=True, text=True)
            self.assertEqual(made.returncode, 0, made.stderr)
            return "" if "-c" in options else subprocess.run([program], capture_output=True, text=True, check=True).stdout

    def test_all_functions_have_equal_types(self):
        for version in (2, 3):
            self.compile(f'#include "fmi{version}Functions.h"\n#define FMI_STRUCTURES_ELSEWHERE\n#include "fmi{version}_standard.h"\n', "-c")

    def test_a_different_type_does_not_compile(self):
        with self.assertRaisesRegex(AssertionError, "conflicting types"):
            self.compile('#include "fmi3Functions.h"\nint fmi3Reset(double);\n', "-c")

    def test_no_function_is_missing(self):
        for version in (2, 3):
            names = [set(re.findall(rf"\bfmi{version}\w+TYPE\s+(fmi{version}\w+)\s*;", without_comments(file.read_text())))
                     for file in (published() / f"fmi{version}Functions.h", FMI / f"fmi{version}_standard.h")]
            self.assertEqual(*names)
            self.assertGreater(len(names[0]), 40)

    def test_equal_numbers_and_structures(self):
        for version in (2, 3):
            theirs = without_comments((published() / f"fmi{version}FunctionTypes.h").read_text())
            numbers = [name for body in re.findall(r"typedef\s+enum\s*\{([^}]*)\}", theirs) for name in re.findall(rf"fmi{version}\w+", body)]
            self.assertGreater(len(numbers), 10)
            numbers += [f"fmi{version}True", f"fmi{version}False"]
            lines = [f'printf("{name} %d\\n", (int){name});' for name in numbers]
            for name, members in CLASSES.items():
                if name.startswith(f"fmi{version}"):
                    lines += [f'printf("{name} %zu\\n", sizeof({name}));']
                    lines += [f'printf("{name}.{m} %zu %zu\\n", offsetof({name}, {m}), sizeof((({name}*)0)->{m}));' for m in members.split()]
            body = "#include <stddef.h>\n#include <stdio.h>\nint main(void) {" + "\n".join(lines) + "return 0; }\n"
            self.assertEqual(*[self.compile(f'#include "{header}"\n{body}') for header in (f"fmi{version}Functions.h", f"fmi{version}_standard.h")])


if __name__ == "__main__":
    unittest.main()
