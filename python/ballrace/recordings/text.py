"""Text tables: a column a signal, with or without a header and times."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import numpy as np

from .._base.libraries import pl
from .._io.parquet import writing_to
from ..errors import FileError, SceneError
from .fields import kind_of, kinds_of
from .headers import broken_row
from .layout import layout_of
from .lines import Text, lines_of
from .preamble import described
from .sampled import sampled, signals_of
from .stamps import seconds
from .times import Column

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from .layout import Layout
    from .reading import Reading
    from .samples import Samples

_FORMULA = re.compile(r"^'*[=+@\t\r-]")
"""How a cell begins that a spreadsheet takes for a formula, which may do anything; a quote makes it text."""

_HEADS = (1 << 13, 1 << 16, 1 << 22)
"""First bytes of a file in which its table is looked for; more only where they do not show it."""

_SHOWN = 50
"""Lines from the table's first that are enough to show it."""

_WIDEST = 4096
"""Most columns."""

_FOOTER = 30
"""Lines that may follow any table."""

_PROBE = 1 << 16
"""Rows whose times say which rows are asked for."""


def write(samples: Samples, temporary: Path, path: Path) -> None:
    """Write times and columns with commas between them, all digits, and units in the header."""
    columns = {"t [s]": samples.t}
    for name, x in samples.columns.items():
        unit = samples.units.get(name)
        title = f"{name} [{unit}]" if unit else name
        columns[f"'{title}" if _FORMULA.match(title) else title] = x
    with writing_to(path):
        pl.DataFrame(columns).write_csv(temporary)


def read(path: Path, reading: Reading) -> Samples:
    """Read a table, however its numbers are separated and written, wherever it begins.

    Raises
    ------
    FileError
        There is no table, it ends in the middle, or it can be read in two ways.
    SceneError
        What was said about it does not fit.
    """
    text = Text(path)
    layout = _layout(path, text, reading)
    said = described(layout.preamble)
    if reading.start is not None or reading.stop is not None:
        return _part(path, text, layout, reading)
    arrays = _Body(path, layout).read(text, reading, slice(0, None))
    if len(arrays) > max(64, arrays[0].size) and not layout.names:
        raise FileError(str(path), _too_wide(len(arrays)))
    return sampled(path, columns_of(layout, arrays, said.metadata), reading, said)


def _layout(path: Path, text: Text, reading: Reading) -> Layout:
    """Return where the table stands, from as much of the beginning as shows it."""
    skip = reading.skip or 0
    for size in _HEADS:
        lines, all_of_it = text.head(size)
        enough = all_of_it or size == _HEADS[-1]
        try:
            shown = [""] * skip + lines[skip:]
            found = layout_of(path, shown, reading.decimal, skipped=reading.skip is not None)
        except FileError:
            if enough:
                raise
            continue
        if enough or len(lines) - found.first >= _SHOWN:
            break
    if len(found.kinds) > _WIDEST:
        raise FileError(str(path), _too_wide(len(found.kinds)))
    return found


def _too_wide(width: int) -> str:
    way = "numpy.loadtxt reads them as an array of rows, and br.Recording takes those that are signals"
    return f"has {width} numbers in a line, more than there are lines; {way}"


def _part(path: Path, text: Text, layout: Layout, reading: Reading) -> Samples:
    """Read the rows between ``start`` and ``stop``, by the rate and the signals that the first ones show."""
    said = described(layout.preamble)
    shown = _Body(path, layout).read(text, reading, slice(0, _PROBE))
    columns = columns_of(layout, shown, said.metadata)
    found = signals_of(path, columns, reading, said)
    body = _Body(path, layout)
    arrays = body.read(text, reading, reading.window(found.fs, 1 << 62))
    if not arrays[0].size:
        allowed = f"below the length of the record, {body.rows / (found.fs or 1.0):g} s"
        raise SceneError("start", repr(reading.start), allowed)
    # Columns of text are none.
    kept = [x for x, kind in zip(arrays, layout.kinds, strict=True) if kind in "nd"]
    return found.of(kept, said.metadata)


def columns_of(
    layout: Layout, arrays: Sequence[NDArray[Any]], metadata: dict[str, Any]
) -> list[Column]:
    """Return the columns of numbers and times; text is kept where it does not change, and left out else."""
    columns = []
    for place, (kind, values) in enumerate(zip(layout.kinds, arrays, strict=True)):
        name = layout.names[place] if layout.names else ""
        name = name[1:] if name.startswith("'") and _FORMULA.match(name) else name
        name = name or f"column_{place + 1}"
        unit = layout.units[place] if layout.units else ""
        match kind:
            case "n":
                columns.append(Column(name=name, values=values, unit=unit))
            case "d":
                stamps, grain, first = seconds(values)
                metadata.setdefault("start", first)
                columns.append(
                    Column(name=name, values=stamps, unit=unit, stamped=True, grain=grain)
                )
            case "t" if values.size:
                metadata.setdefault("texts", {})[name] = str(values[0])
    return columns


