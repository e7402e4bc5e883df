"""Draws the guide's pictures beside itself: ``python docs/figures/draw.py`` (extra ``bench``).

Drawings show how things are named, not how they are shaped: angles, clearances and depths are much too large.
"""

from __future__ import annotations

import functools
import sys
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Arc, Circle, Polygon

import ballrace as br
from ballrace.diagnosis.likelihood import numbers_of
from ballrace.diagnosis.null import ACCUSED
from ballrace.diagnosis.width import are_clear

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.axes import Axes

HERE = Path(__file__).parent
sys.path.append(str(HERE.parents[1] / "benches"))
STEEL, EDGE, BALL, RED, BLUE = "#d7dde3", "#3d4852", "#f3f5f7", "#b3261e", "#1c5d99"

mpl.rcParams |= {
    "svg.fonttype": "none",
    "svg.hashsalt": "ballrace",
    "font.family": "sans-serif",
    "font.size": 10,
}


def plain(ax: Axes, title: str) -> None:
    """Make a drawing of a diagram: one scale, no axes."""
    ax.set_aspect("equal")
    ax.axis("off")
    ax.set_title(title, fontsize=11)


def arrow(
    ax: Axes, tail: tuple[float, float], tip: tuple[float, float], colour: str, text: str = "",
    *, beside: tuple[float, float] = (0.0, 0.0), ha: str = "center", both: bool = False,
) -> None:  # fmt: skip
    """Draw an arrow with a text at its tip."""
    style = "<|-|>" if both else "-|>"
    ax.annotate(
        "", tip, tail, arrowprops={"arrowstyle": style, "color": colour, "lw": 1.6, "shrinkA": 0, "shrinkB": 0}
    )  # fmt: skip
    ax.text(tip[0] + beside[0], tip[1] + beside[1], text, color=colour, ha=ha, va="center")


def note(
    ax: Axes, text: str, at: tuple[float, float], where: tuple[float, float], colour: str
) -> None:
    """Write a text with a line to what it is about."""
    ax.annotate(text, at, where, color=colour, arrowprops={"arrowstyle": "-", "color": colour})


def arc(centre: tuple[float, float], radius: float, first: float, last: float) -> np.ndarray:
    """Return points of a circle between two angles [°]."""
    turn = np.radians(np.linspace(first, last, 120))
    return np.column_stack([centre[0] + radius * np.cos(turn), centre[1] + radius * np.sin(turn)])


def front(ax: Axes) -> None:
    """Draw the bearing seen against z: angles, load, drive, a defect."""
    plain(ax, "seen from +z")
    for radius, colour in ((1.3, STEEL), (1.13, "white"), (0.77, STEEL), (0.5, "white")):
        ax.add_patch(Circle((0, 0), radius, fc=colour, ec=EDGE))
    for k in range(9):
        at = np.radians(-90.0 + 40.0 * k)
        centre = (0.95 * np.cos(at), 0.95 * np.sin(at))
        ax.add_patch(Circle(centre, 0.17, fc=BALL, ec=EDGE))
        ax.text(*centre, str(k), ha="center", va="center", fontsize=8)
    arrow(ax, (0, 0), (1.62, 0), EDGE, "x", beside=(0.08, 0))
    arrow(ax, (0, 0), (0, 1.62), EDGE, "y", beside=(0, 0.09))
    ax.add_patch(Circle((0, 0), 0.05, fc="white", ec=EDGE))
    ax.add_patch(Circle((0, 0), 0.015, fc=EDGE))
    ax.text(-0.12, 0.09, "z", color=EDGE)
    ax.add_patch(Arc((0, 0), 0.7, 0.7, theta1=0, theta2=50, color=BLUE, lw=1.6))
    arrow(ax, (0.245, 0.25), (0.2, 0.29), BLUE)
    ax.text(0.35, 0.2, "φ", color=BLUE)
    arrow(ax, (0, 0), (0, -0.45), RED)
    ax.plot([0.02, 1.25], [-0.3, -1.2], color=RED, lw=0.8)
    ax.text(1.28, -1.22, "radial load\nalong −y", color=RED, va="center")
    ax.add_patch(
        Polygon(np.vstack([arc((0, 0), 1.13, -94, -86), arc((0, 0), 1.2, -86, -94)]), fc=RED)
    )
    note(ax, "defect at φ = −90° (−π/2)", (0, -1.2), (0.15, -1.6), RED)
    turn = arc((0, 0), 0.63, 110, 160)
    ax.plot(*turn.T, color=BLUE, lw=1.6)
    arrow(ax, tuple(turn[-6]), tuple(turn[-1]), BLUE)
    ax.text(-0.98, 1.25, "inner ring turns\nwith Ω > 0", color=BLUE, ha="right")
    ax.plot([-0.97, -0.5], [1.2, 0.42], color=BLUE, lw=0.8)
    ax.set_xlim(-2.1, 1.85)
    ax.set_ylim(-1.8, 1.85)


