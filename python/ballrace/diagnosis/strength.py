"""How strong the vibration of a fault is, in addition to its significance: lines alone are no damage.

In a smooth bearing under load the balls pass through the load zone one by one, which gives lines of the outer race
(varying compliance), in a record without noise as significant as those of any spall; waves of a race modulate
noise. Damage differs from them by its strength. The root mean square of the squared envelope's first harmonics of
the fault's rate in a band, over its mean, is the depth of modulation; the root mean square of that part of the
signal's power is the acceleration at the fault's rate.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .combs import WIDTH
from .envelopes import band_envelope, half_spectrum, line_spectrum

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

__all__ = ["Envelopes", "Limits", "Strength", "has_background", "limits_of", "strength_at"]

_HARMONICS = 6

_FAINT = 0.14
"""Acceleration over the speed of the pitch circle below which lines are no damage [m/s² per m/s].

Of simulated 6205 and 6309 at 900 to 1800 1/min under 150 to 1500 N, silent and through random housings at 0 to
30 dB, healthy ones have up to 0.71 of it and spalled ones 1.06 and more, but for one of 0.3 mm on an outer
race, 0.25. The damaged records of Case Western Reserve University have 5 and 13 times it.
"""

_LOUD = 0.5
"""Acceleration below which lines of a slow bearing may still be those of a healthy one [m/s²].

What unloaded balls do to the cage and the races does not fade with the speed: of simulated dry bearings under a
twentieth of their static rating, a 6205 at 600 1/min has 0.32 and a 6004 0.27 without damage, 1.9 and 2.0 times
the limit above.
"""

_SHALLOW = 0.4
"""Depth of modulation below which lines may come from waves of a race.

A healthy record of the set ``hit-sm`` with significant lines of the inner race has 0.33 to 0.37 in pieces of 2
to 5 s, the damaged ones of ``hit-sm`` and CWRU 1.0 and more, spalled simulated ones down to noise of −10 dB
0.41 and more.
"""

_NOISY = 4.0
"""Kurtosis below which no impacts stand out: 3.2 to 3.4 in that healthy record, 5.3 or more in damaged ones."""


_BLOWS = 5.0
"""Kurtosis from which on impacts need an explanation: noise modulated by a half with the shaft has 4.2."""

_SMOOTH = 3.5
"""Kurtosis below which the lines of a record without a unit may be those of balls in the load zone.

Those of simulated healthy bearings in as much noise have 3.0 with a depth of 0.6, damaged measured records 5.3
and more.
"""

_SILENT = 40.0
"""How far the noise of a record without background is below the record [dB].

