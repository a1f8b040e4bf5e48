#!/usr/bin/env python3
"""Counts the faulty inputs of finite-element readers in the tests: sentences with their place.

    scripts/count_faulty_decks.py [--least N]

Each counts that a test of tests/decks expects as "FILE:LINE: sentence" or, where the test puts the
name of the file before it, "LINE: sentence"; equal ones of a file count once. Sentences of at least
four words; what sounds like a note does not count. Prints the count by file of tests and in all; with --least, exit code 1 if they are fewer.
"""
import argparse
import pathlib
import re
import sys

LITERALS = re.compile(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*')
PART = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
PLACED = re.compile(r'^(?:[\w./-]+\.\w+:)?[1-9]\d*: (?=\S+ \S+ \S+ \S+)')

NOTE = re.compile(r'ignored|left out|taken|of GENERATE')


def sentences(text):
    """The distinct sentences with a place among the literals of a source."""
    text = re.sub(r'^\s*(?://|#).*$', '', text, flags=re.M)
    found = set()
    for match in LITERALS.finditer(text):
        whole = ''.join(PART.findall(match.group()))
        if PLACED.match(whole) and not NOTE.search(whole) and '\\n' not in whole:
            found.add(whole)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--least', type=int, default=0)
    parser.add_argument('--show', action='store_true', help='print the sentences')
    options = parser.parse_args()
    folder = pathlib.Path(__file__).resolve().parent.parent / 'tests' / 'decks'
    total = 0
    for file in sorted(folder.glob('*_test.cpp')):
        found = sentences(file.read_text(encoding='utf-8'))
        if not found:
            continue
        total += len(found)
        print(f'{len(found):6}  {file.name}')
        if options.show:
            for sentence in sorted(found):
                print(f'        {sentence}')
    print(f'{total:6}  in all')
    return 1 if total < options.least else 0


if __name__ == '__main__':
    sys.exit(main())
