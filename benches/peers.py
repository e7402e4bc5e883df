"""Beside other programs, all in one run: what the same bearing costs them at the same error. For developers.

    python benches/peers.py --quick       # about two minutes on an idle core
    python benches/peers.py -o FOLDER     # everything; tables on the screen, and peers.csv in the folder

The scene is the preset ``wheel_bearing`` under 3 kN of thrust: two rows, an outer-race defect, friction.

1. *Slices*: what a number of slices or nodes costs and what it errs in the outer ring's acceleration, all three
   components, relative L2 over 6 ms from equilibrium with one impact, against 64 fitted nodes, integrated tightly.
2. *Right-hand side*: numba (`numba_bearing.py`) on 200 fixed slices, first held to ``Model.rhs``, then timed over
   states along the run. Ours is timed as a run over its evaluations, the integrator's own work included.
3. *A run* of the same 6 ms: SciPy's ``RK45`` and ``LSODA`` with the numba right-hand side, Octave's ``ode45``
   with a vectorised one (`octave_bearing.m`), ours on the same 200 slices, on its default of six fitted nodes, and
   on the fewest nodes that err no more than 200 slices do. Tolerances are swept with the step free, capped as we
   cap it, and (ours) at twice the cap. The error is that of the integration alone: against our integrator on the
   same slices at rtol 1e-10 with a tenth of the cap, which DOP853 confirms for 200 slices.
4. *Exudyn* (extra ``validation``) on the healthy 6205 of ``tests/python/test_exudyn.py``, steps swept; each
   program against its own converged solution over 3 ms, and timed over 20 ms.

Tolerances are one number times a scale for each kind of state, the same for all: the approach of a loaded contact
for lengths, times the highest contact frequency for speeds. SciPy's and Octave's relative part is off, since 36 mm
of position say nothing about what error of it matters; with it on LSODA takes many times longer.

Times are processor times of one thread: on an idle machine wall time, and on a loaded one still comparable.
Peers alternate in rounds; a ratio is the median of the rounds' ratios, with their range. "At 1 %" is interpolated
on a program's front of error and cost; where all its settings do better, it is the cheapest one.
Needs the extras ``bench`` and ``test``; what is not installed is skipped, and said so.
"""

from __future__ import annotations

import argparse
import csv
import importlib.metadata
import importlib.util
import json
import math
import os
import platform
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy.io
from numba_bearing import Bearing
from scipy.integrate import solve_ivp

import ballrace as br

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

HERE = Path(__file__).parent
sys.path.append(str(HERE.parent / "tests" / "python"))

DURATION, FS = 6e-3, 50_000.0
TARGET = 1e-2
ABSOLUTE = 2.3e-14
"""SciPy's least relative tolerance."""
COUNTS = [{"fitted": n} for n in (4, 6, 8, 12, 16, 24, 32)] + [
    {"fixed": n} for n in (50, 100, 200, 400)
]
CONVERGED = {"fitted": 64}


@dataclass
class Case:
    """One setting of one program; `run` returns seconds and a signal of shape (components, samples)."""

    peer: str
    setting: str
    run: Callable[[], tuple[float, Array]]
    truth: Array
    once: bool = False
    error: float = math.nan
    seconds: list[float] = field(default_factory=list)


@dataclass(frozen=True)
class Row:
    """One line of the result."""

    what: str
    setting: str
    unit: str
    median: float
    low: float
    high: float
    error: float = math.nan


def row(
    what: str, setting: str, unit: str, values: Iterable[float], error: float = math.nan
) -> Row:
    """Median and range of some values."""
    found = list(values)
    return Row(what, setting, unit, statistics.median(found), min(found), max(found), error)


def timed(work: Callable[[], Any]) -> tuple[float, Any]:
    """Seconds of the processor, and what the work gave."""
    begun = time.process_time()
    result = work()
    return time.process_time() - begun, result


def relative(signal: Array, truth: Array) -> float:
    """Relative L2 error; infinite for a run that broke off."""
    if signal.shape != truth.shape or not np.isfinite(signal).all():
        return math.inf
    return float(np.linalg.norm(signal - truth) / np.linalg.norm(truth))


# ------------------------------------------------------------------------------------ machine


