"""Width of a spall from records at several speeds: edges are an arc apart, ringing follows by a time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..errors import SceneError
from .verdict import NAMES
from .width import Width, unknown_width, width_of_arc

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from .result import Diagnosis

_APART = 1.3
"""Highest speed over the lowest, at least."""

_ALIKE = 0.1
"""How far arcs, or times, may be from their median, for them to be alike."""


def width_over_speeds(diagnoses: Iterable[Diagnosis]) -> Width:
    """Return the width of a spall that records of one bearing at several speeds agree on.

    The edges of a spall are an arc apart at any speed. What rings after a single event follows it by the same
    time, so that its arc grows with the speed.

    Parameters
    ----------
    diagnoses : iterable of Diagnosis
        Of at least two records of the same damage, at speeds of which the highest is 1.3 times the lowest and
        more.

    Returns
    -------
    Width
        From the median of the arcs where all are within a tenth of it; else ``value`` is None, and ``why`` says
        what they do. Records without a second event do not count.

    Raises
    ------
    SceneError
        There are fewer than two diagnoses, or they are not of one bearing.

    Examples
    --------
    >>> import ballrace as br, numpy as np
    >>> noise = np.random.default_rng(1).normal(size=48_000)
    >>> found = [br.diagnose(noise, "6205", rpm, fs=12_000.0) for rpm in (1200.0, 1800.0)]
    >>> br.diagnosis.width_over_speeds(found).why
    'not known: no race is damaged'
    """
    found = list(diagnoses)
    names = sorted({one.bearing for one in found})
    if len(found) < 2 or len(names) > 1:
        given = f"{len(found)} diagnoses of {', '.join(names) or 'nothing'}"
        raise SceneError("diagnoses", given, "at least two, of one bearing")
    parts = {one.width.part for one in found if one.width.part is not None}
    if not parts:
        return unknown_width("no race is damaged").width
    part = min(parts)
    if len(parts) > 1:
        named = " and ".join(NAMES[each] for each in sorted(parts))
        return unknown_width(f"the diagnoses name {named}").width
    clear = [one for one in found if one.width.spacing is not None]
    arcs = np.array([one.width.spacing for one in clear], dtype=np.float64)
    rates = np.array([one.shaft.rate for one in clear])
    if len(clear) < 2 or rates.max() < _APART * rates.min():
        speeds = ", ".join(f"{rate:.3g}" for rate in rates) or "none"
        why = (
            f"a second event of a pass stands out in {len(clear)} of {len(found)} records, at {speeds} turns a "
            "second; two are needed, one at 1.3 times the speed of the other"
        )
        return unknown_width(why, part).width
    what = (
        f"the second event of a pass comes {', '.join(f'{1e3 * arc:.2f}' for arc in arcs)} mm behind the first at "
        f"{', '.join(f'{rate:.3g}' for rate in rates)} turns a second"
    )
    if not _alike(arcs):
        cause = (
            "by the same time, as ringing does" if _alike(arcs / rates) else "no arc that all have"
        )
        return unknown_width(f"{what}: {cause}", part).width
    size = clear[0]._size
    assert size is not None
    return width_of_arc(part, float(np.median(arcs)), size.ball_diameter, what)


def _alike(of: NDArray[np.float64]) -> bool:
    return bool((np.abs(of / np.median(of) - 1.0) <= _ALIKE).all())
