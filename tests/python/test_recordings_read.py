"""Files as others write them, and damaged ones.

The structures of Paderborn University and the MFPT society are built here; a record of Case Western Reserve
University is read where it is there (see ``test_cwru.py``).
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any

import numpy as np
import polars as pl
import pytest
from scipy.io import savemat, wavfile

import ballrace as br
from ballrace.recordings.formats import FORMATS, Format
from test_cwru import FOLDER

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

X = np.sin(np.arange(500.0))


def test_cwru_keys(tmp_path: Path) -> None:
    path = tmp_path / "105.mat"
    content = {
        f"X105_{place}_time": X[:, None] * k for k, place in enumerate(("DE", "FE", "BA"), 1)
    }
    savemat(path, content | {"X105RPM": [[1797]]})
    record = br.read(path, fs=12_000)
    assert list(record) == ["DE", "FE", "BA"]
    np.testing.assert_array_equal(record["BA"], 3.0 * X)
    assert (record.fs, record.shaft, record.units["DE"]) == (12_000.0, 1797.0 / 60.0, "")
    with pytest.raises(br.SceneError, match=r"fs = None: .* which 105\.mat does not have"):
        br.read(path)


@pytest.mark.parametrize("name", ["SampleFrequency", "sample_rate", "fs"])
def test_a_rate_goes_by_many_names(tmp_path: Path, name: str) -> None:
    savemat(tmp_path / "a.mat", {"ch1": X, name: 25_600})
    assert br.read(tmp_path / "a.mat").fs == 25_600.0
    h5py = pytest.importorskip("h5py")
    for at in ("attribute", "data set"):
        with h5py.File(tmp_path / "a.h5", "w") as file:
            file.create_dataset("ch1", data=X)
            if at == "attribute":
                file.attrs[name] = 25_600.0
            else:
                file.create_dataset(name, data=25_600.0)
        assert br.read(tmp_path / "a.h5").fs == 25_600.0, at


def test_a_cwru_file_with_two_records(tmp_path: Path) -> None:
    content = {"X098_DE_time": X, "X099_DE_time": 2.0 * X, "X099RPM": 1750}
    for name in ("99.mat", "other.mat"):
        savemat(tmp_path / name, content)
    np.testing.assert_array_equal(br.read(tmp_path / "99.mat", fs=1.0)["DE"], 2.0 * X)
    with pytest.raises(br.FileError, match="holds several records"):
        br.read(tmp_path / "other.mat", fs=1.0)


def test_a_record_of_cwru() -> None:
    path = FOLDER / "130.mat"
    if not path.is_file():
        pytest.skip("the record 130.mat is not there; set BALLRACE_CWRU to its folder")
    record = br.read(path, fs=12_000.0)
    assert list(record) == ["DE", "FE", "BA"]
    assert record.n_samples == 121_991
    assert record.shaft == pytest.approx(1796.0 / 60.0)


def paderborn(times: dict[str, Any], signals: list[tuple[str, str, Any]]) -> dict[str, Any]:
    """Build what a file of the data set holds: times by raster, and signals that name theirs."""
    x = [
        {"Name": "Time", "Type": "double", "Data": t, "Raster": raster}
        for raster, t in times.items()
    ]
    y = [{"Name": name, "Type": "double", "Data": data, "Raster": r} for name, r, data in signals]
    return {
        "N15_M07_F10_KA01_1": {"Info": {}, "X": np.array(x), "Y": np.array(y), "Description": {}}
    }


def test_paderborn_rasters(tmp_path: Path) -> None:
    path = tmp_path / "N15_M07_F10_KA01_1.mat"
    times = {
        "Mech_4kHz": np.arange(250) / 4e3,
        "HostService": np.arange(4000) / 64e3,
        "Temp_1Hz": [0.0, 1.0],
    }
    vibration = np.random.default_rng(1).normal(size=4000)
    signals = [
        ("force", "Mech_4kHz", np.full(250, 1000.0)),
        ("speed", "Mech_4kHz", np.full(250, 1500.0)),
        ("phase_current_1", "HostService", np.zeros(4000)),
        ("vibration_1", "HostService", vibration),
        ("temp_2_bearing_module", "Temp_1Hz", [40.0, 41.0]),
    ]
    savemat(path, paderborn(times, signals))
    record = br.read(path)
    assert list(record) == ["phase_current_1", "vibration_1"]
    np.testing.assert_array_equal(record["vibration_1"], vibration)
    assert (record.fs, record.shaft) == (64_000.0, 25.0)
    assert [other.fs for other in record.others] == [4000.0, 1.0]
    assert record.others[0]["force"][0] == 1000.0
    assert record.metadata["record"] == "N15_M07_F10_KA01_1"
    savemat(path, paderborn(times, [("vibration_1", "HostService", vibration[:-1])]))
    with pytest.raises(br.FileError, match="vibration_1 has not one time a sample"):
        br.read(path)


def test_mfpt_struct(tmp_path: Path) -> None:
    path = tmp_path / "baseline_1.mat"
    savemat(path, {"bearing": {"sr": 97_656, "gs": X[:, None], "load": 270, "rate": 25}})
    record = br.read(path)
    np.testing.assert_array_equal(record["acceleration"], X)
    assert (record.fs, record.shaft, record.units["acceleration"]) == (97_656.0, 25.0, "g")
    assert record.metadata["load_lb"] == 270.0
    with pytest.raises(br.SceneError, match=r"fs = 12000"):
        br.read(path, fs=12_000.0)


def test_vectors_of_a_mat_file_and_of_version_73(tmp_path: Path) -> None:
    savemat(tmp_path / "plain.mat", {"ax": X, "ay": 2.0 * X, "fs": 2000, "gain": [1.0, 2.0]})
    record = br.read(tmp_path / "plain.mat")
    assert (list(record), record.fs) == (["ax", "ay"], 2000.0)
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "new.mat", "w", userblock_size=512) as file:
        file["X105_DE_time"] = X[None, :]
        file["X105RPM"] = [[1797.0]]
    with (tmp_path / "new.mat").open("r+b") as raw:
        raw.write(b"MATLAB 7.3 MAT-file")
    record = br.read(tmp_path / "new.mat", fs=12_000.0)
    np.testing.assert_array_equal(record["DE"], X)
    assert record.shaft == pytest.approx(29.95)


@pytest.mark.parametrize(
    ("text", "fs", "columns", "unit"),
    [
        ("t,ay\n0.0,1.5\n0.5,-2\n1.0,3\n", 2.0, {"ay": [1.5, -2.0, 3.0]}, ""),
        (
            "Time (ms);ay [g];b\n0;1,5;1\n1;-2;2\n2;3;3\n",
            1e3,
            {"ay": [1.5, -2, 3], "b": [1, 2, 3]},
            "g",
        ),
        ("# a remark\n1.0\n2.0\n3.0\n", None, {"column_1": [1.0, 2.0, 3.0]}, ""),
        ("1,2\n3,-4\n", None, {"column_1": [1.0, 3.0], "column_2": [2.0, -4.0]}, ""),
        ("0.1\t-1e-3\n0.2\t2E3\n", None, {"column_1": [0.1, 0.2], "column_2": [-1e-3, 2e3]}, ""),
        ("ay\tb\n0.1\t1\n0.2\t2\n", None, {"ay": [0.1, 0.2], "b": [1.0, 2.0]}, ""),
        ("# remark\nt  ay\n0.0  1\n0.5  2\n", 2.0, {"ay": [1.0, 2.0]}, ""),
        ('"ay, left [g]",b\n1,2\n3,4\n', None, {"ay, left": [1.0, 3.0], "b": [2.0, 4.0]}, ""),
        ("a, b\n0.1, -2\n0.2, 3e1\n", None, {"a": [0.1, 0.2], "b": [-2.0, 30.0]}, ""),
        ("  0.1   -2\n  0.2   -3\n", None, {"column_1": [0.1, 0.2], "column_2": [-2.0, -3.0]}, ""),
        ("\ufefft [s],ay [m/s^2]\r\n0,1\r\n0.001,2\r\n", 1e3, {"ay": [1.0, 2.0]}, "m/s^2"),
    ],
)
def test_text_tables(
    tmp_path: Path, text: str, fs: float | None, columns: dict[str, list[float]], unit: str
) -> None:
    path = tmp_path / "table.csv"
    path.write_text(text, encoding="utf-8", newline="")
    record = br.read(path, fs=None if fs else 100.0)
    assert {name: x.tolist() for name, x in record.items()} == columns
    assert record.fs == pytest.approx(fs or 100.0)
    assert record.units.get("ay", "") == unit


def test_text_of_a_german_instrument(tmp_path: Path) -> None:
    path = tmp_path / "record.txt"
    path.write_bytes("Zeit [s]\ta [m/s²]\r\n0,00\t1,5\r\n0,01\t-2,5\r\n".encode("cp1252"))
    record = br.read(path)
    assert (record.fs, record["a"].tolist(), record.units["a"]) == (100.0, [1.5, -2.5], "m/s^2")


def test_whole_numbers_that_become_fractions_late(tmp_path: Path) -> None:
    path = tmp_path / "record.csv"
    path.write_text("a\n" + "0\n" * 20_000 + "0.5\n")
    assert br.read(path, fs=1.0)["a"][-1] == 0.5


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "not a table|has no column"),
        ("a,b\n1,x\n2,3\n", "column b has other entries than numbers"),
        ("a,b\n1,2\n2,\n", "column b has other entries than numbers"),
        ("a,a\n1,2\n2,3\n", "two of its columns have one name"),
        ("a,b\n1,2\n2,3,4\n", "not a table of numbers"),
        ("1 2\n2 3 4\n", "not a table of numbers"),
        ("t,a\n0,1\n1,2\n5,2\n", "not at equal steps"),
        ("t,a\n2,1\n1,2\n", "do not rise"),
        ("t [s]\n0\n1\n", "has no column"),
    ],
)
def test_what_is_wrong_with_a_table_is_reported(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "table.csv"
    path.write_text(text)
    with pytest.raises(br.FileError, match=rf"table\.csv: .*({message})"):
        br.read(path, fs=1.0)


def test_parquet_of_others(tmp_path: Path) -> None:
    path = tmp_path / "table.parquet"
    pl.DataFrame({"t": np.arange(500) / 800.0, "x": X, "n": np.arange(500)}).write_parquet(path)
    record = br.read(path)
    # The third only counts.
    assert (list(record), record.fs, record.metadata["counters"]) == (["x"], 800.0, ["n"])
    pl.DataFrame({"x": ["a"]}).write_parquet(path)
    with pytest.raises(br.FileError, match="column x has other entries"):
        br.read(path, fs=1.0)


@pytest.mark.parametrize(
    ("kind", "full"), [(np.int16, 2**15), (np.int32, 2**31), (np.uint8, 128), (np.float64, 0)]
)
def test_wav_of_others(tmp_path: Path, kind: Any, full: int) -> None:
    path = tmp_path / "sound.wav"
    data = np.array([[0.0, 0.5], [-0.25, 0.75], [-1.0, 0.0]])
    stored = data * full if full else data
    wavfile.write(path, 8000, (stored + 128 if kind is np.uint8 else stored).astype(kind))
    record = br.read(path)
    np.testing.assert_array_equal(np.stack(list(record.values()), axis=1), data)
    assert (list(record), record.fs) == (["channel_1", "channel_2"], 8000.0)
    assert record.units["channel_1"] == ("full scale" if full else "")


def test_hdf5_of_others(tmp_path: Path) -> None:
    h5py = pytest.importorskip("h5py")
    path = tmp_path / "data.h5"
    with h5py.File(path, "w") as file:
        file["group/ax"] = X
        file["group/ax"].attrs["units"] = "g"
        file["group/ay"] = X[None, :]
        file["calibration"] = [1.0, 2.0]
        file["fs"] = 25_600
        file["name"] = "text"
    record = br.read(path)
    assert (list(record), record.fs) == (["group/ax", "group/ay"], 25_600.0)
    assert record.units["group/ax"] == "g"
    with h5py.File(path, "w") as file:
        file["name"] = "text"
    with pytest.raises(br.FileError, match="no data set that could be a signal"):
        br.read(path, fs=1.0)


# pyuff leaves closing its files to Python.
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
@pytest.mark.filterwarnings("ignore::ResourceWarning")
@pytest.mark.parametrize("binary", [0, 1])
def test_universal_files_of_others(tmp_path: Path, binary: int) -> None:
    pyuff = pytest.importorskip("pyuff")
    path = tmp_path / "data.unv"
    sets = [
        pyuff.prepare_58(
            binary=binary, func_type=kind, rsp_node=node, rsp_dir=1, ref_dir=1, ref_node=1, id1="NONE",
            data=X[:size], x=np.arange(size) / 12_800.0, abscissa_spacing=1, z_axis_value=0.0,
            orddenom_spec_data_type=0, z_axis_spec_data_type=0, ordinate_spec_data_type=12,
            abscissa_spec_data_type=17, ordinate_axis_units_lab="g",
        )
        for node, kind, size in ((3, 1, 500), (4, 1, 500), (5, 9, 500), (6, 1, 100))
    ]  # fmt: skip
    for one in sets:
        pyuff.UFF(str(path)).write_sets([one], mode="add")
    record = br.read(path)
    # The density is no record, and the short response one at another length.
    assert list(record) == ["3", "4"]
    assert [list(other) for other in record.others] == [["6"]]
    np.testing.assert_allclose(record["3"], X, rtol=1e-11)
    assert (record.fs, record.units["3"]) == (12_800.0, "g")


@pytest.mark.parametrize(
    "form",
    [one for one in FORMATS.values() if one.written and one.beginnings],
    ids=lambda one: one.name,
)
def test_damaged_files_are_named(tmp_path: Path, form: Format) -> None:
    pytest.importorskip(form.library)
    end = form.suffixes[0]
    path = tmp_path / f"record{end}"
    br.Recording(columns={"x": X, "y": X}, fs=12e3).write(path)
    whole = path.read_bytes()
    cut = [whole[:size] for size in (0, 1, 60, len(whole) // 3, len(whole) * 9 // 10)]
    for bad in (*cut, b"no record at all, but quite some text\n" * 20):
        path.write_bytes(bad)
        with pytest.raises(br.FileError, match=rf"record\{end}: "):
            br.read(path, fs=12e3)


def test_the_format_is_found_by_contents_where_the_name_has_none(tmp_path: Path) -> None:
    record = br.Recording(columns={"x": X.astype(np.float32)}, fs=12e3)
    for end in (".csv", ".wav", ".mat", ".parquet"):
        record.write(tmp_path / f"record{end}")
        plain = tmp_path / "record"
        (tmp_path / f"record{end}").rename(plain)
        assert br.read(plain).fs == 12e3
    assert br.read(plain, format="parquet")["x"].tolist() == record["x"].tolist()
    with pytest.raises(br.FileError, match="neither text nor a record"):
        br.read(plain, format="csv")


WRONG: list[tuple[str, Any]] = [
    *(("fs", fs) for fs in (-1.0, 0.0, float("nan"), 1e300, 1e-300, 10**400, "12e3", [1.0], np.ones(2), True)),
    *(("format", name) for name in ("flac", "CSV", "", ["csv"], 3)),
    *((limit, x) for limit in ("time_limit", "memory_limit") for x in (-(10**400), 0, "1")),
    ("trusted", "no"),
]  # fmt: skip


@pytest.mark.parametrize(("name", "value"), WRONG, ids=repr)
def test_rates_formats_and_sizes_are_refused_by_name(
    tmp_path: Path, name: str, value: object
) -> None:
    path = tmp_path / "record.csv"
    path.write_text("a\n1\n2\n")
    read: Any = br.read
    with pytest.raises(br.SceneError) as caught:
        read(path, **({"fs": 1.0, "trusted": True} | {name: value}))
    assert caught.value.path == name
    assert read(path, 1.0, time_limit=10**400, memory_limit=10**400).n_samples == 2


@pytest.mark.parametrize("rate", [-5.0, float("nan"), 1e300])
def test_a_rate_that_is_none_is_the_files_fault(tmp_path: Path, rate: float) -> None:
    path = tmp_path / "a.mat"
    savemat(path, {"ay": np.arange(4.0), "fs": rate})
    with pytest.raises(br.FileError, match=r"a\.mat: has a sampling rate of .* Hz; give fs"):
        br.read(path)
    assert br.read(path, fs=12e3).fs == 12e3


def test_bad_arguments_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "record.csv"
    path.write_text("a\n1\n2\n")
    calls: list[tuple[str, Callable[[], object]]] = [
        ("fs", lambda: br.read(path, fs=-1.0)),
        ("fs", lambda: br.read(path)),
        ("format", lambda: br.read(path, 1.0, "flac")),
    ]
    for name, call in calls:
        with pytest.raises(br.SceneError) as caught:
            call()
        assert caught.value.path == name
    with pytest.raises(FileNotFoundError):
        br.read(tmp_path / "none.csv")


def test_a_comment_of_another_program_in_a_wav(tmp_path: Path) -> None:
    path = tmp_path / "sound.wav"
    wavfile.write(path, 8000, X.astype(np.float32))
    entry = b"INFOICMT" + struct.pack("<I", 6) + b"hello\0"
    path.write_bytes(path.read_bytes() + b"LIST" + struct.pack("<I", len(entry)) + entry)
    assert list(br.read(path)) == ["channel_1"]
