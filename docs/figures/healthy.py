"""Draws how healthy bearings sound, and a pit and a slot: ``python docs/figures/healthy.py`` (extra ``bench``)."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from draw import BLUE, EDGE, RED, labelled, save

import ballrace as br
from ballrace.measuring.machine import MEASURED_FLOOR

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FS, LOAD = (
    25_600.0,
    {"radial_load": 300.0, "axial_load": 80.0, "speed_rpm": 1797.0, "clearance": 5e-6},
)
TEXTURE = br.scene.Texture(outer=1e-9, inner=1e-9, ball=3e-11, seed=4)
WAVES = [br.scene.Waviness(order=n, amplitude=100e-9, phase=0.1 * n) for n in (8, 10, 17, 19)]


def run(duration: float, changes: dict[str, Any] | None = None, **options: Any) -> br.Signals:
    """Run a 6205, its ring alone on a stiff spring."""
    scene = br.bearing("6205", housing=None, **LOAD, **options)
    return br.simulate(scene.replace(changes or {}), duration=duration, fs=FS)


def healthy(ax: Axes) -> None:
    """Draw spectra of a smooth, a wavy and a textured bearing, over the floor of a measured motor."""
    made = {
        "smooth": run(1.0),
        "wavy": run(1.0, {"rows[0].inner_waviness": WAVES}),
        "textured": run(1.0, texture=TEXTURE),
    }
    for (name, out), colour in zip(made.items(), (EDGE, BLUE, RED), strict=True):
        f, density = br.spectra.psd(out)
        edges = np.geomspace(50.0, 10_000.0, 61)
        middle = np.sqrt(edges[:-1] * edges[1:])
        inside = [density[(f >= low) & (f < high)] for low, high in pairwise(edges)]
        level = [10.0 * np.log10(part.mean()) if part.size else np.nan for part in inside]
        ax.semilogx(middle, level, color=colour, lw=2.4 if name == "smooth" else 1.2, label=name)
    f, floor = (np.asarray(part) for part in MEASURED_FLOOR)
    ax.semilogx(
        f[f < 10_000.0],
        10.0 * np.log10(floor[f < 10_000.0]),
        color="grey",
        ls="--",
        lw=1.0,
        label="floor of record 97",
    )
    ax.legend(frameon=False, fontsize=8)
    labelled(ax, "healthy 6205", "frequency [Hz]", "ring's acceleration\n[dB re 1 (m/s²)²/Hz]")
    ax.set_ylim(-120.0, -25.0)


def passes(ax: Axes) -> None:
    """Draw what the ring does as a ball passes a pit and a slot of the same width."""
    for name, defect, colour in (
        ("slot", br.defects.spall(on="outer_race", width_mm=0.178, length_mm=4.0), BLUE),
        ("pit", br.defects.pit(on="outer_race", diameter_mm=0.178), RED),
    ):
        out = run(0.05, defects=defect)
        y = out["outer.ay"]
        middle = int(np.abs(y[200:]).argmax()) + 200
        around = slice(middle - 40, middle + 120)
        ax.plot(
            1e3 * (out.t[around] - out.t[middle]),
            y[around],
            color=colour,
            lw=1.0,
            label=f"{name} of 0.178 mm",
        )
    ax.legend(frameon=False, fontsize=8)
    labelled(ax, "outer race, 300 N", "time [ms]", "ring's acceleration [m/s²]")
    ax.autoscale(axis="y")


def cages(ax: Axes) -> None:
    """Draw the ring's acceleration with links between neighbouring balls, and with a cage that is a ring."""
    scene = br.bearing("6205", housing=None, radial_load=500.0, speed_rpm=1200.0)
    links = br.scene.Cage(stiffness=1e6, damping=20.0, play=0.1e-3)
    for name, cage, colour in (
        ("links between balls", links, EDGE),
        ("ring with pockets", scene.cage, RED),
    ):
        out = br.simulate(replace(scene, cage=cage), duration=0.05, fs=FS)
        label = f"{name}: {out['outer.ay'].std():.2f} m/s²"
        ax.plot(1e3 * out.t, out["outer.ay"], color=colour, lw=0.8, label=label)
    ax.legend(frameon=False, fontsize=8)
    labelled(ax, "healthy 6205, 500 N, 1200 1/min", "time [ms]", "ring's acceleration [m/s²]")
    ax.autoscale(axis="y")


if __name__ == "__main__":
    save("healthy", 9.5, 3.6, healthy, passes)
    save("rattle", 7.0, 3.0, cages)
