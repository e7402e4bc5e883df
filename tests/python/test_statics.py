"""Stiffness and load distribution from Python; the numbers themselves are tested in Rust."""

from __future__ import annotations

import numpy as np
import pytest

import ballrace as br


@pytest.fixture
def scene() -> br.Scene:
    return br.presets.deep_groove_6205(500.0, 200.0, 1800.0)


def test_stiffness_arrays(scene: br.Scene) -> None:
    """Truth: symmetry of an elastic bearing, and its blocks."""
    found = br.stiffness(scene)
    assert (found.inner.shape, found.rings.shape) == ((3, 3), (6, 6))
    np.testing.assert_array_equal(found.rings, found.rings.T)
    np.testing.assert_array_equal(found.inner, found.rings[3:, 3:])
    assert np.all(np.linalg.eigvalsh(found.inner) > 0.0)
    assert found.axial == found.inner[2, 2]
    assert found.radial[0] < found.radial[1]
    assert "N/µm" in repr(found)
    np.testing.assert_array_equal(found.equilibrium.outer_load, br.equilibrium(scene).outer_load)


def test_the_residual_is_reported(scene: br.Scene) -> None:
    """Truth: forces balance to the precision of the solve; what is left is reported beside the largest load."""
    eq = br.equilibrium(scene)
    assert 0.0 <= eq.residual < 1e-6 * eq.outer_load.max()
    assert eq.residual_share == pytest.approx(eq.residual / 500.0, rel=0.5)
    assert br.stiffness(scene).equilibrium.residual == eq.residual


@pytest.mark.parametrize("length_mm", [2.0, 3.5, 5.0])
def test_a_ball_that_just_touches_inside_a_spall_balances(length_mm: float) -> None:
    """Truth: the forces themselves. Ball 0 touches with 0.6 N, over a tenth of the zone of a whole race."""
    spall = br.defects.spall(on="outer_race", width_mm=1.0, length_mm=length_mm)
    scene = br.bearing(
        "6205", radial_load=500.0, axial_load=1500.0, speed_rpm=1800.0, defects=spall
    )
    assert br.equilibrium(scene).residual_share < 1e-9


def test_stiffness_rises_with_load(scene: br.Scene) -> None:
    """Truth: contacts that stiffen. Thrust makes a deep-groove bearing stiffer axially."""
    loads = (100.0, 300.0, 1000.0)
    axial = [br.stiffness(scene.replace({"loads.axial.force": load})).axial for load in loads]
    assert axial == sorted(axial)


def test_load_distribution_arrays(scene: br.Scene) -> None:
    """Truth: the static solve at the first position, and the means' definition."""
    found = br.load_distribution(scene, positions=4)
    assert found.turn.shape == (4,)
    for name in ("angle", "outer_load", "inner_load", "outer_angle", "inner_angle"):
        assert getattr(found, name).shape == (4, 9)
    eq = br.equilibrium(scene)
    np.testing.assert_array_equal(found.inner_load[0], eq.inner_load)
    np.testing.assert_allclose(found.turn, np.arange(4) * 2.0 * np.pi / 36.0)
    inner = np.mean(found.inner_load**3) ** (1.0 / 3.0)
    outer = np.mean(found.outer_load ** (10.0 / 3.0)) ** 0.3
    np.testing.assert_allclose(found.inner_equivalent, [inner], rtol=1e-12)
    np.testing.assert_allclose(found.outer_equivalent, [outer], rtol=1e-12)
    assert "4 positions" in repr(found)


def test_load_distributions_leave_defects_out() -> None:
    """Truth: the same scene without them. A ball in a spall at one position is no load for all time."""
    healthy = br.bearing("6205", radial_load=1500.0, speed_rpm=1800.0)
    spall = br.defects.spall(on="outer_race", width_mm=1.0)
    spalled = healthy.replace({"defects.spall": spall})
    spalled = spalled.replace({"defects.ball": br.defects.spall(on="ball", width_mm=0.5)})
    found, wanted = (br.load_distribution(scene, positions=4) for scene in (spalled, healthy))
    np.testing.assert_array_equal(found.inner_load, wanted.inner_load)
    np.testing.assert_array_equal(found.outer_equivalent, wanted.outer_equivalent)


def test_around_orders_the_balls(scene: br.Scene) -> None:
    """Truth: a radial load along -y presses the balls at -90° most."""
    found = br.load_distribution(scene, positions=4)
    angle, load = found.around(0, "outer")
    assert angle.shape == load.shape == (36,)
    assert np.all(np.diff(angle) > 0.0)
    assert abs(angle[np.argmax(load)] + np.pi / 2.0) < np.pi / 36.0
    with pytest.raises(ValueError, match="row = 3"):
        found.around(3)
    with pytest.raises(ValueError, match="race = 'middle'"):
        found.around(0, "middle")  # type: ignore[arg-type]


@pytest.mark.parametrize("positions", [0, -1, 1.5, True])
def test_positions_are_checked(scene: br.Scene, positions: object) -> None:
    with pytest.raises(br.SceneError, match="positions"):
        br.load_distribution(scene, positions=positions)  # type: ignore[arg-type]


def test_loaded_balls_are_counted_by_one_rule() -> None:
    """Truth: a tenth of the largest load on the inner race; 2 N of centrifugal force load no ball."""
    scene = br.bearing("6205", radial_load=500.0, speed_rpm=6000.0)
    eq = br.equilibrium(scene)
    assert np.all(eq.outer_load > 1.0)
    np.testing.assert_array_equal(eq.loaded, eq.inner_load > 0.1 * eq.inner_load.max())
    assert repr(eq).startswith("<Equilibrium: 3 of 9 balls loaded")
