"""Fits after ISO 286 and Lamé, heat, and the clearance that they leave."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_bvp

import ballrace as br
from ballrace.bearings import Temperatures, operating_clearance, steady_temperatures
from ballrace.bearings.fits import Interference, Seat, bearing_limits, interference, limits

E, NU = 207e9, 0.3


@pytest.mark.parametrize(
    ("fit", "mm", "low", "high"),
    [
        # Literature: ISO 286-2 as in bearing makers' tables of fits.
        ("k5", 25, 2, 11), ("m6", 45, 9, 25), ("j5", 30, -4, 5), ("j6", 100, -9, 13), ("h6", 20, -13, 0),
        ("g6", 50, -25, -9), ("f6", 17, -27, -16), ("js6", 60, -9.5, 9.5), ("n6", 85, 23, 45), ("p6", 90, 37, 59),
        ("k6", 120, 3, 25), ("H7", 52, 0, 30), ("G7", 62, 10, 40), ("J7", 80, -12, 18), ("J6", 52, -6, 13),
        ("JS7", 110, -17.5, 17.5), ("K6", 52, -15, 4), ("K7", 52, -21, 9), ("M7", 52, -30, 0), ("N7", 52, -39, -9),
        ("P7", 72, -51, -21), ("M6", 260, -41, -9), ("P6", 110, -52, -30), ("H8", 215, 0, 72), ("F7", 47, 25, 50),
    ],
)  # fmt: skip
def test_classes_are_those_of_iso_286(fit: str, mm: float, low: float, high: float) -> None:
    found = limits(fit, 1e-3 * mm)
    assert [1e6 * each for each in found] == pytest.approx([low, high])


def test_a_bearing_has_its_own_tolerance() -> None:
    """Literature: ISO 492, class Normal: 0/-10 of a bore of 25 mm, 0/-13 of an outside diameter of 52 mm."""
    assert bearing_limits("bore", 25e-3) == pytest.approx((-1e-5, 0.0))
    assert bearing_limits("outside", 52e-3) == pytest.approx((-1.3e-5, 0.0))
    assert interference("k5", 25e-3) == pytest.approx(0.5 * (2 + 11 + 10) * 1e-6)
    assert interference("N7", 52e-3) == pytest.approx(0.5 * (9 + 39 - 13) * 1e-6)


def test_lame_on_a_solid_shaft_of_the_same_steel() -> None:
    """Analytic: the raceway grows by I d/F, and the joint carries E I/(2 d) (1 - d²/F²)."""
    d, F, size = 25e-3, 31.1e-3, 10e-6
    found = Interference.of(size, d, F, Seat(free_diameter=0.0), Seat(free_diameter=math.nan))
    assert found.raceway == pytest.approx(size * d / F, rel=1e-12)
    assert found.pressure == pytest.approx(E * size / (2.0 * d) * (1.0 - (d / F) ** 2), rel=1e-12)


def test_lame_in_a_thick_housing_of_the_same_steel() -> None:
    """Analytic: the raceway shrinks by I G/D."""
    D, G, size = 52e-3, 47e-3, 10e-6
    found = Interference.of(size, D, G, Seat(free_diameter=math.inf), Seat(free_diameter=math.nan))
    assert found.raceway == pytest.approx(-size * G / D, rel=1e-12)


@pytest.mark.parametrize(
    ("joint", "raceway", "free"), [(25e-3, 31.1e-3, 10e-3), (52e-3, 47e-3, 80e-3)]
)
def test_lame_is_the_solution_of_the_equation_of_rings(
    joint: float, raceway: float, free: float
) -> None:
    """Analytic, by another way: u'' + u'/r - u/r² = 0 in each body, solved as a boundary value problem."""
    seat = Seat(free_diameter=free, youngs_modulus=70e9, poisson_ratio=0.33)
    found = Interference.of(8e-6, joint, raceway, seat, Seat(free_diameter=math.nan))

    def moved(free_at: float, modulus: float, nu: float) -> tuple[float, float]:
        """Growth of the diameters at the joint and at the free surface."""
        low, high = sorted((0.5 * joint, 0.5 * free_at))

        def stress(r: float, u: float, du: float) -> float:
            return modulus / (1.0 - nu**2) * (du + nu * u / r)

        def ends(a: Any, b: Any) -> Any:
            inside, outside = stress(low, *a), stress(high, *b)
            pressed = (-found.pressure, 0.0) if low == 0.5 * joint else (0.0, -found.pressure)
            return np.array([inside - pressed[0], outside - pressed[1]]) / 1e9

        def slope(r: Any, y: Any) -> Any:
            return np.vstack([y[1], -y[1] / r + y[0] / r**2])

        r = np.linspace(low, high, 41)
        solved = solve_bvp(slope, ends, r, np.full((2, r.size), 1e-6), tol=1e-9)
        assert solved.success
        at, other = (0, -1) if low == 0.5 * joint else (-1, 0)
        return 2.0 * solved.sol(r)[0][at], 2.0 * solved.sol(r)[0][other]

    of_ring, grown = moved(raceway, E, NU)
    of_seat, _ = moved(free, 70e9, 0.33)
    assert abs(of_ring) + abs(of_seat) == pytest.approx(8e-6, rel=1e-5)
    assert found.raceway == pytest.approx(grown, rel=1e-5)


def test_ten_kelvin_take_4_7_of_12_5_micrometres_of_a_6205() -> None:
    """Analytic: α d_m ΔT with balls half-way; of even heat nothing."""
    warm = operating_clearance("6205", temperatures=Temperatures(inner=60.0, outer=50.0))
    made = br.catalogue["6205"]
    assert warm.initial == pytest.approx(12.5e-6)
    assert warm.heat == pytest.approx(12e-6 * made.pitch_diameter * 10.0, rel=1e-12)
    assert round(1e6 * warm.heat, 1) == 4.7
    assert warm.clearance == pytest.approx(7.8e-6, abs=0.05e-6)
    even = operating_clearance("6205", temperatures=Temperatures(inner=80.0, outer=80.0))
    assert even.heat == pytest.approx(0.0, abs=1e-18)


