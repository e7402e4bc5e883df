"""The dataclasses mirror the core's document: names, variants, defaults and values."""

from __future__ import annotations

import copy
import dataclasses
import json
import math
import pickle
import re
import types
import typing
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import pytest

import ballrace as br
from ballrace import _core
from ballrace import scene as s
from ballrace._base.document import INSTEAD, Part, Told, Variant, decode, encode

MINIMAL = s.Row(
    ball_count=9,
    ball_diameter=8e-3,
    pitch_diameter=39e-3,
    outer_conformity=0.52,
    inner_conformity=0.51,
)


OF_BALLS: tuple[s.Component, ...] = (
    "turn_x",
    "turn_y",
    "omega_x",
    "omega_y",
    "alpha_x",
    "alpha_y",
)


def every_field() -> s.Scene:
    """A usable scene in which no field keeps its default (where a single scene can)."""
    support = s.Support(
        x=s.Spring(stiffness=1e8, damping=300.0), y="free", z="fixed", theta=s.Spring(stiffness=1e3)
    )
    row = s.Row(
        ball_count=9,
        ball_diameter=7.94e-3,
        pitch_diameter=39.04e-3,
        outer_conformity=0.525,
        inner_conformity=0.515,
        contact_angle=0.2,
        side=-1,
        axial_position=2e-3,
        clearance=1e-6,
        axial_preload=2e-6,
        start_angle=0.3,
        outer_shoulders=(0.9, 0.8),
        inner_shoulders=(0.7, 0.9),
        outer_shoulder_radius=1e-4,
        inner_shoulder_radius=2e-4,
        outer_waviness=(s.Waviness(order=7, amplitude=1e-7, phase=0.1),),
        inner_waviness=(
            s.Waviness(order=8, amplitude=1e-7),
            s.Waviness(order=9, amplitude=2e-7, phase=-0.1),
        ),
        diameter_errors=(1e-7,) * 9,
        ball_mass=2e-3,
        ball_inertia=1.3e-8,
        ball_support=s.Support(x=s.Spring(damping=1.0)),
        ball_material=s.Material(density=3200.0, youngs_modulus=310e9, poisson_ratio=0.26),
        contact=s.Contact(law=s.Iso16281(constant=4e10), damping=0.3),
        friction=s.Coulomb(coefficient=0.05, slip_speed=0.1),
    )
    floor = s.Floor(depth=1e-5, elements=4)
    place: dict[str, Any] = {"on": "ball", "row": 1, "ball": 2, "angle": 0.3, "axial_offset": 1e-4}
    defect = s.Patch(
        on="outer_race",
        row=1,
        angle=-1.5,
        axial_offset=1e-4,
        length=1e-3,
        width=s.WidthProfile(positions=(-1e-3, 1e-3), widths=(1e-3, 2e-3)),
        edge_radius=3e-4,
        floor=floor,
    )
    races: tuple[s.RingName, ...] = ("inner", "outer")
    return s.Scene(
        name="every field",
        rows=(row, dataclasses.replace(row, side=1, axial_position=-2e-3)),
        outer_ring=s.Ring(mass=0.5, inertia=1e-3, diameter=52e-3, width=15e-3, support=support),
        inner_ring=s.Ring(
            mass=0.3,
            inertia=1e-4,
            diameter=25e-3,
            width=15e-3,
            support=s.Support(
                x=s.Given(1e-6),
                y=s.Given(s.Spline(times=(0.0, 0.1), values=(-1e-5, 0.0), rates=(0.0, 1e-4))),
            ),
        ),
        materials=s.Materials(
            rings=s.Material(density=7800.0, youngs_modulus=2.1e11, poisson_ratio=0.29),
            balls=s.Material(density=3200.0, youngs_modulus=3.1e11, poisson_ratio=0.26),
        ),
        contact=s.Contact(
            law=s.Iso16281(constant=3e10, length_ratio=0.4),
            slices=s.FixedSlices(50),
            damping=0.1,
            clamp_pull=False,
            squeeze=s.SqueezeFilm(damping=20.0, thickness=2e-7, pull=0.03),
        ),
        friction=s.Traction(a=0.01, b=0.02, c=0.5, d=0.03, slip_speed=0.05),
        cage=s.Cage(stiffness=1e6, damping=20.0, play=1e-4),
        drive=s.TorqueDrive(
            value=s.Table(times=(0.0, 0.1, 0.1), values=(0.0, 1.0, 2.0)), initial_speed=100.0
        ),
        gravity=(0.0, 1.0, -9.0),
        loads={
            "axial": s.Load(
                ring="outer",
                direction=(0.0, 0.0, 1.0),
                force=s.Ramp(from_=0.0, to=1e3, start=0.0, end=0.1),
            ),
            "radial": s.Load(
                ring="inner",
                direction=(0.0, -1.0, 0.0),
                force=s.Sine(mean=1e3, amplitude=10.0, frequency=50.0, phase=0.5),
            ),
        },
        unbalances={"rotor": s.Unbalance(ring="inner", moment=1e-4, angle=0.4)},
        table_forces={
            "pull": s.TableForce(
                ring="inner",
                direction=(0.0, 1.0, 0.0),
                places=(-1e-4, 1e-4),
                forces=(-10.0, 10.0),
                damping=5.0,
            )
        },
        defects={
            "outer": defect,
            "inner": dataclasses.replace(defect, on="inner_race", width=1e-3),
            "ball": dataclasses.replace(defect, on="ball", ball=3, width=1e-3, length=5e-4),
            "steep": s.SteepPatch(**place, length=2e-3, width=1e-3, floor=floor),
            "cap": s.Cap(**place, width=1e-3, edge_radius=3e-4, floor=floor),
        },
        probes={
            "motion": s.MotionProbe(
                body="inner",
                components=tuple(c for c in typing.get_args(s.Component) if c not in OF_BALLS),
            ),
            "contacts": s.ContactsProbe(
                row=1, balls=(1, 2), races=races, quantities=typing.get_args(s.ContactQuantity)
            ),
            "cage": s.CageProbe(row=1),
            "energy": s.EnergyProbe(),
            "torque": s.TorqueProbe(),
            "moments": s.MomentsProbe(),
            "forces": s.ForcesProbe(body="outer"),
            "slices": s.SlicesProbe(row=1, balls=(0,), races=("outer",), times=(0.0, 1e-3)),
        },
        solver=s.Solver(
            method="verner",
            rtol=1e-5,
            first_step=1e-8,
            max_step=1e-5,
            frequency_cap=False,
            reduce=False,
        ),
    )


