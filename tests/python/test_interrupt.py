"""A run or a static solve lets other threads go on, reports how far it is, and stops at once when asked to."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

import ballrace as br

pytestmark = pytest.mark.serial

LONG = 100.0
"""Simulated time that takes far longer than any test [s]."""

PROGRAM = """
import ballrace as br

scene = br.presets.wheel_bearing()
started = []
def callback(share):
    if not started:
        print("running", flush=True)
        started.append(share)
br.simulate(scene, duration={long}, fs=1000.0, progress=callback)
"""


def interrupt(child: subprocess.Popen[str]) -> None:
    """Send Ctrl-C and wait for the end, which without it would come in minutes."""
    child.send_signal(signal.SIGINT)
    child.wait(timeout=10.0)


@pytest.mark.skipif(sys.platform == "win32", reason="Ctrl-C is sent in another way there")
def test_ctrl_c_stops_a_run() -> None:
    command = [sys.executable, "-c", PROGRAM.format(long=LONG)]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as child:
        assert child.stdout is not None
        assert child.stderr is not None
        assert child.stdout.readline() == "running\n"
        interrupt(child)
        assert "KeyboardInterrupt" in child.stderr.read()
        assert child.returncode != 0


@pytest.mark.skipif(sys.platform == "win32", reason="Ctrl-C is sent in another way there")
def test_ctrl_c_stops_the_command_and_leaves_nothing(tmp_path: Path) -> None:
    (tmp_path / "scene.toml").write_text(br.presets.wheel_bearing().to_toml())
    options = ["--duration", str(LONG), "--fs", "1000", "-o", "out.parquet"]
    command = [sys.executable, "-m", "ballrace", "run", "scene.toml", *options]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True, cwd=tmp_path) as child:
        assert child.stderr is not None
        # Beside other work the imports alone take two seconds.
        time.sleep(5.0)
        assert child.poll() is None
        interrupt(child)
        assert child.stderr.read() == "ballrace: interrupted\n"
        assert child.returncode == 130
    assert [p.name for p in tmp_path.iterdir()] == ["scene.toml"]


@pytest.mark.skipif(sys.platform == "win32", reason="Ctrl-C is sent in another way there")
def test_a_second_ctrl_c_keeps_the_status(tmp_path: Path) -> None:
    """It comes while Python is at its end, where it would end the process itself: some 50 ms, hit every time."""
    (tmp_path / "scene.toml").write_text(br.presets.wheel_bearing().to_toml())
    options = ["--duration", str(LONG), "--fs", "1000", "-o", "out.parquet"]
    program = (
        "import runpy, ballrace.cli; print('running', flush=True)\n"
        "runpy.run_module('ballrace', run_name='__main__')"
    )
    command = [sys.executable, "-W", "ignore", "-c", program, "run", "scene.toml", *options]
    for _ in range(3):
        with subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=tmp_path
        ) as child:
            assert child.stdout is not None
            assert child.stderr is not None
            assert child.stdout.readline() == "running\n"
            time.sleep(1.0)
            child.send_signal(signal.SIGINT)
            assert child.stderr.readline() == "ballrace: interrupted\n"
            child.send_signal(signal.SIGINT)
            assert (child.wait(timeout=10.0), child.stderr.read()) == (130, "")


def test_other_threads_go_on(wheel: br.Scene) -> None:
    ended = threading.Event()
    counts = [0]

    def count() -> None:
        while not ended.is_set():
            counts[0] += 1
            time.sleep(1e-3)

    def stop(share: float) -> None:
        seen.append(share)
        if time.monotonic() - began > 0.5:
            raise TimeoutError

    seen: list[float] = []
    thread = threading.Thread(target=count)
    thread.start()
    began = time.monotonic()
    try:
        with pytest.raises(TimeoutError):
            br.simulate(wheel, duration=LONG, fs=1000.0, start="rolling", progress=stop)
        meanwhile = counts[0]
    finally:
        ended.set()
        thread.join()
    assert meanwhile > 20
    assert seen == sorted(seen)
    assert all(0.0 <= share <= 1.0 for share in seen)


def test_the_callback_is_called_at_the_end(wheel: br.Scene) -> None:
    seen: list[float] = []
    br.simulate(wheel, duration=1e-3, start="rolling", progress=seen.append)
    assert seen[-1] == 1.0


HUGE = """
from dataclasses import replace
import ballrace as br
scene = br.presets.deep_groove_6205(radial_load=5e3, axial_load=1e3, speed_rpm=1800.0)
row = scene.rows[0]
rows = tuple(
    replace(row, axial_position=0.03 * k, side=1 - 2 * (k % 2)) for k in range(16)
)
rings = {{
    "outer_ring": replace(scene.outer_ring, width=0.6),
    "inner_ring": replace(scene.inner_ring, width=0.6),
}}
scene = replace(scene, rows=rows, **rings, contact=replace(scene.contact, slices=br.scene.FixedSlices({slices})))
print("running", flush=True)
{call}
"""
"""A scene whose static solve takes minutes."""

TABLE = """
import tempfile
from dataclasses import replace
import numpy as np
import ballrace as br
x = np.random.default_rng(0).normal(size=4_000_037)
times = tuple(i * 1e-6 for i in range(1_000_000))
speed = br.scene.Table(times=times, values=tuple(100.0 + 1e-3 * (i % 7) for i in range(len(times))))
scene = replace(br.presets.deep_groove_6205(), drive=br.scene.SpeedDrive(speed))
print("running", flush=True)
{call}
"""
"""A table of a million speeds, and a signal whose length is a prime: transforms take their time."""

CAMPAIGN = "br.campaign({{'loads.radial.force': [1e3, 2e3]}}, {folder}, scene=scene, duration=0.1, {options})"
HERE = "__import__('tempfile').mkdtemp()"

CALLS = {
    "equilibrium": (HUGE, "br.equilibrium(scene)"),
    "stiffness": (HUGE, "br.stiffness(scene)"),
    "load_distribution": (HUGE, "br.load_distribution(scene, positions=8)"),
    "explain": (HUGE, "br.explain(scene)"),
    "start": (HUGE, 'br.Model(scene).start("equilibrium")'),
    "simulate": (HUGE, "br.simulate(scene, duration=0.1, fs=1000.0)"),
    "simulate from rolling": (HUGE, "br.simulate(scene, duration=0.1, start='rolling')"),
    "campaign, one thread": (
        HUGE, CAMPAIGN.format(folder=HERE, options="progress=False, threads=1")
    ),
    "campaign, threads": (HUGE, CAMPAIGN.format(folder=HERE, options="progress=False, threads=2")),
    "dry run": (HUGE, CAMPAIGN.format(folder=HERE, options="dry_run=True")),
    "model": (TABLE, "for _ in range(10_000): br.Model(scene)"),
    "replace": (TABLE, "for _ in range(10_000): scene.replace({'rows[0].clearance': 1e-5})"),
    "plan": (
        TABLE,
        "br.campaign({'rows[0].clearance': [1e-6 * i for i in range(1000)]}, tempfile.mkdtemp(), scene=scene)",
    ),
    "grid": (TABLE, "for _ in range(1000): br.grid({'a': range(2000), 'b': range(2000)})"),
    "envelope": (TABLE, "br.spectra.envelope_spectrum(x, 50e3)"),
    "line": (TABLE, "br.spectra.line(x=x, fs=50e3, near=100.0, width=5.0)"),
}  # fmt: skip
"""Calls that take longer than half a second, by the program they stand in."""

LARGE = """
import tempfile
import ballrace as br
from ballrace._io.parquet import _MARK
file = tempfile.NamedTemporaryFile()
file.seek(8 << 30)
file.write(_MARK + bytes(16) + bytes(4) + b"PAR1")
file.flush()
print("running", flush=True)
{call}
"""
"""A file of gigabytes with a hash, which takes no room on the disk."""

CALLS |= {
    "read_parquet": (LARGE, "br.Signals.read_parquet(file.name)"),
    "scan_parquet": (LARGE, "br.Signals.scan_parquet(file.name)"),
}

WRITE = """
import sys
import numpy as np
import ballrace as br
out = br.simulate(br.presets.deep_groove_6205(), duration=1e-3)
out._t = np.random.default_rng(0).normal(size=2_000_000)
out._columns = dict.fromkeys(out, out._t)
sys.excepthook = lambda kind, error, trace: print(kind.__name__, repr(error.__context__))
print("running", flush=True)
for _ in range(1000):
    {call}
