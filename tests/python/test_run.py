"""The arguments of a run are one document: the same for runs, campaigns, the command line and the core."""

from __future__ import annotations

import copy
import inspect
import json
import pickle
from dataclasses import fields
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import ballrace as br
from ballrace import _core, cli
from ballrace.campaigns import run as campaigns
from ballrace.options import ARGUMENTS, BUDGET, DECIDING

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

SCENE = br.presets.deep_groove_6205()
DEFAULTS = {field.name: field.default for field in fields(br.Run)}


def shared(function: Callable[..., object]) -> dict[str, Any]:
    """Defaults of those arguments of a function that are a run's."""
    parameters = inspect.signature(function).parameters
    return {name: p.default for name, p in parameters.items() if name in ARGUMENTS}


def test_runs_and_campaigns_have_the_arguments_and_defaults_of_the_document() -> None:
    # A run says how long it is; threads of a campaign are cases at once.
    assert shared(br.simulate) == {**DEFAULTS, "duration": inspect.Parameter.empty}
    assert shared(br.campaign) == {**DEFAULTS, "threads": None}
    assert set(ARGUMENTS) <= set(campaigns._Options.__annotations__)
    assert set(ARGUMENTS) == {*DECIDING, *BUDGET, "threads"}


def test_the_core_has_the_same_fields_and_defaults() -> None:
    assert json.loads(_core.run_from_json("{}")) == DEFAULTS
    assert json.loads(br.Run().to_json()) == DEFAULTS


def test_the_command_line_has_every_argument(tmp_path: Path) -> None:
    asked = cli._parser().parse_args(["run", "scene.toml", "-o", "out.parquet"])
    assert {name: getattr(asked, name) for name in ARGUMENTS} == DEFAULTS
    (tmp_path / "scene.toml").write_text(SCENE.to_toml())
    command = ["run", str(tmp_path / "scene.toml"), "-o", str(tmp_path / "out.parquet")]
    more = ["--duration", "1e-3", "--method", "verner", "--bandwidth", "none", "--settle", "0"]
    assert cli.main([*command, *more]) == 0
    out = br.Signals.read_parquet(tmp_path / "out.parquet")
    assert (out.provenance.method, out.provenance.bandwidth, out.t.size) == (
        "Verner 6(5)",
        None,
        50,
    )


def test_a_run_goes_both_ways() -> None:
    run = br.Run(
        duration=0.1 + 0.2, fs=1e4, start=np.array([0.1, -1 / 3]), rtol=1e-7, method="verner",
        threads=2, bandwidth=None, settle=0.0, time_limit=3.5, max_steps=7,
    )  # fmt: skip
    assert br.Run.from_json(run.to_json()) == run
    assert br.Run(**run.to_dict()) == run
    assert pickle.loads(pickle.dumps(run)) == run
    assert copy.deepcopy(run) == run


def test_a_run_says_what_the_arguments_say() -> None:
    run = br.Run(duration=1e-3, start="rolling", settle=0.0, method="verner")
    out = br.simulate(SCENE, **run.to_dict())
    alone = br.simulate(SCENE, duration=1e-3, start="rolling", settle=0.0, method="verner")
    np.testing.assert_array_equal(out["outer.ay"], alone["outer.ay"])
    state = br.Run(duration=1e-3, start=br.Model(SCENE).start("rolling"))
    again = br.simulate(SCENE, **{**state.to_dict(), "method": "verner"})
    np.testing.assert_array_equal(again["outer.ay"], alone["outer.ay"])


@pytest.mark.parametrize(
    ("given", "path"),
    [
        ({"duration": 0.0}, "duration"),
        ({"duration": "long"}, "duration"),
        ({"duration": {"start": "rolling"}}, "duration"),
        ({"fs": 1e10}, "fs"),
        ({"start": "standing"}, "start"),
        ({"start": np.array([0.0, np.inf])}, "start[1]"),
        ({"rtol": 1.0}, "rtol"),
        ({"rtol": "1e-6"}, "rtol"),
        ({"settle": True}, "settle"),
        ({"accuracy": 1.0}, "accuracy"),
        ({"method": "euler"}, "method"),
        ({"bandwidth": "wide"}, "bandwidth"),
        ({"settle": -1.0}, "settle"),
        ({"threads": -1}, "threads"),
        ({"threads": 1.5}, "threads"),
        ({"time_limit": 0.0}, "time_limit"),
        ({"max_steps": 0}, "max_steps"),
    ],
)
def test_what_is_not_usable_is_refused_by_name(given: dict[str, Any], path: str) -> None:
    with pytest.raises(br.SceneError) as caught:
        br.Run(**given).to_json()
    assert caught.value.path == path


@pytest.mark.parametrize(
    ("start", "shown"),
    [
        (None, "None"),
        ({"a": 1}, "{'a': 1}"),
        ([[1.0], [1.0, 2.0]], "[[1.0], [1.0, 2.0]]"),
        (np.zeros((2, 3)), "an array of shape (2, 3)"),
    ],
)
def test_a_start_that_is_no_state_is_refused(start: Any, shown: str) -> None:
    with pytest.raises(br.SceneError) as caught:
        br.simulate(SCENE, duration=1e-3, start=start)
    assert str(caught.value) == (
        f"start = {shown}: 'equilibrium', 'rolling', an array of shape (n_states,) or the Signals of a run"
    )


def test_unknown_fields_are_refused_by_name() -> None:
    with pytest.raises(br.SceneError, match="steps"):
        br.Run.from_json('{"steps": 3}')
    with pytest.raises(TypeError, match="steps"):
        br.Run(steps=3)  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="steps"):
        br.simulate(SCENE, duration=1e-3, steps=3)  # type: ignore[call-arg]
