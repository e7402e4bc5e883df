"""The catalogue."""

from __future__ import annotations

import csv
import math
import warnings
from collections.abc import Iterator, Mapping
from functools import cached_property
from importlib import resources
from typing import cast, get_args

from .._base.libraries import pl
from ..errors import SceneError, SceneWarning
from .entry import Bearing, Kind
from .names import Name, near, read, without_maker
from .refused import why_not
from .sources import BOUNDARY, CONFORMITY, SOURCES, UNLIKE, Sources


class Catalogue(Mapping[str, Bearing]):
    """The bearings by their designations; ``ballrace.catalogue`` is the one that there is.

    A name may be that on a box, with its maker, seals, cage, clearance, tolerance and grease, such as ``SKF
    6205-2RSH/C3``: :meth:`read` takes it apart. They are not part of the row that it finds;
    :func:`ballrace.bearing` takes the clearance from them. A :class:`ballrace.SceneWarning` reports marks that are
    not known, or that change the balls.

    Examples
    --------
    >>> import ballrace as br
    >>> found = br.catalogue["6205-2RS"]
    >>> found.ball_count, found.sources.balls
    (9, 'Case Western Reserve University bearing data, drive end (SKF 6205-2RS JEM)')
    >>> [b.designation for b in br.catalogue.find(kind="angular_contact", bore=25e-3, outside_diameter=52e-3)]
    ['7205A', '7205A5', '7205B', '7205C']
    """

    @cached_property
    def _rows(self) -> dict[str, Bearing]:
        text = resources.files(__package__).joinpath("bearings.csv").read_text(encoding="utf-8")
        rows = map(_bearing, csv.DictReader(text.splitlines()))
        return {row.designation: row for row in rows}

    def __getitem__(self, name: str) -> Bearing:
        found = self.read(name)
        row = self._rows[found.designation]
        for text in _doubtful(found, row):
            warnings.warn(f"designation = {name!r}: {text}", SceneWarning, stacklevel=2)
        return row

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and read(name, self._rows) is not None

    def read(self, name: str) -> Name:
        """Return what a name says: maker, designation, marks with their meanings, and marks that are not known.

        Raises
        ------
        SceneError
            It names no bearing of the catalogue; the message says why, or suggests similar ones.

        Examples
        --------
        >>> import ballrace as br
        >>> found = br.catalogue.read("FAG 6205-C-2HRS-C3")
        >>> found.maker, found.designation, found.clearance, found.meanings["2HRS"]
        ('FAG', '6205', 'C3', 'contact seals on both sides')
        """
        found = read(name, self._rows) if isinstance(name, str) else None
        if found is None:
            raise UnknownBearingError("designation", repr(name), self._allowed(str(name)))
        return found

    def _allowed(self, name: str) -> str:
        reason = why_not(without_maker(name)[1])
        if reason is not None:
            return reason
        alike = near(name, self._rows)
        hint = f"near are {', '.join(alike)}" if alike else f"it has {len(self)}, from 6000 on"
        return f"a bearing of ballrace.catalogue; {hint}; br.Bearing.from_dimensions makes one of any size"

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
        rows = []
        for row in self._rows.values():
            plain = {k: v for k, v in vars(row).items() if k != "sources"}
            rows.append(plain | {f"source_{k}": v for k, v in vars(row.sources).items()})
        return pl.DataFrame(rows)


class UnknownBearingError(SceneError, KeyError):
    """Error: no bearing of the catalogue has this name; a ``KeyError`` too, so that ``in`` and ``get`` work."""


def _doubtful(found: Name, row: Bearing) -> Iterator[str]:
    """Return what keeps the row from being that bearing."""
    balls = f"{row.ball_count} balls of {1e3 * row.ball_diameter:g} mm"
    if found.unknown:
        known = f"not known, and ignored; taken as {row.designation}"
        yield f"{', '.join(found.unknown)}: {known}"
    for mark, meaning in found.effects.items():
        yield f"{mark}, {meaning}: taken as {row.designation}, {balls} of steel"
    if found.maker == "SKF" and row.sources.balls.endswith(UNLIKE):
        yield f"SKF prints other ratings than the maker of these {balls}, so its own differ"


def _is(value: float, wanted: float | None) -> bool:
    return wanted is None or math.isclose(value, wanted, rel_tol=1e-6)


def _bearing(line: dict[str, str]) -> Bearing:
    """Return the bearing of a line of the table, which has millimetres, degrees and newtons."""
    mm = {name: round(1e-3 * float(line[f"{name}_mm"]), 9) for name in _LENGTHS}
    sources = Sources(
        balls="".join(SOURCES[word] for word in line["from_balls"].split()),
        pitch_diameter=SOURCES[line["from_pitch"]],
        boundary=BOUNDARY,
        conformity=CONFORMITY,
        ratings=SOURCES[line["from_ratings"]],
    )
    return Bearing(
        designation=line["designation"],
        kind=cast("Kind", line["kind"]),
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
        f0=float(line["f0"]) if line["f0"] else None,
    )


_LENGTHS = ("ball", "pitch", "bore", "outside", "width")

catalogue: Catalogue = Catalogue()
"""Deep groove, angular contact and thrust ball bearings of 5 to 120 mm bore, and those of public data sets."""
