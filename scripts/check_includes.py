#!/usr/bin/env python3
"""Checks that the rooms of Floatframe use each other only in the directions the architecture allows.

Usage: check_includes.py [path to src/floatframe]
Exit code 1 and one line a fault (file:line: sentence) when an arrow points the wrong way.
"""
import pathlib
import re
import sys

# room -> rooms it may include. CONTRIBUTING.md draws the same picture.
ALLOWED = {
    "core": set(),
    "math": {"core"},
    "fe": {"core", "math"},
    "body": {"core", "math", "fe"},
    "reduction": {"core", "math", "fe", "body"},
    "inertia": {"core", "math", "body"},
    "formats": {"core", "math", "fe", "body", "reduction"},
    "model": {"core", "math", "fe", "reduction", "body", "inertia"},
    "formulation": {"core", "math", "body", "inertia", "model"},
    "integrator": {"core", "math", "body", "inertia", "model", "formulation"},
    "simulation": {"core", "math", "body", "inertia", "model", "formulation", "integrator"},
    "io": {"core", "math", "fe", "reduction", "body", "inertia", "model", "formulation", "integrator", "simulation",
           "formats"},
    "realtime": {"core", "math", "body", "inertia", "model", "formulation", "integrator", "simulation"},
    "sweep": {"core", "math", "fe", "reduction", "body", "inertia", "model", "formulation", "integrator",
              "simulation", "io", "formats"},
    "apps": {"core", "math", "fe", "reduction", "body", "inertia", "model", "formulation", "integrator",
             "simulation", "realtime", "io", "sweep", "formats"},
}

INCLUDE = re.compile(r'\s*#\s*include\s*["<]floatframe/([^/">]+)/')


def faults(root):
    for path in sorted(root.rglob("*")):
        if path.suffix not in (".hpp", ".cpp", ".h", ".inl"):
            continue
        room = path.relative_to(root).parts[0]
        if room not in ALLOWED:
            yield f"{path}:1: the folder '{room}' is not a room; add it to ALLOWED in {pathlib.Path(__file__).name}"
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
            match = INCLUDE.match(line)
            if match and match.group(1) != room and match.group(1) not in ALLOWED[room]:
                yield (f"{path}:{number}: '{room}' must not use '{match.group(1)}'; "
                       f"it may use {', '.join(sorted(ALLOWED[room])) or 'nothing'}")


def main():
    default = pathlib.Path(__file__).resolve().parent.parent / "src" / "floatframe"
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else default
    if not root.is_dir():
        print(f"{root} is not a folder", file=sys.stderr)
        return 1
    found = list(faults(root))
    for fault in found:
        print(fault, file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
