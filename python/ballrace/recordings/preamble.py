"""Preamble above a table: lines of names and values, among which may be the sampling rate."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

from .._base.units import is_unit
from .rates import stated_rate
from .samples import Said

_ENTRY = re.compile(r"^(?P<key>[^:=;,\t|]{1,60}?)\s*(?:[:=;,\t|]\s*)+(?P<value>.*?)[;,\t|\s]*$")
_QUANTITY = re.compile(
    r"(?P<number>[+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+-]?\d+)?)[\s;,|]*"
    r"[\[(]?(?P<unit>[A-Za-zµμ/°%0-9]*)[\])]?(?:[;,\t].*)?"
)
_UNIT = re.compile(
    r"(?:(?:y|vertical|channel|engineering|signal) ?)?(?:axis ?)?(?:units?|einheit)(?: ?labels?)?"
)
_MOST = 200
"""Lines that are kept."""


def described(lines: Sequence[str]) -> Said:
    """Return what lines above a table say.

    >>> described(["# Sampling rate: 25,6 kHz", "Unit;g;", "run of Monday"])  # doctest: +ELLIPSIS
    Said(rate=25600.0, units=['g'], metadata={'Sampling rate': '25,6 kHz', 'Unit': 'g', 'remarks': [...]})
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
        rate = rate_in(found["key"], found["value"]) if rate is None else rate
    units = _units_of(entries)
    metadata = entries | ({"remarks": remarks} if remarks else {})
    return Said(rate=rate, units=units, metadata=metadata)


def rate_in(key: str, text: str) -> float | None:
    """Return the sampling rate that a text states under a name [Hz]; None if it states none.

    >>> rate_in("Abtastrate", "25,6 kHz"), rate_in("Operator", "N. N.")
    (25600.0, None)
    """
    found = _QUANTITY.fullmatch(text.strip())
    if found is None:
        return None
    return stated_rate(key, float(found["number"].replace(",", ".")), found["unit"])


def _units_of(entries: Mapping[str, Any]) -> list[str]:
    """Return the units of the signals among lines above a table."""
    for key, value in entries.items():
        if isinstance(value, str) and _UNIT.fullmatch(re.sub(r"[\W_]+", " ", key.lower()).strip()):
            units = [text for text in re.split(r"[;,\t|\s]+", value.strip()) if text]
            if units and all(map(is_unit, units)):
                return units
    return []