def row(ax: Axes, z: float, side: int, name: str) -> None:
    """Draw one ball between its grooves, with its contact line."""
    ball, conformity, alpha = 0.5, 1.24, np.radians(28.0)
    normal = np.array([side * np.sin(alpha), np.cos(alpha)])
    for sign in (1, -1):
        centre = np.array([z, 2.0]) - sign * (conformity - 1.0) * ball * normal
        middle = np.degrees(np.arctan2(sign * normal[1], sign * normal[0]))
        groove = arc(tuple(centre), conformity * ball, middle - 52, middle + 52)
        top = 3.0 if sign > 0 else 1.0
        body = np.vstack([groove, [[groove[-1, 0], top], [groove[0, 0], top]]])
        ax.add_patch(Polygon(body, fc=STEEL, ec=EDGE, lw=0.8))
    ax.add_patch(Circle((z, 2.0), ball, fc=BALL, ec=EDGE))
    ends = np.array([[z, 2.0]]) + np.array([[-1.75], [1.55]]) * ball * normal
    ax.plot(*ends.T, color=BLUE, lw=1.6)
    ax.plot([z, z], [1.75, 3.35], color=EDGE, lw=0.7, ls="--")
    ax.text(z, 3.42, f"{name}\nside = {side:+d}", ha="center", va="bottom")
    turn = sorted([90.0, 90.0 - side * 28.0])
    ax.plot(*arc((z, 2.0), 0.36, *turn).T, color=BLUE, lw=1.2)
    ax.text(z + side * 0.13, 2.22, "α", color=BLUE, ha="center")


def section(ax: Axes) -> None:
    """Draw two rows cut along the axis: sides, contact angles, thrust."""
    plain(ax, "cut along the axis, upper half")
    row(ax, -0.9, 1, "rows[0]")
    row(ax, 0.9, -1, "rows[1]")
    ax.text(0.0, 2.85, "outer ring", ha="center", color=EDGE)
    ax.text(0.0, 1.1, "inner ring", ha="center", color=EDGE)
    arrow(ax, (-1.9, 0.2), (2.05, 0.2), EDGE, "z", beside=(0.1, 0))
    ax.plot([0, 0], [0.1, 0.3], color=EDGE)
    ax.text(0, -0.05, "z = 0", ha="center", color=EDGE)
    for z, name in ((-0.9, "axial_position < 0"), (0.9, "axial_position > 0")):
        ax.plot([z, z], [0.1, 0.3], color=EDGE)
        ax.text(z, -0.05, name, ha="center", color=EDGE, fontsize=8.5)
    arrow(ax, (-0.45, 0.62), (0.45, 0.62), RED)
    ax.text(
        0,
        0.74,
        "axial load > 0 on the inner ring loads rows[0]",
        color=RED,
        ha="center",
        fontsize=9.5,
    )
    arrow(ax, (1.85, 0.2), (1.85, 2.0), EDGE, both=True)
    ax.text(1.92, 1.1, "pitch_diameter / 2", color=EDGE, rotation=90, va="center", fontsize=8.5)
    ax.plot([0.9, 1.9], [2.0, 2.0], color=EDGE, lw=0.6)
    ax.set_xlim(-2.1, 2.3)
    ax.set_ylim(-0.3, 4.0)