def spun() -> s.Scene:
    """Return the same with balls that spin freely, and a probe of one."""
    full = every_field()
    motion = s.MotionProbe(body="row1.ball2", components=OF_BALLS)
    return dataclasses.replace(
        full,
        spin="free",
        defects={"cap": full.defects["cap"]},
        probes={"motion": motion},
    )


def scenes() -> list[s.Scene]:
    """Scenes that together use every variant."""
    full = every_field()
    return [
        spun(),
        br.presets.wheel_bearing(),
        br.presets.deep_groove_6205(),
        full,
        full.replace({"friction": s.Coulomb(coefficient=0.1, slip_speed=0.1)}),
        full.replace(
            {
                "friction": s.Stribeck(
                    static_coefficient=0.2,
                    kinetic_coefficient=0.1,
                    stribeck_speed=0.3,
                    slip_speed=0.1,
                )
            }
        ),
        full.replace(
            {
                "friction": "none",
                "contact": s.Contact(
                    law="hertz", slices=s.FittedSlices(6), squeeze=s.SqueezeFilm()
                ),
            }
        ),
        full.replace(
            {"drive": s.SpeedDrive(s.Sine(mean=9.0, amplitude=1.0, frequency=2.0, phase=0.0))}
        ),
        full.replace(
            {
                "cage": s.CageRing(
                    mass=2e-3,
                    inertia=1e-6,
                    eccentricity=1e-4,
                    pocket_clearance=60e-6,
                    stiffness=2e5,
                    damping=20.0,
                    damping_depth=1e-7,
                    friction=0.03,
                    slip_speed=0.02,
                    pocket_errors=(1e-3,) * full.rows[0].ball_count,
                    pocket_error=1e-4,
                    seed=3,
                    guided="outer",
                    centring_stiffness=1e4,
                    land_clearance=70e-6,
                    land_radius=0.02,
                    land_stiffness=2e6,
                    land_friction=0.1,
                )
            }
        ),
        full.replace({"drive": s.SpeedDrive(100.0), "contact.slices": s.AccurateSlices(1e-5)}),
        full.replace(
            {
                "drive": s.SpeedDrive(100.0),
                "outer_ring.support.theta": None,
                "outer_speed": s.Ramp(from_=1.0, to=-9.0, start=0.0, end=0.1),
            }
        ),
        shaped(full),
        lubricated(full),
        dented(full),
        tilting(full),
        textured(),
        *seated(),
    ]


