"""Commas that may separate fields or be decimal marks: what tells the two apart."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

from ..errors import FileError
from .fields import NAMES, Candidate, fields_of
from .headers import are_titles

_SEVERAL = 20
"""Rows in which one digit would once be two if it were a number of its own."""


def told_apart(
    path: Path,
    texts: Sequence[str],
    found: Sequence[Candidate],
    best: Candidate,
    decimal: str | None,
) -> Candidate:
    """Return the reading of lines in which a comma may separate, or be the decimal mark.

    Raises
    ------
    FileError
        Both are possible.
    """
    near = [one for one in found if 2 * one.count >= best.count]
    apart = next((one for one in near if one.separator == "," and one.number == (".", "")), None)
    marks = next(
        (one for one in near if one.number == (",", "") and one.separator in ("", ",")), None
    )
    if apart is not None and marks is None and decimal is None and best is apart:
        _check_fractions(path, texts, apart)
    if apart is None or marks is None or decimal is not None or best not in (apart, marks):
        return best
    rows = [apart.fields(text) for text in texts[apart.first : apart.first + apart.count]]
    rows = [row[:-1] if row[-1] == "" else row for row in rows]
    is_decimal, is_separator = _evidence(rows)
    # A number without a fraction among others; one such line alone may have been cut.
    is_decimal |= marks.count > apart.count + 1
    for text in reversed(texts[max(apart.first - NAMES, 0) : apart.first]):
        names = [fields_of(text, ",")] if "," in text else []
        if any(len(one) == len(rows[0]) and are_titles(one) for one in names):
            is_separator = True
        elif any(
            len(one) == len(marks.own) and are_titles(one) for one in names or [[text.strip()]]
        ):
            is_decimal = True
        else:
            continue
        break
    if is_decimal != is_separator:
        return marks if is_decimal else apart
    if not is_decimal and len(rows[0]) > 2:
        _check_fractions(path, texts, apart)
        return apart
    raise FileError(str(path), _ambiguous(rows))


def _check_fractions(path: Path, texts: Sequence[str], apart: Candidate) -> None:
    """Refuse fields between commas that look like the sides of decimal commas, some of them.

    Whole numbers have no sign of zero, and no zeros before them unless all of a column have as many digits.
    """
    rows = [apart.fields(text) for text in texts[apart.first : apart.first + apart.count]]
    if any("." in text for row in rows for text in row):
        return
    above = fields_of(texts[apart.first - 1], ",") if apart.first else []
    headed = len(above) == len(rows[0]) and are_titles(above)
    columns = list(zip(*rows, strict=False))
    for left, column in pairwise(columns):
        widths = {len(text) for text in column}
        padded = any(len(text) > 2 and text.startswith("0") for text in column) and len(widths) > 1
        # Beside signed numbers as many digits as a fraction has, and never a sign.
        signed = any(text.startswith("-") for text in left) and len(set(column)) > 1
        many = min(widths) > 2 or (len(column) >= _SEVERAL and len(set(column)) > 4)
        alike = (
            not headed and signed and len(widths) == 1 and many and all(map(str.isdigit, column))
        )
        power = any(re.fullmatch(r"\d{2,}[eEdD][+-]?\d+", text) for text in column)
        if padded or alike or power or any(text in ("-0", "+0") for text in column):
            shown = ",".join(rows[0])
            reason = f"its commas seem to be decimal marks, and to separate as well ({shown}, …)"
            raise FileError(str(path), f'{reason}; decimal="." reads each comma as a separator')


def _evidence(rows: Sequence[Sequence[str]]) -> tuple[bool, bool]:
    """Return whether something says that commas are decimal marks, and that they separate."""
    if len(rows[0]) % 2:
        return False, True
    pairs = [list(zip(row[::2], row[1::2], strict=True)) for row in rows]
    is_decimal = all(
        any(_is_fraction(*row[place]) for row in pairs) for place in range(len(pairs[0]))
    )
    is_separator = any(
        part[:1] in "+-" or "." in whole + part for row in pairs for whole, part in row
    )
    counts = [row[0] for row in rows]
    if len(rows) > 2 and all(text.isdigit() for text in counts):
        steps = {int(b) - int(a) for a, b in pairwise(counts)}
        is_separator |= len(steps) == 1 and steps != {0}
    return is_decimal, is_separator


def _is_fraction(whole: str, part: str) -> bool:
    """Return whether a comma between two numbers can hardly be anything but a decimal mark."""
    padded = len(part) > 1 and part.startswith("0")
    power = re.fullmatch(r"\d{2,}[eEdD][+-]?\d+", part) is not None
    return padded or power or whole in ("-0", "+0")


def _ambiguous(rows: Sequence[Sequence[str]]) -> str:
    apart = "; ".join(" and ".join(row) for row in rows[:2])
    together = "; ".join(
        " and ".join(f"{a}.{b}" for a, b in zip(row[::2], row[1::2], strict=True))
        for row in rows[:2]
    )
    width = len(rows[0])
    return (
        f'its commas may separate or be decimal marks: decimal="." reads {width} columns ({apart}; …), '
        f'decimal="," {width // 2} ({together}; …); give one of them'
    )
