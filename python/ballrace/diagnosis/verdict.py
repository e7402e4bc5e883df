"""Verdict from evidence: what is damaged, that nothing is, or what would decide.

Lines that chance does not explain are damage where they are deep, come from impacts and are not tiny, or unlikely
in sound bearings; otherwise they are left open, never called healthy: early damage, a distant sensor or a wrong
unit has such lines, too. Only a run, which no path and no sensor can have weakened, is cleared by strength.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Literal

from .combs import Part
from .likelihood import at_any_size
from .null import ACCUSED
from .strength import EXPLAINED

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from .bursts import Bursts
    from .evidence import Evidence
    from .sensitivity import Sensitivity

Verdicts = Literal["healthy", "damaged", "undecided"]

NAMES: dict[Part, str] = {
    "outer_race": "outer race", "inner_race": "inner race", "ball": "ball", "cage": "cage",
}  # fmt: skip

_DOUBT = 3.0
"""Factor on the false-alarm rate up to which a part is doubted, not cleared."""

UNLIKELY = 0.1
"""Likelihood ratio of sound to damaged below which weak lines of a race are damage (:meth:`Size.is_unlikely`).

Of a record of each run of the library, each bearing judged by all others (``benches/verdict_gates.py``), it makes
251 of 499 damaged ones named (219 by the limits of strength alone), of none a sound part more, and none of 216
healthy ones damaged.
"""

_OF_BURSTS = 0.3
"""Share of the false-alarm rate that bursts at the cage's rate may use: they are one question more than lines."""

_BESIDE = 0.5
"""Height and acceleration over those of the other race below which lines of a race are that one's sidebands.

Of five simulated 6205 with both races spalled none is below in both; one with an inner race alone
has 0.35 and 0.30.
"""

_TINY = 1e-3
"""Strength a·D²/v below which deep, impulsive lines may be those of a healthy bearing [m²/s].

Of 648 healthy records of the library twelve have deep lines of more than 3e-4 whose z is above 4.4, one of more
than 1e-3; four in ten of damaged races, most of them narrow or distant, have less. That of a 6205 of Case Western
Reserve University with a hole of 0.18 mm is 1.2e-3 (inner race) and more.
"""

_TINY_LOOSE: tuple[tuple[float, float], ...] = ((1.0, 1e-2), (4.0, 2e-3))
"""Limits of a·D²/v below multiples of gravity with which the turn of the cage presses balls to the outer race.

Below 1 unloaded balls fall off the race at the top and strike it one by one, at the rate of an outer race: 38 of
126 healthy records of ten simulated bearings from 625 to 6310 have lines of 3e-4 and more, up to 6.4e-3. Up to 4
they come loose in vibration (3 of 87, up to 1.5e-3).
"""

SIZES = 0.018, 0.125
"""Pitch diameters of the library's bearings, 6000 to 6316 and 6403 to 6414 [m]: for others no ratio decides.

Of 27 healthy records of a 6322 (``benches/verdict_set.py --seed 57 --bearings 2``) it would call two damaged.
That of a library with 200 more runs, of bearings up to a 6322, called two of 27 of a 6221 damaged (seed 58), whose
lines have 0.8 of the limits of strength.
"""

_BEYOND = 3.0
"""Factor on the limits of strength for sizes that the library does not have.

Light rings are shaken more: of 81 healthy records of a 606, a 628 and a 635 six are above the limits of the
library's sizes, up to 2.7 times. So are eight of 81 of a 6417, a 6324 and a 6418, up to 2.5 times, while no damage
of a race of these has less than 21 times the limit (``benches/verdict_set.py --seed 58`` and ``61``).
"""

_STRUCK = 0.5
"""Share of the acceleration of weak lines that impacts have to carry for their ratio to count."""

_HALF = 0.5
"""Share of the limits below which a ratio does not count.

Of 100 healthy runs with 2 % of noise, which the library has not, four have lines of up to 0.31 of them and ratios
of 0.01 to 0.1.
"""

_RINGING = 10.0
"""Factor on these limits for what rings without impacts: tones of a healthy bearing that meet a resonance.

A healthy 6308 at 3335 1/min, whose sixth line meets its mount at 1 kHz, has 1.4e-3; a spalled hub through a
resonance 5e-2.
"""

_FAINT = 0.2
"""Acceleration over the speed of the pitch circle below which lines of a run are no damage [m/s² per m/s].

Of simulated 6205 and 6309 on their pedestals at 900 to 1800 1/min under 150 to 1500 N and up to 200 N of thrust
healthy ones have up to 0.91 of it and spalled ones 1.06 and more, but for those of 0.3 mm on the outer race of the
6309 under 1500 N, 0.24 and 0.40.
"""

_SLOW = 0.5
"""Acceleration below which lines of a slow run may still be those of a healthy bearing [m/s²]: what unloaded
balls do to the cage and the races does not fade with the speed."""


