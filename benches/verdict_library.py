"""Make the library of simulated records anew that verdicts are read against.

    python benches/verdict_library.py [--runs FOLDER] [--first N] [--count N] [-o TABLE]
    python benches/verdict_library.py --cover PICTURE [-o TABLE]

writes ``benches/verdict_library.csv``: runs of 25 turns of healthy and damaged bearings, of which the first turn
is left out. Each is recorded three times, and one with a spall of a race three more times for its width alone.
Every case and every record is drawn from its own number, so any can be made by itself. With a folder finished runs
are kept there and not simulated anew: a change of what is *found* in records needs none, and an interrupted call
goes on. What is drawn, and why, stands in ``verdict_cases.py``.
"""

from __future__ import annotations

import argparse
import csv
import math
import multiprocessing
import os
import tempfile
import time
import warnings
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import ballrace as br
from ballrace.diagnosis.examined import examined
from ballrace.diagnosis.kinematics import kinematics_of
from ballrace.diagnosis.likelihood import at_any_size
from ballrace.diagnosis.passes import passes_of
from ballrace.diagnosis.width import along
from ballrace.learn.drawn import log_uniform
from verdict_cases import ACCUSED, RACES, TURNS, Case, case

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    Row = dict[str, str | float]

TABLE = Path(__file__).with_name("verdict_library.csv")
JUDGED, SIZED = 3, 6
FS = 51_200.0
COUNT = 720
WEAKER, NEAR = 26.0, 0.2
"""Attenuation of the farthest sensor [dB]; share of records of a sensor on the pedestal itself."""
QUIETER = 20.0
"""Largest attenuation of a motor on a bearing that stands apart from it [dB]."""
RIG, OF_RIG = 3, (20.0, 60.0)
"""Every third record is as of a test rig: the sensor on the pedestal, the motor so much weaker [dB]."""
RATES = (12_000.0, 20_000.0, 25_600.0, 51_200.0)
NARROWED, CLIPPED = 1 / 8, 1 / 12
COLUMNS = ("seat.fx", "seat.fy", "seat.fz", "housing.sensor.ay")
EVIDENCE = [*(f"{name}_{part}" for part in ACCUSED for name in ("z", "depth", "accel")), "kurtosis"]
PASSES = ("spacing", "height", "above", "bands", "agreeing")


def run(of: Case, folder: Path) -> NDArray[np.float64]:
    """Return the force on the seat and what the sensor measures, shape (n, 4), without the first turn."""
    path = folder / f"{of.number}.npy"
    if not path.exists():
        out = br.simulate(of.scene, duration=(TURNS + 1) * 60.0 / of.rpm, fs=FS)
        # Whole or not at all, whenever it is interrupted.
        made = folder / f"{of.number}.{os.getpid()}.tmp"
        with made.open("wb") as file:
            np.save(file, np.stack([out[name] for name in COLUMNS], 1).astype(np.float32))
        made.replace(path)
    return np.load(path).astype(np.float64)[int(FS * 60.0 / of.rpm) :]


@dataclass(frozen=True)
class Recorded:
    """A record of a run, how far noise is below it and its path weakens it [dB], and the share that is clipped."""

    channel: br.Channel
    snr: float
    weaker: float
    clipped: float


def recorded(of: Case, x: NDArray[np.float64], time_: int) -> Recorded:
    """Record a run on a machine by chance."""
    rng = np.random.default_rng([68, of.number, time_])
    size = of.bearing.outside_diameter
    chains = br.measuring.random_chains(
        1, seed=int(rng.integers(1 << 30)), outside_diameter=size, near=0.0
    )
    (chain,) = chains.values()
    near, weakened, narrowed, clipped, quiet = (float(rng.random()) for _ in range(5))
    of_rig = time_ % RIG == RIG - 1
    low, high = OF_RIG if of_rig else (0.0, QUIETER)
    chain = replace(chain, machine=quieter(low + (high - low) * quiet, chain.machine))
    fs = float(rng.choice(RATES))
    flat = log_uniform(rng, (1500.0, 0.4 * fs)) if narrowed < NARROWED else None
    of_record: dict[str, Any] = {"fs": FS, "shaft": of.rpm / 60.0, "seed": 100 * of.number + time_}
    if of_rig or near < NEAR:
        weaker, signal = 0.0, x[:, 3]
        chain = replace(chain, path=None, direction=None)
    else:
        weaker, signal = WEAKER * weakened**2, x[:, :3]
        chain = replace(chain, path=weakened_by(weaker, chain.path))
    logger = replace(chain.logger, fs=fs, bandwidth=flat)
    silent = replace(chain, machine=None, logger=replace(logger, bits=None))
    own = br.measuring.chain.measured(signal, silent, **of_record).x
    found = br.measuring.chain.measured(signal, replace(chain, logger=logger), **of_record)
    if clipped < CLIPPED:
        most = float(np.abs(found.x).max()) * rng.uniform(0.3, 0.9)
        chain = replace(chain, logger=replace(logger, range=most))
        found = br.measuring.chain.measured(signal, chain, **of_record)
    snr = 20.0 * math.log10(own.std() / max((found.x - own).std(), 1e-9))
    channel = br.Channel(x=found.x, fs=found.fs, unit="m/s^2", shaft=of.rpm / 60.0)
    return Recorded(channel, snr, weaker, found.clipped)


def quieter(decibels: float, machine: br.measuring.Machine) -> br.measuring.Machine:
    """Return a machine with so much less of all that it adds."""
    (f, density), less = machine.noise_density, 10.0 ** (-decibels / 20.0)
    shaft, mains = (tuple(less * each for each in of) for of in (machine.shaft, machine.mains))
    return replace(
        machine, noise_density=(f, np.multiply(density, less**2)), shaft=shaft, mains=mains
    )


