"""The catalogue against load ratings and geometry, and scenes of its bearings.

The ratings are formulas of the balls (D, Z, pitch diameter, contact angle), so printed ones tell of them: ISO 76,
``C₀ = f₀ Z D² cos α`` with f₀ from Hertz's pressure of 4.2 GPa on grooves of 0.52 and 0.53, here computed by the
slow reference; ISO 281, ``C = 1.3 f_c (cos α)^0.7 Z^(2/3) D^1.8`` in mm, with the table of f_c for one row.
"""

from __future__ import annotations

import math
import pickle
from dataclasses import replace
from typing import Literal

import numpy as np
import pytest
from scipy.special import ellipe, ellipkm1

import ballrace as br
from ballrace.bearings.clearance import radial_clearance
from ballrace.load_rating import FC
from reference import hertz

ROWS = list(br.catalogue.values())
STEEL = {"density": 7850.0, "youngs_modulus": 207e9, "poisson_ratio": 0.3}


def f0(gamma: float) -> float:
    """Factor of ISO 76 [N/mm²]: a fifth of the ball load over D² at 4.2 GPa, on the worse race."""
    found = []
    for ring, conformity in ((0, "outer_conformity"), (1, "inner_conformity")):
        row = {"ball_diameter": 0.01, "pitch_diameter": 0.01 / gamma, "contact_angle": 0.0}
        row |= {"outer_conformity": 0.53, "inner_conformity": 0.52}
        c_a = hertz(row, ring, {"rings": STEEL, "balls": STEEL}).c_a
        # p = 3 F/(2 π a b), a = c_a F^(1/3); b/a from the curvatures as the reference finds it.
        ratio = axes(row[conformity], gamma, ring)
        load = (4.2e9 * 2.0 * math.pi * c_a**2 * ratio / 3.0) ** 3
        found.append(0.2 * load / 1e-4 * 1e-6)
    return min(found)


def axes(conformity: float, gamma: float, ring: int) -> float:
    """Ratio b/a of the ellipse of contact, by bisection of Hertz's condition."""
    long = 1.0 - 0.5 / conformity
    rolling = 1.0 - gamma / (1.0 + gamma) if ring == 0 else 1.0 + gamma / (1.0 - gamma)
    low, high = 1e-4, 1.0 - 1e-9
    for _ in range(80):
        k = 0.5 * (low + high)
        K, E = float(ellipkm1(k * k)), float(ellipe(1.0 - k * k))
        low, high = (k, high) if (E / k**2 - K) / (K - E) > rolling / long else (low, k)
    return k


@pytest.mark.parametrize(("gamma", "wanted"), [(0.05, 15.7), (0.1, 16.4), (0.2, 14.0), (0.3, 11.6)])
def test_the_factor_is_that_of_the_table_of_iso_76(gamma: float, wanted: float) -> None:
    assert f0(gamma) == pytest.approx(wanted, rel=5e-3)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.designation)
def test_balls_have_the_printed_static_rating(row: br.Bearing) -> None:
    gamma = row.ball_diameter * math.cos(row.contact_angle) / row.pitch_diameter
    area = row.ball_count * (1e3 * row.ball_diameter) ** 2 * math.cos(row.contact_angle)
    assert f0(gamma) * area == pytest.approx(row.static_rating, rel=0.022)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.designation)
def test_balls_have_the_printed_dynamic_rating(row: br.Bearing) -> None:
    gamma = row.ball_diameter * math.cos(row.contact_angle) / row.pitch_diameter
    fc = np.interp(gamma, 0.01 * np.arange(1, 41), FC)
    size = (
        math.cos(row.contact_angle) ** 0.7
        * row.ball_count ** (2 / 3)
        * (1e3 * row.ball_diameter) ** 1.8
    )
    # The 6804 and the UER204 as their data sets print them.
    assert 1.3 * fc * size == pytest.approx(row.dynamic_rating, rel=0.015)


def test_one_ball_more_or_less_has_not() -> None:
    """So the ratings do tell of the balls: with the next standard diameter either rating is off."""
    row = br.catalogue["6308"]
    gamma = row.ball_diameter / row.pitch_diameter
    assert abs(f0(gamma) * 7 * (1e3 * row.ball_diameter) ** 2 / row.static_rating - 1.0) > 0.1


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.designation)
def test_geometry_is_possible(row: br.Bearing) -> None:
    mean = 0.5 * (row.bore + row.outside_diameter)
    assert 0.98 < row.pitch_diameter / mean < 1.04
    # A cage's bar fits between balls.
    chord = row.pitch_diameter * math.sin(math.pi / row.ball_count)
    assert chord > 1.08 * row.ball_diameter
    # Rings have a wall under the ball of at least an eighth of its diameter.
    wall = 0.5 * (row.outside_diameter - row.bore)
    assert row.bore + 0.25 * row.ball_diameter < row.pitch_diameter - row.ball_diameter
    assert row.pitch_diameter + row.ball_diameter < row.outside_diameter - 0.25 * row.ball_diameter
    assert row.ball_diameter < min(wall, row.width)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.designation)
