"""Arrays, matrices and structs in MATLAB files of both kinds, HDF5, NPY and NPZ: the same record of each."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.io import savemat

import ballrace as br

h5py = pytest.importorskip("h5py")

FS = 25_600.0
N = 500
_rng = np.random.default_rng(68)
A, B, C = _rng.normal(size=(3, N))
WIDE = np.stack([A, B, C])

Tree = dict[str, Any]


class Writer73:
    """Writes MATLAB's version 7.3: matrices turned, texts as numbers, cells and struct arrays by references."""

    def __init__(self, path: Path, tree: Tree) -> None:
        with h5py.File(path, "w", userblock_size=512) as file:
            self._refs = file.create_group("#refs#")
            self._count = 0
            for name, value in tree.items():
                self._put(file, name, value)
        with path.open("r+b") as raw:
            raw.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(124) + b"\x00\x02IM")

    def _put(self, group: Any, name: str, value: Any) -> None:
        if isinstance(value, dict):
            inner = group.create_group(name)
            inner.attrs["MATLAB_class"] = np.bytes_("struct")
            for key, one in value.items():
                self._put(inner, key, one)
        elif isinstance(value, list) and value and all(isinstance(one, dict) for one in value):
            inner = group.create_group(name)
            inner.attrs["MATLAB_class"] = np.bytes_("struct")
            for key in value[0]:
                inner.create_dataset(key, data=self._references([one[key] for one in value]))
        elif isinstance(value, list):
            cell = group.create_dataset(name, data=self._references(value))
            cell.attrs["MATLAB_class"] = np.bytes_("cell")
        elif isinstance(value, str):
            data = group.create_dataset(
                name, data=np.array([[ord(c)] for c in value], dtype=np.uint16)
            )
            data.attrs["MATLAB_class"] = np.bytes_("char")
        else:
            array = np.asarray(value)
            array = array.reshape(1, -1) if array.ndim < 2 else array
            data = group.create_dataset(name, data=array.T)
            data.attrs["MATLAB_class"] = np.bytes_("double")

    def _references(self, values: list[Any]) -> Any:
        found = np.empty((len(values), 1), dtype=h5py.ref_dtype)
        for place, value in enumerate(values):
            self._count += 1
            self._put(self._refs, f"r{self._count}", value)
            found[place, 0] = self._refs[f"r{self._count}"].ref
        return found


def as_v5(path: Path, tree: Tree) -> None:
    def plain(value: Any) -> Any:
        if isinstance(value, dict):
            return {name: plain(one) for name, one in value.items()}
        if isinstance(value, list):
            cell = np.empty(len(value), dtype=object)
            for place, one in enumerate(value):
                cell[place] = plain(one)
            return (
                np.array([plain(one) for one in value])
                if all(isinstance(v, dict) for v in value)
                else cell
            )
        return value

    savemat(path, plain(tree))


VERSIONS = {"v5": as_v5, "v7.3": Writer73}
EVERY = pytest.mark.parametrize("version", VERSIONS)

