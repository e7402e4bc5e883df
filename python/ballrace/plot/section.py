"""The bearing cut through its axis, with its parts, sides, angles, loads and defects named."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from .._base.libraries import go
from ..frequencies.operating import operating_angle
from ..scene.defect import extent
from ..scene.scene import checked_scene
from .outlines import circle, on_groove, outlines
from .style import COLOURS, finished

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..scene import Defect, Row, Scene
    from .outlines import Outlines

    Array = NDArray[np.float64]

_STEEL = {"outer": "#dfe6ee", "inner": "#cfd9e4", "ball": "#f3f5f7"}
_INK = "#333333"


def section(
    scene: Scene, *, operating: bool = False, fig: go.Figure | None = None, **layout: Any
) -> go.Figure:
    """Draw a bearing cut through its axis: rings, balls, contact angle, axes, sides, loads and defects.

    The axis lies along the page with +z to the right, y goes up. Balls stand at the top and at the bottom. A
    defect of a race is drawn in the half that it lies in, at the axial place that it has in a run.

    Parameters
    ----------
    scene : Scene
        The scene. Boundary dimensions that it does not give are drawn as common for its balls.
    operating : bool
        Whether the contact angle drawn is that under load, as of :func:`ballrace.fault_frequencies`, not the
        nominal one.
    fig : plotly.graph_objects.Figure, optional
        Figure to draw into.
    **layout
        For ``fig.update_layout``.

    Raises
    ------
    SceneError
        ``scene`` is none.
    EquilibriumError
        ``operating`` of a scene that cannot carry its load.

    Examples
    --------
    >>> import ballrace as br
    >>> fig = br.plot.section(br.presets.wheel_bearing(axial_load=3000.0))
    >>> [a.text for a in fig.layout.annotations if "race" in a.text]
    ['spall on the outer race, at −90°']
    """
    scene = checked_scene(scene)
    fig = fig if fig is not None else go.Figure()
    shapes = outlines(scene)
    for half in (1.0, -1.0):
        for ring, name in (("outer", "outer ring"), ("inner", "inner ring")):
            _filled(fig, half, getattr(shapes, ring), _STEEL[ring], name)
        for number, row in enumerate(scene.rows):
            ball = circle(
                1e3 * row.axial_position, 0.5e3 * row.pitch_diameter, 0.5e3 * row.ball_diameter
            )
            _filled(fig, half, ball, _STEEL["ball"], f"ball of row {number}")
    for number, row in enumerate(scene.rows):
        angle = operating_angle(scene, number) if operating else row.contact_angle
        _angle(fig, row, angle, named=number == 0)
    _axes(fig, shapes)
    _names(fig, scene, shapes)
    for name, defect in scene.placed().defects.items():
        _defect(fig, scene.rows[defect.row], defect, name)
    _loads(fig, scene, shapes)
    room = 0.65 * (shapes.right - shapes.left)
    fig.update_xaxes(title_text="z, along the axis / mm", zeroline=False, showgrid=False, constrain="domain",
                     range=[shapes.left - room, shapes.right + room])  # fmt: skip
    fig.update_yaxes(title_text="y / mm", scaleanchor="x", zeroline=False, showgrid=False, constrain="domain",
                     range=[-1.24 * shapes.outside, 1.24 * shapes.outside])  # fmt: skip
    return finished(fig, layout, height=620, showlegend=False)


def _filled(fig: go.Figure, half: float, outline: Array, colour: str, name: str) -> None:
    fig.add_trace(
        go.Scatter(
            x=outline[:, 0], y=half * outline[:, 1], fill="toself", mode="lines", fillcolor=colour,
            line={"color": _INK, "width": 1.2}, hoverinfo="text", text=name, name=name,
        )
    )  # fmt: skip


def _line(fig: go.Figure, x: list[float], y: list[float], **line: Any) -> None:
    style = {"color": _INK, "width": 1, **line}
    fig.add_trace(go.Scatter(x=x, y=y, mode="lines", line=style, hoverinfo="skip"))


def _angle(fig: go.Figure, row: Row, angle: float, *, named: bool) -> None:
    """Draw the line of contact through the balls of a row, and its angle."""
    z, r, reach = 1e3 * row.axial_position, 0.5e3 * row.pitch_diameter, 0.85e3 * row.ball_diameter
    dz, dr = reach * row.side * math.sin(angle), reach * math.cos(angle)
    for half in (1.0, -1.0):
        _line(
            fig, [z - dz, z + dz], [half * (r - dr), half * (r + dr)], color=COLOURS[0], dash="dash"
        )
        _line(fig, [z, z], [half * (r - reach), half * (r + reach)], color="#999999", dash="dot")
    if named:
        fig.add_annotation(x=z + dz, y=r + dr, text=f"contact angle {math.degrees(angle):.1f}°", ax=-64,
                           ay=-30, font={"color": COLOURS[0]}, arrowcolor=COLOURS[0], arrowhead=0)  # fmt: skip


def _axes(fig: go.Figure, shapes: Outlines) -> None:
    length = shapes.right - shapes.left
    _line(
        fig, [shapes.left - 0.55 * length, shapes.right + 0.35 * length], [0.0, 0.0], dash="dashdot"
    )
    _text(fig, shapes.left - 0.05 * length, -0.9 * shapes.outside, "−z side", xanchor="right")
    _text(fig, shapes.right + 0.05 * length, -0.9 * shapes.outside, "+z side", xanchor="left")
    corner = shapes.left - 0.55 * length
    reach = 0.22 * shapes.outside
    for dx, dy, name in ((reach, 0.0, "z"), (0.0, reach, "y")):
        _arrow(fig, (corner, 0.0), (corner + dx, dy), _INK)
        _text(fig, corner + 1.25 * dx, 1.25 * dy, name)


def _names(fig: go.Figure, scene: Scene, shapes: Outlines) -> None:
    row = scene.rows[-1]
    z, r, half = 1e3 * row.axial_position, 0.5e3 * row.pitch_diameter, 0.5e3 * row.ball_diameter
    inner = 0.5 * (shapes.bore + r - half)
    outer = 0.5 * (shapes.outside + r + half)
    edge = shapes.right
    for text, x, y, ay in (
        ("outer ring", edge, outer, -14), ("ball", z + 0.7 * half, r + 0.3 * half, 0),
        ("inner ring", edge, inner, 16)
    ):  # fmt: skip
        fig.add_annotation(
            x=x, y=y, text=text, ax=22, ay=ay, xanchor="left", arrowhead=0, arrowcolor=_INK
        )
    if len(scene.rows) > 1:
        for number, one in enumerate(scene.rows):
            _text(fig, 1e3 * one.axial_position, 0.5e3 * one.pitch_diameter, f"row {number}")


def _defect(fig: go.Figure, row: Row, defect: Defect, name: str) -> None:
    """Draw a defect as a thick piece of its race; one of a ball on the ball at the top."""
    degrees = math.degrees(math.atan2(math.sin(defect.angle), math.cos(defect.angle)))
    half = 1.0 if math.sin(defect.angle) >= 0.0 else -1.0
    race: Literal["outer", "inner"] = "inner" if defect.on == "inner_race" else "outer"
    assert not isinstance(defect.axial_offset, str)
    along = np.linspace(-0.5, 0.5, 21) * extent(defect) + defect.axial_offset
    if defect.on == "ball":
        half, points, where = 1.0, _on_ball(row, along), f"ball {defect.ball}"
    else:
        points = on_groove(row, race, along)
        where = f"{race} race, at {degrees:.0f}°".replace("-", "−")
    _line(fig, points[:, 0].tolist(), (half * points[:, 1]).tolist(), color=COLOURS[1], width=6)
    fig.add_annotation(
        x=float(points[10, 0]), y=float(half * points[10, 1]), text=f"{name} on the {where}", ax=30,
        ay=half * -(34 if race == "outer" else -34), font={"color": COLOURS[1]}, arrowcolor=COLOURS[1],
    )  # fmt: skip


def _on_ball(row: Row, z: Array) -> Array:
    """Return points of the ball's outside at axial places from its centre [m]."""
    r = 0.5e3 * row.ball_diameter
    angles = np.arcsin(np.clip(1e3 * z / r, -1.0, 1.0))
    centre = np.array([1e3 * row.axial_position, 0.5e3 * row.pitch_diameter])
    return centre + r * np.column_stack([np.sin(angles), np.cos(angles)])


