"""Names of a package that are imported at first use, so that importing the package is fast."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any


def later(
    package: str, homes: Mapping[str, tuple[str, ...]], moved: Mapping[str, str] | None = None
) -> Callable[[str], Any]:
    """Return the ``__getattr__`` of a package.

    Parameters
    ----------
    package : str
        Its name.
    homes : mapping of str to tuple of str
        For each module that is imported later, the names that the package takes from it, besides the module
        itself.
    moved : mapping of str to str, optional
        For each name that the package no longer has, the module that has it: it is found with a
        ``DeprecationWarning`` at the caller of a ``__getattr__`` that calls this one.
    """
    moved = moved or {}
    home = {name: module for module, names in homes.items() for name in names}

    def found(name: str) -> Any:
        if name in homes:
            return import_module(f"{package}.{name}")
        if name in moved:
            there = f"{package}.{moved[name]}"
            warnings.warn(
                f"{package}.{name} is {there}.{name} since 0.4, and will be gone in 0.5",
                DeprecationWarning,
                stacklevel=3,
            )
            return getattr(import_module(there), name)
        if name not in home:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        value = getattr(import_module(f"{package}.{home[name]}"), name)
        setattr(sys.modules[package], name, value)
        return value

    return found


def listed(package: str) -> Callable[[], list[str]]:
    """Return the ``__dir__`` of a package: its public names, imported or not, and no modules beneath."""
    return lambda: sorted(sys.modules[package].__all__)
