"""Impacts that come and go with the cage: a damaged ball meets the load zone once in a turn of the cage."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

    from .combs import Part
    from .evidence import Evidence

_IMPACTS = 10.0
"""Kurtosis from which on there are impacts: damaged balls of measured sets have 11 to 55, or none."""


@dataclass(frozen=True, kw_only=True)
class Bursts:
    """Impacts at the cage's rate: their kurtosis, and how often chance has lines of one of three parts as high."""

    kurtosis: float
    probability: float


def bursts_of(evidence: Mapping[Part, Evidence]) -> Bursts | None:
    """Return the impacts that come and go with the cage; None where there are none, or the cage has no lines."""
    if "cage" not in evidence:
        return None
    cage, strength = evidence["cage"], evidence["cage"].strength
    # Tones beside each other swell and fade, too; as a sine does.
    if strength.kurtosis < _IMPACTS or strength.is_shallow or strength.is_sine:
        return None
    return Bursts(kurtosis=strength.kurtosis, probability=cage.probability)
