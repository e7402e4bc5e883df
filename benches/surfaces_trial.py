"""Compare the acceleration of a 6205 with pits and texture with the trial that its model was specified by.

    python benches/surfaces_trial.py [--seeds N] [-o FILE]

The trial emulated texture by long lists of waves and pits by dips in the same lists; the product has both as
models. 300 N and 80 N of thrust, 1797 1/min, a clearance of 5 µm, no housing; 0.5 s of the outer ring's
acceleration, logged at 12 kHz. A textured bearing, and one whose balls differ, is drawn several times, and the
table has the middle and the extremes.
"""

from __future__ import annotations

import argparse
import sys
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import ballrace as br
from ballrace import spectra

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "python"))
from measured_6205 import PATH, STAND

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

FS, DURATION = 48_000.0, 0.5
BEGUN = 0.05
"""What is left out at the start [s]: the chain rings up from rest."""

LOAD: dict[str, Any] = {
    "radial_load": 300.0, "axial_load": 80.0, "speed_rpm": 1797.0, "clearance": 5e-6, "housing": STAND,
}  # fmt: skip
QUIET, LOUD = (1e-9, 2.0), (2e-9, 1.7)
"""A_30 [m] and slope of the two textures of the trial."""

WIDTH = 0.178
"""Width of the damage [mm]."""


@dataclass(frozen=True)
class Row:
    """A row of the table, and what the trial had: rms [m/s²], kurtosis, lines 2 to 4 over line 1, by race."""

    name: str
    shape: str | None
    texture: tuple[float, float] | None = None
    scatter: bool = False
    housing: bool = False
    outer: tuple[float, ...] = ()
    inner: tuple[float, ...] = ()


ROWS = (
    Row("healthy, smooth", None, outer=(0.064, 5.8)),
    Row("healthy, texture 1 nm, s 2", None, QUIET, outer=(0.152, 3.5)),
    Row("healthy, texture 2 nm, s 1.7", None, LOUD, outer=(0.290, 3.0)),
    Row("slot", "slot", outer=(0.724, 28, 0.98, 0.94, 0.90), inner=(1.316, 41, 0.95, 0.89, 0.81)),
    Row("pit", "pit", outer=(0.458, 30, 0.98, 0.96, 0.92), inner=(0.320, 55, 0.95, 0.90, 0.84)),
    Row("pit, scatter", "pit", scatter=True,
        outer=(0.450, 30, 0.98, 0.96, 0.92), inner=(0.311, 55, 0.95, 0.90, 0.84)),
    Row("pit, texture 1 nm, s 2", "pit", QUIET,
        outer=(0.49, 23, 1.0, 0.98, 0.94), inner=(0.35, 34, 0.93, 0.89, 0.83)),
    Row("pit, texture 2 nm, s 1.7", "pit", LOUD,
        outer=(0.547, 19, 1.0, 1.0, 0.97), inner=(0.417, 19, 0.81, 0.83, 0.83)),
    Row("pit, housing", "pit", housing=True,
        outer=(2.80, 7.0, 0.73, 0.63, 0.63), inner=(1.82, 13, 0.73, 0.76, 0.49)),
    Row("pit, texture 2 nm, s 1.7, housing", "pit", LOUD, housing=True,
        outer=(3.14, 5.7, 0.70, 0.61, 0.61), inner=(1.93, 7.0, 0.60, 0.64, 0.60)),
)  # fmt: skip


def scenes(row: Row, race: str, seeds: int) -> Iterator[br.Scene]:
    """Yield the bearings of a row, one or several."""
    drawn = range(seeds) if row.texture or row.scatter else range(1)
    for seed in drawn:
        texture = None
        if row.texture:
            level, slope = row.texture
            texture = br.scene.Texture(outer=level, inner=level, slope=slope, seed=seed)
        scene = br.bearing("6205", defects=damage(row.shape, race), texture=texture, **LOAD)
        if row.scatter:
            table = br.scatter(scene, 1, seed=seed, ball_diameter=0.5e-6)
            changes = {key: value for key, value in table.row(0, named=True).items() if "[" in key}
            scene = scene.replace({**changes, "cage.ring.pocket_clearance": 0.1e-3})
        yield scene


def damage(shape: str | None, race: str) -> br.scene.Defect | None:
    """Return what is damaged."""
    if shape is None:
        return None
    if shape == "pit":
        return br.defects.pit(on=f"{race}_race", diameter_mm=WIDTH)
    return br.defects.spall(on=f"{race}_race", width_mm=WIDTH, length_mm=4.0)


def logged(scene: br.Scene, path: br.Structure | None) -> NDArray[np.float64]:
    """Return what a logger at 12 kHz has of a run, on request at the end of a path."""
    out = br.simulate(scene, duration=BEGUN + DURATION, fs=FS)
    chain = br.measuring.Chain(path=path, logger=br.measuring.Logger(fs=12_000.0))
    return br.measure(out, chain).x[round(BEGUN * 12_000.0) :]


def facts(x: NDArray[np.float64], rate: float | None) -> list[float]:
    """Return rms, kurtosis, and lines 2 to 4 of the squared envelope at a rate [Hz] over the first one."""
    moments = br.features(x, 12_000.0)
    found = [float(moments[name] or 0.0) for name in ("rms", "kurtosis")]
    if rate is None:
        return found
    envelope = spectra.squared_envelope(x, 12_000.0)
    _, lines = spectra.comb(envelope, 12_000.0, rate, 1.0, orders=(1, 2, 3, 4))
    return [*found, *(float(line / lines[0]) for line in lines[1:])]


def judged(row: Row, race: str, seeds: int) -> NDArray[np.float64]:
    """Return the facts of the bearings of a row, shape (bearings, facts)."""
    found = []
    for scene in scenes(row, race, seeds):
        rates = br.fault_frequencies(scene)
        rate = rates.bpfo if race == "outer" else rates.bpfi
        x = logged(scene, PATH if row.housing else None)
        found.append(facts(x, rate if row.shape else None))
    return np.array(found)


def cell(found: NDArray[np.float64], trial: Sequence[float]) -> str:
    """Return the facts of a row beside those of the trial."""
    middle, low, high = (of(found, axis=0) for of in (np.median, np.min, np.max))
    texts = []
    for k, theirs in enumerate(trial):
        spread = f" ({low[k]:.2g}–{high[k]:.2g})" if len(found) > 1 else ""
        texts.append(f"{middle[k]:.2g}{spread} / {theirs:.2g}")
    return ", ".join(texts)


def main() -> None:
    """Write the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=3, help="bearings that are drawn")
    parser.add_argument("-o", "--output", type=Path, help="file (default: the screen)")
    options = parser.parse_args()
    warnings.simplefilter("ignore", br.SceneWarning)
    lines = [
        "| ours / trial: rms [m/s²], kurtosis, lines 2, 3, 4 | outer race | inner race |",
        "|---|---|---|",
    ]
    for row in ROWS:
        races = {"outer": row.outer, "inner": row.inner}
        cells = [
            cell(judged(row, race, options.seeds), trial) if trial else ""
            for race, trial in races.items()
        ]
        lines.append(f"| {row.name} | {' | '.join(cells)} |")
        print(lines[-1], file=sys.stderr, flush=True)
    table = "\n".join(lines) + "\n"
    if options.output:
        options.output.write_text(table, encoding="utf-8")
    else:
        print(table)


if __name__ == "__main__":
    main()
