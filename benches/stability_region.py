"""Where the default method is stable, by the polynomials of its formulae: a picture (SVG) and a table (CSV).

    python benches/stability_region.py            # some seconds

The polynomials, with their source, stand in ``tests/accuracy/stability_region.rs``, which also compares them with
the steps that the integrator takes. Wants the extra ``bench``. What it says stands in ``benches/README.md``.
"""

from __future__ import annotations

import argparse
import math
from pathlib import Path

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import NDArray

from precision import draw
from work_precision import write

Array = NDArray[np.float64]

SHIFT = Polynomial([0.0, 1.0])
DIFFERENCE = SHIFT**2 * (SHIFT - 1)
SIGMA = Polynomial([1, -5, 19, 9]) / 24
ALPHA = Polynomial([5, -16, 23]) / 12
PI = Polynomial([3, -10, 19]) / 24
BACKWARD = Polynomial([-2, 9, -18, 11]) / 6
REACH = (38 / 360) / (9 / 24)
BLEND = (3 / 8) / (1 + math.sqrt(1 - 3 / 8 * 11 / 6))
FORMULAE = {"Adams": 0.0, "blended": BLEND}
DAMPINGS = (0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 0.7, 1.0, 2.0, 5.0, 10.0)
DEFAULT = 0.9
"""ωh at which default steps end."""


def largest_root(blend: float, wh: float, decays: float) -> float:
    """Size of the largest root of a step's polynomial, by ωh and decays 2ζωh a step; ωh = 0: a decay alone."""
    z = blend**2 * (-decays - REACH * wh**2)
    velocity = (DIFFERENCE - z * BACKWARD, z * SHIFT**3 - SIGMA)
    place = (-(SHIFT**2) - REACH * DIFFERENCE, REACH * ALPHA - PI)
    decay = velocity[0] - decays * velocity[1]
    if wh == 0.0:
        return float(np.abs(decay.roots()).max())
    whole = DIFFERENCE * decay + wh**2 * (place[0] * velocity[1] - place[1] * velocity[0])
    return float(np.abs(whole.roots()).max())


def sizes(blend: float, wh: Array, decays: Array) -> Array:
    """Size of the largest root on a grid."""
    return np.vectorize(largest_root)(blend, wh, decays)


def limit(blend: float, damping: float) -> float:
    """ωh up to which an oscillation of a damping ratio is stable; infinite where it is up to 50."""
    low = high = 0.05
    while largest_root(blend, high, 2 * damping * high) <= 1.0:
        low, high = high, 1.01 * high
        if high > 50.0:
            return math.inf
    for _ in range(40):
        middle = 0.5 * (low + high)
        stable = largest_root(blend, middle, 2 * damping * middle) <= 1.0
        low, high = (middle, high) if stable else (low, middle)
    return low


def dormand_prince(z: NDArray[np.complex128]) -> Array:
    """Amplification of a step of Dormand and Prince's pair."""
    powers = (1, 1, 1 / 2, 1 / 6, 1 / 24, 1 / 120, 1 / 600)
    return np.abs(sum(c * z**k for k, c in enumerate(powers)))


def draw_chart(path: Path) -> None:
    """Draw regions of oscillations, of decays, and the growth of what is not damped."""
    titles = [
        "Oscillations: hλ",
        "Velocities that decay within a step",
        "Undamped: growth a radian",
    ]
    figure, (plane, decaying, undamped) = draw.panels(titles)
    colours = {"Adams": draw.BLUE, "blended": draw.RED}
    real, imaginary = np.meshgrid(np.linspace(-4.0, 0.1, 124), np.linspace(0.02, 3.0, 100))
    d, wh = np.meshgrid(np.geomspace(0.01, 1e4, 100), np.linspace(0.0, 3.0, 76))
    for name, blend in FORMULAE.items():
        colour = colours[name]
        found = sizes(blend, np.hypot(real, imaginary), -2.0 * real)
        plane.contour(real, imaginary, found, levels=[1.0], colors=colour, linewidths=1.3)
        found = sizes(blend, wh, d)
        # Places that nothing pulls back stay where they are, with a root of 1.
        decaying.contour(d, wh, found, levels=[1.0 + 1e-9], colors=colour, linewidths=1.3)
    per_evaluation = dormand_prince(6.0 * (real + 1j * imaginary))
    plane.contour(real, imaginary, per_evaluation, levels=[1.0], colors=draw.GREY, linewidths=1.0)
    plane.set(xscale="linear", yscale="linear", xlabel="real part", ylabel="imaginary part")
    for x, y, text, colour in (
        (-1.1, 1.0, "Adams", draw.BLUE),
        (-2.9, 2.5, "with backward differences", draw.RED),
        (-3.9, 0.1, "grey: Dormand–Prince,\nover six evaluations", draw.GREY),
    ):
        plane.text(x, y, text, color=colour, fontsize=8)
    decaying.set(yscale="linear", xlabel="decays a step, 2ζωh", ylabel="ωh")
    decaying.axhline(DEFAULT, color=draw.BLACK, linewidth=0.8, linestyle="--")
    for x, y, text in (
        (0.012, 0.95, "longest step by default"),
        (20.0, 0.05, "stiff friction"),
        (20.0, 0.6, "films"),
        (0.012, 0.6, "contacts"),
    ):
        decaying.text(x, y, text, color=draw.BLACK, fontsize=8)
    at = np.linspace(0.1, 1.5, 60)
    growth = np.log(sizes(0.0, at, np.zeros_like(at))) / at
    undamped.plot(at, growth, color=draw.BLUE, linewidth=1.3)
    undamped.axvline(DEFAULT, color=draw.BLACK, linewidth=0.8, linestyle="--")
    undamped.set(xscale="linear", xlabel="ωh")
    draw.save(figure, path)


def main() -> None:
    """Run from the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--output", type=Path, default=Path(__file__).parent / "charts")
    folder = parser.parse_args().output
    rows = [
        {"damping": damping} | {name: limit(blend, damping) for name, blend in FORMULAE.items()}
        for damping in DAMPINGS
    ]
    write(rows, folder / "stability_region.csv")
    draw_chart(folder / "stability_region.svg")


if __name__ == "__main__":
    main()
