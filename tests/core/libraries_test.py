"""A program that steps a model needs `floatframe` alone: no sockets, no worker processes, no page. These are in the tools."""
import os
import pathlib
import re
import subprocess
import unittest

BUILD = pathlib.Path(os.environ["FLOATFRAME_BINARY"]).parent
LIB = BUILD / "lib"
TOOLS = LIB / "libfloatframe_tools.so"
TEMPLATE = BUILD / "viewer" / "template.html"
SOCKETS = {"socket", "bind", "connect", "sendto", "recvfrom", "getaddrinfo", "socketpair"}
PROCESSES = {"fork", "waitpid", "kill"}
ROOT = pathlib.Path(__file__).resolve().parents[2]


def imported(library):
    listing = subprocess.run(["nm", "-D", "--undefined-only", library], check=True, capture_output=True, text=True).stdout
    return set(re.findall(r" U (\w+)", listing))


def needed(file):
    listing = subprocess.run(["readelf", "-d", file], check=True, capture_output=True, text=True).stdout
    return set(re.findall(r"\(NEEDED\).*\[(libfloatframe\w*)\.so", listing))


class Libraries(unittest.TestCase):
    def setUp(self):
        self.copies = [file for file in (LIB / "libfloatframe.so", LIB / "glibc-hwcaps" / "x86-64-v3" / "libfloatframe.so")
                       if file.exists()]
        self.assertTrue(self.copies)
        try:
            imported(TOOLS)
        except FileNotFoundError:
            self.skipTest("nm is not installed")

    def test_the_library_of_steps_has_no_sockets_and_no_processes(self):
        self.assertEqual((SOCKETS | PROCESSES) - imported(TOOLS), set())
        for library in self.copies:
            self.assertEqual((SOCKETS | PROCESSES) & imported(library), set(), library)

    def test_the_library_of_steps_has_no_page(self):
        for library in self.copies:
            self.assertNotIn(b"<!doctype html>", library.read_bytes().lower(), library)
        if TEMPLATE.exists() and TEMPLATE.stat().st_size:
            self.assertIn(TEMPLATE.read_bytes()[:1000], TOOLS.read_bytes())

    def test_the_tools_need_the_library_which_needs_no_other_of_the_project(self):
        self.assertEqual(needed(TOOLS), {"libfloatframe"})
        for library in self.copies:
            self.assertEqual(needed(library), set(), library)

    def test_the_build_has_the_rooms_that_the_check_of_includes_takes_for_tools(self):
        built = re.search(r"set\(rooms_of_tools ([^)]*)\)", (ROOT / "src" / "CMakeLists.txt").read_text()).group(1).split()
        checked = re.search(r"^TOOLS = \{([^}]*)\}", (ROOT / "scripts" / "check_includes.py").read_text(), re.MULTILINE).group(1)
        self.assertEqual(sorted(built), sorted(re.findall(r'"(\w+)"', checked)))


if __name__ == "__main__":
    unittest.main()
