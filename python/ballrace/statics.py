"""The static solution of a scene."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from . import _core

if TYPE_CHECKING:
    import polars as pl

    from .scene import Scene

__all__ = ["Equilibrium", "equilibrium"]

_BALL = ("angle", "radius", "z")
_CONTACT = ("load", "angle", "deflection", "zone_centre")


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Equilibrium:
    """Static equilibrium in the cage's frame; arrays have one entry per ball, row by row.

    Attributes
    ----------
    outer, inner : ndarray, shape (3,)
        Displacements of the rings [m].
    row, ball : ndarray of int, shape (n_balls,)
        Row, and place of the ball in it, both from 0.
    angle, radius, z : ndarray, shape (n_balls,)
        Cylindrical coordinates of the ball's centre [rad, m, m].
    outer_load, inner_load : ndarray, shape (n_balls,)
        Normal forces [N].
    outer_angle, inner_angle : ndarray, shape (n_balls,)
        Operating contact angles [rad]; not a number without load.
    outer_deflection, inner_deflection : ndarray, shape (n_balls,)
        Elastic deflections [m]; negative: a gap.
    outer_zone_centre, inner_zone_centre : ndarray, shape (n_balls,)
        Axial place of the zone's middle of force, in the ring's frame [m]; not a number without load.
    iterations : int
        Iterations of the solver.
    """

    outer: NDArray[np.float64]
    inner: NDArray[np.float64]
    row: NDArray[np.int64]
    ball: NDArray[np.int64]
    angle: NDArray[np.float64]
    radius: NDArray[np.float64]
    z: NDArray[np.float64]
    outer_load: NDArray[np.float64]
    outer_angle: NDArray[np.float64]
    outer_deflection: NDArray[np.float64]
    outer_zone_centre: NDArray[np.float64]
    inner_load: NDArray[np.float64]
    inner_angle: NDArray[np.float64]
    inner_deflection: NDArray[np.float64]
    inner_zone_centre: NDArray[np.float64]
    iterations: int

    def __repr__(self) -> str:
        loaded = int(np.count_nonzero(self.outer_load > 0.0))
        return (
            f"<Equilibrium: {loaded} of {self.ball.size} balls loaded, "
            f"largest load {self.outer_load.max():.1f} N, after {self.iterations} iterations>"
        )

    def to_polars(self) -> pl.DataFrame:
        """Return a table with a line per ball and the columns ``row``, ``ball``, ``angle``, …."""
        import polars as pl

        names = ["row", "ball", *_BALL]
        names += [f"{race}_{quantity}" for race in ("outer", "inner") for quantity in _CONTACT]
        return pl.DataFrame({name: getattr(self, name) for name in names})


def equilibrium(scene: Scene) -> Equilibrium:
    """Solve a scene at rest in the cage's frame, with all loads, gravity and centrifugal forces.

    Parameters
    ----------
    scene : Scene
        The scene.

    Returns
    -------
    Equilibrium
        Displacements, loads, contact angles and deflections.

    Raises
    ------
    SceneError
        A field of the scene is not usable.
    EquilibriumError
        There is no stable equilibrium: the load cannot be carried.
    """
    solution = json.loads(_core.equilibrium(scene.to_json()))
    balls = solution["balls"]
    columns = {name: np.array([ball[name] for ball in balls], dtype=np.float64) for name in _BALL}
    for race in ("outer", "inner"):
        for quantity in _CONTACT:
            # What is not a number crosses as null.
            values = [ball[race][quantity] for ball in balls]
            columns[f"{race}_{quantity}"] = np.array(values, dtype=np.float64)
    return Equilibrium(
        outer=np.array(solution["outer"], dtype=np.float64),
        inner=np.array(solution["inner"], dtype=np.float64),
        row=np.array([ball["row"] for ball in balls], dtype=np.int64),
        ball=np.array([ball["ball"] for ball in balls], dtype=np.int64),
        iterations=solution["iterations"],
        **columns,
    )
