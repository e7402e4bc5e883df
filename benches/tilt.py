"""What tilting rings and freely spinning balls do: each beside what is known.

``python benches/tilt.py -o FOLDER`` (extra ``bench``) writes a table and a picture for each of them, as
``tilt_orbit.csv`` and ``.svg``; ``--only orbit whirl`` makes these alone.

- orbit: of the ball of a 218, and the axis of its spin, over speed, beside Jones' and Harris' control by a race;
- torque: of an angular-contact and of a deep-groove bearing under thrust, with axial and with free spin, beside
  Palmgren's and SKF's load torque, and over the slip speed of friction;
- pivoting: how the races share it, over load, and with the conformities exchanged;
- wheel: the wheel bearing's load at the bearing's centre and at the tyre, and what a spall on its outer race says;
- whirl: of a rotor on a tilt spring, and precession of a free one, over speed;
- tumble: a small cap on a ball whose axis is held, and on one that spins freely;
- cost: of a simulated second with axial and free spin, parallel and tilting rings.
"""

from __future__ import annotations

import itertools
import math
import warnings
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import polars as pl
from scipy.special import ellipe

import ballrace as br
import studies
from ballrace.paper.simulations import FS as FS_OF_PAPER
from ballrace.paper.simulations import dynamic
from ballrace.plot.ellipse import axis_ratio
from ballrace.scene import (
    Coulomb,
    Defect,
    Lubricant,
    Moment,
    MotionProbe,
    Ramp,
    Ring,
    Row,
    Scene,
    SpeedDrive,
    Spin,
    Spring,
    Support,
    TorqueProbe,
)
from one_ball import EXPLICIT, RACES, ball_of_218, spun
from studies import Study, cost_of, draw_costs

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

SPINS: tuple[Spin, ...] = ("axial", "free")
COLOURS = {"free": "#0b6e99", "axial": "#d1495b", "grey": "#9aa5b1"}


def tick(axes: Axes, values: pl.Series) -> None:
    """Mark the values themselves on a logarithmic axis."""
    axes.set_xticks(values, [f"{value:g}" for value in values])
    axes.minorticks_off()


# Orbit and spin


THRUST = 17_800.0


def orbit() -> pl.DataFrame:
    """Return orbit speeds over the inner ring's and pitch angles [degrees] over speed."""
    rows = []
    for rpm in (1000.0, 2000.0, 4000.0, 6000.0, 8000.0, 10_000.0, 12_000.0):
        free, axial = (
            spun(ball_of_218(THRUST, rpm * math.pi / 30.0, spin=spin), 0.06)
            for spin in ("free", "axial")
        )
        for name, found in (
            ("free", free), ("axial", axial),
            ("outer control", free.controlled_by("outer")), ("inner control", free.controlled_by("inner")),
        ):  # fmt: skip
            outer, inner = found.pivoting
            rows.append({
                "rpm": rpm, "ball": name, "orbit": found.orbit, "pitch": math.degrees(found.pitch),
                "outer_pivoting": outer, "inner_pivoting": inner,
                "outer_angle": math.degrees(found.angles[0]), "inner_angle": math.degrees(found.angles[1]),
            })  # fmt: skip
    return pl.DataFrame(rows)


def draw_orbit(table: pl.DataFrame, figure: Figure) -> None:
    """Draw orbit and pitch angle."""
    looks = {
        "free": ("o-", COLOURS["free"], "free spin"),
        "axial": ("s--", COLOURS["axial"], "axial spin"),
        "outer control": (":", "black", "control by the outer race"),
        "inner control": ("-.", "black", "control by the inner race"),
    }
    for axes, column, label in zip(
        figure.subplots(1, 2), ("orbit", "pitch"),
        ("orbit over the inner ring's speed", "pitch angle of the spin, degrees"), strict=True,
    ):  # fmt: skip
        for name, (mark, colour, words) in looks.items():
            own = table.filter(pl.col("ball") == name)
            axes.plot(own["rpm"], own[column], mark, color=colour, label=words)
        axes.set(xlabel="speed, 1/min", ylabel=label)
    figure.axes[0].legend(frameon=False)


# Friction torque


RPM, SLIP_SPEED = 1000.0, 0.01


