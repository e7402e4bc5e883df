"""Stiffness and damping of a bearing over load and speed, for rotor models."""

from __future__ import annotations

import inspect
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._base.arguments import knows
from ._base.libraries import needed, pl
from ._base.numbers import counted, real, real_row
from ._io.whole import whole
from .errors import BallraceError, SceneError
from .scene import SpeedDrive
from .scene.scene import checked_scene
from .statics import warned

if TYPE_CHECKING:
    import os
    from collections.abc import Iterable, Mapping, Sequence

    from numpy.typing import ArrayLike

    from .scene import Scene

__all__ = ["StiffnessTable", "stiffness_table"]

RossAxis = Literal["speed", "frequency"]
"""Name that a ``BearingElement`` of ROSS has for the speed of the rotor: from 3 on, and before."""

_AXES = ("x", "y", "z", "a", "b")
"""Names of directions in columns: a and b are the tilts about x and y."""
_ROSS = {"xx": (0, 0), "xy": (0, 1), "yx": (1, 0), "yy": (1, 1), "zz": (2, 2)}
"""Coefficients that a ``BearingElement`` of ROSS takes."""
_MEANT = {
    **dict.fromkeys(
        ("speeds", "speed", "rpm", "frequency"), "speeds_rpm, speeds of the inner ring [1/min]"
    ),
    **dict.fromkeys(
        ("radial_load", "axial_load", "load"),
        'loads, forces by the names of the scene\'s loads [N], such as {"radial": [200.0, 500.0], "axial": 100.0}',
    ),
}


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class StiffnessTable:
    """Stiffness and damping of a bearing over its loads and speeds.

    Entry ``[load, speed, i, j]`` is the force [N] or moment [N m] to be added to the inner ring along ``i`` for
    small, slow motion along ``j``, the outer ring being held: ``f = K q + C dq/dt``. The five directions are x
    (right), y (up), z (along the axis) [m] and the tilts about x and y [rad], about the ring's centre of mass. The
    frame is right-handed, as is that of ROSS, whose z also runs along the shaft: no sign changes.

    Attributes
    ----------
    stiffness : ndarray, shape (n_loads, n_speeds, 5, 5)
        K [N/m, N/rad, N m/m, N m/rad]. Slightly unsymmetric, since damping acts in the rotating frame of the
        balls.
    damping : ndarray, shape (n_loads, n_speeds, 5, 5)
        C [N s/m, N s/rad, N m s/m, N m s/rad].
    loads : dict of str to ndarray, shape (n_loads,)
        Forces of the scene's loads in each case [N], by their names.
    speeds : ndarray, shape (n_speeds,)
        Speeds of the inner ring [rad/s].
    name : str
        The scene's name.
    warnings : tuple of str
        Warnings, each subject once, with the numbers of the first case and in how many it is told.
    """

    stiffness: NDArray[np.float64]
    damping: NDArray[np.float64]
    loads: dict[str, NDArray[np.float64]]
    speeds: NDArray[np.float64]
    name: str
    warnings: tuple[str, ...] = ()

    def __repr__(self) -> str:
        cases, speeds = self.stiffness.shape[:2]
        radial = 1e-6 * np.diagonal(self.stiffness, axis1=-2, axis2=-1)[..., :2]
        return (
            f"<StiffnessTable of {self.name!r}: {cases} loads, {speeds} speeds, "
            f"radial {radial.min():.1f} to {radial.max():.1f} N/µm>"
        )

    @property
    def stiffness_6x6(self) -> NDArray[np.float64]:
        """K with the rotation about z, which the bearing leaves free: shape (n_loads, n_speeds, 6, 6)."""
        return _with_rotation(self.stiffness)

    @property
    def damping_6x6(self) -> NDArray[np.float64]:
        """C with the rotation about z, which the bearing leaves free: shape (n_loads, n_speeds, 6, 6)."""
        return _with_rotation(self.damping)

    def ross_arguments(self, load: int = 0, *, axis: RossAxis = "speed") -> dict[str, Any]:
        """Return the arguments of a ``BearingElement`` of ROSS, beside its node.

        ROSS has x, y and z of a bearing, x and y coupled; it does not include tilts and the coupling of z with x
        and y (``stiffness_6x6`` does).

        Parameters
        ----------
        load : int
            The load case, from 0.
        axis : {"speed", "frequency"}
            Name of the argument for the speeds. ROSS 3 calls the rotor's speed ``speed``, and its ``frequency`` is
            that of the whirl, along which these matrices do not change; ROSS 2 has ``frequency`` for the speed.

        Returns
        -------
        dict
            ``kxx``, ``kxy``, …, ``kzz`` [N/m] and ``cxx``, …, ``czz`` [N s/m], each of shape (n_speeds,), and
            the speeds [rad/s] by the name of ``axis``, which have to rise; of a single speed numbers without it.

        Raises
        ------
        SceneError
            There is no such load case or axis, or the speeds do not rise.
        """
        if axis not in get_args(RossAxis):
            raise SceneError("axis", repr(axis), " or ".join(map(repr, get_args(RossAxis))))
        load = counted("load", load, 0, len(self.stiffness) - 1)
        if np.any(np.diff(self.speeds) <= 0.0):
            raise SceneError("speeds_rpm", f"{self.speeds.size} speeds", "rising, for ROSS")
        found: dict[str, Any] = {}
        for letter, matrices in (("k", self.stiffness[load]), ("c", self.damping[load])):
            found |= {f"{letter}{name}": matrices[:, i, j] for name, (i, j) in _ROSS.items()}
        if self.speeds.size == 1:
            return {name: float(values[0]) for name, values in found.items()}
        return {**found, axis: self.speeds}

    def to_ross(self, n: int, *, load: int = 0, **more: Any) -> Any:
        """Return a ``BearingElement`` of ROSS (package ross-rotordynamics, 2.3 or 3).

        Parameters
        ----------
        n : int
            Node of the shaft.
        load : int
            The load case, from 0.
        **more
            Further arguments of the element, such as ``n_link``, the node of its housing, or ``tag``.

        Raises
        ------
        ImportError
            ROSS is not installed: ``pip install ross-rotordynamics``.
        SceneError
            As :meth:`ross_arguments`.
        """
        ross = needed("ross", "a bearing element of ROSS", extra=None, package="ross-rotordynamics")
        # By what it takes: since 3.0 an array along `frequency` is interpolated along that of the whirl.
        taken = inspect.signature(ross.BearingElement).parameters
        arguments = self.ross_arguments(load, axis="speed" if "speed" in taken else "frequency")
        return ross.BearingElement(n=n, **arguments, **more)

    def to_polars(self) -> pl.DataFrame:
        """Return a table with a line per load and speed.

        Columns are the loads by their names [N], ``speed`` [rad/s], and ``kxx``, ``kxy``, …, ``cbb`` in SI units,
        with ``a`` and ``b`` for the tilts about x and y.
        """
        cases, speeds = self.stiffness.shape[:2]
        columns = {name: np.repeat(values, speeds) for name, values in self.loads.items()}
        columns["speed"] = np.tile(self.speeds, cases)
        for letter, matrices in (("k", self.stiffness), ("c", self.damping)):
            for i, row in enumerate(_AXES):
                for j, column in enumerate(_AXES):
                    columns[f"{letter}{row}{column}"] = matrices[..., i, j].ravel()
        return pl.DataFrame(columns)

    def write(self, path: str | os.PathLike[str]) -> None:
        """Write the table of :meth:`to_polars` as text with commas, all digits.

        Raises
        ------
        OSError
            The file cannot be written.
        """
        with whole(path) as temporary:
            self.to_polars().write_csv(temporary)


