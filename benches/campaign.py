"""Campaigns measured: cases a second against threads and processes, overhead, memory, and the map of the README.

    python benches/campaign.py threads      # on 1 and 2 (or --workers) threads and processes
    python benches/campaign.py overhead     # against bare runs of about a second
    python benches/campaign.py memory       # 10 000 short cases
    python benches/campaign.py map -o FOLDER --svg benches/campaign_map.svg   # 200 cases of 0.2 s

All but the map throw their folders away. The map goes on where it was stopped.
"""

from __future__ import annotations

import argparse
import multiprocessing
import resource
import statistics
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import ballrace as br

if TYPE_CHECKING:
    from collections.abc import Callable

LINE = "outer.ay.row0.bpfo_envelope"


def timed(cases: object, **options: Any) -> float:
    """Return the wall time of a campaign in a folder of its own [s]."""
    with tempfile.TemporaryDirectory() as folder:
        began = time.perf_counter()
        done = br.campaign(cases, folder, progress=False, **options)
        seconds = time.perf_counter() - began
        assert (done.manifest["status"] == "ok").all()
    return seconds


def threads(workers: int, repeats: int) -> None:
    """Compare in rounds, so that a load on the machine falls on all alike."""
    scene = br.presets.wheel_bearing(3000.0)
    cases = br.grid({"loads.axial.force": list(np.linspace(-3000.0, 3000.0, 24))})
    options: dict[str, Any] = {"scene": scene, "duration": 0.02}
    counts = [n for n in (1, 2, 4, 8, 16) if n <= workers]
    times: dict[str, list[float]] = {}
    spawn = multiprocessing.get_context("spawn")
    for _ in range(repeats):
        for n in counts:
            times.setdefault(f"{n} threads", []).append(timed(cases, threads=n, **options))
        for n in counts:
            with ProcessPoolExecutor(n, mp_context=spawn) as pool:
                list(pool.map(abs, range(4 * n)))  # they are up
                br.campaign(cases[:n], tempfile.mkdtemp(), executor=pool, progress=False, **options)
                seconds = timed(cases, executor=pool, **options)
            times.setdefault(f"{n} processes", []).append(seconds)
    for name, found in times.items():
        first = times[f"1 {name.split()[1]}"]
        ratio = statistics.median(a / b for a, b in zip(first, found, strict=True))
        rate = len(cases) / statistics.median(found)
        print(f"{name:>12}: {rate:6.2f} cases/s, {ratio:.2f} times one")


def overhead(repeats: int) -> None:
    """Compare a campaign on one thread with the same runs one after another, by the clock and by work done."""
    scene = br.presets.wheel_bearing(3000.0)
    forces = [0.0, 1000.0, 2000.0, 3000.0]
    cases = br.grid({"loads.axial.force": forces})
    duration = 0.1

    def runs() -> None:
        for force in forces:
            one = scene.replace({"loads.axial.force": force})
            br.simulate(one, duration=duration, threads=1)

    def both(work: Callable[[], object]) -> tuple[float, float]:
        began = time.perf_counter(), time.process_time()
        work()
        return time.perf_counter() - began[0], time.process_time() - began[1]

    kinds: dict[str, dict[str, Any]] = {
        "features": {},
        "and signals kept": {"keep": "signals"},
        "and contact loads": {"contact_loads": True},
    }
    found: dict[str, list[tuple[float, float]]] = {name: [] for name in kinds}
    for _ in range(repeats):
        bare = both(runs)
        for name, options in kinds.items():
            work = partial(timed, cases, scene=scene, duration=duration, threads=1, **options)
            wall, cpu = both(work)
            found[name].append((wall / bare[0] - 1.0, cpu / bare[1] - 1.0))
    print(f"a case takes {bare[0] / len(forces):.2f} s, {bare[1] / len(forces):.2f} s of a core")
    for name, pairs in found.items():
        wall, cpu = (100.0 * statistics.median(column) for column in zip(*pairs, strict=True))
        print(f"{name:>17}: {wall:+.1f} % by the clock, {cpu:+.1f} % of work")


def memory(count: int) -> None:
    """Watch the peak of the resident memory while short cases stream through."""
    scene = br.presets.deep_groove_6205()
    forces = np.linspace(100.0, 2000.0, count)
    seen: dict[int, float] = {}

    def on_progress(progress: Any) -> None:
        tenth = 10 * progress.done // progress.total
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
        seen.setdefault(tenth, peak)

    options: dict[str, Any] = {"start": "rolling", "duration": 2e-4, "columns": ["outer.ay"]}
    with tempfile.TemporaryDirectory() as folder:
        began = time.perf_counter()
        table = br.grid({"loads.radial.force": list(forces)})
        done = br.campaign(table, folder, scene=scene, progress=on_progress, **options)
        seconds = time.perf_counter() - began
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    assert (done.manifest["status"] == "ok").all()
    print(f"{count} cases, {count / seconds:.0f} cases/s; peak of resident memory [MiB]:")
    print("  " + ", ".join(f"{10 * k} % {value:.0f}" for k, value in sorted(seen.items())))
    print(f"  {peak:.0f} with the manifest")


def draw(folder: Path, svg: Path | None) -> None:
    """Run the map of the README, and draw it."""
    scene = br.presets.wheel_bearing()
    table = br.grid(
        {
            "loads.axial.force": [250.0 * i for i in range(-12, 13)],
            "defects.spall.width": [3e-4 * i for i in range(8)],
        }
    )
    began = time.perf_counter()
    done = br.campaign(table, folder, scene=scene, duration=0.2, skip=0.02, columns=["outer.ay"])
    manifest = done.manifest
    print(f"{manifest.height} cases in {time.perf_counter() - began:.0f} s; ", end="")
    print(
        f"{manifest['wall_time'].sum():.0f} s of one core, {manifest['nfev'].sum():,} evaluations"
    )
    if svg is not None:
        picture(manifest, svg)


def picture(manifest: Any, svg: Path) -> None:
    """Draw width × axial load → line at the passing frequency of the balls."""
    import matplotlib as mpl

    mpl.use("svg")
    mpl.rcParams["svg.hashsalt"] = "ballrace"
    from matplotlib import pyplot as plt

    grid = manifest.pivot("loads.axial.force", index="defects.spall.width", values=LINE)
    loads = [float(name) / 1e3 for name in grid.columns[1:]]
    widths = 1e3 * grid["defects.spall.width"].to_numpy()
    values = np.sqrt(grid.drop("defects.spall.width").to_numpy().astype(float))
    fig, axes = plt.subplots(figsize=(7.2, 3.6), layout="constrained")
    mesh = axes.pcolormesh(loads, widths, values, shading="nearest", cmap="viridis")
    fig.colorbar(mesh, label="√(envelope line at BPFO) [m/s²]")
    axes.set(
        xlabel="axial load [kN], towards the faulted row > 0", ylabel="width of the spall [mm]"
    )
    fig.savefig(svg, metadata={"Date": None})


def main() -> None:
    """Measure what was asked for."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("what", choices=("threads", "overhead", "memory", "map"))
    parser.add_argument("-o", "--output", type=Path, default=Path("campaign-map"))
    parser.add_argument("--svg", type=Path)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--count", type=int, default=10_000)
    options = parser.parse_args()
    match options.what:
        case "threads":
            threads(options.workers, options.repeats)
        case "overhead":
            overhead(options.repeats)
        case "memory":
            memory(options.count)
        case "map":
            draw(options.output, options.svg)


if __name__ == "__main__":
    main()
