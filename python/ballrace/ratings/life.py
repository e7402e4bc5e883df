"""Rating life: how many turns nine bearings of ten survive, after ISO 281 and ISO/TS 16281.

ISO 281 takes one equivalent load of the whole bearing. ISO/TS 16281 takes the loads of all balls instead, as
:func:`ballrace.load_distribution` has them, and so includes clearance, contact angles and rows that share
unevenly.
Both are of a healthy bearing, well lubricated and clean. Where a scene has an oil, its film and a class of
contamination give the factor a_ISO by which the second is modified. Loads that come again and again are summed
over their period (:mod:`ballrace.duty`).
"""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from .._base.numbers import positive
from ..bearings.rows import catalogue
from ..duty import duty_cycle
from ..errors import EquilibriumError, SceneError, SceneWarning
from ..scene.scene import checked_scene
from ..scene.turning import relative_speed
from ..statics import LoadDistribution, load_distribution
from .life_factor import Contamination, LifeFactor, check_contamination, life_factor
from .load_rating import equivalent_load, race_ratings, row_rating, static_rating, together

if TYPE_CHECKING:
    from ..bearings import Bearing
    from ..scene import Scene


@dataclass(frozen=True, kw_only=True, repr=False)
class RatingLife:
    """Rating life at 90 % reliability.

    Where loads or the speed change, all values are those of their whole period: lives by Miner's rule, every state
    weighted by its number of turns, and equivalent loads as the corresponding cubic means.

    Attributes
    ----------
    rating : float
        Basic dynamic load rating C of the whole bearing [N].
    source : str
        Where it comes from.
    outer_ratings, inner_ratings : tuple of float
        Rolling element loads for the basic rating of each row, Q_ce and Q_ci [N].
    outer_equivalent, inner_equivalent : tuple of float
        Equivalent loads of each row's races, Q_ee and Q_ei [N].
    reference : float
        Basic reference rating life L₁₀ᵣ after ISO/TS 16281 [turns], loads averaged over positions of the cage;
        infinite without load.
    one_position : float
        The same with the cage at the scene's start angles only [turns], as programs compute it that place a ball
        on the load line. With few balls the mean departs from it by −3 to +15 %.
    equivalent_load : float or None
        Dynamic equivalent load P after ISO 281 [N]; None where the bearing is no single deep groove row, or
        nothing loads the inner ring.
    basic : float or None
        Basic rating life L₁₀ = (C/P)³ after ISO 281 [turns]; None without P.
    speed : float or None
        Constant speed of the inner ring [rad/s]; None where it changes.
    modified : float or None
        Modified reference rating life L₁₀ₘᵣ = a_ISO L₁₀ᵣ after ISO/TS 16281 [turns]; None where a row has no oil,
        or nothing turns or loads the bearing.
    factor : LifeFactor or None
        a_ISO with the numbers it follows from, in the state of the shortest life; None where ``modified`` is.
    """

    rating: float
    source: str
    outer_ratings: tuple[float, ...]
    inner_ratings: tuple[float, ...]
    outer_equivalent: tuple[float, ...]
    inner_equivalent: tuple[float, ...]
    reference: float
    one_position: float
    equivalent_load: float | None
    basic: float | None
    speed: float | None
    modified: float | None = None
    factor: LifeFactor | None = None

    def hours(self, turns: float | None) -> float | None:
        """Return how long a number of turns takes at the scene's speed [h].

        None where the speed changes or is 0, and of a life that there is not.
        """
        if turns is None or not self.speed:
            return None
        return turns * 2.0 * math.pi / abs(self.speed) / 3600.0

    def __repr__(self) -> str:
        """Return the three lives in hours, or why there is none."""
        basic = (
            self._lasting(self.basic)
            if self.basic is not None
            else "none: P of ISO 281 is that of a single deep groove row under a load on its inner ring"
        )
        reference = f"{self._lasting(self.reference)}, {self._lasting(self.one_position)} by one cage position"
        if self.modified is None or self.factor is None:
            modified = "none: it needs an oil in every row, a speed and a load"
        else:
            ratio = "ν/ν₁" if self.factor.kappa_from == "viscosity" else "λ^1.3 of the film"
            of = f"a_ISO {self.factor.value:.3g}, κ {self.factor.kappa:.2f} = {ratio}"
            modified = f"{self._lasting(self.modified)} ({of})"
        return f"<RatingLife: L10 {basic}; L10r {reference}; L10mr {modified}>"

    def _lasting(self, turns: float) -> str:
        """Return a life in hours, or in turns where no speed says how long they take."""
        hours = self.hours(turns)
        return f"{turns:.4g} turns" if hours is None else f"{hours:.4g} h"


_LIGHT = 0.02
"""Share of the largest load of a cycle that shortens a life by less than 1e-5."""


@dataclass(frozen=True, kw_only=True)
class _State:
    """Life under steady loads."""

    share: float
    loads: LoadDistribution | None  # None: too light for an equilibrium
    equivalent: float | None
    reference: float
    one_position: float
    factor: LifeFactor | None


