"""A campaign among faults, for as long as one likes: ``python tests/soak.py [SECONDS] [--seed N]``.

Each round calls one campaign in a new folder several times, each time with another fault: processes killed,
interrupted once or twice, stopped for a while; workers of a pool killed or stopped; a full disk; two calls at
once; between calls bits flipped, files cut and files removed. Then it is called without a fault. It must end with
the bits of a campaign that nobody disturbed, every file must be what was written, and nothing may stand outside
its folder. What came of the faults is printed; the status is 1 after the first round that ends otherwise.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parent / "python"))

import ballrace as br
from sweeps import run, same, table

COUNT = 40
"""Cases of a campaign, the first of which has no equilibrium."""

DURATION = 3e-3
"""Simulated time of a case, some 30 ms of work [s]."""

PATIENCE = 1800.0
"""How long a call may take, also on a busy machine, before it counts as hanging [s]."""

ANSWERS = {
    "done", "CampaignError", "CampaignError: another", "KeyboardInterrupt", "SIGINT", "SIGKILL", "SIGTERM",
}  # fmt: skip
"""How a call may end among faults; anything else is a fault of ours."""


def campaign(folder: Path, **options: Any) -> br.Campaign:
    return run(table(COUNT), folder, duration=DURATION, keep="signals", **options)


# What a child does.


def work(folder: Path, how: dict[str, Any]) -> None:
    """Call the campaign here with the faults that come from within, and print how it ends."""
    if how.get("largest") and sys.platform != "win32":
        import resource

        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (how["largest"], how["largest"]))
    print("began", flush=True)
    try:
        if how.get("workers"):
            _in_a_pool(folder, how)
        else:
            campaign(folder, threads=how.get("threads", 2), shard=tuple(how.get("shard", (0, 1))))
    except br.CampaignError as error:
        held = "is running in" in str(error)
        print("CampaignError: another" if held else "CampaignError", error, sep="\n", flush=True)
    except KeyboardInterrupt:
        print("KeyboardInterrupt", flush=True)
    else:
        print("done", flush=True)


def _in_a_pool(folder: Path, how: dict[str, Any]) -> None:
    import multiprocessing
    from concurrent.futures import ProcessPoolExecutor

    draw = random.Random(how["seed"])
    left = [how["hits"]]

    def on_progress(progress: object) -> None:
        del progress
        # A pool that has broken is replaced by one that only the campaign knows.
        workers = [one.pid for one in multiprocessing.active_children() if one.pid]
        if left[0] and workers and draw.random() < 0.1:
            left[0] -= 1
            _hit(draw.choice(workers), how["workers"])

    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(2, mp_context=context) as pool:
        campaign(folder, executor=pool, retries=3, progress=on_progress)


def _hit(worker: int, how: str) -> None:
    with suppress(ProcessLookupError):
        if how == "kill":
            os.kill(worker, signal.SIGKILL)
            return
        os.kill(worker, signal.SIGSTOP)
        threading.Timer(0.5, _go_on, (worker,)).start()


def _go_on(worker: int) -> None:
    with suppress(ProcessLookupError):
        os.kill(worker, signal.SIGCONT)


# What disturbs it from outside.


class Calls:
    """Children that call the campaign in one folder, and how they ended."""

    def __init__(self, folder: Path, draw: random.Random) -> None:
        self.folder, self.draw = folder, draw
        self.ended: Counter[str] = Counter()

    @contextmanager
    def one(self, **how: Any) -> Iterator[subprocess.Popen[str]]:
        """Start a call, and take note of its end."""
        asked = ["--work", str(self.folder), json.dumps(how)]
        command = [sys.executable, "-W", "ignore", __file__, *asked]
        with subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        ) as child:
            assert child.stdout is not None
            assert child.stdout.readline() in ("began\n", ""), "no beginning"
            yield child
            try:
                printed, errors = child.communicate(timeout=PATIENCE)
            except subprocess.TimeoutExpired:
                child.kill()
                raise AssertionError(f"a call with {how} hangs") from None
        self._note(child.returncode, printed, errors, how)

    def _note(self, status: int, printed: str, errors: str, how: dict[str, Any]) -> None:
        said = printed.split("\n", 1)[0]
        ended = signal.Signals(-status).name if status < 0 else said
        assert ended in ANSWERS, f"a call with {how} ended with {status}:\n{printed}\n{errors}"
        self.ended[ended] += 1

    def after_a_while(self) -> None:
        """Wait until some cases may have finished."""
        time.sleep(self.draw.uniform(0.0, 1.5))


def killed(calls: Calls) -> None:
    with calls.one() as child:
        calls.after_a_while()
        child.kill()


def terminated(calls: Calls) -> None:
    with calls.one() as child:
        calls.after_a_while()
        child.terminate()


def interrupted(calls: Calls) -> None:
    with calls.one() as child:
        calls.after_a_while()
        child.send_signal(signal.SIGINT)


def interrupted_twice(calls: Calls) -> None:
    with calls.one() as child:
        calls.after_a_while()
        child.send_signal(signal.SIGINT)
        time.sleep(calls.draw.uniform(0.0, 0.05))
        child.send_signal(signal.SIGINT)


def stopped(calls: Calls) -> None:
    with calls.one() as child:
        calls.after_a_while()
        child.send_signal(signal.SIGSTOP)
        time.sleep(0.5)
        child.send_signal(signal.SIGCONT)


def workers_killed(calls: Calls) -> None:
    with calls.one(workers="kill", hits=3, seed=calls.draw.random()):
        pass


def workers_stopped(calls: Calls) -> None:
    with calls.one(workers="stop", hits=3, seed=calls.draw.random()):
        pass


def large_files_refused(calls: Calls) -> None:
    with calls.one(largest=calls.draw.randint(1000, 40_000)):
        pass


def disk_full(calls: Calls) -> None:
    """A file system of a size that the campaign outgrows, as far as one may be mounted; then it is made larger."""
    used = shutil.disk_usage(calls.folder.parent).used // 1024
    resized(calls.folder.parent, used + calls.draw.randint(16, 400))
    try:
        with calls.one():
            pass
    finally:
        resized(calls.folder.parent, ENOUGH)


def two_at_once(calls: Calls) -> None:
    with calls.one(), calls.one(threads=1):
        pass


def shards_at_once(calls: Calls) -> None:
    with calls.one(shard=(0, 2), threads=1), calls.one(shard=(1, 2), threads=1):
        pass


def flipped(calls: Calls) -> None:
    for path in some_files(calls):
        data = bytearray(path.read_bytes())
        if data:
            data[calls.draw.randrange(len(data))] ^= 1 << calls.draw.randrange(8)
            path.write_bytes(data)


def cut(calls: Calls) -> None:
    for path in some_files(calls):
        os.truncate(path, calls.draw.randint(0, path.stat().st_size))


def removed(calls: Calls) -> None:
    for path in some_files(calls):
        path.unlink()


def some_files(calls: Calls) -> list[Path]:
    there = sorted(path for path in calls.folder.rglob("*") if path.is_file())
    return calls.draw.sample(there, min(len(there), calls.draw.randint(1, 3)))


EVERYWHERE = (
    killed, terminated, interrupted, interrupted_twice, stopped, workers_killed, workers_stopped,
    large_files_refused, two_at_once, shards_at_once, flipped, cut, removed,
)  # fmt: skip

ENOUGH = 65_536
"""Size of a file system that holds the campaign with what is set aside of it [kB]."""


@contextmanager
def disk() -> Iterator[tuple[Path, bool]]:
    """Give a folder, and whether it is on a file system of its own, whose size can be set: root may mount one."""
    folder = Path(tempfile.mkdtemp(prefix="ballrace-soak-"))
    command = ["mount", "-t", "tmpfs", "-o", f"size={ENOUGH}k", "tmpfs", str(folder)]
    own = sys.platform == "linux" and os.geteuid() == 0 and _succeeds(command)
    try:
        yield folder, own
    finally:
        if own:
            subprocess.run(["umount", str(folder)], check=True)
        shutil.rmtree(folder)


def resized(folder: Path, size: int) -> None:
    """Set the size of a file system [kB]."""
    subprocess.run(["mount", "-o", f"remount,size={size}k", str(folder)], check=True)


def _succeeds(command: list[str]) -> bool:
    with suppress(OSError):
        return subprocess.run(command, capture_output=True, check=False).returncode == 0
    return False


# Rounds.


def soak(seconds: float, seed: int, rounds: int | None = None) -> tuple[Counter[str], Counter[str]]:
    """Run rounds for a time [s], or so many, and return how often each fault came, and how calls ended."""
    draw = random.Random(seed)
    faults: Counter[str] = Counter()
    ended: Counter[str] = Counter()
    until = time.monotonic() + seconds
    with tempfile.TemporaryDirectory() as undisturbed, disk() as (place, own):
        whole = campaign(Path(undisturbed) / "whole")
        signals = whole.scan().collect()
        kinds: list[Callable[[Calls], None]] = [*EVERYWHERE, *([disk_full] if own else [])]
        number = 0
        while time.monotonic() < until if rounds is None else number < rounds:
            calls = Calls(place / f"round{number}", draw)
            chosen = draw.sample(kinds, 4)
            print(f"round {number}:", ", ".join(each.__name__ for each in chosen), flush=True)
            for fault in chosen:
                faults[fault.__name__] += 1
                fault(calls)
            with calls.one():
                pass
            check(calls.folder, whole, signals)
            ended.update(calls.ended)
            shutil.rmtree(calls.folder)
            assert not list(place.iterdir()), list(place.iterdir())
            number += 1
    return faults, ended


def check(folder: Path, whole: br.Campaign, signals: Any) -> None:
    """Check that a campaign is the one that nobody disturbed."""
    done = br.Campaign.open(folder)
    assert same(done, whole), done
    assert done.scan().collect().equals(signals)
    problems = done.verify().drop_nulls("problem")
    assert problems.is_empty(), problems
    assert list((folder / "tmp").iterdir()) == []


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("seconds", type=float, nargs="?", default=60.0)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--rounds", type=int)
    parser.add_argument("--work", nargs=2, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.work is not None:
        work(Path(options.work[0]), json.loads(options.work[1]))
        return
    faults, ended = soak(options.seconds, options.seed, options.rounds)
    print(f"{faults.total()} faults:", ", ".join(f"{n} {name}" for name, n in faults.most_common()))
    print(f"{ended.total()} calls:", ", ".join(f"{n} {how}" for how, n in ended.most_common()))


if __name__ == "__main__":
    main()
