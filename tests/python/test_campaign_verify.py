"""What a campaign holds is known to the bit: its description, tables and shards; what is not its own is left."""

from __future__ import annotations

import errno
import hashlib
import json
import os
import shutil
from pathlib import Path
from typing import Any

import polars as pl
import pytest

import ballrace as br
from ballrace.campaigns import Progress
from ballrace.campaigns.description import NAMES
from ballrace.cli import main
from faults import READING, WRITING, failing
from sweeps import SCENE, run, same, table

links = pytest.mark.skipif(os.name == "nt", reason="links need rights there")


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> br.Campaign:
    out = tmp_path_factory.mktemp("whole") / "runs"
    return run(table(4), out, keep="signals")


@pytest.fixture
def folder(whole: br.Campaign, tmp_path: Path) -> Path:
    out = tmp_path / "runs"
    shutil.copytree(whole.folder, out)
    return out


def flip(path: Path, share: float) -> None:
    data = bytearray(path.read_bytes())
    data[int(share * len(data))] ^= 0x01
    path.write_bytes(data)


def called_again(folder: Path, **options: Any) -> tuple[br.Campaign, int]:
    """Run the campaign once more, and count the cases that ran."""
    seen: list[Progress] = []
    done = run(table(4), folder, keep="signals", progress=seen.append, **options)
    return done, seen[-1].done if seen else 0


def test_a_flipped_bit_of_a_description_never_gives_another_scene(
    whole: br.Campaign, folder: Path
) -> None:
    """Each byte of one copy: it is reported and mended from the other one, and nothing runs again."""
    path = folder / "campaign.json"
    text = path.read_bytes()
    scenes = whole._store.identity["scenes"]
    places = [i for i in range(len(text)) if chr(text[i]).isdigit()][::8]
    assert len(places) > 30
    for place in places:
        data = bytearray(text)
        data[place] ^= 0x01
        path.write_bytes(data)
        assert br.Campaign.open(folder)._store.identity["scenes"] == scenes
    with pytest.warns(br.CampaignWarning, match=r"campaign\.json: damaged, .*written anew"):
        done, ran = called_again(folder)
    assert (same(done, whole), ran, path.read_bytes()) == (True, 0, text)


@pytest.mark.parametrize("how", ["flipped", "cut", "gone"])
def test_results_outlive_the_description(whole: br.Campaign, folder: Path, how: str) -> None:
    for name in NAMES:
        match how:
            case "flipped":
                flip(folder / name, 0.5)
            case "cut":
                (folder / name).write_bytes(b"")
            case _:
                (folder / name).unlink()
    with pytest.raises(br.CampaignError, match=r"holds no campaign|run the campaign again"):
        br.Campaign.open(folder)
    with pytest.warns(br.CampaignWarning, match="finished cases keep their ids"):
        done, ran = called_again(folder)
    assert (same(done, whole), ran) == (True, 0)
    assert done.verify()["problem"].drop_nulls().is_empty()


def test_features_by_other_options_are_not_readmitted(folder: Path) -> None:
    """They do not change the ids of cases."""
    for name in NAMES:
        (folder / name).unlink()
    with pytest.warns(br.CampaignWarning, match="keep their ids"):
        done, ran = called_again(folder, skip=1e-3)
    assert ran == 4
    fresh = run(table(4), folder.with_name("fresh"), keep="signals", skip=1e-3)
    assert same(done, fresh)


def test_a_folder_of_an_older_version_is_taken_and_sealed(whole: br.Campaign, folder: Path) -> None:
    identity = json.loads((folder / "campaign.json").read_text())
    del identity["digest"]
    (folder / "campaign.json").write_text(json.dumps(identity))
    (folder / "campaign.copy.json").unlink()
    done, ran = called_again(folder)
    assert (same(done, whole), ran) == (True, 0)
    assert (folder / "campaign.copy.json").exists()


@pytest.mark.parametrize("share", [0.02, 0.5, 0.98])
def test_verifying_reads_every_file(folder: Path, share: float) -> None:
    """A flipped bit anywhere in any file is reported, of that file alone."""
    files = [p for p in folder.rglob("*") if p.is_file() and p.parent.name not in ("locks", "tmp")]
    assert len(files) == br.Campaign.open(folder).verify().height
    for path in files:
        data = path.read_bytes()
        flip(path, share)
        found = br.campaigns.verify(folder).drop_nulls("problem")
        assert found["file"].to_list() == [path.relative_to(folder).as_posix()], path
        path.write_bytes(data)
    (lost,) = (folder / "signals").iterdir()
    lost.unlink()
    (problem,) = br.campaigns.verify(folder).drop_nulls("problem").iter_rows()
    assert problem == (f"signals/{lost.name}", "missing")


