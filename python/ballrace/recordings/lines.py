"""Text by pieces: lines in UTF-8 whatever the encoding of the file, and never much of it at once."""

from __future__ import annotations

import codecs
from collections.abc import Generator
from contextlib import closing
from pathlib import Path

from ..errors import FileError

PIECE = 1 << 24
"""How much of a file is read at once [bytes]."""

_LOOK = 1 << 16
"""Bytes that show the encoding."""

_MARKS = {
    codecs.BOM_UTF8: "utf-8",
    codecs.BOM_UTF16_LE: "utf-16-le",
    codecs.BOM_UTF16_BE: "utf-16-be",
}


class Text:
    """A text file.

    Parameters
    ----------
    path : Path
        The file.

    Raises
    ------
    FileError
        It is no text.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.size = path.stat().st_size
        self.told = 0.0
        with path.open("rb") as file:
            start = file.read(_LOOK)
        self._mark = next((mark for mark in _MARKS if start.startswith(mark)), b"")
        self.encoding = _MARKS.get(self._mark) or self._guessed(start)
        # Old files end their lines by a carriage return alone.
        self._returns = b"\n" not in start and b"\r" in start

    def _guessed(self, start: bytes) -> str:
        """Return the encoding of a text without a mark: UTF-8, or else what Western European instruments write."""
        if b"\0" in start:
            half = max(len(start) // 2, 1)
            for encoding, zeros in (("utf-16-le", start[1::2]), ("utf-16-be", start[::2])):
                if zeros.count(0) > 0.9 * half and start.count(0) == zeros.count(0):
                    return encoding
            raise FileError(
                str(self.path), "neither text nor a record of a known format; " + other_ways()
            )
        try:
            # The last character may be cut.
            codecs.getincrementaldecoder("utf-8")().decode(start)
        except UnicodeDecodeError:
            return "cp1252"
        return "utf-8"

    def pieces(self, size: int | None = None) -> Generator[bytes, None, None]:
        """Yield whole lines in UTF-8, ended by new lines; the last may have no end.

        Raises
        ------
        FileError
            There are zero bytes in it, or lines that are no lines.
        """
        decoder = codecs.getincrementaldecoder(self.encoding)("replace")
        rest = b""
        with self.path.open("rb") as file:
            file.seek(len(self._mark))
            while data := file.read(size or PIECE):
                self.told = file.tell() / max(self.size, 1)
                if self.encoding != "utf-8":
                    data = decoder.decode(data).encode()
                if b"\0" in data:
                    raise FileError(
                        str(self.path),
                        "neither text nor a record of a known format; " + other_ways(),
                    )
                data = rest + (data.replace(b"\r", b"\n") if self._returns else data)
                whole = data.rfind(b"\n") + 1
                rest = data[whole:]
                if len(rest) > 4 * PIECE:
                    raise FileError(
                        str(self.path), "has a line of more than 64 MB, which is no row of a table"
                    )
                if whole:
                    yield data[:whole]
        if rest:
            yield rest

    def head(self, size: int) -> tuple[list[str], bool]:
        """Return the lines of the first bytes, at least ``size``, and whether these are all."""
        with closing(self.pieces(size)) as pieces:
            return lines_of(next(pieces, b"")), size >= self.size


def lines_of(piece: bytes) -> list[str]:
    """Return lines without their ends, cut at no other characters, which may stand in a name."""
    text = piece.decode("utf-8", errors="replace").replace("\r\n", "\n")
    lines = text.split("\n")
    return lines[:-1] if lines and not lines[-1] else lines


def other_ways() -> str:
    """Return how samples that no reader knows become a record."""
    return 'with the samples in an array it is br.Recording(array, fs=fs, unit="g")'
