"""Layout of a text: where its table begins, and how its numbers are separated and written.

The table is the first long run of lines with equally many fields, all of them numbers or times of day. What stands
above are its names and units, and a preamble.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from pathlib import Path
from typing import Any

from ..errors import FileError
from .commas import told_apart
from .fields import NAMES, NUMBERS, Candidate, fields_of, is_mixed_row, is_row, kind_of, kinds_of
from .headers import REMARK, check_preamble, names_in_remark, titles_above
from .lines import other_ways

LONG = 10
"""Rows of a run that is a table, whatever follows."""

_SEPARATORS = (";", "\t", "|", ", ", ",", " ", "")
"""Separators of the fields of a line, in order of preference; a blank means any number of them.

A comma with a blank is one where commas without are decimal marks.
"""

_WORDS = re.compile(r"[^\W\d_][\w .:+-]*")
"""Text in a column that is none of numbers: a label, a state."""

_HEAD = 5
"""Most numbers before a column that are none of the signal."""


@dataclass(frozen=True, kw_only=True)
class Layout:
    """How a table stands in a text.

    Attributes
    ----------
    separator : str
        Between fields; a blank for any number of blanks, empty for one column.
    decimal, thousands : str
        Decimal mark, and the mark between thousands; empty where there is none.
    paired : bool
        Whether commas both separate fields and are decimal marks: every second one separates.
    first : int
        Number of the line with the first row, from 0.
    kinds : str
        A letter a field: ``n`` number, ``d`` date or time of day, ``t`` text, ``e`` empty.
    names, units : list of str
        Of the fields; empty where there are none.
    preamble : list of str
        Lines before.
    decided : bool
        Whether a number with a decimal mark was seen.
    ended : bool
        Whether separators end lines.
    """

    separator: str
    decimal: str
    thousands: str = ""
    paired: bool = False
    first: int
    kinds: str
    names: list[str] = field(default_factory=list)
    units: list[str] = field(default_factory=list)
    preamble: list[str] = field(default_factory=list)
    decided: bool = True
    ended: bool = False

    def fields(self, line: str) -> list[str]:
        """Return the fields of a line, without blanks and quotes around them."""
        return fields_of(line, self.separator, paired=self.paired)


def layout_of(
    path: Path,
    lines: Sequence[str],
    decimal: str | None,
    separator: str | None = None,
    *,
    skipped: bool = False,
) -> Layout:
    """Return how the table stands in the first lines of a text; lines are without their ends.

    What separates is found where it is not known. Where lines were ``skipped``, the first row is one of the table.

    Raises
    ------
    FileError
        There is none, or it can be read in two ways.
    """
    used = [
        i for i, line in enumerate(lines) if line.strip() and not line.lstrip().startswith(REMARK)
    ]
    texts = [lines[i].replace("−", "-") for i in used]
    joined = "".join(texts)
    found: list[Candidate] = []
    for words in (False, True):
        for mark in _SEPARATORS if separator is None else (separator,):
            if (found and words) or (mark and mark not in joined and separator is None):
                continue
            for number in _number_styles(joined, mark, decimal):
                paired = mark == "," and number == (",", "") and '"' not in joined
                candidate = _candidate(texts, mark, number, paired=paired, words=words)
                if candidate is not None:
                    found.append(candidate)
    if not found:
        raise FileError(str(path), _no_table(texts))
    alone = {(one.number, one.count) for one in found if not one.separator}
    # What separates nothing in the table is no separator.
    found = [
        one
        for one in found
        if not one.separator or len(one.own) > 1 or (one.number, one.count) not in alone
    ]
    best = told_apart(path, texts, found, max(found, key=lambda one: one.count), decimal)
    return _layout(path, lines, used, texts, best, skipped=skipped)


def _no_table(texts: Sequence[str]) -> str:
    if not texts:
        return "not a table of numbers: it is empty"
    shown = texts[0].strip()[:60]
    return (
        f"not a table of numbers, or damaged: no line holds numbers alone, the first is {shown!r}; "
        f'give decimal="," if it has decimal commas; {other_ways()}'
    )


def _number_styles(text: str, separator: str, decimal: str | None) -> Iterator[tuple[str, str]]:
    """Yield how numbers may be written: by their decimal mark, and what stands between thousands."""
    quoted = '"' in text
    for number in NUMBERS:
        mark, thousands = number
        if decimal is not None and mark != decimal:
            continue
        if mark == "," and "," not in text and decimal is None:
            continue
        if separator == ", " and (number != (",", "") or not re.search(r"\d,\d", text)):
            continue
        if thousands and (
            thousands not in text.replace("’", "'") or (separator == thousands and not quoted)
        ):
            continue
        yield number


def _candidate(
    texts: Sequence[str], separator: str, number: tuple[str, str], *, paired: bool, words: bool
) -> Candidate | None:
    """Return the table that a separator and a way to write numbers make; None if there is none.

    Columns of words beside the numbers are taken only where nothing else makes a table.
    """
    kinds = []
    for text in texts:
        fields = fields_of(text, separator)
        if paired:
            # Without a partner a field is no number of the kind.
            fields = fields[:-1] if fields[-1] == "" else fields
            fields = fields_of(text, separator, paired=True) if len(fields) % 2 == 0 else ["?"]
        kinds.append(kinds_of(fields, number))
    runs = _runs(kinds, is_mixed_row if words else is_row)
    if not runs:
        return None
    longest = max(length for _, length in runs)
    first, count = next(run for run in runs if run[1] >= min(LONG, longest))
    if words and 2 * count < len(texts) - first:
        return None
    if words and (
        count < NAMES
        or not all(
            _has_words(fields_of(t, separator), number) for t in texts[first : first + count]
        )
    ):
        return None
    return Candidate(separator, number, paired, tuple(kinds), first, count, kinds[first])


def _has_words(fields: Sequence[str], number: tuple[str, str]) -> bool:
    """Whether all fields that are text are words."""
    return all(_WORDS.fullmatch(text) for text in fields if kind_of(text, number) == "t")


def _runs(kinds: Sequence[str], wanted: Any) -> list[tuple[int, int]]:
    """Return where rows of one kind follow each other, and how many."""
    runs, at = [], 0
    for kind, group in groupby(kinds):
        length = sum(1 for _ in group)
        if wanted(kind):
            runs.append((at, length))
        at += length
    return runs


def _layout(
    path: Path,
    lines: Sequence[str],
    used: Sequence[int],
    texts: Sequence[str],
    best: Candidate,
    *,
    skipped: bool,
) -> Layout:
    """Return the layout with names, units and preamble from the lines above the table."""
    first, own = best.first, best.own
    beside: list[str] = []
    while first and _stands_beside(best.kinds[first - 1], own):
        first -= 1
        fields = zip(best.fields(texts[first]), own, strict=False)
        beside.insert(0, best.separator.join(text for text, kind in fields if kind == "e" and text))
    rows = texts[first : best.first + best.count]
    if len(own) == 1 and not skipped:
        _check_head_of_numbers(path, [best.fields(row)[0] for row in rows])
    if _is_numbered_header(best.fields(rows[0]), [best.fields(row) for row in rows[1:20]], own):
        names, units, above = best.fields(rows[0]), [""] * len(own), first
        first, rows = first + 1, rows[1:]
    else:
        names, units, above = titles_above(path, texts, best, first)
    check_preamble(path, used, texts, best, above)
    if not names:
        names, units = names_in_remark(lines, used[first], best)
    line = used[first]
    preamble = [text for text in [*lines[: used[above]], *beside] if text.strip()]
    marked = any(best.number[0] in text for row in rows for text in best.fields(row))
    return Layout(
        separator=best.separator, decimal=best.number[0], thousands=best.number[1], paired=best.paired, first=line,
        kinds=own, names=names, units=units, preamble=preamble, decided=marked,
        ended=any(len(best.fields(row)) > len(own) for row in rows),
    )  # fmt: skip


def _stands_beside(kinds: str, own: str) -> bool:
    """Whether a line is a row with something in the fields that are empty below, as oscilloscopes write it."""
    alike = all(wanted in {kind, "e"} for kind, wanted in zip(kinds, own, strict=False))
    return "e" in own and len(kinds) == len(own) and alike


def _check_head_of_numbers(path: Path, rows: Sequence[str]) -> None:
    """Refuse a column whose first whole numbers are far beyond the others: a count of samples, a rate."""
    whole = [row.lstrip("+-").isdigit() for row in rows]
    count = whole.index(False) if False in whole else 0
    if not 0 < count <= _HEAD or any(whole[count:]) or len(rows) < count + LONG:
        return
    largest = max(
        abs(float(row.replace(",", ".").lower().replace("d", "e"))) for row in rows[count:]
    )
    if min(abs(float(row)) for row in rows[:count]) > 10.0 * largest:
        shown = ", ".join(rows[:count])
        reason = (
            f"its first numbers ({shown}) are far beyond the others, and may be none of the signal"
        )
        raise FileError(str(path), f"{reason}; skip={count} leaves them out, skip=0 takes them")


def _is_numbered_header(first: Sequence[str], rows: Sequence[Sequence[str]], kinds: str) -> bool:
    """Whether a row of whole numbers 0, 1, 2, … is one of names, as tables without names get them."""
    if not rows or any(kind != "n" for kind in kinds):
        return False
    numbered = list(first) == [str(place) for place in range(len(first))]
    return (
        numbered
        and len(rows) > 2
        and all(re.search(r"[.,eE]", text) for row in rows for text in row)
    )