Of ``hit-sm`` and CWRU it is 4 to 38 dB below; of silent simulated healthy bearings (6004 to 7208B, 600 to 3000
1/min, dry and in oil) 42 to 81 dB in 12 of 15.
"""


@dataclass(frozen=True, kw_only=True)
class Strength:
    """Strength of the vibration at a fault's rate.

    Attributes
    ----------
    acceleration : float
        Its root mean square over all bands, in the unit of the record, m/s² where that is known.
    share : float
        Its power over that of the record.
    depth : float
        Largest depth of modulation in a band: root mean square of the squared envelope's lines over its mean.
        Impacts without noise have 1 and more, noise has almost 0.
    band : tuple of two floats
        That band [Hz].
    kurtosis : float
        Largest kurtosis of a band; 3 for Gaussian noise.
    """

    acceleration: float
    share: float
    depth: float
    band: tuple[float, float]
    kurtosis: float

    @property
    def is_shallow(self) -> bool:
        """Whether lines so weak may come from waves of a race in noise."""
        return self.depth < _SHALLOW and self.kurtosis < _NOISY

    @property
    def is_smooth(self) -> bool:
        """Whether there are no impacts at all, as of balls that pass through the load zone."""
        return self.kurtosis < _SMOOTH


class Envelopes:
    """Squared envelopes of a signal, not prewhitened, in bands; the last band holds all others.

    Attributes
    ----------
    bands : sequence of tuple of two floats
        Bands [Hz].
    duration : float
        Length of the record [s].
    variance : float
        That of the signal.
    rows : list of ndarray
        A squared envelope a band, sampled as densely as it needs.
    """

    def __init__(
        self, x: NDArray[np.float64], fs: float, bands: Sequence[tuple[float, float]]
    ) -> None:
        spectrum = half_spectrum(x)
        self.bands = bands
        self.duration = x.size / fs
        self.variance = float(np.var(x))
        self.rows = [band_envelope(spectrum, *band, x.size, fs) for band in bands]

    def impacts(self, faint: float) -> float | None:
        """Return the largest kurtosis of a band where impacts stand out; None of noise or below ``faint``."""
        largest = max(map(self.kurtosis, range(len(self.bands))))
        loud = 0.5 * float(self.rows[-1].mean()) >= faint**2
        return largest if loud and largest >= _BLOWS else None

    def kurtosis(self, band: int) -> float:
        """Return the kurtosis of the signal in a band; of none, that of noise."""
        row = self.rows[band]
        mean = float(row.mean())
        # Of a sine with a slowly changing amplitude A the mean fourth power is 3/8 of that of A.
        return 1.5 * float(np.mean(row**2)) / mean**2 if mean > 0.0 else 3.0

    def crest_factor(self, band: int) -> float:
        """Return peak over root mean square of the signal in a band."""
        mean = float(self.rows[band].mean())
        return (
            math.sqrt(2.0 * float(self.rows[band].max()) / mean) if mean > 0.0 else math.sqrt(2.0)
        )

    def depth(self, band: int, rate: float) -> float:
        """Return the depth of modulation in a band at a rate [Hz]."""
        row, m = self.rows[band], int((_HARMONICS + 1) * rate * self.duration)
        mean = float(row.mean())
        if mean == 0.0:
            return 0.0
        # A line of amplitude 1 has a quarter of the samples under a Hann window.
        lines = line_spectrum(row, m) / (0.25 * row.size * mean)
        squares = 0.0
        for k in range(1, _HARMONICS + 1):
            place = k * rate * self.duration
            at, reach = round(place), math.ceil(WIDTH * place)
            squares += float(lines[at - reach : at + reach + 1].max(initial=0.0)) ** 2
        return math.sqrt(0.5 * squares)


def strength_at(envelopes: Envelopes, rate: float) -> Strength:
    """Return how strong a signal is at a rate [Hz]."""
    depths = [envelopes.depth(band, rate) for band in range(len(envelopes.bands))]
    power = 0.5 * float(envelopes.rows[-1].mean()) * min(depths[-1], 1.0)
    return Strength(
        acceleration=math.sqrt(power),
        share=min(power / envelopes.variance, 1.0),
        depth=max(depths),
        band=envelopes.bands[int(np.argmax(depths))],
        kurtosis=max(map(envelopes.kurtosis, range(len(envelopes.bands)))),
    )


@dataclass(frozen=True, kw_only=True)
class Limits:
    """Accelerations that lines may carry [m/s²].

    Attributes
    ----------
    faint : float
        Below it lines are no damage.
    slow : float
        Below it lines may be those of a slow healthy bearing.
    """

    faint: float
    slow: float


def limits_of(circle: float) -> Limits:
    """Return the limits at a speed of the pitch circle [m/s]."""
    return Limits(faint=_FAINT * circle, slow=_LOUD)


def has_background(x: NDArray[np.float64]) -> bool:
    """Whether there is noise between the impacts, as in what was measured.

    Noise is judged by the fourth difference, which leaves next to nothing of what rings slowly, in pieces of 32
    samples: in the quietest two of a hundred it has as much power as white noise this far below the record.
    """
    rough = np.diff(x, 4)
    pieces = rough[: rough.size // 32 * 32].reshape(-1, 32)
    # The squares of 1, 4, 6, 4, 1 sum to 70.
    quiet = float(np.quantile(np.mean(pieces**2, axis=1), 0.02)) / 70.0
    return bool(quiet > 10.0 ** (-_SILENT / 10.0) * np.var(x))
