"""Models: from files."""

from __future__ import annotations

import os
from typing import Any

from . import _core


def parameter_text(value: object) -> str:
    """A value as the command line's `--set` takes it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return value
    return repr(float(value)) if hasattr(value, "__float__") and not isinstance(value, int) else str(value)


class Model:
    """A multibody system: bodies, joints, forces, outputs. It never changes once it is built, and threads may share it."""

    def __init__(self) -> None:
        self._built: _core.Model | None = None
        self._path: str | None = None
        self._parameters: dict[str, str] = {}

    @classmethod
    def load(cls, path: str | os.PathLike[str], **parameters: Any) -> Model:
        """The model of a file (docs/model-file.md), with other values of its parameters: `Model.load(path, speed=10)`.

        Raises InputError with every error of the file: file, line, column, sentence.
        """
        model = cls()
        model._path = os.fspath(path)
        model._parameters = {name: parameter_text(value) for name, value in parameters.items()}
        model._built = _core.load_model(model._path, list(model._parameters.items()))
        return model

    @property
    def core(self) -> _core.Model:
        """The built model of the C++ library."""
        assert self._built is not None
        return self._built

    @property
    def name(self) -> str:
        return self.core.name

    @property
    def outputs(self) -> dict[str, str]:
        """Units by the names of outputs."""
        return dict(self.core.output_units)

    def __repr__(self) -> str:
        return f"<floatframe.Model '{self.name}'>"
