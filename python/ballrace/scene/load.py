"""Loads and other forces on the rings."""

from __future__ import annotations

from dataclasses import dataclass, field

from .._base.document import LEFT_OUT, Part
from .bearing import RingName
from .time import TimeFunction

__all__ = ["Load", "Moment", "TableForce", "Unbalance"]


@dataclass(frozen=True, kw_only=True)
class Load(Part):
    """A force on a ring's centre or on another point of it, in a fixed direction of the inertial frame.

    Attributes
    ----------
    ring : {"outer", "inner"}
        The loaded ring.
    direction : tuple of three floats
        Direction along x, y, z [1]; its length does not matter.
    force : TimeFunction
        Force along the direction [N].
    at : tuple of three floats, or None
        Where it acts, in the ring's frame, which tilts but does not turn with the ring [m]; None: the ring's
        origin.
    """

    ring: RingName
    direction: tuple[float, float, float]
    force: TimeFunction
    at: tuple[float, float, float] | None = field(default=None, metadata=LEFT_OUT)


@dataclass(frozen=True, kw_only=True)
class Moment(Part):
    """A moment on a ring, about a direction that is fixed in the inertial frame.

    Its part about the ring's axis turns the ring; its part across the axis tilts the ring, or is carried by the
    support that holds the ring parallel.

    Attributes
    ----------
    ring : {"outer", "inner"}
        The loaded ring.
    direction : tuple of three floats
        Axis of the moment, along x, y, z [1]; its length does not matter.
    moment : TimeFunction
        Moment about the direction [N m].
    """

    ring: RingName
    direction: tuple[float, float, float]
    moment: TimeFunction


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
    axial_position : float or None
        Axial place in the ring's frame [m]; two unbalances at different places make a couple. None: 0.
    """

    ring: RingName
    moment: float
    angle: float = 0.0
    axial_position: float | None = field(default=None, metadata=LEFT_OUT)


@dataclass(frozen=True, kw_only=True)
class TableForce(Part):
    """A force on a ring that depends on its place along a direction: springs that stiffen, magnetic pull, seals.

    It acts on the ring's centre of mass. It is linear between the points of the table and continues its first and
    last piece beyond them; a damper acts along the same direction. Runs, equilibria, stiffness and energies
    include it.

    Attributes
    ----------
    ring : {"outer", "inner"}
        The ring it acts on.
    direction : tuple of three floats
        Direction along x, y, z [1]; its length does not matter.
    places : tuple of float
        Displacements of the ring from its place in the scene, along the direction: two or more, increasing [m].
    forces : tuple of float
        Force along the direction at each place [N]: decreasing for a spring, increasing for a magnetic pull.
    damping : float
        Damping along the direction [N s/m].

    Examples
    --------
    A magnetic pull softens a housing of 30 N/µm by 10 N/µm:

    >>> import ballrace as br
    >>> scene = br.presets.deep_groove_6205(radial_load=800.0).replace(
    ...     {
    ...         "gravity": [0.0, 0.0, 0.0],
    ...         "outer_ring.support.y": br.scene.Spring(stiffness=3e7, damping=300.0),
    ...         "table_forces.pull": br.scene.TableForce(
    ...             ring="outer", direction=(0.0, 1.0, 0.0), places=(-1e-4, 1e-4), forces=(-1e3, 1e3)
    ...         ),
    ...     }
    ... )
    >>> sunk = br.equilibrium(scene).outer[1]
    >>> f"{1e6 * sunk:.1f} µm"  # 800 N over 20 N/µm
    '-40.0 µm'
    """

    ring: RingName
    direction: tuple[float, float, float]
    places: tuple[float, ...]
    forces: tuple[float, ...]
    damping: float = 0.0
