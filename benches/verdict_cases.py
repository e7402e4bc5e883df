"""Draw the runs of the library of verdicts, each from its own number.

What is drawn, and why:

===============  ==================================================================================================
bearing          6000 to 6016, 6200 to 6216, 6300 to 6316, 6403 to 6414, 7205B to 7310B, but those of the sets
                 that are judged (``verdict_set.py``); inner races are damaged where their lines are apart from
                 the shaft's
damage           three of ten healthy, a tenth with two damaged surfaces, as wear spreads from one to the other
width            0.015 to 0.4 ball diameters, logarithmic: from seeded holes to what ends a bearing's use; spalls
                 and cuts, half of which reach across the contact, with edges of 0.0025 to 0.25 ball diameters but
                 at most half as wide as they are, and round holes (a quarter, where they are smaller than the
                 contact)
dents            a quarter of damaged races, 0.015 to 0.12 ball diameters wide, but no wider than the contact
load             four of five 1 to 15 % of the static rating, as catalogues recommend; the others 0.3 to 1 %, as
                 of idling machines
speed            600 to 3600 1/min, as motors of two to ten poles; the last hundred runs 300 to 600, as of drives
slip             scatter of impacts as a recipe has it, or less; and a cage that lags behind the orders that
                 records are judged by, 0 to 4 %, mostly less than 1 %: makers' real dimensions, sliding balls
surfaces         texture as a recipe has it, and waves of 5 to 200 nm
rotor            unbalanced as a recipe has it
machine          pedestals as a recipe has them; the sensor on it, or at the end of a path, as heavy as goes with
                 the bearing's size, 0 to 26 dB weaker, mostly less than 7 dB: sensors sit near what they watch
other vibration  noise, tones and modulation of ``br.measuring.random_chains``, up to 20 dB quieter
test rigs        every third record is as of one: the sensor on the pedestal, the rest 20 to 60 dB quieter; records
                 of damage that rigs have published are 12 to 48 dB above those of their healthy bearings
logger           12, 20, 25.6 or 51.2 kHz; an eighth with a lower band, a twelfth clipped
===============  ==================================================================================================
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

import ballrace as br
from ballrace.bearings.clearance import clearance_limits
from ballrace.learn.drawn import (
    fault_fields,
    log_uniform,
    slip_fields,
    structure_fields,
    texture_fields,
    unbalance,
)

TURNS = 24
HELD_OUT = (
    "6002", "6007", "6012", "6200", "6212", "6301", "6405", "6406", "6408", "6409", "6411",
)  # fmt: skip
"""Bearings of the sets that are judged."""
BEARINGS = tuple(
    name
    for name in (
        *(f"6{series}{bore:02}" for series in (0, 2, 3) for bore in range(17)),
        *(f"64{bore:02}" for bore in range(3, 15)),
        *(f"7{series}{bore:02}B" for series in (2, 3) for bore in range(5, 11)),
    )
    if name not in HELD_OUT
)
ACCUSED = ("outer_race", "inner_race", "ball")
RACES = ACCUSED[:2]
# Of twenty runs.
PARTS: tuple[tuple[str, ...], ...] = (
    *[()] * 6, *[RACES[:1]] * 5, *[RACES[1:]] * 5, *[("ball",)] * 2, RACES, RACES,
)  # fmt: skip
BALLS = 0.3
"""Share of double faults of which one is on a ball."""
SHAPES = {
    br.scene.Patch: "spall", br.scene.Cap: "cap", br.scene.Pit: "pit", br.scene.Dent: "dent"
}  # fmt: skip
DENTED, DRILLED = 0.25, 0.25
"""Shares of dents, and of round holes where they are smaller than the contact."""
WIDTHS, DENTS = (0.015, 0.4), (0.015, 0.12)
LOADS, IDLE, IDLING = (0.01, 0.15), (0.003, 0.01), 0.2
SPEEDS, SLOW = (600.0, 3600.0), (300.0, 600.0)
SLOWER = 620
"""Number of the first run of a slow machine."""
EDGES = (0.0025, 0.25)
"""Radii of edges in ball diameters: from those of wires and sparks, 20 µm in a 6205, to worn ones."""
CUT, ACROSS = 0.5, 0.6
"""Share of spalls that reach across the contact, as cuts and old ones do, and their length in ball diameters."""
SCATTER, LAG = (2e-3, br.learn.recipe.LARGEST_SLIP), 0.04


@dataclass(frozen=True)
class Case:
    """A run of the library; lengths of its first defect in ball diameters, an edge of 0 where it has none."""

    number: int
    bearing: br.Bearing
    parts: tuple[str, ...]
    shapes: tuple[str, ...]
    rpm: float
    load: float
    width: float
    edge: float
    lag: float
    scene: br.Scene


def case(number: int) -> Case:
    """Draw a run."""
    rng = np.random.default_rng([67, number])
    parts = parts_of(number, rng)
    names = BEARINGS if "inner_race" not in parts else [name for name in BEARINGS if is_apart(name)]
    bearing = br.catalogue[str(rng.choice(names))]
    rpm = log_uniform(rng, SPEEDS if number < SLOWER else SLOW)
    load = log_uniform(rng, IDLE if rng.random() < IDLING else LOADS)
    scene = loaded(bearing, load, rpm, "free" if "ball" in parts else None, rng)
    scene = scene.replace(own_of(scene, bearing, parts, rng))
    shapes, sizes, edges = [], [], []
    for part in parts:
        defect = defect_of(scene, bearing, part, rng)
        scene = scene.replace({f"defects.{part}": defect})
        shapes.append(SHAPES[type(defect)])
        sizes.append(br.scene.defect.widest(defect) / bearing.ball_diameter)
        edges.append(getattr(defect, "edge_radius", 0.0) / bearing.ball_diameter)
    lag = LAG * float(rng.random()) ** 2
    grade = log_uniform(rng, br.learn.recipe.GRADES)
    rotor = unbalance(load * bearing.static_rating, rpm * math.pi / 30.0, grade, rng)
    scene = scene.replace({"unbalances.rotor": rotor})
    return Case(
        number, bearing, parts, tuple(shapes), rpm, load, (*sizes, 0.0)[0], (*edges, 0.0)[0], lag, scene
    )  # fmt: skip


def is_apart(name: str) -> bool:
    """Separation of an inner race: whether its lines are apart from the shaft's in so many turns.

    Of the others, half of the sizes, such records carry no evidence, and verdicts are left open without a ratio.
    """
    order = br.catalogue[name].orders.bpfi
    return abs(order - round(order)) > 2.4 / TURNS


def parts_of(number: int, rng: np.random.Generator) -> tuple[str, ...]:
    """Return what is damaged in a run, in the order of ``ACCUSED``."""
    parts, is_of_ball = PARTS[number % len(PARTS)], rng.random() < BALLS
    if len(parts) == 2 and is_of_ball:
        return str(rng.choice(RACES)), "ball"
    return parts


def loaded(
    bearing: br.Bearing, load: float, rpm: float, spin: str | None, rng: np.random.Generator
) -> br.Scene:
    """Return a healthy bearing under a load over its static rating, with thrust and play by chance."""
    radial, thrust, play = load * bearing.static_rating, rng.random(), rng.random()
    options: dict[str, Any] = {"radial_load": radial, "speed_rpm": rpm}
    if bearing.contact_angle > 0.0:
        # From where half of its balls carry load to where all do.
        options["axial_load"] = (1.22 + 0.6 * thrust) * radial * math.tan(bearing.contact_angle)
    else:
        _, most = clearance_limits(bearing.bore, "CN")
        options |= {"axial_load": 0.4 * thrust * radial, "clearance": most * play}
    scene = br.bearing(bearing, texture=br.scene.Texture(outer=1e-9, inner=1e-9), **options)
    probes = {"housing": br.scene.StructureProbe(), "seat": br.scene.SeatProbe()}
    return replace(scene, probes=probes, spin=spin or scene.spin)


def own_of(
    scene: br.Scene, bearing: br.Bearing, parts: tuple[str, ...], rng: np.random.Generator
) -> dict[str, Any]:
    """Return what a bearing and its machine have of their own: fields of the scene."""
    own = {"rows[0].start_angle": float(rng.uniform(0.0, 2.0 * math.pi))}
    own |= structure_fields(scene.structure, rng)
    own |= slip_fields(bearing, log_uniform(rng, SCATTER), rng)
    own |= texture_fields(bearing, rng)
    own |= {f"rows[0].{race}_waviness": waves(rng) for race in ("outer", "inner")}
    if "ball" in parts or scene.spin == "free":
        # The texture of balls is around one axis, about which these do not turn.
        own["rows[0].texture.ball"] = 0.0
    return own


def waves(rng: np.random.Generator) -> tuple[br.scene.Waviness, ...]:
    """Draw six waves of a race, of 5 to 200 nm."""
    orders = rng.choice(np.arange(2, 40), 6, replace=False)
    heights = 1e-6 * np.exp(rng.uniform(math.log(0.005), math.log(0.2), 6))
    drawn = zip(orders.tolist(), heights.tolist(), rng.uniform(0.0, 6.28, 6).tolist(), strict=True)
    return tuple(br.scene.Waviness(order=o, amplitude=a, phase=p) for o, a, p in drawn)


def defect_of(
    scene: br.Scene, bearing: br.Bearing, part: str, rng: np.random.Generator
) -> br.scene.Defect:
    """Draw damage of a surface: a dent, a round hole smaller than its contact, or else a spall or a cap."""
    ball = bearing.ball_diameter
    pit, spall = fault_fields(part, ball * log_uniform(rng, WIDTHS), ball, rng)
    # Two edges have no room for larger radii; wear rounds them as it widens the damage.
    edge = min(ball * log_uniform(rng, EDGES), 0.5 * pit["width"])
    length = ACROSS * ball if rng.random() < CUT else spall.get("length", 0.0)
    shape, flat, rim = rng.random(), rng.uniform(15.0, 40.0), rng.uniform(200.0, 1000.0)
    dented = ball * log_uniform(rng, DENTS)
    angle = pit["angle"]
    if shape < DENTED and part != "ball":
        return dent(scene, part, dented, angle=angle, flat=flat, rim=rim)
    hole = br.defects.pit(on=part, diameter_mm=1e3 * pit["width"], angle=angle)
    if shape > 1.0 - DRILLED and takes(scene, hole, "width"):
        return hole
    wide: dict[str, Any] = {
        "width_mm": 1e3 * spall["width"], "edge_radius_mm": 1e3 * edge, "angle": angle
    }  # fmt: skip
    if part == "ball":
        return br.defects.cap(**wide)
    while True:
        found = br.defects.spall(on=part, length_mm=1e3 * length, **wide)
        if takes(scene, found, "length"):
            return found
        # It would reach beyond the race's shoulder.
        length *= 0.85


def dent(scene: br.Scene, part: str, width: float, **shape: float) -> br.scene.Defect:
    """Return a dent of a width [m], or as wide as its contact takes."""
    size = 1e3 * width
    while True:
        found = br.defects.dent(
            on=part, diameter_mm=size, depth_mm=size / shape["flat"], rim_height_mm=size / shape["rim"],
            angle=shape["angle"],
        )  # fmt: skip
        if takes(scene, found, "width"):
            return found
        size *= 0.85


def takes(scene: br.Scene, defect: br.scene.Defect, field: str) -> bool:
    """Return whether a scene takes a defect: False if it refuses its width or its length."""
    try:
        br.equilibrium(scene.replace({"defects.tried": defect}))
    except br.SceneError as error:
        if error.path != f"defects.tried.{field}":
            raise
        return False
    return True
