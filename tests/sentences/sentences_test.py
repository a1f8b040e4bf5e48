#!/usr/bin/env python3
"""The sentences of errors that the tests of each room meet, against the golden file of the room: tests/sentences/ROOM.txt.

usage: tests/sentences/sentences_test.py [--write] [folder of the build]

Tests assert the place and the code of an error (support/error_of.hpp); each sentence stands here once, in the first room whose
tests meet it. A line is "code: sentence"; of sentences that differ only in names and numbers it keeps the first. --write makes the
files anew: read the diff as a user would. Literals of other tests that repeat four words or more of these sentences are counted:
at most MOST_REPEATED, so that rewording a sentence changes its file and little else.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
TESTS = HERE.parent
# From what knows nothing of the others to what knows most: a sentence belongs to the first.
ROOMS = ["core", "math", "tyres", "yaml", "roads", "fe", "inertia", "body", "reduction", "formats", "decks", "parts", "model", "model_file",
         "formulation", "loops", "start", "reactions", "stepping", "run", "linear", "rotors", "advice", "history", "analyses", "results", "page", "export", "realtime", "sweep", "apps", "bench"]

MOST_REPEATED = 14
LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
LITERALS = re.compile(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*')


def filter_of(room):
    """Of the tests in files that ask for errors; the others record nothing."""
    asks = {f"support/{h.name}" for h in (TESTS / "support").glob("*.hpp") if "support/error_of.hpp" in h.read_text()}
    asks.add("support/error_of.hpp")
    asks |= {f"{room}/{h.name}" for h in (TESTS / room).glob("*.hpp") if any(a in h.read_text() for a in asks)}
    names = []
    for source in sorted((TESTS / room).glob("*_test.cpp")):
        text = source.read_text()
        if any(f'"{a}"' in text for a in asks):
            names += [f"*{suite}.{name}*" for suite, name in re.findall(r"^TEST(?:_[FP])?\((\w+),\s*(\w+)\)", text, re.MULTILINE)]
    return ":".join(names)


def recorded(program, tests):
    """(code, sentence) of every error, without the names of folders of this run."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "sentences"
        done = subprocess.run([program, "--gtest_brief=1", f"--gtest_filter={tests}"], capture_output=True, text=True,
                              env={**os.environ, "FLOATFRAME_SENTENCES": str(file)}, check=False)
        if done.returncode != 0 and not file.exists():
            sys.exit(f"sentences: {program.name} fails:\n{done.stdout[-2000:]}")
        lines = file.read_bytes().decode(errors="replace").split("\n")[:-1] if file.exists() else []
    for line in set(lines):
        code, sentence = line.split("\t", 1)
        sentence = "".join(c if c.isprintable() else f"\\x{ord(c):02x}" for c in sentence)
        sentence = re.sub(r"\b(?=[0-9a-f]*\d)[0-9a-f]{8}\b", "01234567", sentence)  # checksums
        # Numbers that are rounding, and those of the processor.
        sentence = re.sub(r"(relative modal mass|strain energy differ by) -?[\d.e+-]+", r"\1 1e-16", sentence)
        sentence = re.sub(r"process \d+", "process 1", re.sub(r"this is \d[^)]*\)", "this is another)", sentence))
        for path in str(TESTS.parent), tempfile.gettempdir():
            sentence = sentence.replace(path + "/", "")
        yield code, re.sub(r"floatframe_test_\w+/?", "folder/", sentence)


def form(sentence):
    return re.sub(r"'[^']*'|[-+]?\d[\d.e+-]*|\binf\b|\bnan\b", "0", sentence)


def sentences(build):
    """Room -> lines of its golden file."""
    owner, lines = {}, {}
    for room in ROOMS:
        program, tests = build / "tests" / f"{room}_tests", filter_of(room)
        if not tests or not program.exists():
            continue
        kept = {}
        for code, sentence in sorted(recorded(program, tests)):
            if owner.setdefault(form(sentence), room) == room:
                kept.setdefault((code, form(sentence)), sentence)
        lines[room] = [f"{code}: {sentence}" for (code, _), sentence in sorted(kept.items())]
    return lines


def repeated(lines):
    """Literals of tests that stand in a sentence, or a sentence in them."""
    known = [line.split(": ", 1)[1] for room in lines.values() for line in room if len(line.split()) > 4]
    found = []
    patterns = "tests/*/*.cpp", "tests/*/*.hpp", "tests/*/*_test.py", "python/tests/*.py"
    for source in sorted(file for pattern in patterns for file in TESTS.parent.glob(pattern)):
        for text in {"".join(LITERAL.findall(m.group())) for m in LITERALS.finditer(source.read_text())}:
            if len(text.split()) >= 4 and any(text in sentence or sentence in text for sentence in known):
                found.append(f"{source.relative_to(TESTS.parent)}: {text}")
    return found


def main():
    arguments = [a for a in sys.argv[1:] if a != "--write"]
    program = pathlib.Path(os.environ.get("FLOATFRAME_BINARY", TESTS.parent / "build" / "floatframe"))
    build = pathlib.Path(arguments[0]) if arguments else program.resolve().parent
    wrong = 0
    now = sentences(build)
    if len(again := repeated(now)) > MOST_REPEATED:
        wrong += 1
        print(f"{len(again)} literals of tests repeat sentences, at most {MOST_REPEATED}:", *again, sep="\n")
    for room, lines in now.items():
        file = HERE / f"{room}.txt"
        if "--write" in sys.argv:
            file.write_text("".join(f"{line}\n" for line in lines))
            continue
        known = file.read_text().splitlines() if file.exists() else []
        changes = [f"- {line}" for line in known if line not in set(lines)] + [f"+ {line}" for line in lines if line not in set(known)]
        if changes:
            wrong += 1
            print(f"tests/sentences/{room}.txt:", *changes, sep="\n")
    if wrong:
        print("If these are meant: tests/sentences/sentences_test.py --write, and read the diff.")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
