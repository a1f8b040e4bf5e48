#!/usr/bin/env python3
"""Instructions of one step, by room: counts of callgrind are independent of the load of the machine.

usage: bench/count_instructions.py [--json FILE] [--case NAME ...] [--growth] [--build DIR] [--jobs N]

Builds the program with line tables in a separate folder (build-profile, AVX2), runs `floatframe bench step` under callgrind,
which counts only inside the function that makes the steps, and sums up by the source file of each function. Also detects
operations that a step must not do: allocate from the heap, copy memory by library calls, call through a pointer (virtual
dispatch). Exit code 1 if there are any, 2 if a tool is missing.

--growth adds full Newton iterations of chains with different numbers of elements, interface nodes, modes and links.
"""
import argparse
import collections
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
COUNTED = "floatframe_counted_steps"

CASES = {
    "iltis, relative, preprocessing": ["iltis", "--coordinates", "relative"],
    "iltis, absolute, preprocessing": ["iltis", "--coordinates", "absolute"],
    "chain of 4, relative, preprocessing": ["chain", "--coordinates", "relative", "--duration", "1"],
    "chain of 4, absolute, preprocessing": ["chain", "--coordinates", "absolute", "--duration", "1"],
}
SHORT = ["chain", "--iterations", "50"]
GROWTH = {
    **{f"elements {n}": SHORT + ["--elements", str(n)] for n in (5, 20, 100, 1000, 16700)},
    **{f"interface nodes {(n + 1) ** 2}": SHORT + ["--bricks", str(n)] for n in (1, 3, 5)},
    **{f"modes {n}": SHORT + ["--modes", str(n), "--elements", "40"] for n in (4, 8, 16, 32, 64)},
    **{f"links {n}": SHORT + ["--links", str(n)] for n in (1, 4, 16, 64, 256)},
}

HEAP = re.compile(r"^_*(libc_)?(malloc|calloc|realloc|free|cfree|memalign|posix_memalign|aligned_alloc)$|^_int_"
                  r"(malloc|free|realloc|memalign)$|^operator (new|delete)|^_Zn[wa]|^_Zd[la]|tcache|^malloc_consolidate")
COPY = re.compile(r"^_*(mem(cpy|move|pcpy)|w?memcpy)")
FILL = re.compile(r"^_*memset")


def fail(message):
    print(f"count_instructions.py: {message}", file=sys.stderr)
    sys.exit(2)


def need(*tools):
    missing = [tool for tool in tools if not shutil.which(tool)]
    if missing:
        fail(f"{' and '.join(missing)} not found; Debian packages: valgrind, binutils, cmake, ninja-build")


