"""Columns that are times, counters or clocks, under any name and in any unit; rates given beside them.

The truth is the rate that the times were made with.
"""

from __future__ import annotations

import datetime as dt
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
import pytest
from scipy.io import savemat

import ballrace as br

FS = 25_600.0
N = 400
K = np.arange(N)
_rng = np.random.default_rng(67)
A = np.round(_rng.normal(size=N), 6)
B = np.round(_rng.normal(size=N), 6)

Columns = dict[str, Any]


def as_text(path: Path, columns: Columns) -> Path:
    lines = [
        ",".join(columns),
        *(",".join(map(str, row)) for row in zip(*columns.values(), strict=True)),
    ]
    path = path.with_suffix(".csv")
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def as_parquet(path: Path, columns: Columns) -> Path:
    path = path.with_suffix(".parquet")
    pl.DataFrame(columns).write_parquet(path)
    return path


def as_mat(path: Path, columns: Columns) -> Path:
    path = path.with_suffix(".mat")
    savemat(path, {name: np.asarray(x) for name, x in columns.items()})
    return path


def as_hdf5(path: Path, columns: Columns) -> Path:
    h5py = pytest.importorskip("h5py")
    path = path.with_suffix(".h5")
    with h5py.File(path, "w") as file:
        for name, x in columns.items():
            file[name] = x
    return path


def as_npz(path: Path, columns: Columns) -> Path:
    path = path.with_suffix(".npz")
    np.savez(path, **columns)
    return path


WRITERS = {"csv": as_text, "parquet": as_parquet, "mat": as_mat, "hdf5": as_hdf5, "npz": as_npz}
EVERY = pytest.mark.parametrize("form", WRITERS)

# Whole numbers that rise equally, without a unit: times of several units, or numbers of samples.
WITHOUT_A_UNIT: dict[str, tuple[str, Any, float, str]] = {
    "epoch in ms": ("timestamp", 1_700_000_000_000 + K, 1000.0, "time_unit"),
    "epoch in µs": ("timestamp", 1_700_000_000_000_000 + 100 * K, 10_000.0, "time_unit"),
    "epoch in ns": ("time", 1_700_000_000_000_000_000 + 50_000 * K, 20_000.0, "time_unit"),
    "milliseconds": ("time", 2 * K, 500.0, "time_unit"),
    "microseconds": ("Time", 40 * K, 25_000.0, "time_unit"),
    "nanoseconds": ("t", 39_000 * K, 1e9 / 39_000, "time_unit"),
    "µs with fractions": ("time", 39.0625 * K, FS, "time_unit"),
    "ms with fractions": ("time", np.round(0.0390625 * K, 6), FS, "time_unit"),
    "numbers of samples": ("sample", K, FS, "fs"),
    "numbers of samples from 1": ("no", K + 1, FS, "fs"),
    "a counter that goes on": ("counter", K + 51_200, FS, "fs"),
    "seconds, slowly": ("time", K, 1.0, "fs"),
}


@EVERY
@pytest.mark.parametrize("case", WITHOUT_A_UNIT)
def test_times_without_a_unit_are_asked_for(tmp_path: Path, form: str, case: str) -> None:
    name, times, rate, asked = WITHOUT_A_UNIT[case]
    path = WRITERS[form](tmp_path / "a", {name: times, "acc": A})
    with pytest.raises(br.SceneError) as caught:
        br.read(path)
    assert caught.value.path == asked
    assert name in caught.value.allowed
    record = br.read(path, fs=rate)
    assert list(record) == ["acc"]
    assert record.fs == pytest.approx(rate, rel=1e-9)
    np.testing.assert_array_equal(record["acc"], A)


def test_days_of_a_spreadsheet_are_asked_for(tmp_path: Path) -> None:
    path = as_text(
        tmp_path / "a", {"Time": [f"{46_352.5 + x / 86_400.0:.12f}" for x in K / 100.0], "a": A}
    )
    with pytest.raises(br.SceneError, match=r'time_unit = None: .*"d" makes 100 Hz'):
        br.read(path)
    assert br.read(path, time_unit="d").fs == 100.0


@EVERY
@pytest.mark.parametrize(("unit", "scale"), [("s", 1.0), ("ms", 1e3), ("us", 1e6), ("ns", 1e9)])
def test_a_unit_that_is_given_counts(tmp_path: Path, form: str, unit: str, scale: float) -> None:
    # 12.5 kHz has whole steps in every unit but seconds and milliseconds.
    times = np.round(K / 12_500.0 * scale, 9)
    path = WRITERS[form](tmp_path / "a", {"stamp": times, "acc": A})
    assert br.read(path, time_unit=unit).fs == pytest.approx(12_500.0, rel=1e-9)


