"""Rows for training and for testing, with no bearing in both parts."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .._base.numbers import counted, real
from ..errors import SceneError
from .classes import classes_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    import polars as pl
    from numpy.typing import NDArray

_TRIES = 200
"""Random orders in which bearings are assigned; the most even result counts."""


def bearing_split(
    manifest: pl.DataFrame,
    test: float = 0.25,
    groups: str = "bearing_id",
    *,
    balance: str | Sequence[str] | None = None,
    seed: int = 0,
) -> tuple[pl.DataFrame, pl.DataFrame]:
    """Split a table for training and testing: no bearing is in both parts, and every class is in each.

    Windows of a run, and runs of a bearing, resemble each other, so that after a random split much of the test
    data resembles the training data. Bearings are assigned one by one in 200 random orders, each to the part that
    lacks most of its classes, and the most even result is taken.

    Parameters
    ----------
    manifest : polars.DataFrame
        A manifest, a table of windows, or the table of a data set.
    test : float
        Share of the rows of each class that are for testing, above 0 and below 1; met as closely as whole
        bearings allow.
    groups : str
        Column that identifies bearings.
    balance : str or sequence of str, optional
        Columns of classes; by default ``fault_type``, ``label`` or the three ``fault_…`` of a campaign, whichever
        exist. ``()``, or none of these: all rows are one class.
    seed : int
        Seed of the orders.

    Returns
    -------
    train, test : polars.DataFrame
        The rows, in the order of the table.

    Raises
    ------
    SceneError
        An argument is not usable, a row has no bearing, or a class has too few bearings to be in both parts.

    Examples
    --------
    >>> import polars as pl
    >>> table = pl.DataFrame({"bearing_id": [0, 0, 1, 1, 2, 2, 3, 3], "label": ["healthy", "ball"] * 4})
    >>> train, test = bearing_split(table, test=0.25)
    >>> train.height, test.height, set(train["bearing_id"]) & set(test["bearing_id"])
    (6, 2, set())
    """
    if not 0.0 < real(test) < 1.0:
        raise SceneError("test", repr(test), "a share of the rows, above 0 and below 1")
    rng = np.random.default_rng(counted("seed", seed, 0))
    bearing, names = _bearings(manifest, groups)
    kinds = classes_of(manifest, balance, "balance").fill_null("not known").rank("dense") - 1
    count = _counts(bearing, kinds.to_numpy().astype(np.intp), names)
    chosen = _most_even(count, float(test), rng)
    tested = chosen[bearing]
    return manifest.filter(~tested), manifest.filter(tested)


def _bearings(manifest: pl.DataFrame, groups: str) -> tuple[NDArray[np.intp], int]:
    """Return the number of the bearing of each row, and how many there are."""
    if groups not in manifest.columns:
        raise SceneError("groups", repr(groups), f"one of {', '.join(manifest.columns)}")
    if manifest[groups].null_count():
        raise SceneError("groups", f"{groups} with empty cells", "a bearing in every row")
    number = (manifest[groups].rank("dense") - 1).to_numpy().astype(np.intp)
    found = int(number.max(initial=-1)) + 1
    if found < 2:
        raise SceneError("groups", f"{groups} with {found} bearings", "two bearings and more")
    return number, found


def _counts(
    bearing: NDArray[np.intp], kind: NDArray[np.intp], bearings: int
) -> NDArray[np.float64]:
    """Return how many rows of each class a bearing has, shape (bearings, classes)."""
    count = np.zeros((bearings, int(kind.max()) + 1))
    np.add.at(count, (bearing, kind), 1.0)
    lonely = int(((count > 0).sum(axis=0) < 2).sum())
    if lonely:
        raise SceneError(
            "manifest", f"{lonely} of {count.shape[1]} classes with one bearing",
            "two bearings and more of each class, or balance=()",
        )  # fmt: skip
    return count


def _most_even(
    count: NDArray[np.float64], test: float, rng: np.random.Generator
) -> NDArray[np.bool_]:
    """Return which bearings are for testing."""
    share = count / count.sum(axis=0)
    best, chosen = np.inf, np.zeros(count.shape[0], dtype=bool)
    for _ in range(_TRIES):
        tried = _assigned(share, test, rng)
        part = share[tried].sum(axis=0)
        # A class that one side lacks altogether weighs more than any unevenness.
        off = np.abs(part - test).max() + ((part < 1e-9) | (part > 1.0 - 1e-9)).sum()
        if off < best:
            best, chosen = off, tried
    if best >= 1.0:
        raise SceneError("manifest", "bearings of mixed classes", "more bearings of each class")
    return chosen


def _assigned(
    share: NDArray[np.float64], test: float, rng: np.random.Generator
) -> NDArray[np.bool_]:
    """Assign bearings in a random order, to testing where that brings the classes nearer to the share."""
    tried = np.zeros(share.shape[0], dtype=bool)
    part = np.zeros(share.shape[1])
    for one in rng.permutation(share.shape[0]):
        after = part + share[one]
        if np.sum((after - test) ** 2) < np.sum((part - test) ** 2):
            tried[one], part = True, after
    return tried
