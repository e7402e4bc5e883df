"""Rows of balls and the rings around them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from .._base.document import LEFT_OUT, Part
from .contact import Contact
from .friction import Friction
from .lubricant import Lubricant
from .material import Material
from .support import Support
from .texture import Texture

__all__ = ["GothicArch", "RaceProfile", "Ring", "RingName", "Row", "Waviness"]


RingName = Literal["outer", "inner"]
"""Name of a ring."""


@dataclass(frozen=True, kw_only=True)
class Waviness(Part):
    """Harmonic of a race's radius, ``amplitude * cos(order * phi + phase)``, phi from the ring's x axis.

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
class RaceProfile(Part):
    """A race through points: the cubic spline R(z), twice continuously differentiable, that ends with its points.

    Its end conditions are "not a knot", as those of :class:`scipy.interpolate.CubicSpline`. The points are
    those of zero clearance and preload, which shift it as they shift a groove.

    Attributes
    ----------
    z : tuple of float, or array
        Axial places of the points from the row's plane [m], strictly increasing; 4 to 10 000.
    r : tuple of float, or array
        Radius of the race there, from the ring's axis [m].
    """

    z: tuple[float, ...]
    r: tuple[float, ...]


@dataclass(frozen=True, kw_only=True)
class GothicArch(Part):
    """A race of two grooves whose centres lie apart along the axis, so that a ball that rests in it touches both.

    The row's clearance is the play of a ball that touches both flanks at the shim angle.

    Attributes
    ----------
    shim_angle : float
        Between the plane and the normals of a resting ball [rad]; above 0, at most 80°.
    conformities : tuple of two floats, or None
        Conformities of the flanks towards -z and +z [1], above 0.5 and at most 1; None: both that of the race.
    """

    shim_angle: float
    conformities: tuple[float, float] | None = None


@dataclass(frozen=True, kw_only=True)
class Row(Part):
    """Row of balls between two grooves.

    Attributes
    ----------
    ball_count : int
        Number of balls, 1 to 1000.
    ball_diameter : float
        Ball diameter D [m].
    pitch_diameter : float
        Pitch diameter [m].
    outer_conformity, inner_conformity : float
        Groove radius over ball diameter [1], above 0.5 and at most 1.
    contact_angle : float
        Nominal contact angle at zero clearance [rad], 0 to 80°.
    side : int
        Sign of the axial part of the direction from ball to outer contact, +1 or -1. A row of side +1 takes thrust
        towards +z on the inner ring.
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
    outer_shoulder_radius, inner_shoulder_radius : float or None
        Radius by which the shoulders' edges are rounded [m], so that the force of a contact that runs over one
        falls smoothly; None: sharp edges. Only with shoulders and the law of ISO 16281.
    outer_profile, inner_profile : RaceProfile or None
        Race through points, in place of the groove of the conformity.
    outer_arch, inner_arch : GothicArch or None
        Race as a gothic arch, as in a four-point bearing.
    outer_waviness, inner_waviness : tuple of Waviness
        Waviness of the race; turns with its ring. Empty: none.
    texture : Texture or None
        Texture of races and balls, added to their waviness; None: smooth.
    diameter_errors : tuple of float
        Diameter error of each ball [m]; empty: none.
    ball_mass : float or None
        Mass of a ball [kg]; None: from density and diameter.
    ball_inertia : float or None
        Moment of inertia of a ball about z [kg m²]; None: 2/5 m R².
    ball_support : Support
        How every ball of the row is supported; by default free.
    ball_material : Material or None
        Material of the row's balls; None: the scene's ``materials.balls``.
    contact : Contact or None
        Contact of the row's balls and races, in place of all of the scene's ``contact``; None: that of the scene.
    friction : Friction or None
        Friction of the row's balls and races, ``"none"`` for none; None: that of the scene.
    lubricant : Lubricant or None
        Oil of the row's balls and races, in place of all of the scene's ``lubricant``; None: that of the scene.
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
    outer_shoulder_radius: float | None = None
    inner_shoulder_radius: float | None = None
    outer_profile: RaceProfile | None = None
    inner_profile: RaceProfile | None = None
    outer_arch: GothicArch | None = None
    inner_arch: GothicArch | None = None
    outer_waviness: tuple[Waviness, ...] = ()
    inner_waviness: tuple[Waviness, ...] = ()
    texture: Texture | None = field(default=None, metadata=LEFT_OUT)
    diameter_errors: tuple[float, ...] = ()
    ball_mass: float | None = None
    ball_inertia: float | None = None
    ball_support: Support = Support()
    ball_material: Material | None = None
    contact: Contact | None = None
    friction: Friction | None = None
    lubricant: Lubricant | None = field(default=None, metadata=LEFT_OUT)


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
        How the ring is supported.
    tilt : tuple of two floats, or None
        Nominal tilt about x and y [rad], its magnitude at most 0.5: the rotation at which the tilts are held, or
        their springs relaxed; None: 0. It does not apply to a tilt whose motion is given.
    transverse_inertia : float or None
        Moment of inertia about an axis across z through the centre of mass [kg m²]; None: that of the hollow
        cylinder or thin ring that ``inertia`` is computed from, as long as ``width``.
    centre_of_mass : float or None
        Axial place of the centre of mass in the ring's frame [m]; x, y and z of the ring are the displacement of
        this point. None: 0.
    """

    mass: float | None = None
    inertia: float | None = None
    diameter: float | None = None
    width: float | None = None
    support: Support = Support()
    tilt: tuple[float, float] | None = field(default=None, metadata=LEFT_OUT)
    transverse_inertia: float | None = field(default=None, metadata=LEFT_OUT)
    centre_of_mass: float | None = field(default=None, metadata=LEFT_OUT)
