"""Draws a pit beside a slot: what they take of a force, and their sound, before and behind a housing.

``python docs/figures/pits.py`` (extra ``bench``)
"""

from __future__ import annotations

import functools
import sys
import warnings
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from draw import BLUE, HERE, RED, labelled, save

import ballrace as br

sys.path.append(str(HERE.parents[1] / "tests" / "python"))
from measured_6205 import PATH, STAND

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FS = 96_000.0
LOAD: dict[str, Any] = {
    "radial_load": 300.0, "axial_load": 80.0, "speed_rpm": 1797.0, "clearance": 5e-6, "housing": STAND,
}  # fmt: skip
DAMAGE = {
    "slot of 0.178 mm": (br.defects.spall(on="outer_race", width_mm=0.178, length_mm=4.0), BLUE),
    "pit of 0.178 mm": (br.defects.pit(on="outer_race", diameter_mm=0.178), RED),
}


@functools.cache
def run(name: str) -> br.Signals:
    """Run a 6205 with a damage, its contacts recorded."""
    scene = br.bearing("6205", defects=DAMAGE[name][0], **LOAD)
    probes = {**scene.probes, "contacts": br.scene.ContactsProbe(row=0)}
    with warnings.catch_warnings():
        # A slot so narrow takes too little of a force and gives too hard a blow: that is what is drawn.
        warnings.simplefilter("ignore", br.SceneWarning)
        return br.simulate(replace(scene, probes=probes), duration=0.06, fs=FS)


def passes(out: br.Signals) -> tuple[slice, int]:
    """Return the samples around the hardest blow after the start, and the ball that makes it."""
    y = np.abs(out["outer.ay"])
    y[: round(0.02 * FS)] = 0.0
    middle = int(y[: -round(0.006 * FS)].argmax())
    around = slice(middle - 48, middle + 144)
    loads = [out[f"contacts.ball{k}.outer.load"][around] for k in range(9)]
    return around, int(np.argmax([np.ptp(np.diff(load)) for load in loads]))


def forces(ax: Axes) -> None:
    """Draw the force of the outer race on the ball that passes the damage."""
    for name, (_, colour) in DAMAGE.items():
        out = run(name)
        around, ball = passes(out)
        load = out[f"contacts.ball{ball}.outer.load"][around]
        ax.plot(1e3 * np.arange(load.size) / FS, load, color=colour, lw=1.2, label=name)
    ax.legend(frameon=False, fontsize=8)
    labelled(ax, "a pass: force on the ball", "time [ms]", "normal force [N]")
    ax.autoscale(axis="y")


def blows(ax: Axes) -> None:
    """Draw the ring's acceleration of the same passes."""
    for name, (_, colour) in DAMAGE.items():
        out = run(name)
        y = out["outer.ay"][passes(out)[0]]
        ax.plot(1e3 * np.arange(y.size) / FS, y, color=colour, lw=1.0)
    labelled(ax, "the same, ring's acceleration", "time [ms]", "acceleration [m/s²]")
    ax.autoscale(axis="y")


def sounds(ax: Axes) -> None:
    """Draw what a sensor records behind the housing over three passes."""
    for name, (_, colour) in DAMAGE.items():
        out = run(name)
        measured = br.measure(out, br.measuring.Chain(path=PATH)).x[-round(0.028 * FS) :]
        ax.plot(1e3 * np.arange(measured.size) / FS, measured, color=colour, lw=0.8)
    labelled(ax, "three passes, behind a housing", "time [ms]", "acceleration [m/s²]")
    ax.autoscale(axis="y")


if __name__ == "__main__":
    save("pits", 12.0, 3.4, forces, blows, sounds)