def build(folder, jobs):
    """Builds the program with line tables; returns its path."""
    configure = ["cmake", "-S", str(ROOT), "-B", str(folder), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                 "-DFLOATFRAME_HWCAPS=OFF", "-DFLOATFRAME_TESTS=OFF", "-DFLOATFRAME_BENCHMARKS=OFF",
                 "-DCMAKE_CXX_FLAGS=-march=x86-64-v3 -g1"]
    for command in (configure, ["cmake", "--build", str(folder), "--parallel", str(jobs), "--target",
                                "floatframe_program"]):
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            fail(f"the build in {folder} failed:\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
    return folder / "floatframe"


def indirect_calls(library):
    """Addresses of calls through a register or a table; those through the linker's table (%rip) are not."""
    text = subprocess.run(["objdump", "-d", "--no-show-raw-insn", str(library)], capture_output=True, text=True,
                          check=True).stdout
    pattern = re.compile(r"^\s*([0-9a-f]+):\s+(?:notrack )?(?:call|jmp)q?\s+\*(.*)$", re.M)
    calls, jumps = set(), set()
    for match in pattern.finditer(text):
        if "(%rip)" in match[2]:
            continue
        is_call = "call" in match[0]
        # A jump through memory with an offset is a tail call of a virtual function; through a bare register a switch.
        (calls if is_call or "(" in match[2] else jumps).add(int(match[1], 16))
    return calls, jumps


def room_of(path, obj):
    match = re.search(r"src/floatframe/([a-z]+)/", path)
    if match:
        return match[1]
    if "/Eigen/" in path:
        return "Eigen kernels"
    name = pathlib.Path(obj).name
    if name.startswith("libm."):
        return "libm"
    if name.startswith("libc."):
        return "libc"
    if name.startswith("ld-"):
        return "dynamic linker"
    if "/c++/" in path:
        return "C++ library"
    return "other"


class Profile:
    """Parsed callgrind output file (strings and positions not compressed)."""

    def __init__(self, path, library):
        self.rooms = collections.Counter()
        self.inlined_eigen = collections.Counter()
        self.functions = collections.Counter()
        self.calls = collections.Counter()
        self.total = 0
        calls_at, jumps_at = indirect_calls(library)
        self.indirect, self.switches = collections.Counter(), 0
        obj = function = home = here = ""
        homes = {}
        skip = False
        called = None
        with open(path, encoding="utf-8", errors="replace") as file:
            for line in file:
                line = line.rstrip("\n")
                key, equal, value = line.partition("=")
                if equal and key == "ob":
                    obj = value
                elif equal and key == "fl":
                    home = here = value
                elif equal and key in ("fi", "fe"):
                    here = value
                elif equal and key == "fn":
                    function = value
                    here = home
                    homes.setdefault((obj, function), home)
                elif equal and key == "cfn":
                    called = value
                elif equal and key == "calls":
                    if function != COUNTED:
                        self.calls[(function, called)] += int(value.split()[0])
                    skip = True  # the next line is the cost of the call
                elif line[:2] == "0x":
                    if skip:
                        skip = False
                        continue
                    address, _, cost = line.split()
                    cost = int(cost)
                    room = room_of(homes.get((obj, function), home), obj)
                    self.total += cost
                    self.rooms[room] += cost
                    self.functions[(room, function)] += cost
                    if "/Eigen/" in here and room != "Eigen kernels":
                        self.inlined_eigen[room] += cost
                    if obj.endswith(library.name):
                        if int(address, 16) in calls_at and function != COUNTED:
                            self.indirect[function] += cost
                        elif int(address, 16) in jumps_at:
                            self.switches += cost

    def callers(self, pattern):
        """Callers of functions with this name, with counts."""
        found = collections.Counter()
        for (caller, called), n in self.calls.items():
            # Calls inside the allocator count as one call of the allocator.
            if pattern.search(called) and not HEAP.search(caller):
                found[caller] += n
        return found


def shorten(function):
    """A function's name without arguments and template arguments."""
    out, depth = "", 0
    for character in function.replace("(anonymous namespace)::", ""):
        depth += character in "<("
        if depth == 0:
            out += character
        depth -= character in ">)"
    return out.strip() or function


def count(program, library, arguments):
    with tempfile.TemporaryDirectory(prefix="floatframe-count-") as folder:
        out, facts = pathlib.Path(folder) / "callgrind.out", pathlib.Path(folder) / "facts.json"
        command = ["valgrind", "--tool=callgrind", "--dump-instr=yes", "--compress-strings=no", "--compress-pos=no",
                   f"--toggle-collect={COUNTED}", f"--callgrind-out-file={out}", str(program), "bench", "step",
                   *arguments, "--json", str(facts)]
        done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT,
                              env={**os.environ, "LD_BIND_NOW": "1"})
        if done.returncode:
            fail(f"`{' '.join(command)}` failed:\n{done.stderr[-3000:]}")
        return json.loads(facts.read_text()), Profile(out, library)


