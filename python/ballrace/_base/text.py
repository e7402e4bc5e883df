"""Text for terminals, without control characters from names that others wrote."""

from __future__ import annotations

import re

_STEERING = re.compile(
    "[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff]"
)
"""Control characters but tab and new line, what turns the direction of writing, and halves of characters."""


def printable(text: str) -> str:
    r"""Return the text with every character that steers a terminal written out, such as ``\x1b``.

    Examples
    --------
    >>> printable("a \x1b[31mred\x1b[0m name")
    'a \\x1b[31mred\\x1b[0m name'
    """
    return _STEERING.sub(lambda found: ascii(found[0])[1:-1], text)
