"""Arrays of a table of windows, as learning libraries take them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .._base.libraries import pl
from ..datasets.classes import classes_of
from ..errors import SceneError


@dataclass(frozen=True, kw_only=True, eq=False)
class Examples:
    """Windows with their classes.

    Attributes
    ----------
    x : ndarray of float32, shape (n, length)
        Samples, writable and contiguous: ``torch.from_numpy(found.x)`` copies nothing.
    y : ndarray of int64, shape (n,)
        Class of each window, as a place in ``classes``.
    classes : tuple of str
        Names of the classes, in the order of the alphabet.
    class_weight : dict of int to float
        Weight of each class, the reciprocal of its share over the number of classes, so that a rare class counts
        as much as a frequent one (scikit-learn's ``"balanced"``).
    """

    x: NDArray[np.float32]
    y: NDArray[np.int64]
    classes: tuple[str, ...]
    class_weight: dict[int, float]

    def __repr__(self) -> str:
        counts = ", ".join(
            f"{name} {np.count_nonzero(self.y == k)}" for k, name in enumerate(self.classes)
        )
        return f"<Examples: {self.x.shape[0]} windows of {self.x.shape[1]} samples: {counts}>"


def examples(
    table: pl.DataFrame, column: str = "x", label: str | Sequence[str] | None = None
) -> Examples:
    """Return a table of windows as arrays.

    Parameters
    ----------
    table : polars.DataFrame
        From :meth:`ballrace.campaigns.Campaign.windows`, or ``to_windows`` of a run or a record.
    column : str
        Column of the samples.
    label : str or sequence of str, optional
        Columns of the classes; by default ``fault_type``, ``label`` or the three ``fault_…`` of a campaign,
        whichever are there. Of several columns of true and false the names of the true ones are joined, without
        ``fault_``; none is ``healthy``.

    Raises
    ------
    SceneError
        There is no such column, or a window has no label.

    Examples
    --------
    >>> import ballrace as br
    >>> out = br.simulate(br.bearing("6205", speed_rpm=1800.0), duration=0.05, fs=10_000.0)
    >>> examples(out.to_windows(100, columns="outer.ay"), "outer.ay")
    <Examples: 5 windows of 100 samples: healthy 5>
    """
    if column not in table.columns:
        raise SceneError("column", repr(column), f"one of {', '.join(table.columns)}")
    names = classes_of(table, label, "label")
    if names.null_count():
        raise SceneError(
            "label", f"{names.null_count()} windows without one", "one for every window"
        )
    x = _samples(table[column])
    found = names.unique().sort().to_list()
    y = names.replace_strict(found, range(len(found)), return_dtype=pl.Int64).to_numpy(
        writable=True
    )
    counts = np.bincount(y, minlength=len(found))
    weight = {k: y.size / (len(found) * int(count)) for k, count in enumerate(counts)}
    return Examples(x=x, y=y, classes=tuple(found), class_weight=weight)


def _samples(column: pl.Series) -> NDArray[np.float32]:
    """Return the samples of all windows, a copy of its own."""
    if isinstance(column.dtype, pl.List) and column.list.len().n_unique() == 1:
        column = column.list.to_array(column.list.len()[0])
    if not isinstance(column.dtype, pl.Array):
        raise SceneError("column", repr(column.name), "windows of one length")
    return np.array(column.to_numpy(), dtype=np.float32)
