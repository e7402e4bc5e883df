"""Columns into a file, whole or not at all."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .._base.arguments import whole_text
from .._io.files import as_path
from .._io.whole import whole
from .formats import by_name

if TYPE_CHECKING:
    import os

    from .samples import Samples


def write(samples: Samples, path: str | os.PathLike[str]) -> None:
    """Write a file of the format that its name ends in; what it cannot hold is refused before.

    Raises
    ------
    SceneError
        It ends in none, or cannot hold these columns.
    ImportError
        The library for this format is not installed.
    OSError
        It cannot be written.
    """
    path = as_path(path)
    for name in samples.columns:
        whole_text("columns", name)
    writer = by_name(path).write
    assert writer is not None
    with whole(path) as temporary:
        writer(samples, temporary, path)
