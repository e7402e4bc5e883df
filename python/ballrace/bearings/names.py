"""Which designations mean a bearing of the catalogue."""

from __future__ import annotations

import difflib
import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Collection

__all__ = ["clearance_class", "near", "resolved"]

_MAKERS = re.compile(
    r"^(SKF|FAG|INA|NSK|NTN|SNR|KOYO|JTEKT|NACHI|TIMKEN|LDK|REXNORD|MB|IBU|HRB|ZWZ|LYC)\s*"
)
_HARMLESS = re.compile(
    r"""(?: [-\s/]* (?: 2?RSR? | 2RS[1HL] | RS[1HL] | 2?ZR? | ZZ | VV | DDU? | LL[BUH] | [LU]LB | NR? | JEM
        | CM | CN | C[2-5] | P[0456] ) )* [-\s/]* $""",
    re.VERBOSE,
)
"""Seals, shields, snap ring grooves, clearance and tolerance: no matter of the balls."""

_CLASS = re.compile(r"C[N2-5]")

_ANGLES = {"AC": "A5", "ACD": "A5", "CD": "C", "BE": "B", "BEP": "B", "BTVP": "B"}
"""Contact angle as other makers write it; of the same name, the balls may differ."""


def resolved(name: str, known: Collection[str]) -> str | None:
    """Return the designation in the catalogue that a name means, or None.

    Examples
    --------
    >>> resolved("SKF 6205-2RS/C3", ["6205", "7205B"]), resolved("7205 BEP", ["6205", "7205B"])
    ('6205', '7205B')
    >>> resolved("6205 ETN9", ["6205"])  # another set of balls
    """
    text = _MAKERS.sub("", name.strip().upper())
    for designation in sorted(known, key=len, reverse=True):
        if _bare(text).startswith(_bare(designation)) and _HARMLESS.fullmatch(
            _rest(text, designation)
        ):
            return designation
    number, letters = re.fullmatch(r"(\d*)(.*)", _bare(text)).groups()  # type: ignore[union-attr]
    other = number + _ANGLES.get(letters, letters)
    return other if other in known else None


def clearance_class(name: str, designation: str) -> str | None:
    """Return the class of clearance that a name says after its designation, if any.

    Examples
    --------
    >>> clearance_class("SKF 6205-2RS/C3", "6205"), clearance_class("7205 C", "7205C")
    ('C3', None)
    """
    text = _MAKERS.sub("", name.strip().upper())
    said = _CLASS.search(_rest(text, designation)) if _bare(text).startswith(designation) else None
    return said.group() if said else None


def near(name: str, known: Collection[str]) -> list[str]:
    """Return designations that resemble a name, at most five, the nearest first."""
    text = _bare(_MAKERS.sub("", name.strip().upper()))
    starting = sorted(d for d in known if text and _bare(d).startswith(text))
    return (starting or difflib.get_close_matches(text, known, n=5, cutoff=0.5))[:5]


def _bare(text: str) -> str:
    return re.sub(r"[-\s/]", "", text)


def _rest(text: str, designation: str) -> str:
    """Return what follows a designation in a text that begins with it, whatever stands between its letters."""
    pattern = r"[-\s/]*".join(map(re.escape, _bare(designation)))
    return re.sub(f"^{pattern}", "", text)
