"""Defaults of a scene written by hand, and the doubts about it; the numbers themselves are tested in Rust."""

from __future__ import annotations

import dataclasses
import json
import warnings
from pathlib import Path

import numpy as np
import pytest

import ballrace as br
from ballrace.cli import main


@pytest.fixture
def scene() -> br.Scene:
    """A 6205 as someone writes it who knows its catalogue page."""
    row = br.scene.Row(
        ball_count=9,
        ball_diameter=7.94e-3,
        pitch_diameter=39.04e-3,
        outer_conformity=0.525,
        inner_conformity=0.515,
        start_angle=-np.pi / 2.0,
    )
    load = br.scene.Load(ring="inner", direction=(0.0, -1.0, 0.0), force=500.0)
    return br.scene.Scene(
        rows=(row,),
        inner_ring=br.scene.Ring(mass=1.0),
        drive=br.scene.SpeedDrive(188.5),
        loads={"radial": load},
    )


@pytest.fixture
def doubtful() -> br.Scene:
    return br.presets.deep_groove_6205(500.0).replace({"rows[0].start_angle": -90.0})


def test_a_scene_that_names_no_law_has_hertz(scene: br.Scene) -> None:
    """Truth: Hertz's 8.9 µm at 500 N, the paper's law's 25.7."""
    assert scene.contact.law == "hertz"
    assert -br.equilibrium(scene).inner[1] == pytest.approx(8.9e-6, abs=1e-7)
    paper = scene.replace({"contact.law": br.scene.Iso16281()})
    assert -br.equilibrium(paper).inner[1] == pytest.approx(25.7e-6, abs=1e-7)
    assert isinstance(br.presets.wheel_bearing().contact.law, br.scene.Iso16281)


def test_without_probes_what_can_move_is_recorded(scene: br.Scene) -> None:
    out = br.simulate(scene, duration=1e-3)
    assert {name.split(".")[0] for name in out} == {"inner"}
    assert all(np.ptp(out[f"inner.{name}"]) > 0.0 for name in ("vy", "ay", "theta"))


def test_a_run_reports_columns_that_cannot_change(scene: br.Scene) -> None:
    probe = br.scene.MotionProbe(body="outer", components=("ax", "ay"))
    with pytest.warns(br.SceneWarning, match=r"probes\.a = a\.ax, a\.ay: these columns never"):
        out = br.simulate(scene.replace({"probes": {"a": probe}}), duration=1e-4)
    assert len(out.warnings) == 1


def test_statics_report_doubts_and_pressures(scene: br.Scene, doubtful: br.Scene) -> None:
    """Truth: 1544.5 MPa on the inner race under Stribeck's 4.7 F/Z, and the cube root of the load by Hertz."""
    found = br.equilibrium(scene)
    assert found.warnings == scene.doubts() == ()
    assert [text.split(" =")[0] for text in doubtful.doubts()] == ["rows[0].start_angle"]
    assert found.inner_pressure.shape == (9,)
    load = found.inner_load.max()
    expected = 1544.47e6 * (load / (4.7 * 500.0 / 9.0)) ** (1.0 / 3.0)
    assert found.inner_pressure.max() == pytest.approx(expected, rel=1e-3)
    assert "outer_pressure" in found.to_polars().columns
    for solve in (br.equilibrium, br.stiffness, br.load_distribution):
        with pytest.warns(br.SceneWarning, match=r"start_angle = -90 rad: more than a turn"):
            solve(doubtful)
    heavy = br.presets.deep_groove_6205(20e3)
    with pytest.warns(br.SceneWarning, match="contact pressure = .* GPa: the static load rating"):
        assert br.equilibrium(heavy).inner_pressure.max() > 4.2e9


def test_a_campaign_reports_doubts_once_and_pressures_a_case(
    doubtful: br.Scene, tmp_path: Path
) -> None:
    table = br.grid({"loads.radial.force": [500.0, 4000.0]})
    with pytest.warns(br.SceneWarning, match="start_angle") as warned:
        done = br.campaign(
            table, tmp_path, scene=doubtful, duration=1e-3, settle=0.0, progress=False
        )
    assert len(warned) == 1
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", br.SceneWarning)
        found = [br.equilibrium(done.scene(case)) for case in done.manifest["case_id"]]
    # A run begins there, and in a millisecond the cage goes on by four degrees.
    expected = [eq.inner_pressure.max() for eq in found]
    np.testing.assert_allclose(done.manifest["largest_pressure"], expected, rtol=0.02)


