"""The same campaign on threads, spawned processes and a Dask cluster whose worker is killed: the same bits."""

from __future__ import annotations

import importlib
import json
import multiprocessing
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Callable
from concurrent.futures import Future, ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest

import ballrace as br
from ballrace.campaigns import Progress, executors, silence
from sweeps import SCENE, run, same, table

COUNT = 60
LONGER = 3e-3
"""Some 30 ms of work a case [s]."""


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> br.Campaign:
    """The campaign in this process, undisturbed."""
    out = tmp_path_factory.mktemp("whole") / "runs"
    return run(table(COUNT), out, duration=LONGER, keep="signals")


def spawning(workers: int) -> ProcessPoolExecutor:
    return ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context("spawn"))


def test_spawned_processes(whole: br.Campaign, tmp_path: Path) -> None:
    seen: list[Progress] = []
    with spawning(2) as pool:
        done = run(
            table(COUNT), tmp_path, duration=LONGER, keep="signals", executor=pool,
            threads=2, progress=seen.append,
        )  # fmt: skip
    assert same(done, whole)
    assert done.scan().collect().equals(whole.scan().collect())
    assert (seen[-1].done, seen[-1].failed) == (COUNT, 1)


def test_threads_of_another_executor(whole: br.Campaign, tmp_path: Path) -> None:
    with ThreadPoolExecutor(3) as pool:
        assert same(run(table(COUNT), tmp_path, duration=LONGER, executor=pool), whole)


@pytest.mark.filterwarnings("default")  # Dask's own, as it loses a worker
def test_a_dask_worker_is_killed(whole: br.Campaign, tmp_path: Path) -> None:
    distributed: Any = importlib.import_module("distributed")

    killed: list[int] = []
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0"
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        workers = list(client.run(os.getpid).values())

        def kill(progress: Progress) -> None:
            if not killed and progress.done >= 10:
                os.kill(workers[0], signal.SIGKILL)
                killed.append(workers[0])

        done = run(
            table(COUNT), tmp_path, duration=LONGER, keep="signals", executor=client, progress=kill
        )
        assert killed
        assert workers[0] not in client.run(os.getpid).values()
    assert same(done, whole)
    assert done.scan().collect().equals(whole.scan().collect())


@pytest.mark.skipif(sys.platform == "win32", reason="signals are sent in another way there")
def test_a_killed_process_breaks_the_pool_and_loses_nothing(
    whole: br.Campaign, tmp_path: Path
) -> None:
    with spawning(2) as pool:

        def kill(progress: Progress) -> None:
            if progress.done >= 10:
                for pid in list(pool._processes):
                    os.kill(pid, signal.SIGKILL)

        with pytest.raises(
            br.CampaignError, match=r"BrokenProcessPool.*cases are safe in"
        ) as caught:
            run(table(COUNT), tmp_path, duration=LONGER, executor=pool, progress=kill, retries=0)
    safe = br.Campaign.open(tmp_path).manifest["status"].ne("missing").sum()
    assert f"; {safe} of {COUNT} cases are safe" in str(caught.value)
    assert 10 <= safe < COUNT
    assert same(run(table(COUNT), tmp_path, duration=LONGER), whole)


@pytest.mark.skipif(sys.platform == "win32", reason="signals are sent in another way there")
def test_a_campaign_goes_on_in_a_new_pool(whole: br.Campaign, tmp_path: Path) -> None:
    seen: list[Progress] = []
    with spawning(2) as pool:

        def kill(progress: Progress) -> None:
            if progress.done >= 10 and not any(before.done >= 10 for before in seen):
                for pid in list(pool._processes):
                    os.kill(pid, signal.SIGKILL)
            seen.append(progress)

        with pytest.warns(br.CampaignWarning, match=r"BrokenProcessPool.* are tried again"):
            done = run(table(COUNT), tmp_path, duration=LONGER, executor=pool, progress=kill)
    assert same(done, whole)
    assert (seen[-1].done, seen[-1].failed) == (COUNT, 1)