def torque_of(name: str, thrust: float, spin: Spin, slip_speed: float = SLIP_SPEED) -> float:
    """Return the friction torque of a dry bearing of the catalogue under thrust [N mm]."""
    scene = br.bearing(name, radial_load=0.0, axial_load=thrust, speed_rpm=RPM)
    out = br.simulate(
        replace(
            scene, spin=spin, gravity=(0.0, 0.0, 0.0), probes={"torque": TorqueProbe()},
            friction=Coulomb(coefficient=0.05, slip_speed=slip_speed), solver=EXPLICIT,
        ),
        duration=0.01, settle=0.0, rtol=1e-9,
    )  # fmt: skip
    return -1e3 * float(out["torque.inner"][out.t >= 0.008].mean())


def palmgren(name: str, thrust: float) -> float:
    """Return Palmgren's load torque, with f₁ and P₁ of Harris' tables for both kinds of bearing [N mm]."""
    made = br.catalogue[name]
    if made.kind == "angular_contact":
        f_1 = 0.001 * (0.26 * thrust / made.static_rating) ** 0.33
        load = 0.9 * thrust / math.tan(made.contact_angle)
    else:
        f_1 = 0.0005 * (0.5 * thrust / made.static_rating) ** 0.55
        load = 3.0 * thrust
    found = br.friction_torque_palmgren(
        pitch_diameter=made.pitch_diameter, speed_rpm=RPM, viscosity=35e-6, load=load, f_0=0.0, f_1=f_1,
    )  # fmt: skip
    return 1e3 * found.sliding


def skf(name: str, thrust: float) -> float | None:
    """Return SKF's sliding torque with a full film [N mm]; its constants here are of deep-groove bearings."""
    made = br.catalogue[name]
    if made.kind != "deep_groove":
        return None
    found = br.friction_torque_skf(
        "62", bore=made.bore, outside_diameter=made.outside_diameter, speed_rpm=RPM, viscosity=1e-3,
        radial_load=0.0, axial_load=thrust, static_rating=made.static_rating,
    )  # fmt: skip
    return 1e3 * found.sliding


def torque() -> pl.DataFrame:
    """Return friction torques over thrust, and of one thrust over the slip speed [N mm]."""
    loads = (125.0, 250.0, 500.0, 1000.0, 2000.0)
    cases = [(name, load, SLIP_SPEED, "thrust") for name in ("7205B", "6205") for load in loads]
    cases += [("7205B", 2000.0, slip, "slip speed") for slip in (0.003, 0.01, 0.03, 0.1)]
    return pl.DataFrame([{
        "over": over, "bearing": name, "thrust": load, "slip_speed": slip,
        **{spin: torque_of(name, load, spin, slip) for spin in SPINS},
        "palmgren": palmgren(name, load), "skf": skf(name, load),
    } for name, load, slip, over in cases])  # fmt: skip


def draw_torque(table: pl.DataFrame, figure: Figure) -> None:
    """Draw both bearings over thrust, and one over the slip speed."""
    panels = (
        ("7205B", "thrust", "thrust", "thrust on a 7205B, N"),
        ("6205", "thrust", "thrust", "thrust on a 6205, N"),
        ("7205B", "slip speed", "slip_speed", "slip speed of friction, m/s"),
    )
    for axes, (name, over, column, label) in zip(
        figure.subplots(1, 3, sharey=True), panels, strict=True
    ):
        own = table.filter(pl.col("bearing") == name, pl.col("over") == over)
        axes.plot(own[column], own["axial"], "s--", color=COLOURS["axial"], label="axial spin")
        axes.plot(own[column], own["free"], "o-", color=COLOURS["free"], label="free spin")
        axes.plot(own[column], own["palmgren"], "k:", label="Palmgren, of the load")
        if own["skf"].null_count() == 0:
            axes.plot(own[column], own["skf"], "k-.", label="SKF, sliding")
        axes.set(xscale="log", yscale="log", xlabel=label)
        tick(axes, own[column])
    figure.axes[0].set_ylabel("friction torque, N mm")
    figure.axes[1].legend(frameon=False, fontsize=8)


# Shares of pivoting


PAIRS = {
    "f_o 0.55, f_i 0.515": (0.55, 0.515),
    "equal": (0.5232, 0.5232),
    "exchanged": (0.515, 0.55),
}