def test_every_number_has_a_source(row: br.Bearing) -> None:
    assert all(vars(row.sources).values())
    # Standard balls where they are worked out: whole 64ths of an inch.
    if row.sources.balls.startswith("estimated"):
        steps = row.ball_diameter / 25.4e-3 * 64.0
        assert steps == pytest.approx(round(steps), abs=2e-3)


@pytest.mark.parametrize(
    ("name", "orders"),
    [
        (
            "6205",
            {"bpfo": 3.5848, "bpfi": 5.4152, "ftf": 0.39828},
        ),  # Case Western Reserve, drive end
        ("ER-16K", {"bpfo": 3.572, "bpfi": 5.43}),  # SpectraQuest
        ("UER204", {"bpfo": 3.0831, "bpfi": 4.9169}),  # XJTU-SY: 107.91 and 172.09 Hz at 35 Hz
        ("6203", {"bpfo": 3.0543, "bpfi": 4.9457}),  # raceways of 24.0 and 33.1 mm, Paderborn
    ],
)
def test_data_set_bearings_have_their_published_orders(name: str, orders: dict[str, float]) -> None:
    found = br.catalogue[name].orders
    for key, wanted in orders.items():
        assert getattr(found, key) == pytest.approx(wanted, rel=6e-4)


# ------------------------------------------------------------------------------- names


@pytest.mark.parametrize(
    ("name", "designation"),
    [
        ("6205", "6205"), ("SKF 6205-2RS JEM", "6205"), ("6205 2Z/C3", "6205"), ("nsk 6205ddu", "6205"),
        ("6205-2RSH", "6205"), ("LDK UER204", "UER204"), ("MB ER-16K", "ER-16K"), ("er16k", "ER-16K"),
        ("7205 BEP", "7205B"), ("7205-B", "7205B"), ("7205 AC", "7205A5"), ("SKF 7205 ACD", "7205A5"),
        ("7205CD", "7205C"),
    ],
)  # fmt: skip
def test_designations_with_makers_and_seals(name: str, designation: str) -> None:
    assert br.catalogue[name].designation == designation
    assert name in br.catalogue


@pytest.mark.parametrize(
    ("name", "near"),
    [
        ("6299", "6209"),
        ("7205", "7205A5, 7205B, 7205C"),
        ("6205 ETN9", "6205"),
        ("", "from 6000 on"),
    ],
)
def test_an_unknown_name_says_what_is_near(name: str, near: str) -> None:
    with pytest.raises(br.SceneError) as refused:
        br.catalogue[name]
    assert (refused.value.path, refused.value.value) == ("designation", repr(name))
    assert near in refused.value.allowed
    assert name not in br.catalogue
    assert br.catalogue.get(name) is None


def test_a_bearing_and_its_error_go_to_other_processes() -> None:
    row = br.catalogue["6205"]
    again = pickle.loads(pickle.dumps(row))
    assert again == row
    assert hash(again) == hash(row)
    with pytest.raises(br.SceneError) as refused:
        br.bearing("6299")
    error = pickle.loads(pickle.dumps(refused.value))
    assert str(error) == str(refused.value)


def test_find_and_tables() -> None:
    assert len(br.catalogue) >= 50
    assert [row.designation for row in br.catalogue.find(kind="deep_groove", bore=25e-3)] == [
        "6005",
        "6205",
        "6305",
    ]
    with pytest.raises(br.SceneError, match="kind"):
        br.catalogue.find(kind="roller")  # type: ignore[arg-type]
    table = br.catalogue.to_polars()
    assert table.height == len(br.catalogue)
    assert table.filter(designation="6205")["ball_diameter"].item() == 7.94e-3
    angles = {
        round(math.degrees(row.contact_angle)) for row in br.catalogue.find(kind="angular_contact")
    }
    assert angles == {15, 25, 40}


# ------------------------------------------------------------------------------- scenes


