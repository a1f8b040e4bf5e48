"""Exceptions of Floatframe. All are `floatframe.Error`."""

from __future__ import annotations

import re
import warnings
from collections.abc import Sequence
from typing import Any, NamedTuple


class ErrorEntry(NamedTuple):
    """One error of an input: a sentence, and its location."""

    file: str
    """Model file, or a file that it refers to; empty if there is none."""
    line: int
    """From 1; 0: unknown."""
    column: int
    """From 1; 0: unknown."""
    message: str
    code: str = "wrong_value"
    """Code of the error, independent of the wording, as in `floatframe::ErrorCode`: "unknown_key"."""
    path: str = ""
    """Path of the entity and key in the model, as "joints.knee.axis"; empty if there is none."""

    def __str__(self) -> str:
        place = ":".join(str(part) for part in self[:3] if part)
        return f"{place}: {self.message}" if place else self.message


class Error(Exception):
    """Base class of all errors."""


class InputError(Error, ValueError):
    """The input is invalid: all its errors, with locations, are in `errors`."""

    errors: list[ErrorEntry]

    def __init__(self, errors: Sequence[ErrorEntry] | str) -> None:
        if isinstance(errors, str):
            errors = [ErrorEntry("", 0, 0, errors)]
        super().__init__(list(errors))
        self.errors = list(errors)

    def __str__(self) -> str:
        return "\n".join(str(error) for error in self.errors)


class UnknownNameError(InputError, KeyError):
    """An unknown name of an input, an output, a column or an entity."""


class RunError(Error, RuntimeError):
    """A run or computation cannot be started, in one sentence; `code` as in `ErrorEntry`."""

    def __init__(self, message: str, code: str = "") -> None:
        super().__init__(message, code)
        self.code = code

    def __str__(self) -> str:
        return str(self.args[0])


class OutputError(Error):
    """A file cannot be written."""


class StepError(Error, RuntimeError):
    """A step of a simulation failed; `status`, `where` and `time` [s] give kind, location and time."""

    def __init__(self, message: str, status: str = "", where: str = "", time: float = 0.0) -> None:
        super().__init__(message, status, where, time)
        self.status = status
        self.where = where
        self.time = time

    def __str__(self) -> str:
        return str(self.args[0])


class RunWarning(UserWarning):
    """A run or a simulation left the range of the method, or failed: the sentence of the command line. `limit` is the limit that was
    exceeded ("displacement", "balance", ...; docs/range.md), or "failed"."""

    def __init__(self, message: str, limit: str = "") -> None:
        super().__init__(message, limit)
        self.limit = limit

    def __str__(self) -> str:
        return str(self.args[0])


def tell(message: str, limit: str, above: int = 0) -> None:
    """Gives a warning at the line that has called the package; `above`: functions of the package in between."""
    warnings.warn(RunWarning(worded(message), limit), stacklevel=2 + above)


# Sentences of the command line mention its options: here these are arguments.
_OPTION = re.compile(r"(?<![\w/.'\"-])--([a-z]+(?:-[a-z]+)*)\b")
_HELP = re.compile(r" \(see floatframe \w+ --help\)")
_NAMES = {"threads": "processes", "out": "folder", "vary": "vary", "interface": "interfaces", "marker": "markers"}


def worded(message: str) -> str:
    """A sentence of the C++ library in terms of Python."""
    message = re.sub(r"^--set(?:\.|: )", "", _HELP.sub("", message))
    message = re.sub(r"^--speed: ", "", message)
    message = re.sub(r"^--speed ([^:]+): ", r"joint '\1': ", message)
    return _OPTION.sub(lambda option: _NAMES.get(option[1], option[1].replace("-", "_")), message)


def entry_of(file: str, line: int, column: int, message: str, code: str, path: str) -> ErrorEntry:
    """An error of the C++ library."""
    if line == 0 and file.startswith("--"):  # an option of the command line
        file, message = "", f"{file}: {message}"
    return ErrorEntry(file, line, column, worded(message), code, path)


__all__: list[Any] = ["Error", "ErrorEntry", "InputError", "OutputError", "RunError", "RunWarning", "StepError", "UnknownNameError"]
