"""Damaged, crafted and contended folders: found out, reported, and mended by calling again."""

from __future__ import annotations

import contextlib
import errno
import io
import json
import multiprocessing
import os
import shutil
import stat
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import polars as pl
import pytest

import ballrace as br
from ballrace._io.whole import grab, lock
from ballrace.campaigns import Progress, disk
from ballrace.campaigns.store import Store
from sweeps import run, same, table


def flip(path: Path, place: int) -> None:
    """Change one bit of a file."""
    data = bytearray(path.read_bytes())
    data[place] ^= 0x40
    path.write_bytes(data)


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> br.Campaign:
    """A campaign with two shards of signals."""
    out = tmp_path_factory.mktemp("whole") / "runs"
    run(table(3), out, keep="signals")
    return run(table(6), out, keep="signals")


@pytest.mark.parametrize("part", [0, 1])
@pytest.mark.parametrize("share", [0.1, 0.3, 0.5, 0.7])
def test_bit_rot_in_signals(whole: br.Campaign, tmp_path: Path, part: int, share: float) -> None:
    """Any bit, of any shard: no reading gives it out, and calling again runs those cases and no others."""
    out = tmp_path / "runs"
    shutil.copytree(whole.folder, out)
    shard = sorted((out / "signals").iterdir())[part]
    flip(shard, int(share * shard.stat().st_size))
    opened = br.Campaign.open(out)
    hit = opened.manifest.filter(signals=shard.name)["case_id"].to_list()
    with pytest.raises(br.CampaignError, match=f"{shard.name}: damaged .*run the campaign again"):
        opened.scan()
    with pytest.raises(br.CampaignError, match=f"{shard.name}: damaged"):
        opened.signals(hit[0])
    seen: list[Progress] = []
    with pytest.warns(
        br.CampaignWarning, match=f"set aside, and their cases run again: {shard.name}"
    ):
        again = run(table(6), out, keep="signals", progress=seen.append)
    assert seen[-1].done == len(hit)
    assert same(again, whole)
    assert again.scan().collect().equals(whole.scan().collect())


def test_shards_of_another_grouping_replace_damaged_ones(
    whole: br.Campaign, tmp_path: Path
) -> None:
    """What runs again may come to stand in other shards: rows that name the damaged one do not count."""
    out = tmp_path / "runs"
    shutil.copytree(whole.folder, out)
    for shard in (out / "signals").iterdir():
        flip(shard, 1000)
    with pytest.warns(br.CampaignWarning, match="set aside"):
        again = run(table(6), out, keep="signals")
    assert again.scan().collect().equals(whole.scan().collect())
    assert br.Campaign.open(out).scan().collect().equals(whole.scan().collect())
    # Rows of the first time name what is no longer there, and no case needs it.
    assert again.verify()["problem"].drop_nulls().is_empty()


@pytest.mark.parametrize("damage", ["cut", "flipped", "empty", "foreign"])
def test_a_damaged_table_of_cases(whole: br.Campaign, tmp_path: Path, damage: str) -> None:
    out = tmp_path / "runs"
    shutil.copytree(whole.folder, out)
    path = out / "cases.parquet"
    data = path.read_bytes()
    if damage == "flipped":
        flip(path, 60)
    else:
        path.write_bytes({"cut": data[:500], "empty": b"", "foreign": b"text"}[damage])
    with pytest.raises(br.CampaignError, match=r"cases\.parquet: damaged .*run the campaign again"):
        br.Campaign.open(out)
    seen: list[Progress] = []
    assert same(run(table(6), out, keep="signals", progress=seen.append), whole)
    assert not seen, "nothing had to run again"
    assert same(br.Campaign.open(out), whole)


def test_unreadable_results_are_not_missing_cases(whole: br.Campaign, tmp_path: Path) -> None:
    out = tmp_path / "runs"
    shutil.copytree(whole.folder, out)
    shutil.rmtree(out / "results")
    (out / "results").write_text("in the way")
    with pytest.raises(br.CampaignError, match=r"results: cannot be read \(Not a directory\)"):
        _ = br.Campaign.open(out).manifest