def machine() -> str:
    """Processor, cores, versions."""
    bearing = br.presets.deep_groove_6205()
    simd = br.simulate(bearing, duration=1e-5, fs=1e6).provenance["simd"]
    names = ["ballrace", "numpy", "numba", "scipy", "exudyn"]
    found = [f"{n} {importlib.metadata.version(n)}" for n in names if importlib.util.find_spec(n)]
    if shutil.which("octave-cli"):
        text = subprocess.run(
            ["octave-cli", "--version"], capture_output=True, text=True, check=True
        )
        found.append(text.stdout.splitlines()[0])
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        cpu = next(x.partition(":")[2].strip() for x in lines if x.startswith("model name"))
    except (OSError, StopIteration):
        cpu = platform.processor()
    load = f", load {os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else ""
    versions = ", ".join([f"Python {platform.python_version()}", *found])
    return f"{cpu}, {os.cpu_count()} cores{load}; SIMD {simd}; {versions}"


# ------------------------------------------------------------------------------------ the wheel bearing


class Wheel:
    """The scene on one kind of slices, its start and its reference."""

    def __init__(self, slices: dict[str, int]) -> None:
        (kind, count), *_ = slices.items()
        self.name = f"ballrace, {count} {'nodes' if kind == 'fitted' else 'slices'}"
        self.scene = br.presets.wheel_bearing(3000.0).replace({"contact.slices": slices})
        self.model = br.Model(self.scene)
        self.start = self.model.start("equilibrium")
        self.cap = self.signals(1e-6).provenance["max_step"]

    @cached_property
    def truth(self) -> Array:
        """The acceleration, integrated tightly."""
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


def settings(
    wheel: Wheel, tolerances: list[float], *factors: float
) -> list[tuple[str, float, float]]:
    """Names, tolerances and largest steps, the step free and capped."""
    names = {1.0: "cap", math.inf: "free"}
    return [
        (f"{r:.0e}, {names.get(factor, f'{factor:g} × cap')}", r, factor * wheel.cap)
        for factor in factors
        for r in tolerances
    ]


def our_cases(wheel: Wheel, tolerances: list[float]) -> list[Case]:
    """Ours at all settings."""

    def run(rtol: float, step: float) -> tuple[float, Array]:
        seconds, out = timed(lambda: wheel.signals(rtol, min(step, 1.0)))
        return seconds, acceleration(out)

    return [
        Case(wheel.name, name, lambda r=rtol, h=step: run(r, h), wheel.truth)
        for name, rtol, step in settings(wheel, tolerances, 1.0, 2.0, math.inf)
    ]


class Scipy:
    """SciPy's methods with the numba right-hand side."""

    def __init__(self, wheel: Wheel, bearing: Bearing) -> None:
        self.wheel, self.bearing, self.scale = wheel, bearing, wheel.scale()
        self.times = np.arange(round(DURATION * FS)) / FS

    def run(self, method: str, tolerance: float, step: float) -> tuple[float, Array]:
        """Seconds and the outer ring's acceleration."""
        seconds, found = timed(
            lambda: solve_ivp(
                self.bearing,
                (0.0, DURATION),
                self.wheel.start,
                method,
                t_eval=self.times,
                rtol=ABSOLUTE,
                atol=tolerance * self.scale,
                max_step=step,
            )
        )
        half = found.y.shape[0] // 2
        derivatives = [self.bearing(0.0, np.ascontiguousarray(y)) for y in found.y.T]
        return seconds, np.stack(derivatives)[:, half : half + 3].T

    def cases(self, tolerances: list[float]) -> list[Case]:
        """All settings."""
        return [
            Case(
                f"scipy {method}, numba, 200 slices",
                name,
                lambda m=method, r=tolerance, h=step: self.run(m, r, h),
                self.wheel.truth,
            )
            for method in ("RK45", "LSODA")
            for name, tolerance, step in settings(self.wheel, tolerances, 1.0, math.inf)
        ]


# ------------------------------------------------------------------------------------ right-hand sides


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


def slice_errors(rounds: int) -> tuple[list[Row], dict[str, int]]:
    """Cost and error of each number of slices; the fewest nodes that err no more than 200 slices."""
    truth = Wheel(CONVERGED).truth
    rows, matched = [], CONVERGED
    wheels = [Wheel(slices) for slices in COUNTS]
    seconds = [[wheel.evaluation() for wheel in wheels] for _ in range(rounds)]
    errors = [relative(acceleration(wheel.signals(1e-8)), truth) for wheel in wheels]
    for wheel, error, costs in zip(wheels, errors, zip(*seconds, strict=True), strict=True):
        rows.append(row(wheel.name, "an evaluation", "µs", [1e6 * x for x in costs], error))
    bound = errors[COUNTS.index({"fixed": 200})]
    for slices, error in zip(COUNTS, errors, strict=True):
        if "fitted" in slices and error <= bound:
            matched = slices
            break
    return rows, matched


