"""Arguments of a caller about a file that the file does not say itself, or that cannot be recognised."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

from .._base.numbers import counted, real, sampling_rate
from ..errors import SceneError
from .titles import TIME_UNITS, time_unit

Key = str | int
"""A column, by its name or by its place from 0; -1 is the last."""

Chosen = Key | Iterable[Key] | Mapping[Key, str] | None
"""Columns that are asked for, perhaps with new names."""

_TEXT_ONLY = ("skip", "decimal")


def _untold(_share: float) -> None:
    pass


@dataclass(frozen=True, kw_only=True)
class Reading:
    """The arguments of :func:`ballrace.read` about the content of a file, checked.

    Attributes
    ----------
    fs : float or None
        Sampling rate [Hz].
    skip : int or None
        Lines before the names, or before the first row.
    columns : list of (key, name) or None
        Columns to take as signals, and how to call them; None as in the file.
    decimal : {".", ","} or None
        Decimal mark.
    time : list of keys, False or None
        The column of times, or those of a clock; False where no column is one.
    time_unit : str or None
        Unit of the times, one of :data:`.titles.TIME_UNITS`.
    start, stop : float or None
        Times from the first sample between which samples are taken [s].
    tell : function of the share done, 0 to 1
        Called while a long file is read.
    """

    fs: float | None = None
    skip: int | None = None
    columns: list[tuple[Key, str | None]] | None = None
    decimal: str | None = None
    time: list[Key] | bool | None = None
    time_unit: str | None = None
    start: float | None = None
    stop: float | None = None
    tell: Callable[[float], object] = field(default=_untold, compare=False)

    def to_json(self) -> dict[str, Any]:
        """Return the arguments as JSON holds them."""
        return {one.name: getattr(self, one.name) for one in fields(self) if one.name != "tell"}

    def refuse_text_options(self, path: Path, title: str) -> None:
        """Refuse what is said of text about a file that is none.

        Raises
        ------
        SceneError
            It has such an argument.
        """
        for name in _TEXT_ONLY:
            if (value := getattr(self, name)) is not None:
                raise SceneError(name, repr(value), f"left out: {path.name} is {title}, no text")

    def window(self, fs: float | None, count: int) -> slice:
        """Return which of the samples are asked for.

        Raises
        ------
        SceneError
            ``start`` is beyond the last, or there is no rate.
        """
        if self.start is None and self.stop is None:
            return slice(0, count)
        if fs is None or not fs > 0.0:
            name = "start" if self.start is not None else "stop"
            raise SceneError("fs", "None", f"the sampling rate [Hz], which {name} needs")
        first = 0 if self.start is None else _sample(self.start, fs)
        last = count if self.stop is None else min(count, _sample(self.stop, fs))
        if first >= min(count, last):
            allowed = f"below the length of the record, {count / fs:g} s"
            raise SceneError("start", repr(self.start), allowed)
        return slice(first, last)


def _sample(time: float, fs: float) -> int:
    """Return the first sample at a time or later; rounding does not make it the next one."""
    return math.ceil(min(time * fs - 1e-6, 2.0**62))


def key_of(text: str) -> Key:
    """Return a column that was typed: a place where it is a whole number, else a name.

    >>> key_of(" -1"), key_of("acc left ")
    (-1, 'acc left')
    """
    text = text.strip()
    return int(text) if text.removeprefix("-").isdecimal() else text


def checked(
    *, fs: object, skip: object, columns: object, decimal: object, time: object, time_unit: object,
    start: object, stop: object,
) -> Reading:  # fmt: skip
    """Return the arguments of :func:`ballrace.read` checked.

    Raises
    ------
    SceneError
        One of them is not usable.
    """
    if decimal not in (None, ".", ","):
        raise SceneError("decimal", repr(decimal), '".", ",", or None')
    first, last = _bound("start", start), _bound("stop", stop)
    if first is not None and last is not None and not first < last:
        raise SceneError("stop", repr(stop), f"after start, {first:g} s")
    return Reading(
        fs=None if fs is None else sampling_rate(fs),
        skip=None if skip is None else counted("skip", skip, 0),
        columns=_columns(columns),
        decimal=None if decimal is None else str(decimal),
        time=_time(time),
        time_unit=_unit(time_unit),
        start=first,
        stop=last,
    )


def _bound(name: str, value: object) -> float | None:
    if value is None:
        return None
    if not 0.0 <= real(value) < math.inf:
        raise SceneError(name, repr(value), "a time from the first sample, from 0 [s], or None")
    return real(value)


def _unit(value: object) -> str | None:
    if value is None:
        return None
    found = time_unit(value) if isinstance(value, str) else None
    if found is None:
        raise SceneError("time_unit", repr(value), f"one of {', '.join(TIME_UNITS)}, or None")
    return found


def _is_key(value: object) -> bool:
    return isinstance(value, str | int) and not isinstance(value, bool)


def _columns(value: Any) -> list[tuple[Key, str | None]] | None:
    if value is None:
        return None
    allowed = "names or places of columns, or a mapping from them to new names"
    pairs: list[tuple[Any, Any]]
    if isinstance(value, Mapping):
        pairs = list(value.items())
    else:
        keys = [value] if _is_key(value) else list(value) if isinstance(value, Iterable) else [None]
        pairs = [(key, None) for key in keys]
    usable = all(_is_key(key) and isinstance(name, str | None) for key, name in pairs)
    if not pairs or not usable:
        raise SceneError("columns", repr(value), allowed)
    return pairs


def _time(value: Any) -> list[Key] | bool | None:
    if value is None or value is False:
        return value
    keys = [value] if _is_key(value) else list(value) if isinstance(value, Iterable) else []
    if not keys or not all(map(_is_key, keys)):
        allowed = "the name or place of a column, several of a clock, False for none, or None"
        raise SceneError("time", repr(value), allowed)
    return keys
