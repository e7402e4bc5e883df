"""What oil does to a bearing: torque, films, skid, ringing, and the paper's load cases, each beside what is known.

``python benches/lubrication.py -o FOLDER`` (extra ``bench``) writes a table and a picture for each of them, as
``lubrication_torque.csv`` and ``.svg``; ``--only torque film`` makes these alone.

- torque: of a 6205 over speed and over temperature, beside SKF's model;
- film: thickness and λ over speed and over load, beside Hamrock and Dowson's film without heat and starvation;
- skid: the cage of a light fast bearing, over the oil's temperature;
- ringing: decay after the blows of a spall, dry and with oil, with and without the film's damping;
- paper: the wheel bearing's three load cases, dry and with oil;
- cost: of a simulated second, dry and with oil.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import replace
from typing import TYPE_CHECKING, Literal

import numpy as np
import polars as pl

import ballrace as br
import studies
from ballrace.paper.measures import orbit, passages
from ballrace.paper.simulations import FS as FS_OF_PAPER
from ballrace.paper.simulations import SETTLED, dynamic
from ballrace.plot.ellipse import axis_ratio
from ballrace.scene import Lubricant, MotionProbe, OilLayer, Row
from studies import Study, cost_of, draw_costs

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

OIL = "vg68"
CELSIUS, LOAD, RPM = 55.0, 500.0, 1797.0
SPEEDS = (250.0, 500.0, 1000.0, 1797.0, 3000.0, 6000.0)
LAYERS: tuple[OilLayer, ...] = (1e-5, "flooded")
NAMES = {1e-5: "10 µm of oil in front", "flooded": "flooded"}
COLOURS = {"dry": "#9aa5b1", "oil": "#0b6e99", "oil, no film damping": "#d1495b"}
MAKER = br.catalogue["6205"]
RACES: tuple[Literal["outer", "inner"], ...] = ("outer", "inner")


def bearing(
    celsius: float = CELSIUS, load: float = LOAD, rpm: float = RPM, layer: OilLayer = 1e-5
) -> br.Scene:
    """Return the 6205 with oil, and what is read of it."""
    oil = replace(Lubricant.named(OIL, temperature_c=celsius), oil_layer=layer)
    scene = br.presets.deep_groove_6205(load, 0.0, rpm, lubricant=oil)
    ball = MotionProbe(body="row0.ball0", components=("x", "y"))
    return replace(scene, probes={"oil": br.scene.LubricationProbe(), "ball": ball})


def oil_of(scene: br.Scene) -> Lubricant:
    """Return the oil of a scene that has one."""
    assert scene.lubricant is not None
    return scene.lubricant


# Torque


def torque() -> pl.DataFrame:
    """Return friction torque by parts over speed and temperature, and SKF's [N mm]."""
    over = [("speed", CELSIUS, rpm) for rpm in SPEEDS]
    over += [
        ("temperature", celsius, RPM) for celsius in (20.0, 30.0, 40.0, 55.0, 70.0, 85.0, 100.0)
    ]
    rows = []
    for (kind, celsius, rpm), layer in itertools.product(over, LAYERS):
        scene = bearing(celsius, rpm=rpm, layer=layer)
        out = br.simulate(scene, duration=max(0.1, 180.0 / rpm))
        viscosity = oil_of(scene).properties().kinematic_viscosity
        skf = br.friction_torque_skf(
            "62", bore=MAKER.bore, outside_diameter=MAKER.outside_diameter, speed_rpm=rpm,
            viscosity=viscosity, radial_load=LOAD,
        )  # fmt: skip
        of_power = 1e3 / (rpm * math.pi / 30.0)
        rows.append({
            "over": kind, "celsius": celsius, "rpm": rpm, "layer": str(layer),
            "torque": 1e3 * out["oil.friction_torque"].mean(),
            "slip": of_power * out["oil.slip_power"].mean(),
            "rolling": of_power * out["oil.rolling_power"].mean(),
            "skf": 1e3 * skf.total,
        })  # fmt: skip
    return pl.DataFrame(rows)


