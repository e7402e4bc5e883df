"""Tables with a column a signal, and perhaps one of times: what is a signal, and its sampling rate."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NoReturn

from .._base.numbers import RATES
from .._base.units import ENVELOPE, canonical
from ..errors import FileError, SceneError
from .rates import roundest
from .samples import Said, Samples
from .times import Column, Times, examined, find_times, is_constant, is_counter, is_whole, times_in
from .titles import TIME_UNITS

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from .reading import Key, Reading
    from .times import Steps

_SURE = 2e-4
"""How well times that are rounded have to know the rate, as a part of it."""

_VISIBLE = 1e-6
"""How far times lie off equal steps if they are rounded, in steps."""

_SAME = 1e-3
"""How far a given rate may be off the file's as another way to write it."""

_OTHER = 1e-2
"""Share from which on a given rate contradicts the file's."""

_SLOWEST = 100.0
"""Rate up to which steps below 1 without a unit may be milliseconds [Hz]."""

_FASTEST = 2e6
"""Rate from which steps without a unit are likely no seconds, but days of a spreadsheet [Hz]."""

_EPOCH = 1e8
"""Number from which on whole numbers are times since some date, and no numbers of samples."""

_FREQUENCY = re.compile(r"freq(?:uenc(?:y|ies)|uenz(?:en)?)?", re.IGNORECASE)
_HERTZ = ("hz", "khz")

_SHORT = ("s", "ms", "us", "ns")
_LONG = ("s", "d")


@dataclass(frozen=True, kw_only=True)
class Signals:
    """Columns of a table that are signals.

    Attributes
    ----------
    places : dict of str to int
        Their places among the columns, by the names they get.
    units : dict of str to str
        Their units.
    fs : float or None
        Sampling rate [Hz]; None where nothing tells it.
    about : dict
        Which columns are times, and which count.
    notes : list of str
        What the caller is to be warned of.
    """

    places: dict[str, int]
    units: dict[str, str]
    fs: float | None
    about: dict[str, Any]
    notes: list[str]

    def of(self, values: Sequence[NDArray[Any]], metadata: Mapping[str, Any]) -> Samples:
        """Return the samples among the values of all columns."""
        columns = {name: values[place] for name, place in self.places.items()}
        return Samples(
            columns=columns, fs=self.fs, units=self.units, metadata={**metadata, **self.about}, notes=self.notes
        )  # fmt: skip


def sampled(
    path: Path,
    columns: Sequence[Column],
    reading: Reading,
    said: Said,
) -> Samples:
    """Return the signals of a table, at the rate of its times, the one the file states, or the given one.

    Raises
    ------
    FileError, SceneError
        As of :func:`signals_of`; or there are no samples at the times asked for.
    """
    found = signals_of(path, columns, reading, said)
    window = reading.window(found.fs, columns[0].values.size)
    return found.of([column.values[window] for column in columns], said.metadata)


def signals_of(path: Path, columns: Sequence[Column], reading: Reading, said: Said) -> Signals:
    """Return which columns of a table are signals, and their rate.

    Raises
    ------
    FileError
        Times are not at equal steps, there is no signal, or names are not told apart.
    SceneError
        The given rate is another than that of the times, or what was not said has to be.
    """
    _check_spectrum(path, columns)
    asked = [(_found(columns, key, "columns"), name) for key, name in reading.columns or ()]
    free = [column for column in columns if not _among(column, [one for one, _ in asked])]
    times = _times(columns, free, reading)
    fs, notes = _rate(path, times, reading, said.rate)
    about: dict[str, Any] = {}
    if times is not None:
        about["times"] = [column.name for column in times.columns]
    if reading.columns is None:
        rest = [column for column in free if times is None or not _among(column, times.columns)]
        signals = [c for c in rest if times is None or not is_counter(c, times)]
        signals = signals or [c for c in rest if not c.is_named_time]
        signals = _without_constants(signals)
        if left := [column.name for column in rest if not _among(column, signals)]:
            about["counters"] = left
        asked = [(column, None) for column in signals]
    names = [name or column.name for column, name in asked]
    _check_names(path, names)
    if not names or not columns[0].values.size:
        raise FileError(str(path), "has no column of numbers that is a signal")
    units = {name: canonical(column.unit) for name, (column, _) in zip(names, asked, strict=True)}
    free_names = [name for name, unit in units.items() if not unit]
    if len(said.units) in (1, len(free_names)):
        each = said.units if len(said.units) == len(free_names) else said.units * len(free_names)
        units |= dict(zip(free_names, map(canonical, each), strict=True))
    _check_units(path, units)
    places = [next(k for k, one in enumerate(columns) if one is column) for column, _ in asked]
    by_name = dict(zip(names, places, strict=True))
    return Signals(places=by_name, units=units, fs=fs, about=about, notes=notes)


