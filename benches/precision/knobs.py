"""e. The knobs: what slip speed, damping, step cap, slices and threads cost."""

from __future__ import annotations

import statistics
from typing import TYPE_CHECKING, Any

import ballrace as br

from . import draw
from .setting import DEFAULT, Effort, bearing, integrated, largest_step, settled, slices

if TYPE_CHECKING:
    from pathlib import Path

NAME = "knobs"
DURATION = 3e-3
PRESET = DEFAULT
SLIP_SPEEDS = (1e-3, 3e-3, 1e-2, 3e-2, 1e-1, 3e-1)
KNOBS: dict[str, tuple[float, ...]] = {
    "slip speed, m/s": SLIP_SPEEDS,
    "slip speed, m/s (Dormand-Prince)": SLIP_SPEEDS,
    "damping, s/m": (0.02, 0.2, 1.0, 5.0, 20.0),
    "step cap": (0.1, 0.25, 0.5, 0.9, 1.0),
    "fitted nodes": (4, 6, 8, 12, 16, 24, 32),
    "fixed slices": (20, 50, 100, 200, 400),
    "threads, 6 nodes": (1, 2),
    "threads, 400 slices": (1, 2),
}


def measure(*, quick: bool) -> list[dict[str, Any]]:
    """Run 3 ms from the settled start with one knob turned, all in turn; medians, over the untouched run's."""
    points = [(knob, at) for knob, values in KNOBS.items() for at in values]
    scenes = {point: turned(*point) for point in points}
    walls: dict[tuple[str, float], list[float]] = {point: [] for point in points}
    evaluations = {}
    for _ in range(2 if quick else 9):
        for point in points:
            threads = int(point[1]) if point[0].startswith("threads") else 1
            out = br.simulate(
                scenes[point],
                duration=DURATION,
                fs=1e3,
                start=settled(0.1, "fitted 6"),
                threads=threads,
                bandwidth=None,
            )
            walls[point].append(float(out.stats.wall_time))
            evaluations[point] = int(out.stats.nfev)
    untouched = ("step cap", 0.9)
    return [
        {
            "knob": knob,
            "value": at,
            "evaluations": evaluations[knob, at],
            "wall_ms": 1e3 * statistics.median(walls[knob, at]),
            "evaluations_ratio": evaluations[knob, at] / evaluations[untouched],
            "wall_ratio": statistics.median(walls[knob, at]) / statistics.median(walls[untouched]),
        }
        for knob, at in points
    ]


def turned(knob: str, at: float) -> br.Scene:
    """Return the preset with a knob turned."""
    scene = integrated(bearing(), PRESET)
    if knob.startswith("slip speed"):
        if "Dormand" in knob:
            scene = integrated(bearing(), Effort())
        return scene.replace({"friction.coulomb.slip_speed": at})
    if knob.startswith("threads"):
        return scene.replace({"contact.slices": slices("fixed 400")}) if "400" in knob else scene
    if knob.startswith("damping"):
        return scene.replace({"contact.damping": at})
    if knob == "step cap":
        return scene.replace({"solver.max_step": at * largest_step()})
    return scene.replace({"contact.slices": slices(f"{knob.split(maxsplit=1)[0]} {at:g}")})


def draw_chart(rows: list[dict[str, Any]], path: Path) -> None:
    """Draw a panel a knob: evaluations and wall time over the preset's."""
    titles = ["Slip speed, m/s", "Damping, s/m", "Step cap", "Nodes or slices", "Threads"]
    figure, axes = draw.panels([*titles, ""], rows=2)
    axes.pop().remove()
    lines = {
        "slip speed, m/s": (0, "default", draw.BLUE),
        "slip speed, m/s (Dormand-Prince)": (0, "Dormand–Prince", draw.RED),
        "damping, s/m": (1, "", draw.BLUE),
        "step cap": (2, "", draw.BLUE),
        "fitted nodes": (3, "fitted", draw.BLUE),
        "fixed slices": (3, "fixed", draw.ORANGE),
        "threads, 6 nodes": (4, "6 nodes", draw.BLUE),
        "threads, 400 slices": (4, "400 fixed", draw.ORANGE),
    }
    for knob, (i, label, colour) in lines.items():
        mine = [row for row in rows if row["knob"] == knob]
        x = [row["value"] for row in mine]
        wall = [row["wall_ratio"] for row in mine]
        draw.line(axes[i], x, [row["evaluations_ratio"] for row in mine], "", colour, style="o:")
        draw.line(axes[i], x, wall, label, colour)
        axes[i].set_ylim(0.5, 60.0)
    axes[4].set(xscale="linear", xticks=[1, 2], xlim=(0.8, 2.4))
    for i in (0, 3):
        axes[i].set_ylabel("time over the preset's\n(dotted: evaluations)")
    draw.save(figure, path)
