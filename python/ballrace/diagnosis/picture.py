"""The picture of a verdict."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .._base.libraries import go
from ..errors import SceneError
from ..plot.style import COLOURS, SYMBOLS, finished
from .envelopes import FLOOR
from .null import ACCUSED
from .verdict import NAMES

if TYPE_CHECKING:
    from .combs import Part
    from .envelopes import Levels
    from .evidence import Evidence
    from .result import Diagnosis

_MARKS = FLOOR - 2.0
"""Level at which marks stand, below all lines [dB]."""


def picture(
    of: Diagnosis, levels: Levels | None, part: Part | None, fig: go.Figure | None, layout: dict[str, Any]
) -> go.Figure:  # fmt: skip
    """Draw a diagnosis; see :meth:`ballrace.diagnosis.Diagnosis.plot`."""
    one = _chosen(of, levels, part)
    assert levels is not None
    fig = fig if fig is not None else go.Figure()
    f = np.arange(levels.hidden.size) / levels.duration
    shown = f <= 4.3 * one.order * of.shaft.rate
    row = levels.db[of._row(one)]
    fig.add_hrect(
        y0=one.chance[0], y1=one.chance[1], fillcolor="#888", opacity=0.15, line_width=0,
        annotation_text="lines by chance, median to 99 %", annotation_position="top left",
        annotation_bgcolor="rgba(255,255,255,0.8)",
    )  # fmt: skip
    line = {"color": COLOURS[0], "width": 1.0}
    fig.add_trace(
        go.Scatter(x=f[shown], y=row[shown], mode="lines", name="squared envelope", line=line)
    )
    _add_expected(fig, one)
    fig.update_xaxes(title_text="frequency / Hz")
    highest = max(float(row[shown].max()), one.chance[1])
    # Room above for labels and below for the marks of what was expected.
    fig.update_yaxes(title_text="level over median / dB", range=[_MARKS - 2.0, highest + 5.0])
    band = f"{NAMES[one.part]}, {one.band[0]:.0f} to {one.band[1]:.0f} Hz"
    own = f"{band}:<br>z {one.z:.1f}, threshold {of.threshold:.1f}"
    return finished(fig, {"title": {"text": own, "font": {"size": 15}}} | layout, height=420)


def _chosen(of: Diagnosis, levels: Levels | None, part: Part | None) -> Evidence:
    if levels is None:
        raise SceneError("part", repr(part), f"none: the record needs {of.why}")
    if part is None:
        return max((of.evidence[each] for each in ACCUSED), key=lambda one: one.z)
    if part not in of.evidence:
        raise SceneError("part", repr(part), f"one of {', '.join(of.evidence)}")
    return of.evidence[part]


def _add_expected(fig: go.Figure, one: Evidence) -> None:
    """Mark where lines were expected below the axis, and the significant ones at their tops."""
    name, colour, _, marker = SYMBOLS[one.part]
    places = [line.expected for line in one.lines]
    labels = [line.label.replace("f_r", "f<sub>r</sub>") for line in one.lines]
    fig.add_trace(
        go.Scatter(
            x=places, y=[_MARKS] * len(places), mode="markers", name="expected by nominal orders",
            marker={"symbol": "line-ns-open", "size": 12, "color": "#444"},
            text=[line.label for line in one.lines], hovertemplate="%{text}: %{x:.3f} Hz<extra></extra>",
        )
    )  # fmt: skip
    fig.add_trace(
        go.Scatter(
            x=[line.found for line in one.lines], y=[line.level for line in one.lines], mode="markers+text",
            name=f"{name}, order × {one.factor:.3f}", text=labels,
            textposition=[_beside(line.label) for line in one.lines],
            marker={"symbol": marker, "size": 9, "color": colour},
            hovertemplate="%{text}: %{x:.3f} Hz, %{y:.1f} dB<extra></extra>",
        )
    )  # fmt: skip


def _beside(label: str) -> str:
    """Return where the label of a line stands: that of a sideband away from its middle line."""
    return "top left" if " − " in label else "top right" if " + " in label else "top center"
