"""Loads and speeds as recorded: tables far denser than the steps."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import ballrace as br

DURATION = 0.02
"""Simulated time [s]."""
POINTS = 100_000
SPEED, RIPPLE, FREQUENCY = 188.5, 10.0, 40.0
"""Of the shaft, and of how it changes [rad/s, rad/s, Hz]."""


def run(scene: br.Scene) -> br.Signals:
    return br.simulate(scene, duration=DURATION, settle=0.0, bandwidth=None)


def table(points: int) -> br.scene.Table:
    """A sine of the speed, recorded at so many points of the run."""
    t = np.linspace(0.0, DURATION, points)
    values = SPEED + RIPPLE * np.sin(math.tau * FREQUENCY * t)
    return br.scene.Table(times=tuple(t.tolist()), values=tuple(values.tolist()))


@pytest.fixture(scope="module")
def sine() -> br.Signals:
    speed = br.scene.Sine(mean=SPEED, amplitude=RIPPLE, frequency=FREQUENCY, phase=0.0)
    return run(bearing(speed))


def bearing(speed: br.scene.Table | br.scene.Sine) -> br.Scene:
    scene = br.presets.deep_groove_6205(radial_load=500.0, axial_load=0.0, speed_rpm=1800.0)
    probes = {"inner": br.scene.MotionProbe(body="inner")}
    return replace(scene, drive=br.scene.SpeedDrive(speed), probes=probes)


def test_a_dense_table_takes_the_steps_of_what_it_records(sine: br.Signals) -> None:
    dense = run(bearing(table(POINTS)))
    assert dense.stats.accepted < 1.1 * sine.stats.accepted
    assert dense.stats.nfev < 1.1 * sine.stats.nfev
    # Linear between points, by (ripple/8) (tau f dt)^2 off the sine: 3e-9 rad/s.
    for column, off in (("inner.omega", 1e-8), ("inner.theta", 1e-10)):
        assert np.max(np.abs(dense[column] - sine[column])) < off
