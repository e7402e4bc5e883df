"""Two ways to the same answer for any scene: reduced and full, vector levels, threads, resumed, limits of laws."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from typing import IO, Any, cast

import hypothesis
import hypothesis.strategies as st
import numpy as np
import pytest
from numpy.typing import NDArray

import ballrace as br
from ballrace.scene import AccurateSlices, Coulomb, FittedSlices, FixedSlices, Lubricant, Scene
from budget import decided, fuzzed
from strategies import mild

SHORT: dict[str, Any] = {
    "duration": 2e-4, "fs": 5e4, "start": "rolling", "settle": 0.0, "bandwidth": None, "max_steps": 2000,
    "time_limit": 10.0,
}  # fmt: skip
SEEDS = st.integers(0, 99)


def usable(document: object) -> Scene:
    """Return the scene of a document, or pass over one that is refused."""
    scene = decided(lambda: Scene.from_json(json.dumps(document)))
    if not isinstance(scene, Scene):
        hypothesis.reject()
    return scene


def compiled(scene: Scene) -> br.Model:
    """Return the model of a scene, or pass over one that is refused as it is compiled."""
    model = decided(lambda: br.Model(scene))
    if not isinstance(model, br.Model):
        hypothesis.reject()
    return model


def state(model: br.Model, seed: int) -> NDArray[np.float64]:
    """Return the start, places and angles shifted a little and speeds changed by a hundredth."""
    start = decided(lambda: model.start("rolling"))
    if not isinstance(start, np.ndarray):
        hypothesis.reject()
    noise = np.random.default_rng(seed).normal(size=start.size)
    is_speed = np.array(
        [name.rpartition(".")[2].startswith(("v", "omega")) for name in model.names]
    )
    return start + np.where(is_speed, 1e-2 * start, 1e-6) * noise


def alike(a: NDArray[np.float64], b: NDArray[np.float64], tolerance: float, what: str) -> None:
    """Compare numbers by the largest of them."""
    np.testing.assert_allclose(
        a, b, rtol=0.0, atol=tolerance * np.abs(b).max(initial=1e-300), err_msg=what
    )


def forces_alike(a: Scene, b: Scene, seed: int, tolerance: float) -> None:
    """Compare the forces of contacts at the same state of two scenes."""
    first, second = compiled(a), compiled(b)
    y = state(first, seed)
    alike(
        first.forces(0.0, y)["contact"][:, :3], second.forces(0.0, y)["contact"][:, :3], tolerance, "contact"
    )  # fmt: skip


@fuzzed(document=mild())
def test_threads_change_no_bit(document: object) -> str:
    scene = usable(document)
    one, two = (decided(lambda n=n: br.simulate(scene, threads=n, **SHORT)) for n in (1, 2))  # type: ignore[misc]
    if not (isinstance(one, br.Signals) and isinstance(two, br.Signals)):
        assert str(one) == str(two)
        return type(one).__name__
    for name in one:
        np.testing.assert_array_equal(one[name], two[name], err_msg=name)
    return "ok"


@fuzzed(document=mild())
def test_what_a_run_leaves_out_does_not_count(document: object) -> str:
    """The first steps: rounding grows by a factor of e a millisecond, and faster where balls bounce."""
    scene = usable(document)
    short = {**SHORT, "duration": 6e-5, "rtol": 1e-9}
    runs = [decided(lambda r=r: br.simulate(scene, reduce=r, **short)) for r in (True, False)]  # type: ignore[misc]
    if not all(isinstance(out, br.Signals) for out in runs):
        return " and ".join(sorted({type(out).__name__ for out in runs}))
    reduced, full = cast("list[br.Signals]", runs)
    names = [name for name in reduced if name.startswith(("outer.v", "inner.v"))]
    # All at once: what a symmetry leaves out is rounding in the full run.
    both = [np.array([out[name] for name in names]) for out in (reduced, full)]
    alike(both[0], both[1], 1e-4, "velocities of rings")
    return f"{len(reduced.provenance.left_out)} left out"


PROGRAM = """
import json, sys
import numpy as np
import ballrace as br
for line in sys.stdin:
    document, y = json.loads(line)
    model = br.Model(br.Scene.from_json(json.dumps(document)))
    print(json.dumps(model.rhs(0.0, np.array(y)).tolist()), flush=True)
