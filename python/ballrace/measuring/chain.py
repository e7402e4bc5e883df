"""The stages, one after the other."""

from __future__ import annotations

import os
import warnings
from dataclasses import dataclass, field, replace
from typing import TypedDict, Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._base.libraries import pl
from .._base.numbers import counted
from ..channel import Channel
from ..errors import AccuracyWarning, SceneError
from ..recordings.recording import Recording
from ..recordings.scenes import origin_of
from ..recordings.windows import windows
from ..scene import Scene, Structure
from ..signals import Signals
from .coupling import TOO_MUCH, coupling
from .linear import passed
from .logger import Logger
from .machine import Machine
from .mixing import mix_into
from .path import ImpulseResponse, MeasuredResponse, Path
from .sensor import Sensor
from .source import Source, of_array, of_signals
from .tacho import Tacho

CLIPPED = 1e-3
"""Share of clipped samples above which there is a warning."""


@dataclass(frozen=True, kw_only=True)
class Chain:
    """A measuring chain; what is None is left out.

    Attributes
    ----------
    direction : tuple of three floats, or None
        Direction of the sensor, x right, y up, z along the axis; its length does not matter. None: y.
    body : str or None
        The body whose acceleration reaches it, such as ``outer``, or a sensor of the scene's structure, such as
        ``housing.sensor``. None: such a sensor if there is one, else ``outer``. With a path: the name of its
        sensor; None: the only one that it has.
    path : Structure, MeasuredResponse, ImpulseResponse or None
        From the force of the outer ring on its seat to a sensor elsewhere on the machine. It is driven by that
        force and does not act back: see ``coupling`` of a :class:`Measurement`.
    machine : Machine or None
        What the machine adds.
    sensor : Sensor or None
        The accelerometer.
    logger : Logger or None
        The data logger.
    tacho : Tacho or None
        The tachometer.
    """

    direction: tuple[float, float, float] | None = None
    body: str | None = None
    path: Path | None = None
    machine: Machine | None = None
    sensor: Sensor | None = None
    logger: Logger | None = None
    tacho: Tacho | None = None

    def __post_init__(self) -> None:
        for name, kinds in _KINDS.items():
            stage = getattr(self, name)
            if not (stage is None or isinstance(stage, kinds)):
                allowed = " or ".join(kind.__name__ for kind in kinds)
                raise SceneError(name, repr(stage), f"{allowed} of ballrace.measuring, or None")

    @property
    def stages(self) -> tuple[str, ...]:
        """Names of the stages that it has, in order."""
        return tuple(name for name in _KINDS if getattr(self, name) is not None)


class _Stages(TypedDict, total=False):
    """The fields of a chain."""

    direction: tuple[float, float, float] | None
    body: str | None
    path: Path | None
    machine: Machine | None
    sensor: Sensor | None
    logger: Logger | None
    tacho: Tacho | None


