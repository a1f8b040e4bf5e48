#!/usr/bin/env python3
"""Checks that sources which are compiled as one have no name of their own in common.

Many sources of a room - a folder of src/floatframe, bench/floatframe or tests - are compiled as one (FLOATFRAME_UNITY): what stands in
their unnamed namespaces, or is static, then shares one scope. Whether two equal names meet depends on how the batches
fall, and a new file moves them; so no two sources of a room may have one. Functions, variables and types count, functions
whatever their arguments: of two overloads the wrong one could be called. The same alias of a type may be written again.
Elements are compiled one by one.

And that a type in a named namespace of the library is defined once: of two that differ the linker would take the functions
of one for both.

Usage: check_names.py [root of the project]
Exit code 1 and one line for each name that is taken (file:line: sentence).
"""
import pathlib
import re
import sys

ROOMS = ("src/floatframe", "bench/floatframe", "tests")
ALONE = ("src/floatframe/fe/elements",)

# What holds no declarations: comments, raw strings, strings, characters, preprocessor lines.
PROSE = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\\n])+\''
                   r"|^[ \t]*#(?:\\\n|[^\n])*", re.DOTALL | re.MULTILINE)
TOKEN = re.compile(r"[A-Za-z_]\w*|\d[\w.']*|::|\[\[|\]\]|\S")
CLOSING = {"(": ")", "{": "}", "[": "]", "[[": "]]", "<": ">"}


def tokens_of(text):
    """(token, line); of prose only the line ends are left, and a "" for a string."""
    plain = PROSE.sub(lambda m: ('""' if '"' in m.group()[:9] and m.group()[0] not in "/#" else " ") + "\n" * m.group().count("\n"), text)
    return [(m.group(), plain.count("\n", 0, m.start()) + 1) for m in TOKEN.finditer(plain)]


