"""What is read of the oil: probe, films at equilibrium, explanation, features."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import ballrace as br
from ballrace.scene import LubricationProbe

SCENE = replace(
    br.presets.deep_groove_6205(500.0, speed_rpm=1797.0, lubricant="vg68", temperature_c=55.0),
    probes={"oil": LubricationProbe()},
)
COLUMNS = {
    "oil.outer.film": "m",
    "oil.inner.film": "m",
    "oil.outer.lambda": "1",
    "oil.inner.lambda": "1",
    "oil.friction_torque": "N m",
    "oil.slip_power": "W",
    "oil.rolling_power": "W",
    "oil.damping_power": "W",
    "oil.drag_power": "W",
}


@pytest.fixture(scope="module")
def out() -> br.Signals:
    return br.simulate(SCENE, duration=0.01)


def test_the_probe_has_its_columns(out: br.Signals) -> None:
    assert dict(out.units) == COLUMNS
    assert np.all(out["oil.outer.lambda"] == out["oil.outer.film"] / 1e-7)
    losses = sum(out[f"oil.{part}_power"].mean() for part in ("slip", "rolling", "damping"))
    speed = 1797.0 * np.pi / 30.0
    assert out["oil.friction_torque"].mean() * speed == pytest.approx(losses, rel=0.05)


def test_a_dry_row_is_refused() -> None:
    with pytest.raises(br.SceneError, match=r"probes\.oil\.lubrication\.row = 0") as caught:
        br.simulate(replace(SCENE, lubricant=None), duration=0.001)
    assert "`lubricant`" in caught.value.allowed


def test_equilibrium_has_the_films_of_the_run(out: br.Signals) -> None:
    outer, inner = br.equilibrium(SCENE).films
    assert (outer.row, outer.race, inner.race) == (0, "outer", "inner")
    for film in (outer, inner):
        assert out[f"oil.{film.race}.film"][0] == pytest.approx(film.film, rel=1e-12)
        assert film.lambda_ratio == pytest.approx(film.film / 1e-7)
        assert film.minimum_film == pytest.approx(0.8 * film.film)
    assert br.stiffness(SCENE).equilibrium.films == (outer, inner)
    assert br.equilibrium(br.presets.deep_groove_6205(500.0)).films == ()
    assert [film["film"] for film in out.provenance.films] == [outer.film, inner.film]


def test_explain_gives_the_oil() -> None:
    explanation = br.explain(SCENE)
    (oil,) = explanation.oils
    assert (oil["oil"], oil["load_from"], oil["speed_from"]) == ("vg68", "equilibrium", "drive")
    assert oil["kinematic_viscosity"] == pytest.approx(34.8162e-6, rel=1e-4)
    offered = {variant["change"]: variant["note"] for variant in explanation.variants}
    assert "friction torque 0.2 instead of 9.7 N mm" in offered["without oil"]
    assert "vg68 at 55 °C" in str(explanation)


def test_doubtful_films_are_warned_of() -> None:
    rough = SCENE.replace({"lubricant.roughness": 1.9e-6})
    for solve in (br.equilibrium, lambda scene: br.simulate(scene, duration=0.001)):
        with pytest.warns(br.SceneWarning) as warned:
            solve(rough)
        about = [str(one.message).split(" =")[0] for one in warned]
        assert about == ["row 0, outer film, λ", "row 0, inner film, λ"]


def test_features_of_the_oil(out: br.Signals) -> None:
    found = out.features()
    assert found["oil.inner.film_min"] == out["oil.inner.film"].min()
    assert found["oil.friction_torque_mean"] == pytest.approx(out["oil.friction_torque"].mean())
