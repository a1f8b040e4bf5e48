#!/usr/bin/env python3
"""Where the time of a build went: rooms, then the twenty dearest sources, from ninja's log.

    scripts/build_times.py [BUILD_FOLDER]          default: build

Ninja's log holds the wall-clock time of the last run of each command. With as many jobs as
processors and nothing else running that is close to processor time; with a compiler cache it is not.
A source that is compiled together with others is shown as its batch, with the batch's first source.
"""
import collections
import pathlib
import re
import sys

DEAREST = 20


def commands(log):
    """Output file -> seconds, of the last run of each command."""
    lines = log.read_text().splitlines()
    if not lines or not lines[0].startswith("# ninja log v"):
        raise SystemExit(f"{log}: no log of ninja")
    seconds = {}
    for line in lines[1:]:
        start, end, _, output, *_ = line.split("\t")
        seconds[output] = (int(end) - int(start)) / 1000
    return seconds


def place(output, folder):
    """The room, and the source or the batch of sources, of an object file."""
    found = re.search(r"CMakeFiles/([^/]+)\.dir/(.+)\.(?:o|gch)$", output)
    if not found:
        return "linking", pathlib.Path(output).name
    target, source = found.groups()
    if source.startswith("cmake_pch"):
        return "precompiled headers", f"precompiled headers of {target}"
    batch = folder / output.split(".dir/")[0]
    unity = pathlib.Path(f"{batch}.dir") / source.removesuffix(".o")
    if source.startswith("Unity/") and unity.exists():
        first = re.findall(r'#include "[^"]*?([^/"]+/[^/"]+)"', unity.read_text())
        return target, f"{target}: {first[0]} and {len(first) - 1} more" if first else source
    return target, f"{target}: " + "/".join(pathlib.Path(source).parts[-2:])


def table(title, rows):
    print(title)
    for seconds, name in rows:
        print(f"{seconds:9.1f} s  {name}")
    print()


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "build")
    log = folder / ".ninja_log"
    if not log.exists():
        raise SystemExit(f"{folder}: not built with ninja (no .ninja_log)")
    built = re.findall(r"^build ([^:|]+)", (folder / "build.ninja").read_text(), re.MULTILINE)
    outputs = {output for line in built for output in line.split()}
    rooms, sources = collections.Counter(), []
    for output, seconds in commands(log).items():
        if output not in outputs:  # of an earlier layout of the build
            continue
        if not re.search(r"\.(o|gch|so[.0-9]*)$|_tests$|^floatframe$", output):
            continue
        room, source = place(output, folder)
        rooms[room] += seconds
        sources.append((seconds, source))
    if not sources:
        raise SystemExit(f"{log}: nothing was built")
    table("By target", ((s, room) for room, s in rooms.most_common()))
    table(f"The {DEAREST} dearest", sorted(sources, reverse=True)[:DEAREST])
    print(f"{sum(rooms.values()):9.1f} s  in all, {len(sources)} commands")


if __name__ == "__main__":
    main()
