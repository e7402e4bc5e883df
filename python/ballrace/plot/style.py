"""How pictures look: colours with dashes and markers beside them, axis titles in words, and what a page adds."""

from __future__ import annotations

import difflib
import textwrap
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .._base.libraries import needed
from .._io.files import as_path
from .._io.whole import whole
from ..errors import SceneError

if TYPE_CHECKING:
    import os

    import plotly.graph_objects as go

COLOURS = ("#1f6fb4", "#c8452f", "#3a8f4a", "#7a53a6", "#a8700c", "#23808a")
"""Colours of lines, each of which stands out from white and, with its dash or marker, from the others."""

DASHES = ("solid", "dash", "dot", "dashdot", "longdash", "longdashdot")
MARKERS = ("circle", "square", "diamond", "triangle-up", "cross", "x")
SYMBOLS = {
    "outer_race": ("BPFO", COLOURS[1], "solid", "triangle-down"),
    "inner_race": ("BPFI", COLOURS[2], "dash", "square"),
    "ball": ("2·BSF", COLOURS[3], "dot", "diamond"),
    "cage": ("FTF", COLOURS[4], "dashdot", "cross"),
}
"""Style of every fault: its frequency's name, colour, dash and marker."""

CONFIG = {
    "displaylogo": False,
    "responsive": True,
    "showSendToCloud": False,
    "plotlyServerURL": "",
}
"""Options for ``fig.show(config=...)``, ``fig.to_html(config=...)``: no logo, no button that sends data away."""

_IMAGES = ("png", "jpeg", "jpg", "webp", "svg", "pdf")
"""Endings of pictures."""

_QUANTITIES = {
    "x": ("horizontal displacement", "µm", 1e6),
    "y": ("vertical displacement", "µm", 1e6),
    "z": ("axial displacement", "µm", 1e6),
    "vx": ("horizontal velocity", "mm/s", 1e3),
    "vy": ("vertical velocity", "mm/s", 1e3),
    "vz": ("axial velocity", "mm/s", 1e3),
    "ax": ("horizontal acceleration", "m/s²", 1.0),
    "ay": ("vertical acceleration", "m/s²", 1.0),
    "az": ("axial acceleration", "m/s²", 1.0),
    "theta": ("angle", "rad", 1.0),
    "omega": ("angular velocity", "rad/s", 1.0),
    "alpha": ("angular acceleration", "rad/s²", 1.0),
}
_BODIES = {"outer": "outer ring", "inner": "inner ring"}


def words(column: str) -> str:
    """Return what a column is, in words.

    Examples
    --------
    >>> words("outer.ay"), words("row0.ball3.inner.load"), words("sensor")
    ('vertical acceleration, outer ring', 'load, row 0 ball 3 inner race', 'sensor')
    """
    body, _, component = column.rpartition(".")
    if component in _QUANTITIES and body:
        return f"{_QUANTITIES[component][0]}, {_BODIES.get(body, _places(body))}"
    if not body:
        return column.replace("_", " ")
    race = body.rpartition(".")[2] in _BODIES
    return f"{component.replace('_', ' ')}, {_places(body)}{' race' if race else ''}"


def _places(body: str) -> str:
    for part in ("row", "ball", "link"):
        body = body.replace(part, f"{part} ")
    return body.replace(".", " ").replace("_", " ").replace("  ", " ").strip()


def unit(name: str) -> str:
    """Return a unit as it is printed.

    Examples
    --------
    >>> unit("m/s^2")
    'm/s²'
    """
    return name.replace("^2", "²").replace("^3", "³")


def title(what: str, units: str) -> str:
    """Return the title of an axis: what it shows and its unit, if there is one."""
    return f"{what} / {unit(units)}" if units else what


def wrapped(text: str, width: int) -> str:
    """Return a text in lines of at most ``width`` characters, so that no picture cuts it.

    Examples
    --------
    >>> wrapped("kurtosis, vertical acceleration, outer ring", 32)
    'kurtosis, vertical acceleration,<br>outer ring'
    """
    return "<br>".join(textwrap.wrap(text, width, break_long_words=False))


def finished(fig: go.Figure, layout: dict[str, Any], **own: Any) -> go.Figure:
    """Give a figure the look of all, then its own settings, and at last those of the caller.

    Raises
    ------
    SceneError
        The caller's are no properties of a layout.
    """
    known = list(fig.layout)
    for name, value in layout.items():
        # ``title_text`` is a property of the title, ``xaxis2`` another of ``xaxis``.
        if name.partition("_")[0].rstrip("0123456789") not in known:
            near = difflib.get_close_matches(name, known, n=3)
            hint = f", such as {', '.join(near)}" if near else ""
            allowed = f"an argument of this picture, or a property of plotly's layout{hint}"
            raise SceneError(name, repr(value), allowed)
    common: dict[str, Any] = {
        "template": "plotly_white",
        "font": {"size": 13, "color": "#222"},
        "margin": {"l": 64, "r": 16, "t": 64 if "title" in layout else 36, "b": 56},
        "legend": {"orientation": "h", "x": 0.0, "y": -0.2, "yanchor": "top"},
    }
    fig.update_layout(common)
    fig.update_layout(own)
    fig.update_xaxes(title_standoff=8, automargin=True)
    fig.update_yaxes(title_standoff=4, automargin=True)
    return fig.update_layout(layout)


def write(fig: go.Figure, path: str | os.PathLike[str]) -> None:
    """Write a figure as a page of its own that needs no network, plotly.js in it; or as a picture.

    Parameters
    ----------
    fig : plotly.graph_objects.Figure
        The figure.
    path : str or path
        File to write, ``.html``; ``.png``, ``.jpeg``, ``.webp``, ``.svg`` or ``.pdf`` is a picture, by kaleido,
        which draws in an installed Chrome or Chromium.

    Raises
    ------
    ImportError
        It is to be a picture, and kaleido is not installed (extra ``image``).
    OSError
        The file cannot be written.

    Examples
    --------
    >>> import ballrace as br, pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "section.html"
    ...     br.plot.write(br.plot.section(br.presets.deep_groove_6205()), path)
    ...     path.stat().st_size > 1_000_000
    True
    """
    kind = as_path(path).suffix.lower().removeprefix(".")
    if kind in _IMAGES:
        needed("kaleido", as_path(path).name, extra="image")
        with whole(path) as temporary:
            fig.write_image(temporary, format=kind)
        return
    text = fig.to_html(full_html=True, include_plotlyjs=True, config=CONFIG, auto_play=False)
    viewport = '<meta name="viewport" content="width=device-width, initial-scale=1" />'
    with whole(path) as temporary:
        Path(temporary).write_text(text.replace("<head>", f"<head>{viewport}", 1), encoding="utf-8")
