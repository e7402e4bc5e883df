"""Combs of lines that faults have, and how high they stand."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from ..frequencies.kinematic import Orders
    from .envelopes import Levels

Part = Literal["outer_race", "inner_race", "ball", "cage"]
"""A part of a bearing."""

PARTS: tuple[Part, ...] = get_args(Part)

_STEP = 0.001

CAGE_FACTORS = np.linspace(0.954, 1.016, 63)
"""Speeds of the cage over that of pure rolling at the nominal contact angle that are tried, the first and the last
only to see whether lines stand highest between them.

Contact angles up to 20° and dimensions that are not known well make the cage of a deep groove bearing up to 1.5 %
faster; balls that slip in unloaded bearings make it up to 4.5 % slower (measured: 0.960 to 0.993).
"""

_BALL_FACTORS = np.linspace(0.979, 1.021, 43)
"""Orders of a ball over the nominal one that are tried: it rolls on less than its diameter.

Under thrust, with clearance C3, those of simulated bearings are up to 1.8 % above nominal
(``benches/verdict_set.py``, seed 45).
"""

WIDTH = 8e-4
"""How far from its place a line may stand, in parts of its frequency: slip is not steady."""

_HARMONICS = range(1, 5)
_WITH_SIDEBANDS = range(1, 4)


@dataclass(frozen=True, kw_only=True, eq=False)
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
    factors : ndarray, shape (k,)
        Multiples of the nominal order that are tried, but the first and the last, which are only looked at; of
        races and the cage each belongs to one of :data:`CAGE_FACTORS`.
    """

    name: str
    order: float
    sideband: float
    sideband_name: str
    families: tuple[tuple[tuple[int, int], ...], ...]
    factors: NDArray[np.float64]

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


def comb_of(part: Part, orders: Orders, cage: float = 1.0) -> Comb:
    """Return the comb of a part.

    A place on the inner race goes through the load zone once a turn of the shaft, a ball once a turn of the cage,
    one on the outer race where its ring turns: their lines have sidebands there. A ball's defect meets a race
    twice a turn. Where the ball's axis turns, impacts change from pass to pass through the load zone, and the
    lines between sidebands fade: two sidebands on each side are a family of their own.

    Parameters
    ----------
    part : {"outer_race", "inner_race", "ball", "cage"}
        Part.
    orders : Orders
        Those of the bearing.
    cage : float
        Speed of the cage over the nominal one, at which a ball has its sidebands.
    """
    plain = tuple((k, 0) for k in _HARMONICS)
    sides = tuple((k, side) for k in _WITH_SIDEBANDS for side in (-1, 1))
    wide = tuple((k, side) for k in _WITH_SIDEBANDS for side in (-2, -1, 1, 2))
    if part == "ball":
        turns = orders.ftf * float(_factors("cage", orders, np.array([cage]))[0])
        return Comb(name="2·BSF", order=2.0 * orders.bsf, sideband=turns, sideband_name="FTF",
                    families=(plain + sides, wide), factors=_BALL_FACTORS)  # fmt: skip
    factors = _factors(part, orders, CAGE_FACTORS)
    match part:
        case "outer_race":
            return Comb(name="BPFO", order=orders.bpfo, sideband=orders.outer, sideband_name="f_o",
                        families=(plain + sides,) if orders.outer else (plain,), factors=factors)  # fmt: skip
        case "inner_race":
            return Comb(name="BPFI", order=orders.bpfi, sideband=orders.inner, sideband_name="f_r",
                        families=(plain + sides,) if orders.inner else (plain,), factors=factors)  # fmt: skip
        case "cage":
            return Comb(name="FTF", order=orders.ftf, sideband=0.0, sideband_name="",
                        families=(plain,), factors=factors)  # fmt: skip


def _factors(part: Part, orders: Orders, cage: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the orders of a race or the cage over their nominal ones where the cage turns faster by some factors.

    Of the ring that stands the balls pass a place as the cage turns; of the other they pass one as that ring turns
    against the cage: both orders make the number of balls. Where both rings turn, it is the outer one's.
    """
    inner_stands = role_of("inner_race", orders) == "outer_race"
    still, moving = (orders.bpfi, orders.bpfo) if inner_stands else (orders.bpfo, orders.bpfi)
    if part == "cage":
        turns, of_ring = still / (still + moving), orders.inner if inner_stands else orders.outer
        # Rates have no sign: the ring turns as the cage does, or the other way.
        sign = min((-1.0, 1.0), key=lambda one: abs(abs(turns + one * of_ring) - orders.ftf))
        return np.abs(cage * turns + sign * of_ring) / max(orders.ftf, 1e-9)
    if part == ("inner_race" if inner_stands else "outer_race"):
        return cage
    return (still + moving - cage * still) / moving


def cage_factor_of(part: Part, orders: Orders, factor: float) -> float:
    """Return the speed of the cage over the nominal one at which a race has a factor of its nominal order."""
    return float(np.interp(factor, *_rising(_factors(part, orders, CAGE_FACTORS))))


def _rising(factors: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    at = np.argsort(factors)
    return factors[at], CAGE_FACTORS[at]
