"""Killed, interrupted, damaged, full, taken: nothing that has finished is lost, and each is reported clearly."""

from __future__ import annotations

import errno
import importlib.metadata
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import warnings
from pathlib import Path
from typing import IO

import polars as pl
import pytest

import ballrace as br
from ballrace.campaigns import Progress
from ballrace.campaigns.description import NAMES
from ballrace.campaigns.locks import hold
from ballrace.campaigns.work import Job, run_here
from sweeps import SCENE, comparable, finished, run, same, table

posix = pytest.mark.skipif(sys.platform == "win32", reason="signals are sent in another way there")

PROGRAM = """
import sys, time
sys.path.insert(0, {here!r})
import sweeps

def on_progress(progress):
    print(progress.done, time.time(), flush=True)

sweeps.run(sweeps.table({count}), {out!r}, duration={duration}, progress=on_progress, keep={keep!r})
"""


def start(
    out: Path, count: int, *, duration: float = 0.01, keep: str = "features"
) -> subprocess.Popen[str]:
    """Start a campaign in a process of its own, which prints cases done and the time of day."""
    program = PROGRAM.format(
        here=str(Path(__file__).parent), count=count, out=str(out), duration=duration, keep=keep
    )
    return subprocess.Popen(
        [sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )


def read_until(stream: IO[str] | None, count: int, seconds: float = 0.0) -> list[tuple[int, float]]:
    """Read what the campaign prints until so many cases are done, and so much time has passed since the first."""
    assert stream is not None
    seen: list[tuple[int, float]] = []
    while not seen or seen[-1][0] < count or seen[-1][1] < seen[0][1] + seconds:
        done, at = stream.readline().split()
        seen.append((int(done), float(at)))
    return seen


@posix
def test_kill_9_loses_no_more_than_is_in_flight(tmp_path: Path) -> None:
    """Killed three times on the way, it has the table of one that was not, bit for bit."""
    count = 90
    out = tmp_path / "killed"
    safe = []
    for after, seconds in ((5, 2.5), (7, 0.0), (3, 0.0)):
        before = _done(out) if out.exists() else 0
        with start(out, count, duration=50e-3, keep="signals") as child:
            seen = read_until(child.stdout, after, seconds)
            child.kill()
            killed = time.time()
        # The first shard is written after a second, and so are all that follow.
        safe.append(max((done for done, at in seen if at < killed - 1.5), default=0))
        assert _done(out) >= before + safe[-1]
    assert safe[0] > 0
    before = _done(out)
    assert before < count
    seen_now: list[Progress] = []
    done = run(table(count), out, duration=50e-3, keep="signals", progress=seen_now.append)
    assert (seen_now[-1].before, seen_now[-1].done) == (before, count - before)
    whole = run(table(count), tmp_path / "whole", duration=50e-3, keep="signals")
    assert same(done, whole)
    assert done.scan().collect().equals(whole.scan().collect())


def _done(out: Path) -> int:
    """Return the number of cases that have finished, failed ones included."""
    return br.Campaign.open(out).manifest.filter(pl.col("status") != "missing").height


@posix
def test_ctrl_c_stops_and_says_how_to_resume(tmp_path: Path) -> None:
    with start(tmp_path / "runs", 1000) as child:
        read_until(child.stdout, 10)
        child.send_signal(signal.SIGINT)
        assert child.stderr is not None
        printed = child.stderr.read()
    safe = re.search(
        r"KeyboardInterrupt: interrupted; (\d+) of 1000 cases are safe in .*; call again", printed
    )
    assert safe, printed
    count = (
        br.Campaign.open(tmp_path / "runs").manifest.filter(pl.col("status") != "missing").height
    )
    # What had finished when Ctrl-C came is written, and counted.
    assert count == int(safe[1])
    assert 10 <= count < 1000


@posix
def test_a_full_disk_keeps_what_there_is(tmp_path: Path) -> None:
    run(table(5), tmp_path, keep="signals")
    before = finished(tmp_path)
    program = f"""
import resource, sys
sys.path.insert(0, {str(Path(__file__).parent)!r})
import ballrace as br, sweeps
# No file may grow beyond 40 kB: as on a full disk, the write itself fails.
resource.setrlimit(resource.RLIMIT_FSIZE, (40_000, 40_000))
try:
    sweeps.run(sweeps.table(40), {str(tmp_path)!r}, keep="signals")
except br.CampaignError as error:
    print(error)
"""
    printed = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=60, check=True
    ).stdout
    assert re.search(
        r"cannot write to .*: File too large; 5 of 40 cases are safe in .*; call again", printed
    )
    assert finished(tmp_path) == before == 4
    assert not list((tmp_path / "tmp").iterdir())
    done = run(table(40), tmp_path, keep="signals")
    assert same(done, run(table(40), tmp_path.with_name("whole"), keep="signals"))


