"""TOML as others wrote it: readers need the square of the depth of a key, and recur into lists."""

from __future__ import annotations

import re
from typing import Any

DEEPEST = 64
"""Most parts of a key, and of anything nested; scenes have six."""

_PART = r"""(?:[A-Za-z0-9_-]++|"[^"\n]*+"|'[^'\n]*+')"""
_DEEP = re.compile(rf"(?<![\w.-]){_PART}(?:[ \t]*+\.[ \t]*+{_PART}){{{DEEPEST}}}")


def check_depth(text: str) -> None:
    """Refuse a text with a dotted key of more parts than 64.

    Raises
    ------
    ValueError
        There is one.
    """
    if found := _DEEP.search(text):
        line = text.count("\n", 0, found.start()) + 1
        raise ValueError(f"line {line}: a key of more than {DEEPEST} parts")


def loads(text: str) -> dict[str, Any]:
    """Read a text.

    Raises
    ------
    ValueError
        It is no TOML, or nested deeper than is read.
    """
    import tomllib

    check_depth(text)
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise ValueError("nested deeper than is read") from None
