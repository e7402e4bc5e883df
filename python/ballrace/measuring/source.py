"""The signal at the beginning of the chain."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .. import _core
from .._base.numbers import real, real_row
from ..channel import default_column
from ..errors import SceneError
from ..scene import MotionProbe, SeatProbe
from ..scene.turning import constant_speeds
from .path import axes, through

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike

    from ..scene import RingName, Scene
    from ..signals import Signals
    from .path import Path


@dataclass(frozen=True, kw_only=True, eq=False)
class Source:
    """An acceleration [m/s²] at even times [s], and angles [rad] if they are known.

    ``angle`` is that of the shaft, by which the machine and a tachometer go: of the inner ring, or of the outer
    where that one alone turns. ``against`` is that of the inner ring against the outer.
    """

    x: NDArray[np.float64]
    t: NDArray[np.float64]
    fs: float
    angle: NDArray[np.float64] | None
    against: NDArray[np.float64] | None

    @property
    def rate(self) -> float | None:
        """Mean rate of the inner ring against the outer [Hz], if it is known."""
        if self.against is None or self.t.size < 2:
            return None
        turns = abs(float(self.against[-1] - self.against[0])) / (2.0 * math.pi)
        return turns / float(self.t[-1] - self.t[0])

    def needed_angle(self) -> NDArray[np.float64]:
        """Return the angle of the shaft [rad].

        Raises
        ------
        SceneError
            It is not known.
        """
        if self.angle is None:
            raise SceneError(
                "shaft", "None", "the frequency of the shaft [Hz], or its angles [rad], shape (n,)"
            )
        return self.angle


def of_array(
    x: ArrayLike,
    fs: float | None,
    shaft: ArrayLike | None,
    direction: tuple[float, float, float] | None,
    *,
    path: Path | None,
    sensor: str | None,
) -> Source:
    """Return the source that an array is, of shape (n,), or (n, 3) of three axes; with a path, of forces.

    Raises
    ------
    SceneError
        It is no signal, or there is no sampling rate.
    """
    if fs is None or not 0.0 < real(fs) < math.inf:
        raise SceneError("fs", repr(fs), "give fs=, the sampling rate of the array [Hz]")
    signal = real_row("x", x)
    if path is not None and signal.shape[:1] > (1,) and signal.shape[1:] in {(), (3,)}:
        _core.check_samples("x", signal.ravel())
        force = signal if signal.ndim == 2 else np.outer(signal, (0.0, 1.0, 0.0))
        signal = through(path, force, float(fs), unit(direction or (0.0, 1.0, 0.0)), sensor)
    elif signal.ndim == 2 and signal.shape[1] == 3:
        signal = signal @ np.asarray(unit(direction or (0.0, 1.0, 0.0)))
    elif direction is not None:
        raise SceneError(
            "direction", repr(direction), "None, or an array of shape (n, 3) of three axes"
        )
    if signal.ndim != 1 or signal.size < 2:
        raise SceneError("x", f"an array of shape {signal.shape}", "numbers, shape (n,) or (n, 3)")
    _core.check_samples("x", signal)
    t = np.arange(signal.size) / fs
    angle = _angle(shaft, t)
    return Source(x=signal.copy(), t=t, fs=float(fs), angle=angle, against=angle)


def of_signals(
    out: Signals,
    body: str | None,
    direction: tuple[float, float, float] | None,
    shaft: ArrayLike | None,
    path: Path | None = None,
) -> Source:
    """Return the acceleration of a body along a direction, or at the end of a path from the seat.

    Raises
    ------
    SceneError
        It was not recorded.
    """
    parts = unit(direction or (0.0, 1.0, 0.0))
    if path is None:
        name = _sensor(out) if body is None else probe_of(out.scene, body)
        x = (
            _recorded(
                out, f"{name}.a", [part != 0.0 for part in parts], ("direction", repr(direction))
            )
            @ parts
        )
    else:
        force = _recorded(
            out, f"{_seat(out.scene)}.f", axes(path, parts), ("path", f"a {type(path).__name__}")
        )
        x = through(path, force, out.fs, parts, body)
    given = _angle(shaft, out.t)
    inner, against = (_ring_angle(out, "inner"), _against(out)) if given is None else (given, given)
    stands = inner is None or inner[-1] == inner[0]
    angle = against if stands else inner
    return Source(x=x, t=out.t, fs=out.fs, angle=angle, against=against)


def _recorded(
    out: Signals, name: str, needed: Sequence[bool], by: tuple[str, str]
) -> NDArray[np.float64]:
    """Return three columns as one array, 0 where they are not needed; ``by`` is the argument that wants them.

    Raises
    ------
    SceneError
        One is not there.
    """
    found = np.zeros((out.n_samples, 3))
    for k, axis in enumerate("xyz"):
        if needed[k]:
            if f"{name}{axis}" not in out:
                wanted = f"{name}{axis} among the columns, by a probe of the scene"
                if by[0] == "path":
                    wanted += ": the force on the seat of a structure (br.scene.SeatProbe)"
                raise SceneError(*by, wanted)
            found[:, k] = out[f"{name}{axis}"]
    return found


def _seat(scene: Scene) -> str:
    """Return the name under which the force on the seat is recorded."""
    names = [name for name, probe in scene.probes.items() if isinstance(probe, SeatProbe)]
    return names[0] if names else "seat"


def _sensor(out: Signals) -> str:
    """Return what the columns of the first sensor of the scene's structure begin with, else of the outer ring."""
    found = default_column(out)
    return (
        found.removesuffix(".ay") if found.startswith("housing.") else probe_of(out.scene, "outer")
    )


def probe_of(scene: Scene, body: str) -> str:
    """Return the name under which the motion of a body is recorded."""
    probes = scene.probes.items()
    names = [
        name for name, probe in probes if isinstance(probe, MotionProbe) and probe.body == body
    ]
    return names[0] if names else body


def unit(direction: tuple[float, float, float]) -> tuple[float, ...]:
    """Return a direction with the length 1.

    Raises
    ------
    SceneError
        It is none.
    """
    vector = np.asarray(direction, dtype=np.float64)
    length = float(np.linalg.norm(vector)) if vector.shape == (3,) else math.nan
    if not 0.0 < length < math.inf:
        raise SceneError("direction", repr(direction), "three numbers, not all 0")
    return tuple((vector / length).tolist())


def _ring_angle(out: Signals, ring: RingName) -> NDArray[np.float64] | None:
    """Return the angle of a ring [rad], as recorded or by a speed that is given and constant."""
    name = f"{probe_of(out.scene, ring)}.theta"
    if name in out:
        return out[name]
    speeds = constant_speeds(out.scene)
    return None if speeds is None else speeds[ring == "inner"] * out.t


def _against(out: Signals) -> NDArray[np.float64] | None:
    """Return the angle of the inner ring against the outer [rad]."""
    inner = _ring_angle(out, "inner")
    if inner is None or out.scene.outer_speed is None:
        return inner
    outer = _ring_angle(out, "outer")
    return None if outer is None else inner - outer


def _angle(shaft: ArrayLike | None, t: NDArray[np.float64]) -> NDArray[np.float64] | None:
    if shaft is None:
        return None
    given = real_row("shaft", shaft)
    if given.ndim == 0 and np.isfinite(given):
        return 2.0 * np.pi * float(given) * t
    if given.shape != t.shape or not np.isfinite(given).all():
        raise SceneError(
            "shaft",
            f"an array of shape {given.shape}",
            f"a frequency [Hz], or {t.size} angles [rad]",
        )
    return given