def _check_spectrum(path: Path, columns: Sequence[Column]) -> None:
    """Refuse a table over frequencies, which is no record over time."""
    first = columns[0] if columns else None
    if first is None or not (first.unit.lower() in _HERTZ or _FREQUENCY.fullmatch(first.name)):
        return
    steps = examined(first)
    if steps is not None and steps.are_equal:
        raise FileError(
            str(path),
            f"is a spectrum over {first.name}, no record over time; export the time signal",
        )


def _without_constants(signals: list[Column]) -> list[Column]:
    """Leave out whole numbers that stay the same before the first signal: dates, numbers of a device."""
    changing = [column for column in signals if not is_constant(column.values)]
    if not changing:
        return signals
    first = next(place for place, column in enumerate(signals) if column is changing[0])
    before = [c for c in signals[:first] if c.unit or not is_whole(c.values)]
    return [*before, *signals[first:]]


def _among(column: Column, columns: Sequence[Column]) -> bool:
    return any(column is one for one in columns)


def cut(path: Path, samples: Samples, reading: Reading) -> Samples:
    """Return what is asked for of samples with a rate: chosen columns, in the time asked for.

    Raises
    ------
    SceneError
        There is no such column, no such time, or the given rate contradicts that of the file.
    FileError
        The file's is no rate, and none is given.
    """
    for name in ("time", "time_unit"):
        value = getattr(reading, name)
        if value not in (None, False):
            raise SceneError(name, repr(value), f"left out: {path.name} has no column of times")
    fs, notes = _agreed(path, samples.fs, reading.fs)
    columns = [Column(name=name, values=x) for name, x in samples.columns.items()]
    asked = reading.columns or [(place, None) for place in range(len(columns))]
    taken = [(_found(columns, key, "columns"), name) for key, name in asked]
    _check_names(path, [name or column.name for column, name in taken])
    units = {
        name or column.name: canonical(samples.units.get(column.name, "")) for column, name in taken
    }
    _check_units(path, units)
    window = reading.window(fs, samples.n_samples)
    return replace(
        samples, columns={name or column.name: column.values[window] for column, name in taken}, fs=fs,
        units=units, notes=[*samples.notes, *notes], others=[at_its_rate(one, reading) for one in samples.others],
    )  # fmt: skip


def at_its_rate(other: Samples, reading: Reading) -> Samples:
    """Return columns at another rate in the time that is asked for, as far as they have it."""
    if other.fs is None or (reading.start is None and reading.stop is None):
        return other
    first, last = (
        None if time is None else int(min(time * other.fs, other.n_samples - 1))
        for time in (reading.start, reading.stop)
    )
    window = slice(first, None if last is None else max(last, (first or 0) + 1))
    return replace(other, columns={name: x[window] for name, x in other.columns.items()})


def _found(columns: Sequence[Column], key: Key, argument: str) -> Column:
    """Return a column by its name, or its place."""
    if isinstance(key, int):
        if -len(columns) <= key < len(columns):
            return columns[key]
    else:
        same = [c for c in columns if c.name == key]
        alike = same or [c for c in columns if c.name.casefold() == key.casefold()]
        if len(alike) == 1:
            return alike[0]
    names = ", ".join(f"{place}: {column.name}" for place, column in enumerate(columns[:20]))
    raise SceneError(argument, repr(key), f"the name or place of one of the columns {names}")


