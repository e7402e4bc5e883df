"""Scenes that the tests share."""

from __future__ import annotations

import pytest

import ballrace as br


@pytest.fixture(scope="session")
def wheel() -> br.Scene:
    return br.presets.wheel_bearing(axial_load=3000.0)


@pytest.fixture(scope="session")
def out(wheel: br.Scene) -> br.Signals:
    """A short run with every kind of column and a table of slices."""
    probes = {
        "outer": br.scene.MotionProbe(body="outer"),
        "contacts": br.scene.ContactsProbe(balls=(0, 1)),
        "cage": br.scene.CageProbe(),
        "energy": br.scene.EnergyProbe(),
        "torque": br.scene.TorqueProbe(),
        "forces": br.scene.ForcesProbe(body="row0.ball3"),
        "slices": br.scene.SlicesProbe(balls=(1,), times=(0.0, 2e-4)),
    }
    scene = wheel.replace({"probes": probes})
    return br.simulate(scene, duration=1e-3, fs=20_000, start="rolling")
