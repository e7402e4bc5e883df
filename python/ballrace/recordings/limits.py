"""How much the numbers of a file may take, checked against what it declares before any memory is set aside."""

from __future__ import annotations

import math
from pathlib import Path

from ..errors import FileError

_NUMBER = 8.0
"""Length of a number [bytes]."""

most = math.inf
"""Limit of what the numbers of a file may take [bytes]: set in the child process that reads it."""


def check_declared(path: Path, numbers: float) -> None:
    """Refuse a file that declares more numbers than it may have: 2 kB may declare 128 GiB."""
    if numbers * _NUMBER > most:
        size = path.stat().st_size
        declared = (
            f"declares {numbers:.3g} numbers ({numbers * _NUMBER / 1e9:.3g} GB) in {size} bytes"
        )
        raise FileError(str(path), f"{declared}, and memory_limit is {most / 1e9:.3g} GB")
