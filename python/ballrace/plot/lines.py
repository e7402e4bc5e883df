"""Fault lines drawn over a spectrum: a dash, a marker and labels for each fault."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from .._base.libraries import go
from .style import SYMBOLS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..spectra.bands import FaultBand


def add_lines(fig: go.Figure, bands: Sequence[FaultBand], top: float) -> None:
    """Draw lines from 0 to ``top`` where bands have their middle, with a marker and a label on top.

    The labels are upright, so that those of neighbours do not overlap. With several faults in one picture only the
    harmonics are labelled; sidebands show their name under the pointer.
    """
    faults = list(dict.fromkeys(band.fault for band in bands))
    for fault in faults:
        own = [band for band in bands if band.fault == fault]
        name, colour, dash, marker = SYMBOLS[fault]
        first = next((b for b in own if b.harmonic == 1 and not b.sideband), own[0])
        text = [part for band in own for part in (band.label, band.label, None)]
        trace = go.Scatter(
            x=[part for band in own for part in (band.centre, band.centre, None)],
            y=[part for _ in own for part in (0.0, top, None)],
            mode="lines+markers",
            line={"color": colour, "width": 1.3, "dash": dash},
            marker={"symbol": marker, "size": [part for _ in own for part in (0, 8, 0)]},
            text=text,
            name=f"{name}, {first.centre:.4g} Hz",
            hovertemplate="%{text}: %{x:.5g} Hz<extra></extra>",
            opacity=0.85,
        )
        fig.add_trace(trace)
        for band in own:
            if len(faults) == 1 or not band.sideband:
                _label(fig, band, colour)


def _label(fig: go.Figure, band: FaultBand, colour: str) -> None:
    size = 10 if band.sideband else 11
    fig.add_annotation(
        x=band.centre, y=1.0, xref="x", yref="y domain", yanchor="bottom", textangle=-90, showarrow=False,
        text=re.sub("f_([ro])", r"f<sub>\1</sub>", band.label), font={"size": size, "color": colour},
    )  # fmt: skip