@pytest.mark.parametrize("name", list(br.catalogue))
def test_every_bearing_carries_a_tenth_of_its_rating(name: str) -> None:
    scene = br.bearing(name)
    assert scene.doubts() == ()
    found = br.equilibrium(scene)
    # Of a bearing whose rating stands for 4.2 GPa: p ∝ F^(1/3), clearance and thrust move it.
    assert found.inner_pressure.max() == pytest.approx(4.2e9 * 0.1 ** (1.0 / 3.0), rel=0.25)
    assert found.residual_share < 1e-4


def test_the_rating_is_that_of_the_model() -> None:
    """At C₀ a ball carries 5/Z of it by ISO 76, and 4.37/Z by exact statics of half a zone (Sjövall)."""
    made = br.catalogue["6308"]
    scene = br.bearing(made, radial_load=made.static_rating, speed_rpm=1e-3, clearance=0.0)
    pressure = br.equilibrium(scene).inner_pressure.max()
    assert pressure == pytest.approx(4.2e9 * (4.37 / 5.0) ** (1.0 / 3.0), rel=0.01)


def test_its_bare_ring_is_built_as_the_preset() -> None:
    made = br.bearing("6205", radial_load=500.0, housing=None)
    preset = br.presets.deep_groove_6205()
    assert (made.cage, made.friction, made.contact) == (
        preset.cage,
        preset.friction,
        preset.contact,
    )
    for ring in ("outer_ring", "inner_ring"):
        ours, theirs = getattr(made, ring), getattr(preset, ring)
        assert (ours.diameter, ours.width, ours.mass) == pytest.approx(
            (theirs.diameter, theirs.width, theirs.mass), nan_ok=True
        )
        assert ours.support.x == theirs.support.x
    row = replace(made.rows[0], outer_conformity=0.525, inner_conformity=0.515, clearance=10e-6)
    assert replace(row, start_angle=0.0) == replace(preset.rows[0], start_angle=0.0)


def test_by_default_it_sits_in_a_pillow_block() -> None:
    """Literature: a unit UCP205 has 0.8 kg. Analytic: 1 kHz and 3 % of one mass on its mount, of any size."""
    assert br.bearing("6205").outer_ring.mass == pytest.approx(0.8)
    for name in br.catalogue:
        ring = br.bearing(name).outer_ring
        mount = ring.support.y
        assert isinstance(mount, br.scene.Spring)
        assert ring.mass is not None
        assert ring.support == br.scene.Support(x=mount, y=mount, z=mount)
        assert ring.mass / br.catalogue[name].outside_diameter ** 3 == pytest.approx(0.8 / 52e-3**3)
        omega = math.sqrt(mount.stiffness / ring.mass)
        assert omega == pytest.approx(2000.0 * math.pi)
        assert mount.damping / (2.0 * ring.mass * omega) == pytest.approx(0.03)


def test_a_housing_of_its_own_is_the_ring_of_the_scene() -> None:
    ring = br.bearing("6205", housing=br.Pedestal(mass=3.0, stiffness=2e8, damping=0.0)).outer_ring
    assert (ring.mass, ring.support.z) == (3.0, br.scene.Spring(stiffness=2e8, damping=0.0))


def test_load_decides_whether_damage_is_heard() -> None:
    """Limit: no ball carries load over a spall at the top; balls strike a bare ring, but a housing is heavy."""

    def rms(angle: float, housing: Literal["pedestal"] | None) -> float:
        spall = replace(br.defects.spall(on="outer_race", width_mm=1.0), angle=angle)
        scene = br.bearing("6205", radial_load=1500.0, defects=spall, housing=housing)
        return float(br.simulate(scene, duration=0.1)["outer.ay"].std())

    below, above = -math.pi / 2.0, math.pi / 2.0
    assert rms(below, "pedestal") > 15.0 * rms(above, "pedestal")
    assert rms(below, None) < 5.0 * rms(above, None)


@pytest.mark.parametrize("name", ["6000", "6310", "7205C", "7310B"])
def test_scenes_run(name: str) -> None:
    out = br.simulate(br.bearing(name), duration=5e-3)
    assert out.warnings == ()
    assert 0.0 < np.abs(out["outer.ay"]).max() < 1e3


