"""Analysis of vibration signals: spectra, envelopes, orders, kurtograms and fault bands.

All functions take a run, a measurement, a recording, a channel of one (``record.channel("DE")``), or a plain array
with its sampling rate ``fs`` in hertz, and return ``(f, value)`` as scipy does. Amplitude spectra are taken under
a Hann window without the mean: a sine of amplitude 2 has a line of height 2.

Where lines of the outer race stand, and how high; whether it is damaged is for :func:`ballrace.diagnose` to say:

>>> import ballrace as br, numpy as np
>>> fs, orders = 16_000.0, br.frequencies.orders(9, 7.94e-3, 39.04e-3)
>>> since = (np.arange(32_000) / fs) % (1.0 / (orders.bpfo * 30.0))
>>> x = np.exp(-800.0 * since) * np.sin(2 * np.pi * 3000.0 * since)
>>> x += 0.3 * np.random.default_rng(1).normal(size=x.size)
>>> band = kurtogram(x, fs, narrowest=500.0).best
>>> f, value = squared_envelope_spectrum(x, fs, band)
>>> found = fault_band_metrics(f, value, fault_bands(orders, shaft=30.0))
>>> bool(found["outer_race"].level > 20.0)
True
"""

from __future__ import annotations

from .._base.later import listed
from .angular import by_order, order_spectrum, turning
from .bands import FaultBand, FaultMetrics, fault_band_metrics, fault_bands
from .cyclic import cyclic_coherence, improved_envelope_spectrum
from .densities import psd, spectrogram
from .envelopes import (
    envelope_spectrum,
    log_envelope_spectrum,
    squared_envelope,
    squared_envelope_spectrum,
)
from .kurtograms import Kurtogram, kurtogram, spectral_kurtosis
from .lines import comb, floor, line, spectrum
from .pulses import angle_from_pulses, pulse_times
from .separation import separated
from .standard_bands import VelocityBand, bands_iso15242
from .whitening import prewhitened

__all__ = [
    "FaultBand",
    "FaultMetrics",
    "Kurtogram",
    "VelocityBand",
    "angle_from_pulses",
    "bands_iso15242",
    "by_order",
    "comb",
    "cyclic_coherence",
    "envelope_spectrum",
    "fault_band_metrics",
    "fault_bands",
    "floor",
    "improved_envelope_spectrum",
    "kurtogram",
    "line",
    "log_envelope_spectrum",
    "order_spectrum",
    "prewhitened",
    "psd",
    "pulse_times",
    "separated",
    "spectral_kurtosis",
    "spectrogram",
    "spectrum",
    "squared_envelope",
    "squared_envelope_spectrum",
    "turning",
]

__dir__ = listed(__name__)
