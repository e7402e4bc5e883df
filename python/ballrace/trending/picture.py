"""The picture of a trend."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .._base.libraries import go
from ..plot.style import COLOURS, DASHES, MARKERS, finished
from ..plot.times import stack
from .quantities import FOLLOWED

if TYPE_CHECKING:
    from .result import Trend

_NAMES = {
    "rms": "root mean square",
    "velocity": "velocity",
    "crest_factor": "crest factor",
    "kurtosis": "kurtosis",
    "outer_race.acceleration": "at BPFO",
    "inner_race.acceleration": "at BPFI",
    "ball.acceleration": "at 2·BSF",
    "outer_race.lines": "lines of BPFO",
    "inner_race.lines": "lines of BPFI",
    "ball.lines": "lines of 2·BSF",
}


def picture(of: Trend, fig: go.Figure | None, layout: dict[str, Any]) -> go.Figure:
    """Draw a trend; see :meth:`ballrace.trending.Trend.plot`."""
    fig = fig if fig is not None else stack(("z of the parts", "quantities over their limits"))
    time = of.table["time"].to_numpy()
    parts = [name for name in of.table.columns if name.endswith(".z")]
    for number, name in enumerate(parts):
        part = name.removesuffix(".z").replace("_", " ")
        _add(fig, 1, time, of.table[name].to_numpy(), name=f"z, {part}", number=number)
    shown = [name for name in FOLLOWED if name in of.limits]
    for number, name in enumerate(shown, start=len(parts)):
        value = of.table[name].to_numpy() / of.limits[name]
        _add(fig, 2, time, value, name=_NAMES[name], number=number)
    fig.add_hline(y=1.0, line={"color": "#444", "dash": "dash", "width": 1}, row=2, col=1)
    fig.add_vrect(
        x0=time[0], x1=time[of.baseline - 1], fillcolor="#888", opacity=0.15, line_width=0, row="all", col=1
    )  # fmt: skip
    if of.departed is not None:
        fig.add_vline(x=time[of.departed], line={"color": COLOURS[1], "width": 2}, row="all", col=1)
    fig.update_yaxes(title_text="z", row=1, col=1)
    fig.update_yaxes(title_text="value / limit", type="log", row=2, col=1)
    fig.update_xaxes(title_text="time", row=2, col=1)
    return finished(fig, layout, height=560)


def _add(fig: go.Figure, row: int, time: Any, value: Any, *, name: str, number: int) -> None:
    line = {
        "color": COLOURS[number % len(COLOURS)],
        "dash": DASHES[number % len(DASHES)],
        "width": 1.3,
    }
    marker = {"symbol": MARKERS[number % len(MARKERS)], "size": 6}
    fig.add_trace(
        go.Scatter(x=time, y=value, name=name, mode="lines+markers", line=line, marker=marker),
        row=row, col=1,
    )  # fmt: skip
