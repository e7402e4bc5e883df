"""Probes: what a run records."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from .._base.document import Variant
from .bearing import RingName

__all__ = [
    "CageProbe",
    "Component",
    "ContactQuantity",
    "ContactsProbe",
    "EnergyProbe",
    "ForcesProbe",
    "LubricationProbe",
    "MomentsProbe",
    "MotionProbe",
    "Probe",
    "SeatProbe",
    "SlicesProbe",
    "StructureProbe",
    "TorqueProbe",
]


Component = Literal[
    "x",
    "y",
    "z",
    "theta",
    "vx",
    "vy",
    "vz",
    "omega",
    "ax",
    "ay",
    "az",
    "alpha",
    "tilt_x",
    "tilt_y",
    "tilt_vx",
    "tilt_vy",
    "tilt_ax",
    "tilt_ay",
    "turn_x",
    "turn_y",
    "omega_x",
    "omega_y",
    "alpha_x",
    "alpha_y",
]
"""Component of a motion: position [m], angle [rad], their rates and the rates of those; likewise of a
ring's tilt [rad], and of how a ball turns about x and y that spins freely [rad]."""

ContactQuantity = Literal["load", "angle", "zone_centre", "zone_width", "slip"]
"""Quantity of a contact: normal force [N], contact angle [rad], axial place of the zone's middle of force in
the ring's frame [m], axial extent of what touches [m], slip speed weighed by the load [m/s]."""


@dataclass(frozen=True, kw_only=True)
class MotionProbe(Variant, tag="motion"):
    """Position, velocity and acceleration of a body: columns ``<probe>.x`` and so on, filtered.

    Attributes
    ----------
    body : str
        ``outer``, ``inner`` or a ball such as ``row0.ball3``.
    components : tuple of Component, or None
        Which of them; None: the twelve of every body, for a ring that may tilt also those of its tilts, for a
        ball that spins freely also those about x and y.
    """

    body: str
    components: tuple[Component, ...] | None = None


@dataclass(frozen=True, kw_only=True)
class ContactsProbe(Variant, tag="contacts"):
    """Quantities of the contacts of balls and races: ``<probe>.ball3.outer.load`` and so on, as points in time.

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
    """The cage of a row, filtered.

    Of links the force of each, positive in tension: columns ``<probe>.link0``, … [N]. Of a ring its angle, which
    goes on from turn to turn, its speed and its centre, ``<probe>.angle`` [rad], ``.omega`` [rad/s], ``.x``,
    ``.y`` [m], and the force of each pocket's wall on its ball, positive on one that leads,
    ``<probe>.pocket0.force``, … [N].

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

    It is filtered, and costs an evaluation of the model at every point that the filter reads: a run of the wheel
    bearing takes a sixth longer.
    """


@dataclass(frozen=True, kw_only=True)
class MomentsProbe(Variant, tag="moments"):
    """Moments about x and y that the balls put on the rings, each about its own centre, as points in time.

    The columns are ``<probe>.outer.x``, ``<probe>.outer.y``, ``<probe>.inner.x`` and ``<probe>.inner.y`` [N m].
    The support that keeps a ring from tilting carries them.
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
class LubricationProbe(Variant, tag="lubrication"):
    """Films and losses of a row's oil, as points in time.

    The columns are ``<probe>.outer.film`` [m], ``<probe>.outer.lambda``, the same of ``inner``,
    ``<probe>.friction_torque`` [N m], ``<probe>.slip_power``, ``rolling_power``, ``damping_power`` and
    ``drag_power`` [W].

    The torque is that of the row's balls on the inner ring, positive against its motion whichever way it turns; a
    :class:`TorqueProbe` has it with its sign about z. Powers are of both races together. Film and λ are NaN where
    all effects of the oil are switched off.

    Attributes
    ----------
    row : int
        Row, from 0; it has a lubricant.
    """

    row: int = 0


@dataclass(frozen=True, kw_only=True)
class StructureProbe(Variant, tag="structure"):
    """Accelerations of the sensors of a structure: ``<probe>.<sensor>.ax``, ``.ay``, ``.az`` [m/s²], filtered.

    Attributes
    ----------
    sensors : tuple of str, or None
        Names of the sensors; None: all.
    """

    sensors: tuple[str, ...] | None = None


@dataclass(frozen=True, kw_only=True)
class SeatProbe(Variant, tag="seat"):
    """Force of the outer ring on the seat of a structure: ``<probe>.fx``, ``.fy``, ``.fz`` [N], filtered."""


@dataclass(frozen=True, kw_only=True)
class SlicesProbe(Variant, tag="slices"):
    """Forces of the single slices of chosen contacts at chosen times; a table in addition to the signals.

    ``out.slices`` has a line for each slice: ``probe``, ``row``, ``ball``, ``race``, ``time`` [s], its axial place
    in the ball ``zeta`` and in the ring ``z`` [m], its ``width`` and ``penetration`` [m], and its ``force`` [N].

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
    MotionProbe
    | ContactsProbe
    | CageProbe
    | EnergyProbe
    | TorqueProbe
    | ForcesProbe
    | LubricationProbe
    | MomentsProbe
    | SeatProbe
    | SlicesProbe
    | StructureProbe
)
"""A named set of signals."""
