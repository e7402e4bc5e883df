"""plotly, imported where a picture is first drawn: ``from ._plotly import Figure``."""

from __future__ import annotations

from ._libraries import needed

needed("plotly", "a picture", extra="plot")

from plotly.colors import sample_colorscale  # noqa: E402 (an error that says how to install it comes first)
from plotly.graph_objects import (  # noqa: E402
    Bar,
    Box,
    Figure,
    Frame,
    Heatmap,
    Mesh3d,
    Scatter,
    Scatter3d,
    Scatterpolar,
)
from plotly.offline import get_plotlyjs  # noqa: E402
from plotly.subplots import make_subplots  # noqa: E402

__all__ = [
    "Bar",
    "Box",
    "Figure",
    "Frame",
    "Heatmap",
    "Mesh3d",
    "Scatter",
    "Scatter3d",
    "Scatterpolar",
    "get_plotlyjs",
    "make_subplots",
    "sample_colorscale",
]
