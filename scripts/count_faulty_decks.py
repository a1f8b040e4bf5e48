#!/usr/bin/env python3
"""Counts the faulty inputs of finite-element readers in the tests: their sentences in tests/sentences/decks.txt, each once.

    scripts/count_faulty_decks.py [--least N]

Prints the count of each code and of all; with --least, exit code 1 if they are fewer.
"""
import argparse
import collections
import pathlib
import sys


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--least", type=int, default=0)
    options = parser.parse_args()
    file = pathlib.Path(__file__).resolve().parent.parent / "tests" / "sentences" / "decks.txt"
    codes = collections.Counter(line.split(":", 1)[0] for line in file.read_text().splitlines())
    for code, count in codes.most_common():
        print(f"{count:6}  {code}")
    total = sum(codes.values())
    print(f"{total:6}  in all")
    return 1 if total < options.least else 0


if __name__ == "__main__":
    sys.exit(main())
