"""A run that writes its signals as it goes on: the same file, flat memory, and nothing after a failure."""

from __future__ import annotations

import io
import os
import pickle
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
import pytest

import ballrace as br
from ballrace.cli import main


def wide(times: int = 60) -> br.Scene:
    """A scene of so many columns that a block has some hundred samples."""
    scene = br.presets.deep_groove_6205()
    probes: dict[str, Any] = {f"contacts{k}": br.scene.ContactsProbe() for k in range(times)}
    probes["slices"] = br.scene.SlicesProbe(balls=(1,), times=(0.0, 2e-4))
    return replace(scene, probes={**scene.probes, **probes})


RUN: dict[str, Any] = {"duration": 0.03, "settle": 0.0}


def same(one: br.Signals, two: br.Signals) -> None:
    np.testing.assert_array_equal(one.t, two.t)
    assert one.names == two.names
    for name in one.names:
        np.testing.assert_array_equal(one[name], two[name], err_msg=name)
    assert (one.fs, one.units, one.scene) == (two.fs, two.units, two.scene)
    assert (one.warnings, one.provenance) == (two.warnings, two.provenance)
    stats = [{**signals.stats, "wall_time": 0.0} for signals in (one, two)]
    assert stats[0] == stats[1]
    assert one.slices is not None
    assert two.slices is not None
    assert one.slices.equals(two.slices)


def test_the_file_is_what_the_run_without_it_gives(tmp_path: Path) -> None:
    """Truth: the run that keeps its samples, and the file that it writes."""
    path, kept_path = tmp_path / "record.parquet", tmp_path / "kept.parquet"
    kept = br.simulate(wide(30), **RUN)
    kept.write_parquet(kept_path)
    path.write_text("old")
    out = br.simulate(wide(30), **RUN, out=path)
    assert {p.name for p in tmp_path.iterdir()} == {"record.parquet", "kept.parquet"}
    read = br.Signals.read_parquet(path)
    same(read, kept)
    assert read.stats == out.stats
    metadata = pl.read_parquet_metadata(path), pl.read_parquet_metadata(kept_path)
    assert metadata[0].keys() == metadata[1].keys()
    assert pl.read_parquet(path).equals(pl.read_parquet(kept_path))


def test_columns_of_a_file_are_those_of_the_run(tmp_path: Path) -> None:
    """Truth: the run that keeps its samples, points at so high a rate that there are several blocks."""
    path, kept_path = tmp_path / "record.parquet", tmp_path / "kept.parquet"
    run: dict[str, Any] = {"duration": 1.5e-3, "fs": 1e8, "start": "rolling", "settle": 0.0}
    kept = br.simulate(wide(0), **run)
    assert kept.n_samples == kept.t.size > 2 * 65536
    kept.write_parquet(kept_path)
    same(br.simulate(wide(0), **run, out=path), kept)
    same(br.Signals.scan_parquet(path), kept)
    same(br.Signals.scan_parquet(kept_path), kept)


def test_signals_of_a_file_are_signals(tmp_path: Path) -> None:
    path = tmp_path / "record.parquet"
    out = br.simulate(wide(1), duration=1e-3, out=str(path))
    assert (out.n_samples, out.t.size, len(out)) == (50, 50, len(out.names))
    assert "50 samples" in repr(out)
    assert all(values.shape == (50,) for values in out.values())
    assert out.to_polars().equals(pl.read_parquet(path))
    with pytest.raises(KeyError, match=r"near are outer\.ay'?\"?$"):
        out["outer.AY"]
    with pytest.raises(KeyError, match=r"near are outer\.ay"):
        out["outer_ay"]
    same(pickle.loads(pickle.dumps(out)), out)
    out.write_parquet(tmp_path / "again.parquet")
    same(br.Signals.read_parquet(tmp_path / "again.parquet"), out)


def test_a_file_that_changes_or_is_damaged_is_reported(tmp_path: Path) -> None:
    path = tmp_path / "record.parquet"
    out = br.simulate(wide(1), duration=1e-3, out=path)
    data = path.read_bytes()
    path.write_bytes(data[:100] + bytes([data[100] ^ 1]) + data[101:])
    with pytest.raises(br.FileError, match="its content is not what was written"):
        br.Signals.scan_parquet(path)
    path.write_bytes(data + b"x")
    with pytest.raises(br.FileError, match="has changed since it was opened"):
        out["outer.ay"]
    pl.DataFrame({"a": [1.0]}).write_parquet(path)
    with pytest.raises(br.FileError, match="not written by this version of ballrace"):
        br.Signals.scan_parquet(path)