def slices(ax: Axes) -> None:
    """Draw a ball in a groove, cut into slices: what a slice's numbers are."""
    plain(ax, "a ball is cut along z into slices")
    ball, groove, sunk, alpha = 1.0, 1.3, 0.09, np.radians(24.0)
    centre = (ball - sunk - groove) * np.array([np.sin(alpha), np.cos(alpha)])
    line = arc(tuple(centre), groove, 22, 112)
    body = Polygon(
        np.vstack([line, [[line[-1, 0], 1.65], [line[0, 0], 1.65]]]), fc=STEEL, ec="none"
    )
    ax.add_patch(body)
    ax.add_patch(Circle((0, 0), ball, fc=BALL, ec=EDGE))
    # Where the ball would lie within the ring: what the slices are pressed in by.
    pressed = Circle((0, 0), ball, fc=RED, alpha=0.3, ec="none")
    ax.add_patch(pressed)
    pressed.set_clip_path(body)
    ax.plot(*line.T, color=EDGE)
    note(ax, "pressed in by $s_k$", (0.6, 0.76), (1.25, 0.35), RED)
    places = -1 + (np.arange(16) + 0.5) / 8.0
    for place in places:
        high = np.sqrt(1 - place**2)
        ax.plot([place, place], [-high, high], color=EDGE, lw=0.4)
    z = places[11]
    rho = np.sqrt(1 - z**2)
    ax.add_patch(
        Polygon(
            [[z - 0.0625, 0], [z + 0.0625, 0], [z + 0.0625, rho], [z - 0.0625, rho]],
            fc=BLUE,
            alpha=0.25,
        )
    )
    ax.plot([0, z], [0, rho], color=BLUE, lw=1.2)
    ax.plot([0, 0], [0, 1.0], color=EDGE, lw=0.8, ls="--")
    ax.plot(*arc((0, 0), 0.5, np.degrees(np.arctan2(rho, z)), 90).T, color=BLUE, lw=1.2)
    ax.text(0.12, 0.56, r"$α_k$", color=BLUE)
    arrow(ax, (0, -0.12), (z, -0.12), BLUE, r"$ζ_k$", beside=(0.12, 0))
    ax.text(z + 0.09, 0.35, r"$ρ_k$", color=BLUE)
    arrow(ax, (z, rho + 0.6), (z, rho), RED)
    ax.text(z - 0.04, rho + 0.55, r"$F_{r,k}$", color=RED, ha="right")
    arrow(ax, (z + 0.6 * z / rho, rho), (z, rho), RED)
    ax.text(1.25, rho, r"$F_{a,k} = F_{r,k}\,\tan α_k$", color=RED, va="center")
    ax.text(-0.5, 1.4, "outer ring", color=EDGE)
    ax.text(-0.45, -0.55, "ball", color=EDGE)
    ax.set_xlim(-1.1, 2.3)
    ax.set_ylim(-1.1, 1.7)


def edges(ax: Axes) -> None:
    """Draw a ball over a defect of the outer race: the race is absent, circles stand at the edges."""
    plain(ax, "a defect of the outer race, seen from +z")
    race, half, edge, ball = 4.0, 13.0, 0.32, 1.05
    for first, last in ((-128, -90 - half), (-90 + half, -52)):
        inner, outer = arc((0, 0), race, first, last), arc((0, 0), race + 0.9, last, first)
        ax.add_patch(Polygon(np.vstack([inner, outer]), fc=STEEL, ec="none"))
        ax.plot(*inner.T, color=EDGE)
    floor = np.vstack(
        [
            arc((0, 0), race + 0.62, -90 - half, -90 + half),
            arc((0, 0), race + 0.9, -90 + half, -90 - half),
        ]
    )
    ax.add_patch(Polygon(floor, fc=STEEL, ec="none"))
    centre = (0.0, -race + ball - 0.17)
    for at in (-90 - half, -90 + half):
        place = (race + edge) * np.array([np.cos(np.radians(at)), np.sin(np.radians(at))])
        ax.add_patch(Circle(tuple(place), edge, fc="white", ec=RED, lw=1.6))
        ax.plot([centre[0], place[0]], [centre[1], place[1]], color=RED, lw=0.9, ls="--")
    ax.add_patch(Circle(centre, ball, fc=BALL, ec=EDGE, alpha=0.85))
    ax.plot(*centre, "o", color=EDGE, ms=3)
    ax.text(centre[0], centre[1] + 0.2, "ball", ha="center")
    ax.plot(*arc((0, 0), race, -90 - half, -90 + half).T, color=BLUE, lw=1.2, ls=":")
    note(ax, "width w, along the race", (0.35, -race - 0.0), (1.35, -3.0), BLUE)
    note(
        ax,
        "edge_radius: circles of radius $R_f$\ntouch the race at the defect's ends",
        (-1.0, -4.45),
        (-2.9, -5.6),
        RED,
    )
    ax.text(0, -4.42, "absent", ha="center", color=EDGE, fontsize=9)
    ax.set_xlim(-3.2, 3.2)
    ax.set_ylim(-5.8, -1.7)


