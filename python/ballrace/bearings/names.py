"""Names on the boxes of bearings, read.

``marks.csv`` has what may follow a designation, with makers and meanings as their catalogues give them; the column
``effect`` says what it changes of the bearing: nothing here, its ``clearance``, ``balls``, or their ``material``.
"""

from __future__ import annotations

import csv
import difflib
import re
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from functools import cache, lru_cache
from importlib import resources

_MAKERS = (
    "SKF", "FAG", "INA", "SCHAEFFLER", "NSK", "NTN", "SNR", "KOYO", "JTEKT", "NACHI", "TIMKEN", "FAFNIR", "LDK",
    "REXNORD", "NMB", "MB", "IBU", "HRB", "ZWZ", "LYC", "ZKL", "KYK", "FBJ", "TPI", "NKE",
)  # fmt: skip
_MAKER = re.compile(rf"(?:({'|'.join(_MAKERS)})[-\s:]*)?(?:EXPLORER|X-LIFE)?\s*")
_PREFIX = re.compile(r"^(?:[A-Z0-9]{1,5}-|E2\.|[EWSBH]|SS|HCB?|TMB)\s*(?=[67]\d)")
"""Stainless steel, low friction, creep-free, spindle bearing, ceramic balls, makers' codes: same balls."""

_LONGEST = 24
"""Letters of marks that are written without a gap."""
_ANGLES = {"AC": "A5", "E": "A5"}
"""Contact angle as SKF and FAG write it."""


@dataclass(frozen=True)
class Name:
    """A name, taken apart.

    Attributes
    ----------
    designation : str
        The bearing of the catalogue.
    maker : str
        Its maker, empty without one.
    meanings : dict of str to str
        Marks after the designation and what they mean.
    unknown : tuple of str
        Marks that are not in the table.
    clearance : str or None
        Class of ISO 5753-1.
    effects : dict of str to str
        Marks that change the balls or their material.
    """

    designation: str
    maker: str
    meanings: dict[str, str]
    unknown: tuple[str, ...]
    clearance: str | None
    effects: dict[str, str]


def read(name: str, known: Collection[str]) -> Name | None:
    """Return what a name says, by the designations that there are; None where it begins with none of them.

    Examples
    --------
    >>> found = read("SKF Explorer 6205-2RSH/C3", ["6205"])
    >>> found.designation, found.clearance, found.meanings["2RSH"]
    ('6205', 'C3', 'contact seals on both sides')
    >>> read("7208 BECBP", ["7208B"]).designation, read("6805ZZ", ["61805"]).designation
    ('7208B', '61805')
    >>> read("6205-QQ7", ["6205"]).unknown
    ('QQ7',)
    """
    maker, text = without_maker(name)
    for begun in (text, _PREFIX.sub("", text, count=1)):
        for designation, rest in _beginnings(begun, _written(tuple(known))):
            # A digit goes on with the number, unless it begins a mark: 622082RS is no 6220, and 62052RS is a 6205.
            if not (rest[:1].isdigit() and _marks(rest)[1]):
                return _name_of(designation, maker, rest)
    return None


def _beginnings(text: str, written: dict[str, str]) -> Iterator[tuple[str, str]]:
    """Return which designations a text begins with, the longest first, and what follows each.

    Gaps and hyphens may stand between its letters; a stroke is part of it: 60/22 is not 6022.
    """
    places = [i for i, letter in enumerate(text) if letter not in " -"]
    for length in range(min(len(places), max(map(len, written))), 0, -1):
        begun = "".join(text[i] for i in places[:length])
        if begun in written:
            yield written[begun], text[places[length - 1] + 1 :]


def without_maker(name: str) -> tuple[str, str]:
    """Return the maker that a name begins with, empty without one, and what follows, in capitals."""
    text = name.strip().upper()
    found = _MAKER.match(text)
    assert found is not None  # It matches nothing, too.
    return found[1] or "", text[found.end() :]


@cache
def _written(known: tuple[str, ...]) -> dict[str, str]:
    """Return designations by how they may be written."""
    thin = {_thin(d): d for d in known if d.startswith(("618", "619"))}
    angles = {
        d.removesuffix(own) + other: d
        for other, own in _ANGLES.items()
        for d in known
        if d.endswith(own)
    }
    rows = {"5" + d[1:]: d for d in known if re.fullmatch(r"3[23]\d\d", d)}
    return {**thin, **angles, **rows, **{d.replace("-", ""): d for d in known}}


def _thin(designation: str) -> str:
    """Return NSK's name of a bearing of the series 618 and 619, such as 6805 and 688."""
    return "6" + designation[2:].replace("/", "")


def _name_of(designation: str, maker: str, rest: str) -> Name:
    marks, unknown = _marks(rest)
    table = _table()
    classes = [mark for mark in marks if table[mark][0] == "clearance"]
    return Name(
        designation=designation,
        maker=maker,
        meanings={mark: table[mark][1] for mark in marks},
        unknown=tuple(unknown),
        clearance=classes[0] if classes else None,
        effects={m: table[m][1] for m in marks if table[m][0] in ("balls", "material")},
    )


def _marks(rest: str) -> tuple[list[str], list[str]]:
    """Return the marks of the table that a text consists of, and what is none."""
    marks: list[str] = []
    unknown: list[str] = []
    for word in filter(None, re.split(r"[-\s/.,+()]+", rest)):
        # What is left over of a word whose beginning is known, such as X9 of DDUC3X9.
        longest = min(len(word), _LONGEST)
        ends = (end for end in range(longest, 1, -1) if _split(word[:end]) is not None)
        end = next(ends, 1 if word in _table() else 0)
        marks += _split(word[:end]) or ()
        unknown += [word[end:]] if word[end:] else []
    return marks, unknown


@lru_cache
def _split(word: str) -> tuple[str, ...] | None:
    """Return the marks that a word consists of, longer ones first; None where it does not."""
    if not word:
        return ()
    for length in range(min(len(word), 6), 0, -1):
        after = _split(word[length:]) if word[:length] in _table() else None
        if after is not None:
            return (word[:length], *after)
    return None


@cache
def _table() -> dict[str, tuple[str, str]]:
    text = resources.files(__package__).joinpath("marks.csv").read_text(encoding="utf-8")
    return {
        line["mark"]: (line["effect"], line["meaning"])
        for line in csv.DictReader(text.splitlines())
    }


def near(name: str, known: Collection[str]) -> list[str]:
    """Return designations that resemble a name, at most five, the nearest first."""
    text = bare(without_maker(name)[1])
    starting = sorted(d for d in known if text and bare(d).startswith(text))
    return (starting or difflib.get_close_matches(text, known, n=5, cutoff=0.5))[:5]


def bare(text: str) -> str:
    """Return a text without what may stand between its letters."""
    return re.sub(r"[-\s/]", "", text)