def pivoting() -> pl.DataFrame:
    """Return both pivoting rates over the ring's speed, over thrust and conformities, at 100 rad/s."""
    rows = []
    loads = (4000.0, 8000.0, 16_000.0, 32_000.0, 64_000.0)
    for (name, pair), thrust in itertools.product(PAIRS.items(), loads):
        scene = ball_of_218(thrust, 100.0, conformities=pair, slip_speed=SLIP_SPEED)
        found = spun(scene, 0.08)
        outer, inner = (abs(rate) for rate in found.pivoting)
        grips = [
            Q * a * float(ellipe(1.0 - axis_ratio(scene.rows[0], race) ** -2))
            for Q, a, race in zip(found.loads, found.lengths, RACES, strict=True)
        ]
        rows.append({
            "pair": name, "thrust": thrust, "outer": outer, "inner": inner,
            "inner_share": inner / (outer + inner), "inner_grip": grips[1] / sum(grips),
        })  # fmt: skip
    return pl.DataFrame(rows)


def draw_pivoting(table: pl.DataFrame, figure: Figure) -> None:
    """Draw the inner race's share, and what control by a race would have it be."""
    left, right = figure.subplots(1, 2)
    marks = dict(zip(PAIRS, (("o-", "free"), ("^-", "grey"), ("s-", "axial")), strict=True))
    for name, (mark, colour) in marks.items():
        own = table.filter(pl.col("pair") == name)
        left.plot(own["thrust"], own["inner_share"], mark, color=COLOURS[colour], label=name)
        right.plot(own["inner_grip"], own["inner_share"], mark[0], color=COLOURS[colour])
    right.plot([0.0, 0.5, 0.5, 1.0], [1.0, 1.0, 0.0, 0.0], "k:", label="race control")
    for axes in (left, right):
        axes.set(ylim=(-0.05, 1.05), ylabel="the inner race's share of pivoting")
        axes.legend(frameon=False)
    left.set(xscale="log", xlabel="thrust, N")
    tick(left, own["thrust"])
    right.set(xlabel="the inner race's share of Q a ℰ")


# The wheel bearing


def wheel() -> pl.DataFrame:
    """Return tilt, moment, loads, and the spall's signature, with the load at the centre and at the tyre."""
    axial = 3000.0
    cases = [
        ("at the centre", force / 1e3, br.presets.wheel_bearing(force))
        for force in (-axial, 0.0, axial)
    ]
    cases += [
        ("at the tyre", 7.0 * lateral, br.presets.cornering_wheel(lateral))
        for lateral in (-0.6, -0.3, 0.3, axial / 7000.0, 0.6)
    ]
    probes = {
        "outer": MotionProbe(body="outer", components=("ay",)),
        "ball": MotionProbe(body="row0.ball0", components=("x", "y")),
    }
    rows = []
    for where, side_force, scene in cases:
        still = br.equilibrium(scene)
        out = br.simulate(
            replace(scene, probes=probes, solver=EXPLICIT), duration=0.2, fs=FS_OF_PAPER, settle=0.0,
            bandwidth=None,
        )  # fmt: skip
        found = dynamic(out)
        faulty = (still.row == 0) & (np.abs(still.angle + 0.5 * math.pi) < 0.3)
        rows.append({
            "load": where, "side_force": side_force, "tilt": 1e3 * still.inner_tilt[0],
            "moment": still.inner_moment[0], "largest": still.inner_load.max(),
            "over_spall": still.outer_load[faulty].max(), "line": found.line, "impact": found.impact,
            "wall_time": out.stats.wall_time,
        })  # fmt: skip
    return pl.DataFrame(rows)


def draw_wheel(table: pl.DataFrame, figure: Figure) -> None:
    """Draw bars, a panel a number."""
    labels = {
        "moment": "moment of the hold, N m",
        "tilt": "tilt, mrad",
        "over_spall": "ball load at the spall, N",
        "line": "envelope line, m/s²",
    }
    colours = {"at the centre": COLOURS["grey"], "at the tyre": COLOURS["free"]}
    for axes, (column, label) in zip(figure.subplots(1, 4), labels.items(), strict=True):
        for where, shift in (("at the centre", -0.15), ("at the tyre", 0.15)):
            own = table.filter(pl.col("load") == where)
            axes.bar(own["side_force"] + shift, own[column], 0.5, color=colours[where], label=where)
        axes.set_xlabel("side force, kN")
        axes.set_title(label, fontsize=10)
    figure.axes[2].legend(frameon=False, fontsize=8)