def _times(columns: Sequence[Column], free: list[Column], reading: Reading) -> Times | None:
    if reading.time is False:
        return None
    if reading.time is None or reading.time is True:
        return find_times(free, beside=len(free) < len(columns)) if free else None
    keys = reading.time
    found = times_in([_found(columns, key, "time") for key in keys])
    if found is None:
        allowed = (
            "columns of whole numbers that make a clock, from the longest unit to the shortest"
        )
        raise SceneError("time", repr(keys), allowed)
    return found


def _check_names(path: Path, names: list[str]) -> None:
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        way = 'give columns={0: "a", 1: "b"} by their places'
        raise FileError(str(path), f"two of its columns have one name, {twice!r}; {way}")


def _check_units(path: Path, units: Mapping[str, str]) -> None:
    for name, unit in units.items():
        if unit == ENVELOPE:
            reason = (
                f"its column {name} is in gE, the envelope of an acceleration and no record of one"
            )
            way = "export the acceleration, or take other columns with columns="
            raise FileError(str(path), f"{reason}; {way}")


def _rate(
    path: Path, times: Times | None, reading: Reading, stated: float | None
) -> tuple[float | None, list[str]]:
    """Return the sampling rate, None where nothing tells it, and what to tell of it."""
    if times is None:
        return _agreed(path, stated, reading.fs)
    if times.steps is None:
        if not times.constant:
            way = "time=False reads the rest as samples at equal steps"
            raise FileError(str(path), f"the times {times.name} do not rise; {way}")
        fs = reading.fs if reading.fs is not None else stated
        if fs is None:
            raise SceneError(
                "fs", "None", f"the sampling rate [Hz]: the times {times.name} are all equal"
            )
        return fs, [_note(f"the times {times.name} are all equal", fs)]
    unit = reading.time_unit or times.unit
    known = reading.fs if reading.fs is not None else stated
    unit = unit or _guessed(path, times, times.steps, known)
    scale = TIME_UNITS[unit]
    if scale is None:
        return _agreed(path, stated, reading.fs)
    return _of_steps(path, times, scale, reading.fs, stated)


def _agreed(
    path: Path, stated: float | None, given: float | None
) -> tuple[float | None, list[str]]:
    """Return the rate that a file states, or else the one that is given, if they do not contradict each other.

    Raises
    ------
    SceneError
        They do.
    FileError
        The file's is no rate, and none is given.
    """
    if stated is not None and not RATES[0] <= stated <= RATES[1]:
        if given is None:
            reason = f"has a sampling rate of {stated:g} Hz; give fs if you know it"
            raise FileError(str(path), reason)
        stated = None
    if stated is None or given is None:
        return (given if stated is None else stated), []
    off = abs(given / stated - 1.0)
    if off <= _SAME:
        return stated, []
    if off <= _OTHER:
        return given, [_note(f"the file says {stated:g} Hz", given)]
    raise SceneError("fs", f"{given:g}", f"the rate in {path.name}, {stated:g} Hz, or absent")


def _note(why: str, fs: float) -> str:
    return f"{why}; {fs:g} Hz was taken"


