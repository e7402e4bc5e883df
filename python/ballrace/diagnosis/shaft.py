"""The rate of the shaft, from the orders that it leaves in the record."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from .envelopes import levels_of, line_spectrum
from .null import probability

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .envelopes import Levels

__all__ = ["WITHIN", "ShaftRate", "shaft_rate"]

WITHIN = 0.01
"""How far the rate may be from a nominal one, as a part of it."""

_HARMONICS = np.arange(1, 11)
_CLEAR = 0.01
"""How often another family of lines may stand as high by chance, where the shaft's is called clear."""

_COUNT = 200


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
        How far the family of the shaft's orders stands above other families of the record.
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

    It lies within ``within`` of the nominal one, as a part of it. In a record of some 40 turns, lines of an inner
    race at 4.95 times the shaft's rate, with the shaft's sidebands, are also those of a shaft 1 % slower: only a
    more accurate speed separates them.
    """
    plain = line_spectrum(x, envelopes.shape[1])
    value = np.vstack([plain, envelopes])
    levels = levels_of(value, x.size / fs, nominal)
    tried, heights = _family(levels, nominal, within)
    by_chance = np.array(
        [_family(levels, other, within)[1].max(axis=1) for other in _others(nominal)]
    )
    middle = np.median(by_chance, axis=0)
    spread = 1.4826 * np.median(np.abs(by_chance - middle), axis=0) + 0.3
    scores = ((by_chance - middle) / spread).max(axis=1)
    own = (heights - middle[:, np.newaxis]) / spread[:, np.newaxis]
    centre = float(np.median(scores))
    deviation = 1.4826 * float(np.median(np.abs(scores - centre)))
    z = (float(own.max()) - centre) / max(deviation, 1e-9)
    found = float(tried[int(np.argmax(own.max(axis=0)))])
    clear = probability(z) < _CLEAR
    return ShaftRate(
        rate=found if clear else nominal, nominal=nominal, by="record" if clear else "nominal", z=z
    )


def _family(
    levels: Levels, base: float, within: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return rates near a base and the mean levels of their multiples, shape (spectra, rates)."""
    step = 0.25 / (_HARMONICS[-1] * levels.duration)
    count = int(min(max(within * base / step, 1), 400))
    tried = base * (1.0 + within * np.linspace(-1.0, 1.0, 2 * count + 1))
    lines = levels.highest(_HARMONICS[:, np.newaxis] * tried, 0.0)
    return tried, lines.mean(axis=1)


def _others(nominal: float) -> NDArray[np.float64]:
    """Return rates whose multiples are not the shaft's."""
    drawn = np.random.default_rng(0).uniform(0.6, 1.35, 20 * _COUNT)
    shared = np.array([p / q for p in range(1, 7) for q in range(1, 7)])
    free = np.abs(drawn[:, np.newaxis] / shared - 1.0).min(axis=1) > 2.5 * WITHIN
    found: NDArray[np.float64] = nominal * drawn[free][:_COUNT]
    return found
