"""Rating life against ISO 281, and against what the loads of the balls must give."""

from __future__ import annotations

import math

import numpy as np
import pytest

import ballrace as br
from ballrace.ratings.life_factor import _factor
from ballrace.ratings.load_rating import row_rating
from ballrace.scene import Moment, Ramp, Sine, SpeedDrive, Table


def deep(radial: float, axial: float = 0.0, clearance: float | str = "CN") -> br.Scene:
    return br.bearing(
        "6205", radial_load=radial, axial_load=axial, speed_rpm=1500.0, clearance=clearance
    )


def test_reference_life_is_the_basic_one_where_that_was_made_for() -> None:
    """Truth: ISO 281 stands on half of the balls loaded, which is a bearing without clearance."""
    for radial in (700.0, 1400.0):
        life = br.rating_life(deep(radial, clearance=0.0))
        assert life.basic == pytest.approx(1e6 * (14_000.0 / radial) ** 3)
        assert life.reference == pytest.approx(life.basic, rel=0.06)
    loose, half, tight = (
        br.rating_life(deep(1400.0, clearance=c)).reference for c in (40e-6, 0.0, -4e-6)
    )
    assert loose < 0.85 * half < half < tight


def test_loads_that_are_known_are_taken() -> None:
    """Truth: the same life without them; those of twice the load shorten it, unless the load changes in time."""
    scene = deep(1400.0)
    once, twice = (br.load_distribution(deep(load)) for load in (1400.0, 2800.0))
    assert br.rating_life(scene, around=once) == br.rating_life(scene)
    assert br.rating_life(scene, around=twice).reference < 0.2 * br.rating_life(scene).reference
    swells = scene.replace(
        {"loads.radial.force": Sine(mean=1400.0, amplitude=100.0, frequency=2.0, phase=0.0)}
    )
    assert br.rating_life(swells, around=twice) == br.rating_life(swells)
    other = br.load_distribution(br.bearing("6206", radial_load=500.0, speed_rpm=1800.0))
    for wrong in (other, other.outer_load):
        with pytest.raises(br.SceneError, match=r"^around = "):
            br.rating_life(br.presets.motor(), around=wrong)  # type: ignore[arg-type]


def test_equivalent_load_of_iso_281() -> None:
    """Truth: its table, at a line of it and where thrust does not count."""
    relative = 0.689 * 9 * 7.94**2
    life = br.rating_life(deep(1000.0, relative))
    assert life.equivalent_load == pytest.approx(0.56 * 1000.0 + 1.71 * relative, rel=1e-6)
    assert br.rating_life(deep(1000.0, 150.0)).equivalent_load == pytest.approx(1000.0)
    assert br.rating_life(br.bearing("7205B", speed_rpm=1800.0)).equivalent_load is None
    assert br.rating_life(br.presets.wheel_bearing()).basic is None


def test_life_falls_with_the_cube_and_a_bit_more() -> None:
    """Truth: L10r goes with load^-3 where the loaded zone stays as it is."""
    scenes = [
        br.bearing("7210B", radial_load=f, axial_load=3.0 * f, speed_rpm=1800.0)
        for f in (1000.0, 2000.0)
    ]
    light, heavy = (br.rating_life(scene).reference for scene in scenes)
    assert light / heavy == pytest.approx(8.0, rel=0.05)


@pytest.mark.parametrize("name", ["6205", "6008", "6310", "7210B", "7205C"])
def test_the_formula_meets_the_catalogue(name: str) -> None:
    """Truth: the makers' printed ratings."""
    scene = br.bearing(name, speed_rpm=1800.0)
    printed = br.catalogue[name].dynamic_rating
    assert row_rating(scene.rows[0]) == pytest.approx(printed, rel=0.015)
    assert br.rating_life(scene).rating == printed
    renamed = br.rating_life(scene.replace({"name": "mine"}))
    assert renamed.source == "formula of ISO 281"


def test_two_rows_rate_as_iso_281_says() -> None:
    """Truth: i^0.7 of one; and both rows under the same load live as one under half of it, less 2^-0.1·…."""
    wheel = br.presets.wheel_bearing().replace({"defects": {}})
    life = br.rating_life(wheel)
    assert life.rating == pytest.approx(2.0**0.7 * row_rating(wheel.rows[0]))
    assert life.inner_ratings[0] == pytest.approx(life.inner_ratings[1])
    damage = [
        (np.array(loads) / np.array(ratings)) ** (10 / 3)
        for loads, ratings in (
            (life.outer_equivalent, life.outer_ratings),
            (life.inner_equivalent, life.inner_ratings),
        )
    ]
    assert life.reference == pytest.approx(1e6 * float(np.sum(damage)) ** -0.9)


