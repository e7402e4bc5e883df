"""Tables of cases: one row a case, one column a field of the scene."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import SceneError

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    import polars as pl

__all__ = ["grid", "latin_hypercube", "sobol"]


def grid(values: Mapping[str, Iterable[object]]) -> pl.DataFrame:
    """Return every combination of the given values, the last column changing fastest.

    Parameters
    ----------
    values : mapping of str to iterable
        Values by dotted path of a field, or by the name of a label.

    Raises
    ------
    SceneError
        There is nothing to combine.

    Examples
    --------
    >>> import ballrace as br
    >>> table = br.grid({"loads.axial.force": [0.0, 3000.0], "defects.spall.width": [0.0, 1e-3, 2e-3]})
    >>> table.shape, table.row(1)
    ((6, 2), (0.0, 0.001))
    """
    from .._polars import pl

    lists = {name: list(column) for name, column in values.items()}
    for name, column in lists.items():
        if not column:
            raise SceneError(name, "[]", "at least one value")
    if not lists:
        raise SceneError("values", "{}", "at least one column")
    count = math.prod(len(column) for column in lists.values())
    each, columns = count, []
    for name, column in lists.items():
        each //= len(column)
        # A number beside a word would become a word.
        kind = pl.Object if _is_mixed(column) else None
        place = np.arange(count) // each % len(column)
        columns.append(pl.Series(name, column, dtype=kind, strict=False)[place])
    return pl.DataFrame(columns)


def _is_mixed(column: list[object]) -> bool:
    present = [value for value in column if value is not None]
    return len({isinstance(value, str) for value in present}) > 1


def latin_hypercube(
    ranges: Mapping[str, tuple[float, float]], n: int, *, seed: int
) -> pl.DataFrame:
    """Return a Latin hypercube sample: each of ``n`` equal parts of every range is met once.

    Parameters
    ----------
    ranges : mapping of str to (float, float)
        Lowest and highest value by dotted path of a field.
    n : int
        Number of cases.
    seed : int
        The same seed gives the same table.

    Raises
    ------
    SceneError
        A range or ``n`` is not usable.

    Examples
    --------
    >>> import ballrace as br
    >>> table = br.latin_hypercube({"loads.axial.force": (-3e3, 3e3), "rows[0].clearance": (0.0, 2e-5)}, 8, seed=1)
    >>> sorted((table["loads.axial.force"] // 750).cast(int).to_list())
    [-4, -3, -2, -1, 0, 1, 2, 3]
    """
    from scipy.stats import qmc

    _check(ranges, n)
    return _scaled(qmc.LatinHypercube(len(ranges), rng=seed).random(n), ranges)


def sobol(ranges: Mapping[str, tuple[float, float]], n: int, *, seed: int) -> pl.DataFrame:
    """Return the first ``n`` points of a scrambled Sobol sequence, which fill the ranges evenly.

    Parameters
    ----------
    ranges, seed
        As for :func:`latin_hypercube`.
    n : int
        Number of cases, a power of two: others spoil the balance of the sequence.

    Raises
    ------
    SceneError
        A range or ``n`` is not usable.

    Examples
    --------
    >>> import ballrace as br
    >>> br.sobol({"loads.axial.force": (-3e3, 3e3), "rows[0].clearance": (0.0, 2e-5)}, 64, seed=1).shape
    (64, 2)
    """
    from scipy.stats import qmc

    _check(ranges, n)
    if n & (n - 1):
        raise SceneError("n", str(n), "a power of two")
    return _scaled(qmc.Sobol(len(ranges), rng=seed).random(n), ranges)


def _check(ranges: Mapping[str, tuple[float, float]], n: int) -> None:
    if not ranges:
        raise SceneError("ranges", "{}", "at least one column")
    for name, (low, high) in ranges.items():
        if not (math.isfinite(low) and math.isfinite(high) and low < high):
            raise SceneError(name, f"({low}, {high})", "two finite numbers, the second above")
    if n < 1:
        raise SceneError("n", str(n), "at least 1")


def _scaled(unit: Any, ranges: Mapping[str, tuple[float, float]]) -> pl.DataFrame:
    from .._polars import pl

    columns = zip(ranges.items(), unit.T, strict=True)
    return pl.DataFrame({name: low + (high - low) * u for (name, (low, high)), u in columns})