def seated() -> list[s.Scene]:
    """Scenes whose outer ring stands on a structure."""
    modes = tuple(
        s.Mode(frequency=f, damping=0.05, mass=2.0, seat=(0.1, 1.0, 0.0), sensors={"top": (0.0, 1.0, 0.2)})
        for f in (700.0, 1200.0)
    )  # fmt: skip
    bearing = br.presets.deep_groove_6205()
    matrix = ((2e-9, 1e-10, 0.0), (1e-10, 2e-9, 0.0), (0.0, 0.0, 1e-9))
    compliances: list[s.Compliance | None] = [None, 2e-9, (1e-9, 2e-9, 3e-9), matrix]
    made = [
        dataclasses.replace(
            bearing, structure=s.Structure(modes=modes, static_compliance=compliance)
        )
        for compliance in compliances
    ]
    probes: dict[str, s.Probe] = {
        "housing": s.StructureProbe(sensors=("top",)),
        "seat": s.SeatProbe(),
    }
    return [*made, dataclasses.replace(made[0], probes=probes)]


def tilting(full: s.Scene) -> s.Scene:
    """A scene whose rings tilt, under loads off their centres."""
    diagonal = [[float(i == j) for j in range(6)] for i in range(6)]
    held = s.Support(
        tilt_x=s.Spring(stiffness=1e4, damping=1.0),
        tilt_y="free",
        coupled=s.CoupledSupport(
            stiffness=tuple(tuple(row) for row in diagonal),
            damping=tuple(tuple(0.1 * x for x in row) for row in diagonal),
            axial_position=1e-3,
        ),
    )
    load = s.Load(ring="inner", direction=(0.0, 1.0, 0.0), force=1e3, at=(0.0, -0.3, 0.02))
    return dataclasses.replace(
        full,
        outer_ring=dataclasses.replace(full.outer_ring, support=held),
        inner_ring=dataclasses.replace(
            full.inner_ring, tilt=(1e-3, -1e-3), transverse_inertia=1e-3, centre_of_mass=2e-3
        ),
        drive=s.SpeedDrive(100.0),
        loads={"wheel": load},
        moments={"bend": s.Moment(ring="outer", direction=(1.0, 0.0, 0.0), moment=2.0)},
        unbalances={"rotor": s.Unbalance(ring="inner", moment=1e-4, axial_position=0.1)},
        solver=s.Solver(method="dormand-prince"),
    )


def shaped(full: s.Scene) -> s.Scene:
    """A scene whose races are a curve through points and gothic arches."""
    row = dataclasses.replace(
        full.rows[0],
        outer_shoulders=None,
        outer_shoulder_radius=None,
        inner_shoulder_radius=None,
        outer_profile=s.RaceProfile(
            z=(-3e-3, -1e-3, 1e-3, 3e-3), r=(22.7e-3, 23.4e-3, 23.4e-3, 22.7e-3)
        ),
        inner_arch=s.GothicArch(shim_angle=0.3, conformities=(0.52, 0.53)),
    )
    other = dataclasses.replace(
        row,
        inner_shoulders=None,
        outer_profile=None,
        inner_arch=None,
        outer_arch=row.inner_arch,
        inner_profile=s.RaceProfile(
            z=(-3e-3, -1e-3, 1e-3, 3e-3), r=(16.3e-3, 15.6e-3, 15.6e-3, 16.3e-3)
        ),
    )
    return dataclasses.replace(full, rows=(row, other))


def dented(full: s.Scene) -> s.Scene:
    """A scene with damages smaller than their contacts."""
    rows = [
        dataclasses.replace(row, outer_shoulder_radius=None, inner_shoulder_radius=None)
        for row in full.rows
    ]
    place: dict[str, Any] = {"on": "ball", "row": 1, "axial_offset": 1e-4, "width": 1e-4}
    defects = {
        "pit": s.Pit(**place, ball=2, angle=0.3, length=2e-4),
        "dent": s.Dent(**place, ball=3, angle=0.4, length=2e-4, depth=8e-6, rim_height=4e-7),
    }
    return dataclasses.replace(full, name="dented", rows=tuple(rows), defects=defects)


def textured() -> s.Scene:
    """A scene whose races and balls are not smooth."""
    texture = s.Texture(
        outer=1e-9,
        inner=2e-9,
        ball=3e-11,
        slope=1.8,
        orders=(2, 400),
        seed=7,
        reference_load=200.0,
    )
    return br.presets.deep_groove_6205().replace({"rows[0].texture": texture})


