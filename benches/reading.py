"""How long it takes to read records, beside pandas, polars and scipy; and what the child process costs.

python benches/reading.py [--rows N] [--hour]

Each figure is the median of several rounds, in which all programs take turns; the ratios are to pandas, or to the
library that reads the format, in wall time, and in processor time, which other work on the machine disturbs less.
``--hour`` reads an hour at 51.2 kHz as text and as MAT, with the memory it takes.
"""

from __future__ import annotations

import argparse
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
import polars as pl
from scipy.io import loadmat, savemat

import ballrace as br
from ballrace.recordings import apart

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

FS = 25_600.0
ROUNDS = 7


def texts(folder: Path, rows: int) -> Iterator[tuple[str, Path, dict[str, object], float | None]]:
    """Write tables as loggers do; yield what each is, its file, how pandas has to be told, and its rate."""
    rng = np.random.default_rng(1)
    t, a, b = np.arange(rows) / FS, rng.normal(size=rows), rng.normal(size=rows)
    kinds: dict[str, tuple[str, str, int, dict[str, object]]] = {
        "CSV: times, two signals": (",", ".", 3, {}),
        "decimal commas, semicolons": (";", ",", 3, {"sep": ";", "decimal": ","}),
        "one column": (",", ".", 1, {}),
        "blanks": ("  ", ".", 3, {"sep": r"\s+"}),
    }
    for name, (separator, mark, columns, told) in kinds.items():
        path = folder / f"{name.split(':')[0]}.csv"
        # pandas is given names without blanks.
        titles = ["t[s]", "a[g]", "b[g]"] if columns == 3 else ["a[g]"]
        parts = [
            pl.Series(x).round(9 if title == "t[s]" else 6).cast(pl.String).str.replace(".", mark, literal=True)
            for title, x in zip(titles, (t, a, b) if columns == 3 else (a,), strict=True)
        ]  # fmt: skip
        lines = pl.select(pl.concat_str(parts, separator=separator)).to_series().to_list()
        path.write_text("\n".join([separator.join(titles), *lines]) + "\n")
        yield name, path, told, None if columns == 3 else FS


def medians(calls: dict[str, Callable[[], object]]) -> dict[str, tuple[float, float]]:
    """Return the median wall and processor time of each in this process, which take turns [s]."""
    taken: dict[str, list[tuple[float, float]]] = {name: [] for name in calls}
    for call in calls.values():
        call()
    for _ in range(ROUNDS):
        for name, call in calls.items():
            began = time.perf_counter(), time.process_time()
            call()
            ended = time.perf_counter(), time.process_time()
            taken[name].append((ended[0] - began[0], ended[1] - began[1]))
    return {
        name: (
            statistics.median(wall for wall, _ in times),
            statistics.median(own for _, own in times),
        )
        for name, times in taken.items()
    }


def row(name: str, size: float, found: dict[str, tuple[float, float]], beside: str) -> str:
    """Return a line of the table."""
    wall, own = found[beside]
    ratios = [found["br.read"][0] / wall, found["trusted"][0] / wall, found["trusted"][1] / own]
    shown = " | ".join(f"{ratio:.1f}" for ratio in ratios)
    return (
        f"| {name} | {size:.0f} MB | {beside} | {1e3 * wall:.0f} ms, {1e3 * own:.0f} ms | {shown} |"
    )


def beside_others(rows: int) -> None:
    """Print the table of formats."""
    print(
        "| file | size | beside | its wall, processor time | wall | wall, trusted | processor, trusted |"
    )
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for title, path, told, fs in texts(folder, rows):
            found = medians(
                {
                    "pandas": lambda path=path, told=told: pd.read_csv(path, **told),
                    "br.read": lambda path=path, fs=fs: br.read(path, fs),
                    "trusted": lambda path=path, fs=fs: br.read(path, fs, trusted=True),
                }
            )
            print(row(title, path.stat().st_size / 1e6, found, "pandas"), flush=True)
        path = folder / "a.mat"
        savemat(path, {"a": np.random.default_rng(1).normal(size=(rows, 1)), "fs": FS})
        found = medians(
            {
                "scipy": lambda: loadmat(path),
                "br.read": lambda: br.read(path),
                "trusted": lambda: br.read(path, trusted=True),
            }
        )
        print(row("MAT: one vector", path.stat().st_size / 1e6, found, "scipy"))


def child() -> None:
    """Print what the child process costs."""
    with tempfile.TemporaryDirectory() as name:
        path = Path(name) / "a.csv"
        path.write_text("t [s],a [g]\n" + "".join(f"{k / FS:.9f},0.5\n" for k in range(2560)))
        firsts = []
        for _ in range(ROUNDS):
            apart.end_child()
            began = time.perf_counter()
            br.read(path)
            firsts.append(time.perf_counter() - began)
        found = medians(
            {"child": lambda: br.read(path), "here": lambda: br.read(path, trusted=True)}
        )
        print(
            f"child, first file: {1e3 * statistics.median(firsts):.0f} ms, least {1e3 * min(firsts):.0f} ms"
        )
        print(
            f"file of 2560 rows: child {1e3 * found['child'][0]:.1f} ms, here {1e3 * found['here'][0]:.1f} ms"
        )
        path = Path(name) / "a.npy"
        np.save(path, np.zeros(10_000_000))
        found = medians(
            {"child": lambda: br.read(path, FS), "here": lambda: br.read(path, FS, trusted=True)}
        )
        print(
            f"10 million samples: child {1e3 * found['child'][0]:.0f} ms, here {1e3 * found['here'][0]:.0f} ms"
        )


HOUR = """
import sys, time, ballrace as br
from ballrace.recordings import apart

def peak(process):
    status = open(f"/proc/{process}/status").read()
    return int(status.split("VmHWM:")[1].split()[0]) / 1e6

began = time.perf_counter()
record = br.read(sys.argv[1], fs=51_200.0, time_limit=1e3)
took = time.perf_counter() - began
child, own = peak(apart._Own.child._process.pid), peak("self")
print(f"{record.n_samples} samples in {took:.0f} s; peaks: {child:.2f} GB in the child, {own:.2f} GB here")
"""


def hour() -> None:
    """Print time and memory of an hour at 51.2 kHz."""
    rng = np.random.default_rng(1)
    with tempfile.TemporaryDirectory() as name:
        for end in ("csv", "mat"):
            path = Path(name) / f"hour.{end}"
            if end == "csv":
                block = "\n".join(f"{x:.5f}" for x in rng.normal(size=512_000)) + "\n"
                with path.open("w") as file:
                    file.write("acc [g]\n")
                    file.writelines(block for _ in range(360))
            else:
                savemat(path, {"acc": rng.normal(size=(360 * 512_000, 1)).astype(np.float32)})
            print(f"{end}, {path.stat().st_size / 1e9:.2f} GB:", end=" ", flush=True)
            subprocess.run([sys.executable, "-c", HOUR, str(path)], check=True)
            path.unlink()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rows", type=int, default=500_000)
    parser.add_argument("--hour", action="store_true")
    options = parser.parse_args()
    if options.hour:
        hour()
    else:
        beside_others(options.rows)
        child()
