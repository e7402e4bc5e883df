"""Columns that are times: recognised by their names, their units, and by what they do.

Times rise by equal steps, up to the digits they are written with. So do numbers of samples and clocks in several
columns (hour, minute, second, microsecond); none of these is a signal.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .titles import is_time_name, time_unit

EQUAL = 0.1
"""How far a time may lie off equal steps, in steps: they are rounded, or one is missing."""

FEW = 8
"""Rows from which steps alone say that a column is of times."""

_BLOCK = 1 << 20
"""Numbers that are looked at together."""

_EDGE = 500
"""Numbers at both ends of a column that show to which digits it is written."""

_CHAIN = (("d", 86400.0, 32.0), ("h", 3600.0, 24.0), ("min", 60.0, 60.0), ("s", 1.0, 61.0))
"""Columns of a clock: unit, its length [s], and what its numbers are below."""

_FRACTIONS = (("ms", 1e-3, 1e3), ("us", 1e-6, 1e6), ("ns", 1e-9, 1e9))

_STRAIGHT = 0.05
"""How far times that jitter or have gaps lie off a straight line, as a part of their length."""

_SELDOM = 0.02
"""Share of steps that are unlike the others below which they are no rounding."""

_PLAUSIBLE = 50.0, 1e6
"""Sampling rates of records of vibration [Hz]: they decide where a clock's digits leave two readings."""


@dataclass(kw_only=True, eq=False)
class Column:
    """A column of a table.

    Attributes
    ----------
    name : str
        As in the file.
    values : ndarray, shape (n,)
        Numbers, of any type.
    unit : str
        As in the file; empty where there is none.
    stamped : bool
        Whether it was of dates and times of day; the values are seconds.
    grain : float
        To what it is rounded; 0 where that has to be found.
    """

    name: str
    values: NDArray[Any]
    unit: str = ""
    stamped: bool = False
    grain: float = 0.0

    @property
    def time_unit(self) -> str:
        """Unit of time that its unit or its name says; empty if none."""
        return "s" if self.stamped else time_unit(self.unit) or is_time_name(self.name)[1]

    @property
    def is_named_time(self) -> bool:
        """Whether the column's name or its unit says that it is of times."""
        if self.stamped:
            return True
        if self.unit and time_unit(self.unit) is None:
            return False
        return is_time_name(self.name)[0]

    @property
    def may_be_time(self) -> bool:
        """Whether nothing says that it is of something else."""
        return not self.unit or time_unit(self.unit) is not None


@dataclass(frozen=True, kw_only=True)
class Steps:
    """How a column rises.

    Attributes
    ----------
    first, mean : float
        Its first value, and the mean step.
    off : float
        Largest distance from equal steps, in steps.
    spread : float
        Between which bounds these distances lie.
    largest : float
        Largest step.
    odd : int
        Number of steps that are unlike most.
    grain : float
        To what the values are rounded.
    count : int
        Number of values.
    """

    first: float
    mean: float
    off: float
    spread: float
    largest: float
    odd: int
    grain: float
    count: int

    @property
    def are_equal(self) -> bool:
        """Whether the steps are equal but for small errors."""
        return self.off <= EQUAL

    @property
    def are_rounded(self) -> bool:
        """Whether the steps would be equal if they were not rounded.

        Where hardly any step is unlike the others, a sample is missing: rounding would show in more of them.
        """
        seldom = 0 < self.odd <= max(3.0, _SELDOM * self.count)
        return self.spread <= 2.05 * self.grain and not seldom

    @property
    def are_nearly_equal(self) -> bool:
        """Whether the times nearly follow a straight line, as of times that are rounded, jitter or have gaps."""
        length = self.mean * (self.count - 1)
        return self.spread <= max(_STRAIGHT * length, 2.05 * self.grain)

    @property
    def are_counts(self) -> bool:
        """Whether the times are whole numbers of the unit."""
        return self.off < 1e-6 and self.mean >= 1.0 and abs(self.mean - round(self.mean)) < 1e-9

    @property
    def within(self) -> float:
        """How far the mean step may be off, as a part of it."""
        return max(self.grain / (self.mean * (self.count - 1)), 1e-12)


