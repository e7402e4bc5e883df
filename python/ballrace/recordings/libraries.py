"""Libraries that only some formats need."""

from __future__ import annotations

import importlib
from typing import Any


def needed(module: str, what: str, extra: str = "io") -> Any:
    """Import a library; where it is missing, say which extra of this package installs it.

    Raises
    ------
    ImportError
        It is not installed.
    """
    try:
        return importlib.import_module(module)
    except ImportError as error:
        text = f'{what} needs {module} ({error}): pip install "ballrace[{extra}]"'
        raise ImportError(text, name=module) from error
