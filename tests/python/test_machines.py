"""Rigid shafts on several bearings: statics in closed form, preload, and each bearing's lines in one spectrum."""

from __future__ import annotations

import math
import re
from collections.abc import Callable

import numpy as np
import pytest
from scipy.optimize import brentq

import ballrace as br
from ballrace.machines import Reaction, belt, force, gear, reactions

SPAN, OVERHANG = 0.25, 0.08
BEARINGS = [("6309/C3", 0.0), ("6207/C3", SPAN)]


def motor(**loads: br.scene.Load) -> br.Scene:
    return br.shaft(BEARINGS, speed_rpm=1480.0, masses=[(25.0, 0.125, 0.15)], loads=loads)


def weight(made: br.Scene) -> tuple[float, float]:
    ring = made.inner_ring
    assert ring.mass is not None
    assert ring.centre_of_mass is not None
    return 9.81 * ring.mass, ring.centre_of_mass


def test_reactions_are_those_of_a_beam() -> None:
    """Analytic: R₂ L = F a + W b + M₁ + M₂ and R₁ = F + W - R₂; with moments left out, the lever rule."""
    made = motor(belt=belt(900.0, at=-OVERHANG))
    load, place = weight(made)
    first, second = reactions(made)
    # Moments about x: of -F at z it is F z, of a reaction at z -R z.
    held = first.moment[0] + second.moment[0]
    right = (load * place - 900.0 * OVERHANG + held) / SPAN
    # The shaft tilts by 1e-4, and places move by their share of it.
    assert second.force[1] == pytest.approx(right, rel=1e-4)
    assert first.force[1] + second.force[1] == pytest.approx(900.0 + load, rel=1e-6)
    assert first.force[1] == pytest.approx(
        900.0 + load - (load * place - 900.0 * OVERHANG) / SPAN, rel=1e-3
    )
    assert abs(first.force[0] + second.force[0]) < 1e-6 * load


def test_forces_and_moments_balance_in_space() -> None:
    """Analytic: all sums are 0 to 1e-6 of the loads, wherever they act, about the displaced centre of mass."""
    made = motor(
        belt=belt(900.0, at=-OVERHANG, angle=0.3),
        impeller=force(y=-200.0, z=-400.0, at=0.33),
        top=br.scene.Load(ring="inner", direction=(1.0, 0.0, 0.0), force=50.0, at=(0.0, 0.04, 0.1)),
    )
    found = br.equilibrium(made)
    load, place = weight(made)
    tilt = np.array([*found.inner_tilt, 0.0])
    turn = np.eye(3) + np.array([[0, 0, tilt[1]], [0, 0, -tilt[0]], [-tilt[1], tilt[0], 0]])
    total, about = np.array([0.0, -load, 0.0]), np.zeros(3)
    for each in reactions(made):
        total += each.force
        about += each.moment + np.cross(turn @ [0.0, 0.0, each.at - place], each.force)
    for pull in made.loads.values():
        assert isinstance(pull.force, float)
        assert pull.at is not None
        push = pull.force * np.array(pull.direction)
        total += push
        about += np.cross(turn @ (np.array(pull.at) - [0.0, 0.0, place]), push)
    np.testing.assert_allclose(total, 0.0, atol=1e-6 * 900.0)
    np.testing.assert_allclose(about[:2], 0.0, atol=1e-6 * 900.0 * SPAN)


def test_a_mesh_is_a_torque_with_what_follows_from_the_teeth() -> None:
    """Analytic: 2 T/d along the circle, tan α_n/cos β of it away from the mesh, tan β along the axis."""
    helix, alpha = 0.2, math.radians(20.0)
    mesh = gear(-40.0, 0.08, at=0.3, angle=0.7, helix_angle=helix)
    assert isinstance(mesh.force, float)
    assert mesh.at is not None
    push = mesh.force * np.array(mesh.direction)
    outward, along = (
        np.array([math.cos(0.7), math.sin(0.7), 0.0]),
        np.array([-math.sin(0.7), math.cos(0.7), 0.0]),
    )
    assert np.cross(mesh.at, push)[2] == pytest.approx(-40.0)
    assert push @ along == pytest.approx(-1000.0)
    assert push @ outward == pytest.approx(-1000.0 * math.tan(alpha) / math.cos(helix))
    assert push[2] == pytest.approx(1000.0 * math.tan(helix))


