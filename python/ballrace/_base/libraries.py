"""Libraries that only some parts need, or whose import takes long: each is imported when it is first used."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import plotly.graph_objects as go
    import polars as pl
    import scipy

__all__ = ["MissingLibraryError", "go", "needed", "pl", "scipy"]


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


class _Later:
    """A module under its usual name, imported when something of it is first asked for."""

    def __init__(self, module: str, name: str = "") -> None:
        self._module, self._name = module, name

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):  # by which doctest and others look whether a function is wrapped
            raise AttributeError(name)
        module = importlib.import_module(self._module, __package__)
        found = getattr(getattr(module, self._name) if self._name else module, name)
        setattr(self, name, found)
        return found


if not TYPE_CHECKING:
    go, pl, scipy = _Later(".plotly", "go"), _Later(".polars", "pl"), _Later("scipy")
