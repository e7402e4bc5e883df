"""What approximations by request cost in accuracy and gain in time, against the free model.

``python benches/approximations.py -o FOLDER`` (extra ``bench``) writes a table and a picture; some three minutes.

Signals are compared by what they are judged by, from 0.1 s on: rms below 2 and 10 kHz, 99.9 % of the peaks, line
of the squared envelope at the passing frequency of the balls. Runs part within milliseconds, so the free model
from a start a nanometre away says how far two runs of one model are apart.
"""

from __future__ import annotations

import argparse
import statistics
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib as mpl
import numpy as np
import polars as pl

import ballrace as br
from ballrace.scene import Approximations, Defect, SpeedDrive

if TYPE_CHECKING:
    from numpy.typing import NDArray

mpl.use("Agg")
from matplotlib import pyplot as plt

FS = 50_000.0
DURATION = 0.6
BEGIN = 0.1
TIMES = 11
SILENT = 1e-3
"""Of an outer ring's acceleration [m/s²]."""
FREE = Approximations()
ROLLING = Approximations(rolling=True)
PLANE = Approximations(plane=True)
FLAT = Approximations(rolling=True, plane=True)
ONE_ROW = Approximations(one_row=True)
NAMES = {
    FREE: "a nanometre away",
    ROLLING: "rolling",
    PLANE: "plane",
    FLAT: "rolling, plane",
    ONE_ROW: "one_row",
}


def scenes() -> dict[str, tuple[br.Scene, list[Approximations]]]:
    """Return scenes by name and what they are simplified by."""
    spall = Defect(
        on="outer_race",
        angle=-1.5708,
        axial_offset=0.0,
        length=1.5e-3,
        width=0.8e-3,
        edge_radius=0.3e-3,
    )
    level = br.presets.deep_groove_6205(radial_load=500.0)
    thrust = level.replace({"loads.axial.force": 500.0})
    wheel = br.presets.wheel_bearing(axial_load=3000.0)
    lifted = wheel.replace({"loads.radial.force": 500.0, "loads.axial.force": 20_000.0})
    angled = [ROLLING, PLANE, FLAT]
    return {
        "6205": (level, [ROLLING]),
        "6205, spall": (replace(level, defects={"spall": spall}), [ROLLING]),
        "6205, 500 N of thrust": (thrust, angled),
        "6205, 500 N of thrust, spall": (replace(thrust, defects={"spall": spall}), angled),
        "wheel bearing, 0 kN": (wheel.replace({"loads.axial.force": 0.0}), angled),
        "wheel bearing, +3 kN": (wheel, angled),
        "wheel bearing, +3 kN, healthy": (replace(wheel, defects={}), angled),
        "wheel bearing, 0.5 kN, 20 kN of thrust": (lifted, [*angled, ONE_ROW]),
    }


def beside(scene: br.Scene) -> NDArray[np.float64]:
    """Return the equilibrium with one ball a nanometre aside."""
    model = br.Model(scene)
    y = model.start("equilibrium")
    y[model.names.index("row0.ball0.x")] += 1e-9
    return y


def features(out: br.Signals, line: float) -> dict[str, float]:
    """Return what a signal is judged by."""
    x = out["outer.ay"][int(BEGIN * FS) :]
    spectrum = np.abs(np.fft.rfft(x - x.mean())) ** 2
    f = np.fft.rfftfreq(len(x), 1 / FS)
    of = {
        f"rms_{limit}": float(np.sqrt(2 * spectrum[f <= limit].sum()) / len(x))
        for limit in (2000, 10_000)
    }
    squared = br.spectra.squared_envelope(x, FS, (500.0, 10_000.0))
    frequency, value = br.spectra.line(squared, FS, line, 0.03 * line)
    peak = float(np.quantile(np.abs(x), 0.999))
    return {**of, "peak": peak, "line": value, "frequency": frequency}


