"""Channels: a signal and what is known of it, from a run, a measuring chain or a file.

A run (:class:`ballrace.Signals`), what a chain measured (:class:`ballrace.measuring.Measurement`) and a file
(:class:`ballrace.Recording`) hold signals under different names. Each gives one of them as a :class:`Channel`, and
the functions of signals (:mod:`ballrace.spectra`, :mod:`ballrace.plot`, :func:`ballrace.diagnose`) take any of
them, a channel, or an array with its sampling rate.

>>> import ballrace as br, numpy as np
>>> record = br.Recording(columns={"DE": np.sin(np.arange(4000.0))}, fs=12e3, units={"DE": "g"}, shaft=29.95)
>>> record.channel("DE")
<Channel DE [g]: 4000 samples at 12000 Hz, shaft 29.95 Hz>
>>> f, value = br.spectra.psd(record)
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._base.numbers import real_row
from ._base.units import canonical, in_unit
from .errors import SceneError
from .scene import Scene

__all__ = ["Channel", "Recorded", "channel_of"]


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Channel:
    """A signal of a record.

    Attributes
    ----------
    x : ndarray, shape (n,)
        Samples, in ``unit``.
    fs : float
        Sampling rate [Hz].
    name : str
        Its column; empty for an array.
    unit : str
        Unit, such as ``m/s^2`` or ``g``; empty where it is not known.
    start : float
        Time of the first sample [s].
    shaft : float or None
        Mean rate of the inner ring [Hz], if it is known.
    scene : Scene or None
        What was simulated; None of what was measured.
    warnings : tuple of str
        Warnings about the record: uncertain accelerations, clipped samples.
    is_run : bool
        Whether it is a column of a run itself: neither a path through a machine nor a sensor is in between.
    """

    x: NDArray[np.float64]
    fs: float
    name: str = ""
    unit: str = ""
    start: float = 0.0
    shaft: float | None = None
    scene: Scene | None = None
    warnings: tuple[str, ...] = ()
    is_run: bool = False

    def __repr__(self) -> str:
        shaft = "" if self.shaft is None else f", shaft {self.shaft:g} Hz"
        name = f"{self.name or 'array'} [{self.unit or '?'}]"
        return f"<Channel {name}: {self.x.size} samples at {self.fs:g} Hz{shaft}>"

    @property
    def n_samples(self) -> int:
        """Number of samples."""
        return self.x.size

    @property
    def t(self) -> NDArray[np.float64]:
        """Times of the samples, shape (n,) [s]."""
        return self.start + np.arange(self.x.size) / self.fs

    def channel(self, name: str | None = None) -> Channel:
        """Return the channel itself, so that it can take the place of a record.

        Raises
        ------
        KeyError
            Another name is asked for.
        """
        if name is not None and name != self.name:
            raise KeyError(f"no column {name!r}; there is {self.name or 'one without a name'}")
        return self

    def to(self, unit: str, band: tuple[float, float] = (10.0, 1000.0)) -> Channel:
        """Return the signal in another unit.

        Parameters
        ----------
        unit : {"m/s^2", "g", "mg", "mm/s^2", "cm/s^2", "in/s^2", "ft/s^2", "mm/s", "m/s", "cm/s", "µm/s", "in/s"}
            However it is spelled. Accelerations become velocities by integration in the spectrum (division by
            2πif).
        band : tuple of two floats
            Frequencies that a velocity keeps [Hz]; by default those of ISO 20816-1, 10 to 1000 Hz.

        Raises
        ------
        SceneError
            There is no such unit, or the channel's own is not known, or that of something else: a voltage has
            to be divided by the sensor's sensitivity, an envelope (gE) or a displacement is no acceleration.

        Examples
        --------
        10 m/s² at 100 Hz are 10/(2π·100) m/s:

        >>> t = np.arange(10_000) / 10_000.0
        >>> shaken = Channel(x=10.0 * np.sin(2 * np.pi * 100.0 * t), fs=10_000.0, unit="m/s^2")
        >>> round(float(shaken.to("mm/s").x.max()), 2), round(float(shaken.to("g").x.max()), 3)
        (15.92, 1.02)
        """
        x = in_unit(self.x, self.fs, self.unit, unit, band)
        return replace(self, x=x, unit=canonical(unit))


def default_column(names: Iterable[str]) -> str:
    """Return the column that stands for a record: of a structure's sensor, else the outer ring, else the first.

    Examples
    --------
    >>> default_column(["inner.ay", "outer.ay"]), default_column(["outer.ay", "housing.sensor.ay"])
    ('outer.ay', 'housing.sensor.ay')
    """
    names = list(names)
    sensed = [name for name in names if name.startswith("housing.") and name.endswith(".ay")]
    return (sensed or [name for name in names if name == "outer.ay"] or names)[0]


@runtime_checkable
class Recorded(Protocol):
    """Interface that runs, measurements, recordings and channels share."""

    @property
    def fs(self) -> float:
        """Sampling rate [Hz]."""

    def channel(self, name: str | None = None) -> Channel:
        """Return one signal; by default that of a structure's sensor, else ``outer.ay``, else the first."""


def channel_of(
    of: Recorded | ArrayLike, fs: float | None = None, column: str | None = None, *, name: str = "x"
) -> Channel:
    """Return a signal as a channel.

    Parameters
    ----------
    of : Signals, Measurement, Recording, Channel or array_like
        A record, a channel or an array.
    fs : float, optional
        Sampling rate of an array [Hz].
    column : str, optional
        Which column of a record.
    name : str
        Name of the argument, for messages.

    Raises
    ------
    SceneError
        The sampling rate of an array is missing, ``fs`` differs from that of the record, or ``of`` is not a
        one-dimensional array of numbers.
    KeyError
        There is no such column.
    """
    if isinstance(of, Recorded):
        if fs is not None and fs != of.fs:
            raise SceneError("fs", repr(fs), f"left out: the record has {of.fs:g} Hz")
        return of.channel(column)
    if isinstance(of, str | os.PathLike):
        raise SceneError(name, repr(of), "a record or an array; ballrace.read(path) reads a file")
    if fs is None:
        raise SceneError("fs", "None", "give fs=, the sampling rate of the array [Hz]")
    if column is not None:
        raise SceneError("column", repr(column), "None with an array, which has no columns")
    return Channel(x=real_row(name, of), fs=fs)
