"""Records of a spall by the machine around the bearing, beside measured ones.

    python benches/housing.py [--seconds S] [--groups OR5 IR5 …] [--picture docs/figures/housing.svg]
                              [--levels] [--edges]

HIT-SM (Harbin Institute of Technology, SpectraQuest half; see ``verdict_measured.py`` for the folder): a 6205
under 49 N with damage over 2, 5 and 8 degrees of a race. Its unit is not given, so levels are over the whole.
Each figure is the median of 600, 900 and 1200 1/min, between 50 Hz and 20 kHz: rms [m/s²], kurtosis, crest
factor, the time in which impacts fall by 20 dB, and the level of bands over that of the whole [dB]. Beside
them runs on the pedestal, with oil between balls and races, and without a film of grease, on the lump of 0.8 kg
at 1 kHz of version 0.3, and on a stiff spring alone. ``--levels``: rms on the pedestal by the width of a
spall on the outer race, which it does not tell. ``--edges``: level and kurtosis of shapes of a seeded spall
beside records of Case Western Reserve University.
"""

from __future__ import annotations

import argparse
import math
import warnings
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.signal import butter, hilbert, resample_poly, sosfiltfilt

import ballrace as br
from verdict_measured import DATA, records

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from ballrace.defects import Surface


def _spall(on: Surface, width: float, **sizes: float) -> br.scene.Defect:
    return br.defects.spall(on=on, width_mm=width, **sizes)  # type: ignore[arg-type]


RPMS = (600, 900, 1200)
FS, BEGIN = 51_200.0, 0.1
WIDTHS = (0.3, 0.6, 1.0, 1.5, 2.0, 2.5, 3.0)
BAND, BANDS = (50.0, 20_000.0), (500.0, 1000.0, 2000.0, 4000.0, 8000.0, 14_000.0)
LUMP = {
    "outer_ring.mass": 0.8,
    **{
        f"outer_ring.support.{axis}": br.scene.Spring(
            stiffness=0.8 * (2e3 * math.pi) ** 2, damping=0.06 * 0.8 * 2e3 * math.pi
        )
        for axis in "xyz"
    },
}

SEEDED: dict[str, tuple[Surface, float]] = {
    "105": ("inner_race", 0.18),
    "130": ("outer_race", 0.18),
    "209": ("inner_race", 0.53),
    "234": ("outer_race", 0.53),
}
"""Race and diameter [mm] of the holes of Case Western Reserve University's records."""
BEGIN_SEEDED = 4800
SHAPES: dict[str, Callable[[Surface, float], br.scene.Defect]] = {
    **{
        f"spall, edges of {radius:g} mm": partial(_spall, edge_radius_mm=radius)
        for radius in (0.02, 0.05, 0.1, 0.2, 0.3)
    },
    "as long as wide": lambda on, width: br.defects.spall(on=on, width_mm=width, length_mm=width),
    "as long as wide, steep walls": lambda on, width: br.defects.spall(
        on=on, width_mm=width, length_mm=width, walls="steep"
    ),
    **{
        f"floor at {depth:g} µm": partial(_spall, depth_mm=1e-3 * depth)
        for depth in (1.0, 2.0, 2.5, 3.0, 4.0)
    },
    "pit": lambda on, width: br.defects.pit(on=on, diameter_mm=width),
    "pit, rim of 1 µm": lambda on, width: br.defects.dent(
        on=on, diameter_mm=width, depth_mm=0.28, rim_height_mm=1e-3
    ),
}
"""Shapes of a seeded spall; those with edges or a floor are 2 mm long."""

OIL: dict[str, Any] = {"lubricant": "vg68", "temperature_c": 40.0}


WAYS: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "pedestal": ({}, {}),
    "pedestal, oil": (OIL, {}),
    "pedestal, dry": ({}, {"contact.squeeze": None}),
    "lump": ({"housing": None}, LUMP),
    "none": ({"housing": None}, {}),
}
"""Arguments of ``br.bearing`` and what is changed in its scene."""


def scene(group: str, rpm: float, way: str) -> br.Scene:
    """Return a 6205 with the damage of a group, such as ``OR5``."""
    made = br.catalogue["6205"]
    outer = group.startswith("OR")
    race = 0.5 * (made.pitch_diameter + (1 if outer else -1) * made.ball_diameter)
    width = 1e3 * race * math.radians(float(group[2:]))
    spall = br.defects.spall(on="outer_race" if outer else "inner_race", width_mm=width)
    arguments, changes = WAYS[way]
    of = br.bearing(made, radial_load=49.0, speed_rpm=rpm, defects=spall, **arguments)
    return of.replace(changes)


