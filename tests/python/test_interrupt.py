"""A run or a static solve lets other threads go on, tells how far it is, and stops at once when asked to."""

from __future__ import annotations

import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

import ballrace as br

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


def interrupt(child: subprocess.Popen[str]) -> float:
    """Send Ctrl-C and return the seconds until the end."""
    child.send_signal(signal.SIGINT)
    began = time.monotonic()
    child.wait(timeout=10.0)
    return time.monotonic() - began


@pytest.mark.skipif(sys.platform == "win32", reason="Ctrl-C is sent in another way there")
def test_ctrl_c_stops_a_run_within_a_second() -> None:
    command = [sys.executable, "-c", PROGRAM.format(long=LONG)]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as child:
        assert child.stdout is not None
        assert child.stderr is not None
        assert child.stdout.readline() == "running\n"
        assert interrupt(child) < 1.0
        assert "KeyboardInterrupt" in child.stderr.read()
        assert child.returncode != 0


@pytest.mark.skipif(sys.platform == "win32", reason="Ctrl-C is sent in another way there")
def test_ctrl_c_stops_the_command_and_leaves_nothing(tmp_path: Path) -> None:
    (tmp_path / "scene.toml").write_text(br.presets.wheel_bearing().to_toml())
    options = ["--duration", str(LONG), "--fs", "1000", "-o", "out.parquet"]
    command = [sys.executable, "-m", "ballrace", "run", "scene.toml", *options]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True, cwd=tmp_path) as child:
        assert child.stderr is not None
        time.sleep(2.0)
        assert child.poll() is None
        assert interrupt(child) < 1.0
        assert child.stderr.read() == "ballrace: interrupted\n"
        assert child.returncode == 130
    assert [p.name for p in tmp_path.iterdir()] == ["scene.toml"]


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


def test_the_callback_hears_the_end(wheel: br.Scene) -> None:
    seen: list[float] = []
    br.simulate(wheel, duration=1e-3, start="rolling", progress=seen.append)
    assert seen[-1] == 1.0


HUGE = """
from dataclasses import replace
import ballrace as br
from ballrace import _core
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

CALLS = {
    "equilibrium": "br.equilibrium(scene)",
    "stiffness": "br.stiffness(scene)",
    "load_distribution": "br.load_distribution(scene, positions=8)",
    "explain": "br.explain(scene)",
    "start": 'br.Model(scene).start("equilibrium")',
    "simulate": "br.simulate(scene, duration=0.1, fs=1000.0)",
}


@pytest.mark.skipif(sys.platform == "win32", reason="Ctrl-C is sent in another way there")
@pytest.mark.parametrize("name", CALLS)
def test_ctrl_c_stops_a_static_solve(name: str) -> None:
    program = HUGE.format(slices=100_000, call=CALLS[name])
    command = [sys.executable, "-c", program]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as child:
        assert child.stdout is not None
        assert child.stderr is not None
        assert child.stdout.readline() == "running\n"
        time.sleep(0.5)
        assert child.poll() is None, child.stderr.read()
        assert interrupt(child) < 2.0
        assert "KeyboardInterrupt" in child.stderr.read()


@pytest.mark.skipif(sys.platform == "win32", reason="the program is that of the tests above")
def test_a_time_limit_ends_a_static_solve() -> None:
    call = "br.simulate(scene, duration=0.1, fs=1000.0, time_limit=0.3)"
    program = HUGE.format(slices=100_000, call=call)
    ended = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=60.0, check=False
    )
    assert "BudgetError: stopped at t = 0 s: time_limit = 0.3 is spent" in ended.stderr
