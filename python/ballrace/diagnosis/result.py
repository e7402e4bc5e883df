"""A verdict with its evidence."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from .._base.html import paragraph, table
from .._base.text import printable
from .combs import Part
from .envelopes import Levels
from .evidence import Evidence
from .sensitivity import Sensitivity
from .severity import Severity
from .shaft import ShaftRate
from .verdict import NAMES, Verdicts
from .width import Sized, Width

if TYPE_CHECKING:
    import os

    import plotly.graph_objects as go

    from ..spectra.checks import Given


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Diagnosis:
    """Result of :func:`ballrace.diagnose` on a record.

    Attributes
    ----------
    verdict : {"healthy", "damaged", "undecided"}
        The verdict.
    parts : tuple of {"outer_race", "inner_race", "ball"}
        What is damaged, the surest first; empty unless ``damaged``.
    why : str
        Reason for the verdict; where it is undecided, what would decide.
    evidence : mapping of str to Evidence
        Of ``outer_race``, ``inner_race``, ``ball`` and ``cage``; empty where the record allows none. The cage's
        line alone is no sign of damage.
    shaft : ShaftRate
        Rate of the shaft, and whether it comes from the record.
    severity : Severity or None
        Severity of the vibration; None where the record allows no evidence.
    width : Width
        How wide the spall of a damaged race is, with an interval, or why that is not known.
    sensitivity : Sensitivity or None
        Least damage that would have stood out; None where hardly any would, and of a run, which has no noise.
    false_alarm : float
        Share of healthy records that may be called damaged, as asked for.
    threshold : float
        The z that follows from it.
    bearing : str
        What the bearing is called.
    record : str
        Column, length and sampling rate of the record.
    unit : str
        Its unit; empty where it is not known.
    notes : tuple of str
        What else there is to know: what could not be judged, and what the record was warned of.
    """

    verdict: Verdicts
    parts: tuple[Part, ...]
    why: str
    evidence: Mapping[Part, Evidence]
    shaft: ShaftRate
    severity: Severity | None
    width: Width
    false_alarm: float
    threshold: float
    bearing: str
    record: str
    unit: str
    notes: tuple[str, ...] = ()
    sensitivity: Sensitivity | None = None
    _levels: Levels | None = field(default=None)
    _bands: tuple[tuple[float, float], ...] = ()
    _size: Sized | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "evidence", MappingProxyType(dict(self.evidence)))

    def __reduce__(self) -> tuple[Any, ...]:
        fields = {name: getattr(self, name) for name in self.__dataclass_fields__}
        return _remade, (fields | {"evidence": dict(self.evidence)},)

    def __repr__(self) -> str:
        by = f"z above {self.threshold:.1f} in {100.0 * self.false_alarm:g} % of healthy records"
        lines = [
            f"<Diagnosis of {self.bearing}, {self.record}: {headline(self)}",
            f"  {reason(self)}",
            "  " + (", ".join(map(_short, self.evidence.values())) or "no evidence"),
            *([f"  {width_of(self)}"] if self.width.part else []),
            f"  {by}; shaft {self.shaft.rate:.3f} Hz ({self.shaft.by})",
        ]
        return printable("\n".join(lines)) + ">"

    def _repr_html_(self) -> str:
        """Return the verdict and a table of the evidence, as notebooks show it."""
        summary = paragraph(f"{self.bearing}: {headline(self)}.", f"{capital(reason(self))}.")
        return summary + table(header_of(self.unit), self.rows())

    def _row(self, one: Evidence) -> int:
        """Return the row of the levels in which a part stands out most."""
        return self._bands.index(one.band) + len(self._bands) * (one.whitening == "smoothed")

    def rows(self) -> list[list[str]]:
        """Return the evidence as text: part, z, probability, ratio, factor, band, depth, acceleration."""
        return [_row(one) for one in self.evidence.values()]

    def plot(
        self, part: Part | None = None, fig: go.Figure | None = None, **layout: Any
    ) -> go.Figure:
        """Draw the envelope spectrum in the deciding band with the lines of a part and the null's band.

        Parameters
        ----------
        part : {"outer_race", "inner_race", "ball", "cage"}, optional
            Whose lines are drawn; by default those of the part that stands out most.
        fig : plotly.graph_objects.Figure, optional
            Figure to draw into.
        **layout
            For ``fig.update_layout``.

        Raises
        ------
        SceneError
            There is no such part, or the record allowed no evidence.
        """
        from .picture import picture

        return picture(self, self._levels, part, fig, layout)

    def against(
        self,
        reference: Given,
        *,
        fs: float | None = None,
        column: str | None = None,
        unit: str | None = None,
    ) -> Diagnosis:
        """Return the diagnosis with the change of its severity since another record of the same machine.

        Parameters
        ----------
        reference : Signals, Measurement, Recording, Channel or array_like, shape (n,)
            A record of the machine in good condition.
        fs, column, unit
            As of :func:`ballrace.diagnose`.

        Returns
        -------
        Diagnosis
            The same, but for ``severity.change``: ratios to the reference, of crest factor and kurtosis in the
            deciding band of this record. ``report`` includes them.

        Raises
        ------
        SceneError
            The record allowed no evidence, or the reference has another unit or does not reach that band.
        KeyError
            There is no such column.
        """
        from .reference import against

        return against(self, reference, fs, column, unit)

    def plot_size(
        self, beside: Diagnosis | None = None, fig: go.Figure | None = None, **layout: Any
    ) -> go.Figure:
        """Draw the averaged pass of a ball over the spall, with both events marked.

        Parameters
        ----------
        beside : Diagnosis, optional
            Another one, as of a run with a spall of the width that was found, drawn over it.
        fig : plotly.graph_objects.Figure, optional
            Figure to draw into.
        **layout
            For ``fig.update_layout``.

        Raises
        ------
        SceneError
            The width of one is not known.
        """
        from .size_picture import size_picture

        return size_picture(self._size, None if beside is None else beside._size, fig, layout)

    def report(self, path: str | os.PathLike[str], *, title: str | None = None) -> None:
        """Write a page that needs no network: verdict, evidence, picture, severity, and what to trust.

        Parameters
        ----------
        path : str or path
            File to write, ``.html``; one of the same name is replaced.
        title : str, optional
            Title of the page.

        Raises
        ------
        SceneError
            The name does not end in ``.html``, or plotly is not installed.
        OSError
            The file cannot be written.
        """
        from ..report import write_page
        from .page import diagnosis_page

        write_page(path, lambda: diagnosis_page(self, title))


HEADER = (
    "part", "z", "by chance", "sound : damaged", "order found / expected", "band, Hz", "depth",
    "at the fault's rate",
)  # fmt: skip
"""Columns of :meth:`Diagnosis.rows`."""


def header_of(unit: str) -> list[str]:
    """Return the columns of :meth:`Diagnosis.rows` for a record in a unit."""
    return [*HEADER[:-1], f"{HEADER[-1]}, {unit or 'unit not known'}"]


def headline(of: Diagnosis) -> str:
    """Return the verdict with the parts, such as ``damaged, outer race``."""
    return of.verdict + "".join(f", {NAMES[part]}" for part in of.parts)


def reason(of: Diagnosis) -> str:
    """Return why the verdict is what it is, or what would decide."""
    return f"what would decide: {of.why}" if of.verdict == "undecided" else of.why


def capital(text: str) -> str:
    """Return a sentence that begins as one."""
    return text[:1].upper() + text[1:]


def width_of(of: Diagnosis) -> str:
    """Return the width of a spall in words."""
    width = of.width
    if width.value is None or width.interval is None:
        return f"width {width.why}"
    low, high = (1e3 * end for end in width.interval)
    return f"width {1e3 * width.value:.2f} mm, 90 % within {low:.2f} to {high:.2f} mm"


def ratio_of(one: Evidence) -> str:
    """Return a likelihood ratio in words, such as ``1 : 30``."""
    if one.ratio is None:
        return "–"
    many = max(one.ratio, 1.0 / one.ratio)
    odds = f"{many:.0f}" if many >= 9.5 else f"{many:.1f}"
    return f"{odds} : 1" if one.ratio >= 1.0 else f"1 : {odds}"


def _short(one: Evidence) -> str:
    return f"{NAMES[one.part]} z {one.z:.1f}"


def _row(one: Evidence) -> list[str]:
    z, band = f"{one.z:.1f}".replace("-", "−"), f"{one.band[0]:.0f}–{one.band[1]:.0f}"
    strength = [f"{one.strength.depth:.2f}", f"{one.strength.acceleration:.3g}"]
    chances = [f"{one.probability:.2g}", ratio_of(one)]
    return [NAMES[one.part], z, *chances, f"{one.factor:.3f}", band, *strength]


def _remade(fields: dict[str, Any]) -> Diagnosis:
    return Diagnosis(**fields)