def facts(x: NDArray[np.float64], passes: float, seconds: float) -> dict[str, float]:
    """Return the figures of a record with impacts at a rate [Hz].

    The crest factor grows with the length of a record: it is the median over pieces of some length [s].
    """
    x = sosfiltfilt(butter(4, BAND, "bandpass", fs=FS, output="sos"), x - x.mean())
    rms = float(np.sqrt(np.mean(x**2)))
    pieces = np.array_split(x, max(1, round(x.size / (FS * seconds))))
    power = np.abs(np.fft.rfft(x)) ** 2
    f = np.fft.rfftfreq(x.size, 1.0 / FS)
    levels = {
        f"{1e-3 * low:g}–{1e-3 * high:g} kHz": 10.0
        * math.log10(power[(f >= low) & (f < high)].sum() / power.sum())
        for low, high in pairwise(BANDS)
    }
    return {
        "rms": rms,
        "kurtosis": float(np.mean(x**4) / rms**4),
        "crest": float(np.median([np.abs(p).max() for p in pieces]) / rms),
        "−20 dB, ms": 1e3 * decay(x, passes),
    } | levels


def decay(x: NDArray[np.float64], passes: float) -> float:
    """Return how long the mean squared envelope of the strongest third of impacts takes to fall by 20 dB [s].

    Nan where it does not within a pass of the balls.
    """
    size = round(FS / passes)
    envelope = np.abs(hilbert(x)) ** 2
    peaks = np.array(
        [k + int(np.argmax(envelope[k : k + size])) for k in range(0, x.size - 2 * size, size)]
    )
    strongest = peaks[np.argsort(envelope[peaks])[-max(1, peaks.size // 3) :]]
    kernel = np.ones(round(2e-4 * FS)) / round(2e-4 * FS)
    smooth = np.convolve(envelope, kernel, "same")
    mean = np.mean([smooth[k : k + size] for k in strongest if k + size <= x.size], axis=0)
    below = np.flatnonzero(mean < 0.01 * mean[0])
    return float(below[0] / FS) if below.size else math.nan


def rate(group: str, rpm: float) -> float:
    """Return the frequency of impacts of a group [Hz]."""
    orders = br.catalogue["6205"].orders
    return rpm / 60.0 * (orders.bpfo if group.startswith("OR") else orders.bpfi)


def measured(group: str, seconds: float) -> list[dict[str, float]]:
    """Return the figures of a group's records."""
    found = {each.name: each for each in records(DATA) if each.collection == "HIT-SM"}
    return [facts(found[f"{group}_{rpm}"].x, rate(group, rpm), seconds) for rpm in RPMS]


def simulated(group: str, seconds: float, way: str) -> list[dict[str, float]]:
    """Return the figures of a group's runs."""
    runs = [(ran(scene(group, rpm, way), seconds), rate(group, rpm)) for rpm in RPMS]
    return [facts(x, passes, seconds) for x, passes in runs]


def ran(of: br.Scene, seconds: float) -> NDArray[np.float64]:
    """Return what a sensor shows of a run after its beginning."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        out = br.simulate(of, duration=BEGIN + seconds, fs=FS)
    return out.channel().x[round(BEGIN * FS) :]


def median(rows: list[dict[str, float]]) -> dict[str, float]:
    """Return the medians over the speeds."""
    return {name: float(np.median([row[name] for row in rows])) for name in rows[0]}


def table(groups: list[str], seconds: float) -> str:
    """Return the comparison as a table in Markdown."""
    lines: list[str] = []
    for group in groups:
        for name in ("HIT-SM", *WAYS):
            of = measured(group, seconds) if name == "HIT-SM" else simulated(group, seconds, name)
            found = median(of)
            if not lines:
                lines += [f"| | | {' | '.join(found)} |", "|---|---|" + "---|" * len(found)]
            cells = [f"{v:.2g}" if abs(v) < 10.0 else f"{v:.0f}" for v in found.values()]
            lines.append(f"| {group} | {name} | {' | '.join(cells)} |")
    return "\n".join(lines)


def levels() -> str:
    """Return the rms of the sensor over 0.3 s at 1797 1/min by load and width of a spall."""
    lines = ["| load N | " + " | ".join(f"{width:g} mm" for width in WIDTHS) + " |"]
    lines.append("|---|" + "---|" * len(WIDTHS))
    for load in (500.0, 1500.0):
        spalls = [br.defects.spall(on="outer_race", width_mm=width) for width in WIDTHS]
        made = [br.bearing("6205", radial_load=load, speed_rpm=1797.0, defects=d) for d in spalls]
        rms = [br.simulate(of, duration=0.3).channel().x.std() for of in made]
        lines.append(f"| {load:g} | " + " | ".join(f"{x:.3g}" for x in rms) + " |")
    return "\n".join(lines)


def edges() -> str:
    """Return rms [m/s²] and kurtosis at 12 kHz of shapes of a seeded spall, beside the records with its sizes.

    Load, thrust and clearance are those of ``tests/python/measured_6205.py``, where they are assumed.
    """
    found = {each.name: each for each in records(DATA) if each.collection == "CWRU"}
    lines = [f"| | {' | '.join(SEEDED)} |", "|---|" + "---|" * len(SEEDED)]
    rows = {"measured": [_level(9.81 * found[name].x) for name in SEEDED]}
    for shape, made in SHAPES.items():
        rows[shape] = []
        for on, width in SEEDED.values():
            try:
                x = _seeded(made(on, width))
            except br.SceneError:
                rows[shape].append("refused")
            else:
                rows[shape].append(_level(resample_poly(x[BEGIN_SEEDED:], 1, 4)))
    for shape, levels_of in rows.items():
        lines.append(f"| {shape} | {' | '.join(levels_of)} |")
    return "\n".join(lines)


def _seeded(spall: br.scene.Defect) -> NDArray[np.float64]:
    """Return what the sensor measures of a spall at 48 kHz."""
    of = br.bearing(
        "6205", radial_load=300.0, axial_load=80.0, speed_rpm=1797.0, clearance=5e-6, defects=spall
    )  # fmt: skip
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return np.asarray(br.simulate(of, duration=0.4, fs=48e3)["housing.sensor.ay"])


def _level(x: NDArray[np.float64]) -> str:
    """Return root mean square and kurtosis of a record."""
    x = x - x.mean()
    return f"{x.std():.3g}, {np.mean(x**4) / x.var() ** 2:.2g}"


def draw(path: Path) -> None:
    """Draw two passes of the balls over 5 degrees of the outer race, over the root mean square."""
    import matplotlib as mpl
    import matplotlib.pyplot as plt

    mpl.rcParams |= {"svg.fonttype": "none", "svg.hashsalt": "ballrace", "font.size": 10}
    group, rpm = "OR5", 900
    passes = rate(group, rpm)
    (record,) = (each for each in records(DATA) if each.name == f"{group}_{rpm}")
    shown = {"measured": record.x[: round(FS)]}
    shown |= {way: ran(scene(group, rpm, way), 0.3) for way in ("pedestal", "lump", "none")}
    titles = {"lump": "one mass, 1 kHz", "none": "stiff spring alone"}
    fig, axes = plt.subplots(1, 4, figsize=(11.0, 2.6), sharey=True, layout="constrained")
    for ax, (name, x) in zip(axes, shown.items(), strict=True):
        begin = int(np.argmax(np.abs(x[: x.size // 2]))) - round(0.3 * FS / passes)
        part = (x[max(0, begin) :][: round(2.0 * FS / passes)] - x.mean()) / x.std()
        ax.plot(1e3 * np.arange(part.size) / FS, part, color="#3d4852", lw=0.6)
        ax.set(title=titles.get(name, name), xlabel="time [ms]")
        ax.spines[["top", "right"]].set_visible(False)
    axes[0].set_ylabel("acceleration over its rms")
    fig.savefig(path, metadata={"Date": None})


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--seconds", type=float, default=0.6)
    parser.add_argument("--groups", nargs="+", default=["OR2", "OR5", "OR8", "IR2", "IR5", "IR8"])
    parser.add_argument("--picture", type=Path, help="draw passes of OR5 instead")
    parser.add_argument("--levels", action="store_true", help="levels over widths instead")
    parser.add_argument("--edges", action="store_true", help="shapes of seeded spalls instead")
    options = parser.parse_args()
    if options.levels:
        print(levels())
    elif options.edges:
        print(edges())
    elif options.picture is None:
        print(table(options.groups, options.seconds))
    else:
        draw(options.picture)


if __name__ == "__main__":
    main()
