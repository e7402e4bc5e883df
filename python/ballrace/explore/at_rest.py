"""Results at rest, in words and numbers."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from .._base.html import paragraph, points, table
from ..report import words

if TYPE_CHECKING:
    from ..ratings.life import RatingLife
    from .live import Live


def page(live: Live) -> str:
    """Return the text beside the drawings, as HTML."""
    what = [[name, value] for name, value in numbers(live).items()]
    rates = table(("row", "per", *_FAULTS), _rates(live))
    speed = "" if live.steady else " The speed changes: orders alone."
    doubts = points(live.doubts)
    lines = paragraph("Fault frequencies", f"at the contact angles under load.{speed}")
    return f'<div class="facts">{doubts}{table(("at rest", ""), what)}{lines}{rates}</div>'


_FAULTS = ("shaft", "FTF", "BPFO", "BPFI", "2·BSF")


def numbers(live: Live) -> dict[str, str]:
    """Return what is solved by its names, with units."""
    eq, tangent = live.equilibrium, live.stiffness
    loaded = int(np.count_nonzero(eq.loaded))
    angles = np.degrees(np.abs(eq.outer_angle[eq.outer_load > 0.0]))
    soft, stiff = 1e-6 * tangent.radial
    moved = ", ".join(f"{1e6 * each:z.1f}" for each in eq.inner - eq.outer)
    found = {
        "balls loaded": f"{loaded} of {eq.ball.size}",
        "largest load": f"{max(eq.outer_load.max(), eq.inner_load.max()):.0f} N",
        "contact angles": f"{angles.min():.1f} to {angles.max():.1f}°" if angles.size else "–",
        "largest pressure, outer race": f"{1e-6 * eq.outer_pressure.max():.0f} MPa",
        "largest pressure, inner race": f"{1e-6 * eq.inner_pressure.max():.0f} MPa",
        "inner against outer ring": f"{moved} µm along x, y, z",
        "radial stiffness": f"{soft:.1f} to {stiff:.1f} N/µm",
        "axial stiffness": f"{1e-6 * tangent.axial:.1f} N/µm",
        **_tilt(live),
        **_films(live),
    }
    return found | _life(live.life, live.no_life)


def _tilt(live: Live) -> dict[str, str]:
    eq = live.equilibrium
    if live.scene.moments or np.any(eq.inner_tilt != 0.0):
        return {"tilt about x, y": ", ".join(f"{1e3 * t:z.2f}" for t in eq.inner_tilt) + " mrad"}
    held = math.hypot(*eq.inner_moment)
    return {"moment that holds the rings parallel": f"{held:.2f} N m"}


def _films(live: Live) -> dict[str, str]:
    films = live.equilibrium.films
    if not films:
        return {"oil film": "none: dry"}
    thinnest = min(films, key=lambda film: film.lambda_ratio)
    text = f"{1e6 * thinnest.film:.2f} µm, {thinnest.lambda_ratio:.1f} times the roughness (Λ)"
    return {f"oil film, {thinnest.race} race": text}


def _life(life: RatingLife | None, why: str) -> dict[str, str]:
    if life is None:
        return {"rating life": f"none: {why}"}
    lives = {
        "L₁₀, ISO 281": life.basic,
        "L₁₀ᵣ, ISO/TS 16281": life.reference,
        "L₁₀ᵣ at one cage position": life.one_position,
        "L₁₀ₘᵣ, with its oil": life.modified,
    }
    return {name: words.lasting(life, turns) for name, turns in lives.items() if turns is not None}


def _rates(live: Live) -> list[list[str]]:
    rows = []
    for number, found in enumerate(live.rates):
        hertz = np.array([found.shaft, found.ftf, found.bpfo, found.bpfi, 2.0 * found.bsf])
        if live.steady:
            rows.append([str(number), "s (Hz)", *(f"{f:.2f}" for f in hertz)])
        rows.append([str(number), "turn", *(f"{f:.4f}" for f in hertz / found.shaft)])
    return rows