# Structs, cells and names: what the default column, the rate and the unit have to be.
STRUCTS: dict[str, tuple[Tree, str, str, float]] = {
    "MFPT": (
        {"bearing": {"sr": 97_656.0, "gs": A, "load": 270.0, "rate": 25.0}},
        "acceleration",
        "g",
        97_656.0,
    ),
    "MFPT by another name": ({"b1": {"sr": FS, "gs": A, "rate": 25.0}}, "acceleration", "g", FS),
    "signal and rate": ({"data": {"fs": FS, "vibration": A}}, "data.vibration", "", FS),
    "unit beside": ({"data": {"Fs": FS, "signal": A, "unit": "m/s2"}}, "data.signal", "m/s^2", FS),
    "rate at the top": ({"fs": FS, "run": {"acc": A, "units": "g"}}, "run.acc", "g", FS),
    "two levels": (
        {"exp": {"ch1": {"sampling_rate": FS, "values": A, "unit": "G"}}},
        "exp.ch1.values",
        "g",
        FS,
    ),
    "a step": ({"rec": {"dt": 1.0 / FS, "y": A}}, "rec.y", "", FS),
    "time beside": ({"rec": {"t": np.arange(N) / FS, "y": A}}, "rec.y", "", FS),
    "a cell": ({"fs": FS, "data": ["left", A]}, "data.2", "", FS),
    "an array of structs": (
        {"fs": FS, "ch": [{"name": "x", "y": A}, {"name": "z", "y": B}]},
        "ch.1.y",
        "",
        FS,
    ),
    "a struct in a cell": (
        {"runs": [{"fs": FS, "acc": A}, {"fs": FS, "acc": B}]},
        "runs.1.acc",
        "",
        FS,
    ),
    "LMS": (
        {
            "Signal": {
                "x_values": {
                    "start_value": 0.0,
                    "increment": 1.0 / FS,
                    "number_of_values": float(N),
                    "quantity": {"label": "s"},
                },
                "y_values": {"values": A, "quantity": {"label": "g"}},
                "function_record": {"name": "bearing:+Z", "type": "time"},
            }
        },
        "bearing:+Z",
        "g",
        FS,
    ),
    "LMS, two signals, in ms": (
        {
            "Signal_0": {
                "x_values": {"increment": 1e3 / FS, "quantity": {"label": "ms"}},
                "y_values": {"values": np.stack([A, B], axis=1), "quantity": {"label": "m/s^2"}},
                "function_record": {"name": ["DE", "FE"]},
            }
        },
        "DE",
        "m/s^2",
        FS,
    ),
    "names of columns": (
        {"fs": FS, "m": {"data": WIDE.T, "labels": ["x", "y", "z"], "unit": "g"}},
        "x",
        "g",
        FS,
    ),
    "rate in a head beside": (
        {"File_Header": {"SampleFrequency": FS, "Title": "run"}, "Channel_1_Data": A},
        "Channel_1_Data",
        "",
        FS,
    ),
    "rate as text": ({"data": {"fs": "25600 Hz", "acc": A}}, "data.acc", "", FS),
    "Case Western": (
        {"X105_DE_time": A, "X105_FE_time": B, "X105RPM": 1797.0, "fs": FS},
        "DE",
        "",
        FS,
    ),
}


@EVERY
@pytest.mark.parametrize("case", STRUCTS)
def test_structs_cells_and_names(tmp_path: Path, version: str, case: str) -> None:
    tree, name, unit, rate = STRUCTS[case]
    VERSIONS[version](tmp_path / "105.mat", tree)
    record = br.read(tmp_path / "105.mat", FS if case == "Case Western" else None)
    assert (record.channel().name, record.channel().unit) == (name, unit)
    assert record.fs == pytest.approx(rate, rel=1e-9)
    np.testing.assert_array_equal(record.channel().x, A)
    if case.startswith("MFPT"):
        assert record.shaft == 25.0
    if case == "Case Western":
        assert record.shaft == pytest.approx(29.95)


@EVERY
def test_paderborns_structs(tmp_path: Path, version: str) -> None:
    times = [
        {"Raster": "fast", "Data": np.arange(N) / 64e3},
        {"Raster": "slow", "Data": np.arange(50) / 4e3},
    ]
    signals = [
        {"Name": "force", "Raster": "slow", "Data": B[:50]},
        {"Name": "vibration_1", "Raster": "fast", "Data": A},
        {"Name": "speed", "Raster": "slow", "Data": np.full(50, 1500.0)},
    ]
    VERSIONS[version](tmp_path / "a.mat", {"N15": {"X": times, "Y": signals}})
    record = br.read(tmp_path / "a.mat")
    assert (list(record), record.fs, record.shaft) == (["vibration_1"], 64_000.0, 25.0)
    assert [list(other) for other in record.others] == [["force", "speed"]]


def hdf5(path: Path, fill: Callable[[Any], object]) -> None:
    with h5py.File(path, "w") as file:
        fill(file)


def _with_attributes(file: Any, data: Any, **attributes: Any) -> None:
    file.create_dataset("group/data", data=data).attrs.update(attributes)


def _frame(file: Any) -> None:
    group = file.create_group("frame")
    group["axis0"] = group["block0_items"] = np.array([b"x", b"y", b"z"])
    group["axis1"] = np.arange(N)
    group["block0_values"] = WIDE.T


def _matlab(content: Tree) -> Callable[[Path], None]:
    return lambda path: savemat(path, content)


def _matlab73(content: Tree) -> Callable[[Path], object]:
    return lambda path: Writer73(path, content)


