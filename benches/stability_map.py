"""Where each method works: slip speed x damping x tolerance, as a table (CSV) and a picture (SVG).

    python benches/stability_map.py -o FOLDER            # the whole map, some minutes on two cores
    python benches/stability_map.py -o FOLDER --quick    # a coarse one, half a minute

Each run is the faulted wheel bearing at +3 kN from equilibrium over 2 ms, in which a ball crosses the spall; its
error is that of the outer ring's vertical acceleration against rtol 1e-10 (relative, L2). Marks:

- *works*: no warning, error of at most 10 %;
- *slowly*: the same at more than 4e6 evaluations a simulated second, five times what the preset takes;
- *warns*: the run came to its end with an ``AccuracyWarning``;
- *refuses*: the run ended with an error, or was given up after a minute;
- *lies*: no warning, and an error of more than 10 %. There should be none.
"""

from __future__ import annotations

import argparse
import csv
import itertools
import math
import time
import warnings
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

import ballrace as br

if TYPE_CHECKING:
    from collections.abc import Iterable

DURATION = 2e-3
LARGEST_ERROR = 0.1
SLOW = 4e6  # evaluations a simulated second
PATIENCE = 60.0  # s
COLUMN = "outer.ay"
COLOURS = {
    "works": "#3a923a",
    "slowly": "#a8d08d",
    "warns": "#f2b134",
    "refuses": "#8c8c8c",
    "lies": "#c03028",
}


@dataclass(frozen=True)
class Grid:
    """What is varied: slip speeds [m/s], damping [s/m], relative tolerances."""

    slip_speeds: tuple[float, ...] = (1e-4, 1e-3, 1e-2, 1e-1)
    dampings: tuple[float, ...] = (0.0, 0.2, 1.0, 5.0, 20.0)
    tolerances: tuple[float, ...] = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7)


QUICK = Grid((1e-3, 1e-2, 1e-1), (0.0, 0.2, 5.0), (1e-2, 1e-4, 1e-6))


@dataclass(frozen=True)
class Point:
    """A run and what came of it."""

    method: str
    slip_speed: float
    damping: float
    rtol: float
    mark: str
    error: float
    residual: float
    evaluations: int
    wall_time: float


def bearing(slip_speed: float, damping: float) -> br.Scene:
    """Return the wheel bearing, turned so that a ball crosses the spall about 1.2 ms after the start."""
    scene = br.presets.wheel_bearing(axial_load=3000.0)
    first = -math.pi / 2.0 - 76.0 * 1.2e-3
    return scene.replace(
        {
            "rows[0].start_angle": first,
            "rows[1].start_angle": first + math.pi / 13.0,
            "friction.coulomb.slip_speed": slip_speed,
            "contact.damping": damping,
        }
    )


def simulate(scene: br.Scene, rtol: float, method: str, seconds: float = math.inf) -> br.Signals:
    """Run a scene by a method, or give it up; ``default`` leaves the choice to ``ballrace``."""
    begun = time.perf_counter()

    def patience(_: float) -> None:
        if time.perf_counter() - begun > seconds:
            raise TimeoutError

    chosen = {} if method == "default" else {"method": method}
    return br.simulate(
        scene,
        duration=DURATION,
        fs=200e3,
        rtol=rtol,
        threads=1,
        progress=patience,
        **chosen,
        settle=0.0,
        bandwidth=None,
    )


def judge(method: str, slip_speed: float, damping: float, rtol: float, true: br.Signals) -> Point:
    """Run one point of the map."""
    begun = time.perf_counter()
    try:
        out = simulate(bearing(slip_speed, damping), rtol, method, PATIENCE)
    except (br.BallraceError, TimeoutError):
        waited = time.perf_counter() - begun
        return Point(method, slip_speed, damping, rtol, "refuses", math.nan, math.nan, 0, waited)
    truth = true[COLUMN]
    error = float(np.linalg.norm(out[COLUMN] - truth) / np.linalg.norm(truth))
    evaluations = int(out.stats.nfev)
    # What the reference says as well is of the scene.
    if not set(out.warnings) <= set(true.warnings):
        mark = "warns"
    elif error > LARGEST_ERROR:
        mark = "lies"
    else:
        mark = "slowly" if evaluations > SLOW * DURATION else "works"
    residual = float(out.stats.acceleration_residual)
    waited = time.perf_counter() - begun
    return Point(method, slip_speed, damping, rtol, mark, error, residual, evaluations, waited)


