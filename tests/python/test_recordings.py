"""Records out into every format and back: the same numbers, rate and units."""

from __future__ import annotations

import copy
import pickle
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
import pytest

import ballrace as br
from ballrace.recordings.formats import FORMATS

ENDS = [end for one in FORMATS.values() for end in one.suffixes[: one.written]]
NEEDS = {end: one.library for one in FORMATS.values() for end in one.suffixes}


@pytest.fixture
def record() -> br.Recording:
    rng = np.random.default_rng(1)
    columns = {"sensor.ay": 30.0 * rng.normal(size=2000), "load": 1e-7 * rng.normal(size=2000)}
    units = {"sensor.ay": "m/s^2"}
    metadata = {"bearing": "6205", "µ": [1, None]}
    return br.Recording(
        columns=columns, fs=51_200.0, units=units, shaft=np.float64(29.95), metadata=metadata
    )


def library(end: str) -> None:
    if end in NEEDS:
        pytest.importorskip(NEEDS[end])


def same(found: br.Recording, wanted: br.Recording | br.Signals, end: str) -> None:
    assert list(found) == list(wanted)
    assert found.fs == wanted.fs
    assert dict(found.units) == dict(wanted.units)
    for name in wanted:
        if end == ".wav":
            np.testing.assert_array_equal(found[name], wanted[name].astype(np.float32))
        else:
            np.testing.assert_array_equal(found[name], wanted[name])


@pytest.mark.parametrize("end", ENDS)
def test_there_and_back(record: br.Recording, end: str, tmp_path: Path) -> None:
    library(end)
    path = tmp_path / f"record{end}"
    path.write_text("old")
    record.write(path)
    assert [p.name for p in tmp_path.iterdir()] == [path.name]
    found = br.read(path)
    same(found, record, end)
    assert found.source == str(path)
    if end not in (".csv", ".txt"):
        assert found.shaft == record.shaft
    if end not in (".csv", ".txt", ".uff", ".unv"):
        assert dict(found.metadata) == dict(record.metadata)


@pytest.mark.parametrize("end", ENDS)
def test_a_run_there_and_back(out: br.Signals, end: str, tmp_path: Path) -> None:
    library(end)
    path = tmp_path / f"run{end}"
    # Contacts without load have no angle, and Universal Files no such number.
    finite = [name for name in out if np.isfinite(out[name]).all()]
    assert len(finite) < len(out)
    universal = end in (".uff", ".unv")
    if universal:
        with pytest.raises(br.SceneError, match="all finite"):
            out.write(path)
    out.write(path, finite if universal else None)
    found = br.read(path)
    if not universal:
        same(found, out, end)
    assert list(found) == (finite if universal else list(out))
    if end not in (".csv", ".txt", ".uff", ".unv"):
        assert found.metadata["scene"] == out.scene.to_dict()
        assert found.shaft == pytest.approx(30.0)
    if end == ".parquet":
        assert br.Signals.read_parquet(path).scene == out.scene


@pytest.mark.parametrize("fs", [12_000.0, 97_656.25, 64_001.7, 1 / 3])
# A WAV file has a whole number of samples a second.
@pytest.mark.parametrize("end", [end for end in ENDS if end != ".wav"])
def test_any_rate_comes_back(fs: float, end: str, tmp_path: Path) -> None:
    library(end)
    path = tmp_path / f"record{end}"
    br.Recording(columns={"x": np.arange(3000.0)}, fs=fs).write(path)
    assert br.read(path).fs == pytest.approx(fs, rel=1e-11)


@pytest.mark.parametrize("end", ENDS)
def test_columns_are_chosen_and_renamed(out: br.Signals, end: str, tmp_path: Path) -> None:
    library(end)
    path = tmp_path / f"run{end}"
    out.write(path, columns="outer.ay")
    assert list(br.read(path)) == ["outer.ay"]
    out.write(path, columns={"outer.az": "z", "outer.ay": "y"})
    found = br.read(path)
    assert list(found) == ["z", "y"]
    assert found.units["y"] == "m/s^2"
    wanted = out["outer.ay"]
    np.testing.assert_allclose(found["y"], wanted, rtol=6e-8 if end == ".wav" else 0.0)