@knows(_MEANT)
def stiffness_table(
    bearing: Scene,
    loads: Mapping[str, ArrayLike] | None = None,
    speeds_rpm: ArrayLike | None = None,
    *,
    positions: int = 4,
) -> StiffnessTable:
    """Compute the stiffness and damping of a bearing over its loads and speeds, for a model of a rotor.

    At each load and speed the forces of a run's contacts, with their damping, films and friction, are linearised
    about the steady motion in which a run begins. The balls follow the ring: along their radius and the axis in
    equilibrium with their contacts; along the orbit and in their rotation so that friction does not change. This
    is valid for motion that is slow compared with vibration of the balls on their contacts, below some kHz, and
    whose C dq/dt is small compared with K q. The variation as balls pass is averaged. Supports of rings, the cage
    and defects are not included.

    Parameters
    ----------
    bearing : Scene
        The scene.
    loads : mapping of str to array_like, optional
        Forces of the scene's loads [N], by their names: arrays of one length, or numbers for all cases. By default
        those of the scene, as one case.
    speeds_rpm : array_like, optional
        Speeds of the inner ring [1/min]; by default that of the scene.
    positions : int
        Positions of the cage per ball pitch that are averaged.

    Returns
    -------
    StiffnessTable
        Matrices of the inner ring.

    Raises
    ------
    SceneError
        An argument or a field of the scene is not usable.
    EquilibriumError
        There is no stable equilibrium in some case; a note of the error names the case.

    Warns
    -----
    SceneWarning
        As for :func:`ballrace.equilibrium`.

    Examples
    --------
    >>> import ballrace as br
    >>> bearing = br.presets.deep_groove_6205(500.0, 200.0)
    >>> table = br.stiffness_table(bearing, {"axial": [100.0, 400.0]}, speeds_rpm=[0.0, 3000.0])
    >>> table.stiffness.shape
    (2, 2, 5, 5)
    >>> axial = table.stiffness[:, 1, 2, 2]
    >>> bool(axial[1] > axial[0])
    True
    """
    scene = checked_scene(bearing)
    positions = counted("positions", positions, 1)
    cases = _cases(scene, loads)
    speeds = None if speeds_rpm is None else _speeds(speeds_rpm)
    found: list[Mapping[str, Any]] = []
    shape = (len(next(iter(cases.values()), [0.0])), 1 if speeds is None else speeds.size)
    for case in range(shape[0]):
        changes: dict[str, Any] = {
            f"loads.{name}.force": float(of[case]) for name, of in cases.items()
        }
        for k in range(shape[1]):
            if speeds is not None:
                changes["drive"] = SpeedDrive(float(speeds[k]))
            rpm = None if speeds is None else float(speeds[k]) * 30.0 / math.pi
            found.append(_coefficients(scene, changes, positions, _note(cases, case, rpm)))
    texts = _once([one["equilibrium"]["warnings"] for one in found])
    return StiffnessTable(
        stiffness=np.stack([one["stiffness"] for one in found]).reshape(*shape, 5, 5),
        damping=np.stack([one["damping"] for one in found]).reshape(*shape, 5, 5),
        loads=cases,
        speeds=np.array([_own_speed(scene)]) if speeds is None else speeds,
        name=scene.name,
        warnings=warned(texts, stacklevel=4),
    )


