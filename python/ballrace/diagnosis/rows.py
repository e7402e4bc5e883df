"""A bearing of several rows: each row that has orders of its own is judged."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from .kinematics import kinematics_of
from .null import ACCUSED

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..scene import Scene
    from .result import Diagnosis

_ALIKE = 0.015
"""Orders of two rows that differ by less, as a part of them, are those of one for a search that allows for
slip."""

_RANK = {"damaged": 2, "undecided": 1, "healthy": 0}


def judged_by_rows(
    scene: Scene, false_alarm: float, judge: Callable[[int, float], Diagnosis]
) -> Diagnosis:
    """Return the verdict on the row with the strongest sign of damage, with a note on the others.

    Parameters
    ----------
    scene : Scene
        A scene of several rows.
    false_alarm : float
        Of the whole bearing: each row that is judged gets its part of it.
    judge : function of a row and a false-alarm rate
        Returns the diagnosis of a row.
    """
    alike = _alike(scene)
    found = {rows[0]: judge(rows[0], false_alarm / len(alike)) for rows in alike}
    worst = max(alike, key=lambda rows: _rank(found[rows[0]]))
    chosen = found[worst[0]]
    others = (f"{_named(rows)}: {found[rows[0]].verdict}" for rows in alike if rows is not worst)
    notes = [*chosen.notes, *others]
    if len(worst) > 1:
        notes.append(f"{_named(worst)} have the same orders: lines do not show which of them it is")
    return replace(chosen, bearing=f"{chosen.bearing}, {_named(worst)}", notes=tuple(notes))


def _alike(scene: Scene) -> list[list[int]]:
    """Return the rows by their orders: those that the search for a common factor takes for one are together."""
    groups: list[tuple[float, float, list[int]]] = []
    for row in range(len(scene.rows)):
        orders = kinematics_of(scene, row).orders
        for bpfo, bpfi, rows in groups:
            ratios = (orders.bpfo / bpfo, orders.bpfi / bpfi)
            if all(abs(ratio - 1.0) <= _ALIKE for ratio in ratios):
                rows.append(row)
                break
        else:
            groups.append((orders.bpfo, orders.bpfi, [row]))
    return [rows for _, _, rows in groups]


def _rank(found: Diagnosis) -> tuple[int, float]:
    z = (found.evidence[part].z for part in ACCUSED if part in found.evidence)
    return _RANK[found.verdict], max(z, default=0.0)


def _named(rows: list[int]) -> str:
    numbers = " and ".join(map(str, rows))
    return f"row {numbers}" if len(rows) == 1 else f"rows {numbers}"
