"""The model's right-hand side and forces, and the equilibrium, from Python."""

from __future__ import annotations

import math
import pickle
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import ballrace as br
from ballrace.scene import TorqueDrive


@pytest.fixture(scope="module")
def model(wheel: br.Scene) -> br.Model:
    return br.Model(wheel)


@pytest.fixture(scope="module")
def eq(wheel: br.Scene) -> br.statics.Equilibrium:
    return br.equilibrium(wheel)


def test_names(model: br.Model) -> None:
    assert len(model.bodies) == 28
    assert model.bodies[:3] == ("outer", "inner", "row0.ball0")
    assert model.bodies[-1] == "row1.ball12"
    assert len(set(model.names)) == len(model.names)
    assert "outer.x" in model.names
    assert "row0.ball3.vz" in model.names
    assert f"{len(model.names)} states" in repr(model)


@pytest.mark.parametrize("kind", ["equilibrium", "rolling"])
def test_rhs_and_forces(model: br.Model, kind: str) -> None:
    y = model.start(kind)  # type: ignore[arg-type]
    rates = model.rhs(0.0, y)
    assert rates.shape == y.shape == (len(model.names),)
    assert np.isfinite(rates).all()
    forces = model.forces(0.0, y)
    assert "contact" in forces
    assert all(f.shape == (len(model.bodies), 4) for f in forces.values())


def test_rhs_takes_what_numpy_takes(model: br.Model) -> None:
    y = model.start("rolling")
    rates = model.rhs(0.0, y)
    np.testing.assert_array_equal(model.rhs(0.0, list(y)), rates)
    np.testing.assert_array_equal(model.rhs(0.0, np.repeat(y, 2)[::2]), rates)


@pytest.mark.parametrize("shape", [(3,), (2, 2), ()])
def test_wrong_shapes_are_named(model: br.Model, shape: tuple[int, ...]) -> None:
    for function in (model.rhs, model.forces):
        with pytest.raises(ValueError, match=rf"\({len(model.names)},\)"):
            function(0.0, np.zeros(shape))


def test_unknown_start_is_refused(model: br.Model) -> None:
    with pytest.raises(br.SceneError, match="start"):
        model.start("standing")  # type: ignore[arg-type]


def test_scipy_can_drive_it(model: br.Model) -> None:
    y = model.start("equilibrium")
    found = solve_ivp(model.rhs, (0.0, 2e-5), y, max_step=1e-6)
    assert found.success
    assert np.isfinite(found.y).all()


def test_model_pickles(model: br.Model) -> None:
    again = pickle.loads(pickle.dumps(model))
    y = model.start("rolling")
    np.testing.assert_array_equal(again.rhs(0.0, y), model.rhs(0.0, y))


def test_equilibrium_arrays(eq: br.statics.Equilibrium) -> None:
    assert eq.outer.shape == eq.inner.shape == (3,)
    for name in (
        "row",
        "ball",
        "angle",
        "outer_load",
        "inner_load",
        "outer_angle",
        "inner_deflection",
    ):
        assert getattr(eq, name).shape == (26,), name
    assert eq.row.tolist() == [0] * 13 + [1] * 13
    assert (eq.outer_load >= 0.0).all()
    assert eq.outer_load.max() > 100.0


def test_equilibrium_table(eq: br.statics.Equilibrium) -> None:
    table = eq.to_polars()
    assert table.height == 26
    assert table.columns[:5] == ["row", "ball", "angle", "radius", "z"]
    assert "balls loaded" in repr(eq)


def test_forces_follow_the_films_of_a_changing_speed() -> None:
    """Truth: Newton's law between forces and rates, at speeds that are not those that the films were made for."""
    scene = br.bearing("6205", speed_rpm=1800.0, lubricant="vg68", temperature_c=40.0)
    driven = replace(scene, drive=TorqueDrive(value=0.0, initial_speed=188.0))
    model = br.Model(driven)
    y = model.start().copy()
    half = y.size // 2
    y[half:] *= 0.3
    rates = dict(zip(model.names, model.rhs(0.0, y), strict=True))
    forces = sum(model.forces(0.0, y).values())
    ball = model.bodies.index("row0.ball0")
    row = driven.rows[0]
    volume = math.pi / 6.0 * row.ball_diameter**3
    mass = driven.materials.balls.density * volume
    for k, name in enumerate(("vx", "vy")):
        acceleration = forces[ball][k] / mass  # type: ignore[index]
        assert acceleration == pytest.approx(rates[f"row0.ball0.{name}"], rel=1e-6)
