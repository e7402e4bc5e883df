"""Features that :class:`ballrace.learn.EnvelopeLines` computes of one record."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..diagnosis.combs import PARTS, comb_of
from ..diagnosis.envelopes import bands_of, envelope_spectra, levels_of, without_rings
from ..diagnosis.lacking import HELD
from ..diagnosis.strength import Envelopes

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..diagnosis.envelopes import Levels
    from ..frequencies.kinematic import Orders

_SHORTEST = 64
"""Samples below which a band has too few for any envelope."""

_WHOLE = (0.03, 0.95)
"""The one band of a record whose sampling rate is too low for several, in parts of fs/2."""


def names_of(orders: NDArray[np.float64]) -> list[str]:
    """Return the names of the features."""
    heights = [f"{part}.height" for part in PARTS]
    depths = [f"{part}.depth" for part in PARTS]
    return [*heights, *depths, *(f"order {o:.6g}" for o in orders)]


def features_of(
    x: NDArray[np.float64], fs: float, shaft: float, kinematic: Orders, orders: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the features of a signal; 0 where it is too short for one.

    Parameters
    ----------
    x : ndarray, shape (n,)
        Signal.
    fs, shaft : float
        Sampling rate, and rate of the shaft [Hz].
    kinematic : Orders
        Those of the bearing.
    orders : ndarray, shape (m,)
        Middles of equal steps of the envelope's orders; may be empty.
    """
    if x.size < _SHORTEST or not x.std() > 1e-12 * np.abs(x).max(initial=0.0):
        return np.zeros(len(names_of(orders)))
    whole = (_WHOLE[0] * fs / 2.0, _WHOLE[1] * fs / 2.0)
    bands = bands_of(fs, HELD * kinematic.bpfi * shaft) or [whole]
    highest = max(
        4.1 * 2.0 * kinematic.bsf, 4.1 * kinematic.bpfi + 2.0, float(orders.max(initial=0.0)) + 1.0
    )
    spectra = envelope_spectra(x, fs, bands, highest * shaft, shaft)
    levels = without_rings(levels_of(spectra, x.size / fs, shaft), kinematic, shaft)
    envelopes = Envelopes(x, fs, bands)
    heights, depths = [], []
    for part in PARTS:
        comb = comb_of(part, kinematic)
        found = comb.heights(levels, np.array([comb.order * shaft]), shaft)[0, :, 0]
        factor = comb.factors[int(np.argmax(found.max(axis=0)))]
        rate = comb.order * factor * shaft
        heights.append(float(found.max()))
        depths.append(max(envelopes.depths(band, rate)[0] for band in range(len(bands))))
    return np.array([*heights, *depths, *_spectrum(levels, shaft, orders)])


def _spectrum(levels: Levels, shaft: float, orders: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the highest level within each step of orders, a mean over bands [dB]."""
    if orders.size == 0:
        return orders
    half = 0.5 * float(orders[1] - orders[0])
    edges = np.append(orders - half, orders[-1] + half) * shaft * levels.duration
    at = np.clip(np.rint(edges).astype(int), 0, levels.db.shape[1] - 1)
    found: NDArray[np.float64] = np.maximum.reduceat(levels.db, at[:-1], axis=1).mean(axis=0)
    return found
