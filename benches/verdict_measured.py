"""Verdicts of measured records in one table, beside three plain baselines.

    python benches/verdict_measured.py [-o TABLE]

Records of others, whose damage is known, are looked for in the folders ``cwru``, ``hit-sm``, ``mfpt`` and
``uestc`` of $BALLRACE_DATA, by default ``../shared/data`` beside the project: Case Western Reserve University
(drive end, 29), Harbin Institute of Technology (SpectraQuest half, 21), Society for Machinery Failure Prevention
Technology (4), University of Electronic Science and Technology of China (16). Each is judged with its unit and
without it, at its nominal and at its true speed, and by

- cepstrum prewhitening over the whole band, the squared envelope's spectrum, and three harmonics with sidebands
  beside those of 400 orders that no part has: named where z > 3.5 (P. Borghesani et al., Mech. Syst. Signal
  Process. 36 (2013) 370);
- the same lines of the squared envelope in the band of the kurtogram (J. Antoni, Mech. Syst. Signal Process. 21
  (2007) 108);
- the two thresholds of the example *Rolling Element Bearing Fault Diagnosis* of MATLAB's Predictive Maintenance
  Toolbox: the logarithm of the amplitude at BPFI over that at BPFO in that band, above 0.5 inner race, up to −1.5
  outer race.
"""

from __future__ import annotations

import argparse
import csv
import functools
import math
import os
import warnings
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.ndimage import median_filter

import ballrace as br

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

ROOT = Path(__file__).parents[1]
DATA = Path(os.environ.get("BALLRACE_DATA") or ROOT.parent / "shared" / "data")
PARTS = ("outer_race", "inner_race", "ball")
ORDERS_MFPT = br.frequencies.orders(8, 0.235, 1.245)

LOADS = (1797.0, 1772.0, 1750.0, 1730.0)
CWRU = {
    "inner race, 0.18 mm": (105, 106, 107, 108),
    "ball, 0.18 mm": (118, 119, 120, 121),
    "outer race, loaded, 0.18 mm": (130, 131, 132, 133),
    "outer race, beside, 0.18 mm": (144, 145, 146, 147),
    "inner race, 0.53 mm": (209, 210, 211, 212),
    "ball, 0.53 mm": (222, 223, 224, 225),
    "outer race, loaded, 0.53 mm": (234, 235, 236, 237),
}
"""Records of Case Western Reserve University under motor loads of 0 to 3 hp, by what is damaged."""


@dataclass(frozen=True, kw_only=True)
class Record:
    """A measured record whose damage is known.

    Attributes
    ----------
    collection : str
        Where it comes from.
    name : str
        Its name there.
    group : str
        What is damaged, and how.
    part : {"outer_race", "inner_race", "ball"} or None
        What is damaged.
    path : Path
        Its file.
    fs : float
        Sampling rate [Hz].
    bearing : str or Orders
        What :func:`ballrace.diagnose` takes for its bearing.
    nominal : float
        Speed as its name or page has it [1/min].
    unit : str or None
        Unit of its samples; None where the source gives none.
    """

    collection: str
    name: str
    group: str
    part: str | None
    path: Path
    fs: float
    bearing: str | br.frequencies.Orders
    nominal: float
    unit: str | None

    @functools.cached_property
    def x(self) -> NDArray[np.float64]:
        """Samples, shape (n,), in ``unit``."""
        record = br.read(self.path, fs=None if self.collection == "MFPT" else self.fs, trusted=True)
        return np.asarray(record["DE" if self.collection == "CWRU" else next(iter(record))])


def records(data: Path = DATA) -> Iterator[Record]:
    """Return the records that are there."""
    for each in (*_cwru(data), *_hit(data), *_mfpt(data), *_uestc(data)):
        if each.path.is_file():
            yield each


def _cwru(data: Path) -> Iterator[Record]:
    def one(number: int, group: str, fs: float, rpm: float) -> Record:
        return Record(
            collection="CWRU", name=str(number), group=group, part=_part(group), fs=fs, nominal=rpm, unit="g",
            path=data / "cwru" / f"{number}.mat", bearing="6205",
        )  # fmt: skip

    yield one(97, "healthy", 48_000.0, LOADS[0])
    for group, numbers in CWRU.items():
        for number, rpm in zip(numbers, LOADS, strict=True):
            yield one(number, group, 12_000.0, rpm)


def _part(group: str) -> str | None:
    head = group.partition(",")[0]
    return None if head == "healthy" else head.replace(" ", "_")


def _hit(data: Path) -> Iterator[Record]:
    groups = {"Normal": "healthy"} | {
        f"{short}{arc}": f"{race} race, {arc}°" for short, race in (("OR", "outer"), ("IR", "inner"))
        for arc in (2, 5, 8)
    }  # fmt: skip
    for short, group in groups.items():
        for rpm in (600, 900, 1200):
            yield Record(
                collection="HIT-SM", name=f"{short}_{rpm}", group=group, part=_part(group), fs=51_200.0,
                nominal=float(rpm), unit=None, path=data / "hit-sm" / f"{short}_{rpm}.mat", bearing="6205",
            )  # fmt: skip


