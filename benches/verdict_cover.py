"""Measured records of damaged races beside those of the library: strength, depth, kurtosis over width.

    python benches/verdict_library.py --cover PICTURE

For each race, and for each set of records of ``verdict_measured.py`` whose damage has a known width, it prints
where the median lies among records of the library at like widths, and among those of them at like speeds and
sampling rates, without dents: what was measured are holes and cuts. Impacts ring into each other the less the
slower they come, and rates decide how much of them is seen, so that kurtosis and depth depend on both.

The ranges of the library are chosen by reason, not by this. It was looked at seventeen times: at 29 runs, after
which sensors were set mostly near, half of the cuts across the contact and their edges sharper; at 33, 97 and 597
of these, which showed that noise was not yet quieter than a motor's and that paths did not grow with the bearings;
after which edges were bounded by the widths; twice with records weighted by how near their sensors are and by what
rigs are like, after which every third record was taken as of a test rig; at what was kept, before and after; with
the library made anew; with more records weighted as of rigs, which changed nothing; at distances of damage from
the healthy records of the same rigs, after which the library's rigs were made as quiet, twice at what came of it;
once with the library made anew, of paths with 5 to 40 modes and unbalanced rotors; and once at the medians of all
records of a race, after which a hundred runs of slow machines were added.
"""

from __future__ import annotations

import math
import re
import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import NullFormatter

import ballrace as br
from ballrace.diagnosis.examined import examined
from ballrace.diagnosis.kinematics import kinematics_of
from verdict_cases import RACES, WIDTHS
from verdict_fit import judged, library
from verdict_library import numbers_of
from verdict_measured import SPEEDS, Record, records

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from matplotlib.axes import Axes
    from numpy.typing import NDArray

ALIKE = 1.6
"""Factor within which widths, speeds and sampling rates are alike."""
INSIDE, OUTER = (0.2, 0.8), (0.05, 0.95)
"""Quantiles of records of the library between which measured ones are inside; the others that are drawn."""
SHOWN = {"accel": "a·D²/v [m²/s]", "depth": "depth of modulation", "kurtosis": "kurtosis"}
STANDARD_GRAVITY = 9.80665


@dataclass(frozen=True, kw_only=True)
class Shown:
    """Numbers of a measured record by name, with its race, width in ball diameters, speed and sampling rate."""

    group: str
    part: str
    width: float
    speed_rpm: float
    fs: float
    numbers: dict[str, float]


def shown() -> Iterator[Shown]:
    """Yield what measured records of damaged races show whose widths are known."""
    for of in records():
        if of.part not in RACES or isinstance(of.bearing, br.frequencies.Orders):
            continue
        bearing = br.catalogue[of.bearing]
        width = _width(of, bearing)
        if width is None:
            continue
        numbers = _numbers(of, bearing)
        yield Shown(
            group=f"{of.collection}, {of.group}",
            part=of.part,
            width=width,
            speed_rpm=of.nominal,
            fs=of.fs,
            numbers=numbers,
        )


def _width(of: Record, bearing: br.Bearing) -> float | None:
    """Return the width of a record's damage in ball diameters by its group."""
    if size := re.search(r"([\d.]+) mm", of.group):
        return 1e-3 * float(size[1]) / bearing.ball_diameter
    if arc := re.search(r"(\d+)°", of.group):
        side = 1.0 if of.part == "outer_race" else -1.0
        radius = 0.5 * (bearing.pitch_diameter + side * bearing.ball_diameter)
        return math.radians(float(arc[1])) * radius / bearing.ball_diameter
    return None


def _numbers(of: Record, bearing: br.Bearing) -> dict[str, float]:
    """Return the evidence for a record's part; its strength only where its unit is known."""
    rate = of.nominal * SPEEDS.get(of.name, 1.0) / 60.0
    x = of.x * (STANDARD_GRAVITY if of.unit == "g" else 1.0)
    channel = br.Channel(x=x, fs=of.fs, unit="m/s^2", shaft=rate)
    found = numbers_of(examined(channel, kinematics_of(bearing), rate), bearing.pitch_diameter)
    numbers = {"depth": found[f"depth_{of.part}"], "kurtosis": found["kurtosis"]}
    if of.unit is not None:
        numbers["accel"] = found[f"accel_{of.part}"]
    return numbers