# Whirl


I_P, I_T, TILT_SPRING = 3.2e-4, 2e-4, 2e4


def rotor(speed: float, stiffness: float) -> Scene:
    """Return a ring, on a tilt spring or free, struck by a moment that ends; its ball runs on the outer race."""
    row = Row(
        ball_count=1, ball_diameter=8e-3, pitch_diameter=40e-3, outer_conformity=0.53, inner_conformity=0.52,
        clearance=1e-4,
    )  # fmt: skip
    mount = Spring(stiffness=stiffness)
    support = Support(x="fixed", y="fixed", z="fixed", tilt_x=mount, tilt_y=mount)
    kick = Ramp(from_=1.0, to=0.0, start=2e-4, end=2e-4)
    return Scene(
        rows=(row,), gravity=(0.0, 0.0, 0.0), drive=SpeedDrive(speed), solver=EXPLICIT,
        inner_ring=Ring(mass=0.5, inertia=I_P, transverse_inertia=I_T, support=support),
        moments={"kick": Moment(ring="inner", direction=(1.0, 0.0, 0.0), moment=kick)},
        probes={"rotor": MotionProbe(body="inner", components=("tilt_x", "tilt_y"))},
    )  # fmt: skip


def two_rates(z: NDArray[np.complex128], dt: float) -> tuple[float, float]:
    """Return the rates of the two circular motions that a complex signal is made of, the lower first [rad/s].

    Prony's method: a sum of two obeys ``z[n + 2] = c z[n + 1] + d z[n]``.
    """
    c, d = np.linalg.lstsq(np.stack([z[1:-1], z[:-2]], axis=1), z[2:], rcond=None)[0]
    low, high = np.sort(np.angle(np.roots([1.0, -c, -d])) / dt).tolist()
    return low, high


def whirl() -> pl.DataFrame:
    """Return whirl and precession rates over speed, beside the closed form [rad/s]."""
    rows = []
    springs = {"tilt spring": TILT_SPRING, "free": 0.0}
    for (name, stiffness), speed in itertools.product(
        springs.items(), np.linspace(0.0, 6000.0, 7).tolist()
    ):
        if speed == stiffness == 0.0:
            continue  # A free ring that does not spin just turns over.
        out = br.simulate(
            rotor(speed, stiffness), duration=0.01, fs=50_000.0, start="rolling", settle=0.0, bandwidth=None,
            rtol=1e-10,
        )  # fmt: skip
        free = out.t > 2.5e-4
        backward, forward = two_rates(
            (out["rotor.tilt_x"] + 1j * out["rotor.tilt_y"])[free], 1.0 / out.fs
        )
        g = I_P * speed / (2.0 * I_T)
        root = math.sqrt(g**2 + stiffness / I_T)
        rows.append({
            "rotor": name, "speed": speed, "forward": forward, "backward": -backward,
            "forward_exact": g + root, "backward_exact": root - g,
        })  # fmt: skip
    return pl.DataFrame(rows)


def draw_whirl(table: pl.DataFrame, figure: Figure) -> None:
    """Draw a Campbell diagram, and the precession of the free rotor."""
    left, right = figure.subplots(1, 2)
    own = table.filter(pl.col("rotor") == "tilt spring")
    for name, colour in (("forward", COLOURS["free"]), ("backward", COLOURS["axial"])):
        left.plot(own["speed"], own[f"{name}_exact"], "k-", lw=0.8)
        left.plot(own["speed"], own[name], "o", color=colour, label=f"{name} whirl")
    left.set(xlabel="speed of the rotor, rad/s", ylabel="whirl on a tilt spring, rad/s")
    left.legend(frameon=False)
    own = table.filter(pl.col("rotor") == "free")
    right.plot(own["speed"], own["forward_exact"], "k-", lw=0.8, label="closed forms")
    right.plot(own["speed"], own["forward"], "o", color=COLOURS["free"], label="precession")
    right.set(xlabel="speed of the rotor, rad/s", ylabel="precession of a free rotor, rad/s")
    right.legend(frameon=False)