def draw_torque(table: pl.DataFrame, figure: Figure) -> None:
    """Draw torque over speed and over temperature."""
    for axes, kind, column, label in zip(
        figure.subplots(1, 2, sharey=True), ("speed", "temperature"), ("rpm", "celsius"),
        ("speed, 1/min", "temperature of the oil, °C"), strict=True,
    ):  # fmt: skip
        part = table.filter(pl.col("over") == kind)
        for layer, mark in zip(LAYERS, ("o-", "s--"), strict=True):
            own = part.filter(pl.col("layer") == str(layer))
            axes.plot(own[column], own["torque"], mark, color=COLOURS["oil"], label=NAMES[layer])
        axes.plot(own[column], own["skf"], "k:", label="SKF's model")
        axes.set_xlabel(label)
    figure.axes[0].set_xscale("log")
    figure.axes[0].set_xticks(SPEEDS, [f"{rpm:g}" for rpm in SPEEDS])
    figure.axes[0].minorticks_off()
    figure.axes[0].set_ylabel("friction torque, N mm")
    figure.axes[0].legend(frameon=False)


# Films


def hamrock_dowson(scene: br.Scene, race: Literal["outer", "inner"], rpm: float) -> float:
    """Return the central film of Hamrock and Dowson (1977) at the row's mean load [m].

    ``h = 2.69 R_x U^0.67 G^0.53 W^-0.067 (1 - 0.61 exp(-0.73 k))``, k the ellipse's axis ratio.
    """
    row, oil = scene.rows[0], oil_of(scene).properties()
    steel = scene.materials.rings
    modulus = steel.youngs_modulus / (1.0 - steel.poisson_ratio**2)
    gamma = row.ball_diameter * math.cos(row.contact_angle) / row.pitch_diameter
    R_x = rolling_radius(row, gamma, race)
    speed = rpm * math.pi / 30.0 * row.pitch_diameter * (1.0 - gamma**2) / 4.0
    loads = getattr(br.equilibrium(replace(scene, lubricant=None, probes={})), f"{race}_load")
    U = oil.viscosity * speed / (modulus * R_x)
    G = oil.pressure_viscosity * modulus
    W = float((loads**2).sum() / loads.sum()) / (modulus * R_x**2)
    shape = 1.0 - 0.61 * math.exp(-0.73 * axis_ratio(row, race))
    return 2.69 * R_x * U**0.67 * G**0.53 * W**-0.067 * shape


def rolling_radius(row: Row, gamma: float, race: Literal["outer", "inner"]) -> float:
    """Return the reduced radius along the rolling direction [m]."""
    half = 0.5 * row.ball_diameter
    return half * (1.0 + gamma) if race == "outer" else half * (1.0 - gamma)


def film() -> pl.DataFrame:
    """Return films and λ of both races over speed and over load, beside Hamrock and Dowson."""
    over = [("speed", LOAD, rpm) for rpm in np.geomspace(100.0, 12_000.0, 10).tolist()]
    over += [("load", load, RPM) for load in np.geomspace(50.0, 5000.0, 8).tolist()]
    rows = []
    for kind, load, rpm in over:
        scene = bearing(load=load, rpm=rpm)
        # The film follows the rings' speed, so any instant has it.
        out = br.simulate(scene, duration=1e-3, settle=0.0)
        rows += [{
            "over": kind, "load": load, "rpm": rpm, "race": race,
            "film": 1e6 * out[f"oil.{race}.film"].mean(),
            "lambda": out[f"oil.{race}.lambda"].mean(),
            "hamrock_dowson": 1e6 * hamrock_dowson(scene, race, rpm),
        } for race in RACES]  # fmt: skip
    return pl.DataFrame(rows)