"""
LEVELS = ("x86-64-v4", "x86-64-v3", "neon", "baseline")


@pytest.fixture(scope="module", autouse=True)
def closed() -> Iterator[None]:
    """End the processes of the levels."""
    yield
    for child in STARTED:
        child.kill()
        child.communicate()


STARTED: list[subprocess.Popen[str]] = []


@cache
def process(level: str) -> subprocess.Popen[str]:
    """Return a process that evaluates models on the vector instructions of a level."""
    started = subprocess.Popen(
        [sys.executable, "-c", PROGRAM],
        env={**os.environ, "BALLRACE_SIMD": level},
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    STARTED.append(started)
    return started


def evaluated(level: str, document: object, y: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """Return the right-hand side at a level; None where this machine has no such level."""
    child = process(level)
    try:
        print(json.dumps([document, y.tolist()]), file=child.stdin, flush=True)
    except BrokenPipeError:
        return None
    line = cast("IO[str]", child.stdout).readline()
    if not line:
        printed = cast("IO[str]", child.stderr).read()
        assert "BALLRACE_SIMD" in printed, printed
        return None
    return np.array(json.loads(line))


@fuzzed(document=mild(), seed=SEEDS)
def test_levels_differ_by_rounding(document: object, seed: int) -> str:
    scene = usable(document)
    y = state(compiled(scene), seed)
    truth = evaluated("baseline", document, y)
    assert truth is not None
    met = []
    for level in LEVELS[:-1]:
        found = evaluated(level, document, y)
        if found is not None:
            alike(found, truth, 1e-10, level)
            met.append(level)
    return f"baseline against {', '.join(met) or 'none'}"


LOADS = st.lists(st.floats(10.0, 3000.0), min_size=1, max_size=4, unique=True)


@fuzzed(loads=LOADS, first=st.integers(0, 4), steps=st.sampled_from((None, 40, 80)))
def test_a_resumed_campaign_is_the_whole(loads: list[float], first: int, steps: int | None) -> str:
    options: dict[str, Any] = {
        "scene": br.presets.deep_groove_6205(), "duration": 2e-4, "fs": 5e4, "start": "rolling", "settle": 0.0,
        "progress": False, "threads": 1,
    }  # fmt: skip
    kept = ("wall_time", "signals")
    with tempfile.TemporaryDirectory() as folder:
        column = "loads.radial.force"
        whole = br.campaign({column: loads}, f"{folder}/whole", **options).manifest
        if loads[:first]:
            br.campaign({column: loads[:first]}, f"{folder}/parts", max_steps=steps, **options)
        parts = br.campaign({column: loads}, f"{folder}/parts", **options).manifest
        assert parts.drop(kept).equals(whole.drop(kept))
    return f"{len(loads[:first])} of {len(loads)} before"


@fuzzed(document=mild(), seed=SEEDS)
def test_little_friction_is_almost_none(document: object, seed: int) -> str:
    """The coefficient towards 0, where a scene has dry friction in all rows."""
    scene = usable(document)
    rows = tuple(replace(row, friction=None, lubricant=None) for row in scene.rows)
    dry = replace(scene, rows=rows, lubricant=None, friction="none", probes={})
    little = replace(dry, friction=Coulomb(coefficient=1e-9, slip_speed=0.1))
    forces_alike(little, dry, seed, 1e-8)
    return "ok"


@fuzzed(document=mild(), seed=SEEDS)
def test_oil_without_effects_is_dry(document: object, seed: int) -> str:
    scene = usable(document)
    rows = tuple(replace(row, friction=None, lubricant=None) for row in scene.rows)
    dry = replace(scene, rows=rows, lubricant=None, probes={})
    off = Lubricant(
        oil="vg68",
        temperature=330.0,
        film=False,
        damping=False,
        traction=False,
        rolling=False,
        reference_speed=100.0,
    )
    model = compiled(dry)
    y = state(model, seed)
    oiled = br.Model(replace(dry, lubricant=off))
    alike(oiled.rhs(0.0, y), model.rhs(0.0, y), 1e-12, "accelerations")
    return "ok"


@fuzzed(document=mild(), seed=SEEDS)
def test_many_slices_are_fitted_nodes(document: object, seed: int) -> str:
    """Both integrate the same force, fixed slices with an error that falls with their number."""
    scene = usable(document)
    rows = tuple(replace(row, contact=None) for row in scene.rows)
    smooth = replace(scene, rows=rows, friction="none", lubricant=None, defects={}, probes={})
    fitted = replace(smooth, contact=replace(scene.contact, slices=FittedSlices(64)))
    fixed = replace(smooth, contact=replace(scene.contact, slices=FixedSlices(100_000)))
    forces_alike(fixed, fitted, seed, 1e-3)
    accurate = replace(smooth, contact=replace(scene.contact, slices=AccurateSlices(1e-6)))
    forces_alike(accurate, fitted, seed, 1e-3)
    return "ok"


@fuzzed(document=mild())
def test_rest_is_a_zero_of_the_equations(document: object) -> str:
    """The equilibrium from the static solve and the forces of the model, with its rings where they stand."""
    scene = usable(document)
    found = decided(lambda: br.equilibrium(scene))
    if not isinstance(found, br.statics.Equilibrium):
        return type(found).__name__
    for race in ("outer", "inner"):
        load, pressure = getattr(found, f"{race}_load"), getattr(found, f"{race}_pressure")
        assert ((load > 0.0) == (pressure > 0.0)).all()
    stiff = decided(lambda: br.stiffness(scene))
    loads = decided(lambda: br.load_distribution(scene, positions=1))
    # Which leaves defects out; a healthy bearing may be one that does not stand.
    healthy = decided(lambda: br.equilibrium(scene.replace({"defects": {}})))
    if isinstance(loads, br.statics.LoadDistribution) and isinstance(
        healthy, br.statics.Equilibrium
    ):
        alike(loads.outer_load[0], healthy.outer_load, 1e-3, "first position")
    return f"{type(stiff).__name__}, {type(loads).__name__}"
