#!/usr/bin/env python3
"""A wheel in a fresh environment: what it loads, how long it takes to import, the Iltis, the tests of python/tests.

Usage: check_wheel.py dist/floatframe-*.whl
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Of the system: the C library, which is as old as the wheel's name says, or newer.
SYSTEM = ("ld-linux", "libc.", "libdl.", "libm.", "libpthread.", "librt.", "libutil.", "libresolv.", "libnss_")
LOOK = """
import json, os, time
import numpy
start = time.perf_counter()
import floatframe as ff
imported = time.perf_counter() - start
res = ff.run(ff.Model.load(ff.example("iltis")), step=0.01)
libraries = sorted({line.split()[-1] for line in open("/proc/self/maps") if ".so" in line})
print(json.dumps({"import": imported, "info": ff.build_info(), "z": res["chassis.z"][-1], "libraries": libraries}))
"""


def main():
    wheel = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        python = pathlib.Path(folder, "bin", "python")
        environment = {"PATH": f"{folder}/bin:/usr/bin:/bin", "HOME": folder, "MPLBACKEND": "agg"}

        def run(*arguments, **options):
            return subprocess.run([str(a) for a in arguments], check=True, text=True, cwd=folder, env=environment, **options)

        subprocess.run([sys.executable, "-m", "venv", folder], check=True)
        run(python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", wheel)
        told = [json.loads(run(python, "-B", "-c", LOOK, capture_output=True).stdout) for _ in range(3)]
        foreign = [path for path in told[0]["libraries"] if not path.startswith(folder) and not path.startswith(sys.base_prefix)
                   and not os.path.basename(path).startswith(SYSTEM) and "/lib-dynload/" not in path and "libpython" not in path]
        # What the interpreter itself is linked with is the system's.
        plain = run(python, "-c", "import bz2, hashlib, lzma, numpy, zlib; print(open('/proc/self/maps').read())", capture_output=True).stdout
        foreign = [path for path in foreign if path not in plain]
        print(json.dumps(told[0]["info"], indent=1))
        print(f"import on top of numpy's: {min(t['import'] for t in told):.3f} s")
        print(run(folder + "/bin/floatframe", "--version", capture_output=True).stdout.strip())
        if foreign:
            print(f"the wheel uses libraries of the system: {', '.join(foreign)}", file=sys.stderr)
            return 1
        run(python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "pytest", "pandas", "matplotlib")
        return subprocess.run([python, "-B", "-m", "pytest", "-q", "-p", "no:cacheprovider", "--rootdir", folder, ROOT / "python/tests"],
                              cwd=folder, env=environment).returncode


if __name__ == "__main__":
    sys.exit(main())
