"""What a user says: the scene, frozen dataclasses in SI units.

Every class mirrors one of the same document that the TOML files hold. Objects are checked as a whole when
they are used (or by :meth:`Scene.validate`); an error names the path of the field, its value and what is
allowed there. Nothing here changes in place: make variants of a scene with :meth:`Scene.replace` or
:func:`dataclasses.replace`.

Where a field may be one of several things, its type says so: ``friction="none"`` or
``friction=Coulomb(coefficient=0.05, slip_speed=0.1)``.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal

from . import _core
from ._document import Part, Variant, decode, encode
from .errors import SceneError

__all__ = [
    "AccurateSlices",
    "Approximations",
    "AxialOffset",
    "Cage",
    "CageProbe",
    "Component",
    "Contact",
    "ContactQuantity",
    "ContactsProbe",
    "Coulomb",
    "Defect",
    "Drive",
    "EnergyProbe",
    "FittedSlices",
    "FixedSlices",
    "Floor",
    "ForcesProbe",
    "Friction",
    "Iso16281",
    "Load",
    "Material",
    "Materials",
    "Method",
    "MotionProbe",
    "Mount",
    "NormalLaw",
    "Probe",
    "Ramp",
    "Ring",
    "RingName",
    "Row",
    "Scene",
    "Sine",
    "Slices",
    "SlicesProbe",
    "Solver",
    "SpeedDrive",
    "Spring",
    "Stribeck",
    "Support",
    "Surface",
    "Table",
    "TimeFunction",
    "TorqueDrive",
    "TorqueProbe",
    "Traction",
    "Unbalance",
    "Waviness",
    "Width",
    "WidthProfile",
]

RingName = Literal["outer", "inner"]
"""Which ring."""

Surface = Literal["outer_race", "inner_race", "ball"]
"""The surface that carries a defect."""

Component = Literal["x", "y", "z", "theta", "vx", "vy", "vz", "omega", "ax", "ay", "az", "alpha"]
"""One component of a motion: position [m], angle [rad], their rates and the rates of those."""

ContactQuantity = Literal["load", "angle", "zone_centre", "zone_width", "slip"]
"""One quantity of a contact: load [N], angle [rad], middle and extent of the zone [m], slip speed [m/s]."""


# Values in time


@dataclass(frozen=True, kw_only=True)
class Ramp(Variant, tag="ramp"):
    """Linear from one value to another, constant before and after; a jump when ``start == end``.

    Attributes
    ----------
    from_, to : float
        Value before ``start`` and from ``end`` on. In documents and paths the first is named ``from``.
    start, end : float
        Times at which the change begins and is over [s].
    """

    from_: float
    to: float
    start: float
    end: float


@dataclass(frozen=True, kw_only=True)
class Sine(Variant, tag="sine"):
    """``mean + amplitude * sin(2 pi frequency t + phase)``.

    Attributes
    ----------
    mean, amplitude : float
        Mean value and amplitude.
    frequency : float
        Frequency [Hz].
    phase : float
        Phase at t = 0 [rad].
    """

    mean: float
    amplitude: float
    frequency: float
    phase: float


@dataclass(frozen=True, kw_only=True)
class Table(Variant, tag="table"):
    """Linear between points, constant beyond them; two equal times make a jump.

    Attributes
    ----------
    times : tuple of float
        Times, not decreasing [s].
    values : tuple of float
        A value a time.
    """

    times: tuple[float, ...]
    values: tuple[float, ...]


TimeFunction = float | Ramp | Sine | Table
"""A value that may change in time; a plain number is constant."""


# Rows, rings and how they are held


@dataclass(frozen=True, kw_only=True)
class Waviness(Part):
    """One harmonic of a race's radius, ``amplitude * cos(order * phi + phase)``, phi from the ring's x axis.

    Attributes
    ----------
    order : int
        Waves around the circumference, 1 to 1000.
    amplitude : float
        Amplitude of the radius [m].
    phase : float
        Phase [rad].
    """

    order: int
    amplitude: float
    phase: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Spring(Variant, tag="spring"):
    """A spring and a damper to the inertial frame, relaxed at the body's nominal place.

    Attributes
    ----------
    stiffness : float
        Stiffness [N/m], about z [N m/rad].
    damping : float
        Damping [N s/m], about z [N m s/rad].
    """

    stiffness: float = 0.0
    damping: float = 0.0


Mount = Literal["free", "fixed"] | Spring
"""One direction of a support."""


@dataclass(frozen=True, kw_only=True)
class Support(Part):
    """How a body hangs on the inertial frame, a direction each.

    An absent direction is fixed for the outer ring, free for the inner ring and the balls.

    Attributes
    ----------
    x, y, z : Mount or None
        Along the axes.
    theta : Mount or None
        About z. Absent for the inner ring when a given speed drives it.
    """

    x: Mount | None = None
    y: Mount | None = None
    z: Mount | None = None
    theta: Mount | None = None


@dataclass(frozen=True, kw_only=True)
class Row(Part):
    """One row of balls between two grooves.

    Attributes
    ----------
    ball_count : int
        Number of balls, 1 to 1000.
    ball_diameter : float
        Ball diameter D [m].
    pitch_diameter : float
        Pitch diameter [m].
    outer_conformity, inner_conformity : float
        Groove radius over ball diameter, above 0.5 and at most 1.
    contact_angle : float
        Nominal contact angle at zero clearance [rad], 0 to 80°.
    side : int
        Sign of the axial part of the direction from ball to outer contact, +1 or -1.
    axial_position : float
        Axial place of the row [m].
    clearance : float
        Diametral clearance [m]; negative: interference.
    axial_preload : float
        Axial preload [m]; negative: an axial gap.
    start_angle : float
        Start angle of ball 0, counter-clockwise from +x [rad].
    outer_shoulders, inner_shoulders : tuple of two floats, or None
        Shoulder angles towards -z and +z, from the groove's centre [rad]; None: no shoulders.
    outer_waviness, inner_waviness : tuple of Waviness
        Waviness of the races; turns with the rings.
    diameter_errors : tuple of float
        Diameter error of each ball [m]; empty: none.
    ball_mass : float or None
        Mass of a ball [kg]; None: from density and diameter.
    ball_inertia : float or None
        Moment of inertia of a ball about z [kg m²]; None: 2/5 m R².
    ball_support : Support
        How every ball of the row hangs on the inertial frame; by default free.
    ball_material : Material or None
        Material of the row's balls; None: the scene's ``materials.balls``.
    contact : Contact or None
        How the row's balls meet their races, in place of the whole of the scene's ``contact``; None: as there.
    friction : Friction or None
        Friction of the row's balls and races, ``"none"`` for none; None: that of the scene.
    """

    ball_count: int
    ball_diameter: float
    pitch_diameter: float
    outer_conformity: float
    inner_conformity: float
    contact_angle: float = 0.0
    side: int = 1
    axial_position: float = 0.0
    clearance: float = 0.0
    axial_preload: float = 0.0
    start_angle: float = 0.0
    outer_shoulders: tuple[float, float] | None = None
    inner_shoulders: tuple[float, float] | None = None
    outer_waviness: tuple[Waviness, ...] = ()
    inner_waviness: tuple[Waviness, ...] = ()
    diameter_errors: tuple[float, ...] = ()
    ball_mass: float | None = None
    ball_inertia: float | None = None
    ball_support: Support = Support()
    ball_material: Material | None = None
    contact: Contact | None = None
    friction: Friction | None = None


@dataclass(frozen=True, kw_only=True)
class Ring(Part):
    """A ring: its mass and how it is held.

    Attributes
    ----------
    mass : float or None
        Mass, with what turns or moves with the ring [kg]; None: from ``diameter``, ``width`` and density.
    inertia : float or None
        Moment of inertia about z [kg m²]; None: from ``diameter``, ``width`` and density, or of a thin
        ring of ``mass`` at the pitch radius.
    diameter : float or None
        Boundary diameter [m]: outside diameter of the outer ring, bore of the inner.
    width : float or None
        Axial width [m].
    support : Support
        How the ring hangs on the inertial frame.
    """

    mass: float | None = None
    inertia: float | None = None
    diameter: float | None = None
    width: float | None = None
    support: Support = Support()


@dataclass(frozen=True, kw_only=True)
class Material(Part):
    """A linear elastic, isotropic material; the default is bearing steel.

    Attributes
    ----------
    density : float
        Density [kg/m³].
    youngs_modulus : float
        Young's modulus [Pa]; used by the Hertz law.
    poisson_ratio : float
        Poisson's ratio.
    """

    density: float = 7850.0
    youngs_modulus: float = 206e9
    poisson_ratio: float = 0.3


@dataclass(frozen=True, kw_only=True)
class Materials(Part):
    """Materials of the parts.

    Attributes
    ----------
    rings, balls : Material
        Of both rings, and of the balls.
    """

    rings: Material = Material()
    balls: Material = Material()


# Contact, friction, cage


@dataclass(frozen=True, kw_only=True)
class Iso16281(Variant, tag="iso16281"):
    """The paper's law, after the roller slices of ISO/TS 16281: the sum of ``c s^(10/9)`` over the slices.

    With the paper's constants it gives way about three times as far as Hertz; :func:`ballrace.explain` tells how
    far at a scene's own load.

    Attributes
    ----------
    constant : float
        Constant of the law for lengths in metres [N/m²].
    length_ratio : float
        Equivalent length of the line contact over the ball diameter.
    """

    constant: float = 3.5948e10
    length_ratio: float = 0.5


NormalLaw = Iso16281 | Literal["hertz"]
"""Elastic force of a slice; ``"hertz"`` is Hertz's point contact cut into slices."""


