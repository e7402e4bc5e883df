"""Data sets in the layout of ``bearing-datasets``, and splits by bearing.

Truth: limit, since samples and labels are those of the campaign; and the package itself, which has to accept what
is written, and whose own files have to be read.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
import pytest

import ballrace as br

CHAINS = {
    "plain": br.measuring.Chain(logger=br.measuring.Logger(fs=12_000.0)),
    "housed": br.measuring.Chain(
        path=br.measuring.random_housing(seed=1, band=(3_000.0, 9_000.0)),
        direction=(1.0, 0.0, 0.0),
    ),
}


def spalled(angle: float) -> br.Scene:
    spall = br.defects.spall(on="outer_race", width_mm=1.0, angle=np.radians(angle))
    return br.bearing("6205", radial_load=1000.0, speed_rpm=1797.0, defects={"spall": spall})


@pytest.fixture(scope="module")
def done(tmp_path_factory: pytest.TempPathFactory) -> br.Campaign:
    """Healthy; two spalls under the load; one 2.5 mm beside the contacts, which balls pass and never meet."""
    table = pl.DataFrame(
        {
            "defects.spall.width": [0.0, 1e-3, 1.5e-3, 1e-3],
            "defects.spall.axial_offset": [None, None, None, 2.5e-3],
            "defects.spall.length": [None, None, None, 0.5e-3],
            "bearing_id": ["A", "B", "C", "D"],
        }
    )
    folder = tmp_path_factory.mktemp("runs") / "runs"
    return br.campaign(
        table, folder, scene=spalled(-90.0), duration=0.03, columns=["outer.ay"], keep="signals", progress=False
    )  # fmt: skip


@pytest.fixture(scope="module")
def written(done: br.Campaign, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("root") / "simulated"
    done.to_bearing_datasets(path, CHAINS, licence="CC-BY-4.0", seed=3)
    return path


def test_labels_are_those_of_defects_that_were_met(done: br.Campaign, written: Path) -> None:
    table = br.read_bearing_dataset(written).metadata
    labels = {row["bearing_id"]: row for row in table.to_dicts()}
    assert [labels[k]["fault_type"] for k in "ABCD"] == ["normal", "outer", "outer", "normal"]
    assert [labels[k]["fault_size_mm"] for k in "ABCD"] == [0.0, 1.0, 1.5, 0.0]
    assert [labels[k]["fault_severity_level"] for k in "ABCD"] == [0, 1, 2, 0]
    assert labels["D"]["native_label"] == "outer_race 1 mm"
    assert done.manifest["fault_outer_race"].to_list() == [False, True, True, False]


def test_orders_speed_and_load_are_those_of_the_scene(written: Path) -> None:
    row = br.read_bearing_dataset(written).metadata.row(0, named=True)
    orders = br.catalogue["6205"].orders
    for name in ("bpfo", "bpfi", "bsf", "ftf"):
        assert row[name] == pytest.approx(getattr(orders, name), rel=0.01)
    assert row["speed_rpm"] == pytest.approx(1797.0)
    assert (row["load"], row["load_unit"], row["speed_profile"]) == (1000.0, "N", "constant")


def test_samples_are_those_of_the_campaign(done: br.Campaign, written: Path) -> None:
    found = br.read_bearing_dataset(written)
    lines = {f"{x.case_id}_{x.chain}": x.measurement for x in done.measurements(CHAINS, seed=3)}
    assert set(found.metadata["recording_id"]) == set(lines)
    for row in found.metadata.to_dicts():
        channel, wanted = found.channel(row["signal_id"]), lines[row["recording_id"]]
        assert np.array_equal(channel.x, wanted.x.astype(np.float32))
        assert (channel.fs, channel.unit) == (wanted.fs, "m/s^2")
        assert channel.shaft == pytest.approx(29.95)
        housed = row["recording_id"].endswith("housed")
        assert row["axis"] == ("horizontal" if housed else "vertical")
        assert row["sensor_mounting"] == "pedestal"


def test_the_card_has_scenes_and_licence(done: br.Campaign, written: Path) -> None:
    import hashlib

    card = json.loads((written / "manifest.json").read_text(encoding="utf-8"))
    assert card["license"] == "CC-BY-4.0"
    assert list(card["scenes"]) == done.manifest["case_id"].to_list()
    for case_id, digest in card["scenes"].items():
        assert digest == hashlib.sha256(done.scene(case_id).to_json().encode()).hexdigest()
    assert set(card["columns"]) == set(br.read_bearing_dataset(written).metadata.columns)


def test_without_chains_the_signals_are_those_of_the_sensors(
    done: br.Campaign, tmp_path: Path
) -> None:
    done.to_bearing_datasets(tmp_path / "ring")
    found = br.read_bearing_dataset(tmp_path / "ring")
    assert found.metadata["channel"].unique().sort().to_list() == [
        "housing.sensor.ax",
        "housing.sensor.ay",
        "housing.sensor.az",
    ]
    case_id = done.manifest["case_id"][1]
    x = done.run_of(case_id)["housing.sensor.ay"]
    assert np.array_equal(found.channel(f"{case_id}/housing.sensor.ay").x, x.astype(np.float32))


def test_the_package_takes_what_is_written(written: Path) -> None:
    bd = pytest.importorskip("bearing_datasets", reason="bearing-datasets is not installed")
    schema = pytest.importorskip("bearing_datasets.schema")
    opened, ours = bd.open(written.name, written.parent), br.read_bearing_dataset(written)
    table = opened.metadata()
    schema.validate(table)
    at_fault = schema.at_fault(table["sensor_location"], table["fault_location"])
    assert at_fault.tolist() == table["sensor_at_fault"].tolist()
    assert opened.columns()["description"].str.len().min() > 0
    for row in opened.with_signals().to_dict("records"):
        assert np.array_equal(row["signal"], ours.channel(row["signal_id"]).x)


def test_what_the_package_writes_is_read(tmp_path: Path) -> None:
    """Two row groups, 16-bit numbers, and a unit that nobody knows."""
    build = pytest.importorskip("bearing_datasets.build", reason="bearing-datasets is not there")
    writer = build.SignalWriter(tmp_path / "signals", row_group_bytes=100)
    samples = {f"r{k}/DE": np.arange(40, dtype=np.int16) + 100 * k for k in range(3)}
    for name, x in samples.items():
        writer.add(name, x)
    writer.close()
    rows = []
    for name in samples:
        file, group, row = writer.locations[name]
        rows.append(
            {"signal_id": name, "channel": "DE", "fs": 12000, "unit": "unknown", "speed_rpm": 1797.0}
            | {"signal_file": file, "signal_row_group": group, "signal_row": row}
        )  # fmt: skip
    pl.DataFrame(rows).write_parquet(tmp_path / "metadata.parquet")
    (tmp_path / "manifest.json").write_text('{"schema_version": 2, "license": "none"}')
    found = br.read_bearing_dataset(tmp_path)
    assert len({row["signal_row_group"] for row in rows}) > 1
    for name, x in samples.items():
        channel = found.channel(name)
        assert np.array_equal(channel.x, x.astype(float))
        assert (channel.fs, channel.unit) == (12_000.0, "")
        assert channel.shaft == pytest.approx(29.95)


def test_cases_without_a_label_are_left_out(tmp_path: Path) -> None:
    """In a millisecond no ball comes to the spall of a case, so nobody knows what it would do."""
    table = [{"defects.spall.width": 0.0}, {"defects.spall.width": 1e-3}]
    done = br.campaign(
        table, tmp_path / "short", scene=spalled(-70.0), duration=0.001, start="rolling",
        columns=["outer.ay"], keep="signals", progress=False,
    )  # fmt: skip
    assert done.manifest["fault_outer_race"].to_list() == [False, None]
    with pytest.warns(br.CampaignWarning, match="1 cases have no label and are left out"):
        done.to_bearing_datasets(tmp_path / "set")
    assert set(br.read_bearing_dataset(tmp_path / "set").metadata["fault_type"]) == {"normal"}


def test_nothing_is_half_written(
    done: br.Campaign, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pl.DataFrame, "write_parquet", _full)
    with pytest.raises(OSError, match="No space left"):
        done.to_bearing_datasets(tmp_path / "set")
    assert list(tmp_path.iterdir()) == []


def _full(self: pl.DataFrame, file: Any, **_options: Any) -> None:
    raise OSError(28, "No space left on device", str(file))


def test_what_is_there_is_not_replaced(done: br.Campaign, written: Path, tmp_path: Path) -> None:
    with pytest.raises(br.SceneError, match="a folder that is not there yet"):
        done.to_bearing_datasets(written)
    for given in ({"licence": None}, {"title": 3}):
        with pytest.raises(br.SceneError, match="text"):
            done.to_bearing_datasets(tmp_path / "set", **given)
    assert list(tmp_path.iterdir()) == []


def test_other_folders_are_refused(written: Path, tmp_path: Path) -> None:
    with pytest.raises(br.FileError, match="not a set of bearing-datasets"):
        br.read_bearing_dataset(tmp_path)
    old = tmp_path / "old"
    old.mkdir()
    (old / "metadata.parquet").write_bytes((written / "metadata.parquet").read_bytes())
    (old / "manifest.json").write_text("{}")
    with pytest.raises(br.FileError, match="schema version 1, not 2"):
        br.read_bearing_dataset(old)
    (old / "manifest.json").write_text('{"schema_version": 2}')
    lost = br.read_bearing_dataset(old)
    with pytest.raises(br.FileError, match=r"part-float32-00000\.parquet"):
        lost.channel(lost.metadata["signal_id"][0])
    with pytest.raises(KeyError, match="no signal 'x'"):
        lost.channel("x")


@pytest.mark.parametrize("seed", range(20))
def test_no_bearing_is_on_both_sides(seed: int) -> None:
    """Bearings of one to nine rows in three classes: each class is on both sides, near the share."""
    rng = np.random.default_rng(seed)
    kinds, rows = ("normal", "outer", "inner"), []
    for bearing in range(36):
        rows += [{"bearing_id": bearing, "fault_type": kinds[bearing % 3]}] * rng.integers(1, 10)
    table = pl.DataFrame(rows).sample(fraction=1.0, shuffle=True, seed=seed)
    train, test = br.bearing_split(table, test=0.25, seed=seed)
    assert not set(train["bearing_id"]) & set(test["bearing_id"])
    assert train.height + test.height == table.height
    for kind in kinds:
        share = test.filter(fault_type=kind).height / table.filter(fault_type=kind).height
        assert share == pytest.approx(0.25, abs=0.03)


def test_a_split_is_that_of_its_seed() -> None:
    table = pl.DataFrame({"bearing_id": range(40), "label": ["healthy", "ball"] * 20})
    sides = [tuple(br.bearing_split(table, seed=s)[1]["bearing_id"]) for s in (0, 0, 1)]
    assert sides[0] == sides[1] != sides[2]


def test_the_windows_of_a_campaign_are_split(done: br.Campaign) -> None:
    table = done.windows(CHAINS, 64, labels=["fault_outer_race", "bearing_id"])
    train, test = br.bearing_split(table, test=0.5, balance="fault_outer_race")
    assert set(train["bearing_id"]) | set(test["bearing_id"]) == set("ABCD")
    assert train["fault_outer_race"].n_unique() == test["fault_outer_race"].n_unique() == 2


@pytest.mark.parametrize(
    ("path", "table", "options"),
    [
        ("test", {"bearing_id": [0, 1]}, {"test": 1.0}),
        ("seed", {"bearing_id": [0, 1]}, {"seed": -1}),
        ("groups", {"other": [0, 1]}, {}),
        ("groups", {"bearing_id": [0, 0]}, {}),
        ("groups", {"bearing_id": [0, None]}, {}),
        ("balance", {"bearing_id": [0, 1]}, {"balance": "kind"}),
        ("manifest", {"bearing_id": [0, 1], "label": ["a", "b"]}, {}),
    ],
)
def test_what_cannot_be_split_is_refused(
    path: str, table: dict[str, Any], options: dict[str, Any]
) -> None:
    with pytest.raises(br.SceneError) as caught:
        br.bearing_split(pl.DataFrame(table), **options)
    assert caught.value.path == path
