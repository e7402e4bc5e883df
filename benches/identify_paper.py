"""Identify what the paper does not publish: a repeatable fit of the wheel bearing, for developers.

    python benches/identify_paper.py            # the three tables, on the screen
    python benches/identify_paper.py -o FOLDER  # and as identify.md and identify.json

It stands here and not in the package because its result is a set of constants, frozen in the preset
``wheel_bearing``; users run ``ballrace paper``, which checks them.

1. *Statics.* Over plausible geometry (pitch diameter, conformity of both races, contact angle; balls of
   15/32 in, no clearance): which healthy bearings move ball and contact zone as published, from 0 to +3 kN. For
   each pitch diameter and conformity the range of contact angles that does, and the best.
2. *Dynamics.* For each geometry that the statics leave: the axial place of the defect at which impacts grow by
   30 %, by the secant method, and the phase of the balls; then every target of ``ballrace.paper``.
3. *Sensitivity.* From the preset, each unknown a step down and up: what each target does.

The misfit of a target is the distance from the middle of its bounds over half their width; of one with one
bound, 0 where it is met and else 1 plus the relative excess. A set of values is as good as another if none of its
misfits exceeds 1. The balls' phase is hardly free: at t = 0.017992 s a ball stands within 1° of -90°, half the
defect's width, with and without axial load; the two loads differ by 0.9°.
"""

from __future__ import annotations

import argparse
import itertools
import json
import math
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import numpy as np

import ballrace as br
from ballrace import paper

PITCH_DIAMETERS = (54e-3, 60e-3, 70e-3)
CONFORMITIES = (0.515, 0.52, 0.5225, 0.524, 0.525, 0.5275, 0.53, 0.535)
CONTACT_ANGLES = tuple(float(a) for a in np.arange(9.0, 18.5, 0.5))


@dataclass(frozen=True)
class Unknowns:
    """What is not published, with the values of the preset [SI, angles in degrees]."""

    pitch_diameter: float = 60e-3
    contact_angle: float = 13.0
    outer_conformity: float = 0.524
    inner_conformity: float = 0.524
    clearance: float = 0.0
    axial_preload: float = 0.0
    row_distance: float = 22e-3
    row_phase: float = 0.5
    outer_mass: float = 0.8
    outer_stiffness: float = 1e9
    outer_damping: float = 6e3
    inner_mass: float = 0.6
    inner_damping: float = 500.0
    contact_damping: float = 0.2
    friction: float = 0.05
    slip_speed: float = 0.1
    cage_stiffness: float = 1e6
    cage_damping: float = 20.0
    defect_offset: float = 2.32e-3
    # Where the ball of row 0 stands at t = 0.017992 s under +3 kN, from -90° [deg].
    phase: float = 0.15


STEPS: dict[str, tuple[float, float]] = {
    "pitch_diameter": (57e-3, 63e-3),
    "contact_angle": (11.0, 15.0),
    "outer_conformity": (0.520, 0.528),
    "inner_conformity": (0.520, 0.528),
    "clearance": (-10e-6, 10e-6),
    "axial_preload": (-10e-6, 10e-6),
    "row_distance": (18e-3, 26e-3),
    "row_phase": (0.0, 0.25),
    "outer_mass": (0.4, 1.6),
    "outer_stiffness": (0.5e9, 2e9),
    "outer_damping": (3e3, 12e3),
    "inner_mass": (0.3, 1.2),
    "inner_damping": (250.0, 1000.0),
    "contact_damping": (0.1, 0.4),
    "friction": (0.025, 0.1),
    "slip_speed": (0.05, 0.2),
    "cage_stiffness": (1e5, 1e7),
    "cage_damping": (0.0, 100.0),
    "defect_offset": (2.22e-3, 2.42e-3),
    "phase": (-0.25, 0.55),
}


