"""The choice of a method from Python; the methods themselves are tested in Rust."""

from __future__ import annotations

from typing import get_args

import numpy as np
import pytest

import ballrace as br
from ballrace.scene import Method, Solver

ADAPTIVE: tuple[Method, ...] = ("dormand-prince", "verner")


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


def test_methods_agree() -> None:
    """Truth: each other at tight tolerance. From equilibrium the signal is small, and so is any difference."""
    truth = run("dormand-prince", rtol=1e-9)["outer.ay"]
    for method in ADAPTIVE[1:]:
        off = run(method, rtol=1e-8)["outer.ay"] - truth
        assert np.linalg.norm(off) < 3e-3 * np.linalg.norm(truth), method


@pytest.mark.parametrize("method", get_args(Method))
def test_every_method_runs_with_its_defaults(method: Method) -> None:
    """Truth: the default at tight tolerance; warnings are errors here."""
    truth = run("dormand-prince", rtol=1e-9)["outer.ay"]
    out = run(method)
    assert np.linalg.norm(out["outer.ay"] - truth) < 0.05 * np.linalg.norm(truth)
    assert out.provenance.max_step == out.provenance.step_limit
