"""The races unrolled: where the balls touch them, how hard, and where defects lie."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from .._base.libraries import go
from ..scene.defect import extent, widest
from ..statics import Equilibrium, equilibrium
from .ellipse import semi_axes
from .maps import SHADES
from .outlines import race_radius
from .style import COLOURS, finished

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..scene import Defect, Row, Scene

    Array = NDArray[np.float64]

_WIDER = 5.0
"""Ellipses are drawn so many times as wide as they are: a race is a hundred times as long as they are."""

_RACES: tuple[Literal["outer", "inner"], ...] = ("outer", "inner")
_TURN = np.linspace(0.0, 2.0 * np.pi, 41)


def unrolled(
    scene: Scene,
    loads: Equilibrium | None = None,
    *,
    row: int = 0,
    fig: go.Figure | None = None,
    **layout: Any,
) -> go.Figure:
    """Draw both races of a row unrolled, with the ellipses of contact, their forces, and the defects.

    Along the page goes the angle around the bearing, up the axial place from the row's plane. Ellipses have their
    length across the race in scale and are drawn five times as wide as they are; defects are in scale, where a run
    has them.

    Parameters
    ----------
    scene : Scene
        The scene.
    loads : Equilibrium, optional
        Its equilibrium; by default it is solved here.
    row : int
        Row of balls.
    fig : plotly.graph_objects.Figure, optional
        A figure of ``make_subplots`` with two rows.
    **layout
        For ``fig.update_layout``.

    Raises
    ------
    EquilibriumError
        There is no stable equilibrium.

    Examples
    --------
    >>> import ballrace as br
    >>> fig = br.plot.unrolled(br.presets.wheel_bearing(axial_load=3000.0))
    """
    from .._base.plotly import make_subplots

    eq = equilibrium(scene) if loads is None else loads
    if fig is None:
        titles = ("outer race (contacts 5 times as wide)", "inner race")
        fig = make_subplots(
            rows=2, cols=1, shared_xaxes=True, vertical_spacing=0.1, subplot_titles=titles
        )
    defects = scene.placed().defects
    largest = max(float(eq.outer_load.max()), float(eq.inner_load.max()), 1e-9)
    for place, race in enumerate(_RACES, start=1):
        _contacts(fig, scene.rows[row], eq, number=row, race=race, largest=largest)
        for name, defect in defects.items():
            if defect.row == row and defect.on == f"{race}_race":
                _defect(fig, scene.rows[row], name, defect, place)
        fig.update_yaxes(title_text="axial place / mm", row=place, col=1)
    ticks = {"tickvals": list(range(-180, 181, 60)), "ticksuffix": "°", "range": [-190, 190]}
    fig.update_xaxes(**ticks)
    fig.update_xaxes(title_text="angle around the bearing", row=2, col=1)
    return finished(fig, layout, height=520, showlegend=False)


def _contacts(
    fig: go.Figure, row: Row, eq: Equilibrium, *, number: int, race: Literal["outer", "inner"], largest: float,
) -> None:  # fmt: skip
    from .._base.plotly import sample_colorscale

    place = _RACES.index(race) + 1

    own = np.flatnonzero(eq.row == number)
    load, pressure = getattr(eq, f"{race}_load")[own], getattr(eq, f"{race}_pressure")[own]
    across, along = semi_axes(row, race, load, pressure)
    angle, z = np.degrees(_wrapped(eq.angle[own])), _axial(eq, own, race, row)
    half = np.degrees(_WIDER * along / race_radius(row, race))
    cosine = np.abs(np.cos(np.nan_to_num(getattr(eq, f"{race}_angle")[own])))
    for k in np.flatnonzero(load > 0.0):
        shade = sample_colorscale(SHADES, [0.85 * load[k] / largest])[0]
        ellipse = go.Scatter(
            x=angle[k] + half[k] * np.cos(_TURN), y=1e3 * (z[k] + across[k] * cosine[k] * np.sin(_TURN)),
            fill="toself", mode="lines", line={"color": "#333", "width": 1}, fillcolor=shade, hoverinfo="text",
            text=f"{load[k]:.0f} N, {1e-6 * pressure[k]:.0f} MPa, {2e3 * across[k]:.2f} × {2e3 * along[k]:.2f} mm",
        )  # fmt: skip
        fig.add_trace(ellipse, row=place, col=1)
    for k in np.flatnonzero(load >= 1.0):
        # Upright, so that those of neighbours do not meet on a narrow page.
        fig.add_annotation(
            x=angle[k], y=1e3 * (z[k] + across[k] * cosine[k]), text=f"{load[k]:.0f} N", textangle=-90,
            yanchor="bottom", showarrow=False, font={"size": 10}, row=place, col=1,
        )  # fmt: skip
    low, high = _extent(load, z, across * cosine)
    fig.update_yaxes(range=[low - 0.1 * (high - low), high + 0.5 * (high - low)], row=place, col=1)
    free = go.Scatter(
        x=angle[load <= 0.0], y=np.zeros(int((load <= 0.0).sum())), mode="markers",
        hovertemplate="no load<extra></extra>", marker={"symbol": "circle-open", "size": 8, "color": "#888"},
    )  # fmt: skip
    fig.add_trace(free, row=place, col=1)


def _extent(load: Array, z: Array, reach: Array) -> tuple[float, float]:
    """Return between which axial places contacts lie, the row's plane with them [mm]."""
    loaded = load > 0.0
    ends = np.concatenate([[-1e-4, 1e-4], (z - reach)[loaded], (z + reach)[loaded]])
    return 1e3 * float(ends.min()), 1e3 * float(ends.max())


def _defect(fig: go.Figure, row: Row, name: str, defect: Defect, place: int) -> None:
    race = _RACES[place - 1]
    width = widest(defect)
    half = math.degrees(0.5 * width / race_radius(row, race))
    middle = math.degrees(float(_wrapped(np.array(defect.angle))))
    assert not isinstance(defect.axial_offset, str)
    z = 1e3 * defect.axial_offset
    end = 0.5e3 * extent(defect)
    box = go.Scatter(
        x=[middle + s * half for s in (-1, 1, 1, -1, -1)], y=[z + s * end for s in (-1, -1, 1, 1, -1)],
        mode="lines", line={"color": COLOURS[1], "width": 2, "dash": "solid"}, fill="toself",
        fillcolor="rgba(200,69,47,0.25)", hoverinfo="text",
        text=f"{name}: {1e3 * width:.2f} × {1e3 * extent(defect):.2f} mm",
    )  # fmt: skip
    fig.add_trace(box, row=place, col=1)
    fig.add_annotation(x=middle + half, y=z - end, text=name, ax=34, ay=22, font={"color": COLOURS[1]},
                       arrowcolor=COLOURS[1], row=place, col=1)  # fmt: skip


def _axial(
    eq: Equilibrium, own: NDArray[np.int64], race: Literal["outer", "inner"], row: Row
) -> NDArray[np.float64]:
    """Return where contacts lie on the race from the row's plane [m]."""
    centre: NDArray[np.float64] = getattr(eq, f"{race}_zone_centre")[own] - row.axial_position
    return centre


def _wrapped(angle: NDArray[np.float64]) -> NDArray[np.float64]:
    found: NDArray[np.float64] = np.angle(np.exp(1j * angle))
    return found