def measure(name: str, scene: br.Scene, wanted: list[Approximations]) -> list[dict[str, object]]:
    """Return a row an approximation; times are medians of interleaved short runs."""
    drive = scene.drive
    assert isinstance(drive, SpeedDrive)
    assert isinstance(drive.speed, float)
    line = br.frequencies.of_row(scene.rows[0]).bpfo * drive.speed / (2 * np.pi)
    free = features(br.simulate(scene, duration=DURATION, fs=FS), line)
    rows: list[dict[str, object]] = []
    for approximations in [FREE, *wanted]:
        simple = replace(scene, approximations=approximations)
        start = beside(scene) if approximations == FREE else "equilibrium"
        out = br.simulate(simple, duration=DURATION, fs=FS, start=start)
        found = features(out, line)
        times: dict[bool, list[float]] = {True: [], False: []}
        for _ in range(TIMES):
            for is_simple in (True, False):
                run = br.simulate(simple if is_simple else scene, duration=0.02, threads=1)
                times[is_simple].append(run.stats.wall_time)
        rows.append(
            {
                "scene": name,
                "faulted": bool(scene.defects),
                "approximation": NAMES[approximations],
                "states": out.provenance.states,
                "times_faster": statistics.median(times[False]) / statistics.median(times[True]),
                "rms_2kHz_%": 100 * (found["rms_2000"] / free["rms_2000"] - 1),
                "rms_10kHz_%": 100 * (found["rms_10000"] / free["rms_10000"] - 1),
                "peak_%": 100 * (found["peak"] / free["peak"] - 1),
                "line_dB": 20 * float(np.log10(found["line"] / free["line"])),
                "frequency_%": 100 * (found["frequency"] / free["frequency"] - 1),
                "rms": found["rms_10000"],
            }
        )
    return rows


def draw(table: pl.DataFrame, path: Path) -> None:
    """Draw speed against the error of the rms, a mark an approximation; hollow where no race has a defect."""
    figure, axes = plt.subplots(figsize=(8.5, 4.4), layout="constrained")
    # A share of nothing says nothing.
    silent = table.filter(~pl.col("faulted") & (pl.col("rms") < SILENT))["scene"].unique().to_list()
    names = table.filter(~pl.col("scene").is_in(silent))["scene"].unique(maintain_order=True)
    colours = dict(zip(names, plt.get_cmap("tab10").colors[: len(names)], strict=True))
    marks = {"rolling": "o", "plane": "s", "rolling, plane": "D", "one_row": "^"}
    for row in table.iter_rows(named=True):
        mark, colour = marks.get(row["approximation"]), colours.get(row["scene"])
        if mark and row["scene"] not in silent:
            fill = colour if row["faulted"] else "white"
            error = abs(row["rms_10kHz_%"])
            axes.plot(row["times_faster"], error, mark, color=colour, mfc=fill, ms=7)
    for scene, colour in colours.items():
        axes.plot([], [], lw=5, color=colour, label=scene)
    for name, mark in marks.items():
        axes.plot([], [], mark, color="black", mfc="white", label=name)
    axes.set_yscale("log")
    axes.set_xlabel("times faster than the free model")
    axes.set_ylabel("error of the rms below 10 kHz, % (hollow: healthy)")
    axes.grid(color="0.9")
    axes.set_axisbelow(True)
    axes.legend(frameon=False, fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5))
    axes.spines[["top", "right"]].set_visible(False)
    figure.savefig(path)
    plt.close(figure)


def main() -> None:
    """Measure, write and draw."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FOLDER")
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    rows = [
        row for name, (scene, wanted) in scenes().items() for row in measure(name, scene, wanted)
    ]
    table = pl.DataFrame(rows)
    table.write_csv(options.output / "approximations.csv", float_precision=4)
    draw(table, options.output / "approximations.svg")
    with pl.Config(tbl_rows=-1, tbl_cols=-1, fmt_str_lengths=60):
        print(table)


if __name__ == "__main__":
    main()
