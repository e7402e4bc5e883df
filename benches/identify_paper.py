"""Identify what the paper does not publish: the fit behind the preset ``wheel_bearing``, for developers.

    python benches/identify_paper.py statics                     # geometries that move ball and zone as published
    python benches/identify_paper.py sensitivity --damping heavy # every target, each unknown a step down and up
    python benches/identify_paper.py search -o FOLDER --minutes 30 --seed 1  # FOLDER/candidates.csv
    python benches/identify_paper.py judge                       # both sets of the preset over fresh starts

It stands here and not in the package because its result is two sets of constants, frozen in the preset; users run
``ballrace paper``, which checks the lightly damped one.

*Statics* varies pitch diameter, conformity of both races and contact angle of the heavily damped set. *Search*
begins at the lightly damped one and varies ``SEARCHED``. Of each candidate, contact angle and conformity of the
outer race follow from ball and zone shift at rest; what is left is a penalty, the mean over ``CHOSEN`` starts of
how far each number lies outside its target, minimised by differential evolution (``scipy.optimize``). Its runs
have rtol 1e-4: motion is chaotic at -3 kN, and its statistics are those at 1e-7. *Judge* takes the default
tolerance and starts that no search has seen. Starts have their balls 1e-9 rad further round than each other.
"""

from __future__ import annotations

import argparse
import csv
import itertools
import json
import math
import re
import time
from dataclasses import dataclass
from functools import partial, reduce
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import differential_evolution, root

import ballrace as br
from ballrace import paper
from ballrace.paper.simulations import VISIBLE, from_start
from ballrace.scene import MotionProbe

if TYPE_CHECKING:
    from collections.abc import Iterable

PITCH_DIAMETERS = (54e-3, 60e-3, 70e-3)
CONFORMITIES = (0.515, 0.52, 0.5225, 0.524, 0.525, 0.5275, 0.53, 0.535)
CONTACT_ANGLES = tuple(float(a) for a in np.arange(9.0, 18.5, 0.5))
CHOSEN, FRESH = range(1, 5), range(5, 13)
"""Starts by which candidates are chosen, and by which the chosen one is judged."""
RTOL = 1e-4

Values = dict[str, float]
"""Values of what is not published, by the names of ``UNKNOWNS`` [SI]."""


@dataclass(frozen=True)
class Unknown:
    """A number that is not published: where it stands, of every row or axis, and a step that shows its effect."""

    path: str
    step: float
    factor: bool = False

    def moved(self, value: float, steps: float) -> float:
        """Return the value some steps further."""
        return value * self.step**steps if self.factor else value + steps * self.step


UNKNOWNS = {
    "pitch_diameter": Unknown("rows[{r}].pitch_diameter", 3e-3),
    "contact_angle": Unknown("rows[{r}].contact_angle", math.radians(2.0)),
    "outer_conformity": Unknown("rows[{r}].outer_conformity", 0.004),
    "inner_conformity": Unknown("rows[{r}].inner_conformity", 0.004),
    "clearance": Unknown("rows[{r}].clearance", 10e-6),
    "axial_preload": Unknown("rows[{r}].axial_preload", 10e-6),
    "outer_mass": Unknown("outer_ring.mass", 2.0, factor=True),
    "outer_stiffness": Unknown("outer_ring.support.{a}.spring.stiffness", 2.0, factor=True),
    "outer_damping": Unknown("outer_ring.support.{a}.spring.damping", 2.0, factor=True),
    "inner_mass": Unknown("inner_ring.mass", 2.0, factor=True),
    "inner_damping": Unknown("inner_ring.support.{a}.spring.damping", 2.0, factor=True),
    "contact_damping": Unknown("contact.damping", 0.1),
    "friction": Unknown("friction.coulomb.coefficient", 2.0, factor=True),
    "slip_speed": Unknown("friction.coulomb.slip_speed", 2.0, factor=True),
    "cage_stiffness": Unknown("cage.stiffness", 10.0, factor=True),
    "cage_damping": Unknown("cage.damping", 2.0, factor=True),
    "defect_offset": Unknown("defects.spall.axial_offset", 0.1e-3),
    # Where the ball of row 0 stands at t = 0.017992 s under +3 kN, from -90°.
    "phase": Unknown("rows[0].start_angle", math.radians(0.4)),
}
SEARCHED = (
    "pitch_diameter", "inner_conformity", "clearance", "outer_mass", "outer_stiffness", "outer_damping",
    "inner_mass", "inner_damping", "friction", "slip_speed", "cage_damping", "defect_offset",
)  # fmt: skip
SCALES = {
    "impact_change": 4.0,
    "line_away": 4.0,
    "clarity_away": 4.0,
    "scatter_away": 10.0,
    "largest_away": 10.0,
    "transient": 3e-3,
}
"""Scale of each target in the penalty, in its unit, of those that a search judges by runs."""


