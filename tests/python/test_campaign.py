"""A table in, a table out: what rows mean, what comes back, and that it is the same whoever runs it."""

from __future__ import annotations

import io
import json
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import polars as pl
import pytest

import ballrace as br
from ballrace.campaigns import Progress
from ballrace.campaigns.progress import Counts, ProgressDisplay
from sweeps import DURATION, SCENE, comparable, run, same, table


def test_any_number_of_threads_gives_the_same_bits(tmp_path: Path) -> None:
    one = run(table(9), tmp_path / "one", threads=1)
    three = run(table(9), tmp_path / "three", threads=3)
    assert same(one, three)
    assert one.manifest["loads.radial.force"].to_list() == table(9)["loads.radial.force"].to_list()
    assert one.manifest["status"].to_list() == ["failed"] + 8 * ["ok"]


def test_signals_are_those_of_a_run_alone(tmp_path: Path) -> None:
    done = run(table(4), tmp_path, keep="signals", threads=2)
    case_id = done.manifest["case_id"][2]
    alone = br.simulate(done.scene(case_id), duration=DURATION, settle=0.0)
    assert done.signals(case_id).equals(alone.to_polars())
    scanned = done.scan().collect()
    assert scanned["case_id"].to_list() == sorted(scanned["case_id"])
    assert scanned.filter(case_id=case_id).drop("case_id").equals(alone.to_polars())
    assert scanned.height == 3 * alone.t.size
    with pytest.raises(KeyError, match="no case"):
        done.signals(done.manifest["case_id"][0])


def test_a_cage_that_is_a_ring_varies_in_a_campaign(tmp_path: Path) -> None:
    """Truth: runs alone."""
    scene = br.bearing("6205", radial_load=500.0, speed_rpm=1800.0)
    path = "cage.ring.pocket_clearance"
    cases = [{path: 0.0}, {path: 80e-6}]
    done = run(cases, tmp_path, scene=scene, duration=DURATION, keep="signals")
    for row in done.manifest.iter_rows(named=True):
        alone = br.simulate(scene.replace({path: row[path]}), duration=DURATION, settle=0.0)
        assert done.signals(row["case_id"]).equals(alone.to_polars())
    first, second = (done.signals(case_id) for case_id in done.manifest["case_id"])
    assert not first.equals(second)


def test_features_are_those_of_the_signals(tmp_path: Path) -> None:
    """Another implementation: `ballrace.spectra` finds the same lines, or where they reach into the range."""
    scene = br.presets.wheel_bearing(3000.0)
    cases = [{"loads.axial.force": 3000.0}]
    options: dict[str, Any] = {"skip": 5e-3, "band": (500.0, 20e3), "columns": ["outer.ay"]}
    options["contact_loads"] = True
    done = run(cases, tmp_path, scene=scene, duration=0.035, keep="signals", **options)
    row = done.manifest.row(0, named=True)
    x = done.signals(row["case_id"])["outer.ay"].to_numpy()[250:]
    assert row["outer.ay.rms"] == pytest.approx(np.sqrt(np.mean(x**2)), rel=1e-12)
    assert row["outer.ay.peak"] == np.abs(x).max()
    assert row["outer.ay.crest_factor"] == pytest.approx(
        row["outer.ay.peak"] / row["outer.ay.rms"], rel=1e-12
    )
    centred = x - x.mean()
    kurtosis = np.mean(centred**4) / np.mean(centred**2) ** 2
    assert row["outer.ay.kurtosis"] == pytest.approx(kurtosis, rel=1e-9)

    orders = br.fault_frequencies(br.simulate(scene, duration=0.035))
    envelope = br.spectra.squared_envelope(x, 50e3, (500.0, 20e3))
    width = 1.0 / 0.03
    for name, near in (("bpfo", orders.bpfo), ("bpfi", orders.bpfi), ("2bsf", 2.0 * orders.bsf)):
        if near < 2.0 * width:
            continue
        for suffix, signal in (("", x), ("_envelope", envelope)):
            _, value = br.spectra.line(signal, 50e3, near, width)
            # Next to nothing is not a line, whose summit both would find.
            found = row[f"outer.ay.row0.{name}{suffix}"]
            assert found == pytest.approx(value, rel=2e-3, abs=1e-5 * signal.std()), name
    assert "outer.ay.row0.ftf" not in done.manifest.columns  # the record is too short
    assert row["row0.outer.load_max"] > 500.0


