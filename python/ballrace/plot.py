"""Pictures, by plotly: ``pip install "ballrace[plot]"``.

Each function draws into ``fig`` if one is given, passes ``layout`` on to ``fig.update_layout``, and returns
the figure.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .statics import Equilibrium

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    import plotly.graph_objects as go
    from numpy.typing import NDArray

    from .paper.case import Balls
    from .signals import Signals

__all__ = ["force_distribution", "load_cases", "load_distribution", "signals", "slice_forces"]

_COLOURS = ("#1f6fb4", "#c8452f", "#3a8f4a", "#7a53a6", "#c98a16", "#3c9aa3")
# Beyond this many points the browser is better served by WebGL.
_MANY = 20_000


def signals(
    out: Signals, names: str | Iterable[str], fig: go.Figure | None = None, **layout: Any
) -> go.Figure:
    """Draw columns of a run one below the other, on one time axis.

    Parameters
    ----------
    out : Signals
        The run.
    names : str or iterable of str
        A column, or several.
    fig : plotly.graph_objects.Figure, optional
        A figure of ``make_subplots`` with as many rows as there are names.
    **layout
        For ``fig.update_layout``.
    """
    names = (names,) if isinstance(names, str) else tuple(names)
    fig = fig if fig is not None else _stack(names)
    for place, name in enumerate(names, start=1):
        fig.add_trace(_line(out.t, out[name], name, place - 1), row=place, col=1)
        fig.update_yaxes(title_text=_unit(out.units[name]), row=place, col=1)
    return _finish_stack(fig, len(names), layout)


def load_cases(
    cases: Mapping[str, Signals],
    name: str = "outer.ay",
    *,
    bpfo: float | None = None,
    fig: go.Figure | None = None,
    **layout: Any,
) -> go.Figure:
    """Draw one column of several runs one below the other, with common scales.

    Parameters
    ----------
    cases : mapping of str to Signals
        Runs by the title of their panel.
    name : str
        Column.
    bpfo : float, optional
        Frequency of the balls passing a place of the outer race [Hz]: draws grid lines one passage apart.
    fig : plotly.graph_objects.Figure, optional
        A figure of ``make_subplots`` with as many rows as there are cases.
    **layout
        For ``fig.update_layout``.
    """
    fig = fig if fig is not None else _stack(tuple(cases))
    for place, (label, out) in enumerate(cases.items(), start=1):
        fig.add_trace(_line(out.t, out[name], label, place - 1), row=place, col=1)
        fig.update_yaxes(title_text=f"{name} / {_unit(out.units[name])}", row=place, col=1)
    fig.update_yaxes(matches="y")
    if bpfo is not None:
        passage = {
            "dtick": 1.0 / bpfo,
            "showgrid": True,
            "griddash": "dot",
            "gridcolor": "#b8b8b8",
        }
        fig.update_xaxes(minor=passage)
    return _finish_stack(fig, len(cases), layout)


def load_distribution(
    equilibria: Equilibrium | Mapping[str, Equilibrium],
    fig: go.Figure | None = None,
    **layout: Any,
) -> go.Figure:
    """Draw the load of each ball on the outer race against the ball's place, a line per row.

    Parameters
    ----------
    equilibria : Equilibrium or mapping of str to Equilibrium
        One solution, or several by the title of their panel, which stand side by side with common scales.
    fig : plotly.graph_objects.Figure, optional
        A figure of ``make_subplots`` with as many polar columns as there are solutions.
    **layout
        For ``fig.update_layout``.
    """
    from plotly.graph_objects import Scatterpolar
    from plotly.subplots import make_subplots

    cases = {"": equilibria} if isinstance(equilibria, Equilibrium) else dict(equilibria)
    if fig is None:
        specs = [[{"type": "polar"} for _ in cases]]
        fig = make_subplots(rows=1, cols=len(cases), specs=specs, subplot_titles=tuple(cases))
        fig.update_annotations(yshift=18)  # clear of the label at 90°
    for place, eq in enumerate(cases.values(), start=1):
        for row in np.unique(eq.row):
            of_row = np.flatnonzero(eq.row == row)
            around = np.append(of_row, of_row[0])
            trace = Scatterpolar(
                theta=np.degrees(eq.angle[around]),
                r=eq.outer_load[around],
                name=f"row {row}",
                legendgroup=f"row {row}",
                showlegend=place == 1,
                mode="lines+markers",
                line={"color": _COLOURS[row % len(_COLOURS)]},
                hovertemplate="ball at %{theta:.1f}°: %{r:.0f} N",
            )
            fig.add_trace(trace, row=1, col=place)
    largest = max((float(eq.outer_load.max()) for eq in cases.values()), default=0.0)
    fig.update_polars(
        radialaxis={"range": [0.0, 1.1 * largest or 1.0], "ticksuffix": " N", "angle": 90}
    )
    return fig.update_layout({"template": "plotly_white", "margin": {"t": 80}, **layout})


def force_distribution(
    balls: Balls, *, largest: float | None = None, fig: go.Figure | None = None, **layout: Any
) -> go.Figure:
    """Draw the normal forces of all balls on both races, a polar panel per row.

    Parameters
    ----------
    balls : Balls
        The balls at one instant.
    largest : float, optional
        Force at the rim of the panels [N], for a scale common to several figures.
    fig : plotly.graph_objects.Figure, optional
        A figure of ``make_subplots`` with as many polar columns as there are rows of balls.
    **layout
        For ``fig.update_layout``.
    """
    from plotly.graph_objects import Scatterpolar
    from plotly.subplots import make_subplots

    numbers = np.unique(balls.row)
    if fig is None:
        specs = [[{"type": "polar"} for _ in numbers]]
        titles = tuple(f"row {row}" for row in numbers)
        fig = make_subplots(rows=1, cols=numbers.size, specs=specs, subplot_titles=titles)
        fig.update_annotations(yshift=18)  # clear of the label at 90°
    races = {"outer race": balls.outer_load, "inner race": balls.inner_load}
    for place, row in enumerate(numbers, start=1):
        of_row = np.flatnonzero(balls.row == row)
        around = np.append(of_row, of_row[0])
        for (race, load), colour in zip(races.items(), _COLOURS, strict=False):
            trace = Scatterpolar(
                theta=np.degrees(balls.angle[around]),
                r=load[around],
                name=race,
                legendgroup=race,
                showlegend=place == 1,
                mode="lines+markers",
                line={"color": colour},
                hovertemplate="ball at %{theta:.1f}°: %{r:.0f} N",
            )
            fig.add_trace(trace, row=1, col=place)
    rim = largest or max(float(load.max()) for load in races.values()) or 1.0
    fig.update_polars(radialaxis={"range": [0.0, 1.1 * rim], "ticksuffix": " N", "angle": 90})
    return fig.update_layout({"template": "plotly_white", "margin": {"t": 80}, **layout})


def slice_forces(
    cases: Mapping[str, Mapping[str, NDArray[np.float64]]],
    *,
    bands: Iterable[tuple[float, float]] = (),
    fig: go.Figure | None = None,
    **layout: Any,
) -> go.Figure:
    """Draw the normal force of each slice of a ball, several cases on common scales one below the other.

    Parameters
    ----------
    cases : mapping of str to mapping of str to ndarray
        Axial place ``z`` [m], ``width`` [m] and ``force`` [N] of the slices of a contact at one time, such as
        ``ballrace.paper.Snapshot.slices``, by the title of their panel.
    bands : iterable of tuple of float
        Axial beginnings and ends of the defects [m], shaded.
    fig : plotly.graph_objects.Figure, optional
        A figure of ``make_subplots`` with as many rows as there are cases.
    **layout
        For ``fig.update_layout``.
    """
    from plotly.graph_objects import Bar

    fig = fig if fig is not None else _stack(tuple(cases))
    for place, (label, table) in enumerate(cases.items(), start=1):
        bars = Bar(
            x=1e3 * table["z"],
            y=table["force"],
            width=1e3 * table["width"],
            name=label,
            marker={"color": _COLOURS[(place - 1) % len(_COLOURS)]},
        )
        fig.add_trace(bars, row=place, col=1)
        fig.update_yaxes(title_text="force of a slice / N", row=place, col=1)
    for first, last in bands:
        fig.add_vrect(x0=1e3 * first, x1=1e3 * last, fillcolor="#b8b8b8", opacity=0.3, line_width=0)
    fig.update_yaxes(matches="y")
    fig = _finish_stack(fig, len(cases), layout)
    return fig.update_xaxes(title_text="z on the outer ring / mm", row=max(len(cases), 1), col=1)


def _stack(titles: tuple[str, ...]) -> go.Figure:
    from plotly.subplots import make_subplots

    gap = min(0.08, 0.3 / len(titles)) if titles else 0.0
    return make_subplots(
        rows=max(len(titles), 1),
        cols=1,
        shared_xaxes=True,
        vertical_spacing=gap,
        subplot_titles=titles,
    )


def _finish_stack(fig: go.Figure, rows: int, layout: dict[str, Any]) -> go.Figure:
    fig.update_xaxes(title_text="time / s", row=max(rows, 1), col=1)
    height = 120 + 200 * max(rows, 1)
    return fig.update_layout(
        {"template": "plotly_white", "showlegend": False, "height": height, **layout}
    )


def _line(t: NDArray[np.float64], values: NDArray[np.float64], name: str, place: int) -> Any:
    from plotly.graph_objects import Scatter, Scattergl

    kind = Scattergl if t.size > _MANY else Scatter
    colour = _COLOURS[place % len(_COLOURS)]
    return kind(x=t, y=values, name=name, mode="lines", line={"color": colour, "width": 1})


def _unit(unit: str) -> str:
    return unit.replace("^2", "²").replace("^3", "³")
