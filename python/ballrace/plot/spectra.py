"""Spectra with the lines of defects drawn and named."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .. import spectra
from .._base.libraries import go
from ..errors import SceneError
from .lines import add_lines
from .sources import faults_of, rates_of, row_of, source, spin_of
from .style import COLOURS, DASHES, finished, title
from .times import fault_rate

if TYPE_CHECKING:
    from collections.abc import Iterable

    import numpy as np
    from numpy.typing import NDArray

    from ..bearings import Bearing
    from ..frequencies.operating import FaultFrequencies
    from ..scene import Scene
    from ..spectra.bands import Fault
    from ..spectra.checks import Given


def envelope_spectrum(
    of: Given,
    column: str | None = None,
    *,
    bearing: str | Bearing | Scene | None = None,
    speed_rpm: float | None = None,
    fs: float | None = None,
    band: tuple[float, float] | None = None,
    squared: bool = True,
    faults: Iterable[Fault] | None = None,
    rates: FaultFrequencies | None = None,
    row: int | None = None,
    harmonics: int = 3,
    sidebands: int = 1,
    limit: float | None = None,
    name: str | None = None,
    fig: go.Figure | None = None,
    **layout: Any,
) -> go.Figure:
    """Draw the spectrum of an envelope with the lines that defects may have: k·BPFO, k·BPFI ± f_r, 2k·BSF ± FTF.

    In a run whose balls spin about the axis only, the lines of a ball's defect are k·BSF/cos α, or twice that
    where it reaches both tracks (:func:`ballrace.frequencies.operating.spin_of`).

    Parameters
    ----------
    of : Signals, Measurement, Recording, Channel or array_like
        A run, a record, or an array.
    column : str, optional
        Column of it; by default as of :meth:`ballrace.Recording.channel`.
    fs : float, optional
        Sampling rate of an array [Hz].
    band : tuple of two floats, optional
        Band of the envelope [Hz], such as ``br.spectra.kurtogram(x, fs).best``; by default all frequencies.
    squared : bool
        Whether the squared envelope is taken, as of :func:`ballrace.spectra.envelope_spectrum`.
    faults : iterable of {"outer_race", "inner_race", "ball", "cage"}, optional
        Whose lines are drawn; by default those that the scene has, else of both races and a ball.
    rates : FaultFrequencies, optional
        Fault frequencies, from :func:`ballrace.fault_frequencies`; by default those of the run's scene at its
        operating contact angle. Without any no lines are drawn.
    bearing : str, Bearing or Scene, optional
        In place of ``rates``, of a measured record: whose fault frequencies count.
    speed_rpm : float, optional
        Speed of its inner ring [1/min]; by default that of the record.
    row : int, optional
        Row of balls whose frequencies count; by default that of the first defect.
    harmonics, sidebands : int
        How many multiples of each fault frequency, and lines to either side.
    limit : float, optional
        Highest frequency that is shown [Hz]; by default somewhat above the highest line.
    name : str, optional
        Name in the legend, for several spectra in one figure.
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
    >>> scene = br.bearing("6205", defects=br.defects.spall(on="inner_race", width_mm=1.0), speed_rpm=1800.0)
    >>> fig = br.plot.envelope_spectrum(br.simulate(scene, duration=0.1), harmonics=2)
    >>> [a.text for a in fig.layout.annotations][:3]
    ['BPFI − f<sub>r</sub>', 'BPFI', 'BPFI + f<sub>r</sub>']
    """
    signal = source(of, column, fs)
    row = row_of(of) if row is None else row
    found = rates_of(of, rates, row, bearing, speed_rpm)
    chosen = faults_of(of, faults, row) if found is not None else ()
    f, value = spectra.envelope_spectrum(signal.x, signal.fs, band, squared)
    spin = spin_of(of, found, row)
    end = _limit(limit, f, found, chosen, harmonics, spin=spin)
    shown = (f > 0.0) & (f <= end)
    fig = fig if fig is not None else go.Figure()
    what = "squared envelope" if squared else "envelope"
    # Fault lines, which have markers, are no spectra.
    kind = sum(trace.mode == "lines" for trace in fig.data) % len(COLOURS)
    style = {"color": COLOURS[kind], "dash": DASHES[kind], "width": 1.4}
    fig.add_trace(
        go.Scatter(x=f[shown], y=value[shown], name=name or what, mode="lines", line=style)
    )
    if found is not None:
        top = 1.05 * float(value[shown].max(initial=0.0)) or 1.0
        lines = spectra.fault_bands(
            found.orders, found.shaft, harmonics=harmonics, sidebands=sidebands, spin=spin
        )
        add_lines(fig, [one for one in lines if one.fault in chosen and one.centre <= end], top)
    square = {True: f"({signal.unit})²", False: signal.unit}[squared] if signal.unit else ""
    fig.update_xaxes(title_text="frequency / Hz", range=[0.0, end])
    fig.update_yaxes(title_text=title(f"line of the {what}", square), rangemode="tozero")
    return finished(
        fig, layout, height=440, showlegend=True, margin={"t": 130 if "title" in layout else 100}
    )


def _limit(
    limit: float | None,
    f: NDArray[np.float64],
    rates: FaultFrequencies | None,
    faults: tuple[Fault, ...],
    harmonics: int,
    *,
    spin: tuple[float, int] | None,
) -> float:
    if limit is not None:
        if not limit > 0.0:
            raise SceneError("limit", str(limit), "a frequency above 0 [Hz]")
        return min(limit, float(f[-1]))
    if rates is None or not faults:
        return float(f[-1])
    highest = max(fault_rate(rates, fault, spin) for fault in faults)
    return min((harmonics + 0.5) * highest, float(f[-1]))


def psd(
    of: Given,
    column: str | None = None,
    *,
    fs: float | None = None,
    length: int | None = None,
    band: tuple[float, float] | None = None,
    fig: go.Figure | None = None,
    **layout: Any,
) -> go.Figure:
    """Draw the power spectral density of a signal.

    Parameters
    ----------
    of, column, fs
        As for :func:`envelope_spectrum`.
    length : int, optional
        Samples of a window, as of :func:`ballrace.spectra.psd`.
    band : tuple of two floats, optional
        A band that is shaded [Hz], such as that of an envelope.
    fig : plotly.graph_objects.Figure, optional
        Figure to draw into.
    **layout
        For ``fig.update_layout``.

    Examples
    --------
    >>> import ballrace as br
    >>> fig = br.plot.psd(br.simulate(br.bearing("6205", speed_rpm=1800.0), duration=0.02), "outer.ay")
    """
    signal = source(of, column, fs)
    f, value = spectra.psd(signal.x, signal.fs, length)
    fig = fig if fig is not None else go.Figure()
    style = {"color": COLOURS[0], "width": 1.2}
    fig.add_trace(go.Scatter(x=f[1:], y=value[1:], name=signal.name, mode="lines", line=style))
    if band is not None:
        fig.add_vrect(x0=band[0], x1=band[1], fillcolor=COLOURS[1], opacity=0.12, line_width=0,
                      annotation_text="band of the envelope", annotation_position="top left")  # fmt: skip
    square = f"({signal.unit})²/Hz" if signal.unit else "1/Hz"
    fig.update_xaxes(title_text="frequency / Hz")
    fig.update_yaxes(
        title_text=f"power spectral density / {square}", type="log", exponentformat="power"
    )
    return finished(fig, layout, height=360, showlegend=False)
