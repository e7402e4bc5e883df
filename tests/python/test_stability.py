"""Where methods fail, seen from Python; the numerics themselves are shown in ``tests/stability``.

Each test names the failure, shows it, and shows what ballrace does instead.
"""

from __future__ import annotations

import importlib.util
import math
import pickle
import sys
import warnings
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

import ballrace as br


def soon_over_the_spall(slip_speed: float = 0.1, damping: float = 0.2) -> br.Scene:
    """The faulted wheel bearing, a ball of which crosses the spall about 1.2 ms after the start."""
    first = -math.pi / 2.0 - 76.0 * 1.2e-3
    return br.presets.wheel_bearing(axial_load=3000.0).replace(
        {
            "rows[0].start_angle": first,
            "rows[1].start_angle": first + math.pi / 13.0,
            "friction.coulomb.slip_speed": slip_speed,
            "contact.damping": damping,
        }
    )


def quietly(scene: br.Scene, rtol: float, duration: float = 2e-3) -> br.Signals:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", br.AccuracyWarning)
        return br.simulate(
            scene, duration=duration, fs=200e3, rtol=rtol, threads=1, settle=0.0, bandwidth=None
        )


def apart(x: NDArray[np.float64], truth: NDArray[np.float64]) -> float:
    return float(np.linalg.norm(x - truth) / np.linalg.norm(truth))


@pytest.mark.parametrize(
    ("slip_speed", "damping", "cap", "rtol", "lies"),
    [
        (0.1, 0.2, True, 1e-2, False),
        (0.1, 0.2, False, 1e-2, True),
        (0.001, 0.2, True, 1e-3, True),
        (1e-4, 0.2, True, 1e-4, True),
        (0.1, 5.0, True, 1e-7, False),
    ],
)
def test_success_with_wrong_accelerations_is_warned_of(
    slip_speed: float, damping: float, cap: bool, rtol: float, lies: bool
) -> None:
    """Failure: a loose tolerance reports success; truth: the same at rtol 1e-10."""
    scene = soon_over_the_spall(slip_speed, damping)
    truth = quietly(scene, 1e-10)["outer.ay"]
    scene = scene.replace({"solver.frequency_cap": cap})
    if lies:
        with pytest.warns(br.AccuracyWarning, match=r"uncertain by about \d+ %.*rtol = 1e-\d"):
            out = br.simulate(scene, duration=2e-3, fs=200e3, rtol=rtol, settle=0.0, bandwidth=None)
        assert len(out.warnings) == 1
        assert out.stats.acceleration_residual > 0.05
    else:
        # Warnings are errors here.
        out = br.simulate(scene, duration=2e-3, fs=200e3, rtol=rtol, settle=0.0, bandwidth=None)
        assert out.warnings == ()
        assert out.stats.acceleration_residual < 0.01
    assert (apart(out["outer.ay"], truth) > 0.1) == lies


def test_the_warning_points_at_the_caller_and_stays_with_the_signals(tmp_path: Path) -> None:
    scene = soon_over_the_spall(damping=5.0)
    with pytest.warns(br.AccuracyWarning) as caught:
        out = br.simulate(scene, duration=1e-3, rtol=1e-3, settle=0.0, bandwidth=None)
    assert caught[0].filename == __file__
    out.write_parquet(tmp_path / "out.parquet")
    assert br.Signals.read_parquet(tmp_path / "out.parquet").warnings == out.warnings
    with pytest.raises(br.AccuracyWarning):  # pyproject.toml makes warnings errors
        br.simulate(scene, duration=1e-3, rtol=1e-3, settle=0.0, bandwidth=None)


def test_a_contact_over_the_shoulder_is_warned_of() -> None:
    scene = br.presets.deep_groove_6205(radial_load=0.0, axial_load=4000.0)
    scene = scene.replace({"spin": "free"})
    angle = float(br.equilibrium(scene).outer_angle[0])
    low = scene.replace({"rows[0].outer_shoulders": (1.1 * angle, 1.1 * angle)})
    with pytest.warns(
        br.AccuracyWarning, match=r"over a shoulder or past the pole .* \d+ times in \d+ steps"
    ):
        out = br.simulate(low, duration=0.2e-3, settle=0.0, bandwidth=None)
    assert out.stats.truncated_contacts > 0