def place(ax: Axes) -> None:
    """Draw where a defect has to lie along the axis: under the contact, not under the ball's middle."""
    plain(ax, "the same, cut along the axis")
    ball, groove, alpha = 1.0, 1.35, np.radians(28.0)
    normal = np.array([np.sin(alpha), -np.cos(alpha)])
    centre = -(groove - ball) * normal
    line = arc(tuple(centre), groove, -122, -22)
    ax.add_patch(
        Polygon(np.vstack([line, [[line[-1, 0], -1.6], [line[0, 0], -1.6]]]), fc=STEEL, ec="none")
    )
    ax.plot(*line.T, color=EDGE)
    ax.add_patch(Circle((0, 0), ball, fc=BALL, ec=EDGE))
    ax.plot([0, 1.22 * normal[0]], [0, 1.22 * normal[1]], color=BLUE, lw=1.4)
    ax.plot([0, 0], [0.25, -1.75], color=EDGE, lw=0.8, ls="--")
    ax.plot(*arc((0, 0), 0.55, -90, -62).T, color=BLUE, lw=1.2)
    ax.text(0.15, -0.68, "α", color=BLUE, ha="center")
    for at, colour in ((-62.0, RED), (-83.0, "#8a8f94")):
        from_to = (at - 6, at + 6)
        ring = np.vstack(
            [
                arc(tuple(centre), groove, *from_to),
                arc(tuple(centre), groove + 0.1, *reversed(from_to)),
            ]
        )
        ax.add_patch(Polygon(ring, fc=colour))
    reach = groove * normal[0] + centre[0]
    arrow(ax, (0, -1.7), (reach, -1.7), RED, both=True)
    ax.text(reach + 0.06, -1.72, "axial_offset", color=RED, va="center")
    ax.text(0.66, -1.3, "here the ball\nmeets it", color=RED, ha="left", va="center", fontsize=9)
    ax.text(-0.22, -1.36, "here it\ndoes not", color="#6a7076", ha="right", va="center", fontsize=9)
    ax.text(0, 0.32, "the row's plane", ha="center", color=EDGE, fontsize=9)
    ax.text(0, 0.62, "ball", ha="center", color=EDGE)
    ax.set_xlim(-1.4, 1.75)
    ax.set_ylim(-1.95, 1.1)


@functools.cache
def spalled() -> br.Signals:
    """Run the README's bearing."""
    scene = br.bearing(
        "6205", radial_load=1500.0, speed_rpm=1797.0,
        defects=br.defects.spall(on="inner_race", width_mm=1.0),
    )  # fmt: skip
    return br.simulate(scene, duration=1.0)


def damaged(ax: Axes) -> None:
    """Draw what is simulated: a loaded bearing with a spall on its inner ring."""
    plain(ax, "a bearing, its load, its damage")
    for radius, colour in ((1.3, STEEL), (1.13, "white"), (0.77, STEEL), (0.5, "white")):
        ax.add_patch(Circle((0, 0), radius, fc=colour, ec=EDGE))
    for at in np.radians(-90.0 + 40.0 * np.arange(9)):
        ax.add_patch(Circle((0.95 * np.cos(at), 0.95 * np.sin(at)), 0.17, fc=BALL, ec=EDGE))
    spall = np.vstack([arc((0, 0), 0.78, 205, 218), arc((0, 0), 0.7, 218, 205)])
    ax.add_patch(Polygon(spall, fc=RED))
    arrow(ax, (0, 0.4), (0, -0.4), RED)
    turn = arc((0, 0), 0.63, 20, 70)
    ax.plot(*turn.T, color=BLUE, lw=1.6)
    arrow(ax, tuple(turn[-6]), tuple(turn[-1]), BLUE)


def blows(ax: Axes) -> None:
    """Draw the first turns of its acceleration."""
    out = spalled()
    shown = out.t < 0.12
    ax.plot(1e3 * out.t[shown], out["housing.sensor.ay"][shown], color=EDGE, lw=0.6)
    ax.margins(x=0.0)
    labelled(ax, "what a sensor records", "time [ms]", "acceleration [m/s²]")
    highest = np.abs(out["housing.sensor.ay"][shown]).max()
    ax.set_ylim(-highest, highest)


def named(ax: Axes) -> None:
    """Draw its envelope spectrum under a heading."""
    spectrum(ax, sidebands=False)
    ax.set_title("what it says: the inner race", fontsize=11)