@dataclass(frozen=True, kw_only=True)
class Size:
    """Size by which strength is judged.

    Attributes
    ----------
    diameter : float
        Pitch diameter [m].
    rate : float
        Rate of the shaft [Hz].
    pressed : float
        Acceleration with which the turn of the cage presses balls to the outer race, over gravity.
    """

    diameter: float
    rate: float
    pressed: float

    @property
    def faint(self) -> float:
        """Acceleration below which lines of a run are no damage [m/s²]."""
        return _FAINT * math.pi * self.diameter * self.rate

    def is_unlikely(self, one: Evidence) -> bool:
        """Return whether impacts carry a part's lines and sound simulated bearings hardly have such ones.

        Smaller and larger bearings than those of the library are not among these.
        """
        struck = one.strength.impulsive >= _STRUCK * one.strength.acceleration
        likely = one.ratio is not None and one.ratio < UNLIKELY
        known = SIZES[0] <= self.diameter <= SIZES[1]
        return struck and likely and known and not self.is_tiny(one, _HALF)

    def is_tiny(self, one: Evidence, share: float = 1.0) -> bool:
        """Return whether lines are below a share of the limit up to which a healthy bearing may have impacts."""
        tiny = next((limit for below, limit in _TINY_LOOSE if self.pressed < below), _TINY)
        tiny *= 1.0 if SIZES[0] <= self.diameter <= SIZES[1] else _BEYOND
        largest = max(one.strength.impulsive, one.strength.acceleration / _RINGING)
        return at_any_size(largest, self.diameter, self.rate) < share * tiny


@dataclass(frozen=True, kw_only=True)
class Verdict:
    """The verdict: ``healthy``, ``damaged`` with the parts, or ``undecided``; and why, in one sentence."""

    verdict: Verdicts
    parts: tuple[Part, ...]
    why: str


def decided(
    evidence: Mapping[Part, Evidence],
    false_alarm: float,
    *,
    size: Size | None,
    falls: bool,
    is_run: bool,
    bursts: Bursts | None,
    seen: Sensitivity | None,
    wanting: Sequence[str],
) -> Verdict:
    """Return the verdict.

    Parameters
    ----------
    evidence : mapping of str to Evidence
        Of each part.
    false_alarm : float
        Share of healthy records that may be called damaged.
    size : Size or None
        What strength is judged by; None where the unit of the record or the bearing's dimensions are not known.
    falls : bool
        Whether unloaded balls of a healthy bearing fall off the race at this speed.
    is_run : bool
        Whether the record is a run's own.
    bursts : Bursts or None
        Impacts that come and go with the cage; None where none do.
    seen : Sensitivity or None
        Damage that would have stood out; None where hardly any would.
    wanting : sequence of str
        What the record lacks for a statement that nothing is damaged, the gravest first.
    """
    ranked = sorted((evidence[part] for part in ACCUSED), key=lambda one: -one.z)
    cleared = [one for one in ranked if is_run and _is_faint(one, size)]
    left = [one for one in ranked if one not in cleared]
    own = [one for one in left if one.probability < false_alarm]
    own.sort(key=lambda one: -one.height)
    held = sum(one.strength.explained for one in own)
    not_sure = partial(_not_sure, size=size, falls=falls, is_run=is_run)
    open_ = {one.part: not_sure(one, held) for one in own}
    named = [one for one in own if open_[one.part] is None]
    if named:
        named = [one for one in named if not _is_of(one, named[0])]
        parts = tuple(one.part for one in named)
        is_weak = size is not None and named[0].part != "ball" and size.is_tiny(named[0])
        why = _supported(named[0]) if is_weak else _lines_of(named[0])
        return Verdict(verdict="damaged", parts=parts, why=why)
    is_tiny = size is not None and size.is_tiny(evidence["ball"])
    if bursts is not None and not is_tiny and bursts.probability < _OF_BURSTS * false_alarm:
        return Verdict(verdict="damaged", parts=("ball",), why=_burst(bursts))
    doubted = [one for one in left if false_alarm <= one.probability < _DOUBT * false_alarm]
    needs = [
        *filter(None, open_.values()),
        *map(_doubt, doubted),
        *map(_hidden, filter(_is_hidden, ranked)),
        *wanting,
        *([_BLIND] if seen is None and not is_run else []),
    ]
    if needs:
        return Verdict(verdict="undecided", parts=(), why=needs[0])
    strongest = [one for one in cleared if one.probability < false_alarm]
    if strongest and size is not None:
        return Verdict(verdict="healthy", parts=(), why=_faint(strongest[0], size.faint))
    nearest = f"{NAMES[ranked[0].part]}, come by chance in {_percent(ranked[0])} of records"
    would = "" if seen is None else f"; {seen}"
    why = f"no lines of a fault; the nearest, {nearest}{would}"
    return Verdict(verdict="healthy", parts=(), why=why)


_BLIND = "a longer record, or one with less noise: in this one hardly any damage would stand out"


def _is_faint(one: Evidence, size: Size | None) -> bool:
    """Whether lines of a run are so weak that a loaded healthy bearing has them; impacts of a ball it has not."""
    struck = one.part == "ball" and not (one.strength.is_shallow or one.strength.is_smooth)
    return size is not None and one.strength.acceleration < size.faint and not struck