def test_plain_programs_read_what_is_written(record: br.Recording, tmp_path: Path) -> None:
    table = pl.read_csv(record_as(record, tmp_path / "a.csv"))
    assert table.columns == ["t [s]", "sensor.ay [m/s^2]", "load"]
    assert table["load"].to_list() == record["load"].tolist()

    scipy_io = pytest.importorskip("scipy.io")
    rate, data = scipy_io.wavfile.read(record_as(record, tmp_path / "a.wav"))
    assert (rate, data.dtype, data.shape) == (51_200, np.float32, (2000, 2))

    found = scipy_io.loadmat(record_as(record, tmp_path / "118.mat", {"sensor.ay": "DE"}))
    np.testing.assert_array_equal(found["X118_DE_time"].ravel(), record["sensor.ay"])
    assert found["X118_DE_time"].shape == (2000, 1)
    assert found["X118RPM"].item() == pytest.approx(1797.0)

    h5py = pytest.importorskip("h5py")
    with h5py.File(record_as(record, tmp_path / "a.h5")) as file:
        assert file["sensor.ay"].attrs["units"] == "m/s^2"
        assert file.attrs["sampling_rate"] == 51_200.0

    pyuff = pytest.importorskip("pyuff")
    first, second = pyuff.UFF(str(record_as(record, tmp_path / "a.uff"))).read_sets()
    np.testing.assert_array_equal(first["data"], record["sensor.ay"])
    assert (first["id1"], second["id1"], first["func_type"]) == ("sensor.ay", "load", 1)
    assert first["abscissa_inc"] == pytest.approx(1.0 / 51_200.0, rel=1e-5)


def test_a_rate_that_is_no_number_is_damage(record: br.Recording, tmp_path: Path) -> None:
    pytest.importorskip("pyuff")
    path = record_as(record, tmp_path / "a.uff")
    path.write_bytes(path.read_bytes().replace(b"51200.0", b"512.0.0"))
    with pytest.raises(br.FileError, match=r"damaged: 512\.0\.0 Hz is no number"):
        br.read(path)


def record_as(record: br.Recording, path: Path, columns: dict[str, str] | None = None) -> Path:
    record.write(path, columns)
    return path


def test_tables_of_others(record: br.Recording) -> None:
    table = record.to_polars()
    assert table.columns == ["t", "sensor.ay", "load"]
    pandas = pytest.importorskip("pandas")
    frame = record.to_pandas()
    assert isinstance(frame, pandas.DataFrame)
    assert frame["load"].tolist() == record["load"].tolist()
    pytest.importorskip("xarray")
    data = record.to_xarray()
    np.testing.assert_array_equal(data["sensor.ay"].sel(t=record.t[3]), record["sensor.ay"][3])
    assert data["sensor.ay"].attrs["units"] == "m/s^2"
    assert data.attrs["sampling_rate"] == 51_200.0


def test_a_recording_is_a_mapping(record: br.Recording) -> None:
    assert (len(record), record.n_samples) == (2, 2000)
    np.testing.assert_allclose(np.diff(record.t), 1.0 / 51_200.0)
    assert "sensor.ay [m/s^2], load [?]" in repr(record)
    with pytest.raises(KeyError, match=r"near are sensor\.ay"):
        record["sensor.ax"]
    assert record == record  # noqa: PLR0124
    with pytest.raises(AttributeError):
        record.fs = 1.0  # type: ignore[misc]


def test_measured_records_go_into_the_same_functions(record: br.Recording) -> None:
    f, _ = br.spectra.psd(record["sensor.ay"], record.fs)
    assert f[-1] == pytest.approx(25_600.0, rel=1e-2)
    assert br.features(record["sensor.ay"], record.fs)["rms"] == pytest.approx(30.0, rel=0.1)


@pytest.mark.parametrize(
    ("name", "fields"),
    [
        ("columns", {"columns": {}}),
        ("columns", {"columns": {"a": [1.0], "b": [1.0, 2.0]}}),
        ("columns['a']", {"columns": {"a": [[1.0]]}}),
        ("columns['a']", {"columns": {"a": "text"}}),
        ("columns", {"columns": [[1.0]]}),
        ("columns", {"columns": None}),
        ("units", {"units": ["g"]}),
        ("metadata", {"metadata": "text"}),
        ("fs", {"fs": 0.0}),
        ("fs", {"fs": 1e300}),
        ("fs", {"fs": "1"}),
        ("shaft", {"shaft": -1.0}),
    ],
)
def test_recordings_of_nothing_are_refused(name: str, fields: dict[str, Any]) -> None:
    given: dict[str, Any] = {"columns": {"a": [1.0]}, "fs": 1.0}
    with pytest.raises(br.SceneError) as caught:
        br.Recording(**(given | fields))
    assert caught.value.path == name


