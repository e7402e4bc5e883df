"""Quantities of one record that are followed over time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..diagnosis.null import ACCUSED
from ..diagnosis.strength import Envelopes

if TYPE_CHECKING:
    from ..channel import Channel
    from ..diagnosis import Diagnosis

FOLLOWED = (
    "rms",
    "velocity",
    "crest_factor",
    "kurtosis",
    *(f"{part}.acceleration" for part in ACCUSED),
    *(f"{part}.lines" for part in ACCUSED),
)
"""Columns in which a departure is looked for."""

POOLED = tuple(f"{part}.lines" for part in ACCUSED)
"""Quantities that each record shares with the last ones."""


@dataclass(frozen=True)
class Shape:
    """Crest factor and kurtosis of a band."""

    crest_factor: float
    kurtosis: float


def shapes_of(
    channel: Channel, bands: tuple[tuple[float, float], ...]
) -> dict[tuple[float, float], Shape]:
    """Return crest factor and kurtosis by band."""
    found = Envelopes(channel.x, channel.fs, bands)
    return {band: Shape(found.crest_factor(k), found.kurtosis(k)) for k, band in enumerate(bands)}


def numbers_of(channel: Channel, found: Diagnosis) -> dict[str, float | str | None]:
    """Return all that does not depend on a band that is chosen later."""
    severity = found.severity
    numbers: dict[str, float | str | None] = {
        "verdict": found.verdict,
        "parts": "+".join(found.parts),
        "shaft": found.shaft.rate,
        "rms": float(np.std(channel.x)),
        "velocity": None if severity is None else severity.velocity,
        "zone": None if severity is None else severity.zone,
    }
    for part in ACCUSED:
        one = found.evidence.get(part)
        numbers[f"{part}.z"] = None if one is None else one.z
        numbers[f"{part}.acceleration"] = None if one is None else one.strength.acceleration
    return numbers
