"""Moving parts of the animation of a bearing, picture by picture."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .._base.libraries import go
from ..scene.defect import widest
from .maps import SHADES
from .outlines import circle, outlines, race_radius
from .style import COLOURS

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..scene import Defect
    from ..signals import Signals

Array = NDArray[np.float64]

_INK = "#333333"
_TURN = np.linspace(0.0, 2.0 * np.pi, 25)
_BAR = 0.3
"""Longest bar of a load over the outside radius."""


class Moving:
    """Traces of a run: those that stand still, and those of a sample."""

    def __init__(self, out: Signals, row: int) -> None:
        self._out, self._row, self._scene = out, row, out.scene
        self._of_row = out.scene.rows[row]
        self._shapes = outlines(out.scene)
        rows = [range(of_row.ball_count) for of_row in out.scene.rows]
        self._loads = [
            np.array([out[f"row{r}.ball{b}.outer.load"] for b in balls])
            for r, balls in enumerate(rows)
        ]
        self._places = [
            1e3 * np.array([[out[f"row{r}_ball{b}.{axis}"] for axis in "xyz"] for b in balls])
            for r, balls in enumerate(rows)
        ]
        self._theta = out["inner.theta"]
        self._largest = max(float(loads.max()) for loads in self._loads) or 1.0

    def still(self) -> Iterator[Any]:
        """Give what stands in the front view: circles of the races, outer defects unless they turn, a scale."""
        row, shapes = self._of_row, self._shapes
        pitch, half = 0.5e3 * row.pitch_diameter, 0.5e3 * row.ball_diameter
        turn = np.linspace(0.0, 2.0 * np.pi, 121)
        for radius, width in (
            (shapes.outside, 1.2),
            (pitch + half, 2.0),
            (pitch - half, 2.0),
            (shapes.bore, 1.2),
        ):
            yield go.Scatter(x=radius * np.cos(turn), y=radius * np.sin(turn), mode="lines",
                          line={"color": _INK, "width": width}, hoverinfo="skip")  # fmt: skip
        for name, defect in self._scene.defects.items():
            if defect.row == self._row and not self._is_carried(defect):
                yield self._on_race(defect, name, 0.0)
        title = {"text": "load / N", "side": "top"}
        bar = {
            "title": title, "thickness": 10, "len": 0.45, "nticks": 4, "orientation": "h",
            "x": 1.0, "xanchor": "right", "y": 1.08, "yanchor": "bottom",
        }  # fmt: skip
        scale = {
            "color": [0.0], "cmin": 0.0, "cmax": self._largest, "colorscale": SHADES, "size": 1e-3,
            "showscale": True, "colorbar": bar,
        }  # fmt: skip
        yield go.Scatter(x=[None], y=[None], mode="markers", marker=scale, hoverinfo="skip")

    def section_still(self) -> Iterator[Any]:
        """Give the rings in the section."""
        for half in (1.0, -1.0):
            for outline, colour in (
                (self._shapes.outer, "#dfe6ee"),
                (self._shapes.inner, "#cfd9e4"),
            ):
                yield go.Scatter(x=outline[:, 0], y=half * outline[:, 1], fill="toself", fillcolor=colour,
                              mode="lines", line={"color": _INK, "width": 1}, hoverinfo="skip")  # fmt: skip

    def at(self, k: int) -> Iterator[tuple[int, Any]]:
        """Give the traces of a sample with the panel, 1 or 2, that each belongs to."""
        places, loads = self._places[self._row][:, :, k], self._loads[self._row][:, k]
        yield 1, self._cage(places)
        for place, load in zip(places, loads, strict=True):
            yield 1, self._ball(place, load)
        yield 1, self._bars(places, loads)
        yield 1, self._turned(k)
        for name, defect in self._scene.defects.items():
            if defect.row == self._row and self._is_carried(defect):
                yield 1, self._carried(defect, name, k)
        for row in range(len(self._scene.rows)):
            for half in (1.0, -1.0):
                yield 2, self._cut(row, half, k)

    def _shade(self, load: float) -> str:
        from .._base.plotly import sample_colorscale

        return str(sample_colorscale(SHADES, [min(max(load / self._largest, 0.0), 1.0)])[0])

    def _ball(self, place: Array, load: float) -> Any:
        r = 0.5e3 * self._of_row.ball_diameter
        return _filled(
            place[0] + r * np.cos(_TURN), place[1] + r * np.sin(_TURN), self._shade(load)
        )

    def _bars(self, places: Array, loads: Array) -> Any:
        """Bars from the outside, as long as the loads on the outer race are large."""
        angle = np.arctan2(places[:, 1], places[:, 0])
        inside = 1.04 * self._shapes.outside
        outside = inside + _BAR * self._shapes.outside * loads / self._largest
        gap = np.full(angle.size, np.nan)
        x = np.column_stack([inside * np.cos(angle), outside * np.cos(angle), gap]).ravel()
        y = np.column_stack([inside * np.sin(angle), outside * np.sin(angle), gap]).ravel()
        line = {"color": _INK, "width": 4}
        return go.Scatter(
            x=_short(x), y=_short(y), mode="lines", line=line, name="load", hoverinfo="skip"
        )

    def _cage(self, places: Array) -> Any:
        """Bars of the cage: arcs on the pitch circle between neighbouring balls."""
        angle = np.arctan2(places[:, 1], places[:, 0])
        radius = 0.5e3 * self._of_row.pitch_diameter
        pitch, free = 2.0 * math.pi / angle.size, 0.56e3 * self._of_row.ball_diameter / radius
        within = np.linspace(free, pitch - free, 5)
        arcs = np.append(angle[:, None] + within, np.full((angle.size, 1), np.nan), axis=1).ravel()
        line = {"color": "#8a6d3b", "width": 4}
        x, y = _short(radius * np.cos(arcs)), _short(radius * np.sin(arcs))
        return go.Scatter(x=x, y=y, mode="lines", line=line, name="cage", hoverinfo="skip")

    def _turned(self, k: int) -> Any:
        """Mark the inner ring, which shows how far the shaft has turned."""
        angle = float(self._theta[k])
        ends = np.array(
            [self._shapes.bore, 0.5e3 * (self._of_row.pitch_diameter - self._of_row.ball_diameter)]
        )
        line = {"color": _INK, "width": 3}
        x, y = _short(ends * math.cos(angle)), _short(ends * math.sin(angle))
        return go.Scatter(x=x, y=y, mode="lines", line=line, name="shaft", hoverinfo="skip")

    def _is_carried(self, defect: Defect) -> bool:
        return defect.on != "outer_race" or self._scene.outer_speed is not None

    def _carried(self, defect: Defect, name: str, k: int) -> Any:
        """Draw a defect that moves with a ring or a ball."""
        if defect.on != "ball":
            ring = "inner" if defect.on == "inner_race" else "outer"
            return self._on_race(defect, name, float(self._out[f"{ring}.theta"][k]))
        x, y, _ = self._places[self._row][int(defect.ball or 0), :, k]
        turned = defect.angle + float(self._out[f"row{self._row}_ball{defect.ball}.theta"][k])
        radius = 0.5e3 * self._of_row.ball_diameter
        half = 0.5 * widest(defect) * 1e3 / radius
        return _mark((x, y), radius, turned, half, name)

    def _on_race(self, defect: Defect, name: str, turned: float) -> Any:
        radius = 1e3 * race_radius(self._of_row, defect.on)
        half = 0.5e3 * widest(defect) / radius
        return _mark((0.0, 0.0), radius, defect.angle + turned, half, name)

    def _cut(self, row: int, half: float, k: int) -> Any:
        """Draw the ball that is nearest to the plane at the top or at the bottom, turned into it."""
        places = self._places[row][:, :, k]
        near = np.where(half * places[:, 1] > 0.0, np.abs(places[:, 0]), np.inf)
        ball = int(np.argmin(near))
        radius = half * math.hypot(places[ball, 0], places[ball, 1])
        ring = circle(places[ball, 2], radius, 0.5e3 * self._scene.rows[row].ball_diameter)[::3]
        return _filled(ring[:, 0], ring[:, 1], self._shade(self._loads[row][ball, k]))


def _mark(centre: tuple[float, float], radius: float, angle: float, half: float, name: str) -> Any:
    """Draw a thick piece of a circle; at least two degrees, so that it is seen."""
    arc = np.linspace(angle - max(half, 0.02), angle + max(half, 0.02), 7)
    line = {"color": COLOURS[1], "width": 7}
    px = _short(centre[0] + radius * np.cos(arc))
    py = _short(centre[1] + radius * np.sin(arc))
    return go.Scatter(x=px, y=py, mode="lines", line=line, name=name, hovertemplate=name)


def _filled(x: Array, y: Array, colour: str) -> Any:
    line = {"color": _INK, "width": 1}
    return go.Scatter(
        x=_short(x),
        y=_short(y),
        fill="toself",
        fillcolor=colour,
        mode="lines",
        line=line,
        hoverinfo="skip",
    )


def _short(values: Array) -> NDArray[np.float32]:
    return np.asarray(values, dtype=np.float32)