def _loads(fig: go.Figure, scene: Scene, shapes: Outlines) -> None:
    """Draw loads that lie in the plane of the section, from the axis or at it."""
    reach = 0.34 * shapes.outside
    middle = 0.5 * (shapes.left + shapes.right)
    for name, load in scene.loads.items():
        x, y, z = load.direction
        size = math.sqrt(x * x + y * y + z * z)
        force = load.force
        if size == 0.0 or abs(x) > 1e-6 * size or (isinstance(force, float) and force == 0.0):
            continue
        sign = -1.0 if isinstance(force, float) and force < 0.0 else 1.0
        dz, dy = sign * reach * z / size, sign * reach * y / size
        amount = f"{abs(force):.0f} N" if isinstance(force, float) else "varies"
        start = (middle + 0.08 * reach, 0.0) if dy else (middle - dz / 2, 0.28 * reach)
        _arrow(fig, start, (start[0] + dz, start[1] + dy), COLOURS[2], width=3)
        at = (start[0] + 0.1 * reach, start[1] + 0.7 * dy) if dy else (middle, 0.7 * reach)
        text = (
            f"{name} load<br>on the {load.ring} ring<br>{amount}"
            if dy
            else f"{name} load, {amount}"
        )
        _text(fig, *at, text, colour=COLOURS[2], xanchor="left" if dy else "center")


def _arrow(
    fig: go.Figure,
    start: tuple[float, float],
    end: tuple[float, float],
    colour: str,
    width: int = 1,
) -> None:
    fig.add_annotation(
        x=end[0], y=end[1], ax=start[0], ay=start[1], axref="x", ayref="y", text="", showarrow=True,
        arrowhead=2, arrowwidth=width, arrowcolor=colour,
    )  # fmt: skip


def _text(
    fig: go.Figure, x: float, y: float, text: str, *, colour: str = _INK, xanchor: str = "center"
) -> None:
    fig.add_annotation(
        x=x, y=y, text=text, showarrow=False, font={"color": colour}, xanchor=xanchor, align="left"
    )
