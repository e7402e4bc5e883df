"""Pieces of HTML as notebooks show them; every text is escaped."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

import numpy as np
from numpy.typing import NDArray

from .text import printable

_PIECES, _HEIGHT = 300, 40
"""Width of a waveform, a pixel a piece of it, and its height [px]."""


def paragraph(title: str, text: str = "") -> str:
    """Return a paragraph with a title in bold."""
    return f"<p><strong>{_shown(title)}</strong> {_shown(text)}</p>"


def points(items: Iterable[str]) -> str:
    """Return a list; of no items nothing."""
    lines = "".join(f"<li>{_shown(item)}</li>" for item in items)
    return f"<ul>{lines}</ul>" if lines else ""


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table."""
    head = "".join(f"<th>{_shown(cell)}</th>" for cell in header)
    body = "".join(
        "<tr>" + "".join(f"<td>{_shown(cell)}</td>" for cell in row) + "</tr>" for row in rows
    )
    return f"<table><tr>{head}</tr>{body}</table>"


def folded(title: str, text: str, *, opened: bool = False) -> str:
    """Return a text in its own lines, closed until it is asked for."""
    how = ' open=""' if opened else ""
    return f"<details{how}><summary>{_shown(title)}</summary><pre>{_shown(text)}</pre></details>"


def _shown(text: str) -> str:
    return escape(printable(text))


def waveform(name: str, unit: str, x: NDArray[np.float64]) -> str:
    """Return a row of a table: a signal's name, its least and largest values over time, and what they are."""
    if x.size == 0:
        return ""
    pieces = np.array_split(x, min(x.size, _PIECES))
    low, high = np.array([p.min() for p in pieces]), np.array([p.max() for p in pieces])
    least, span = float(low.min()), float(high.max() - low.min()) or 1.0
    y = _HEIGHT * (1.0 - (np.concatenate([high, low[::-1]]) - least) / span)
    t = np.arange(len(pieces))
    outline = " ".join(f"{a},{b:.1f}" for a, b in zip([*t, *t[::-1]], y, strict=True))
    summary = f"RMS {np.sqrt(np.mean(x**2)):.3g}, {low.min():.3g} to {high.max():.3g} {unit}"
    drawn = (
        f'<svg width="{_PIECES}" height="{_HEIGHT}" viewBox="0 0 {len(pieces)} {_HEIGHT}" '
        f'preserveAspectRatio="none"><polygon points="{outline}" fill="#1f77b4" stroke="#1f77b4"/></svg>'
    )
    return f"<tr><td>{_shown(name)}</td><td>{drawn}</td><td>{_shown(summary)}</td></tr>"
