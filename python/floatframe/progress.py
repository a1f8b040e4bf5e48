"""Progress bars: tqdm's if it is installed, else a line of text."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any

from .arrays import function_or_flag


class Bar:
    """`show` takes the fraction done; None if progress is not shown."""

    show: Callable[[float], object] | None

    def __init__(self, progress: bool | Callable[[float], object]) -> None:
        self._bar: Any = None
        self._text = False
        function_or_flag("progress", progress)
        if callable(progress):
            self.show = progress
        elif not progress:
            self.show = None
        else:
            try:
                from tqdm.auto import tqdm
            except ImportError:
                self._text = True
                self.show = self._write
            else:
                self._bar = tqdm(total=100, unit="%", bar_format="{l_bar}{bar}| {elapsed}<{remaining}")
                self.show = self._update

    def _update(self, fraction: float) -> None:
        self._bar.update(100.0 * fraction - self._bar.n)

    def _write(self, fraction: float) -> None:
        sys.stderr.write(f"\r{100.0 * fraction:3.0f} %")
        sys.stderr.flush()

    def __enter__(self) -> Bar:
        return self

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.close()
        if self._text:
            sys.stderr.write("\n")