_KINDS: dict[str, tuple[type, ...]] = {
    "path": (Structure, MeasuredResponse, ImpulseResponse),
    "machine": (Machine,),
    "sensor": (Sensor,),
    "logger": (Logger,),
    "tacho": (Tacho,),
}


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Measurement:
    """Result of a chain on a signal.

    Attributes
    ----------
    x : ndarray, shape (n,)
        The acceleration [m/s²].
    fs : float
        Sampling rate [Hz].
    start : float
        Time of the first sample [s].
    unit : str
        Unit of ``x``.
    pulses : ndarray, shape (n_pulses,)
        Times of the tachometer's pulses [s]; empty without one.
    range : float or None
        Range of the logger [m/s²], given or chosen; None without a logger.
    clipped : float
        Share of the samples that were beyond it; above 0.1 % :func:`ballrace.measure` warns.
    chain : Chain
        What was applied.
    seed : int
        With which seed.
    shaft : float or None
        Mean rate of the shaft [Hz], if it is known.
    scene : Scene or None
        What was run, where signals of a run were measured.
    coupling : float or None
        How much the path's modes would act back on the ring, were they in the scene; up to 0.1 the rms is right
        within 10 %, above 0.3 :func:`ballrace.measure` warns. None without a run or a path with modes.
    warnings : tuple of str
        Warnings of that run.
    """

    x: NDArray[np.float64]
    fs: float
    start: float = 0.0
    unit: str = "m/s^2"
    pulses: NDArray[np.float64] = field(default_factory=lambda: np.zeros(0))
    range: float | None = None
    clipped: float = 0.0
    chain: Chain = Chain()
    seed: int = 0
    shaft: float | None = None
    scene: Scene | None = None
    coupling: float | None = None
    warnings: tuple[str, ...] = ()

    def __repr__(self) -> str:
        by = ", ".join(self.chain.stages) or "no stage"
        reach = "" if self.range is None else f", range ±{self.range:g} {self.unit}"
        clipped = f", {100.0 * self.clipped:.2g} % clipped" if self.clipped > 0.0 else ""
        return f"<Measurement of {self.x.size} samples at {self.fs:g} Hz by {by}{reach}{clipped}>"

    @property
    def t(self) -> NDArray[np.float64]:
        """Times of the samples, shape (n,) [s]."""
        return self.start + np.arange(self.x.size) / self.fs

    def channel(self, name: str | None = None) -> Channel:
        """Return the signal with all that is known of it, as runs and recordings do.

        Raises
        ------
        KeyError
            There is no such column; the only one is ``sensor``.
        """
        clipped = (_clipped(self.clipped, self.range),) if self.clipped > CLIPPED else ()
        sensor = Channel(
            x=self.x, fs=self.fs, name="sensor", unit=self.unit, start=self.start, shaft=self.shaft,
            scene=self.scene, warnings=(*self.warnings, *clipped),
        )  # fmt: skip
        return sensor.channel(name)

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object:
        """Return a table with the time ``t`` and the column ``sensor`` by Arrow's interface for C."""
        return self.to_polars().__arrow_c_stream__(requested_schema)

    def to_polars(self) -> pl.DataFrame:
        """Return a table with the time ``t`` and the column ``sensor``."""
        return pl.DataFrame({"t": self.t, "sensor": self.x})

    def write(self, path: str | os.PathLike[str]) -> None:
        """Write the signal into a file that :func:`ballrace.read` reads, as the column ``sensor``.

        Parameters
        ----------
        path : path
            File, of the formats of :meth:`ballrace.Recording.write`.

        Raises
        ------
        SceneError
            The name ends in none of them.
        OSError
            The file cannot be written.

        Examples
        --------
        >>> import ballrace as br, numpy as np, pathlib, tempfile
        >>> sensed = br.measure(np.sin(np.arange(1000.0)), fs=12_000.0, shaft=30.0)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     sensed.write(pathlib.Path(folder) / "sensor.parquet")
        ...     again = br.read(pathlib.Path(folder) / "sensor.parquet")
        >>> again.channel()
        <Channel sensor [m/s^2]: 1000 samples at 12000 Hz, shaft 30 Hz>
        """
        self._recording().write(path)

    def to_windows(
        self,
        length: int,
        hop: int | None = None,
        *,
        label: str | None = None,
        bearing_id: str | int | None = None,
    ) -> pl.DataFrame:
        """Return pieces of equal length as a table for learning, a row a window.

        Parameters
        ----------
        length, hop, label, bearing_id
            As of a run, :meth:`ballrace.Signals.to_windows`; by default the label is what is damaged in the run
            that was measured.

        Returns
        -------
        polars.DataFrame
            As of a run; its column is ``sensor``, and ``start`` counts from the first sample [s].

        Raises
        ------
        SceneError
            An argument is not usable.

        Examples
        --------
        >>> import ballrace as br
        >>> out = br.simulate(br.presets.deep_groove_6205(), duration=0.02, fs=10_000.0)
        >>> table = br.measure(out, sensor=br.measuring.Sensor()).to_windows(64)
        >>> table.height, table["sensor"][0].len(), table["label"][0]
        (3, 64, 'healthy')
        """
        record = self._recording()
        if self.scene is None:
            return record.to_windows(length, hop, label=label, bearing_id=bearing_id)
        origin = origin_of(self.scene, None).later(self.start)
        return windows(
            record._samples(("sensor",)), origin, length, hop, label=label, bearing_id=bearing_id
        )

    def _recording(self) -> Recording:
        columns, units = {"sensor": self.x}, {"sensor": self.unit}
        return Recording(columns=columns, fs=self.fs, units=units, shaft=self.shaft)

    def mix_into(
        self, background: ArrayLike, snr_db: float, *, seed: int | None = None
    ) -> NDArray[np.float64]:
        """Return it on top of a measured background; as :func:`ballrace.measuring.mix_into`."""
        return mix_into(self.x, background, snr_db, seed=seed)


