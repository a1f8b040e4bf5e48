#!/usr/bin/env python3
"""Checks that the rooms of Floatframe use each other only in the directions the architecture allows.

Files beside the rooms, src/floatframe/*.hpp, are the public headers: what they reach includes nothing but the standard
library and Eigen, and stays within PUBLIC. Rooms do not include them.

Usage: check_includes.py [path to src/floatframe]
Exit code 1 and one line per error (file:line: sentence) when an arrow points the wrong way.
"""
import pathlib
import re
import sys

# room -> rooms it may include. CONTRIBUTING.md draws the same picture.
FE = {"core", "math", "fe"}
DYNAMICS = {"core", "math", "formulas", "roads", "body", "inertia", "description", "model", "formulation", "integrator"}
RUNS = {"loops", "tangents", "start", "reactions", "stepping", "run"}
# The library floatframe_tools (src/CMakeLists.txt). Only the command line uses it besides.
TOOLS = {"advice", "history", "results", "page", "export", "realtime", "sweep", "validation", "vehicle", "analyses", "fmu"}
HEADERS_OF_TOOLS = {"analysis.hpp", "fmu.hpp", "history.hpp", "realtime.hpp", "sweep.hpp", "floatframe.hpp"}
ALLOWED = {
    "core": set(),
    "math": {"core"},
    "formulas": {"core", "math"},
    "roads": {"core", "math", "formulas"},
    "fe": {"core", "math"},
    "body": FE,
    "reduction": FE | {"body"},
    "inertia": {"core", "math", "body"},
    # A room of its own for each format. `formats` itself holds the list of finite-element files (fe_file.hpp).
    "formats": FE | {"formats/gmsh", "formats/matrices", "formats/text", "formats/written"},
    "formats/text": {"core", "fe"},
    "formats/gmsh": FE | {"formats", "formats/text"},
    "formats/nastran": FE | {"formats/text"},
    "formats/matrices": FE | {"formats", "formats/text", "formats/nastran"},
    "formats/sid": {"core", "math", "body", "formats/text"},
    "formats/body_file": {"core", "math", "body", "reduction"},
    "formats/geometry": {"core", "math", "formats/text"},
    "formats/matlab": {"core", "math"},
    "formats/vtk": {"core", "math"},
    "formats/written": FE | {"formats", "formats/gmsh", "formats/vtk"},
    # A library of its own, which no other room may include.
    "decks": FE | {"formats", "formats/nastran", "formats/text", "formats/written"},
    "parts": FE | {"body", "reduction", "formats", "formats/body_file", "formats/sid", "formats/text", "formats/written"},
    # Formulas of tyres, and readers of their files.
    "tyres": {"core", "math"},
    # What the user says, and its checks.
    "description": FE | {"formulas", "roads", "body", "reduction"},
    "model": FE | {"formulas", "roads", "body", "reduction", "inertia", "description", "tyres"},
    # Models in one file: what they are read and built with knows neither finite elements nor their reduction.
    "packed": {"core", "math", "formulas", "roads", "body", "description", "model"},
    "formulation": {"core", "math", "formulas", "roads", "body", "inertia", "description", "model"},
    "integrator": {"core", "math", "formulas", "roads", "body", "inertia", "description", "model", "formulation"},
    # From the model at rest to results: each uses those before it.
    "loops": DYNAMICS,
    "tangents": DYNAMICS | {"loops"},
    "start": DYNAMICS | {"loops", "tangents"},
    "reactions": DYNAMICS | {"start"},
    "stepping": DYNAMICS | {"loops", "tangents", "start", "reactions"},
    "run": DYNAMICS | {"loops", "start", "stepping"},
    "linear": DYNAMICS | RUNS,
    "rotors": DYNAMICS | RUNS | {"linear"},
    "advice": DYNAMICS | RUNS | {"linear"},
    "yaml": {"core", "math", "formulas"},
    "model_file": FE | {"packed", "formulas", "roads", "body", "reduction", "description", "model", "formats/body_file", "formats/geometry", "formats/matlab", "formats/sid", "parts",
                   "yaml"},
    # floatframe.h: a client of Simulation, and of the readers of files in one source (open_model_file.cpp).
    "c_interface": {"core", "description", "model", "loops", "stepping", "packed", "model_file"},
    "history": DYNAMICS | RUNS,
    "results": DYNAMICS | RUNS,
    "page": DYNAMICS | RUNS | {"linear", "rotors", "advice", "history", "results"},
    "export": DYNAMICS | RUNS | {"history", "page", "results", "formats/body_file", "formats/vtk"},
    "realtime": DYNAMICS | RUNS,
    "sweep": DYNAMICS | RUNS | {"yaml", "model_file", "history", "page", "results"},
    "validation": DYNAMICS | RUNS | {"linear", "yaml", "page", "results"},
    "vehicle": DYNAMICS | RUNS | {"results"},
    "analyses": DYNAMICS | RUNS | {"linear", "rotors", "advice", "page", "results", "formats/body_file", "formats/matlab", "model_file"},
    "fmu": {"core", "math", "body", "inertia", "description", "formulas", "model", "packed", "page", "formats/body_file", "stepping"},
    "apps": DYNAMICS | FE | RUNS | {"reduction", "formats/body_file", "formats/sid", "formats/text", "parts", "linear", "realtime",
                             "model_file", "history", "page", "results", "export", "analyses", "sweep", "validation", "vehicle", "packed", "fmu"},
    # The benchmarks of the program, in the folder bench of the project, which no other room may include.
    "bench": DYNAMICS | FE | RUNS | {"reduction", "model_file", "apps"},
}