def survey(grid: Grid, methods: Iterable[str], workers: int) -> list[Point]:
    """Run the whole map."""
    places = list(itertools.product(grid.slip_speeds, grid.dampings))
    with ThreadPoolExecutor(workers) as pool, warnings.catch_warnings():
        warnings.simplefilter("ignore", br.AccuracyWarning)
        truths = dict(
            zip(
                places,
                pool.map(lambda p: simulate(bearing(*p), 1e-10, "default"), places),
                strict=True,
            )
        )
        runs = [
            (method, *place, rtol, truths[place])
            for method, place, rtol in itertools.product(methods, places, grid.tolerances)
        ]
        return list(pool.map(lambda run: judge(*run), runs))


def write(points: list[Point], path: Path) -> None:
    """Write the table."""
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(asdict(points[0]))
        for point in points:
            entries = asdict(point).values()
            table.writerow([f"{x:.3g}" if isinstance(x, float) else x for x in entries])


def draw(points: list[Point], grid: Grid, path: Path) -> None:
    """Draw the map: a panel a method and damping, a square a slip speed and tolerance."""
    import matplotlib as mpl

    mpl.use("svg")
    import matplotlib.pyplot as plt

    mpl.rcParams["svg.hashsalt"] = "ballrace"
    methods = list(dict.fromkeys(point.method for point in points))
    figure, panels = plt.subplots(
        len(methods),
        len(grid.dampings),
        figsize=(2.4 * len(grid.dampings) + 1.0, 3.2 * len(methods) + 0.8),
        squeeze=False,
        sharex=True,
        sharey=True,
        layout="constrained",
    )
    for (i, method), (j, damping) in itertools.product(
        enumerate(methods), enumerate(grid.dampings)
    ):
        panel = panels[i, j]
        for point in points:
            if (point.method, point.damping) != (method, damping):
                continue
            x, y = grid.slip_speeds.index(point.slip_speed), grid.tolerances.index(point.rtol)
            panel.add_patch(plt.Rectangle((x - 0.5, y - 0.5), 1, 1, color=COLOURS[point.mark]))
            label = "-" if math.isnan(point.error) else f"{point.error:.0e}"
            panel.text(
                x,
                y,
                label.replace("e-0", "e-").replace("e+0", "e"),
                ha="center",
                va="center",
                fontsize=6,
            )
        panel.set(
            xlim=(-0.5, len(grid.slip_speeds) - 0.5),
            ylim=(-0.5, len(grid.tolerances) - 0.5),
            xticks=range(len(grid.slip_speeds)),
            yticks=range(len(grid.tolerances)),
            xticklabels=[f"{v:g}" for v in grid.slip_speeds],
            yticklabels=[f"{r:.0e}" for r in grid.tolerances],
            title=f"damping {damping:g} s/m",
        )
        panel.tick_params(labelsize=7)
        if j == 0:
            panel.set_ylabel(f"{method}\nrtol")
        if i == len(methods) - 1:
            panel.set_xlabel("slip speed, m/s")
    handles = [plt.Rectangle((0, 0), 1, 1, color=colour) for colour in COLOURS.values()]
    figure.legend(handles, COLOURS, loc="outside upper center", ncols=len(COLOURS), frameon=False)
    figure.savefig(path, metadata={"Date": None})


def main() -> None:
    """Run from the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--output", type=Path, default=Path())
    parser.add_argument("--quick", action="store_true", help="a coarse map")
    parser.add_argument(
        "--methods", nargs="+", default=["default"], help="names for simulate(method=...)"
    )
    parser.add_argument("--workers", type=int, default=2, help="runs at a time")
    options = parser.parse_args()
    grid = QUICK if options.quick else Grid()
    options.output.mkdir(parents=True, exist_ok=True)
    begun = time.perf_counter()
    points = survey(grid, options.methods, options.workers)
    write(points, options.output / "stability_map.csv")
    draw(points, grid, options.output / "stability_map.svg")
    for method, marks in itertools.groupby(points, key=lambda point: point.method):
        count = Counter(point.mark for point in marks)
        print(method, ", ".join(f"{mark} {count[mark]}" for mark in COLOURS))
    print(f"{len(points)} runs in {time.perf_counter() - begun:.0f} s")


if __name__ == "__main__":
    main()