def test_the_command_verifies(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["campaign", str(folder), "--verify"]) == 0
    assert "all 6 files are what was written" in capsys.readouterr().out
    flip(folder / "manifest.parquet", 0.5)
    assert main(["campaign", str(folder), "--verify"]) == 1
    printed = capsys.readouterr()
    assert "manifest.parquet: damaged" in printed.out
    assert "1 of 6 files are not what was written" in printed.err


def test_anyone_can_check_the_manifest(whole: br.Campaign) -> None:
    """With polars and Python alone, as the guide says."""
    path = whole.folder / "manifest.parquet"
    table = pl.read_parquet(path)
    digest = hashlib.sha256()
    for name in table.columns:
        digest.update(repr((name, table[name].to_list())).encode())
    assert digest.hexdigest() == pl.read_parquet_metadata(path)["ballrace.digest"]


@links
@pytest.mark.parametrize(
    "name", ["tmp", "results", "signals", "locks", "campaign.json", "cases.parquet"]
)
def test_nothing_is_followed_or_swept_through_a_link(folder: Path, name: str) -> None:
    moved = folder.with_name("elsewhere")
    (folder / name).rename(moved)
    if moved.is_dir():
        (moved / ("0" * 32)).write_text("precious")
    (folder / name).symlink_to(moved)
    with pytest.raises(br.CampaignError, match=rf"{name}: a link, and nothing .* is followed"):
        called_again(folder)
    assert not moved.is_dir() or (moved / ("0" * 32)).read_text() == "precious"


@links
@pytest.mark.parametrize("kind", ["results", "signals", "locks"])
def test_files_of_a_campaign_are_no_links(folder: Path, kind: str) -> None:
    (path, *_) = sorted((folder / kind).iterdir())
    moved = folder.with_name("elsewhere")
    path.rename(moved)
    path.symlink_to(moved)
    with pytest.raises(br.CampaignError, match=r"a link, and nothing .* is followed"):
        called_again(folder)


@pytest.mark.parametrize("number", [errno.EIO, errno.EMFILE, errno.EACCES])
def test_what_cannot_be_read_is_left_and_never_computed_again(
    whole: br.Campaign, folder: Path, number: int
) -> None:
    """Every call that reads a file of the folder fails once; afterwards all is there, and nothing runs."""
    before = {p: p.read_bytes() for p in folder.rglob("*") if p.is_file()}
    messages: list[str] = []
    for fail_at in range(1, 200):
        with failing(fail_at, READING, number, within=str(folder)) as faults:
            try:
                _, ran = called_again(folder)
            except (br.CampaignError, OSError) as error:
                messages.append(str(error))
            else:
                assert ran == 0
        if faults.calls < fail_at:
            break
    else:
        pytest.fail("there is no end to it")
    assert len(messages) > 5
    assert all(os.strerror(number) in text for text in messages)
    assert not list(folder.rglob("*.damaged"))
    unchanged = {p: p.read_bytes() for p in before if p.parent.name in ("results", "signals")}
    assert unchanged.items() <= before.items()
    done, ran = called_again(folder)
    assert (same(done, whole), ran) == (True, 0)


@pytest.mark.long
def test_any_failure_of_writing_loses_nothing_that_was_finished(
    whole: br.Campaign, tmp_path: Path
) -> None:
    """Every call that writes fails once, from an empty folder on; called again, the campaign is whole."""
    messages: list[str] = []
    for fail_at in range(1, 400):
        folder = tmp_path / str(fail_at)
        with failing(fail_at, WRITING, errno.ENOSPC, within=str(folder)) as faults:
            try:
                called_again(folder)
            except (br.CampaignError, OSError) as error:
                messages.append(str(error))
        if faults.calls < fail_at:
            break
        finished = 0
        if (folder / "campaign.json").exists() and (folder / "cases.parquet").exists():
            finished = int((br.Campaign.open(folder).manifest["status"] != "missing").sum())
        done, ran = called_again(folder)
        assert same(done, whole)
        assert ran == 4 - finished
    else:
        pytest.fail("there is no end to it")
    assert len(messages) > 10
    assert all(os.strerror(errno.ENOSPC) in text for text in messages)


def test_the_scene_of_a_case_is_that_of_the_description(whole: br.Campaign) -> None:
    case_id = whole.manifest.filter(status="ok")["case_id"][0]
    assert whole.scene(case_id).rows == SCENE.rows


def test_other_vector_instructions_are_reported(folder: Path) -> None:
    """A campaign that goes on on another machine mixes last bits."""
    (shard,) = (folder / "results").iterdir()
    rows = pl.read_parquet(shard).filter(pl.col("status") == "ok").head(1)
    store = br.Campaign.open(folder)._store
    shard.unlink()
    store.write("results", rows.with_columns(simd=pl.lit("another")))
    with pytest.warns(
        br.CampaignWarning, match=r"ran on the vector instructions .*another.* simd says"
    ):
        called_again(folder)