def place(own: Sequence[Shown], name: str, rows: NDArray[np.void]) -> str:
    """Return where a median lies among rows of the library at like widths, and then speeds and rates.

    And the median of where each record lies among those of its own width.
    """
    own = [each for each in own if name in each.numbers]
    if not own:
        return "unit not known"
    median = float(np.median([each.numbers[name] for each in own]))
    told = [f"{median:.3g}"]
    for also in ((), ("speed_rpm", "fs")):
        there = column(alike(rows, own, ("width", *also)), own[0].part, name)
        share = below(there, median)
        low, high = np.quantile(there, INSIDE) if there.size else (math.nan, math.nan)
        where = "inside" if INSIDE[0] <= share <= INSIDE[1] else "OUTSIDE"
        told.append(f"{where} at {100.0 * share:.0f} % of {there.size} ({low:.3g} to {high:.3g})")
    each_own = [
        below(column(alike(rows, [each], ("width",)), each.part, name), each.numbers[name])
        for each in own
    ]
    return f"{'; '.join(told)}; each at its own width {100.0 * np.median(each_own):.0f} %"


def below(there: NDArray[np.float64], value: float) -> float:
    """Return the share of numbers below a value; NaN of none."""
    return float((there < value).mean()) if there.size else math.nan


def alike(rows: NDArray[np.void], own: Sequence[Shown], names: Sequence[str]) -> NDArray[np.void]:
    """Return the rows that are like any record of a set by some numbers."""
    chosen = np.ones(len(rows), bool)
    for name in names:
        low, high = (end([getattr(each, name) for each in own]) for end in (min, max))
        chosen &= (rows[name] > low / ALIKE) & (rows[name] < high * ALIKE)
    return rows[chosen]


def column(rows: NDArray[np.void], part: str, name: str) -> NDArray[np.float64]:
    """Return a number of the rows of a part."""
    found: NDArray[np.float64] = rows[name if name == "kurtosis" else f"{name}_{part}"]
    return found


def cover(table: Path, picture: Path) -> None:
    """Draw it, and print where the sets lie."""
    warnings.simplefilter("ignore")
    mpl.rcParams |= {"svg.fonttype": "none", "svg.hashsalt": "ballrace"}
    rows, measured = judged(library(table)), list(shown())
    figure, axes = plt.subplots(2, 3, figsize=(12.0, 7.0), layout="constrained")
    for part, line in zip(RACES, axes, strict=True):
        of_part = rows[(rows["part"] == part) & (rows["shape"] != "dent")]
        groups = [each for each in measured if each.part == part]
        for name, ax in zip(SHOWN, line, strict=True):
            _draw(ax, of_part, groups, name)
            ax.set_title(part.replace("_", " "), fontsize=10)
        sets = {each.group: [one for one in groups if one.group == each.group] for each in groups}
        for group, own in {f"All, {part.replace('_', ' ')}": groups, **sets}.items():
            for name in SHOWN:
                print(f"{group}, {name}: {place(own, name, of_part)}")
    axes[0, -1].legend(frameon=False, fontsize=7)
    figure.savefig(picture, metadata={"Date": None})


def _draw(ax: Axes, rows: NDArray[np.void], groups: Sequence[Shown], name: str) -> None:
    """Draw a number of measured records of a part over the width of its damage, on quantiles of the library."""
    part = groups[0].part
    bands = {}
    for width in np.geomspace(*WIDTHS, 40):
        near = np.abs(np.log(rows["width"] / width)) < math.log(ALIKE)
        if near.any():
            bands[width] = np.quantile(column(rows[near], part, name), (*OUTER, *INSIDE))
    for low, high in np.array(list(bands.values())).T.reshape(2, 2, -1):
        ax.fill_between(list(bands), low, high, color="tab:gray", alpha=0.25, lw=0.0)
    for collection in dict.fromkeys(each.group.partition(",")[0] for each in groups):
        own = [g for g in groups if g.group.startswith(collection) and name in g.numbers]
        ax.loglog(
            [g.width for g in own],
            [g.numbers[name] for g in own],
            "o",
            ms=5,
            alpha=0.8,
            label=collection,
        )
    ax.xaxis.set_minor_formatter(NullFormatter())
    ax.set_xlabel("width [ball diameters]")
    ax.set_ylabel(SHOWN[name])