TUMBLING = 0.2  # s: six turns of the shaft, three of the cage


def capped(spin: Spin, place: float) -> Scene:
    """Return a loaded 7205B with a cap on ball 0, at an axial place over the ball's radius."""
    bearing = br.bearing("7205B", radial_load=900.0, axial_load=900.0, speed_rpm=1800.0)
    radius = 0.5 * bearing.rows[0].ball_diameter
    cap = Defect(
        on="ball", ball=0, angle=0.0, shape="cap", width=1.2e-3, edge_radius=0.3e-3,
        axial_offset=place * radius,
    )  # fmt: skip
    return bearing.replace({
        "spin": spin, "defects": {"cap": cap}, "friction.coulomb.slip_speed": SLIP_SPEED, "solver": EXPLICIT,
        "probes": {"outer": MotionProbe(body="outer", components=("ay",))},
    })  # fmt: skip


def tumble() -> pl.DataFrame:
    """Return the outer ring's acceleration over time: a cap that lies where contacts run, at the start."""
    # Held to the axis, a ball meets the outer race at a latitude of 40 degrees; one that rolls, at its equator.
    places: dict[Spin, float] = {"axial": math.sin(math.radians(40.0)), "free": 0.0}
    return pl.concat(
        pl.DataFrame({"time": out.t, "spin": spin, "acceleration": out["outer.ay"]})
        for spin, place in places.items()
        for out in [br.simulate(capped(spin, place), duration=TUMBLING, fs=12_800.0)]
    )


def draw_tumble(table: pl.DataFrame, figure: Figure) -> None:
    """Draw both records."""
    upper, lower = figure.subplots(2, 1, sharex=True)
    for axes, spin, name in ((upper, "axial", "axis held"), (lower, "free", "spins freely")):
        own = table.filter(pl.col("spin") == spin)
        axes.plot(own["time"], own["acceleration"], lw=0.5, color=COLOURS[spin])
        axes.set(ylabel="outer ring, m/s²", title=name)
    lower.set(xlabel="time, s")


# Cost


def cost() -> pl.DataFrame:
    """Return what a simulated second costs with axial and with free spin, and with the load at the tyre."""
    thrust = replace(
        br.bearing("7205B", radial_load=0.0, axial_load=2000.0, speed_rpm=RPM), gravity=(0.0, 0.0, 0.0),
        probes={"outer": MotionProbe(body="outer")},
    )  # fmt: skip
    soft = Coulomb(coefficient=0.05, slip_speed=SLIP_SPEED)
    free = replace(thrust, spin="free")
    oiled = free.replace({"lubricant": Lubricant.named("vg68", temperature_c=55.0)})
    return pl.DataFrame([
        cost_of("7205B, axial spin", thrust, 0.05),
        cost_of("free spin", free, 0.05),
        cost_of("free spin, dormand-prince", replace(free, solver=EXPLICIT), 0.05),
        cost_of("free spin, slip speed 0.01 m/s", replace(free, friction=soft), 0.05),
        cost_of("the same, dormand-prince", replace(free, friction=soft, solver=EXPLICIT), 0.02),
        cost_of("free spin in oil", oiled, 0.02),
        cost_of("the same, dormand-prince ", replace(oiled, solver=EXPLICIT), 0.005),
        cost_of("wheel bearing, parallel rings", br.presets.wheel_bearing(2100.0), 0.05),
        cost_of("the load at the tyre", br.presets.cornering_wheel(0.3), 0.05),
    ])  # fmt: skip


STUDIES = {
    "orbit": Study(orbit, draw_orbit),
    "torque": Study(torque, draw_torque),
    "pivoting": Study(pivoting, draw_pivoting),
    "wheel": Study(wheel, draw_wheel),
    "whirl": Study(whirl, draw_whirl),
    "tumble": Study(tumble, draw_tumble),
    "cost": Study(cost, draw_costs),
}

if __name__ == "__main__":
    # A spall that no ball touches is an answer here, and so is a contact beyond the static rating.
    warnings.simplefilter("ignore", br.SceneWarning)
    studies.run("tilt", __doc__, STUDIES)
