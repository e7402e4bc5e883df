"""Results at rest for every move of a control."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator
from dataclasses import dataclass

from ..errors import BallraceError, SceneWarning
from ..frequencies.operating import FaultFrequencies, fault_frequencies, rates_at_a_turn, spin_of
from ..ratings.life import RatingLife, rating_life
from ..scene import Scene
from ..scene.turning import constant_speeds
from ..statics import Equilibrium, LoadDistribution, Stiffness, load_distribution, stiffness


@dataclass(frozen=True, kw_only=True, eq=False)
class Live:
    """A bearing at rest in the cage's frame, without its damage.

    Attributes
    ----------
    scene : Scene
        As the controls say it, with its damage.
    around : LoadDistribution
        Loads of the balls all around.
    stiffness : Stiffness
        Tangent stiffness.
    life : RatingLife or None
        Rating life.
    no_life : str
        Why there is none.
    rates : tuple of FaultFrequencies
        Of each row, at the scene's speed [Hz], or at one turn a second where that changes.
    spin : tuple of float and int, or None
        Of a ball's damage, as :func:`ballrace.frequencies.operating.spin_of` has it.
    steady : bool
        Whether the speed is given and constant.
    doubts : tuple of str
        What was warned of.
    """

    scene: Scene
    around: LoadDistribution
    stiffness: Stiffness
    life: RatingLife | None
    no_life: str
    rates: tuple[FaultFrequencies, ...]
    spin: tuple[float, int] | None
    steady: bool
    doubts: tuple[str, ...]

    @property
    def equilibrium(self) -> Equilibrium:
        """Places of rings and balls."""
        return self.stiffness.equilibrium


def solved(scene: Scene) -> Live:
    """Solve a scene at rest; where its speeds are not given, or change, rates are orders.

    Raises
    ------
    SceneError
        A field is not usable.
    EquilibriumError
        The bearing cannot carry its load.
    """
    healthy = scene.replace({"defects": {}})
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", SceneWarning)
        tangent = stiffness(healthy)
        around = load_distribution(healthy)
        steady = constant_speeds(scene) is not None
        of_row = fault_frequencies if steady else rates_at_a_turn
        rates = tuple(of_row(healthy, row=k) for k in range(len(scene.rows)))
        life, why = _life(healthy, around)
        warned = (str(each.message) for each in caught)
        doubts = dict.fromkeys([*_apart(healthy, rates), *scene.doubts(), *warned])
    return Live(
        scene=scene,
        around=around,
        stiffness=tangent,
        life=life,
        no_life=why,
        rates=rates,
        spin=spin_of(scene, rates[0]) if scene.defects else None,
        steady=steady,
        doubts=tuple(doubts),
    )


def _apart(scene: Scene, rates: tuple[FaultFrequencies, ...]) -> Iterator[str]:
    """Yield rows of angular contact that thrust does not hold together."""
    for number, (row, found) in enumerate(zip(scene.rows, rates, strict=True)):
        if found.contact_angle < 0.5 * row.contact_angle:
            yield (
                f"row {number}: under load its contact angle is {math.degrees(found.contact_angle):.1f}° in "
                f"place of {math.degrees(row.contact_angle):.0f}°: with so little thrust the rings come apart"
            )


def _life(scene: Scene, around: LoadDistribution) -> tuple[RatingLife | None, str]:
    try:
        return rating_life(scene, around=around), ""
    except BallraceError as error:
        return None, str(error)
