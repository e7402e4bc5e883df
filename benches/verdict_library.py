"""Make the library of simulated records anew that verdicts are read against.

    python benches/verdict_library.py [--runs FOLDER]

writes ``python/ballrace/diagnosis/library.csv``: 480 runs of 25 turns, healthy and damaged, half of them with
waves of the races, half with textures. Each is recorded three times without its first turn, and one with a damaged
race three more times for its width alone: at the end of a path by chance or on the pedestal, in white noise of
0.05 to 2 m/s², logged at 12.8, 25.6 or 51.2 kHz. With a folder the runs are kept there, and those that are there
are not simulated anew: a change of what is *found* in records needs none.
"""

from __future__ import annotations

import argparse
import csv
import math
import tempfile
import time
import warnings
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

import ballrace as br
from ballrace.diagnosis.examined import examined
from ballrace.diagnosis.kinematics import kinematics_of
from ballrace.diagnosis.likelihood import at_any_size
from ballrace.diagnosis.passes import passes_of
from ballrace.diagnosis.width import along

if TYPE_CHECKING:
    from numpy.typing import NDArray

TABLE = Path(br.__file__).parent / "diagnosis" / "library.csv"
JUDGED, SIZED = 3, 6
FS, TURNS = 51_200.0, 24
BEARINGS = ("6004", "6203", "6205", "6207", "6306", "6309", "6310", "6000")
COUNT = 480
TEXTURED = 240
"""Number from which on races are textured; before, they have waves."""
# Of ten runs.
PARTS = (*[None] * 3, *["outer_race"] * 3, *["inner_race"] * 3, "ball")
ACCUSED = ("outer_race", "inner_race", "ball")
EVIDENCE = [*(f"{name}_{part}" for part in ACCUSED for name in ("z", "depth", "accel")), "kurtosis"]


@dataclass(frozen=True)
class Case:
    """A run of the library; lengths of its defect in ball diameters."""

    number: int
    bearing: br.Bearing
    part: str | None
    rpm: float
    load: float
    width: float
    edge: float
    scene: br.Scene


def log_uniform(rng: np.random.Generator, low: float, high: float) -> float:
    """Draw a number whose logarithm is even."""
    return math.exp(rng.uniform(math.log(low), math.log(high)))