def test_labels_and_faults_are_carried(tmp_path: Path) -> None:
    scene = br.presets.wheel_bearing()
    cases = [
        {"defects.spall.width": 0.0, "label": "healthy", "bearing_id": 1},
        {"defects.spall.width": 1e-3, "label": "spalled", "bearing_id": 1},
    ]
    # A ball comes to the spall after a millisecond.
    scene = scene.replace({"defects.spall.angle": scene.rows[0].start_angle + 0.1})
    done = run(cases, tmp_path, scene=scene, duration=3e-3)
    columns = ["label", "bearing_id", "fault_outer_race", "fault_inner_race", "fault_ball"]
    assert done.manifest.select(columns).rows() == [
        ("healthy", 1, False, False, False),
        ("spalled", 1, True, False, False),
    ]


def test_a_column_scene_chooses(tmp_path: Path) -> None:
    scenes = {"small": SCENE, "wheel": br.presets.wheel_bearing()}
    cases = [{"scene": "wheel"}, {"scene": "small", "duration": 1e-3}, {"scene": "tall"}]
    done = run(cases, tmp_path, scene=scenes, start="rolling", keep="signals")
    assert done.manifest["status"].to_list() == ["ok", "ok", "failed"]
    assert "scene = tall: one of small, wheel" in done.manifest["message"][2]
    wheel, small = done.manifest["case_id"].to_list()[:2]
    assert done.scene(wheel) == scenes["wheel"].validate()
    assert (done.signals(wheel).height, done.signals(small).height) == (100, 50)
    with pytest.raises(br.SceneError, match="no column scene"):
        run(table(2), tmp_path / "other", scene=scenes)


@pytest.mark.parametrize("kind", ["polars", "lazy", "pandas", "arrow", "dicts", "columns"])
def test_tables_of_every_kind(kind: str, tmp_path: Path) -> None:
    frame = pl.DataFrame({"loads.radial.force": [300.0, None], "label": ["a", "b"]})
    made: dict[str, object] = {
        "polars": frame,
        "lazy": frame.lazy(),
        "pandas": pd.DataFrame(frame.to_dicts()),
        "arrow": frame.to_arrow(),
        "dicts": [{"loads.radial.force": 300, "label": "a"}, {"label": "b"}],
        "columns": frame.to_dict(as_series=False),
    }
    done = run(made[kind], tmp_path, duration=2e-4)
    assert done.manifest["loads.radial.force"].to_list() == [300.0, None]
    # An empty cell leaves the scene as it is.
    assert done.scene(done.manifest["case_id"][1]).loads["radial"].force == 500.0
    ids = [done.manifest["case_id"][i] for i in range(2)]
    again = run(frame, tmp_path / "again", duration=2e-4)
    assert again.manifest["case_id"].to_list() == ids


def test_values_of_any_shape(tmp_path: Path) -> None:
    """A force that changes in time and a list are values like others; so is a whole part of the scene."""
    ramp = br.scene.Ramp(from_=100.0, to=500.0, start=0.0, end=1e-3)
    cases = [
        {"loads.radial.force": ramp, "rows[0].diameter_errors": 9 * [1e-6]},
        {"loads.radial.force": 250, "friction": "none"},
    ]
    done = run(cases, tmp_path, start="rolling")
    assert done.manifest["status"].to_list() == ["ok", "ok"]
    first = done.scene(done.manifest["case_id"][0])
    assert first.loads["radial"].force == ramp
    assert first.rows[0].diameter_errors == 9 * (1e-6,)
    assert json.loads(done.manifest["loads.radial.force"][0])["ramp"]["to"] == 500.0


def test_rows_of_the_same_case_run_once(tmp_path: Path) -> None:
    seen: list[Progress] = []
    cases = [{"loads.radial.force": 300.0, "label": label} for label in "abc"]
    done = run(cases, tmp_path, progress=seen.append)
    assert seen[-1].total == 1
    assert done.manifest["status"].to_list() == ["ok"] * 3
    assert done.manifest["outer.ay.rms"].n_unique() == 1


def test_a_failed_case_is_a_row(tmp_path: Path) -> None:
    cases = [
        {"rows[0].ball_diameter": -1.0},
        {"loads.radial.force": 0.0},
        {"rows[0].ball_diameter": float("nan")},
        {"loads.radial.force": 300.0},
    ]
    done = run(cases, tmp_path)
    assert done.manifest["error"].to_list() == [
        "SceneError",
        "EquilibriumError",
        "SceneError",
        None,
    ]
    assert "rows[0].ball_diameter = -1" in done.failed["message"][0]
    assert done.manifest["outer.ay.rms"].is_null().to_list() == [True, True, True, False]
    seen: list[Progress] = []
    run(cases, tmp_path, progress=seen.append)
    assert not seen, "failed cases are finished"


