"""Sensitivity: damage that would have stood out in a record, so that "healthy" says how far it was looked.

Impacts at the rate of the outer race that make up a share of the vibration have envelope lines whose height over
the floor of this record follows from that share. The share at which they reach the height that chance seldom has
is the least that would stand out; how wide a spall is that makes so much comes from simulated bearings.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .fit import fit
from .likelihood import at_any_size

if TYPE_CHECKING:
    from .combs import Comb
    from .null import Found
    from .strength import Envelopes

_LINE = 0.5
"""Amplitude of a line of the squared envelope over its mean, where impacts make up all of a band.

Of a train of short impacts it is 2, of impacts that ring for a tenth of their distance and scatter by a hundredth
of it 0.5 to 1 in the first four lines.
"""

_MOST = 0.5
"""Share of the vibration above which impacts that stand out are no help."""

_DEPTH = 1.2
"""Depth of modulation of such impacts without anything else, by their first six lines."""


@dataclass(frozen=True, kw_only=True)
class Sensitivity:
    """The least damage of the outer race that would stand out in nine of ten such records.

    Attributes
    ----------
    share : float
        Of the vibration's power, impacts at the outer race's rate.
    acceleration : float
        Root mean square of these, in the unit of the record.
    width : float or None
        Width of a spall that makes so much [m]; None where the unit or the bearing's dimensions are not known.
    """

    share: float
    acceleration: float
    width: float | None

    def __str__(self) -> str:
        if self.width is None:
            share = f"{100.0 * self.share:.2g} % of the vibration's power"
            return f"impacts at the outer race's rate with {share} would stand out"
        return f"a spall of {1e3 * self.width:.2g} mm of the outer race would stand out in 9 of 10 such records"


def sensitivity_of(
    envelopes: Envelopes, comb: Comb, found: Found, shaft: float, z: float, *,
    diameter: float | None, ball: float | None,
) -> Sensitivity | None:  # fmt: skip
    """Return the least damage that would stand out; None where hardly any would.

    Parameters
    ----------
    envelopes : Envelopes
        Squared envelopes of the record in bands.
    comb, found : Comb and Found
        Of the outer race.
    shaft : float
        Rate of the shaft [Hz].
    z : float
        From which on a comb counts.
    diameter, ball : float or None
        Pitch diameter and ball diameter [m]; None where strength does not count.
    """
    bands = len(envelopes.bands)
    # Of both ways to prewhiten a band, and of all families of lines, the one that needs least.
    needed = found.chance.height_at(z).reshape(-1, bands).min(axis=0)
    rate = comb.order * shaft
    floors = [_floor(envelopes, band, rate) for band in range(bands)]
    shares = np.array(floors) * 10.0 ** (needed / 20.0) / _LINE
    share = float(shares.min())
    if not share <= _MOST:
        return None
    power = 0.5 * float(envelopes.rows[-1].mean())
    acceleration = math.sqrt(power * min(_DEPTH * share, 1.0))
    if diameter is None or ball is None:
        return Sensitivity(share=share, acceleration=acceleration, width=None)
    line = fit()["strength"]
    size = math.log10(max(at_any_size(acceleration, diameter, shaft), 1e-12))
    width = max(10.0 ** ((size - line["constant"]) / line["slope"]), line["narrowest"])
    if width > line["widest"]:
        return None
    return Sensitivity(share=share, acceleration=acceleration, width=width * ball)


def _floor(envelopes: Envelopes, band: int, rate: float) -> float:
    """Return the median amplitude of the squared envelope's lines up to four times a rate [Hz], over its mean."""
    low, high = (int(multiple * rate * envelopes.duration) for multiple in (0.5, 4.5))
    return float(np.median(envelopes.lines(band)[low : high + 1]))
