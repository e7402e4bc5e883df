"""Likelihood ratio of what was found: with a part healthy over with it damaged, among simulated bearings.

Lines that stand out are no damage by themselves: a loaded healthy bearing has some, too. On the records of the
library a logistic regression separates damage of a part from everything else, other damage included, by how far
its lines stand out, alone and compared with those of other parts, and by their depth of modulation, kurtosis and
acceleration. Its odds over the odds of the library are a likelihood ratio (N. Brümmer, J. du Preez, Comput. Speech
Lang. 20 (2006) 230), which does not depend on how many records of the library are damaged. It is limited to
1 : 100 and 100 : 1, since some 1400 records do not support more.
"""

from __future__ import annotations

import functools
import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from .library import library
from .null import ACCUSED

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from .combs import Part
    from .evidence import Evidence

__all__ = ["at_any_size", "fitted", "judged", "odds_of", "rows_of", "strongest", "with_ratios"]

_LARGEST = 100.0
_Z = 12.0
"""z above which more does not count: longer records have higher ones than the library's."""

_RIDGE = 0.3
"""Pull of the coefficients of standardised numbers towards 0."""

_STEPS = 30


def at_any_size(acceleration: float, diameter: float, rate: float) -> float:
    """Return an acceleration as a number that healthy bearings of all sizes have alike [m²/s].

    Waves of a height h on a race move a ring of a mass m on contacts of a stiffness k by an acceleration of h·k/m.
    Of bearings that differ in size alone, pressed alike, k goes with the pitch diameter D (Hertz) and m with its
    cube: waves of the same height, as grinding leaves them, cause accelerations as 1/D². Impacts of spalls that
    are the same part of a ball wide go as 1/D. Among the records of the library it is D to the power −2.2 without
    damage, −1.4 with a damaged outer race. Over the speed v of the pitch circle, as both grow, it is a·D²/v.

    Parameters
    ----------
    acceleration : float
        What comes at the rate of a fault, as a root mean square [m/s²].
    diameter : float
        Pitch diameter [m].
    rate : float
        Rate of the shaft [Hz].
    """
    return acceleration * diameter / (math.pi * rate)


@functools.cache
def strongest(part: Part) -> float:
    """Return the largest number of :func:`at_any_size` of the lines of a part among healthy bearings [m²/s].

    Lines that are stronger are rarer among n healthy bearings than 1/(n + 1), whatever a regression makes of them,
    and n is 144.
    """
    rows = judged()
    return float(rows[f"accel_{part}"][rows["part"] == "none"].max())


def with_ratios(
    evidence: Mapping[Part, Evidence], diameter: float | None, rate: float
) -> dict[Part, Evidence]:
    """Return evidence with likelihood ratios.

    Parameters
    ----------
    evidence : mapping of str to Evidence
        Of all parts.
    diameter : float or None
        Pitch diameter [m]; None where strength does not count, since the unit of the record is not known.
    rate : float
        Rate of the shaft [Hz].
    """
    row = _as_row(evidence, diameter, rate)
    ratios = {
        part: _ratio(part, evidence[part].role, row, diameter is not None) for part in ACCUSED
    }
    return {part: replace(one, ratio=ratios.get(part)) for part, one in evidence.items()}


def _ratio(part: Part, role: Part, row: NDArray[Any], sized: bool) -> float:
    """Return the ratio of a part by the records of the library with the part that has its role."""
    rows = judged()
    model = fitted(role, sized)
    prior = np.count_nonzero(rows["part"] == role) / np.count_nonzero(rows["part"] != role)
    ratio = prior / odds_of(model, rows_of(part, row, sized))[0]
    return float(np.clip(ratio, 1.0 / _LARGEST, _LARGEST))


def judged() -> NDArray[Any]:
    """Return the records of the library that are long enough for evidence."""
    rows = library()
    found: NDArray[Any] = rows[np.isfinite(rows["kurtosis"])]
    return found


def _as_row(evidence: Mapping[Part, Evidence], diameter: float | None, rate: float) -> NDArray[Any]:
    """Return evidence as a row of the library."""
    row: dict[str, float] = {"kurtosis": evidence[ACCUSED[0]].strength.kurtosis}
    for part in ACCUSED:
        one = evidence[part]
        row[f"z_{part}"], row[f"depth_{part}"] = one.z, one.strength.depth
        row[f"accel_{part}"] = math.nan
        if diameter is not None:
            row[f"accel_{part}"] = at_any_size(one.strength.acceleration, diameter, rate)
    return np.array([tuple(row.values())], dtype=[(name, float) for name in row])


def rows_of(part: Part, table: NDArray[Any], sized: bool) -> NDArray[np.float64]:
    """Return what the regression of a part takes of rows of the library, shape (rows, numbers)."""
    z = np.clip(table[f"z_{part}"], None, _Z)
    others = [np.clip(table[f"z_{other}"], None, _Z) for other in ACCUSED if other != part]
    columns = [z, z - np.maximum(*others), _log(table[f"depth_{part}"]), _log(table["kurtosis"])]
    if sized:
        columns.append(_log(table[f"accel_{part}"]))
    return np.stack(columns, axis=1)


def _log(x: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.log10(np.maximum(x, 1e-6))


Model = tuple["NDArray[np.float64]", "NDArray[np.float64]", "NDArray[np.float64]"]
"""Means and deviations of the numbers, and coefficients, the constant first."""


@functools.cache
def fitted(part: Part, sized: bool, without: str = "") -> Model:
    """Return the regression of a part over the library, on request without a bearing.

    Parameters
    ----------
    part : {"outer_race", "inner_race", "ball"}
        Part.
    sized : bool
        Whether strength counts.
    without : str
        Designation of a bearing whose records are left out.
    """
    rows = judged()
    rows = rows[rows["bearing"] != without]
    x = rows_of(part, rows, sized)
    mean, deviation = x.mean(axis=0), x.std(axis=0)
    x = np.column_stack([np.ones(len(x)), (x - mean) / deviation])
    return mean, deviation, _regression(x, rows["part"] == part)


def _regression(x: NDArray[np.float64], true: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Return the coefficients of greatest likelihood less the ridge, by Newton's method."""
    found = np.zeros(x.shape[1])
    ridge = _RIDGE * np.diag([0.0] + [1.0] * (x.shape[1] - 1))
    for _ in range(_STEPS):
        chance = 1.0 / (1.0 + np.exp(-x @ found))
        gradient = x.T @ (true - chance) - ridge @ found
        found = found + np.linalg.solve(
            (x * (chance * (1.0 - chance))[:, np.newaxis]).T @ x + ridge, gradient
        )
    return found


def odds_of(model: Model, x: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the odds of damage by a regression, shape (rows,)."""
    mean, deviation, coefficients = model
    logit = coefficients[0] + ((x - mean) / deviation) @ coefficients[1:]
    odds: NDArray[np.float64] = np.exp(np.clip(logit, -50.0, 50.0))
    return odds
