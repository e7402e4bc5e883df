"""How strong the vibration of a fault is, in addition to its significance: lines alone are no damage.

In a smooth bearing under load the balls pass through the load zone one by one, which gives lines of the outer race
(varying compliance), in a record without noise as significant as those of any spall; waves of a race modulate
noise. Damage differs from them by its strength. The root mean square of the squared envelope's first harmonics of
the fault's rate in a band, over its mean, is the depth of modulation; the root mean square of that part of the
signal's power is the acceleration at the fault's rate.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .combs import WIDTH
from .envelopes import band_envelope, half_spectrum, line_spectrum, reach_of

_HARMONICS = 6

SHALLOW = 0.5
"""Depth of modulation below which lines may come from waves of a race, or be damage in too much else.

A healthy record of the set ``hit-sm`` with significant lines of the inner race has 0.33 to 0.37, and bearings
with a damaged ball have lines of the races of 0.11 to 0.36; damaged races of all measured sets have 0.78 and
more.
"""

_BLOWS = 5.0
"""Kurtosis from which on impacts need an explanation: noise modulated by a half with the shaft has 4.2."""

_SMOOTH = 3.5
"""Kurtosis below which no impacts stand out.

Balls that pass through the load zone one by one make tones, whose sum has a kurtosis of at most 3 at a depth of
1, as noise has; damaged measured races have 3.9 and more.
"""


_OVERTONES = 0.25
"""Depth without the highest line below which vibration may only swell and fade as a sine does.

Noise times 1 + m cos φ has a squared envelope with lines of 2 m and m²/2 over 1 + m²/2: whatever m, the second
has a depth of at most 0.24. Twice the frequency of the mains lies where a race's rate may lie.
"""

EXPLAINED = 0.08
"""Share of a squared envelope's variance in lines below which impacts come at other times than its rate.

Of 20 impacts at random in a second, in simulated records whose lines chance has in less than 1 %, they hold up to
0.053; lines of damaged races of all measured sets hold 0.108 and more.
"""


@dataclass(frozen=True, kw_only=True)
class Strength:
    """Strength of the vibration at a fault's rate.

    Attributes
    ----------
    acceleration : float
        Its root mean square over all bands, in the unit of the record, m/s² where that is known.
    impulsive : float
        That in the strongest band where impacts stand out; 0 where they do in none.
    share : float
        Its power over that of the record.
    depth : float
        Largest depth of modulation in a band: root mean square of the squared envelope's lines over its mean.
        Impacts without noise have 1 and more, noise has almost 0.
    overtones : float
        Largest depth of modulation in a band without its highest line: impacts have many.
    explained : float
        Largest share of the variance of a band's squared envelope that the part's lines hold.
    band : tuple of two floats
        Band of the largest depth [Hz].
    kurtosis : float
        Largest kurtosis of a band; 3 for Gaussian noise.
    """

    acceleration: float
    impulsive: float
    share: float
    depth: float
    overtones: float
    explained: float
    band: tuple[float, float]
    kurtosis: float

    @property
    def is_shallow(self) -> bool:
        """Whether lines may come from waves of a race in noise."""
        return self.depth < SHALLOW

    @property
    def is_sine(self) -> bool:
        """Whether lines of a part may be of vibration that swells and fades as a sine, as by hum of the mains."""
        return self.overtones < _OVERTONES

    @property
    def is_smooth(self) -> bool:
        """Whether no impacts stand out, as of balls that pass through the load zone."""
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
        self._lines: dict[int, NDArray[np.float64]] = {}

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

    def lines(self, band: int) -> NDArray[np.float64]:
        """Return the amplitudes of the lines of a squared envelope over its mean, at ``0, 1/duration, …``."""
        if band not in self._lines:
            row = self.rows[band]
            mean = max(float(row.mean()), np.finfo(float).tiny)
            # A line of amplitude 1 has a quarter of the samples under a Hann window.
            self._lines[band] = line_spectrum(row, row.size // 2) / (0.25 * row.size * mean)
        return self._lines[band]

    def depths(
        self, band: int, rate: float, taken: NDArray[np.float64] | None = None
    ) -> tuple[float, float]:
        """Return the depth of modulation in a band at a rate [Hz], and that without the highest line.

        Lines that are another part's [Hz] do not count.
        """
        lines = self.lines(band)[: int((_HARMONICS + 1) * rate * self.duration)]
        if taken is not None and taken.size:
            lines = lines.copy()
            for f in taken[(taken > 0.0) & (taken < lines.size / self.duration)]:
                lines[reach_of(f, self.duration)] = 0.0
        squares = []
        for k in range(1, _HARMONICS + 1):
            place = k * rate * self.duration
            at, reach = round(place), math.ceil(WIDTH * place)
            squares.append(float(lines[at - reach : at + reach + 1].max(initial=0.0)) ** 2)
        return math.sqrt(0.5 * sum(squares)), math.sqrt(0.5 * (sum(squares) - max(squares)))

    def deepest(self, rate: float, taken: NDArray[np.float64] | None = None) -> float:
        """Return the largest depth of modulation in any band at a rate [Hz]."""
        return max(self.depths(band, rate, taken)[0] for band in range(len(self.bands)))


def strength_at(
    envelopes: Envelopes, rate: float, taken: NDArray[np.float64] | None = None
) -> Strength:
    """Return how strong a signal is at a rate [Hz], but for lines that are another part's [Hz]."""
    found = [envelopes.depths(band, rate, taken) for band in range(len(envelopes.bands))]
    depths, overtones = zip(*found, strict=True)
    kurtosis = [envelopes.kurtosis(band) for band in range(len(found))]
    # The variance of a squared envelope over its squared mean; that of noise is 1, and of a tone 0.
    varying = [max(one / 1.5 - 1.0, 0.3) for one in kurtosis]
    powers = [
        0.5 * float(row.mean()) * min(depth, 1.0)
        for row, depth in zip(envelopes.rows, depths, strict=True)
    ]
    power = powers[-1]
    struck = [one for one, of in zip(powers, kurtosis, strict=True) if of >= _SMOOTH]
    return Strength(
        acceleration=math.sqrt(power),
        impulsive=math.sqrt(max(struck, default=0.0)),
        share=min(power / envelopes.variance, 1.0),
        depth=max(depths),
        overtones=max(overtones),
        explained=max(depth**2 / of for depth, of in zip(depths, varying, strict=True)),
        band=envelopes.bands[int(np.argmax(depths))],
        kurtosis=max(kurtosis),
    )
