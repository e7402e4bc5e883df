"""Reactions: what each row of a scene carries."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..statics import Equilibrium, equilibrium

if TYPE_CHECKING:
    from ..scene import Scene


@dataclass(frozen=True, kw_only=True, eq=False)
class Reaction:
    """Force and moment of a row on the inner ring, or the shaft.

    Attributes
    ----------
    row : int
        The row, from 0.
    at : float
        Its axial place [m].
    force : ndarray, shape (3,)
        Force along x, y, z [N].
    moment : ndarray, shape (3,)
        Moment about the row's place on the shaft's axis [N m], by which a row resists tilting of the shaft.
    largest_load : float
        Load of the most loaded ball [N].
    """

    row: int
    at: float
    force: NDArray[np.float64]
    moment: NDArray[np.float64]
    largest_load: float


def reactions(scene: Scene) -> tuple[Reaction, ...]:
    """Solve the equilibrium of a scene, and return what each row carries, in order; a bearing may have two rows.

    Parameters
    ----------
    scene : Scene
        The scene, as of :func:`ballrace.shaft`.

    Raises
    ------
    SceneError, EquilibriumError
        As of :func:`ballrace.equilibrium`.

    Examples
    --------
    >>> import ballrace as br
    >>> pull = br.machines.force(y=-900.0, at=0.05)
    >>> made = br.shaft([("6205", 0.0), ("6205", 0.1)], speed_rpm=1500.0, loads={"pull": pull})
    >>> [round(each.force[1]) for each in br.machines.reactions(made.replace({"gravity": [0.0, 0.0, 0.0]}))]
    [450, 450]
    """
    found = equilibrium(scene)
    return tuple(_of_row(scene, found, row) for row in range(len(scene.rows)))


def _of_row(scene: Scene, found: Equilibrium, row: int) -> Reaction:
    of = found.row == row
    turned = _rotation(np.array([*found.inner_tilt, 0.0]))
    z = np.array([0.0, 0.0, 1.0])
    # The displacement is that of the centre of mass, about which the shaft tilts.
    middle = (scene.inner_ring.centre_of_mass or 0.0) * z
    places = found.radius[of, None] * _outward(found.angle[of]) + found.z[of, None] * z
    own = (places - middle - found.inner) @ turned
    angle, load = np.nan_to_num(found.inner_angle[of]), found.inner_load[of]
    pushed = np.cos(angle)[:, None] * _outward(np.arctan2(own[:, 1], own[:, 0]))
    # Angles count towards the side that the row takes thrust to.
    pushed += scene.rows[row].side * np.sin(angle)[:, None] * z
    forces = -load[:, None] * pushed @ turned.T
    at = scene.rows[row].axial_position
    about = middle + found.inner + turned @ (at * z - middle)
    return Reaction(
        row=row,
        at=at,
        force=forces.sum(axis=0),
        moment=np.cross(places - about, forces).sum(axis=0),
        largest_load=float(load.max()),
    )


def _outward(angle: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=1)


def _rotation(vector: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the matrix of a rotation vector, Rodrigues' formula."""
    size = float(np.linalg.norm(vector))
    x, y, z = vector / size if size > 0.0 else vector
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    turned: NDArray[np.float64] = (
        np.eye(3) + np.sin(size) * cross + (1.0 - np.cos(size)) * cross @ cross
    )
    return turned