def dies_at(load: float) -> None:
    """Have this process end as it comes to a case of that load; the initialiser of a worker."""
    worker: Any = executors
    run_here = worker.run_here

    def ending(store: Any, cases: Any, *args: Any) -> None:
        loads = [json.loads(case[1])["loads"]["radial"]["force"] for case in cases]
        run_here(store, cases[: loads.index(load)] if load in loads else cases, *args)
        if load in loads:
            os._exit(9)

    worker.run_here = ending


def test_a_case_that_ends_its_worker_becomes_a_failed_row(tmp_path: Path) -> None:
    """Found among others that run beside it, all of which end well, and not tried for ever."""
    seen: list[Progress] = []
    context = multiprocessing.get_context("spawn")
    with (
        ProcessPoolExecutor(2, context, initializer=dies_at, initargs=(500.0,)) as pool,
        pytest.warns(br.CampaignWarning, match="tried again"),
    ):
        done = run(table(12), tmp_path, executor=pool, progress=seen.append)
    (row,) = done.manifest.filter(error="CampaignError").iter_rows(named=True)
    assert row["loads.radial.force"] == 500.0
    assert "so it did whenever it ran this case" in row["message"]
    assert done.manifest["status"].to_list().count("ok") == 10
    assert (seen[-1].done, seen[-1].failed) == (12, 2)
    again: list[Progress] = []
    run(table(12), tmp_path, progress=again.append)
    assert not again or again[-1].done == 0, "it is known to fail"


def test_a_case_that_ends_its_worker_is_raised_if_asked_for(tmp_path: Path) -> None:
    context = multiprocessing.get_context("spawn")
    cases = table(6).tail(5)
    with (
        ProcessPoolExecutor(2, context, initializer=dies_at, initargs=(300.0,)) as pool,
        pytest.warns(br.CampaignWarning, match="tried again"),
        pytest.raises(br.CampaignError, match="whenever it ran this case"),
    ):
        run(cases, tmp_path, executor=pool, on_error="raise")
    assert run(cases, tmp_path).manifest["status"].to_list() == ["ok"] * 5


