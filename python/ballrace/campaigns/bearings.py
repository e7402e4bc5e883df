"""Virtual bearings: one design with the deviations of its manufacturing tolerances."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from .._base.libraries import pl
from .._base.numbers import counted, real
from ..errors import SceneError
from .designs import counted_cases

if TYPE_CHECKING:
    from ..scene import Scene

_LIMIT = 3.0
"""Parts further than this many standard deviations from the drawing have been sorted out."""


def scatter(
    scene: Scene,
    n: int,
    *,
    seed: int,
    ball_diameter: float = 0.0,
    clearance: float = 0.0,
    groove_radius: float = 0.0,
    start_phase: bool = True,
    texture_seed: bool = False,
) -> pl.DataFrame:
    """Return a table of ``n`` bearings with random deviations, as from manufacturing.

    Every row of balls of every bearing has its own numbers: normally distributed about the nominal ones, cut off
    at three standard deviations. The column ``bearing_id`` is the bearing of a case: split data for learning by
    it, not by case, or models are tested on bearings that they were trained on.

    Cross the table with loads and defects by ``table.join(br.grid(...), how="cross")``.

    Parameters
    ----------
    scene : Scene
        The nominal bearing.
    n : int
        Number of bearings, at most ten million.
    seed : int
        The same seed gives the same bearings.
    ball_diameter : float
        Standard deviation of each ball's diameter within its row [m].
    clearance : float
        Standard deviation of the diametral clearance [m].
    groove_radius : float
        Standard deviation of the radius of either groove [m].
    start_phase : bool
        Whether the cage starts at any angle, evenly distributed over one pitch of the balls.
    texture_seed : bool
        Whether every bearing has surfaces of its own; needs a texture in each row of the scene.

    Raises
    ------
    SceneError
        An argument is not usable.

    Examples
    --------
    >>> import ballrace as br
    >>> made = br.scatter(br.presets.deep_groove_6205(), 1000, seed=7, ball_diameter=0.2e-6, clearance=2e-6)
    >>> made.columns
    ['bearing_id', 'rows[0].diameter_errors', 'rows[0].clearance', 'rows[0].start_angle']
    >>> cases = made.join(br.grid({"loads.axial.force": [0.0, 500.0]}), how="cross")
    >>> cases.height, cases["bearing_id"].n_unique()
    (2000, 1000)
    """
    n, seed = counted_cases(n), counted("seed", seed, 0)
    deviations = {
        "ball_diameter": ball_diameter, "clearance": clearance, "groove_radius": groove_radius,
    }  # fmt: skip
    for name, value in deviations.items():
        if not 0.0 <= real(value) < 1.0:
            raise SceneError(name, repr(value), "a standard deviation, from 0 to below 1 m")
    if texture_seed and any(row.texture is None for row in scene.rows):
        raise SceneError("texture_seed", "True", "False, or a scene whose rows have a texture")
    rng = np.random.default_rng(seed)
    columns: dict[str, object] = {"bearing_id": range(n)}
    for i, row in enumerate(scene.rows):
        path = f"rows[{i}]"
        if ball_diameter > 0.0:
            errors = ball_diameter * _normal(rng, (n, row.ball_count))
            if row.diameter_errors:
                errors = errors + np.array(row.diameter_errors)
            columns[f"{path}.diameter_errors"] = errors.tolist()
        if clearance > 0.0:
            columns[f"{path}.clearance"] = row.clearance + clearance * _normal(rng, (n,))
        if groove_radius > 0.0:
            share = groove_radius / row.ball_diameter
            columns[f"{path}.outer_conformity"] = row.outer_conformity + share * _normal(rng, (n,))
            columns[f"{path}.inner_conformity"] = row.inner_conformity + share * _normal(rng, (n,))
        if start_phase:
            pitch = 2.0 * math.pi / row.ball_count
            columns[f"{path}.start_angle"] = row.start_angle + pitch * rng.random(n)
        if texture_seed:
            columns[f"{path}.texture.seed"] = rng.integers(0, 2**53, n)
    return pl.DataFrame(columns)


def _normal(rng: np.random.Generator, shape: tuple[int, ...]) -> np.ndarray:
    """Draw standard normal numbers, again where they fall beyond the limit."""
    drawn = rng.standard_normal(shape)
    while (beyond := np.abs(drawn) > _LIMIT).any():
        drawn[beyond] = rng.standard_normal(int(beyond.sum()))
    return drawn