def test_a_folder_that_cannot_be_synced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Some network file systems answer EINVAL for a folder; its names last there all the same."""
    sync = os.fsync
    codes = [errno.EINVAL]

    def refuse(file: int) -> None:
        if stat.S_ISDIR(os.fstat(file).st_mode):
            raise OSError(codes[0], os.strerror(codes[0]))
        sync(file)

    monkeypatch.setattr(os, "fsync", refuse)
    assert run(table(3), tmp_path / "runs").manifest["status"].to_list() == ["failed", "ok", "ok"]
    codes[0] = errno.EIO
    with pytest.raises(br.CampaignError, match="Input/output error"):
        run(table(3), tmp_path / "other")


def test_leftovers_of_killed_writes_are_removed(tmp_path: Path) -> None:
    run(table(2), tmp_path)
    left, written = (tmp_path / "tmp" / (32 * letter) for letter in "ab")
    left.write_bytes(b"half")
    with written.open("xb") as file:
        assert grab(file.fileno())
        run(table(2), tmp_path)
        assert not left.exists()
        assert written.exists(), "another process is writing it"
    run(table(2), tmp_path)
    assert not written.exists()


def test_a_file_swept_away_before_its_lock_is_made_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "tmp").mkdir()
    swept: list[Path] = []

    def sweep_first(file: int) -> None:
        if not swept:
            swept.extend((tmp_path / "tmp").iterdir())
            swept[0].unlink()
        lock(file)

    monkeypatch.setattr(disk, "lock", sweep_first)
    assert disk.put(tmp_path, "file", b"whole")
    assert swept
    assert (tmp_path / "file").read_bytes() == b"whole"


@pytest.mark.skipif(os.name == "nt", reason="nothing is swept there")
def test_a_file_that_is_just_swept_away_is_made_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The other process has its lock, but has not removed it yet."""
    (tmp_path / "tmp").mkdir()
    with contextlib.ExitStack() as sweeper:
        taken: list[Path] = []

        def take_first(file: int) -> None:
            if not taken:
                taken.extend((tmp_path / "tmp").iterdir())
                sweeping = sweeper.enter_context(taken[0].open("r+b"))
                assert grab(sweeping.fileno())
            try:
                lock(file)
            finally:
                sweeper.callback(taken[0].unlink, missing_ok=True)

        monkeypatch.setattr(disk, "lock", take_first)
        with disk._temporary(tmp_path / "tmp") as (path, file):
            assert path != taken[0]
            assert file.writable()


@pytest.mark.parametrize(
    "name", ["../../secret.parquet", "/etc/passwd", "..", "x" * 32 + ".parquet"]
)
def test_a_crafted_folder_opens_no_other_file(tmp_path: Path, name: str) -> None:
    done = run(table(2), tmp_path / "runs", keep="signals")
    case_id = done.manifest["case_id"][1]
    secret = pl.DataFrame({"case_id": [case_id], "t": [0.0], "secret": [42.0]})
    secret.write_parquet(tmp_path / "secret.parquet")
    rows = done._store.results().with_columns(signals=pl.lit(name), version=pl.lit("0"))
    done._store.write("results", rows)
    for path in (tmp_path / "runs" / "signals").iterdir():
        path.unlink()
    opened = br.Campaign.open(tmp_path / "runs")
    assert opened.manifest["signals"][1] == name
    for read in (opened.scan, lambda: opened.signals(case_id)):
        with pytest.raises(br.CampaignError, match="not written by ballrace"):
            read()


@pytest.mark.parametrize(
    "frame",
    [
        pl.DataFrame({"a": [1.0]}),
        pl.DataFrame({"case_id": [1], "status": ["ok"]}),
        pl.DataFrame({"case_id": ["a"], "status": ["ok"], "outer.ay.rms": ["loud"]}),
        None,
    ],
)
def test_crafted_results_are_reported(tmp_path: Path, frame: pl.DataFrame | None) -> None:
    """The hash is right, the rows are none."""
    done = run(table(2), tmp_path)
    if frame is None:
        name = f"{disk_hash(b'text')}.parquet"
        (tmp_path / "results" / name).write_bytes(b"text")
    else:
        name = done._store.write("results", frame)
    with pytest.raises(br.CampaignError, match=rf"{name}: damaged \("):
        _ = br.Campaign.open(tmp_path).manifest
    with pytest.warns(br.CampaignWarning, match="set aside"):
        assert same(run(table(2), tmp_path), done)


