"""c. Methods against each other, ours and SciPy's on our right-hand side."""

from __future__ import annotations

import math
import time
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.integrate import solve_ivp

import ballrace as br

from . import draw
from .setting import (
    DURATION,
    FS,
    IMPACT_OVER,
    Case,
    Effort,
    bearing,
    best,
    error,
    in_band,
    integrated,
    largest_step,
    settled,
    survey,
    truth,
)

if TYPE_CHECKING:
    from pathlib import Path

NAME = "methods"
CUT = "fitted 6"
SLIP_SPEEDS = (0.1, 0.001)
ADAPTIVE = (
    "adams",
    "dormand-prince",
    "verner",
)
PEERS = ("RK45", "DOP853", "Radau", "LSODA")
PEER_TOLERANCES = (1e-3, 1e-4, 1e-6)
PATIENCE = 15.0  # s, for a peer
CAPS = (math.inf, 2.0, 1.5, 1.0, 0.9, 0.5, 0.25)
TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)
TARGETS = (1e-2, 1e-3, 1e-4)


def measure(*, quick: bool) -> list[dict[str, Any]]:
    """Scan caps and tolerances of every method at both slip speeds."""
    rows = []
    caps = (math.inf, 1.0) if quick else CAPS
    tolerances = (1e-3, 1e-5, 1e-7) if quick else TOLERANCES
    for slip_speed in SLIP_SPEEDS:
        cases = [
            case(slip_speed, Effort(method, rtol, cap))
            for method in ADAPTIVE
            for cap in caps
            for rtol in tolerances
        ]
        rows += survey(cases, 1 if quick else 3)
        rows += [
            peer(name, slip_speed, rtol)
            for name in PEERS
            for rtol in ((1e-4,) if quick else PEER_TOLERANCES)
        ]
    return rows


def case(slip_speed: float, effort: Effort) -> Case:
    """Return a run by a method of ours."""
    labels = {
        "slip_speed": slip_speed,
        "method": effort.method,
        "cap": effort.cap,
        "rtol": effort.rtol,
    }
    scene = integrated(bearing(slip_speed, CUT), effort)
    return Case(labels, scene, settled(slip_speed, CUT), truth(slip_speed, CUT).signal)


def peer(name: str, slip_speed: float, rtol: float) -> dict[str, Any]:
    """Run SciPy's method on our right-hand side, without a cap, on the scales that our own tolerances have.

    Its wall time has a call from Python in every evaluation; one that takes longer than the patience is given up.
    """
    model = br.Model(bearing(slip_speed, CUT))
    calls = 0

    def rhs(t: float, y: np.ndarray) -> np.ndarray:
        # Counted here: SciPy leaves out what a Jacobian takes.
        nonlocal calls
        calls += 1
        if time.perf_counter() - begun > PATIENCE:
            raise TimeoutError
        return model.rhs(t, y)

    t = np.arange(round(DURATION * FS)) / FS
    true = truth(slip_speed, CUT).signal
    begun = time.perf_counter()
    try:
        # Differences for a Jacobian try steps at which a contact's force overflows.
        with np.errstate(over="ignore", invalid="ignore"):
            solution = solve_ivp(
                rhs,
                (0.0, DURATION),
                settled(slip_speed, CUT),
                method=name,
                t_eval=t,
                rtol=3e-14,
                atol=rtol * scales(model),
            )
    except TimeoutError:
        solution = None
    wall = time.perf_counter() - begun
    row = {"slip_speed": slip_speed, "method": name, "cap": math.inf, "rtol": rtol}
    if solution is None or not solution.success:
        lost = dict.fromkeys(("error", "error_to_4ms", "error_in_band"), math.nan)
        return {**row, **lost, "evaluations": calls, "warned": 1, "wall_ms": 1e3 * wall}
    rate = model.names.index("outer.vy")
    found = np.array([model.rhs(s, y)[rate] for s, y in zip(t, solution.y.T, strict=True)])
    early = t < IMPACT_OVER
    return {
        **row,
        "error": error(found, true),
        "error_to_4ms": error(found[early], true[early]),
        "error_in_band": error(in_band(found), in_band(true)),
        "evaluations": calls,
        "warned": 0,
        "wall_ms": 1e3 * wall,
    }


def scales(model: br.Model) -> np.ndarray:
    """Return the size of an error that matters in every state: the approach of a ball and race, and its rate."""
    approach = 40e-6  # m, of the heaviest loaded ball
    radius = model.scene.rows[0].ball_diameter / 2.0
    scale = np.full(len(model.names), approach)
    for i, name in enumerate(model.names):
        what = name.rsplit(".", 1)[1]
        if what in {"theta", "omega"}:
            scale[i] /= radius
        if what in {"vx", "vy", "vz", "omega"}:
            scale[i] /= largest_step()
    return scale


def cheapest(rows: list[dict[str, Any]], cost: str) -> list[str]:
    """Say which settings reach the targets at the least cost."""
    lines = []
    for slip_speed in SLIP_SPEEDS:
        for target in TARGETS:
            good = [
                row
                for row in rows
                if row["slip_speed"] == slip_speed
                and row["error"] <= target
                and (cost == "evaluations" or row["method"] not in PEERS)
            ]
            row = min(good, key=lambda row: row[cost])
            lines.append(
                f"v_s {slip_speed:g} m/s, error {target:.0e}, least {cost}: {row['method']}, cap {row['cap']:g}, "
                f"rtol {row['rtol']:.0e}: {row['evaluations']} evaluations, {row['wall_ms']:.1f} ms, "
                f"{row['error']:.1e}"
            )
    return lines


def draw_chart(rows: list[dict[str, Any]], path: Path) -> None:
    """Draw the best of every method over caps and tolerances."""
    titles = [
        f"{what}, v_s = {speed:g} m/s"
        for what in ("Evaluations", "Wall time")
        for speed in SLIP_SPEEDS
    ]
    figure, axes = draw.panels(titles, rows=2)
    colours = {
        "adams": draw.RED,
        "dormand-prince": draw.BLUE,
        "verner": draw.BROWN,
        **dict.fromkeys(PEERS, draw.GREY),
    }
    for i, ax in enumerate(axes):
        cost = "evaluations" if i < 2 else "wall_ms"
        for method, colour in colours.items():
            if cost == "wall_ms" and method in PEERS:
                continue
            mine = [
                r for r in rows if (r["method"], r["slip_speed"]) == (method, SLIP_SPEEDS[i % 2])
            ]
            front = [r for r in best(mine, cost) if 1e-6 <= r["error"] <= 0.3]
            x, y = [r[cost] for r in front], [r["error"] for r in front]
            draw.line(ax, x, y, method, colour, style="o:" if method in PEERS else "o-")
        unit = "evaluations for 6 ms" if i < 2 else "wall time for 6 ms, ms"
        ax.set_xlabel(unit)
        if i % 2 == 0:
            ax.set_ylabel("integration error of outer.ay")
    draw.save(figure, path)
