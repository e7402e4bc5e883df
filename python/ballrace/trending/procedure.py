"""Course of a trend from records."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from .._base.libraries import pl
from .._base.numbers import counted, real_row
from ..channel import Recorded, channel_of
from ..diagnosis import diagnose
from ..diagnosis.arguments import checked_channel, known_bearing
from ..diagnosis.lacking import FEWEST_TURNS
from ..diagnosis.null import ACCUSED
from ..errors import SceneError
from .departure import departure_of, limit_of
from .pooling import TURNS, Pool
from .quantities import FOLLOWED, POOLED, numbers_of, shapes_of
from .result import Trend

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import ArrayLike, NDArray

    from ..channel import Channel
    from ..diagnosis import Diagnosis
    from ..diagnosis.kinematics import AnyBearing
    from ..diagnosis.severity import Machine
    from ..spectra.checks import Given

_OVERLAPPING = 1.5
"""Independent values that those of groups which overlap are worth, over those of groups which do not."""


def trend(
    records: Iterable[Given],
    bearing: AnyBearing | None = None,
    speed_rpm: float | None = None,
    *,
    outer_rpm: float | None = None,
    times: ArrayLike | None = None,
    baseline: int = 10,
    fs: float | None = None,
    column: str | None = None,
    unit: str | None = None,
    row: int | None = None,
    speed_within: float | None = None,
    false_alarm: float = 0.01,
    machine: Machine | None = None,
    seed: int = 0,
) -> Trend:
    """Follow a bearing over its records: a table, and the first record that departs from the baseline.

    Of every record :func:`ballrace.diagnose` gives verdict, z and strength of each part, and the severity. Root
    mean square, velocity, crest factor, kurtosis and the accelerations at the rates of the faults are compared
    with their own baseline, the first records: a departure is the first record above the baseline's mean by
    three of its deviations whose next record is, too. Records of less than 20 turns of the shaft, which hardly
    show lines by themselves, are pooled: ``<part>.lines`` says how high lines of a part stand in the median of the
    spectra of the squared envelope of the last records, 60 turns together, as far as a third of the baseline
    allows. Where the baseline has few records, the three become more
    (:func:`ballrace.trending.departure.limit_of`). Crest factor and kurtosis are those of one band in all
    records: the deciding one of the record with the largest z.

    Parameters
    ----------
    records : iterable of Signals, Measurement, Recording, Channel or array_like
        In the order of time, all at one sampling rate; a generator that reads files is enough, or
        :func:`ballrace.read_folder`.
    bearing, speed_rpm, outer_rpm, fs, column, unit, row, speed_within, false_alarm, machine, seed
        As of :func:`ballrace.diagnose`.
    times : array_like, shape (n,), optional
        Times of the records, increasing, in any unit; by default those of :func:`ballrace.read_folder`, or 0, 1,
        2, …
    baseline : int
        Number of first records that are known to be healthy, 3 and more.

    Returns
    -------
    Trend
        ``table``, ``departed``, ``limits``; ``plot()``.

    Raises
    ------
    SceneError
        An argument is not usable, there are too few records, or their sampling rates differ.
    KeyError
        There is no such column.

    Examples
    --------
    Noise of one second, in which impacts at the rate of the outer race begin with the ninth record:

    >>> import ballrace as br, numpy as np
    >>> def taken(k):
    ...     x = np.random.default_rng(k).normal(size=12_000)
    ...     x[::112] += 0.0 if k < 8 else 8.0
    ...     return x
    >>> found = br.trend(map(taken, range(12)), "6205", 1797.0, fs=12_000.0, baseline=6)
    >>> found.departed, found.table["parts"][-1]
    (8, 'outer_race')
    """
    one = isinstance(records, Recorded | str) or getattr(records, "ndim", 2) == 1
    if one or not isinstance(records, Iterable):
        raise SceneError("records", type(records).__name__, "several records, in the order of time")
    baseline = counted("baseline", baseline, 3)
    options: Any = {
        "outer_rpm": outer_rpm, "row": row, "speed_within": speed_within, "false_alarm": false_alarm,
        "machine": machine, "seed": seed,
    }  # fmt: skip
    taken: list[_Taken] = []
    pool = None
    for number, record in enumerate(records):
        at = f"records[{number}]"
        channel = checked_channel(channel_of(record, fs, column, name=at), unit, at)
        _check_alike(at, channel, taken[0] if taken else None)
        if pool is None:
            known = known_bearing(channel, bearing, row or 0, speed_rpm, outer_rpm)
            pool = Pool(*known, _count(channel, known[1], int(baseline)))
        found = diagnose(channel, bearing, speed_rpm, **options)
        taken.append(_Taken(channel, found, pool.heights(channel)))
    if len(taken) < baseline + 2:
        wanted = f"{baseline + 2} and more: the baseline and two"
        raise SceneError("records", f"{len(taken)} records", wanted)
    band = max(taken, key=lambda one: one.z).band
    times = getattr(records, "times", None) if times is None else times
    table = _table(taken, band, _checked_times(times, len(taken)))
    assert pool is not None
    limits, departures = _departures(table, int(baseline), pool.count)
    return Trend(
        table=table, baseline=int(baseline), pooled=pool.count, limits=limits, departures=departures, band=band,
        bearing=taken[0].bearing, unit=taken[0].unit,
    )  # fmt: skip


class _Taken:
    """Numbers kept of a record: not its samples, so that many may follow each other."""

    def __init__(
        self, channel: Channel, found: Diagnosis, heights: Mapping[str, float | None]
    ) -> None:
        accused = [found.evidence[part] for part in ACCUSED if part in found.evidence]
        first = max(accused, key=lambda one: one.z, default=None)
        self.fs, self.unit, self.bearing = channel.fs, channel.unit, found.bearing
        self.numbers = numbers_of(channel, found)
        self.numbers |= {f"{part}.lines": height for part, height in heights.items()}
        self.shapes = shapes_of(channel, found._bands)
        self.z = -np.inf if first is None else first.z
        self.band = None if first is None else first.band


def _check_alike(at: str, channel: Channel, first: _Taken | None) -> None:
    """Refuse a record whose numbers cannot be compared with those of the first."""
    if first is not None and (channel.fs, channel.unit) != (first.fs, first.unit):
        given = f"{channel.fs:g} Hz in {channel.unit or 'no unit'}"
        raise SceneError(
            at, given, f"as the first record, {first.fs:g} Hz in {first.unit or 'no unit'}"
        )


def _checked_times(times: ArrayLike | None, count: int) -> NDArray[np.float64]:
    if times is None:
        return np.arange(float(count))
    found = real_row("times", times)
    if found.shape != (count,) or not np.isfinite(found).all() or not (np.diff(found) > 0.0).all():
        raise SceneError("times", f"an array of shape {found.shape}", f"{count} rising numbers")
    return found


def _table(
    taken: list[_Taken], band: tuple[float, float] | None, times: NDArray[np.float64]
) -> pl.DataFrame:
    rows = []
    for time, one in zip(times.tolist(), taken, strict=True):
        shape = one.shapes.get(band) if band is not None else None
        of_band = {name: getattr(shape, name, None) for name in ("crest_factor", "kurtosis")}
        rows.append({"time": time} | one.numbers | of_band)
    found = pl.DataFrame(rows, infer_schema_length=None)
    return found.with_columns(pl.col(name).cast(pl.Float64) for name in FOLLOWED)


def _count(channel: Channel, shaft: float, baseline: int) -> int:
    """Return how many records are pooled, of short ones; the baseline has to hold three such groups."""
    turns = channel.n_samples / channel.fs * shaft
    return 1 if turns >= FEWEST_TURNS else max(min(math.ceil(TURNS / turns), baseline // 3), 1)


def _departures(
    table: pl.DataFrame, baseline: int, pooled: int
) -> tuple[dict[str, float], dict[str, int]]:
    """Return the limit of each quantity that all records have, and the record at which it departs.

    Quantities that ``pooled`` records share have a value from the last of the first group on. Their baseline is
    the groups that share no record, and they depart where half a group of values does.
    """
    limits: dict[str, float] = {}
    departures: dict[str, int] = {}
    for name in FOLLOWED:
        count = pooled if name in POOLED else 1
        value = table[name].to_numpy()
        if np.isnan(value[count - 1 :]).any():
            continue
        worth = _OVERLAPPING * (baseline / count) if count > 1 else None
        limits[name] = limit_of(value[count - 1 : baseline], worth)
        at = departure_of(np.nan_to_num(value), baseline, limits[name], max(2, count // 2))
        if at is not None:
            departures[name] = at
    return limits, departures
