"""The formats, recognised by the name of a file or by its first bytes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..errors import SceneError

if TYPE_CHECKING:
    from pathlib import Path

SUFFIXES = {
    ".csv": "csv", ".txt": "csv", ".wav": "wav", ".mat": "mat", ".uff": "uff", ".unv": "uff",
    ".h5": "hdf5", ".hdf5": "hdf5", ".parquet": "parquet", ".pq": "parquet",
}  # fmt: skip
"""Format by the end of a file's name."""

_BEGINNINGS = {
    b"RIFF": "wav", b"RIFX": "wav", b"RF64": "wav", b"MATLAB": "mat", b"    -1": "uff",
    b"\x89HDF": "hdf5", b"PAR1": "parquet",
}  # fmt: skip


def by_name(path: Path) -> str:
    """Return the format that a file's name ends in.

    Raises
    ------
    SceneError
        It ends in none.
    """
    found = SUFFIXES.get(path.suffix.lower())
    if found is None:
        raise SceneError("path", str(path), f"a name that ends in {', '.join(SUFFIXES)}")
    return found


def by_contents(path: Path) -> str:
    """Return the format that a file's name ends in, else the one it begins as, else text."""
    known = SUFFIXES.get(path.suffix.lower())
    if known is not None:
        return known
    with path.open("rb") as file:
        start = file.read(8)
    return next((f for mark, f in _BEGINNINGS.items() if start.startswith(mark)), "csv")