@dataclass(frozen=True, kw_only=True)
class Times:
    """The times of a table.

    Attributes
    ----------
    columns : tuple of Column
        Columns they are in.
    unit : str
        Their unit, of :data:`.titles.TIME_UNITS`; empty where nothing says it.
    steps : Steps or None
        How they rise; None if they do not.
    constant : bool
        Whether all are equal.
    """

    columns: tuple[Column, ...]
    unit: str
    steps: Steps | None
    constant: bool = False

    @property
    def name(self) -> str:
        """Name of the columns, for messages."""
        return ", ".join(column.name for column in self.columns)


def examined(column: Column) -> Steps | None:
    """Return how a column rises; None if it falls anywhere, or has a value that is not finite."""
    x = column.values
    count = x.size
    if count < 2:
        return None
    first, last = x[0], x[-1]
    mean = _apart(last, first) / (count - 1)
    if not (np.isfinite(mean) and mean > 0.0) or _falls(x[: 2 * _EDGE], first):
        return None
    low = high = largest = 0.0
    smallest = np.inf
    odd, usual = 0, float(np.median(np.diff(_from(x[: 2 * _EDGE], first))))
    for start in range(0, count, _BLOCK):
        block = _from(x[max(start - 1, 0) : start + _BLOCK], first)
        steps = np.diff(block)
        if not np.isfinite(block).all() or (steps < 0.0).any():
            return None
        off = block - mean * np.arange(max(start - 1, 0), max(start - 1, 0) + block.size)
        low, high = min(low, float(off.min())), max(high, float(off.max()))
        largest = max(largest, float(steps.max(initial=0.0)))
        smallest = min(smallest, float(steps.min(initial=np.inf, where=steps > 0.0)))
        odd += int((np.abs(steps - usual) > 0.5 * usual).sum()) if usual > 0.0 else 0
    grain = column.grain or _grain(x)
    if usual == 0.0:
        # Values that come again are rounded to the smallest step, as in single precision.
        grain = max(grain, smallest)
    return Steps(
        first=float(first), mean=mean, off=max(high, -low) / mean, spread=high - low, largest=largest,
        odd=odd, grain=grain, count=count,
    )  # fmt: skip


def _from(x: NDArray[Any], first: Any) -> NDArray[np.float64]:
    """Return values from the first one on; whole ones as large as times since 1970 in ns keep their digits."""
    if x.dtype.kind in "iu":
        return (x.astype(np.int64) - int(first)).astype(np.float64)
    return x.astype(np.float64) - float(first)


def _apart(last: Any, first: Any) -> float:
    whole = isinstance(last, np.integer)
    return float(int(last) - int(first)) if whole else float(last) - float(first)


def _falls(x: NDArray[Any], first: Any) -> bool:
    return bool((np.diff(_from(x, first)) < 0.0).any())


def _grain(x: NDArray[Any]) -> float:
    """Return the coarsest decimal digit that values keep, or else the distance of floating-point numbers."""
    if x.dtype.kind in "iu":
        return 1.0
    edges = np.concatenate([x[:_EDGE], x[-_EDGE:]]).astype(np.float64)
    largest = float(np.abs(edges).max())
    spacing = float(np.spacing(x.dtype.type(largest)))
    for digits in range(13):
        grain = 10.0**-digits
        if grain < 20.0 * spacing:
            return max(spacing, grain)  # finer digits do not show
        scaled = edges / grain
        if (
            largest >= 0.5 * grain
            and np.abs(scaled - np.round(scaled)).max() <= 1e-9 + 4.0 * spacing / grain
        ):
            return grain
    return max(spacing, 1e-300)


def is_constant(x: NDArray[Any]) -> bool:
    """Whether all values are equal."""
    return bool(x.size and (x == x[0]).all())


def find_times(columns: Sequence[Column], *, beside: bool = False) -> Times | None:
    """Return the times of a table, by names and units, or else by steps; None if it has none.

    One column at least has to be left as a signal, unless there are signals ``beside`` these columns.
    """
    return _of_a_clock(columns, beside) or _of_a_column(columns, beside)


def times_in(columns: Sequence[Column]) -> Times | None:
    """Return times in columns that are said to hold them; None if several are no clock."""
    if len(columns) > 1:
        return clock_of(columns)
    (column,) = columns
    steps = examined(column)
    constant = steps is None and is_constant(column.values)
    return Times(columns=(column,), unit=column.time_unit, steps=steps, constant=constant)


