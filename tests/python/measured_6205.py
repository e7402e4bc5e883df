"""A simulated 6205 with an outer-race fault, as measured, beside record 130 of the Case Western Reserve data.

``python tests/python/measured_6205.py`` prints the table. Three columns: the acceleration of the outer ring as
it is simulated; the same through a measuring chain, onto the healthy record 97, brought from its 48 kHz to the
12 of the others; and record 130 as it was measured.

Taken from the record, and so no evidence: the two frequencies, the damping and the opposite signs of the
path's modes (its resonances at 2.85 and 3.42 kHz, 2 %), and the ratio of signal to background (its power
over that of the healthy record). Assumed: 300 N, 80 N of thrust, a clearance of 5 µm, a slot of 0.178 mm where
the record has a round pit. All else is what the simulation and the chain make of it.
"""

from __future__ import annotations

import math
from functools import cache
from typing import TYPE_CHECKING

import numpy as np

import ballrace as br
from ballrace import measuring, spectra
from test_cwru import FS, PUBLISHED, at_12_khz, record

if TYPE_CHECKING:
    from numpy.typing import NDArray

BANDS = [(1000.0 * k, 1000.0 * (k + 1)) for k in range(6)]
PATH = br.Structure(
    modes=tuple(
        br.Mode(
            frequency=f, damping=0.02, mass=(2850.0 / f) ** 2, seat=(0.0, 0.1, 0.0),
            sensors={"sensor": (0.0, psi, 0.0)},
        )
        for f, psi in ((2850.0, -32.0), (3420.0, 32.0))
    )
)  # fmt: skip
STAND = br.Structure(modes=(br.Mode(frequency=1e3, damping=0.1, mass=1.0, seat=(0.0, 0.0, 0.0)),))
"""A seat that does not move, but measures the force on it."""
G = 9.81
"""The records are in multiples of it."""

SHAFT, DEFECT = PUBLISHED["outer"]


@cache
def simulated() -> br.Signals:
    """Run the bearing at the shaft's speed of the record."""
    pit = br.defects.spall(on="outer_race", width_mm=0.178, length_mm=4.0)
    # The machine is the path, fitted to the record.
    scene = br.bearing(
        "6205", radial_load=300.0, axial_load=80.0, speed_rpm=60.0 * SHAFT, clearance=5e-6, defects=pit,
        housing=STAND,
    )  # fmt: skip
    return br.simulate(
        scene.replace({"cage.ring.pocket_clearance": 0.0}), duration=0.4, fs=48_000.0
    )


def signals() -> dict[str, NDArray[np.float64]]:
    """Return the three signals at 12 kHz [m/s²]."""
    healthy, faulty = G * at_12_khz("97"), G * record("130")
    logger = measuring.Logger(fs=FS)
    ideal = br.measure(simulated(), measuring.Chain(logger=logger))
    through = br.measure(simulated(), measuring.Chain(path=PATH, logger=logger))
    # The first 20 ms of the chain ring up from rest.
    settled = through.x[round(0.02 * FS) :]
    ratio = 10.0 * math.log10(faulty.var() / healthy.var() - 1.0)
    mixed = measuring.mix_into(settled, healthy, ratio)
    return {"ideal point": ideal.x, "measured by the chain": mixed, "record 130": faulty}


def levels(x: NDArray[np.float64]) -> list[float]:
    """Root mean squares in the bands [m/s²]."""
    power = np.abs(np.fft.rfft(x - x.mean())) ** 2 / x.size**2 * 2.0
    f = np.fft.rfftfreq(x.size, 1.0 / FS)
    return [math.sqrt(power[(f >= low) & (f < high)].sum()) for low, high in BANDS]


def lines(x: NDArray[np.float64], f: float, width: float, count: int) -> list[float]:
    """Lines of the squared envelope at multiples of a frequency, over its mean."""
    envelope = spectra.squared_envelope(x, FS)
    _, values = spectra.comb(envelope, FS, f, width, orders=range(1, count + 1))
    return [float(value / envelope.mean()) for value in values]


def order(x: NDArray[np.float64]) -> float:
    """Order of the family of lines of the defect."""
    envelope = spectra.squared_envelope(x, FS)
    return spectra.comb(envelope, FS, DEFECT, 1.0, orders=(1, 2, 3))[0] / SHAFT


def facts(x: NDArray[np.float64]) -> dict[str, list[float]]:
    """Return what the table shows of a signal."""
    moments = br.features(x, FS)
    return {
        "rms [m/s²]": [float(moments["rms"] or 0.0)],
        "kurtosis": [float(moments["kurtosis"] or 0.0)],
        "rms in 0–1, …, 5–6 kHz [m/s²]": levels(x),
        "order of the defect": [order(x)],
        "envelope lines 1–3 × defect, over the mean": lines(x, DEFECT, 1.0, 3),
        "envelope lines 1–2 × shaft, over the mean": lines(x, SHAFT, 0.2, 2),
    }


def table() -> str:
    """Return the comparison as a table in Markdown."""
    found = {name: facts(x) for name, x in signals().items()}
    rows = [f"| | {' | '.join(found)} |", "|---|" + "---|" * len(found)]
    for fact in next(iter(found.values())):
        cells = [" ".join(f"{v:.4g}" for v in column[fact]) for column in found.values()]
        rows.append(f"| {fact} | {' | '.join(cells)} |")
    return "\n".join(rows)


if __name__ == "__main__":
    print(table())
