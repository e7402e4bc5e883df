"""Two equal angular contact bearings side by side."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Literal, get_args

from .._base.arguments import knows
from .._base.numbers import finite, positive
from ..bearings import Bearing, bearing, catalogue
from ..bearings.filled import with_spin
from ..errors import SceneError
from ..scene import Load, Scene
from ..statics import equilibrium
from .shafts import SPEEDS, shaft

if TYPE_CHECKING:
    from ..scene import Structure

Arrangement = Literal["back_to_back", "face_to_face", "tandem"]
"""How two bearings stand: lines of contact meet the axis outside of them, between them, or are parallel."""

_SIDES = {"back_to_back": (1, -1), "face_to_face": (-1, 1), "tandem": (1, 1)}


@knows(SPEEDS | dict.fromkeys(("load", "force"), "radial_load and axial_load [N]"))
def pair(
    name: str | Bearing,
    *,
    arrangement: Arrangement = "back_to_back",
    preload: float = 0.0,
    radial_load: float | None = None,
    axial_load: float | None = None,
    at: float = 0.0,
    speed_rpm: float | None = None,
    outer_rpm: float | None = None,
    housing: Literal["pedestal"] | Structure | None = "pedestal",
) -> Scene:
    """Return a pair of equal angular contact bearings side by side, their middle at z = 0; the shaft tilts.

    Parameters
    ----------
    name : str or Bearing
        A single row angular contact bearing, such as ``"7208 BECBP"``.
    arrangement : {"back_to_back", "face_to_face", "tandem"}
        Arrangement. Back to back they are stiff against tilting, face to face compliant; both take thrust in
        either direction. In tandem they share thrust towards +z, and need it.
    preload : float
        Axial force between the bearings at rest and without load [N], from 0; in tandem 0.
    radial_load : float, optional
        Load on the shaft along -y [N]; by default a tenth of the static load rating of one.
    axial_load : float, optional
        Load on the shaft along +z [N]; by default 0, in tandem 1.22 times the least that holds them together.
    at : float
        Axial place of the radial load [m].
    speed_rpm, outer_rpm, housing
        As of :func:`ballrace.shaft`.

    Raises
    ------
    SceneError
        The bearing is not an angular contact bearing, or an argument is not usable.
    EquilibriumError
        There is no equilibrium under the preload.

    Examples
    --------
    >>> import ballrace as br
    >>> made = br.pair("7208 BECBP", preload=500.0, radial_load=0.0, speed_rpm=1500.0)
    >>> [round(float(each.force[2]), -1) for each in br.machines.reactions(made)]
    [-500.0, 500.0]
    """
    made = catalogue[name] if isinstance(name, str) else name
    if not isinstance(made, Bearing) or made.kind != "angular_contact":
        raise SceneError("name", repr(name), "a single row angular contact bearing, such as 7208B")
    if arrangement not in get_args(Arrangement):
        allowed = " or ".join(map(repr, get_args(Arrangement)))
        raise SceneError("arrangement", repr(arrangement), allowed)
    preload = positive("preload", preload, "N", zero=True)
    if arrangement == "tandem" and preload:
        raise SceneError("preload", repr(preload), "0 in tandem [N]")
    if radial_load is None:
        radial_load = 0.1 * made.static_rating
    radial = positive("radial_load", radial_load, "N", zero=True)
    axial = _thrust(made, arrangement, radial, axial_load)
    aside = 0.5 * made.width
    first, second = _SIDES[arrangement]
    scene = shaft(
        [(made, -aside, first), (made, aside, second)],
        speed_rpm=speed_rpm,
        outer_rpm=outer_rpm,
        loads={
            "radial": Load(
                ring="inner",
                direction=(0.0, -1.0, 0.0),
                force=radial,
                at=(0.0, 0.0, finite("at", at, "m")),
            ),
            "axial": Load(ring="inner", direction=(0.0, 0.0, 1.0), force=axial),
        },
        housing=housing,
    )
    pressed = _approach(made, preload)
    rows = tuple(replace(row, axial_preload=pressed) for row in scene.rows)
    title = f"{made.designation} {arrangement.replace('_', ' ')}"
    return with_spin(replace(scene, rows=rows, name=title).validate())


def _thrust(made: Bearing, arrangement: Arrangement, radial: float, axial: float | None) -> float:
    """Return the axial load, which only a tandem needs to hold together."""
    least = radial * math.tan(made.contact_angle) if arrangement == "tandem" else 0.0
    if axial is None:
        return 1.22 * least
    axial = finite("axial_load", axial, "N")
    if arrangement == "tandem" and not axial > least:
        raise SceneError("axial_load", f"{axial:g}", f"above {least:.4g} N, in tandem")
    return axial


def _approach(made: Bearing, force: float) -> float:
    """Return how far a bearing's rings go towards each other under a thrust [m]."""
    if force == 0.0:
        return 0.0
    alone = bearing(made, radial_load=0.0, axial_load=force, speed_rpm=100.0, housing=None)
    found = equilibrium(replace(alone, gravity=(0.0, 0.0, 0.0)))
    return float(found.inner[2] - found.outer[2])
