"""The binaries inside FMUs need nothing of the machine that they run on, and show the functions of FMI alone."""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
import zipfile

BUILD = pathlib.Path(os.environ["FLOATFRAME_BINARY"]).parent
ROOT = pathlib.Path(__file__).resolve().parents[2]
LINUX = BUILD / "lib" / "fmu" / "linux64" / "floatframe_fmu.so"
WINDOWS = BUILD / "lib" / "fmu" / "win64" / "floatframe_fmu.dll"
MASTER = ROOT / "tests" / "fmi" / "master.c"
CAR = ROOT / "examples" / "quarter_car" / "quarter_car.yaml"
# glibc of Debian 12: what a machine needs at least is printed.
NEWEST_GLIBC = (2, 36)
LARGEST = 12.5e6  # [byte]
OF_FMI = {"fmi2Instantiate", "fmi2DoStep", "fmi2SerializeFMUstate", "fmi3InstantiateCoSimulation", "fmi3DoStep",
          "fmi3SerializeFMUState"}
OF_WINDOWS = {"kernel32.dll", "msvcrt.dll"}


def output_of(*command):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout


def version_of(text):
    return tuple(int(number) for number in text.split("."))


def add_c_library(root, *programs):
    """The files of the C library that these need, and no others, in a root of their own."""
    for program in programs:
        for line in output_of("ldd", program).splitlines():
            if match := re.search(r"(/\S+/(?:libc|libm|libdl|libpthread|ld-linux-x86-64)\.so\.\d+)", line):
                place = root / match.group(1).lstrip("/")
                place.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(match.group(1), place)


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
            add_c_library(root, root / "load", LINUX)
            done = subprocess.run(["/load", "/fmu.so"], capture_output=True, text=True, preexec_fn=lambda: os.chroot(root), cwd="/")
            self.assertEqual((done.returncode, done.stdout), (0, "2.0 3.0\n"), done.stderr)


class Master(unittest.TestCase):
    """The master in C99 of tests/fmi runs FMUs on a system that has the C library alone, and on Windows."""

    def setUp(self):
        if not LINUX.exists():
            self.skipTest("the runtime of FMUs was not built (FLOATFRAME_FMU)")
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)

    def unzipped(self, version):
        """Token and count of outputs of an FMU that is in the folder `fmu` now."""
        output_of(os.environ["FLOATFRAME_BINARY"], "fmu", CAR, "-o", self.root / "car.fmu", "--fmi", version)
        with zipfile.ZipFile(self.root / "car.fmu") as archive:
            archive.extractall(self.root / "fmu")
        described = ElementTree.parse(self.root / "fmu" / "modelDescription.xml").getroot()
        references = [int(v.get("valueReference")) for v in described.find("ModelVariables")]
        return (described.get("guid") or described.get("instantiationToken"),
                sum(0x20000 <= reference < 0x30000 for reference in references))

    def rows(self, done):
        self.assertEqual(done.returncode, 0, done.stderr)
        return [[float(number) for number in line.split(",")] for line in done.stdout.splitlines()]

    def compiled(self, *command):
        subprocess.run([*command, "-I", ROOT / "src", MASTER], check=True)

    def test_bare_system(self):
        if os.geteuid() != 0:
            self.skipTest("another root needs a superuser")
        compiler = shutil.which("gcc") or shutil.which("cc")
        self.compiled(compiler, "-o", self.root / "master", "-x", "c", "-std=c99", "-w")
        add_c_library(self.root, self.root / "master", LINUX)
        for version, resources, folder in (("2", "file:///fmu/resources", "linux64"), ("3", "/fmu/resources/", "x86_64-linux")):
            token, count = self.unzipped(version)
            words = [f"/fmu/binaries/{folder}/quarter_car.so", resources, token, "0.5", "0.01", str(count)]
            bare = subprocess.run(["/master", *words], capture_output=True, text=True, cwd="/", env={},
                                  preexec_fn=lambda: os.chroot(self.root), check=False)
            rows = self.rows(bare)
            self.assertEqual(len(rows), 51)
            shutil.rmtree(self.root / "fmu")

    def test_wine_differs_in_the_last_digits(self):
        wine = next((w for w in (shutil.which("wine64"), "/usr/lib/wine/wine64", shutil.which("wine")) if w and os.path.exists(w)),
                    None)
        if not WINDOWS.exists() or wine is None:
            self.skipTest("the runtime for Windows was not built, or there is no Wine (scripts/install_packages.sh --fmu)")
        self.compiled("x86_64-w64-mingw32-gcc", "-o", self.root / "master.exe", "-w")
        self.compiled(shutil.which("gcc") or shutil.which("cc"), "-o", self.root / "master", "-x", "c", "-std=c99", "-w")
        token, count = self.unzipped("3")
        words = [token, "0.5", "0.01", str(count)]
        fmu = self.root / "fmu"
        here = self.rows(subprocess.run([self.root / "master", fmu / "binaries/x86_64-linux/quarter_car.so",
                                         f"{fmu}/resources/", *words], capture_output=True, text=True, check=False))
        environment = dict(os.environ, WINEPREFIX=str(self.root / "wine"), WINEDEBUG="-all")
        there = self.rows(subprocess.run([wine, self.root / "master.exe", f"Z:{fmu}/binaries/x86_64-windows/quarter_car.dll",
                                          f"Z:{fmu}/resources/", *words], capture_output=True, text=True, env=environment,
                                         check=False))
        self.assertEqual(len(here), len(there))
        difference = max(abs(a - b) for row, other in zip(here, there) for a, b in zip(row, other))
        size = max(abs(number) for row in here for number in row[1:])
        print(f"Windows differs by {difference / size:.1e} of the largest output")
        self.assertLess(difference, 1e-9 * size)


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
