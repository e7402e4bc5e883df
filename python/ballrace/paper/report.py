"""Files of the paper's cases: numbers, tables, signals and a page with the figures."""

from __future__ import annotations

import importlib.util
import json
import math
from typing import TYPE_CHECKING, Any

from .._io.files import check_writable
from .._io.whole import whole
from ..report.page import Page
from .comparison import AXIAL_LOADS
from .simulations import SIGNALS

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    import polars as pl

    from .case import Case
    from .study import Paper


def write(paper: Paper, folder: Path, *, numbers_only: bool = False) -> list[Path]:
    """Write ``paper.json`` and, unless it is to be alone, tables, signals and the page with the figures.

    The page, ``paper.html``, needs plotly and is left out without it.

    Returns
    -------
    list of Path
        The files written.
    """
    check_writable(folder / "paper.json" if folder.exists() else folder)
    folder.mkdir(exist_ok=True)
    written = [folder / "paper.json"]
    with whole(written[-1]) as temporary:
        temporary.write_text(dumps(paper), encoding="utf-8")
    if numbers_only:
        return written
    for name, table in _tables(paper).items():
        written.append(folder / name)
        with whole(written[-1]) as temporary:
            table.write_csv(temporary)
    for name, case in paper.cases.items():
        written.append(folder / f"axial_{AXIAL_LOADS[name]:.0f}N.parquet")
        case.signals.write_parquet(written[-1])
    if importlib.util.find_spec("plotly") is not None:
        written.append(folder / "paper.html")
        with whole(written[-1]) as temporary:
            temporary.write_text(_page(paper), encoding="utf-8")
    return written


def dumps(paper: Paper) -> str:
    """Return every number as JSON; what is not a number becomes null."""
    return json.dumps(_finite(paper.to_dict()), indent=2, ensure_ascii=False) + "\n"


def _finite(value: Any) -> Any:
    match value:
        case dict():
            return {key: _finite(entry) for key, entry in value.items()}
        case list():
            return [_finite(entry) for entry in value]
        case float() if not math.isfinite(value):
            return None
    return value


def _tables(paper: Paper) -> dict[str, pl.DataFrame]:
    from .._base.polars import pl

    def stacked(of: Callable[[Case], pl.DataFrame]) -> pl.DataFrame:
        return pl.concat(
            of(case).select(pl.lit(AXIAL_LOADS[name]).alias("axial_load"), pl.all())
            for name, case in paper.cases.items()
        )

    return {
        "comparison.csv": pl.DataFrame([line.to_dict() for line in paper.table]),
        "balls.csv": stacked(lambda case: case.snapshot.balls.to_polars()),
        "slices.csv": stacked(lambda case: pl.DataFrame(dict(case.snapshot.slices))),
    }


def rows(paper: Paper) -> list[list[str]]:
    """Return the lines of the table as text: figure, quantity, published, wanted, ours, deviation, verdict."""
    lines = []
    for line in paper.table:
        deviation = "" if line.deviation is None else f"{100.0 * line.deviation:+.1f} %"
        verdict = "met" if line.met else "MISSED"
        target = line.target
        cells = [target.published, line.wanted, f"{line.ours:.4g}", deviation, verdict]
        lines.append([target.what, target.figure, *cells])
    return lines


HEADER = ["quantity", "figure", "published", "wanted", "ours", "deviation", "verdict"]
"""Titles of :func:`rows`."""


def _page(paper: Paper) -> str:
    from .. import plot

    names = list(AXIAL_LOADS)
    cases = paper.cases
    signals = cases[names[0]].signals
    scene = signals.scene
    bpfo = cases[names[0]].dynamic.bpfo
    spans = [
        (signals.defects[name].axial_offset + scene.rows[0].axial_position, defect.length)
        for name, defect in scene.defects.items()
        if defect.row == 0
    ]
    bands = [(z - length / 2.0, z + length / 2.0) for z, length in spans]

    def force(name: str) -> Any:
        largest = max(float(case.snapshot.balls.outer_load.max()) for case in cases.values())
        return plot.force_distribution(cases[name].snapshot.balls, largest=largest, height=420)

    def acceleration(*shown: str) -> Any:
        fig = plot.load_cases({f"axial {name}": cases[name].signals for name in shown}, bpfo=bpfo)
        # At least the scale of figure 11; the first milliseconds of a rolling start go far beyond.
        rim = max(90.0, *(1.4 * cases[name].dynamic.largest for name in shown))
        return fig.update_yaxes(range=[-rim, rim])

    slices = {f"axial {name}": cases[name].snapshot.slices for name in names[:2]}
    figures = {
        "Figure 6: vertical acceleration of the outer ring, 0 and +3 kN": acceleration(*names[:2]),
        "Figure 7: normal forces, 0 kN": force(names[0]),
        "Figure 8: normal forces, +3 kN": force(names[1]),
        "Figure 9: slices of the ball in the middle of the load zone": plot.slice_forces(
            slices, bands=bands
        ),
        "Figure 10: normal forces, -3 kN": force(names[2]),
        "Figure 11: vertical acceleration of the outer ring, -3 kN": acceleration(names[2]),
    }
    made = Page("A 3D-ball bearing model for simulation of axial load variations")
    made.text(
        "The published case, run again: 7 kN radial load, defect on the outer ring, 30 turns a second. "
        "Accelerations are cut off in the first milliseconds; forces are those at 0.017992 s. "
        f"Signals are {SIGNALS}."
    )
    made.table(HEADER, rows(paper))
    for title, fig in figures.items():
        made.section(title)
        made.figure(fig, None)
    return made.html()