@dataclass(frozen=True)
class FixedSlices(Variant, tag="fixed", wraps=True):
    """Slices of equal width over the whole ball, fixed in it: the paper's method.

    Attributes
    ----------
    count : int
        Number of slices, 10 to 100 000.
    """

    count: int


@dataclass(frozen=True)
class FittedSlices(Variant, tag="fitted", wraps=True):
    """Quadrature nodes on every smooth piece of the zone that touches.

    Attributes
    ----------
    count : int
        Nodes a piece of the zone, 2 to 64.
    """

    count: int


@dataclass(frozen=True)
class AccurateSlices(Variant, tag="accuracy", wraps=True):
    """As many fitted nodes as give normal and friction force of rolling balls to an accuracy.

    Attributes
    ----------
    accuracy : float
        Error of the force over the normal force, 1e-9 to 0.1; each race has its own number of nodes.
    """

    accuracy: float


Slices = FixedSlices | FittedSlices | AccurateSlices
"""Where a ball is cut."""


@dataclass(frozen=True, kw_only=True)
class Contact(Part):
    """How a ball meets a race.

    Attributes
    ----------
    law : NormalLaw
        Force of a slice from its penetration; Hertz's law by default.
    slices : Slices
        Where the ball is cut; 6 fitted nodes by default.
    damping : float
        Hunt-Crossley damping [s/m]: restitution is about ``1 - damping * v`` at an impact speed v.
    clamp_pull : bool
        Whether a slice that would pull is set to zero (and counted); False keeps the paper's bare sum.
    """

    law: NormalLaw = "hertz"
    slices: Slices = FittedSlices(6)
    damping: float = 0.2
    clamp_pull: bool = True


