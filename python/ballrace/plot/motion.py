"""Paths of bodies: the orbit of the shaft, and a ball over a defect."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from .._base.libraries import go
from ..errors import SceneError
from ..scene import MotionProbe
from ..scene.defect import widest
from .decimation import min_max
from .outlines import race_radius
from .sources import check_columns, check_run
from .style import COLOURS, DASHES, finished

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..recordings.columns import Columns
    from ..signals import Signals

    Array = NDArray[np.float64]

_LONGEST = 10_000
"""Samples of an orbit that are drawn; of more, one could see no path."""


def orbit(
    out: Columns,
    *,
    relative: bool = True,
    skip: float = 0.0,
    fig: go.Figure | None = None,
    **layout: Any,
) -> go.Figure:
    """Draw the orbit: the path of the shaft's centre in the plane of the bearing.

    Every sample is drawn, of a long run those of its end.

    Parameters
    ----------
    out : Signals or Recording
        A run, or a record, with the columns ``inner.x`` and ``inner.y``.
    relative : bool
        Whether it is relative to the outer ring's centre, if that was recorded.
    skip : float
        Beginning of the run that is left out [s].
    fig : plotly.graph_objects.Figure, optional
        Figure to draw into.
    **layout
        For ``fig.update_layout``.

    Raises
    ------
    SceneError
        ``out`` is neither a run nor a record, a column was not recorded, or nothing is left after ``skip``.

    Examples
    --------
    >>> import ballrace as br
    >>> fig = br.plot.orbit(br.simulate(br.bearing("6205", speed_rpm=1800.0), duration=0.02))
    """
    check_columns(out, "out")
    kept = out.t >= skip
    if not kept.any():
        raise SceneError("skip", str(skip), f"less than the run's {out.t[-1]:g} s")
    x, y = (_recorded(out, "inner", axis)[kept] for axis in "xy")
    seen = relative and "outer.x" in out and "outer.y" in out
    if seen:
        x, y = x - out["outer.x"][kept], y - out["outer.y"][kept]
    x, y = x[-_LONGEST:], y[-_LONGEST:]
    part = f", last {x.size / out.fs:.3g} s" if x.size < kept.sum() else ""
    fig = fig if fig is not None else go.Figure()
    line = {"color": COLOURS[0], "width": 1, "shape": "spline"}
    path = go.Scatter(
        x=1e6 * x, y=1e6 * y, mode="lines", line=line, name=f"path of the shaft's centre{part}"
    )
    start = go.Scatter(
        x=[1e6 * x[0]], y=[1e6 * y[0]], mode="markers", name="start",
        marker={"symbol": "diamond", "size": 10, "color": COLOURS[1]},
    )  # fmt: skip
    fig.add_traces([path, start])
    where = " from the outer ring's centre" if seen else ""
    fig.update_xaxes(title_text=f"horizontal{where} / µm")
    fig.update_yaxes(title_text=f"vertical{where} / µm", scaleanchor="x")
    return finished(fig, layout, height=460, showlegend=True)


def ball_path(
    out: Signals,
    defect: str | None = None,
    *,
    reach: float = 3.0,
    fig: go.Figure | None = None,
    **layout: Any,
) -> go.Figure:
    """Draw how far balls dip into a defect of a race as they pass it, a line a pass.

    Parameters
    ----------
    out : Signals
        A run with the motion of a ball of the row (``MotionProbe(body="row0.ball3", components=("x", "y"))``, any
        number of them), and of the ring if it moves.
    defect : str, optional
        Name of the defect; by default the first on a race.
    reach : float
        Range that is shown to either side, in widths of the defect.
    fig : plotly.graph_objects.Figure, optional
        Figure to draw into.
    **layout
        For ``fig.update_layout``.

    Raises
    ------
    SceneError
        ``out`` is no run, there is no such defect on a race, no ball was recorded, or none passed it.

    Examples
    --------
    >>> import ballrace as br
    >>> ball = br.scene.MotionProbe(body="row0.ball0", components=("x", "y"))
    >>> scene = br.bearing("6205", defects=br.defects.spall(on="outer_race", width_mm=1.0), speed_rpm=1800.0)
    >>> out = br.simulate(scene.replace({"probes.ball": ball}), duration=0.1)
    >>> fig = br.plot.ball_path(out)
    """
    check_run(out)
    name, race, width, radius = _chosen(out, defect)
    fig = fig if fig is not None else go.Figure()
    for ball, (arc, height) in _relative(out, name, race, radius).items():
        for start, stop in _passes(arc, reach * width):
            _pass(fig, arc[start:stop], height[start:stop], f"{ball}, {1e3 * out.t[start]:.1f} ms")
    if not fig.data:
        raise SceneError("out", f"{out.n_samples} samples", "a run in which a recorded ball passes")
    for edge in (-0.5e3 * width, 0.5e3 * width):
        fig.add_vline(x=edge, line={"color": COLOURS[1], "dash": "dash", "width": 1.5})
    fig.add_annotation(x=0.0, y=1.0, yref="y domain", yanchor="bottom", showarrow=False,
                       text=f"{name}, {1e3 * width:.2f} mm wide", font={"color": COLOURS[1]})  # fmt: skip
    fig.update_xaxes(title_text="along the race from the defect's middle / mm")
    fig.update_yaxes(title_text="ball's centre towards the race / µm")
    return finished(fig, layout, height=420, showlegend=True)


def _pass(fig: go.Figure, arc: Array, height: Array, name: str) -> None:
    number = len(fig.data) % len(COLOURS)
    ends = 0.5 * (height[0] + height[-1])
    x, y = min_max(1e3 * arc, 1e6 * (height - ends), 2000)
    fig.add_trace(
        go.Scatter(
            x=x, y=y, mode="lines", name=name,
            line={"color": COLOURS[number], "dash": DASHES[number], "width": 1.5},
        )
    )  # fmt: skip


def _chosen(
    out: Signals, defect: str | None
) -> tuple[str, Literal["outer", "inner"], float, float]:
    """Return a defect's name, race and width [m], and the radius of the race [m]."""
    scene = out.scene
    races = {name: d for name, d in scene.defects.items() if d.on != "ball"}
    name = defect if defect is not None else next(iter(races), None)
    if name not in races:
        known = ", ".join(races) or "none here"
        raise SceneError("defect", repr(defect), f"a defect of a race: {known}")
    found = races[name]
    race: Literal["outer", "inner"] = "outer" if found.on == "outer_race" else "inner"
    return name, race, widest(found), race_radius(scene.rows[found.row], race)


