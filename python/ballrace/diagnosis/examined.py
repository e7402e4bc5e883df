"""The evidence of a record for all parts, before anything is made of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from .combs import Part, comb_of
from .envelopes import Levels, bands_of, envelope_spectra, levels_of, without_rings
from .evidence import Evidence, evidence_of
from .lacking import HELD
from .null import ACCUSED
from .search import Search, searched
from .shaft import FURTHEST, WITHIN, ShaftRate, shaft_rate
from .strength import Envelopes

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import NDArray

    from ..channel import Channel
    from .kinematics import Kinematics


@dataclass(frozen=True, kw_only=True, eq=False)
class Examined:
    """Rate of the shaft, levels of lines, envelopes in bands, searches and evidence by part of a record."""

    shaft: ShaftRate
    levels: Levels
    envelopes: Envelopes
    searches: dict[Part, Search]
    evidence: dict[Part, Evidence]


def bands_for(
    channel: Channel, kinematics: Kinematics, nominal: float
) -> list[tuple[float, float]]:
    """Return the bands of a record [Hz] for a nominal rate of the shaft [Hz]."""
    return bands_of(channel.fs, HELD * kinematics.orders.bpfi * nominal)


def examined(
    channel: Channel, kinematics: Kinematics, nominal: float, *,
    within: float | None = None, orders: Sequence[float] = (), rates: Sequence[float] = (), seed: int = 0,
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
    within : float, optional
        How far the shaft's rate may be from it, as a part of it; by default 1 %, and 8 % where the record's own
        lines are not clear there but are further away.
    orders, rates : sequence of float
        Orders, and rates [Hz], that are not the bearing's.
    seed : int
        Which combs the null has.
    """
    bands = bands_for(channel, kinematics, nominal)
    spectra = spectra_of(channel.x, channel.fs, bands, kinematics, nominal)
    if len(kinematics.orders.turning) == 1:
        shaft = shaft_rate(
            channel.x, channel.fs, nominal, spectra, WITHIN if within is None else within
        )
        if within is None and shaft.by == "nominal":
            shaft = shaft_rate(channel.x, channel.fs, nominal, spectra, FURTHEST)
    else:
        # Each of two rings may be off by another part, and lines of faults are near those of the one or the other.
        shaft = ShaftRate(rate=nominal, nominal=nominal, by="nominal", z=0.0)
    levels = levels_of(spectra, channel.n_samples / channel.fs, shaft.rate)
    levels = levels.without([order * shaft.rate for order in orders] + [*rates])
    levels = without_rings(levels, kinematics.orders, shaft.rate)
    envelopes = Envelopes(channel.x, channel.fs, bands)
    searches = searched(levels, envelopes, kinematics.orders, shaft.rate, seed)
    evidence = {
        part: evidence_of(search, envelopes, kinematics=kinematics, shaft=shaft.rate)
        for part, search in searches.items()
    }
    return Examined(
        shaft=shaft, levels=levels, envelopes=envelopes, searches=searches, evidence=evidence
    )


def spectra_of(
    x: NDArray[np.float64], fs: float, bands: list[tuple[float, float]], kinematics: Kinematics, shaft: float
) -> NDArray[np.float64]:  # fmt: skip
    """Return the spectra of envelopes up to the last line of the null's highest comb."""
    highest = max(comb_of(part, kinematics.orders).order for part in ACCUSED)
    limit = (4.1 * 1.55 * highest + 3.0) * (1.0 + FURTHEST) * shaft
    return envelope_spectra(x, fs, bands, limit, shaft)
