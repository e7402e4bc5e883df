"""Rings that tilt, from Python: what scenes say, equilibria, stiffness, runs."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

import ballrace as br
from ballrace import scene as s


def tilted() -> br.Scene:
    """A 6205 under 500 N and 300 N whose inner ring tilts, damped."""
    scene = br.presets.deep_groove_6205(500.0, 300.0)
    damped = s.Spring(damping=0.05)
    return scene.replace(
        {
            "inner_ring.support.tilt_x": damped,
            "inner_ring.support.tilt_y": damped,
        }
    )


def test_documents_without_tilts_say_nothing_of_them() -> None:
    for name in ("wheel_bearing", "deep_groove_6205"):
        scene: br.Scene = getattr(br.presets, name)()
        for text in (scene._document(), scene.to_json(), scene.to_toml()):
            assert not any(word in text for word in ("tilt", "moments", "coupled"))


def test_parallel_rings_hide_a_moment() -> None:
    """Truth: the ring that is free to tilt, and the balance of moments."""
    held = br.equilibrium(br.presets.deep_groove_6205(500.0, 300.0))
    free = br.equilibrium(tilted())
    assert held.inner_moment.shape == free.inner_tilt.shape == (2,)
    assert held.inner_moment[0] > 2.0
    assert np.all(held.inner_tilt == 0.0)
    assert abs(free.inner_moment[0]) < 1e-5
    assert 1e-3 < free.inner_tilt[0] < 4e-3
    assert free.inner_load.max() > 1.2 * held.inner_load.max()


def test_stiffness_has_tilts_beside_places() -> None:
    found = br.stiffness(tilted())
    assert (found.inner_spatial.shape, found.rings_spatial.shape) == ((5, 5), (10, 10))
    np.testing.assert_array_equal(found.inner, found.inner_spatial[:3, :3])
    np.testing.assert_allclose(found.inner_spatial, found.inner_spatial.T, rtol=1e-9, atol=1.0)
    assert np.linalg.eigvalsh(found.inner_spatial)[0] > 0.0


def test_load_distributions_have_tilts() -> None:
    found = br.load_distribution(tilted(), positions=3)
    assert found.inner_tilt.shape == found.inner_moment.shape == (found.turn.size, 2)
    assert np.all(found.inner_tilt[:, 0] > 1e-3)
    assert np.all(found.outer_tilt == 0.0)


def test_a_moment_tilts_as_a_load_off_the_centre_does() -> None:
    scene = tilted()
    moment = s.Moment(ring="inner", direction=(1.0, 0.0, 0.0), moment=3.0)
    by_moment = br.equilibrium(scene.replace({"moments.bend": moment}))
    load = dataclasses.replace(scene.loads["axial"], at=(0.0, 0.01, 0.0))
    by_load = br.equilibrium(scene.replace({"loads.axial": load}))
    np.testing.assert_allclose(by_moment.inner_tilt, by_load.inner_tilt, rtol=1e-4, atol=1e-9)


def test_a_run_records_tilts_and_moments() -> None:
    """Truth: the equilibrium, in which the run begins."""
    components: tuple[s.Component, ...] = ("tilt_x", "tilt_vx", "tilt_ax", "y")
    probes = {"inner": s.MotionProbe(body="inner", components=components), "m": s.MomentsProbe()}
    scene = tilted().replace({"probes": probes})
    out = br.simulate(scene, duration=2e-3, settle=0.0)
    start = br.equilibrium(scene).inner_tilt[0]
    tilt = np.asarray(out["inner.tilt_x"])
    assert tilt[0] == pytest.approx(start, rel=0.05)
    assert np.ptp(tilt) > 0.0
    for name in ("m.outer.x", "m.inner.y", "inner.tilt_ax"):
        assert np.asarray(out[name]).size == tilt.size


def test_the_road_tilts_a_cornering_wheel() -> None:
    tilts = [br.equilibrium(br.presets.cornering_wheel(g)).inner_tilt[0] for g in (0.1, 0.3)]
    assert abs(tilts[1]) > abs(tilts[0]) > 1e-3
