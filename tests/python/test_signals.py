"""Signals: a mapping with times, units and metadata, through Parquet and back."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path

import numpy as np
import polars as pl
import pytest

import ballrace as br


def test_is_a_mapping_from_names_to_arrays(out: br.Signals) -> None:
    assert len(out) == len(out.names) == len(out.units)
    assert tuple(out) == out.names
    assert "outer.ay" in out
    assert "outer.ya" not in out
    assert out["outer.ay"].dtype == np.float64
    assert all(values.shape == out.t.shape for values in out.values())
    assert all(np.isfinite(out[f"outer.{name}"]).all() for name in ("x", "vx", "ax", "theta"))


def test_times_are_uniform(out: br.Signals) -> None:
    assert out.fs == 20_000
    assert out.t.shape == (20,)
    np.testing.assert_allclose(out.t, np.arange(20) / out.fs, rtol=0, atol=1e-15)


def test_units(out: br.Signals) -> None:
    assert (out.units["outer.x"], out.units["outer.vy"], out.units["outer.ay"]) == (
        "m",
        "m/s",
        "m/s^2",
    )


def test_a_wrong_name_gets_the_near_ones(out: br.Signals) -> None:
    with pytest.raises(KeyError, match=r"outer\.ay"):
        out["outer_ay"]
    with pytest.raises(KeyError, match=r"no column"):
        out["zzz"]


def test_statistics_and_provenance(out: br.Signals) -> None:
    assert out.stats.accepted > 0
    assert out.stats["nfev"] == out.stats.nfev
    assert "accepted" in dir(out.stats)
    with pytest.raises(AttributeError, match="accepted"):
        _ = out.stats.acepted
    with pytest.raises(AttributeError):
        out.stats.accepted = 0
    assert len(out.provenance) > 0


def test_scene_is_the_one_that_ran(out: br.Signals, wheel: br.Scene) -> None:
    assert out.scene == wheel.replace({"probes": out.scene.to_dict()["probes"]})
    assert "slices" in out.scene.probes


def test_slices_are_a_table(out: br.Signals) -> None:
    table = out.slices
    assert table is not None
    assert {
        "probe",
        "time",
        "row",
        "ball",
        "race",
        "zeta",
        "z",
        "width",
        "penetration",
        "force",
    } == set(table.columns)
    assert set(table["ball"].to_list()) <= {1}


def test_no_slices_without_a_probe(wheel: br.Scene) -> None:
    assert br.simulate(wheel, duration=1e-4, start="rolling").slices is None


def test_repr_is_short(out: br.Signals) -> None:
    text = repr(out)
    assert "wheel bearing" in text
    assert "20 samples" in text
    assert len(text.splitlines()) < 12


def test_to_polars(out: br.Signals) -> None:
    table = out.to_polars()
    assert table.columns == ["t", *out.names]
    assert table.height == out.t.size


def same(one: br.Signals, two: br.Signals) -> None:
    np.testing.assert_array_equal(one.t, two.t)
    assert one.names == two.names
    for name in one.names:
        np.testing.assert_array_equal(one[name], two[name])
    assert (one.fs, one.units, one.scene) == (two.fs, two.units, two.scene)
    assert (one.stats, one.provenance) == (two.stats, two.provenance)
    assert one.slices is not None
    assert two.slices is not None
    assert one.slices.equals(two.slices)


def test_other_programs_take_a_table_with_its_times(out: br.Signals) -> None:
    """Truth: the columns themselves. pandas is told what to call: it made a table of names alone."""
    pandas, pyarrow = pytest.importorskip("pandas"), pytest.importorskip("pyarrow")
    measured = br.measure(out, sensor=br.measuring.Sensor())
    recording = br.Recording(np.ones((4, 2)), fs=2.0)
    for of in (out, recording, measured):
        table = pl.DataFrame(of)
        assert table.equals(of.to_polars())
        assert table["t"].to_list() == of.t.tolist()
        assert pyarrow.table(of).column_names == table.columns
    for of in (out, recording):
        with pytest.raises(TypeError, match="to_pandas"):
            pandas.DataFrame(of)


def test_some_columns_are_a_record(out: br.Signals) -> None:
    some = out[["outer.ay", "outer.ax"]]
    assert list(some) == ["outer.ay", "outer.ax"]
    assert some.units == {"outer.ay": "m/s^2", "outer.ax": "m/s^2"}
    assert some.scene == out.scene
    assert (some["outer.ay"] == out["outer.ay"]).all()
    recording = br.Recording(np.ones((4, 2)), fs=2.0, unit="g")[["x_2"]]
    assert dict(recording.units) == {"x_2": "g"}
    with pytest.raises(KeyError, match="near are outer"):
        out[["outer.a"]]


def test_arrays_cannot_be_changed(out: br.Signals) -> None:
    """Truth: what was written into a column was what a file held later."""
    given = np.ones(4)
    recording = br.Recording(given, fs=2.0)
    for x in (out["outer.ay"], out.t, recording["x"]):
        with pytest.raises(ValueError, match="read-only"):
            x[0] = 1.0
    given[0] = 2.0  # an array that was given is its owner's


def test_parquet_round_trip(out: br.Signals, tmp_path: Path) -> None:
    path = tmp_path / "run.parquet"
    out.write_parquet(path)
    same(br.Signals.read_parquet(path), out)
    assert [p.name for p in tmp_path.iterdir()] == ["run.parquet"]
    # Anyone can read it without this package.
    assert pl.read_parquet(path).columns == ["t", *out.names]
    assert pl.read_parquet_metadata(path)["sampling_rate"] == "20000.0"


def test_parquet_replaces_a_file(out: br.Signals, tmp_path: Path) -> None:
    path = tmp_path / "run.parquet"
    path.write_text("old")
    out.write_parquet(path)
    same(br.Signals.read_parquet(path), out)


def test_pickle_and_copy(out: br.Signals) -> None:
    same(pickle.loads(pickle.dumps(out)), out)
    same(copy.deepcopy(out), out)


def test_failed_writes_leave_nothing(
    out: br.Signals, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with pytest.raises(FileNotFoundError):
        out.write_parquet(tmp_path / "nowhere" / "run.parquet")
    with pytest.raises(IsADirectoryError):
        out.write_parquet(tmp_path)

    def disk_full(_self: pl.DataFrame, path: Path, **_: object) -> None:
        path.write_text("half")
        raise OSError(28, "No space left on device")

    old = tmp_path / "run.parquet"
    old.write_text("old")
    _ = out.slices
    plain = br.Signals(
        fs=out.fs, t=out.t, columns=dict(out), units=out.units, scene=out.scene.to_json(), stats={}, provenance={}
    )  # fmt: skip
    monkeypatch.setattr(pl.DataFrame, "write_parquet", disk_full)
    with pytest.raises(OSError, match="space"):
        plain.write_parquet(old)
    assert old.read_text() == "old"
    assert list(tmp_path.iterdir()) == [old]


def test_other_files_are_refused(tmp_path: Path) -> None:
    text = tmp_path / "text.parquet"
    text.write_text("not parquet at all")
    with pytest.raises(br.FileError, match=r"text\.parquet: not a Parquet file"):
        br.Signals.read_parquet(text)
    foreign = tmp_path / "foreign.parquet"
    pl.DataFrame({"a": [1.0]}).write_parquet(foreign)
    with pytest.raises(br.FileError, match="not written by this version of ballrace"):
        br.Signals.read_parquet(foreign)
    with pytest.raises(FileNotFoundError):
        br.Signals.read_parquet(tmp_path / "none.parquet")


@pytest.mark.parametrize(
    ("entry", "text", "message"),
    [
        ("units", None, "its metadata has no units"),
        ("units", "{}", "its metadata has no unit of cage"),
        ("units", "[1", "the entry units of its metadata cannot be read"),
        ("stats", "3", r"the entry stats of its metadata cannot be read \(it is no mapping\)"),
        ("provenance", None, "its metadata has no provenance"),
        ("sampling_rate", "fast", "the entry sampling_rate of its metadata"),
        ("sampling_rate", "-1", "the entry sampling_rate of its metadata"),
        ("scene", "{}", "the entry scene of its metadata cannot be read"),
        ("scene", None, "its metadata has no scene"),
        ("warnings", "7", "the entry warnings of its metadata"),
        ("slices", "QUJD", "the entry slices of its metadata"),
    ],
)
def test_broken_metadata_is_reported(
    out: br.Signals, tmp_path: Path, entry: str, text: str | None, message: str
) -> None:
    """A file that is broken says which and what of it, and is no fault of a scene."""
    good, bad = tmp_path / "good.parquet", tmp_path / "bad.parquet"
    out.write_parquet(good)
    metadata = {
        name: value
        for name, value in pl.read_parquet_metadata(good).items()
        if name != "ARROW:schema"
    }
    metadata[entry] = text or ""
    if text is None:
        del metadata[entry]
    pl.read_parquet(good).write_parquet(bad, metadata=metadata)
    with pytest.raises(br.FileError, match=rf"bad\.parquet: damaged: {message}") as caught:
        br.Signals.read_parquet(bad)
    assert not isinstance(caught.value, br.SceneError)


def test_damaged_columns_are_reported(out: br.Signals, tmp_path: Path) -> None:
    path = tmp_path / "run.parquet"
    out.write_parquet(path)
    metadata = {k: v for k, v in pl.read_parquet_metadata(path).items() if k != "ARROW:schema"}
    table = pl.read_parquet(path)
    table.drop("t").write_parquet(path, metadata=metadata)
    with pytest.raises(br.FileError, match="the column t is missing"):
        br.Signals.read_parquet(path)
    table.cast({"outer.ay": pl.String}).write_parquet(path, metadata=metadata)
    with pytest.raises(br.FileError, match=r"the column outer\.ay has other entries than numbers"):
        br.Signals.read_parquet(path)


def test_bit_rot_is_found(out: br.Signals, tmp_path: Path) -> None:
    """Any flipped bit is reported, before polars meets it: one of a length asks it for exabytes of memory."""
    path = tmp_path / "run.parquet"
    out.write_parquet(path)
    data = path.read_bytes()
    mark = data.index(b"ballrace blake2b")
    for place in [*range(0, len(data), len(data) // 100), *range(mark, mark + 32), len(data) - 6]:
        path.write_bytes(data[:place] + bytes([data[place] ^ 0x20]) + data[place + 1 :])
        if mark <= place < mark + 16:
            # Where the mark is gone, the file counts as one of others, and is right.
            same(br.Signals.read_parquet(path), out)
        else:
            with pytest.raises(br.FileError, match=r"run\.parquet: .* not what was written"):
                br.Signals.read_parquet(path)
    for length in (0, 7, len(data) // 2, len(data) - 1):
        path.write_bytes(data[:length])
        with pytest.raises(br.FileError, match=r"run\.parquet: "):
            br.Signals.read_parquet(path)


def test_other_programs_read_a_sealed_file(out: br.Signals, tmp_path: Path) -> None:
    pyarrow = pytest.importorskip("pyarrow.parquet")
    path = tmp_path / "run.parquet"
    out.write_parquet(path)
    table = pyarrow.read_table(path)
    np.testing.assert_array_equal(table["outer.ay"].to_numpy(), out["outer.ay"])
    assert pl.scan_parquet(path).select("t").collect()["t"].to_numpy().tolist() == out.t.tolist()
