"""Recipes and the records that are simulated by them.

Truth: what was asked for, and limits: a fault smaller than its contact is a pit, a class is what was met.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
import pytest

import ballrace as br
from ballrace.learn.cases import Drawing
from ballrace.learn.data import _counting

pytest.importorskip("sklearn", reason="scikit-learn is not installed")

SMALL: dict[str, Any] = {"speed_rpm": 3000.0, "faults": {"outer": (0.3, 2.0), "inner": (0.3, 2.0)}}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("learn") / "runs"


def made(folder: Path, per_class: int = 2, **options: Any) -> br.learn.Simulated:
    wanted: dict[str, Any] = {"window": 0.11, "per_case": 2, "threads": 1, "progress": False}
    machines = br.measuring.random_chains(3, seed=1)
    recipe = br.learn.Recipe("6205", **SMALL)
    return br.learn.dataset(
        recipe, folder, per_class=per_class, machines=machines, **(wanted | options)
    )


@pytest.fixture(scope="module")
def data(folder: Path) -> br.learn.Simulated:
    return made(folder)


def test_as_many_records_of_each_class_grouped_by_bearing(data: br.learn.Simulated) -> None:
    assert dict(data.windows["label"].value_counts().iter_rows()) == dict.fromkeys(
        data.recipe.classes, 4
    )
    for _, of_bearing in data.windows.group_by("bearing_id"):
        assert set(of_bearing["label"]) == set(data.recipe.classes)
    assert data.windows["x"].dtype == pl.Array(pl.Float32, 1320)
    assert data.windows["shaft"].unique().to_list() == [pytest.approx(50.0)]
    assert data.windows["chain"].n_unique() > 1
    assert data.turns == pytest.approx(5.5)
    found = br.learn.examples(data.windows)
    assert found.classes == ("healthy", "inner_race", "outer_race")


def test_features_are_32_bit_numbers_of_the_recipes_bearing(data: br.learn.Simulated) -> None:
    X, y, groups = data.features()
    assert X.dtype == np.float32
    assert X.shape == (12, 8)
    assert (sorted(set(y)), sorted(set(groups))) == (
        ["healthy", "inner_race", "outer_race"],
        [0, 1],
    )
    named = br.learn.EnvelopeLines("6205").fit_transform(list(data.channels()))
    assert np.array_equal(named.astype(np.float32), X)
    assert data.features(br.learn.EnvelopeLines(highest=5.0))[0].shape == (12, 57)


def test_called_again_it_runs_only_what_is_missing(
    data: br.learn.Simulated, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = data.campaign.manifest
    seen: list[br.campaigns.Progress] = []
    again = made(folder, progress=seen.append)
    assert not seen
    assert np.array_equal(again.windows["x"].to_numpy(), data.windows["x"].to_numpy())
    more = made(folder, per_class=3, progress=True)
    text = capsys.readouterr().err
    assert re.search(r"dataset: 3 of 9 runs to do, 6 records: about .*, \d+ records an hour", text)
    assert "6 from before" in text
    assert set(before["case_id"]) < set(more.campaign.manifest["case_id"])
    assert more.windows.height == 18


def test_a_class_is_what_was_met() -> None:
    """Of four that ran one met what it has, one met nothing, of one nothing is known; one is healthy."""
    kinds = ["outer_race", "outer_race", "inner_race", "healthy", "ball"]
    manifest = pl.DataFrame({
        "part": kinds, "status": ["ok"] * 4 + ["failed"],
        "fault_outer_race": [True, False, False, False, False],
        "fault_inner_race": [False, False, None, False, False], "fault_ball": [False] * 4 + [True],
    })  # fmt: skip
    assert _counting(manifest)["label"].to_list() == ["outer_race", "healthy"]


def test_more_are_drawn_where_too_few_were_met(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The first two bearings with a fault are made to count for nothing."""
    monkeypatch.setattr(
        "ballrace.learn.data._counting",
        lambda table: _counting(table).filter(
            (pl.col("bearing_id") > 1) | (pl.col("part") == "healthy")
        ),
    )
    found = made(tmp_path / "runs", per_class=1, per_case=1)
    assert dict(found.windows.select("label", "bearing_id").iter_rows()) == {
        "healthy": 0, "outer_race": 2, "inner_race": 2,
    }  # fmt: skip


