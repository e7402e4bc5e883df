"""Null distribution: combs by chance, the same comb at orders of the same record that no part of the bearing has.

Nothing is trained and no threshold in decibels is set: a tone of the machine, a sloping spectrum or a short record
raise the null as they raise the fault's comb. The largest of many combs is distributed as extreme values are
(E. J. Gumbel, *Statistics of Extremes*, 1958): of white noise the probabilities below came out within a factor 1.2
of the share of records (``tests/python/test_diagnosis.py``).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .combs import PARTS, WIDTH, comb_of
from .envelopes import FLOOR
from .kinematics import LEAST

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..frequencies.kinematic import Orders
    from .combs import Comb
    from .envelopes import Levels

ACCUSED = PARTS[:3]
"""Parts that a verdict may name: the cage's line alone is no sign of damage."""

_COUNT = 600
"""Combs of the null."""

_APART = 0.02
"""Nearest that an order of the null comes to one at which a comb shares lines with a fault's, as a part of it."""

_APART_OF_BALLS = 0.025
"""The same of a ball, whose order is looked for in a wider range."""

_SIDEBANDS = 4
"""Sidebands of a ball's order on each side that its damage fills, since it meets the load zone now and then.

A comb at the order of one of them has its lines in common with the ball's: of a null that held such combs a
quarter would hold lines of the damage, which would stand out less. Of 18 balls of ``benches/verdict_set.py``,
seed 45, the lines of 9, 8 and 11 stood out so at 20, 10 and 0 dB, and those of 13, 14 and 14 do without.
"""

_OF_SHAFT = 0.03
"""Nearest that it comes to a multiple of a ring's turns, over these if they are below 1."""

_SPREAD = 1.4826
"""Standard deviation of normal numbers over the median of their distances from their median."""

_LEAST = 0.3
"""Added to the spread of a spectrum's combs [dB]: where all are alike, none stands out for that."""

_GUMBEL = 0.36651, 0.76705
"""Median, and median distance from it, of the standard Gumbel distribution."""


@dataclass(frozen=True, kw_only=True, eq=False)
class ByChance:
    """Heights of the null's combs: median and spread in each spectrum, and of the largest score over all spectra.

    Attributes
    ----------
    middle, spread : ndarray, shape (rows,)
        Of the heights, a row a family of lines and a spectrum [dB].
    centre, deviation : float
        Of the largest of (height − middle)/spread.
    """

    middle: NDArray[np.float64]
    spread: NDArray[np.float64]
    centre: float
    deviation: float

    def height_at(self, z: float) -> NDArray[np.float64]:
        """Return the height with which a comb has a z in each row [dB], shape (rows,)."""
        return self.middle + self.spread * (self.centre + self.deviation * z)


@dataclass(frozen=True, kw_only=True)
class Found:
    """A comb beside its null.

    Attributes
    ----------
    z : float
        How far it stands above the null's median, in the null's standard deviations.
    row : int
        Spectrum in which it stands out most.
    at : int
        Which of the comb's factors it has there.
    height : float
        Mean level of its lines there [dB].
    chance : ByChance
        What it is compared with.
    """

    z: float
    row: int
    at: int
    height: float
    chance: ByChance


def null_orders(orders: Orders, part: str, rng: np.random.Generator) -> NDArray[np.float64]:
    """Draw orders of the null, around those of the races and balls, or of the cage."""
    faults = [comb_of(each, orders).order for each in ACCUSED]
    near = [orders.ftf] if part == "cage" else faults
    ratios = [p / q for p in range(1, 5) for q in range(1, 5)]
    cage = [orders.ftf] if orders.ftf >= LEAST else []
    shared = [fault * ratio for fault in (*faults, *cage) for ratio in ratios]
    if part == "ball":
        shared += [2.0 * orders.bsf + k * orders.ftf for k in range(-_SIDEBANDS, _SIDEBANDS + 1)]
    apart = _APART_OF_BALLS if part == "ball" else _APART
    drawn = rng.uniform(0.6 * min(near), 1.55 * max(near), 6 * _COUNT)
    own = np.abs(drawn[:, np.newaxis] / np.array(shared) - 1.0).min(axis=1) < apart
    whole: NDArray[np.bool_] = np.any([_is_near(drawn, turns) for turns in orders.turning], axis=0)
    free = drawn[~(own | whole)]
    # Of a bearing whose faults lie so densely that next to nothing is left, nearer ones have to do.
    return free[:_COUNT] if free.size >= _COUNT // 4 else drawn[~whole][:_COUNT]


