"""Cases, times in rounds, the front of error and cost, and tables."""

from __future__ import annotations

import csv
import importlib.metadata
import importlib.util
import math
import os
import platform
import shutil
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import ballrace as br

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    Array = NDArray[np.float64]


@dataclass
class Case:
    """One setting of one program; `run` returns seconds and a signal of shape (components, samples)."""

    peer: str
    setting: str
    run: Callable[[], tuple[float, Array]]
    truth: Array
    once: bool = False
    error: float = math.nan
    seconds: list[float] = field(default_factory=list)


@dataclass(frozen=True)
class Row:
    """One line of the result."""

    what: str
    setting: str
    unit: str
    median: float
    low: float
    high: float
    error: float = math.nan


def row(
    what: str, setting: str, unit: str, values: Iterable[float], error: float = math.nan
) -> Row:
    """Median and range of some values."""
    found = list(values)
    return Row(what, setting, unit, statistics.median(found), min(found), max(found), error)


def timed(work: Callable[[], Any]) -> tuple[float, Any]:
    """Seconds of the processor, and what the work gave."""
    begun = time.process_time()
    result = work()
    return time.process_time() - begun, result


def relative(signal: Array, truth: Array) -> float:
    """Relative L2 error; infinite for a run that broke off."""
    if signal.shape != truth.shape or not np.isfinite(signal).all():
        return math.inf
    return float(np.linalg.norm(signal - truth) / np.linalg.norm(truth))


def machine() -> str:
    """Processor, cores, versions."""
    bearing = br.presets.deep_groove_6205()
    ours = br.simulate(bearing, duration=1e-5, fs=1e6).provenance
    names = ["numpy", "numba", "scipy", "exudyn"]
    found = [f"{n} {importlib.metadata.version(n)}" for n in names if importlib.util.find_spec(n)]
    if shutil.which("octave-cli"):
        text = subprocess.run(
            ["octave-cli", "--version"], capture_output=True, text=True, check=True
        )
        found.append(text.stdout.splitlines()[0])
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        cpu = next(x.partition(":")[2].strip() for x in lines if x.startswith("model name"))
    except (OSError, StopIteration):
        cpu = platform.processor()
    load = f", load {os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else ""
    versions = ", ".join(
        [f"Python {platform.python_version()}", f"ballrace {ours['version']}", *found]
    )
    return f"{cpu}, {os.cpu_count()} cores{load}; SIMD {ours['simd']}; {versions}"


def alternate(cases: list[Case], rounds: int) -> None:
    """Run all cases in rounds."""
    for turn in range(rounds):
        for case in cases:
            if turn > 0 and case.once:
                continue
            seconds, signal = case.run()
            case.seconds.append(seconds)
            case.error = relative(signal, case.truth)
        print(f"  round {turn + 1} of {rounds}", file=sys.stderr)


def cost(cases: list[Case], turn: int, target: float) -> float:
    """Seconds at an error in one round, log-log between neighbours on the front; NaN where none comes so near."""
    points = sorted((c.seconds[turn], c.error) for c in cases)
    front: list[tuple[float, float]] = []
    for seconds, error in points:
        if not front or error < front[-1][1]:
            front.append((seconds, error))
    met = next((i for i, (_, error) in enumerate(front) if error <= target), None)
    if met is None:
        return math.nan
    (high, fine) = front[met]
    if met == 0 or fine == target or not math.isfinite(front[met - 1][1]):
        return high
    low, coarse = front[met - 1]
    share = math.log(coarse / target) / math.log(coarse / fine)
    return low * (high / low) ** share


def settings_of(cases: list[Case]) -> list[Row]:
    """All settings."""
    return [row(c.peer, c.setting, "ms", [1e3 * s for s in c.seconds], c.error) for c in cases]


def compare(cases: list[Case], ours: str, targets: Iterable[float]) -> list[Row]:
    """Cost of each program at each error it reaches, and its ratio to ours at the same error."""
    by_peer: dict[str, list[Case]] = {}
    for case in cases:
        by_peer.setdefault(case.peer, []).append(case)
    rows = []
    for target in targets:
        at = {
            peer: [cost(own, turn, target) for turn in range(len(own[0].seconds))]
            for peer, own in by_peer.items()
        }
        for peer, seconds in at.items():
            if not all(map(math.isfinite, seconds)):
                continue
            setting = f"at {100 * target:.2g} %"
            rows.append(row(peer, setting, "ms", [1e3 * s for s in seconds], target))
            if peer != ours and all(map(math.isfinite, at[ours])):
                ratios = [a / b for a, b in zip(seconds, at[ours], strict=False)]
                rows.append(row(f"{peer} ÷ {ours}", setting, "×", ratios, target))
    return rows


def show(title: str, rows: list[Row]) -> None:
    """Print a table."""
    print(f"\n## {title}\n\n| what | setting | error | median | range |\n|---|---|---|---|---|")
    for r in rows:
        error = "" if math.isnan(r.error) else f"{r.error:.1e}"
        print(
            f"| {r.what} | {r.setting} | {error} | {r.median:.3g} {r.unit} | {r.low:.3g} to {r.high:.3g} |"
        )


def write(folder: Path, sections: dict[str, list[Row]], about: str) -> None:
    """Write all tables to one file."""
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "peers.csv").open("w", newline="", encoding="utf-8") as file:
        file.write(f"# {about}\n")
        table = csv.writer(file)
        table.writerow(["section", "what", "setting", "unit", "median", "low", "high", "error"])
        for section, rows in sections.items():
            for r in rows:
                table.writerow(
                    [section, r.what, r.setting, r.unit, r.median, r.low, r.high, r.error]
                )
    print(f"\nwritten: {folder / 'peers.csv'}")