def _relative(
    out: Signals, name: str, race: Literal["outer", "inner"], radius: float
) -> dict[str, tuple[Array, Array]]:
    """Return of each recorded ball its arc from the defect and its height towards the race [m]."""
    defect = out.scene.defects[name]
    ring = {axis: _column(out, race, axis) for axis in ("x", "y", "theta")}
    found = {}
    for probe, kind in out.scene.probes.items():
        of_row = isinstance(kind, MotionProbe) and kind.body.startswith(f"row{defect.row}.ball")
        if not (of_row and f"{probe}.x" in out and f"{probe}.y" in out):
            continue
        x, y = out[f"{probe}.x"] - ring["x"], out[f"{probe}.y"] - ring["y"]
        angle = np.arctan2(y, x) - ring["theta"] - defect.angle
        outward = 1.0 if race == "outer" else -1.0
        found[kind.body.rpartition(".")[2].replace("ball", "ball ")] = (  # type: ignore[union-attr]
            radius * np.angle(np.exp(1j * angle)),
            outward * np.hypot(x, y),
        )
    if not found:
        allowed = f'a run with MotionProbe(body="row{defect.row}.ball0", components=("x", "y"))'
        raise SceneError("out", "no ball of the row recorded", allowed)
    return found


def _passes(arc: Array, reach: float) -> list[tuple[int, int]]:
    """Return where a ball is within reach, first sample and the one after the last of each whole pass."""
    near = np.concatenate([[False], np.abs(arc) < reach, [False]])
    edges = np.flatnonzero(near[1:] != near[:-1]).reshape(-1, 2)
    whole = [(a, b) for a, b in edges if a > 0 and b < arc.size and arc[a] * arc[b - 1] < 0.0]
    return [(int(a), int(b)) for a, b in whole]


def _recorded(out: Columns, body: str, axis: str) -> Array:
    if f"{body}.{axis}" not in out:
        raise SceneError(
            "out", f"no column {body}.{axis}", f'a run with MotionProbe(body="{body}")'
        )
    return out[f"{body}.{axis}"]


def _column(out: Signals, body: str, axis: str) -> Array | float:
    return out.get(f"{body}.{axis}", 0.0)
