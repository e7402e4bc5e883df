"""A page into its file."""

from __future__ import annotations

import importlib.util
import warnings
from typing import TYPE_CHECKING

from .._io.files import as_path, check_writable
from .._io.whole import whole
from ..errors import SceneError, SceneWarning

if TYPE_CHECKING:
    import os
    from collections.abc import Callable
    from pathlib import Path

    from .page import Page


def check_page(path: Path, name: str = "path") -> None:
    """Refuse a place where no page can be written, given as ``name``.

    Raises
    ------
    SceneError
        The name does not end in ``.html``, or plotly is not installed.
    OSError
        The file cannot be written.
    """
    if path.suffix.lower() not in (".html", ".htm"):
        raise SceneError(name, str(path), "a file that ends in .html, which is what is written")
    check_writable(path)
    if importlib.util.find_spec("plotly") is None:
        allowed = 'plotly, which is not installed: pip install "ballrace[plot]"'
        raise SceneError(name, str(path), allowed)


def write_page(path: str | os.PathLike[str], make: Callable[[], Page]) -> None:
    """Make a page and write it, whole or not at all.

    Raises
    ------
    SceneError
        The name does not end in ``.html``, or plotly is not installed.
    OSError
        The file cannot be written.
    """
    path = as_path(path)
    check_page(path)
    with warnings.catch_warnings():
        # What a run was warned of stands on its page; its scene is not to warn again.
        warnings.simplefilter("ignore", SceneWarning)
        text = make().html()
    with whole(path) as temporary:
        temporary.write_text(text, encoding="utf-8")