class _Body:
    """The rows of a table, read by pieces."""

    def __init__(self, path: Path, layout: Layout) -> None:
        self._path = path
        self._layout = layout
        self._decimal = layout.decimal
        self._decided = layout.decided
        self._fields = [_Growing(np.float64 if kind == "n" else object) for kind in layout.kinds]
        self.rows = 0
        self._line = 0
        self._footer = ""
        self._others = 0

    def read(self, text: Text, reading: Reading, window: slice) -> list[NDArray[Any]]:
        """Return the fields of the rows of a window, an array a field."""
        first, last = window.start or 0, window.stop
        for piece in text.pieces():
            below = piece if self._line >= self._layout.first else self._below(piece)
            at = max(self._line, self._layout.first)
            if self._footer:
                self._check_footer(lines_of(below), at)
            else:
                self._take(below, at, first, last, text.told)
            self._line += piece.count(b"\n")
            reading.tell(text.told)
            if last is not None and self.rows >= last:
                break
        if self._others > max(_FOOTER, self.rows):
            reason = f"{self._footer} and {self._others} others follow {self.rows} rows"
            raise FileError(
                str(self._path),
                f"not a table of numbers: {reason}; skip= and decimal= may find another",
            )
        return [field.taken() for field in self._fields]

    def _below(self, piece: bytes) -> bytes:
        """Return what of a piece is below the first line of the table."""
        at = 0
        for _ in range(self._layout.first - self._line):
            at = piece.find(b"\n", at) + 1
            if not at:
                return b""
        return piece[at:]

    def _take(self, piece: bytes, at: int, first: int, last: int | None, done: float) -> None:
        """Keep those rows of a piece, which begins in a line ``at``, that are asked for."""
        table = self._parsed(piece)
        if table is None:
            table = self._parsed_by_lines(piece, at)
        if table is None:
            return
        start, stop = self.rows, self.rows + table.height
        self.rows = stop
        if stop <= first or (last is not None and start >= last):
            return
        table = table.slice(
            max(first - start, 0), None if last is None else last - max(first, start)
        )
        whole = int(1.02 * stop / done)
        likely = (whole if last is None else min(whole, last)) - first
        for kind, field, column in zip(
            self._layout.kinds, self._fields, table.get_columns(), strict=True
        ):
            if kind in "ndt":
                field.add(column.to_numpy(), likely)

    def _parsed(self, piece: bytes) -> pl.DataFrame | None:
        """Return the rows of a piece, None where some of its lines are none."""
        layout = self._layout
        schema: dict[str, Any] = {
            str(place): pl.Float64 if kind == "n" else pl.String
            for place, kind in enumerate(layout.kinds)
        }
        data = self._canonical(piece)
        if data is None or not data or data.isspace():
            return None
        try:
            table = pl.read_csv(
                data, has_header=False, separator=_separator(layout), schema=schema, comment_prefix="#",
                encoding="utf8-lossy", truncate_ragged_lines=False, raise_if_empty=False,
            )  # fmt: skip
        except (pl.exceptions.PolarsError, pl.exceptions.PanicException):
            return None
        filled = zip(layout.kinds, table.null_count().row(0), strict=True)
        if any(missing and kind in "nd" for kind, missing in filled):
            return None
        stamps = [str(place) for place, kind in enumerate(layout.kinds) if kind == "d"]
        begun = all(table[name].str.contains(r"^ *\d").all() for name in stamps)
        return table if begun else None

    def _canonical(self, piece: bytes) -> bytes | None:
        """Return a piece with points as decimal marks and nothing but separators between numbers."""
        layout = self._layout
        piece = _plain(piece)
        if not self._decided and layout.separator != "," and (b"," in piece or b"." in piece):
            # Whole numbers so far.
            self._decided, self._decimal = True, "," if b"," in piece else "."
        if b'"' in piece and ("t" not in layout.kinds or layout.decimal == ","):
            piece = re.sub(rb'"([^"\n]*)"', self._unquoted, piece)
        if layout.thousands and layout.separator != layout.thousands:
            piece = piece.replace(layout.thousands.encode(), b"").replace("’".encode(), b"")
        if layout.paired:
            piece = piece.replace(b",\n", b"\n").removesuffix(b",")
            piece = re.sub(rb"([^,\n]*),([^,\n]*)(,|(?=\n)|\Z)", rb"\1.\2\3", piece)
        elif self._decimal == "," and layout.separator != ",":
            if layout.separator == ", ":
                piece = re.sub(rb", +|,(?=\n|\Z)", b";", piece)
            if b"." in piece and "d" not in layout.kinds:
                return None
            piece = piece.replace(b",", b".")
        if (b"D" in piece or b"d" in piece) and set(layout.kinds) <= {"n", "e"}:
            piece = re.sub(rb"(?<=[\d.])[dD](?=[+-]?\d)", b"e", piece)
        if layout.separator == " ":
            piece = piece.replace(b"\t", b" ")
        mark = _separator(layout).encode()
        if b" " in piece:
            piece = _without_blanks(piece, mark.strip(b" "))
        if layout.ended:
            piece = piece.replace(mark + b"\n", b"\n").removesuffix(mark)
        return piece

    def _unquoted(self, found: re.Match[bytes]) -> bytes:
        inner = found[1]
        if self._layout.separator == "," and self._layout.decimal == ",":
            return (
                inner.replace(b".", b"").replace(b",", b".")
                if self._layout.thousands
                else inner.replace(b",", b".")
            )
        return inner.replace(b",", b"") if self._layout.thousands == "," else inner

    def _parsed_by_lines(self, piece: bytes, at: int) -> pl.DataFrame | None:
        """Return the rows of a piece up to the first line that is none, where a footer begins."""
        lines = lines_of(piece)
        rows = []
        for number, line in enumerate(lines):
            if not line.strip(" \t\r\x1a") or line.lstrip().startswith("#"):
                continue
            if not self._is_row(line):
                self._begin_footer(lines, number, at)
                break
            rows.append(line.lstrip(" "))
        table = self._parsed("\n".join(rows).encode()) if rows else None
        if rows and table is None:
            reason = "not a table of numbers, or damaged: numbers below its first lines are written otherwise"
            raise FileError(str(self._path), reason)
        return table

    @property
    def _number(self) -> tuple[str, str]:
        return self._decimal, self._layout.thousands

    def _is_row(self, line: str) -> bool:
        kinds, own = kinds_of(self._layout.fields(line), self._number), self._layout.kinds
        alike = all(wanted in {kind, "t", "e"} for kind, wanted in zip(kinds, own, strict=False))
        return len(kinds) == len(own) and alike

    def _begin_footer(self, lines: list[str], number: int, at: int) -> None:
        """Take a line as the first of a footer, unless it is a broken row, or rows follow."""
        layout, line = self._layout, lines[number]
        fields = layout.fields(line)
        first = next((kind for text in fields if (kind := kind_of(text, self._number)) != "e"), "e")
        if first in ("n", "d"):
            reason = broken_row(fields, layout.kinds, layout.names, at + number + 1, self._number)
            raise FileError(str(self._path), reason)
        self._footer = f"line {at + number + 1} ({line.strip()[:40]!r})"
        self._check_footer(lines[number + 1 :], at + number + 1)

    def _check_footer(self, lines: list[str], at: int) -> None:
        """Refuse rows below a footer."""
        self._others += sum(1 for line in lines if line.strip())
        for number, line in enumerate(lines):
            kinds = kinds_of(self._layout.fields(line), self._number)
            if "n" in kinds and "t" not in kinds and not line.lstrip().startswith("#"):
                way = f"cut the file there, or read what follows with skip={at + number}"
                reason = f"{self._footer} interrupts the table, and line {at + number + 1} has numbers again"
                raise FileError(str(self._path), f"not a table of numbers: {reason}; {way}")


