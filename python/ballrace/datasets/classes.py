"""Classes of the rows of a table."""

from __future__ import annotations

from collections.abc import Sequence

from .._base.libraries import pl
from ..errors import SceneError
from ..scene.defect import SURFACES

_KNOWN = (("fault_type",), ("label",), tuple(f"fault_{on}" for on in SURFACES))
"""Columns of classes: in data sets, in windows of a run, in campaigns and their windows."""


def classes_of(
    table: pl.DataFrame, columns: str | Sequence[str] | None, argument: str
) -> pl.Series:
    """Return the name of the class of each row, empty where it is not known.

    Parameters
    ----------
    table : polars.DataFrame
        The table.
    columns : str or sequence of str, optional
        Columns of classes; by default ``fault_type``, ``label`` or the three ``fault_…`` of a
        campaign, whichever exist. ``()``, or none of these: all rows are one class.
    argument : str
        What ``columns`` is called in an error.

    Raises
    ------
    SceneError
        There is no such column.

    Examples
    --------
    >>> import polars as pl
    >>> table = pl.DataFrame({"fault_ball": [True, False], "fault_outer_race": [True, False]})
    >>> classes_of(table, ["fault_ball", "fault_outer_race"], "label").to_list()
    ['ball+outer_race', 'healthy']
    """
    if columns is None:
        columns = next((names for names in _KNOWN if set(names) <= set(table.columns)), ())
    names = (columns,) if isinstance(columns, str) else tuple(columns)
    for name in names:
        if name not in table.columns:
            raise SceneError(argument, repr(name), f"some of {', '.join(table.columns)}")
    if names and all(table[name].dtype == pl.Boolean for name in names):
        return _joined(table, names)
    parts = [pl.col(name).cast(pl.String) for name in names] or [pl.lit("all")]
    return table.select(pl.concat_str(parts, separator=", ").alias("class")).to_series()


def _joined(table: pl.DataFrame, names: tuple[str, ...]) -> pl.Series:
    """Return the names of the columns that are true, joined."""
    known = pl.all_horizontal(pl.col(name).is_not_null() for name in names)
    true = [pl.when(pl.col(n)).then(pl.lit(n.removeprefix("fault_"))) for n in names]
    joined = pl.concat_str(true, separator="+", ignore_nulls=True)
    label = pl.when(pl.any_horizontal(*names)).then(joined).otherwise(pl.lit("healthy"))
    return table.select(pl.when(known).then(label).alias("class")).to_series()