def right_hand_sides(wheels: list[Wheel], bearing: Bearing, rounds: int) -> list[Row]:
    """Time an evaluation of numba and of ours, in rounds."""
    numba, states = "numba, 200 slices", np.concatenate([wheels[0].states(10)] * 10)
    seconds: dict[str, list[float]] = {name: [] for name in (numba, *(w.name for w in wheels))}
    for _ in range(rounds):
        seconds[numba].append(timed(lambda: bearing.repeat(states))[0] / len(states))
        for wheel in wheels:
            seconds[wheel.name].append(wheel.evaluation())
    rows = [row(name, "an evaluation", "µs", [1e6 * x for x in s]) for name, s in seconds.items()]
    for wheel in wheels:
        ratios = [a / b for a, b in zip(seconds[numba], seconds[wheel.name], strict=True)]
        rows.append(row(f"{numba} ÷ {wheel.name}", "an evaluation", "×", ratios))
    return rows


# ------------------------------------------------------------------------------------ Octave


class Octave:
    """ode45 with the vectorised right-hand side; one process a setting."""

    def __init__(self, scipy_peer: Scipy) -> None:
        self.peer = scipy_peer
        self.tables = octave_tables(scipy_peer.bearing) | {
            "scale": scipy_peer.scale,
            "start": scipy_peer.wheel.start,
            "times": scipy_peer.times,
            "rtol": ABSOLUTE,
        }

    def call(self, states: Array, tolerances: list[float], steps: list[float]) -> dict[str, Any]:
        """Return derivatives of states, and a run of every setting."""
        with tempfile.TemporaryDirectory() as folder:
            given, found = Path(folder, "in.mat"), Path(folder, "out.mat")
            more = {"states": states, "tolerance": tolerances, "max_step": steps}
            scipy.io.savemat(given, self.tables | more)
            subprocess.run(
                [
                    *("octave-cli", "-qf", "--path", str(HERE)),
                    *("--eval", f"octave_bearing('{given}', '{found}')"),
                ],
                check=True,
                stderr=subprocess.PIPE,
                env=os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"},
            )
            result: dict[str, Any] = scipy.io.loadmat(found)
        return result

    def run(self, tolerance: float, step: float) -> tuple[float, Array]:
        """Seconds and the outer ring's acceleration."""
        found = self.call(self.peer.wheel.start[None], [tolerance], [min(step, 1.0)])
        return float(found["seconds"][0, 0]), found["accelerations"].reshape(3, -1)

    def cases(self, tolerances: list[float]) -> list[Case]:
        """All settings."""
        wheel = self.peer.wheel
        return [
            Case(
                "octave ode45, vectorised, 200 slices",
                name,
                lambda r=tolerance, h=step: self.run(r, h),
                wheel.truth,
                once=True,
            )
            for name, tolerance, step in settings(wheel, tolerances, math.inf)
        ]