def scene(u: Unknowns, axial_load: float, start_angle: float | None = None) -> br.Scene:
    """Return the paper's bearing with these values; without a start angle the preset's."""
    changes: dict[str, object] = {
        "outer_ring.mass": u.outer_mass,
        "inner_ring.mass": u.inner_mass,
        "contact.damping": u.contact_damping,
        "friction.coulomb.coefficient": u.friction,
        "friction.coulomb.slip_speed": u.slip_speed,
        "cage.stiffness": u.cage_stiffness,
        "cage.damping": u.cage_damping,
        "defects.spall.axial_offset": u.defect_offset,
    }
    for axis in "xyz":
        changes[f"outer_ring.support.{axis}.spring.stiffness"] = u.outer_stiffness
        changes[f"outer_ring.support.{axis}.spring.damping"] = u.outer_damping
        changes[f"inner_ring.support.{axis}.spring.damping"] = u.inner_damping
    preset = br.presets.wheel_bearing(axial_load)
    for r, row in enumerate(preset.rows):
        of_row = {
            "pitch_diameter": u.pitch_diameter,
            "contact_angle": math.radians(u.contact_angle),
            "outer_conformity": u.outer_conformity,
            "inner_conformity": u.inner_conformity,
            "clearance": u.clearance,
            "axial_preload": u.axial_preload,
            "axial_position": math.copysign(u.row_distance / 2.0, row.axial_position),
        }
        if start_angle is not None:
            pitch = 2.0 * math.pi / row.ball_count
            of_row["start_angle"] = start_angle + r * u.row_phase * pitch
        changes |= {f"rows[{r}].{name}": value for name, value in of_row.items()}
    return preset.replace(changes)


def start_angle(u: Unknowns) -> float:
    """Return the start angle of row 0 that puts a ball at -90° (plus the phase) under +3 kN [rad].

    The rolling start turns with the nominal contact angle for so short a time that the operating one, of the
    loaded ball at rest, gives the way round.
    """
    towards = scene(u, 3000.0, -math.pi / 2.0).replace({"defects": {}})
    row = towards.rows[0]
    angle = float(br.equilibrium(towards).outer_angle[0])
    rate = 2.0 * math.pi * 30.0 * br.frequencies.ftf(
        row.ball_count, row.ball_diameter, row.pitch_diameter, angle
    )  # fmt: skip
    way = (rate * paper.INSTANT) % (2.0 * math.pi / row.ball_count)
    return -math.pi / 2.0 + math.radians(u.phase) - way


def misfit(line: paper.Comparison) -> float:
    """Return the misfit of a target."""
    low, high = line.target.low, line.target.high
    if line.target.value is not None:
        return abs(line.ours - (low + high) / 2.0) / ((high - low) / 2.0)
    if line.met:
        return 0.0
    bound = high if line.ours > high else low
    return 1.0 + abs(line.ours - bound) / abs(bound)


def at_rest(u: Unknowns) -> tuple[float, float, float] | None:
    """Return ball shift, the same relative to the outer ring, and zone shift [mm]; None if one case has none."""
    try:
        none, towards = (paper.static(scene(u, load)) for load in (0.0, 3000.0))
    except br.BallraceError:
        return None
    ball = 1e3 * (towards.ball_z - none.ball_z)
    outer = 1e3 * (towards.outer_z - none.outer_z)
    return ball, ball - outer, 1e3 * (towards.zone_middle - none.zone_middle)


def worst_at_rest(shifts: tuple[float, float, float]) -> float:
    """Return the largest misfit of the shifts of a healthy bearing at rest."""
    ball, relative, zone = shifts
    return max(abs(ball - 0.05) / 0.005, abs(relative - 0.05) / 0.005, abs(zone - 0.9) / 0.09)


def statics(jobs: int) -> list[dict[str, object]]:
    """Return, for each pitch diameter and conformity, the contact angles that the statics allow."""

    def one(pair: tuple[float, float]) -> dict[str, object]:
        diameter, f = pair
        found = {}
        for angle in CONTACT_ANGLES:
            u = Unknowns(
                pitch_diameter=diameter, contact_angle=angle, outer_conformity=f, inner_conformity=f
            )
            shifts = at_rest(u)
            if shifts is not None:
                found[angle] = (worst_at_rest(shifts), shifts)
        best = min(found, key=lambda angle: found[angle][0])
        good = [angle for angle in found if found[angle][0] <= 1.0]
        return {
            "pitch_diameter": diameter,
            "conformity": f,
            "contact_angles": [min(good), max(good)] if good else None,
            "best_angle": best,
            "ball_relative_zone": found[best][1],
            "misfit": found[best][0],
        }

    with ThreadPoolExecutor(jobs) as pool:
        return list(pool.map(one, itertools.product(PITCH_DIAMETERS, CONFORMITIES)))