def _is_of(one: Evidence, surer: Evidence) -> bool:
    """Return whether a race's low and weak lines are sidebands of the other race's: BPFO is Z f_r − BPFI."""
    return (
        {one.part, surer.part} == {"outer_race", "inner_race"}
        and one.height < _BESIDE * surer.height
        and one.strength.acceleration < _BESIDE * surer.strength.acceleration
    )


def _not_sure(
    one: Evidence, held: float, *, size: Size | None, falls: bool, is_run: bool
) -> str | None:
    """Return what would decide whether lines that stand out are damage; None where they are.

    All lines that stand out hold a share of what the vibration varies by; a run has no shocks from elsewhere.
    """
    if one.strength.is_shallow:
        return _shallow(one)
    if one.strength.is_sine:
        return _sine(one)
    if held < EXPLAINED and not is_run:
        return _elsewhere(one, held)
    if one.strength.is_smooth:
        return _smooth(one)
    if one.part == "ball":
        return None
    if size is None:
        return _falling(one) if falls else None
    if is_run and one.strength.acceleration < _SLOW:
        return _between(one)
    if size.is_tiny(one):
        if falls:
            return _falling(one)
        return None if not is_run and size.is_unlikely(one) else _weak(one)
    return None


def _is_hidden(one: Evidence) -> bool:
    return one.hidden > 0.5


def _lines_of(one: Evidence) -> str:
    lines = ", ".join(line.label for line in one.lines[:4]) or "lines"
    return f"{NAMES[one.part]}: {lines} stand out, as by chance in {_percent(one)} of records"


def _burst(bursts: Bursts) -> str:
    return (
        f"a ball is likely: impacts (kurtosis {bursts.kurtosis:.0f}) come and go with the cage and have the rate "
        f"of no race, as by chance in {_share(bursts.probability)} of records"
    )


def _supported(one: Evidence) -> str:
    return f"{_lines_of(one)}, and among simulated bearings are {_odds(one):.0f} times likelier with it damaged"


def _certain(one: Evidence) -> str:
    return f"lines of the {NAMES[one.part]} are certain (z {one.z:.0f})"


def _shallow(one: Evidence) -> str:
    depth, kurtosis = 100.0 * one.strength.depth, one.strength.kurtosis
    return (
        f"a record from when it was new, another load or place, or a trend: {_certain(one)}, but modulate the "
        f"vibration by {depth:.0f} % only (kurtosis {kurtosis:.1f}), as waves of a race or early damage do"
    )


def _sine(one: Evidence) -> str:
    return (
        f"another speed, or a record from when it was new: {_certain(one)}, but the vibration swells and fades as "
        "a sine does, as by hum of the mains, not as by impacts"
    )


def _elsewhere(one: Evidence, held: float) -> str:
    return (
        f"a longer record: {_certain(one)}, but hold {100.0 * held:.1g} % of what the vibration "
        "varies by: most impacts come at other times, as shocks from elsewhere do"
    )


def _smooth(one: Evidence) -> str:
    return (
        f"a record from when it was new, another load or place, or a trend: {_certain(one)}, but no impacts "
        f"stand out (kurtosis {one.strength.kurtosis:.1f}), as of balls in the load zone of a healthy bearing"
    )


def _weak(one: Evidence) -> str:
    return (
        f"another load or place, the record's unit, or a trend: {_certain(one)} and weak "
        f"({one.strength.acceleration:.2g} m/s²): early damage, a distant sensor, or a wrong unit"
    )


def _falling(one: Evidence) -> str:
    return (
        f"a record at a higher speed, one from when it was new, or a trend: {_certain(one)}, but at this speed "
        "unloaded balls of a healthy bearing fall off the race at the top and strike it as often"
    )


def _between(one: Evidence) -> str:
    return (
        f"a record from when it was new: lines of the {NAMES[one.part]} carry "
        f"{one.strength.acceleration:.2g} m/s², which a slow healthy bearing may have, too: up to {_SLOW:g}"
    )


def _faint(one: Evidence, faint: float) -> str:
    return (
        f"lines of the {NAMES[one.part]} are there, but carry {one.strength.acceleration:.2g} m/s² where damage "
        f"has more than {faint:.2g}: a loaded healthy bearing has such lines, too"
    )


def _doubt(one: Evidence) -> str:
    return (
        f"another or a longer record: lines of the {NAMES[one.part]} come by chance in {_percent(one)}, "
        "too often to call it damaged and too seldom to call it healthy"
    )


def _hidden(one: Evidence) -> str:
    return f"a longer record: most lines of the {NAMES[one.part]} lie on the shaft's or on what was excluded"


def _odds(one: Evidence) -> float:
    """Return how many times likelier what was found is with the part damaged than with it sound."""
    return math.inf if not one.ratio else 1.0 / one.ratio


def _percent(one: Evidence) -> str:
    return _share(one.probability)


def _share(probability: float) -> str:
    share = 100.0 * probability
    if share < 1e-3:
        return "less than 0.001 %"
    return f"{share:.{max(0, 1 - math.floor(math.log10(share)))}f} %"
