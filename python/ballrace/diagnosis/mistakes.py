"""The likely mistake where impacts stand out that are at no rate of the bearing: units, rates, a changing speed.

Impacts that repeat show their rate without any bearing. Where it changes, the speed does; where it is that of a
part times a factor that sampling rates or units differ by, that is what was given wrong; where it is that of
another bearing of the catalogue, that one may be meant, or stand beside it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .._base.libraries import scipy
from ..bearings import catalogue
from .combs import WIDTH, comb_of
from .envelopes import band_envelope, envelope_spectra, half_spectrum, levels_of
from .null import ACCUSED, probability
from .shaft import WITHIN, shaft_rate

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from ..channel import Channel
    from .envelopes import Levels
    from .kinematics import Kinematics

_ORDERS = 1.5, 9.0
"""Orders of the shaft at which impacts are looked for."""

_FACTORS = (2.0, 0.5, 4.0, 0.25, 48.0 / 44.1, 44.1 / 48.0)
"""Factors by which sampling rates are mistaken, the last two among multiples of 11 025 and 12 000 Hz."""

_FASTEST = 400.0
"""Rate above which a shaft does not turn, so that a speed was not given in hertz [Hz]."""

_COMMON = ("62", "63", "60", "68", "72", "73")
"""Series of bearings that are named first."""

_NEAR, _ALIKE = 0.02, 0.006
"""How near a rate has to be to a part's times a factor, and to that of another bearing, as a part of it."""

_MULTIPLES = np.arange(1, 5)

_AS_HIGH = 0.8
"""How high multiples of a part of a rate stand, over those of the rate, where that part is the rate."""

_OF_SHAFT = 0.03
"""How near to a whole number an order is the shaft's."""

_CELL = 0.02
"""Width of the pieces of rates that are compared, as a part of them."""

_SURE = 1e-3
"""How often chance may have impacts that repeat as clearly."""

_TURNS, _PIECES = 4.0, 100
"""Turns of a piece of the record, and the most pieces, in which the rate of impacts is followed."""

_CLEAR, _STEADY, _FOLLOWS = 0.25, 0.015, 0.6
"""Autocorrelation of the pieces' squared envelope from which on a rate is clear; logarithm of a change that is
none; correlation of one piece's rate with the next one's from which on a change is one of the speed."""


def given_in_hertz(channel: Channel, nominal: float) -> str | None:
    """Return that a speed was given in hertz, where the record has lines of a shaft sixty times as fast."""
    shaft = 60.0 * nominal
    limit = 12.0 * shaft
    silent = not channel.x.std() > 1e-12 * np.abs(channel.x).max(initial=0.0)
    if (
        shaft > _FASTEST
        or limit > 0.25 * channel.fs
        or channel.n_samples < 20.0 / shaft * channel.fs
        or silent
    ):
        return None
    bands = [(0.1 * channel.fs / 2.0, 0.95 * channel.fs / 2.0)]
    spectra = envelope_spectra(channel.x, channel.fs, bands, limit, shaft)
    found = shaft_rate(channel.x, channel.fs, shaft, spectra, WITHIN)
    if found.by == "nominal":
        return None
    return (
        f"the speed in 1/min, {60.0 * found.rate:.5g}: {60.0 * nominal:.5g} was given, and the record has lines "
        f"of a shaft at {found.rate:.5g} Hz"
    )


def changing_speed(
    channel: Channel, shaft: float, bands: Sequence[tuple[float, float]]
) -> str | None:
    """Return that the speed changes, where the rate of impacts does in the course of the record."""
    found = _changing(channel, shaft, bands)
    if found is None:
        return None
    return (
        f"a constant speed, or the record over the shaft's angle (ballrace.spectra.by_order): impacts repeat at "
        f"{found[0]:.3g} to {found[1]:.3g} Hz in the course of the record"
    )


def repeating(channel: Channel, shaft: float, bands: Sequence[tuple[float, float]]) -> float | None:
    """Return the rate at which impacts repeat [Hz]; None where chance may have it, or the shaft."""
    spectra = envelope_spectra(channel.x, channel.fs, list(bands), 4.2 * _ORDERS[1] * shaft, shaft)
    return _repeating(levels_of(spectra, channel.n_samples / channel.fs, shaft), shaft)


def another_rate(channel: Channel, kinematics: Kinematics, rate: float, shaft: float) -> str:
    """Return what has a rate at which impacts repeat [Hz], beside the bearing that was given."""
    repeat = f"impacts repeat at {rate:.5g} Hz, {rate / shaft:.4g} times the shaft's rate"
    guesses = [*_at_other_rates(channel, kinematics, rate / shaft), *_of_others(rate / shaft)]
    return f"the exact speed, or the right bearing: {repeat}" + "".join(
        f", {'as' if number == 0 else 'or as'} {guess}" for number, guess in enumerate(guesses)
    )


def _at_other_rates(channel: Channel, kinematics: Kinematics, order: float) -> list[str]:
    found = []
    for factor in _FACTORS:
        fs = channel.fs * factor
        halves = factor in (2.0, 0.5, 4.0, 0.25)
        usual = any(abs(fs / unit - round(fs / unit)) < 1e-3 for unit in (11_025.0, 12_000.0))
        if halves or usual:
            found += [
                f"{comb.name} with fs={fs:.6g}"
                for comb in (comb_of(part, kinematics.orders) for part in ACCUSED)
                if abs(order * factor / comb.order - 1.0) < _NEAR
            ]
    return found[:1]


