#!/usr/bin/env python3
"""Checks that functions, files and lines stay small enough to be read in one go.

Usage: check_sizes.py [root of the project]
Exit code 1 and one line for each function, file or line that is too long (file:line: sentence). Sources are formatted, so a
function ends at the closing brace in the column where its first line begins.
"""
import pathlib
import re
import sys

LONGEST_FUNCTION = 80
LONGEST_LINE = 100  # of C++, columns
# folder -> lines of a file
LONGEST_FILE = {"src": 400, "bench/floatframe": 400, "tests": 450, "python": 450}
# What opens a block and is no function.
OTHER = re.compile(r"^(namespace|class|struct|union|enum|extern|if|for|while|switch|do|else|try|catch|case|default|using|typedef|static_assert)\b")


def functions(lines):
    """(first line, name, number of lines) of each function; what is within a function counts for it."""
    head, inside = [], None
    for number, line in enumerate(lines):
        text = line.split("//")[0].strip()
        indent = len(line) - len(line.lstrip())
        if inside is not None:
            first, column, name = inside
            if indent == column and text.startswith("}"):
                yield first + 1, name, number - first + 1
                head, inside = [], None
        elif not text or text.startswith("#") or text.endswith((";", "}", "public:", "private:", "protected:")):
            head = []
        else:
            head.append(number)
            if text.endswith("{"):
                words = " ".join(lines[k].split("//")[0].strip() for k in head)
                words = re.sub(r"^template <[^()]*?> (requires \S+ )?", "", words)
                first, head = head[0], []
                call = re.search(r"([\w:~]+|operator\S+?)\(", words)
                if call and "=" not in words[:call.start()] and not OTHER.match(words):
                    inside = first, len(lines[first]) - len(lines[first].lstrip()), call.group(1)


def errors(root):
    for folder in ("src", "bench", "tests", "examples", "fuzz", "python"):
        for path in sorted((root / folder).rglob("*.[ch]pp")):
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
                if len(line) > LONGEST_LINE:
                    yield f"{path.relative_to(root)}:{number}: {len(line)} columns; expected at most {LONGEST_LINE}"
    for folder, longest in LONGEST_FILE.items():
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in (".hpp", ".cpp", ".py") or "data" in path.parts:
                continue
            lines = path.read_text(encoding="utf-8").splitlines()
            name = path.relative_to(root)
            if len(lines) > longest:
                yield f"{name}:1: {len(lines)} lines; expected at most {longest}: split it by subject"
            if path.suffix == ".py" or folder not in ("src", "bench/floatframe"):
                continue
            for line, function, count in functions(lines):
                if count > LONGEST_FUNCTION:
                    yield f"{name}:{line}: {function} has {count} lines; expected at most {LONGEST_FUNCTION}"


def main():
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent
    if not (root / "src").is_dir():
        print(f"{root} has no folder src", file=sys.stderr)
        return 1
    found = list(errors(root))
    for error in found:
        print(error, file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
