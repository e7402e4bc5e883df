"""Bearings of several rows, and records that are clipped, in a verdict.

Truth: analytic; the blows of ``test_diagnosis.py``, at the rate of one row.
"""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

import ballrace as br
from ballrace.diagnosis.kinematics import kinematics_of
from test_diagnosis import FS, ORDERS, RPM, blows, judged, noise

ONE = br.bearing("6205", radial_load=500.0, speed_rpm=RPM)


def two(other: br.scene.Row) -> br.Scene:
    """The row of a 6205 and another one, 20 mm apart."""
    rows = (ONE.rows[0], dataclasses.replace(other, axial_position=0.02))
    return dataclasses.replace(ONE, rows=rows)


UNLIKE = two(dataclasses.replace(ONE.rows[0], ball_count=8))
ALIKE = two(ONE.rows[0])


@pytest.mark.parametrize("row", [0, 1])
def test_the_row_whose_rate_blows_have_is_named(row: int) -> None:
    order = kinematics_of(UNLIKE, row).orders.bpfo
    found = judged(noise(blows(order), 0.3), UNLIKE)
    assert found.parts == ("outer_race",)
    assert found.bearing.endswith(f", row {row}")
    assert f"row {1 - row}: damaged" not in found.notes
    assert any(note.startswith(f"row {1 - row}: ") for note in found.notes)
    alone = judged(noise(blows(order), 0.3), UNLIKE, row=row)
    assert alone.evidence["outer_race"].z == found.evidence["outer_race"].z


def test_rows_with_the_same_orders_are_judged_as_one() -> None:
    found = judged(noise(blows(ORDERS.bpfi, 1.0), 0.3), ALIKE)
    assert found.parts == ("inner_race",)
    assert found.bearing.endswith(", rows 0 and 1")
    assert found.notes[-1].startswith("rows 0 and 1 have the same orders")
    assert found.false_alarm == 0.01


def test_rows_share_the_rate_of_false_alarms() -> None:
    found = judged(
        np.random.default_rng(3).normal(size=24_000), UNLIKE, false_alarm=0.02, speed_within=1e-3
    )
    assert found.verdict == "healthy"
    assert found.false_alarm == 0.01


def test_a_clipped_record_that_accuses_has_its_note_on_the_page(tmp_path: Path) -> None:
    x = np.clip(noise(blows(ORDERS.bpfo), 0.3), -1.0, 1.0)
    found = judged(x)
    assert found.parts == ("outer_race",)
    (note,) = (each for each in found.notes if "clipped" in each)
    found.report(tmp_path / "page.html")
    assert note in (tmp_path / "page.html").read_text(encoding="utf-8")


def test_clipping_of_a_measurement_is_reported_once() -> None:
    x = noise(blows(ORDERS.bpfo), 0.3)
    with pytest.warns(br.AccuracyWarning, match="clipped"):
        sensed = br.measure(
            x, fs=FS, shaft=RPM / 60.0, logger=br.measuring.Logger(fs=FS, range=1.0)
        )
    found = br.diagnose(sensed, "6205")
    assert sum("clipped" in note for note in found.notes) == 1