FORKED = """
import multiprocessing, sys
from concurrent.futures import ProcessPoolExecutor
sys.path.insert(0, {here!r})
import ballrace as br, sweeps

sweeps.run(sweeps.table(4), {out!r}, keep="signals", threads=2)  # threads of Rust and polars are up
with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("fork")) as pool:
    try:
        sweeps.run(sweeps.table(9), {out!r}, keep="signals", executor=pool)
    except br.CampaignError as error:
        print(error)
    scene = sweeps.SCENE.to_json()
    # A single run is not in danger: it has no threads but those of a pool of its process.
    run = br.Run(duration=1e-3, start="rolling", threads=2, settle=0.0).to_json()
    print(pool.submit(br._core.simulate, scene, run).result()["fs"])
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork")
def test_a_forked_child_is_refused(tmp_path: Path) -> None:
    program = FORKED.format(here=str(Path(__file__).parent), out=str(tmp_path / "runs"))
    command = [sys.executable, "-W", "ignore", "-c", program]
    printed = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True).stdout
    assert "this process was forked" in printed
    assert 'get_context("spawn")' in printed
    assert "4 of 9 cases are safe" in printed
    assert printed.endswith("\n50000.0\n")


def test_errors_of_workers_are_typed(tmp_path: Path) -> None:
    with ThreadPoolExecutor(1) as pool:
        options: dict[str, Any] = {"executor": pool, "on_error": "raise"}
        with pytest.raises(br.EquilibriumError, match="no equilibrium"):
            run(table(3), tmp_path, **options)
    with pytest.raises(TypeError, match="neither submit nor get_executor"):
        run(table(3), tmp_path, executor="cluster")


def test_workers_must_match(tmp_path: Path) -> None:
    store = run(table(3), tmp_path)._store
    job = {"threads": 1, "keep_signals": False, "features": "{}", "raise_errors": False}
    task = {"root": str(tmp_path), "key": store.key, "version": "0.0.9", "job": job, "cases": []}
    with pytest.raises(br.CampaignError, match=r"the campaign 0\.0\.9; install the same"):
        executors.run_task(json.dumps(task))
    task |= {"version": br.campaigns.work.version(), "key": "another"}
    with pytest.raises(br.CampaignError, match="not the same folder for this worker"):
        executors.run_task(json.dumps(task))
    task |= {"root": str(tmp_path / "nowhere")}
    with pytest.raises(br.CampaignError, match="holds no campaign"):
        executors.run_task(json.dumps(task))


class Recorder:
    """An executor that runs a task when it is waited for, and remembers how large it was."""

    _max_workers = 2

    def __init__(self) -> None:
        self.sizes: list[int] = []

    def submit(self, fn: Any, /, text: str) -> Future[str]:
        self.sizes.append(len(json.loads(text)["cases"]))
        future: Future[str] = Future()
        future.set_result(fn(text))
        return future


class Loser(Recorder):
    """An executor that loses its second task, and finds it again after a while [s]."""

    def __init__(self, after: float) -> None:
        super().__init__()
        self.after = after

    def submit(self, fn: Any, /, text: str) -> Future[str]:
        if len(self.sizes) != 1:
            return super().submit(fn, text)
        self.sizes.append(len(json.loads(text)["cases"]))
        lost: Future[str] = Future()

        def find() -> None:
            if not lost.cancelled():
                lost.set_result(fn(text))

        found = threading.Timer(self.after, find)
        found.daemon = True
        found.start()
        return lost


def test_a_task_that_is_lost_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It cannot be known from one that takes long: what is safe is said, and that the same call goes on."""
    monkeypatch.setattr(silence, "_FIRST", 0.3)
    monkeypatch.setattr(silence, "_SHARE", 0.0)
    monkeypatch.setattr(silence, "_LOOK", 0.0)
    with pytest.warns(br.CampaignWarning) as told:
        done = run(table(9), tmp_path, executor=Loser(after=3.0))
    assert done.manifest["status"].to_list().count("missing") == 0
    texts = [str(each.message) for each in told]
    assert (
        "with 1 tasks out: cases take as long, or it has lost tasks; 8 cases of this call"
        in texts[0]
    )
    assert f"are safe in {tmp_path}, and after Ctrl-C the same call goes on" in texts[0]
    # Again after twice as long each time.
    assert 2 <= len(texts) <= 5


def refuses() -> Future[str]:
    raise RuntimeError("no workers")


def cancelled() -> Future[str]:
    future: Future[str] = Future()
    future.cancel()
    future.set_running_or_notify_cancel()
    return future


@pytest.mark.parametrize(
    ("submitted", "message"),
    [
        (refuses, "the executor took no task: RuntimeError: no workers; 0 of 1 cases are safe"),
        (cancelled, "a worker failed: CancelledError"),
        (lambda: 5, "its submit returned a int, no Future"),
    ],
)
def test_an_executor_that_does_not_do_as_it_should_is_told(
    submitted: Callable[[], object], message: str, tmp_path: Path
) -> None:
    class Broken(Recorder):
        def submit(self, *_: object) -> Future[str]:
            return submitted()  # type: ignore[return-value]

    with pytest.raises(br.CampaignError, match=message):
        br.campaign(
            {"loads.radial.force": [500.0]}, tmp_path, scene=br.presets.deep_groove_6205(),
            duration=0.001, executor=Broken(),
        )  # fmt: skip


class Dask:
    """What is known of a Dask cluster whose workers may go, all at once and for good."""

    status = "running"

    def __init__(self) -> None:
        self._scheduler_identity: dict[str, Any] = {"n_workers": 2, "workers": {}}

    def desert(self) -> None:
        # As of versions before 2025.4, which list all workers.
        self._scheduler_identity = {"workers": {}}