def _plain(piece: bytes) -> bytes:
    """Return lines ended by new lines alone, with the common sign of minus, without the end of old texts."""
    for old, new in ((b"\r\n", b"\n"), ("−".encode(), b"-"), (b"\x1a", b"")):
        if old[:1] in piece:  # is found faster
            piece = piece.replace(old, new)
    return piece


def _without_blanks(piece: bytes, mark: bytes) -> bytes:
    """Return lines with one blank for several, and none at their ends and around what separates."""
    while b"  " in piece:
        piece = piece.replace(b"  ", b" ")
    for around in filter(None, (b"\n", mark)):
        piece = piece.replace(b" " + around, around).replace(around + b" ", around)
    return piece.strip(b" ")


class _Growing:
    """An array that grows without being copied, where its length is foreseen."""

    def __init__(self, kind: Any) -> None:
        self._values = np.empty(0, dtype=kind)
        self._size = 0

    def add(self, values: NDArray[Any], likely: int) -> None:
        """Append values to an array that is likely to become so long."""
        size = self._size + values.size
        if size > self._values.size:
            grown = np.empty(max(size, likely), dtype=self._values.dtype)
            grown[: self._size] = self._values[: self._size]
            self._values = grown
        self._values[self._size : size] = values
        self._size = size

    def taken(self) -> NDArray[Any]:
        """Return what was added."""
        return self._values[: self._size]


def _separator(layout: Layout) -> str:
    """Return what polars takes for a separator; of one column, what is in none."""
    return {"": "\t", ", ": ";"}.get(layout.separator, layout.separator)