def test_fits_take_clearance_and_are_listed() -> None:
    """Analytic: 11.5 µm of k5 less 2.6 of smoothing, by d/F; an H7 has play and takes nothing."""
    made = br.catalogue["6205"]
    found = operating_clearance("6205/C3", shaft_fit="k5", housing_fit="H7")
    raceway = made.pitch_diameter - made.ball_diameter
    assert found.shaft_fit == pytest.approx((11.5e-6 - 2.6e-6) * made.bore / raceway, rel=1e-9)
    assert found.housing_fit == 0.0
    assert found.clearance == pytest.approx(found.initial - found.shaft_fit)
    text = str(found)
    for part in (
        "before mounting",
        "fit on the shaft",
        "play",
        "heat",
        "in operation",
        "smoothing took 2.60",
    ):
        assert part in text


def test_an_aluminium_housing_lets_go_as_it_warms_up() -> None:
    """Analytic: the interference of an N7 falls by D (α_Al - α) ΔT."""
    light = Seat(free_diameter=80e-3, youngs_modulus=70e9, poisson_ratio=0.33, expansion=23e-6)
    cold, hot = (
        operating_clearance(
            "6205", housing_fit="N7", housing=light, temperatures=Temperatures(inner=t, outer=t)
        )
        for t in (20.0, 40.0)
    )
    lost = cold.housing_interference - hot.housing_interference
    assert lost == pytest.approx(52e-3 * (23e-6 - 12e-6) * 20.0, rel=1e-9)
    assert 0.0 < hot.housing_fit < cold.housing_fit


def test_a_scene_runs_with_it_and_explain_says_it() -> None:
    found = operating_clearance(
        "6205", shaft_fit="k5", temperatures=Temperatures(inner=60.0, outer=50.0)
    )
    scene = br.bearing("6205", radial_load=800.0, speed_rpm=1800.0)
    mounted = found.apply(scene)
    assert mounted.rows[0].clearance == found.clearance
    # Less clearance spreads the load over more balls.
    loads = [br.equilibrium(each).outer_load.max() for each in (scene, mounted)]
    assert loads[1] < loads[0]
    with pytest.raises(br.SceneError, match=r"^rows\[0\]\.clearance = .*before mounting"):
        found.apply(mounted)
    explanation = br.explain(mounted, clearance=found)
    assert str(found) in str(explanation)
    assert explanation.clearance["heat"] == found.heat
    assert explanation.clearance["clearance"] == found.clearance
    with pytest.raises(br.SceneError, match=r"^clearance = .*in operation"):
        br.explain(scene, clearance=found)


def test_losses_that_fall_with_heat_meet_what_is_given_off() -> None:
    """Analytic: P = 40/T of the mean temperature and one conductance each, a quadratic equation."""
    found = steady_temperatures(
        lambda mean: 400.0 / mean, inner_conductance=0.4, outer_conductance=0.4
    )
    # T = 20 + 0.5 · 400/T /0.4.
    mean = 10.0 + math.sqrt(100.0 + 500.0)
    assert 0.5 * (found.inner + found.outer) == pytest.approx(mean, rel=1e-8)
    uneven = steady_temperatures(
        12.0, inner_conductance=0.2, outer_conductance=0.6, ambient=30.0, inner_share=0.25
    )
    assert (uneven.inner, uneven.outer) == pytest.approx((45.0, 45.0))
    with pytest.raises(br.EquilibriumError, match="no steady temperature"):
        steady_temperatures(lambda mean: mean**2, inner_conductance=0.1, outer_conductance=0.1)


WRONG: list[tuple[dict[str, Any], str]] = [
    ({"name": "7205B"}, "name"), ({"shaft_fit": "k9"}, "shaft_fit"), ({"shaft_fit": "H7"}, "shaft_fit"),
    ({"housing_fit": "k5"}, "housing_fit"), ({"shaft_fit": math.nan}, "shaft_fit"),
    ({"shaft_fit": 1.0}, "shaft_fit"),
    ({"smoothing": -1e-6}, "smoothing"), ({"clearance": "C9"}, "clearance"), ({"shaft_fit": "m8"}, "shaft_fit"),
]  # fmt: skip


@pytest.mark.parametrize(("arguments", "field"), WRONG)
def test_what_is_wrong_is_named(arguments: dict[str, Any], field: str) -> None:
    with pytest.raises(br.SceneError) as refused:
        operating_clearance(**({"name": "6205"} | arguments))
    assert refused.value.path == field


@pytest.mark.parametrize(
    ("arguments", "field"),
    [
        ({"losses": -1.0}, "losses"), ({"losses": lambda mean: math.nan}, "losses"),
        ({"inner_conductance": 0.0}, "inner_conductance"), ({"outer_conductance": "a"}, "outer_conductance"),
        ({"inner_share": 1.5}, "inner_share"), ({"ambient": math.nan}, "ambient"),
    ],
)  # fmt: skip
def test_heat_names_what_is_wrong(arguments: dict[str, Any], field: str) -> None:
    good: dict[str, Any] = {"losses": 1.0, "inner_conductance": 1.0, "outer_conductance": 1.0}
    with pytest.raises(br.SceneError) as refused:
        steady_temperatures(**(good | arguments))
    assert refused.value.path == field
    with pytest.raises(br.SceneError, match=r"^inner = nan"):
        Temperatures(inner=math.nan)
