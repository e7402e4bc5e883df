"""The static solution of a scene: loads, stiffness, and loads over a turn of the cage."""

from __future__ import annotations

import json
import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._base.html import paragraph, points, table
from ._base.libraries import pl
from ._base.numbers import counted
from .errors import SceneError, SceneWarning
from .ring_force import passed
from .scene.scene import checked_scene

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from .ring_force import RingForce
    from .scene import Scene

__all__ = [
    "Equilibrium",
    "LoadDistribution",
    "RaceFilm",
    "Stiffness",
    "equilibrium",
    "load_distribution",
    "stiffness",
]

_BALL = ("angle", "radius", "z")
_CONTACT = ("load", "angle", "deflection", "zone_centre", "pressure")


@dataclass(frozen=True, kw_only=True)
class RaceFilm:
    """The oil film between a row's balls and one race, at its reference load and speed.

    A film is made for one load and follows the speed of the rings; with a steady drive it is that of a whole run.

    Attributes
    ----------
    row : int
        Row, from 0.
    race : {"outer", "inner"}
        The race.
    film : float
        Thickness in the middle of a contact [m].
    minimum_film : float
        Least thickness, 0.8 of it [m].
    lambda_ratio : float
        λ: the film over the roughness of both surfaces.
    friction : float
        Friction coefficient at large slip.
    slip_scale : float
        Slip over which friction rises to that [m/s].
    reference_load : float
        Load of a contact [N]: the lubricant's, or that of the equilibrium without films.
    reference_speed : float
        Speed of the rings against each other [rad/s]: the lubricant's, or the largest of the drive.
    ellipticity : float
        Length of the contact's ellipse over its width.
    moes : float
        Moes' parameter L.
    pressure : float
        Largest Hertz pressure under the reference load [Pa].
    """

    row: int
    race: Literal["outer", "inner"]
    film: float
    minimum_film: float
    lambda_ratio: float
    friction: float
    slip_scale: float
    reference_load: float
    reference_speed: float
    ellipticity: float
    moes: float
    pressure: float


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Equilibrium:
    """Static equilibrium in the cage's frame; arrays have one entry per ball, row by row.

    Attributes
    ----------
    outer, inner : ndarray, shape (3,)
        Displacements of the rings [m].
    outer_tilt, inner_tilt : ndarray, shape (2,)
        Tilts of the rings about x and y [rad].
    outer_moment, inner_moment : ndarray, shape (2,)
        Moments about x and y that the balls put on the rings, each about its own centre [N m]; the support that
        keeps a ring from tilting carries them.
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
    outer_pressure, inner_pressure : ndarray, shape (n_balls,)
        Largest Hertz pressures, at the centres of the contacts, whatever the law [Pa]; 0 without load. Of the
        smooth race where a ball lies in a defect. The static load rating of ball bearings (ISO 76) stands for
        4.2 GPa.
    films : tuple of RaceFilm
        The films of rows with an oil, race by race; empty without.
    iterations : int
        Iterations of the solver.
    warnings : tuple of str
        Texts of the warnings.
    residual : float
        Largest unbalanced force on a body: on a ring along its free directions, on a ball along its radius and z
        [N].
    residual_share : float
        The same over the largest load, of a contact or on a ring; at most 1e-4, or there is no equilibrium.
    """

    outer: NDArray[np.float64]
    inner: NDArray[np.float64]
    outer_tilt: NDArray[np.float64]
    inner_tilt: NDArray[np.float64]
    outer_moment: NDArray[np.float64]
    inner_moment: NDArray[np.float64]
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
    outer_pressure: NDArray[np.float64]
    inner_pressure: NDArray[np.float64]
    iterations: int
    residual: float
    residual_share: float
    films: tuple[RaceFilm, ...] = ()
    warnings: tuple[str, ...] = ()

    @property
    def loaded(self) -> NDArray[np.bool_]:
        """Balls that count as loaded, shape (n_balls,): above a tenth of the largest load on the inner race.

        At speed every ball is thrown against the outer race, which does not count.
        """
        rule: NDArray[np.bool_] = self.inner_load > max(0.1 * float(self.inner_load.max()), 0.0)
        return rule

    def __repr__(self) -> str:
        loaded = int(np.count_nonzero(self.loaded))
        return (
            f"<Equilibrium: {loaded} of {self.ball.size} balls loaded, "
            f"largest load {self.outer_load.max():.1f} N, after {self.iterations} iterations>"
        )

    def _repr_html_(self) -> str:
        """Return displacements, warnings and the balls, as notebooks show it."""
        moved = ", ".join(f"{1e6 * each:.2f}" for each in self.inner - self.outer)
        summary = paragraph(
            repr(self).strip("<>"), f"Inner against outer ring: {moved} µm along x, y, z."
        )
        names = ("row", "ball", "at / °", "load / N", "contact angle / °", "largest pressure / GPa")
        at, angle = np.degrees(self.angle), np.degrees(self.outer_angle)
        rows = [
            (str(self.row[k]), str(self.ball[k]), f"{at[k]:.1f}", f"{self.outer_load[k]:.1f}", f"{angle[k]:.2f}",
             f"{1e-9 * max(self.outer_pressure[k], self.inner_pressure[k]):.3f}")
            for k in range(self.ball.size)
        ]  # fmt: skip
        return summary + points(self.warnings) + table(names, rows)

    def to_polars(self) -> pl.DataFrame:
        """Return a table with a line per ball and the columns ``row``, ``ball``, ``angle``, …."""
        names = ["row", "ball", *_BALL]
        names += [f"{race}_{quantity}" for race in ("outer", "inner") for quantity in _CONTACT]
        return pl.DataFrame({name: getattr(self, name) for name in names})


