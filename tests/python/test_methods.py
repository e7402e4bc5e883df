"""The choice of a method from Python; the methods themselves are tested in Rust."""

from __future__ import annotations

from typing import get_args

import numpy as np
import pytest

import ballrace as br
from ballrace.scene import Method, Solver

ADAPTIVE: tuple[Method, ...] = (
    "dormand-prince",
    "bogacki-shampine",
    "tsitouras",
    "verner",
    "implicit-friction",
)


def run(method: Method | None, slip_speed: float = 0.1, **solver: object) -> br.Signals:
    changes: dict[str, object] = {"friction.coulomb.slip_speed": slip_speed}
    changes |= {f"solver.{name.removesuffix('_')}": value for name, value in solver.items()}
    scene = br.presets.wheel_bearing().replace(changes)
    return br.simulate(
        scene, duration=5e-4, fs=100_000, threads=1, method=method, settle=0.0, bandwidth=None
    )


def test_the_names_are_those_of_the_core() -> None:
    """Every name is taken, and one that is not is refused with the list of them."""
    scene = br.presets.wheel_bearing()
    for method in get_args(Method):
        assert scene.replace({"solver.method": method}).solver == Solver(method=method)
    with pytest.raises(br.SceneError, match=r"solver\.method = .euler.*") as refused:
        scene.replace({"solver.method": "euler"})
    assert all(f'"{method}"' in str(refused.value) for method in get_args(Method))


def test_an_unknown_method_of_a_run_is_refused() -> None:
    with pytest.raises(br.SceneError, match=r"method = .*euler.*dormand-prince"):
        run("euler")  # type: ignore[arg-type]


@pytest.mark.parametrize("method", ADAPTIVE)
def test_the_argument_and_the_scene_say_the_same(method: Method) -> None:
    argument, scene = run(method), run(None, method_=method)
    assert np.array_equal(argument["outer.ay"], scene["outer.ay"])
    assert argument.scene.solver.method == method
    assert argument.provenance.method == scene.provenance.method
    assert argument.provenance.stiffness is None


def test_methods_agree() -> None:
    """Truth: each other at tight tolerance. From equilibrium the signal is small, and so is any difference."""
    truth = run("dormand-prince", rtol=1e-9)["outer.ay"]
    for method in ADAPTIVE[1:]:
        off = run(method, rtol=1e-8)["outer.ay"] - truth
        assert np.linalg.norm(off) < 3e-3 * np.linalg.norm(truth), method


def test_auto_says_what_it_did() -> None:
    # So many nodes that some lie where the balls stick at the first look.
    nodes = {"contact.slices": br.scene.FittedSlices(24)}
    scene = br.presets.wheel_bearing().replace(nodes)
    rough = scene.replace({"friction.coulomb.slip_speed": 1e-3})

    def started(scene: br.Scene, method: Method) -> br.Signals:
        return br.simulate(
            scene, duration=5e-4, fs=100_000, threads=1, method=method, settle=0.0, bandwidth=None
        )

    soft, stiff = started(scene, "auto"), started(rough, "auto")
    explicit = started(rough, "dormand-prince")
    assert soft.provenance.method == "auto: Dormand-Prince 5(4)"
    assert stiff.provenance.method == "auto: Kennedy-Carpenter ARK4(3)6L[2]SA"
    assert soft.provenance.stiffness < 1.0 < stiff.provenance.stiffness
    assert (soft.stats.implicit_share, stiff.stats.implicit_share) == (0.0, 1.0)
    assert soft.stats.iterations == 0 < stiff.stats.iterations
    assert stiff.stats.nfev < explicit.stats.nfev / 1.5


def test_fixed_steps_are_the_largest_allowed() -> None:
    out = run("runge-kutta-4", max_step=2e-6)
    assert (out.stats.accepted, out.stats.nfev) == (250, 1001)
    verlet = run("velocity-verlet", max_step=1e-6)
    assert verlet.stats.nfev == 501
    with pytest.raises(br.SceneError, match=r"solver\.max_step"):
        run("runge-kutta-4", frequency_cap=False)


@pytest.mark.parametrize("method", get_args(Method))
def test_every_method_runs_with_its_defaults(method: Method) -> None:
    """Truth: the default at tight tolerance; warnings are errors here."""
    truth = run("dormand-prince", rtol=1e-9)["outer.ay"]
    out = run(method)
    assert np.linalg.norm(out["outer.ay"] - truth) < 0.05 * np.linalg.norm(truth)
    assert out.provenance.max_step == out.provenance.step_limit


def test_a_fixed_step_that_is_too_long_is_told() -> None:
    with pytest.raises(br.IntegrationError, match=r"smaller max_step \(the step was 10 µs"):
        br.simulate(
            br.presets.wheel_bearing().replace(
                {"solver.frequency_cap": False, "solver.max_step": 1e-5}
            ),
            duration=2e-3,
            method="velocity-verlet",
        )
    with pytest.warns(br.AccuracyWarning, match="a fixed step of 4 µs is longer than"):
        run("runge-kutta-4", frequency_cap=False, max_step=4e-6)
