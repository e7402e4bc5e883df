"""Recipe of simulated training data: ranges of operation, faults, surfaces and scatter."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Literal, get_args

from .._base.numbers import real
from ..bearings import Bearing, catalogue
from ..bearings.build import asked_clearance
from ..bearings.clearance import clearance_limits
from ..errors import SceneError

if TYPE_CHECKING:
    from ..scene import Surface

Fault = Literal["outer", "inner", "ball"]
"""Place of a fault."""

Range = float | tuple[float, float]
"""A number, or the lowest and the highest of those that are drawn."""

SURFACES: dict[str, Surface] = {"outer": "outer_race", "inner": "inner_race", "ball": "ball"}
"""Names in scenes, verdicts and labels."""

LARGEST_SLIP = 0.02
"""Scatter that balls of 1.4 µm of scatter make in 0.7 mm of play: none that are sold are that unlike."""

GRADES = (1.0, 16.0)
"""Balance quality grades, from grinding machines to shafts of cars [mm/s] (ISO 21940-11)."""

_Surfaces = Literal["as_made", "smooth"]

_FAULTS = {"outer": (0.15, 3.0), "inner": (0.15, 3.0), "ball": (0.2, 2.0)}


@dataclass(frozen=True)
class Recipe:
    """Ranges from which each simulated bearing of a training set is drawn.

    A range is a pair of numbers, between which each case draws its own, uniformly; fault sizes, slip and balance
    grade on a logarithmic scale; one number is the same for all. The guide gives the sources of the defaults and
    the fixed ranges (`From a campaign to a trained model`).

    Attributes
    ----------
    bearing : str or Bearing
        Deep groove bearing of one row, by its designation or as :class:`ballrace.Bearing`.
    speed_rpm : float or pair of float
        Speed of the inner ring, 10 to 100 000 [1/min].
    radial_load : float or pair of float, optional
        Load that presses the inner ring down, above 0 [N]; by default 0.012 to 0.1 of the static rating.
    axial_load : float or pair of float, optional
        Load along the axis, of either sign [N]; by default up to a fifth of the largest radial load either way.
    clearance : {"scatter", "C2", "CN", "C3", "C4", "C5"} or float
        ``"scatter"``: uniform from 0 to the largest of the class in the designation (else CN), since fits and heat
        reduce it; or one clearance for all, as of :func:`ballrace.bearing`.
    faults : mapping of {"outer", "inner", "ball"} to pair of float
        Smallest and largest size of the faults of each kind, the extent along rolling [mm]: a pit where it is
        smaller than its contact, else a spall (on a ball a cap). A kind that is left out is no class.
    surfaces : {"as_made", "smooth"}
        ``"as_made"``: races and balls have a texture (:class:`ballrace.scene.Texture`), of 0.2 to 5 nm at order 30
        with a slope of 1.5 to 2.5.
    slip : float, pair of float or None
        Scatter of the balls' spacing: standard deviation of the times between impacts of a fault on the outer
        race, over their mean, up to 0.02. It is produced by balls of different diameters in a cage with play: for
        5e-3 in a 6205, a standard deviation of 0.36 µm, less than that of balls of grade 10 (ISO 3290-1), and a
        play of 0.08 to 0.2 mm. Record 130 has 7e-3; R. B. Randall and J. Antoni give 0.01 to 0.02
        (Mech. Syst. Signal Process. 25 (2011) 485): beyond 6e-3 unequal balls stand for all that makes times
        uneven. None: equal balls in the scene's cage.
    balance_grade : float, pair of float or None
        Balance quality grade of the rotor, 0.01 to 1000 [mm/s]: its unbalance, as of a mass as heavy as the radial
        load, turns with the inner ring (ISO 21940-11: grinding machines 1, pumps and fans 6.3, shafts of cars 16),
        with at most two thirds of that load. None: balanced.

    Raises
    ------
    SceneError
        A field is not usable; it names the field, such as ``faults.outer``.

    Examples
    --------
    >>> made = Recipe("6205", speed_rpm=(1700, 1800), faults={"outer": (0.15, 3.0)})
    >>> made.classes
    ('healthy', 'outer_race')
    """

    bearing: str | Bearing
    _: KW_ONLY
    speed_rpm: Range = 1800.0
    radial_load: Range | None = None
    axial_load: Range | None = None
    clearance: str | float = "scatter"
    faults: Mapping[str, tuple[float, float]] = field(default_factory=_FAULTS.copy)
    surfaces: _Surfaces = "as_made"
    slip: Range | None = (5e-3, 2e-2)
    balance_grade: Range | None = GRADES

    def __post_init__(self) -> None:
        made = self.made
        if made.kind != "deep_groove":
            raise SceneError("bearing", repr(made.designation), "a deep groove bearing of one row")
        _checked("speed_rpm", self.speed_rpm, 10.0, 1e5, "1/min")
        _checked("radial_load", self.radial, 1e-3, made.static_rating, "N")
        _checked("axial_load", self.axial, -made.static_rating, made.static_rating, "N")
        if self.slip is not None:
            _checked("slip", self.slip, 1e-5, LARGEST_SLIP, "1")
        if self.balance_grade is not None:
            _checked("balance_grade", self.balance_grade, 0.01, 1000.0, "mm/s")
        if self.surfaces not in get_args(_Surfaces):
            raise SceneError("surfaces", repr(self.surfaces), '"as_made" or "smooth"')
        self._check_clearance()
        self._check_faults()

    @cached_property
    def made(self) -> Bearing:
        """The bearing of the catalogue."""
        return self.bearing if isinstance(self.bearing, Bearing) else catalogue[self.bearing]

    @property
    def classes(self) -> tuple[str, ...]:
        """Names of the classes: ``healthy``, and surfaces as verdicts name them."""
        return ("healthy", *(SURFACES[kind] for kind in self.faults))

    @property
    def speed(self) -> tuple[float, float]:
        """Lowest and highest speed [1/min]."""
        return ends_of(self.speed_rpm)

    @property
    def radial(self) -> tuple[float, float]:
        """Lowest and highest radial load [N]."""
        rating = self.made.static_rating
        return (
            (0.012 * rating, 0.1 * rating)
            if self.radial_load is None
            else ends_of(self.radial_load)
        )

    @property
    def axial(self) -> tuple[float, float]:
        """Lowest and highest axial load [N]."""
        most = 0.2 * self.radial[1]
        return (-most, most) if self.axial_load is None else ends_of(self.axial_load)

    @cached_property
    def clearances(self) -> tuple[float, float] | None:
        """Lowest and highest clearance [m]; None where all have the same."""
        if self.clearance != "scatter":
            return None
        asked = str(asked_clearance(self.bearing, self.made))
        return 0.0, clearance_limits(self.made.bore, asked)[1]

    def _check_clearance(self) -> None:
        if self.clearance != "scatter":
            from ..bearings import bearing

            bearing(self.bearing, speed_rpm=1800.0, clearance=self.clearance)

    def _check_faults(self) -> None:
        if not isinstance(self.faults, Mapping) or not self.faults:
            raise SceneError("faults", repr(self.faults), "sizes [mm] by outer, inner and ball")
        for kind, sizes in self.faults.items():
            if kind not in SURFACES:
                raise SceneError(f"faults.{kind}", repr(sizes), "faults of outer, inner and ball")
            _checked(f"faults.{kind}", sizes, 1e-3, 500.0 * self.made.ball_diameter, "mm")


def ends_of(given: Range) -> tuple[float, float]:
    """Return the ends of a range; NaN where it is none."""
    low, high = given if isinstance(given, tuple | list) and len(given) == 2 else (given, given)
    return real(low), real(high)


def _checked(name: str, given: Range, least: float, most: float, unit: str) -> None:
    low, high = ends_of(given)
    if not least <= low <= high <= most:
        allowed = f"a number, or two that rise, {least:g} to {most:g} [{unit}]"
        raise SceneError(name, repr(given), allowed)