# Matrices N x k and k x N, with their rate where each format may have it.
MATRICES: dict[str, tuple[str, Callable[[Path], object], bool]] = {
    "3 x N": ("mat", _matlab({"data": WIDE, "fs": FS}), True),
    "N x 3": ("mat", _matlab({"data": WIDE.T, "fs": FS}), True),
    "3 x N of v7.3": ("mat", _matlab73({"data": WIDE, "fs": FS}), True),
    "N x 3 of v7.3": ("mat", _matlab73({"data": WIDE.T, "fs": FS}), True),
    "no rate": ("mat", _matlab({"data": WIDE}), False),
    "times in the matrix": ("mat", _matlab({"data": np.vstack([np.arange(N) / FS, WIDE])}), True),
    "times beside": ("mat", _matlab({"time": np.arange(N) / FS, "data": WIDE.T}), True),
    "single precision": ("mat", _matlab({"data": WIDE.astype(np.float32), "Fs": FS}), True),
    "1 x 3 x N": ("mat", _matlab({"data": WIDE[None], "fs": FS}), True),
    "HDF5, rate in the data set": (
        "h5",
        lambda p: hdf5(p, lambda f: _with_attributes(f, WIDE.T, fs=FS)),
        True,
    ),
    "HDF5, rate in the file": (
        "h5",
        lambda p: hdf5(
            p, lambda f: (f.attrs.update(sampling_rate=FS), f.create_dataset("data", data=WIDE))
        ),
        True,
    ),
    "HDF5, rate in the group": (
        "h5",
        lambda p: hdf5(
            p, lambda f: (f.create_dataset("g/data", data=WIDE), f["g"].attrs.update(SampleRate=FS))
        ),
        True,
    ),
    "HDF5, step in the data set": (
        "h5",
        lambda p: hdf5(p, lambda f: _with_attributes(f, WIDE.T, dt=1.0 / FS)),
        True,
    ),
    "HDF5, rate beside": (
        "h5",
        lambda p: hdf5(
            p, lambda f: (f.create_dataset("g/data", data=WIDE), f.create_dataset("g/fs", data=FS))
        ),
        True,
    ),
    "HDF5, rate as text": (
        "h5",
        lambda p: hdf5(p, lambda f: _with_attributes(f, WIDE.T, sample_rate="25.6 kHz")),
        True,
    ),
    "HDF5, as pandas stores a frame": (
        "h5",
        lambda p: hdf5(p, _frame),
        False,
    ),
    "HDF5, no rate": (
        "h5",
        lambda p: hdf5(p, lambda f: f.create_dataset("data", data=WIDE.T)),
        False,
    ),
    "HDF5, names and units": (
        "h5",
        lambda p: hdf5(
            p, lambda f: _with_attributes(f, WIDE.T, fs=FS, columns=["x", "y", "z"], units="g")
        ),
        True,
    ),
    "NPY": ("npy", lambda p: np.save(p, WIDE.T), False),
    "NPY, turned": ("npy", lambda p: np.save(p, WIDE), False),
    "NPZ": ("npz", lambda p: np.savez(p, data=WIDE, fs=FS), True),
}


@pytest.mark.parametrize("case", MATRICES)
def test_matrices_are_columns(tmp_path: Path, case: str) -> None:
    end, write, rated = MATRICES[case]
    path = tmp_path / f"m.{end}"
    write(path)
    if not rated:
        with pytest.raises(br.SceneError, match=r"fs = None: the sampling rate"):
            br.read(path)
    record = br.read(path, None if rated else FS)
    assert (len(record), record.fs) == (3, FS)
    truth = WIDE.astype(np.float32) if case == "single precision" else WIDE
    np.testing.assert_array_equal(np.stack(list(record.values())), truth)
    if "names" in case:
        assert (list(record), record.units["x"]) == (["x", "y", "z"], "g")


def test_an_array_that_is_no_row_of_signals_is_told(tmp_path: Path) -> None:
    savemat(tmp_path / "a.mat", {"picture": np.zeros((100, 120)), "a": A, "fs": FS})
    record = br.read(tmp_path / "a.mat")
    assert list(record) == ["a"]
    assert record.metadata["left_out"] == ["picture (100, 120)"]
    savemat(tmp_path / "b.mat", {"picture": np.zeros((100, 120))})
    with pytest.raises(br.FileError, match=r"no data set that could be a signal.*picture"):
        br.read(tmp_path / "b.mat", FS)