def _once(found: Sequence[Iterable[str]]) -> list[str]:
    """Return what equilibria warn of: each subject once, with the numbers of the first, and in how many."""
    of: dict[str, list[str]] = {}
    for texts in found:
        for text in texts:
            of.setdefault(text.partition(" = ")[0], []).append(text)
    several = "" if len(found) == 1 else f"; in {{}} of {len(found)} equilibria of the table"
    return [texts[0] + several.format(len(texts)) for texts in of.values()]


def _coefficients(
    scene: Scene, changes: Mapping[str, Any], positions: int, note: str
) -> Mapping[str, Any]:
    """Return the matrices of one load and speed; an error has a note of which."""
    try:
        return _core.dynamic_coefficients(scene.replace(changes)._document(), positions)
    except BallraceError as error:
        error.add_note(note)
        raise


def _note(cases: Mapping[str, NDArray[np.float64]], case: int, rpm: float | None) -> str:
    """Say in words which load and speed it is."""
    loads = ", ".join(f"{name} = {of[case]:g} N" for name, of in cases.items())
    speed = "" if rpm is None else f", at {rpm:g} 1/min"
    return f"in load case {case}: {loads}{speed}"


def _cases(scene: Scene, loads: Mapping[str, ArrayLike] | None) -> dict[str, NDArray[np.float64]]:
    """Return the forces of all loads that are given, a number for each case."""
    if loads is None:
        constant = {name: load.force for name, load in scene.loads.items()}
        numbers = {name: real(force) for name, force in constant.items()}
        return {name: np.array([force]) for name, force in numbers.items() if math.isfinite(force)}
    known = ", ".join(map(repr, scene.loads)) or "none, and the scene has none"
    if not hasattr(loads, "items"):
        allowed = f"a mapping of forces [N] by the names of the scene's loads: {known}"
        raise SceneError("loads", f"a {type(loads).__name__}", allowed)
    given = {}
    for name, forces in loads.items():
        if name not in scene.loads:
            raise SceneError("loads", repr(name), f"names of the scene's loads: {known}")
        given[name] = np.atleast_1d(_finite(f"loads[{name!r}]", forces))
    try:
        shared = np.broadcast_arrays(*given.values()) if given else ()
    except ValueError:
        lengths = ", ".join(f"{name}: {of.size}" for name, of in given.items())
        raise SceneError("loads", lengths, "arrays of one length, or numbers") from None
    return {name: of.copy() for name, of in zip(given, shared, strict=True)}


def _speeds(speeds_rpm: ArrayLike) -> NDArray[np.float64]:
    """Return speeds [rad/s]."""
    return np.atleast_1d(_finite("speeds_rpm", speeds_rpm)) * (math.pi / 30.0)


def _finite(name: str, given: ArrayLike) -> NDArray[np.float64]:
    """Return a number or a row of numbers."""
    row = real_row(name, given)
    if row.ndim > 1 or row.size == 0 or not np.all(np.isfinite(row)):
        raise SceneError(
            name, f"an array of shape {row.shape}", "one finite number or a row of them"
        )
    return row


def _own_speed(scene: Scene) -> float:
    """Return the speed at which a scene begins [rad/s]."""
    drive = scene.drive
    if isinstance(drive, SpeedDrive):
        if math.isfinite(speed := real(drive.speed)):
            return speed
        raise SceneError(
            "speeds_rpm", "absent", "speeds [1/min], since the scene's own speed changes in time"
        )
    return drive.initial_speed


def _with_rotation(matrices: NDArray[np.float64]) -> NDArray[np.float64]:
    wider = np.zeros((*matrices.shape[:-2], 6, 6))
    wider[..., :5, :5] = matrices
    return wider