def test_wide_grooves_are_rated_less() -> None:
    scene = br.bearing("6205", speed_rpm=1800.0).replace({"name": "wide"})
    wide = scene.replace({"rows[0].inner_conformity": 0.54})
    assert row_rating(wide.rows[0]) < 0.9 * row_rating(scene.rows[0])
    narrow = scene.replace({"rows[0].inner_conformity": 0.51})
    assert row_rating(narrow.rows[0]) == row_rating(scene.rows[0])


def test_defects_and_speeds() -> None:
    scene = deep(1400.0)
    faulty = scene.replace({"defects.d": br.defects.spall(on="outer_race", width_mm=1.0)})
    assert br.rating_life(faulty).reference == br.rating_life(scene).reference
    life = br.rating_life(scene, rating=7000.0)
    assert life.source == "given"
    assert life.basic == pytest.approx(125e6)
    assert life.hours(125e6) == pytest.approx(125e6 / 1500.0 / 60.0)


@pytest.mark.filterwarnings("ignore:loads.radial.force")
def test_under_next_to_no_load_it_lasts_for_ever() -> None:
    """Truth: the formula's limit; the cube of the ratio has no number."""
    scene = br.bearing("6205", radial_load=5.5e-279, speed_rpm=1800.0)
    assert br.rating_life(scene).basic == math.inf


def test_bad_arguments_are_named() -> None:
    for rating in (0.0, -1.0, math.nan, math.inf):
        with pytest.raises(br.SceneError, match="rating"):
            br.rating_life(deep(1400.0), rating=rating)
    with pytest.raises(br.SceneError, match="scene"):
        br.rating_life("6205")  # type: ignore[arg-type]


def test_lives_under_loads_that_change() -> None:
    """Truth: Miner's rule with the exponent 3 of ISO 281, integrated in closed form or by a thousand points."""
    steady = deep(500.0)
    swinging = Sine(mean=500.0, amplitude=2000.0, frequency=25.0, phase=0.3)
    life = br.rating_life(steady.replace({"loads.radial.force": swinging}))
    turn = np.linspace(0.0, 2.0 * np.pi, 4001)[:-1]
    cubes = float(np.mean(np.abs(500.0 + 2000.0 * np.sin(turn)) ** 3))
    assert life.basic == pytest.approx(1e6 * 14_000.0**3 / cubes, rel=1e-3)
    # By 200 points of the swing.
    assert life.reference == pytest.approx(5.493e8, rel=1e-3)
    # A triangle from 0 to 3 kN: the cubic mean is 3/4^(1/3) kN.
    triangle = Table(times=(0.0, 0.5, 2.0), values=(0.0, 3000.0, 0.0))
    life = br.rating_life(steady.replace({"loads.radial.force": triangle}))
    assert life.equivalent_load == pytest.approx(3000.0 / 4.0 ** (1.0 / 3.0), rel=1e-6)
    # Steps: shares of the time, here equal to those of the turns; and of the turns where the speed steps, too.
    steps = Table(times=(0.0, 1.0, 1.0, 4.0), values=(1000.0, 1000.0, 2000.0, 2000.0))
    scene = steady.replace({"loads.radial.force": steps})
    light, heavy = (br.rating_life(deep(f)).reference for f in (1000.0, 2000.0))
    assert br.rating_life(scene).reference == pytest.approx(1.0 / (0.25 / light + 0.75 / heavy))
    speed = Table(times=(0.0, 1.0, 1.001, 4.0), values=(300.0, 300.0, 100.0, 100.0))
    found = br.rating_life(scene.replace({"drive": SpeedDrive(speed)}))
    assert found.reference == pytest.approx(1.0 / (0.5 / light + 0.5 / heavy), rel=0.01)