@pytest.mark.parametrize(
    ("changes", "rtol", "named"),
    [
        (
            {"friction.coulomb.slip_speed": 1e-8, "friction.coulomb.coefficient": 1e6},
            1e-6,
            ".outer",
        ),
        ({"cage.damping": 1e9}, 1e-6, "row0.cage"),
        ({"outer_ring.support.x.spring.damping": 1e12}, 1e-6, "outer.support"),
    ],
)
def test_a_collapsed_step_names_what_caused_it(
    wheel: br.Scene, changes: dict[str, object], rtol: float, named: str
) -> None:
    """Failure: a run that goes on for ever; instead an error within a thousand hopeless steps."""
    with pytest.raises(br.IntegrationError, match="step has collapsed") as caught:
        br.simulate(wheel.replace(changes), duration=1e-3, rtol=rtol, settle=0.0, bandwidth=None)
    error = caught.value
    assert named in error.contacts[0]
    assert error.contacts[0] in str(error)
    assert error.body in br.Model(wheel).bodies
    assert 0.0 < error.step < 1e-9
    again = pickle.loads(pickle.dumps(error))
    assert (again.contacts, str(again)) == (error.contacts, str(error))


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf, 1e300])
@pytest.mark.parametrize(
    "field", ["rows[0].clearance", "contact.damping", "loads.radial.force", "solver.rtol"]
)
def test_numbers_that_are_none_are_refused_by_name(wheel: br.Scene, field: str, bad: float) -> None:
    with pytest.raises(br.SceneError) as caught:
        wheel.replace({field: bad})
    assert field in caught.value.path


def test_a_cold_start_is_repeatable_to_the_bit(wheel: br.Scene) -> None:
    """Failure: chaos from the rolling start; instead the same bits for any number of threads."""
    runs = [
        br.simulate(wheel, duration=1e-3, start="rolling", threads=threads, bandwidth=None)
        for threads in (1, 1, 2)
    ]
    for out in runs[1:]:
        for name in out:
            np.testing.assert_array_equal(out[name], runs[0][name])


def test_a_peer_reports_success_with_wrong_accelerations() -> None:
    """Failure: SciPy's RK45 on our right-hand side with strong damping, at rtol = atol = 1e-4, reports success.

    Truth: rtol 1e-10. Instead: the default tolerance is right in a thirtieth of the evaluations, and a loose one
    warned of (above).
    """
    model = br.Model(soon_over_the_spall(damping=5.0))
    t = np.arange(0.0, 2e-3, 5e-6)
    peer = solve_ivp(model.rhs, (0.0, 2e-3), model.start(), t_eval=t, rtol=1e-4, atol=1e-4)
    assert peer.success
    row = model.names.index("outer.vy")
    theirs = np.array([model.rhs(t, y)[row] for t, y in zip(t, peer.y.T, strict=True)])
    truth = quietly(model.scene, 1e-10)["outer.ay"]
    ours = br.simulate(model.scene, duration=2e-3, fs=200e3, settle=0.0, bandwidth=None)
    errors = apart(theirs, truth), apart(ours["outer.ay"], truth)
    print(f"RK45 {peer.nfev}, error {errors[0]:.1e}; ours {ours.stats.nfev}, {errors[1]:.1e}")
    assert errors[0] > 0.3
    assert errors[1] < 0.01
    assert 20 * ours.stats.nfev < peer.nfev


