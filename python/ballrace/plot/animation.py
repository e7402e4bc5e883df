"""The bearing in motion: front view, section, and the signal running below."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .._base.libraries import go
from ..channel import default_column
from ..errors import SceneError
from ..scene import ContactsProbe, MotionProbe, StructureProbe
from .decimation import min_max
from .moving import Moving
from .outlines import outlines
from .sources import check_run, source
from .style import COLOURS, finished, title

if TYPE_CHECKING:
    from ..scene import Probe, Scene
    from ..signals import Signals


def probes(scene: Scene) -> dict[str, Probe]:
    """Return the probes that a run needs for :func:`animation`: the motion of all bodies, and all loads.

    Examples
    --------
    >>> import ballrace as br
    >>> scene = br.bearing("6205", speed_rpm=1800.0)
    >>> ready = scene.replace({"probes": br.plot.probes(scene)})
    """
    found: dict[str, Probe] = {ring: MotionProbe(body=ring) for ring in ("outer", "inner")}
    for number, row in enumerate(scene.rows):
        found[f"row{number}"] = ContactsProbe(row=number, quantities=("load",))
        for ball in range(row.ball_count):
            found[f"row{number}_ball{ball}"] = MotionProbe(
                body=f"row{number}.ball{ball}", components=("x", "y", "z", "theta")
            )
    if scene.structure is not None and scene.structure.sensors:
        found["housing"] = StructureProbe()
    return found


def animation(
    out: Signals,
    column: str | None = None,
    *,
    row: int = 0,
    start: float = 0.0,
    end: float | None = None,
    frames: int = 90,
    fig: go.Figure | None = None,
    **layout: Any,
) -> go.Figure:
    """Draw a bearing as it runs: a row from the front, the section through the axis, a signal with the time.

    Balls are shaded by their load on the outer race, which bars beyond the race show as well; the cage is drawn
    between the balls, defects turn with what carries them. In the section stand the balls that are nearest to it.
    A page or a notebook shows the first picture until it is told to run.

    Parameters
    ----------
    out : Signals
        A run of a scene with the probes of :func:`probes`.
    column : str, optional
        Column of the signal below; by default as of :meth:`ballrace.Recording.channel`.
    row : int
        Row that is seen from the front.
    start, end : float
        Part of the run that is shown [s]; by default all of it.
    frames : int
        Pictures, 2 to 500.
    fig : plotly.graph_objects.Figure, optional
        A figure of ``make_subplots`` with two rows and two columns, the second row one panel.
    **layout
        For ``fig.update_layout``.

    Raises
    ------
    SceneError
        An argument is not usable, or the run lacks a column.

    Examples
    --------
    >>> import ballrace as br
    >>> scene = br.bearing("6205", speed_rpm=1800.0)
    >>> out = br.simulate(scene.replace({"probes": br.plot.probes(scene)}), duration=0.01)
    >>> fig = br.plot.animation(out, frames=20)
    >>> len(fig.frames)
    20
    """
    check_run(out)
    column = default_column(out) if column is None else column
    check(out, column, row, frames)
    shown = samples(out, start, end, frames)
    t = 1e3 * out.t
    moving = Moving(out, row)
    fig = fig if fig is not None else _panels()
    for trace in moving.still():
        fig.add_trace(trace, row=1, col=1)
    for trace in moving.section_still():
        fig.add_trace(trace, row=1, col=2)
    _signal(fig, out, column, shown)
    first = len(fig.data)
    for panel, trace in moving.at(shown[0]):
        fig.add_trace(trace, row=1, col=panel)
    fig.add_trace(_cursor(fig, t[shown[0]]), row=2, col=1)
    places = list(range(first, len(fig.data)))
    fig.frames = [
        go.Frame(
            data=[*(trace for _, trace in moving.at(k)), _cursor(fig, t[k])],
            traces=places,
            name=f"{t[k]:.2f}",
        )
        for k in shown
    ]
    return _finish(fig, out, layout)


def check(out: Signals, column: str, row: int, frames: int) -> None:
    """Refuse what is no run, a row that there is not, too few or many frames, and a run without the columns."""
    check_run(out)
    if not 0 <= row < len(out.scene.rows):
        raise SceneError("row", str(row), f"a row, 0 to {len(out.scene.rows) - 1}")
    if isinstance(frames, bool) or not 2 <= frames <= 500:
        raise SceneError("frames", repr(frames), "2 to 500")
    needed = [column, "inner.theta"]
    if out.scene.outer_speed is not None:
        needed.append("outer.theta")
    for number, of_row in enumerate(out.scene.rows):
        for ball in range(of_row.ball_count):
            needed += [f"row{number}_ball{ball}.{axis}" for axis in ("x", "y", "z", "theta")]
            needed.append(f"row{number}.ball{ball}.outer.load")
    missing = [name for name in needed if name not in out]
    if missing:
        allowed = 'a run of scene.replace({"probes": br.plot.probes(scene)})'
        raise SceneError("out", f"no column {missing[0]}", allowed)


def samples(out: Signals, start: float, end: float | None, frames: int) -> list[int]:
    """Return the samples that are shown."""
    last = float(out.t[-1]) if end is None else end
    if not 0.0 <= start < last:
        raise SceneError("start", str(start), f"from 0 to below the end, {last:g} s")
    low, high = np.searchsorted(out.t, [start, last])
    high = min(int(high), out.n_samples - 1)
    return [int(k) for k in np.unique(np.linspace(low, high, frames).astype(int))]


def _panels() -> go.Figure:
    from .._base.plotly import Paused, make_subplots

    return make_subplots(
        figure=Paused(), rows=2, cols=2, specs=[[{}, {}], [{"colspan": 2}, None]], column_widths=[0.62, 0.38],
        row_heights=[0.72, 0.28], vertical_spacing=0.12, horizontal_spacing=0.04,
        subplot_titles=("front view", "section"),
    )  # fmt: skip


def _signal(fig: go.Figure, out: Signals, column: str, samples: list[int]) -> None:
    signal = source(out, column, None)
    part = slice(samples[0], samples[-1] + 1)
    t, x = min_max(1e3 * out.t[part], signal.x[part])
    line = {"color": COLOURS[0], "width": 1}
    fig.add_trace(go.Scatter(x=t, y=x, mode="lines", line=line, name=signal.name), row=2, col=1)
    rim = 1.1 * float(np.abs(x).max(initial=0.0)) or 1.0
    fig.update_yaxes(
        title_text=title(signal.name.split(",")[0], signal.unit), range=[-rim, rim], row=2, col=1
    )
    fig.update_xaxes(title_text="time / ms", row=2, col=1)


def _cursor(fig: go.Figure, now: float) -> Any:
    low, high = fig.layout.yaxis3.range or (-1.0, 1.0)
    style = {"color": COLOURS[1], "width": 2, "dash": "dash"}
    return go.Scatter(
        x=[float(now), float(now)], y=[low, high], mode="lines", line=style, name="now"
    )


def _finish(fig: go.Figure, out: Signals, layout: dict[str, Any]) -> go.Figure:
    shapes = outlines(out.scene)
    reach = 1.45 * shapes.outside
    half = 0.5 * (shapes.right - shapes.left)
    plain = {"showgrid": False, "zeroline": False}
    fig.update_xaxes(title_text="x / mm", range=[-reach, reach], **plain, row=1, col=1)
    fig.update_yaxes(
        title_text="y / mm", range=[-reach, reach], scaleanchor="x", **plain, row=1, col=1
    )
    fig.update_xaxes(
        title_text="z / mm", range=[shapes.left - half, shapes.right + half], **plain, row=1, col=2
    )
    fig.update_yaxes(
        range=[-reach, reach], scaleanchor="x2", showticklabels=False, **plain, row=1, col=2
    )
    return finished(
        fig, layout, height=760, showlegend=False, margin={"t": 130}, **player(fig, redraw=False)
    )


def player(fig: go.Figure, *, redraw: bool) -> dict[str, Any]:
    """Return the buttons and the slider of a figure's frames, as fields of its layout."""
    run = {
        "frame": {"duration": 60, "redraw": redraw},
        "fromcurrent": True,
        "transition": {"duration": 0},
    }
    stop = {"frame": {"duration": 0, "redraw": redraw}, "mode": "immediate"}
    buttons = [
        {"label": "▶ run", "method": "animate", "args": [None, run]},
        {"label": "❚❚ stop", "method": "animate", "args": [[None], stop]},
    ]
    steps = [{"label": f.name, "method": "animate", "args": [[f.name], stop]} for f in fig.frames]
    own: dict[str, Any] = {
        "updatemenus": [{"type": "buttons", "direction": "left", "buttons": buttons, "x": 0.0, "y": 1.2,
                         "xanchor": "left", "yanchor": "top", "showactive": False}],
        "sliders": [{"steps": steps, "x": 0.0, "len": 1.0, "y": -0.13, "pad": {"t": 8},
                     "currentvalue": {"prefix": "time / ms: "}, "ticklen": 0, "minorticklen": 0,
                     "font": {"color": "rgba(0,0,0,0)"}}],
    }  # fmt: skip
    own["sliders"][0]["currentvalue"]["font"] = {"color": "#222"}
    return own
