"""Races through points and gothic arches, as Python says them."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np
import pytest

import ballrace as br
from ballrace import scene as s


def tabulated(row: s.Row, outer: bool) -> s.RaceProfile:
    """Points of the groove that the conformity says."""
    conformity = row.outer_conformity if outer else row.inner_conformity
    sigma = 1.0 if outer else -1.0
    r, ball = conformity * row.ball_diameter, row.ball_diameter / 2
    angle = np.radians(np.linspace(-75.0, 75.0, 401))
    centre = row.pitch_diameter / 2 - sigma * (r - ball)
    z, radii = r * np.sin(angle), centre + sigma * r * np.cos(angle)
    return s.RaceProfile(z=tuple(z.tolist()), r=tuple(radii.tolist()))


def bearing(**changes: Any) -> s.Scene:
    scene = br.presets.deep_groove_6205(800.0, 200.0)
    row = dataclasses.replace(scene.rows[0], **changes)
    return dataclasses.replace(scene, rows=(row,))


def test_points_of_a_groove_are_the_groove() -> None:
    row = br.presets.deep_groove_6205().rows[0]
    points = bearing(outer_profile=tabulated(row, True), inner_profile=tabulated(row, False))
    assert s.Scene.from_toml(points.to_toml()) == points
    one, two = (br.equilibrium(scene) for scene in (bearing(), points))
    np.testing.assert_allclose(two.inner_load, one.inner_load, rtol=1e-5, atol=1e-3)
    runs = [br.simulate(scene, duration=2e-3, settle=0.0) for scene in (bearing(), points)]
    first, second = (run["outer.ay"] for run in runs)
    assert np.abs(first - second).max() < 1e-3 * np.abs(first).max()


def test_a_four_point_bearing_has_contact_angles_of_either_sign() -> None:
    arch = s.GothicArch(shim_angle=0.5)
    four = bearing(outer_arch=arch, inner_arch=arch)
    assert s.Scene.from_toml(four.to_toml()) == four
    for towards in (1.0, -1.0):
        load = s.Load(ring="inner", direction=(0.0, 0.0, towards), force=500.0)
        angle = br.equilibrium(dataclasses.replace(four, loads={"thrust": load})).inner_angle
        assert np.all(towards * angle > 0.45)


@pytest.mark.parametrize(
    ("changes", "path"),
    [
        ({"outer_arch": s.GothicArch(shim_angle=math.nan)}, "rows[0].outer_arch.shim_angle"),
        ({"inner_arch": s.GothicArch(shim_angle=-0.1)}, "rows[0].inner_arch.shim_angle"),
        ({"outer_profile": s.RaceProfile(z=(0.0, 1e-3), r=(1e-2, 1e-2))}, "rows[0].outer_profile"),
        ({"inner_shoulder_radius": 1e-4}, "rows[0].inner_shoulder_radius"),
    ],
)
def test_bad_races_are_named(changes: dict[str, Any], path: str) -> None:
    with pytest.raises(br.SceneError) as refused:
        br.equilibrium(bearing(**changes))
    assert refused.value.path == path
