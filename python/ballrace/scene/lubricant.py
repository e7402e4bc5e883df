"""The oil between balls and races.

Film, film damping, traction and rolling resistance follow from it, each of which may be left out;
see ``docs/lubrication.md``.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Literal

from .. import _core
from .._base.document import INSTEAD, Part, encode
from .._base.numbers import finite
from ..errors import SceneError

__all__ = ["BaseOil", "Lubricant", "NamedOil", "OilLayer", "OilProperties"]

BaseOil = Literal["mineral", "naphthenic", "pao", "pag", "ester"]
"""Kind of base oil: pressure-viscosity and limiting shear stress follow from it where they are not given."""

OilLayer = float | Literal["flooded"]
"""Free oil in front of a contact: its thickness [m], or as much as the film asks for."""

_ZERO_CELSIUS = 273.15
"""0 °C [K]."""


@dataclass(frozen=True, kw_only=True)
class Lubricant(Part):
    """An oil at its temperature, how much of it there is, and which of its effects are computed.

    Its traction replaces the scene's friction law in the contacts of balls and races, unless ``traction`` is
    False. For a grease give its base oil, with the layer of it that the balls leave on the track.

    Attributes
    ----------
    oil : str or None
        Named oil, one of :func:`ballrace.lubricants`; None: the viscosities are given.
    viscosity_40, viscosity_100 : float or None
        Kinematic viscosity at 40 °C and at 100 °C [m²/s], 1e-6 times that in cSt; None: that of the named oil.
    density_15 : float or None
        Density at 15 °C [kg/m³]; None: that of the named oil, or 880.
    temperature : float
        Temperature of the oil where it enters the contacts [K], 233 to 473; constant during a run.
    base : BaseOil or None
        Kind of base oil; None: that of the named oil, or mineral. An ester must have ``pressure_viscosity`` and
        ``limiting_stress`` given.
    pressure_viscosity : float or None
        Pressure-viscosity coefficient α [1/Pa]; None: by viscosity and base (Gold et al. 2001).
    limiting_stress : float or None
        Limiting shear stress over pressure, the traction coefficient at large slip [1], between 0 and 0.5; None:
        by base.
    boundary_friction : float
        Coefficient of friction where asperities touch [1], between 0 and 0.5.
    conductivity : float
        Thermal conductivity [W/(m K)].
    roughness : float
        Root mean square roughness of both surfaces together [m].
    oil_layer : OilLayer
        Free oil in front of a contact [m], which bounds its film; ``"flooded"``: as much as the film needs.
    hysteresis : float
        Share of the elastic work that the rolled-over steel loses [1].
    slip_floor : float
        Lower bound of the slip speed over which traction rises, numerical [m/s]; larger values make runs faster
        and torque smaller.
    damping_frequency : float or None
        Frequency at which the film's damping is taken [Hz]; None: the contacts' own.
    reference_speed : float or None
        Relative speed of the rings for which films are computed [rad/s]; None: the largest that is given.
    reference_load : float or None
        Contact load for which films are computed [N]; None: that of the equilibrium.
    fill : float
        Volume share of oil in the space through which balls move, for their drag [1], 0 to 1; 0: no drag.
    film, damping, traction, rolling : bool
        Whether the film separates the surfaces, damps their approach, replaces dry friction by its traction, and
        resists rolling.

    Examples
    --------
    >>> from ballrace.scene import Lubricant
    >>> oil = Lubricant.named("vg68", temperature_c=55.0)
    >>> oil.oil, oil.temperature
    ('vg68', 328.15)
    >>> sheet = Lubricant(viscosity_40=46e-6, viscosity_100=6.8e-6, temperature=343.15, oil_layer="flooded")
    """

    oil: str | None = None
    viscosity_40: float | None = None
    viscosity_100: float | None = None
    density_15: float | None = None
    temperature: float = field(
        metadata={
            INSTEAD: ("temperature_c", "Temperature of the oil [°C], in place of that in kelvin.")
        }
    )
    base: BaseOil | None = None
    pressure_viscosity: float | None = None
    limiting_stress: float | None = None
    boundary_friction: float = 0.12
    conductivity: float = 0.134
    roughness: float = 1e-7
    oil_layer: OilLayer = 1e-5
    hysteresis: float = 0.007
    slip_floor: float = 5e-4
    damping_frequency: float | None = None
    reference_speed: float | None = None
    reference_load: float | None = None
    fill: float = 0.0
    film: bool = True
    damping: bool = True
    traction: bool = True
    rolling: bool = True

    @classmethod
    def named(cls, oil: str, *, temperature_c: float) -> Lubricant:
        """Return a named oil at a temperature, all else by default.

        Parameters
        ----------
        oil : str
            One of the names in :func:`ballrace.lubricants`, such as ``"vg68"``.
        temperature_c : float
            Temperature of the oil where it enters the contacts [°C], -40 to 200.

        Raises
        ------
        SceneError
            An argument is not a name or a temperature. Whether the name is known and the temperature lies in its
            range is checked with the scene.
        """
        if not isinstance(oil, str):
            raise SceneError("oil", repr(oil), "a named oil, as ballrace.lubricants() lists them")
        return cls(
            oil=oil, temperature=finite("temperature_c", temperature_c, "°C") + _ZERO_CELSIUS
        )

    def properties(self) -> OilProperties:
        """Return the numbers of the oil at its temperature, with where they come from.

        Raises
        ------
        SceneError
            A field is not usable.
        """
        found = json.loads(_core.oil(json.dumps(encode(self, "lubricant"))))
        numbers = [each.name for each in fields(OilProperties) if each.name != "sources"]
        return OilProperties(
            **{name: found[name]["value"] for name in numbers},
            sources={name: found[name]["source"] for name in numbers},
        )


@dataclass(frozen=True, kw_only=True)
class OilProperties:
    """Properties of an oil at its temperature and at the pressure of the surroundings.

    Attributes
    ----------
    kinematic_viscosity : float
        Kinematic viscosity ν [m²/s], by ASTM D341.
    density : float
        Density ρ [kg/m³].
    viscosity : float
        Dynamic viscosity η [Pa s].
    temperature_viscosity : float
        Temperature-viscosity coefficient β = -d ln ν/dT [1/K].
    pressure_viscosity : float
        Pressure-viscosity coefficient α [1/Pa].
    limiting_stress : float
        Limiting shear stress over pressure Λ.
    sources : mapping of str to str
        Where each of them comes from: given, the named oil, a formula, the base oil.
    """

    kinematic_viscosity: float
    density: float
    viscosity: float
    temperature_viscosity: float
    pressure_viscosity: float
    limiting_stress: float
    sources: Mapping[str, str]


@dataclass(frozen=True, kw_only=True)
class NamedOil:
    """An oil that a scene may name.

    Attributes
    ----------
    name : str
        Its name.
    viscosity_40, viscosity_100 : float
        Kinematic viscosity at 40 °C and at 100 °C [m²/s].
    density_15 : float
        Density at 15 °C [kg/m³].
    base : BaseOil
        Kind of base oil.
    source : str
        Where the numbers come from.
    """

    name: str
    viscosity_40: float
    viscosity_100: float
    density_15: float
    base: BaseOil
    source: str


def lubricants() -> tuple[NamedOil, ...]:
    """Return the oils that a scene may name, with their numbers and sources.

    Examples
    --------
    >>> import ballrace as br
    >>> [oil.name for oil in br.lubricants()]
    ['vg32', 'vg68', 'vg100', 'vg220', 'fva3']
    """
    return tuple(NamedOil(**oil) for oil in json.loads(_core.named_oils()))


def chosen(lubricant: str | Lubricant | None, temperature_c: float | None) -> Lubricant | None:
    """Return the lubricant given by the two arguments of a function.

    Raises
    ------
    SceneError
        A name without a temperature, a temperature without a name, or an argument of another type.
    """
    if isinstance(lubricant, str):
        if temperature_c is None:
            allowed = f"the temperature of the oil [°C], which {lubricant} must have"
            raise SceneError("temperature_c", "None", allowed)
        return Lubricant.named(lubricant, temperature_c=temperature_c)
    if not (lubricant is None or isinstance(lubricant, Lubricant)):
        raise SceneError(
            "lubricant",
            repr(lubricant),
            "the name of an oil (ballrace.lubricants() lists them), a Lubricant, or None",
        )
    if temperature_c is not None:
        has = "there is no lubricant" if lubricant is None else "a Lubricant has its own"
        raise SceneError("temperature_c", repr(temperature_c), f"absent, since {has}")
    return lubricant
