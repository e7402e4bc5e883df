"""Plan of a set of records of many bearings: sizes, states, chains and the split, each by its number."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache, cached_property
from typing import Any

import numpy as np

from .._base.polars import pl
from ..bearings import catalogue
from ..datasets.split import bearing_split
from ..measuring import Chain, Logger, random_chains
from .cases import Drawing
from .data import OVERSAMPLED, SKIP
from .recipe import Recipe

SIZES = tuple(f"6{series}{bore:02}" for series in (0, 2, 3) for bore in range(17))
_SPEEDS, _FASTEST = (600.0, 3600.0), 3e5
"""Speeds [1/min], and the largest speed times the pitch diameter [mm/min], at which grease lasts."""
_FAULTS = {"outer": (0.02, 0.4), "inner": (0.02, 0.4), "ball": (0.025, 0.25)}
"""Sizes in ball diameters."""
_STATES = (None, *_FAULTS)
BLOCK = 4 * len(_STATES)
"""Bearings that are split together."""
_TESTED = 1.0 / len(_STATES)
OWN = {
    "split": "train or test, by bearing",
    "radial_load": "load that presses the inner ring down, in N",
    "axial_load": "load along the axis, in N",
    "damage_shape": "none, pit or spall (of a ball a cap)",
    "case_id": "hash of the scene and of the arguments of its run",
    "chain": "near: the sensor is on the pedestal; far: at the end of a path; bearings/ has the chain",
    "range": "range of the logger in m/s^2",
}
"""Columns beside those of ``bearing-datasets``."""


@dataclass(frozen=True, kw_only=True)
class Plan:
    """Plan of a set, on which alone its signals depend.

    Attributes
    ----------
    seed : int
        Seed of all that is drawn.
    seconds : float
        Length of a record [s].
    fs : float
        Sampling rate [Hz].
    records : int
        Records of a bearing, each under a load and at a speed of its own.
    """

    seed: int
    seconds: float
    fs: float
    records: int

    def drawing(self, number: int) -> Drawing:
        """Return the recipe of a bearing by its number."""
        rng = np.random.default_rng([self.seed, 3, number])
        return drawing_of(str(rng.choice(SIZES)), self.seed)

    def rows(self, number: int) -> tuple[str, list[dict[str, Any]]]:
        """Return the designation of a bearing, and its rows of a campaign's table."""
        drawing = self.drawing(number)
        name = drawing.recipe.made.designation
        rows = drawing.rows(_STATES[number % len(_STATES)], number, self.records)
        return name, [row | {"scene": f"{name} {row['scene']}"} for row in rows]

    def chain(self, number: int) -> tuple[str, Chain]:
        """Return the measuring chain of a bearing, and whether its sensor is near or far."""
        rng = np.random.default_rng([self.seed, 4, number])
        size = self.drawing(number).recipe.made.outside_diameter
        chains = random_chains(1, seed=int(rng.integers(2**31)), outside_diameter=size)
        (drawn,) = chains.values()
        chain = replace(drawn, logger=replace(drawn.logger or Logger(), fs=self.fs))
        return ("far" if chain.path else "near"), chain

    @cached_property
    def options(self) -> dict[str, Any]:
        """Arguments of the campaigns."""
        return {
            "duration": self.seconds + SKIP, "fs": OVERSAMPLED * self.fs, "keep": "signals",
            "columns": ["housing.sensor.ay"], "progress": False,
        }  # fmt: skip


@cache
def drawing_of(name: str, seed: int) -> Drawing:
    """Return the recipe of a size of bearing, with a seed."""
    made = catalogue[name]
    ball, highest = 1e3 * made.ball_diameter, _FASTEST / (1e3 * made.pitch_diameter)
    faults = {kind: (low * ball, high * ball) for kind, (low, high) in _FAULTS.items()}
    speeds = (_SPEEDS[0], min(_SPEEDS[1], highest))
    return Drawing(Recipe(name, speed_rpm=speeds, faults=faults), seed)


@cache
def for_testing(seed: int, block: int) -> frozenset[int]:
    """Return which bearings of a block are for testing."""
    numbers = range(block * BLOCK, (block + 1) * BLOCK)
    states = [str(_STATES[n % len(_STATES)]) for n in numbers]
    table = pl.DataFrame({"bearing_id": list(numbers), "label": states})
    return frozenset(bearing_split(table, _TESTED, seed=seed + block)[1]["bearing_id"])