def test_warnings_are_reported(tmp_path: Path) -> None:
    scene = br.presets.wheel_bearing().replace({"friction.coulomb.slip_speed": 1e-4})
    with pytest.warns(br.AccuracyWarning, match="accelerations are uncertain"):
        out = br.simulate(
            scene, duration=2e-3, rtol=1e-3, settle=0.0, out=tmp_path / "record.parquet"
        )
    assert out.warnings
    assert br.Signals.read_parquet(tmp_path / "record.parquet").warnings == out.warnings


def test_targets_that_cannot_be_meant(tmp_path: Path) -> None:
    """Refused before anything runs: the scene, which takes minutes, is never begun."""
    before = set(tmp_path.iterdir())

    def refused(kind: type[Exception], match: str, out: Any) -> None:
        with pytest.raises(kind, match=match):
            br.simulate(br.presets.wheel_bearing(), duration=1e3, out=out)

    refused(br.SceneError, r"out = .*a file that ends in \.parquet", tmp_path / "out.csv")
    refused(br.SceneError, "out = -: ", "-")
    refused(br.SceneError, "out = BytesIO: the name of a Parquet file", io.BytesIO())
    refused(FileNotFoundError, "no such folder", tmp_path / "nowhere" / "out.parquet")
    refused(IsADirectoryError, "is a folder", tmp_path)
    if sys.platform != "win32":
        refused(OSError, "is a device or a pipe", os.devnull)
    assert set(tmp_path.iterdir()) == before


class StoppedError(Exception):
    """What a callback raises."""


def stop(share: float) -> None:
    if share > 0.5:
        raise StoppedError


@pytest.mark.parametrize("old", [None, "old"])
def test_a_run_that_ends_early_leaves_nothing(tmp_path: Path, old: str | None) -> None:
    path = tmp_path / "record.parquet"
    if old is not None:
        path.write_text(old)
    before = set(tmp_path.iterdir())
    long: dict[str, Any] = {"duration": 1.0, "settle": 0.0, "out": path}
    with pytest.raises(StoppedError):
        br.simulate(wide(), duration=0.06, settle=0.0, out=path, progress=stop)
    with pytest.raises(br.BudgetError):
        br.simulate(wide(), **long, max_steps=3000)
    with pytest.raises(br.EquilibriumError):
        br.simulate(wide(0).replace({"loads.radial.force": 1e9}), **long)
    assert set(tmp_path.iterdir()) == before
    assert old is None or path.read_text() == old


def test_a_write_that_fails_stops_the_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def disk_full(_self: pl.DataFrame, path: Path, **_: object) -> None:
        blocks.append(path)
        path.write_text("half")
        if len(blocks) == 2:
            raise OSError(28, "No space left on device")

    blocks: list[Path] = []
    monkeypatch.setattr(pl.DataFrame, "write_parquet", disk_full)
    with pytest.raises(OSError, match="space"):
        br.simulate(wide(), duration=100.0, settle=0.0, out=tmp_path / "record.parquet")
    assert len(blocks) == 2
    assert not list(tmp_path.iterdir())


LIMITED = """
import resource, signal, sys
from ballrace.cli import main
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, ({limit}, {limit}))
options = "run scene.toml -o out.parquet --duration 3e-3 --fs 1e8 --start rolling --settle 0"
sys.exit(main(options.split()))
"""


@pytest.mark.skipif(sys.platform == "win32", reason="there is no limit of a file's size")
@pytest.mark.parametrize("limit", [1 << 20, 15 << 20], ids=["block", "whole"])
def test_a_disk_that_is_full_is_reported_and_leaves_nothing(tmp_path: Path, limit: int) -> None:
    """Limit: of the size of files, below that of a block, or of the blocks together."""
    (tmp_path / "scene.toml").write_text(br.presets.deep_groove_6205().to_toml())
    command = [sys.executable, "-c", LIMITED.format(limit=limit)]
    ended = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, check=False)
    assert ended.returncode == 2, ended.stderr
    assert ended.stderr.startswith("ballrace: out.parquet: cannot be written (")
    assert len(ended.stderr.splitlines()) == 1
    assert [p.name for p in tmp_path.iterdir()] == ["scene.toml"]


def test_the_command_writes_as_it_goes_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def kept(_self: br.Signals, _path: Path) -> None:
        raise AssertionError("the samples were kept")

    monkeypatch.setattr(br.Signals, "write_parquet", kept)
    (tmp_path / "scene.toml").write_text(br.presets.deep_groove_6205().to_toml())
    path = tmp_path / "out.parquet"
    assert main(["run", str(tmp_path / "scene.toml"), "-o", str(path), "--duration", "1e-3"]) == 0
    assert br.Signals.read_parquet(path).n_samples == 50


def test_a_long_record_is_not_refused_for_its_memory(tmp_path: Path) -> None:
    """Limit: of terabytes, of which a block is held."""
    run: dict[str, Any] = {"duration": 1e6, "fs": 1e6, "start": "rolling"}
    with pytest.raises(MemoryError, match="write its record to a file"):
        br.simulate(wide(0), **run)

    def stopped(_: float) -> None:
        raise StoppedError

    with pytest.raises(StoppedError):
        br.simulate(wide(0), **run, out=tmp_path / "record.parquet", progress=stopped)
    assert not list(tmp_path.iterdir())


