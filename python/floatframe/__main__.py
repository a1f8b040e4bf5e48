"""The command line, `floatframe` or `python -m floatframe`: the program of the package."""

import os
import sys

from .build import program


def main() -> None:
    path = program()
    os.execv(path, [path, *sys.argv[1:]])


if __name__ == "__main__":
    main()