def test_the_command_line_reports_doubts(
    doubtful: br.Scene, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(doubtful.to_toml())
    assert main(["explain", str(path)]) == 0
    text = capsys.readouterr().out
    assert "\ndoubtful   rows[0].start_angle = -90 rad" in text
    assert "\nlaw        Hertz's point contact: under " in text
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", br.SceneWarning)
        assert main(["equilibrium", str(path), "--json", "--stiffness", "--life"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert len(found["balls"]) == 9
    assert found["balls"][0]["outer_pressure"] > 1e8
    assert found["warnings"][0].startswith("rows[0].start_angle")
    assert np.shape(found["stiffness"]) == (3, 3)
    assert len(found["inner_equivalent"]) == 1


@pytest.mark.parametrize(
    ("changes", "path"),
    [
        ({"defects.spall.width": 1e-6}, "defects.spall.width = 0.001 mm"),
        ({"drive.speed": 3500.0}, "drive.speed = 3500 rad/s"),
        ({"loads.radial.force": 1.5, "loads.axial.force": 0.0}, "loads.radial.force = 1.5 N"),
        ({"contact.damping": 20.0}, "contact.damping = 20 s/m"),
        ({"rows[0].clearance": -100e-6}, "rows[0].clearance = -100 µm"),
        ({"rows[0].axial_preload": 10e-6}, "rows[0].axial_preload = 0.01 mm"),
        ({"loads.radial.at": (0.0, 0.0, -0.06)}, "loads.radial.at = "),
        (
            {
                "defects.spall.on": "ball",
                "defects.spall.ball": 0,
                "loads.axial.force": 2000.0,
            },
            "defects.spall.on = ball",
        ),
        ({"rows[0].texture": br.scene.Texture(outer=1e-7)}, "rows[0].texture.outer = 100 nm"),
    ],
)
def test_what_misleads_is_reported_by_its_field(changes: dict[str, object], path: str) -> None:
    """Truth: each was simulated without a word."""
    spall = br.defects.spall(on="outer_race", width_mm=1.0)
    scene = br.bearing("6205", radial_load=500.0, axial_load=50.0, defects=spall, speed_rpm=1800.0)
    assert scene.doubts() == ()
    changed = scene.replace(changes)
    assert [text for text in changed.doubts() if text.startswith(path)], changed.doubts()


def test_units_of_the_arguments_are_reported() -> None:
    """Truth: 29.95 turns a second are 1797 a minute, and a spall of a micrometre is none."""
    slow = br.bearing("6205", radial_load=500.0, speed_rpm=29.95)
    assert [text.split(" =")[0] for text in slow.doubts()] == ["drive.speed"]
    light = br.bearing("6205", radial_load=1.5, speed_rpm=1800.0)
    assert [text.split(" =")[0] for text in light.doubts()] == ["loads.radial.force"]


def test_thrust_away_from_the_contacts_is_doubted() -> None:
    """Truth: an angular contact bearing takes thrust one way; `br.bearing` refuses what `replace` lets by."""
    scene = br.bearing("7205B", radial_load=100.0, axial_load=500.0, speed_rpm=1800.0)
    assert scene.doubts() == ()
    (doubt,) = scene.replace({"loads.axial.force": -500.0}).doubts()
    assert doubt.startswith("thrust on the inner ring = -500 N: ")


def test_other_rings_without_other_rows_are_doubted() -> None:
    """Truth: 60 and 130 mm put the balls near 95 mm; rows of the catalogue lie in the middle of their own."""
    other = dataclasses.replace(
        br.catalogue["6310"], bore=60e-3, outside_diameter=130e-3, width=31e-3
    )
    (doubt,) = br.bearing(other, speed_rpm=1800.0).doubts()
    assert doubt.startswith("rows[0].pitch_diameter = 80 mm: ")
    for name in ("608", "6310", "61808", "16008", "6416", "7308B", "3308"):
        assert br.bearing(name, speed_rpm=1800.0).doubts() == ()