def weakened_by(decibels: float, path: br.Structure) -> br.Structure:
    """Return a path whose sensor shows so much less."""
    more = 10.0 ** (decibels / 20.0)
    return replace(path, modes=tuple(replace(mode, mass=mode.mass * more) for mode in path.modes))


def row_of(of: Case, record: Recorded, judged: bool) -> Row:
    """Return what is found in a record."""
    channel = record.channel
    row: Row = {
        "bearing": of.bearing.designation, "part": "+".join(of.parts) or "none", "speed_rpm": of.rpm,
        "load": of.load, "width": of.width, "edge": of.edge, "fs": channel.fs, "snr_db": record.snr,
    }  # fmt: skip
    row |= evidence_of(of, channel) if judged else dict.fromkeys(EVIDENCE, math.nan)
    row |= dict.fromkeys(PASSES, math.nan)
    if is_sized(of):
        part = of.parts[0]
        speed = along(of.bearing, part, nominal(of), of.bearing.contact_angle)
        passes = passes_of(channel.x, channel.fs, speed)
        if passes is not None:
            row |= {name: getattr(passes, name) for name in PASSES}
    more: Row = {
        "shape": "+".join(of.shapes) or "none", "lag": of.lag, "weaker_db": record.weaker,
        "clipped": record.clipped,
    }  # fmt: skip
    return row | more


def is_sized(of: Case) -> bool:
    """Whether it has a spall of a race alone, whose width a record may show."""
    return len(of.parts) == 1 and of.parts[0] in RACES and of.edge > 0.0


def nominal(of: Case) -> float:
    """Return the rate of the damage of a race by kinematics [Hz]."""
    orders = of.bearing.orders
    return (orders.bpfo if of.parts[0] == "outer_race" else orders.bpfi) * of.rpm / 60.0


def promised(of: Case) -> br.Bearing:
    """Return the bearing as a catalogue has it behind whose cage that of the run lags."""
    bearing = of.bearing
    ftf = bearing.orders.ftf / (1.0 - of.lag)
    # 2 f = 1 - D cos(α) / D_pw, of balls that may be as small as it takes.
    share = max(1.0 - 2.0 * ftf, 0.02) / math.cos(bearing.contact_angle)
    return replace(bearing, ball_diameter=share * bearing.pitch_diameter)


def evidence_of(of: Case, record: br.Channel) -> dict[str, float]:
    """Return the evidence for all parts."""
    found = examined(record, kinematics_of(promised(of)), of.rpm / 60.0)
    return numbers_of(found, of.bearing.pitch_diameter)


def numbers_of(found: Any, diameter: float) -> dict[str, float]:
    """Return the evidence of what is examined, for a pitch diameter [m]."""
    values: list[float] = []
    for part in ACCUSED:
        one = found.evidence[part]
        size = at_any_size(one.strength.acceleration, diameter, found.shaft.rate)
        values += [one.z, one.strength.depth, size]
    return dict(zip(EVIDENCE, [*values, one.strength.kurtosis], strict=True))


def rows_of(number: int, folder: Path) -> tuple[list[Row], float, float]:
    """Return the rows of a run, and the times of its processor that the run and its records took [s].

    One that fails has none, and says so: the others count.
    """
    warnings.simplefilter("ignore")
    began = time.process_time()
    of = case(number)
    try:
        x = run(of, folder)
    except br.BallraceError as error:
        print(f"run {number} failed: {error}")
        return [], time.process_time() - began, 0.0
    ran = time.process_time()
    count = SIZED if is_sized(of) else JUDGED
    rows = [row_of(of, recorded(of, x, k), judged=k < JUDGED) for k in range(count)]
    return rows, ran - began, time.process_time() - ran


def all_rows(numbers: range, folder: Path, workers: int) -> Iterator[Row]:
    """Yield the rows of runs in their order, made on all cores, and tell how far it is."""
    started = multiprocessing.get_context("spawn")
    times, began = [0.0, 0.0], time.monotonic()
    with ProcessPoolExecutor(workers, mp_context=started) as pool:
        made = pool.map(partial(rows_of, folder=folder), numbers)
        for done, (rows, *took) in enumerate(made, start=1):
            times = [sum(pair) for pair in zip(times, took, strict=True)]
            spent = f"runs {times[0]:.0f} s, records {times[1]:.0f} s of a core"
            print(f"{done} of {len(numbers)}, {time.monotonic() - began:.0f} s: {spent}", end="\r")
            yield from rows
    print()


def main() -> None:
    """Write the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=Path, metavar="FOLDER", help="where runs are kept")
    parser.add_argument("--first", type=int, default=0, help="number of the first run")
    parser.add_argument("--count", type=int, default=COUNT, help="runs (default: %(default)s)")
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1, help="processes")
    parser.add_argument(
        "--cover", type=Path, metavar="PICTURE", help="measured records on the table"
    )
    parser.add_argument("-o", "--output", type=Path, default=TABLE)
    options = parser.parse_args()
    if options.cover is not None:
        from verdict_cover import cover

        cover(options.output, options.cover)
        return
    numbers = range(options.first, options.first + options.count)
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.runs or Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        rows = list(all_rows(numbers, folder, options.workers))
    with options.output.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(rows[0])
        writer.writerows(
            [v if isinstance(v, str) else f"{v:.4g}" for v in row.values()] for row in rows
        )


if __name__ == "__main__":
    main()