def lubricated(full: s.Scene) -> s.Scene:
    """A scene with an oil by its data sheet, and by name in one row."""
    sheet = s.Lubricant(
        viscosity_40=46e-6,
        viscosity_100=6.8e-6,
        density_15=865.0,
        temperature=343.15,
        base="pao",
        pressure_viscosity=1.5e-8,
        limiting_stress=0.04,
        boundary_friction=0.1,
        conductivity=0.14,
        roughness=2e-7,
        oil_layer="flooded",
        hysteresis=0.01,
        slip_floor=1e-3,
        damping_frequency=1000.0,
        reference_speed=200.0,
        reference_load=300.0,
        fill=0.1,
        film=False,
        damping=False,
        traction=False,
        rolling=False,
    )
    row = dataclasses.replace(full.rows[0], lubricant=s.Lubricant.named("fva3", temperature_c=40.0))
    return dataclasses.replace(
        full,
        name="lubricated",
        rows=(row, full.rows[1]),
        lubricant=sheet,
        probes={"oil": s.LubricationProbe(row=1)},
    )


def walk(value: Any, hint: Any, path: str = "") -> Iterator[tuple[str, Any, Any]]:
    """All places of a scene with the hint that rules there."""
    yield path, value, hint
    if isinstance(value, Variant):
        path = f"{path}.{value.tag}"
    if isinstance(value, Part):
        hints = typing.get_type_hints(type(value))
        for field in dataclasses.fields(value):
            key = field.name.removesuffix("_")
            wraps = isinstance(value, Variant) and value.wraps
            inner = path if wraps else f"{path}.{key}".removeprefix(".")
            yield from walk(getattr(value, field.name), hints[field.name], inner)
    elif isinstance(value, Mapping):
        for key, entry in value.items():
            yield from walk(entry, typing.get_args(hint)[1], f"{path}.{key}")
    elif isinstance(value, tuple):
        tuples = [h for h in members(hint) if typing.get_origin(h) is tuple]
        rows = value != () and isinstance(value[0], tuple)
        of_rows = [typing.get_origin(typing.get_args(h)[0]) is tuple for h in tuples]
        of_tuple = tuples[of_rows.index(rows) if len(tuples) > 1 else 0]
        for i, entry in enumerate(value):
            yield from walk(entry, typing.get_args(of_tuple)[0], f"{path}[{i}]")


def members(hint: Any) -> tuple[Any, ...]:
    is_union = typing.get_origin(hint) in (typing.Union, types.UnionType)
    return typing.get_args(hint) if is_union else (hint,)


def choices(hint: Any) -> set[str]:
    """Tags and plain names that may stand at a place."""
    found: set[str] = set()
    for member in members(hint):
        if typing.get_origin(member) is typing.Literal:
            found |= set(typing.get_args(member))
        elif isinstance(member, type) and issubclass(member, Variant):
            found.add(member.tag)
    return found


def expected_by_core(scene: s.Scene, path: str, intruder: object) -> set[str]:
    """The names that the core would have taken instead of ``intruder`` at ``path``."""
    document: Any = scene.to_dict()
    place = document
    steps = re.findall(r"[^.\[\]]+", path)
    for step in steps[:-1]:
        place = place[int(step) if isinstance(place, list) else step]
    key = int(steps[-1]) if isinstance(place, list) else steps[-1]
    known = left_out() | {"shape", "walls"}
    assert key in place or isinstance(key, int) or intruder == 1 or key in known
    place[key] = intruder
    with pytest.raises(br.SceneError) as caught:
        _core.scene_from_json(json.dumps(document))
    assert "stranger" in str(caught.value)
    _, listed, fields = caught.value.allowed.partition("there are: ")
    return set(fields.split(", ") if listed else re.findall(r"\"([^\"]+)\"", caught.value.allowed))


def left_out() -> set[str]:
    """Fields that a document leaves out where they are None."""
    fields = (field for part in parts() for field in dataclasses.fields(part))
    return {field.name for field in fields if "left_out" in field.metadata}


def parts() -> set[type]:
    """All classes of the document; a run is one of its own."""
    found: set[type] = set()
    todo: list[type] = [Part]
    while todo:
        subclasses: list[type] = todo.pop().__subclasses__()
        found |= set(subclasses)
        todo += subclasses
    return found - {Variant, Told, s.Defect, br.Run}