def figures(facts, profile):
    # Full iterations instead of steps: each counts as a step of one iteration and one factorisation.
    full = facts["full_iterations"]
    steps, iterations = (full, full) if full else (facts["steps"], facts["iterations"])
    per_step = {room: round(n / steps, 1) for room, n in profile.rooms.most_common() if n >= 0.05 * steps}
    return {
        "instructions_per_step": round(profile.total / steps, 1),
        "instructions_per_iteration": round(profile.total / iterations, 1),
        "steps": steps,
        "iterations_per_step": round(iterations / steps, 4),
        "factorizations_per_step": 1.0 if full else round(facts["factorizations"] / steps, 4),
        "rooms": per_step,
        "eigen_inlined": {room: round(profile.inlined_eigen[room] / steps, 1) for room in per_step
                          if profile.inlined_eigen[room]},
        "functions": [{"room": room, "function": shorten(name), "per_step": round(n / steps, 1)}
                      for (room, name), n in profile.functions.most_common(12)],
        "heap_calls": sum(profile.callers(HEAP).values()),
        "memory_copy_calls": sum(profile.callers(COPY).values()),
        "memory_fill_calls": sum(profile.callers(FILL).values()),
        "virtual_calls": sum(profile.indirect.values()),
    }


def show(name, f):
    print(f"\n{name}: {f['instructions_per_step']:,.0f} instructions per step, {f['instructions_per_iteration']:,.0f} an "
          f"iteration ({f['iterations_per_step']:.2f} iterations, {f['factorizations_per_step']:.2f} factorisations)")
    print(f"  {'room':<16} {'a step':>10} {'share':>7}  of which Eigen templates inlined")
    for room, n in f["rooms"].items():
        inlined = f["eigen_inlined"].get(room, 0)
        print(f"  {room:<16} {n:>10,.0f} {n / f['instructions_per_step']:>7.1%}  {inlined:>10,.0f}")
    print("  the largest functions:")
    for entry in f["functions"][:8]:
        print(f"    {entry['per_step']:>10,.0f}  {entry['room']}: {entry['function'][:90]}")
    print(f"  calls in all steps: malloc and free {f['heap_calls']}, memcpy and memmove {f['memory_copy_calls']}, virtual "
          f"{f['virtual_calls']} (memset {f['memory_fill_calls']})")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", type=pathlib.Path, help="write the figures to this file")
    parser.add_argument("--case", action="append", help="only the cases whose name contains this")
    parser.add_argument("--growth", action="store_true", help="also elements, interface nodes, modes and links")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build-profile", help="build folder")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    arguments = parser.parse_args()
    need("valgrind", "objdump", "cmake", "ninja")
    cases = {**CASES, **(GROWTH if arguments.growth else {})}
    if arguments.case:
        cases = {name: what for name, what in {**CASES, **GROWTH}.items() if any(c in name for c in arguments.case)}
        if not cases:
            fail(f"--case: no case is named like {' or '.join(arguments.case)}; there are: "
                 f"{'; '.join({**CASES, **GROWTH})}")
    program = build(arguments.build.resolve(), arguments.jobs)
    library = (arguments.build.resolve() / "lib" / "libfloatframe.so").resolve()
    results, clean, facts = {}, True, {}
    for name, what in cases.items():
        facts, profile = count(program, library, what)
        results[name] = figures(facts, profile)
        show(name, results[name])
        for what, callers in (("through a pointer", profile.indirect), ("of the heap", profile.callers(HEAP)),
                              ("of memcpy", profile.callers(COPY)), ("of memset", profile.callers(FILL))):
            for function, n in callers.most_common(6):
                print(f"    calls {what} in {shorten(function)}: {n}")
        clean = clean and not (results[name]["heap_calls"] or results[name]["virtual_calls"] or
                               results[name]["memory_copy_calls"])
    if arguments.json:
        arguments.json.write_text(json.dumps({"cases": results, "build": facts["build"]}, indent=1) + "\n")
    print(f"\nbuild: {facts['build']}")
    print("No step takes memory from the heap, copies memory by library calls or calls virtual functions." if clean
          else "A step does what it should not: see the counts of calls above.")
    return 0 if clean else 1


if __name__ == "__main__":
    sys.exit(main())
