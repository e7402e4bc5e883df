"""d. Features of half a second: rms, kurtosis and the line of the outer ring's ball pass in the envelope."""

from __future__ import annotations

import math
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

import numpy as np

import ballrace as br

from . import draw
from .contact import times_of_evaluation
from .setting import COLUMN, DEFAULT, Effort, bearing, integrated, settled

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

NAME = "features"
TRUE = "fitted 24"
FS = 50e3
BAND = (500.0, 20e3)  # Hz
PERTURBATION = 1e-12  # m
FEATURES = ("rms", "kurtosis", "bpfo_line")
CHOICES = (
    *((f"fitted {n}", Effort(cap=1.5, rtol=1e-4)) for n in (3, 4, 6, 8, 12, 16)),
    *((f"fixed {n}", Effort(cap=1.5, rtol=1e-4)) for n in (20, 50, 100, 200)),
    *(("fitted 6", Effort(cap=cap, rtol=1e-3)) for cap in (2.0, 3.0, math.inf)),
    ("fitted 6", Effort(cap=math.inf, rtol=1e-2)),
    ("fitted 6", Effort(cap=0.5, rtol=1e-6)),
    *(("fitted 6", Effort("adams", rtol, 0.9)) for rtol in (1e-4, 1e-6)),
    ("fitted 6", DEFAULT),
)


def measure(*, quick: bool) -> list[dict[str, Any]]:
    """Compare single runs with the mean of an ensemble, whose spread is the noise of a single run.

    Two runs at a time, one thread each. Every choice runs from three perturbed starts; ``error_…`` is the
    root mean square of the three from the ensemble's mean, ``bias_…`` that of their mean.
    """
    duration, members = (0.1, 4) if quick else (0.5, 12)
    best = Effort(cap=1.0, rtol=1e-6)
    jobs = [(TRUE, best, seed) for seed in range(members)]
    repeats = 1 if quick else 3
    jobs += [(cut, effort, seed) for cut, effort in CHOICES for seed in range(repeats)]
    for cut in {cut for cut, _, _ in jobs}:
        settled(0.1, cut)
    with ThreadPoolExecutor(2) as pool:
        found = list(pool.map(lambda job: run(*job, duration), jobs))
    ensemble, single = found[:members], found[members:]
    rows = [summary("ensemble", TRUE, best, ensemble, ensemble)]
    for i, (cut, effort) in enumerate(CHOICES):
        mine = single[i * repeats : (i + 1) * repeats]
        rows.append(summary("choice", cut, effort, mine, ensemble))
    add_times(rows, 3 if quick else 15)
    return rows


def add_times(rows: list[dict[str, Any]], rounds: int) -> None:
    """Add what the evaluations take, those of all slices timed in turn: long runs meet other work on the cores."""
    times = times_of_evaluation(dict.fromkeys(row["slices"] for row in rows), rounds)
    for row in rows:
        row["time_ms"] = 1e3 * row["evaluations"] * times[row["slices"]]


def run(cut: str, effort: Effort, seed: int, duration: float) -> dict[str, float]:
    """Return the features and the cost of a run from a start perturbed by a picometre."""
    scene = integrated(bearing(cut=cut), effort)
    start = settled(0.1, cut).copy()
    names = br.Model(scene).names
    places = [i for i, name in enumerate(names) if name.rsplit(".", 1)[1] in {"x", "y", "z"}]
    start[places] += PERTURBATION * np.random.default_rng(seed).standard_normal(len(places))
    out = br.simulate(scene, duration=duration, fs=FS, start=start, threads=1, bandwidth=None)
    return {
        **features(out[COLUMN], scene),
        "evaluations": float(out.stats.nfev),
    }


def features(x: NDArray[np.float64], scene: br.Scene) -> dict[str, float]:
    """Return rms [m/s²], kurtosis and the envelope's line at the ball pass [m²/s⁴]."""
    centred = x - x.mean()
    power = float(np.mean(centred**2))
    near = br.frequencies.of_row(scene.rows[0]).bpfo * 30.0
    squared = br.spectra.squared_envelope(x, FS, BAND)
    _, line = br.spectra.line(squared, FS, near=near, width=0.05 * near)
    return {
        "rms": math.sqrt(power),
        "kurtosis": float(np.mean(centred**4)) / power**2,
        "bpfo_line": line,
    }


def summary(
    kind: str,
    cut: str,
    effort: Effort,
    runs: list[dict[str, float]],
    ensemble: list[dict[str, float]],
) -> dict[str, Any]:
    """Return a row of the table."""
    row: dict[str, Any] = {
        "kind": kind,
        "slices": cut,
        "method": effort.method,
        "cap": effort.cap,
        "rtol": effort.rtol,
    }
    row["evaluations"] = float(np.median([r["evaluations"] for r in runs]))
    for name in FEATURES:
        mean = float(np.mean([r[name] for r in ensemble]))
        apart = np.array([r[name] for r in runs]) / mean - 1.0
        row[name] = float(np.mean([r[name] for r in runs]))
        row[f"error_{name}"] = float(np.sqrt(np.mean(apart**2)))
        row[f"bias_{name}"] = float(np.mean(apart))
    return row


def draw_chart(rows: list[dict[str, Any]], path: Path) -> None:
    """Draw a panel a feature, with the noise of a single run as a band."""
    figure, axes = draw.panels(["rms", "Kurtosis", "Line at the ball pass of the outer ring"])
    noise, *choices = rows
    default = [row for row in choices if row["method"] == "adams"]
    choices = [row for row in choices if row not in default]
    plain = [row for row in choices if row["rtol"] == 1e-4]
    families = (
        ([row for row in plain if row["slices"].startswith("fitted")], draw.BLUE, "o-"),
        ([row for row in plain if row["slices"].startswith("fixed")], draw.ORANGE, "o-"),
        ([row for row in choices if row["rtol"] != 1e-4], draw.GREEN, "o"),
        (default, draw.RED, "o"),
    )
    for ax, name in zip(axes, FEATURES, strict=True):
        ax.axhspan(1e-6, noise[f"error_{name}"], color="#ececec", zorder=0)
        for family, colour, style in families:
            x, y = [r["time_ms"] for r in family], [r[f"error_{name}"] for r in family]
            draw.line(ax, x, y, "", colour, style=style)
            for row, at, error in zip(family, x, y, strict=True):
                draw.point(ax, at, error, label(row), colour)
        ax.set_xlabel("time of the evaluations of 0.5 s, ms")
        errors = [row[f"error_{name}"] for row in rows]
        ax.set_ylim(min(errors) / 3.0, max(errors) * 2.0)
        ax.text(
            0.02,
            0.02,
            "grey: chance, the spread of runs 1e-12 m apart",
            fontsize=7,
            color="#666666",
            transform=ax.transAxes,
        )
    axes[0].set_ylabel("relative error")
    draw.save(figure, path)


def label(row: dict[str, Any]) -> str:
    """Return what a point is, where it is worth a label."""
    kind, count = row["slices"].split()
    if kind == "fixed":
        return f"{count} slices"
    if row["method"] == "adams":
        return "default" if row["rtol"] == 1e-7 else f"{row['rtol']:.0e}".replace("e-0", "e-")
    if row["rtol"] == 1e-4:
        return {"4": "4 nodes", "8": "8", "16": "16 nodes"}.get(count, "")
    if math.isinf(row["cap"]):
        return f"no cap, rtol {row['rtol']:.0e}".replace("e-0", "e-")
    return ""
