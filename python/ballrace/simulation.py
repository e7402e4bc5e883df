"""Runs in pieces, between which they can be inspected and changed."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Literal

import numpy as np

from . import _core
from ._base.document import encode
from ._base.numbers import finite, positive, real, real_row
from ._results.snapshot import Snapshot, joined
from .errors import SceneError
from .ring_force import passed, warnings_of
from .run import request, shown, warn
from .scene.scene import Scene, checked_path, checked_scene
from .signals import Signals

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Mapping, Sequence

    from numpy.typing import NDArray

    from ._results.snapshot import Piece
    from .ring_force import RingForce
    from .scene import Method

__all__ = ["Simulation", "Snapshot"]

_OPEN = 1e6
"""The longest duration of a run, that of one without an end of its own [s]."""


class Simulation:
    """A run in pieces.

    Its record is that of :func:`ballrace.simulate`, bit by bit, whatever the pieces: the end of a piece does not
    shorten a step of the integrator; states there are interpolated within the step. Ended by :meth:`finish` before
    its duration, all but its last 14 samples are, which differ by less than the integration error. Between pieces
    its state, contacts and forces can be read, and loads, speeds, clearances and defects changed.

    Parameters
    ----------
    scene : Scene
        What to run.
    duration : float, optional
        Time at which the run ends by itself [s]; by default it ends with :meth:`finish`, before 1e6 s.
    keep : bool
        Whether the record stays in memory for :meth:`finish`.
    fs, start, rtol, accuracy, method, reduce, threads, progress, bandwidth, settle, max_steps
        As of :func:`ballrace.simulate`. `progress` is of the beginning, until the start has settled.
    time_limit : float, optional
        Wall time that the beginning and each call may take [s]. A run that it stops may go on.
    forces : mapping of str to RingForce, optional
        As of :func:`ballrace.simulate`. An exception of a function is raised by the call and every later one; such
        a run has no snapshots.

    Raises
    ------
    SceneError, EquilibriumError, IntegrationError, BudgetError, MemoryLimitError
        As of :func:`ballrace.simulate`, from before its first step.

    Examples
    --------
    Raise the load until a contact carries 400 N:

    >>> import ballrace as br
    >>> scene = br.presets.deep_groove_6205(radial_load=500.0)
    >>> simulation = br.Simulation(scene)
    >>> force = 500.0
    >>> while simulation.contacts["load"].max() < 400.0:
    ...     force += 100.0
    ...     simulation.change({"loads.radial.force": force})
    ...     piece = simulation.advance(0.002)
    >>> out = simulation.finish()
    >>> out.provenance.duration == simulation.time
    True
    """

    def __init__(
        self,
        scene: Scene,
        *,
        duration: float | None = None,
        keep: bool = True,
        fs: float = 50_000.0,
        start: Literal["equilibrium", "rolling"] | NDArray[np.float64] | Signals = "equilibrium",
        rtol: float | None = None,
        accuracy: float | None = None,
        method: Method | None = None,
        reduce: bool | None = None,
        threads: int = 0,
        progress: bool | Callable[[float], object] | None = None,
        bandwidth: Literal["auto"] | None = "auto",
        settle: float | None = None,
        time_limit: float | None = None,
        max_steps: int | None = None,
        forces: Mapping[str, RingForce] | None = None,
    ) -> None:
        code = passed(forces)
        document, asked, state = request(
            checked_scene(scene), reduce, start,
            duration=_OPEN if duration is None else duration, fs=fs, rtol=rtol, accuracy=accuracy,
            method=method, threads=threads, bandwidth=bandwidth, settle=settle,
            time_limit=time_limit, max_steps=max_steps,
        )  # fmt: skip
        self._core = shown(
            progress,
            scene.name,
            lambda share: _core.Simulation(document, asked, state, share, code),
        )
        self._forces = tuple(forces or ())
        self._keep = keep
        self._pieces: list[Piece] = []
        self._end: float | None = None

    @classmethod
    def restore(cls, snapshot: Snapshot | str | os.PathLike[str]) -> Simulation:
        """Go on where a snapshot was taken, in this process or another.

        It must be of the same version of ballrace; the bits are the same on processors with the same vector
        instructions.

        Parameters
        ----------
        snapshot : Snapshot or path
            The snapshot, or the file that :meth:`Snapshot.write` wrote.

        Raises
        ------
        SceneError
            It is of another version, or no snapshot.
        FileError
            The file is no snapshot, or damaged.
        """
        if not isinstance(snapshot, Snapshot):
            snapshot = Snapshot.read(snapshot)
        made = cls.__new__(cls)
        made._core = _core.Simulation.restored(snapshot._document)
        made._keep = True
        made._pieces = list(snapshot._pieces)
        made._end = None
        made._forces = ()
        return made

    def snapshot(self) -> Snapshot:
        """Return what the run needs to go on from here, and its record until here.

        Raises
        ------
        SceneError
            It has forces by functions, which a snapshot cannot hold.
        """
        if self._forces:
            allowed = "absent for a snapshot, which cannot hold functions; a TableForce is part of the scene"
            raise SceneError("forces", ", ".join(self._forces), allowed)
        return Snapshot(self._core.snapshot(), tuple(self._pieces))

    def __repr__(self) -> str:
        state = "finished" if self._end is not None else "stands"
        return f"<Simulation {state} at {self.time:g} s>"

    @property
    def time(self) -> float:
        """The time that it has reached [s]."""
        return self._core.time if self._end is None else self._end

    @property
    def scene(self) -> Scene:
        """The scene as it is now, with a number for the axial place of every defect."""
        return Scene._read(self._core.scene)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the states: ``outer.x``, ``row0.ball3.vz`` and so on."""
        return tuple(self._core.names)

    @property
    def state(self) -> NDArray[np.float64]:
        """States of all bodies, shape (n_states,), in the order of :attr:`names`."""
        return self._core.state()

    @property
    def contacts(self) -> dict[str, NDArray[np.float64]]:
        """Contacts of all balls with outer and inner race, each of shape (n_balls, 2).

        ``load`` [N], ``angle`` [rad], ``zone_centre`` and ``zone_width`` [m], ``slip`` [m/s], as a
        :class:`ballrace.scene.ContactsProbe` records them; angle, centre and slip are NaN without load.
        """
        return self._core.contacts()

    def wrench(self, ring: Literal["outer", "inner"]) -> NDArray[np.float64]:
        """Return force and moment of the balls on a ring.

        Returns
        -------
        ndarray, shape (6,)
            Force along x, y, z [N], and moment about the ring's centre of mass [N m].

        Raises
        ------
        SceneError
            It is neither ``"outer"`` nor ``"inner"``.
        """
        return self._core.wrench(ring)

    def advance(
        self, dt: float, *, progress: bool | Callable[[float], object] | None = None
    ) -> Piece:
        """Go on by a time `dt` [s]; see :meth:`advance_to`."""
        return self.advance_to(self.time + positive("dt", dt, "s", zero=True), progress=progress)

    def advance_to(
        self, t: float, *, progress: bool | Callable[[float], object] | None = None
    ) -> Piece:
        """Go on to a time `t` [s].

        Ctrl-C stops it at a time before, from which it may go on.

        Returns
        -------
        dict of str to ndarray
            The times ``t`` [s] and the columns of the samples before the time reached that have become final.
            Where signals are filtered, the last 14 become final later. All pieces together, with the samples of
            :meth:`finish`, are the record.

        Raises
        ------
        SceneError
            The time has passed, or is beyond the end of the run.
        IntegrationError
            The motion cannot go on.
        BudgetError
            It took more than `time_limit` or `max_steps` allows.
        """
        target = finite("t", t, "s")
        piece = shown(progress, "simulating", lambda share: self._core.advance_to(target, share))
        if self._keep and piece["t"].size:
            self._pieces.append(piece)
        return piece

    def change(self, changes: Mapping[str, object]) -> None:
        """Change fields of the scene by their paths, as :meth:`Scene.replace` does.

        Allowed are changes of loads, moments, the drive, gravity, clearances, defects, friction and others that
        keep the bodies, the held directions and the probes. The scene is compiled again, and the integrator
        restarts as at a corner of a table; the motion goes on from its state, and tables in time from the time of
        the run. A new driving speed applies at once: to change it smoothly, give a ramp or a table.

        Raises
        ------
        SceneError
            A path does not exist, a value is not usable, or the change needs other bodies, held directions or
            probes. The simulation is then as it was.
        """
        if not hasattr(changes, "items"):
            raise SceneError("changes", repr(changes), "new values by their paths")
        pairs = [(checked_path(path), encode(value, path)) for path, value in changes.items()]
        self._core.change(json.dumps(pairs))

    def set_loads(self, loads: Mapping[str, float]) -> None:
        """Set the sizes of constant loads, moments and of a constant torque of the drive by their paths.

        It is for forces from another simulation that exchanges them every few microseconds: the integrator
        restarts as in :meth:`change`, but nothing is compiled. Tolerances, step limits, films, textures and places
        of defects stay those of the loads with which the scene was compiled. Unchanged sizes leave the motion as
        it is, bit by bit.

        Parameters
        ----------
        loads : mapping of str to float
            Sizes [N], [N m] by paths: ``loads.radial.force``, ``moments.tilt.moment``, ``drive.torque.value``.

        Raises
        ------
        SceneError
            A path is none of these, its size changes in time, or the new size is not usable. The simulation is
            then as it was.

        Examples
        --------
        A belt pulls the inner ring down with 500 N, and with 50 N/µm of its stretch; the force is updated every 10
        µs:

        >>> import ballrace as br
        >>> scene = br.presets.deep_groove_6205(radial_load=500.0)
        >>> simulation = br.Simulation(scene)
        >>> y = simulation.names.index("inner.y")
        >>> rest = simulation.state[y]
        >>> for step in range(1, 101):
        ...     force = 500.0 + 5e7 * (simulation.state[y] - rest)
        ...     simulation.set_loads({"loads.radial.force": force})
        ...     piece = simulation.advance_to(1e-5 * step)
        >>> bool(abs(simulation.state[y] - rest) < 1e-6)
        True
        """
        if not hasattr(loads, "items"):
            raise SceneError("loads", repr(loads), "sizes by their paths")
        self._core.set_loads(
            [(path, finite(checked_path(path), size, "N, N m")) for path, size in loads.items()]
        )

    def set_motions(self, motions: Mapping[str, Sequence[float]], *, until: float) -> None:
        """Move rings with given motions from where they are to places with speeds, by paths of motions.

        It is for rings that are part of another simulation, which gives before each piece their places at its end.
        Places and speeds are continuous: a cubic joins them, and after its end the rings go on with
        these speeds. The integrator restarts as in :meth:`change`, but nothing is compiled.

        Parameters
        ----------
        motions : mapping of str to two floats
            Place [m] and speed [m/s], of tilts [rad] and [rad/s], by paths such as ``inner_ring.support.x.given``.
        until : float
            Time at which they reach these places [s]; later than :attr:`time`.

        Raises
        ------
        SceneError
            A path is no given motion, a place is too far or no number, or the time has passed. The simulation is
            then as it was.

        Examples
        --------
        Another program carries the inner ring, and moves it down by 5 µm in 1 ms:

        >>> import ballrace as br
        >>> held = {"inner_ring.support.x": br.scene.Given(0.0), "inner_ring.support.y": br.scene.Given(-2e-5)}
        >>> simulation = br.Simulation(br.presets.deep_groove_6205(radial_load=500.0).replace(held))
        >>> before = simulation.wrench("inner")[1]
        >>> for step in range(1, 11):
        ...     t = 1e-4 * step
        ...     simulation.set_motions({"inner_ring.support.y.given": (-2e-5 - 5e-3 * t, -5e-3)}, until=t)
        ...     piece = simulation.advance_to(t)
        >>> bool(simulation.wrench("inner")[1] > before + 100.0)
        True
        """
        if not hasattr(motions, "items"):
            raise SceneError("motions", repr(motions), "a place and a speed by their paths")
        pairs: list[tuple[str, Sequence[float]]] = []
        for path, to in motions.items():
            given = real_row(checked_path(path), to)
            if given.shape != (2,) or not np.isfinite(given).all():
                raise SceneError(path, repr(to), "a place and a speed, two finite numbers")
            pairs.append((path, given.tolist()))
        self._core.set_motions(pairs, real(until))

    def finish(self, *, progress: bool | Callable[[float], object] | None = None) -> Signals:
        """End the run here, and return its record.

        With ``keep=False`` that is only what no piece has had.

        Raises
        ------
        SceneError
            It stands at the beginning, or was finished before.
        """
        end = self.time
        raw = shown(progress, "simulating", self._core.finish)
        self._end = end
        warn(raw, stacklevel=3)
        rest = {"t": raw["t"], **{name: values for name, _, values in raw["columns"]}}
        record = joined([*self._pieces, rest])
        self._pieces = []
        raw["warnings"] += warnings_of(self._forces)
        raw["t"] = record["t"]
        raw["columns"] = [(name, unit, record[name]) for name, unit, _ in raw["columns"]]
        return Signals._from_core(raw)