def disk_hash(data: bytes) -> str:
    import hashlib

    return hashlib.blake2b(data, digest_size=16).hexdigest()


def found(task: tuple[str, int, float]) -> list[str]:
    """Found the same folders as others do at the same time; returns what went wrong."""
    import time

    root, count, at = task
    wrong = []
    time.sleep(max(0.0, at - time.time()))
    for i in range(count):
        try:
            Store.prepare(Path(root) / str(i), {"run": {"duration": 1.0}})
        except Exception as error:  # noqa: BLE001 - whatever it is, the job would be lost
            wrong.append(f"{i}: {type(error).__name__}: {error}")
    return wrong


def test_jobs_that_start_together_all_live(tmp_path: Path) -> None:
    """Jobs of a batch array come to a folder that is not there yet, all at once."""
    import time

    jobs = 4
    with ProcessPoolExecutor(jobs, mp_context=multiprocessing.get_context("spawn")) as pool:
        list(pool.map(found, [(str(tmp_path / "warm"), 1, 0.0)] * jobs))
        tasks = [(str(tmp_path / "runs"), 150, time.time() + 0.2)] * jobs
        assert [wrong for job in pool.map(found, tasks) for wrong in job] == []
    store = Store.prepare(tmp_path / "runs" / "0", {"run": {"duration": 1.0}})
    assert list((store.root / "tmp").iterdir()) == []
    with pytest.raises(br.CampaignError, match=r"duration is 1\.0 there and 2\.0 here"):
        Store.prepare(tmp_path / "runs" / "0", {"run": {"duration": 2.0}})


def test_a_file_system_without_links(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*paths: Any) -> None:
        raise OSError(errno.EPERM, "Operation not permitted")

    monkeypatch.setattr(os, "link", refuse)
    assert run(table(2), tmp_path / "runs").manifest.height == 2


def test_shards_keep_to_one_table(tmp_path: Path) -> None:
    """A shard with another table does not replace the one that others work on; one with more rows does."""
    run(table(4), tmp_path, shard=(0, 2))
    other = br.grid({"loads.radial.force": [1000.0, 1100.0, 1200.0, 1300.0]})
    with pytest.raises(br.CampaignError, match="its table has 4 cases that this table lacks"):
        run(other, tmp_path, shard=(1, 2))
    assert br.Campaign.open(tmp_path).manifest["loads.radial.force"].to_list() == [
        0.0,
        100.0,
        200.0,
        300.0,
    ]
    run(table(6), tmp_path, shard=(1, 2))
    done = run(table(6), tmp_path, shard=(0, 2))
    assert same(done, run(table(6), tmp_path.with_name("whole")))


def test_a_folder_of_the_version_before(tmp_path: Path) -> None:
    """Rows without the newer columns, and a table without its hash, are read and gone on with."""
    whole = run(table(5), tmp_path / "whole")
    old = tmp_path / "old"
    run(table(3), old)
    cases = pl.read_parquet(old / "cases.parquet")
    cases.write_parquet(old / "cases.parquet")
    (shard,) = (old / "results").iterdir()
    newer = [
        "warnings",
        "acceleration_residual",
        "truncated_contacts",
        "simd",
        "budget",
        "budget_limit",
    ]
    buffer = io.BytesIO()
    pl.read_parquet(shard).drop(newer).write_parquet(buffer)
    shard.unlink()
    name = f"{disk_hash(buffer.getvalue())}.parquet"
    (old / "results" / name).write_bytes(buffer.getvalue())
    opened = br.Campaign.open(old).manifest
    assert opened["status"].to_list() == ["failed", "ok", "ok"]
    assert opened["simd"].to_list() == [None, None, None]
    seen: list[Progress] = []
    done = run(table(5), old, progress=seen.append)
    assert seen[-1].done == 2
    common = ["case_id", "status", "outer.ay.rms"]
    assert done.manifest.select(common).equals(whole.manifest.select(common))


def test_the_description_is_there_before_anything_else(tmp_path: Path) -> None:
    done = run(table(2), tmp_path)
    text = json.dumps({**done._store.identity, "format": 99})
    (tmp_path / "campaign.json").write_text(text)
    with pytest.raises(br.CampaignError, match="format 99"):
        run(table(2), tmp_path)