"""
"""Polars at work: it notices Ctrl-C by itself, and so does Python."""

TIMED = """
import sys, time
def on_exception(kind, error, trace):
    print(kind.__name__, time.monotonic(), flush=True)
sys.excepthook = on_exception
"""
"""Prints when an exception comes out of a program, which may take its time to end thereafter."""


def ended_after(program: str) -> float:
    """Start a program, send Ctrl-C while it runs, and return how long it took to end [s]."""
    with subprocess.Popen(
        [sys.executable, "-c", TIMED + program],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    ) as child:  # fmt: skip
        assert child.stdout is not None
        assert child.stderr is not None
        assert child.stdout.readline() == "running\n", child.stderr.read()
        time.sleep(0.5)
        assert child.poll() is None, child.stderr.read()
        sent = time.monotonic()
        interrupt(child)
        printed = child.stdout.read().split()
        assert printed[:1] == ["KeyboardInterrupt"], (printed, child.stderr.read())
        return float(printed[1]) - sent


@pytest.mark.skipif(sys.platform == "win32", reason="Ctrl-C is sent in another way there")
@pytest.mark.parametrize("name", CALLS)
def test_ctrl_c_is_answered_within_half_a_second(name: str) -> None:
    program, call = CALLS[name]
    # Of several tries the fastest, and the longer the more processes wait for each core.
    limit = 0.5 * max(1.0, os.getloadavg()[0] / (os.cpu_count() or 1))
    tries = (ended_after(program.format(slices=100_000, call=call)) for _ in range(3))
    assert any(seconds < limit for seconds in tries)


@pytest.mark.skipif(sys.platform == "win32", reason="Ctrl-C is sent in another way there")
def test_ctrl_c_is_answered_once(tmp_path: Path) -> None:
    call = f"out.write_parquet({str(tmp_path / 'out.parquet')!r})"
    with subprocess.Popen(
        [sys.executable, "-c", WRITE.format(call=call)],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    ) as child:  # fmt: skip
        assert child.stdout is not None
        assert child.stdout.readline() == "running\n"
        time.sleep(0.5)
        child.send_signal(signal.SIGINT)
        assert child.stdout.read() == "KeyboardInterrupt None\n"


POOL = """
import multiprocessing
from concurrent.futures import ProcessPoolExecutor
import ballrace as br
if __name__ == "__main__":
    scene = br.presets.wheel_bearing()
    table = {{"loads.axial.force": [float(i) for i in range(20)]}}
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        pool.submit(abs, 1).result()
        print("running", flush=True)
        br.campaign(
            table, {folder!r}, scene=scene, duration={long}, progress=False, executor=pool
        )
