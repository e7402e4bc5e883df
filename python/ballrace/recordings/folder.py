"""The files of a folder as one sequence of records, each read when it is asked for, with their times."""

from __future__ import annotations

import datetime as dt
import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal, get_args, overload

import numpy as np

from .._io.files import as_path
from ..errors import SceneError
from .dispatch import read

if TYPE_CHECKING:
    import os
    from collections.abc import Iterator
    from pathlib import Path

    from numpy.typing import NDArray

    from .recording import Recording

Times = Literal["names", "modified"]

_DIGITS = re.compile(r"\d+")
_STAMP = re.compile(
    r"(?<!\d)(?P<Y>(?:19|20)\d{2})[-_. ]?(?P<m>\d{2})[-_. ]?(?P<d>\d{2})[-_. T]{0,3}"
    r"(?P<H>\d{2})[-_.: hH]?(?P<M>\d{2})(?:[-_.: m]?(?P<S>\d{2})(?:[.,_](?P<f>\d{1,6}))?)?(?!\d)"
)
"""A date and a time of day in a name: ``2004.02.12.10.32.39``, ``20260131_120000``."""


class RecordFolder(Sequence["Recording"]):
    """Records in the order of their times, each read anew when it is asked for: many may follow each other.

    Made by :func:`ballrace.read_folder`.

    Attributes
    ----------
    paths : tuple of Path
        The files.
    times : ndarray, shape (n,)
        Times of the records: seconds from the first, by names that have date and time or by changes of the files;
        else the numbers in the names.
    """

    def __init__(
        self, paths: Sequence[Path], times: NDArray[np.float64], options: dict[str, Any]
    ) -> None:
        self.paths = tuple(paths)
        self.times = times
        self._options = options

    def __repr__(self) -> str:
        first, last = self.paths[0].name, self.paths[-1].name
        times = f"times {self.times[0]:g} to {self.times[-1]:g}"
        return f"<RecordFolder: {len(self)} records, {first} to {last}, {times}>"

    def __len__(self) -> int:
        return len(self.paths)

    @overload
    def __getitem__(self, place: int) -> Recording: ...

    @overload
    def __getitem__(self, place: slice) -> RecordFolder: ...

    def __getitem__(self, place: int | slice) -> Recording | RecordFolder:
        if isinstance(place, slice):
            if not self.paths[place]:
                raise SceneError("records", repr(place), f"some of the {len(self)} records")
            return RecordFolder(self.paths[place], self.times[place], self._options)
        return read(self.paths[place], **self._options)

    def __iter__(self) -> Iterator[Recording]:
        for path in self.paths:
            yield read(path, **self._options)


def read_folder(
    folder: str | os.PathLike[str],
    pattern: str = "*",
    *,
    times: Times | None = None,
    **options: Any,
) -> RecordFolder:
    """Return the files of a folder as one sequence of records, for :func:`ballrace.trend`.

    Numbers in names count as numbers: ``2.csv`` comes before ``10.csv``. Nothing is read until a record is asked
    for.

    Parameters
    ----------
    folder : path
        The folder; of folders in it nothing is taken.
    pattern : str
        Which of its files, as ``"*.csv"``; hidden ones are left out.
    times : {"names", "modified"}, optional
        From where the times are: from names, which have a date with a time of day or one number that differs, or
        from when the files were last changed. By default names where they have it, else 0, 1, 2, …
    **options
        Of :func:`ballrace.read`, for every file: ``fs``, ``columns`` and so on.

    Returns
    -------
    RecordFolder
        Records with ``times``.

    Raises
    ------
    SceneError
        An argument is not usable, no file is found, or names tell no times that rise.
    OSError
        The folder cannot be read.

    Examples
    --------
    >>> import ballrace as br, numpy as np, pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     for minute in (0, 10, 20):
    ...         path = pathlib.Path(folder) / f"2026-11-26_10-{minute:02}-00.csv"
    ...         br.Recording(np.sin(np.arange(64.0)), fs=1000.0, unit="g").write(path)
    ...     records = br.read_folder(folder, "*.csv")
    ...     records.times.tolist(), records[2].n_samples
    ([0.0, 600.0, 1200.0], 64)
    """
    path = as_path(folder, "folder", "the name of a folder")
    if times is not None and times not in get_args(Times):
        raise SceneError("times", repr(times), f"one of {', '.join(get_args(Times))}, or None")
    if not isinstance(pattern, str) or "/" in pattern:
        raise SceneError("pattern", repr(pattern), "a pattern of names of files, as *.csv")
    found = [
        one
        for one in path.iterdir()
        if one.match(pattern) and not one.name.startswith(".") and one.is_file()
    ]
    if not found:
        raise SceneError("pattern", repr(pattern), f"names of files in {path}")
    found.sort(key=_natural)
    if times == "modified":
        changed = np.array([one.stat().st_mtime for one in found])
        order = np.argsort(changed, kind="stable")
        found, rising = [found[k] for k in order], changed[order] - changed[order[0]]
    else:
        named = _by_names(found)
        if named is None and times == "names":
            allowed = "names with a date and a time of day, or one number that differs; or times='modified'"
            raise SceneError("times", repr(times), allowed)
        rising = np.arange(float(len(found))) if named is None else named
        order = np.argsort(rising, kind="stable")
        found, rising = [found[k] for k in order], rising[order]
    if not (np.diff(rising) > 0.0).all():
        place = int(np.argmin(np.diff(rising)))
        allowed = f"different for each file, and not as of {found[place].name} and {found[place + 1].name}"
        raise SceneError("times", repr(times), allowed)
    return RecordFolder(found, rising, options)


def _natural(path: Path) -> list[tuple[int, str]]:
    """Return by what names sort with their numbers as numbers."""
    parts = re.split(r"(\d+)", path.name)
    return [(int(part), "") if part.isdecimal() else (-1, part) for part in parts]


def _by_names(paths: Sequence[Path]) -> NDArray[np.float64] | None:
    """Return times by the names: seconds from the first of dates, or the one number in them that differs."""
    stamps = [_STAMP.search(path.name) for path in paths]
    if all(stamps):
        try:
            at = [_date(found) for found in stamps if found is not None]
        except ValueError:
            return None
        first = min(at)
        return np.array([(one - first).total_seconds() for one in at])
    numbers = [[int(n) for n in _DIGITS.findall(path.stem)] for path in paths]
    if len({len(row) for row in numbers}) != 1 or not numbers[0]:
        return None
    differ = [column for column in zip(*numbers, strict=True) if len(set(column)) > 1]
    return np.array(differ[0], dtype=np.float64) if len(differ) == 1 else None


def _date(found: re.Match[str]) -> dt.datetime:
    year, month, day, hour, minute = (int(found[name]) for name in "YmdHM")
    fraction = int((found["f"] or "").ljust(6, "0")) if found["f"] else 0
    return dt.datetime(year, month, day, hour, minute, int(found["S"] or 0), fraction)