@pytest.mark.parametrize(
    ("title", "scale"),
    [
        ("t [s]", 1.0),
        ("Time (ms)", 1e3),
        ("time_us", 1e6),
        ("Timestamp [µs]", 1e6),
        ("t / ms", 1e3),
        ("TimeNs", 1e9),
        ("Zeit in ms", 1e3),
        ("millis", 1e3),
        ("elapsed time (sec)", 1.0),
        ("X_Value", 1.0),
        ("Time [min]", 1.0 / 60.0),
        ("seconds", 1.0),
    ],
)
def test_units_are_in_names(tmp_path: Path, title: str, scale: float) -> None:
    record = br.read(
        as_text(tmp_path / "a", {title: [f"{x:.12g}" for x in K / 12_500.0 * scale], "acc": A})
    )
    assert (list(record), record.fs) == (["acc"], 12_500.0)


# Columns that are no signals: never the default, and never among the signals.
def clock(*, hour: bool = True, fraction: float = 1e6, start: float = 34_779.065_664) -> Columns:
    at = start + K / FS
    whole = np.floor(at).astype(int)
    columns: Columns = {"h": whole // 3600, "m": whole // 60 % 60, "s": whole % 60}
    if not hour:
        del columns["h"]
    return columns | {"f": np.floor((at - whole) * fraction).astype(int)}


def stamps(form: str, start: dt.datetime | None = None) -> list[str]:
    start = start or dt.datetime(2026, 11, 26, 10, 20, 30)
    return [(start + dt.timedelta(seconds=k / 4000.0)).strftime(form) for k in range(N)]


CLOCKS: dict[str, tuple[Columns, float]] = {
    "hour, minute, second, µs": (clock(), FS),
    "seconds with a fraction": (
        {"h": np.full(N, 9), "m": np.full(N, 39), "s": [f"{39.5 + x:.9f}" for x in K / FS]},
        FS,
    ),
    "a date as a number": ({"d": np.full(N, 20261126), "t [s]": [f"{x:.9f}" for x in K / FS]}, FS),
    "a number of the device": ({"id": np.full(N, 7), "abc": [f"{x:.9f}" for x in K / FS]}, FS),
    "stamps to the second, then microseconds": (
        {"when": ["2026-11-26 10:20:30"] * N, "us": np.round(1e6 * K / 12_500.0).astype(int)},
        12_500.0,
    ),
    "over a full second": (clock(start=34_779.995), FS),
    "over midnight's hour": (clock(start=35_999.999), FS),
    "minute, second, µs": (clock(hour=False), FS),
    "hour, minute, second, ns": (clock(fraction=1e9), FS),
    "a counter, then a clock": ({"n": K, **clock()}, FS),
    "ISO 8601": ({"when": stamps("%Y-%m-%dT%H:%M:%S.%f")}, 4000.0),
    "ISO 8601 in UTC": ({"when": stamps("%Y-%m-%dT%H:%M:%S.%fZ")}, 4000.0),
    "date and time with a blank": ({"when": stamps("%Y-%m-%d %H:%M:%S.%f")}, 4000.0),
    "day first": ({"when": stamps("%d.%m.%Y %H:%M:%S.%f")}, 4000.0),
    "month first, twelve hours": ({"when": stamps("%m/%d/%Y %I:%M:%S.%f %p")}, 4000.0),
    "time of day": ({"when": stamps("%H:%M:%S.%f")}, 4000.0),
    "minutes and seconds of a spreadsheet": ({"when": stamps("%M:%S.%f")}, 4000.0),
    "date beside time of day": (
        {"date": stamps("%Y-%m-%d"), "when": stamps("%H:%M:%S.%f")},
        4000.0,
    ),
    "over midnight": (
        {"when": stamps("%H:%M:%S.%f", dt.datetime(2026, 11, 26, 23, 59, 59, 950_000))},
        4000.0,
    ),
    "compact": ({"when": stamps("%Y%m%dT%H%M%S.%f")}, 4000.0),
    "seconds under another name": ({"abc": [f"{x:.9f}" for x in K / FS]}, FS),
    "a counter and seconds": ({"n": K, "abc": [f"{x:.9f}" for x in K / FS]}, FS),
    "seconds and a counter": ({"abc": [f"{x:.9f}" for x in K / FS], "n": K}, FS),
    "seconds twice": (
        {"t [s]": [f"{x:.9f}" for x in K / FS], "Time [s]": [f"{x:.9f}" for x in K / FS]},
        FS,
    ),
    "epoch in seconds": ({"time": [f"{1.7e9 + x:.7f}" for x in K / FS]}, FS),
}


@pytest.mark.parametrize("headed", [True, False])
@pytest.mark.parametrize("case", CLOCKS)
def test_clocks_counters_and_times_are_no_signals(tmp_path: Path, case: str, headed: bool) -> None:
    columns, rate = CLOCKS[case]
    path = as_text(tmp_path / "acc", columns | {"a": A, "b": B})
    if not headed:
        path.write_text(path.read_text(encoding="utf-8").split("\n", 1)[1], encoding="utf-8")
    record = br.read(path)
    assert record.fs == rate
    assert len(record) == 2
    np.testing.assert_array_equal(record.channel().x, A)
    np.testing.assert_array_equal(list(record.values())[1], B)
    assert record.metadata["times"]


def test_a_clock_of_seconds_needs_the_rate(tmp_path: Path) -> None:
    """Three seconds, written to the second: the rate is known to a third."""
    count = 3000
    at = 10 * 3600 + np.arange(count) / 1000.0
    columns = {"h": at // 3600, "m": at // 60 % 60, "s": np.floor(at % 60)}
    a = np.round(np.random.default_rng(1).normal(size=count), 4)
    path = as_text(tmp_path / "a", {k: v.astype(int) for k, v in columns.items()} | {"a": a})
    with pytest.raises(br.SceneError, match=r"fs = None: .*rounded to 1 s"):
        br.read(path)
    with pytest.warns(br.FileWarning, match="do not resolve"):
        record = br.read(path, fs=1000.0)
    assert (list(record), record.fs) == (["a"], 1000.0)


def test_dates_and_times_of_other_formats(tmp_path: Path) -> None:
    start = dt.datetime(2026, 11, 26)
    when = [start + dt.timedelta(microseconds=250 * k) for k in range(N)]
    record = br.read(as_parquet(tmp_path / "a", {"when": when, "acc": A}))
    assert (list(record), record.fs) == (["acc"], 4000.0)


# Times that are rounded, and the rate that is given beside them.
ROUNDED: dict[str, Callable[[Any], list[str]]] = {
    "to four digits": lambda t: [f"{x:.4f}" for x in t],
    "to milliseconds": lambda t: [f"{x:.3f}" for x in t],
    "cut to milliseconds": lambda t: [f"{np.floor(1e3 * x) / 1e3:.3f}" for x in t],
    "to hundredths": lambda t: [f"{x:.2f}" for x in t],
    "from a start": lambda t: [f"{100.0 + x:.4f}" for x in t],
    "of single precision far from 0": lambda t: [f"{np.float32(5000.0 + x):.6f}" for x in t],
    "in ms to one digit": lambda t: [f"{1e3 * x:.1f}" for x in t],
    "times of day to the ms": lambda t: [f"10:20:{30.0 + x:06.3f}" for x in t],
    "whole seconds": lambda t: [f"{np.floor(x):.0f}" for x in t],
    "times of day to the second": lambda t: [f"10:20:{np.floor(30.0 + x):02.0f}" for x in t],
}


@pytest.mark.parametrize("case", ROUNDED)
def test_a_given_rate_wins_over_rounded_times(tmp_path: Path, case: str) -> None:
    count = 2000
    a = np.round(np.random.default_rng(2).normal(size=count), 4)
    title = "time [ms]" if case.startswith("in ms") else "time [s]"
    path = as_text(tmp_path / "a", {title: ROUNDED[case](np.arange(count) / FS), "a": a})
    with pytest.raises(br.SceneError, match=r"^fs = None"):
        br.read(path)
    with pytest.warns(br.FileWarning, match="25600 Hz was taken"):
        record = br.read(path, fs=FS)
    assert (list(record), record.fs) == (["a"], FS)
    np.testing.assert_array_equal(record["a"], a)


def test_rounded_times_of_a_long_record_tell_the_rate(tmp_path: Path) -> None:
    t = np.arange(60_000) / 2560.0
    path = as_text(tmp_path / "a", {"time": [f"{x:.3f}" for x in t], "a": np.round(np.sin(t), 4)})
    assert br.read(path).fs == 2560.0


@pytest.mark.parametrize("form", ["csv", "parquet", "mat", "hdf5", "npz"])
def test_two_precise_rates_that_contradict_each_other_are_refused(
    tmp_path: Path, form: str
) -> None:
    path = WRITERS[form](tmp_path / "a", {"t": np.round(K / FS, 9), "a": A})
    for fs in (12_800.0, 25_000.0, 26_000.0, 1797.0):
        with pytest.raises(br.SceneError, match=rf"fs = {fs:g}: .*25600 Hz.*time=False"):
            br.read(path, fs=fs)
    assert br.read(path, fs=25_605.0).fs == FS
    with pytest.warns(br.FileWarning, match="make 25600 Hz; 25500 Hz was taken"):
        assert br.read(path, fs=25_500.0).fs == 25_500.0
    record = br.read(path, fs=12_800.0, time=False)
    assert (sorted(record), record.fs) == (["a", "t"], 12_800.0)


def test_missing_samples_are_no_rounding(tmp_path: Path) -> None:
    t = np.delete(np.arange(1001), 500) / 1000.0
    path = as_text(tmp_path / "a", {"time": [f"{x:.3f}" for x in t], "a": np.round(np.sin(t), 4)})
    with pytest.raises(br.FileError, match="not at equal steps"):
        br.read(path)
    with pytest.warns(br.FileWarning, match="not at equal steps"):
        br.read(path, fs=1000.0)
    gap = np.delete(np.arange(2000), range(500, 900)) / 1000.0
    path = as_text(
        tmp_path / "a", {"time": [f"{x:.3f}" for x in gap], "a": np.round(np.sin(gap), 4)}
    )
    with pytest.raises(br.FileError, match="samples seem to be missing, or time=False"):
        br.read(path, fs=1000.0)
    assert br.read(path, fs=1000.0, time=False, columns="a").n_samples == 1600


def test_times_that_jitter_need_the_rate(tmp_path: Path) -> None:
    t = K / 1000.0 + 4e-4 * np.random.default_rng(4).random(N)
    path = as_text(tmp_path / "a", {"time [s]": np.sort(t), "a": A})
    with pytest.raises(br.FileError, match=r"not at equal steps.* give fs"):
        br.read(path)
    with pytest.warns(br.FileWarning, match="not at equal steps"):
        assert br.read(path, fs=1000.0).fs == 1000.0


def test_times_are_found_beside_chosen_columns(tmp_path: Path) -> None:
    path = as_text(tmp_path / "a", {"abc": [f"{x:.9f}" for x in K / FS], "a": A})
    assert br.read(path, columns={1: "ay"}).fs == FS
    path = as_text(tmp_path / "b", {**clock(), "a": A})
    assert br.read(path, columns=[-1]).fs == FS


def test_columns_of_time_are_named(tmp_path: Path) -> None:
    path = as_text(tmp_path / "a", {"u": [f"{x:.6f}" for x in np.sqrt(K)], "v": 40 * K, "a": A})
    record = br.read(path, time="v", time_unit="us")
    assert (list(record), record.fs) == (["u", "a"], 25_000.0)
    record = br.read(path, time=-2, time_unit="us", columns=["a"])
    assert (list(record), record.fs) == (["a"], 25_000.0)
    path = as_text(tmp_path / "b", {**clock(), "a": A})
    assert br.read(path, time=["h", "m", "s", "f"]).fs == FS
    for time in ("w", ["h", "a"], 9):
        with pytest.raises(br.SceneError, match=r"^time = "):
            br.read(path, time=time)


@pytest.mark.parametrize("ramp", ["speed", "temperature"])
def test_a_ramp_beside_times_is_a_signal(tmp_path: Path, ramp: str) -> None:
    columns = {"t [s]": K / 1000.0, ramp: np.round(10.0 + 0.013 * K, 4), "a": A}
    assert list(br.read(as_text(tmp_path / "a", columns))) == [ramp, "a"]


def test_a_table_of_ramps_alone_is_one_of_signals(tmp_path: Path) -> None:
    record = br.read(as_text(tmp_path / "a", {"t [s]": K / 1000.0, "a": K}))
    assert (list(record), record.fs) == (["a"], 1000.0)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("skip", -1),
        ("skip", 1.5),
        ("skip", "3"),
        ("columns", []),
        ("columns", 1.5),
        ("columns", [None]),
        ("columns", {1: 2}),
        ("decimal", ";"),
        ("decimal", True),
        ("time", True),
        ("time", 1.5),
        ("time", []),
        ("time_unit", "fortnight"),
        ("time_unit", 1),
        ("start", -1.0),
        ("start", "1"),
        ("start", float("inf")),
        ("stop", -1.0),
        ("stop", float("nan")),
    ],
)
def test_what_is_said_about_a_file_is_checked_by_name(
    tmp_path: Path, name: str, value: Any
) -> None:
    path = as_text(tmp_path / "a", {"t": K / 1000.0, "a": A})
    read: Any = br.read
    with pytest.raises(br.SceneError) as caught:
        read(path, **{name: value})
    assert caught.value.path == name


def test_what_is_of_text_alone_is_refused_elsewhere(tmp_path: Path) -> None:
    path = as_mat(tmp_path / "a", {"a": A, "fs": 1000.0})
    for options in ({"skip": 1}, {"decimal": ","}):
        with pytest.raises(br.SceneError, match=r"left out: a\.mat is a MATLAB file, no text"):
            br.read(path, **options)