def test_no_space_left_is_reported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    run(table(5), tmp_path)

    def full(file: int) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patched:
        patched.setattr(os, "fsync", full)
        # The table of cases comes first, and is not half there either.
        with pytest.raises(br.CampaignError, match=r"cannot write to .*: No space left"):
            run(table(9), tmp_path)
    assert finished(tmp_path) == 4
    assert run(table(9), tmp_path).manifest.filter(status="ok").height == 8


def test_a_file_in_the_way_and_a_foreign_folder(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("mine")
    with pytest.raises(br.CampaignError, match="file: a file; give a folder"):
        run(table(2), tmp_path / "file")
    with pytest.raises(
        br.CampaignError, match="not a campaign's folder, it holds file; give a new"
    ):
        run(table(2), tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["file"]
    with pytest.raises(br.CampaignError, match="holds no campaign"):
        br.Campaign.open(tmp_path)


def test_a_read_only_folder(tmp_path: Path) -> None:
    run(table(3), tmp_path / "runs")
    for folder in (tmp_path / "runs", tmp_path / "runs" / "tmp"):
        folder.chmod(0o555)
    if os.access(tmp_path / "runs", os.W_OK):
        pytest.skip("nothing is read-only to this user")
    with pytest.raises(PermissionError, match="tmp"):
        run(table(5), tmp_path / "runs")
    assert finished(tmp_path / "runs") == 2


def test_a_read_only_file_system_is_reported(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run(table(3), tmp_path)

    def refuse(path: Path, *arguments: object, **options: object) -> None:
        raise PermissionError(30, "Read-only file system", str(path))

    monkeypatch.setattr(Path, "touch", refuse)
    with pytest.raises(PermissionError, match="Read-only file system"):
        run(table(5), tmp_path)


def test_another_campaign_is_not_mixed_in(tmp_path: Path) -> None:
    run(table(3), tmp_path)
    with pytest.raises(
        br.CampaignError, match=r"another campaign, run: duration is 0\.002 there and 0\.003"
    ):
        run(table(3), tmp_path, duration=0.003)
    with pytest.raises(br.CampaignError, match=r"features: skip is 0\.0 there and 0\.001 here"):
        run(table(3), tmp_path, skip=1e-3)
    with pytest.raises(br.CampaignError, match="scenes"):
        run(table(3), tmp_path, scene=SCENE.replace({"rows[0].clearance": 1e-6}))
    assert run(table(4), tmp_path).manifest.height == 4, "more rows are the same campaign"


@posix
def test_two_campaigns_in_one_folder(tmp_path: Path) -> None:
    with start(tmp_path / "runs", 1000) as child:
        read_until(child.stdout, 1)
        with pytest.raises(br.CampaignError, match=r"another campaign is running in .*; wait"):
            run(table(1000), tmp_path / "runs", duration=0.01)
        with pytest.raises(br.CampaignError, match="another campaign is running"):
            run(table(1000), tmp_path / "runs", duration=0.01, shard=(0, 2))
        child.kill()
    # The lock of a killed process is free.
    with hold(tmp_path / "runs" / "locks", 0, 1):
        pass


def test_shards_of_one_division_go_side_by_side(tmp_path: Path) -> None:
    with hold(tmp_path, 0, 3), hold(tmp_path, 2, 3):
        for part, parts in ((0, 1), (1, 2), (2, 3)):
            with (
                pytest.raises(br.CampaignError, match="is running in"),
                hold(tmp_path, part, parts),
            ):
                pass
    with hold(tmp_path, 0, 1):
        pass


@posix
def test_a_file_system_without_locks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import fcntl

    def refuse(file: int, operation: int) -> None:
        raise OSError(errno.ENOLCK, "No locks available")

    monkeypatch.setattr(fcntl, "flock", refuse)
    with pytest.warns(br.CampaignWarning, match="this file system has no locks"):
        run(table(2), tmp_path)


@pytest.mark.parametrize("damage", ["cut", "flipped"])
def test_a_damaged_shard_of_results(damage: str, tmp_path: Path) -> None:
    run(table(4), tmp_path)
    whole = run(table(6), tmp_path)
    shard = max((tmp_path / "results").iterdir(), key=lambda path: path.stat().st_mtime_ns)
    data = bytearray(shard.read_bytes())
    if damage == "cut":
        del data[len(data) // 2 :]
    else:
        data[100] ^= 1
    shard.write_bytes(data)
    with pytest.raises(
        br.CampaignError, match=rf"{shard.name}: damaged .*; run the campaign again"
    ):
        _ = br.Campaign.open(tmp_path).manifest
    seen: list[Progress] = []
    with pytest.warns(br.CampaignWarning, match=rf"damaged files are set aside.*: {shard.name}"):
        again = run(table(6), tmp_path, progress=seen.append)
    assert (seen[-1].before, seen[-1].done) == (4, 2)
    assert same(again, whole)
    assert shard.with_name(f"{shard.name}.damaged").read_bytes() == data


def test_a_damaged_or_lost_shard_of_signals(tmp_path: Path) -> None:
    whole = run(table(6), tmp_path, keep="signals")
    signals = whole.scan().collect()
    (shard,) = (tmp_path / "signals").iterdir()
    shard.write_bytes(shard.read_bytes()[:1000])
    with pytest.warns(br.CampaignWarning, match=rf"damaged files are set aside.*: {shard.name}"):
        again = run(table(6), tmp_path, keep="signals")
    assert same(again, whole)
    assert again.scan().collect().equals(signals)
    shard.unlink()
    with pytest.raises(br.CampaignError, match=rf"{shard.name}: damaged \(No such file"):
        br.Campaign.open(tmp_path).scan()
    again = run(table(6), tmp_path, keep="signals")
    assert same(again, whole)
    assert again.scan().collect().equals(signals)


def test_signals_after_features(tmp_path: Path) -> None:
    """What was run without its signals runs again for them, and is in the table once."""
    features = run(table(4), tmp_path)
    with pytest.raises(FileNotFoundError, match="no signals"):
        features.scan()
    both = run(table(4), tmp_path, keep="signals")
    assert same(features, both)
    assert both.scan().collect()["case_id"].n_unique() == 3


def test_a_case_that_ran_twice_is_there_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As when Dask hands a chunk out again whose first worker had written some of it."""
    whole = run(table(6), tmp_path, keep="signals")
    signals = whole.scan().collect()
    job = Job(threads=1, keep_signals=True, features=json.dumps({}), raise_errors=False)
    # Of two rows of a case the older version's counts: here the second.
    monkeypatch.setattr(importlib.metadata, "version", lambda name: "0.0.0")
    for row in (3, 1):
        case_id = whole.manifest["case_id"][row]
        scene = whole.scene(case_id).to_json()
        run_document = json.dumps(whole._store.identity["run"])
        document = (case_id, scene, run_document)
        run_here(whole._store, [document], job, lambda counts: None)
    again = br.Campaign.open(tmp_path)
    assert len(list((tmp_path / "results").iterdir())) == 3
    assert again.manifest["signals"].n_unique() == 4, "three shards, and none of the failed case"
    assert (
        comparable(again.manifest)
        .drop("version")
        .equals(comparable(whole.manifest).drop("version"), null_equal=True)
    )
    assert again.scan().collect().equals(signals)
    assert again.scan().collect()["case_id"].is_sorted()


def test_leftovers_disturb_nothing(tmp_path: Path) -> None:
    """Files that others leave in the folders (.nfs…, .DS_Store, half a download) are not read."""
    whole = run(table(4), tmp_path, keep="signals")
    for folder in ("results", "signals", "tmp", "locks"):
        for name in (".nfs0001", "leftover.parquet", "0123456789abcdef.parquet.part"):
            (tmp_path / folder / name).write_text("not Parquet")
    # As if killed between the signals and the rows that name them: an orphan.
    run(table(3), tmp_path / "other", keep="signals")
    (shard,) = (tmp_path / "other" / "signals").iterdir()
    shutil.copy(shard, tmp_path / "signals")
    shutil.rmtree(tmp_path / "other")
    again = run(table(5), tmp_path, keep="signals")
    assert again.scan().collect()["case_id"].n_unique() == 4
    assert comparable(again.manifest[:4]).equals(comparable(whole.manifest), null_equal=True)
    # Damaged it is set aside, though no case needs it: the folder is as it should be thereafter.
    orphan = tmp_path / "signals" / shard.name
    orphan.write_bytes(orphan.read_bytes()[:100])
    with pytest.warns(br.CampaignWarning, match=f"set aside.*: {shard.name}"):
        again = run(table(5), tmp_path, keep="signals")
    assert again.verify()["problem"].drop_nulls().is_empty()


def test_a_new_version_warns_or_refuses(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with monkeypatch.context() as patched:
        patched.setattr(importlib.metadata, "version", lambda name: "0.0.9")
        run(table(3), tmp_path)
    with pytest.warns(br.CampaignWarning, match=r"has cases of ballrace 0\.0\.9; this is"):
        done = run(table(5), tmp_path)
    assert done.manifest["version"].n_unique() == 2
    with pytest.raises(br.CampaignError, match=r"0\.0\.9.*give another folder"):
        run(table(5), tmp_path, resume="strict")
    with pytest.raises(br.CampaignError, match="holds 5 finished cases"):
        run(table(5), tmp_path, resume=False)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        run(table(3), tmp_path.with_name("new"), resume=False)


def test_names_come_from_hashes_only(tmp_path: Path) -> None:
    """A label with the path of something else names no file."""
    cases = [{"label": "../../evil", "loads.radial.force": 300.0}]
    run(cases, tmp_path / "runs", keep="signals", scene={"../up": SCENE})
    names = {
        path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*") if path.is_file()
    }
    locks = {"locks/0-of-1", "locks/description"}
    fixed = {*NAMES, "cases.parquet", "manifest.parquet", *locks}
    assert {
        name for name in names if not re.fullmatch(r"runs/(results|signals)/\w{32}\.parquet", name)
    } == {f"runs/{name}" for name in fixed}
