"""The wheel bearing: our runs, the reference of all, and what others are held to."""

from __future__ import annotations

import json
import math
import sys
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

import ballrace as br
from numba_bearing import Bearing

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

from .measuring import Case, relative, timed

DURATION, FS = 6e-3, 50_000.0
COUNTS = [{"fitted": n} for n in (4, 6, 8, 12, 16, 24, 32)] + [
    {"fixed": n} for n in (50, 100, 200, 400)
]
CONVERGED = {"fitted": 64}
SHIPPED = "ballrace as shipped"
TIMES = np.arange(round(DURATION * FS)) / FS


class Wheel:
    """The scene on one kind of slices, its start and its signal."""

    def __init__(self, slices: dict[str, int]) -> None:
        (kind, count), *_ = slices.items()
        self.kind = f"{count} {'nodes' if kind == 'fitted' else 'slices'}"
        self.scene = br.presets.wheel_bearing(3000.0).replace({"contact.slices": slices})
        self.model = br.Model(self.scene)
        self.start = self.model.start("equilibrium")
        self.cap = self.signals(1e-6).provenance["max_step"]

    @cached_property
    def truth(self) -> Array:
        """The acceleration, integrated tightly: on 64 nodes the reference of all."""
        return acceleration(self.signals(1e-10, self.cap / 10))

    @property
    def doubt(self) -> float:
        """How far a less tight integration is from it."""
        return relative(acceleration(self.signals(1e-9, self.cap / 5)), self.truth)

    def signals(
        self,
        rtol: float,
        step: float | None = None,
        duration: float = DURATION,
        probes: dict[str, Any] | None = None,
    ) -> br.Signals:
        """Run; without a step the default cap holds."""
        changes: dict[str, Any] = {}
        if step is not None:
            changes = {"solver.max_step": step, "solver.frequency_cap": False}
        scene = self.scene.replace(changes)
        scene = scene if probes is None else replace(scene, probes=probes)
        return br.simulate(
            scene, duration=duration, fs=FS, start=self.start, rtol=rtol, threads=1, bandwidth=None
        )

    def states(self, every: int) -> Array:
        """States along the run, shape (states, dim)."""
        bodies = list(self.model.bodies)
        probes = {f"b{i}": br.scene.MotionProbe(body=body) for i, body in enumerate(bodies)}
        out = self.signals(1e-6, probes=probes)
        parts = (name.rpartition(".") for name in self.model.names)
        return np.stack([out[f"b{bodies.index(b)}.{q}"][::every] for b, _, q in parts], axis=1)

    def scale(self) -> Array:
        """Return what the tolerance is a share of, for every state."""
        approach = float(br.equilibrium(self.scene).outer_deflection.max())
        row = self.scene.rows[0]
        radius = np.full(len(self.model.bodies), row.ball_diameter / 2)
        radius[:2] = row.pitch_diameter / 2
        one = np.ones_like(radius)
        position = approach * np.stack([one, one, one, 1 / radius], axis=1).ravel()
        return np.concatenate([position, position / self.cap])

    def evaluation(self) -> float:
        """Seconds an evaluation in a run; the difference of two runs leaves their set-up out."""
        short, few = timed(lambda: self.signals(1e-6, duration=DURATION / 8))
        long, many = timed(lambda: self.signals(1e-6))
        return (long - short) / (many.stats.nfev - few.stats.nfev)


def acceleration(out: br.Signals) -> Array:
    """Stack the outer ring's acceleration."""
    return np.stack([out[f"outer.{a}"] for a in ("ax", "ay", "az")])


@dataclass(frozen=True)
class Problem:
    """What another program integrates, with a right-hand side of its own, judged by the converged wheel."""

    kind: str
    bearing: Bearing
    start: Array
    converged: Wheel

    def acceleration(self, states: Array) -> Array:
        """Return the outer ring's acceleration in states, shape (states, dim)."""
        half = states.shape[1] // 2
        found = [self.bearing(0.0, np.ascontiguousarray(y))[half : half + 3] for y in states]
        return np.stack(found, axis=1)