def rows(kind: str | None, **options: Any) -> list[dict[str, Any]]:
    drawing = Drawing(br.learn.Recipe("6205", **options), 1)
    return [drawing.row(kind, k) for k in range(40)]


def test_a_bearing_keeps_its_surfaces_and_changes_its_load() -> None:
    healthy, outer = rows(None), rows("outer")
    for one, other in zip(healthy, outer, strict=True):
        same = {name for name in one if one[name] == other.get(name)}
        assert {
            "rows[0].texture.seed",
            "rows[0].diameter_errors",
            "rows[0].clearance",
            "cage.ring.pocket_clearance",
        } <= same
        assert "loads.radial.force" not in same
    assert len({row["rows[0].texture.seed"] for row in healthy}) == 40


@pytest.mark.parametrize("kind", ["outer", "inner", "ball"])
def test_small_faults_are_pits_and_large_ones_spalls(kind: str) -> None:
    """Below 0.3 mm all are smaller than a contact of 100 N and more, above 2 mm none."""
    for sizes, shape in (((0.15, 0.3), "pit"), ((2.0, 3.0), "spall")):
        found = rows(kind, faults={kind: sizes}, radial_load=(100.0, 800.0))
        assert {row["shape"] for row in found} == {shape}
        assert all(sizes[0] <= row["size_mm"] <= sizes[1] for row in found)
        assert all(
            row["defects.fault.width"] == pytest.approx(1e-3 * row["size_mm"]) for row in found
        )
    drawn = [row["size_mm"] for row in rows(kind)]
    low, high = br.learn.Recipe("6205").faults[kind]
    assert np.log(drawn).mean() == pytest.approx(0.5 * np.log(low * high), abs=0.4)  # logarithmic


def test_what_is_left_out_of_a_recipe_is_not_drawn() -> None:
    found = rows(
        None, surfaces="smooth", slip=None, balance_grade=None, clearance="C3", speed_rpm=1500.0
    )
    left_out = ("rows[0].texture.seed", "rows[0].diameter_errors", "rows[0].clearance")
    assert set(left_out).isdisjoint(found[0])
    assert "unbalances.rotor.moment" not in found[0]
    assert [row["drive.speed"] for row in found] == pytest.approx([50.0 * np.pi] * 40)
    scattered = rows(None)
    assert 0.0 <= min(row["rows[0].clearance"] for row in scattered) < 4e-6
    assert 16e-6 < max(row["rows[0].clearance"] for row in scattered) <= 20e-6  # CN of 25 mm


def test_balls_are_as_unlike_as_the_slip_says() -> None:
    errors = np.array([row["rows[0].diameter_errors"] for row in rows(None, slip=6e-3)])
    assert errors.std() == pytest.approx(6e-3 / 1.4e4, rel=0.15)
    assert max(row["cage.ring.pocket_clearance"] for row in rows(None, slip=6e-3)) < 0.1e-3
    assert min(row["cage.ring.pocket_clearance"] for row in rows(None, slip=0.02)) > 0.13e-3


def test_a_rotor_as_heavy_as_the_load_is_balanced_to_its_grade() -> None:
    """Truth: ISO 21940-11. Grade 6.3 at 1500 1/min takes a force of 0.0063 m/s · 157 rad/s / g of the weight."""
    found = rows("outer", balance_grade=6.3, speed_rpm=1500.0)
    for row in found:
        force = row["unbalances.rotor.moment"] * row["drive.speed"] ** 2
        assert force == pytest.approx(0.1009113 * row["loads.radial.force"], rel=1e-5)
    assert np.ptp([row["unbalances.rotor.angle"] for row in found]) > 5.0
    fast = rows("outer", balance_grade=16.0, speed_rpm=10_000.0, radial_load=(2000.0, 4000.0))
    for row in fast:
        force = row["unbalances.rotor.moment"] * row["drive.speed"] ** 2
        assert force == pytest.approx(2.0 / 3.0 * row["loads.radial.force"])
    scenes = Drawing(br.learn.Recipe("6205"), 1).scenes
    assert all(list(scene.unbalances) == ["rotor"] for scene in scenes.values())