def preset(damping: br.presets.Damping) -> Values:
    """Return the values of a set of the preset."""
    made = br.presets.wheel_bearing(damping=damping)
    document = json.loads(made.to_json())
    values = {}
    for name, unknown in UNKNOWNS.items():
        keys = re.findall(r"\w+", unknown.path.format(r=0, a="x"))
        values[name] = reduce(
            lambda at, key: at[int(key) if key.isdigit() else key], keys, document
        )
    values["phase"] = made.rows[0].start_angle - start_angle(values | {"phase": 0.0})
    return values


def scene(values: Values, axial_load: float, start: int = 0) -> br.Scene:
    """Return the paper's bearing with these values, its balls ``start`` nanoradians further round."""
    return placed(values, axial_load, start_angle(values) + 1e-9 * start)


def placed(values: Values, axial_load: float, angle: float) -> br.Scene:
    """Return the paper's bearing with these values, the first ball of row 0 at an angle [rad]."""
    made = br.presets.wheel_bearing(axial_load)
    pitch = 2.0 * math.pi / made.rows[0].ball_count
    changes: dict[str, object] = {
        unknown.path.format(r=r, a=axis): values[name]
        for name, unknown in UNKNOWNS.items()
        for r, axis in itertools.product(range(2), "xyz")
    }
    starts = {f"rows[{r}].start_angle": angle + r * pitch / 2.0 for r in range(2)}
    return made.replace(changes | starts)


def start_angle(values: Values) -> float:
    """Return the start angle of row 0 that puts a ball at -90° plus the phase under +3 kN [rad].

    The rolling start turns with the nominal contact angle for so short a time that the operating one, of the
    loaded ball at rest, gives the way round.
    """
    towards = placed(values, 3000.0, -math.pi / 2.0).replace({"defects": {}})
    row = towards.rows[0]
    angle = float(br.equilibrium(towards).outer_angle[0])
    order = br.frequencies.ftf(row.ball_count, row.ball_diameter, row.pitch_diameter, angle)
    way = (2.0 * math.pi * 30.0 * order * paper.INSTANT) % (2.0 * math.pi / row.ball_count)
    return -math.pi / 2.0 + values["phase"] - way


# At rest


def at_rest(values: Values) -> tuple[float, float, float]:
    """Return ball shift, the same relative to the outer ring, and zone shift [mm]."""
    none, towards = (paper.static(placed(values, load, 0.0)) for load in (0.0, 3000.0))
    ball = 1e3 * (towards.ball_z - none.ball_z)
    outer = 1e3 * (towards.outer_z - none.outer_z)
    return ball, ball - outer, 1e3 * (towards.zone_middle - none.zone_middle)


def misfit_at_rest(shifts: tuple[float, float, float]) -> float:
    """Return the largest distance of a shift from the published one, over the half width of its target."""
    ball, relative, zone = shifts
    return max(abs(ball - 0.05) / 0.005, abs(relative - 0.05) / 0.005, abs(zone - 0.9) / 0.09)


