"""Runs."""

from __future__ import annotations

import functools
import warnings
from typing import TYPE_CHECKING, Any, Literal, ParamSpec, TypeAlias, TypeVar

import numpy as np

from . import _core
from ._base.progress import Bar
from ._base.text import printable
from ._io.files import as_path, check_output
from ._results.file import Scanned, metadata, writing
from .errors import AccuracyWarning, SceneError, SceneWarning
from .options import Run, Start
from .ring_force import passed, warnings_of
from .scene.scene import checked_scene
from .signals import Signals

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Mapping
    from pathlib import Path

    from numpy.typing import NDArray

    from ._core import _Signals
    from .ring_force import RingForce
    from .scene import Method, Scene

    _Sink: TypeAlias = Callable[[Mapping[str, NDArray[np.float64]]], object]

__all__ = ["simulate"]

_CATEGORIES = {"accuracy": AccuracyWarning, "scene": SceneWarning}

P = ParamSpec("P")
T = TypeVar("T")


def _of_a_scene(function: Callable[P, Signals]) -> Callable[P, Signals]:
    """Check the scene before Python misses arguments: ``simulate("file.toml")`` says how to read a file."""

    @functools.wraps(function)
    def called(*args: P.args, **kwargs: P.kwargs) -> Signals:
        if args or "scene" in kwargs:
            checked_scene(args[0] if args else kwargs["scene"])
        return function(*args, **kwargs)

    return called


@_of_a_scene
def simulate(
    scene: Scene,
    *,
    duration: float,
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
    out: str | os.PathLike[str] | None = None,
    forces: Mapping[str, RingForce] | None = None,
) -> Signals:
    """Run a scene and record its probes.

    Other Python threads run meanwhile, and Ctrl-C stops the run within half a second. A :class:`ballrace.Run`
    holds the arguments as one document: ``br.simulate(scene, **run.to_dict())``.

    Parameters
    ----------
    scene : Scene
        What to run.
    duration : float
        Simulated time [s].
    fs : float
        Sampling rate of the signals [Hz]. It does not change the steps of the integrator.
    start : {"equilibrium", "rolling"}, ndarray of shape (n_states,) or Signals
        The static equilibrium in the cage's frame, the nominal places of pure rolling, a state in the
        order of ``Model(scene).names``, or another run, from whose end this one goes on. Time begins at 0 again,
        for loads that change in time, too; :class:`ballrace.Simulation` goes on in time.
    rtol : float, optional
        Relative tolerance; by default ``scene.solver.rtol``.
    accuracy : float, optional
        Relative error of the accelerations that is aimed at, 1e-4 to 0.1, over the first milliseconds from a given
        state. Nodes, tolerance and step cap are chosen for it, in place of `rtol`, by pilot runs of the first 3
        ms, which take as long as 10 to 20 ms of the run itself. ``out.accuracy`` has the choice and the errors of
        the pilot runs; ``out.scene`` has the choice, too. Fixed slices are kept; the method must be the default,
        ``"adams"``, for which the choice was validated.
    method : str, optional
        Method of integration; by default ``scene.solver.method``.
    reduce : bool, optional
        Whether to leave out what does not change the motion (:meth:`Model.summary` lists it); by default
        ``scene.solver.reduce``, which is true.
    threads : int
        Threads of the run; 0: chosen automatically. The result is the same, bit by bit, for any number.
    progress : bool or callable, optional
        True shows a bar on a terminal or in a notebook. A callable is called with the share done, from 0 to 1,
        about twenty times a second; an exception that it raises stops the run.
    bandwidth : {"auto"} or None
        ``"auto"`` reads motion, cage forces and friction torques as finely as the steps go, and decimates them
        through a linear-phase low-pass: flat within 0.004 dB up to 0.4 `fs`, 83 dB down beyond 0.6 `fs`, without
        delay. Accelerations are the filtered derivatives of the velocities. Where something jumps, the samples
        around it ring. For its last samples a run goes on for 14 samples past its end, by a tenth of its
        duration at most; beyond that, and before t = 0, signals are continued by their odd reflection.
        Contacts, energies, forces by origin and slices are values of a state and always points.

        None takes point samples of the dense output for all columns, for studies of the integrator. Content
        above half the sampling rate is then folded into the band below: of a faulted 6205's acceleration
        four fifths of the power at 12 kHz.

        In ``out.provenance``, ``bandwidth`` [Hz] is 0.4 `fs`, or `fs`/2 where `fs` is so high that no filter
        was needed, or None; ``oversampling`` is the number of points read for each sample.
    settle : float, optional
        Time before t = 0 in which the transient of the start decays [s], at most 1000; 0 switches it off. By
        default it is as long as the scene needs from equilibrium, at most 0.1 s, and 0 from any other
        start. ``out.provenance.settled`` is its length, ``out.stats.settling_nfev`` its number of
        evaluations. Meanwhile loads and drive are as at t = 0 (a driving torque: the initial speed), and rings and
        cage are turned back, so that at t = 0 they are where the scene puts them except for the slip of the balls;
        this does not apply to a given state.
    time_limit : float, optional
        Wall time that the run may take, equilibrium and pilot runs included [s], checked about every 20 ms; by
        default any.
    max_steps : int, optional
        Steps that the run may take, accepted and rejected ones; by default any. The same run ends at the same
        step everywhere.
    out : path-like, optional
        Parquet file to write the signals to while the run goes on, without keeping them: a record of 1.8 GB took
        0.24 GB of memory, most of it at the end, when the file is put together, and longer ones take some more. It
        is the file that :meth:`Signals.write_parquet` writes of the run without `out`, with units, scene,
        statistics and provenance. It appears only when the run is over and it is complete, and replaces one of the
        same name; nothing of it is left where the run fails or is stopped. Until then a hidden folder beside it
        holds the samples: the disk must have room for them twice.
    forces : mapping of str to RingForce, optional
        Forces on the rings by functions, by name; slow, for studies. They are not part of the scene:
        ``out.warnings`` names them. Exceptions of a function are raised.

    Returns
    -------
    Signals
        The columns of the probes, with the scene and statistics. With `out` the columns stay in the file and are
        read from there when they are asked for, as by :meth:`Signals.scan_parquet`.

    Raises
    ------
    SceneError
        A field of the scene, or an argument, is not usable.
    EquilibriumError
        There is no stable equilibrium to start from.
    IntegrationError
        The integration could not go on; the error names the contacts that caused it.
    BudgetError
        The run cost more than `time_limit` or `max_steps` allows; an IntegrationError that has the time reached.
    MemoryLimitError
        The signals would take more memory than there is, a MemoryError; nothing was computed. With `out` that is
        a block of them, of at most 65 536 samples.
    OSError
        `out` cannot be written; if possible this is reported before anything is computed.

    Warns
    -----
    AccuracyWarning
        The steps do not resolve the contacts, or contacts rode over a shoulder or past the pole of ball
        and groove.
    SceneWarning
        The scene is probably not what was meant: a number that no bearing is likely to have, contacts beyond the
        static load rating (``out.stats.largest_pressure``), columns that cannot change, `fs` below
        twice the line of a defect.

    Examples
    --------
    >>> import ballrace as br
    >>> scene = br.presets.deep_groove_6205()
    >>> out = br.simulate(scene, duration=0.001, fs=50_000)
    >>> out["outer.ay"].shape
    (50,)
    """
    target = None if out is None else _target(out)
    code = passed(forces)
    document, asked, state = request(
        scene, reduce, start,
        duration=duration, fs=fs, rtol=rtol, accuracy=accuracy, method=method, threads=threads,
        bandwidth=bandwidth, settle=settle, time_limit=time_limit, max_steps=max_steps,
    )  # fmt: skip

    def run(sink: _Sink | None) -> _Signals:
        raw = shown(
            progress,
            scene.name,
            lambda share: _core.simulate(document, asked, state, share, sink, code),
        )
        raw["warnings"] += warnings_of(forces)
        return raw

    raw, written = (run(None), None) if target is None else _written(target, run)
    warn(raw, stacklevel=4)
    return Signals._from_core(raw, written)