# Rooms, and single files, that public headers may reach.
PUBLIC = {"core", "math", "formulas", "roads", "body", "inertia", "fe", "reduction", "formats", "formats/body_file", "formats/sid", "formats/vtk", "parts", "description",
          "model", "model_file", "packed",
          "formulation/counts.hpp", "loops", "tangents", "start", "stepping", "run", "linear", "rotors", "advice", "history", "page", "results", "export/run_scene.hpp", "analyses", "realtime", "sweep", "fmu"}
FOREIGN = re.compile(r'\s*#\s*include\s*<(?!floatframe/)(?!Eigen/)([^>]*[./-][^>]*)>')
# What programs and modules beside the library see of it.
OUTSIDE = {"main": {"apps/command_line.hpp", "bench/bench_command.hpp"}, "mpi": {"sweep/ranks.hpp"},
           "mumps": {"math/sparse_engine.hpp"}}

# Comments of installed headers send nobody to a header that is not installed.
NAMED = re.compile(r"^(?!\s*#).*?\b([a-z_]+\.hpp)")
INCLUDE = re.compile(r'\s*#\s*include\s*["<]floatframe/([^">]+)[">]')
DECLARED = re.compile(r"(?:class|struct) (\w+);")
DEFINED = re.compile(r"^(?:class|struct) (\w+)\b[^;{]*\{", re.M)


def room_of(path):
    """The room of a file named from src/floatframe: `formats/abaqus`, or the first folder where it has no rooms within."""
    folders = path.split("/")[:-1]
    nested = "/".join(folders[:2])
    return nested if nested in ALLOWED else folders[0] if folders else ""


def included(path):
    """Line number and name from src/floatframe of each of our headers that a file includes."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        if match := INCLUDE.match(line):
            yield number, match.group(1)


QUOTED = re.compile(r'\s*#\s*include\s*"([^"]*)"')


def odd_paths(path):
    """What in quotes is not one of our headers by its full name, and so would not be seen by the other checks."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        if (match := QUOTED.match(line)) and (not match.group(1).startswith("floatframe/") or ".." in match.group(1)):
            yield (f"{path}:{number}: found \"{match.group(1)}\", expected \"floatframe/...\" for a header of ours, <...> "
                   "for any other")


def errors_outside(root):
    for folder, allowed in OUTSIDE.items():
        for path in sorted((root.parent / folder).glob("*.[ch]pp")):
            yield from odd_paths(path)
            for number, header in included(path):
                if header not in allowed:
                    yield f"{path}:{number}: '{folder}' must not use {header}; it may use {', '.join(sorted(allowed))}"


