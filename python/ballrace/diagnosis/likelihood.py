"""Likelihood ratio of what was found: with a part healthy over with it damaged, among simulated bearings.

A logistic regression separates simulated damage of a part from everything else, other damage included, by how
far its lines stand out, alone and compared with those of other parts, and by their depth of modulation, kurtosis
and acceleration; more of any of these never makes damage less likely. Its odds over the odds of the library are
a likelihood ratio (N. Brümmer, J. du Preez, Comput. Speech Lang. 20 (2006) 230), which does not depend on how
many records of the library are damaged. It is limited to 1 : 100 and 100 : 1, since some 2100 records do not
support more.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from .fit import fit
from .null import ACCUSED

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from .combs import Part
    from .evidence import Evidence

_LARGEST = 100.0
_Z = 12.0
"""z above which more does not count: longer records have higher ones than the library's."""


def at_any_size(acceleration: float, diameter: float, rate: float) -> float:
    """Return an acceleration as a number that healthy bearings of all sizes have alike [m²/s].

    Waves of a height h on a race move a machine of a mass m on contacts of a stiffness k by an acceleration of
    h·k/m. Of bearings that differ in size alone, pressed alike, k goes with the pitch diameter D (Hertz) and m
    with its cube: waves of the same height, as grinding leaves them, cause accelerations as 1/D². Impacts of
    spalls that are the same part of a ball wide go as 1/D. Among the records of the library, with noise of motors
    and at the ends of paths, it is D to the power −1.5 without damage, −0.8 with a damaged outer race. Over the
    speed v of the pitch circle, as both grow, it is a·D²/v.

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
    """Return the ratio of a part by the regression of the part that has its role."""
    model = fit()["ratio"][role]["sized" if sized else "unsized"]
    x = (numbers_of(part, row, sized)[0] - model["mean"]) / model["deviation"]
    logit = model["constant"] + float(x @ model["coefficients"])
    ratio = model["prior"] * math.exp(-max(min(logit, 50.0), -50.0))
    return float(np.clip(ratio, 1.0 / _LARGEST, _LARGEST))


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


def numbers_of(part: Part, table: NDArray[Any], sized: bool) -> NDArray[np.float64]:
    """Return what the regression of a part takes of a table's rows, shape (rows, numbers).

    Parameters
    ----------
    part : {"outer_race", "inner_race", "ball"}
        Part.
    table : structured ndarray, shape (rows,)
        With ``z_<part>``, ``depth_<part>`` and ``accel_<part>`` (of :func:`at_any_size`) of all parts, and
        ``kurtosis``.
    sized : bool
        Whether strength counts.
    """
    z = np.clip(table[f"z_{part}"], None, _Z)
    others = [np.clip(table[f"z_{other}"], None, _Z) for other in ACCUSED if other != part]
    columns = [z, z - np.maximum(*others), _log(table[f"depth_{part}"]), _log(table["kurtosis"])]
    if sized:
        columns.append(_log(table[f"accel_{part}"]))
    return np.stack(columns, axis=1)


def _log(x: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.log10(np.maximum(x, 1e-6))