@pytest.mark.parametrize("scene", scenes(), ids=lambda scene: scene.name)
def test_round_trips(scene: s.Scene) -> None:
    assert s.Scene.from_json(scene.to_json()) == scene
    assert s.Scene.from_toml(scene.to_toml()) == scene
    assert json.loads(scene.to_json()) == scene.to_dict()
    assert scene.validate() == scene
    assert pickle.loads(pickle.dumps(scene)) == scene
    assert copy.deepcopy(scene) == scene


def test_the_scenes_above_use_everything() -> None:
    used: dict[type, set[str]] = {}
    for scene in scenes():
        for _, value, _ in walk(scene, s.Scene):
            if isinstance(value, Part):
                changed = used.setdefault(type(value), set())
                for field in dataclasses.fields(value):
                    default = field.default
                    if field.default_factory is not dataclasses.MISSING:
                        default = field.default_factory()
                    if getattr(value, field.name) != default:
                        changed.add(field.name)
    # The version of the document has one value.
    used[s.Scene].add("schema")
    assert used == {part: {f.name for f in dataclasses.fields(part)} for part in parts()}


def test_fields_and_variants_have_the_same_names_in_the_core() -> None:
    compared: set[object] = set()
    for scene in scenes():
        for path, value, hint in walk(scene, s.Scene):
            if key := frozenset(choices(hint)):
                # Beside a number there is a word, elsewhere a table.
                intruder = "stranger" if hint in (s.AxialOffset, s.OilLayer) else {"stranger": {}}
                # The fields of links lie flat beside the tag of a ring.
                flat = {f.name for f in dataclasses.fields(s.Cage)} if path == "cage" else set()
                assert expected_by_core(scene, path, intruder) == key | flat, path
                compared.add(key)
            if isinstance(value, Part) and not (isinstance(value, Variant) and value.wraps):
                inner = f"{path}.{value.tag}" if isinstance(value, Variant) else path
                names = {f.name.removesuffix("_") for f in dataclasses.fields(value)}
                also = [
                    f.metadata[INSTEAD] for f in dataclasses.fields(value) if INSTEAD in f.metadata
                ]
                names |= {key for key, _ in also}
                if isinstance(value, Told):
                    names.update(value._telling)
                    for kind in s.Defect._kinds():
                        names |= {field.name for field in dataclasses.fields(kind)}
                if isinstance(value, s.Cage):
                    names.add(s.CageRing.tag)
                assert expected_by_core(scene, f"{inner}.stranger", 1) == names, inner
                compared.add(type(value).__name__)
    assert {part.__name__ for part in parts()}.difference(compared) == {
        "AccurateSlices", "FittedSlices", "FixedSlices", "Given", "SpeedDrive"
    }  # fmt: skip


def test_words_for_kinds_of_damage_are_those_of_the_core(wheel: s.Scene) -> None:
    for key, words in (("shape", s.DefectShape), ("walls", s.DefectWalls)):
        taken = expected_by_core(wheel, f"defects.spall.{key}", "stranger")
        told = {getattr(kind, key) for kind in s.Defect._kinds()} - {None}
        assert taken == told == set(typing.get_args(words))


def test_defaults_are_those_of_the_core() -> None:
    row = {
        f.name: getattr(MINIMAL, f.name)
        for f in dataclasses.fields(s.Row)
        if f.default is dataclasses.MISSING
    }
    wave = {"order": 3, "amplitude": 1e-7}
    outer = {"angle": 0.0, "length": 1e-3, "width": 1e-3, "edge_radius": 3e-4, "on": "outer_race"}
    document = {
        "rows": [{**row, "outer_waviness": [wave]}],
        "drive": {"torque": {"value": 1.0}},
        "outer_ring": {"mass": 1.0, "support": {"x": {"spring": {}}}},
        "inner_ring": {"mass": 1.0},
        "contact": {"law": {"iso16281": {}}, "squeeze": {}},
        "cage": {"stiffness": 1.0},
        # A document that does not say it means the tolerance of before there was a band.
        "solver": {"rtol": "band"},
        "unbalances": {"a": {"ring": "inner", "moment": 1e-3}},
        "defects": {"a": outer},
        "probes": {
            "a": {"motion": {"body": "outer"}},
            "b": {"contacts": {}},
            "c": {"cage": {}},
            "d": {"slices": {"times": []}},
        },
    }
    scene = s.Scene(
        rows=(dataclasses.replace(MINIMAL, outer_waviness=(s.Waviness(order=3, amplitude=1e-7),)),),
        drive=s.TorqueDrive(value=1.0),
        outer_ring=s.Ring(mass=1.0, support=s.Support(x=s.Spring())),
        inner_ring=s.Ring(mass=1.0),
        contact=s.Contact(law=s.Iso16281(), squeeze=s.SqueezeFilm()),
        cage=s.Cage(stiffness=1.0),
        unbalances={"a": s.Unbalance(ring="inner", moment=1e-3)},
        defects={
            "a": s.Defect(on="outer_race", angle=0.0, length=1e-3, width=1e-3, edge_radius=3e-4)
        },
        probes={
            "a": s.MotionProbe(body="outer"),
            "b": s.ContactsProbe(),
            "c": s.CageProbe(),
            "d": s.SlicesProbe(times=()),
        },
    )
    assert json.loads(_core.scene_from_json(json.dumps(document))) == scene.to_dict()


