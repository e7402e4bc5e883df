"""Each kind of error once, with its fields."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest

import ballrace as br


def test_the_tree() -> None:
    assert issubclass(br.SceneError, br.BallraceError)
    assert issubclass(br.SceneError, ValueError)
    assert issubclass(br.EquilibriumError, br.BallraceError)
    assert issubclass(br.EquilibriumError, RuntimeError)
    assert issubclass(br.IntegrationError, br.BallraceError)
    assert issubclass(br.IntegrationError, RuntimeError)


def test_scene_error_says_where_what_and_what_is_allowed(wheel: br.Scene) -> None:
    with pytest.raises(br.SceneError) as caught:
        wheel.replace({"rows[0].outer_conformity": 0.4})
    error = caught.value
    assert (error.path, error.value) == ("rows[0].outer_conformity", "0.4")
    assert "above 0.5" in error.allowed
    assert str(error) == f"rows[0].outer_conformity = 0.4: {error.allowed}"


@pytest.mark.parametrize(
    ("arguments", "path"),
    [
        ({"duration": 0.0}, "duration"),
        ({"duration": -1.0}, "duration"),
        ({"duration": float("nan")}, "duration"),
        ({"duration": float("inf")}, "duration"),
        ({"duration": 1e9}, "duration"),
        ({"duration": 1e-3, "fs": 0.0}, "fs"),
        ({"duration": 1e-3, "fs": float("nan")}, "fs"),
        ({"duration": 1e-3, "rtol": 0.0}, "rtol"),
        ({"duration": 1e-3, "rtol": float("nan")}, "rtol"),
        ({"duration": 1e-3, "start": "standing"}, "start"),
        ({"duration": 1e-3, "start": np.zeros(3)}, "start"),
        ({"duration": 1e-3, "start": np.zeros((2, 3))}, "start"),
        ({"duration": 1e-3, "threads": -1}, "threads"),
    ],
)
def test_arguments_of_a_run_are_checked(
    wheel: br.Scene, arguments: dict[str, object], path: str
) -> None:
    with pytest.raises(br.SceneError) as caught:
        br.simulate(wheel, **arguments)  # type: ignore[arg-type]
    assert path in caught.value.path


def test_a_state_that_is_not_finite_is_refused(wheel: br.Scene) -> None:
    state = br.Model(wheel).start("rolling")
    state[3] = np.nan
    with pytest.raises(br.SceneError, match="start"):
        br.simulate(wheel, duration=1e-3, start=state)


def test_no_equilibrium_under_a_load_that_cannot_be_carried(wheel: br.Scene) -> None:
    with pytest.raises(br.EquilibriumError) as caught:
        br.equilibrium(wheel.replace({"loads.axial.force": 1e9}))
    assert str(caught.value)


def test_integration_error_says_when_and_where(wheel: br.Scene) -> None:
    model = br.Model(wheel)
    state = model.start("rolling")
    # Thrown out of the groove at an absurd speed.
    state[model.names.index("row0.ball3.vz")] = 1e150
    with pytest.raises(br.IntegrationError) as caught:
        br.simulate(wheel, duration=1e-3, start=state)
    assert caught.value.time >= 0.0
    assert caught.value.step > 0.0
    assert caught.value.body in model.bodies


@pytest.mark.parametrize(
    "error",
    [
        br.SceneError("a.b", "1", "2"),
        br.EquilibriumError("no equilibrium"),
        br.IntegrationError("stopped", 0.1, 1e-9, "outer"),
        br.FileError("a.parquet", "damaged"),
    ],
)
def test_errors_cross_processes(error: br.BallraceError) -> None:
    again = pickle.loads(pickle.dumps(error))
    assert (type(again), str(again), vars(again)) == (type(error), str(error), vars(error))


def test_a_budget_error_crosses_processes() -> None:
    error = br.BudgetError("spent", 0.1, "max_steps", 50.0)
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.time, again.budget, again.limit) == ("spent", 0.1, "max_steps", 50.0)


@pytest.mark.parametrize(
    ("changes", "options"),
    [
        ({}, {"duration": 1.0, "fs": 1.0}),
        ({"loads.axial.force": 1e9}, {"duration": 1e-3}),
        ({"cage.damping": 1e9}, {"duration": 1e-3, "start": "rolling"}),
        ({}, {"duration": 1e-3, "max_steps": 5}),
        ({}, {"duration": 1e6, "fs": 1e9, "start": "rolling"}),
    ],
    ids=["SceneError", "EquilibriumError", "IntegrationError", "BudgetError", "MemoryLimitError"],
)
def test_an_error_is_the_same_alone_and_from_a_campaign(
    changes: dict[str, object],
    options: dict[str, object],
    tmp_path: Path,
    request: pytest.FixtureRequest,
) -> None:
    scene = br.presets.wheel_bearing().replace(changes)
    with pytest.raises(br.BallraceError) as alone:
        br.simulate(scene, **options)  # type: ignore[arg-type]
    with pytest.raises(br.BallraceError) as there:
        br.campaign([{}], tmp_path, scene=scene, on_error="raise", progress=False, **options)  # type: ignore[call-overload]
    assert type(alone.value) is type(there.value)
    assert type(alone.value).__name__ in request.node.callspec.id
    if isinstance(alone.value, br.MemoryLimitError):
        # What there is changes from call to call, and with the cases at once.
        assert isinstance(there.value, br.MemoryLimitError)
        assert there.value.needed == alone.value.needed
    else:
        assert vars(there.value) == vars(alone.value)


HALF = "\ud800"
"""Half of a character: JSON may have it, files and the crate cannot."""


def test_halves_of_characters_are_refused_by_name(tmp_path: Path) -> None:
    record = br.Recording(np.ones(100), fs=10.0, unit="g")
    scene = br.presets.deep_groove_6205()
    cases = [{"loads.radial.force": 500.0, "label": HALF}]
    for path, call in (
        ("scene", lambda: br.Scene.from_json(HALF)),
        ("scene", lambda: br.Scene.from_toml(HALF)),
        ("label", lambda: record.to_windows(10, label=HALF)),
        ("bearing_id", lambda: record.to_windows(10, bearing_id=HALF)),
        ("columns", lambda: record.write(tmp_path / "record.csv", columns={"x": HALF})),
        ("cases.label", lambda: br.campaign(cases, tmp_path / "campaign", scene=scene)),
    ):
        with pytest.raises(br.SceneError, match="whole characters") as caught:
            call()
        assert caught.value.path == path
    assert list(tmp_path.iterdir()) == []


def test_an_array_without_its_rate_says_what_to_give() -> None:
    with pytest.raises(br.SceneError, match="give fs="):
        br.diagnose(np.ones(1000), "6205", 1500.0)
