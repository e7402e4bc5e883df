"""Signals over time, and when a defect is expected to be hit."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from .._base.libraries import go
from ..channel import default_column
from ..errors import SceneError
from ..spectra import squared_envelope
from .decimation import min_max
from .sources import check_columns, faults_of, rates_of, row_of, source, spin_of
from .style import COLOURS, DASHES, SYMBOLS, finished, title, unit, words

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from ..bearings import Bearing
    from ..frequencies.operating import FaultFrequencies
    from ..recordings.columns import Columns
    from ..scene import Scene
    from ..spectra.bands import Fault
    from ..spectra.checks import Given

# Beyond this many points the browser is better served by WebGL.
_MANY = 20_000


def signals(
    out: Columns, names: str | Iterable[str], fig: go.Figure | None = None, **layout: Any
) -> go.Figure:
    """Draw columns of a run one below the other, on one time axis.

    Parameters
    ----------
    out : Signals or Recording
        The run, or the record.
    names : str or iterable of str
        A column, or several.
    fig : plotly.graph_objects.Figure, optional
        A figure of ``make_subplots`` with as many rows as there are names.
    **layout
        For ``fig.update_layout``.

    Examples
    --------
    >>> import ballrace as br
    >>> out = br.simulate(br.bearing("6205", speed_rpm=1800.0), duration=0.002)
    >>> fig = br.plot.signals(out, ["outer.ax", "outer.ay"], title="A run")

    Raises
    ------
    SceneError
        ``out`` is neither a run nor a record.
    KeyError
        There is no such column.
    """
    check_columns(out, "out")
    names = (names,) if isinstance(names, str) else tuple(names)
    fig = _stacked(fig, [(words(name), out, name) for name in names])
    return finish_stack(fig, len(names), layout)


def load_cases(
    cases: Mapping[str, Columns],
    name: str | None = None,
    *,
    bpfo: float | None = None,
    fig: go.Figure | None = None,
    **layout: Any,
) -> go.Figure:
    """Draw one column of several runs or records one below the other, with common scales.

    Parameters
    ----------
    cases : mapping of str to Signals or Recording
        Runs or records by the title of their panel.
    name : str, optional
        Column; by default as of :meth:`ballrace.Recording.channel`.
    bpfo : float, optional
        Frequency of the balls passing a place of the outer race [Hz]: draws grid lines one passage apart.
    fig : plotly.graph_objects.Figure, optional
        A figure of ``make_subplots`` with as many rows as there are cases.
    **layout
        For ``fig.update_layout``.

    Raises
    ------
    SceneError
        ``cases`` holds anything else.
    KeyError
        There is no such column.
    """
    _check_cases(cases)
    fig = _stacked(fig, [(label, out, name or default_column(out)) for label, out in cases.items()])
    share_scale(fig, len(cases))
    if bpfo is not None:
        passage = {
            "dtick": 1.0 / bpfo,
            "showgrid": True,
            "griddash": "dot",
            "gridcolor": "#b8b8b8",
        }
        fig.update_xaxes(minor=passage)
    return finish_stack(fig, len(cases), layout)


def _check_cases(cases: object) -> None:
    if not isinstance(cases, Mapping):
        allowed = "runs by the titles of panels, a dict"
        raise SceneError("cases", f"a {type(cases).__name__}", allowed)
    for label, out in cases.items():
        check_columns(out, f"cases[{label!r}]")


_MARKS = 100
"""Marks of hits in a picture, at most: more would merge into a bar."""


def impacts(
    of: Given,
    column: str | None = None,
    *,
    fs: float | None = None,
    faults: Iterable[Fault] | None = None,
    rates: FaultFrequencies | None = None,
    bearing: str | Bearing | Scene | None = None,
    speed_rpm: float | None = None,
    row: int | None = None,
    band: tuple[float, float] | None = None,
    fig: go.Figure | None = None,
    **layout: Any,
) -> go.Figure:
    """Draw a signal over time with marks where a defect is expected to be hit.

    The marks stand one period of the fault frequency apart. Where the first one stands is taken from the signal:
    there the oscillation of its squared envelope at that frequency is highest.

    Parameters
    ----------
    of : Signals, Measurement, Recording, Channel or array_like
        A run, a record, or an array.
    column : str, optional
        Column of it; by default as of :meth:`ballrace.Recording.channel`.
    fs : float, optional
        Sampling rate of an array [Hz].
    faults : iterable of {"outer_race", "inner_race", "ball", "cage"}, optional
        Whose hits are marked; by default those that the scene has, else of both races and a ball.
    rates : FaultFrequencies, optional
        Fault frequencies; by default those of the run's scene at its operating contact angle.
    bearing : str, Bearing or Scene, optional
        In place of ``rates``, of a measured record: whose fault frequencies count.
    speed_rpm : float, optional
        Speed of its inner ring [1/min]; by default that of the record.
    row : int, optional
        Row of balls whose frequencies count; by default that of the first defect.
    band : tuple of two floats, optional
        Band of the envelope [Hz].
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
    >>> scene = br.bearing("6205", defects=br.defects.spall(on="outer_race", width_mm=1.0), speed_rpm=1800.0)
    >>> fig = br.plot.impacts(br.simulate(scene, duration=0.03))
    >>> [trace.name for trace in fig.data]
    ['vertical acceleration, housing sensor', 'BPFO, 107.7 Hz']
    """
    signal = source(of, column, fs)
    row = row_of(of) if row is None else row
    found = rates_of(of, rates, row, bearing, speed_rpm)
    if found is None and (rates is not None or faults is not None):
        raise SceneError("rates", "None", "fault frequencies, from ballrace.fault_frequencies")
    fig = fig if fig is not None else go.Figure()
    fig.add_trace(_line(signal.t, signal.x, signal.name, 0))
    top = 1.12 * float(np.abs(signal.x).max(initial=0.0)) or 1.0
    for fault in faults_of(of, faults, row) if found is not None else ():
        name, colour, _, marker = SYMBOLS[fault]
        rate = fault_rate(found, fault, spin_of(of, found, row))  # type: ignore[arg-type]
        at = signal.start + _hits(signal.x, signal.fs, rate, band)
        every = math.ceil(at.size / _MARKS)
        at = at[::every]
        # So small that those of neighbours do not meet on a phone.
        mark = {"symbol": marker, "size": min(9.0, max(3.0, 200.0 / at.size)), "color": colour}
        thinned = f", every {every} hits" if every > 1 else ""
        trace = go.Scatter(
            x=at, y=np.full(at.size, top), mode="markers", marker=mark, name=f"{name}, {rate:.1f} Hz{thinned}",
            hovertemplate="a hit is expected at %{x:.4f} s",
        )  # fmt: skip
        fig.add_trace(trace)
    fig.update_xaxes(title_text="time / s")
    fig.update_yaxes(title_text=title(signal.name, signal.unit))
    return finished(fig, layout, height=380, showlegend=True)


def fault_rate(
    rates: FaultFrequencies, fault: Fault, spin: tuple[float, int] | None = None
) -> float:
    """Return the frequency at which a defect is hit [Hz]: a ball's twice a turn of its spin, or as a run's are."""
    order, hits = (rates.orders.bsf, 2) if spin is None else spin
    of: dict[Fault, float] = {
        "outer_race": rates.bpfo,
        "inner_race": rates.bpfi,
        "ball": hits * order * rates.shaft,
        "cage": rates.ftf,
    }
    return of[fault]


def _hits(
    x: NDArray[np.float64], fs: float, rate: float, band: tuple[float, float] | None
) -> NDArray[np.float64]:
    """Return the times of hits from the first sample on, their phase as the squared envelope has it."""
    squared = squared_envelope(x, fs, band)
    t = np.arange(x.size) / fs
    phase = np.angle(np.sum((squared - squared.mean()) * np.exp(-2j * np.pi * rate * t)))
    first = (-phase / (2.0 * np.pi)) % 1.0 / rate
    return np.arange(first, x.size / fs, 1.0 / rate)


def stack(titles: tuple[str, ...]) -> go.Figure:
    """Return panels one below the other, on one axis."""
    from .._base.plotly import make_subplots

    gap = min(0.08, 0.3 / len(titles)) if titles else 0.0
    return make_subplots(
        rows=max(len(titles), 1),
        cols=1,
        shared_xaxes=True,
        vertical_spacing=gap,
        subplot_titles=titles,
    )


def _stacked(fig: go.Figure | None, panels: list[tuple[str, Columns, str]]) -> go.Figure:
    """Draw a column of a record in each panel of a stack, under its title."""
    fig = fig if fig is not None else stack(tuple(label for label, _, _ in panels))
    for place, (label, out, name) in enumerate(panels, start=1):
        fig.add_trace(_line(out.t, out[name], label, place - 1), row=place, col=1)
        fig.update_yaxes(title_text=unit(out.units[name]), row=place, col=1)
    return fig


def share_scale(fig: go.Figure, rows: int) -> None:
    """Give the panels of a stack the scale of the first; that of itself it must not be asked to match."""
    for place in range(2, rows + 1):
        fig.update_yaxes(matches="y", row=place, col=1)


def finish_stack(
    fig: go.Figure, rows: int, layout: dict[str, Any], axis: str = "time / s"
) -> go.Figure:
    """Give panels one below the other a title of their axis, and a height."""
    fig.update_xaxes(title_text=axis, row=max(rows, 1), col=1)
    return finished(fig, layout, showlegend=False, height=120 + 200 * max(rows, 1))


def _line(t: NDArray[np.float64], values: NDArray[np.float64], name: str, place: int) -> Any:
    t, values = min_max(t, values, _MANY)
    style = {"color": COLOURS[place % len(COLOURS)], "width": 1, "dash": DASHES[0]}
    return go.Scatter(x=t, y=values, name=name, mode="lines", line=style)