def _guessed(path: Path, times: Times, steps: Steps, known: float | None) -> str:
    """Return the unit of times that do not say it: by the known rate, or seconds where only these are likely.

    Raises
    ------
    SceneError
        It has to be said.
    """
    if known is None and not (steps.are_equal or steps.are_rounded):
        return "s"
    counts = steps.are_counts and abs(steps.mean - 1.0) < 1e-9 and abs(steps.first) < _EPOCH
    if known is not None:
        fitting = [
            u
            for u in _SHORT
            if _off(known, steps.mean * (TIME_UNITS[u] or 1.0)) <= max(_OTHER, steps.within)
        ]
        if fitting or counts:
            return fitting[0] if fitting else "samples"
        if steps.mean >= 1.0 and (steps.are_equal or steps.are_rounded):
            listed = ", ".join(f"{r:g} Hz" for _, r in _readings(steps))
            allowed = f"the rate by the times {times.name}, {listed}, or time=False where they are no times"
            raise SceneError("fs", f"{known:g}", allowed)
        return "s"
    rate = 1.0 / steps.mean
    if _SLOWEST < rate < _FASTEST or (1.0 < rate <= _SLOWEST and times.name == "t"):
        return "s"
    if counts:
        why = f"the column {times.name} counts samples; or time_unit= if these are times"
        allowed = f"the sampling rate [Hz]: {why}"
        raise SceneError("fs", "None", allowed)
    listed = ", ".join(f'"{unit}" makes {rate:g} Hz' for unit, rate in _readings(steps))
    allowed = f"the unit of the times {times.name}, which rise by {steps.mean:.6g} and have none: {listed}; or fs="
    raise SceneError("time_unit", "None", allowed)


def _readings(steps: Steps) -> list[tuple[str, float]]:
    """Return what the rate is in units that are likely [Hz]."""
    return [
        (u, float(f"{1.0 / (steps.mean * (TIME_UNITS[u] or 1.0)):.6g}"))
        for u in (_SHORT if steps.mean > 1.0 / _FASTEST else _LONG)
    ]


def _off(fs: float, step: float) -> float:
    return abs(fs * step - 1.0)


def _of_steps(
    path: Path, times: Times, scale: float, given: float | None, stated: float | None
) -> tuple[float, list[str]]:
    """Return the rate of times in a known unit, or the given one where they cannot resolve it."""
    steps = times.steps
    assert steps is not None
    step = steps.mean * scale
    rate = roundest(1.0 / step, steps.within)
    known = given if given is not None else stated
    if steps.are_equal or steps.are_rounded:
        if known is None:
            if steps.off > _VISIBLE and steps.within > _SURE:
                about = f"rounded to {steps.grain * scale:g} s, and make {rate:g} Hz within {steps.within:.2%}"
                raise SceneError(
                    "fs", "None", f"the sampling rate [Hz]: the times {times.name} are {about}"
                )
            return _usable(path, rate), []
        off = _off(known, step)
        if off <= steps.within:
            resolved = steps.are_equal or steps.within <= _SURE or given is None
            about = f"the times {times.name} are rounded to {steps.grain * scale:g} s and do not resolve the rate"
            return known, [] if resolved else [_note(about, known)]
        if off <= _SAME and given is not None and steps.within > _VISIBLE:
            return given, []
        if off <= _SAME or (given is None and off <= _OTHER):
            return rate, []
        if off <= _OTHER:
            return known, [_note(f"the times {times.name} make {rate:g} Hz", known)]
        _refuse_contradiction(path, times, 1.0 / step, given, stated)
    missing = steps.largest >= 1.5 * steps.mean + 2.0 * steps.grain
    reason = f"the times {times.name} are not at equal steps: {steps.off:.1f} steps off"
    if given is None or missing or _off(given, step) > _OTHER:
        way = (
            "samples seem to be missing"
            if missing
            else "give fs if they are only recorded unevenly"
        )
        raise FileError(str(path), f"{reason}; {way}, or time=False")
    return given, [_note(reason, given)]


def _refuse_contradiction(
    path: Path, times: Times, rate: float, given: float | None, stated: float | None
) -> NoReturn:
    """Refuse two rates that are both precise."""
    if given is not None:
        way = "or absent; time=False where they are no times"
        allowed = f"the rate by the times {times.name}, {rate:.6g} Hz, {way}"
        raise SceneError("fs", f"{given:g}", allowed)
    reason = (
        f"says {stated:g} Hz, and its times {times.name} make {rate:g} Hz; give fs and time=False"
    )
    raise FileError(str(path), reason)


def _usable(path: Path, rate: float) -> float:
    return _agreed(path, rate, None)[0] or rate
