"""Tables and sizes of files as text."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .._base.text import printable


def numbers(values: NDArray[np.float64], digits: int) -> list[str]:
    """Return numbers with some decimals, a dash for what is none."""
    return [f"{value:.{digits}f}" if np.isfinite(value) else "-" for value in values]


def print_size(path: Path) -> None:
    """Print the name and the size of a file that was written."""
    print(f"{printable(str(path))}: {path.stat().st_size / 1e6:.1f} MB")


def print_table(header: list[str], lines: list[list[str]]) -> None:
    """Print a table, its first column to the left and the others to the right."""
    widths = [max(len(line[i]) for line in [header, *lines]) for i in range(len(header))]
    for first, *rest in [header, *lines]:
        cells = (cell.rjust(width) for cell, width in zip(rest, widths[1:], strict=True))
        print("  ".join([first.ljust(widths[0]), *cells]))
