"""A scene of rows and rings, filled with what all scenes of the catalogue have: friction, cage, drive, probes."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, TypeVar

from .. import _core
from .._base.numbers import finite
from ..errors import EquilibriumError, SceneError
from ..scene import (
    CageRing,
    Contact,
    Coulomb,
    Defect,
    Load,
    Lubricant,
    MotionProbe,
    Ring,
    Row,
    Scene,
    SeatProbe,
    SpeedDrive,
    SqueezeFilm,
    StructureProbe,
)
from ..scene.defect import ALONG_AXIS, named_by_shape
from ..scene.lubricant import chosen

if TYPE_CHECKING:
    from ..scene import Probe, Spin, Structure, Unbalance

T = TypeVar("T")

_OF_6205 = 7.94e-3
"""Ball diameter of the bearing that a squeeze film is by default for [m]."""

_LOADS = (
    'loads on a ring by their names, such as {"belt": br.machines.belt(900.0, at=-0.08)} or '
    '{"push": br.scene.Load(ring="inner", direction=(0.0, -1.0, 0.0), force=500.0)}'
)
_DEFECTS = (
    'one of br.defects, such as br.defects.spall(on="inner_race", width_mm=1.0), or several by their '
    'names, {"first": …, "second": …}'
)


def filled(
    *,
    name: str,
    rows: tuple[Row, ...],
    outer_ring: Ring,
    inner_ring: Ring,
    structure: Structure | None = None,
    speed_rpm: float | None,
    outer_rpm: float | None,
    loads: Mapping[str, Load] | None,
    unbalances: Mapping[str, Unbalance] | None = None,
    defects: Defect | Mapping[str, Defect] | None,
    lubricant: str | Lubricant | None,
    temperature_c: float | None,
) -> Scene:
    """Return the checked scene; the fields are those of :class:`ballrace.Scene`, the arguments of ``bearing``.

    Without a speed the inner ring stands, where the outer ring turns.

    Raises
    ------
    SceneError
        An argument is not usable.
    """
    if speed_rpm is None and outer_rpm is None:
        allowed = "the speed of the inner ring [1/min], such as speed_rpm=1500.0, or outer_rpm"
        raise SceneError("speed_rpm", "None", allowed)
    speed_rpm = 0.0 if speed_rpm is None else speed_rpm
    speed_rpm = finite("speed_rpm", speed_rpm, "1/min")
    if outer_rpm is not None:
        outer_rpm = finite("outer_rpm", outer_rpm, "1/min")
    one = {named_by_shape(defects): defects} if isinstance(defects, Defect) else defects
    scene = Scene(
        name=name,
        rows=rows,
        outer_ring=outer_ring,
        inner_ring=inner_ring,
        structure=structure,
        friction=Coulomb(coefficient=0.05, slip_speed=0.1),
        contact=Contact(squeeze=_grease(rows)),
        lubricant=chosen(lubricant, temperature_c),
        cage=CageRing(),
        loads=named("loads", loads, Load, _LOADS),
        unbalances=unbalances or {},
        drive=SpeedDrive(speed_rpm * math.pi / 30.0),
        outer_speed=None if outer_rpm is None else outer_rpm * math.pi / 30.0,
        defects=named("defects", one, Defect, _DEFECTS),
        probes=_probes(structure),
    )
    return with_spin(scene.validate())


def _grease(rows: tuple[Row, ...]) -> SqueezeFilm:
    """Return the squeeze film of starved grease, whose damping goes with the area of the balls."""
    size = sum(row.ball_diameter for row in rows) / len(rows) / _OF_6205
    film = SqueezeFilm()
    return replace(film, damping=film.damping * size * size, pull=film.pull * size)


def _probes(structure: Structure | None) -> dict[str, Probe]:
    """Return the probes of the motion of both rings, and of a structure with its sensors and its seat."""
    probes: dict[str, Probe] = {
        "outer": MotionProbe(body="outer"),
        "inner": MotionProbe(body="inner"),
    }
    if structure is not None:
        if structure.sensors:
            probes["housing"] = StructureProbe()
        probes["seat"] = SeatProbe()
    return probes


def with_spin(scene: Scene) -> Scene:
    """Return a scene whose balls spin about any axis where that matters, else about the bearing's for less.

    It matters where orbit speeds or loads at rest differ by more than 0.2 %. A ball's defect that has its length
    along the axis, as a spall of :mod:`ballrace.defects` on a ball, needs the axis held, and so does any beside a
    ball's texture.
    """
    on_balls = [d for d in scene.defects.values() if d.on == "ball"]
    rough = any(row.texture is not None and row.texture.ball > 0.0 for row in scene.rows)
    held = any(rough or isinstance(d, ALONG_AXIS) for d in on_balls)
    spin: Spin | None = None if held or not _parts(scene) else "free"
    return scene if scene.spin == spin else replace(scene, spin=spin).validate()


def _parts(scene: Scene) -> bool:
    """Return whether holding the balls' axis gives another answer; without an equilibrium nothing is known."""
    try:
        found = _core.axis_held(scene._document())
    except EquilibriumError:
        return False
    return found is not None and not found[2]


def named(field: str, given: object, kind: type[T], allowed: str) -> dict[str, T]:
    """Return parts of one kind by their names; None is none of them.

    Raises
    ------
    SceneError
        It is something else, or an entry of it is; the message names the entry.
    """
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise SceneError(field, repr(given), allowed)
    for name, part in given.items():
        if not isinstance(name, str):
            raise SceneError(field, repr(name), "names that are text")
        if not isinstance(part, kind):
            raise SceneError(f"{field}.{name}", repr(part), allowed)
    return dict(given)
