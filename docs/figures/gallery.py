"""Draws the pictures of the guide's gallery: ``python docs/figures/gallery.py`` (extras ``plot`` and ``image``).

It runs the blocks of ``docs/gallery.md``; where a picture follows a block, the block's ``fig`` becomes it.
"""

from __future__ import annotations

import contextlib
import re
import tempfile
from pathlib import Path
from typing import Any

import ballrace as br

DOCS = Path(__file__).resolve().parents[1]
PARTS = re.compile(
    r"^```python\n(?P<code>.*?)^```|^!\[[^]]*\]\((?P<picture>[^)]*)\)", re.DOTALL | re.MULTILINE
)


def draw() -> None:
    """Run the page and write its pictures."""
    names: dict[str, Any] = {}
    page = (DOCS / "gallery.md").read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        for part in PARTS.finditer(page):
            if part["code"]:
                exec(part["code"], names)
            else:
                br.plot.write(names["fig"], DOCS / part["picture"])


if __name__ == "__main__":
    draw()
