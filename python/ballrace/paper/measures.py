"""Measures of the published figures on plain arrays."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .. import spectra

Array = NDArray[np.float64]

ENVELOPE_BAND = (500.0, 20_000.0)
"""Band of the acceleration whose envelope is taken [Hz]."""


_WINDOW = 2e-3
"""Length of a moving rms [s]: many periods of a contact (30 µs), a part of a ball's passage (6 ms)."""


def orbit(t: Array, x: Array, y: Array) -> tuple[float, float]:
    """Return the rate [rad/s] and the angle at t = 0 [rad] of a ball's way round, by least squares."""
    rate, angle = np.polyfit(t, np.unwrap(np.arctan2(y, x)), 1)
    return float(rate), float(angle)


def passages(
    t: Array, rate: float, angle: float, *, count: int, place: float, after: float
) -> NDArray[np.intp]:
    """Return the edges of whole passages of balls as indices of samples.

    Parameters
    ----------
    t : ndarray, shape (n_samples,)
        Times, uniform [s].
    rate, angle : float
        Rate at which the balls go round [rad/s] and the angle of one of them at t = 0 [rad].
    count : int
        Balls.
    place : float
        Angle that they pass in the middle of each passage [rad].
    after : float
        No passage begins before [s].

    Returns
    -------
    ndarray of int, shape (n_passages + 1,)
        Passage k is ``signal[edges[k]:edges[k + 1]]``; empty if there is none.
    """
    turn = count * (angle + rate * t - place) / (2.0 * np.pi) + 0.5
    first = int(np.searchsorted(t, after))
    if first >= t.size:
        return np.empty(0, dtype=np.intp)
    wanted = np.arange(math.ceil(turn[first]), math.floor(turn[-1]) + 1)
    return np.searchsorted(turn, wanted).astype(np.intp)


def impacts(signal: Array, edges: NDArray[np.intp]) -> Array:
    """Return the largest distance from the mean in each passage; the mean is over all passages."""
    part = signal[edges[0] : edges[-1]]
    largest: Array = np.maximum.reduceat(np.abs(part - part.mean()), edges[:-1] - edges[0])
    return largest


def envelope_line(
    signal: Array, fs: float, frequency: float, band: tuple[float, float] = ENVELOPE_BAND
) -> float:
    """Return the amplitude of the envelope's oscillation at a frequency.

    Parameters
    ----------
    signal : ndarray, shape (n_samples,)
        Signal, best over a whole number of periods of ``frequency``.
    fs : float
        Sampling rate [Hz].
    frequency : float
        Frequency of the line [Hz].
    band : tuple of float
        Band whose envelope is taken [Hz].

    Returns
    -------
    float
        Amplitude in the unit of the signal.

    Examples
    --------
    A tone of 3 kHz, its amplitude swinging by 0.25 at 100 Hz:

    >>> t = np.arange(20_000) / 200_000.0
    >>> tone = (1.0 + 0.25 * np.cos(2 * np.pi * 100 * t)) * np.sin(2 * np.pi * 3000 * t)
    >>> round(envelope_line(tone, 200_000.0, 100.0), 6)
    0.25
    """
    envelope = np.sqrt(spectra.squared_envelope(signal, fs, band))
    carrier = np.exp(-2j * np.pi * frequency * np.arange(signal.size) / fs)
    return float(2.0 * np.abs(np.mean((envelope - envelope.mean()) * carrier)))


def clarity(signal: Array, fs: float, frequency: float) -> float:
    """Return how far the squared envelope's line at a frequency stands over what surrounds it.

    Noise without a structure gives 4 to 9 dB: the highest of the bins in which the line is sought.

    Parameters
    ----------
    signal : ndarray, shape (n_samples,)
        Signal.
    fs : float
        Sampling rate [Hz].
    frequency : float
        Frequency of the line [Hz]; its surroundings reach from 0.6 to 1.4 of it.

    Returns
    -------
    float
        Ratio of the line to the median of its surroundings [dB].
    """
    squared = spectra.squared_envelope(signal, fs, ENVELOPE_BAND)
    around = spectra.floor(*spectra.spectrum(squared, fs), frequency, 0.4 * frequency)[1]
    highest = spectra.line(squared, fs, frequency, 0.02 * frequency)[1]
    return 20.0 * math.log10(highest / around)


def settling_time(t: Array, signal: Array, level: float) -> float:
    """Return the time from which on the signal's moving rms stays below that of a vibration of an amplitude.

    What is seen in a figure as a transient is the envelope of the signal, not its last high sample: after a
    start from rest balls rattle, and when the last of them strikes is a toss of a coin. Starts 1e-9 m apart,
    or the same on 6, 12 and 24 nodes, put the last sample above 4.9 m/s² anywhere from 9 to 33 ms (13 starts,
    three axial loads; the latest load of each start: 20 to 33 ms), the end of the moving rms at 7 to 19 ms
    (13 to 19 ms). With windows of 1 to 3 ms it varies by 2 ms.

    Parameters
    ----------
    t, signal : ndarray, shape (n_samples,)
        Uniform times [s] and the signal; distances are from its mean over the last half.
    level : float
        Amplitude [unit of the signal]: the moving rms is held against ``level / sqrt(2)``.

    Returns
    -------
    float
        Middle of the last window above [s]; 0 if there is none.
    """
    count = max(1, round(_WINDOW * (t.size - 1) / (t[-1] - t[0])))
    power = np.square(signal - signal[signal.size // 2 :].mean())
    summed = np.concatenate([[0.0], np.cumsum(power)])
    above = np.flatnonzero(summed[count:] - summed[:-count] > count * level**2 / 2.0)
    return float(t[above[-1]] + _WINDOW / 2.0) if above.size else 0.0


@dataclass(frozen=True)
class Zone:
    """The contact zone of one ball on one race.

    Attributes
    ----------
    force : float
        Sum of the slices' normal forces [N].
    middle : float
        Axial place of the middle of force in the ring's frame [m].
    first, last : float
        Axial places where the first bearing slice begins and the last one ends [m].
    length : float
        Summed width of the slices that bear [m].
    """

    force: float
    middle: float
    first: float
    last: float
    length: float


def zone(z: Array, width: Array, force: Array) -> Zone:
    """Return the contact zone that slices make.

    Parameters
    ----------
    z, width, force : ndarray, shape (n_slices,)
        Axial places in the ring's frame [m], widths [m] and normal forces [N] of the slices.

    Examples
    --------
    >>> zone(np.array([0.0, 1.0, 2.0]), np.ones(3), np.array([0.0, 3.0, 1.0]))
    Zone(force=4.0, middle=1.25, first=0.5, last=2.5, length=2.0)
    """
    bears = force > 0.0
    if not bears.any():
        return Zone(0.0, math.nan, math.nan, math.nan, 0.0)
    z, width, force = z[bears], width[bears], force[bears]
    total = float(force.sum())
    return Zone(
        force=total,
        middle=float((z * force).sum() / total),
        first=float((z - width / 2.0).min()),
        last=float((z + width / 2.0).max()),
        length=float(width.sum()),
    )
