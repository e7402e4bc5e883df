"""Load cases of the paper, run and compared."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import presets
from ..signals import Signals
from .case import Case
from .comparison import AXIAL_LOADS, Comparison, compare
from .measures import ENVELOPE_BAND
from .simulations import FS, INSTANT, SIGNALS, VISIBLE, dynamic, from_start, load_case

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..scene import Scene

DURATION = 0.11
"""Simulated time of a case: thirteen impacts after the transient [s]."""

MEASURED = ("0", "+3 kN")
"""Axial loads of figure 5, by the names of :data:`AXIAL_LOADS`."""

MEASURED_RADIAL_LOAD = 5000.0
"""Radial load of the measured signals of figure 5 [N]; those that the paper simulates have 7000."""


@dataclass(frozen=True)
class Paper:
    """The paper's cases and the table.

    Attributes
    ----------
    cases : mapping of str to Case
        By the names in :data:`AXIAL_LOADS`.
    table : tuple of Comparison
        Published against ours.
    as_measured : mapping of str to Signals
        Runs under the loads of figure 5's measurements, 0 and +3 kN beside 5 kN.
    """

    cases: Mapping[str, Case]
    table: tuple[Comparison, ...]
    as_measured: Mapping[str, Signals]

    def to_dict(self) -> dict[str, Any]:
        """Return every number: the table, and each case's features, ready for JSON."""
        return {
            "table": [line.to_dict() for line in self.table],
            "cases": {name: _numbers(case) for name, case in self.cases.items()},
            "as_measured": {name: asdict(dynamic(out)) for name, out in self.as_measured.items()},
            "instant": INSTANT,
            "sampling_rate": FS,
            "signals": SIGNALS,
            "impact_filter": "none",
            "envelope_band": list(ENVELOPE_BAND),
            "scene": json.loads(next(iter(self.cases.values())).signals.scene.to_json()),
        }


def _numbers(case: Case) -> dict[str, Any]:
    balls, k = case.snapshot.balls, case.snapshot.middle
    return {
        "dynamic": asdict(case.dynamic),
        "static": asdict(case.static),
        "middle_ball": {
            "ball": int(balls.ball[k]),
            "angle_deg": float(np.degrees(balls.angle[k])),
            "z": float(balls.z[k]),
            "outer_z": case.snapshot.outer_z,
            "outer_load": float(balls.outer_load[k]),
            "inner_load": float(balls.inner_load[k]),
            "zone": asdict(case.snapshot.zone),
        },
        "transient": case.transient,
        "start_at_rest": case.start_at_rest,
        "evaluations": int(case.signals.stats.nfev),
    }


def bearing(axial_load: float = 0.0) -> Scene:
    """Return the bearing that is compared, the preset ``wheel_bearing`` lightly damped."""
    return presets.wheel_bearing(axial_load, damping="light")


def run(
    scene_at: Callable[[float], Scene] = bearing,
    *,
    duration: float = DURATION,
    threads: int = 0,
    progress: Callable[[float], object] | None = None,
) -> Paper:
    """Run the published cases and compare.

    Parameters
    ----------
    scene_at : callable
        Gives the scene for an axial load [N], with a load named ``radial``; by default :func:`bearing`.
    duration : float
        Simulated time of each case [s]; below 0.1 there are fewer than the twelve impacts asked for.
    threads : int
        Threads of a run; 0: chosen automatically.
    progress : callable, optional
        Is given the share done, from 0 to 1.

    Returns
    -------
    Paper
        Cases and table.

    Raises
    ------
    SceneError
        ``duration`` is too short for an impact after the transient.
    """
    steps = len(AXIAL_LOADS) + 1
    cases: dict[str, Case] = {}
    level = None
    for done, (name, axial_load) in enumerate(AXIAL_LOADS.items()):

        def show(share: float, done: int = done) -> None:
            if progress is not None:
                progress((done + share) / steps)

        cases[name] = load_case(scene_at(axial_load), duration, threads, show, level)
        level = VISIBLE * cases["0"].dynamic.impact
    as_measured = {}
    for done, name in enumerate(MEASURED):
        lighter = scene_at(AXIAL_LOADS[name]).replace({"loads.radial.force": MEASURED_RADIAL_LOAD})
        as_measured[name] = from_start(lighter, duration, threads)
        if progress is not None:
            progress((len(AXIAL_LOADS) + (done + 1) / len(MEASURED)) / steps)
    return Paper(cases, compare(cases), as_measured)
