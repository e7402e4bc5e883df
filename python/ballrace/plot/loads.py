"""Loads of balls around a bearing, and of the slices of one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from .._base.libraries import go
from ..errors import SceneError
from ..signals import Signals
from ..statics import Equilibrium, LoadDistribution
from .style import COLOURS, DASHES, MARKERS, finished
from .times import finish_stack, share_scale, stack

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from ..paper.case import Balls

    Loads = Equilibrium | LoadDistribution


def load_distribution(
    loads: Loads | Mapping[str, Loads],
    fig: go.Figure | None = None,
    *,
    row: int | None = None,
    **layout: Any,
) -> go.Figure:
    """Draw the load of each ball on the outer race against the ball's place, a line per row.

    Parameters
    ----------
    loads : Equilibrium, LoadDistribution or mapping of str to these
        One solution, or several by the title of their panel, which stand side by side with common scales. Of an
        equilibrium the balls are marked; of a load distribution the line shows the loads at every place.
    fig : plotly.graph_objects.Figure, optional
        A figure of ``make_subplots`` with as many polar columns as there are solutions.
    row : int, optional
        Shows this row alone, all solutions in one panel, a line each.
    **layout
        For ``fig.update_layout``.

    Raises
    ------
    SceneError
        There is no such row, or ``loads`` are something else.

    Examples
    --------
    >>> import ballrace as br
    >>> eq = br.equilibrium(br.presets.wheel_bearing(axial_load=3000.0))
    >>> [trace.name for trace in br.plot.load_distribution(eq).data]
    ['row 0', 'row 1']
    """
    _check_solutions(loads)
    cases = dict(loads) if isinstance(loads, Mapping) else {"": loads}
    largest = max((float(found.outer_load.max()) for found in cases.values()), default=0.0)
    if row is not None:
        return _finish_polars(_one_row(cases, row, fig), largest, layout)
    fig = fig if fig is not None else _polars(tuple(cases))
    for place, found in enumerate(cases.values(), start=1):
        for number in np.unique(found.row):
            angle, load, marked = _around(found, int(number))
            trace = _polar_line(
                angle, load, f"row {number}", int(number), place == 1, marked=marked
            )
            fig.add_trace(trace, row=1, col=place)
    return _finish_polars(fig, largest, layout)


def _check_solutions(loads: object) -> None:
    for found in loads.values() if isinstance(loads, Mapping) else (loads,):
        if not isinstance(found, Equilibrium | LoadDistribution):
            allowed = "what ballrace.equilibrium or ballrace.load_distribution finds of a scene"
            raise SceneError("loads", f"a {type(found).__name__}", allowed)


def force_distribution(
    balls: Equilibrium | Balls,
    *,
    largest: float | None = None,
    fig: go.Figure | None = None,
    **layout: Any,
) -> go.Figure:
    """Draw the normal forces of all balls on both races, a polar panel per row.

    Parameters
    ----------
    balls : Equilibrium or Balls
        The balls at rest, or at one instant of the paper's run (``ballrace.paper.Snapshot.balls``).
    largest : float, optional
        Force at the rim of the panels [N], for a scale common to several figures.
    fig : plotly.graph_objects.Figure, optional
        A figure of ``make_subplots`` with as many polar columns as there are rows of balls.
    **layout
        For ``fig.update_layout``.

    Raises
    ------
    SceneError
        ``balls`` are something else.
    """
    if not all(hasattr(balls, name) for name in ("row", "angle", "outer_load", "inner_load")):
        allowed = "what ballrace.equilibrium returns, or the balls of a snapshot of the paper"
        raise SceneError("balls", f"a {type(balls).__name__}", allowed)
    numbers = np.unique(balls.row)
    fig = fig if fig is not None else _polars(tuple(f"row {row}" for row in numbers))
    races = {"outer race": balls.outer_load, "inner race": balls.inner_load}
    for place, row in enumerate(numbers, start=1):
        of_row = np.flatnonzero(balls.row == row)
        around = np.append(of_row, of_row[0])
        for number, (race, load) in enumerate(races.items()):
            trace = _polar_line(balls.angle[around], load[around], race, number, place == 1)
            fig.add_trace(trace, row=1, col=place)
    rim = largest or max(float(load.max()) for load in races.values()) or 1.0
    return _finish_polars(fig, rim, layout)


def slice_forces(
    cases: Signals | Mapping[str, Mapping[str, NDArray[np.float64]]],
    *,
    bands: Iterable[tuple[float, float]] = (),
    fig: go.Figure | None = None,
    **layout: Any,
) -> go.Figure:
    """Draw the normal force of each slice of a ball, several cases on common scales one below the other.

    Parameters
    ----------
    cases : Signals, or mapping of str to mapping of str to ndarray
        A run with a :class:`ballrace.scene.SlicesProbe`, a panel for each contact and time that it recorded. Or
        axial place ``z`` [m], ``width`` [m] and ``force`` [N] of the slices of a contact at one time, such as
        ``ballrace.paper.Snapshot.slices``, by the title of their panel.
    bands : iterable of tuple of float
        Axial beginnings and ends of the defects [m], shaded.
    fig : plotly.graph_objects.Figure, optional
        A figure of ``make_subplots`` with as many rows as there are cases.
    **layout
        For ``fig.update_layout``.

    Raises
    ------
    SceneError
        The run has no slices recorded, or it is neither a run nor such a mapping.

    Examples
    --------
    >>> import ballrace as br
    >>> probe = br.scene.SlicesProbe(balls=(0,), races=("outer",), times=(0.0,))
    >>> scene = br.bearing("6205", speed_rpm=1800.0).replace({"probes.slices": probe})
    >>> fig = br.plot.slice_forces(br.simulate(scene, duration=1e-4))
    """
    tables = _tables(cases)
    fig = fig if fig is not None else stack(tuple(tables))
    for place, (label, table) in enumerate(tables.items(), start=1):
        bars = go.Bar(
            x=1e3 * table["z"],
            y=table["force"],
            width=1e3 * table["width"],
            name=label,
            marker={"color": COLOURS[(place - 1) % len(COLOURS)]},
            hovertemplate="z = %{x:.3f} mm: %{y:.2f} N",
        )
        fig.add_trace(bars, row=place, col=1)
        fig.update_yaxes(title_text="force of a slice / N", row=place, col=1)
    for first, last in bands:
        fig.add_vrect(x0=1e3 * first, x1=1e3 * last, fillcolor="#b8b8b8", opacity=0.3, line_width=0)
    share_scale(fig, len(tables))
    return finish_stack(fig, len(tables), layout, "axial place on the ring / mm")


def _tables(cases: object) -> Mapping[str, Mapping[str, NDArray[np.float64]]]:
    if isinstance(cases, Signals):
        return _slices(cases)
    if not isinstance(cases, Mapping):
        allowed = "a run, as ballrace.simulate returns it, or tables of slices by titles of panels"
        raise SceneError("cases", f"a {type(cases).__name__}", allowed)
    for label, table in cases.items():
        if not isinstance(table, Mapping) or not {"z", "width", "force"} <= set(table):
            allowed = "a table of slices, with z, width and force"
            raise SceneError(f"cases[{label!r}]", f"a {type(table).__name__}", allowed)
    return cases


def _slices(out: Signals) -> dict[str, dict[str, NDArray[np.float64]]]:
    table = getattr(out, "slices", None)
    if table is None or table.is_empty():
        raise SceneError("cases", "a run without slices", "one with a SlicesProbe among its probes")
    found = {}
    keys = ["time", "row", "ball", "race"]
    for (time, row, ball, race), part in table.group_by(keys, maintain_order=True):
        label = f"row {row} ball {ball}, {race} race, {1e3 * time:.3f} ms"
        found[label] = {name: part[name].to_numpy() for name in ("z", "width", "force")}
    return found


def _one_row(cases: Mapping[str, Loads], row: int, fig: go.Figure | None) -> go.Figure:
    fig = fig if fig is not None else _polars(("",))
    for number, (label, found) in enumerate(cases.items()):
        if not (found.row == row).any():
            raise SceneError("row", str(row), f"a row, 0 to {int(found.row.max())}")
        angle, load, marked = _around(found, row)
        fig.add_trace(_polar_line(angle, load, label, number, True, marked=marked), row=1, col=1)
    return fig


def _around(found: Loads, row: int) -> tuple[NDArray[np.float64], NDArray[np.float64], bool]:
    if isinstance(found, LoadDistribution):
        angle, load = found.around(row, "outer")
        return np.append(angle, angle[0]), np.append(load, load[0]), False
    of_row = np.flatnonzero(found.row == row)
    around = np.append(of_row, of_row[0])
    return found.angle[around], found.outer_load[around], True


def _polars(titles: tuple[str, ...]) -> go.Figure:
    from .._base.plotly import make_subplots

    specs = [[{"type": "polar"} for _ in titles]]
    fig = make_subplots(rows=1, cols=len(titles), specs=specs, subplot_titles=titles)
    return fig.update_annotations(yshift=18)  # clear of the label at 90°


def _polar_line(
    angle: NDArray[np.float64],
    load: NDArray[np.float64],
    name: str,
    number: int,
    legend: bool,
    *,
    marked: bool = True,
) -> Any:
    kind = number % len(COLOURS)
    return go.Scatterpolar(
        theta=np.degrees(angle),
        r=load,
        name=name,
        legendgroup=name,
        showlegend=legend,
        mode="lines+markers" if marked else "lines",
        line={"color": COLOURS[kind], "dash": DASHES[kind]},
        marker={"symbol": MARKERS[kind], "size": 7},
        hovertemplate="at %{theta:.1f}°: %{r:.0f} N",
    )


def _finish_polars(fig: go.Figure, largest: float, layout: dict[str, Any]) -> go.Figure:
    fig.update_polars(
        radialaxis={"range": [0.0, 1.1 * largest or 1.0], "ticksuffix": " N", "nticks": 4},
        radialaxis_angle=90,
        radialaxis_tickangle=90,
        angularaxis={"ticksuffix": "°", "dtick": 45},
    )  # fmt: skip
    return finished(fig, layout, height=420, margin={"l": 40, "r": 40, "t": 90, "b": 40})
