"""What people give to a campaign: cells, labels and arguments that are not quite what they meant."""

from __future__ import annotations

import math
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import polars as pl
import pytest

import ballrace as br
from ballrace.campaigns.frames import rows_of
from sweeps import SCENE, run, table


@pytest.mark.parametrize("method", ["euler", math.nan, 3])
def test_one_bad_method_cell_fails_one_case(tmp_path: Path, method: object) -> None:
    done = run([{"method": "verner"}, {"method": method}, {}], tmp_path)
    assert done.manifest["status"].to_list() == ["ok", "failed", "ok"]
    assert "method = " in done.failed["message"][0]
    assert "one of adams, dormand-prince, verner" in done.failed["message"][0]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"method": "euler"}, "method = 'euler': one of adams, dormand-prince"),
        ({"skip": 1.0}, "skip = 1: from 0 to below the duration"),
        ({"skip": "a moment"}, "skip = 'a moment': a finite number [s]"),
        ({"skip": True}, "skip = True: a finite number"),
        ({"skip": np.inf}, "skip = inf: a finite number"),
        ({"columns": 3}, "columns = 3: a name of a column, or several"),
        ({"band": 3}, "band = 3: two frequencies"),
        ({"band": (1.0, np.nan)}, "band = (1.0, nan): two frequencies"),
        ({"band": (True, 5e3)}, "band = (True, 5000.0): two frequencies"),
        ({"band": (5.0, 2.0)}, "band = [5, 2]: two rising frequencies"),
        ({"band": (5.0,)}, "band = (5.0,): two frequencies"),
        ({"band": "all"}, "band = 'all': two frequencies"),
        ({"accuracy": 1e-2, "rtol": 1e-3}, "rtol = 0.001: absent where `accuracy` is given"),
        ({"contact_loads": "yes"}, "contact_loads = 'yes': True or False"),
        ({"progress": 3}, "progress = 3: True, False or a callable"),
        ({"in_flight": 0}, "in_flight = 0: a whole number, at least 1"),
        ({"shard": 2}, "shard = 2: a pair (i, n)"),
        ({"shard": ("a", 2)}, "shard = ('a', 2): a pair (i, n)"),
        ({"threads": "two"}, "threads = 'two': a whole number"),
        ({"fs": 1.0}, "fs = 1: at least one sample"),
        ({"scene": "wheel.toml"}, "ballrace.Scene.load(path) reads one from a file"),
    ],
)
def test_wrong_arguments_are_refused_before_anything_is_written(
    options: dict[str, Any], message: str, tmp_path: Path
) -> None:
    with pytest.raises(br.SceneError) as caught:
        run(table(2), tmp_path / "runs", **options)
    assert message in str(caught.value)
    assert not (tmp_path / "runs").exists()


def test_records_with_names_are_a_table() -> None:
    """A NumPy array of records has names of columns, and is no array of numbers."""
    rows, names = rows_of(np.array([(1.0, 2), (3.0, 4)], dtype=[("a", float), ("b", int)]))
    assert (rows, names) == ([{"a": 1.0, "b": 2}, {"a": 3.0, "b": 4}], ["a", "b"])


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ("cases.csv", "cases = 'cases.csv': a table: polars, pandas"),
        (Path("cases.csv"), "polars.read_csv(path) reads a file"),
        (np.zeros((3, 2)), "cases = ndarray without names of columns: a table"),
        ([500.0, 1000.0], "cases = list without names of columns: a table"),
    ],
)
def test_what_has_no_names_of_columns_is_no_table(
    given: object, message: str, tmp_path: Path
) -> None:
    """Else the letters of a path, or plain numbers, are cases that change nothing."""
    with pytest.raises(br.SceneError, match=re.escape(message)):
        run(given, tmp_path / "runs")
    assert not (tmp_path / "runs").exists()


def test_an_option_that_one_row_cannot_meet(tmp_path: Path) -> None:
    done = run([{"duration": 1e-3}, {"duration": 3e-3}], tmp_path, skip=2e-3)
    assert done.manifest["status"].to_list() == ["failed", "ok"]
    assert "skip = 0.002: from 0 to below the duration, 0.001 s" in done.failed["message"][0]


@pytest.mark.parametrize(
    ("label", "field"),
    [
        ("axial_load", "loads.axial.force"),
        ("radial_force", "loads.radial.force"),
        ("clearance", "rows[0].clearance"),
        ("clearence", "rows[0].clearance"),
        ("spall_width", "defects.spall.width"),
        ("ball_diametr", "rows[0].ball_diameter"),
        ("durations", "duration"),
        ("maxsteps", "max_steps"),
        ("speed_rpm", "drive.speed [rad/s]"),
        ("rpm", "drive.speed [rad/s]"),
        ("spall_width_mm", "defects.spall.width [m]"),
    ],
)
def test_a_label_that_resembles_a_field_is_warned_of(
    tmp_path: Path, label: str, field: str
) -> None:
    scene = br.presets.wheel_bearing()
    with pytest.warns(br.CampaignWarning, match="carried along as a label") as caught:
        br.campaign(
            [{label: 1.0}],
            tmp_path / "runs",
            scene=scene,
            duration=1e-4,
            start="rolling",
            progress=False,
        )
    assert str(caught[0].message).endswith(f"call it {field}")
    assert caught[0].filename == __file__


