"""f. Steps over a pit: error against evaluations, by the largest step.

A 6205 under 400 N and 150 N with a pit of 0.178 mm that a ball meets a millisecond after the start, or has, at a
usual speed and at one where the pit, not the contacts' frequency, limits steps. The error is that of the outer
ring's vertical acceleration over 2 ms, relative, L2, at 200 kHz; the truth has steps of 0.1 µs at rtol 1e-10.
"""

from __future__ import annotations

import math
from functools import cache
from typing import TYPE_CHECKING, Any

import ballrace as br

from . import draw
from .setting import best, error

if TYPE_CHECKING:
    from pathlib import Path

    import numpy as np
    from numpy.typing import NDArray

NAME = "pits"
COLUMN = "outer.ay"
SPEEDS = (1797.0, 20_000.0)
METHODS = ("adams", "dormand-prince")
CAPS = (8.0, 4.0, 2.0, 1.0, 0.5, 0.25)
"""Largest steps over the default one."""
TOLERANCES = (1e-3, 1e-5, 1e-7)
BEFORE = 1e-3
"""Time before a ball meets the pit [s]."""


def bearing(on: str, speed_rpm: float) -> br.Scene:
    """Return the bearing whose ball 0 meets a pit soon."""
    scene = br.presets.deep_groove_6205(400.0, 150.0, speed_rpm)
    shaft, row = speed_rpm * math.pi / 30.0, scene.rows[0]
    gamma = row.ball_diameter / row.pitch_diameter
    orbit = 0.5 * (1.0 - gamma) * shaft
    ahead = {
        "outer_race": orbit,
        "inner_race": orbit - shaft,
        "ball": orbit + 0.5 * (1.0 / gamma - gamma) * shaft,
    }[on]
    pit = br.defects.pit(
        on=on,  # type: ignore[arg-type]
        diameter_mm=0.178,
        angle=-math.pi / 2.0 + ahead * BEFORE,
        ball=0 if on == "ball" else None,
    )
    return scene.replace({"defects": {"pit": pit}})


def run(scene: br.Scene, method: str, rtol: float, max_step: float | None) -> br.Signals:
    """Run it with steps of at most so many seconds, or of its own."""
    given = scene.replace(
        {
            "solver.method": method,
            "solver.frequency_cap": max_step is None,
            "solver.max_step": max_step,
            "solver.rtol": rtol,
        }
    )
    return br.simulate(given, duration=2e-3, fs=200e3, threads=1, bandwidth=None, settle=0.0)


@cache
def truth(on: str, speed_rpm: float) -> NDArray[np.float64]:
    """Return the signal at steps of 0.1 µs."""
    return run(bearing(on, speed_rpm), "dormand-prince", 1e-10, 1e-7)[COLUMN]


def measure(*, quick: bool) -> list[dict[str, Any]]:
    """Scan largest steps and tolerances of both methods, and their defaults."""
    rows = []
    for speed in SPEEDS:
        for on in ("outer_race",) if quick else ("outer_race", "inner_race", "ball"):
            scene = bearing(on, speed)
            for method in METHODS:
                own = run(scene, method, 1e-7, None)
                step = float(own.provenance.max_step)
                labels = {"speed_rpm": speed, "on": on, "method": method}
                rows.append(
                    {**labels, "rtol": 1e-7, "cap": math.nan, **judged(own, truth(on, speed))}
                )
                rows += [
                    {
                        **labels,
                        "rtol": rtol,
                        "cap": cap,
                        **judged(run(scene, method, rtol, cap * step), truth(on, speed)),
                    }
                    for cap in ((4.0, 1.0) if quick else CAPS)
                    for rtol in ((1e-7,) if quick else TOLERANCES)
                ]
    return rows


def judged(out: br.Signals, true: NDArray[np.float64]) -> dict[str, Any]:
    """Return what a run took, and how far it is off."""
    return {
        "max_step_us": 1e6 * float(out.provenance.max_step),
        "error": error(out[COLUMN], true),
        "evaluations": int(out.stats.nfev),
    }


def cheapest(rows: list[dict[str, Any]]) -> list[str]:
    """Say what the defaults reach, and the same method with four times their steps."""
    without_cap = [row for row in rows if math.isnan(row["cap"])]
    lines = []
    for row in without_cap:
        alike = ("speed_rpm", "on", "method", "rtol")
        longer = next(
            r for r in rows if r["cap"] == 4.0 and all(r[key] == row[key] for key in alike)
        )
        lines.append(
            f"{row['on']}, {row['speed_rpm']:g} 1/min, {row['method']}: step {row['max_step_us']:.2f} µs, "
            f"{row['evaluations']} evaluations, {row['error']:.1e}; four times the step "
            f"{longer['evaluations']}, {longer['error']:.1e}"
        )
    return lines


def draw_chart(rows: list[dict[str, Any]], path: Path) -> None:
    """Draw the best of every method over steps and tolerances, for the outer race; crosses are defaults."""
    figure, axes = draw.panels([f"Pit of 0.178 mm, {speed:g} 1/min" for speed in SPEEDS])
    for ax, speed in zip(axes, SPEEDS, strict=True):
        for method, colour in zip(METHODS, (draw.RED, draw.BLUE), strict=True):
            mine = [
                row
                for row in rows
                if (row["speed_rpm"], row["on"], row["method"]) == (speed, "outer_race", method)
            ]
            front = best([row for row in mine if not math.isnan(row["cap"])], "evaluations")
            x, y = [r["evaluations"] for r in front], [r["error"] for r in front]
            draw.line(ax, x, y, method, colour)
            own = next(row for row in mine if math.isnan(row["cap"]))
            ax.plot([own["evaluations"]], [own["error"]], "x", color=colour, markersize=8)
        ax.set_xlabel("evaluations for 2 ms")
    axes[0].set_ylabel("integration error of outer.ay")
    draw.save(figure, path)
