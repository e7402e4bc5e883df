"""The page of a verdict."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..report import Page
from ..report.words import degrees, number
from .picture import picture
from .result import capital, header_of, headline, reason, width_of
from .size_picture import size_picture
from .verdict import NAMES

if TYPE_CHECKING:
    from .result import Diagnosis

_METHOD = (
    "Prewhitening by the cepstrum, and over a running mean as wide as the shaft's rate; spectra of the squared "
    "envelope in overlapping bands, over their medians. For each part the mean level of its lines, the largest "
    "over speeds of the cage of 0.955 to 1.015 times the nominal one (of balls orders of 0.98 to 1.02) and over "
    "the bands; z against the same of hundreds of combs of this record at orders that no part has; a Gumbel "
    "distribution makes it a probability. Other parts are looked for at the speed of the cage that the surest one "
    "shows, without its lines."
)


def diagnosis_page(of: Diagnosis, title: str | None = None) -> Page:
    """Return a diagnosis as a page."""
    page = Page(title or f"{of.bearing}: {headline(of)}")
    page.text(f"Verdict: {headline(of)}. {capital(reason(of))}.")
    for note in of.notes:
        page.warning(note)
    page.section("Record and bearing")
    nominal = f"nominal {number(of.shaft.nominal, 5)} Hz"
    source = (
        "from the record's shaft orders"
        if of.shaft.by == "record"
        else "the nominal one; the record's are not clear"
    )
    page.facts([
        ("Bearing", of.bearing), ("Record", of.record), ("Unit", of.unit or "not known"),
        ("Shaft", f"{number(of.shaft.rate, 6)} Hz, {source} ({nominal})"),
        ("False alarms asked for", f"{100.0 * of.false_alarm:g} % of healthy records: z above {of.threshold:.2f}"),
    ])  # fmt: skip
    if of.evidence:
        _add_evidence(page, of)
        _add_size(page, of)
        _add_severity(page, of)
    page.section("How it was judged")
    page.text(_METHOD)
    return page


def _add_evidence(page: Page, of: Diagnosis) -> None:
    page.section("Evidence")
    page.table(header_of(of.unit), of.rows())
    for part in of.parts or (None,):
        fig = picture(of, of._levels, part, None, {})
        page.figure(
            fig, "squared envelope in the deciding band, with what chance gives in this record."
        )
    for one in (of.evidence[part] for part in of.parts):
        angle = (
            ""
            if one.contact_angle is None
            else f", as balls at a contact angle of {degrees(one.contact_angle)} have it"
        )
        page.text(
            f"Lines of the {NAMES[one.part]}, at {one.factor:.3f} times nominal orders{angle}:"
        )
        rows = [
            [
                line.label,
                number(line.order, 5),
                number(line.expected, 5),
                number(line.found, 5),
                number(line.level, 3),
            ]
            for line in one.lines
        ]
        page.table(["line", "order", "expected, Hz", "found, Hz", "level, dB"], rows)


def _add_size(page: Page, of: Diagnosis) -> None:
    if of.width.part is None:
        return
    page.section("Size of the damage")
    page.text(f"{capital(width_of(of))}.")
    if of.width.value is not None:
        page.text(f"{capital(of.width.why)}.")
        page.figure(
            size_picture(of._size, None, None, {}), "averaged pass of a ball over the spall."
        )


def _add_severity(page: Page, of: Diagnosis) -> None:
    found = of.severity
    assert found is not None
    page.section("Severity")
    machine = (
        "no class of the machine was given"
        if found.machine is None
        else found.machine.replace("_", ", ")
    )
    page.facts([
        (f"Velocity, {found.band[0]:g} to {found.band[1]:g} Hz, mm/s rms", number(found.velocity, 3)),
        ("Zone by ISO 20816-3", f"{found.zone or '–'} ({machine})"),
        ("Crest factor in the deciding band", number(found.crest_factor, 3)),
        ("Kurtosis there (3: noise)", number(found.kurtosis, 3)),
    ])  # fmt: skip
    if found.change is not None:
        ratios = (("velocity", found.change.velocity), ("crest factor", found.change.crest_factor),
                  ("kurtosis", found.change.kurtosis))  # fmt: skip
        changes = ", ".join(f"{name} {number(ratio, 3)}" for name, ratio in ratios)
        page.text(f"Times those of the reference record: {changes}.")