def _is_near(orders: NDArray[np.float64], turns: float) -> NDArray[np.bool_]:
    """Whether orders are near multiples of a ring's turns."""
    apart = np.abs(orders - turns * np.rint(orders / turns))
    return np.asarray(apart < _OF_SHAFT * min(turns, 1.0))


def found_of(
    comb: Comb,
    levels: Levels,
    shaft: float,
    null: NDArray[np.float64],
    *,
    null_levels: Levels,
    near: NDArray[np.bool_] | None = None,
) -> Found:
    """Return a comb beside the null's.

    Parameters
    ----------
    comb : Comb
        The comb.
    levels : Levels
        Where it is looked for.
    shaft : float
        Rate of the shaft [Hz].
    null : ndarray, shape (n,)
        Orders of the null.
    null_levels : Levels
        Where the null's combs are.
    near : ndarray of bool, optional
        Which of the comb's factors are tried, where they are known; by default all, of which one counts where
        lines stand higher than at both of its neighbours. What rises up to the end of a search is not found.
    """
    tried = np.concatenate(comb.heights(levels, np.array([comb.order * shaft]), shaft)[:, :, 0])
    by_chance = _highest(np.concatenate(comb.heights(null_levels, null * shaft, shaft)), near)
    middle = np.median(by_chance, axis=1)
    spread = _SPREAD * np.median(np.abs(by_chance - middle[:, np.newaxis]), axis=1) + _LEAST
    scores = ((by_chance - middle[:, np.newaxis]) / spread[:, np.newaxis]).max(axis=0)
    centre = float(np.median(scores))
    deviation = max(_SPREAD * float(np.median(np.abs(scores - centre))), 1e-9)
    score = (_summits(tried, near) - middle[:, np.newaxis]) / spread[:, np.newaxis]
    row, at = np.unravel_index(int(np.argmax(score)), score.shape)
    return Found(
        z=(float(score.max()) - centre) / deviation,
        row=int(row) % levels.db.shape[0],
        at=int(at),
        height=float(tried[row, at]),
        chance=ByChance(middle=middle, spread=spread, centre=centre, deviation=deviation),
    )


def _highest(heights: NDArray[np.float64], near: NDArray[np.bool_] | None) -> NDArray[np.float64]:
    found: NDArray[np.float64] = _summits(heights, near).max(axis=-1)
    return found


def _summits(heights: NDArray[np.float64], near: NDArray[np.bool_] | None) -> NDArray[np.float64]:
    """Return heights over factors where they count, elsewhere the floor of levels."""
    if near is not None:
        return np.where(near, heights, FLOOR)
    inner = heights[..., 1:-1]
    found = np.full_like(heights, FLOOR)
    tops = (inner >= heights[..., :-2]) & (inner >= heights[..., 2:])
    found[..., 1:-1] = np.where(tops, inner, FLOOR)
    return found


def probability(z: float, of: int = 1) -> float:
    """Return how often the largest of some combs stands that high by chance.

    Examples
    --------
    >>> round(probability(5.0), 5), round(probability(5.0, of=3), 5)
    (0.00235, 0.00703)
    """
    median, distance = _GUMBEL
    above = median + _SPREAD * distance * z
    alone = -math.expm1(-math.exp(-min(above, 700.0)) if above > -30.0 else -math.inf)
    return -math.expm1(of * math.log1p(-alone)) if alone < 1.0 else 1.0


def largest_z(rate: float, of: int) -> float:
    """Return the z that some combs exceed at a rate by chance."""
    low, high = -5.0, 200.0
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if probability(middle, of) > rate else (low, middle)
    return high


def levels_by_chance(
    comb: Comb, levels: Levels, shaft: float, null: NDArray[np.float64], shares: Sequence[float]
) -> NDArray[np.float64]:
    """Return quantiles of single lines of the null, shape (len(shares), spectra) [dB]."""
    lines = levels.highest(comb.frequencies(null * shaft, shaft), WIDTH)
    return np.quantile(lines, shares, axis=(1, 2))
