"""What a run leaves out, from Python: the truth is the full model."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import ballrace as br
from ballrace.cli import main


def plane() -> br.Scene:
    return br.presets.deep_groove_6205(radial_load=500.0).replace({"friction": "none"})


def test_reduced_and_full_signals_agree() -> None:
    """Analytic: the same motion with half the states, over the first half of a millisecond."""
    scene = plane()
    out, full = (
        br.simulate(
            scene, duration=5e-4, fs=100_000, rtol=1e-9, reduce=reduce, settle=0.0, bandwidth=None
        )
        for reduce in (True, False)
    )
    assert (out.provenance.states, full.provenance.states) == (44, 88)
    assert {"z", "spin of balls"} <= {o["what"] for o in out.provenance.left_out}
    assert full.provenance.left_out == []
    for name in ("outer.ay", "inner.ay", "inner.y"):
        scale = np.abs(full[name]).max()
        np.testing.assert_allclose(out[name], full[name], rtol=0.0, atol=1e-5 * scale)
    assert not out["inner.z"].any()


def test_reduce_is_part_of_the_scene() -> None:
    scene = plane().replace({"solver.reduce": False})
    assert br.simulate(scene, duration=1e-4, settle=0.0).provenance.states == 88
    assert br.Scene.from_toml(scene.to_toml()) == scene


def test_a_scene_is_explained() -> None:
    """Analytic: counts by hand; costs are only put in order."""
    summary = br.Model(plane()).summary()
    assert (summary.bodies, summary.states, summary.kept) == (11, 88, 44)
    assert sum(2 * o["degrees"] for o in summary.omissions) == 44
    assert all(c["evaluation"].startswith("3 of 6 nodes") for c in summary.contacts)
    assert summary.constant == ["gravity", "load"]
    assert {"friction", "defects", "waviness"} <= set(summary.absent)
    assert summary.cost.seconds == pytest.approx(summary.cost.evaluations * summary.cost.evaluation)
    seconds = [v["seconds"] for v in summary.variants]
    assert seconds == sorted(seconds)
    assert "44 of 88 are integrated" in str(summary)
    assert "note     nothing drives the balls' orbit" in str(summary)
    assert br.explain(br.presets.deep_groove_6205()).notes == []

    thrust = br.explain(plane().replace({"loads.axial.force": 1.0}))
    reasons = {o["what"]: o["reason"] for o in thrust.obstacles}
    assert reasons["motion in the plane"] == 'load "axial" acts along z'


def test_the_command_explains(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(plane().to_toml())
    assert main(["explain", str(path)]) == 0
    assert "mirror symmetry" in capsys.readouterr().out
    assert main(["explain", str(path), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["kept"] == 44
    assert main(["explain", str(tmp_path / "none.toml")]) == 2
