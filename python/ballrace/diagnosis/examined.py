"""The evidence of a record for all parts, before anything is made of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from .combs import PARTS, Part, comb_of
from .envelopes import Levels, bands_of, envelope_spectra, levels_of, without_rings
from .evidence import Evidence, evidence_of
from .kinematics import LEAST
from .lacking import HELD
from .null import ACCUSED
from .shaft import WITHIN, ShaftRate, shaft_rate
from .strength import Envelopes

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import NDArray

    from ..channel import Channel
    from .kinematics import Kinematics

__all__ = ["Examined", "bands_for", "examined"]


@dataclass(frozen=True, kw_only=True, eq=False)
class Examined:
    """What a record shows: rate of the shaft, levels of lines, envelopes in bands, evidence by part."""

    shaft: ShaftRate
    levels: Levels
    envelopes: Envelopes
    evidence: dict[Part, Evidence]


def bands_for(
    channel: Channel, kinematics: Kinematics, nominal: float
) -> list[tuple[float, float]]:
    """Return the bands of a record [Hz] for a nominal rate of the shaft [Hz]."""
    return bands_of(channel.fs, HELD * kinematics.orders.bpfi * nominal)


def examined(
    channel: Channel, kinematics: Kinematics, nominal: float, *,
    within: float = WITHIN, orders: Sequence[float] = (), rates: Sequence[float] = (), seed: int = 0,
) -> Examined:  # fmt: skip
    """Return the evidence of a record.

    Parameters
    ----------
    channel : Channel
        Record.
    kinematics : Kinematics
        Bearing.
    nominal : float
        Nominal rate of the shaft [Hz].
    within : float
        How far the shaft's rate may be from it, as a part of it.
    orders, rates : sequence of float
        Orders, and rates [Hz], that are not the bearing's.
    seed : int
        Which combs the null has.
    """
    bands = bands_for(channel, kinematics, nominal)
    spectra = _spectra(channel, bands, kinematics, nominal)
    if len(kinematics.orders.turning) == 1:
        shaft = shaft_rate(channel.x, channel.fs, nominal, spectra, within)
    else:
        # Each of two rings may be off by another part, and lines of faults are near those of the one or the other.
        shaft = ShaftRate(rate=nominal, nominal=nominal, by="nominal", z=0.0)
    levels = levels_of(spectra, channel.n_samples / channel.fs, shaft.rate)
    levels = levels.without([order * shaft.rate for order in orders] + [*rates])
    levels = without_rings(levels, kinematics.orders, shaft.rate)
    envelopes = Envelopes(channel.x, channel.fs, bands)
    evidence = {
        part: evidence_of(
            part, envelopes, levels=levels, kinematics=kinematics, shaft=shaft.rate, seed=seed
        )
        for part in PARTS
        if comb_of(part, kinematics.orders).order >= LEAST
    }
    return Examined(shaft=shaft, levels=levels, envelopes=envelopes, evidence=evidence)


def _spectra(
    channel: Channel, bands: list[tuple[float, float]], kinematics: Kinematics, shaft: float
) -> NDArray[np.float64]:
    """Return the spectra of envelopes up to the last line of the null's highest comb."""
    highest = max(comb_of(part, kinematics.orders).order for part in ACCUSED)
    limit = (4.1 * 1.55 * highest + 3.0) * shaft
    return envelope_spectra(channel.x, channel.fs, bands, limit, shaft)
