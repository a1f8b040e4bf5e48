#!/usr/bin/env python3
"""Words that an engineer would have to translate, and what to write instead, in sources, tests, messages and documents; and long
sentences of documents: more than 35 words between full stops, colons and semicolons, outside tables, blocks and formulas.

Usage: check_words.py [root of the project]"""
import pathlib
import re
import sys

WORDS = {
    r"passed over": "ignored",
    r"pass(es)? it over": "ignores it",
    r"reckon": "compute; does not overflow",
    r"spoken of": "reported",
    r"told apart": "distinguished",
    r"of our own": "Floatframe's",
    r"stays? open by": "has a gap of",
    r"handed_over|let_out": "flush",
    r"made_nodes": "generated_nodes",
    r"what one sees": "the frame or the quantity",
    r"\bgapes?\b": "opens; leaves a gap",
    r"\bdefeats?\b": "prevents",
}
FOLDERS = {"src": (".cpp", ".hpp"), "tests": (".cpp", ".hpp", ".py"), "python": (".py", ".cpp"), "scripts": (".py", ".sh"),
           "bench": (".py", ".cpp", ".hpp"), "docs": (".md",), "viewer/src": (".ts",), "examples": (".md", ".py", ".yaml")}


LONGEST = 35
PROSE_END = re.compile(r"[^.:;!?]*(?:[.:;!?](?!\s)[^.:;!?]*)*(?:[.:;!?](?=\s)|$)")


def blank(match):
    return re.sub(r"[^\n]", " ", match.group())


def paragraphs(text):
    """(first line, text) of each paragraph or item of a list."""
    for kind in (r"```.*?```", r"\$\$.*?\$\$", r"<!--.*?-->"):
        text = re.sub(kind, blank, text, flags=re.DOTALL)
    lines = ["" if line.startswith(("|", "#")) else line for line in text.split("\n")] + [""]
    first, held = 0, []
    for k, line in enumerate(lines):
        if held and (not line.strip() or re.match(r"\s*(-|\d+\.) ", line)):
            yield first + 1, re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", "\n".join(held))
            held = []
        if line.strip():
            first = first if held else k
            held.append(line)


def long_sentences(text):
    """(line, number of words, beginning)"""
    for first, prose in paragraphs(text):
        for match in PROSE_END.finditer(prose):
            sentence = match.group()
            words = [word for word in sentence.split() if re.search(r"\w", word)]
            if len(words) > LONGEST:
                before = match.start() + len(sentence) - len(sentence.lstrip())
                yield first + prose.count("\n", 0, before), len(words), " ".join(words[:8])


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    files = [root / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")]
    for folder, endings in FOLDERS.items():
        files += [f for f in sorted((root / folder).rglob("*")) if f.suffix in endings and f.name != "check_words.py"
                  and "node_modules" not in f.parts]
    found = 0
    for file in files:
        text = file.read_text(encoding="utf-8", errors="replace")
        for word, better in WORDS.items():
            for match in re.finditer(word, text, re.IGNORECASE):
                line = text.count("\n", 0, match.start()) + 1
                print(f"{file.relative_to(root)}:{line}: '{match[0]}': {better}")
                found += 1
        if file.suffix == ".md":
            for line, words, begin in long_sentences(text):
                print(f"{file.relative_to(root)}:{line}: a sentence of {words} words, at most {LONGEST}: '{begin} ...'")
                found += 1
    print(f"{found} words of the list or sentences that are too long in {len(files)} files")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
