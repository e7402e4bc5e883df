"""The shaft's angle from the pulses of a tachometer, of which some are missing and some come twice.

Which pulses count, and how many are missing between two of them, is the path of least cost through all pulses:
what is dropped and what is missing costs, and so does each change of speed from one interval to the next. The path
is found by dynamic programming (A. J. Viterbi, IEEE Trans. Inf. Theory 13 (1967) 260).
"""

from __future__ import annotations

import math
import warnings
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from .._base.libraries import scipy
from .._base.numbers import counted, real, real_row
from ..channel import channel_of
from ..errors import AccuracyWarning, SceneError
from .checks import checked_signal

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from .checks import Given

    State: TypeAlias = tuple[int, int]
    States: TypeAlias = dict[State, tuple[float, State | None]]

_CHANGE = math.log(1.5)
"""Most that the logarithm of the speed may change from one interval to the next."""

_SLOWER, _FASTER = math.exp(-_CHANGE), math.exp(_CHANGE)

_ROUGH = 0.1
"""Change of the angle that costs as much as one pulse that is dropped or missing."""

_DROPPED, _LONGEST = 5, 20
"""Most pulses in a row that are dropped; most intervals without a pulse."""

_WEIGHTS = (2.0, 1.0), (1.0, 2.0)
"""Costs of a dropped and of a missing pulse: of both pairs the shaft has to turn alike, or it is a guess."""

_MARGIN = 12.0
"""Cost over the least of late above which a path is given up."""

_BEYOND = 2.0
"""Intervals before the first and after the last pulse in which the angle is still known."""

_OFF = 1.0 / 3.0
"""Most that the number of missing pulses may differ from what the speed around the gap has."""

_FEWEST = 4
"""Pulses, at least."""


def angle_from_pulses(
    pulses: ArrayLike, at: ArrayLike, pulses_per_turn: int = 1
) -> NDArray[np.float64]:
    """Return the shaft's angle at the times of samples from the pulses of a tachometer.

    Missing pulses are counted and double ones dropped, so that the speed changes as little as it can. Between
    pulses the angle is a cubic, exact for a constant acceleration; beyond the ends the speed stays.

    Parameters
    ----------
    pulses : array_like, shape (n_pulses,)
        Times of the pulses, rising [s]: of a file, of :func:`pulse_times`, or of a measurement,
        :attr:`ballrace.measuring.Measurement.pulses`.
    at : array_like, shape (n,)
        Times for which the angle is asked [s], such as ``record.t``; at most two intervals before the first and
        after the last pulse.
    pulses_per_turn : int
        Pulses a turn, at even angles.

    Returns
    -------
    ndarray, shape (n,)
        Angle, rising with time, 0 at the first pulse [rad]; for :func:`by_order`.

    Raises
    ------
    SceneError
        An argument is not usable; or it cannot be decided which pulses are missing or double: the speed would
        change by more than half from one interval to the next, no pulse comes for 20 intervals, or a count
        depends on which of the two is held for likelier.

    Warns
    -----
    AccuracyWarning
        Pulses were dropped, or missing ones counted: how many.

    Examples
    --------
    Of 20 pulses, one a turn, one is missing, and one is followed by another 1 ms later:

    >>> import warnings
    >>> pulses = np.sort(np.append(np.delete(np.arange(20) / 25.0, 7), 12.0 / 25.0 + 1e-3))
    >>> with warnings.catch_warnings(record=True) as told:
    ...     warnings.simplefilter("always")
    ...     angle = angle_from_pulses(pulses, np.arange(0.0, 0.76, 0.04))
    >>> bool(np.allclose(angle, 2 * np.pi * np.arange(19)))
    True
    >>> print(told[0].message)
    of 20 pulses 1 was double and is dropped, 1 missing one is counted
    """
    each = counted("pulses_per_turn", pulses_per_turn, 1)
    times, asked = _checked_times(pulses), real_row("at", at)
    if asked.ndim != 1 or not np.isfinite(asked).all():
        raise SceneError("at", f"an array of shape {asked.shape}", "finite times, shape (n,)")
    count = _counts(times)
    kept = count >= 0
    missing = int(count.max()) + 1 - int(np.count_nonzero(kept))
    _tell(times.size, int(np.count_nonzero(~kept)), missing)
    times, turned = times[kept], count[kept] * (2.0 * math.pi / each)
    _check_reach(times, count[kept], asked)
    slope = np.gradient(turned, times, edge_order=2)
    within = np.clip(asked, times[0], times[-1])
    beyond = np.where(asked < times[0], slope[0], slope[-1]) * (asked - within)
    angle: NDArray[np.float64] = (
        scipy.interpolate.CubicHermiteSpline(times, turned, slope)(within) + beyond
    )
    return angle