def spectrum(ax: Axes, *, sidebands: bool = True) -> None:
    """Draw the envelope spectrum of a simulated bearing, its lines named."""
    out = spalled()
    rates = br.fault_frequencies(out.scene)
    f, value = br.spectra.squared_envelope_spectrum(out)
    shown = (f > 3.0) & (f < 420.0)
    ax.plot(f[shown], value[shown], color=EDGE, lw=0.9)
    lines = {"$f_r$": rates.shaft, "BPFI": rates.bpfi, "2 BPFI": 2.0 * rates.bpfi}
    if sidebands:
        lines["BPFI − $f_r$"] = rates.bpfi - rates.shaft
        lines["BPFI + $f_r$"] = rates.bpfi + rates.shaft
    for name, at in lines.items():
        height = value[np.abs(f - at) < 3.0].max()
        ax.text(
            at,
            height + 0.02 * value[shown].max(),
            name,
            color=RED,
            ha="center",
            va="bottom",
            fontsize=9,
        )
    ax.margins(x=0.0)
    labelled(ax, "", "frequency [Hz]", "squared envelope of\nhousing.sensor.ay [(m/s²)²]")


def approaches(ax: Axes) -> None:
    """Draw the load of the heaviest contact of a 6205 over its approach, by both elastic laws."""
    for law, colour in (("hertz", BLUE), (br.scene.Iso16281(), RED)):
        scene = br.presets.deep_groove_6205().replace({"contact.law": law})
        found = [
            br.equilibrium(scene.replace({"loads.radial.force": load}))
            for load in np.linspace(20.0, 4000.0, 30)
        ]
        approach = [1e6 * eq.outer_deflection.max() for eq in found]
        ax.plot(approach, [eq.outer_load.max() for eq in found], color=colour)
        name = "Hertz" if law == "hertz" else "iso16281"
        ax.text(approach[-1], found[-1].outer_load.max(), f"{name} ", color=colour, ha="right")
    labelled(ax, "outer race of a 6205", "approach [µm]", "normal force [N]")


def frictions(ax: Axes) -> None:
    """Draw friction over normal force against the slip speed, law by law."""
    slip, fading = np.linspace(0.0, 1.0, 400), 0.02
    smooth = slip / np.hypot(slip, fading)
    laws = {
        "coulomb": np.full_like(slip, 0.05),
        "stribeck": 0.035 + 0.05 * np.exp(-((slip / 0.2) ** 2)),
        "traction": (-0.03 + 0.25 * slip) * np.exp(-3.0 * slip) + 0.03,
    }
    for (name, value), colour in zip(laws.items(), (EDGE, RED, BLUE), strict=True):
        ax.plot(slip, smooth * value, color=colour)
        ax.text(1.02, value[-1], name, color=colour, va="center")
    ax.set_xlim(0.0, 1.0)
    labelled(ax, "friction, $v_s$ = 0.02 m/s", "slip speed u [m/s]", "μ u / √(u² + $v_s$²)")


def films(ax: Axes) -> None:
    """Draw the film on the outer race of a 6205 against the temperature of its oil."""
    for name, colour in (("vg32", BLUE), ("vg68", EDGE), ("vg100", RED)):
        degrees = np.linspace(40.0, 110.0, 15)
        scenes = [
            br.presets.deep_groove_6205(lubricant=name, temperature_c=float(t)) for t in degrees
        ]
        film = [1e6 * br.equilibrium(scene).films[0].film for scene in scenes]
        ax.plot(degrees, film, color=colour)
        ax.text(degrees[0], film[0], f"{name} ", color=colour, ha="right", va="center")
    labelled(ax, "film of a 6205 at 1800 1/min", "temperature [°C]", "central film [µm]")
    ax.set_xlim(25.0, None)