def stability_map() -> ModuleType:
    path = Path(__file__).parents[2] / "benches" / "stability_map.py"
    spec = importlib.util.spec_from_file_location("stability_map", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # where dataclasses look their annotations up
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize(
    ("slip_speed", "damping", "rtol", "mark"),
    [
        (0.1, 0.2, 1e-2, "works"),
        (1e-4, 0.2, 1e-7, "works"),
        (0.1, 5.0, 1e-2, "warns"),
        # A doubt of so much damping is no doubt of the run.
        (0.1, 20.0, 1e-7, "works"),
    ],
)
def test_marks_of_the_map(slip_speed: float, damping: float, rtol: float, mark: str) -> None:
    module = stability_map()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", br.AccuracyWarning)
        warnings.simplefilter("ignore", br.SceneWarning)
        truth = module.simulate(module.bearing(slip_speed, damping), 1e-10, "default")
        point = module.judge("default", slip_speed, damping, rtol, truth)
    assert point.mark == mark


@pytest.mark.long
@pytest.mark.filterwarnings("ignore:spin = axial")
def test_nowhere_on_the_map_a_run_lies() -> None:
    """Truth: rtol 1e-10 at each place; success without a warning is within 10 %."""
    module = stability_map()
    points = module.survey(module.QUICK, ["default"], workers=2)
    assert {point.mark for point in points} <= {"works", "slowly", "warns"}


def off(out: br.Signals, truth: br.Signals, column: str) -> float:
    """Return the relative error of a column."""
    return apart(out[column], truth[column])


def test_records_that_are_right_in_their_band_are_not_warned_of() -> None:
    """Failure: noise of stiff friction beyond the band counted as 12 % of uncertainty; truth: rtol 1e-10."""
    friction = br.scene.Stribeck(
        static_coefficient=0.088, kinetic_coefficient=0.031, stribeck_speed=0.099, slip_speed=1e-3
    )
    scene = br.presets.deep_groove_6205(2886.0, 329.0, 515.0).replace({"friction": friction})
    run: Any = {"duration": 3e-3, "settle": 0.0}
    out = br.simulate(scene, **run)  # warnings are errors here
    truth = br.simulate(scene, rtol=1e-10, **run)
    assert max(off(out, truth, f"outer.a{axis}") for axis in "xyz") < 0.02
    assert 0.0 < out.stats.acceleration_residual < 0.05
    # Nor are the model's own accelerations: velocities that decay within a step leave no noise in them.
    br.simulate(scene, bandwidth=None, **run)


def test_an_accuracy_that_cannot_be_had_is_warned_of() -> None:
    """Failure: motion that is chance was given as right to 0.1 %; truth: rtol 1e-10, from starts 1e-7 rad apart.

    A dry 6000 whose balls hit a spall at 6760 1/min. The default run is off by 45 % along x within 3 ms and says
    nothing: no step is wrong, the motion multiplies what the tolerance leaves, and a moved start as well.
    """
    friction = br.scene.Stribeck(
        static_coefficient=0.086, kinetic_coefficient=0.038, stribeck_speed=0.08, slip_speed=0.044
    )
    spall = br.defects.spall(on="outer_race", width_mm=0.8, length_mm=3.0)
    scene = br.bearing(
        "6000",
        radial_load=120.0,
        axial_load=30.0,
        speed_rpm=6760.0,
        clearance=13e-6,
        defects=spall,
        housing=None,
    ).replace({"friction": friction, "contact.squeeze": None})
    run: Any = {"duration": 3e-3, "settle": 0.0}
    truth = br.simulate(scene, rtol=1e-10, **run)
    assert off(br.simulate(scene, **run), truth, "outer.ax") > 0.05
    angle = scene.rows[0].start_angle
    other = br.simulate(scene.replace({"rows[0].start_angle": angle + 1e-7}), rtol=1e-10, **run)
    assert off(other, truth, "outer.ax") > 0.01
    with pytest.warns(br.AccuracyWarning, match="accuracy = 0.001 was asked for, but pilot runs"):
        out = br.simulate(scene, accuracy=1e-3, **run)
    assert out.accuracy is not None
    assert out.accuracy.integration_error + out.accuracy.node_error > 1e-3
