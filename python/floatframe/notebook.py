"""Pages in notebooks."""

from __future__ import annotations

import html
from pathlib import Path


class Page:
    """An HTML page that a notebook shows in a separate frame; `html` is its text."""

    def __init__(self, text: str, height: int) -> None:
        self.html = text
        self.height = int(height)

    def _repr_html_(self) -> str:
        # As a separate document: styles and scripts of page and notebook do not interfere.
        return (
            f'<iframe srcdoc="{html.escape(self.html, quote=True)}" style="width:100%;height:{self.height}px;border:0" '
            f'sandbox="allow-scripts allow-same-origin allow-downloads"></iframe>'
        )

    def write(self, path: str | Path) -> None:
        """Writes the page to a file."""
        Path(path).write_text(self.html, encoding="utf-8")

    def __repr__(self) -> str:
        return f"<floatframe.Page of {len(self.html)} characters; a notebook shows it, write(path) keeps it>"
