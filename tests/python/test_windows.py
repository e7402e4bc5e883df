"""Tables for learning: each window has all that is known of it."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import polars as pl
import pytest

import ballrace as br
from ballrace.scene import Ramp, Sine, Table, TorqueDrive

if TYPE_CHECKING:
    from collections.abc import Callable


SCENE = br.presets.wheel_bearing(axial_load=500.0)


@pytest.fixture(scope="module")
def run() -> br.Signals:
    return br.simulate(SCENE, duration=0.01, fs=20_000, start="rolling", settle=0.0)


def test_windows_are_the_samples(run: br.Signals) -> None:
    table = run.to_windows(64, 48, columns=("outer.ay", "outer.ax"))
    starts = range(0, 200 - 64 + 1, 48)
    assert table.height == len(starts)
    for row, start in zip(table.to_dicts(), starts, strict=True):
        assert row["outer.ay"] == np.float32(run["outer.ay"][start : start + 64]).tolist()
        assert row["outer.ax"] == np.float32(run["outer.ax"][start : start + 64]).tolist()
        assert row["start"] == pytest.approx(start / 20_000)
    assert run.to_windows(64).height == 3


def test_a_measurement_has_the_labels_of_its_run() -> None:
    """A load that rises by 100 N/s, of which half a second is over when the measurement begins."""
    load = Ramp(from_=100.0, to=200.0, start=0.0, end=1.0)
    scene = br.bearing("6205", defects=br.defects.spall(on="ball", width_mm=1.0), speed_rpm=1800.0)
    scene = scene.replace({"loads.radial.force": load})
    x = np.arange(100.0)
    sensed = br.measuring.Measurement(x=x, fs=1000.0, start=0.5, scene=scene)
    table = sensed.to_windows(40, bearing_id="A")
    assert table["sensor"].to_list() == [x[:40].tolist(), x[40:80].tolist()]
    assert (table["label"][0], table["bearing_id"][0], table["start"][1]) == ("ball", "A", 0.04)
    forces = {each["name"]: each["force"] for each in table["load"][1]}
    assert forces["radial"] == pytest.approx(156.0)
    assert table["units"][0] == {"sensor": "m/s^2"}
    alone = br.measuring.Measurement(x=x, fs=1000.0, shaft=25.0).to_windows(40, label="worn")
    assert (alone["label"][0], alone["speed"][0]) == ("worn", pytest.approx(50.0 * math.pi))


def test_a_row_has_what_it_is_of(run: br.Signals) -> None:
    row = run.to_windows(100, bearing_id=7, columns="outer.ay").row(0, named=True)
    assert (row["label"], row["bearing_id"], row["sampling_rate"]) == ("outer_race", 7, 20_000.0)
    assert row["speed"] == SCENE.drive.speed  # type: ignore[union-attr]
    assert {load["name"]: load["force"] for load in row["load"]} == {
        "axial": 500.0,
        "radial": 7000.0,
    }
    assert [rows["ball_count"] for rows in row["geometry"]] == [r.ball_count for r in SCENE.rows]
    (defect,) = row["defect"]
    spall = SCENE.defects["spall"]
    assert (defect["name"], defect["on"], defect["width"]) == ("spall", "outer_race", spall.width)
    assert row["units"] == {"outer.ay": "m/s^2"}
    assert row["version"] == run.provenance.version
    # All accelerations where no columns are named.
    assert {n for n in run.to_windows(100).columns if "." in n} == {
        name for name in run if run.units[name] == "m/s^2"
    }


@pytest.mark.parametrize(
    ("speed", "wanted"),
    [
        (100.0, [100.0, 100.0]),
        (Ramp(from_=100.0, to=200.0, start=0.0, end=0.01), [125.0, 175.0]),
        (Table(times=(0.0, 0.005, 0.01), values=(100.0, 100.0, 140.0)), [100.0, 120.0]),
        (Sine(mean=100.0, amplitude=8.0, frequency=100.0, phase=0.0), [108.0, 92.0]),
    ],
)
def test_speed_and_load_are_those_of_the_middle(speed: Any, wanted: list[float]) -> None:
    scene = SCENE.replace({"drive": br.scene.SpeedDrive(speed)})
    jump = Ramp(from_=1.0, to=2.0, start=0.005, end=0.005)
    scene = scene.replace({"loads.axial.force": jump})
    run = br.simulate(scene, duration=0.01, fs=20_000, start="rolling", settle=0.0)
    table = run.to_windows(100, columns="outer.ay")
    assert table["speed"].to_list() == pytest.approx(wanted)
    axial = [next(x["force"] for x in loads if x["name"] == "axial") for loads in table["load"]]
    assert axial == [1.0, 2.0]


def test_without_defects_or_a_given_speed() -> None:
    scene = br.presets.deep_groove_6205().replace({"drive": TorqueDrive(value=0.1)})
    run = br.simulate(scene, duration=2e-3, fs=20_000, start="rolling", settle=0.0)
    row = run.to_windows(40).row(0, named=True)
    assert (row["label"], row["defect"], row["speed"]) == ("healthy", [], None)
    assert run.to_windows(40, label="good")["label"][0] == "good"


def test_a_recording_has_what_it_knows() -> None:
    record = br.Recording(columns={"DE": np.arange(10.0)}, fs=12e3, units={"DE": "g"}, shaft=30.0)
    row = record.to_windows(10, label="inner_race").row(0, named=True)
    assert row["speed"] == pytest.approx(60.0 * math.pi)
    assert (row["load"], row["geometry"], row["defect"], row["version"]) == (None,) * 4
    assert record.to_windows(10)["label"][0] is None


def test_windows_of_many_records_are_one_table(run: br.Signals, tmp_path: Path) -> None:
    """The columns of a table have the same types whatever is known."""
    record = br.Recording(
        columns={"outer.ay": np.arange(200.0)}, fs=20e3, units={"outer.ay": "m/s^2"}
    )
    tables = [
        x.to_windows(50, columns="outer.ay", bearing_id=bearing)
        for x, bearing in ((run, "a"), (record, None))
    ]
    path = tmp_path / "windows.parquet"
    pl.concat(tables).write_parquet(path)
    again = pl.read_parquet(path)
    assert again.height == 8
    assert again.schema["outer.ay"] == pl.Array(pl.Float32, 50)
    parquet = pytest.importorskip("pyarrow.parquet")
    assert (
        parquet.read_table(path).to_pylist()[0]["outer.ay"]
        == np.float32(run["outer.ay"][:50]).tolist()
    )


def test_bad_arguments_are_refused(run: br.Signals) -> None:
    calls: list[tuple[str, Callable[[], object]]] = [
        ("length", lambda: run.to_windows(0)),
        ("length", lambda: run.to_windows(201)),
        ("length", lambda: run.to_windows(2.5)),  # type: ignore[arg-type]
        ("hop", lambda: run.to_windows(10, 0)),
        ("columns", lambda: run.to_windows(10, columns="outer.jerk")),
    ]
    for name, call in calls:
        with pytest.raises(br.SceneError) as caught:
            call()
        assert caught.value.path == name