def rating_life(
    scene: Scene,
    rating: float | None = None,
    *,
    contamination: Contamination | float = "normal",
    around: LoadDistribution | None = None,
) -> RatingLife:
    """Return the rating life of a bearing under the loads of a scene, its defects left out.

    Where loads or the speed follow sines or tables, damage is summed over their common period (Miner's rule with
    the exponent 3 of ISO 281), as if all loads met the same place of the outer ring. A speed that ramps counts as
    the one it ends at.

    Parameters
    ----------
    scene : Scene
        The scene. The inner ring turns against the load, or the outer one where the scene says so.
    rating : float, optional
        Basic dynamic load rating C of the whole bearing [N], as its maker prints it. By default that of the
        catalogue if the scene's name is there with the same balls, else by the formula of ISO 281.
    contamination : Contamination or float
        How clean the oil is, one of the classes of ISO 281 from ``"extreme"`` cleanliness over ``"high"``,
        ``"normal"``, ``"slight"`` and ``"typical"`` contamination to ``"severe"`` and ``"very severe"``, or e_C
        itself, 0 to 1. It counts where the scene has an oil.
    around : LoadDistribution, optional
        The :func:`load_distribution` of the scene if it is already known, which saves nine tenths of the time. It
        is used where loads and speeds are constant.

    Returns
    -------
    RatingLife
        Lives in turns.

    Raises
    ------
    SceneError
        A field is not usable, a load ramps or has no period in common with the others, or the balls are too large
        for the table of ISO 281 and no rating is given.
    EquilibriumError
        There is no stable equilibrium.

    Warns
    -----
    SceneWarning
        As for :func:`equilibrium`, in the state of the shortest life.

    Examples
    --------
    >>> import ballrace as br
    >>> life = br.rating_life(br.bearing("6205", radial_load=1400.0, speed_rpm=1800.0))
    >>> life.rating, round(life.basic / 1e6)  # (14000/1400)³
    (14000.0, 1000)
    >>> 0.5 < life.reference / life.basic < 1.5
    True
    >>> oiled = br.bearing("6205", radial_load=1400.0, speed_rpm=1797.0, lubricant="vg68", temperature_c=55.0)
    >>> found = br.rating_life(oiled, contamination="slight")
    >>> round(found.factor.kappa, 1), found.factor.cleanliness, round(found.factor.value, 1)
    (2.0, 0.4, 4.0)
    >>> print(str(found).replace("; ", chr(10)))
    <RatingLife: L10 9275 h
    L10r 7838 h, 8030 h by one cage position
    L10mr 3.173e+04 h (a_ISO 4.05, κ 2.05 = ν/ν₁)>
    """
    healthy = replace(checked_scene(scene), defects={})
    if rating is not None:
        positive("rating", rating, "N")
    check_contamination(contamination)
    value, source = (rating, "given") if rating is not None else _rating(healthy)
    formulas = [row_rating(row) for row in healthy.rows]
    # A printed rating is shared by the rows as the formula shares it.
    scale = value / together(formulas)
    ratings = [
        race_ratings(row, scale * own) for row, own in zip(healthy.rows, formulas, strict=True)
    ]
    _check_around(around, healthy)
    cycle = _by_turns(duty_cycle(healthy))
    known = around if [scene for _, scene in cycle] == [healthy] else None
    with warnings.catch_warnings():
        # What belongs to the hardest state is reported below, once.
        warnings.simplefilter("ignore", SceneWarning)
        peak = max(_force(each) for _, each in cycle)
        states = [
            _state(
                share,
                each,
                around=known,
                rating=value,
                ratings=ratings,
                contamination=contamination,
                static_rating=_static_rating(healthy),
                peak=peak,
            )
            for share, each in cycle
        ]
    hardest = min(states, key=lambda state: state.reference)
    for text in hardest.loads.warnings if hardest.loads else ():
        warnings.warn(text, SceneWarning, stacklevel=2)
    equivalent = _mean_load([(state.share, state.equivalent) for state in states])
    outer, inner = (
        tuple(
            _mean_load([(s.share, _of_row(s.loads, name, row)) for s in states]) or 0.0
            for row in range(len(healthy.rows))
        )
        for name in ("outer_equivalent", "inner_equivalent")
    )
    return RatingLife(
        rating=value,
        source=source,
        outer_ratings=tuple(of_outer for of_outer, _ in ratings),
        inner_ratings=tuple(of_inner for _, of_inner in ratings),
        outer_equivalent=outer,
        inner_equivalent=inner,
        reference=_miner([(state.share, state.reference) for state in states]),
        one_position=_miner([(state.share, state.one_position) for state in states]),
        equivalent_load=equivalent,
        basic=_basic(value, equivalent) if equivalent else None,
        speed=relative_speed(healthy),
        modified=_modified(states),
        factor=hardest.factor,
    )


