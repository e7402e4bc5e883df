"""Failures around a run: clocks that jump, forks, threads, a folder that is removed, a scheduler that is lost."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import ballrace as br
from ballrace.campaigns import Progress
from sweeps import SCENE, finished, run, same, table

pytestmark = pytest.mark.serial

posix = pytest.mark.skipif(sys.platform == "win32", reason="signals are sent in another way there")
SHORT: dict[str, Any] = {"duration": 5e-4, "fs": 2e4, "start": "rolling", "settle": 0.0}


def jump(seconds: float) -> Callable[[], float]:
    """Return a clock that goes from one reading to the next by so much more."""
    real, past = time.time, [0.0]

    def read() -> float:
        past[0] += seconds
        return real() + past[0]

    return read


@pytest.mark.parametrize("seconds", [3600.0, -3600.0])
def test_a_clock_that_jumps_changes_nothing(
    seconds: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = run(table(4), tmp_path / "whole")
    with monkeypatch.context() as patched:
        patched.setattr(time, "time", jump(seconds))
        patched.setattr(time, "time_ns", lambda: int(1e9 * jump(seconds)()))
        run(table(2), tmp_path / "runs")
        # Files from the day after tomorrow, and from before there were files.
        for i, path in enumerate(sorted((tmp_path / "runs").rglob("*.parquet"))):
            os.utime(path, (time.time() + 2e5, time.time() + 2e5) if i % 2 else (0.0, 0.0))
        seen: list[Progress] = []
        done = run(table(4), tmp_path / "runs", progress=seen.append)
    assert seen[-1].before == 2
    assert same(done, whole)


def test_a_machine_that_slept_goes_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Some clocks that never go back count the sleep of a machine, others do not."""
    whole = run(table(4), tmp_path / "whole")
    real, slept = time.monotonic, [0.0]

    def woken(progress: Progress) -> None:
        slept[0] += 3600.0

    monkeypatch.setattr(time, "monotonic", lambda: real() + slept[0])
    assert same(run(table(4), tmp_path / "runs", progress=woken), whole)
    assert slept[0] > 0.0


