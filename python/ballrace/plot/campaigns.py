"""Pictures of many cases."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .._base.libraries import go, pl
from ..errors import SceneError
from ..scene.defect import SURFACES
from .maps import SHADES
from .names import feature, parameter
from .style import COLOURS, MARKERS, finished, wrapped

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..campaigns import Campaign


def campaign_map(
    done: Campaign | pl.DataFrame,
    x: str,
    y: str,
    value: str,
    *,
    logarithmic: bool = False,
    fig: go.Figure | None = None,
    **layout: Any,
) -> go.Figure:
    """Draw a feature of a campaign over two of its parameters: a cell, or a point, is the mean of its cases.

    Tables whose cells are mostly empty, such as those drawn at random, are points.

    Parameters
    ----------
    done : Campaign or DataFrame
        A campaign, or its manifest.
    x, y : str
        Columns of parameters.
    value : str
        Column of the feature.
    logarithmic : bool
        Whether shades follow the decimal logarithm.
    fig : plotly.graph_objects.Figure, optional
        Figure to draw into.
    **layout
        For ``fig.update_layout``.

    Raises
    ------
    SceneError
        There is no such column.

    Examples
    --------
    >>> import polars as pl, ballrace as br
    >>> table = pl.DataFrame({"load": [1.0, 2.0], "width": [0.1, 0.1], "rms": [3.0, 4.0]})
    >>> fig = br.plot.campaign_map(table, "load", "width", "rms")
    >>> fig.data[0].z.tolist()
    [[3.0, 4.0]]
    """
    table = _table(done, (x, y, value)).drop_nulls([x, y, value])
    mean = table.group_by(x, y).agg(pl.col(value).mean())
    fig = fig if fig is not None else go.Figure()
    quantity = feature(value)
    named = f"log₁₀ of {quantity}" if logarithmic else quantity
    cells = mean[x].n_unique() * mean[y].n_unique()
    drawn = _points if 2 * mean.height < cells else _cells
    fig.add_trace(drawn(mean, (x, y, value), logarithmic))
    axis = {} if drawn is _points else {"type": "category"}
    fig.update_xaxes(title_text=parameter(x), **axis)
    fig.update_yaxes(title_text=parameter(y), **axis)
    # Beside the bar there is no room for so many words.
    fig.add_annotation(
        text=wrapped(named, _LINE), x=0.0, y=1.02, xref="x domain", yref="y domain", xanchor="left",
        yanchor="bottom", align="left", showarrow=False,
    )  # fmt: skip
    return finished(fig, layout, height=440, margin={"t": 64 + 24 * ("title" in layout)})


def _shades(values: NDArray[np.float64], logarithmic: bool) -> NDArray[np.float64]:
    return np.log10(np.where(values > 0.0, values, np.nan)) if logarithmic else values


def _cells(mean: pl.DataFrame, columns: tuple[str, str, str], logarithmic: bool) -> go.Heatmap:
    """Draw the cases of a grid."""
    x, y, value = columns
    across, up = (np.unique(mean[name].to_numpy()) for name in (x, y))
    z = np.full((up.size, across.size), np.nan)
    places = (np.searchsorted(a, mean[name].to_numpy()) for a, name in ((up, y), (across, x)))
    z[tuple(places)] = mean[value].to_numpy()
    few = z.size <= 64
    labels = [["–" if np.isnan(v) else f"{v:.3g}" for v in line] for line in z]
    return go.Heatmap(
        x=[f"{v:.6g}" for v in across], y=[f"{v:.6g}" for v in up], z=_shades(z, logarithmic),
        colorscale=SHADES, text=labels, colorbar={"thickness": 14},
        texttemplate="%{text}" if few else None,
        hovertemplate=f"{x} %{{x}}, {y} %{{y}}: %{{text}}<extra></extra>",
    )  # fmt: skip


def _points(mean: pl.DataFrame, columns: tuple[str, str, str], logarithmic: bool) -> go.Scatter:
    """Draw cases that are no grid."""
    x, y, value = columns
    shades = _shades(mean[value].to_numpy(), logarithmic)
    marker = {"color": shades, "colorscale": SHADES, "colorbar": {"thickness": 14}, "size": 9}
    return go.Scatter(
        x=mean[x].to_numpy(), y=mean[y].to_numpy(), mode="markers", marker=marker,
        text=[f"{v:.3g}" for v in mean[value]],
        hovertemplate=f"{x} %{{x:.4g}}, {y} %{{y:.4g}}: %{{text}}<extra></extra>",
    )  # fmt: skip


def distribution(
    done: Campaign | pl.DataFrame,
    value: str,
    by: str | None = None,
    *,
    fig: go.Figure | None = None,
    **layout: Any,
) -> go.Figure:
    """Draw how a feature is distributed over the cases of a campaign, a box for each value of a column.

    Parameters
    ----------
    done : Campaign or DataFrame
        A campaign, or its manifest.
    value : str
        Column of the feature.
    by : str, optional
        Column that groups the cases by its values, such as ``fault_outer_race``.
    fig : plotly.graph_objects.Figure, optional
        Figure to draw into.
    **layout
        For ``fig.update_layout``.

    Raises
    ------
    SceneError
        There is no such column.

    Examples
    --------
    >>> import polars as pl, ballrace as br
    >>> table = pl.DataFrame({"rms": [3.0, 4.0, 9.0], "faulty": [False, False, True]})
    >>> [box.name for box in br.plot.distribution(table, "rms", by="faulty").data]
    ['faulty: no', 'faulty: yes']
    """
    table = _table(done, (value,) if by is None else (value, by)).drop_nulls(value)
    groups = {"all cases": table}
    if by is not None:
        parts = table.sort(by).group_by(by, maintain_order=True)
        of = _FAULTS.get(by, parameter(by))
        groups = {f"{of}: {_named(key)}": part for (key,), part in parts}
    fig = fig if fig is not None else go.Figure()
    for number, (name, part) in enumerate(groups.items()):
        style = {"color": COLOURS[number % len(COLOURS)], "symbol": MARKERS[number % len(MARKERS)]}
        points = "all" if part.height <= 200 else "outliers"
        box = go.Box(
            y=part[value].to_numpy(), name=name, boxpoints=points, marker=style, jitter=0.5
        )
        fig.add_trace(box)
    fig.update_yaxes(title_text=wrapped(feature(value), _LINE))
    if by is not None:
        ticks = [name.rpartition(": ")[2] for name in groups]
        title = wrapped(of, _LINE)
        fig.update_xaxes(title_text=title, tickvals=list(groups), ticktext=ticks)
    return finished(fig, layout, height=400, showlegend=False)


_LINE = 40
"""Characters of a line of words beside a picture as wide as a phone."""


_FAULTS = {f"fault_{on}": f"contact met a defect of the {on.replace('_', ' ')}" for on in SURFACES}


def _named(key: object) -> str:
    if isinstance(key, bool):
        return "yes" if key else "no"
    return "not known" if key is None else str(key)


def _table(done: Campaign | pl.DataFrame, names: tuple[str, ...]) -> pl.DataFrame:
    table: pl.DataFrame = done.manifest if hasattr(done, "manifest") else done
    for name in names:
        if name not in table.columns:
            raise SceneError("column", repr(name), f"one of {', '.join(table.columns)}")
    return table
