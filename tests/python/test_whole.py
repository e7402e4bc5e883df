"""Files are written whole or not at all: among several writers, planted links, kills, failures of the system."""

from __future__ import annotations

import os
import stat
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING

import numpy as np
import pytest

import ballrace as br
from ballrace._io.whole import whole
from faults import WRITING, failing

if TYPE_CHECKING:
    from pathlib import Path

posix = pytest.mark.skipif(os.name == "nt", reason="no modes, no locks of folders")


def write(path: Path, text: str) -> None:
    with whole(path) as temporary:
        temporary.write_text(text)


def test_of_several_writers_of_one_name_the_last_one_is_there_whole(tmp_path: Path) -> None:
    path = tmp_path / "out.txt"
    texts = [letter * 200_000 for letter in "abcd"]
    for _ in range(20):
        with ThreadPoolExecutor(len(texts)) as pool:
            list(pool.map(write, [path] * len(texts), texts))
        assert path.read_text() in texts
        assert list(tmp_path.iterdir()) == [path]


def test_temporary_names_cannot_be_guessed_or_entered(tmp_path: Path) -> None:
    path = tmp_path / "out.txt"
    seen = set()
    for _ in range(3):
        with whole(path) as temporary:
            seen.add(temporary.parent)
            assert temporary.parent.parent == tmp_path
            assert os.name == "nt" or stat.S_IMODE(temporary.parent.stat().st_mode) == 0o700
            temporary.write_text("x")
    assert len(seen) == 3


@posix
@pytest.mark.parametrize("mode", [0o600, 0o640, 0o444])
def test_a_file_keeps_its_mode(tmp_path: Path, mode: int) -> None:
    path = tmp_path / "out.txt"
    path.write_text("old")
    path.chmod(mode)
    write(path, "new")
    assert (path.read_text(), stat.S_IMODE(path.stat().st_mode)) == ("new", mode)


@posix
def test_a_new_file_has_the_mode_of_any_new_file(tmp_path: Path) -> None:
    write(tmp_path / "ours", "x")
    (tmp_path / "plain").write_text("x")
    assert (tmp_path / "ours").stat().st_mode == (tmp_path / "plain").stat().st_mode


@posix
def test_what_killed_writers_left_is_removed_by_the_next_of_that_name(tmp_path: Path) -> None:
    program = (
        "import os, signal, sys; from ballrace._io.whole import whole\n"
        "with whole(sys.argv[1]) as temporary:\n"
        "    temporary.write_text('half'); temporary.with_name('part').write_text('x')\n"
        "    os.kill(os.getpid(), signal.SIGKILL)"
    )
    for name in ("out.txt", "other.txt"):
        subprocess.run([sys.executable, "-c", program, tmp_path / name], check=False)
    assert len(list(tmp_path.glob(".ballrace-*"))) == 2
    with whole(tmp_path / "out.txt") as temporary:
        write(tmp_path / "out.txt", "another's")  # which leaves those alone that are at work
        temporary.write_text("whole")
    assert (tmp_path / "out.txt").read_text() == "whole"
    (left,) = tmp_path.glob(".ballrace-*")
    assert [path.name for path in left.iterdir() if "other" in path.name] == ["other.txt"]


@posix
def test_nothing_is_removed_through_a_link(tmp_path: Path) -> None:
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "precious").write_text("x")
    with whole(tmp_path / "out.txt") as temporary:
        own = temporary.parent.name.rpartition("-")[0]
        temporary.write_text("x")
    (tmp_path / f"{own}-planted").symlink_to(tmp_path / "mine")
    write(tmp_path / "out.txt", "new")
    assert (tmp_path / "mine" / "precious").read_text() == "x"


@pytest.mark.parametrize("end", [".csv", ".parquet", ".wav"])
def test_any_failure_leaves_the_old_file_and_nothing_else(tmp_path: Path, end: str) -> None:
    """Every call that writes fails once, one after the other."""
    path = tmp_path / f"out{end}"
    path.write_text("old")
    record = br.Recording(columns={"x": np.array([1.0, 2.0])}, fs=10.0)
    fail_at = 0
    while True:
        fail_at += 1
        with failing(fail_at, WRITING, within=str(tmp_path)) as faults:
            try:
                record.write(path)
            except OSError:
                pass
            else:
                break
        assert faults.calls >= fail_at
        if path.read_bytes() == b"old":
            assert list(tmp_path.iterdir()) == [path], fail_at
        else:  # it failed to make the new name last
            assert br.read(path)["x"].tolist() == [1.0, 2.0]
    assert fail_at > 4
    assert br.read(path)["x"].tolist() == [1.0, 2.0]
    assert list(tmp_path.iterdir()) == [path]