def case(number: int) -> Case:
    """Draw a run."""
    rng = np.random.default_rng([42, number])
    bearing = br.catalogue[BEARINGS[number // 10 % len(BEARINGS)]]
    part = PARTS[number % 10]
    rpm, load = log_uniform(rng, 600.0, 3600.0), log_uniform(rng, 0.005, 0.08)
    thrust, width = rng.uniform(0.0, 0.4), rng.uniform(0.03, 0.45)
    edge = log_uniform(rng, 0.0025, 0.04)
    length, clearance = rng.uniform(0.25, 0.8), str(rng.choice(["C2", "CN", "C3"]))
    outer, inner = (waves(rng) for _ in range(2))
    start = float(rng.uniform(0.0, 6.28))
    radial = load * bearing.static_rating
    scene = br.bearing(
        bearing, radial_load=radial, axial_load=thrust * radial, speed_rpm=rpm, clearance=clearance,
        defects=defect(part, bearing, width, edge, length),
    )  # fmt: skip
    row = replace(scene.rows[0], start_angle=start)
    if number < TEXTURED:
        row = replace(row, outer_waviness=outer, inner_waviness=inner)
    else:
        row = replace(row, texture=texture(rng))
    width = 0.0 if part is None else width
    return Case(number, bearing, part, rpm, load, width, edge, replace(scene, rows=(row,)))


def waves(rng: np.random.Generator) -> tuple[br.scene.Waviness, ...]:
    """Draw six waves of a race, of 5 to 200 nm."""
    orders = rng.choice(np.arange(2, 40), 6, replace=False)
    heights = 1e-6 * np.exp(rng.uniform(math.log(0.005), math.log(0.2), 6))
    drawn = zip(orders.tolist(), heights.tolist(), rng.uniform(0.0, 6.28, 6).tolist(), strict=True)
    return tuple(br.scene.Waviness(order=o, amplitude=a, phase=p) for o, a, p in drawn)


def texture(rng: np.random.Generator) -> br.scene.Texture:
    """Draw a texture of the races, of quiet to loud bearings."""
    outer, inner = (log_uniform(rng, 2e-10, 5e-9) for _ in range(2))
    return br.scene.Texture(
        outer=outer, inner=inner, slope=rng.uniform(1.5, 2.5), seed=int(rng.integers(1 << 30))
    )


def defect(
    part: str | None, bearing: br.Bearing, width: float, edge: float, length: float
) -> br.scene.Defect | None:
    """Return a spall of a race, or a cap of a ball, which is met however the ball turns."""
    ball = 1e3 * bearing.ball_diameter
    if part is None:
        return None
    if part == "ball":
        return br.defects.cap(width_mm=max(width, 0.05) * ball, edge_radius_mm=edge * ball)
    return br.defects.spall(
        on=part, width_mm=width * ball, length_mm=length * ball, edge_radius_mm=edge * ball
    )


def run(of: Case, folder: Path) -> NDArray[np.float64]:
    """Return the force on the seat and what the sensor measures, shape (n, 4), without the first turn."""
    path = folder / f"{of.number}.npy"
    if not path.exists():
        out = br.simulate(of.scene, duration=(TURNS + 1) * 60.0 / of.rpm, fs=FS)
        names = ("seat.fx", "seat.fy", "seat.fz", "housing.sensor.ay")
        np.save(path, np.stack([out[name] for name in names], 1).astype(np.float32))
    return np.load(path).astype(np.float64)[int(FS * 60.0 / of.rpm) :]


def recorded(of: Case, x: NDArray[np.float64], time_: int) -> tuple[br.Channel, float]:
    """Return a record of a run, and how far its noise is below it [dB]."""
    rng = np.random.default_rng([43, of.number, time_])
    fs = float(rng.choice([12_800.0, 25_600.0, 51_200.0]))
    noise = log_uniform(rng, 0.05, 2.0)
    logger = br.measuring.Logger(fs=fs) if fs < FS else None
    if rng.uniform() < 0.85:
        path = br.measuring.random_housing(seed=1000 + 10 * of.number + time_)
        measured = br.measure(x[:, :3], fs=FS, path=path, logger=logger).x
    else:
        measured = br.measure(x[:, 3], fs=FS, logger=logger).x
    snr = 20.0 * math.log10(measured.std() / noise)
    measured = measured + noise * rng.normal(size=measured.size)
    return br.Channel(x=measured, fs=fs, unit="m/s^2", shaft=of.rpm / 60.0), snr


def row_of(of: Case, record: br.Channel, snr: float, judged: bool) -> dict[str, str | float]:
    """Return what is found in a record."""
    row: dict[str, str | float] = {
        "bearing": of.bearing.designation, "part": of.part or "none", "speed_rpm": of.rpm, "load": of.load,
        "width": of.width, "edge": of.edge, "fs": record.fs, "snr_db": snr,
    }  # fmt: skip
    row |= evidence_of(of, record) if judged else dict.fromkeys(EVIDENCE, math.nan)
    names = ("spacing", "height", "above", "bands", "agreeing")
    row |= dict.fromkeys(names, math.nan)
    if of.part in ACCUSED[:2]:
        passes = passes_of(
            record.x, record.fs, along(of.bearing, of.part, nominal(of), of.bearing.contact_angle)
        )
        if passes is not None:
            row |= {name: getattr(passes, name) for name in names}
    return row


def nominal(of: Case) -> float:
    """Return the rate of the damage of a race by kinematics [Hz]."""
    orders = of.bearing.orders
    return (orders.bpfo if of.part == "outer_race" else orders.bpfi) * of.rpm / 60.0


def evidence_of(of: Case, record: br.Channel) -> dict[str, float]:
    """Return the evidence for all parts."""
    found = examined(record, kinematics_of(of.bearing), of.rpm / 60.0)
    values: list[float] = []
    for part in ACCUSED:
        one = found.evidence[part]
        size = at_any_size(one.strength.acceleration, of.bearing.pitch_diameter, found.shaft.rate)
        values += [one.z, one.strength.depth, size]
    return dict(zip(EVIDENCE, [*values, one.strength.kurtosis], strict=True))


def main() -> None:
    """Write the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=Path, metavar="FOLDER", help="where runs are kept")
    parser.add_argument("--count", type=int, default=COUNT, help="runs (default: %(default)s)")
    parser.add_argument("-o", "--output", type=Path, default=TABLE)
    options = parser.parse_args()
    warnings.simplefilter("ignore", br.SceneWarning)
    begun = time.process_time()
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.runs or Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        rows = []
        for number in range(options.count):
            of = case(number)
            x = run(of, folder)
            count = SIZED if of.part in ACCUSED[:2] else JUDGED
            rows += [row_of(of, *recorded(of, x, k), judged=k < JUDGED) for k in range(count)]
            print(f"{number + 1} of {options.count}, {time.process_time() - begun:.0f} s", end="\r")
    with options.output.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(rows[0])
        writer.writerows(
            [v if isinstance(v, str) else f"{v:.4g}" for v in row.values()] for row in rows
        )


if __name__ == "__main__":
    main()
