"""Runs on a thread of their own: with progress, stopped at any time, the newest alone."""

from __future__ import annotations

import threading
import warnings
from dataclasses import dataclass, field
from typing import Literal

from ..errors import BallraceError
from ..explanation import explain
from ..run import simulate
from ..scene import Scene
from ..signals import Signals

FS = 25_600.0
"""Sampling rate of the page's runs [Hz]."""

_State = Literal["waiting", "running", "done", "failed", "stopped"]


_REST = 0.4
"""Time for which a scene has to stay before its cost is asked for [s]: not at every move of a slider."""


class _StoppedError(Exception):
    """The run is no longer wanted."""


@dataclass(eq=False)
class Running:
    """A run, from waiting to its result.

    Attributes
    ----------
    scene : Scene
        What runs.
    state : {"waiting", "running", "done", "failed", "stopped"}
        How far it is.
    share : float
        Share of the simulated time that is done.
    out : Signals or None
        The result of a run that is done.
    why : str
        Why it failed.
    """

    scene: Scene
    state: _State = "waiting"
    share: float = 0.0
    out: Signals | None = None
    why: str = ""
    _stop: threading.Event = field(default_factory=threading.Event)
    _ended: threading.Event = field(default_factory=threading.Event)

    def stop(self) -> None:
        """Stop it where it is; one that has ended stays as it is."""
        self._stop.set()

    def wait(self, seconds: float) -> bool:
        """Wait for its end, and return whether it came."""
        return self._ended.wait(seconds)

    def _work(self, duration: float, delay: float) -> None:
        try:
            if self._stop.wait(delay):
                raise _StoppedError  # noqa: TRY301 (as from within the run)
            self.state = "running"
            with warnings.catch_warnings():
                # They stand in the result.
                warnings.simplefilter("ignore")
                self.out = simulate(
                    self.scene, duration=duration, fs=FS, progress=self._on_progress
                )
            self.state = "done"
        except _StoppedError:
            self.state = "stopped"
        except BallraceError as error:
            self.why, self.state = str(error), "failed"
        finally:
            self._ended.set()

    def _on_progress(self, share: float) -> None:
        self.share = share
        if self._stop.is_set():
            raise _StoppedError


class Runner:
    """Runs the newest scene that was asked for, and stops those before it."""

    def __init__(self) -> None:
        self.newest: Running | None = None

    def start(self, scene: Scene, *, duration: float, delay: float = 0.0) -> Running:
        """Start a run of a simulated time [s], after a delay in which another one may replace it [s]."""
        self.stop()
        run = Running(scene)
        self.newest = run
        threading.Thread(
            target=run._work, args=(duration, delay), name="ballrace run", daemon=True
        ).start()
        return run

    def stop(self) -> None:
        """Stop what waits or runs."""
        if self.newest is not None:
            self.newest.stop()


class Forecast:
    """Cost of a simulated second of the newest scene, worked out on a thread once the scene stays the same."""

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._asked: Scene | None = None
        self._known: tuple[Scene, float | None] | None = None
        threading.Thread(target=self._work, name="ballrace forecast", daemon=True).start()

    def ask(self, scene: Scene) -> None:
        """Have the cost of a scene worked out, and no more that of one before."""
        with self._changed:
            self._asked = scene
            self._changed.notify_all()

    def seconds(self, scene: Scene | None) -> float | None:
        """Return the time that a simulated second of a scene takes [s]; None as long as it is not known."""
        known = self._known
        return known[1] if known is not None and known[0] == scene else None

    def _work(self) -> None:
        while True:
            with self._changed:
                while self._asked is None:
                    self._changed.wait()
                scene = self._asked
                if self._changed.wait(_REST):
                    continue
                self._asked = None
            self._known = scene, _cost(scene)


def _cost(scene: Scene) -> float | None:
    """Return what :func:`ballrace.explain` measures; None of a scene that cannot begin."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return float(explain(scene).cost.seconds)
    except BallraceError:
        return None