def statics() -> str:
    """Return, for each pitch diameter and conformity, the contact angles that the shifts at rest allow."""
    lines = []
    for diameter, f in itertools.product(PITCH_DIAMETERS, CONFORMITIES):
        geometry = {"pitch_diameter": diameter, "outer_conformity": f, "inner_conformity": f}
        found = {}
        for angle in CONTACT_ANGLES:
            try:
                shifts = at_rest(
                    preset("heavy") | geometry | {"contact_angle": math.radians(angle)}
                )
            except br.BallraceError:
                continue  # one of the load cases has no equilibrium
            found[angle] = (misfit_at_rest(shifts), shifts)
        best = min(found, key=lambda angle: found[angle][0])
        good = [angle for angle in found if found[angle][0] <= 1.0]
        allowed = f"{min(good):g} … {max(good):g}" if good else "none"
        ball, relative, zone = found[best][1]
        numbers = [f"{ball:.4f}", f"{relative:.4f}", f"{zone:.3f}", f"{found[best][0]:.2f}"]
        lines.append([f"{1e3 * diameter:g}", f"{f:g}", allowed, f"{best:g}", *numbers])
    header = ["pitch mm", "f", "angles °", "best °", "ball mm", "rel. mm", "zone mm", "misfit"]
    return table(header, lines)


def met_at_rest(values: Values) -> Values:
    """Return the values with the contact angle and outer conformity by which ball and zone move as published.

    Raises
    ------
    BallraceError
        There is none.
    """
    unit = np.array([math.radians(1.0), 1e-3])

    def at(place: Iterable[float]) -> Values:
        angle, conformity = place * unit
        return values | {"contact_angle": float(angle), "outer_conformity": float(conformity)}

    def miss(place: Iterable[float]) -> list[float]:
        ball, relative, zone = at_rest(at(place))
        return [((ball + relative) / 2.0 - 0.05) / 0.005, (zone - 0.9) / 0.09]

    first = np.array([values["contact_angle"], values["outer_conformity"]]) / unit
    found = at(root(miss, first, options={"eps": 1e-4, "xtol": 1e-3, "maxfev": 30}).x)
    if misfit_at_rest(at_rest(found)) > 1.0:
        raise br.BallraceError("no contact angle and outer conformity give the shifts at rest")
    return found


# Runs


def evaluated(values: Values, starts: Iterable[int]) -> list[tuple[paper.Comparison, ...]]:
    """Return the table of the paper for each start."""
    return [paper.run(partial(scene, values, start=start)).table for start in starts]


def over_starts(values: Values) -> str:
    """Return, of every target, median, least and largest number over the fresh starts and how many meet it."""
    lines = []
    for each in zip(*evaluated(values, FRESH), strict=True):
        ours = [line.ours for line in each]
        spread = f"{min(ours):.3g} … {max(ours):.3g}"
        met = f"{sum(line.met for line in each)}"
        lines.append([each[0].target.what, each[0].wanted, f"{np.median(ours):.3g}", spread, met])
    return table(["quantity", "wanted", "median", "range", f"met of {len(FRESH)}"], lines)


def sensitivity(base: Values) -> str:
    """Return all targets at these values and with each unknown a step down and up; ``!`` if missed."""
    trials = [("base", base)]
    for (name, unknown), steps in itertools.product(UNKNOWNS.items(), (-1.0, 1.0)):
        moved = unknown.moved(base[name], steps)
        trials.append((f"{name} {moved:.4g}", base | {name: moved}))
    lines = []
    for name, values in trials:
        try:
            (found,) = evaluated(values, [0])
        except br.BallraceError as error:
            lines.append([name, str(error).splitlines()[0], *[""] * (len(paper.TARGETS) - 1)])
            continue
        lines.append([name, *(f"{line.ours:.3g}{'' if line.met else ' !'}" for line in found)])
    return table(["unknown", *(target.key for target in paper.TARGETS)], lines)


def dynamic(values: Values, load: float, start: int) -> paper.Dynamic:
    """Return the features of a load case."""
    made = scene(values, load, start).replace({"solver.rtol": RTOL})
    return paper.dynamic(from_start(made, paper.DURATION, threads=1))


def transient(values: Values, load: float, start: int, level: float) -> float:
    """Return when the healthy bearing has settled below a level [s]."""
    changes = {"defects": {}, "probes": {"outer": MotionProbe(body="outer")}, "solver.rtol": RTOL}
    out = br.simulate(
        scene(values, load, start).replace(changes),
        duration=2.0 * paper.SETTLED, fs=paper.FS, start="rolling", threads=1, settle=0.0, bandwidth=None,
    )  # fmt: skip
    return paper.settling_time(out.t, out["outer.ay"], level)


