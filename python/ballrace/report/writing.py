"""A page into its file."""

from __future__ import annotations

import importlib.util
import warnings
from pathlib import Path
from typing import TYPE_CHECKING

from .._files import check_writable, whole
from ..errors import SceneError, SceneWarning

if TYPE_CHECKING:
    import os
    from collections.abc import Callable

    from .page import Page

__all__ = ["write_page"]


def write_page(path: str | os.PathLike[str], make: Callable[[], Page]) -> None:
    """Make a page and write it, whole or not at all.

    Raises
    ------
    SceneError
        The name does not end in ``.html``, or plotly is not installed.
    OSError
        The file cannot be written.
    """
    path = Path(path)
    if path.suffix.lower() not in (".html", ".htm"):
        raise SceneError("path", str(path), "a file that ends in .html, which is what is written")
    check_writable(path)
    if importlib.util.find_spec("plotly") is None:
        raise SceneError(
            "path", str(path), 'plotly, which is not installed: pip install "ballrace[plot]"'
        )
    with warnings.catch_warnings():
        # What a run was warned of stands on its page; its scene is not to warn again.
        warnings.simplefilter("ignore", SceneWarning)
        text = make().html()
    with whole(path) as temporary:
        temporary.write_text(text, encoding="utf-8")