RaceControl = Literal["friction", "outer"]
"""Control of the axis about which a ball spins that spins freely."""


def equilibrium(
    scene: Scene,
    *,
    race_control: RaceControl = "friction",
    forces: Mapping[str, RingForce] | None = None,
) -> Equilibrium:
    """Solve a scene at rest in the cage's frame, with all loads, gravity and centrifugal forces.

    Centrifugal forces are those of the orbit speed at the contact angles found; friction carries the gyroscopic
    moments of balls that spin freely (``spin="free"``).

    Parameters
    ----------
    scene : Scene
        The scene.
    race_control : {"friction", "outer"}
        What determines the spin axis of a ball that spins freely: friction at both races, as in a run, or the
        outer race, on which it then does not pivot (Jones' hypothesis, for fast bearings under light loads).
    forces : mapping of str to RingForce, optional
        Forces on the rings by functions, as of :func:`ballrace.simulate`.

    Returns
    -------
    Equilibrium
        Displacements, loads, contact angles and deflections.

    Raises
    ------
    SceneError
        A field of the scene is not usable.
    EquilibriumError
        There is no stable equilibrium: the load cannot be carried, or more than 1e-4 of the largest
        load stays unbalanced on a body.

    Warns
    -----
    SceneWarning
        A number of the scene is one that no bearing is likely to have, or a contact's pressure exceeds the static
        rating.
    """
    document = checked_scene(scene)._document()
    return _equilibrium(_core.equilibrium(document, race_control, passed(forces)))


def _equilibrium(result: Mapping[str, Any]) -> Equilibrium:
    """Return the equilibrium of the core's result; warn the caller of a public function."""
    films = tuple(RaceFilm(**film) for film in json.loads(result["films"]))
    texts = warned(result["warnings"], stacklevel=4)
    return Equilibrium(**{**result, "films": films, "warnings": texts})


def warned(texts: Iterable[str], *, stacklevel: int) -> tuple[str, ...]:
    """Give the core's warnings to the caller of a public function, and return their texts."""
    texts = tuple(texts)
    for text in texts:
        warnings.warn(text, SceneWarning, stacklevel=stacklevel)
    return texts


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Stiffness:
    """Tangent stiffness at the static equilibrium, in the scene's frame: x right, y up, z along the axis.

    Entry ``[i, j]`` is the force [N] to be added along ``i`` per metre along ``j``, for small displacements:
    positive on the diagonal. The balls follow the rings, each free along its radius and along z at the angle where
    the cage holds it. Supports of rings and a structure below them, gravity, damping and friction are
    not included. The matrices are symmetric.

    Attributes
    ----------
    inner : ndarray, shape (3, 3)
        Inner ring against a held outer ring: forces and displacements of the inner ring along x, y, z [N/m].
    rings : ndarray, shape (6, 6)
        Both rings: x, y, z of the outer, then x, y, z of the inner ring [N/m].
    inner_spatial : ndarray, shape (5, 5)
        Inner ring with its tilts: forces along x, y, z [N] and moments about x and y, about the ring's centre of
        mass [N m], by displacements along x, y, z [m] and tilts about x and y [rad], in this order.
    rings_spatial : ndarray, shape (10, 10)
        The same of both rings: the five of the outer, then those of the inner ring.
    equilibrium : Equilibrium
        The equilibrium at which they are taken.
    """

    inner: NDArray[np.float64]
    rings: NDArray[np.float64]
    inner_spatial: NDArray[np.float64]
    rings_spatial: NDArray[np.float64]
    equilibrium: Equilibrium

    @property
    def axial(self) -> float:
        """Stiffness along z with x and y held [N/m]."""
        return float(self.inner[2, 2])

    @property
    def radial(self) -> NDArray[np.float64]:
        """Softest and stiffest radial direction with z held, shape (2,) [N/m]."""
        return np.asarray(np.linalg.eigvalsh(self.inner[:2, :2]), dtype=np.float64)

    def __repr__(self) -> str:
        low, high = 1e-6 * self.radial
        return (
            f"<Stiffness: radial {low:.1f} to {high:.1f} N/µm, axial {1e-6 * self.axial:.1f} N/µm>"
        )