class Source:
    """The declarations of a source at the level of namespaces."""

    def __init__(self, text):
        self.tokens = tokens_of(text)
        self.at = 0
        self.names = {}  # name with its namespaces -> line of the first declaration, of an alias also its text
        self.types = {}  # the same of types that are defined in named namespaces
        self.namespaces([], False)
        self.left_at = self.tokens[self.at][1] if self.at < len(self.tokens) else None  # a brace too many

    def token(self, ahead=0):
        k = self.at + ahead
        return self.tokens[k][0] if k < len(self.tokens) else ""

    def skip(self):
        """Over one token, or over all that it opens."""
        closing = CLOSING.get(self.token()) if self.token() != "<" else None
        self.at += 1
        while closing and self.token() and self.token() != closing:
            self.skip()
        if closing:
            self.at += 1

    def skip_angles(self):
        """Over <...>, and what is in it."""
        self.at += 1
        while self.token() and self.token() != ">":
            self.skip_angles() if self.token() == "<" else self.skip()
        self.at += 1

    def skip_to(self, *ends):
        while self.token() and self.token() not in ends:
            self.skip()

    def namespaces(self, path, unnamed):
        while self.token() and self.token() != "}":
            if self.token() == "namespace" or (self.token() == "inline" and self.token(1) == "namespace"):
                start = self.at
                while self.token() not in ("{", ";", "=", ""):
                    self.at += 1
                named = [t for t, _ in self.tokens[start:self.at] if t not in ("namespace", "inline", "::")]
                if self.token() == "{":
                    self.at += 1
                    self.namespaces(path + named, unnamed or not named)
                else:
                    self.skip_to(";")
                self.at += 1
            elif self.token() == "extern" and self.token(1) == '"':
                self.at += 1
            else:
                self.declaration(path, unnamed)

    def add(self, path, name, line, alias=""):
        self.names.setdefault("::".join(path + [name]), (line, alias))

    def using(self, path, unnamed):
        start = self.at
        self.skip_to(";")
        if self.tokens[start + 2][0] == "=" and unnamed:
            self.add(path, *self.tokens[start + 1], " ".join(t for t, _ in self.tokens[start:self.at]))
        self.at += 1

    def declaration(self, path, unnamed):
        if self.token() == "using":
            self.using(path, unnamed)
            return
        start, specialised = self.at, False
        words = []  # (identifier, line, is it qualified) before what ends the name
        kind = False
        static = False
        while True:
            t = self.token()
            if t == "":
                return
            if t == "template":
                self.at += 1
                specialised = self.token(1) == ">"
                if self.token() == "<":
                    self.skip_angles()
            elif t in ("requires", "alignas", "decltype", "noexcept") and self.token(1) == "(":
                self.at += 1
                self.skip()
                words.append((t, 0, True))
            elif t == "[[":
                self.skip()
            elif t in ("struct", "class", "union", "enum") and not words:
                kind = True
                self.at += 1
            elif t == "static":
                static = True
                self.at += 1
            elif t in ("const", "constexpr", "constinit", "inline", "extern", "typename", "final", "volatile"):
                self.at += 1
            elif t == "<":
                if words and words[-1][0] == "operator":
                    break
                self.skip_angles()
            elif t == ":" and kind:
                break
            elif t in ("(", "=", "{", ";", "[", ","):
                break
            elif re.match(r"[A-Za-z_]", t):
                words.append((t, self.tokens[self.at][1], self.at > start and self.token(-1) == "::"))
                self.at += 1
            else:
                self.at += 1
        is_operator = any(w == "operator" for w, _, _ in words)
        macro = len(words) == 1 and self.token() == "(" and words[0][0].isupper()
        own = words and (unnamed or static) and not (specialised or is_operator or macro or words[-1][2])
        if own:
            self.add(path, words[-1][0], words[-1][1])
        if kind and words and not (unnamed or specialised or words[-1][2]) and self.token() in ("{", ":"):
            self.types.setdefault("::".join(path + [words[-1][0]]), words[-1][1])
        self.finish(kind, path if own else None)

    def finish(self, kind, path):
        """Over what follows the name: arguments, initialisers, a body, further names (kept if there is a path)."""
        while self.token() not in (";", "", "}"):
            if self.token() == "{":
                self.skip()
                if not kind and self.token() not in (",", ";"):
                    return  # a function
            elif self.token() == "=":
                self.skip_to(",", ";")
            elif self.token() == "," and self.token(2) in ("=", "{", ",", ";", "[") and path is not None:
                self.at += 1
                self.add(path, *self.tokens[self.at])
            else:
                self.skip()
        if self.token() == ";":
            self.at += 1


def errors(root):
    for rooms in ROOMS:
        for room in sorted(p for p in (root / rooms).glob("*") if p.is_dir()):
            taken = {}
            for path in sorted(room.rglob("*.cpp")):
                name = path.relative_to(root).as_posix()
                if name.startswith(ALONE) or "/data/" in name:
                    continue
                source = Source(path.read_text(encoding="utf-8"))
                if source.left_at:
                    yield f"{name}:{source.left_at}: found a '}}' that closes nothing; names after it are not checked"
                for entity, (line, alias) in source.names.items():
                    where, same = taken.setdefault(entity, (f"{name}:{line}", alias))
                    if not where.startswith(f"{name}:") and not (alias and alias == same):
                        yield (f"{name}:{line}: '{entity.split('::')[-1]}' is also in {where}; expected a name of its own, since "
                               "sources of a room are compiled as one")


def types_defined_twice(root):
    taken = {}
    for path in sorted((root / "src/floatframe").rglob("*.[ch]pp")):
        name = path.relative_to(root).as_posix()
        for entity, line in Source(path.read_text(encoding="utf-8")).types.items():
            where = taken.setdefault(entity, f"{name}:{line}")
            if not where.startswith(f"{name}:"):
                yield f"{name}:{line}: '{entity}' is also defined in {where}; expected one definition of a type"


def main():
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent
    if not any((root / rooms).is_dir() for rooms in ROOMS):
        print(f"{root} has none of the folders {', '.join(ROOMS)}", file=sys.stderr)
        return 1
    found = [*errors(root), *types_defined_twice(root)]
    for error in found:
        print(error, file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