def test_loads_without_a_period_are_refused_by_name() -> None:
    """Truth: what has no period has no sum over it; what does not change or lasts needs none."""
    steady = deep(500.0, 100.0)
    ramp = Ramp(from_=0.0, to=500.0, start=0.0, end=0.1)
    ten, odd = (
        Sine(mean=500.0, amplitude=100.0, frequency=f, phase=0.0) for f in (10.0, 10.0 * math.pi)
    )
    table = Table(times=(0.0, 0.95), values=(100.0, 200.0))
    long = Table(times=(0.0, 2.0), values=(100.0, 200.0))
    jump = Table(times=(1.0, 1.0), values=(100.0, 200.0))
    moment = Moment(ring="inner", direction=(1.0, 0.0, 0.0), moment=ramp)
    for changes, named in (
        ({"loads.radial.force": ramp}, "loads.radial.force = a ramp"),
        ({"loads.radial.force": jump}, "loads.radial.force = a table that jumps"),
        ({"moments.m": moment}, "moments.m.moment = a ramp"),
        ({"loads.radial.force": ten, "loads.axial.force": odd}, "loads.axial.force = a sine of 31"),
        ({"loads.radial.force": ten, "loads.axial.force": table}, "loads.radial.force = a sine"),
        ({"loads.radial.force": long, "loads.axial.force": table}, "loads.radial.force = a table"),
    ):
        with pytest.raises(br.SceneError, match=named):
            br.rating_life(steady.replace(changes))
    still = Ramp(from_=500.0, to=500.0, start=0.0, end=0.1)
    run_up = Ramp(from_=0.0, to=2.0 * math.pi * 25.0, start=0.0, end=0.1)
    found = br.rating_life(steady.replace({"loads.radial.force": still, "drive.speed": run_up}))
    assert found.reference == pytest.approx(br.rating_life(steady).reference)
    assert found.basic == br.rating_life(steady).basic


def test_life_factor_of_iso_281() -> None:
    """Truth: its curves meet at κ 0.4 and 1, end at 0.1 and 50, and rise with κ and e_C C_u/P."""
    for kappa in (0.4, 1.0):
        below, above = _factor(kappa * (1.0 - 1e-9), 0.2), _factor(kappa, 0.2)
        assert below == pytest.approx(above, rel=1e-3)
    assert _factor(0.1 + 1e-9, 0.2) == pytest.approx(0.1, rel=0.01)
    assert _factor(0.05, 5.0) == _factor(1.0, 0.0) == 0.1
    assert _factor(4.0, 5.0) == 50.0
    assert _factor(9.0, 0.1) == _factor(4.0, 0.1) > _factor(1.0, 0.1) > _factor(0.3, 0.1)


def test_lives_with_oil() -> None:
    """Truth: ISO 281's viscosity ratio ν/ν₁ beside λ^1.3, its short formula C₀/22 for C_u, limits of e_C."""
    oil = {"lubricant": "vg68", "temperature_c": 55.0}
    scene = br.bearing("6205", radial_load=1400.0, speed_rpm=1797.0, **oil)  # type: ignore[arg-type]
    life = br.rating_life(scene)
    factor = life.factor
    assert factor is not None
    assert scene.lubricant is not None
    viscosity = 1e6 * scene.lubricant.properties().kinematic_viscosity
    assert factor.kappa == pytest.approx(viscosity * math.sqrt(1797.0 * 39.04) / 4500.0, rel=0.15)
    assert factor.fatigue_limit == pytest.approx(7800.0 / 22.0, rel=0.2)
    assert life.modified == pytest.approx(factor.value * life.reference)
    dirty = br.rating_life(scene, contamination="very severe")
    assert dirty.modified == pytest.approx(0.1 * life.reference)
    slower = br.rating_life(scene.replace({"drive.speed": 20.0})).factor
    assert slower is not None
    assert slower.value < factor.value
    varying = Sine(mean=1400.0, amplitude=700.0, frequency=5.0, phase=0.0)
    swung = br.rating_life(scene.replace({"loads.radial.force": varying}))
    assert swung.modified is not None
    assert life.modified is not None
    assert 0.0 < swung.modified < life.modified
    assert br.rating_life(deep(1400.0)).modified is None
    at_rest = scene.replace({"lubricant.reference_speed": 100.0, "drive.speed": 0.0})
    assert br.rating_life(at_rest).factor is None
    for wrong in ("filthy", 1.5, -0.1, True, math.nan):
        with pytest.raises(br.SceneError, match="contamination"):
            br.rating_life(scene, contamination=wrong)  # type: ignore[arg-type]