WIDE = """
import sys
from dataclasses import replace
import ballrace as br
scene = br.presets.deep_groove_6205()
probes = {f"c{k}": br.scene.ContactsProbe() for k in range(60)}
scene = replace(scene, probes={**scene.probes, **probes})
"""

ENDLESS = (
    WIDE
    + """
from ballrace._results.file import Writer
take = Writer.take
def take_and_print(self, columns):
    take(self, columns)
    print("a block", flush=True)
Writer.take = take_and_print
br.simulate(scene, duration=100.0, settle=0.0, out="record.parquet")
"""
)


@pytest.mark.skipif(sys.platform == "win32", reason="Ctrl-C is sent in another way there")
def test_ctrl_c_leaves_nothing(tmp_path: Path) -> None:
    command = [sys.executable, "-c", ENDLESS]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=tmp_path
    ) as child:
        assert child.stdout is not None
        assert child.stderr is not None
        for _ in range(2):
            assert child.stdout.readline() == "a block\n"
        assert len(list(tmp_path.iterdir())) == 1
        child.send_signal(signal.SIGINT)
        # At most the block that is being written, and what stands in the pipe.
        assert child.stdout.read().count("a block") <= 2
        child.wait(timeout=10.0)
        assert "KeyboardInterrupt" in child.stderr.read()
    assert not list(tmp_path.iterdir())


JOINING = """
import signal, sys, threading, time, os
import numpy as np, polars as pl
from ballrace._results.file import Writer, writing
values = np.random.default_rng(0).normal(size=(20, 65536))
with writing("record.parquet") as writer:
    for k in range(40):
        writer.take({f"c{i}": column + k for i, column in enumerate(values)})
    threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
    writer.finish({})
    print("finished")
"""


@pytest.mark.skipif(sys.platform == "win32", reason="Ctrl-C is sent in another way there")
def test_ctrl_c_while_blocks_are_joined_leaves_nothing(tmp_path: Path) -> None:
    ended = subprocess.run(
        [sys.executable, "-c", JOINING], capture_output=True, text=True, cwd=tmp_path, check=False
    )
    assert ended.stdout == ""
    assert "KeyboardInterrupt" in ended.stderr
    assert not list(tmp_path.iterdir())


MEMORY = """
import resource, sys
from dataclasses import replace
import ballrace as br
S = br.scene
scene = br.presets.deep_groove_6205()
scene = replace(scene, rows=(replace(scene.rows[0], ball_count=3),), probes={{
    "outer": S.MotionProbe(body="outer"), "inner": S.MotionProbe(body="inner"),
    "ball": S.MotionProbe(body="row0.ball0"),
}})
out = br.simulate(
    scene, duration={duration}, fs={fs}, start="rolling", settle=0.0, {out}
)
columns = len(out)
print(out.n_samples * (columns + 1) * 8, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024)
"""


def taken(duration: float, fs: float, out: str, folder: Path) -> tuple[int, int]:
    """Return the size of a record and the peak memory of the process that made it [bytes]."""
    program = MEMORY.format(duration=duration, fs=fs, out=out)
    command = [sys.executable, "-W", "ignore", "-c", program]
    ended = subprocess.run(command, capture_output=True, text=True, cwd=folder, check=False)
    assert ended.returncode == 0, ended.stderr
    size, peak = ended.stdout.split()
    return int(size), int(peak)


@pytest.mark.skipif(sys.platform != "linux", reason="what a process took is given in other units")
def test_memory_does_not_grow_with_the_record(tmp_path: Path) -> None:
    """Limit: ten times the record takes far less than itself more; one that is kept takes itself."""
    out = 'out="record.parquet"'
    short, low = taken(2e-3, 1e8, out, tmp_path)
    long, high = taken(2e-2, 1e8, out, tmp_path)
    assert long > 5e8
    assert long > 9 * short
    assert high - low < 0.3 * (long - short), (short, low, long, high)


def test_a_record_is_kept_where_no_thread_can_be_started(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As under a limit of address space: 53 s of a run were lost to a thread that only listens to Ctrl-C."""
    path = tmp_path / "record.parquet"
    kept = br.simulate(br.presets.deep_groove_6205(), duration=2e-3)

    def none_left(_: object) -> None:
        raise RuntimeError("can't start new thread")

    monkeypatch.setattr("threading.Thread.start", none_left)
    br.simulate(br.presets.deep_groove_6205(), duration=2e-3, out=path)
    monkeypatch.undo()
    np.testing.assert_array_equal(br.read(path)["outer.ay"], kept["outer.ay"])
