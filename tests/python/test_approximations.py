"""Approximations by request, from Python: the truth is the free model, on what a faulted bearing is judged by."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import ballrace as br
from ballrace.scene import Approximations, Defect, TorqueDrive

FLAT = Approximations(rolling=True, plane=True)


def spalled() -> br.Scene:
    scene = br.presets.deep_groove_6205(radial_load=500.0, axial_load=500.0)
    spall = Defect(
        on="outer_race",
        angle=-1.5708,
        axial_offset=0.0,
        length=1.5e-3,
        width=0.8e-3,
        edge_radius=0.3e-3,
    )
    return replace(scene, defects={"spall": spall})


@pytest.mark.parametrize(
    ("approximations", "states"), [(Approximations(rolling=True), 48), (FLAT, 26)]
)
def test_impacts_keep_their_size_and_rate(approximations: Approximations, states: int) -> None:
    """The free model; bounds as measured in benches/records.md."""
    scene, fs = spalled(), 50_000.0
    runs = [
        br.simulate(replace(scene, approximations=wanted), duration=0.2, fs=fs)
        for wanted in (Approximations(), approximations)
    ]
    assert runs[1].provenance.states == states
    omitted = {o["what"] for o in runs[1].provenance.left_out if "by request" in o["reason"]}
    assert "orbit and spin of balls" in omitted
    rms, rates = [], []
    passing = br.frequencies.of_row(scene.rows[0]).bpfo * 30.0
    for out in runs:
        x = out["outer.ay"][int(0.02 * fs) :]
        spectrum = np.abs(np.fft.rfft(x)) ** 2
        spectrum[np.fft.rfftfreq(x.size, 1.0 / fs) > 10_000.0] = 0.0
        rms.append(float(np.sqrt(2.0 * spectrum.sum()) / x.size))
        squared = br.spectra.squared_envelope(x, fs, (500.0, 10_000.0))
        rates.append(br.spectra.line(squared, fs, passing, 0.05 * passing)[0])
    print(rms, rates)
    assert rms[0] > 1.0
    assert rms[1] == pytest.approx(rms[0], rel=0.25)
    assert rates[1] == pytest.approx(rates[0], rel=0.007)


def test_an_approximation_is_part_of_the_scene() -> None:
    scene = spalled().replace({"approximations.rolling": True})
    assert br.Scene.from_toml(scene.to_toml()) == scene
    assert "rolling = true" in scene.to_toml()
    assert not br.presets.wheel_bearing().approximations.rolling


def test_what_cannot_be_is_refused() -> None:
    scene = replace(spalled(), drive=TorqueDrive(value=1.0), approximations=FLAT)
    with pytest.raises(br.SceneError, match=r"approximations\.rolling.*drive\.torque"):
        br.simulate(scene, duration=1e-3)
    with pytest.raises(br.SceneError, match=r"approximations\.one_row.*two rows"):
        br.simulate(spalled().replace({"approximations.one_row": True}), duration=1e-3)


def test_a_healthy_bearing_is_offered_none() -> None:
    """Rolling hides what it does; that faulted ones are offered it is tested in the crate, without a clock."""
    for scene in (br.presets.deep_groove_6205(), replace(spalled(), defects={})):
        changes = {v["change"] for v in br.explain(scene).variants}
        assert not any("approximations" in change for change in changes)
