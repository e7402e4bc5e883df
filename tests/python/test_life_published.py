"""Lives and life factors beside those that other programs print.

MASTA: L10r of seven cases, Z 7, D 11.5, d_m 43.5, C 23.4 kN, as the tests of a public ISO/TS 16281 code print
them. They are of one cage position; there a tilt is linear, and the moment of the last lies across the plane of
the tilt.

SKF: κ, P_u and a of a 6309 by its calculator (4 and 0.5 kN, 1800 1/min, ν 21.6 mm²/s, e_C 0.55), and κ of
the example of its catalogue (3000 1/min, ν 20 mm²/s). Its ν₁ is 16 % below that of ISO 281, its P_u C₀/23.5.
"""

from __future__ import annotations

import math

import pytest

import ballrace as br
from ballrace import scene as s
from ballrace.ratings.life_factor import _factor, rated_viscosity
from truth import meets

STEEL = s.Material(youngs_modulus=210e9, poisson_ratio=0.3)


def masta(clearance: float, radial: float, axial: float, moment: float) -> br.Scene:
    """A ring that is free to move and to tilt, a ball on the load line."""
    row = s.Row(
        ball_count=7,
        ball_diameter=11.5e-3,
        pitch_diameter=43.5e-3,
        outer_conformity=0.53,
        inner_conformity=0.52,
        clearance=clearance,
    )
    # Under a force along one direction the tilt of a loose bearing is not held by anything, nor does it matter.
    tilts = bool(moment or (radial and axial))
    held = s.Support(tilt_x="free", tilt_y="free") if tilts else s.Support()
    loads = {
        "radial": s.Load(ring="inner", direction=(1.0, 0.0, 0.0), force=radial),
        "axial": s.Load(ring="inner", direction=(0.0, 0.0, 1.0), force=axial),
    }
    moments = {"moment": s.Moment(ring="inner", direction=(1.0, 0.0, 0.0), moment=moment)}
    return br.Scene(
        rows=(row,),
        inner_ring=s.Ring(mass=1.0, support=held),
        materials=s.Materials(rings=STEEL, balls=STEEL),
        drive=s.SpeedDrive(0.0),
        gravity=(0.0, 0.0, 0.0),
        loads={name: load for name, load in loads.items() if load.force},
        moments=moments if moment else {},
    )


@pytest.mark.parametrize(
    ("case", "arguments", "published", "within"),
    [
        ("radial", (0.0, 1000.0, 0.0, 0.0), 13163.019, 3e-3),
        ("axial", (0.0, 0.0, 1000.0, 0.0), 2222.7318, 3e-3),
        ("radial, loose", (10e-6, 1000.0, 0.0, 0.0), 10795.7948, 3e-3),
        ("axial, loose", (10e-6, 0.0, 1000.0, 0.0), 3115.8781, 3e-3),
        ("combined", (10e-6, 1000.0, 1000.0, 0.0), 1630.5367, 6e-3),
        ("moment", (0.0, 0.0, 0.0, 1.0), 785144.7521, 6e-3),
        ("combined, moment", (10e-6, 1000.0, 1000.0, 1.0), 1627.7479, 6e-3),
    ],
)
def test_lives_at_one_cage_position_are_those_of_masta(
    case: str, arguments: tuple[float, float, float, float], published: float, within: float
) -> None:
    """Truth: printed. Where all balls carry alike the mean over the cage is the same."""
    life = br.rating_life(masta(*arguments), rating=23_400.0)
    meets(f"MASTA {case}: L10r, millions", published, 1e-6 * life.one_position, within)
    assert -0.05 < life.reference / life.one_position - 1.0 < 0.2


def oiled(speed_rpm: float, viscosity: float) -> br.Scene:
    """A 6309 in an oil of a viscosity [mm²/s] at 70 °C."""
    oil = s.Lubricant(
        viscosity_40=4e-6 * viscosity, viscosity_100=0.5e-6 * viscosity, temperature=343.15
    )
    return br.bearing(
        "6309", radial_load=4000.0, axial_load=500.0, speed_rpm=speed_rpm, lubricant=oil
    )


def test_life_factor_of_a_6309_beside_skf() -> None:
    """Truth: printed by SKF. Its ν₁ is another than the standard's, and so are its curves of a."""
    assert rated_viscosity(3000.0, 72.5e-3) == pytest.approx(9.65, abs=0.01)
    scene = oiled(1800.0, 21.6)
    assert scene.lubricant is not None
    own = 1e6 * scene.lubricant.properties().kinematic_viscosity
    life = br.rating_life(scene, contamination=0.55)
    factor = life.factor
    assert factor is not None
    assert factor.kappa_from == "viscosity"
    kappa = factor.kappa * 21.6 / own
    meets("6309 in SKF's calculator: κ", 2.08, kappa, 0.18)
    meets("6309 in SKF's calculator: C_u, N", 1340.0, factor.fatigue_limit, 0.09)
    meets("6309 in SKF's catalogue: κ", 2.45, 20.0 / rated_viscosity(3000.0, 72.5e-3), 0.18)
    meets(
        "6309 in SKF's calculator: a of ISO 281 for its κ",
        12.4,
        _factor(2.08, 0.55 * 1340.0 / 4000.0),
        0.1,
    )


def test_a_roughness_that_is_given_counts() -> None:
    """Truth: ISO 281 takes λ^1.3 where the film is known; without a roughness it is the ratio of viscosities."""
    scene = oiled(1800.0, 21.6)
    rough = scene.replace({"lubricant.roughness": 0.4e-6})
    film = min(film.lambda_ratio for film in br.equilibrium(rough).films)
    factor = br.rating_life(rough).factor
    assert factor is not None
    assert factor.kappa_from == "film"
    assert factor.kappa == pytest.approx(film**1.3, rel=1e-6)
    assert "λ^1.3 of the film" in repr(br.rating_life(rough))


def test_a_life_shows_hours_or_why_not() -> None:
    """Truth: hours by hand; a pair has no P, a dry bearing no L10mr."""
    life = br.rating_life(br.bearing("6205", radial_load=1400.0, speed_rpm=1500.0))
    assert f"L10 {1e9 / 1500.0 / 60.0:.4g} h" in repr(life)
    assert "by one cage position" in repr(life)
    assert "L10mr none: it needs an oil" in repr(life)
    assert life.hours(life.modified) is None
    pair = br.rating_life(br.pair("7205B", preload=300.0, speed_rpm=1500.0))
    assert "L10 none: P of ISO 281" in repr(pair)
    assert math.isfinite(pair.reference)
