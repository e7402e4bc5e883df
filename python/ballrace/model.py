"""The equations of a scene, for other integrators."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from . import _core
from .errors import SceneError
from .explanation import Explanation, explain
from .scene.scene import checked_scene

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from .scene import Scene

__all__ = ["Model"]


class Model:
    """A compiled scene, which does not change, so threads may share it.

    Parameters
    ----------
    scene : Scene
        The scene; checked here.

    Raises
    ------
    SceneError
        A field of the scene is not usable.

    Examples
    --------
    Any integrator may use the right-hand side, here one of SciPy's::

        y0 = model.start("equilibrium")
        scipy.integrate.solve_ivp(model.rhs, (0.0, 1e-3), y0, max_step=2e-6)
    """

    def __init__(self, scene: Scene) -> None:
        self._core = _core.Model(checked_scene(scene).to_json())
        self._scene = scene
        self._names = tuple(self._core.names)
        self._bodies = tuple(self._core.bodies)

    def __repr__(self) -> str:
        return f"<Model of {self._scene.name!r}: {len(self._bodies)} bodies, {len(self._names)} states>"

    def __reduce__(self) -> tuple[type[Model], tuple[Scene]]:
        return Model, (self._scene,)

    @property
    def scene(self) -> Scene:
        """The scene."""
        return self._scene

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the states in their order, such as ``outer.x`` or ``row0.ball3.vz``."""
        return self._names

    @property
    def bodies(self) -> tuple[str, ...]:
        """Names of the bodies in their order: the outer ring, the inner ring, then the balls row by row."""
        return self._bodies

    def summary(self) -> Explanation:
        """Report what a run integrates and leaves out, what it costs, and what would make it cheaper.

        Returns
        -------
        Explanation
            As of :func:`ballrace.explain`.

        Raises
        ------
        EquilibriumError
            There is no stable equilibrium to start from.
        """
        return explain(self._scene)

    def start(self, kind: Literal["equilibrium", "rolling"] = "equilibrium") -> NDArray[np.float64]:
        """Return the state at which a run starts.

        Parameters
        ----------
        kind : {"equilibrium", "rolling"}
            The static equilibrium in the cage's frame, or the nominal places of pure rolling.

        Returns
        -------
        ndarray, shape (n_states,)
            State in SI units, in the order of :attr:`names`.

        Raises
        ------
        EquilibriumError
            There is no stable equilibrium.
        SceneError
            ``kind`` is not known.
        """
        return self._core.start(kind)

    def rhs(self, t: float, y: ArrayLike) -> NDArray[np.float64]:
        """Return the time derivative of a state.

        Parameters
        ----------
        t : float
            Time [s].
        y : array_like, shape (n_states,)
            State.

        Returns
        -------
        ndarray, shape (n_states,)
            Derivatives, in the order of :attr:`names`.

        Raises
        ------
        SceneError
            The shape is wrong (a ``ValueError``).
        """
        return self._core.rhs(t, self._state(y))

    def forces(self, t: float, y: ArrayLike) -> dict[str, NDArray[np.float64]]:
        """Return the forces on every body by origin.

        Parameters
        ----------
        t : float
            Time [s].
        y : array_like, shape (n_states,)
            State.

        Returns
        -------
        dict of str to ndarray, shape (n_bodies, 4)
            Forces along x, y, z [N] and torque about z [N m], in the order of :attr:`bodies`. Their sum is
            what moves the bodies.

        Raises
        ------
        SceneError
            The shape is wrong (a ``ValueError``).
        """
        return self._core.forces(t, self._state(y))

    def _state(self, y: ArrayLike) -> NDArray[np.float64]:
        state = np.asarray(y, dtype=np.float64)
        wanted = (len(self._names),)
        if state.shape != wanted:
            raise SceneError(
                "y",
                f"an array of shape {state.shape}",
                f"an array of shape {wanted}, one number per state",
            )
        return state
