"""The tolerance that the band of a record asks for."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

import ballrace as br

SHORT: dict[str, Any] = {"duration": 2e-3, "settle": 0.0}


@pytest.fixture(scope="module")
def scene() -> br.Scene:
    spall = br.defects.spall(on="outer_race", width_mm=1.0)
    return br.bearing("6205", radial_load=500.0, speed_rpm=1797.0, defects=spall)


@pytest.mark.filterwarnings("ignore:nothing drives the balls")
@pytest.mark.parametrize(
    ("changes", "options", "by_band"),
    [
        ({}, {}, True),
        ({}, {"fs": 51_200.0}, True),
        ({}, {"fs": 12_000.0}, True),
        ({}, {"fs": 100e3}, False),
        ({}, {"bandwidth": None}, False),
        ({}, {"method": "dormand-prince"}, False),
        ({}, {"rtol": 1e-5}, False),
        ({"solver.rtol": 1e-7}, {}, False),
        ({"friction": "none"}, {}, False),
        ({"friction.coulomb.slip_speed": 0.01}, {}, False),
        ({"contact.damping": 0.0}, {}, False),
    ],
    ids=str,
)
def test_which_runs_it_is_for(
    scene: br.Scene, changes: dict[str, Any], options: dict[str, Any], by_band: bool
) -> None:
    out = br.simulate(scene.replace(changes), **(SHORT | options))
    assert out.provenance.by_band is by_band
    exact = options.get("rtol", 1e-7)
    assert out.provenance.rtol == (1e-4 if by_band else exact)
    assert out.scene.solver.rtol == changes.get("solver.rtol", options.get("rtol", "band"))


def test_documents_say_it_or_mean_the_exact_one(scene: br.Scene) -> None:
    """Golden: documents that were written before there was a band keep their runs."""
    assert 'rtol = "band"' in scene.to_toml()
    assert br.Scene.from_toml(scene.to_toml()) == scene
    before = scene.to_dict()
    del before["solver"]["rtol"]
    assert br.Scene.from_json(json.dumps(before)).solver.rtol == 1e-7
    del before["solver"]
    assert br.Scene.from_json(json.dumps(before)).solver.rtol == 1e-7
    with pytest.raises(br.SceneError, match=r'solver\.rtol = "bands".*"band"'):
        scene.replace({"solver.rtol": "bands"})
    with pytest.raises(br.SceneError, match=r"solver\.rtol = 0\.5"):
        scene.replace({"solver.rtol": 0.5})


def test_it_is_right_in_the_band(scene: br.Scene) -> None:
    """Truth: a run of the same millisecond at 1e-10 with half the cap; evaluations are fewer."""
    start = br.simulate(scene, duration=0.01)
    limit = br.simulate(scene, **SHORT, rtol=1e-7).provenance.step_limit
    fine = scene.replace({"solver.max_step": 0.5 * limit, "solver.rtol": 1e-10})
    seen = "housing.sensor.ay"
    truth = br.simulate(fine, duration=1e-3, start=start)[seen]
    found = br.simulate(scene, duration=1e-3, start=start)
    assert np.linalg.norm(found[seen] - truth) < 0.01 * np.linalg.norm(truth)
    exact = br.simulate(scene, duration=1e-3, start=start, rtol=1e-7)
    assert found.stats.nfev < 0.7 * exact.stats.nfev
    assert found.provenance.step_limit == pytest.approx(1.2 * exact.provenance.step_limit)


def test_a_run_that_goes_on_keeps_it(scene: br.Scene) -> None:
    """Truth: the run in one piece, to the bit."""
    whole = br.simulate(scene, duration=2e-3, settle=0.0)
    run = br.Simulation(scene, duration=2e-3, settle=0.0)
    run.advance_to(1e-3)
    again = br.Simulation.restore(run.snapshot())
    again.advance_to(2e-3)
    out = again.finish()
    assert out.provenance.by_band
    np.testing.assert_array_equal(out["outer.ay"], whole["outer.ay"])