def octave_tables(bearing: Bearing) -> dict[str, Any]:
    """One entry a contact, numbered from 1, as columns."""
    grooves, defects, slices, bodies, record = bearing.tables
    common = {name: float(record[0][name]) for name in record.dtype.names}
    count = int(common["count"])
    balls = np.arange(int(common["rows"]) * count)
    contacts, ring = np.repeat(balls, 2), np.tile([0, 1], balls.size)
    groove = grooves[contacts // count, ring]
    defect = np.stack([defects[name][contacts // count] for name in defects.dtype.names], axis=1)
    defect[ring == 1, 2] = -1.0
    following = balls // count * count + (balls + 1) % count

    def column(x: Any) -> Array:
        return np.asarray(x, dtype=float).reshape(-1, 1)

    return {
        **common,
        "ball": column(contacts + 3),
        "ring": column(ring + 1),
        "sigma": column(groove["sigma"]),
        **{f"groove_{name}": column(groove[name]) for name in "azr"},
        "defect": defect,
        **dict(zip(("zeta", "rho", "tan", "sin", "cos"), slices, strict=True)),
        **dict(zip(("constant", "mobility", "spring", "damper", "place"), bodies, strict=True)),
        "this": column(balls + 3),
        "next": column(following + 3),
    }


# ------------------------------------------------------------------------------------ Exudyn


def exudyn_cases(quick: bool) -> list[Case]:
    """Run the healthy 6205, each program against its own converged solution."""
    import exudyn
    import exudyn.itemInterface

    import test_exudyn as shared

    scene, constants = shared.scene(), shared.constants()
    rate = scene.drive.speed / math.tau
    horizon, length = 3e-3, 20e-3
    samples = round(horizon * FS)

    def theirs(step: float, duration: float) -> tuple[float, Array]:
        built = shared.build(scene, rate, *constants)
        output = exudyn.OutputVariableType.Acceleration
        sensor = built.system.AddSensor(
            exudyn.itemInterface.SensorBody(
                bodyNumber=built.inner, storeInternal=True, outputVariableType=output
            )
        )
        built.system.Assemble()
        chosen = shared.implicit(exudyn, duration, step, FS)
        seconds, _ = timed(lambda: built.system.SolveDynamic(chosen))
        found = built.system.GetSensorStoredData(sensor)
        return seconds, found[1:samples, 1:3].T

    def ours(rtol: float, step: float, duration: float) -> tuple[float, Array]:
        changes = {"solver.max_step": step, "solver.frequency_cap": False}
        bounded = scene.replace(changes)
        seconds, out = timed(
            lambda: br.simulate(
                bounded,
                duration=duration,
                fs=FS,
                start="rolling",
                rtol=rtol,
                threads=1,
                bandwidth=None,
            )
        )
        return seconds, np.stack([out["inner.ax"], out["inner.ay"]])[:, 1:samples]

    cap = br.simulate(scene, duration=1e-4, start="rolling").provenance["max_step"]
    finest = 2.5e-7
    their_truth = theirs(finest, horizon)[1]
    our_truth = ours(1e-10, cap / 10, horizon)[1]
    print(
        f"Exudyn against ballrace, both converged: {relative(their_truth, our_truth):.1e} "
        "(a point contact and linear damping there)"
    )

    steps = (1e-5, 5e-6, 2.5e-6, 1.25e-6) if quick else (2e-5, 1e-5, 5e-6, 2.5e-6, 1.25e-6, 6.25e-7)
    cases = [
        Case("exudyn, healthy 6205", f"{h:.2e} s", lambda h=h: theirs(h, length), their_truth)
        for h in steps
    ]
    cases += [
        Case(
            "ballrace, healthy 6205",
            f"{r:.0e}, {factor:g} × cap",
            lambda r=r, h=factor * cap: ours(r, h, length),
            our_truth,
        )
        for r in (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
        for factor in (1.0, 2.0, 4.0)
    ]
    return cases


# ------------------------------------------------------------------------------------ rounds and fronts


def alternate(cases: list[Case], rounds: int) -> None:
    """Run all cases in rounds."""
    for turn in range(rounds):
        for case in cases:
            if turn > 0 and case.once:
                continue
            seconds, signal = case.run()
            case.seconds.append(seconds)
            case.error = relative(signal, case.truth)
        print(f"  round {turn + 1} of {rounds}", file=sys.stderr)


def cost(cases: list[Case], turn: int) -> float:
    """Seconds at the target error in one round, log-log between the neighbours on the front."""
    points = sorted((c.seconds[turn], c.error) for c in cases)
    front: list[tuple[float, float]] = []
    for seconds, error in points:
        if not front or error < front[-1][1]:
            front.append((seconds, error))
    met = next((i for i, (_, error) in enumerate(front) if error <= TARGET), None)
    if met is None:
        return math.nan
    (high, fine) = front[met]
    if met == 0 or fine == TARGET or not math.isfinite(front[met - 1][1]):
        return high
    low, coarse = front[met - 1]
    share = math.log(coarse / TARGET) / math.log(coarse / fine)
    return low * (high / low) ** share


def compare(cases: list[Case], pairs: list[tuple[str, str]]) -> list[Row]:
    """All settings, then the cost at the target error, then its ratios."""
    rows = [row(c.peer, c.setting, "ms", [1e3 * s for s in c.seconds], c.error) for c in cases]
    by_peer: dict[str, list[Case]] = {}
    for case in cases:
        by_peer.setdefault(case.peer, []).append(case)
    at: dict[str, list[float]] = {}
    for peer, own in by_peer.items():
        at[peer] = [cost(own, turn) for turn in range(len(own[0].seconds))]
        rows.append(row(peer, "at 1 %", "ms", [1e3 * s for s in at[peer]], TARGET))
    for theirs, ours in pairs:
        if theirs in at:
            ratios = [a / b for a, b in zip(at[theirs], at[ours], strict=False)]
            rows.append(row(f"{theirs} ÷ {ours}", "at 1 %", "×", ratios, TARGET))
    return rows


def show(title: str, rows: list[Row]) -> None:
    """Print a table."""
    print(f"\n## {title}\n\n| what | setting | error | median | range |\n|---|---|---|---|---|")
    for r in rows:
        error = "" if math.isnan(r.error) else f"{r.error:.1e}"
        print(
            f"| {r.what} | {r.setting} | {error} | {r.median:.3g} {r.unit} | {r.low:.3g} to {r.high:.3g} |"
        )


def write(folder: Path, sections: dict[str, list[Row]], about: str) -> None:
    """Write all tables to one file."""
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "peers.csv").open("w", newline="", encoding="utf-8") as file:
        file.write(f"# {about}\n")
        table = csv.writer(file)
        table.writerow(["section", "what", "setting", "unit", "median", "low", "high", "error"])
        for section, rows in sections.items():
            for r in rows:
                table.writerow(
                    [section, r.what, r.setting, r.unit, r.median, r.low, r.high, r.error]
                )
    print(f"\nwritten: {folder / 'peers.csv'}")


# ------------------------------------------------------------------------------------ main


def wheel_bearing(quick: bool, rounds: int) -> dict[str, list[Row]]:
    """Run everything on the wheel bearing."""
    tolerances = [10.0**-k for k in (range(3, 7) if quick else range(3, 10))]
    sections: dict[str, list[Row]] = {}
    slices, nodes = Wheel({"fixed": 200}), Wheel({"fitted": 6})
    sections["slices"], fewest = slice_errors(rounds)
    show("Slices", sections["slices"])
    matched = Wheel(fewest)
    wheels = [slices, nodes, matched]

    print("\nfewest nodes that err no more than 200 slices:", matched.name)
    bearing = Bearing(slices.scene)
    along = slices.states(4)
    judge = Judge(slices, np.concatenate([along[::10], along[60:70]]))
    hold("numba", judge, [bearing(0.0, y) for y in judge.states])
    bearing.repeat(judge.states[0][None])  # compiles
    scipy_peer = Scipy(slices, bearing)
    _, confirmed = scipy_peer.run("DOP853", 1e-10, slices.cap / 3)
    print(f"reference of 200 slices from DOP853 at 1e-10: {relative(confirmed, slices.truth):.1e}")
    for wheel in wheels:
        print(f"reference of {wheel.name} from rtol 1e-9 at a fifth of the cap: {wheel.doubt:.1e}")
    sections["right-hand side"] = right_hand_sides(wheels, bearing, 5 * rounds)
    show("A right-hand side", sections["right-hand side"])

    cases = [case for wheel in wheels for case in our_cases(wheel, tolerances)]
    cases += scipy_peer.cases(tolerances)
    if shutil.which("octave-cli"):
        octave = Octave(scipy_peer)
        hold("octave", judge, octave.call(np.stack(judge.states), [], [])["derivatives"])
        cases += octave.cases([1e-4, 1e-5] if quick else [1e-3, 1e-4, 1e-5, 1e-6])
    else:
        print("octave: skipped, octave-cli is not installed")
    alternate(cases, rounds)
    ours = [wheel.name for wheel in wheels]
    peers = dict.fromkeys(case.peer for case in cases if case.peer not in ours)
    sections["run"] = compare(cases, [(peer, own) for own in ours for peer in peers])
    show("A run of 6 ms with an impact", sections["run"])
    return sections


def main() -> None:
    """Run all peers."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="fewer settings and rounds")
    parser.add_argument("-o", "--output", type=Path, help="folder for peers.csv")
    given = parser.parse_args()
    quick = given.quick
    rounds = 3 if quick else 5
    about = machine()
    print(about)
    sections = wheel_bearing(quick, rounds)
    if importlib.util.find_spec("exudyn"):
        healthy = exudyn_cases(quick)
        alternate(healthy, rounds)
        pair = [("exudyn, healthy 6205", "ballrace, healthy 6205")]
        sections["healthy 6205"] = compare(healthy, pair)
        show("20 ms of the healthy 6205", sections["healthy 6205"])
    else:
        print("exudyn: skipped, the extra `validation` is not installed")
    if given.output is not None:
        write(given.output, sections, about)


if __name__ == "__main__":
    main()
