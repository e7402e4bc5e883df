"""A bearing in three dimensions: bodies are closed and where the run has them; pressures are Hertz's."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import ballrace as br
from ballrace.plot import solids
from browser import opened


@pytest.fixture(scope="module")
def out() -> br.Signals:
    spalls = {
        "inside": br.defects.spall(on="inner_race", width_mm=1.5, angle=-1.6),
        "outside": br.defects.spall(on="outer_race", width_mm=1.5, angle=-1.5),
        "rolls": br.defects.spall(on="ball", width_mm=1.0, ball=0),
    }
    scene = br.bearing("6205", radial_load=2000.0, defects=spalls, speed_rpm=1800.0)
    return br.simulate(scene.replace({"probes": br.plot.probes(scene)}), duration=0.01, settle=0.0)


def volume(mesh: solids.Mesh) -> float:
    a, b, c = mesh.points[mesh.triangles].transpose(1, 0, 2)
    return abs(float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum())) / 6.0


def test_bodies_have_their_volumes() -> None:
    """Analytic: π (R² - r²) b of a turned rectangle; a ball is 4π/3 less its facets; triangles close."""
    square = np.array([[0.0, 1.0], [2.0, 1.0], [2.0, 3.0], [0.0, 3.0], [0.0, 1.0]])
    whole = solids.ring(square, 0.0, 2.0 * math.pi, 400)
    assert volume(whole) == pytest.approx(2.0 * math.pi * (9.0 - 1.0), rel=1e-3)
    made = solids.ball()
    assert made.points.shape == (42, 3)
    np.testing.assert_allclose(np.linalg.norm(made.points, axis=1), 1.0)
    edges = np.sort(made.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()
    assert 0.85 < volume(made) / (4.0 * math.pi / 3.0) < 1.0


def test_pictures_show_the_run(out: br.Signals) -> None:
    """Balls are at their places, patches beyond them by a radius, and coloured by Hertz's largest pressure."""
    fig = br.plot.animation3d(out, frames=5)
    assert len(fig.frames) == 5
    named = {trace.name: trace for trace in fig.data}
    assert {"outer ring", "inner ring", "balls", "contacts", "cage", "inside", "outside"} <= set(
        named
    )
    unit = 26e-3 / 30_000
    samples = np.linspace(0, out.n_samples - 1, 5).astype(int)
    ball = 3
    for frame, k in zip(fig.frames, samples, strict=True):
        moved = frame.data[0]
        middle = [
            np.asarray(each).reshape(9, 42)[ball].mean() * unit for each in (moved.x, moved.y)
        ]
        assert middle == pytest.approx(
            [out[f"row0_ball{ball}.{axis}"][k] for axis in "xy"], abs=2e-6
        )
        patches = frame.data[1]
        x, y = (
            np.asarray(each).reshape(2, 9, 6).mean(axis=2) * unit for each in (patches.x, patches.y)
        )
        reach = np.hypot(x, y)[:, ball] - math.hypot(*middle)
        assert reach == pytest.approx([4.01e-3, -4.01e-3], rel=0.02)
    # At rest the run has the equilibrium's pressure, within what vibration and damage change.
    eq = br.equilibrium(out.scene.replace({"defects": {}}))
    pressure = max(eq.outer_pressure.max(), eq.inner_pressure.max())
    assert named["contacts"].cmax == pytest.approx(1e-6 * pressure, rel=0.15)
    shade = np.asarray(fig.frames[0].data[1].intensity).reshape(2, 9, 6)
    load = np.array([out[f"row0.ball{b}.inner.load"][0] for b in range(9)])
    heavy = int(load.argmax())
    expected = eq.inner_pressure.max() * (load[heavy] / eq.inner_load.max()) ** (1.0 / 3.0)
    assert shade[1, heavy, 0] == pytest.approx(1e-6 * expected, abs=1.0)


def test_damage_of_the_inner_race_turns_with_the_shaft(out: br.Signals) -> None:
    fig = br.plot.animation3d(out, frames=3)
    assert [trace.name for trace in fig.data][-1] == "inside"
    for frame, k in zip(fig.frames, (0, out.n_samples // 2, out.n_samples - 1), strict=True):
        x, y = (
            np.asarray(each, dtype=float).mean() for each in (frame.data[-1].x, frame.data[-1].y)
        )
        turned = math.atan2(y, x) + 1.6 - out["inner.theta"][k]
        assert math.remainder(turned, 2.0 * math.pi) == pytest.approx(0.0, abs=0.02)


def test_a_ball_has_a_spot_and_its_damage(out: br.Signals) -> None:
    (balls,) = (trace for trace in br.plot.animation3d(out, frames=2).data if trace.name == "balls")
    spots = np.asarray(balls.intensity).reshape(9, 42)
    assert (spots == 1).any(axis=1).all()
    assert np.argwhere(spots == 2)[:, 0].tolist() == [0]


@pytest.mark.parametrize(
    "scene", [br.bearing("6205", speed_rpm=1800.0), br.presets.wheel_bearing(3000.0)]
)
def test_a_page_of_200_pictures_is_below_6_mb(scene: br.Scene, tmp_path: Path) -> None:
    """Of 9 and of 13 balls; plotly.js has 4.8 MB of it."""
    run = br.simulate(scene.replace({"probes": br.plot.probes(scene)}), duration=0.006, settle=0.0)
    br.plot.write(br.plot.animation3d(run, frames=200), tmp_path / "page.html")
    assert (tmp_path / "page.html").stat().st_size < 6e6


@pytest.mark.parametrize(
    ("name", "value"), [("enlarged", 0.0), ("enlarged", "4"), ("row", 1), ("frames", 1)]
)
def test_what_is_wrong_is_named(out: br.Signals, name: str, value: object) -> None:
    draw: object = br.plot.animation3d
    assert callable(draw)
    with pytest.raises(br.SceneError) as refused:
        draw(out, **{name: value})
    assert refused.value.path == name


def test_it_moves_in_a_browser_without_a_network(out: br.Signals, tmp_path: Path) -> None:
    path = tmp_path / "page.html"
    br.plot.write(br.plot.animation3d(out, frames=12), path)
    with opened() as browser, browser.page(path, 1200) as (page, seen):
        now = "document.querySelector('.plotly-graph-div').textContent"
        before = page.evaluate(now)
        page.get_by_text("▶ run").click()
        page.wait_for_timeout(3000)
        assert page.evaluate(now) != before
        assert page.locator("canvas").count() > 0
        assert [
            request
            for request in seen.requests
            if not request.startswith(("file:", "blob:", "data:"))
        ] == []
        assert [line for line in seen.console if line.startswith("error")] == []
