"""What stands above a table: lines of names and values, among which may be the sampling rate."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from .rates import stated_rate

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["described"]

_ENTRY = re.compile(r"^(?P<key>[^:=;,\t|]{1,60}?)\s*(?:[:=;,\t|]\s*)+(?P<value>.*?)[;,\t|\s]*$")
_QUANTITY = re.compile(
    r"(?P<number>[+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+-]?\d+)?)[\s;,|]*"
    r"[\[(]?(?P<unit>[A-Za-zµμ/°%0-9]*)[\])]?(?:[;,\t].*)?"
)
_MOST = 200
"""Lines that are kept."""


def described(lines: Sequence[str]) -> tuple[dict[str, Any], float | None]:
    """Return what lines above a table say, and the sampling rate among it [Hz]; None without.

    >>> described(["# Sampling rate: 25,6 kHz", "Operator;N. N.;", "run of Monday"])
    ({'Sampling rate': '25,6 kHz', 'Operator': 'N. N.', 'remarks': ['run of Monday']}, 25600.0)
    """
    entries: dict[str, Any] = {}
    remarks: list[str] = []
    rate = None
    for line in lines[:_MOST]:
        text = line.strip().lstrip("#%!*/;").strip().replace('"', "").rstrip("\x1a")
        if not text:
            continue
        found = _ENTRY.match(text)
        if found is None or not found["value"]:
            found = re.match(r"(?P<key>[^\d=:]*[^\d=:\s])\s+(?P<value>[+-]?[\d.].*)$", text)
        if found is None:
            remarks.append(text)
            continue
        entries.setdefault(found["key"], found["value"])
        quantity = _QUANTITY.fullmatch(found["value"].strip())
        if quantity is not None and rate is None:
            number = float(quantity["number"].replace(",", "."))
            rate = stated_rate(found["key"], number, quantity["unit"])
    return entries | ({"remarks": remarks} if remarks else {}), rate
