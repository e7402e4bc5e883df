"""Forces on rings computed by the user's functions."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from ._base.numbers import real
from .errors import SceneError
from .scene.bearing import RingName

if TYPE_CHECKING:
    from ._core import _Force

__all__ = ["RingForce", "RingMotion"]


class RingMotion(NamedTuple):
    """Place and motion of a ring, in the scene's frame.

    Attributes
    ----------
    place : tuple of three floats
        Displacement of the centre of mass from its place in the scene, along x, y, z [m].
    angles : tuple of three floats
        Tilt about x and y, 0 where the ring stays parallel, and angle about its axis [rad].
    velocity : tuple of three floats
        Velocity of the centre of mass [m/s].
    rates : tuple of three floats
        Rates of the angles [rad/s].
    """

    place: tuple[float, float, float]
    angles: tuple[float, float, float]
    velocity: tuple[float, float, float]
    rates: tuple[float, float, float]


@dataclass(frozen=True, kw_only=True)
class RingForce:
    """A force on a ring computed by a function: magnetic pull, a seal, a squeeze film, a controller.

    The function is called at every evaluation of the right-hand side, several times for every sample, some 13 µs
    each, longer than all the rest of a small bearing: for studies. A force along a direction that depends on the
    ring's place is a :class:`ballrace.scene.TableForce`, which costs almost nothing and is part of the scene. The
    equilibrium from which a run begins includes the force.

    Attributes
    ----------
    ring : {"outer", "inner"}
        The ring it acts on.
    wrench : callable
        ``wrench(t, motion)`` of time [s] and a :class:`RingMotion`: forces along x, y, z on its centre [N],
        or these and moments about it [N m]; three or six finite numbers. It has to be smooth except at a few
        places, and to depend on its arguments only, since steps may be repeated. An exception that it raises ends
        the run.
    stiffness : float
        Upper bound of its stiffness [N/m], which limits the steps.
    damping : float
        Upper bound of its damping [N s/m], likewise.
    peak : tuple of two floats
        Its largest force in the plane and along z [N]; needed where it is a main load of the bearing.
    in_plane : bool
        Whether it neither acts along z nor tilts the ring, so that a run may leave these directions out.

    Examples
    --------
    >>> import ballrace as br
    >>> spring = br.RingForce(
    ...     ring="outer", wrench=lambda t, ring: (0.0, -1e6 * ring.place[1], 0.0), stiffness=1e6, in_plane=True
    ... )
    >>> scene = br.presets.deep_groove_6205(radial_load=800.0)
    >>> out = br.simulate(scene, duration=1e-3, settle=0.0, forces={"spring": spring})
    """

    ring: RingName
    wrench: Callable[[float, RingMotion], Sequence[float]]
    stiffness: float = 0.0
    damping: float = 0.0
    peak: tuple[float, float] = (0.0, 0.0)
    in_plane: bool = False


def passed(forces: Mapping[str, RingForce] | None) -> list[_Force]:
    """Return checked forces as the core takes them."""
    if forces is None:
        return []
    if not hasattr(forces, "items"):
        raise SceneError("forces", f"a {type(forces).__name__}", "a mapping of RingForce by names")
    return [_passed(str(name), force) for name, force in forces.items()]


def warnings_of(forces: Iterable[str] | None) -> list[tuple[Literal["asked"], str]]:
    """Return the warning of a record about forces that its scene does not have."""
    names = ", ".join(forces or ())
    if not names:
        return []
    return [
        ("asked", f"forces by functions, which the scene does not have, acted on rings: {names}")
    ]


def _passed(name: str, force: object) -> _Force:
    path = f"forces.{name}"
    if not isinstance(force, RingForce):
        allowed = "a RingForce, which has the function as its wrench"
        raise SceneError(path, f"a {type(force).__name__}", allowed)
    if force.ring not in ("outer", "inner"):
        raise SceneError(f"{path}.ring", repr(force.ring), '"outer" or "inner"')
    wrench: object = force.wrench
    if not callable(wrench):
        allowed = "a function of time and a RingMotion"
        raise SceneError(f"{path}.wrench", f"a {type(wrench).__name__}", allowed)
    for field in ("stiffness", "damping"):
        if not 0.0 <= real(getattr(force, field)) < math.inf:
            raise SceneError(f"{path}.{field}", repr(getattr(force, field)), "a number from 0")
    peak = [real(each) for each in force.peak] if isinstance(force.peak, Sequence) else []
    if len(peak) != 2 or not all(0.0 <= each < math.inf for each in peak):
        raise SceneError(f"{path}.peak", repr(force.peak), "two numbers from 0 [N]")

    def called(t: float, *parts: Sequence[float]) -> list[float]:
        motion = RingMotion(*((x, y, z) for x, y, z in parts))
        given = np.asarray(wrench(t, motion))
        is_number = given.dtype.kind in "biuf"
        if given.shape not in ((3,), (6,)) or not is_number or not np.isfinite(given).all():
            text = f"{given} at {t:g} s" if given.size <= 6 else f"an array of shape {given.shape}"
            raise SceneError(
                path, text, "three or six finite numbers: forces [N] and moments [N m]"
            )
        return [*map(float, given), 0.0, 0.0, 0.0][:6]

    return (
        name, force.ring, called, float(force.stiffness), float(force.damping), peak, bool(force.in_plane)
    )  # fmt: skip
