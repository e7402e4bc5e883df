"""The rows of the catalogue."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from importlib import resources
from typing import TYPE_CHECKING, Literal, get_args

from .. import frequencies
from ..errors import SceneError
from .names import near, resolved
from .sources import BOUNDARY, CONFORMITY, SOURCES, Sources

if TYPE_CHECKING:
    import polars as pl

__all__ = ["Bearing", "Catalogue", "Kind", "catalogue"]

Kind = Literal["deep_groove", "angular_contact"]
"""Kind of a bearing."""


@dataclass(frozen=True, kw_only=True)
class Bearing:
    """A bearing of the catalogue, one row of balls.

    Attributes
    ----------
    designation : str
        Its name, without maker, seals and clearance.
    kind : {"deep_groove", "angular_contact"}
        Kind.
    ball_count : int
        Number of balls.
    ball_diameter, pitch_diameter : float
        Diameters [m].
    bore, outside_diameter, width : float
        Boundary dimensions; the width is that of the outer ring [m].
    contact_angle : float
        Nominal contact angle [rad].
    outer_conformity, inner_conformity : float
        Groove radius over ball diameter.
    dynamic_rating, static_rating : float
        Basic load ratings C of ISO 281 and C₀ of ISO 76 [N].
    sources : Sources
        Where the numbers come from. What is not published begins with ``estimated`` or ``assumed``.
    """

    designation: str
    kind: Kind
    ball_count: int
    ball_diameter: float
    pitch_diameter: float
    bore: float
    outside_diameter: float
    width: float
    contact_angle: float
    outer_conformity: float
    inner_conformity: float
    dynamic_rating: float
    static_rating: float
    sources: Sources

    @property
    def orders(self) -> frequencies.Orders:
        """Kinematic orders at the nominal contact angle."""
        return frequencies.orders(
            self.ball_count, self.ball_diameter, self.pitch_diameter, self.contact_angle
        )


class Catalogue(Mapping[str, Bearing]):
    """The bearings by their designations; ``ballrace.catalogue`` is the one that there is.

    A name may go on with seals, clearance and tolerance, as ``6205-2RS/C3``. They are not part of the row that it
    finds; :func:`ballrace.bearing` takes the clearance from them.

    Examples
    --------
    >>> import ballrace as br
    >>> found = br.catalogue["6205-2RS"]
    >>> found.ball_count, found.sources.balls
    (9, 'Case Western Reserve University bearing data, drive end (SKF 6205-2RS JEM)')
    >>> [b.designation for b in br.catalogue.find(kind="angular_contact", bore=25e-3)]
    ['7205C', '7205A5', '7205B', '7305B']
    """

    @cached_property
    def _rows(self) -> dict[str, Bearing]:
        text = resources.files(__package__).joinpath("bearings.csv").read_text(encoding="utf-8")
        rows = map(_bearing, csv.DictReader(text.splitlines()))
        return {row.designation: row for row in rows}

    def __getitem__(self, name: str) -> Bearing:
        designation = resolved(name, self._rows) if isinstance(name, str) else None
        if designation is None:
            raise UnknownBearingError(
                "designation", repr(name), f"a bearing of ballrace.catalogue{self._hint(str(name))}"
            )
        return self._rows[designation]

    def _hint(self, name: str) -> str:
        alike = near(name, self._rows)
        return f"; near are {', '.join(alike)}" if alike else f"; it has {len(self)}, from 6000 on"

    def __iter__(self) -> Iterator[str]:
        return iter(self._rows)

    def __len__(self) -> int:
        return len(self._rows)

    def __repr__(self) -> str:
        return f"<Catalogue of {len(self)} bearings, {', '.join(list(self)[:3])}, …>"

    def find(
        self,
        *,
        kind: Kind | None = None,
        bore: float | None = None,
        outside_diameter: float | None = None,
    ) -> tuple[Bearing, ...]:
        """Return the bearings of a kind, bore and outside diameter [m], in the order of the catalogue.

        Raises
        ------
        SceneError
            There is no such kind.
        """
        if kind is not None and kind not in get_args(Kind):
            raise SceneError("kind", repr(kind), "one of " + ", ".join(get_args(Kind)))
        return tuple(
            row
            for row in self._rows.values()
            if kind in (None, row.kind)
            and _is(row.bore, bore)
            and _is(row.outside_diameter, outside_diameter)
        )

    def to_polars(self) -> pl.DataFrame:
        """Return a table with a line per bearing, lengths in metres and loads in newtons."""
        from .._polars import pl

        rows = []
        for row in self._rows.values():
            plain = {k: v for k, v in vars(row).items() if k != "sources"}
            rows.append(plain | {f"source_{k}": v for k, v in vars(row.sources).items()})
        return pl.DataFrame(rows)


class UnknownBearingError(SceneError, KeyError):
    """No bearing of the catalogue has this name; a ``KeyError`` too, so that ``in`` and ``get`` work."""


def _is(value: float, wanted: float | None) -> bool:
    return wanted is None or math.isclose(value, wanted, rel_tol=1e-6)


def _bearing(line: dict[str, str]) -> Bearing:
    """Return the bearing of a line of the table, which has millimetres, degrees and newtons."""
    mm = {name: round(1e-3 * float(line[f"{name}_mm"]), 9) for name in _LENGTHS}
    kind: Kind = "angular_contact" if line["kind"] == "angular_contact" else "deep_groove"
    sources = Sources(
        balls=SOURCES[line["from_balls"]],
        pitch_diameter=SOURCES[line["from_pitch"]],
        boundary=BOUNDARY,
        conformity=CONFORMITY,
        ratings=SOURCES[line["from_ratings"]],
    )
    return Bearing(
        designation=line["designation"],
        kind=kind,
        ball_count=int(line["balls"]),
        ball_diameter=mm["ball"],
        pitch_diameter=mm["pitch"],
        bore=mm["bore"],
        outside_diameter=mm["outside"],
        width=mm["width"],
        contact_angle=math.radians(float(line["angle_deg"])),
        outer_conformity=0.53,
        inner_conformity=0.52,
        dynamic_rating=float(line["c_n"]),
        static_rating=float(line["c0_n"]),
        sources=sources,
    )


_LENGTHS = ("ball", "pitch", "bore", "outside", "width")

catalogue: Catalogue = Catalogue()
"""Some sixty common bearings, and those of public data sets."""
