"""A set of thousands of bearings, made by one command.

Truth: limits. What is interrupted and resumed has the same bytes as what is not; no bearing is in both parts of
the split, and a larger set keeps it; the package ``bearing-datasets`` has to accept what is written.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import ballrace as br
from ballrace.learn import corpus
from ballrace.learn.corpus import main, make_corpus
from ballrace.learn.corpus_plan import SIZES, Plan, for_testing

if TYPE_CHECKING:
    from collections.abc import Callable

SMALL: dict[str, Any] = {
    "bearings": 3, "seconds": 0.1, "fs": 12_000.0, "records": 1, "seed": 1, "progress": False
}  # fmt: skip


def contents(folder: Path) -> dict[str, bytes]:
    """Return all files but the card, which says when it was written, and the page of it."""
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and path.name not in {"manifest.json", "README.md"}
    }


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("whole") / "corpus"
    make_corpus(folder, workers=2, **SMALL)
    return folder


def test_interrupted_and_resumed_it_has_the_same_bytes(
    made: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "corpus"
    put: Callable[[Path, str], None] = corpus._put

    def interrupted(path: Path, text: str) -> None:
        if path.name == "000001.json":
            raise KeyboardInterrupt
        put(path, text)

    with monkeypatch.context() as patch:
        patch.setattr(corpus, "_put", interrupted)
        with pytest.raises(KeyboardInterrupt, match=r"[12] of 3 bearings are in"):
            make_corpus(folder, workers=1, **SMALL)
    found = br.read_bearing_dataset(folder)
    assert "000000" in found.metadata["bearing_id"].to_list()
    assert found.channel(found.metadata["signal_id"][0]).x.size == 1200
    make_corpus(folder, workers=1, **SMALL)
    assert contents(folder) == contents(made)


@pytest.mark.filterwarnings("default")  # Dask's own
def test_runs_of_a_scheduler_are_the_same(made: Path, tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed", reason="Dask is not installed")
    folder = tmp_path / "corpus"
    options = [f"--{name}={value}" for name, value in SMALL.items() if name != "progress"]
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, dashboard_address=None
    ) as cluster:
        assert main([str(folder), *options, "--dask", cluster.scheduler_address]) == 0
    assert contents(folder) == contents(made)


def test_rows_say_what_was_simulated(made: Path) -> None:
    found = br.read_bearing_dataset(made)
    card = json.loads((made / "manifest.json").read_text(encoding="utf-8"))
    assert (card["n_bearings"], card["seed"], card["seconds"]) == (3, 1, 0.1)
    assert set(card["columns"]) == set(found.metadata.columns)
    for row in found.metadata.to_dicts():
        document = json.loads((made / "bearings" / f"{row['bearing_id']}.json").read_text())
        scene = document["scenes"][row["recording_id"]]
        assert document["designation"] == row["bearing_model"]
        assert scene["drive"]["speed"] * 30.0 / np.pi == pytest.approx(row["speed_rpm"])
        assert scene["loads"]["radial"]["force"] == row["radial_load"]
        states: dict[str, list[str]] = {
            "normal": [],
            "outer": ["outer_race"],
            "inner": ["inner_race"],
        }
        damaged = [defect["on"] for defect in scene["defects"].values()]
        assert damaged == states[row["fault_type"]] or row["fault_type"] == "normal"


def test_the_package_takes_it(made: Path) -> None:
    bd = pytest.importorskip("bearing_datasets", reason="bearing-datasets is not installed")
    schema = pytest.importorskip("bearing_datasets.schema")
    opened = bd.open(made.name, made.parent)
    card = json.loads((made / "manifest.json").read_text(encoding="utf-8"))
    schema.validate(opened.metadata(), card["columns"])
    assert all(row["signal"].size == 1200 for row in opened.with_signals().to_dict("records"))


def test_of_sixteen_bearings_four_are_for_testing_one_in_each_state() -> None:
    for block in range(3):
        chosen = sorted(for_testing(0, block))
        assert [number // 16 for number in chosen] == [block] * 4
        assert sorted(number % 4 for number in chosen) == [0, 1, 2, 3]


def test_paths_are_as_heavy_as_goes_with_the_bearing() -> None:
    """Truth: similarity. At like frequencies masses go with the square of the outside diameter.

    Beyond that they go with the root of the number of modes.
    """
    plan = Plan(seed=3, seconds=1.0, fs=12_000.0, records=1)
    masses = {}
    for number in range(20):
        name, _ = plan.rows(number)
        path = plan.chain(number)[1].path
        if isinstance(path, br.Structure):
            of_one = path.modes[0].mass * path.modes[0].frequency / len(path.modes) ** 0.5
            masses[br.catalogue[name].outside_diameter] = of_one
    sizes = np.array(list(masses))
    assert sizes.max() > 1.5 * sizes.min()
    at_one_size = np.array(list(masses.values())) / sizes**2
    assert at_one_size == pytest.approx(np.full(sizes.size, at_one_size[0]))


def test_a_bearing_keeps_its_damage_and_changes_load_and_speed() -> None:
    name, rows = Plan(seed=3, seconds=1.0, fs=12_000.0, records=3).rows(5)
    assert name in SIZES
    assert {row["part"] for row in rows} == {"outer_race"}
    for field in ("size_mm", "defects.fault.width", "rows[0].texture.seed", "scene"):
        assert len({row[field] for row in rows}) == 1
    for field in ("drive.speed", "loads.radial.force", "loads.axial.force"):
        assert len({row[field] for row in rows}) == 3


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"bearings": 0}, "bearings = 0: a whole number, at least 1"),
        ({"seconds": 0.01}, "seconds = 0.01: 0.1 to 600"),
        ({"fs": 1.0}, r"fs = 1.0: 1000 to 100000"),
        ({"records": 0}, "records = 0: a whole number, 1 to 1000"),
        ({"workers": 0}, "workers = 0: a whole number, at least 1"),
        ({"seed": -1}, "seed = -1: a whole number, at least 0"),
    ],
)
def test_bad_arguments_are_named(options: dict[str, Any], message: str, tmp_path: Path) -> None:
    with pytest.raises(br.SceneError, match=message):
        make_corpus(tmp_path / "corpus", **(SMALL | options))
    assert not (tmp_path / "corpus").exists()


def test_a_folder_of_others_is_refused(
    made: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(br.SceneError, match=r"seed = 2: that of the set in .*, 1"):
        make_corpus(made, **(SMALL | {"seed": 2}))
    (tmp_path / "notes.txt").touch()
    assert main([str(tmp_path)]) == 2
    assert "a new or empty folder" in capsys.readouterr().err


@pytest.mark.long
def test_ten_minutes_of_it(tmp_path: Path) -> None:
    """Fifteen bearings, ten minutes of two cores: all records met their damage or are healthy, none is still."""
    options: dict[str, Any] = {"bearings": 15, "seconds": 4.0, "records": 4, "progress": False}
    found = make_corpus(tmp_path / "corpus", **options)
    assert sum(found.metadata["n_samples"].to_list()) / 25_600.0 == pytest.approx(240.0, rel=0.05)
    assert set(found.metadata["fault_type"]) == {"normal", "outer", "inner", "rolling_element"}
    for name in found.metadata["signal_id"]:
        assert 0.01 < found.channel(name).x.std() < 1e3
    again = make_corpus(tmp_path / "corpus", **options)
    assert again.metadata.equals(found.metadata)