FORK = """
import json, os, sys, warnings
import ballrace as br
warnings.simplefilter("ignore")  # Python's own, that a process with threads forks
scene = br.presets.deep_groove_6205()
def numbers():
    out = br.simulate(scene, duration=5e-4, fs=2e4, start="rolling", settle=0.0, threads=2)
    return [out["outer.ay"].tolist(), br.equilibrium(scene).outer_load.tolist(), br.stiffness(scene).axial]
before = numbers()
child = os.fork()
if child == 0:
    os._exit(0 if numbers() == before else 1)
_, status = os.waitpid(child, 0)
print(os.waitstatus_to_exitcode(status))
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork")
def test_a_forked_child_runs_as_its_parent() -> None:
    """Campaigns refuse to, since threads of polars do not survive a fork; runs and statics have none."""
    command = [sys.executable, "-c", FORK]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=60.0, check=True)
    assert ended.stdout.strip() == "0", ended.stderr


def test_eight_threads_get_what_one_gets(tmp_path: Path) -> None:
    loads = [200.0 * (1 + k) for k in range(8)]
    model = br.Model(SCENE)
    state = model.start("rolling")
    together = threading.Barrier(8)

    def everything(k: int) -> list[Any]:
        scene = SCENE.replace({"loads.radial.force": loads[k]})
        out = br.simulate(scene, threads=2, **SHORT)
        case = {"loads.radial.force": [loads[k]]}
        done = run(case, tmp_path / f"{threading.get_ident()}-{k}", duration=5e-4)
        return [
            out["outer.ay"], br.equilibrium(scene).outer_load, br.stiffness(scene).rings,
            br.spectra.spectrum(out["outer.ay"], 2e4)[1], model.rhs(0.0, state),
            done.manifest["outer.ay.rms"].to_numpy(),
        ]  # fmt: skip

    def at_once(k: int) -> list[Any]:
        together.wait()
        return everything(k)

    with ThreadPoolExecutor(8) as pool:
        found = list(pool.map(at_once, range(8)))
    for ours, alone in zip(found, map(everything, range(8)), strict=True):
        for a, b in zip(ours, alone, strict=True):
            np.testing.assert_array_equal(a, b)


def test_of_eight_threads_in_one_folder_one_runs(tmp_path: Path) -> None:
    together = threading.Barrier(8)

    def attempt(_: int) -> str:
        together.wait()
        try:
            return run(table(20), tmp_path / "runs", duration=5e-3).status()
        except br.CampaignError as error:
            return str(error)

    with ThreadPoolExecutor(8) as pool:
        outcomes = list(pool.map(attempt, range(8)))
    # Whoever came late, when the first had ended, found all done.
    refused = [text for text in outcomes if "another campaign is running in" in text]
    ran = [text for text in outcomes if "20 cases: 19 ok" in text]
    assert ran
    assert len(refused) + len(ran) == 8
    assert finished(tmp_path / "runs") == 19


TERMINATED = """
import sys
sys.path.insert(0, {here!r})
import sweeps
sweeps.run(sweeps.table(1000), {out!r}, duration=0.02, progress=lambda p: print(p.done, flush=True))
"""


@posix
def test_an_end_by_the_batch_system_is_as_a_kill(tmp_path: Path) -> None:
    """SIGTERM, as SLURM and Kubernetes send it before they kill."""
    out = tmp_path / "runs"
    program = TERMINATED.format(here=str(Path(__file__).parent), out=str(out))
    with subprocess.Popen(
        [sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as child:
        assert child.stdout is not None
        began = time.monotonic()
        # The first shard is a second old when it is written.
        while not (out / "results").exists() or not list((out / "results").glob("*.parquet")):
            assert child.poll() is None
            assert time.monotonic() - began < 60.0
            child.stdout.readline()
        child.send_signal(signal.SIGTERM)
        child.communicate(timeout=10.0)
    assert child.returncode == -signal.SIGTERM
    safe = finished(out)
    assert 0 < safe < 999
    seen: list[Progress] = []
    run(table(safe + 3), out, duration=0.02, progress=seen.append)
    assert seen[-1].before > 0


@posix
def test_a_folder_that_is_removed_ends_the_campaign(tmp_path: Path) -> None:
    out = tmp_path / "runs"

    def remove(progress: Progress) -> None:
        shutil.rmtree(out, ignore_errors=True)

    with pytest.raises(br.CampaignError, match=r"cannot .*No such file"):
        run(table(30), out, duration=5e-3, progress=remove)
    assert same(run(table(4), out), run(table(4), tmp_path / "whole"))


def started(name: str, folder: Path, *options: str) -> subprocess.Popen[bytes]:
    """Start a scheduler or a worker of Dask."""
    command = [sys.executable, "-m", f"distributed.cli.dask_{name}"]
    command += ["--scheduler-file", str(folder / "scheduler.json"), "--no-dashboard", *options]
    quiet: dict[str, Any] = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    return subprocess.Popen(command, **quiet)


@posix
@pytest.mark.filterwarnings("default")  # Dask's own, as it loses its scheduler
def test_a_dask_scheduler_is_killed(tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    scheduler = started("scheduler", tmp_path, "--host", "127.0.0.1", "--port", "0")
    worker = started("worker", tmp_path, "--nthreads", "1", "--no-nanny", "--death-timeout", "60")
    try:
        with distributed.Client(
            scheduler_file=str(tmp_path / "scheduler.json"), timeout=60
        ) as client:

            def kill(progress: Progress) -> None:
                if progress.done >= 3:
                    scheduler.kill()

            with pytest.raises(br.CampaignError, match="Dask's scheduler was lost") as caught:
                run(table(300), tmp_path / "runs", duration=5e-3, executor=client, progress=kill)
    finally:
        for process in (scheduler, worker):
            process.kill()
            process.wait()
    safe = re.search(r"; (\d+) of 300 cases are safe in .*; call again", str(caught.value))
    assert safe is not None, caught.value
    # The worker may have gone on for a while.
    assert (
        3
        <= int(safe[1])
        <= br.Campaign.open(tmp_path / "runs").manifest["status"].ne("missing").sum()
    )
    whole = run(table(9), tmp_path / "whole", duration=5e-3)
    assert same(run(table(9), tmp_path / "runs", duration=5e-3), whole)


def test_a_page_and_a_file_are_there_whole_or_not_at_all(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A disk that fills as a report or a table is written: what was there before, stays."""
    out = br.simulate(SCENE, **SHORT)
    writers: list[tuple[str, Callable[[Path], object]]] = [
        ("run.csv", out.write), ("run.parquet", out.write), ("page.html", out.report),
    ]  # fmt: skip
    for name, write in writers:
        path = tmp_path / name
        path.write_text("before")

        def full(file: int) -> None:
            raise OSError(28, "No space left on device")

        with monkeypatch.context() as patched:
            patched.setattr(os, "fsync", full)
            patched.setattr(Path, "replace", lambda *_: full(0))
            with pytest.raises(OSError, match="No space left"):
                write(path)
        assert path.read_text() == "before"
        assert [p.name for p in tmp_path.iterdir() if p.name == name] == [name]