def evaluate(u: Unknowns) -> dict[str, object]:
    """Return every target's number and misfit, or why there is none."""
    try:
        angle = start_angle(u)
        found = paper.run(lambda load: scene(u, load, angle), threads=1)
    except br.BallraceError as error:
        return {"unknowns": asdict(u), "error": str(error)}
    return {
        "unknowns": asdict(u),
        "start_angle": angle,
        "ours": {line.target.key: line.ours for line in found.table},
        "misfit": {line.target.key: misfit(line) for line in found.table},
        "impacts": {name: case.dynamic.impact for name, case in found.cases.items()},
        "worst": max(misfit(line) for line in found.table),
    }


def impact_change(u: Unknowns) -> float:
    """Return how much stronger impacts are at +3 kN than without axial load."""
    angle = start_angle(u)
    impact = []
    for load in (0.0, 3000.0):
        probes = {
            "outer": br.scene.MotionProbe(body="outer", components=("ay",)),
            "ball": br.scene.MotionProbe(body="row0.ball0", components=("x", "y")),
        }
        out = br.simulate(
            scene(u, load, angle).replace({"probes": probes}),
            duration=0.06, fs=paper.FS, start="rolling", threads=1, bandwidth=None,
        )  # fmt: skip
        impact.append(paper.dynamic(out).impact)
    return impact[1] / impact[0] - 1.0


def place_defect(u: Unknowns) -> Unknowns:
    """Return the values with the defect where impacts grow by 30 %."""
    # The frozen place at 13° lies this far beyond the middle of the zone of the unloaded groove.
    beyond = Unknowns.defect_offset - 5.953e-3 * math.sin(math.radians(Unknowns.contact_angle))
    first = beyond + 5.953e-3 * math.sin(math.radians(u.contact_angle))
    places = [first, first + 0.1e-3]
    changes = [impact_change(replace(u, defect_offset=place)) for place in places]
    for _ in range(3):
        if abs(changes[-1] - 0.30) < 0.01:
            break
        slope = (changes[-1] - changes[-2]) / (places[-1] - places[-2])
        step = (0.30 - changes[-1]) / slope if slope > 0.0 else -0.2e-3
        places.append(places[-1] + min(max(step, -0.4e-3), 0.4e-3))
        changes.append(impact_change(replace(u, defect_offset=places[-1])))
    nearest = min(range(len(places)), key=lambda i: abs(changes[i] - 0.30))
    return replace(u, defect_offset=round(places[nearest], 5))


def place_ball(u: Unknowns) -> Unknowns:
    """Return the values with the phase, within 0.3°, at which ball and zone shift most nearly as published."""

    def worst(phase: float) -> float:
        v = replace(u, phase=phase)
        angle = start_angle(v)
        none, towards = (paper.snapshot(scene(v, load, angle), threads=1) for load in (0.0, 3000.0))
        ball = 1e3 * float(towards.balls.z[towards.middle] - none.balls.z[none.middle])
        outer = 1e3 * (towards.outer_z - none.outer_z)
        return worst_at_rest((ball, ball - outer, 1e3 * (towards.zone.middle - none.zone.middle)))

    return replace(u, phase=min((-0.3, -0.15, 0.0, 0.05, 0.1, 0.15, 0.2, 0.3), key=worst))


def dynamics(allowed: list[dict[str, object]], jobs: int) -> list[dict[str, object]]:
    """Return all targets for each geometry that the statics allow, the best first."""

    def one(line: dict[str, object]) -> dict[str, object]:
        f = line["conformity"]
        u = Unknowns(
            pitch_diameter=line["pitch_diameter"], contact_angle=line["best_angle"],
            outer_conformity=f, inner_conformity=f,
        )  # fmt: skip
        try:
            return evaluate(place_ball(place_defect(u)))
        except br.BallraceError as error:
            return {"unknowns": asdict(u), "error": str(error)}

    with ThreadPoolExecutor(jobs) as pool:
        found = list(pool.map(one, [line for line in allowed if line["contact_angles"]]))
    return sorted(found, key=lambda entry: entry.get("worst", math.inf))


def sensitivity(jobs: int) -> list[dict[str, object]]:
    """Return all targets at the preset's values, and with each unknown a step down and up."""
    trials = [("preset", Unknowns())]
    for name, values in STEPS.items():
        trials += [(name, replace(Unknowns(), **{name: value})) for value in values]
    with ThreadPoolExecutor(jobs) as pool:
        found = list(pool.map(evaluate, [u for _, u in trials]))
    return [{"unknown": name, **entry} for (name, _), entry in zip(trials, found, strict=True)]