@pytest.mark.parametrize("arrangement", ["back_to_back", "face_to_face"])
def test_preload_is_the_axial_force_of_each(arrangement: br.machines.Arrangement) -> None:
    made = br.pair(
        "7208B", arrangement=arrangement, preload=500.0, radial_load=0.0, speed_rpm=1500.0
    )
    still = made.replace({"gravity": [0.0, 0.0, 0.0], "drive.speed": 10.0})
    forces = [float(each.force[2]) for each in reactions(still)]
    side = -1.0 if arrangement == "back_to_back" else 1.0
    assert forces == pytest.approx([side * 500.0, -side * 500.0], rel=1e-3)


def test_preload_presses_as_hertz_and_jones_say() -> None:
    """Analytic: F = Z K δ^1.5 sin α', (A + δ) cos α' = A cos α, A of the grooves, way A (cos α tan α' - sin α)."""
    row = br.pair("7208B", preload=800.0, speed_rpm=1500.0).rows[0]
    A = (row.outer_conformity + row.inner_conformity - 1.0) * row.ball_diameter
    alpha = row.contact_angle
    shallow = br.equilibrium(
        br.bearing(
            "7208B", radial_load=0.0, axial_load=800.0, speed_rpm=100.0, housing=None
        ).replace({"gravity": [0.0, 0.0, 0.0]})
    )
    # Hertz's constant of both contacts from one loaded ball, then Jones' geometry alone.
    delta = float(shallow.outer_deflection[0] + shallow.inner_deflection[0])
    stiffness = float(shallow.inner_load[0]) / delta**1.5

    def missing(turned: float) -> float:
        pressed = A * (math.cos(alpha) / math.cos(turned) - 1.0)
        return float(row.ball_count * stiffness * pressed**1.5 * math.sin(turned) - 800.0)

    turned = brentq(missing, alpha + 1e-9, alpha + 0.2)
    way = A * (math.cos(alpha) * math.tan(turned) - math.sin(alpha))
    assert row.axial_preload == pytest.approx(way, rel=1e-3)


def stiff(made: br.Scene) -> float:
    """Tilt of a shaft under a load beside the pair."""
    return abs(float(br.equilibrium(made).inner_tilt[0]))


def test_back_to_back_is_stiff_against_tilting() -> None:
    tilts = [
        stiff(
            br.pair(
                "7208B", arrangement=a, preload=500.0, radial_load=300.0, at=0.06, speed_rpm=1500.0
            )
        )
        for a in ("back_to_back", "face_to_face")
    ]
    assert 2.0 * tilts[0] < tilts[1]


def test_a_tandem_shares_thrust_and_needs_it() -> None:
    made = br.pair(
        "7208B", arrangement="tandem", radial_load=0.0, axial_load=3000.0, speed_rpm=1500.0
    )
    forces = [each.force[2] for each in reactions(made)]
    assert forces == pytest.approx([-1500.0, -1500.0], rel=0.01)
    with pytest.raises(br.SceneError, match=r"above 839\.1 N, in tandem"):
        br.pair(
            "7208B", arrangement="tandem", radial_load=1000.0, axial_load=500.0, speed_rpm=1500.0
        )


def test_bearings_of_two_rows_and_named_sides_are_rows_of_the_scene() -> None:
    made = br.shaft([("3206", 0.0), ("6204", 0.2)], speed_rpm=1500.0)
    assert [round(row.axial_position, 4) for row in made.rows] == [-0.0051, 0.0051, 0.2]
    steep = br.shaft(
        [("7208B", 0.0, -1), ("7208B", 0.1, 1)],
        loads={"z": force(z=500.0, at=0.0)},
        speed_rpm=1500.0,
    )
    assert [row.side for row in steep.rows] == [-1, 1]
    assert made.name == "3206 + 6204"
    assert made.doubts() == ()