def test_on_error_raise(tmp_path: Path) -> None:
    with pytest.raises(br.SceneError, match="ball_diameter"):
        run([{"rows[0].ball_diameter": -1.0}], tmp_path / "a", on_error="raise")
    assert not (tmp_path / "a").exists()
    cases = table(6).reverse()
    with pytest.raises(br.EquilibriumError):
        run(cases, tmp_path / "b", on_error="raise", threads=1)
    done = br.Campaign.open(tmp_path / "b").manifest
    assert done["status"].to_list() == 5 * ["ok"] + ["missing"]


@pytest.mark.parametrize(
    ("cases", "options", "message"),
    [
        ([], {}, "cases = an empty table: at least one row"),
        (3, {}, "cases = int: a table"),
        (
            [{"loads.axal.force": 1.0}],
            {},
            "loads.axal.force = axal: no such field, perhaps axial; there are: axial",
        ),
        ([{"rows[3].clearance": 1.0}], {}, "an index below 1"),
        ([{"status": "new"}], {}, "status = a column of cases: another name"),
        ([{"scene": "a"}], {}, "several scenes by name"),
        ([{}], {"duration": -1.0}, "duration = -1: above 0"),
        ([{}], {"start": "running"}, "start = 'running'"),
        ([{}], {"columns": ["outer.by"]}, "columns = outer.by: columns of the scene's probes"),
        ([{}], {"keep": "all"}, "keep = 'all': one of"),
        ([{}], {"threads": 0}, "threads = 0: a whole number, at least 1"),
        ([{}], {"shard": (2, 2)}, "shard = 2/2"),
        ([{}], {"scene": "wheel"}, "scene = 'wheel': a Scene"),
    ],
)
def test_bad_input_gets_one_clear_error(
    cases: Any, options: dict[str, Any], message: str, tmp_path: Path
) -> None:
    with pytest.raises(br.SceneError) as caught:
        run(cases, tmp_path / "runs", **options)
    assert message in str(caught.value)
    assert not (tmp_path / "runs").exists()


def test_dry_run_writes_nothing(tmp_path: Path) -> None:
    options: dict[str, Any] = {
        "scene": SCENE,
        "duration": DURATION,
        "keep": "signals",
        "settle": 0.0,
    }
    found = br.campaign(table(5), tmp_path / "runs", dry_run=True, **options)
    assert not (tmp_path / "runs").exists()
    assert (found.total, found.missing) == (5, 5)
    assert found.seconds > 0.0
    done = br.campaign(table(5), tmp_path / "runs", progress=False, **options)
    kept = sum(path.stat().st_size for path in (tmp_path / "runs").rglob("*") if path.is_file())
    # Of the five one fails and keeps nothing.
    assert 0.5 < found.bytes / kept < 2.0
    again = br.campaign(table(5), tmp_path / "runs", dry_run=True, **options)
    assert (again.total, again.missing, again.bytes) == (5, 0, 0)
    assert "0 of 5 cases to run" in str(again)
    assert done.manifest.height == 5


def test_progress_is_a_line_or_a_callback(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    run(table(4), tmp_path / "a", progress=True)
    assert capsys.readouterr().err.startswith("campaign: 4 of 4 cases, 1 failed, ")
    seen: list[Progress] = []
    run(table(4), tmp_path / "b", progress=seen.append)
    assert [p.done for p in seen] == sorted(p.done for p in seen)
    last = seen[-1]
    assert (last.total, last.done, last.failed, last.left) == (4, 4, 1, 0.0)
    assert last.rate > 0.0

    def stop(progress: Progress) -> None:
        raise TimeoutError

    with pytest.raises(TimeoutError):
        run(table(40), tmp_path / "c", progress=stop)
    assert capsys.readouterr().err == ""


def test_a_terminal_sees_a_bar() -> None:
    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    stream = Terminal()
    display = ProgressDisplay(progress=True, total=10, before=2, stream=stream)
    display.update(Counts(done=3, failed=1))
    bar = stream.getvalue()
    assert bar.startswith(f"\r[{15 * '#'}{15 * '.'}] 5/10, 1 failed, ")
    assert bar.rstrip().endswith(" s left")
    display.end()
    assert "campaign: 5 of 10 cases, 2 from before, 1 failed, " in stream.getvalue()
    assert stream.getvalue().endswith("\n")


def test_shards_make_up_the_whole(tmp_path: Path) -> None:
    whole = run(table(7), tmp_path / "whole")
    for part in (2, 0, 1):
        assert not (tmp_path / "parts" / "manifest.parquet").exists()
        done = run(table(7), tmp_path / "parts", shard=(part, 3))
    assert same(whole, done)
    written = pl.read_parquet(tmp_path / "parts" / "manifest.parquet")
    assert comparable(written).equals(comparable(whole.manifest), null_equal=True)