@dataclass(frozen=True, kw_only=True)
class Coulomb(Variant, tag="coulomb"):
    """Friction with a constant coefficient.

    Attributes
    ----------
    coefficient : float
        Coefficient.
    slip_speed : float
        Slip speed below which friction fades [m/s].
    """

    coefficient: float
    slip_speed: float


@dataclass(frozen=True, kw_only=True)
class Stribeck(Variant, tag="stribeck"):
    """Friction that falls from a static to a kinetic coefficient, ``k + (s - k) exp(-(u / u_s)²)``.

    Attributes
    ----------
    static_coefficient, kinetic_coefficient : float
        The two coefficients, s and k.
    stribeck_speed : float
        Stribeck speed u_s [m/s].
    slip_speed : float
        Slip speed below which friction fades [m/s].
    """

    static_coefficient: float
    kinetic_coefficient: float
    stribeck_speed: float
    slip_speed: float


@dataclass(frozen=True, kw_only=True)
class Traction(Variant, tag="traction"):
    """A lubricated traction curve, ``(a + b u) exp(-c u) + d`` at a slip speed u.

    Attributes
    ----------
    a : float
        Traction at no slip, less ``d``.
    b : float
        Initial slope [s/m].
    c : float
        Decay [s/m].
    d : float
        Traction at high slip.
    slip_speed : float
        Slip speed below which friction fades [m/s].
    """

    a: float
    b: float
    c: float
    d: float
    slip_speed: float