def test_unknown_names_are_refused_here_too() -> None:
    document = br.presets.wheel_bearing().to_dict()
    document["cage"]["stranger"] = 1
    with pytest.raises(br.SceneError, match=r"cage\.stranger"):
        decode(s.Scene, document)
    document = br.presets.wheel_bearing().to_dict()
    document["friction"] = {"stranger": {}}
    with pytest.raises(br.SceneError, match="friction"):
        decode(s.Scene, document)


def test_replace_reaches_every_field(wheel: s.Scene) -> None:
    profile = s.WidthProfile(positions=(0.0,), widths=(1e-3,))
    changed = wheel.replace({"rows[1].clearance": 5e-6, "defects.spall.width": profile})
    assert changed.rows[1].clearance == 5e-6
    assert changed.defects["spall"].width == profile
    assert wheel.rows[1].clearance == 0.0


LED: list[tuple[str, s.TimeFunction]] = [
    ("inner_ring.support.x", s.Ramp(from_=0.0, to=1e-5, start=0.0, end=1.0)),
    ("outer_ring.support.y", s.Table(times=(0.0, 1.0), values=(0.0, 1e-5))),
    ("inner_ring.support.z", 0.2),
    ("outer_ring.support.tilt_x", 0.6),
    ("outer_ring.support.theta", 0.0),
]
"""Motions that no ring can be given."""


def test_rings_that_are_led_are_not_the_record() -> None:
    """Their motion is known; the loads of the contacts are not."""
    led = {f"inner_ring.support.{d}": s.Given(-2e-5 if d == "y" else 0.0) for d in "xyz"}
    held = br.bearing("6205", housing=None, speed_rpm=1800.0).replace(
        {"probes": {}, "outer_ring.support": s.Support(), **led}
    )
    assert br.simulate(held, duration=1e-3, settle=0.0).names[0] == "row0.ball0.outer.load"


@pytest.mark.parametrize(
    ("path", "value", "named"),
    [
        ("rows[0].clearance", float("nan"), "rows[0].clearance"),
        ("rows[0].ball_diameter", 0.02, "rows[0].ball_diameter"),
        ("rows[0].outer_conformity", 0.5, "rows[0].outer_conformity"),
        ("rows[2].clearance", 0.0, "rows[2].clearance"),
        ("loads.sideways.force", 1.0, "loads.sideways.force"),
        *[
            (
                "loads.axial.force",
                s.Spline(times=times, values=(1.0, 2.0)[: len(times)], rates=rates),
                f"loads.axial.force.spline{field}",
            )
            for times, rates, field in [
                ((0.0, 1.0), (0.0,), ""),
                ((0.0, 0.0), (0.0, 0.0), ".times[1]"),
                ((0.0,), (math.inf,), ".rates[0]"),
                ((0.0, 1.0), (1e14, 1e14), ""),
            ]
        ],
        *[(place, s.Given(motion), f"{place}.given") for place, motion in LED],
        ("rows[0].ball_support.x", s.Given(0.0), "rows[0].ball_support"),
        ("defects.spall.length", 0.1, "defects.spall.length"),
        ("contact.slices", s.FittedSlices(1), "contact.slices.fitted"),
        ("drive", "full speed ahead", "drive"),
        ("gravity", object(), "gravity"),
    ],
)
def test_errors_name_the_field(wheel: s.Scene, path: str, value: object, named: str) -> None:
    with pytest.raises(br.SceneError) as caught:
        wheel.replace({path: value})
    assert caught.value.path.startswith(named)


