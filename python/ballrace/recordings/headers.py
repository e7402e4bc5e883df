"""Lines above a table of numbers: names, units, and rows that do not belong there."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise
from pathlib import Path

from .._base.units import is_unit
from ..errors import FileError
from .fields import NAMES, Candidate, fields_of, is_mixed_row, is_row, kind_of
from .titles import is_time_name, named, time_unit

REMARK = "#"
"""Beginnings of lines that are remarks and belong to no table."""


def titles_above(
    path: Path, texts: Sequence[str], best: Candidate, first: int
) -> tuple[list[str], list[str], int]:
    """Return names and units of the fields, and the number of the first of their lines among the texts."""
    width = len(best.own)
    rows: list[list[str]] = []
    while len(rows) < min(NAMES, first):
        fields = _title_fields(texts[first - 1 - len(rows)], best, width)
        if fields is None:
            break
        rows.append(fields)
    if not rows:
        if first:
            _check_names_line(path, texts[first - 1], best, width)
        return [], [], first
    # Counted upwards: the nearest line that is none of units has the names.
    of_names = next((up for up, row in enumerate(rows) if not _are_units(row)), 0)
    of_units = next((up for up, row in enumerate(rows) if up != of_names and _are_units(row)), None)
    split = [named(name) for name in rows[of_names]]
    units = [unit for _, unit in split]
    if of_units is not None:
        units = [
            text.strip("[]() ") or unit for text, unit in zip(rows[of_units], units, strict=True)
        ]
    return [name for name, _ in split], units, first - 1 - max(of_names, of_units or 0)


def _title_fields(text: str, best: Candidate, width: int) -> list[str] | None:
    """Return the fields of a line of names or units; None if it is none."""
    fields = best.fields(text) if not best.paired else fields_of(text, best.separator)
    for split in (fields, *_other_splits(text, best.separator)):
        while len(split) > width and split[-1].casefold() in ("", "comment"):
            split.pop()
        if len(split) == width + 1 and best.own.endswith("e"):
            split.pop()  # over nothing
        if len(split) == width - 1 and best.own.startswith("dd"):
            split.insert(1, "")  # one name of a date and a time of day
        if len(split) == width and are_titles(split):
            return split
    return None


def _other_splits(text: str, between: str) -> Iterator[list[str]]:
    """Yield the fields of a line of names that are separated otherwise than the columns."""
    text = text.strip()
    for separator in ("\t", ";", ","):
        if separator in text:
            yield fields_of(text, separator)
    yield [part.strip() for part in re.split(r"\s{2,}", text)]
    if between == " ":
        yield re.findall(r"\S+(?:\s*[\[(][^\])]*[\])])?", text)


def _are_units(fields: Sequence[str]) -> bool:
    """Return whether all fields of a line are units, or say that there is none."""
    known = [_is_a_unit(text) for text in fields if text]
    return bool(known) and all(known)


def _is_a_unit(text: str) -> bool:
    inner = text.strip("[]() ")
    bracketed = text[:1] in "[(" and text[-1:] in "])"
    return bracketed or inner in ("", "-", "1") or is_unit(inner) or time_unit(inner) is not None


def _check_names_line(path: Path, text: str, best: Candidate, width: int) -> None:
    """Refuse names that are not as many as the columns."""
    between = "\t" if best.separator == " " and "\t" in text else best.separator
    fields = fields_of(text, between) if between else []
    names = [name for name in fields if name]
    words = all(kind_of(name, best.number) == "t" and len(name.split()) <= 3 for name in names)
    if len(names) > 2 and words and abs(len(names) - width) <= 2 and not re.search(r"[:=]", text):
        reason = f"its header names {len(names)} columns of {width}"
        raise FileError(str(path), f"{reason}; skip= up to its first row reads them without names")


def are_titles(fields: Sequence[str]) -> bool:
    """Return whether fields may be names or units: text, but for numbers of channels behind the first."""
    kinds = "".join(kind_of(text, (".", "")) for text in fields)
    if len(fields) == 1:
        inner = fields[0].strip("[] ")
        section = fields[0].startswith("[") and not is_unit(inner) and time_unit(inner) is None
        return (
            kinds == "t"
            and len(fields[0]) < 80
            and not section
            and not re.search(r"^\d|[:=]", fields[0])
        )
    if "n" not in kinds:
        return "t" in kinds and "d" not in kinds
    numbers = [text for text, kind in zip(fields, kinds, strict=True) if kind == "n"]
    numbered = all(map(str.isdigit, numbers)) and [int(n) for n in numbers] in (
        list(range(len(numbers))), list(range(1, len(numbers) + 1))
    )  # fmt: skip
    return (
        numbered
        and kinds[1:] == "n" * (len(kinds) - 1)
        and (not fields[0] or is_time_name(fields[0])[0])
    )


def check_preamble(
    path: Path, used: Sequence[int], texts: Sequence[str], best: Candidate, above: int
) -> None:
    """Refuse rows above the table: they are data, or the table is damaged."""
    kinds = best.kinds[:above]
    alike = [k for k, kind in enumerate(kinds) if is_row(kind) and len(kind) == len(best.own)]
    marked = [k for k in alike if best.number[0] in texts[k]]
    follow = any(b - a == 1 for a, b in pairwise(alike))
    if follow or marked or (alike and len(best.own) > 1):
        broken = alike[-1] + 1
        _check_first_row(path, used[broken], texts[: broken + 1], best, best.kinds[broken])
        line, between = used[alike[-1]] + 1, used[broken] + 1
        shown = repr(texts[broken].strip()[:40])
        reason = f"line {between} ({shown}) interrupts a table, which line {line} belongs to"
        raise FileError(
            str(path), f"not a table of numbers: {reason}; skip={between} reads what follows"
        )
    if above == best.first and above:
        _check_first_row(path, used[above - 1], texts[:above], best, kinds[above - 1])


def _check_first_row(
    path: Path, line: int, texts: Sequence[str], best: Candidate, kinds: str
) -> None:
    """Refuse a row with text among its numbers above the table: it would be left out."""
    width = len(best.own)
    if not is_mixed_row(kinds) or kinds[0] != "n" or len(kinds) != width:
        return
    rows = (_title_fields(text, best, width) for text in reversed(texts[:-1]))
    names = [named(title)[0] for title in next((row for row in rows if row), [])]
    fields = best.fields(texts[-1])
    raise FileError(str(path), broken_row(fields, best.own, names, line + 1, best.number))


def broken_row(
    fields: Sequence[str], kinds: str, names: Sequence[str], line: int, number: tuple[str, str]
) -> str:
    """Return what is wrong with a row."""
    if len(fields) != len(kinds) and not (len(fields) == len(kinds) + 1 and not fields[-1]):
        wrong = f"line {line} has {len(fields)} fields where the others have {len(kinds)}"
        return f"not a table of numbers, or damaged: {wrong}"
    for place, (text, kind) in enumerate(zip(fields, kinds, strict=False)):
        if kind != "e" and kind_of(text, number) != kind:
            name = names[place] if place < len(names) and names[place] else f"column_{place + 1}"
            shown = repr(text[:30]) if text else "nothing"
            return f"the column {name} has other entries than numbers: {shown} in line {line}"
    return f"not a table of numbers, or damaged: line {line} cannot be read"


def names_in_remark(
    lines: Sequence[str], first: int, best: Candidate
) -> tuple[list[str], list[str]]:
    """Return names from the last remark above a table, as ``numpy.savetxt`` writes them; none if it has others."""
    above = [text.strip() for text in lines[:first] if text.strip()]
    width = len(best.own)
    if width < 2 or not above or not above[-1].startswith(REMARK):
        return [], []
    fields = _title_fields(above[-1].lstrip("# "), best, width)
    if fields is None or not all(fields):
        return [], []
    split = [named(name) for name in fields]
    return [name for name, _ in split], [unit for _, unit in split]