Friction = Literal["none"] | Coulomb | Stribeck | Traction
"""Friction of a slice against its slip velocity."""


@dataclass(frozen=True, kw_only=True)
class Cage(Part):
    """Springs that keep the centres of neighbouring balls of a row at their distance.

    Attributes
    ----------
    stiffness : float
        Stiffness [N/m].
    damping : float
        Damping, while engaged [N s/m].
    play : float
        Total play [m]: free within ± half of it around the nominal distance.
    """

    stiffness: float
    damping: float = 0.0
    play: float = 0.0


# Loads and drives


@dataclass(frozen=True, kw_only=True)
class Load(Part):
    """A force on a ring's centre, in a fixed direction of the inertial frame.

    Attributes
    ----------
    ring : {"outer", "inner"}
        The loaded ring.
    direction : tuple of three floats
        Direction; its length does not matter.
    force : TimeFunction
        Force along the direction [N].
    """

    ring: RingName
    direction: tuple[float, float, float]
    force: TimeFunction


@dataclass(frozen=True, kw_only=True)
class Unbalance(Part):
    """A mass off the axis of a ring that turns with it.

    Attributes
    ----------
    ring : {"outer", "inner"}
        The unbalanced ring.
    moment : float
        Mass times eccentricity [kg m].
    angle : float
        Angular place on the ring, counter-clockwise from its own x axis [rad].
    """

    ring: RingName
    moment: float
    angle: float = 0.0


@dataclass(frozen=True)
class SpeedDrive(Variant, tag="speed", wraps=True):
    """The inner ring turns at a given speed.

    Attributes
    ----------
    speed : TimeFunction
        Speed [rad/s]; may not jump.
    """

    speed: TimeFunction


@dataclass(frozen=True, kw_only=True)
class TorqueDrive(Variant, tag="torque"):
    """A given torque about z turns the inner ring.

    Attributes
    ----------
    value : TimeFunction
        Torque [N m].
    initial_speed : float
        Speed at t = 0 [rad/s].
    """

    value: TimeFunction
    initial_speed: float = 0.0


Drive = SpeedDrive | TorqueDrive
"""What turns the inner ring."""


# Defects


@dataclass(frozen=True, kw_only=True)
class WidthProfile(Part):
    """Width given at axial places, linear between them, constant beyond.

    Attributes
    ----------
    positions : tuple of float
        Axial places from the defect's middle, increasing [m].
    widths : tuple of float
        Widths [m].
    """

    positions: tuple[float, ...]
    widths: tuple[float, ...]


Width = float | WidthProfile
"""Width of a defect along its length; a plain number is constant [m]."""

AxialOffset = float | Literal["contact"]
"""Axial place of a defect's middle: a number [m], or where the contact runs (see :class:`Defect`)."""


@dataclass(frozen=True, kw_only=True)
class Floor(Part):
    """Fault circles between the edges of a defect, their crests at a depth: a bed of bumps.

    Attributes
    ----------
    depth : float
        Depth of the crests below the surface [m].
    elements : int
        Number of circles, 1 to 1000.
    """

    depth: float
    elements: int


@dataclass(frozen=True, kw_only=True)
class Defect(Part):
    """A surface that is absent over an arc, with fault circles at its edges; it turns with its body.

    Attributes
    ----------
    on : {"outer_race", "inner_race", "ball"}
        Which surface.
    row : int
        Row, from 0.
    ball : int or None
        Ball of the row, from 0; needed for a ball defect, absent otherwise.
    angle : float
        Angular place on the body, counter-clockwise from its own x axis [rad].
    axial_offset : AxialOffset
        Axial place of the middle, from the row's plane (races) or the ball's centre [m]. ``"contact"`` places it
        where the contact runs that it is there for: the most loaded of those that meet it over a turn of the
        balls, at the static equilibrium of the healthy bearing under the largest value of every load. Of a
        defect on the outer race that is a ball's at the defect's own angle; of one on a ball, its contact with
        the race that loads it more. Without equilibrium or load it is the place of the nominal contact angle.
        A run records the number in ``out.scene`` and tells in ``out.defects`` where it comes from.
    length : float
        Axial length [m].
    width : Width
        Arc length along the surface [m].
    edge_radius : float
        Radius of the fault circles at the edges [m].
    floor : Floor or None
        Recessed circles between the edges; None: no floor.
    """

    on: Surface
    row: int = 0
    ball: int | None = None
    angle: float
    axial_offset: AxialOffset = "contact"
    length: float
    width: Width
    edge_radius: float
    floor: Floor | None = None