class Deserted(Loser):
    def __init__(self) -> None:
        super().__init__(after=30.0)
        self._client = Dask()

    def submit(self, fn: Any, /, text: str) -> Future[str]:
        if self.sizes:
            self._client.desert()
        return super().submit(fn, text)


@pytest.mark.parametrize("retries", [0, 2])
def test_without_workers_dask_is_waited_for_within_bounds(
    retries: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its nannies give workers up that die too often, and then tasks wait for ever."""
    monkeypatch.setattr(silence, "_DESERTED", 0.5)
    monkeypatch.setattr(silence, "_LOOK", 0.0)
    limit = 0.5 * (1 + retries)
    text = rf"no worker for .* the limit is {limit:g} s with retries = {retries}; .*; [1-8] of 9 cases are safe"
    with pytest.raises(br.CampaignError, match=text):
        run(table(9), tmp_path, executor=Deserted(), retries=retries)


@pytest.mark.long
@pytest.mark.filterwarnings("default")  # Dask's own, as it loses workers
def test_a_dask_cluster_whose_workers_all_die(
    whole: br.Campaign, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    distributed: Any = importlib.import_module("distributed")
    monkeypatch.setattr(silence, "_DESERTED", 3.0)
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0"
        ) as cluster,
        distributed.Client(cluster) as client,
    ):

        def scale(progress: Progress) -> None:
            if progress.done >= 10:
                cluster.scale(0)

        with pytest.raises(br.CampaignError, match=r"Dask has had no worker .* cases are safe in"):
            run(table(2000), tmp_path, duration=LONGER, executor=client, progress=scale)
    assert same(run(table(COUNT), tmp_path, duration=LONGER), whole)


class Crowd(Recorder):
    """As many workers on this machine as leave each a few kilobytes."""

    _max_workers = 10**6


def test_workers_on_a_machine_share_its_memory(tmp_path: Path) -> None:
    table = {"loads.radial.force": [1e3, 2e3]}
    done = run(table, tmp_path, duration=LONGER, executor=Crowd())
    assert done.manifest["error"].to_list() == ["MemoryLimitError"] * 2
    assert "run fewer cases at once, which share the memory" in done.manifest["message"][0]


def test_tasks_of_dask_are_counted_by_machine() -> None:
    class Client:
        def nthreads(self) -> dict[str, int]:
            return {"tcp://10.0.0.1:4711": 3, "tcp://10.0.0.1:4712": 2, "tls://10.0.0.2:4711": 4}

    assert executors.tasks_on_a_machine(Client()) == 5
    assert executors.tasks_on_a_machine(Recorder()) == 2
    assert executors.tasks_on_a_machine(object()) == 1


def test_chunks_grow_with_what_is_known_and_shrink_at_the_end(tmp_path: Path) -> None:
    recorder = Recorder()
    run(table(100), tmp_path, duration=2e-4, start="rolling", executor=recorder, in_flight=4)
    assert sum(recorder.sizes) == 100
    assert recorder.sizes[:4] == [1, 1, 1, 1]
    assert recorder.sizes[4] == 24
    assert recorder.sizes[-1] == 1


def test_a_chunk_takes_some_twenty_seconds() -> None:
    assert executors._size(None, 1, 10**6, 4) == 1
    assert executors._size(1.0, 1, 10**6, 4) == 20
    assert executors._size(1.0, 4, 10**6, 4) == 80
    assert executors._size(90.0, 1, 10**6, 4) == 1
    assert executors._size(1e-4, 1, 10**6, 4) == 1000
    assert executors._size(1.0, 1, 10, 4) == 3


def test_scene_is_only_json(whole: br.Campaign) -> None:
    assert whole.scene(whole.manifest["case_id"][5]) == SCENE.replace({"loads.radial.force": 500.0})
