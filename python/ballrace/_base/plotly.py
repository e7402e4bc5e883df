"""plotly, or the error that says how to install it; its ``go`` is that of :mod:`ballrace._base.libraries`."""

from __future__ import annotations

from typing import Any

from .libraries import needed

needed("plotly", "a picture", extra="plot")

import plotly.graph_objects as go  # noqa: E402 (an error that says how to install it comes first)
from plotly.colors import sample_colorscale  # noqa: E402
from plotly.offline import get_plotlyjs  # noqa: E402
from plotly.subplots import make_subplots  # noqa: E402

__all__ = ["Paused", "get_plotlyjs", "go", "make_subplots", "sample_colorscale"]


class Paused(go.Figure):  # type: ignore[misc]
    """A figure with frames whose pages begin at rest, as :meth:`show` does; ``auto_play=True`` runs it at once."""

    def to_html(self, *given: Any, auto_play: bool = False, **options: Any) -> Any:
        return super().to_html(*given, auto_play=auto_play, **options)

    def write_html(self, *given: Any, auto_play: bool = False, **options: Any) -> Any:
        return super().write_html(*given, auto_play=auto_play, **options)