# Probes


@dataclass(frozen=True, kw_only=True)
class MotionProbe(Variant, tag="motion"):
    """Position, velocity and acceleration of a body: columns ``<probe>.x`` and so on, filtered.

    Attributes
    ----------
    body : str
        ``outer``, ``inner`` or a ball such as ``row0.ball3``.
    components : tuple of Component, or None
        Which of them; None: all twelve.
    """

    body: str
    components: tuple[Component, ...] | None = None


@dataclass(frozen=True, kw_only=True)
class ContactsProbe(Variant, tag="contacts"):
    """What happens between balls and races: columns ``<probe>.ball3.outer.load`` and so on, as points in time.

    Attributes
    ----------
    row : int
        Row, from 0.
    balls : tuple of int, or None
        Balls of the row; None: all.
    races : tuple of {"outer", "inner"}, or None
        Races; None: both.
    quantities : tuple of ContactQuantity, or None
        Which quantities; None: all.
    """

    row: int = 0
    balls: tuple[int, ...] | None = None
    races: tuple[RingName, ...] | None = None
    quantities: tuple[ContactQuantity, ...] | None = None


@dataclass(frozen=True, kw_only=True)
class CageProbe(Variant, tag="cage"):
    """Force of every cage link of a row, positive in tension: columns ``<probe>.link0``, … [N], filtered.

    Attributes
    ----------
    row : int
        Row, from 0.
    """

    row: int = 0


@dataclass(frozen=True, kw_only=True)
class EnergyProbe(Variant, tag="energy"):
    """Energies [J] and dissipated powers [W], as points in time."""


@dataclass(frozen=True, kw_only=True)
class TorqueProbe(Variant, tag="torque"):
    """Friction torque about z that the balls put on each ring: ``<probe>.outer``, ``<probe>.inner`` [N m].

    It is filtered, and takes an evaluation of the model at every point that the filter reads: a run of the wheel
    bearing takes a sixth longer.
    """


@dataclass(frozen=True, kw_only=True)
class ForcesProbe(Variant, tag="forces"):
    """The forces on a body by origin: ``<probe>.contact.x`` and so on [N], about z [N m], as points in time.

    Attributes
    ----------
    body : str
        ``outer``, ``inner`` or a ball such as ``row0.ball3``.
    """

    body: str


@dataclass(frozen=True, kw_only=True)
class SlicesProbe(Variant, tag="slices"):
    """Forces of the single slices of chosen contacts at chosen times; a table beside the signals.

    Attributes
    ----------
    row : int
        Row, from 0.
    balls : tuple of int, or None
        Balls of the row; None: all.
    races : tuple of {"outer", "inner"}, or None
        Races; None: both.
    times : tuple of float
        Times within the run [s].
    """

    row: int = 0
    balls: tuple[int, ...] | None = None
    races: tuple[RingName, ...] | None = None
    times: tuple[float, ...]


Probe = (
    MotionProbe | ContactsProbe | CageProbe | EnergyProbe | TorqueProbe | ForcesProbe | SlicesProbe
)
"""A named set of signals."""


# The whole

Method = Literal[
    "dormand-prince",
    "bogacki-shampine",
    "tsitouras",
    "verner",
    "runge-kutta-4",
    "velocity-verlet",
    "implicit-friction",
    "auto",
]
"""The method of integration: explicit pairs of order 5, 3, 5 and 6, two of fixed steps, the one that
is explicit in positions and implicit in velocities, and the choice of it or the first by friction's stiffness."""