@pytest.mark.parametrize(
    ("path", "options"),
    [
        ("bearing", {"bearing": "7205B"}),
        ("speed_rpm", {"speed_rpm": (1800.0, 1700.0)}),
        ("speed_rpm", {"speed_rpm": "fast"}),
        ("radial_load", {"radial_load": (0.0, 100.0)}),
        ("axial_load", {"axial_load": (0.0, 1e6)}),
        ("clearance", {"clearance": "C9"}),
        ("faults", {"faults": {}}),
        ("faults.cage", {"faults": {"cage": (0.1, 1.0)}}),
        ("faults.outer", {"faults": {"outer": (0.0, 1.0)}}),
        ("faults.ball", {"faults": {"ball": (0.1, 5.0)}}),
        ("surfaces", {"surfaces": "rough"}),
        ("slip", {"slip": (0.0, 0.01)}),
        ("slip", {"slip": 0.05}),
        ("balance_grade", {"balance_grade": (0.0, 6.3)}),
    ],
)
def test_a_recipe_names_the_field_that_is_wrong(path: str, options: dict[str, Any]) -> None:
    with pytest.raises(br.SceneError) as caught:
        br.learn.Recipe(**({"bearing": "6205"} | options))
    assert caught.value.path == path


@pytest.mark.parametrize(
    ("path", "options"),
    [
        ("per_class", {"per_class": 0}),
        ("fs", {"fs": 10.0}),
        ("window", {"window": 0.05}),
        ("per_case", {"per_case": 4}),
        ("chains", {"machines": []}),
        ("seed", {"seed": -1}),
        ("recipe", {"recipe": "6205"}),
    ],
)
def test_a_data_set_names_the_argument_that_is_wrong(
    tmp_path: Path, path: str, options: dict[str, Any]
) -> None:
    given: dict[str, Any] = {
        "recipe": br.learn.Recipe("6205", **SMALL), "folder": tmp_path / "runs", "per_class": 1,
        "machines": br.measuring.random_chains(3, seed=1), "progress": False,
    }  # fmt: skip
    with pytest.raises(br.SceneError) as caught:
        br.learn.dataset(**(given | options))
    assert caught.value.path == path
    assert not (tmp_path / "runs").exists()


@pytest.mark.long
def test_blows_are_as_uneven_as_the_slip_says() -> None:
    """Times between the largest accelerations of 40 passes, of three bearings with a slip of 1 %."""
    drawing = Drawing(
        br.learn.Recipe("6205", slip=0.01, surfaces="smooth", radial_load=300.0, axial_load=80.0), 3
    )
    found = []
    for number in range(3):
        row = {
            name: value
            for name, value in drawing.row(None, number).items()
            if name.startswith(("rows", "cage"))
        }
        scene = br.bearing(
            "6205", radial_load=300.0, axial_load=80.0, housing=None,
            defects=br.defects.spall(on="outer_race", width_mm=0.5), speed_rpm=1800.0,
        )  # fmt: skip
        out = br.simulate(
            scene.replace(row | {"rows[0].clearance": 5e-6}), duration=0.4, fs=48_000.0
        )
        x, period = np.abs(out["outer.ay"]), out.fs / br.fault_frequencies(out).bpfo
        at = [int(np.argmax(x[: int(period)]))]
        while at[-1] + 1.4 * period < x.size:
            first = int(at[-1] + 0.6 * period)
            at.append(first + int(np.argmax(x[first : first + int(0.8 * period)])))
        found.append(float(np.diff(at).std() / period))
    assert 0.006 < np.mean(found) < 0.015
