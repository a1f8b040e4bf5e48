"""The binaries inside FMUs need nothing of the machine that they run on, and show the functions of FMI alone."""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

BUILD = pathlib.Path(os.environ["FLOATFRAME_BINARY"]).parent
ROOT = pathlib.Path(__file__).resolve().parents[2]
LINUX = BUILD / "lib" / "fmu" / "linux64" / "floatframe_fmu.so"
WINDOWS = BUILD / "lib" / "fmu" / "win64" / "floatframe_fmu.dll"
# glibc of Debian 12: what a machine needs at least is printed.
NEWEST_GLIBC = (2, 36)
LARGEST = 16e6  # [byte]
OF_FMI = {"fmi2Instantiate", "fmi2DoStep", "fmi2SerializeFMUstate", "fmi3InstantiateCoSimulation", "fmi3DoStep",
          "fmi3SerializeFMUState"}
OF_WINDOWS = {"kernel32.dll", "msvcrt.dll"}


def output_of(*command):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout


def version_of(text):
    return tuple(int(number) for number in text.split("."))


def exported_by_dll(listing):
    """The names in the export table that `objdump -p` prints."""
    table = listing.split("[Ordinal/Name Pointer] Table", 1)[1]
    return set(re.findall(r"^\s*\[\s*\d+\].*?\s([A-Za-z_]\w*)$", table, re.M))


class Linux(unittest.TestCase):
    def setUp(self):
        if not LINUX.exists():
            self.skipTest("the runtime of FMUs was not built (FLOATFRAME_FMU)")

    def test_needs_the_c_library_alone(self):
        needed = set(re.findall(r"\(NEEDED\).*\[(.*)\]", output_of("readelf", "-d", LINUX)))
        self.assertLessEqual(needed, {"libc.so.6", "libm.so.6", "ld-linux-x86-64.so.2"})

    def test_shows_the_functions_of_fmi_alone(self):
        shown = set(re.findall(r" [A-Za-z] (\w+)", output_of("nm", "-D", "--defined-only", LINUX)))
        self.assertLessEqual(OF_FMI, shown)
        self.assertEqual({name for name in shown if not re.match(r"fmi[23]", name)}, set())

    def test_runs_with_old_c_libraries(self):
        imported = re.findall(r" [Uw] (\w+)@GLIBC_([0-9.]+)", output_of("nm", "-D", "--undefined-only", LINUX))
        newest = max(version_of(version) for _, version in imported)
        names = sorted(name for name, version in imported if version_of(version) == newest)
        print(f"floatframe_fmu.so: {LINUX.stat().st_size / 1e6:.2f} MB, glibc {'.'.join(map(str, newest))} or later "
              f"({', '.join(names)})")
        self.assertLessEqual(newest, NEWEST_GLIBC)
        self.assertLess(LINUX.stat().st_size, LARGEST)

    def test_loads_on_a_bare_system(self):
        """A root with the files of the C library alone, as on Debian without Floatframe and without libstdc++."""
        if os.geteuid() != 0 or not hasattr(os, "chroot"):
            self.skipTest("another root needs a superuser")
        compiler = shutil.which("gcc") or shutil.which("cc")
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            shutil.copy(LINUX, root / "fmu.so")
            subprocess.run([compiler, "-x", "c", "-", "-o", root / "load", "-ldl"], check=True, text=True, input=LOADER)
            for line in output_of("ldd", root / "load").splitlines() + output_of("ldd", LINUX).splitlines():
                if match := re.search(r"(/\S+/(?:libc|libm|libdl|ld-linux-x86-64)\.so\.\d+)", line):
                    place = root / match.group(1).lstrip("/")
                    place.parent.mkdir(parents=True, exist_ok=True)
                    shutil.copy(match.group(1), place)
            done = subprocess.run(["/load", "/fmu.so"], capture_output=True, text=True, preexec_fn=lambda: os.chroot(root), cwd="/")
            self.assertEqual((done.returncode, done.stdout), (0, "2.0 3.0\n"), done.stderr)


LOADER = """
#include <dlfcn.h>
#include <stdio.h>
int main(int n, char** words) {
  void* fmu = dlopen(words[n - 1], RTLD_NOW | RTLD_LOCAL);
  if (!fmu) return fprintf(stderr, "%s", dlerror()), 1;
  const char* (*fmi2)(void) = (const char* (*)(void))dlsym(fmu, "fmi2GetVersion");
  const char* (*fmi3)(void) = (const char* (*)(void))dlsym(fmu, "fmi3GetVersion");
  if (!fmi2 || !fmi3) return 2;
  printf("%s %s\\n", fmi2(), fmi3());
  return 0;
}
"""


class Windows(unittest.TestCase):
    def setUp(self):
        objdump = "x86_64-w64-mingw32-objdump"
        if not WINDOWS.exists() or not shutil.which(objdump):
            self.skipTest("the runtime for Windows was not built (scripts/install_packages.sh --fmu)")
        self.listing = output_of(objdump, "-p", WINDOWS)

    def test_needs_windows_alone(self):
        needed = {name.lower() for name in re.findall(r"DLL Name: (\S+)", self.listing)}
        print(f"floatframe_fmu.dll: {WINDOWS.stat().st_size / 1e6:.2f} MB, {', '.join(sorted(needed))}")
        self.assertLessEqual(needed, OF_WINDOWS)
        self.assertLess(WINDOWS.stat().st_size, LARGEST)

    def test_shows_the_functions_of_fmi_alone(self):
        shown = exported_by_dll(self.listing)
        self.assertLessEqual(OF_FMI, shown)
        self.assertEqual({name for name in shown if not re.match(r"fmi[23]", name)}, set())


if __name__ == "__main__":
    unittest.main()
