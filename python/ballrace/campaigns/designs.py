"""Tables of cases: one row a case, one column a field of the scene."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from itertools import islice
from numbers import Real
from typing import Any

import numpy as np

from .._base.document import Part
from .._base.libraries import pl, scipy
from .._base.numbers import counted, real
from ..errors import SceneError

MOST_CASES = 10_000_000
"""Most rows of a table: a mistyped number is refused before it takes the memory."""


def grid(values: Mapping[str, Iterable[object]]) -> pl.DataFrame:
    """Return every combination of the given values, the last column changing fastest.

    Parameters
    ----------
    values : mapping of str to iterable
        Values by dotted path of a field, or by the name of a label.

    Raises
    ------
    SceneError
        There is nothing to combine, or there would be more than ten million cases.

    Examples
    --------
    >>> import ballrace as br
    >>> table = br.grid({"loads.axial.force": [0.0, 3000.0], "defects.spall.width": [0.0, 1e-3, 2e-3]})
    >>> table.shape, table.row(1)
    ((6, 2), (0.0, 0.001))
    """
    lists = {name: _listed(name, column) for name, column in _named("values", values).items()}
    count = math.prod(len(column) for column in lists.values())
    check_cases("values", count)
    each, columns = count, []
    for name, column in lists.items():
        each //= len(column)
        place = np.arange(count) // each % len(column)
        columns.append(_series(name, column)[place])
    return pl.DataFrame(columns)


def _named(argument: str, columns: object) -> Mapping[str, Any]:
    """Return columns by their names, of which there must be one."""
    if not isinstance(columns, Mapping) or not columns:
        raise SceneError(argument, repr(columns), "at least one column, by its name")
    for name in columns:
        if not isinstance(name, str) or not name:
            raise SceneError(argument, f"a column {name!r}", "columns with names")
    return columns


def _listed(name: str, column: object) -> list[object]:
    values = column if isinstance(column, Iterable) and not isinstance(column, str | bytes) else ()
    # No more than is needed to know that they are too many: a generator may have no end.
    found = list(islice(values, MOST_CASES + 1))
    if not found:
        raise SceneError(name, repr(column), "at least one value, in a list")
    check_cases(name, len(found))
    return found


def _series(name: str, column: list[object]) -> pl.Series:
    """Return a column whose cells are what was given, as objects where polars has no type for them."""
    # A number beside a word would become a word, and beside a list there is no type for both.
    kinds = (str, bytes, Mapping, Sequence, np.ndarray, Part, Real, np.bool_)
    present = [value for value in column if value is not None]
    if len({next((k for k in kinds if isinstance(v, k)), type(v)) for v in present}) <= 1:
        # For some types that polars does not support it raises errors of Python's own, too.
        with suppress(pl.exceptions.PolarsError, TypeError, ValueError, AttributeError):
            return pl.Series(name, column, strict=False)
    return pl.Series(name, column, dtype=pl.Object)


def latin_hypercube(
    ranges: Mapping[str, tuple[float, float]], n: int, *, seed: int
) -> pl.DataFrame:
    """Return a Latin hypercube sample: each of ``n`` equal parts of every range has one value.

    Parameters
    ----------
    ranges : mapping of str to (float, float)
        Lowest and highest value by dotted path of a field.
    n : int
        Number of cases, at most ten million.
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
    count, seed = _checked(ranges, n, seed)
    return _scaled(scipy.stats.qmc.LatinHypercube(len(ranges), rng=seed).random(count), ranges)


def sobol(ranges: Mapping[str, tuple[float, float]], n: int, *, seed: int) -> pl.DataFrame:
    """Return the first ``n`` points of a scrambled Sobol sequence, which fill the ranges evenly.

    Parameters
    ----------
    ranges, seed
        As for :func:`latin_hypercube`.
    n : int
        Number of cases, a power of two, at most ten million: other numbers unbalance the sequence.

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
    count, seed = _checked(ranges, n, seed)
    if count & (count - 1):
        raise SceneError("n", str(n), "a power of two")
    return _scaled(scipy.stats.qmc.Sobol(len(ranges), rng=seed).random(count), ranges)


def _checked(ranges: Mapping[str, tuple[float, float]], n: int, seed: int) -> tuple[int, int]:
    for name, pair in _named("ranges", ranges).items():
        is_pair = isinstance(pair, tuple | list) and len(pair) == 2
        low, high = map(real, pair) if is_pair else (math.nan, math.nan)
        if not (low < high and math.isfinite(high - low)):
            raise SceneError(name, repr(pair), "two finite numbers, the second above")
    return counted_cases(n), counted("seed", seed, 0)


def counted_cases(n: object) -> int:
    """Return the number of cases that was asked for as ``n``."""
    count = counted("n", n, 1)
    check_cases("n", count)
    return count


def check_cases(name: str, count: int) -> None:
    """Refuse a table of improbably many cases; ``name`` is what asks for them."""
    if count > MOST_CASES:
        raise SceneError(name, f"{count:,} cases", f"at most {MOST_CASES:,}")


def _scaled(unit: Any, ranges: Mapping[str, tuple[float, float]]) -> pl.DataFrame:
    columns = zip(ranges.items(), unit.T, strict=True)
    return pl.DataFrame(
        {name: real(low) + (real(high) - real(low)) * u for (name, (low, high)), u in columns}
    )