def test_what_a_format_cannot_hold_is_refused_and_leaves_nothing(
    record: br.Recording, tmp_path: Path
) -> None:
    x = np.array([1.0, 2.0])
    odd = br.Recording(columns={"a.b": x, "a_b": x}, fs=0.5)
    far = br.Recording(columns={"a": 1e300 * x}, fs=8.0)
    unwritable = br.Recording(columns={"a": x}, fs=1.0, metadata={"a": object()})
    long = br.Recording(columns={"a" * 81: x}, fs=1.0)
    calls: list[tuple[str, br.Recording, str, Any]] = [
        ("path", record, "a.bz2", None),
        ("path", record, "a", None),
        ("path", odd, "a.wav", None),
        ("path", far, "a.wav", None),
        ("columns", odd, "a.mat", None),
        ("columns", long, "a.uff", None),
        ("columns", long, "a.mat", None),
        ("metadata", unwritable, "a.mat", None),
        ("columns", record, "a.csv", ["sensor"]),
        ("columns", record, "a.csv", []),
        ("columns", record, "a.csv", {"load": "x", "sensor.ay": "x"}),
    ]
    for name, what, file, columns in calls:
        library(Path(file).suffix)
        with pytest.raises(br.SceneError) as caught:
            what.write(tmp_path / file, columns)
        assert caught.value.path == name, file
    assert not list(tmp_path.iterdir())
    with pytest.raises(FileNotFoundError):
        record.write(tmp_path / "nowhere" / "a.csv")


def test_pickle_and_copy(record: br.Recording) -> None:
    for again in (pickle.loads(pickle.dumps(record)), copy.deepcopy(record)):
        same(again, record, "")
        assert (again.shaft, again.metadata) == (record.shaft, record.metadata)


def test_a_failed_write_leaves_what_was_there(
    record: br.Recording, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def disk_full(path: Path, *_: object, **__: object) -> None:
        path.write_text("half")
        raise OSError(28, "No space left on device")

    old = tmp_path / "record.mat"
    old.write_text("old")
    monkeypatch.setattr("scipy.io.savemat", disk_full)
    with pytest.raises(OSError, match="space"):
        record.write(old)
    assert old.read_text() == "old"
    assert list(tmp_path.iterdir()) == [old]


@pytest.mark.parametrize("end", [".uff", ".h5"])
def test_a_missing_library_is_named_with_its_extra(
    record: br.Recording, end: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def without(name: str) -> Any:
        raise ModuleNotFoundError(f"No module named {name!r}", name=name)

    monkeypatch.setattr("importlib.import_module", without)
    path = tmp_path / f"a{end}"
    with pytest.raises(ImportError, match=r'pip install "ballrace\[io\]"'):
        record.write(path)
    assert not list(tmp_path.iterdir())
    path.write_text("any")
    with pytest.raises(ImportError, match=NEEDS[end]):
        br.read(path, trusted=True)
    with pytest.raises(ImportError, match="pip install xarray"):
        record.to_xarray()


def test_columns_are_names(record: br.Recording) -> None:
    with pytest.raises(br.SceneError, match=r"^columns = 3: columns: "):
        record.to_windows(2, columns=3)  # type: ignore[arg-type]


def test_import_needs_none_of_the_libraries() -> None:
    program = (
        "import ballrace, sys; heavy = {'scipy', 'polars', 'plotly', 'h5py', 'pyuff', 'xarray', 'pandas'};"
        "print(sorted(heavy & {name.partition('.')[0] for name in sys.modules}))"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert done.stdout == "[]\n"


@pytest.mark.parametrize("name", ["=1+1", "+x", "-x", "@SUM(A1)", "'=x", "ay", "'ay"])
def test_a_spreadsheet_takes_no_name_for_a_formula(tmp_path: Path, name: str) -> None:
    path = tmp_path / "a.csv"
    br.Recording(columns={name: np.arange(3.0)}, fs=10.0, units={name: "g"}).write(path)
    header = path.read_text(encoding="utf-8").splitlines()[0].removeprefix("t [s],").strip('"')
    assert header[0] not in "=+-@"
    assert list(br.read(path)) == [name]
