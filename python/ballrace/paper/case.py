"""Results of one load case of the paper."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .._base.libraries import pl
from ..signals import Signals
from .measures import Array, Zone


@dataclass(frozen=True)
class Static:
    """The healthy bearing at rest in the cage's frame, a ball of row 0 at -90°.

    Attributes
    ----------
    ball_z, outer_z : float
        Axial places of that ball and of the outer ring [m].
    zone_middle : float
        Middle of its force on the outer race, in the ring's frame [m].
    load : float
        Its load on the outer race [N].
    """

    ball_z: float
    outer_z: float
    zone_middle: float
    load: float


@dataclass(frozen=True)
class Balls:
    """Balls at one instant; arrays have one entry per ball, row by row.

    Attributes
    ----------
    row, ball : ndarray of int, shape (n_balls,)
        Row, and place of the ball in it.
    angle : ndarray, shape (n_balls,)
        Where it stands [rad].
    z : ndarray, shape (n_balls,)
        Axial place [m].
    outer_load, inner_load : ndarray, shape (n_balls,)
        Normal forces [N].
    """

    row: NDArray[np.int64]
    ball: NDArray[np.int64]
    angle: Array
    z: Array
    outer_load: Array
    inner_load: Array

    def to_polars(self) -> pl.DataFrame:
        """Return a table with a line per ball."""
        return pl.DataFrame(self.__dict__)


@dataclass(frozen=True)
class Snapshot:
    """The bearing at t = 0.017992 s.

    Attributes
    ----------
    balls : Balls
        All balls.
    middle : int
        Index, in ``balls``, of the ball of row 0 nearest to -90°.
    outer_z : float
        Axial place of the outer ring [m].
    zone : Zone
        Contact zone of the middle ball on the outer race.
    slices : dict of str to ndarray, each of shape (n_slices,)
        Slices of the middle ball on the outer race: ``zeta``, ``z``, ``width``, ``penetration`` [m] and
        ``force`` [N].
    """

    balls: Balls
    middle: int
    outer_z: float
    zone: Zone
    slices: Mapping[str, Array]


@dataclass(frozen=True)
class Dynamic:
    """Numbers of the outer ring's vertical acceleration.

    Attributes
    ----------
    impact, impact_spread : float
        Mean and standard deviation of the impacts [m/s²].
    impact_count : int
        Impacts counted.
    largest : float
        Largest impact [m/s²].
    line : float
        Amplitude of the envelope's line at ``bpfo`` [m/s²].
    clarity : float
        How far the squared envelope's line at ``bpfo`` stands over its surroundings [dB].
    rms : float
        Root mean square about the mean [m/s²].
    bpfo : float
        Rate at which balls of row 0 pass a place of the outer race in this run [Hz].
    """

    impact: float
    impact_spread: float
    impact_count: int
    largest: float
    line: float
    clarity: float
    rms: float
    bpfo: float


@dataclass(frozen=True)
class Case:
    """An axial load: everything that is compared.

    Attributes
    ----------
    signals : Signals
        The run from the paper's start.
    dynamic : Dynamic
        Features of its signal.
    snapshot : Snapshot
        The bearing at t = 0.017992 s.
    static : Static
        The healthy bearing at rest.
    transient : float
        Time until the paper's start of the healthy bearing has died down [s].
    start_at_rest : float
        Acceleration of the healthy bearing in the first passage of a ball after a start from equilibrium, over
        the same after the paper's start, root mean squares.
    """

    signals: Signals
    dynamic: Dynamic
    snapshot: Snapshot
    static: Static
    transient: float
    start_at_rest: float