@pytest.mark.parametrize(
    ("changes", "named", "allowed"),
    [
        ({"on": "outer_race", "ball": None}, "shape", "absent for a defect on a race"),
        ({"length": 1e-3}, "length", "as long as it is wide"),
        ({"width": s.WidthProfile(positions=(0.0,), widths=(1e-3,))}, "width", "one number"),
        ({"width": 6e-3}, "width", "below the ball's radius"),
        ({"edge_radius": 3e-3}, "edge_radius", "below half the ball's radius"),
        ({"axial_offset": 7e-3}, "axial_offset", "a place on the ball"),
        ({"shape": "cup"}, "shape", "cap"),
        ({"shape": None}, "length", "above 0"),
    ],
)
def test_a_cap_is_refused_by_the_field(
    wheel: s.Scene, changes: dict[str, Any], named: str, allowed: str
) -> None:
    cap = br.defects.cap(width_mm=1.0, ball=2)
    whole = dataclasses.replace(wheel, defects={"pit": cap})
    assert s.Scene.from_json(whole.to_json()) == whole
    assert s.Scene.from_toml(whole.to_toml()) == whole
    document = whole.to_dict()["defects"]["pit"]
    assert (document["shape"], document["length"]) == ("cap", 0.0)
    with pytest.raises(br.SceneError, match=allowed) as caught:
        whole.replace({f"defects.pit.{field}": value for field, value in changes.items()})
    assert caught.value.path == f"defects.pit.{named}"


def test_a_defect_is_the_kind_that_its_fields_say() -> None:
    """As documents of schema 1 have them, which older programs write."""
    place: dict[str, Any] = {"on": "ball", "ball": 2, "angle": 0.3}
    sizes = {"length": 2e-3, "width": 1e-3}
    cases: list[tuple[dict[str, Any], type[s.Defect]]] = [
        ({**sizes, "edge_radius": 3e-4}, s.Patch),
        ({**sizes, "edge_radius": 3e-4, "shape": None, "walls": None, "floor": None}, s.Patch),
        ({**sizes, "walls": "steep"}, s.SteepPatch),
        ({"width": 1e-3, "edge_radius": 3e-4, "shape": "cap", "length": 0.0}, s.Cap),
        ({"width": 2e-4, "shape": "pit", "edge_radius": 0.0}, s.Pit),
        ({"width": 2e-4, "shape": "dent", "depth": 8e-6, "rim_height": 4e-7}, s.Dent),
    ]
    for fields, kind in cases:
        defect = s.Defect(**place, **fields)
        assert isinstance(defect, kind)
        assert defect == kind(**place, **{k: v for k, v in fields.items() if k in own(kind)})
        assert copy.copy(pickle.loads(pickle.dumps(defect))) == defect
        document = defect.to_dict()
        assert all(document.get(key) == value for key, value in fields.items())
    with pytest.raises(br.SceneError, match=r"edge_radius = 0\.0003: left out"):
        s.Defect(**place, width=2e-4, shape="pit", edge_radius=3e-4)
    with pytest.raises(br.SceneError, match="shape = 'cup': left out, or cap or dent or pit"):
        s.Defect(**place, width=2e-4, shape="cup")


def own(kind: type[s.Defect]) -> set[str]:
    return {field.name for field in dataclasses.fields(kind)}


def test_a_defect_given_alone_has_the_name_of_its_shape() -> None:
    for defect, name in [
        (br.defects.spall(on="outer_race", width_mm=1.0), "spall"),
        (br.defects.spall(on="outer_race", width_mm=1.0, walls="steep"), "spall"),
        (br.defects.cap(width_mm=1.0), "cap"),
        (br.defects.pit(on="outer_race", diameter_mm=0.2), "pit"),
        (br.defects.dent(on="outer_race", diameter_mm=0.2), "dent"),
    ]:
        scene = br.bearing("6205", radial_load=500.0, defects=defect, speed_rpm=1800.0)
        assert list(scene.defects) == [name]
    # The name of before is told; a document that has it keeps it.
    with pytest.raises(br.SceneError, match="defect given alone is named by its shape"):
        scene.replace({"defects.defect.width": 1e-4})
    older = scene.replace({"defects": {"defect": scene.defects["dent"]}})
    assert older.replace({"defects.defect.width": 1e-4}).defects["defect"].width == 1e-4


def test_documents_of_patches_do_not_name_shapes(wheel: s.Scene) -> None:
    assert "shape" not in wheel.to_dict()["defects"]["spall"]
    assert "shape" not in wheel.to_json()


