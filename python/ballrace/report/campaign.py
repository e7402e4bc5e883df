"""The report of a campaign."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .._base.libraries import pl
from ..errors import SceneError
from ..scene.defect import SURFACES
from . import words
from .page import Page

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..campaigns import Campaign

_SHOWN = 40
"""Lines of a table of failures or warnings, at most."""

_WANTED = (".bpfo_envelope", ".kurtosis", ".rms")
"""Endings of the features that are shown if none are asked for, one of each."""


def campaign_page(
    done: Campaign, *, features: Sequence[str] | None = None, title: str | None = None
) -> Page:
    """Return the report of a campaign as a page; see :meth:`ballrace.campaigns.Campaign.report`."""
    table = done.manifest
    names = _features(table, features)
    varied = _varied(table, done.parameters)
    page = Page(title or f"Campaign {done.folder.name}")
    page.text(done.status().rpartition(f"{done.folder}: ")[2] + ".")
    _add_parameters(page, table, varied)
    _add_maps(page, table, varied, names)
    _add_distributions(page, table, names)
    _add_troubles(page, table, varied)
    _add_effort(page, table)
    return page


def _features(table: pl.DataFrame, asked: Sequence[str] | None) -> list[str]:
    for name in asked or ():
        if name not in table.columns:
            raise SceneError("features", repr(name), f"some of {', '.join(table.columns)}")
    if asked is not None:
        return list(asked)
    numeric = [
        n
        for n in table.columns
        if table[n].dtype.is_numeric() and table[n].null_count() < table.height
    ]
    found = [next((n for n in numeric if n.endswith(end)), None) for end in _WANTED]
    return [name for name in found if name is not None]


def _varied(table: pl.DataFrame, parameters: Sequence[str]) -> list[str]:
    return [name for name in parameters if table[name].n_unique() > 1]


def _add_parameters(page: Page, table: pl.DataFrame, varied: list[str]) -> None:
    page.section("What was varied")
    rows = []
    for name in varied:
        column = table[name]
        if column.dtype.is_numeric():
            low, high = float(column.min()), float(column.max())  # type: ignore[arg-type]
            span = [words.number(low), words.number(high)]
        else:
            span = [str(column.min()), str(column.max())]
        rows.append([name, f"{column.n_unique()}", *span])
    page.table(["column", "values", "least", "largest"], rows)


def _add_maps(page: Page, table: pl.DataFrame, varied: list[str], names: list[str]) -> None:
    from .. import plot

    grids = [
        name for name in varied if table[name].dtype.is_numeric() and table[name].n_unique() <= 60
    ]
    if len(grids) < 2:
        return
    page.section("Maps")
    # A mean over healthy and damaged cases would describe neither.
    by = _fault(table)
    parts = {"": table}
    if by is not None:
        met = f"a loaded contact met a defect of the {by.removeprefix('fault_').replace('_', ' ')}"
        parts = {
            f", where {met}": table.filter(table[by]),
            f", but for those where {met}": table.filter(~table[by]),
        }
    for name in names:
        for which, part in parts.items():
            caption = (
                f"{name} over {grids[0]} and {grids[1]}: the mean of the cases of each cell{which}."
            )
            if part[name].drop_nulls().len():
                page.figure(plot.campaign_map(part, grids[0], grids[1], name), caption)


def _add_distributions(page: Page, table: pl.DataFrame, names: list[str]) -> None:
    from .. import plot

    page.section("Distributions")
    by = _fault(table)
    for name in names:
        caption = f"{name} of all cases" + (
            f", by {by}: whether a loaded contact met such a defect" if by else ""
        )
        if table[name].drop_nulls().len():
            page.figure(plot.distribution(table, name, by=by), caption + ".")


def _fault(table: pl.DataFrame) -> str | None:
    """Return the column of faults, if there is one, that separates damaged cases from others."""
    names = (f"fault_{on}" for on in SURFACES if f"fault_{on}" in table.columns)
    return next((name for name in names if table[name].drop_nulls().n_unique() > 1), None)


def _add_troubles(page: Page, table: pl.DataFrame, varied: list[str]) -> None:
    page.section("Failures and warnings")
    failed = table.filter(status="failed")
    warned = table.filter(pl.col("warnings").is_not_null())
    if failed.is_empty() and warned.is_empty():
        page.text("None: every case that ran gave a result without a warning.")
    for name, part, column in (
        ("failed", failed, "message"),
        ("ran with a warning", warned, "warnings"),
    ):
        if part.is_empty():
            continue
        page.warning(f"{part.height} of {table.height} cases {name}.")
        rows = [
            [str(line["case_id"])[:12], *(str(line[v]) for v in varied), str(line[column])]
            for line in part.head(_SHOWN).to_dicts()
        ]
        page.table(["case", *varied, "why"], rows)
        if part.height > _SHOWN:
            page.text(f"… and {part.height - _SHOWN} more; all are in the manifest.")


def _add_effort(page: Page, table: pl.DataFrame) -> None:
    page.section("Provenance")
    ran = table.filter(status="ok")
    versions = sorted({str(v) for v in ran["version"].drop_nulls()})
    levels = sorted({str(v) for v in ran["simd"].drop_nulls()})
    page.facts([
        ("Version of the solver", ", ".join(versions) or "–"),
        ("Vector instructions", ", ".join(levels) or "–"),
        ("Evaluations of the equations", words.large(float(ran["nfev"].sum() or 0))),
        ("Wall time of all cases", f"{words.number(float(ran['wall_time'].sum() or 0.0))} s"),
    ])  # fmt: skip
