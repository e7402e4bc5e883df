"""Friction torque by SKF's model and by Palmgren's.

Truth: the formulas worked out apart from this code for a 6205 in VG 68 (its viscosity by ASTM D341 from 68 and
8.7 mm²/s), and the formulas' limits. Constants of the other series show in their order: of bearings of one size
those with smaller balls slide more.
"""

from __future__ import annotations

import math
from typing import Any

import pytest

import ballrace as br
from ballrace.ratings.friction import CONSTANTS
from oils import astm_d341

OF_6205: dict[str, Any] = {"bore": 25e-3, "outside_diameter": 52e-3}


def skf(
    celsius: float = 55.0, load: float = 500.0, rpm: float = 1797.0, **more: Any
) -> br.ratings.FrictionTorque:
    viscosity = 1e-6 * astm_d341(68.0, 8.7, celsius)
    arguments = {"radial_load": load, "speed_rpm": rpm, "viscosity": viscosity, **OF_6205, **more}
    return br.friction_torque_skf(arguments.pop("series", "62"), **arguments)


@pytest.mark.parametrize(
    ("celsius", "load", "wanted"),
    [
        (40.0, 500.0, 16.44),
        (55.0, 500.0, 12.14),
        (70.0, 500.0, 9.69),
        (70.0, 1000.0, 17.91),
        (70.0, 3000.0, 63.59),
    ],
)
def test_skf_6205_in_vg_68(celsius: float, load: float, wanted: float) -> None:
    assert 1e3 * skf(celsius, load).total == pytest.approx(wanted, rel=1e-3)


def test_under_a_heavy_load_sliding_leads() -> None:
    found = skf(70.0, 3000.0)
    assert found.sliding > found.rolling > 0.0
    assert found.total == found.sliding + found.rolling
    assert "SKF" in found.source


def test_skf_rolling_grows_with_speed_and_load_as_it_says() -> None:
    """Slow and thin oil heats nothing and starves nowhere: (ν n)^0.6 F^0.54, and F^(5/3) at 0.12."""
    slow, faster = skf(rpm=1.0), skf(rpm=2.0)
    assert faster.rolling / slow.rolling == pytest.approx(2.0**0.6, rel=1e-3)
    assert skf(load=1000.0).rolling / skf(load=500.0).rolling == pytest.approx(2.0**0.54)
    assert skf(load=1000.0).sliding / skf(load=500.0).sliding == pytest.approx(2.0 ** (5 / 3))
    standing = skf(rpm=0.0)
    assert standing.rolling == 0.0
    assert standing.sliding == pytest.approx(1e-3 * 3.23e-3 * 38.5**-0.26 * 500.0 ** (5 / 3) * 0.12)
    assert skf(rpm=-1797.0) == skf()


def test_skf_with_thrust() -> None:
    """Rolling is continuous where the thrust vanishes; sliding jumps, and is the formula's under thrust alone."""
    little = skf(axial_load=1e-9, static_rating=7800.0)
    assert little.rolling == pytest.approx(skf().rolling, rel=1e-5)
    assert little.sliding == pytest.approx(38.5**0.115 * skf().sliding)
    thrust = skf(load=0.0, axial_load=-7800.0, static_rating=7800.0, rpm=0.0)
    sine = math.sin(math.radians(24.6))
    alone = 3.23e-3 * 38.5**-0.145 * (36.5 * 38.5**1.5 / sine * 7800.0**4) ** (1 / 3)
    assert thrust.sliding == pytest.approx(0.12e-3 * alone)


def test_series_of_one_size() -> None:
    """The smaller the balls, the more they slide."""
    found = [skf(series=series) for series in ("64", "63", "62", "60", "160", "618")]
    sliding = [each.sliding for each in found]
    assert sliding == sorted(sliding)
    rolling = [each.rolling for each in found]
    assert rolling == sorted(rolling)
    assert CONSTANTS["622"] == CONSTANTS["62"]


def test_palmgren() -> None:
    """Truth: his two formulas with round numbers: d_m 100 mm, ν n = 8000 has a power of 400; 160 below 2000."""
    round_numbers = {"pitch_diameter": 0.1, "load": 1000.0, "f_0": 2.0, "f_1": 1e-3}
    found = br.friction_torque_palmgren(speed_rpm=800.0, viscosity=10e-6, **round_numbers)
    assert found.rolling == pytest.approx(1e-3 * 2.0 * 1e-7 * 400.0 * 1e6)
    assert found.sliding == pytest.approx(0.1)
    assert found.total == found.rolling + found.sliding
    slow = br.friction_torque_palmgren(speed_rpm=100.0, viscosity=10e-6, **round_numbers)
    assert slow.rolling == pytest.approx(1e-3 * 2.0 * 160e-7 * 1e6)


def test_the_two_are_of_one_order() -> None:
    """Both are fits of measured bearings; a factor of two between them is common."""
    other = br.friction_torque_palmgren(
        pitch_diameter=38.5e-3, speed_rpm=1797.0, viscosity=34.8e-6, load=500.0,
        f_0=2.0, f_1=0.0005 * (500.0 / 7800.0) ** 0.55,
    )  # fmt: skip
    assert 0.5 < skf().total / other.total < 2.0


@pytest.mark.parametrize(
    ("argument", "value"),
    [
        ("series", "72"),
        ("series", "6205"),
        ("bore", 0.0),
        ("outside_diameter", 25e-3),
        ("speed_rpm", math.inf),
        ("viscosity", -1e-6),
        ("viscosity", True),
        ("radial_load", -1.0),
        ("axial_load", math.nan),
        ("film_friction", "0.05"),
    ],
)
def test_unusable_arguments_are_named(argument: str, value: Any) -> None:
    with pytest.raises(br.SceneError) as caught:
        skf(**{argument: value})
    assert caught.value.path == argument


def test_thrust_wants_the_static_rating() -> None:
    with pytest.raises(br.SceneError, match="static_rating = None: a rating"):
        skf(axial_load=100.0)
    with pytest.raises(br.SceneError, match="static_rating"):
        skf(axial_load=100.0, static_rating=0.0)
    usable = {"pitch_diameter": 0.1, "load": 1.0, "f_0": 2.0, "f_1": 1e-3}
    for name in usable:
        arguments = {**usable, name: -1.0}
        with pytest.raises(br.SceneError, match=name):
            br.friction_torque_palmgren(speed_rpm=1.0, viscosity=1e-5, **arguments)
