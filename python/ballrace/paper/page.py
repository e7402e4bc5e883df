"""Figures 5 to 11 on one page: what the paper says of each beside ours."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..report.page import Page
from .comparison import AXIAL_LOADS
from .simulations import INSTANT, SIGNALS, dynamic
from .study import MEASURED_RADIAL_LOAD

if TYPE_CHECKING:
    from .case import Case
    from .comparison import Comparison
    from .study import Paper

HEADER = ["quantity", "figure", "published", "wanted", "ours", "deviation", "verdict"]
"""Titles of :func:`rows`."""

# Figure 11's axis; the first milliseconds of a rolling start go far beyond.
_AXIS = 90.0


def rows(paper: Paper) -> list[list[str]]:
    """Return the lines of the table as text: figure, quantity, published, wanted, ours, deviation, verdict."""
    lines = []
    for line in paper.table:
        deviation = "" if line.deviation is None else f"{100.0 * line.deviation:+.1f} %"
        target = line.target
        cells = [target.published, line.wanted, f"{line.ours:.4g}", deviation, _verdict(line)]
        lines.append([target.what, target.figure, *cells])
    return lines


def page(paper: Paper) -> str:
    """Return the page as HTML; it needs plotly."""
    missed = [line.target.what for line in paper.table if not line.met]
    made = Page("A 3D-ball bearing model for simulation of axial load variations")
    made.text(
        "The case of P. Tkachuk and J. Strackeljan, run again: a double-row wheel bearing with a defect on the "
        f"outer ring. {len(paper.table) - len(missed)} of {len(paper.table)} statements are met"
        f"{', missed: ' + '; '.join(missed) if missed else ''}. The paper gives balls, speed, loads and the "
        "size of the defect. Geometry, clearance, masses, damping and the defect's axial place were identified "
        "from its results. At -3 kN the motion is chaotic: other starts have other impacts, and what one start "
        "misses the median of eight may meet."
    )
    made.text(
        "Accelerations are cut off in the first milliseconds; forces are those at "
        f"{INSTANT} s. Signals are {SIGNALS}."
    )
    made.table(HEADER, rows(paper))
    for (title, fig), said in zip(_figures(paper).items(), _said(paper), strict=True):
        made.section(title)
        made.table(["", "the paper", "ours"], said)
        made.figure(fig, None)
    return made.html()


def _verdict(line: Comparison) -> str:
    return "met" if line.met else "MISSED"


def _said(paper: Paper) -> list[list[list[str]]]:
    """Return, for figures 5 to 11, what the paper says and what we have."""
    cases = paper.cases
    none, towards, away = (cases[name] for name in AXIAL_LOADS)
    measured = [dynamic(out) for out in paper.as_measured.values()]
    grown = 100.0 * (measured[1].impact / measured[0].impact - 1.0)
    over = "line over its surroundings, +3 kN"
    begun = ["first 0.02 s", "initial conditions, no physical meaning", "the same start"]
    forces = [
        ["largest normal force on the faulted race", text, f"{_largest(case):.0f} N"]
        for text, case in (
            ("drawn, no number", none),
            ("considerable influence of the axial load", towards),
            ("considerably smaller", away),
        )
    ]  # fmt: skip
    on_defect = f"{none.snapshot.zone.force:.0f} to {towards.snapshot.zone.force:.0f} N"
    return [
        [
            ["impacts, 0 to +3 kN", "measured: amplitudes get higher", f"{grown:+.0f} %"],
            [over, "measured: a typical fault structure", f"{measured[1].clarity:.0f} dB"],
        ],
        [
            *_lines(paper, "6"),
            [over, "periodical peaks", f"{towards.dynamic.clarity:.0f} dB"],
            begun,
        ],
        [forces[0]],
        [forces[1]],
        [*_lines(paper, "9"), ["force of the ball on the defect", "grows", on_defect]],
        [*_lines(paper, "10"), forces[2]],
        [*_lines(paper, "11"), begun],
    ]


def _largest(case: Case) -> float:
    """Return the largest normal force on the outer race of the faulted row [N]."""
    balls = case.snapshot.balls
    return float(balls.outer_load[balls.row == 0].max())


def _lines(paper: Paper, figure: str) -> list[list[str]]:
    """Return the table's lines that belong to a figure: quantity, the paper, ours."""
    return [
        [line.target.what, line.target.published or f"wanted {line.wanted}", f"{line.ours:.3g}, {_verdict(line)}"]
        for line in paper.table
        if figure in line.target.figure.split(", ")
    ]  # fmt: skip


def _figures(paper: Paper) -> dict[str, Any]:
    """Return the figures by their titles."""
    from .. import plot

    names = list(AXIAL_LOADS)
    cases = paper.cases
    signals = {f"axial {name}": case.signals for name, case in cases.items()}
    first = cases[names[0]]
    row = first.signals.scene.rows[0]
    spans = [
        (first.signals.defects[name].axial_offset + row.axial_position, defect.length)
        for name, defect in first.signals.scene.defects.items()
        if defect.row == 0
    ]
    bands = [(z - length / 2.0, z + length / 2.0) for z, length in spans]
    strongest = max(float(case.snapshot.balls.outer_load.max()) for case in cases.values())

    def force(name: str) -> Any:
        return plot.force_distribution(cases[name].snapshot.balls, largest=strongest, height=420)

    def acceleration(shown: dict[str, Any], largest: float) -> Any:
        rim = max(_AXIS, 1.4 * largest)
        return plot.load_cases(shown, bpfo=first.dynamic.bpfo).update_yaxes(range=[-rim, rim])

    lighter = {f"axial {name}": out for name, out in paper.as_measured.items()}
    both = {name: signals[name] for name in list(signals)[:2]}
    slices = {f"axial {name}": cases[name].snapshot.slices for name in names[:2]}
    vertical = "vertical acceleration of the outer ring"
    return {
        f"Figure 5: {vertical}, {MEASURED_RADIAL_LOAD / 1e3:g} kN radial, 0 and +3 kN": acceleration(
            lighter, max(dynamic(out).largest for out in lighter.values())
        ),
        f"Figure 6: {vertical}, 0 and +3 kN": acceleration(
            both, max(cases[name].dynamic.largest for name in names[:2])
        ),
        "Figure 7: normal forces, 0 kN": force(names[0]),
        "Figure 8: normal forces, +3 kN": force(names[1]),
        "Figure 9: slices of the ball in the middle of the load zone": plot.slice_forces(
            slices, bands=bands
        ),
        "Figure 10: normal forces, -3 kN": force(names[2]),
        f"Figure 11: {vertical}, -3 kN": acceleration(
            {f"axial {names[2]}": signals[f"axial {names[2]}"]}, cases[names[2]].dynamic.largest
        ),
    }