def pulse_times(
    x: Given, fs: float | None = None, *, level: float | None = None
) -> NDArray[np.float64]:
    """Return when a recorded tachometer rises through a level.

    After each pulse the signal has to sink below the level by half its distance to the nearer extreme before the
    next one counts, so that noise on an edge gives no second pulse.

    Parameters
    ----------
    x : Signals, Measurement, Recording, Channel or array_like, shape (n,)
        The tachometer's signal, such as ``record.channel("tacho")``.
    fs : float, optional
        Sampling rate of an array [Hz].
    level : float, optional
        Level [unit of ``x``]; by default halfway between the lowest and the highest sample.

    Returns
    -------
    ndarray, shape (n_pulses,)
        Times [s], as ``record.t`` counts them; between two samples on a straight line.

    Raises
    ------
    SceneError
        An argument is not usable, or the signal does not reach both sides of the level.

    Examples
    --------
    >>> x = np.sin(2 * np.pi * 25.0 * np.arange(1200) / 12_000.0)
    >>> pulse_times(x, 12_000.0, level=0.5).round(4)
    array([0.0033, 0.0433, 0.0833])
    """
    channel = channel_of(x, fs)
    signal = checked_signal(channel.x, channel.fs)
    low, high = float(signal.min()), float(signal.max())
    if not low < high:
        raise SceneError("x", f"{low:g} throughout", "a signal that changes")
    through = 0.5 * (low + high) if level is None else real(level)
    if not low < through < high:
        raise SceneError("level", repr(level), f"a level between {low:g} and {high:g}")
    below = through - 0.5 * min(through - low, high - through)
    side = np.where(signal >= through, 1, np.where(signal < below, -1, 0))
    # Between the two levels it is where it was.
    last = np.maximum.accumulate(np.where(side != 0, np.arange(side.size), 0))
    after = np.flatnonzero(np.diff(side[last]) == 2) + 1
    before = signal[after - 1]
    return channel.start + (after - 1 + (through - before) / (signal[after] - before)) / channel.fs


def _checked_times(pulses: ArrayLike) -> NDArray[np.float64]:
    times = real_row("pulses", pulses)
    if times.ndim != 1 or times.size < _FEWEST:
        allowed = f"times of at least {_FEWEST} pulses, shape (n,)"
        raise SceneError("pulses", f"an array of shape {times.shape}", allowed)
    fine = np.isfinite(times)
    wrong = np.flatnonzero(~(fine[:-1] & fine[1:] & (times[1:] >= times[:-1])))
    if wrong.size:
        found = f"{times[wrong[0]]:g} s and then {times[wrong[0] + 1]:g} s"
        raise SceneError("pulses", found, "finite times [s] that rise")
    return times