def judged(values: Values, start: int) -> Values:
    """Return, from one start, the numbers of ``SCALES``."""
    none, towards, away = (dynamic(values, load, start) for load in paper.AXIAL_LOADS.values())
    level = VISIBLE * none.impact
    return {
        "impact_change": 100.0 * (towards.impact / none.impact - 1.0),
        "line_away": 20.0 * math.log10(away.line / towards.line),
        "clarity_away": away.clarity,
        "scatter_away": 100.0 * away.impact_spread / away.impact,
        "largest_away": away.largest,
        "transient": max(
            transient(values, load, start, level) for load in paper.AXIAL_LOADS.values()
        ),
    }


def penalty(numbers: Values) -> float:
    """Return how far the numbers of a start lie outside their targets."""
    return sum(
        max(0.0, target.low - numbers[target.key], numbers[target.key] - target.high)
        / SCALES[target.key]
        for target in paper.TARGETS
        if target.key in SCALES
    )


def defect_to_zone(values: Values) -> float:
    """Return how far the defect lies from the middle of the contact zone at rest under +3 kN [m]."""
    towards = placed(values, 3000.0, 0.0)
    return (
        values["defect_offset"] + towards.rows[0].axial_position - paper.static(towards).zone_middle
    )


def search(folder: Path, minutes: float, seed: int) -> None:
    """Write candidates to ``candidates.csv`` until the time is over; print those that are the best so far."""
    base = preset("light")
    end = time.monotonic() + 60.0 * minutes
    refused = 100.0  # more than the penalty of any bearing
    best = refused
    folder.mkdir(exist_ok=True)
    with (folder / "candidates.csv").open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, ["penalty", *UNKNOWNS, *SCALES])
        writer.writeheader()

        def cost(steps: Iterable[float]) -> float:
            nonlocal best
            if time.monotonic() > end:
                return refused
            moved = {n: UNKNOWNS[n].moved(base[n], s) for n, s in zip(SEARCHED, steps, strict=True)}
            try:
                values = met_at_rest(base | moved)
                # The search moves the defect against the contact zone.
                beyond = defect_to_zone(base) + moved["defect_offset"] - base["defect_offset"]
                values["defect_offset"] += beyond - defect_to_zone(values)
                each = [judged(values, start) for start in CHOSEN]
            except br.BallraceError:
                return refused
            found = float(np.mean([penalty(numbers) for numbers in each]))
            medians = {key: float(np.median([numbers[key] for numbers in each])) for key in SCALES}
            line = {"penalty": found, **values, **medians}
            writer.writerow({key: f"{value:.6g}" for key, value in line.items()})
            file.flush()
            if found < best:
                best = found
                print(", ".join(f"{key} {value:.4g}" for key, value in line.items()), flush=True)
            return found

        differential_evolution(
            cost,
            [(-1.0, 1.0)] * len(SEARCHED),
            x0=np.zeros(len(SEARCHED)),
            popsize=2,
            rng=seed,
            tol=0.0,
            maxiter=10**6,
            polish=False,
            callback=lambda *_: time.monotonic() > end,
        )


def table(header: list[str], lines: list[list[str]]) -> str:
    """Return a Markdown table."""
    rows = [header, ["---"] * len(header), *lines]
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)


def main() -> None:
    """Run a part."""
    parser = argparse.ArgumentParser(description="Identify what the paper does not publish.")
    parser.add_argument("part", choices=("statics", "sensitivity", "search", "judge"))
    parser.add_argument(
        "--damping", choices=("heavy", "light"), help="set of the preset (default: both)"
    )
    parser.add_argument(
        "-o", "--output", type=Path, default=Path("identify"), help="folder for the candidates"
    )
    parser.add_argument(
        "--minutes", type=float, default=60.0, help="time of the search (default: %(default)s)"
    )
    parser.add_argument("--seed", type=int, default=1, help="of the search (default: %(default)s)")
    options = parser.parse_args()
    if options.part == "statics":
        print(statics())
        return
    if options.part == "search":
        search(options.output, options.minutes, options.seed)
        return
    both: tuple[br.presets.Damping, ...] = ("heavy", "light")
    made = sensitivity if options.part == "sensitivity" else over_starts
    for damping in both:
        if options.damping in (None, damping):
            print(f"\n{damping}\n\n{made(preset(damping))}")


if __name__ == "__main__":
    main()