def stiffness(scene: Scene) -> Stiffness:
    """Return the tangent stiffness of a bearing at its static equilibrium.

    Parameters
    ----------
    scene : Scene
        The scene.

    Returns
    -------
    Stiffness
        Matrices of the inner ring and of both rings, and the equilibrium.

    Raises
    ------
    SceneError
        A field of the scene is not usable.
    EquilibriumError
        There is no stable equilibrium: the load cannot be carried.

    Warns
    -----
    SceneWarning
        As for :func:`equilibrium`.

    Examples
    --------
    >>> import ballrace as br
    >>> loaded = br.stiffness(br.presets.deep_groove_6205(500.0, 200.0))
    >>> loaded.inner.shape, bool(loaded.radial[1] > loaded.axial)
    ((3, 3), True)
    """
    found = _core.stiffness(checked_scene(scene)._document())
    return Stiffness(
        inner=found["inner"],
        rings=found["rings"],
        inner_spatial=found["inner_spatial"],
        rings_spatial=found["rings_spatial"],
        equilibrium=_equilibrium(found["equilibrium"]),
    )


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class LoadDistribution:
    """Static loads while the cage turns past rings that stand at angle 0.

    Attributes
    ----------
    turn : ndarray, shape (n_positions,)
        How far the cage has turned from the scene's start angles [rad].
    row, ball : ndarray of int, shape (n_balls,)
        Row, and place of the ball in it, both from 0.
    angle : ndarray, shape (n_positions, n_balls)
        Where each ball stands [rad].
    outer_load, inner_load : ndarray, shape (n_positions, n_balls)
        Normal forces on the races [N].
    outer_angle, inner_angle : ndarray, shape (n_positions, n_balls)
        Operating contact angles [rad]; not a number without load.
    outer_tilt, inner_tilt : ndarray, shape (n_positions, 2)
        Tilts of the rings about x and y [rad].
    outer_moment, inner_moment : ndarray, shape (n_positions, 2)
        Moments about x and y that balls and loads put on the rings [N m].
    outer_equivalent, inner_equivalent : ndarray, shape (n_rows,)
        Equivalent loads of the races [N]: the load that, constant on every ball, gives the race the same fatigue
        life, after ISO/TS 16281. For a ring that turns relative to the load (mean of Q³)^(1/3), for one that
        stands (mean of Q^(10/3))^(3/10); the outer ring turns with an ``outer_speed``.
    warnings : tuple of str
        Texts of the warnings.
    """

    turn: NDArray[np.float64]
    outer_tilt: NDArray[np.float64]
    inner_tilt: NDArray[np.float64]
    outer_moment: NDArray[np.float64]
    inner_moment: NDArray[np.float64]
    row: NDArray[np.int64]
    ball: NDArray[np.int64]
    angle: NDArray[np.float64]
    outer_load: NDArray[np.float64]
    inner_load: NDArray[np.float64]
    outer_angle: NDArray[np.float64]
    inner_angle: NDArray[np.float64]
    outer_equivalent: NDArray[np.float64]
    inner_equivalent: NDArray[np.float64]
    warnings: tuple[str, ...] = ()

    def __repr__(self) -> str:
        equivalents = zip(self.outer_equivalent, self.inner_equivalent, strict=True)
        rows = "; ".join(
            f"outer {outer:.1f} N, inner {inner:.1f} N" for outer, inner in equivalents
        )
        return f"<LoadDistribution: {self.turn.size} positions, equivalent loads {rows}>"

    def around(
        self, row: int = 0, race: Literal["outer", "inner"] = "inner"
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return angles in (-π, π], in order [rad], and the loads of a row's balls on a race there [N].

        Both have shape (n_positions * balls of the row,).
        """
        if race not in ("outer", "inner"):
            raise SceneError("race", repr(race), '"outer" or "inner"')
        chosen = self.row == counted("row", row, 0, int(self.row.max()))
        angle = self.angle[:, chosen].ravel()
        order = np.argsort(angle, kind="stable")
        load: NDArray[np.float64] = getattr(self, f"{race}_load")[:, chosen].ravel()
        return angle[order], load[order]


def load_distribution(scene: Scene, *, positions: int = 16) -> LoadDistribution:
    """Solve a scene at rest at many positions of its cage; return ball loads and equivalent loads for life.

    Defects are left out, since a ball in a spall at one of these positions would count as if it were always there;
    :func:`equilibrium` includes them. Where all balls are alike, the cage turns by one ball pitch, which places a
    ball at every angle. Where they differ (diameters, rows of different numbers of balls) it makes a whole turn.

    Parameters
    ----------
    scene : Scene
        The scene.
    positions : int
        Positions of the cage per ball pitch.

    Returns
    -------
    LoadDistribution
        Loads of all balls at all positions, and equivalent loads of the races.

    Raises
    ------
    SceneError
        A field of the scene or ``positions`` is not usable.
    EquilibriumError
        There is no stable equilibrium at some position.

    Warns
    -----
    SceneWarning
        As for :func:`equilibrium`.

    Examples
    --------
    >>> import ballrace as br
    >>> loads = br.load_distribution(br.presets.deep_groove_6205(500.0), positions=4)
    >>> loads.inner_load.shape
    (4, 9)
    >>> psi, load = loads.around(race="outer")
    """
    document = checked_scene(scene)._document()
    found: Mapping[str, Any] = _core.load_distribution(document, counted("positions", positions, 1))
    return LoadDistribution(**{**found, "warnings": warned(found["warnings"], stacklevel=3)})