def _counts(times: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return how many pulses came or should have come before each, and -1 of those that are dropped."""
    interval = np.diff(times)
    if interval.all() and (np.abs(np.diff(np.log(interval))) <= _CHANGE).all():
        return np.arange(times.size)
    one, other = (_least_cost(times, *weights) for weights in _WEIGHTS)
    # At the ends one may drop what the other keeps.
    both = np.flatnonzero(one >= 0), np.flatnonzero(other >= 0)
    shared = times[max(kept[0] for kept in both) : min(kept[-1] for kept in both) + 1]
    turned = [
        np.interp(shared, times[kept], count[kept])
        for kept, count in zip(both, (one, other), strict=True)
    ]
    apart = turned[0] - turned[1]
    if np.ptp(apart) > 0.5:
        at = float(shared[np.argmax(np.abs(np.diff(apart)))])
        raise _undecided(f"intervals near {at:.6g} s in which pulses may be missing or double")
    _check_gaps(times[one >= 0], one[one >= 0])
    return one


def _check_gaps(times: NDArray[np.float64], count: NDArray[np.int64]) -> None:
    """Refuse a count that is not what the speeds on both sides of a gap have, of a gap at an end their trend."""
    turns, lasts, middle = np.diff(count), np.diff(times), 0.5 * (times[1:] + times[:-1])
    speed = turns / lasts
    if times.size < _FEWEST:
        raise _undecided(f"{times.size} pulses at one speed")
    for gap in np.flatnonzero(turns > 1).tolist():
        one = min(max(gap, 1), turns.size - 2)
        near = [k for k in (one - 1, one, one + 1) if k != gap]
        (a, b), (v, w) = middle[near], speed[near]
        expected = (v + (w - v) / (b - a) * (middle[gap] - a)) * lasts[gap]
        if abs(expected - turns[gap]) > _OFF:
            found = f"{expected - 1.0:.2f} pulses missing between {times[gap]:.6g} and {times[gap + 1]:.6g} s"
            raise _undecided(found)


def _least_cost(times: NDArray[np.float64], dropped: float, missing: float) -> NDArray[np.int64]:
    """Return the counts of the path of least cost."""
    paths, even = _Paths(times, dropped, missing), _even_until(times)
    pulse = 1
    while pulse < times.size:
        alive = paths.alive(pulse)
        if even[pulse] > pulse and paths.agree(pulse, alive):
            paths.count(pulse, even[pulse])
            pulse = even[pulse]
        else:
            for state in alive:
                paths.go_on(pulse, state)
            pulse += 1
    return paths.cheapest()


def _even_until(times: NDArray[np.float64]) -> list[int]:
    """Return up to which pulse all intervals around each one are alike, some before the first that is not."""
    with np.errstate(divide="ignore", invalid="ignore"):
        uneven = ~(np.abs(np.diff(np.log(np.diff(times)))) <= 0.5 * _CHANGE)
    pulse = np.arange(times.size)
    ends = np.concatenate(([0], np.flatnonzero(uneven) + 1, [times.size - 1]))
    at = np.searchsorted(ends, pulse)
    settled = pulse - ends[np.maximum(at - 1, 0)] > _DROPPED + 1
    found: list[int] = np.where(settled, ends[at] - _DROPPED, 0).tolist()
    return found


class _Paths:
    """The cheapest ways through the pulses to each of their states.

    A state is a kept pulse, with the kept one before it and how many intervals of the wheel lie between them.
    """

    def __init__(self, times: NDArray[np.float64], dropped: float, missing: float) -> None:
        self.at, self.last, self.dropped = times.tolist(), times.size - 1, dropped
        self.gap = [0.0, *(missing * math.log2(many) for many in range(1, _LONGEST + 1))]
        self.states: list[States] = [{} for _ in self.at]
        self.least = [math.inf] * times.size
        for first in range(min(_DROPPED + 1, self.last)):
            for second in self._following(first):
                if self.at[second] > self.at[first]:
                    for many in range(1, _LONGEST + 1):
                        cost = dropped * (second - 1) + self.gap[many]
                        self.states[second][first, many] = cost, None

    def _following(self, pulse: int) -> range:
        return range(pulse + 1, min(pulse + _DROPPED + 1, self.last) + 1)

    def alive(self, pulse: int) -> list[State]:
        """Return the states of a pulse that may be on the cheapest path."""
        here = self.states[pulse]
        self.least[pulse] = min((cost for cost, _ in here.values()), default=math.inf)
        bound = min(self.least[max(pulse - _DROPPED, 0) : pulse + 1]) + _MARGIN
        return [state for state, (cost, _) in here.items() if cost < bound]

    def agree(self, pulse: int, alive: list[State]) -> bool:
        """Say whether all states of a pulse have the speed of the one that counts the pulse before."""
        interval = self.at[pulse] - self.at[pulse - 1]
        return (pulse - 1, 1) in alive and all(
            _SLOWER < many * interval / (self.at[pulse] - self.at[before]) < _FASTER
            for before, many in alive
        )

    def count(self, pulse: int, until: int) -> None:
        """Count every pulse, where they are even and nothing is cheaper."""
        cost, _ = self.states[pulse][pulse - 1, 1]
        for each in range(pulse + 1, until + 1):
            self.states[each] = {(each - 1, 1): (cost, (each - 2, 1))}
            self.least[each] = cost

    def go_on(self, pulse: int, state: State) -> None:
        """Enter the states that one may be followed by, where it is the cheapest way there."""
        (before, many), (cost, _) = state, self.states[pulse][state]
        speed = many / (self.at[pulse] - self.at[before])
        for following in self._following(pulse):
            expected = speed * (self.at[following] - self.at[pulse])
            fewest, most = math.ceil(expected * _SLOWER), math.floor(expected * _FASTER)
            for new in range(max(fewest, 1), min(most, _LONGEST) + 1):
                rough = (math.log(new / expected) / _ROUGH) ** 2
                sum_ = cost + self.dropped * (following - pulse - 1) + self.gap[new] + rough
                if sum_ < self.states[following].get((pulse, new), (math.inf,))[0]:
                    self.states[following][pulse, new] = sum_, state

    def cheapest(self) -> NDArray[np.int64]:
        """Return the counts of the cheapest path to the end."""
        ends = [
            (cost + self.dropped * (self.last - pulse), pulse, state)
            for pulse in range(max(self.last - _DROPPED, 1), self.last + 1)
            for state, (cost, _) in self.states[pulse].items()
        ]
        if not ends:
            reached = max((k for k, here in enumerate(self.states) if here), default=0)
            raise _undecided(f"no even speed beyond {self.at[reached]:.6g} s")
        _, pulse, state = min(ends)
        back, behind = [(pulse, 0)], 0
        now: State | None = state
        while now is not None:
            (before, many), (_, earlier) = now, self.states[pulse][now]
            behind += many
            back.append((before, behind))
            pulse, now = before, earlier
        count = np.full(self.last + 1, -1, dtype=np.int64)
        for each, until_end in back:
            count[each] = behind - until_end
        return count


def _undecided(found: str) -> SceneError:
    allowed = (
        "a speed that changes by less than half from pulse to pulse, but for missing and double ones; leave out "
        "the time in which it does not, or in which the shaft almost stands"
    )
    return SceneError("pulses", found, allowed)


def _tell(pulses: int, dropped: int, missing: int) -> None:
    """Warn of what was repaired."""
    told = []
    if dropped:
        told.append(
            f"{dropped} {'was double and is' if dropped == 1 else 'were double and are'} dropped"
        )
    if missing:
        told.append(f"{missing} missing {'one is' if missing == 1 else 'ones are'} counted")
    if told:
        warnings.warn(f"of {pulses} pulses {', '.join(told)}", AccuracyWarning, stacklevel=3)


def _check_reach(
    times: NDArray[np.float64], count: NDArray[np.int64], asked: NDArray[np.float64]
) -> None:
    """Refuse times that are too far from the pulses."""
    if not asked.size:
        return
    interval = np.diff(times) / np.diff(count)
    first, last = times[0] - _BEYOND * interval[0], times[-1] + _BEYOND * interval[-1]
    if asked.min() < first or asked.max() > last:
        found = f"{asked.min():.6g} to {asked.max():.6g} s"
        allowed = f"times within two intervals of the pulses, {first:.6g} to {last:.6g} s"
        raise SceneError("at", found, allowed)