def _check_around(around: object, scene: Scene) -> None:
    """Refuse what is no distribution of as many balls."""
    balls = sum(row.ball_count for row in scene.rows)
    if isinstance(around, LoadDistribution):
        if (len(around.outer_equivalent), around.ball.size) != (len(scene.rows), balls):
            given = f"one of {around.ball.size} balls"
            raise SceneError("around", given, f"that of this scene, which has {balls}")
    elif around is not None:
        raise SceneError("around", f"a {type(around).__name__}", "a LoadDistribution, or None")


def _by_turns(cycle: list[tuple[float, Scene]]) -> list[tuple[float, Scene]]:
    """Return states with their shares of the turns in place of those of the time, where they differ."""
    turns = [share * abs(relative_speed(scene) or 0.0) for share, scene in cycle]
    if not sum(turns):
        return cycle
    return [
        (each / sum(turns), scene) for each, (_, scene) in zip(turns, cycle, strict=True) if each
    ]


def _state(
    share: float,
    scene: Scene,
    *,
    around: LoadDistribution | None,
    rating: float,
    ratings: list[tuple[float, float]],
    contamination: Contamination | float,
    static_rating: float,
    peak: float,
) -> _State:
    equivalent = equivalent_load(scene)
    try:
        loads = around or load_distribution(scene)
        once = load_distribution(scene, positions=1)
    except EquilibriumError:
        # Where a load crosses zero, nothing may hold a ring with clearance; the balls then carry next to nothing.
        if _force(scene) > _LIGHT * peak or scene.moments:
            raise
        return _State(
            share=share,
            loads=None,
            equivalent=equivalent,
            reference=math.inf,
            one_position=math.inf,
            factor=None,
        )
    reference = _reference(loads, ratings)
    load = rating * (1e6 / reference) ** (1.0 / 3.0)
    return _State(
        share=share,
        loads=loads,
        equivalent=equivalent,
        reference=reference,
        one_position=_reference(once, ratings),
        factor=life_factor(scene, load, contamination, static_rating) if load > 0.0 else None,
    )


def _reference(loads: LoadDistribution, ratings: list[tuple[float, float]]) -> float:
    """Return L₁₀ᵣ of the races' equivalent loads [turns]."""
    damage = sum(
        (loads.outer_equivalent[k] / of_outer) ** (10.0 / 3.0)
        + (loads.inner_equivalent[k] / of_inner) ** (10.0 / 3.0)
        for k, (of_outer, of_inner) in enumerate(ratings)
    )
    return 1e6 * float(damage) ** -0.9 if damage > 0.0 else math.inf


def _force(scene: Scene) -> float:
    """Return the size of all steady loads together [N]."""
    return sum(
        abs(load.force) for load in scene.loads.values() if isinstance(load.force, int | float)
    )


def _of_row(loads: LoadDistribution | None, name: str, row: int) -> float:
    return float(getattr(loads, name)[row]) if loads else 0.0


def _miner(lives: list[tuple[float, float]]) -> float:
    """Return the life of shares of the turns, each with its own life."""
    damage = sum(share / life for share, life in lives)
    return 1.0 / damage if damage > 0.0 else math.inf


def _basic(rating: float, load: float) -> float:
    """Return L₁₀; infinite under a load so small that no number has its life."""
    try:
        return 1e6 * (rating / load) ** 3
    except OverflowError:
        return math.inf


def _modified(states: list[_State]) -> float | None:
    """Return L₁₀ₘᵣ; None where a loaded state has no factor."""
    loaded = [state for state in states if not math.isinf(state.reference)]
    if not loaded or any(state.factor is None for state in loaded):
        return None
    return _miner([(s.share, s.factor.value * s.reference) for s in loaded if s.factor is not None])


def _mean_load(loads: list[tuple[float, float | None]]) -> float | None:
    """Return the cubic mean of loads with their shares of the turns; None where one is not known, or all are 0."""
    if any(load is None for _, load in loads):
        return None
    if len(loads) == 1:
        return loads[0][1] or None
    return float(sum(share * (load or 0.0) ** 3 for share, load in loads)) ** (1.0 / 3.0) or None


def _rating(scene: Scene) -> tuple[float, str]:
    """Return C [N], and where it comes from."""
    known = _known(scene)
    if known is not None:
        return known.dynamic_rating, f"catalogue: {known.sources.ratings}"
    return together([row_rating(row) for row in scene.rows]), "formula of ISO 281"


def _static_rating(scene: Scene) -> float:
    """Return C₀ [N], of the catalogue or by the formula of ISO 76."""
    known = _known(scene)
    if known is not None:
        return known.static_rating
    return sum(
        static_rating(row.ball_count, row.ball_diameter, row.pitch_diameter, row.contact_angle)
        for row in scene.rows
    )


def _known(scene: Scene) -> Bearing | None:
    """Return the bearing of the catalogue with the scene's name, if its balls are the scene's."""
    row = scene.rows[0]
    # By its designation alone: a scene may have any name.
    known = catalogue[scene.name] if scene.name in tuple(catalogue) else None
    if known is None or len(scene.rows) != known.row_count:
        return None
    same = (known.ball_count, known.ball_diameter, known.pitch_diameter) == (
        row.ball_count,
        row.ball_diameter,
        row.pitch_diameter,
    )
    return known if same else None
