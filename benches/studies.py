"""Studies that write a table and draw it; for `lubrication.py` and `tilt.py`."""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib as mpl
import polars as pl

import ballrace as br

if TYPE_CHECKING:
    from collections.abc import Mapping

mpl.use("Agg")
from matplotlib import pyplot as plt
from matplotlib.figure import Figure


@dataclass(frozen=True)
class Study:
    """What measures a table, and what draws it."""

    measure: Callable[[], pl.DataFrame]
    draw: Callable[[pl.DataFrame, Figure], None]


def run(prefix: str, about: str, studies: Mapping[str, Study]) -> None:
    """Run the studies that the command line asks for; write and draw each as ``PREFIX_NAME.csv`` and ``.svg``."""
    parser = argparse.ArgumentParser(description=about.splitlines()[0])
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FOLDER")
    parser.add_argument("--only", nargs="+", choices=studies, default=list(studies))
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    for name in options.only:
        table = studies[name].measure()
        table.write_csv(options.output / f"{prefix}_{name}.csv", float_precision=5)
        figure = plt.figure(figsize=(8.5, 4.0), layout="constrained")
        studies[name].draw(table, figure)
        for axes in figure.axes:
            axes.grid(color="0.9")
            axes.set_axisbelow(True)
            axes.spines[["top", "right"]].set_visible(False)
        figure.savefig(options.output / f"{prefix}_{name}.svg")
        plt.close(figure)
        with pl.Config(tbl_rows=40, tbl_cols=-1):
            print(name, table)


def cost_of(case: str, scene: br.Scene, duration: float) -> dict[str, str | float]:
    """Return what a simulated second costs on one thread: the least of three runs [s], and evaluations."""
    seconds, evaluations = float("inf"), 0.0
    for _ in range(3):
        begun = time.process_time()
        out = br.simulate(scene, duration=duration, settle=0.0, threads=1)
        seconds = min(seconds, (time.process_time() - begun) / duration)
        evaluations = out.stats.nfev / duration
    return {"case": case, "seconds": seconds, "evaluations": evaluations}


def draw_costs(table: pl.DataFrame, figure: Figure) -> None:
    """Draw seconds and evaluations of all cases."""
    left, right = figure.subplots(1, 2, sharey=True)
    for axes, column, label in (
        (left, "seconds", "processor time for a simulated second, s"),
        (right, "evaluations", "evaluations for a simulated second"),
    ):
        bars = axes.barh(table["case"], table[column], color="#0b6e99")
        axes.bar_label(bars, fmt="{:,.3g}", padding=3, fontsize=8)
        axes.set(xscale="log", xlabel=label)
        axes.margins(x=0.2)
        axes.xaxis.set_minor_formatter("")
    left.invert_yaxis()