def measure(
    of: Signals | ArrayLike,
    chain: Chain | None = None,
    *,
    fs: float | None = None,
    shaft: ArrayLike | None = None,
    seed: int = 0,
    **stages: Unpack[_Stages],
) -> Measurement:
    """Take an acceleration, or the force on a seat, through a measuring chain.

    Parameters
    ----------
    of : Signals, or array_like, shape (n,) or (n, 3)
        Signals of a run; or an acceleration [m/s²], or those along x, y, z. With a path: the force on the seat
        along y [N], or along x, y, z.
    chain : Chain, optional
        The stages. Without any the numbers stay as they are.
    fs : float, optional
        Sampling rate of an array [Hz].
    shaft : float or array_like, shape (n,), optional
        Frequency of the shaft [Hz] or its angle [rad], for shaft orders and tachometer. Signals have it where the
        motion of the inner ring was recorded, or its speed is constant.
    seed : int
        The same seed gives the same noise, phases and jitter.
    **stages
        Fields of the chain, as of :class:`ballrace.measuring.Chain`; they replace those of `chain`.

    Returns
    -------
    Measurement
        Signal, sampling rate, pulses of the tachometer.

    Raises
    ------
    SceneError
        An argument is not usable, or a column was not recorded.

    Warns
    -----
    AccuracyWarning
        More than 0.1 % of the samples lie beyond the range that the logger was given, or the path would act back.

    Examples
    --------
    >>> import ballrace as br, numpy as np
    >>> x = 30.0 * np.sin(2 * np.pi * 100.0 * np.arange(5000) / 50_000.0)
    >>> br.measure(x, fs=50_000.0, logger=br.measuring.Logger(bits=16))
    <Measurement of 5000 samples at 50000 Hz by logger, range ±50 m/s^2>
    """
    found = measured(of, chain, fs=fs, shaft=shaft, seed=seed, **stages)
    if found.clipped > CLIPPED:
        warnings.warn(_clipped(found.clipped, found.range), AccuracyWarning, stacklevel=2)
    if found.coupling is not None and found.coupling > TOO_MUCH:
        warnings.warn(_acts_back(found.coupling), AccuracyWarning, stacklevel=2)
    return found


def _acts_back(kappa: float) -> str:
    return (
        f"a mode of the path would act back on the ring (κ = {kappa:.2g}, above {TOO_MUCH:g}): levels are wrong "
        "by half and more; run it in the scene, br.bearing(housing=…), or give it heavier modes"
    )


def _clipped(share: float, reach: float | None) -> str:
    return (
        f"{100.0 * share:.2g} % of the samples lie beyond the logger's range of ±{reach:g} m/s² "
        "and are clipped: levels and lines are too small; leave out logger.range, and it fits the signal"
    )


def measured(
    of: Signals | ArrayLike,
    chain: Chain | None = None,
    *,
    fs: float | None = None,
    shaft: ArrayLike | None = None,
    seed: int = 0,
    **stages: Unpack[_Stages],
) -> Measurement:
    """Measure as :func:`measure`, and warn of nothing."""
    chain = replace(Chain() if chain is None else chain, **stages)
    if isinstance(of, Signals):
        if fs is not None:
            raise SceneError("fs", repr(fs), "None: the signals of a run know it")
        source = of_signals(of, chain.body, chain.direction, shaft, chain.path)
    else:
        source = of_array(of, fs, shaft, chain.direction, path=chain.path, sensor=chain.body)
    # A stream of its own for each stage.
    streams = [np.random.default_rng([stage, counted("seed", seed, 0)]) for stage in range(3)]
    x, rate = _sensed(source, chain, streams[0]), source.fs
    clipped, reach = 0.0, None
    if chain.logger is not None:
        x, rate = chain.logger.sampled(x, rate)
        x, clipped, reach = chain.logger.digitised(x, rate, streams[1])
    pulses = np.zeros(0)
    if chain.tacho is not None:
        pulses = chain.tacho.times(source.t, source.needed_angle(), streams[2])
    start = float(source.t[0])
    return Measurement(
        x=x, fs=rate, start=start, pulses=pulses, range=reach, clipped=clipped, chain=chain,
        seed=seed, shaft=source.rate, scene=of.scene if isinstance(of, Signals) else None,
        coupling=_coupled(of, chain), warnings=of.warnings if isinstance(of, Signals) else (),
    )  # fmt: skip


def _coupled(of: object, chain: Chain) -> float | None:
    if isinstance(of, Signals) and isinstance(chain.path, Structure):
        return coupling(of.scene, chain.path)
    return None


def _sensed(source: Source, chain: Chain, rng: np.random.Generator) -> NDArray[np.float64]:
    """Return what the sensor gives."""
    shaken = source.x
    if chain.machine is not None:
        shaken = shaken + chain.machine.added(source, rng)
    return shaken if chain.sensor is None else passed(shaken, source.fs, [chain.sensor])