def test_labels_are_listed_first(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    cases = [
        {
            "bearing_id": 1,
            "condition": "new",
            "note": None,
            "loads.radial.force": 300.0,
            "rtol": 1e-4,
        }
    ]
    run(cases, tmp_path / "a", progress=True)
    first, last = capsys.readouterr().err.splitlines()
    assert (
        first == "campaign: columns that are labels and change nothing: bearing_id, condition, note"
    )
    assert last.startswith("campaign: 1 of 1 cases, ")
    run(table(2), tmp_path / "b", progress=True)
    assert len(capsys.readouterr().err.splitlines()) == 1


def test_whole_numbers_that_pandas_made_floats(tmp_path: Path) -> None:
    cases = pd.DataFrame(
        {"rows[0].ball_count": [8, None], "max_steps": [None, 1e6], "label": ["a", "b"]}
    )
    assert str(cases["rows[0].ball_count"].dtype) == "float64"
    done = run(cases, tmp_path)
    assert done.manifest["status"].to_list() == ["ok", "ok"]
    counts = [done.scene(case_id).rows[0].ball_count for case_id in done.manifest["case_id"]]
    assert counts == [8, SCENE.rows[0].ball_count]
    half = run([{"rows[0].ball_count": 8.5}], tmp_path.with_name("half"))
    assert "rows[0].ball_count" in half.failed["message"][0]


def test_nan_says_how_to_leave_a_cell_empty(tmp_path: Path) -> None:
    names = ["loads.radial.force", "rtol", "start", "method", "time_limit"]
    done = run([{name: math.nan} for name in names], tmp_path)
    for name, message in zip(names, done.manifest["message"], strict=True):
        assert message.startswith(f"{name} = nan")
        assert "an empty cell is None, or null in a data frame" in message


def test_nan_is_a_label_like_others(tmp_path: Path) -> None:
    done = run([{"label": 1.5}, {"label": math.nan}, {"label": None}], tmp_path)
    assert done.manifest["label"].dtype == pl.Float64
    assert done.manifest["label"].is_nan().to_list() == [False, True, None]


def test_text_columns_of_pandas_need_no_pyarrow(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Polars takes text columns of pandas by pyarrow alone."""
    program = f"""
import sys
sys.modules["pyarrow"] = None
sys.path.insert(0, {str(Path(__file__).parent)!r})
import pandas as pd, sweeps
cases = pd.DataFrame({{"label": ["a", None], "start": ["rolling", None], "loads.radial.force": [300.0, 400.0]}})
print(sweeps.run(cases, {str(tmp_path / "runs")!r}).manifest["label"].to_list())
"""
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=False
    )
    assert done.stdout == "['a', None]\n", done.stderr
    with pytest.raises(br.SceneError, match="two columns 'label'"):
        run(pd.DataFrame([[1, 2]], columns=["label", "label"]), tmp_path / "twice")


def test_a_new_entry_by_its_path(tmp_path: Path) -> None:
    spall = br.presets.wheel_bearing().defects["spall"]
    scene = SCENE.replace({"defects.new": spall, "loads.extra": SCENE.loads["radial"]})
    assert scene.defects["new"] == spall
    assert set(scene.loads) == {*SCENE.loads, "extra"}
    with pytest.raises(br.SceneError, match=r"defects\.new = 0\.001: a table"):
        SCENE.replace({"defects.new": 1e-3})
    with pytest.raises(br.SceneError, match="no such field"):
        SCENE.replace({"defects.new.width": 1e-3})
    done = run([{"defects.new": spall}, {}], tmp_path, duration=5e-3, start="rolling")
    # Contacts of a 6205 run beside it, until a pass is over.
    assert done.manifest["fault_outer_race"].to_list() == [False, False]
    assert done.manifest["defects.new.touched"].to_list() == [0.0, None]
    assert done.scene(done.manifest["case_id"][0]).defects["new"] == spall
    moment = br.scene.Moment(ring="inner", direction=(0.0, 0.0, 1.0), moment=0.1)
    turned = run([{"moments.new": moment}], tmp_path / "turned", duration=1e-4, start="rolling")
    assert turned.scene(turned.manifest["case_id"][0]).moments == {"new": moment}


@pytest.mark.parametrize(
    "call",
    [
        lambda scene: br.simulate(scene, duration=1e-3),
        br.simulate, br.equilibrium, br.stiffness, br.load_distribution, br.explain, br.Model,
    ],
)  # fmt: skip
def test_a_file_in_place_of_a_scene(call: Any) -> None:
    for given in ("scene.toml", Path("scene.toml")):
        with pytest.raises(
            br.SceneError, match=r"scene = 'scene\.toml': a Scene; ballrace\.Scene\.load"
        ):
            call(given)
    with pytest.raises(br.SceneError, match="scene = a dict: a Scene"):
        call({})