def problems(slices: Wheel, converged: Wheel, nodes: Iterable[int]) -> list[Problem]:
    """On fixed slices and on numbers of Gauss nodes."""
    by_gauss = [
        Problem(f"{n} Gauss nodes", Bearing(slices.scene, n), converged.start, converged)
        for n in nodes
    ]
    return [Problem(slices.kind, Bearing(slices.scene), slices.start, converged), *by_gauss]


def settings(
    cap: float, tolerances: list[float], factors: Iterable[float]
) -> list[tuple[str, float, float]]:
    """Names, tolerances and largest steps, the step free and capped."""
    names = {1.0: "cap", math.inf: "free"}
    return [
        (f"{r:.0e}, {names.get(factor, f'{factor:g} × cap')}", r, factor * cap)
        for factor in factors
        for r in tolerances
    ]


def our_cases(wheel: Wheel, truth: Array, tolerances: list[float]) -> list[Case]:
    """Ours at all settings."""

    def run(rtol: float, step: float) -> tuple[float, Array]:
        seconds, out = timed(lambda: wheel.signals(rtol, min(step, 1.0)))
        return seconds, acceleration(out)

    return [
        Case("ballrace", f"{wheel.kind}, {name}", lambda r=rtol, h=step: run(r, h), truth)
        for name, rtol, step in settings(wheel.cap, tolerances, (0.5, 1.0, 2.0, math.inf))
    ]


def shipped(truth: Array) -> Case:
    """Ours with every setting left alone, but for the start and one thread."""
    scene = br.presets.wheel_bearing(3000.0)
    start = br.Model(scene).start("equilibrium")

    def run() -> tuple[float, Array]:
        seconds, out = timed(
            lambda: br.simulate(
                scene, duration=DURATION, fs=FS, start=start, threads=1, bandwidth=None
            )
        )
        return seconds, acceleration(out)

    return Case(SHIPPED, "6 nodes, rtol 1e-7, cap", run, truth)


class Judge:
    """Differences of right-hand sides relative to the sums of magnitudes, by the tests' slow reference."""

    def __init__(self, wheel: Wheel, states: Array) -> None:
        import reference

        slow = reference.Reference(json.loads(wheel.scene.to_json()))
        self.states, self.model, self.sizes = [], wheel.model, []
        self.in_defect = 0
        for y in states:
            # Next to a switching threshold two roundings are two answers.
            if slow.threshold_distance(y) < 1e-12:
                continue
            # Round-off of 1e-16 m in a lightly loaded contact is 1e-8 N.
            size = np.maximum(slow.magnitudes, [10.0, 10.0, 10.0, 0.1])
            self.in_defect += slow.active["edge"] > 0
            self.states.append(y)
            self.sizes.append(np.where(slow.fixed(), np.inf, size / np.maximum(slow.mass, 1e-300)))

    def worst(self, derivatives: Iterable[Array]) -> float:
        """Largest difference of the given derivatives from those of the model."""
        worst = 0.0
        for y, dy, size in zip(self.states, derivatives, self.sizes, strict=True):
            half = y.size // 2
            off = np.abs(dy - self.model.rhs(0.0, y))[half:].reshape(-1, 4)
            worst = max(worst, float(np.max(off / size)))
        return worst


def hold(what: str, judge: Judge, derivatives: Iterable[Array]) -> None:
    """End the run where a peer solves another problem."""
    worst = judge.worst(derivatives)
    print(
        f"{what} against Model.rhs: {worst:.1e} of the sums of magnitudes "
        f"({len(judge.states)} states, {judge.in_defect} in the defect)"
    )
    if not (worst <= 1e-9 and judge.in_defect > 0):
        sys.exit(f"{what} is another model")
