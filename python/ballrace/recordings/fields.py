"""Fields of a line of text: what separates them, of which kinds they are, and how their numbers are written."""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass

NAMES = 3
"""Most lines of names and units above a table."""

_NAN = r"[+-]?(?:nan|inf(?:inity)?)"
NUMBERS = {
    (".", ""): re.compile(rf"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?|{_NAN}", re.IGNORECASE),
    (",", ""): re.compile(rf"[+-]?(?:\d+(?:,\d+)?|,\d+)(?:[eEdD][+-]?\d+)?|{_NAN}", re.IGNORECASE),
    (".", ","): re.compile(r"[+-]?(?:\d{1,3}(?:,\d{3})+|\d{1,3})(?:\.\d*)?"),
    (",", "."): re.compile(r"[+-]?(?:\d{1,3}(?:\.\d{3})+|\d{1,3})(?:,\d*)?"),
    (".", "'"): re.compile(r"[+-]?(?:\d{1,3}(?:['’]\d{3})+|\d{1,3})(?:\.\d*)?"),
}
"""Numbers by their decimal mark, and the mark between thousands."""

_DATE = r"(?:\d{4}[-/.]\d{1,2}[-/.]\d{1,2}|\d{1,2}[-/.]\d{1,2}[-/.]\d{2,4}|\d{1,2}[- ][A-Za-zäé]{3,9}[- ]\d{2,4})"
_CLOCK = r"\d{1,2}:\d{1,2}(?::\d{1,2}(?:[.,:]\d{1,15})?|[.,]\d{1,15})?\s*(?:[AaPp]\.?[Mm]\.?)?"
_STAMP = re.compile(
    rf"(?:{_DATE}(?:[T ,_-]+{_CLOCK})?|{_CLOCK}|\d{{8}}T\d{{6}}(?:[.,]\d{{1,15}})?)"
    r"\s*(?:Z|UTC|[+-]\d{2}:?\d{2})?"
)
"""A date, a time of day, or both."""

_ENDS = " \xa0\r\x1a"
_BLANKS = "\t" + _ENDS


def fields_of(line: str, separator: str, *, paired: bool = False) -> list[str]:
    """Return the fields of a line, without blanks and quotes around them; pairs joined by decimal commas."""
    # No other characters: those at which Python cuts lines, too, may stand in a name.
    line = line.strip(_ENDS if separator == "\t" else _BLANKS)
    if not separator:
        found = [line]
    elif separator == " ":
        found = re.split(r"[ \t]+", line)
    elif separator == ", ":
        found = re.split(r", +|,$", line)
    elif '"' in line:
        found = _unquoted(line, separator)
    else:
        found = line.split(separator)
    found = [text.strip(_BLANKS).strip('"').strip(_BLANKS) for text in found]
    if paired:
        found = [f"{whole},{part}" for whole, part in zip(found[::2], found[1::2], strict=False)]
    return found


def _unquoted(line: str, separator: str) -> list[str]:
    """Return the fields of a line with quotes; where these are none of fields, those between separators."""
    try:
        return next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])
    except csv.Error:
        return line.split(separator)


def kind_of(text: str, number: tuple[str, str]) -> str:
    """Return the kind of a field, as in ``Layout.kinds``."""
    if not text:
        return "e"
    if NUMBERS[number].fullmatch(text):
        return "n"
    return "d" if text[0].isdigit() and _STAMP.fullmatch(text) else "t"


def kinds_of(fields: Sequence[str], number: tuple[str, str]) -> str:
    """Return the kinds of fields; a separator at the end of a line makes no field."""
    kinds = "".join(kind_of(text, number) for text in fields)
    return kinds[:-1] if kinds.endswith("e") else kinds


def is_row(kinds: str) -> bool:
    """Return whether a line whose fields have these kinds is a row of numbers."""
    return "n" in kinds and "t" not in kinds


def is_mixed_row(kinds: str) -> bool:
    """Return whether a line whose fields have these kinds has text beside numbers."""
    return "n" in kinds and "t" in kinds


@dataclass(frozen=True)
class Candidate:
    """A way to read the lines, and the table that this makes."""

    separator: str
    number: tuple[str, str]
    paired: bool
    kinds: tuple[str, ...]
    first: int
    count: int
    own: str

    def fields(self, line: str) -> list[str]:
        """Return the fields of a line."""
        return fields_of(line, self.separator, paired=self.paired)
