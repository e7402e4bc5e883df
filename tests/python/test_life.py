"""Rating life against ISO 281, and against what the loads of the balls must give."""

from __future__ import annotations

import math

import numpy as np
import pytest

import ballrace as br
from ballrace.life import row_rating


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


def test_equivalent_load_of_iso_281() -> None:
    """Truth: its table, at a line of it and where thrust does not count."""
    relative = 0.689 * 9 * 7.94**2
    life = br.rating_life(deep(1000.0, relative))
    assert life.equivalent_load == pytest.approx(0.56 * 1000.0 + 1.71 * relative, rel=1e-6)
    assert br.rating_life(deep(1000.0, 150.0)).equivalent_load == pytest.approx(1000.0)
    assert br.rating_life(br.bearing("7205B")).equivalent_load is None
    assert br.rating_life(br.presets.wheel_bearing()).basic is None


def test_life_falls_with_the_cube_and_a_bit_more() -> None:
    """Truth: L10r goes with load^-3 where the loaded zone stays as it is."""
    scenes = [br.bearing("7210B", radial_load=f, axial_load=3.0 * f) for f in (1000.0, 2000.0)]
    light, heavy = (br.rating_life(scene).reference for scene in scenes)
    assert light / heavy == pytest.approx(8.0, rel=0.05)


@pytest.mark.parametrize("name", ["6205", "6008", "6310", "7210B", "7205C"])
def test_the_formula_meets_the_catalogue(name: str) -> None:
    """Truth: the makers' printed ratings."""
    scene = br.bearing(name)
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
    scene = br.bearing("6205").replace({"name": "wide"})
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


def test_bad_arguments_are_named() -> None:
    for rating in (0.0, -1.0, math.nan, math.inf):
        with pytest.raises(br.SceneError, match="rating"):
            br.rating_life(deep(1400.0), rating=rating)
    with pytest.raises(br.SceneError, match="scene"):
        br.rating_life("6205")  # type: ignore[arg-type]
