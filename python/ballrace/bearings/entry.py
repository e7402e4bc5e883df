"""A bearing by the numbers of a catalogue."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from ..frequencies import kinematic
from .sources import Sources

Kind: TypeAlias = Literal["deep_groove", "angular_contact", "double_row", "thrust"]
"""Kind of a bearing; a ``double_row`` one has angular contact, back to back."""


@dataclass(frozen=True, kw_only=True)
class Uncertainty:
    """Error of an estimated bearing: nine of ten real ones are closer, in each number separately.

    Attributes
    ----------
    ball_count : int
        Of the number of balls.
    ball_diameter, pitch_diameter : float
        Of the diameters [m].
    orders : Orders
        Of the kinematic orders.
    """

    ball_count: int
    ball_diameter: float
    pitch_diameter: float
    orders: kinematic.Orders


@dataclass(frozen=True, kw_only=True)
class Bearing:
    """A bearing of the catalogue, or a user's own.

    Attributes
    ----------
    designation : str
        Its name, without maker, seals and clearance.
    kind : {"deep_groove", "angular_contact", "double_row", "thrust"}
        Kind. Two rows are alike, of ``ball_count`` balls each.
    ball_count : int
        Number of balls of a row.
    ball_diameter, pitch_diameter : float
        Diameters [m].
    bore, outside_diameter, width : float
        Boundary dimensions; the width is that of the outer ring, of a thrust bearing the height [m].
    contact_angle : float
        Nominal contact angle [rad].
    outer_conformity, inner_conformity : float
        Groove radius over ball diameter.
    dynamic_rating, static_rating : float
        Basic load ratings C of ISO 281 and C₀ of ISO 76 of the whole bearing [N]; of thrust bearings axial ones.
    sources : Sources
        Where the numbers come from. What is not published begins with ``estimated`` or ``assumed``.
    f0 : float or None
        The factor f₀ that the maker prints, C₀ = f₀ Z D² cos α with D in mm [N/mm²]; None: none.
    uncertainty : Uncertainty or None
        Of a bearing by :meth:`from_dimensions`; None: of the catalogue, or a user's own.
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
    f0: float | None = None
    uncertainty: Uncertainty | None = None

    @property
    def row_count(self) -> int:
        """Number of rows of balls."""
        return 2 if self.kind == "double_row" else 1

    @property
    def orders(self) -> kinematic.Orders:
        """Kinematic orders at the nominal contact angle."""
        return kinematic.orders(
            self.ball_count, self.ball_diameter, self.pitch_diameter, self.contact_angle
        )

    @classmethod
    def from_dimensions(
        cls,
        d: float,
        D: float,
        B: float,
        *,
        kind: Kind = "deep_groove",
        contact_angle: float | None = None,
    ) -> Bearing:
        """Return an estimate of a bearing that is known by its boundary dimensions alone.

        A standard ball near 0.3 (D - d), of a narrow single row near 0.71 B; as many balls as go in between rings
        that are put together eccentrically, over 187° of the pitch circle, or with angular contact over 0.80 of
        the circle, from 27.5° on 0.86; the pitch circle half-way between bore and outside diameter.

        It finds the number of balls of every second bearing of the catalogue, and of 97 in a hundred to within one
        ball. What orders may be off by is ``uncertainty.orders``: count the balls where you can, and
        ``dataclasses.replace`` them.

        Parameters
        ----------
        d, D, B : float
            Bore, outside diameter and width [m].
        kind : {"deep_groove", "angular_contact", "double_row"}
            Kind.
        contact_angle : float, optional
            Contact angle [rad]: required for angular contact, as a rule 0.698 (40°), 0.524 (30°), 0.436 (25°) or
            0.262 (15°); by default 0.436 of a double row, and 0 of a deep groove bearing.

        Returns
        -------
        Bearing
            With ``uncertainty`` and with ratings by ISO 281 and ISO 76 from the estimated balls.

        Raises
        ------
        SceneError
            A number is not usable.

        Examples
        --------
        >>> import ballrace as br
        >>> made = br.Bearing.from_dimensions(80e-3, 170e-3, 39e-3)
        >>> made.ball_count, round(1e3 * made.ball_diameter, 2)  # as of a 6316: 8 of 28.58
        (8, 26.99)
        >>> round(made.orders.bpfo, 2), round(made.uncertainty.orders.bpfo, 2)
        (3.14, 0.53)
        >>> round(br.catalogue["6316"].orders.bpfo, 2)
        3.09
        >>> scene = br.bearing(made, radial_load=3000.0, speed_rpm=1800.0)
        """
        from .estimate import estimated

        return estimated(d, D, B, kind, contact_angle)