def test_a_spall_between_steep_walls_is_placed_with_its_numbers() -> None:
    """Half a contact's width wider, and circles of a quarter of the ball's diameter."""
    spall = br.defects.spall(on="outer_race", width_mm=0.8, walls="steep")
    scene = br.bearing("6205", radial_load=500.0, defects=spall, speed_rpm=1800.0)
    assert s.Scene.from_toml(scene.to_toml()) == scene
    assert scene.to_dict()["defects"]["spall"]["walls"] == "steep"
    out = br.simulate(scene, duration=0.01)
    placed, met = out.scene.defects["spall"], out.defects["spall"]
    assert placed.walls is None
    assert placed.edge_radius == pytest.approx(7.94e-3 / 4.0, rel=1e-12)
    # The run's heaviest contact is not quite that at rest.
    assert met.contact_width is not None
    assert placed.width == pytest.approx(0.8e-3 + met.contact_width / 2.0, rel=0.05)
    assert "walls" not in out.scene.to_dict()["defects"]["spall"]
    rolled = br.defects.spall(on="outer_race", width_mm=0.8)
    assert (rolled.edge_radius, rolled.walls) == (0.3e-3, None)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"walls": "sheer"}, "walls = 'sheer': 'rolled' or 'steep'"),
        ({"walls": "steep", "edge_radius_mm": 0.3}, r"edge_radius_mm = 0\.3: left out"),
        ({"edge_radius_mm": -0.3}, "edge_radius_mm"),
    ],
)
def test_walls_are_refused_by_the_field(given: dict[str, Any], message: str) -> None:
    with pytest.raises(br.SceneError, match=message):
        br.defects.spall(on="outer_race", width_mm=1.0, **given)


def test_parts_cannot_be_changed(wheel: s.Scene) -> None:
    with pytest.raises(dataclasses.FrozenInstanceError):
        wheel.name = "other"  # type: ignore[misc]
    with pytest.raises(TypeError):
        wheel.loads["x"] = wheel.loads["axial"]  # type: ignore[index]


def test_lists_dicts_and_arrays_are_taken_in() -> None:
    loads = {"a": s.Load(ring="inner", direction=np.array([0.0, 0.0, 1.0]), force=np.float64(1.0))}  # type: ignore[arg-type]
    drive = s.SpeedDrive(np.int64(9))  # type: ignore[arg-type]
    scene = s.Scene(rows=[MINIMAL], inner_ring=s.Ring(mass=1.0), drive=drive, loads=loads)  # type: ignore[arg-type]
    loads.clear()
    assert scene.validate() == scene
    assert encode(scene.loads["a"], "") == {
        "ring": "inner",
        "direction": [0.0, 0.0, 1.0],
        "force": 1.0,
    }


def test_load_reads_files(tmp_path: Any, wheel: s.Scene) -> None:
    (tmp_path / "a.toml").write_text(wheel.to_toml())
    (tmp_path / "a.json").write_text(wheel.to_json())
    (tmp_path / "b.toml").write_bytes(b"\xff\xfe\x00")
    assert s.Scene.load(tmp_path / "a.toml") == s.Scene.load(tmp_path / "a.json") == wheel
    with pytest.raises(br.SceneError, match=r"\.toml or \.json"):
        s.Scene.load(tmp_path / "a.yaml")
    with pytest.raises(br.SceneError, match="UTF-8"):
        s.Scene.load(tmp_path / "b.toml")
    with pytest.raises(FileNotFoundError):
        s.Scene.load(tmp_path / "c.toml")


def test_repr_says_what_there_is(wheel: s.Scene) -> None:
    assert repr(wheel) == (
        "<Scene 'wheel bearing': 13 + 13 balls; loads: axial 3000 N, radial 7000 N; "
        "defects: spall; probes: inner, outer>"
    )


@pytest.mark.parametrize(
    "text", [".".join(["a"] * 16_000) + " = 1", "[" + "a . " * 99 + "a]", "a = " + "[" * 9999]
)
def test_no_depth_of_a_document_takes_long_or_recurs(text: str) -> None:
    """16 000 parts took 12 s."""
    with pytest.raises(br.SceneError, match="not TOML"):
        s.Scene.from_toml(text)


def test_equal_scenes_have_one_hash() -> None:
    """Truth: what ``functools.lru_cache`` asks of its arguments; the order of loads says nothing."""
    scene = br.bearing("6205", radial_load=500.0, axial_load=100.0, speed_rpm=1500.0)
    again = br.Scene.from_json(scene.to_json())
    turned = dataclasses.replace(scene, loads=dict(reversed(list(scene.loads.items()))))
    assert len({scene, again, turned}) == 1
    assert len({scene, scene.replace({"name": "another"})}) == 2