def draw_film(table: pl.DataFrame, figure: Figure) -> None:
    """Draw films with λ at the right."""
    roughness = 1e6 * oil_of(bearing()).roughness
    for axes, kind, column, label in zip(
        figure.subplots(1, 2, sharey=True), ("speed", "load"), ("rpm", "load"),
        ("speed, 1/min", "radial load, N"), strict=True,
    ):  # fmt: skip
        for race, colour in zip(
            RACES, (COLOURS["oil"], COLOURS["oil, no film damping"]), strict=True
        ):
            own = table.filter(pl.col("over") == kind, pl.col("race") == race)
            axes.plot(own[column], own["film"], "o-", color=colour, label=f"{race} race")
            axes.plot(own[column], own["hamrock_dowson"], ":", color=colour)
        axes.set(xscale="log", yscale="log", xlabel=label)
    right = axes.secondary_yaxis(
        "right", functions=(lambda h: h / roughness, lambda x: x * roughness)
    )
    right.set_ylabel("λ, film over roughness")
    figure.axes[0].set_ylabel("film, µm (dotted: Hamrock and Dowson)")
    figure.axes[0].legend(frameon=False)


# Skid


def skid() -> pl.DataFrame:
    """Return the cage's speed over the kinematic one, under 20 N at 12 000 1/min."""
    rows = []
    for celsius, layer in itertools.product((30.0, 42.5, 55.0, 72.5, 90.0), LAYERS):
        scene = bearing(celsius, 20.0, 12_000.0, layer)
        out = br.simulate(scene, duration=0.1)
        late = out.t >= 0.05
        rate, _ = orbit(out.t[late], out["ball.x"][late], out["ball.y"][late])
        kinematic = br.frequencies.of_row(scene.rows[0]).ftf * 12_000.0 * math.pi / 30.0
        rows.append({"celsius": celsius, "layer": str(layer), "cage": rate / kinematic})
    return pl.DataFrame(rows)


def draw_skid(table: pl.DataFrame, figure: Figure) -> None:
    """Draw the cage's speed over the oil's temperature."""
    axes = figure.subplots()
    for layer, mark in zip(LAYERS, ("o-", "s--"), strict=True):
        own = table.filter(pl.col("layer") == str(layer))
        axes.plot(own["celsius"], own["cage"], mark, color=COLOURS["oil"], label=NAMES[layer])
    axes.axhline(1.0, color="black", lw=0.8)
    axes.set(xlabel="temperature of the oil, °C", ylabel="speed of the cage over the kinematic one")
    axes.legend(frameon=False)


# Ringing


def ringing() -> pl.DataFrame:
    """Return the mean level of the outer ring's squared envelope after the blows of a spall [dB]."""
    spall = br.defects.spall(on="outer_race", width_mm=1.0)
    oiled = replace(bearing(), defects={"spall": spall})
    undamped = replace(oil_of(oiled), damping=False)
    variants = {
        "dry": replace(oiled, lubricant=None),
        "oil": oiled,
        "oil, no film damping": replace(oiled, lubricant=undamped),
    }
    tables = []
    for name, scene in variants.items():
        motion = {
            "outer": MotionProbe(body="outer", components=("ay",)),
            "ball": scene.probes["ball"],
        }
        out = br.simulate(replace(scene, probes=motion), duration=0.5, fs=100_000.0)
        tables.append(pl.DataFrame(after_blows(out)).with_columns(pl.lit(name).alias("variant")))
    return pl.concat(tables)


def after_blows(out: br.Signals, span: float = 4e-3) -> dict[str, NDArray[np.float64]]:
    """Return time since the blow [ms] and the squared envelope averaged over all blows [dB of its peak]."""
    squared = br.spectra.squared_envelope(out["outer.ay"], out.fs, (1000.0, 20_000.0))
    rate, angle = orbit(out.t, out["ball.x"], out["ball.y"])
    count = out.scene.rows[0].ball_count
    edges = passages(out.t, rate, angle, count=count, place=-math.pi / 2.0, after=0.02)
    length = round(span * out.fs)
    blows = [a + int(np.argmax(squared[a:b])) for a, b in itertools.pairwise(edges.tolist())]
    mean = np.mean([squared[k : k + length] for k in blows if k + length <= squared.size], axis=0)
    return {"ms": 1e3 * np.arange(length) / out.fs, "level": 10.0 * np.log10(mean / mean.max())}