# Vectors of other lengths and rates in one file: the signals, and what is kept beside.
BESIDE: dict[str, tuple[Tree, list[str], dict[str, tuple[int, float | None]]]] = {
    "pulses of a tachometer": (
        {"vibration": A, "tach": np.cumsum(np.full(90, 1e-3))},
        ["vibration"],
        {"tach": (90, None)},
    ),
    "a column vector": (
        {"vibration": A[:, None], "tach": B[:90, None]},
        ["vibration"],
        {"tach": (90, None)},
    ),
    "the tachometer first": (
        {"a_tach": B[:90], "vibration": A},
        ["vibration"],
        {"a_tach": (90, None)},
    ),
    "two slow ones": (
        {"acc": A, "load": B[:50], "torque": C[:50]},
        ["acc"],
        {"load": (50, None), "torque": (50, None)},
    ),
    "two lengths": (
        {"acc": A, "load": B[:50], "temp": C[:5]},
        ["acc"],
        {"load": (50, None), "temp": (5, None)},
    ),
    "one sample less": ({"acc": A, "acc2": B[:-1]}, ["acc"], {"acc2": (N - 1, FS)}),
    "rates of their own": (
        {"fast": {"fs": FS, "acc": A}, "slow": {"fs": 100.0, "load": B[:50]}},
        ["fast.acc"],
        {"slow.load": (50, 100.0)},
    ),
    "one length, two rates": (
        {"fast": {"fs": FS, "acc": A, "acc2": C}, "slow": {"fs": 100.0, "load": B}},
        ["fast.acc", "fast.acc2"],
        {"slow.load": (N, 100.0)},
    ),
    "a matrix beside": (
        {"acc": A, "orders": np.zeros((2, 40))},
        ["acc"],
        {"orders_1": (40, None), "orders_2": (40, None)},
    ),
    "Case Western's of other lengths": (
        {"X105_DE_time": A, "X105_FE_time": B[:-2], "X105RPM": 1797.0},
        ["DE"],
        {"FE": (N - 2, FS)},
    ),
    "a gain of two numbers": (
        {"acc": A, "gain": np.array([1.0, 2.0])},
        ["acc"],
        {"gain": (2, None)},
    ),
}


@EVERY
@pytest.mark.parametrize("case", BESIDE)
def test_vectors_of_other_lengths_are_kept_beside(tmp_path: Path, version: str, case: str) -> None:
    tree, names, others = BESIDE[case]
    VERSIONS[version](tmp_path / "105.mat", tree)
    record = br.read(tmp_path / "105.mat", fs=None if "rate" in case else FS)
    assert (list(record), record.fs) == (names, FS)
    np.testing.assert_array_equal(record[names[0]], A)
    found = {name: (one.n_samples, one.fs) for one in record.others for name in one}
    assert set(found) == set(others)
    for name, (size, rate) in others.items():
        assert found[name][0] == size
        assert found[name][1] == rate or (rate is None and np.isnan(found[name][1]))
        assert f"{name} ({size} samples)" in repr(record)


def test_a_vector_beside_is_chosen_by_its_name(tmp_path: Path) -> None:
    savemat(tmp_path / "a.mat", {"vibration": A, "load": B[:50]})
    record = br.read(tmp_path / "a.mat", fs=100.0, columns="load")
    assert (list(record), record.n_samples) == (["load"], 50)


def test_others_without_a_rate_are_refused_by_what_needs_one() -> None:
    record = br.Recording(columns={"tach": A}, fs=float("nan"))
    with pytest.raises(br.SceneError, match="fs"):
        br.spectra.psd(record)


def test_hdf5_and_npz_keep_texts_and_numbers_as_metadata(tmp_path: Path) -> None:
    np.savez(tmp_path / "a.npz", acc=A, fs=FS, load=270.0, name="run 7", unit="g")
    record = br.read(tmp_path / "a.npz")
    assert (record.units["acc"], record.fs) == ("g", FS)
    assert {"load": 270.0, "name": "run 7"}.items() <= record.metadata.items()
    structured = np.zeros(N, dtype=[("t", "f8"), ("acc", "f4")])
    structured["t"], structured["acc"] = np.arange(N) / FS, A
    np.save(tmp_path / "b.npy", structured)
    assert (list(br.read(tmp_path / "b.npy")), br.read(tmp_path / "b.npy").fs) == (["acc"], FS)


def test_objects_in_npy_are_not_unpickled(tmp_path: Path) -> None:
    for name in ("a.npy", "a.npz"):
        path = tmp_path / name
        objects = np.array([{"a": 1}], dtype=object)
        np.save(path, objects, allow_pickle=True) if name == "a.npy" else np.savez(path, x=objects)
        with pytest.raises(br.FileError, match=r"br\.Recording\(array, fs=fs, unit=.g.\)"):
            br.read(path, FS)
