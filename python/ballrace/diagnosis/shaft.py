"""The rate of the shaft, from the orders that it leaves in the record."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from .envelopes import levels_of, line_spectrum
from .null import probability

WITHIN = 0.01
"""How far the rate may be from a nominal one, as a part of it, where nobody says so."""

FURTHEST = 0.08
"""Largest share by which the rate may be off: loaded motors turn up to so much slower than their nominal speed."""

_HARMONICS = np.arange(1, 11)
_BUT = 2
"""Lines of a family, the highest, that do not count: a race has two among those of a wrong shaft, such as 5 and
10."""

_SEEN = 12.0
"""Level of its first or second line from which on a shaft is found further from its nominal speed than 1 %
[dB]."""

_CLEAR = 0.003
"""How often another family of lines may stand as high by chance, where the shaft's is called clear."""

_CELL = 0.01
"""Half of the width of the pieces of the null, as a part of their rates: the widest search has eight of them."""

_CLEARER = 1.5
"""How many times the z of the signal's own spectrum that of the envelopes has to be.

The signal holds what the shaft itself does; lines of envelopes may be a damaged bearing's, whose distances are
nearly the shaft's rate.
"""

_OTHERS = (0.55, 1.45)
"""Rates of the null over those that are searched."""

_SHARED = 0.006
"""How near to a simple ratio of the rate that was found a rate of the null shares its lines, as a part of it."""

_RATIOS = np.unique([p / q for p in range(1, 7) for q in range(1, 7)])


@dataclass(frozen=True, kw_only=True)
class ShaftRate:
    """Rate of the inner ring against the outer, the shaft's where the outer ring stands.

    Attributes
    ----------
    rate : float
        The rate [Hz].
    nominal : float
        What was given, or what the record knew [Hz].
    by : {"record", "nominal"}
        Whether it comes from the record's shaft orders, or these are not clear and the nominal one was taken.
    z : float
        How far the family of the shaft's orders stands above other families of the record; 0 where it is not
        clear.
    """

    rate: float
    nominal: float
    by: Literal["record", "nominal"]
    z: float


def shaft_rate(
    x: NDArray[np.float64],
    fs: float,
    nominal: float,
    envelopes: NDArray[np.float64],
    within: float = WITHIN,
) -> ShaftRate:
    """Find the rate whose multiples stand highest in the spectrum and in the envelopes' spectra.

    It lies within ``within`` of the nominal one, as a part of it; what rises up to the end of that search is not
    found. Up to 1 % beside the nominal rate envelopes count, too; further away, where lines of a damaged bearing
    look like those of a shaft, the signal's own spectrum has to show its first or second line. In a record of
    some 40 turns, lines of an inner race at 4.95 times the shaft's rate, with the shaft's sidebands, are also
    those of a shaft 1 % slower: only a more accurate speed separates them.
    """
    plain = line_spectrum(x, envelopes.shape[1])[np.newaxis]
    own = _found(plain, x.size / fs, nominal, within)
    if within > WITHIN:
        turns = levels_of(plain, x.size / fs, nominal).highest(np.array([1.0, 2.0]) * own.rate, 0.0)
        seen = own.by == "record" and float(turns.max()) >= _SEEN
        return own if seen else ShaftRate(rate=nominal, nominal=nominal, by="nominal", z=0.0)
    enveloped = _found(envelopes, x.size / fs, nominal, within)
    return enveloped if enveloped.z > _CLEARER * own.z else own


def _found(value: NDArray[np.float64], duration: float, nominal: float, within: float) -> ShaftRate:
    """Return the rate whose multiples stand highest in any of some spectra."""
    levels = levels_of(value, duration, nominal)
    step = 0.25 / (_HARMONICS[-1] * duration * nominal)
    tried = nominal * np.arange(_OTHERS[0] - within, _OTHERS[1] + within, step)
    lines = np.sort(levels.highest(_HARMONICS[:, np.newaxis] * tried, 0.0), axis=1)
    heights = lines[:, :-_BUT].mean(axis=1)
    # A search narrower than a step of rates has three of them.
    here = np.abs(tried / nominal - 1.0) <= max(within, 1.01 * step)
    near = np.flatnonzero(here)
    highest = tried[near[np.argmax(heights[:, near].max(axis=0))]]
    cells = _maxima(heights, tried / nominal, float(highest) / nominal, here)
    middle = np.median(cells, axis=1, keepdims=True)
    spread = 1.4826 * np.median(np.abs(cells - middle), axis=1, keepdims=True) + 0.3
    scores = ((cells - middle) / spread).max(axis=0)
    own = ((heights[:, near] - middle) / spread).max(axis=0)
    centre = float(np.median(scores))
    deviation = 1.4826 * float(np.median(np.abs(scores - centre)))
    at = int(np.argmax(own))
    z = (float(own[at]) - centre) / max(deviation, 1e-9)
    clear = 0 < at < own.size - 1 and probability(z, max(1, round(within / _CELL))) < _CLEAR
    if not clear:
        return ShaftRate(rate=nominal, nominal=nominal, by="nominal", z=0.0)
    return ShaftRate(rate=float(tried[near[at]]), nominal=nominal, by="record", z=z)


def _maxima(
    heights: NDArray[np.float64], tried: NDArray[np.float64], found: float, here: NDArray[np.bool_]
) -> NDArray[np.float64]:
    """Return the largest heights in pieces of the rates that share no lines with the one that was found.

    Parameters
    ----------
    heights : ndarray, shape (spectra, rates)
        Mean levels of the multiples of the rates.
    tried, found : ndarray and float
        Rates, and the one that was found, over the nominal one.
    here : ndarray of bool, shape (rates,)
        Which of them are searched.
    """
    shared = np.abs(tried[:, np.newaxis] / (found * _RATIOS) - 1.0).min(axis=1) < _SHARED
    count = int((_OTHERS[1] - _OTHERS[0]) / (2.0 * _CELL))
    cell = ((tried - _OTHERS[0]) / (2.0 * _CELL)).astype(int)
    free = ~(shared | here)
    kept = [np.flatnonzero(free & (cell == k)) for k in range(count)]
    fewest = 0.3 * max(each.size for each in kept)
    return np.stack([heights[:, each].max(axis=1) for each in kept if each.size >= fewest], axis=1)
