"""A trend with its table."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from .._base.libraries import pl
from .._base.text import printable

if TYPE_CHECKING:
    import plotly.graph_objects as go


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Trend:
    """Result of :func:`ballrace.trend` on the records of a bearing.

    Attributes
    ----------
    table : polars.DataFrame
        A row a record: ``time``; ``verdict`` and ``parts`` (joined by +); ``shaft`` [Hz]; ``rms`` [unit of the
        records]; ``velocity`` [mm/s] and ``zone`` of ISO 20816-3; ``<part>.z`` and ``<part>.acceleration`` of
        ``outer_race``, ``inner_race`` and ``ball``; ``<part>.lines``, how high their lines stand in the spectra
        of the squared envelope of the last ``pooled`` records [dB]; ``crest_factor`` and ``kurtosis``
        in ``band``. Cells are empty where a record has no value.
    baseline : int
        How many of the first records are the baseline.
    pooled : int
        How many records share the spectra of ``<part>.lines``.
    limits : mapping of str to float
        Limit that each quantity has to exceed twice in a row to depart, by column.
    departures : mapping of str to int
        The record at which a quantity departs, from 0, by column; only those that do.
    band : tuple of two floats, or None
        Band of crest factor and kurtosis [Hz].
    bearing : str
        What the bearing is called.
    unit : str
        Unit of the records; empty where it is not known.
    """

    table: pl.DataFrame
    baseline: int
    pooled: int
    limits: Mapping[str, float]
    departures: Mapping[str, int]
    band: tuple[float, float] | None
    bearing: str
    unit: str

    @property
    def departed(self) -> int | None:
        """The first record, from 0, at which any quantity departs from the baseline; None if there is none."""
        return min(self.departures.values(), default=None)

    def __repr__(self) -> str:
        head = f"<Trend of {self.bearing}: {self.table.height} records, baseline {self.baseline}"
        if self.departed is None:
            return printable(f"{head}; none departs>")
        first = [name for name, at in self.departures.items() if at == self.departed]
        time = self.table["time"][self.departed]
        return printable(f"{head}; record {self.departed} at {time:g} departs: {', '.join(first)}>")

    def _repr_html_(self) -> str:
        """Return the table, as notebooks show it."""
        return self.table._repr_html_()

    def plot(self, fig: go.Figure | None = None, **layout: Any) -> go.Figure:
        """Draw z of each part, and each quantity over its limit, over time, with the first departure.

        Parameters
        ----------
        fig : plotly.graph_objects.Figure, optional
            Figure to draw into.
        **layout
            For ``fig.update_layout``.
        """
        from .picture import picture

        return picture(self, fig, layout)
