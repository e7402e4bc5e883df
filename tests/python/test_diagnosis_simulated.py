"""Verdicts of simulated bearings: silent, and on random machines with noise.

Truth: the scene. A loaded healthy bearing has lines of the outer race as significant as those of a spall, and must
not be called damaged for them; a spall must be named or left open, and never another part.
"""

from __future__ import annotations

import functools

import numpy as np
import pytest

import ballrace as br

FS, RPM = 51_200.0, 1797.0


@functools.cache
def run(load: float, on: str | None, width_mm: float, duration: float) -> br.Signals:
    defects = None if on is None else br.defects.spall(on=on, width_mm=width_mm)  # type: ignore[arg-type]
    scene = br.bearing("6205", radial_load=load, axial_load=80.0, speed_rpm=RPM, defects=defects)
    return br.simulate(scene, duration=duration, fs=FS)


def measured(out: br.Signals, seed: int, snr_db: float) -> br.Channel:
    """Return what a sensor records on a random machine, in white noise so far below it."""
    sensor = br.measure(out, path=br.measuring.random_housing(seed=seed)).channel()
    x = sensor.x[round(0.05 * FS) :]
    noise = np.random.default_rng(seed).normal(size=x.size) * x.std() * 10.0 ** (-snr_db / 20.0)
    return br.Channel(x=x + noise, fs=FS, unit=sensor.unit, shaft=sensor.shaft, scene=sensor.scene)


def test_lines_of_a_healthy_run_are_no_damage() -> None:
    """Silent: varying compliance is significant, and faint; a spall of 0.8 mm is neither in doubt nor faint."""
    healthy = br.diagnose(run(500.0, None, 0.0, 1.0))
    assert healthy.evidence["outer_race"].probability < 1e-3
    assert healthy.verdict == "healthy"
    assert "a loaded healthy bearing has such lines" in healthy.why
    spalled = br.diagnose(run(500.0, "outer_race", 0.8, 1.0))
    assert spalled.parts == ("outer_race",)
    ratio = (spalled.evidence["outer_race"].strength.acceleration
             / healthy.evidence["outer_race"].strength.acceleration)  # fmt: skip
    assert ratio > 50.0


@pytest.mark.long
@pytest.mark.parametrize("snr_db", [20.0, 10.0, 0.0])
def test_on_machines_no_part_is_accused_that_is_sound(snr_db: float) -> None:
    """Six machines a bearing, 2 s each: how many are named is printed, and held where it is most."""
    named = {}
    for on in (None, "outer_race", "inner_race"):
        cases = [(150.0, 0.8), (500.0, 0.8), (500.0, 2.0)] if on else [(150.0, 0.0), (500.0, 0.0)]
        found = [
            br.diagnose(measured(run(load, on, width, 2.0), seed, snr_db))
            for load, width in cases
            for seed in range(6)
        ]
        wrong = [d.parts for d in found if set(d.parts) - {on}]
        assert not wrong
        named[on] = sum(bool(d.parts) for d in found) / len(found)
        what = (on or "healthy").replace("_", " ")
        print(
            f"\n[verdict] simulated 6205, {what}, {snr_db:g} dB | {named[on]:.0%} of {len(found)} named | "
            "none wrong"
        )
    if snr_db >= 20.0:
        assert named["inner_race"] > 0.5
        assert named["outer_race"] > 0.5
