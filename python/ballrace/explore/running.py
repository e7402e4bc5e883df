"""Runs on a thread of their own: with progress, stopped at any time, the newest alone."""

from __future__ import annotations

import threading
import warnings
from dataclasses import dataclass, field
from typing import Literal

from ..errors import BallraceError
from ..run import simulate
from ..scene import Scene
from ..signals import Signals

__all__ = ["FS", "Runner", "Running"]

FS = 25_600.0
"""Sampling rate of the page's runs [Hz]."""

_State = Literal["waiting", "running", "done", "failed", "stopped"]


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