def test_the_shaft_and_what_sits_on_it() -> None:
    """Analytic: a cylinder of the smaller bore, and a disc beside its middle."""
    ring = br.shaft(
        [("6206", -0.1), ("6206", 0.1)], masses=[(5.0, 0.05, 0.2)], speed_rpm=1500.0
    ).inner_ring
    bar = 7850.0 * math.pi / 4.0 * 30e-3**2 * 0.2
    centre = 5.0 * 0.05 / (5.0 + bar)
    across = bar * (30e-3**2 / 16.0 + 0.2**2 / 12.0 + centre**2) + 5.0 * (
        0.2**2 / 16.0 + (0.05 - centre) ** 2
    )
    assert ring.mass == pytest.approx(5.0 + bar)
    assert ring.centre_of_mass == pytest.approx(centre)
    assert ring.transverse_inertia == pytest.approx(across)
    assert ring.inertia == pytest.approx(5.0 * 0.2**2 / 8.0 + bar * 30e-3**2 / 8.0)


def test_each_bearing_has_its_lines_in_one_spectrum() -> None:
    """Analytic: a spall of either outer race gives the line at its own bearing's rate."""
    spalls = {
        "near": br.defects.spall(on="outer_race", width_mm=1.5, row=0),
        "far": br.defects.spall(on="outer_race", width_mm=1.5, row=1, angle=math.pi / 2.0),
    }
    made = br.shaft(
        BEARINGS,
        speed_rpm=1480.0,
        masses=[(25.0, 0.125, 0.15)],
        loads={"belt": belt(2500.0, at=-OVERHANG)},
        defects=spalls,
    )
    out = br.simulate(made, duration=0.4)
    f, height = br.spectra.envelope_spectrum(out["outer.ay"], out.fs)
    rates = [br.fault_frequencies(made, row=row).bpfo for row in (0, 1)]
    assert rates[1] > 1.1 * rates[0]
    for rate in rates:
        strongest = f[(f > 0.93 * rate) & (f < 1.07 * rate)]
        near = height[(f > 0.93 * rate) & (f < 1.07 * rate)]
        assert strongest[np.argmax(near)] == pytest.approx(rate, rel=0.02)
        assert near.max() > 5.0 * np.median(height[(f > 50.0) & (f < 250.0)])


def test_the_motor_is_a_preset() -> None:
    made = br.presets.motor(belt_pull=600.0)
    assert made.name == "6309 + 6207"
    assert made.doubts() == ()
    assert "motor" in br.presets.names()
    out = br.simulate(made, duration=5e-3)
    assert out.warnings == ()
    assert np.abs(out["outer.ay"]).max() < 100.0
    assert isinstance(reactions(made)[0], Reaction)


@pytest.mark.parametrize(
    ("arguments", "field"),
    [
        ({"bearings": [("6309", 0.0)]}, "bearings"), ({"bearings": "6309"}, "bearings"),
        ({"bearings": [("6309", 0.0), ("6207", 0.0)]}, "bearings"),
        ({"bearings": [("6309", 0.0), ("6207", 0.25), ("6207", -0.015)]}, "bearings"),
        ({"bearings": [("6309", 0.0), 3.0]}, "bearings"),
        ({"bearings": [("6309", 0.0), ("6207", math.nan)]}, "bearings"),
        ({"bearings": [("6309", 0.0, 1), ("6207", 0.2)]}, "bearings"),
        ({"bearings": [("7208B", 0.0), ("7208B", 0.2, 1)]}, "bearings"),
        ({"bearings": [("6309", 0.0), (6207, 0.2)]}, "bearings"),
        ({"bearings": [("6309", 0.0), ("NU207", 0.2)]}, "designation"), ({"speed_rpm": math.inf}, "speed_rpm"),
        ({"masses": [(0.0, 0.1)]}, "masses"), ({"masses": [25.0]}, "masses"),
        ({"masses": [(1.0, 0.1, -1.0)]}, "masses"),
        ({"unbalances": [(1e-6,)]}, "unbalances"), ({"unbalances": [("a", 0.1)]}, "unbalances"),
        ({"housing": "stool"}, "housing"),
        ({"loads": 3.0}, "loads"), ({"loads": [force(y=1.0, at=0.0)]}, "loads"),
        ({"loads": {1: force(y=1.0, at=0.0)}}, "loads"), ({"loads": {"a": 900.0}}, "loads.a"),
        ({"loads": {"a": br.scene.Moment(ring="inner", direction=(1, 0, 0), moment=1.0)}}, "loads.a"),
        ({"loads": {"a b": force(y=1.0, at=0.0)}}, 'loads."a b"'),
        ({"loads": {"a": br.scene.Load(ring="inner", direction=(0, 1, 0), force=math.nan)}}, "loads.a.force"),
        ({"loads": {"a": br.scene.Load(ring="shaft", direction=(0, 1, 0), force=1.0)}}, "loads.a.ring"),  # type: ignore[arg-type]
        ({"loads": {"a": br.scene.Load(ring="inner", direction=(0, 1), force=1.0)}}, "loads.a.direction"),  # type: ignore[arg-type]
        ({"loads": {"a": br.scene.Load(ring="inner", direction=(0, 1, 0), force=1.0, at=0.1)}}, "loads.a.at"),  # type: ignore[arg-type]
        ({"defects": 1.0}, "defects"), ({"defects": {"a": "spall"}}, "defects.a"),
        ({"speed": 100.0}, "speed"), ({"radial_load": 100.0}, "radial_load"),
    ],
)  # fmt: skip
def test_a_shaft_names_what_is_wrong(arguments: dict[str, object], field: str) -> None:
    good: dict[str, object] = {"bearings": BEARINGS, "speed_rpm": 1500.0}
    with pytest.raises(br.SceneError) as refused:
        br.shaft(**(good | arguments))  # type: ignore[arg-type]
    assert refused.value.path == field


