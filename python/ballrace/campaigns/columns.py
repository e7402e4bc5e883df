"""Columns of results: those of every row, and features that some row has."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from .._base.libraries import pl
from ..scene.defect import SURFACES

FAULTS = tuple(f"fault_{surface}" for surface in SURFACES)

STATISTICS = {
    "accepted": "Int64", "rejected": "Int64", "nfev": "Int64", "wall_time": "Float64",
    "acceleration_residual": "Float64", "truncated_contacts": "Int64", "simd": "String",
}  # fmt: skip
"""Results of the core for every run besides its features, by the name there, with the type of the column."""

BASE = (
    "case_id", *FAULTS, "status", "error", "message", "warnings", "version", *STATISTICS, "signals",
)  # fmt: skip
"""Columns of every row of results; features follow."""

BUDGET = {"budget": "String", "budget_limit": "Float64"}
"""Columns of the limit that a case has spent, and what it was: results that the manifest leaves out."""


def schema() -> dict[str, Any]:
    """Return the types of the columns that every row of results has."""
    types = {**STATISTICS, **BUDGET, **dict.fromkeys(FAULTS, "Boolean")}
    return {name: getattr(pl, types.get(name, "String")) for name in (*BASE, *BUDGET)}


def found_in(table: pl.DataFrame, features: Iterable[str]) -> list[str]:
    """Return the features that some row has: records may be too short for lines, or for standard errors."""
    return [name for name in features if table[name].null_count() < table.height]


def check_results(frame: pl.DataFrame) -> None:
    """Refuse a table that has the right hash but was not written as rows of results."""
    base = schema()
    if not {"case_id", "status"} <= set(frame.columns):
        raise ValueError("it has no rows of results")
    for name, found in frame.schema.items():
        if found != base.get(name, pl.Float64):
            raise ValueError(f"its column {name} is of type {found}")