def request(
    scene: Scene, reduce: bool | None, start: Start | NDArray[np.float64] | Signals, **given: Any
) -> tuple[str, str, NDArray[np.float64] | None]:
    """Return the documents of a scene and of a run, and the state that it begins from where one is given.

    A state goes beside the documents, as an array: as text it would take far longer.
    """
    state = None if isinstance(start, str) else _state(start)
    asked = Run(start=start if isinstance(start, str) else "rolling", **given).to_json()
    if reduce is not None:
        scene = scene.replace({"solver.reduce": reduce})
    return scene.to_json(), asked, state


def shown(
    progress: bool | Callable[[float], object] | None,
    label: str,
    work: Callable[[Callable[[float], object] | None], T],
) -> T:
    """Work while a bar, or a callable, is given the share done."""
    if progress is not True:
        return work(progress or None)
    with Bar(label or "simulating") as bar:
        return work(bar.show)


def warn(raw: _Signals, *, stacklevel: int) -> None:
    """Give the warnings of a run, except those about what its caller asked for."""
    for category, text in raw["warnings"]:
        if category != "asked":
            warnings.warn(printable(text), _CATEGORIES[category], stacklevel=stacklevel)


def _target(out: str | os.PathLike[str]) -> Path:
    path = as_path(out, "out", "the name of a Parquet file, or None")
    check_output(path, name="out")
    return path


def _written(path: Path, run: Callable[[_Sink], _Signals]) -> tuple[_Signals, Scanned]:
    """Have a run write its samples to a file; return its other results, and the file's columns."""
    with writing(path) as writer:
        raw = run(writer.take)
        writer.finish(metadata(Signals._from_core(raw)))
    return raw, Scanned(path)


def _state(start: NDArray[np.float64] | Signals) -> NDArray[np.float64]:
    allowed = "'equilibrium', 'rolling', an array of shape (n_states,) or the Signals of a run"
    if isinstance(start, Signals):
        if start.end_state is None:
            raise SceneError("start", "signals without an end state", "those of version 0.3 and on")
        return start.end_state
    try:
        state = np.asarray(start, dtype=np.float64)
    except (TypeError, ValueError):
        raise SceneError("start", repr(start), allowed) from None
    if state.ndim != 1:
        given = f"an array of shape {state.shape}" if state.ndim else repr(start)
        raise SceneError("start", given, allowed)
    return state