@dataclass(frozen=True, kw_only=True)
class Approximations(Part):
    """Simplifications that change the answer, all off by default.

    What each costs in accuracy is measured in ``benches/README.md``; :func:`ballrace.explain` offers those that
    apply to a scene, and ``out.provenance.left_out`` tells which ones a run made use of.

    Attributes
    ----------
    rolling : bool
        Balls and cage are kinematic: every row orbits in proportion to the inner ring as it rolls at the start,
        its balls spaced as there, and moves along its radii and z only. Friction and cage are left out, of
        :meth:`Model.rhs` and :meth:`Model.forces` too, which else are those of free balls. Needs a driven speed.
    plane : bool
        Rings and balls keep their axial places from the start, the balls of a row all the same one: the plane
        model of a bearing with a contact angle, where loads along z do not change.
    one_row : bool
        Of two rows the one that carries less than 2 % of the load at the start is left out, where loads do not
        change.
    """

    rolling: bool = False
    plane: bool = False
    one_row: bool = False


@dataclass(frozen=True, kw_only=True)
class Solver(Part):
    """How the equations are integrated.

    Attributes
    ----------
    method : Method
        The method. Explicit steps shrink with the slip speed of friction; those of ``"implicit-friction"`` do
        not, and ``"auto"`` chooses. Methods of fixed steps take the largest step allowed.
    rtol : float
        Relative tolerance, 1e-12 to 1e-1; each kind of state has its scale from the scene.
    first_step : float or None
        First step [s]; None: Hairer's estimate.
    max_step : float or None
        Largest step [s]; None: no limit but the one below.
    frequency_cap : bool
        Whether the step is also kept below what the method's stability and accuracy ask for: a share of the
        period of the highest contact frequency, less for methods of low order where contacts ring undamped; for
        fixed steps also a share of the time in which friction and damping act (``provenance.step_limit``).
        Without it, loose tolerances report success with accelerations wrong by 30 % and more, and fixed steps
        longer than that are warned of.
    reduce : bool
        Whether a run leaves out what does not change the motion: directions without forces, mirror images, slices
        where a closed form says the same.
    """

    method: Method = "dormand-prince"
    rtol: float = 1e-6
    first_step: float | None = None
    max_step: float | None = None
    frequency_cap: bool = True
    reduce: bool = True


def _empty() -> MappingProxyType[str, Any]:
    return MappingProxyType({})


