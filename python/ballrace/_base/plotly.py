"""plotly, imported where a picture is first drawn: ``from ._plotly import Figure``."""

from __future__ import annotations

from typing import Any

from .libraries import needed

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
    "Paused",
    "Scatter",
    "Scatter3d",
    "Scatterpolar",
    "get_plotlyjs",
    "make_subplots",
    "sample_colorscale",
]


class Paused(Figure):  # type: ignore[misc]
    """A figure with frames whose pages begin at rest, as :meth:`show` does; ``auto_play=True`` runs it at once."""

    def to_html(self, *given: Any, auto_play: bool = False, **options: Any) -> Any:
        return super().to_html(*given, auto_play=auto_play, **options)

    def write_html(self, *given: Any, auto_play: bool = False, **options: Any) -> Any:
        return super().write_html(*given, auto_play=auto_play, **options)
