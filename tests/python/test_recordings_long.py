"""Long records: parts of them by time, memory that is bounded; folders as one sequence for a trend."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import ballrace as br
from ballrace._base import memory as _memory
from ballrace.recordings.formats import FORMATS

FS = 2000.0
N = 6000
X = np.round(np.random.default_rng(70).normal(size=N), 6)
Y = np.round(np.random.default_rng(71).normal(size=N), 6)

WRITTEN = {one.suffixes[0]: one.library for one in FORMATS.values() if one.written}


@pytest.mark.parametrize("end", WRITTEN)
@pytest.mark.parametrize(
    ("part", "rows"),
    [((None, 0.5), (0, 1000)), ((1.0, 1.5), (2000, 3000)), ((2.9, None), (5800, 6000)),
     ((0.25, 99.0), (500, 6000)),
     ((0.00025, 0.001), (1, 2))],
)  # fmt: skip
def test_a_part_of_a_record(
    tmp_path: Path, end: str, part: tuple[float | None, float | None], rows: tuple[int, int]
) -> None:
    (start, stop), (first, last) = part, rows
    path = tmp_path / f"a{end}"
    pytest.importorskip(WRITTEN[end])
    br.Recording(columns={"x": X, "y": Y}, fs=FS, units={"x": "g"}).write(path)
    record = br.read(path, start=start, stop=stop)
    assert (list(record), record.fs, record.units["x"]) == (["x", "y"], FS, "g")
    exact = 1e-7 if end == ".wav" else 0.0
    np.testing.assert_allclose(record["y"], Y[first:last], rtol=exact)
    assert (
        br.read(path, start=start, stop=stop, columns="y", trusted=True).n_samples == last - first
    )


def test_parts_of_others_and_of_a_text_in_pieces(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of a text, pieces that are not asked for are not kept."""
    path = tmp_path / "a.csv"
    br.Recording(columns={"x": X, "y": Y}, fs=FS).write(path)
    monkeypatch.setattr("ballrace.recordings.lines.PIECE", 1 << 12)
    for start, stop in ((0.0, 0.4), (0.777, 1.234), (2.5, 3.0)):
        part = br.read(path, start=start, stop=stop, trusted=True)
        first, last = round(start * FS), round(stop * FS)
        np.testing.assert_array_equal(part["x"], X[first:last])
    np.testing.assert_array_equal(br.read(path, trusted=True)["x"], X)


def test_parts_beyond_the_record_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    br.Recording(columns={"x": X}, fs=FS).write(path)
    with pytest.raises(br.SceneError, match=r"start = 3\.0: below the length of the record, 3 s"):
        br.read(path, start=3.0)
    with pytest.raises(br.SceneError, match=r"stop = 1\.0: after start, 1 s"):
        br.read(path, start=1.0, stop=1.0)
    path.write_text("x\n" + "0.5\n" * 100)
    with pytest.raises(br.SceneError, match=r"fs = None: the sampling rate .*which start needs"):
        br.read(path, start=0.01)
    assert br.read(path, fs=1000.0, start=0.01, stop=0.02).n_samples == 10


LONG = """
import resource, sys, ballrace as br
record = br.read(sys.argv[1], fs=51_200.0, trusted=True)
print(record.n_samples, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024)
part = br.read(sys.argv[1], fs=51_200.0, start=10.0, stop=11.0)
print(part.n_samples)
"""