# Tables

_COLUMNS = {
    "impact_change": "impacts %",
    "ball_shift": "ball mm",
    "ball_shift_relative": "rel. mm",
    "support_share": "support",
    "zone_shift": "zone mm",
    "static_ball_shift": "ball at rest",
    "static_zone_shift": "zone at rest",
    "force_away": "force -3",
    "line_away": "line dB",
    "transient": "transient s",
}


def table(header: list[str], lines: list[list[str]]) -> str:
    """Return a Markdown table."""
    rows = [header, ["---"] * len(header), *lines]
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)


def cells(entry: dict[str, object]) -> list[str]:
    """Return the targets of a trial as text."""
    if "error" in entry:
        return [str(entry["error"])[:60], *[""] * len(_COLUMNS)]
    misfits = entry["misfit"]
    marked = [f"{entry['ours'][key]:.3g}{'' if misfits[key] <= 1.0 else ' !'}" for key in _COLUMNS]
    return [*marked, f"{entry['worst']:.2f} {max(misfits, key=misfits.get)}"]


def report(found: dict[str, list[dict[str, object]]]) -> str:
    """Return the three tables as Markdown; ``!`` marks a target that is missed."""
    parts = ["## Geometry that the statics allow\n"]
    lines = []
    for line in found["statics"]:
        angles = line["contact_angles"]
        ball, relative, zone = line["ball_relative_zone"]
        lines.append(
            [f"{1e3 * line['pitch_diameter']:g}", f"{line['conformity']:g}",
             f"{angles[0]:g} … {angles[1]:g}" if angles else "none", f"{line['best_angle']:g}",
             f"{ball:.4f}", f"{relative:.4f}", f"{zone:.3f}", f"{line['misfit']:.2f}"]
        )  # fmt: skip
    head = ["pitch mm", "f", "angles °", "best °", "ball mm", "rel. mm", "zone mm", "misfit"]
    parts.append(table(head, lines))
    parts.append("\n## Every target, defect placed for +30 %; the best first\n")
    lines = [
        [f"{1e3 * u['pitch_diameter']:g}", f"{u['outer_conformity']:g}", f"{u['contact_angle']:g}",
         f"{1e3 * u['defect_offset']:.3g}", f"{u['phase']:g}", *cells(entry)]
        for entry in found["dynamics"]
        for u in [entry["unknowns"]]
    ]  # fmt: skip
    titles = [*_COLUMNS.values(), "worst misfit"]
    parts.append(table(["pitch mm", "f", "angle °", "defect mm", "phase °", *titles], lines))
    parts.append("\n## Each unknown a step down and up\n")
    lines = []
    for entry in found["sensitivity"]:
        name = entry["unknown"]
        value = f"{entry['unknowns'][name]:g}" if name in STEPS else ""
        lines.append([name, value, *cells(entry)])
    parts.append(table(["unknown", "value", *titles], lines))
    return "\n".join(parts) + "\n"


def main() -> None:
    """Run the parts asked for; print and write their tables."""
    parser = argparse.ArgumentParser(description="Identify what the paper does not publish.")
    parser.add_argument(
        "-o", "--output", type=Path, help="folder for identify.md and identify.json"
    )
    parser.add_argument("--jobs", type=int, default=2, help="runs at a time (default: %(default)s)")
    parser.add_argument(
        "--only",
        choices=("statics", "dynamics", "sensitivity"),
        help="one part (dynamics needs statics)",
    )
    options = parser.parse_args()
    found: dict[str, list[dict[str, object]]] = {"statics": [], "dynamics": [], "sensitivity": []}
    if options.only != "sensitivity":
        found["statics"] = statics(options.jobs)
    if options.only in (None, "dynamics"):
        found["dynamics"] = dynamics(found["statics"], options.jobs)
    if options.only in (None, "sensitivity"):
        found["sensitivity"] = sensitivity(options.jobs)
    text = report(found)
    print(text)
    if options.output is not None:
        options.output.mkdir(exist_ok=True)
        (options.output / "identify.md").write_text(text, encoding="utf-8")
        (options.output / "identify.json").write_text(json.dumps(found, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