"""


@pytest.mark.skipif(sys.platform == "win32", reason="Ctrl-C is sent in another way there")
def test_ctrl_c_stops_what_workers_have_taken(tmp_path: Path) -> None:
    """The pool waits for its workers, each with a case of hours and more in its queue."""
    program = tmp_path / "pool.py"
    program.write_text(POOL.format(folder=str(tmp_path / "runs"), long=LONG))
    with subprocess.Popen(
        [sys.executable, program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as child:
        assert child.stdout is not None
        assert child.stderr is not None
        assert child.stdout.readline() == "running\n", child.stderr.read()
        time.sleep(2.0)
        interrupt(child)
        assert "KeyboardInterrupt: interrupted; 0 of 20 cases are safe" in child.stderr.read()


@pytest.mark.skipif(sys.platform == "win32", reason="the program is that of the tests above")
def test_a_time_limit_ends_a_static_solve() -> None:
    call = "br.simulate(scene, duration=0.1, fs=1000.0, time_limit=0.3)"
    program = HUGE.format(slices=100_000, call=call)
    ended = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=60.0, check=False
    )
    assert "BudgetError: stopped at t = 0 s: time_limit = 0.3 is spent" in ended.stderr


def test_no_first_array_is_a_panic() -> None:
    """The bindings find numpy as the package is imported: Ctrl-C while they did so was a panic of theirs."""
    program = (
        "import sys, ballrace as br\n"
        "class Interrupted:\n"
        "    def __getattr__(self, name): raise KeyboardInterrupt\n"
        "for name in [name for name in sys.modules if name.startswith('numpy') and 'multiarray' in name]:\n"
        "    sys.modules[name] = Interrupted()\n"
        "scene = br.presets.deep_groove_6205()\n"
        "print(br.simulate(scene, duration=1e-3)['outer.ay'].size, br.Model(scene).start('rolling').ndim)"
    )
    command = [sys.executable, "-c", program]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=60.0, check=False)
    assert ended.stdout.split() == ["50", "1"], ended.stderr


def test_ctrl_c_while_numpy_is_found_is_ctrl_c() -> None:
    program = (
        "import sys, numpy\n"
        "class Interrupted:\n"
        "    def __getattr__(self, name): raise KeyboardInterrupt\n"
        "for name in [name for name in sys.modules if name.startswith('numpy') and 'multiarray' in name]:\n"
        "    sys.modules[name] = Interrupted()\n"
        "try:\n"
        "    import ballrace._base.arrays\n"
        "except KeyboardInterrupt:\n"
        "    print('interrupted')"
    )
    command = [sys.executable, "-c", program]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=60.0, check=False)
    assert ended.stdout == "interrupted\n", ended.stderr
