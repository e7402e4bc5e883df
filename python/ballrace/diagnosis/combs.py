"""Combs of lines that faults have, and how high they stand."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..frequencies.kinematic import Orders
    from .envelopes import Levels

__all__ = ["PARTS", "REACH", "WIDTH", "Comb", "Part", "comb_of", "role_of"]

Part = Literal["outer_race", "inner_race", "ball", "cage"]
"""A part of a bearing."""

PARTS: tuple[Part, ...] = get_args(Part)

REACH = 0.015
"""How far slip, contact angle and a pitch diameter that is not known take orders from nominal ones, in parts."""

_REACH_OF_BALLS = 0.02
"""The same of balls, which roll on less than their diameter.

Under thrust, with clearance C3, those of simulated bearings are up to 1.8 % above nominal
(``benches/verdict_set.py``, seed 45).
"""

_STEP = 0.001

WIDTH = 8e-4
"""How far from its place a line may stand, in parts of its frequency: slip is not steady."""

_HARMONICS = range(1, 5)
_WITH_SIDEBANDS = range(1, 4)


@dataclass(frozen=True, kw_only=True)
class Comb:
    """Lines at multiples of an order, some with sidebands.

    Attributes
    ----------
    name : str
        Name of the order, such as ``BPFO``.
    order : float
        Its nominal value.
    sideband : float
        Distance of the sidebands, as an order; 0: none.
    families : tuple of tuple of tuple of two ints
        Lines that stand out together, each by its harmonic and its sideband, from (1, 0) on; one family is enough.
    reach : float
        How far from the nominal order it is looked for, in parts of it.
    """

    name: str
    order: float
    sideband: float
    sideband_name: str
    families: tuple[tuple[tuple[int, int], ...], ...]
    reach: float = REACH

    @property
    def factors(self) -> NDArray[np.float64]:
        """Multiples of the nominal order that are tried."""
        return np.linspace(1.0 - self.reach, 1.0 + self.reach, 2 * round(self.reach / _STEP) + 1)

    @property
    def lines(self) -> tuple[tuple[int, int], ...]:
        """Harmonic and sideband of each line of any family."""
        return tuple(dict.fromkeys(line for family in self.families for line in family))

    def frequencies(self, base: NDArray[np.float64], shaft: float) -> NDArray[np.float64]:
        """Return the frequencies of the lines [Hz] over those of base frequencies [Hz], a line a row."""
        rows = [k * base + side * self.sideband * shaft for k, side in self.lines]
        return np.array(rows)

    def heights(
        self, levels: Levels, base: NDArray[np.float64], shaft: float
    ) -> NDArray[np.float64]:
        """Return the mean level of each family [dB], shape (families, spectra, *base.shape, factors)."""
        tried = base[..., np.newaxis] * self.factors
        total = np.zeros((len(self.families), levels.db.shape[0], *tried.shape))
        for line, row in zip(self.lines, self.frequencies(tried, shaft), strict=True):
            level = levels.highest(row, WIDTH)
            for k, family in enumerate(self.families):
                if line in family:
                    total[k] += level / len(family)
        return total

    def label(self, line: tuple[int, int]) -> str:
        """Return the name of a line, such as ``2·BPFI − f_r``."""
        harmonic, side = line
        head = self.name if harmonic == 1 else f"{harmonic}·{self.name}"
        tail = self.sideband_name if abs(side) == 1 else f"{abs(side)}·{self.sideband_name}"
        return head if side == 0 else f"{head} {'+' if side > 0 else '−'} {tail}"


def role_of(part: Part, orders: Orders) -> Part:
    """Return the part of a bearing with a shaft that turns whose role in the load this one has.

    Balls pass the load at the rate of the race that stands, in a healthy bearing as well, and its lines have
    no sidebands. That is the outer race as a rule, and the inner one of a hub.
    """
    if part not in ("outer_race", "inner_race"):
        return part
    turns = orders.outer if part == "outer_race" else orders.inner
    return "inner_race" if turns else "outer_race"


def comb_of(part: Part, orders: Orders) -> Comb:
    """Return the comb of a part.

    A place on the inner race goes through the load zone once a turn of the shaft, a ball once a turn of the cage,
    one on the outer race where its ring turns: their lines have sidebands there. A ball's defect meets a race
    twice a turn. Where the ball's axis turns, impacts change from pass to pass through the load zone, and the
    lines between sidebands fade: two sidebands on each side are a family of their own.
    """
    plain = tuple((k, 0) for k in _HARMONICS)
    sides = tuple((k, side) for k in _WITH_SIDEBANDS for side in (-1, 1))
    wide = tuple((k, side) for k in _WITH_SIDEBANDS for side in (-2, -1, 1, 2))
    match part:
        case "outer_race":
            return Comb(name="BPFO", order=orders.bpfo, sideband=orders.outer, sideband_name="f_o",
                        families=(plain + sides,) if orders.outer else (plain,))  # fmt: skip
        case "inner_race":
            return Comb(name="BPFI", order=orders.bpfi, sideband=orders.inner, sideband_name="f_r",
                        families=(plain + sides,) if orders.inner else (plain,))  # fmt: skip
        case "ball":
            return Comb(name="2·BSF", order=2.0 * orders.bsf, sideband=orders.ftf, sideband_name="FTF",
                        families=(plain + sides, wide), reach=_REACH_OF_BALLS)  # fmt: skip
        case "cage":
            return Comb(
                name="FTF", order=orders.ftf, sideband=0.0, sideband_name="", families=(plain,)
            )