def errors_of_python(root):
    """The Python package is a program like any other: it sees the public headers."""
    for path in sorted((root.parent.parent / "python" / "src").glob("*.[ch]pp")):
        for number, header in included(path):
            if "/" in header:
                yield f"{path}:{number}: the Python package must not use {header}; it may use the public headers, <floatframe/NAME.hpp>"


def errors_of_table():
    """A program that steps a model does not link the tools, so that no room of the library uses them."""
    for room, allowed in ALLOWED.items():
        if allowed & TOOLS and room not in TOOLS | {"apps", "bench"}:
            yield f"{__file__}:1: '{room}' must not be allowed {', '.join(sorted(allowed & TOOLS))}: of the library floatframe_tools"


def public_errors(root):
    reached = {path.name: path.name for path in sorted(root.glob("*.hpp"))}  # file: the public header it is reached from
    waiting = list(reached)
    while waiting:
        name = waiting.pop()
        if not (root / name).is_file():
            continue  # written by CMake
        for number, line in enumerate((root / name).read_text(encoding="utf-8").splitlines(), start=1):
            if (match := FOREIGN.match(line)) and match.group(1) != "time.h":
                yield (f"{root / name}:{number}: the public header {reached[name]} must not reach <{match.group(1)}>: "
                       "only the standard library and Eigen")
            if (match := NAMED.match(line)) and not (root / match.group(1)).is_file():
                yield (f"{root / name}:{number}: a comment names {match.group(1)}, which is not installed; the public header "
                       f"{reached[name]} reaches this one")
        for number, used in included(root / name):
            if "/" in used and used not in PUBLIC and room_of(used) not in PUBLIC:
                yield f"{root / name}:{number}: the public header {reached[name]} must not reach {used}"
            elif "/" not in name and name not in HEADERS_OF_TOOLS and (room_of(used) in TOOLS or used in HEADERS_OF_TOOLS):
                yield f"{root / name}:{number}: the public header {name} is of floatframe, and must not use {used} of floatframe_tools"
            elif used not in reached:
                reached[used] = reached[name]
                waiting.append(used)


def rooms_of_types(root):
    """For each type of the rooms: the rooms that define one of this name."""
    found = {}
    for path in root.rglob("*.hpp"):
        room = room_of(path.relative_to(root).as_posix())
        for name in DEFINED.findall(path.read_text(encoding="utf-8")):
            found.setdefault(name, set()).add(room)
    return found


def errors_of_declarations(path, room, rooms):
    """A type that is declared but not included is used as well."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        declared = DECLARED.match(line)
        used = rooms.get(declared.group(1), set()) if declared else set()
        if used and not used & (ALLOWED[room] | {room}):
            yield f"{path}:{number}: '{room}' must not declare {declared.group(1)} of '{', '.join(sorted(used))}'"


def errors(root):
    types = rooms_of_types(root)
    yield from errors_of_table()
    yield from public_errors(root)
    yield from errors_outside(root)
    yield from errors_of_python(root)
    bench = root.parent.parent / "bench" / "floatframe"
    for path in sorted([*root.rglob("*"), *bench.rglob("*")]):
        if path.suffix not in (".hpp", ".cpp", ".h", ".inl") or path.parent == root:
            continue
        room = room_of(path.relative_to(bench if bench in path.parents else root).as_posix())
        if room not in ALLOWED:
            yield f"{path}:1: the folder '{room}' is not a room; add it to ALLOWED in {pathlib.Path(__file__).name}"
            continue
        yield from odd_paths(path)
        yield from errors_of_declarations(path, room, types)
        for number, header in included(path):
            used = room_of(header)
            if not used:
                yield f"{path}:{number}: '{room}' must not use the public header {header}; include the header of its room"
            elif used != room and used not in ALLOWED[room]:
                yield (f"{path}:{number}: '{room}' must not use '{used}'; "
                       f"it may use {', '.join(sorted(ALLOWED[room])) or 'nothing'}")


def main():
    default = pathlib.Path(__file__).resolve().parent.parent / "src" / "floatframe"
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else default
    if not root.is_dir():
        print(f"{root} is not a folder", file=sys.stderr)
        return 1
    found = list(errors(root))
    for error in found:
        print(error, file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
