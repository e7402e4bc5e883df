"""Log-log charts with a label at the end of every line."""

from __future__ import annotations

from typing import TYPE_CHECKING

import matplotlib as mpl
from matplotlib.text import Annotation
from matplotlib.ticker import LogLocator, NullLocator

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

mpl.use("svg")
mpl.rcParams.update(
    {
        "svg.hashsalt": "ballrace",
        "svg.fonttype": "none",
        "figure.dpi": 72,
        "font.sans-serif": ["DejaVu Sans"],
        "font.size": 9,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.grid": True,
        "axes.titlelocation": "left",
        "axes.titlesize": 10,
        "grid.color": "#e6e6e6",
        "lines.markersize": 3.5,
    }
)

import matplotlib.pyplot as plt  # noqa: E402

BLUE, ORANGE, GREEN, RED, PURPLE, GREY, BROWN, BLACK = (
    "#1f5fa8",
    "#d9730d",
    "#2e8540",
    "#b3261e",
    "#7b4fa3",
    "#8a8a8a",
    "#8c5a2b",
    "#222222",
)


BEHIND = {"facecolor": "white", "alpha": 0.7, "pad": 0.3, "linewidth": 0}
"""A label stays readable across a line, and a text in the file."""


def panels(titles: list[str], rows: int = 1) -> tuple[Figure, list[Axes]]:
    """Return a figure of panels with logarithmic axes."""
    columns = len(titles) // rows
    figure, grid = plt.subplots(
        rows, columns, figsize=(4.6 * columns, 3.6 * rows), squeeze=False, layout="constrained"
    )
    axes = [ax for line in grid for ax in line]
    for ax, title in zip(axes, titles, strict=True):
        ax.set(title=title, xscale="log", yscale="log")
        ax.minorticks_off()
    return figure, axes


def few_ticks(ax: Axes) -> None:
    """Put plain numbers below, 1, 2, 5 within less than two decades, and powers of ten at the side."""
    low, high = ax.get_xlim()
    if ax.get_xscale() == "log":
        subs = (1.0, 2.0, 5.0) if high < 100.0 * low else (1.0,)
        ax.xaxis.set_major_locator(LogLocator(subs=subs))
        ax.xaxis.set_major_formatter(lambda x, _: f"{x:g}")
        ax.xaxis.set_minor_locator(NullLocator())
    ax.yaxis.set_minor_locator(NullLocator())


def line(
    ax: Axes, x: list[float], y: list[float], label: str, colour: str, *, style: str = "o-"
) -> None:
    """Draw a line with its label at its end."""
    ax.plot(x, y, style, color=colour, linewidth=1.3)
    if label and x:
        ax.annotate(
            label,
            (x[-1], y[-1]),
            xytext=(5, 0),
            textcoords="offset points",
            color=colour,
            fontsize=8,
            va="center",
            annotation_clip=False,
            bbox=BEHIND,
        )


def level(ax: Axes, y: float, label: str, colour: str = GREY) -> None:
    """Draw a horizontal line with its label at the right edge."""
    ax.axhline(y, color=colour, linewidth=0.8, linestyle="--")
    ax.annotate(
        label,
        (1.0, y),
        xycoords=("axes fraction", "data"),
        xytext=(4, 0),
        textcoords="offset points",
        color=colour,
        fontsize=8,
        va="center",
        annotation_clip=False,
    )


def save(figure: Figure, path: Path) -> None:
    """Move labels off each other and write the picture."""
    for ax in figure.axes:
        few_ticks(ax)
    figure.canvas.draw()
    figure.set_layout_engine("none")  # it would move the labels again
    for ax in figure.axes:
        part([text for text in ax.texts if isinstance(text, Annotation)])
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)


def part(texts: list[Annotation]) -> None:
    """Push labels that overlap apart, up and down."""
    for _ in range(200):
        moved = False
        texts.sort(key=lambda text: text.get_window_extent().y0)
        for i, low in enumerate(texts):
            for high in texts[i + 1 :]:
                a, b = (text.get_window_extent().padded(1.0) for text in (low, high))
                if not a.overlaps(b):
                    continue
                shift = 0.5 * (a.y1 - b.y0) + 0.2
                for text, sign in ((low, -1.0), (high, 1.0)):
                    x, y = text.xyann
                    text.xyann = (x, y + sign * shift)
                moved = True
        if not moved:
            return


def point(ax: Axes, x: float, y: float, label: str, colour: str) -> None:
    """Write a label beside a point, if there is one."""
    if not label:
        return
    ax.annotate(
        label,
        (x, y),
        xytext=(4, 3),
        textcoords="offset points",
        color=colour,
        fontsize=7,
        annotation_clip=False,
        bbox=BEHIND,
    )