def cages(ax: Axes) -> None:
    """Draw how fast the cage of a fast angular contact bearing goes round over its thrust, dry and in oil."""
    thrusts = np.geomspace(5.0, 8000.0, 33)
    row = br.bearing("7208B", speed_rpm=10_000.0).rows[0]
    gamma = row.ball_diameter * np.cos(row.contact_angle) / row.pitch_diameter
    orbit = 0.5 * (1.0 - gamma) * 10_000.0 * np.pi / 30.0
    mass = 7850.0 * np.pi / 6.0 * row.ball_diameter**3
    ten = 10.0 * row.ball_count * mass * orbit**2 * row.pitch_diameter / 2.0
    for oil, colour in ((None, RED), ("vg68", BLUE)):
        more = {} if oil is None else {"lubricant": oil, "temperature_c": 70.0}
        made = (
            br.bearing("7208B", radial_load=0.0, axial_load=f, speed_rpm=10_000.0, **more)
            for f in thrusts
        )
        found = [br.fault_frequencies(scene.replace({"spin": "free"})).orders.ftf for scene in made]
        ax.plot(thrusts, found, color=colour, label="dry" if oil is None else "oil, VG 68 at 70 °C")
    ax.axhline(0.5 * (1.0 - gamma), color=EDGE, lw=0.8)
    ax.text(5.0, 0.5 * (1.0 - gamma), "rolling", color=EDGE, va="bottom")
    ax.axvline(ten, color=EDGE, ls="--", lw=0.8)
    ax.text(ten, 0.05, "ten centrifugal forces a ball ", color=EDGE, ha="right")
    ax.set_xscale("log")
    ax.legend(frameon=False)
    labelled(ax, "7208B at 10 000 1/min", "thrust [N]", "turns of the cage a turn")


def reliability(ax: Axes) -> None:
    """Draw shares of damaged parts over the chances by the fit, of bearings that the fit did not see."""
    from verdict_fit import damaged, judged, ratios, regression

    rows = judged()
    chances, true = [], []
    for part in ACCUSED:
        for bearing in np.unique(rows["bearing"]):
            own = rows[rows["bearing"] == bearing]
            model = regression(part, True, bearing)
            odds = model["prior"] / ratios(model, numbers_of(part, own, True))
            chances += (odds / (1.0 + odds)).tolist()
            true += damaged(own, part).tolist()
    chance, known = np.array(chances), np.array(true)
    ax.plot([0, 1], [0, 1], color=EDGE, lw=0.8, ls="--")
    edges = [0.0, 0.05, 0.2, 0.4, 0.6, 0.8, 0.95, 1.0]
    for low, high in pairwise(edges):
        among = (chance >= low) & (chance <= high)
        share, count = known[among].mean(), np.count_nonzero(among)
        error = np.sqrt(max(share * (1.0 - share), 0.25 / count) / count)
        ax.errorbar(chance[among].mean(), share, error, color=BLUE, marker="o", capsize=3)
        ax.text(chance[among].mean() + 0.03, share - 0.02, str(count), fontsize=8, va="top")
    labelled(ax, "chance of damage, counts beside", "told", "damaged")


def widths(ax: Axes) -> None:
    """Draw widths of simulated spalls over the spacing of the events of a pass, with the 90 % intervals."""
    from verdict_fit import bridged, library

    rows = library()
    rows = rows[are_clear(rows)]
    for part, colour, marker in (("outer_race", RED, "v"), ("inner_race", BLUE, "s")):
        own = rows[rows["part"] == part]
        ax.plot(
            own["spacing"], own["width"], marker, color=colour, ms=3, label=part.replace("_", " ")
        )
        span = np.array([0.05, 0.45])
        low, _, high = bridged(part)
        ax.fill_between(span, span + low, span + high, color=colour, alpha=0.15, lw=0)
    ax.legend(frameon=False)
    labelled(ax, "spalls, lengths in ball diameters", "arc between the two events", "width")


def labelled(ax: Axes, title: str, x: str, y: str) -> None:
    """Say what a diagram shows."""
    ax.set_title(title, fontsize=11)
    ax.set_xlabel(x)
    ax.set_ylabel(y)
    ax.set_ylim(0.0, None)
    ax.spines[["top", "right"]].set_visible(False)


def save(name: str, width: float, height: float, *panels: Callable[[Axes], None]) -> None:
    """Draw panels side by side into a file."""
    figure, axes = plt.subplots(
        1, len(panels), figsize=(width, height), squeeze=False, layout="constrained"
    )
    for panel, ax in zip(panels, axes[0], strict=True):
        panel(ax)
    figure.savefig(HERE / f"{name}.svg", metadata={"Date": None})
    plt.close(figure)


if __name__ == "__main__":
    save("project", 12.0, 3.3, damaged, blows, named)
    save("bearing", 10.5, 5.0, front, section)
    save("slices", 6.0, 4.6, slices)
    save("spectrum", 8.0, 3.0, spectrum)
    save("laws", 11.0, 3.4, approaches, frictions, films)
    save("cages", 7.0, 3.6, cages)
    save("size", 9.0, 3.6, reliability, widths)
    save("defect", 10.0, 4.4, edges, place)
