"""The JSON Schema of scenes: for editors, and for programs that write scenes."""

from __future__ import annotations

from typing import Any

from .described import described
from .scene import Scene

__all__ = ["schema"]


def schema() -> dict[str, Any]:
    """Return the JSON Schema (draft 2020-12) of a scene's document, in TOML or JSON.

    Examples
    --------
    >>> found = schema()
    >>> found["required"]
    ['rows', 'drive']
    >>> found["$defs"]["Row"]["properties"]["ball_count"]["maximum"]
    1000.0
    """
    heading = {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "A scene of ballrace",
    }
    return {**heading, **described(Scene)}