def test_bearings_side_by_side_touch_and_do_not_overlap() -> None:
    """By the widths of ISO 15: a 6309 has 25 mm, a 6207 17 mm; 21 mm from middle to middle they touch."""
    assert len(br.shaft([("6207", 0.1), ("6309", 0.1 + 0.021)], speed_rpm=1500.0).rows) == 2
    allowed = r"^bearings = 6207 at 0\.1 m, 6309 at 0\.12 m: places 0\.021 m apart or more"
    with pytest.raises(br.SceneError, match=allowed):
        br.shaft([("6309", 0.12), ("6207", 0.1)], speed_rpm=1500.0)


def test_one_defect_of_a_shaft_needs_no_name() -> None:
    spall = br.defects.spall(on="inner_race", width_mm=1.0, row=1)
    assert dict(br.shaft(BEARINGS, defects=spall, speed_rpm=1500.0).defects)["spall"].row == 1


def test_reactions_are_of_a_scene() -> None:
    with pytest.raises(br.SceneError, match=r"^scene = '6205': a Scene"):
        reactions("6205")  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("arguments", "field"),
    [
        ({"name": "6205"}, "name"), ({"name": "3206"}, "name"), ({"arrangement": "O"}, "arrangement"),
        ({"preload": -1.0}, "preload"),
        ({"preload": 10.0, "arrangement": "tandem"}, "preload"), ({"radial_load": -1.0}, "radial_load"),
        ({"at": math.nan}, "at"),
        ({"axial_load": math.inf}, "axial_load"), ({"load": 1.0}, "load"), ({"rpm": 1.0}, "rpm"),
    ],
)  # fmt: skip
def test_a_pair_names_what_is_wrong(arguments: dict[str, object], field: str) -> None:
    good: dict[str, object] = {"name": "7208B"}
    with pytest.raises(br.SceneError) as refused:
        br.pair(**(good | arguments))  # type: ignore[arg-type]
    assert refused.value.path == field


def test_loads_name_what_is_wrong() -> None:
    wrong: list[tuple[Callable[[], br.scene.Load], str]] = [
        (lambda: force(at=0.0), "force"),
        (lambda: force(y=math.nan, at=0.0), "y"),
        (lambda: force(y=1.0, at=math.inf), "at"),
        (lambda: belt(0.0, at=0.0), "pull"),
        (lambda: gear(0.0, 0.1, at=0.0), "torque"),
        (lambda: gear(1.0, -0.1, at=0.0), "pitch_diameter"),
        (lambda: gear(1.0, 0.1, at=0.0, helix_angle=1.2), "helix_angle"),
    ]
    for make, field in wrong:
        with pytest.raises(br.SceneError, match=rf"^{re.escape(field)} = "):
            make()