@dataclass(frozen=True, kw_only=True, repr=False)
class Scene(Part):
    """A whole bearing, its loads, its defects and what to record of it.

    Attributes
    ----------
    schema : int
        Version of the document, 1.
    name : str
        A title.
    rows : tuple of Row
        The rows of balls, at least one.
    outer_ring, inner_ring : Ring
        The rings.
    materials : Materials
        Materials.
    contact : Contact
        Contact of balls and races.
    friction : Friction
        Friction of balls and races.
    cage : Cage or None
        Cage; None: the balls are not linked.
    drive : Drive
        What turns the inner ring.
    gravity : tuple of three floats
        Gravity [m/s²].
    loads : mapping of str to Load
        Loads by name.
    unbalances : mapping of str to Unbalance
        Unbalances by name.
    defects : mapping of str to Defect
        Defects by name.
    probes : mapping of str to Probe
        Probes by name. None: the motion of the outer ring if it can move along x, y or z, else of the inner
        ring, in the directions that can move; where both are held, the loads of all contacts (``row0`` and so on).
    approximations : Approximations
        What is given up for speed; nothing by default.
    solver : Solver
        Options of the integrator.

    Examples
    --------
    >>> import ballrace as br
    >>> scene = br.presets.wheel_bearing(axial_load=3000.0)
    >>> scene.loads["axial"].force
    3000.0
    >>> scene.replace({"loads.axial.force": -3000.0}).loads["axial"].force
    -3000.0
    """

    schema: int = 1
    name: str = ""
    rows: tuple[Row, ...]
    outer_ring: Ring = Ring()
    inner_ring: Ring = Ring()
    materials: Materials = Materials()
    contact: Contact = Contact()
    friction: Friction = "none"
    cage: Cage | None = None
    drive: Drive
    gravity: tuple[float, float, float] = (0.0, -9.81, 0.0)
    loads: Mapping[str, Load] = field(default_factory=_empty)
    unbalances: Mapping[str, Unbalance] = field(default_factory=_empty)
    defects: Mapping[str, Defect] = field(default_factory=_empty)
    probes: Mapping[str, Probe] = field(default_factory=_empty)
    approximations: Approximations = Approximations()
    solver: Solver = Solver()

    def __repr__(self) -> str:
        balls = " + ".join(str(row.ball_count) for row in self.rows)
        named = {kind: getattr(self, kind) for kind in ("loads", "unbalances", "defects", "probes")}
        parts = [f"{balls} balls", *(f"{kind}: {', '.join(v)}" for kind, v in named.items() if v)]
        return f"<Scene {self.name!r}: {'; '.join(parts)}>"

    @classmethod
    def from_toml(cls, text: str) -> Scene:
        """Read a scene from TOML and check it.

        Raises
        ------
        SceneError
            Names the first field that is unknown, missing or not usable.
        """
        return cls._read(_core.scene_from_toml(text))

    @classmethod
    def from_json(cls, text: str) -> Scene:
        """Read a scene from JSON and check it.

        Raises
        ------
        SceneError
            Names the first field that is unknown, missing or not usable.
        """
        return cls._read(_core.scene_from_json(text))

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Scene:
        """Read a scene from a file that ends in ``.toml`` or ``.json`` and check it.

        Raises
        ------
        SceneError
            Names the first field that is unknown, missing or not usable.
        OSError
            The file cannot be read.
        """
        path = Path(path)
        readers = {".toml": cls.from_toml, ".json": cls.from_json}
        reader = readers.get(path.suffix.lower())
        if reader is None:
            raise SceneError("path", str(path), "a file that ends in .toml or .json")
        try:
            text = path.read_text(encoding="utf-8")
        except UnicodeDecodeError as error:
            raise SceneError("path", str(path), f"a text file in UTF-8 ({error})") from error
        return reader(text)

    def validate(self) -> Scene:
        """Check every field, and return the scene as the core reads it.

        Raises
        ------
        SceneError
            With the path, the value and what is allowed, for the first field that is not usable.
        """
        return self.from_json(self._document())

    def doubts(self) -> tuple[str, ...]:
        """Check the scene and return what is unusual about its numbers and probes, of an ordinary bearing nothing.

        Runs, static solutions and campaigns warn of the same (:class:`ballrace.SceneWarning`), and of contacts
        beyond the static load rating.

        Raises
        ------
        SceneError
            A field is not usable.
        """
        return tuple(_core.scene_doubts(self._document()))

    def to_toml(self) -> str:
        """Check the scene and return it as TOML.

        Raises
        ------
        SceneError
            A field is not usable.
        """
        return _core.scene_to_toml(self._document())

    def to_json(self) -> str:
        """Check the scene and return it as JSON on one line, every field written out.

        Raises
        ------
        SceneError
            A field is not usable.
        """
        return _core.scene_from_json(self._document())

    def replace(self, changes: Mapping[str, object]) -> Scene:
        """Return a checked copy with some fields replaced, each by its dotted path.

        Parameters
        ----------
        changes : mapping of str to object
            Paths such as ``loads.axial.force`` or ``rows[0].clearance``, and new values: numbers, text,
            lists, or parts of a scene. ``defects.new`` adds an entry to loads, unbalances, defects or
            probes and takes the whole of it; to remove one, use :func:`dataclasses.replace`.

        Raises
        ------
        SceneError
            A path leads nowhere, or the new scene is not usable.
        """
        pairs = [(path, encode(value, path)) for path, value in changes.items()]
        return self._read(_core.scene_replace(self._document(), json.dumps(pairs)))

    @classmethod
    def _read(cls, text: str) -> Scene:
        scene = decode(Scene, json.loads(text))
        object.__setattr__(scene, "_text", text)
        return scene

    def _document(self) -> str:
        """JSON, not yet checked; kept, since a scene does not change."""
        text: str | None = self.__dict__.get("_text")
        if text is None:
            text = json.dumps(encode(self, ""))
            object.__setattr__(self, "_text", text)
        return text


def checked_scene(given: object) -> Scene:
    """Return a scene where one is meant.

    Raises
    ------
    SceneError
        It is something else; the message says how to come by a scene.
    """
    if isinstance(given, Scene):
        return given
    if isinstance(given, str | os.PathLike):
        allowed = (
            "a Scene; ballrace.Scene.load(path) reads one from a file, ballrace.presets has some"
        )
        raise SceneError("scene", repr(os.fspath(given)), allowed)
    raise SceneError(
        "scene", f"a {type(given).__name__}", "a Scene, as ballrace.Scene.load reads it"
    )
