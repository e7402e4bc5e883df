"""Pictures whose third dimension is a shade: spectrogram, order map, kurtogram, maps of campaigns."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import spectra
from .._base.libraries import go
from .._base.numbers import real_row
from ..errors import SceneError
from ..recordings.columns import Columns
from ..scene import Scene
from .sources import faults_of, rates_of, row_of, scene_of, source, spin_of
from .style import SYMBOLS, finished

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import ArrayLike, NDArray

    from ..bearings import Bearing
    from ..channel import Channel
    from ..frequencies.operating import FaultFrequencies
    from ..spectra import Kurtogram
    from ..spectra.bands import Fault
    from ..spectra.checks import Given

SHADES = "Cividis"
"""Colours from dark to light for everyone, and on paper."""

_TURNS = 5.0
"""Turns of a window of an order map, at least."""

_CELLS = 600
"""Cells of a map along an axis, at most: what a screen shows."""


def spectrogram(
    of: Given,
    column: str | None = None,
    *,
    fs: float | None = None,
    length: int | None = None,
    fig: go.Figure | None = None,
    **layout: Any,
) -> go.Figure:
    """Draw the power spectral density over time, in decibels below its largest value.

    Parameters
    ----------
    of : Signals, Measurement, Recording, Channel or array_like
        A run, a record, or an array.
    column : str, optional
        Column of it; by default as of :meth:`ballrace.Recording.channel`.
    fs : float, optional
        Sampling rate of an array [Hz].
    length : int, optional
        Samples of a window, as of :func:`ballrace.spectra.spectrogram`.
    fig : plotly.graph_objects.Figure, optional
        Figure to draw into.
    **layout
        For ``fig.update_layout``.

    Raises
    ------
    SceneError
        An argument is not usable.

    Examples
    --------
    >>> import ballrace as br
    >>> fig = br.plot.spectrogram(br.simulate(br.bearing("6205", speed_rpm=1800.0), duration=0.05))
    """
    signal = source(of, column, fs)
    f, t, value = spectra.spectrogram(signal.x, signal.fs, length)
    fig = fig if fig is not None else go.Figure()
    fig.add_trace(_shaded(t + signal.start, f, value, "time %{x:.4f} s, %{y:.0f} Hz: %{z:.1f} dB"))
    fig.update_xaxes(title_text="time / s")
    fig.update_yaxes(title_text="frequency / Hz")
    return finished(fig, layout, height=420)


def order_map(
    of: Given,
    angle: str | ArrayLike = "inner.theta",
    column: str | None = None,
    *,
    per_turn: int | None = None,
    envelope: bool = True,
    band: tuple[float, float] | None = None,
    faults: Iterable[Fault] | None = None,
    rates: FaultFrequencies | None = None,
    bearing: str | Bearing | Scene | None = None,
    row: int | None = None,
    highest: float = 20.0,
    fig: go.Figure | None = None,
    **layout: Any,
) -> go.Figure:
    """Draw orders over the turns of a shaft whose speed changes, with the orders of defects.

    Of a run from rest, or to it, the longest part is drawn in which the shaft has at least a twentieth of its
    highest speed: there no turn has more than 20 times the samples of the fastest. The axis says from when.

    Parameters
    ----------
    of : Signals, Measurement, Recording, Channel or array_like
        A run-up, as a run, a record, or an array.
    angle : str or array_like
        Column of the shaft's angle, or the angle itself [rad]. Of a run whose outer ring turns, that of the inner
        ring is taken against the outer's.
    column : str, optional
        Column of the signal; by default as of :meth:`ballrace.Recording.channel`.
    per_turn : int, optional
        Samples a turn, as of :func:`ballrace.spectra.by_order`; by default enough for ``highest``.
    envelope : bool
        Whether the orders are those of the squared envelope, which shows defects, or of the signal.
    band : tuple of two floats, optional
        Band of the envelope [Hz].
    faults, row
        As of :func:`envelope_spectrum`.
    rates : FaultFrequencies, optional
        Where the orders of defects are from; by default the scene's nominal contact angle.
    bearing : str, Bearing or Scene, optional
        In place of ``rates``, of a measured record: whose orders count.
    highest : float
        Highest order that is shown.
    fig : plotly.graph_objects.Figure, optional
        Figure to draw into.
    **layout
        For ``fig.update_layout``.

    Raises
    ------
    SceneError
        An argument is not usable.

    Examples
    --------
    >>> import ballrace as br
    >>> speed = br.scene.Ramp(from_=60.0, to=180.0, start=0.0, end=0.2)
    >>> scene = br.bearing("6205", speed_rpm=1800.0).replace({"drive": br.scene.SpeedDrive(speed)})
    >>> fig = br.plot.order_map(br.simulate(scene, duration=0.2))
    """
    if not 0.0 < highest < math.inf:
        raise SceneError("highest", str(highest), "an order above 0")
    rate = None if hasattr(of, "fs") else 1.0
    if envelope and band is not None and rate is not None:
        raise SceneError("band", str(band), "None with an array, whose sampling rate is not known")
    signal = source(of, column, rate)
    x = spectra.squared_envelope(signal.x, signal.fs, band) if envelope else signal.x
    turns = real_row("angle", _angle(of, angle) if isinstance(angle, str) else angle)
    turning = spectra.turning(turns) if x.shape == turns.shape else slice(0, None)
    x, turns = x[turning], turns[turning]
    turn, value = spectra.by_order(x, turns, per_turn or math.ceil(2.5 * highest))
    rate_of_turns = 1.0 / float(turn[1])
    # Windows of some turns, or the sidebands of a fault would flow into its line.
    length = max(round((4.0 * value.size) ** 0.5), round(_TURNS * rate_of_turns))
    length = min(length, value.size // 2)
    f, t, power = spectra.spectrogram(value, rate_of_turns, length, max(length // 16, 1))
    shown = f <= highest
    fig = fig if fig is not None else go.Figure()
    fig.add_trace(
        _shaded(t, f[shown], power[shown], "turn %{x:.1f}, order %{y:.2f}: %{z:.1f} dB", 40.0)
    )
    # Between map and bar is room for the names of the lines.
    fig.update_traces(colorbar_xpad=58, selector={"type": "heatmap"})
    if bearing is not None:
        rates = rates_of(of, rates, row or 0, bearing, None if isinstance(bearing, Scene) else 60.0)
    _fault_orders(fig, of, faults=faults, rates=rates, row=row, highest=highest)
    what = "the squared envelope" if envelope else "the signal"
    since = "" if turning.start == 0 else _since(turning.start, signal, rate)
    what_turns = (
        "turns of the shaft"
        if _against(of, angle) is None
        else "turns of the rings against each other"
    )
    fig.update_xaxes(title_text=f"{what_turns}{since}")
    fig.update_yaxes(title_text=f"order of {what} / per turn")
    return finished(fig, layout, height=440)


def _since(first: int, signal: Channel, rate: float | None) -> str:
    """Say from when on the shaft turns: time, or a sample of an array without a rate."""
    if rate is not None:
        return f" from sample {first} on, where it has a twentieth of its highest speed"
    return f" from {signal.start + first / signal.fs:.4g} s on, where it has a twentieth of its highest speed"


def _fault_orders(
    fig: go.Figure,
    of: object,
    *,
    faults: Iterable[Fault] | None,
    rates: FaultFrequencies | None,
    row: int | None,
    highest: float,
) -> None:
    """Draw a line for each harmonic of each fault; orders do not change as the speed does."""
    from ..frequencies.operating import rates_at_a_turn
    from ..spectra import fault_bands

    scene = scene_of(of)
    row = row_of(of) if row is None else row
    if rates is None and scene is None:
        return
    if rates is None:
        assert scene is not None
        rates = rates_at_a_turn(scene, row, operating=False)
    chosen = faults_of(of, faults, row)
    for band in fault_bands(rates.orders, sidebands=0, spin=spin_of(of, rates, row)):
        if band.fault in chosen and band.centre <= highest:
            _, colour, dash, _ = SYMBOLS[band.fault]
            fig.add_hline(
                y=band.centre, line={"color": "white", "dash": dash, "width": 1.2},
                annotation={"text": band.label, "font": {"color": colour, "size": 11}, "x": 1.0,
                            "xanchor": "left", "yanchor": "middle", "bgcolor": "white"},
            )  # fmt: skip


def _angle(of: object, column: str) -> ArrayLike:
    """Return an angle of a run or a recording; where the outer ring turns, that of the inner ring against it."""
    if not isinstance(of, Columns):
        raise SceneError(
            "angle", repr(column), "the shaft's angle [rad]: the signal has no columns"
        )
    found: ArrayLike = of[column]
    against = _against(of, column)
    if against is None:
        return found
    return against if against[-1] >= against[0] else -against


def _against(of: object, angle: str | ArrayLike) -> NDArray[np.float64] | None:
    """Return the angle of the inner ring against the outer [rad]; None where that of the shaft alone is meant."""
    scene = scene_of(of)
    if (
        scene is None
        or scene.outer_speed is None
        or not isinstance(angle, str)
        or angle != "inner.theta"
    ):
        return None
    assert isinstance(of, Columns)
    found: NDArray[np.float64] = np.asarray(of["inner.theta"]) - np.asarray(of["outer.theta"])
    return found


def kurtogram(
    found: Kurtogram | Given,
    fig: go.Figure | None = None,
    *,
    fs: float | None = None,
    narrowest: float | None = None,
    **layout: Any,
) -> go.Figure:
    """Draw a kurtogram: the kurtosis of bands from all frequencies to the narrowest, and the best of them.

    Parameters
    ----------
    found : Kurtogram, Signals, Measurement, Recording, Channel or array_like
        From :func:`ballrace.spectra.kurtogram`; or a run, a record, or an array.
    fig : plotly.graph_objects.Figure, optional
        Figure to draw into.
    fs, narrowest : float, optional
        Sampling rate of an array, and least width of a band [Hz]; as of that function.
    **layout
        For ``fig.update_layout``.

    Raises
    ------
    SceneError
        An argument is not usable.

    Examples
    --------
    >>> import ballrace as br
    >>> out = br.simulate(br.bearing("6205", speed_rpm=1800.0), duration=0.05)
    >>> found = br.spectra.kurtogram(out["outer.ay"], out.fs, narrowest=1000.0)
    >>> fig = br.plot.kurtogram(found)
    >>> len(fig.data[0].y) == len(set(found.level))
    True
    """
    fig = fig if fig is not None else go.Figure()
    if not isinstance(found, spectra.Kurtogram):
        found = spectra.kurtogram(found, fs, narrowest)
    levels = np.unique(found.level)
    edges = np.unique(np.concatenate([found.low, found.high]).round(6))
    middles = 0.5 * (edges[:-1] + edges[1:])
    z = np.array([_level(found, level, middles) for level in levels])
    widths = [float(found.high[np.argmax(found.level == level)]) for level in levels]
    names = [f"{width:.0f} Hz" for width in widths]
    heatmap = go.Heatmap(
        x=edges, y=list(range(len(levels))), z=z, colorscale=SHADES,
        colorbar={"title": {"text": "kurtosis"}, "thickness": 14},
        hovertemplate="%{x:.0f} Hz: kurtosis %{z:.2f}<extra></extra>",
    )  # fmt: skip
    fig.add_trace(heatmap)
    low, high = found.best
    if found.has_power.any():
        own = found.level[(found.low == low) & (found.high == high)]
        at = int(np.searchsorted(levels, own[0]))
        fig.add_shape(
            type="rect", x0=low, x1=high, y0=at - 0.5, y1=at + 0.5, line={"color": "#c8452f", "width": 3}
        )  # fmt: skip
        text = f"best band: {low:.0f} to {high:.0f} Hz,<br>kurtosis {found.highest:.2f}"
    else:
        text = "no band has power:<br>the signal is constant"
    fig.add_annotation(
        text=text, x=0.0, y=1.02, xref="x domain", yref="y domain", xanchor="left", yanchor="bottom",
        align="left", showarrow=False,
    )  # fmt: skip
    fig.update_xaxes(title_text="frequency / Hz")
    fig.update_yaxes(title_text="width of the bands", tickvals=list(range(len(levels))),
                     ticktext=names, autorange="reversed")  # fmt: skip
    return finished(fig, layout, height=430, margin={"t": 52 + 24 * ("title" in layout)})


def _level(found: Kurtogram, level: float, at: NDArray[np.float64]) -> NDArray[np.float64]:
    own = found.level == level
    place = np.searchsorted(found.low[own], at, side="right") - 1
    kurtosis: NDArray[np.float64] = found.kurtosis[own][place]
    return kurtosis


def _shaded(
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    power: NDArray[np.float64],
    hover: str,
    span: float = 60.0,
) -> Any:
    """Return a heat map in decibels down to ``-span``, with no more cells than a screen shows."""
    x, power = x[:: _step(x.size)], power[:, :: _step(x.size)]
    every = _step(y.size)
    if every > 1:  # the largest of neighbours, so that no line is lost
        kept = y.size // every * every
        power = power[:kept].reshape(-1, every, power.shape[1]).max(axis=1)
        y = y[:kept].reshape(-1, every).mean(axis=1)
    largest = float(power.max(initial=0.0)) or 1.0
    level = 10.0 * np.log10(np.maximum(power / largest, 10.0 ** (-0.1 * span)))
    return go.Heatmap(
        x=x, y=y, z=level.astype(np.float32), colorscale=SHADES, zmin=-span, zmax=0.0,
        colorbar={"title": {"text": "dB"}, "thickness": 14}, hovertemplate=hover + "<extra></extra>",
    )  # fmt: skip


def _step(size: int) -> int:
    return max(1, size // _CELLS)
