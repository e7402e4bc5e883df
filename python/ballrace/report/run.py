"""The report of a run."""

from __future__ import annotations

from typing import TYPE_CHECKING

from . import words
from .bearing import add_bearing, add_loads
from .page import Page
from .signal import add_features, add_signal, chosen
from .verdict import add_verdict

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..signals import Signals


def run_page(
    out: Signals, *, columns: Sequence[str] | None = None, title: str | None = None
) -> Page:
    """Return the report of a run as a page; see :meth:`ballrace.Signals.report`."""
    names = chosen(out, columns)
    scene = out.scene
    page = Page(title or scene.name or "A bearing")
    decided = add_verdict(page, out, names)
    for warning in out.warnings:
        page.warning(warning)
    page.section("Simulated bearing and operating point")
    record = f"{out.n_samples / out.fs:.4g} s, {out.n_samples} samples at {out.fs:g} Hz"
    add_bearing(page, scene, [*words.operation(scene), ("Record", record)])
    page.section("Defect frequencies")
    _add_frequencies(page, out)
    for name in names:
        add_signal(page, out, name, decided.get(name))
    add_loads(page, scene)
    add_features(page, out, names)
    _add_defects(page, out)
    add_model(page, out)
    add_provenance(page, out)
    return page


def _add_frequencies(page: Page, out: Signals) -> None:
    from ..frequencies.operating import spin_of
    from ..plot.sources import rates_of
    from ..plot.times import fault_rate

    rows = []
    for row in range(len(out.scene.rows)):
        found = rates_of(out, None, row)
        if found is None:
            page.text(
                "The speed is not constant: defects show at their orders, over turns of the shaft."
            )
            return
        ball = fault_rate(found, "ball", spin_of(out.scene, found, row))
        rings = [found.shaft] if out.scene.outer_speed is None else [found.inner, found.outer]
        hertz = [*rings, found.ftf, found.bpfo, found.bpfi, ball]
        rows.append(
            [f"{row}", words.degrees(found.contact_angle), *(words.number(f) for f in hertz)]
        )
    page.text(
        "At the contact angle under load. A ball's defect is hit twice a turn, at 2·BSF; one "
        "of a ball whose axis the model holds at BSF/cos α, or twice that where it reaches both races."
    )
    turning = ["shaft"] if out.scene.outer_speed is None else ["inner ring", "outer ring"]
    names = [f"{name}, Hz" for name in (*turning, "FTF", "BPFO", "BPFI", "ball")]
    page.table(["row", "contact angle", *names], rows)


def _add_defects(page: Page, out: Signals) -> None:
    met = out.defects if "defects" in out.provenance else {}
    if not met:
        return
    page.section("Passes over the defects")
    rows = [
        [
            name,
            f"{one.touched} of {one.passes}",
            f"{one.largest_load:.0f}",
            f"{1e3 * one.axial_offset:.3f}".replace("-", "−"),
            "–"
            if one.contact_offset is None
            else f"{1e3 * one.contact_offset:.3f}".replace("-", "−"),
        ]
        for name, one in met.items()
    ]
    page.table(
        [
            "defect",
            "passes that met it",
            "largest load there, N",
            "its middle, mm",
            "contact ran at, mm",
        ],
        rows,
    )


def add_model(page: Page, out: Signals) -> None:
    """Add what the model holds, and what it left out."""
    page.section("Model and its simplifications")
    page.facts(words.model(out.scene))
    left = out.provenance.to_dict().get("left_out", [])
    if left:
        page.text("Left out of the integration, and why:")
        page.points(f"{one['what']}: {one['reason']}" for one in left)
    absent = words.absent(out.scene)
    if absent:
        page.text(f"Not in this scene: {', '.join(absent)}.")
    page.text("In no model of this package: heat, elastic rings and housings, damage that grows.")


_PROVENANCE = {
    "version": "Version", "method": "Method", "rtol": "Relative tolerance", "max_step": "Largest step, s",
    "start": "Start", "settled": "Settled before t = 0, s", "bandwidth": "Flat up to, Hz",
    "simd": "Vector instructions", "architecture": "Processor",
}  # fmt: skip
_STATISTICS = {
    "accepted": "Steps", "rejected": "Steps rejected", "nfev": "Evaluations of the equations",
    "acceleration_residual": "Residual of accelerations",
    "truncated_contacts": "Contacts beyond a shoulder or pole",
    "wall_time": "Wall time, s",
}  # fmt: skip


def add_provenance(page: Page, out: Signals) -> None:
    """Add what made the signals, and the scene itself."""
    page.section("Settings and effort of the simulation")
    rows = []
    for record, names in ((out.provenance, _PROVENANCE), (out.stats, _STATISTICS)):
        known = record.to_dict()
        for key, what in names.items():
            if known.get(key) is not None:
                value = known[key]
                rows.append((what, words.number(value) if isinstance(value, float) else str(value)))
    page.facts(rows)
    page.folded("The scene, as TOML", out.scene.to_toml())
