"""The picture of a spall's width: the averaged pass with both events."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .._base.libraries import go
from ..errors import SceneError
from ..plot.style import COLOURS, DASHES, finished
from .verdict import NAMES

if TYPE_CHECKING:
    from .width import Sized


def size_picture(
    of: Sized | None, beside: Sized | None, fig: go.Figure | None, layout: dict[str, Any]
) -> go.Figure:
    """Draw an averaged pass; see :meth:`ballrace.diagnosis.Diagnosis.plot_size`."""
    fig = fig if fig is not None else go.Figure()
    _add_pass(fig, of, "this record", 0)
    if beside is not None:
        _add_pass(fig, beside, "beside it", 1)
    assert of is not None
    width = of.width
    assert width.part is not None
    assert width.spacing is not None
    for at, name in ((0.0, "falls in"), (1e3 * width.spacing, "hits the far edge")):
        fig.add_vline(x=at, line={"color": "#444", "dash": "dot"}, annotation_text=name)
    fig.update_xaxes(title_text="arc along the race since the first event / mm")
    fig.update_yaxes(title_text="squared envelope over its mean")
    title = f"{NAMES[width.part]}, events {1e3 * width.spacing:.2f} mm apart"
    return finished(fig, {"title": {"text": title, "font": {"size": 15}}} | layout, height=380)


def _add_pass(fig: go.Figure, of: Sized | None, name: str, line: int) -> None:
    if of is None or of.averaged is None or of.width.value is None:
        why = "no width was looked for" if of is None else of.width.why
        raise SceneError("width", "of " + name, f"one that is known: {why}")
    fig.add_trace(
        go.Scatter(
            x=1e3 * of.ball_diameter * of.averaged.arc, y=of.averaged.envelope, mode="lines",
            name=f"{name}: {1e3 * of.width.value:.2f} mm, {of.averaged.count} passes",
            line={"color": COLOURS[line], "dash": DASHES[line]},
        )
    )  # fmt: skip
