"""Lines of faults in records that are too short to show them, by spectra of squared envelopes of several records.

A record of some turns of the shaft has three bins between two of its orders, and lines as high by chance as
those of early damage. In the median of the last records chance evens out and lines stay.
"""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING

import numpy as np

from ..diagnosis.combs import comb_of
from ..diagnosis.drift import without_drift
from ..diagnosis.envelopes import levels_of
from ..diagnosis.examined import bands_for, spectra_of
from ..diagnosis.null import ACCUSED

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..channel import Channel
    from ..diagnosis.kinematics import Kinematics

TURNS = 60.0
"""Turns of the shaft in a group of records, at least, as far as the baseline allows."""


class Pool:
    """The spectra of the last records.

    Parameters
    ----------
    kinematics : Kinematics
        Bearing.
    shaft : float
        Rate of the shaft [Hz].
    count : int
        Records in a group.
    """

    def __init__(self, kinematics: Kinematics, shaft: float, count: int) -> None:
        self.kinematics, self.shaft, self.count = kinematics, shaft, count
        self._spectra: deque[NDArray[np.float64]] = deque(maxlen=count)

    def heights(self, channel: Channel) -> dict[str, float | None]:
        """Add a record, and return how high lines of each part stand in the last ones; None of too few.

        Heights are means of the levels of a comb over their running medians, the highest of all bands [dB].
        """
        orders = self.kinematics.orders
        steady = without_drift(channel.x, channel.fs, self.shaft)
        bands = bands_for(channel, self.kinematics, self.shaft)
        nothing: dict[str, float | None] = dict.fromkeys(ACCUSED)
        if not bands:
            return nothing
        found = spectra_of(steady, channel.fs, bands, self.kinematics, self.shaft)
        if self._spectra and self._spectra[-1].shape != found.shape:
            self._spectra.clear()
        self._spectra.append(_evened(found))
        if len(self._spectra) < self.count:
            return nothing
        # Of a median one record with large impacts is not more than another.
        typical = np.median(self._spectra, axis=0)
        levels = levels_of(typical, channel.n_samples / channel.fs, self.shaft)
        return nothing | {
            part: float(comb.heights(levels, np.array([comb.order * self.shaft]), self.shaft).max())
            for part, comb in ((part, comb_of(part, orders)) for part in ACCUSED)
        }


def _evened(found: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return spectra over their medians, so that each record counts alike, however loud.

    A narrow band has no lines above its width, which are no part of its median.
    """
    typical = [np.median(row[row > 0.0]) if row.any() else 1.0 for row in found]
    return np.asarray(found / np.array(typical)[:, np.newaxis])
