"""Layout of a text: where its table begins, and how its numbers are separated and written.

The table is the first long run of lines with equally many fields, all of them numbers or times of day. What stands
above are its names and units, and a preamble.
"""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass, field
from itertools import groupby, pairwise
from typing import TYPE_CHECKING, Any

from .._base.units import is_unit
from ..errors import FileError
from .lines import other_ways
from .titles import is_time_name, named, time_unit

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

__all__ = ["Layout", "broken_row", "kind_of", "kinds_of", "layout_of"]

LONG = 10
"""Rows of a run that is a table, whatever follows."""

_NAMES = 3
"""Most lines of names and units above a table."""

_SEPARATORS = (";", "\t", "|", ", ", ",", " ", "")
"""Separators of the fields of a line, in order of preference; a blank means any number of them.

A comma with a blank is one where commas without are decimal marks.
"""

_NAN = r"[+-]?(?:nan|inf(?:inity)?)"
_NUMBERS = {
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

_WORDS = re.compile(r"[^\W\d_][\w .:+-]*")
"""Text in a column that is none of numbers: a label, a state."""

_ENDS = " \xa0\r\x1a"
_BLANKS = "\t" + _ENDS

_SEVERAL = 20
"""Rows in which one digit would once be two if it were a number of its own."""

_HEAD = 5
"""Most numbers before a column that are none of the signal."""

_REMARK = "#"
"""How lines begin that belong to no table."""


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
        return _fields(line, self.separator, paired=self.paired)


def _fields(line: str, separator: str, *, paired: bool = False) -> list[str]:
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
    """Return the kind of a field, as in :attr:`Layout.kinds`."""
    if not text:
        return "e"
    if _NUMBERS[number].fullmatch(text):
        return "n"
    return "d" if text[0].isdigit() and _STAMP.fullmatch(text) else "t"


def kinds_of(fields: Sequence[str], number: tuple[str, str]) -> str:
    """Return the kinds of fields; a separator at the end of a line makes no field."""
    kinds = "".join(kind_of(text, number) for text in fields)
    return kinds[:-1] if kinds.endswith("e") else kinds


def _is_row(kinds: str) -> bool:
    return "n" in kinds and "t" not in kinds


def _is_mixed_row(kinds: str) -> bool:
    return "n" in kinds and "t" in kinds


@dataclass(frozen=True)
class _Candidate:
    """A way to read the lines, and the table that this makes."""

    separator: str
    number: tuple[str, str]
    paired: bool
    kinds: tuple[str, ...]
    first: int
    count: int
    own: str

    def fields(self, line: str) -> list[str]:
        return _fields(line, self.separator, paired=self.paired)


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
        i for i, line in enumerate(lines) if line.strip() and not line.lstrip().startswith(_REMARK)
    ]
    texts = [lines[i].replace("−", "-") for i in used]
    joined = "".join(texts)
    found: list[_Candidate] = []
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
    best = _told_apart(path, texts, found, max(found, key=lambda one: one.count), decimal)
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
    for number in _NUMBERS:
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
) -> _Candidate | None:
    """Return the table that a separator and a way to write numbers make; None if there is none.

    Columns of words beside the numbers are taken only where nothing else makes a table.
    """
    kinds = []
    for text in texts:
        fields = _fields(text, separator)
        if paired:
            # Without a partner a field is no number of the kind.
            fields = fields[:-1] if fields[-1] == "" else fields
            fields = _fields(text, separator, paired=True) if len(fields) % 2 == 0 else ["?"]
        kinds.append(kinds_of(fields, number))
    runs = _runs(kinds, _is_mixed_row if words else _is_row)
    if not runs:
        return None
    longest = max(length for _, length in runs)
    first, count = next(run for run in runs if run[1] >= min(LONG, longest))
    if words and 2 * count < len(texts) - first:
        return None
    if words and (
        count < _NAMES
        or not all(_has_words(_fields(t, separator), number) for t in texts[first : first + count])
    ):
        return None
    return _Candidate(separator, number, paired, tuple(kinds), first, count, kinds[first])


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


