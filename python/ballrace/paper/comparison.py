"""The table: published against ours."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping

    from .case import Case

AXIAL_LOADS = {"0": 0.0, "+3 kN": 3000.0, "-3 kN": -3000.0}
"""Axial loads of the paper by the name of their case [N]."""


@dataclass(frozen=True)
class Target:
    """A published statement as a number and what counts as meeting it.

    Attributes
    ----------
    key : str
        Name.
    figure : str
        Where it is published.
    what : str
        The quantity, with its unit.
    published : str
        As published.
    value : float or None
        The published number, if there is one.
    low, high : float
        Ours meets it from ``low`` to ``high``.
    """

    key: str
    figure: str
    what: str
    published: str
    value: float | None
    low: float
    high: float


_INF = math.inf
_SHIFT, _ZONE = ("0.05", 0.05, 0.045, 0.055), ("0.9", 0.9, 0.81, 0.99)
TARGETS = (
    Target("impact_change", "6", "impacts, 0 to +3 kN, %", "+30", 30.0, 22.0, 38.0),
    Target("impact_count", "6", "impacts counted, each load", "", None, 12, _INF),
    Target("ball_shift", "9", "ball shift, 0 to +3 kN, mm", *_SHIFT),
    Target("ball_shift_relative", "9", "the same, relative to the outer ring, mm", *_SHIFT),
    Target("support_share", "9", "outer ring's travel over ball shift", "", None, 0.0, 0.1),
    Target("zone_shift", "9", "contact zone's shift, 0 to +3 kN, mm", *_ZONE),
    Target("static_ball_shift", "9", "ball shift at rest, healthy, mm", *_SHIFT),
    Target("static_ball_shift_relative", "9", "the same, relative to the outer ring, mm", *_SHIFT),
    Target("static_zone_shift", "9", "contact zone's shift at rest, healthy, mm", *_ZONE),
    Target("force_away", "10", "ball force at -3 kN over the smaller other", "smaller", None, 0, 1),
    Target("zone_away", "10", "zone length at -3 kN over the smaller other", "smaller", None, 0, 1),
    Target("line_away", "11", "envelope line, -3 against +3 kN, dB", "quieter", None, -_INF, -12.0),
    Target(
        "clarity_away", "11", "line over its surroundings, -3 kN, dB", "none", None, -_INF, 10.0
    ),
    Target("scatter_away", "11", "scatter of impacts at -3 kN, %", "varying", None, 20.0, _INF),
    Target(
        "largest_away", "11", "largest acceleration at -3 kN, m/s²", "axis to 90", None, 30.0, 120.0
    ),
    Target("transient", "6, 11", "transient, rolling start, s", "0.02", 0.02, 0.01, 0.03),
    Target("start_at_rest", "", "equilibrium over rolling start, %", "", None, 0.0, 2.0),
)


@dataclass(frozen=True)
class Comparison:
    """A line of the table: a target, our number and the verdict.

    Attributes
    ----------
    target : Target
        What is published.
    ours : float
        Our number.
    """

    target: Target
    ours: float

    @property
    def met(self) -> bool:
        """Whether ours lies within the target's bounds."""
        return self.target.low <= self.ours <= self.target.high

    @property
    def deviation(self) -> float | None:
        """Ours over the published number, less 1; None where no number is published."""
        return None if self.target.value is None else self.ours / self.target.value - 1.0

    @property
    def wanted(self) -> str:
        """The bounds as text."""
        low, high = self.target.low, self.target.high
        if low == -_INF or (low == 0.0 and high < _INF):
            return f"≤ {high:g}"
        return f"≥ {low:g}" if high == _INF else f"{low:g} … {high:g}"

    def to_dict(self) -> dict[str, Any]:
        """Return the line as plain numbers and text."""
        named = {name: getattr(self.target, name) for name in ("key", "figure", "what")}
        return {
            **named,
            "published": self.target.published,
            "wanted": self.wanted,
            "ours": self.ours,
            "deviation": self.deviation,
            "met": self.met,
        }


def compare(cases: Mapping[str, Case]) -> tuple[Comparison, ...]:
    """Return the table: every published number beside ours.

    Parameters
    ----------
    cases : mapping of str to Case
        By the names in :data:`AXIAL_LOADS`.
    """
    none, towards, away = (cases[name] for name in AXIAL_LOADS)
    before, after, third = none.snapshot, towards.snapshot, away.snapshot
    ball = float(after.balls.z[after.middle] - before.balls.z[before.middle])
    outer = after.outer_z - before.outer_z
    at_rest = towards.static.ball_z - none.static.ball_z
    at_rest_outer = towards.static.outer_z - none.static.outer_z
    ours = {
        "impact_change": 100.0 * (towards.dynamic.impact / none.dynamic.impact - 1.0),
        "impact_count": min(case.dynamic.impact_count for case in cases.values()),
        "ball_shift": 1e3 * ball,
        "ball_shift_relative": 1e3 * (ball - outer),
        "support_share": abs(outer / ball),
        "zone_shift": 1e3 * (after.zone.middle - before.zone.middle),
        "static_ball_shift": 1e3 * at_rest,
        "static_ball_shift_relative": 1e3 * (at_rest - at_rest_outer),
        "static_zone_shift": 1e3 * (towards.static.zone_middle - none.static.zone_middle),
        "force_away": third.zone.force / min(before.zone.force, after.zone.force),
        "zone_away": third.zone.length / min(before.zone.length, after.zone.length),
        "line_away": 20.0 * math.log10(away.dynamic.line / towards.dynamic.line),
        "clarity_away": away.dynamic.clarity,
        "scatter_away": 100.0 * away.dynamic.impact_spread / away.dynamic.impact,
        "largest_away": away.dynamic.largest,
        "transient": max(case.transient for case in cases.values()),
        "start_at_rest": 100.0 * max(case.start_at_rest for case in cases.values()),
    }
    return tuple(Comparison(target, float(ours[target.key])) for target in TARGETS)
