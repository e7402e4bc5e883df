"""Runs begin settled: the start has died down before t = 0, and no feature of a campaign contains it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import ballrace as br
from ballrace.cli import main
from ballrace.cli.campaigns import read

COLUMN = "outer.ay"


def test_it_is_reported_and_may_be_switched_off() -> None:
    scene = br.presets.wheel_bearing()
    out = br.simulate(scene, duration=1e-3)
    assert 5e-3 < out.provenance.settled < 0.1
    assert out.stats.settling_nfev > out.stats.nfev
    off = br.simulate(scene, duration=1e-3, settle=0.0)
    assert (off.provenance.settled, off.stats.settling_nfev) == (0.0, 0)
    state = br.Model(scene).start("equilibrium")
    given = br.simulate(scene, duration=1e-3, start=state)
    assert given.provenance.settled == 0.0
    assert np.array_equal(given[COLUMN], off[COLUMN])
    assert br.simulate(scene, duration=1e-3, start="rolling").provenance.settled == 0.0
    asked = br.simulate(scene, duration=1e-3, start="rolling", settle=2e-3)
    assert (asked.provenance.settled, asked.t[0]) == (2e-3, 0.0)


@pytest.mark.parametrize("settle", [-1.0, float("nan"), 1e9])
def test_nonsense_is_refused(settle: float, tmp_path: Path) -> None:
    scene = br.presets.wheel_bearing()
    with pytest.raises(br.SceneError, match="settle"):
        br.simulate(scene, duration=1e-3, settle=settle)
    with pytest.raises(br.SceneError, match="settle"):
        br.campaign([{}], tmp_path / "runs", scene=scene, duration=1e-3, settle=settle)


def test_features_do_not_contain_the_start(tmp_path: Path) -> None:
    """Unsettled, the first 30 ms of a healthy 6205 have ten times the rms of the following."""
    scene = br.presets.deep_groove_6205()
    cases = [{"duration": 0.03}, {"duration": 0.1}, {"duration": 0.03, "settle": 0.0}]
    done = br.campaign(cases, tmp_path, scene=scene, columns=[COLUMN], progress=False)
    short, long, unsettled = done.manifest[f"{COLUMN}.rms"]
    print(short, long, unsettled)
    assert 0.7 < short / long < 1.4
    assert unsettled > 4.0 * long


def test_the_command_line_and_sweeps_know_it(tmp_path: Path) -> None:
    scene, out = tmp_path / "scene.toml", tmp_path / "out.parquet"
    scene.write_text(br.presets.wheel_bearing().to_toml())
    arguments = ["run", str(scene), "-o", str(out), "--duration", "0.001"]
    assert main([*arguments, "--settle", "0.003"]) == 0
    assert br.Signals.read_parquet(out).provenance.settled == 3e-3
    sweep = tmp_path / "sweep.toml"
    sweep.write_text('scene = "wheel-bearing"\nsettle = 0.0\n[grid]\nduration = [0.001]\n')
    assert read(sweep)["settle"] == 0.0
