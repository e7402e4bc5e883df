"""Libraries that only some parts need."""

from __future__ import annotations

import importlib
from typing import Any


class MissingLibraryError(ImportError):
    """A library that a part needs is not installed."""


def needed(module: str, what: str, extra: str | None = "io", package: str | None = None) -> Any:
    """Import a library; where it is missing, say how to install it: by an extra, or by its package.

    A package is called as its module unless another name is given.

    Raises
    ------
    MissingLibraryError
        It is not installed.
    """
    try:
        return importlib.import_module(module)
    except ImportError as error:
        install = f'"ballrace[{extra}]"' if extra else package or module
        text = f"{what} needs {module} ({error}): pip install {install}"
        raise MissingLibraryError(text, name=module) from error