def _of_others(order: float) -> list[str]:
    """Return what of other bearings has an order, the nearest ones of the commonest series first."""
    near = [
        (
            not _is_common(bearing.designation),
            abs(order / value - 1.0),
            name,
            bearing.designation,
            value,
        )
        for bearing in catalogue.values()
        for name, value in (("BPFO", bearing.orders.bpfo), ("BPFI", bearing.orders.bpfi))
        if abs(order / value - 1.0) < _ALIKE
    ]
    return [
        f"{name} of a {designation} ({value:.4g})"
        for _, _, name, designation, value in sorted(near)[:2]
    ]


def _is_common(designation: str) -> bool:
    return len(designation) == 4 and designation.startswith(_COMMON)


def _repeating(levels: Levels, shaft: float) -> float | None:
    """Return the rate whose first four multiples stand highest [Hz]; None where chance may have it."""
    tried = np.arange(_ORDERS[0] * shaft, _ORDERS[1] * shaft, 0.25 / (4.0 * levels.duration))
    # What repeats with the shaft is no damage of a bearing.
    of_shaft = np.abs(tried / shaft - np.rint(tried / shaft)) < _OF_SHAFT
    cell = (np.log(tried / tried[0]) / _CELL).astype(int)
    begins = np.flatnonzero(np.diff(cell, prepend=-1))

    def heights(of: Levels) -> NDArray[np.float64]:
        return np.asarray(of.highest(_MULTIPLES[:, np.newaxis] * tried, 0.0).mean(axis=1))

    own = heights(levels)
    best = _lowest(tried, np.where(of_shaft, -np.inf, own.max(axis=0)))
    beside = np.arange(-2, 3)[:, np.newaxis] * shaft
    lines = (
        np.arange(1, int(levels.hidden.size / levels.duration / best) + 2) * best + beside
    ).ravel()
    highest = np.maximum.reduceat(heights(levels.without_lines(lines, WIDTH)), begins, axis=1)
    middle = np.median(highest, axis=1)
    spread = 1.4826 * np.median(np.abs(highest - middle[:, np.newaxis]), axis=1) + 0.3
    scores = ((highest - middle[:, np.newaxis]) / spread[:, np.newaxis]).max(axis=0)
    deviation = 1.4826 * float(np.median(np.abs(scores - np.median(scores)))) + 1e-9
    at = int(np.argmin(np.abs(tried - best)))
    z = (float(((own[:, at] - middle) / spread).max()) - float(np.median(scores))) / deviation
    return best if probability(z, scores.size) < _SURE else None


def _lowest(tried: NDArray[np.float64], height: NDArray[np.float64]) -> float:
    """Return the rate with the highest multiples, or a half or a third of it with multiples almost as high."""
    best = float(tried[np.argmax(height)])
    for parts in (3.0, 2.0):
        near = np.abs(parts * tried / best - 1.0) < 1e-3
        if near.any() and float(height[near].max()) > _AS_HIGH * float(height.max()):
            return float(tried[near][np.argmax(height[near])])
    return best


def _changing(
    channel: Channel, shaft: float, bands: Sequence[tuple[float, float]]
) -> tuple[float, float] | None:
    """Return the lowest and the highest rate of impacts in a record [Hz]; None where it is steady."""
    spectrum, duration = half_spectrum(channel.x), channel.n_samples / channel.fs
    count = min(int(duration * shaft / _TURNS), _PIECES)
    if count < 4:
        return None
    best: tuple[float, NDArray[np.float64]] | None = None
    for band in bands:
        row = band_envelope(spectrum, *band, channel.n_samples, channel.fs)
        rates, clear = _rates(row, row.size / duration, shaft, count)
        if best is None or clear > best[0]:
            best = clear, rates
    assert best is not None
    rates = best[1]
    if np.isfinite(rates).sum() < 0.6 * count:
        return None
    rates = np.log(rates[np.isfinite(rates)])
    # The highest correlation may be that of every other impact.
    middle = float(np.median(rates))
    rates = rates - np.log(2.0) * np.rint((rates - middle) / np.log(2.0))
    low, high = np.quantile(rates, [0.05, 0.95])
    # A rate that changes is followed from piece to piece; chance jumps.
    before, after = rates[:-1], rates[1:]
    varies = high - low > _STEADY and min(np.ptp(before), np.ptp(after)) > 0.0
    follows = np.corrcoef(before, after)[0, 1] if varies else 0.0
    return (float(np.exp(low)), float(np.exp(high))) if follows > _FOLLOWS else None


def _rates(
    row: NDArray[np.float64], fs: float, shaft: float, count: int
) -> tuple[NDArray[np.float64], float]:
    """Return the rate of impacts in pieces of a squared envelope [Hz], nan where not clear, and how clear."""
    pieces = row[: row.size // count * count].reshape(count, -1)
    pieces = np.minimum(pieces, np.quantile(pieces, 0.99, axis=1, keepdims=True))
    pieces = pieces - pieces.mean(axis=1, keepdims=True)
    size = scipy.fft.next_fast_len(2 * pieces.shape[1], real=True)
    correlation = scipy.fft.irfft(np.abs(scipy.fft.rfft(pieces, size, axis=1)) ** 2, size, axis=1)
    first, last = (round(fs / (order * shaft)) for order in reversed(_ORDERS))
    last = min(last, pieces.shape[1] // 2)
    if first < 3 or last <= first:
        return np.full(count, np.nan), 0.0
    over = correlation[:, first:last] / np.maximum(correlation[:, :1], np.finfo(float).tiny)
    at = np.argmax(over, axis=1)
    height = over[np.arange(count), at]
    rates = np.where(height > _CLEAR, fs / (first + at), np.nan)
    return rates, float(np.median(height))