@pytest.mark.serial
@pytest.mark.skipif(_memory.used() is None, reason="only Linux tells the memory")
def test_memory_for_a_text_is_that_of_its_samples(tmp_path: Path) -> None:
    """80 MB of text, as much in samples: polars and both copies of a piece take the rest."""
    count = 10_000_000
    (tmp_path / "a.csv").write_bytes(b"x\n" + b"0.12345\n-1.2345\n" * (count // 2))
    taken = []
    for name, size in (("a.csv", count), ("b.csv", 1000)):
        if name == "b.csv":
            (tmp_path / name).write_bytes(b"x\n" + b"0.12345\n" * 1000)
        command = [sys.executable, "-c", LONG.partition("part =")[0], str(tmp_path / name)]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        samples, peak = map(int, done.stdout.split())
        assert samples == size
        taken.append(peak)
    assert taken[0] - taken[1] < 8 * count + 220e6
    command = [sys.executable, "-c", LONG, str(tmp_path / "a.csv")]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout.split()[-1] == "51200"


def fill(folder: Path, names: list[str]) -> None:
    for number, name in enumerate(names):
        br.Recording(X[:100] + number, fs=FS, unit="g").write(folder / name)


@pytest.mark.parametrize(
    ("names", "times"),
    [
        (["10.csv", "2.csv", "1.csv"], [1.0, 2.0, 10.0]),
        (["acc_00003.csv", "acc_00001.csv", "acc_00002.csv"], [1.0, 2.0, 3.0]),
        (["2004.02.12.10.32.39.csv", "2004.02.12.10.42.39.csv", "2004.02.13.10.32.39.csv"], [0.0, 600.0, 86400.0]),
        (["b 20260131_120000.csv", "a 20260131_115930.csv"], [0.0, 30.0]),
        (["run-2026-01-31T12-00-00.csv", "run-2026-01-31T13-00-00.csv"], [0.0, 3600.0]),
        (["a1_x2.csv", "a2_x7.csv", "b.csv"], [0.0, 1.0, 2.0]),
        (["left.csv", "right.csv"], [0.0, 1.0]),
    ],
)  # fmt: skip
def test_a_folder_is_a_sequence_with_times(
    tmp_path: Path, names: list[str], times: list[float]
) -> None:
    fill(tmp_path, names)
    (tmp_path / ".hidden.csv").write_text("no record")
    (tmp_path / "folder.csv").mkdir()
    records = br.read_folder(tmp_path, "*.csv")
    assert records.times.tolist() == times
    assert [record.n_samples for record in records] == [100] * len(names)
    assert records[-1].source == str(records.paths[-1])
    assert records[1:].times.tolist() == times[1:]
    assert len(records[:1]) == 1


def test_a_folder_by_when_its_files_were_changed(tmp_path: Path) -> None:
    fill(tmp_path, ["b.csv", "a.csv", "c.csv"])
    for name, at in (("a.csv", 300), ("b.csv", 100), ("c.csv", 200)):
        os.utime(tmp_path / name, (at, at))
    records = br.read_folder(tmp_path, times="modified", fs=FS)
    assert [path.name for path in records.paths] == ["b.csv", "c.csv", "a.csv"]
    assert records.times.tolist() == [0.0, 100.0, 200.0]


def test_what_a_folder_cannot_be_is_refused(tmp_path: Path) -> None:
    read: Any = br.read_folder
    fill(tmp_path, ["b.csv", "a.csv"])
    for name, options in (
        ("pattern", {"pattern": "*.mat"}), ("pattern", {"pattern": "../*"}), ("pattern", {"pattern": 3}),
        ("times", {"times": "names"}), ("times", {"times": "size"}),
    ):  # fmt: skip
        with pytest.raises(br.SceneError) as caught:
            read(tmp_path, **options)
        assert caught.value.path == name
    for name in ("a.csv", "b.csv"):
        os.utime(tmp_path / name, (100, 100))
    with pytest.raises(
        br.SceneError, match=r"different for each file, and not as of a\.csv and b\.csv"
    ):
        read(tmp_path, times="modified")
    with pytest.raises(FileNotFoundError):
        read(tmp_path / "none")


def test_a_folder_goes_into_a_trend_with_its_times(tmp_path: Path) -> None:
    for number in range(8):
        x = np.random.default_rng(number).normal(size=6000)
        path = tmp_path / f"2026-11-26_{10 + number}-00-00.csv"
        br.Recording(np.round(x, 4), fs=12_000.0, unit="g").write(path)
    records = br.read_folder(tmp_path, "*.csv")
    found = br.trend(records, "6205", 1797.0, baseline=4)
    assert found.table["time"].to_list() == [3600.0 * k for k in range(8)]
    given = br.trend(records, "6205", 1797.0, baseline=4, times=range(8))
    assert given.table["time"].to_list() == list(range(8))
