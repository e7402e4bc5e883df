"""Sources of the catalogue's numbers, by the words in its table."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Sources:
    """Sources of the numbers of a bearing.

    Attributes
    ----------
    balls, pitch_diameter, boundary, conformity, ratings : str
        A sentence each: on number and diameter of the balls; the pitch diameter; bore, outside diameter and width;
        the radii of the grooves; the load ratings.
    """

    balls: str
    pitch_diameter: str
    boundary: str
    conformity: str
    ratings: str


BOUNDARY = "ISO 15, of thrust bearings ISO 104, as in the makers' tables"
"""Bore, outside diameter and width."""

CONFORMITY = (
    "assumed: the largest that ISO 76 rates, 0.52 inside and 0.53 outside; makers do not publish it"
)
"""Groove radii."""

UNLIKE = "; another set than SKF's, whose printed ratings are not those of these balls"
"""Remark on balls of a maker other than SKF, with whose ratings they do not agree."""

SOURCES = {
    "f0": "estimated: the standard balls that have the printed f₀, C₀ = f₀ Z D² cos α, and C by ISO 281",
    "ratings": "estimated: the standard balls that have the printed ratings by ISO 76 and ISO 281",
    "rough": "estimated: the standard balls whose ratings come nearest to the printed ones, to 3 %",
    "unlike_skf": UNLIKE,
    "mean": "estimated: the mean of bore and outside diameter; 0 to 1 % more in real bearings",
    "nsk": "NSK rolling bearing tables",
    "nsk_precision": "NSK super-precision tables",
    "skf": "SKF rolling bearing tables",
    "cwru": "Case Western Reserve University bearing data, drive end (SKF 6205-2RS JEM)",
    "paderborn": "Paderborn University KAt data (its 6203; CWRU's fan end gives 6.746 on 28.5 mm)",
    "pronostia": "FEMTO-ST PRONOSTIA data (NSK 6804)",
    "xjtu": "XJTU-SY data (LDK UER204)",
    "spectraquest": "SpectraQuest, with the Ottawa data: 0.3125 inch on 1.516 inch (others print 39.3 mm)",
    "size205": "assumed: as of a 6205, whose balls it has",
    "harris": "T. A. Harris, Rolling Bearing Analysis, the 218 angular contact bearing",
}
"""Sentence, or the end of one, by the words in ``bearings.csv``."""