def _of_a_column(columns: Sequence[Column], beside: bool) -> Times | None:
    """Return the column that is called so, or of several the first with steps; else one with equal steps."""
    called = [times_in([column]) for column in columns if column.is_named_time]
    if called:
        return next((one for one in called if one is not None and one.steps is not None), called[0])
    if columns[0].values.size < FEW:
        return None
    rising = []
    for place, column in enumerate(columns):
        steps = examined(column) if column.may_be_time else None
        # Others than equal ones may rise as slow signals do: they are times where times stand, at first.
        if steps is not None and (steps.are_equal or (steps.are_nearly_equal and place == 0)):
            rising.append((column, steps))
    if not rising or (len(rising) == len(columns) and not beside):
        return None
    # Of times and numbers of samples, the times have no whole steps.
    column, steps = min(rising, key=lambda one: one[1].are_counts)
    return Times(columns=(column,), unit=column.time_unit, steps=steps)


def is_counter(column: Column, times: Times) -> bool:
    """Whether a column beside the times is of times again, in any unit, or counts."""
    if column.stamped:
        return True
    if not column.may_be_time or (column.values.size < FEW and not column.is_named_time):
        return False
    steps = examined(column)
    if steps is None:
        return False
    return (
        column.is_named_time
        or steps.are_counts
        or (times.steps is not None and _are_alike(steps, times.steps))
    )


def _are_alike(steps: Steps, others: Steps) -> bool:
    """Whether two columns rise together, one perhaps in thousandths."""
    thousands = np.log10(steps.mean / others.mean) / 3.0
    return steps.are_equal and bool(abs(thousands - round(thousands)) < 1e-4)


def _of_a_clock(columns: Sequence[Column], beside: bool) -> Times | None:
    """Return the columns of a clock: whole numbers at the beginning, or after a counter."""
    if columns[0].values.size < FEW:
        return None
    for start in (0, 1):
        group = []
        for column in columns[start:]:
            if not column.may_be_time and not column.stamped:
                break
            group.append(column)
            # Seconds, the last, may have a fraction.
            if not column.stamped and not is_whole(column.values):
                break
        for size in range(min(len(group), 5), 1, -1):
            if (size < len(columns) or beside) and (found := clock_of(group[:size])) is not None:
                return found
    return None


def clock_of(group: Sequence[Column]) -> Times | None:
    """Return times that stand in several columns, from the longest unit to the shortest; None if they do not."""
    found = []
    for units in _readings(group):
        values = np.zeros(group[0].values.size)
        for column, (unit, length, below) in zip(group, units, strict=True):
            x = column.values.astype(np.float64)
            if (
                not (column.stamped or unit == "s" or is_whole(column.values))
                or not np.isfinite(x).all()
            ):
                break
            if not column.stamped and (x.min() < 0.0 or x.max() >= below):
                break
            values += (x - float(x[0])) * length
        else:
            last = group[-1]
            if is_constant(last.values):
                break
            fine = units[-1][0] == "s" and not last.stamped and not is_whole(last.values)
            whole = Column(
                name="", values=values, grain=_grain(last.values) if fine else units[-1][1]
            )
            steps = examined(whole)
            if steps is not None and (steps.are_equal or steps.are_rounded):
                found.append(steps)
    if not found:
        return None
    low, high = _PLAUSIBLE
    steps = next((one for one in found if low <= 1.0 / one.mean <= high), found[0])
    return Times(columns=tuple(group), unit="s", steps=steps)


def _readings(group: Sequence[Column]) -> Iterator[list[tuple[str, float, float]]]:
    """Yield what the columns of a clock may be: parts of a chain that ends in seconds or a fraction of them."""
    size = len(group)
    if any(column.stamped for column in group[1:]):
        return
    if group[0].stamped:
        if size == 2:
            yield from ([("stamp", 1.0, np.inf), fraction] for fraction in _FRACTIONS)
        return
    for fraction in (*_FRACTIONS, None):
        chain = [*_CHAIN, fraction] if fraction is not None else [*_CHAIN]
        if size <= len(chain):
            yield chain[len(chain) - size :]


def is_whole(x: NDArray[Any]) -> bool:
    """Whether all values are whole numbers."""
    if x.dtype.kind in "iu":
        return True
    head = x[:_EDGE].astype(np.float64)
    if not np.isfinite(head).all() or (head != np.round(head)).any():
        return False
    return bool(np.isfinite(x).all() and (x == np.round(x)).all())
