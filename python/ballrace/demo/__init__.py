"""``ballrace demo``: the wheel bearing under three loads, as a table, files and a report.

Thrust towards a faulted row makes its impacts stronger, thrust away from it makes them vanish: the result of the
paper that this project starts from (P. Tkachuk, J. Strackeljan, *A 3D-ball bearing model for simulation of axial
load variations*).
"""

from __future__ import annotations

import importlib.util
from collections.abc import Mapping
from pathlib import Path

from ..report import write_page
from .case import COLUMN, Case, run_case
from .story import page

__all__ = ["AXIAL_LOADS", "HEADER", "TITLE", "Case", "page", "rows", "run_case", "write"]

AXIAL_LOADS = {"axial 0": 0.0, "axial +3 kN": 3000.0, "axial -3 kN": -3000.0}
"""Axial loads by the names of the cases [N]."""

TITLE = (
    f"Wheel bearing, 7 kN radial, defect on the outer ring: {COLUMN} after the start has settled"
)
HEADER = [
    "case",
    "rms m/s²",
    "peak m/s²",
    "kurtosis",
    "impact m/s²",
    "steps",
    "evaluations",
    "wall s",
]


def rows(cases: Mapping[str, Case]) -> list[list[str]]:
    """Return the lines of the table as text."""
    lines = []
    for label, case in cases.items():
        rms, peak, kurtosis, impact = case.numbers
        shape = "nan" if kurtosis is None else f"{kurtosis:.1f}"
        stats = case.out.stats
        effort = [f"{stats.accepted}", f"{stats.nfev}", f"{case.seconds:.1f}"]
        lines.append([label, f"{rms:.2f}", f"{peak:.1f}", shape, f"{impact:.1f}", *effort])
    return lines


def write(cases: Mapping[str, Case], folder: Path) -> list[Path]:
    """Write the signals of each case and, if plotly is there, the page; return the files."""
    folder.mkdir(exist_ok=True)
    written = []
    for case in cases.values():
        written.append(folder / f"axial_{case.axial_load:.0f}N.parquet")
        case.out.write_parquet(written[-1])
    if importlib.util.find_spec("plotly") is not None:
        written.append(folder / "demo.html")
        write_page(written[-1], lambda: page(cases))
    return written
