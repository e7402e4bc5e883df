"""Bands of a spectrum in which a defect's lines are to be expected, and what stands there.

A defect of the outer race gives lines at the multiples of BPFO. One of the inner race turns with the shaft in and
out of the load, so its lines at the multiples of BPFI have others a shaft's rate beside them. One of a ball meets
a race twice a turn and goes round with the cage: lines at the multiples of 2·BSF, others FTF beside them
(R. B. Randall, J. Antoni, *Rolling element bearing diagnostics*, Mech. Syst. Signal Process. 25 (2011) 485).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from .._base.numbers import counted, positive, real
from ..errors import SceneError

if TYPE_CHECKING:
    from collections.abc import Iterable

    from ..frequencies.kinematic import Orders

Fault = Literal["outer_race", "inner_race", "ball", "cage"]
"""Part that is damaged."""

_BESIDE = 10
"""Bands of the same width to either side, by which a band is judged."""

_HANN = 1.5
"""Equivalent noise bandwidth of the Hann window [bins]."""


@dataclass(frozen=True, kw_only=True)
class FaultBand:
    """A line that a defect may have, and the band within which slip moves it.

    Attributes
    ----------
    fault : {"outer_race", "inner_race", "ball", "cage"}
        What is damaged.
    harmonic : int
        Multiple of its fault frequency: BPFO, BPFI, 2·BSF or FTF.
    sideband : int
        How many rates of the inner ring, of the outer ring where it turns, or of the cage (ball) beside it.
    centre, low, high : float
        Kinematic place of the line and edges of the band, in orders or [Hz].
    spinning : int
        Of a ball that spins about the axis only: how often a turn its defect meets a race, so that ``harmonic``
        counts multiples of BSF/cos α, or of twice that. 0 of a real ball, and of all others.
    """

    fault: Fault
    harmonic: int
    sideband: int
    centre: float
    low: float
    high: float
    spinning: int = 0

    @property
    def label(self) -> str:
        """Name of the line as on a spectrum: ``2·BPFI − f_r``."""
        name = {"outer_race": "BPFO", "inner_race": "BPFI", "ball": "2·BSF", "cage": "FTF"}
        times = "" if self.harmonic == 1 else f"{self.harmonic}·"
        if self.fault == "ball":
            hits = self.harmonic * (self.spinning or 2)
            line = f"{'' if hits == 1 else f'{hits}·'}BSF{'/cos α' if self.spinning else ''}"
        else:
            line = times + name[self.fault]
        if self.sideband == 0:
            return line
        beside = {"outer_race": "f_o", "ball": "FTF"}.get(self.fault, "f_r")
        many = "" if abs(self.sideband) == 1 else f"{abs(self.sideband)}·"
        return f"{line} {'+' if self.sideband > 0 else '−'} {many}{beside}"


@dataclass(frozen=True, kw_only=True, eq=False)
class FaultMetrics:
    """Metrics of a spectrum in the bands of one fault; each array has an entry a band.

    Attributes
    ----------
    bands : tuple of FaultBand
        The bands.
    peak : ndarray
        Highest value in the band, in the unit of the spectrum.
    frequency : ndarray
        Where it stands, in the unit of the spectrum's frequencies.
    power : ndarray
        Mean square of what lies in the band, of an amplitude spectrum under a Hann window: a²/2 of a line a.
    levels : ndarray
        Peak over the median of the peaks of ten bands of the same width to either side [dB]. Noise alone has
        0 dB, give or take 2, however wide the band and long the record. Not a number where a spectrum is too
        short for any such band.
    """

    bands: tuple[FaultBand, ...]
    peak: NDArray[np.float64]
    frequency: NDArray[np.float64]
    power: NDArray[np.float64]
    levels: NDArray[np.float64]

    @property
    def level(self) -> float:
        """Mean level of the harmonics, sidebands aside [dB]: high only if most of them stand out."""
        return float(
            np.mean([v for b, v in zip(self.bands, self.levels, strict=True) if not b.sideband])
        )


def fault_bands(
    orders: Orders,
    shaft: float = 1.0,
    *,
    harmonics: int = 3,
    sidebands: int = 1,
    slip: float = 0.01,
    spin: tuple[float, int] | None = None,
) -> tuple[FaultBand, ...]:
    """Return the bands in which the lines of defects are to be sought.

    Parameters
    ----------
    orders : Orders
        Kinematic orders of the row, from :func:`ballrace.frequencies.orders`.
    shaft : float
        Rate of the shaft: 1 gives bands in orders, its frequency [Hz] bands in hertz.
    harmonics : int
        Multiples of each fault frequency, from 1 to this.
    sidebands : int
        Sidebands to either side: of the shaft for the inner race, of the outer ring for its race where it turns
        (:meth:`ballrace.frequencies.Orders.turned`), of the cage for a ball, none for others.
    slip : float
        Share by which a fault frequency may lie off its kinematic value, by slip and by the contact angle: half
        the width of the first harmonic's bands; the others are wider as they are higher.
    spin : tuple of float and int, optional
        Of balls that spin about the axis only, as those of a run do: order of their turns against the cage,
        BSF/cos α, and how often a turn a defect meets a race, 1 or 2
        (:func:`ballrace.frequencies.operating.spin_of`). The lines of a ball stand at their product. By default
        at 2·BSF, as of real balls, which tumble.

    Raises
    ------
    SceneError
        An argument is not usable.

    Examples
    --------
    >>> import ballrace as br
    >>> bands = fault_bands(br.frequencies.orders(9, 7.94e-3, 39.04e-3), shaft=29.95, harmonics=2)
    >>> [(band.label, round(band.centre, 1)) for band in bands if band.fault == "inner_race"][:3]
    [('BPFI − f_r', 132.2), ('BPFI', 162.2), ('BPFI + f_r', 192.1)]
    >>> [band.label for band in bands if band.fault == "ball"][-2:]
    ['4·BSF', '4·BSF + FTF']
    """
    harmonics, sidebands = counted("harmonics", harmonics, 1), counted("sidebands", sidebands, 0)
    positive("shaft", shaft)
    if not 0.0 <= real(slip) < 0.5:
        raise SceneError("slip", repr(slip), "from 0 to below 0.5")
    ball, hits = (orders.bsf, 2) if spin is None else spin
    rates: tuple[tuple[Fault, float, float], ...] = (
        ("outer_race", orders.bpfo, orders.outer),
        ("inner_race", orders.bpfi, orders.inner),
        ("ball", hits * ball, orders.ftf),
        ("cage", orders.ftf, 0.0),
    )
    lines = (
        (fault, k, side, (k * rate + side * beside) * shaft, k * rate * slip * shaft)
        for fault, rate, beside in rates
        for k in range(1, harmonics + 1)
        for side in (range(-sidebands, sidebands + 1) if beside else (0,))
        if k * rate * (1.0 - slip) + side * beside > 0.0
    )
    return tuple(
        FaultBand(
            fault=fault, harmonic=k, sideband=side, centre=at, low=at - half, high=at + half,
            spinning=hits if spin is not None and fault == "ball" else 0,
        )
        for fault, k, side, at, half in lines
    )  # fmt: skip


def fault_band_metrics(
    f: NDArray[np.float64], value: NDArray[np.float64], bands: Iterable[FaultBand]
) -> dict[Fault, FaultMetrics]:
    """Return what a spectrum has in the bands of each fault.

    Parameters
    ----------
    f, value : ndarray, shape (n,)
        An amplitude spectrum at equal steps from 0, in hertz or orders as the bands are; of a squared envelope, as
        a rule.
    bands : iterable of FaultBand
        From :func:`fault_bands`. A band takes in the bins that reach into it, one at least.

    Returns
    -------
    dict of str to FaultMetrics
        By fault, in the order of the bands.

    Raises
    ------
    SceneError
        The spectrum is none, or ends below a band.

    Examples
    --------
    >>> import ballrace as br
    >>> bands = fault_bands(br.frequencies.orders(9, 7.94e-3, 39.04e-3), shaft=30.0)
    >>> t = np.arange(24_000) / 12_000.0
    >>> x = sum(np.cos(2 * np.pi * k * 107.5 * t) for k in (1, 2, 3))
    >>> x = x + np.random.default_rng(1).normal(size=t.size)
    >>> found = fault_band_metrics(*br.spectra.spectrum(x, 12_000.0), bands)
    >>> found["outer_race"].frequency.tolist(), found["outer_race"].level > 20 > found["ball"].level
    ([107.5, 215.0, 322.5], True)
    """
    f, value = np.asarray(f, dtype=np.float64), np.asarray(value, dtype=np.float64)
    if f.ndim != 1 or f.shape != value.shape or f.size < 2 or not f[1] > f[0] == 0.0:
        raise SceneError(
            "f", f"arrays of shape {f.shape} and {value.shape}", "a spectrum from 0 up"
        )
    by_fault: dict[Fault, list[FaultBand]] = {}
    for band in bands:
        if band.high > f[-1]:
            raise SceneError(
                "f", f"up to {f[-1]:g}", f"a spectrum that reaches {band.label}, {band.high:g}"
            )
        by_fault.setdefault(band.fault, []).append(band)
    return {fault: _metrics(f, value, tuple(group)) for fault, group in by_fault.items()}


def _metrics(
    f: NDArray[np.float64], value: NDArray[np.float64], bands: tuple[FaultBand, ...]
) -> FaultMetrics:
    rows = [_measured(f, value, band) for band in bands]
    peak, frequency, power, levels = np.array(rows).T
    return FaultMetrics(bands=bands, peak=peak, frequency=frequency, power=power, levels=levels)


def _measured(
    f: NDArray[np.float64], value: NDArray[np.float64], band: FaultBand
) -> tuple[float, float, float, float]:
    """Return peak, its frequency, power and level of a band."""
    first = max(round(band.low / f[1]), 1)
    end = max(round(band.high / f[1]), first) + 1
    at = first + int(np.argmax(value[first:end]))
    peak = float(value[at])
    width = end - first
    starts = (first + side * width for side in range(-_BESIDE, _BESIDE + 1) if side)
    # Not where the mean was removed, which takes two bins under a Hann window, nor beyond the end.
    beside = [value[s : s + width].max() for s in starts if s >= 2 and s + width <= f.size]
    around = float(np.median(beside)) if beside else math.nan
    power = float(np.sum(value[first:end] ** 2)) / 2.0 / _HANN
    return peak, float(f[at]), power, _decibels(peak, around)


def _decibels(value: float, reference: float) -> float:
    """Return a ratio as a level: infinite over nothing, 0 of nothing over nothing, none without a reference."""
    if value == reference == 0.0:
        return 0.0
    with np.errstate(divide="ignore"):
        return float(20.0 * np.log10(np.float64(value) / reference))