def test_clearance_is_the_middle_of_its_class() -> None:
    assert br.bearing("6205").rows[0].clearance == pytest.approx(12.5e-6)
    assert br.bearing("6205", clearance="C3").rows[0].clearance == pytest.approx(20.5e-6)
    assert br.bearing("6205", clearance=3e-6).rows[0].clearance == 3e-6
    assert br.bearing("SKF 6205-2RS/C3").rows[0].clearance == pytest.approx(20.5e-6)
    assert br.bearing("6205 C3", clearance="C3").rows[0].clearance == pytest.approx(20.5e-6)
    assert br.bearing("7205 C").rows[0].clearance == 0.0
    with pytest.raises(br.SceneError, match="'C3', which '6205/C3' says"):
        br.bearing("6205/C3", clearance="C2")
    assert radial_clearance(10e-3, "CN") == pytest.approx(7.5e-6)
    with pytest.raises(br.SceneError, match="clearance"):
        br.bearing("6205", clearance="C9")
    with pytest.raises(br.SceneError, match="contact angle"):
        br.bearing("7205B", clearance="C3")


def test_angular_contact_bearings_want_thrust_their_way() -> None:
    alpha = math.radians(40.0)
    by_default = br.bearing("7205B", radial_load=1000.0)
    assert by_default.loads["axial"].force == pytest.approx(1220.0 * math.tan(alpha))
    # About half of the balls carry it.
    loads = br.equilibrium(br.bearing("7205B", radial_load=1000.0, speed_rpm=1.0)).inner_load
    assert 6 <= np.count_nonzero(loads > 1e-3 * loads.max()) <= 9
    for thrust in (0.0, -1000.0, 800.0):
        with pytest.raises(br.SceneError, match="come apart") as refused:
            br.bearing("7205B", radial_load=1000.0, axial_load=thrust)
        assert refused.value.path == "axial_load"
    assert (
        br.equilibrium(br.bearing("7205B", radial_load=0.0, axial_load=500.0)).inner_load.min()
        > 0.0
    )
    # A deep groove bearing takes it either way.
    for thrust in (-200.0, 200.0):
        br.equilibrium(br.bearing("6205", radial_load=300.0, axial_load=thrust))


@pytest.mark.parametrize(
    ("arguments", "field"),
    [
        ({"radial_load": -1.0}, "radial_load"),
        ({"axial_load": math.nan}, "axial_load"),
        ({"speed_rpm": math.inf}, "speed_rpm"),
        ({"clearance": math.nan}, "clearance"),
        ({"housing": 3.0}, "housing"),
    ],
)
def test_bad_arguments_are_named(arguments: dict[str, float], field: str) -> None:
    with pytest.raises(br.SceneError) as refused:
        br.bearing("6205", **arguments)  # type: ignore[arg-type]
    assert refused.value.path == field


@pytest.mark.parametrize("field", ["mass", "stiffness", "damping"])
def test_a_pedestal_names_what_is_wrong(field: str) -> None:
    good: dict[str, object] = {"mass": 1.0, "stiffness": 1e7, "damping": 1.0}
    for bad in (-1.0, math.nan, math.inf, "1", True):
        with pytest.raises(
            br.SceneError, match="from 0" if field == "damping" else "above 0"
        ) as refused:
            br.Pedestal(**(good | {field: bad}))  # type: ignore[arg-type]
        assert refused.value.path == f"housing.{field}"


SPALL = br.defects.spall(on="inner_race", width_mm=1.0)


@pytest.mark.parametrize(
    ("arguments", "field", "told"),
    [
        ({"defects": [SPALL, SPALL]}, "defects", r"several by their names, \{\"first\""),
        ({"defects": "inner_race"}, "defects", r"br\.defects\.spall\(on=\"inner_race\""),
        ({"defects": {"a": "inner_race"}}, "defects", r"br\.defects\.spall"),
        ({"speed": 1797.0}, "speed", r"speed_rpm, .* \[rev/min\]"),
        ({"d": 25e-3}, "d", r"br\.bearing\(\"6205\"\)"),
        ({"load": 1e3}, "load", "radial_load"),
        ({"radial_laod": 1e3}, "radial_laod", "write radial_load"),
        ({"housing": "none"}, "housing", r"\"pedestal\", None \(the bare ring\)"),
        ({"housing": br.measuring.random_housing(1)}, "housing", r"br\.measuring\.Chain"),
    ],
)
def test_what_people_write_is_refused_with_what_they_meant(
    arguments: dict[str, object], field: str, told: str
) -> None:
    with pytest.raises(br.SceneError, match=told) as refused:
        br.bearing("6205", **arguments)  # type: ignore[arg-type]
    assert refused.value.path == field
    with pytest.raises(br.SceneError, match="first argument"):
        br.bearing(d=25e-3)  # type: ignore[call-arg]