def _told_apart(
    path: Path,
    texts: Sequence[str],
    found: Sequence[_Candidate],
    best: _Candidate,
    decimal: str | None,
) -> _Candidate:
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
    for text in reversed(texts[max(apart.first - _NAMES, 0) : apart.first]):
        names = [_fields(text, ",")] if "," in text else []
        if any(len(one) == len(rows[0]) and _are_titles(one) for one in names):
            is_separator = True
        elif any(
            len(one) == len(marks.own) and _are_titles(one) for one in names or [[text.strip()]]
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


def _check_fractions(path: Path, texts: Sequence[str], apart: _Candidate) -> None:
    """Refuse fields between commas that look like the sides of decimal commas, some of them.

    Whole numbers have no sign of zero, and no zeros before them unless all of a column have as many digits.
    """
    rows = [apart.fields(text) for text in texts[apart.first : apart.first + apart.count]]
    if any("." in text for row in rows for text in row):
        return
    above = _fields(texts[apart.first - 1], ",") if apart.first else []
    headed = len(above) == len(rows[0]) and _are_titles(above)
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
    """Whether two numbers can hardly be anything else than the sides of a decimal comma."""
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


def _layout(
    path: Path,
    lines: Sequence[str],
    used: Sequence[int],
    texts: Sequence[str],
    best: _Candidate,
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
        names, units, above = _titles(path, texts, best, first)
    _check_preamble(path, used, texts, best, above)
    if not names:
        names, units = _names_in_remark(lines, used[first], best)
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


def _titles(
    path: Path, texts: Sequence[str], best: _Candidate, first: int
) -> tuple[list[str], list[str], int]:
    """Return names and units of the fields, and the number of the first of their lines among the texts."""
    width = len(best.own)
    rows: list[list[str]] = []
    while len(rows) < min(_NAMES, first):
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


def _title_fields(text: str, best: _Candidate, width: int) -> list[str] | None:
    """Return the fields of a line of names or units; None if it is none."""
    fields = best.fields(text) if not best.paired else _fields(text, best.separator)
    for split in (fields, *_other_splits(text, best.separator)):
        while len(split) > width and split[-1].casefold() in ("", "comment"):
            split.pop()
        if len(split) == width + 1 and best.own.endswith("e"):
            split.pop()  # over nothing
        if len(split) == width - 1 and best.own.startswith("dd"):
            split.insert(1, "")  # one name of a date and a time of day
        if len(split) == width and _are_titles(split):
            return split
    return None


def _other_splits(text: str, between: str) -> Iterator[list[str]]:
    """Yield the fields of a line of names that are separated otherwise than the columns."""
    text = text.strip()
    for separator in ("\t", ";", ","):
        if separator in text:
            yield _fields(text, separator)
    yield [part.strip() for part in re.split(r"\s{2,}", text)]
    if between == " ":
        yield re.findall(r"\S+(?:\s*[\[(][^\])]*[\])])?", text)


def _are_titles(fields: Sequence[str]) -> bool:
    """Whether fields may be names or units: text, but for numbers of channels behind the first."""
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


def _are_units(fields: Sequence[str]) -> bool:
    """Whether all fields are units, or say that there is none."""
    known = [_is_a_unit(text) for text in fields if text]
    return bool(known) and all(known)


def _is_a_unit(text: str) -> bool:
    inner = text.strip("[]() ")
    bracketed = text[:1] in "[(" and text[-1:] in "])"
    return bracketed or inner in ("", "-", "1") or is_unit(inner) or time_unit(inner) is not None


def _check_names_line(path: Path, text: str, best: _Candidate, width: int) -> None:
    """Refuse names that are not as many as the columns."""
    between = "\t" if best.separator == " " and "\t" in text else best.separator
    fields = _fields(text, between) if between else []
    names = [name for name in fields if name]
    words = all(kind_of(name, best.number) == "t" and len(name.split()) <= 3 for name in names)
    if len(names) > 2 and words and abs(len(names) - width) <= 2 and not re.search(r"[:=]", text):
        reason = f"its header names {len(names)} columns of {width}"
        raise FileError(str(path), f"{reason}; skip= up to its first row reads them without names")


def _check_preamble(
    path: Path, used: Sequence[int], texts: Sequence[str], best: _Candidate, above: int
) -> None:
    """Refuse rows above the table: they are data, or the table is damaged."""
    kinds = best.kinds[:above]
    alike = [k for k, kind in enumerate(kinds) if _is_row(kind) and len(kind) == len(best.own)]
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
    path: Path, line: int, texts: Sequence[str], best: _Candidate, kinds: str
) -> None:
    """Refuse a row with text among its numbers above the table: it would be left out."""
    width = len(best.own)
    if not _is_mixed_row(kinds) or kinds[0] != "n" or len(kinds) != width:
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


def _names_in_remark(
    lines: Sequence[str], first: int, best: _Candidate
) -> tuple[list[str], list[str]]:
    """Return names from the last remark above a table, as ``numpy.savetxt`` writes them; none if it has others."""
    above = [text.strip() for text in lines[:first] if text.strip()]
    width = len(best.own)
    if width < 2 or not above or not above[-1].startswith(_REMARK):
        return [], []
    fields = _title_fields(above[-1].lstrip("# "), best, width)
    if fields is None or not all(fields):
        return [], []
    split = [named(name) for name in fields]
    return [name for name, _ in split], [unit for _, unit in split]
