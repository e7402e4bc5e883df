"""The tachometer."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .._base.numbers import counted, positive


@dataclass(frozen=True, kw_only=True)
class Tacho:
    """A tachometer at the shaft.

    Attributes
    ----------
    pulses : int
        Pulses a turn, at even angles, the first at the angle 0.
    jitter : float
        Standard deviation of the time of a pulse, normal [s].
    """

    pulses: int = 1
    jitter: float = 0.0

    def __post_init__(self) -> None:
        counted("tacho.pulses", self.pulses, 1)
        positive("tacho.jitter", self.jitter, "s", zero=True)

    def times(
        self, t: NDArray[np.float64], angle: NDArray[np.float64], rng: np.random.Generator
    ) -> NDArray[np.float64]:
        """Return when it gives pulses [s], rising; it counts turns forwards alone.

        Parameters
        ----------
        t, angle : ndarray, shape (n,)
            Times [s], and the angle of the shaft there [rad].
        rng : Generator
            What the jitter is drawn from.
        """
        # Of an angle that swings back, what was reached before gives no second pulse.
        turned = np.maximum.accumulate(
            np.sign(angle[-1] - angle[0]) * angle * self.pulses / (2.0 * np.pi)
        )
        counts = np.arange(np.ceil(turned[0] - 1e-9), np.floor(turned[-1] + 1e-9) + 1.0)
        times = np.interp(counts, turned, t)
        return np.sort(times + self.jitter * rng.standard_normal(times.size))
