"""The page of the demonstration: which row, where the defect lies, and why thrust increases its vibration."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..frequencies.operating import fault_frequencies
from ..report import Page, words
from ..report.run import add_model, add_provenance
from .case import COLUMN, passing

if TYPE_CHECKING:
    from collections.abc import Mapping

    from .case import Case


def page(cases: Mapping[str, Case]) -> Page:
    """Return the page."""
    none, towards, away = cases.values()
    made = Page("Why thrust makes the impacts of a spall stronger, or vanish")
    made.text(
        "A double-row wheel bearing under 7 kN of radial load turns 30 times a second. Its outer race has a "
        "spall. The same spall is run three times: without thrust, with 3 kN towards it, and with 3 kN away "
        "from it. The case is that of P. Tkachuk and J. Strackeljan, A 3D-ball bearing model for simulation of "
        "axial load variations."
    )
    for label, case in cases.items():
        for warning in case.out.warnings:
            made.warning(f"{label}: {warning}")
    _where(made, none, towards)
    _zones(made, cases)
    _loads(made, cases)
    _vibration(made, cases)
    _spectra(made, cases)
    _why(made, none, towards, away)
    add_model(made, towards.out)
    add_provenance(made, towards.out)
    return made


def _where(made: Page, none: Case, towards: Case) -> None:
    from .. import plot

    scene = towards.out.scene
    low, high = (1e3 * (edge - scene.rows[0].axial_position) for edge in none.spall)
    made.section("Which row, and where")
    made.text(
        "The spall lies on the outer race of row 0, the row on the −z side, at −90°: where the radial load "
        f"presses. Seen from the middle of that row it reaches from {low:.2f} to {high:.2f} mm towards +z. Thrust "
        "along +z on the inner ring is carried by row 0, thrust along −z by row 1."
    )
    made.facts(words.bearing(scene))
    made.figure(
        plot.section(scene),
        "the bearing cut through its axis, with 3 kN of thrust towards the faulted row. Boundary dimensions are "
        "drawn as common.",
    )


def _zones(made: Page, cases: Mapping[str, Case]) -> None:
    from .. import plot

    row = next(iter(cases.values())).out.scene.rows[0]
    made.section("The contact before and after")
    none, towards, away = cases.values()
    made.text(
        "A ball meets the race in a zone some millimetres long. Thrust moves that zone along the axis, and "
        "decides how much of the load this row carries. Under the ball at −90° of the healthy bearing, "
        f"{none.within:.0f} N rest on the place of the spall without thrust, {towards.within:.0f} N with 3 kN "
        f"towards it, and {away.within:.0f} N with 3 kN away from it."
    )
    plane = row.axial_position
    slices = {label: case.slices | {"z": case.slices["z"] - plane} for label, case in cases.items()}
    low, high = none.spall
    fig = plot.slice_forces(slices, bands=[(low - plane, high - plane)])
    fig.update_xaxes(title_text="axial place from the middle of row 0 / mm", row=len(slices), col=1)
    made.figure(
        fig,
        "force of the slices of the ball of row 0 at −90°, on the healthy outer race. The grey band is where the "
        "spall lies; what stands in it meets the spall.",
    )
    rows = []
    for label, case in cases.items():
        zone = case.zone
        places = (1e3 * (z - row.axial_position) for z in (zone.first, zone.middle, zone.last))
        cells = [f"{z:.2f}".replace("-", "−") for z in places] if zone.force > 0.0 else ["–"] * 3
        share = f"{100.0 * case.within / zone.force:.0f}" if zone.force > 0.0 else "–"
        rows.append([label, f"{zone.force:.0f}", *cells, f"{case.within:.0f}", share])
    header = [
        "case", "radial force, N", "zone from, mm", "middle, mm", "to, mm", "on the spall's place, N", "share, %",
    ]  # fmt: skip
    made.table(header, rows)


def _loads(made: Page, cases: Mapping[str, Case]) -> None:
    from .. import plot

    loads = {label: case.loads for label, case in cases.items()}
    fig = plot.load_distribution(loads, row=0)
    made.figure(
        fig, "load of a ball of row 0 on the outer race wherever it stands; the spall lies at 270°."
    )


def _vibration(made: Page, cases: Mapping[str, Case]) -> None:
    from .. import plot

    made.section("Vibration")
    outs = {label: case.out for label, case in cases.items()}
    rate = fault_frequencies(outs[list(cases)[1]].scene).bpfo
    made.figure(
        plot.load_cases(outs, COLUMN, bpfo=rate),
        "vertical acceleration of the outer ring after the start has settled; dotted lines one ball passage apart "
        f"({rate:.1f} Hz, as the contact angle under 3 kN has it).",
    )
    made.table(
        ["case", "rms, m/s²", "peak, m/s²", "kurtosis", "mean impact, m/s²"],
        [
            [label, *(words.number(value) for value in case.numbers)]
            for label, case in cases.items()
        ],
    )


_ENOUGH = 0.02
"""Shortest run whose envelope has lines to look at [s]."""


def _spectra(made: Page, cases: Mapping[str, Case]) -> None:
    from .. import plot

    last = list(cases)[1]
    if cases[last].out.n_samples / cases[last].out.fs < _ENOUGH:
        made.text("The run is too short for an envelope spectrum.")
        return
    limit, fig = 3.6 * passing(cases[last].out.scene), None
    # In the order of the other pictures, so that each case keeps its colour.
    for label, case in cases.items():
        faults = None if label == last else ()
        fig = plot.envelope_spectrum(
            case.out, COLUMN, name=label, faults=faults, limit=limit, fig=fig
        )
    assert fig is not None
    made.figure(
        fig,
        "spectrum of the squared envelope. The spall has lines at BPFO and its multiples, here at the contact "
        "angle under 3 kN.",
    )


def _why(made: Page, none: Case, towards: Case, away: Case) -> None:
    made.section("Why")
    (_, _, _, before), (_, _, _, louder), (_, _, _, softer) = (
        case.numbers for case in (none, towards, away)
    )
    moved = 1e3 * (towards.zone.middle - none.zone.middle)
    loads = f"{none.zone.force:.0f} to {towards.zone.force:.0f} N"
    change = 100.0 * (louder / before - 1.0)
    text = (
        f"Thrust of 3 kN towards the faulted row moves the middle of the contact by {moved:.2f} mm onto the spall "
        f"and presses the ball harder ({loads} radially): impacts go from {before:.1f} to {louder:.1f} m/s², "
        f"{change:+.0f} %. Thrust away from it takes the load off the row ({away.zone.force:.0f} N) and the "
        f"contact off the spall: {softer:.1f} m/s² are left. The spall is the same; a radial model, in which a "
        "ball meets a race in its middle plane whatever the thrust, could not distinguish these three."
    )
    made.text(text.replace("-", "−"))
    made.text(
        "How strong and how regular the impacts are under thrust away from the spall depends on clearance and "
        "damping, which the paper does not give. This bearing has no clearance and is heavily damped; that of "
        "the command “ballrace paper” is loose and lightly damped, and there they vary as in the paper."
    )
