"""The bearing of a report: drawn, and what its contacts carry."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..errors import BallraceError
from ..ratings.life import RatingLife, rating_life
from ..statics import Equilibrium, LoadDistribution, equilibrium, load_distribution
from . import words

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..scene import Scene
    from .page import Page


def add_bearing(page: Page, scene: Scene, operation: Sequence[tuple[str, str]]) -> None:
    """Add the measures of the bearing with facts of its operation, and a drawing of it."""
    from .. import plot
    from ..plot.outlines import outlines

    page.facts([*words.bearing(scene), *operation])
    assumed = (
        " Its boundary dimensions are not given, and drawn as common."
        if outlines(scene).assumed
        else ""
    )
    page.figure(
        plot.section(scene),
        f"the bearing cut through its axis, at its nominal contact angle.{assumed}",
    )


def add_loads(page: Page, scene: Scene) -> None:
    """Add the loads of the balls, pressures, and rating life; or why there are none."""
    from .. import plot

    page.section("Ball loads, contact pressure and rating life")
    healthy = scene.replace({"defects": {}})
    try:
        eq, around = equilibrium(healthy), load_distribution(scene)
    except BallraceError as error:
        page.warning(f"no static solution: {error}")
        return
    page.text(
        "At rest in the cage's frame, without defects, under the loads at their first instant."
    )
    page.figure(plot.load_distribution(around), "load of a ball on the outer race over its place.")
    _add_pressures(page, eq, len(scene.rows))
    _add_life(page, scene, around)


def _add_pressures(page: Page, eq: Equilibrium, rows: int) -> None:
    table = []
    for row in range(rows):
        for race in ("outer", "inner"):
            own = eq.row == row
            load = getattr(eq, f"{race}_load")[own]
            angles = np.abs(getattr(eq, f"{race}_angle")[own][load > 0.0])
            spread = (
                f"{words.degrees(angles.min())} to {words.degrees(angles.max())}"
                if angles.size
                else "–"
            )
            pressure = 1e-6 * float(getattr(eq, f"{race}_pressure")[own].max())
            loaded = f"{np.count_nonzero(eq.loaded[own])} of {load.size}"
            cells = [loaded, f"{load.max():.0f}", f"{pressure:.0f}", spread]
            table.append([f"row {row}, {race} race", *cells])
    page.table(
        [
            "contacts",
            "balls loaded",
            "largest load, N",
            "largest Hertz pressure, MPa",
            "contact angles",
        ],
        table,
    )
    page.text("The static load rating of ball bearings (ISO 76) stands for a pressure of 4200 MPa.")


def _add_life(page: Page, scene: Scene, around: LoadDistribution) -> None:
    try:
        life = rating_life(scene, around=around)
    except BallraceError as error:
        page.text(f"No rating life: {error}.")
        return
    page.facts(_life(life))
    page.text(
        "Lives are of the bearing without its defects, at 90 % reliability. ISO 281 takes one equivalent load; "
        "ISO/TS 16281 takes the load of every ball, so clearance and contact angles count, here in the mean over "
        "a turn of the cage; programs that place a ball on the load line have the life at one place of it. Loads "
        "that change are summed over their period (Miner's rule). "
        + (
            "No oil is known: lubrication and contamination (a_ISO of ISO 281) are left out."
            if life.factor is None
            else "The modified life knows the oil's viscosity, and takes its cleanliness for normal."
        )
    )


def _life(life: RatingLife) -> list[tuple[str, str]]:
    entries = [("Basic dynamic load rating C", f"{words.large(life.rating)} N ({life.source})")]
    if life.equivalent_load is not None and life.basic is not None:
        entries.append(("Equivalent load P, ISO 281", f"{words.large(life.equivalent_load)} N"))
        entries.append(("Basic rating life L₁₀, ISO 281", words.lasting(life, life.basic)))
    entries.append(
        ("Basic reference rating life L₁₀ᵣ, ISO/TS 16281", words.lasting(life, life.reference))
    )
    entries.append(
        ("The same with the cage at one place only", words.lasting(life, life.one_position))
    )
    if life.modified is not None and life.factor is not None:
        ratio = "ν/ν₁" if life.factor.kappa_from == "viscosity" else "λ^1.3"
        of = f"a_ISO {life.factor.value:.2g}, κ {life.factor.kappa:.2g} = {ratio}"
        entries.append((f"Modified life L₁₀ₘᵣ, {of}", words.lasting(life, life.modified)))
    return entries