def draw_ringing(table: pl.DataFrame, figure: Figure) -> None:
    """Draw the decays."""
    axes = figure.subplots()
    for name in table["variant"].unique(maintain_order=True):
        own = table.filter(pl.col("variant") == name)
        axes.plot(own["ms"], own["level"], color=COLOURS[name], label=name)
    axes.set(xlabel="time since the blow, ms", ylabel="squared envelope, 1 to 20 kHz, dB")
    axes.legend(frameon=False)


# The paper's load cases


def paper() -> pl.DataFrame:
    """Return impacts, line of the envelope and kurtosis of the three load cases, dry and with oil."""
    place = MotionProbe(body="row0.ball0", components=("x", "y"))
    rows = []
    for axial, name in itertools.product((0.0, 3000.0, -3000.0), ("dry", "oil")):
        oil = None if name == "dry" else Lubricant.named(OIL, temperature_c=CELSIUS)
        scene = br.presets.wheel_bearing(axial, lubricant=oil)
        probes = {"outer": MotionProbe(body="outer", components=("ay",)), "ball": place}
        # As the paper computed its own: from its start, point samples.
        out = br.simulate(
            replace(scene, probes=probes), duration=0.2, fs=FS_OF_PAPER, start="rolling",
            settle=0.0, bandwidth=None,
        )  # fmt: skip
        found, x = dynamic(out), out["outer.ay"][out.t >= SETTLED]
        kurtosis = float(np.mean((x - x.mean()) ** 4) / x.var() ** 2)
        rows.append({
            "axial_load": axial, "variant": name, "impact": found.impact, "spread": found.impact_spread,
            "line": found.line, "kurtosis": kurtosis, "wall_time": out.stats.wall_time,
        })  # fmt: skip
    return pl.DataFrame(rows)


def draw_paper(table: pl.DataFrame, figure: Figure) -> None:
    """Draw bars, a panel a feature."""
    labels = {
        "impact": "impact, m/s²",
        "line": "line of the envelope, m/s²",
        "kurtosis": "kurtosis",
    }
    panels: list[Axes] = list(figure.subplots(1, 3))
    for axes, (column, label) in zip(panels, labels.items(), strict=True):
        for shift, name in ((-0.2, "dry"), (0.2, "oil")):
            own = table.filter(pl.col("variant") == name)
            error = own["spread"] if column == "impact" else None
            places = [k + shift for k in range(own.height)]
            axes.bar(places, own[column], 0.38, yerr=error, color=COLOURS[name], label=name)
        axes.set_xticks(range(own.height), [f"{1e-3 * load:+g} kN" for load in own["axial_load"]])
        axes.set_title(label, fontsize=10)
    panels[0].legend(frameon=False)


# Cost


def cost() -> pl.DataFrame:
    """Return what a simulated second costs, dry and with oil, by the default method and another."""
    presets = {
        "wheel bearing": br.presets.wheel_bearing(3000.0),
        "6205": br.presets.deep_groove_6205(LOAD, 0.0, RPM),
    }
    cases = []
    for name, dry in presets.items():
        oiled = dry.replace({"lubricant": Lubricant.named(OIL, temperature_c=CELSIUS)})
        cases += [
            (f"{name}, dry", dry),
            (f"{name}, oil", oiled),
            (f"{name}, oil, dormand-prince", oiled.replace({"solver.method": "dormand-prince"})),
        ]
    return pl.DataFrame([cost_of(case, scene, 0.05) for case, scene in cases])


STUDIES = {
    "torque": Study(torque, draw_torque),
    "film": Study(film, draw_film),
    "skid": Study(skid, draw_skid),
    "ringing": Study(ringing, draw_ringing),
    "paper": Study(paper, draw_paper),
    "cost": Study(cost, draw_costs),
}

if __name__ == "__main__":
    studies.run("lubrication", __doc__, STUDIES)