def _mfpt(data: Path) -> Iterator[Record]:
    for kind, numbers in (("InnerRace", (1, 5)), ("OuterRace", (2, 6))):
        for number in numbers:
            name = f"{kind}Fault_vload_{number}"
            group = f"{kind[:5].lower()} race"
            yield Record(
                collection="MFPT", name=name, group=group, part=_part(group), fs=48_828.0, nominal=1500.0,
                unit="g", path=data / "mfpt" / f"{name}.mat", bearing=ORDERS_MFPT,
            )  # fmt: skip


def _uestc(data: Path) -> Iterator[Record]:
    groups = {
        "N": "healthy",
        "I": "inner race, 0.55 mm",
        "O": "outer race, 0.55 mm",
        "B": "ball, 3 mm",
    }
    for short, group in groups.items():
        for rpm in (800, 1200):
            for number in (1, 4):
                name = f"{short}_{rpm}_{number}"
                yield Record(
                    collection="UESTC", name=name, group=group, part=_part(group), fs=20_000.0,
                    nominal=float(rpm), unit=None, path=data / "uestc" / f"{name}.mat", bearing="6204",
                )  # fmt: skip


SPEEDS = {
    "B_800_1": 1.0033, "B_800_4": 1.0036, "B_1200_1": 1.0189, "B_1200_4": 1.0647, "I_800_1": 0.9744,
    "I_800_4": 0.9744, "I_1200_1": 0.9876, "I_1200_4": 0.9876, "N_800_1": 0.9913, "N_800_4": 0.9911,
    "N_1200_1": 1.0597, "N_1200_4": 1.0597, "O_800_1": 1.0096, "O_800_4": 1.0106, "O_1200_1": 1.0611,
    "O_1200_4": 1.0611,
}  # fmt: skip
"""True speed over the nominal one of the records of UESTC, by the lines of the shaft in their spectra, read by
eye."""

EXACT = 2e-3
"""How far a true speed may be off, as a part of it."""

Parts = tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class Way:
    """A way to judge a record."""

    name: str
    judge: Callable[[Record], tuple[str, Parts]]


def diagnosed(of: Record, unit: bool, exact: bool) -> tuple[str, Parts]:
    """Return verdict and parts of :func:`ballrace.diagnose`."""
    rpm = of.nominal * SPEEDS.get(of.name, 1.0) if exact else of.nominal
    within = EXACT if exact and of.name in SPEEDS else None
    options: dict[str, Any] = {
        "fs": of.fs,
        "unit": of.unit if unit else None,
        "speed_within": within,
    }
    found = br.diagnose(of.x, of.bearing, rpm, **options)
    return found.verdict, found.parts


def prewhitened(of: Record) -> tuple[str, Parts]:
    """Name the part whose lines stand out after cepstrum prewhitening."""
    return _above_null(of, br.spectra.prewhitened(of.x, of.fs), None)


def in_kurtogram_band(of: Record) -> tuple[str, Parts]:
    """Name the part whose lines stand out in the band of the kurtogram."""
    return _above_null(of, of.x, _band(of))


def two_thresholds(of: Record) -> tuple[str, Parts]:
    """Name a race by the ratio of the amplitudes at BPFI and BPFO."""
    f, value = br.spectra.envelope_spectrum(of.x, of.fs, _band(of))
    orders, shaft = _orders(of), _shaft(of)
    inner, outer = (
        value[np.abs(f / (order * shaft) - 1.0) < 0.01].max(initial=0.0)
        for order in (orders.bpfi, orders.bpfo)
    )
    ratio = math.log(inner / outer)
    if ratio > 0.5:
        return "damaged", ("inner_race",)
    return ("damaged", ("outer_race",)) if ratio <= -1.5 else ("healthy", ())


WAYS = (
    Way(name="diagnose, with unit", judge=lambda of: diagnosed(of, True, False)),
    Way(name="diagnose, without", judge=lambda of: diagnosed(of, False, False)),
    Way(name="with unit, true speed", judge=lambda of: diagnosed(of, True, True)),
    Way(name="without, true speed", judge=lambda of: diagnosed(of, False, True)),
    Way(name="prewhitened envelope", judge=prewhitened),
    Way(name="band of the kurtogram", judge=in_kurtogram_band),
    Way(name="two thresholds", judge=two_thresholds),
)


def _orders(of: Record) -> br.frequencies.Orders:
    return (
        of.bearing
        if isinstance(of.bearing, br.frequencies.Orders)
        else br.catalogue[of.bearing].orders
    )


