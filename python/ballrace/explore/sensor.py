"""A run as a sensor measures it: figures, and sound."""

from __future__ import annotations

import io
import warnings
from typing import TYPE_CHECKING

import numpy as np

from .._base.libraries import scipy
from ..measuring import Chain, Logger, measure

if TYPE_CHECKING:
    import plotly.graph_objects as go

    from ..channel import Channel
    from ..frequencies.operating import FaultFrequencies
    from ..signals import Signals

_FADE = 0.01
"""Time over which a sound rises and falls, so that it does not click [s]."""

_PEAK = 0.9
"""Largest sample of a sound over the full scale."""


def sensed(out: Signals, noise: float = 0.0) -> Channel:
    """Return what a sensor measures, else the outer ring's acceleration, in white noise of an rms [m/s²]."""
    density = noise**2 / (0.5 * out.fs)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return measure(out, Chain(logger=Logger(noise_density=density)), seed=1).channel()


def rates_of(out: Signals) -> FaultFrequencies | None:
    """Return the fault frequencies that a run measured; None where its speed changes."""
    from ..plot.sources import rates_of, row_of

    return rates_of(out, None, row_of(out))


def waveform(channel: Channel, rates: FaultFrequencies | None = None) -> go.Figure:
    """Return the signal over time, with marks where its defects are expected to be hit."""
    from .. import plot

    defects = channel.scene.defects if channel.scene is not None else {}
    return plot.impacts(channel, rates=rates, faults=None if defects else (), height=300)


def envelope(channel: Channel, rates: FaultFrequencies | None = None) -> go.Figure:
    """Return the spectrum of the envelope, with the lines of all parts."""
    from .. import plot

    return plot.envelope_spectrum(channel, rates=rates, name="simulated", height=420)


def orders(channel: Channel, out: Signals) -> go.Figure:
    """Return the map of orders over the turns of the shaft."""
    from .. import plot

    return plot.order_map(channel, out["inner.theta"])


def sound(channel: Channel) -> bytes:
    """Return the signal as WAV of 16 bits, its largest sample near the full scale.

    Its loudness says nothing: the weakest record is as loud as the strongest.
    """
    x = channel.x - channel.x.mean()
    fade = min(round(_FADE * channel.fs), x.size // 2)
    ramp = np.ones(x.size)
    ramp[:fade] = np.linspace(0.0, 1.0, fade)
    ramp[x.size - fade :] = np.linspace(1.0, 0.0, fade)
    x *= ramp
    largest = float(np.abs(x).max(initial=0.0)) or 1.0
    buffer = io.BytesIO()
    samples = np.round(32767.0 * _PEAK * x / largest).astype(np.int16)
    scipy.io.wavfile.write(buffer, round(channel.fs), samples)
    return buffer.getvalue()
