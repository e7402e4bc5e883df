"""b. The signal: error of the integration and of the model on the same axes."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from . import draw
from .setting import (
    DEFAULT,
    IN_BAND,
    Case,
    Effort,
    bearing,
    best,
    integrated,
    settled,
    survey,
    truth,
)

if TYPE_CHECKING:
    from pathlib import Path

NAME = "signals"
TRUE = "fitted 64"
OWN = "fitted 6"
CAPS = (math.inf, IN_BAND.cap, 0.9, 0.5, 0.25)
TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10)
CUTS = (
    *(f"fitted {n}" for n in (4, 6, 8, 12, 16, 24, 32)),
    *(f"fixed {n}" for n in (50, 100, 200, 400)),
)
DRAWN = (*(f"fitted {n}" for n in (6, 12, 16, 24, 32)), *(f"fixed {n}" for n in (50, 100, 400)))
FINE = Effort("adams", 1e-8, 0.3)
EFFORTS = (
    IN_BAND,
    Effort("adams", 1e-6, 0.9),
    DEFAULT,
    FINE,
)


def measure(*, quick: bool) -> list[dict[str, Any]]:
    """Vary tolerance and cap against the same model, and slices against 64 fitted nodes.

    All start from the settled state of the model they are compared with, but for the rows of an own start: there
    each model has settled by itself.
    """
    tolerances = TOLERANCES[::3] if quick else TOLERANCES
    caps = CAPS[::2] if quick else CAPS
    efforts = EFFORTS[::2] if quick else EFFORTS
    cases = [
        case("integration", OWN, OWN, Effort("adams", rtol, cap))
        for cap in caps
        for rtol in tolerances
    ]
    cases += [case("total", cut, TRUE, effort) for cut in CUTS for effort in efforts]
    own = [
        replace(case("total, own start", cut, TRUE, FINE), start=settled(0.1, cut)) for cut in CUTS
    ]
    cases += own
    return survey(cases, 1 if quick else 5)


def case(kind: str, cut: str, against: str, effort: Effort) -> Case:
    """Return a run on some slices, from the settled state of the model it is compared with."""
    true = truth(0.1, against)
    labels = {
        "error_of": kind,
        "slices": cut,
        "cap": effort.cap,
        "rtol": effort.rtol,
        "references_agree": true.agreement,
    }
    scene = integrated(bearing(cut=cut), effort)
    return Case(labels, scene, settled(0.1, against), true.signal)


def draw_chart(rows: list[dict[str, Any]], path: Path) -> None:
    """Draw what the tolerance buys beside what the nodes buy."""
    figure, (left, right) = draw.panels(
        ["Steps: with the cap any tolerance will do", "Nodes, at four settings of the steps"]
    )
    colours = {
        math.inf: draw.RED,
        IN_BAND.cap: draw.PURPLE,
        0.9: draw.BLUE,
        0.5: draw.ORANGE,
        0.25: draw.GREEN,
    }
    for cap, colour in colours.items():
        mine = [r for r in rows if (r["error_of"], r["cap"]) == ("integration", cap)]
        label = "no cap" if math.isinf(cap) else f"cap × {cap:g}"
        x = [r["evaluations"] for r in mine]
        draw.line(left, x, [r["error"] for r in mine], label, colour)
        draw.line(left, x, [r["error_in_band"] for r in mine], "", colour, style="o:")
    total = [r for r in rows if r["error_of"] == "total"]
    for cut in DRAWN:
        mine = [r for r in total if r["slices"] == cut]
        colour = draw.BLUE if cut.startswith("fitted") else draw.ORANGE
        front = sorted(mine, key=lambda r: r["wall_ms"])
        x, y = [r["wall_ms"] for r in front], [r["error"] for r in front]
        kind, count = cut.split()
        draw.line(right, x, y, f"{count} {'nodes' if kind == 'fitted' else 'fixed slices'}", colour)
    for cut in ("fitted 6", "fitted 16", "fitted 24"):
        floor = best([r for r in total if r["slices"] == cut], "wall_ms")[-1]["error"]
        draw.level(left, floor, f"model error, {cut.split()[1]} nodes")
    left.set(
        xlabel="evaluations for 6 ms", ylabel="relative error of outer.ay\n(dotted: below 20 kHz)"
    )
    right.set(xlabel="wall time for 6 ms, ms")
    draw.save(figure, path)