def _shaft(of: Record) -> float:
    """Return the true rate of the shaft [Hz]: a baseline knows it."""
    return of.nominal * SPEEDS.get(of.name, 1.0) / 60.0


def _band(of: Record) -> tuple[float, float]:
    return br.spectra.kurtogram(of.x, of.fs, 3.0 * _orders(of).bpfi * _shaft(of)).best


def _above_null(
    of: Record, x: NDArray[np.float64], band: tuple[float, float] | None
) -> tuple[str, Parts]:
    """Return the part whose three harmonics with sidebands stand highest above those of 400 other orders."""
    f, value = br.spectra.squared_envelope_spectrum(x, of.fs, band)
    orders, shaft = _orders(of), _shaft(of)
    width = int(0.6 * shaft / f[1]) | 1
    level = 20.0 * np.log10(np.maximum(value / median_filter(value, width), 1e-3))
    level = np.clip(level, 0.0, 25.0)
    own = {
        "outer_race": (orders.bpfo, 0.0),
        "inner_race": (orders.bpfi, 1.0),
        "ball": (2 * orders.bsf, orders.ftf),
    }
    rng = np.random.default_rng(0)
    others = rng.uniform(2.2, 8.3, 4000)
    near = np.array(
        [order * p / q for order, _ in own.values() for p in range(1, 4) for q in range(1, 4)]
    )
    free = (np.abs(others[:, np.newaxis] / near - 1.0).min(axis=1) > 0.02) & (
        np.abs(others - np.rint(others)) > 0.03
    )
    found = {}
    for part, (order, side) in own.items():
        by_chance = np.array(
            [_height(level, f[1], shaft, each, side) for each in others[free][:400]]
        )
        middle = float(np.median(by_chance))
        spread = 1.4826 * float(np.median(np.abs(by_chance - middle)))
        found[part] = (_height(level, f[1], shaft, order, side) - middle) / spread
    first = max(found, key=lambda part: found[part])
    return ("damaged", (first,)) if found[first] > 3.5 else ("healthy", ())


def _height(
    level: NDArray[np.float64], step: float, shaft: float, order: float, side: float
) -> float:
    """Return the mean level of three harmonics with sidebands, the highest within 1.5 % of an order [dB]."""
    factors = np.linspace(0.985, 1.015, 31)
    sides = (-side, 0.0, side) if side else (0.0,)
    lines = (
        np.array([k * order * factors + each for k in (1, 2, 3) for each in sides]) * shaft / step
    )
    at = np.clip(np.rint(lines).astype(int), 1, level.size - 2)
    return float(np.maximum(np.maximum(level[at - 1], level[at]), level[at + 1]).mean(axis=0).max())


Row = dict[str, "str | int"]


def judged(data: Path = DATA) -> list[Row]:
    """Return a row a record and a way: what is said, whether that is right, and whether a sound part is named."""
    warnings.simplefilter("ignore")
    asked = [(of, way) for of in records(data) for way in WAYS]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(lambda one: _row(*one), asked))


def _row(of: Record, way: Way) -> Row:
    verdict, parts = way.judge(of)
    truth = () if of.part is None else (of.part,)
    return {
        "collection": of.collection, "record": of.name, "group": of.group, "way": way.name, "verdict": verdict,
        "parts": " ".join(parts), "right": int(parts == truth and (verdict == "healthy" or of.part is not None)),
        "cleared": int(verdict == "healthy" and of.part is not None),
        "mistaken": int(bool(set(parts) - {of.part})),
    }  # fmt: skip


def summary(rows: Sequence[Row]) -> Iterator[str]:
    """Return a Markdown table: right of all, damaged called healthy, a sound part named, by collection and way."""
    collections = list(dict.fromkeys(str(row["collection"]) for row in rows))
    yield (
        "| right of all; damaged and called healthy; a sound part named | "
        + " | ".join(collections)
        + " |"
    )
    yield "|---" * (len(collections) + 1) + "|"
    for way in WAYS:
        cells = [
            _cell([r for r in rows if (r["collection"], r["way"]) == (c, way.name)])
            for c in collections
        ]
        yield f"| {way.name} | " + " | ".join(cells) + " |"


def _cell(rows: Sequence[Row]) -> str:
    right, cleared, mistaken = (
        sum(int(row[name]) for row in rows) for name in ("right", "cleared", "mistaken")
    )
    return f"{right} of {len(rows)}; {cleared}; {mistaken}"


def main() -> None:
    """Print the table, and write the verdicts where asked."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--data", type=Path, metavar="FOLDER", default=DATA)
    parser.add_argument(
        "-o", "--output", type=Path, metavar="TABLE", help="verdicts by record, as CSV"
    )
    options = parser.parse_args()
    rows = judged(options.data)
    for line in summary(rows):
        print(line)
    if options.output is not None:
        with options.output.open("w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)


if __name__ == "__main__":
    main()
