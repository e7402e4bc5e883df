"""The bearing in motion, in three dimensions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .._base.libraries import go
from .._base.numbers import real
from ..errors import SceneError
from .animation import check, player, samples
from .style import finished
from .turning import Turning

if TYPE_CHECKING:
    from ..signals import Signals


def animation3d(
    out: Signals,
    *,
    row: int = 0,
    start: float = 0.0,
    end: float | None = None,
    frames: int = 100,
    enlarged: float = 4.0,
    fig: go.Figure | None = None,
    **layout: Any,
) -> go.Figure:
    """Draw a row of a bearing as it runs, in three dimensions: rings cut open, balls, contacts, cage, defects.

    Patches of contact are ellipses after Hertz, coloured by their largest pressure and drawn enlarged. A spot on
    each ball shows how it rolls, about the bearing's axis also where it spins freely. Drag to turn the bearing,
    also while it runs; it stands until it is told to. Written by :func:`write`, 200 frames of a row of 13 balls or
    fewer take less than 6 MB.

    Parameters
    ----------
    out : Signals
        A run of a scene with the probes of :func:`probes`.
    row : int
        The row.
    start, end : float
        Part of the run that is shown [s]; by default all of it.
    frames : int
        Pictures, 2 to 500.
    enlarged : float
        How many times as large as they are patches of contact are drawn, 1 to 20.
    fig : plotly.graph_objects.Figure, optional
        Figure to draw into.
    **layout
        For ``fig.update_layout``.

    Raises
    ------
    SceneError
        An argument is not usable, or the run lacks a column.
    EquilibriumError
        The scene, without its defects, has no equilibrium: pressures are counted from it.

    Examples
    --------
    >>> import ballrace as br
    >>> scene = br.bearing("6205", speed_rpm=1800.0)
    >>> out = br.simulate(scene.replace({"probes": br.plot.probes(scene)}), duration=0.01)
    >>> fig = br.plot.animation3d(out, frames=20)
    >>> len(fig.frames)
    20
    """
    from .._base.plotly import Paused

    check(out, "inner.theta", row, frames)
    if not 1.0 <= real(enlarged) <= 20.0:
        raise SceneError("enlarged", repr(enlarged), "1 to 20")
    shown = samples(out, start, end, frames)
    t = 1e3 * out.t
    turning = Turning(out, row, enlarged)
    fig = fig if fig is not None else Paused()
    fig.add_traces(list(turning.still()))
    first = len(fig.data)
    fig.add_traces(turning.first(shown[0]))
    places = list(range(first, len(fig.data)))
    fig.frames = [go.Frame(data=turning.at(k), traces=places, name=f"{t[k]:.2f}") for k in shown]
    hidden = {"visible": False}
    scene = {
        "xaxis": hidden, "yaxis": hidden, "zaxis": hidden, "aspectmode": "data", "uirevision": "kept",
        "camera": {"eye": {"x": 0.9, "y": 0.7, "z": 1.5}, "up": {"x": 0.0, "y": 1.0, "z": 0.0}},
    }  # fmt: skip
    text = f"contacts drawn {enlarged:g} times as large"
    note = {"text": text, "x": 0.0, "y": 0.0, "xref": "paper", "yref": "paper", "showarrow": False}
    return finished(
        fig, layout, height=760, showlegend=False, scene=scene, annotations=[note], **player(fig, redraw=True)
    )  # fmt: skip
