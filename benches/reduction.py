"""Cost of the full and of the reduced model over a ladder of scenes, from the plane to the faulted double row.

``python benches/reduction.py -o FOLDER`` (extra ``bench``) writes a table and a picture; half a minute.
"""

from __future__ import annotations

import argparse
import statistics
from dataclasses import replace
from pathlib import Path

import matplotlib as mpl
import polars as pl

import ballrace as br
from ballrace.scene import Defect, Iso16281

mpl.use("Agg")
from matplotlib import pyplot as plt

DURATION = 0.02
TIMES = 7


def ladder() -> dict[str, br.Scene]:
    """Return scenes of growing need, by name."""
    plane = br.presets.deep_groove_6205(radial_load=500.0)
    smooth = plane.replace({"friction": "none"})
    level = br.presets.wheel_bearing(axial_load=0.0)
    level = replace(
        level,
        defects={},
        rows=(level.rows[0], replace(level.rows[1], start_angle=level.rows[0].start_angle)),
    )
    spall = Defect(
        on="outer_race",
        angle=-1.5708,
        axial_offset=0.0,
        length=1.5e-3,
        width=1e-3,
        edge_radius=0.3e-3,
    )
    return {
        "6205, no friction": smooth,
        "the same, ISO law": smooth.replace({"contact.law": Iso16281()}),
        "the same, spall in the middle": replace(smooth, defects={"spall": spall}),
        "the same, 200 N of thrust": smooth.replace({"loads.axial.force": 200.0}),
        "6205, friction": plane,
        "the same, ISO law, 24 nodes": plane.replace(
            {"contact.law": Iso16281(), "contact.slices": br.scene.FittedSlices(24)}
        ),
        "the same, 100 slices": plane.replace(
            {"contact.law": "hertz", "contact.slices": br.scene.FixedSlices(100)}
        ),
        "two mirrored rows": level,
        "faulted wheel bearing, +3 kN": br.presets.wheel_bearing(axial_load=3000.0),
    }


def measure(scene: br.Scene) -> dict[str, float]:
    """Return states and time [s] for a simulated second, reduced and full: medians of interleaved runs."""
    times: dict[bool, list[float]] = {True: [], False: []}
    states: dict[bool, int] = {}
    for _ in range(TIMES):
        for reduce in (True, False):
            out = br.simulate(scene, duration=DURATION, reduce=reduce, threads=1)
            times[reduce].append(out.stats.wall_time / DURATION)
            states[reduce] = out.provenance.states
    reduced, full = (statistics.median(times[reduce]) for reduce in (True, False))
    ratios = [b / a for a, b in zip(times[True], times[False], strict=True)]
    return {
        "states": states[True],
        "states_full": states[False],
        "seconds": reduced,
        "seconds_full": full,
        "ratio": statistics.median(ratios),
        "ratio_least": min(ratios),
        "ratio_most": max(ratios),
    }


def draw(table: pl.DataFrame, path: Path) -> None:
    """Draw pairs of bars."""
    figure, axes = plt.subplots(figsize=(8, 4.2), layout="constrained")
    places = range(table.height)
    for shift, column, label, colour in (
        (-0.2, "seconds_full", "full", "#9aa5b1"),
        (0.2, "seconds", "reduced", "#0b6e99"),
    ):
        axes.barh([p + shift for p in places], table[column], 0.38, label=label, color=colour)
    for place, row in zip(places, table.iter_rows(named=True), strict=True):
        text = f"{row['ratio']:.2f} ×, {row['states']} of {row['states_full']} states"
        axes.text(
            max(row["seconds"], row["seconds_full"]), place, f"  {text}", va="center", fontsize=8
        )
    axes.set_yticks(list(places), table["scene"])
    axes.invert_yaxis()
    axes.set_xlabel("time for a simulated second on one thread, s")
    axes.margins(x=0.35)
    axes.legend(frameon=False)
    axes.spines[["top", "right"]].set_visible(False)
    figure.savefig(path)
    plt.close(figure)


def main() -> None:
    """Measure, write and draw."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FOLDER")
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    table = pl.DataFrame([{"scene": name, **measure(scene)} for name, scene in ladder().items()])
    table.write_csv(options.output / "reduction.csv", float_precision=4)
    draw(table, options.output / "reduction.svg")
    with pl.Config(tbl_rows=-1, tbl_cols=-1, fmt_str_lengths=40):
        print(table)


if __name__ == "__main__":
    main()
