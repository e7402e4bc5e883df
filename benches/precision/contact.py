"""a. A contact: error of its normal force, friction and stiffness against its time."""

from __future__ import annotations

import statistics
from typing import TYPE_CHECKING, Any

import numpy as np

import ballrace as br
from ballrace.scene import ContactsProbe

from . import draw
from .setting import DURATION, FS, Effort, bearing, integrated, settled, states

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from numpy.typing import NDArray

NAME = "contact"
FIXED = (10, 20, 50, 100, 200, 400)
FITTED = (2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 24)
TRUE = "fitted 64"
SHIFT = 1e-7  # m: the stiffness is a difference over the shift of the outer ring
QUANTITIES = {
    "normal": "Normal force",
    "friction": "Friction force",
    "stiffness": "Stiffness",
}


def measure(*, quick: bool) -> list[dict[str, Any]]:
    """Compare on states along a settled run, healthy ones and ones over the spall.

    Forces are all those on the outer ring, as a vector of x, y, z; the stiffness is their change with the ring's
    height. Root mean square over the states, relative. The time is that of an evaluation of the whole bearing in a
    run over its loaded contacts, for eight contacts are evaluated at a time and one alone says little.
    """
    count = 10 if quick else 60
    run = integrated(bearing(cut=TRUE), Effort())
    visited = states(run, duration=DURATION, fs=count / DURATION, start=settled(0.1, TRUE))
    true = forces(TRUE, visited)
    loaded = loaded_contacts()
    cuts = [f"fitted {n}" for n in FITTED] + [f"fixed {n}" for n in FIXED]
    times = times_of_evaluation(cuts, 3 if quick else 7)
    rows = []
    for cut in cuts:
        found = forces(cut, visited)
        errors = {
            name: float(np.sqrt(np.sum((found[name] - true[name]) ** 2) / np.sum(true[name] ** 2)))
            for name in QUANTITIES
        }
        kind, count = cut.split()
        time = 1e9 * times[cut] / loaded
        rows.append({"slices": kind, "count": int(count), "time_ns": time, **errors})
    return rows


def loaded_contacts() -> float:
    """Return the mean number of loaded contacts over the run."""
    scene = bearing(cut=TRUE)
    probes = {
        f"row{row}": ContactsProbe(row=row, quantities=("load",)) for row in range(len(scene.rows))
    }
    watched = integrated(scene.replace({"probes": probes}), Effort())
    out = br.simulate(
        watched, duration=DURATION, fs=FS, start=settled(0.1, TRUE), threads=1, bandwidth=None
    )
    return sum(float(np.mean(out[column] > 0.0)) for column in out)


def forces(cut: str, visited: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
    """Return the quantities compared, each of shape (states, 3)."""
    model = br.Model(bearing(cut=cut))
    height = model.names.index("outer.y")

    def on_ring(state: NDArray[np.float64], origin: str) -> NDArray[np.float64]:
        return model.forces(0.0, state)[origin][0, :3]

    shift = np.zeros(len(model.names))
    shift[height] = SHIFT
    return {
        "normal": np.array([on_ring(y, "contact") for y in visited]),
        "friction": np.array([on_ring(y, "friction") for y in visited]),
        "stiffness": np.array(
            [on_ring(y + shift, "contact") - on_ring(y - shift, "contact") for y in visited]
        )
        / (2.0 * SHIFT),
    }


def times_of_evaluation(cuts: Iterable[str], rounds: int) -> dict[str, float]:
    """Return the wall time of a run over its evaluations [s], the cuts in turn, medians over the rounds."""
    walls: dict[str, list[float]] = {cut: [] for cut in cuts}
    for _ in range(rounds):
        for cut, mine in walls.items():
            scene = integrated(bearing(cut=cut), Effort())
            out = br.simulate(
                scene, duration=5e-4, fs=2e3, start=settled(0.1, TRUE), threads=1, bandwidth=None
            )
            mine.append(float(out.stats.wall_time) / float(out.stats.nfev))
    return {cut: statistics.median(mine) for cut, mine in walls.items()}


def draw_chart(rows: list[dict[str, Any]], path: Path) -> None:
    """Draw a panel a quantity."""
    figure, axes = draw.panels(list(QUANTITIES.values()))
    for ax, name in zip(axes, QUANTITIES, strict=True):
        for kind, colour in (("fitted", draw.BLUE), ("fixed", draw.ORANGE)):
            mine = [row for row in rows if row["slices"] == kind]
            x, y = [row["time_ns"] for row in mine], [row[name] for row in mine]
            unit = "nodes" if kind == "fitted" else "slices"
            draw.line(ax, x, y, f"{mine[-1]['count']} {kind} {unit}", colour)
            for row in mine:
                if row["count"] in (2, 6, 12, 24, 10, 50, 400) and row is not mine[-1]:
                    draw.point(ax, row["time_ns"], row[name], str(row["count"]), colour)
        ax.set_xlabel("time per loaded contact, ns")
    axes[0].set_ylabel("relative error")
    draw.save(figure, path)
