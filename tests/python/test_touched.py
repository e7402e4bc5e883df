"""Defects lie where contacts run; runs, explanations and campaigns report which of them were touched.

Truth: the static equilibrium for the place, and a healthy bearing for what is not touched.
"""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import polars as pl
import pytest

import ballrace as br
from ballrace.scene import AxialOffset, Defect
from sweeps import run

INNER = Defect(
    on="inner_race", angle=-math.pi / 2 - 0.2, length=2e-3, width=1e-3, edge_radius=0.3e-3
)
DURATION = 4e-3


def angular_7208(**defects: Defect) -> br.Scene:
    """Return an angular-contact bearing 7208 (40°) under thrust."""
    scene = br.presets.deep_groove_6205(500.0, 3000.0, 3000.0)
    row = replace(
        scene.rows[0], ball_count=15, ball_diameter=11.112e-3, pitch_diameter=60e-3,
        contact_angle=math.radians(40.0), clearance=0.0, outer_conformity=0.52, inner_conformity=0.52,
    )  # fmt: skip
    return replace(
        scene,
        name="angular contact 7208",
        rows=(row,),
        outer_ring=replace(scene.outer_ring, diameter=80e-3, width=18e-3),
        inner_ring=replace(scene.inner_ring, diameter=40e-3, width=18e-3),
        defects=defects,
    )


def rms(out: br.Signals) -> float:
    return float(np.sqrt(np.mean(out["outer.ay"] ** 2)))


def test_by_default_a_spall_lies_where_the_contact_runs(tmp_path: Path) -> None:
    scene = angular_7208(spall=INNER)
    healthy = rms(br.simulate(angular_7208(), duration=DURATION))
    out = br.simulate(scene, duration=DURATION)
    at = br.equilibrium(angular_7208())
    ran = at.inner_zone_centre[np.argmax(at.inner_load)]
    defect = out.defects["spall"]
    assert defect.axial_offset == out.scene.defects["spall"].axial_offset
    assert defect.axial_offset == pytest.approx(ran, abs=1e-9)
    assert (defect.placed, defect.on, defect.share) == ("contact", "inner_race", 1.0)
    assert defect.largest_load > 50.0
    assert rms(out) > 10.0 * healthy
    assert out.warnings == ()

    out.write_parquet(tmp_path / "out.parquet")
    read = br.Signals.read_parquet(tmp_path / "out.parquet")
    assert read.defects == out.defects
    assert read.scene == out.scene
    assert isinstance(out.defects["spall"], br.signals.Touched)


def test_what_is_not_touched_is_warned_of() -> None:
    missed = angular_7208(spall=replace(INNER, axial_offset=0.0))
    with pytest.warns(
        br.SceneWarning, match=r"\"spall\" was never touched: balls passed it \d+ times"
    ):
        out = br.simulate(missed, duration=DURATION)
    assert out.defects["spall"].share == 0.0
    assert out.defects["spall"].placed == "given"
    with pytest.warns(br.SceneWarning, match='no ball passed defect "spall" in 0.0001 s'):
        out = br.simulate(missed, duration=1e-4)
    assert out.defects["spall"].share is None
    assert br.simulate(angular_7208(), duration=1e-4).defects == {}


def test_an_explanation_has_the_place() -> None:
    explanation = br.explain(angular_7208(spall=INNER))
    assert explanation.defects[0]["placed"] == "contact"
    assert "touched at 15 of 15 places of a turn" in str(explanation)
    missed = br.explain(angular_7208(spall=replace(INNER, axial_offset=0.0)))
    assert missed.defects[0]["touched"] == 0
    assert "not touched: contacts run at" in str(missed)


@pytest.mark.parametrize("offset", ["contact", 1.5e-3])
def test_places_go_through_documents(offset: AxialOffset) -> None:
    scene = angular_7208(spall=replace(INNER, axial_offset=offset))
    assert br.Scene.from_toml(scene.to_toml()) == scene
    assert br.Scene.from_json(scene.to_json()) == scene
    other = scene.replace({"defects.spall.axial_offset": 1e-3})
    assert other.defects["spall"].axial_offset == 1e-3
    assert other.replace({"defects.spall.axial_offset": offset}) == scene
    with pytest.raises(
        br.SceneError, match=r'defects.spall.axial_offset.*a number \[m\], or "contact"'
    ):
        scene.replace({"defects.spall.axial_offset": "middle"})


def test_labels_of_a_campaign_follow_what_was_touched(tmp_path: Path) -> None:
    """A spall that is met, one that is missed, one that no ball comes to in time, none, and a case that fails."""
    cases = [
        {"label": "met"},
        {"label": "missed", "defects.spall.axial_offset": 0.0},
        {"label": "too short", "duration": 1e-4},
        {"label": "healthy", "defects.spall.width": 0.0},
        {"label": "too long", "defects.spall.length": 20e-3},
    ]
    done = run(cases, tmp_path, scene=angular_7208(spall=INNER), duration=DURATION)
    faults = ["fault_outer_race", "fault_inner_race", "fault_ball"]
    rows = {row["label"]: row for row in done.manifest.iter_rows(named=True)}
    assert {label: tuple(row[fault] for fault in faults) for label, row in rows.items()} == {
        "met": (False, True, False),
        "missed": (False, False, False),
        "too short": (False, None, False),
        "healthy": (False, False, False),
        "too long": (None, None, None),
    }
    assert rows["too long"]["status"] == "failed"
    assert done.manifest.schema["fault_ball"] == pl.Boolean
    touched = {label: row["defects.spall.touched"] for label, row in rows.items()}
    assert touched == {
        "met": 1.0,
        "missed": 0.0,
        "too short": None,
        "healthy": None,
        "too long": None,
    }
    assert rows["met"]["defects.spall.passes"] >= 1.0
    assert rows["too short"]["defects.spall.passes"] == 0.0
    assert rows["missed"]["defects.spall.placed_at"] == 0.0
    alone = br.simulate(angular_7208(spall=INNER), duration=DURATION, settle=0.0).defects["spall"]
    assert rows["met"]["defects.spall.placed_at"] == alone.axial_offset
    assert rows["met"]["defects.spall.largest_load"] == alone.largest_load


def test_a_grid_may_hold_both(tmp_path: Path) -> None:
    table = br.grid({"defects.spall.axial_offset": ["contact", 0.0]})
    done = run(table, tmp_path, scene=angular_7208(spall=INNER), duration=DURATION)
    assert done.manifest["fault_inner_race"].to_list() == [True, False]
