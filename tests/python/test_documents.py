"""What was released stays: documents are read as they were meant, and what others write and read is there."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest

import ballrace as br
from ballrace._results.file import metadata
from interface import interface

FOLDER = Path(__file__).parents[1] / "documents"
DOCUMENTS = sorted(FOLDER.glob("schema_*.toml"))
ROW = {
    "ball_count": 9,
    "ball_diameter": 7.94e-3,
    "pitch_diameter": 39.04e-3,
    "outer_conformity": 0.525,
    "inner_conformity": 0.515,
}
DOCUMENT = {"rows": [ROW], "inner_ring": {"mass": 0.2}, "drive": {"speed": 188.5}}


def holds(document: object, stored: object) -> bool:
    """Whether all that was stored is there; fields may have been added."""
    if isinstance(stored, Mapping):
        return isinstance(document, Mapping) and all(
            key in document and holds(document[key], value) for key, value in stored.items()
        )
    if isinstance(stored, Sequence) and not isinstance(stored, str):
        assert isinstance(document, Sequence)
        return len(document) == len(stored) and all(map(holds, document, stored))
    return document == stored


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: path.stem)
def test_documents_keep_their_meaning(path: Path) -> None:
    """Golden: what a released version read. A default that changes needs a new number of the schema."""
    scene = br.Scene.load(path)
    stored = path.with_suffix(".json")
    meant = json.loads(stored.read_text(encoding="utf-8"))
    # Asked for nothing, and is no more.
    assert meant.pop("approximations") == dict.fromkeys(("rolling", "plane", "one_row"), False)
    assert holds(json.loads(scene.to_json()), meant)
    assert br.Scene.load(stored) == scene


def test_what_is_gone_is_said_to_be() -> None:
    document = {**DOCUMENT, "approximations": {"rolling": True}}
    with pytest.raises(
        br.SceneError, match=r"^approximations\.rolling = true: .*removed with 0\.4"
    ):
        br.Scene.from_json(json.dumps(document))


def test_the_current_schema_is_stored() -> None:
    assert f"schema_{br.Scene.schema}" in [path.stem for path in DOCUMENTS]


def test_a_document_without_a_schema_is_of_the_first() -> None:
    scene = br.Scene.from_json(json.dumps(DOCUMENT))
    assert scene.schema == 1
    assert scene == br.Scene.from_json(json.dumps({"schema": 1, **DOCUMENT}))


@pytest.mark.parametrize("extra", [{}, {"temperature": 40.0}, {"drive": {"hydraulic": 3.0}}])
def test_a_newer_document_says_to_upgrade(extra: dict[str, object], tmp_path: Path) -> None:
    """What it has that this version lacks is no mistake, and not what is reported."""
    document = {"schema": br.Scene.schema + 1, **DOCUMENT, **extra}
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(document))
    with pytest.raises(br.SceneError, match=r"newer .* pip install --upgrade ballrace") as caught:
        br.Scene.load(path)
    assert (caught.value.path, caught.value.value) == ("schema", str(br.Scene.schema + 1))
    toml = "schema = 99\nwhatever = 1\n"
    with pytest.raises(br.SceneError, match="--upgrade"):
        br.Scene.from_toml(toml)


@pytest.mark.parametrize(
    ("text", "path"),
    [('{"schema": 0}', "rows"), ('{"schema": "2"}', "schema"), ("[1]", "scene"), ("{", "scene")],
)
def test_other_mistakes_are_reported_as_before(text: str, path: str) -> None:
    with pytest.raises(br.SceneError) as caught:
        br.Scene.from_json(text)
    assert "--upgrade" not in str(caught.value)
    assert path in str(caught.value)


def test_files_of_newer_versions_are_not_called_damaged(tmp_path: Path, out: br.Signals) -> None:
    path = tmp_path / "run.parquet"
    entries = metadata(out)
    newer = json.dumps(json.loads(entries["scene"]) | {"schema": br.Scene.schema + 1, "heat": 1.0})
    out.to_polars().write_parquet(path, metadata={**entries, "scene": newer})
    with pytest.raises(br.FileError, match=r"schema = 2: .* --upgrade") as caught:
        br.Signals.read_parquet(path)
    assert "damaged" not in str(caught.value)
    out.to_polars().write_parquet(path, metadata={**entries, "ballrace": "9"})
    with pytest.raises(br.FileError, match=r"format 9, this .* reads 1; read it with the one"):
        br.Signals.scan_parquet(path)


def test_campaigns_of_newer_versions_say_so(tmp_path: Path) -> None:
    (tmp_path / "campaign.json").write_text('{"format": 9}')
    with pytest.raises(br.CampaignError, match=r"format 9, this .* the version that made"):
        br.Campaign.open(tmp_path)


def test_nothing_is_taken_away() -> None:
    """Golden: what 0.2 offers. What goes must have warned for a version, see docs/stability.md; then mint anew."""
    stored = json.loads((FOLDER / "interface.json").read_text(encoding="utf-8"))
    offered = interface()
    gone = {name for name in stored if name not in offered}
    lost = {
        name: [each for each in behind if each not in offered[name]]
        for name, behind in stored.items()
        if name not in gone and not set(behind) <= set(offered[name])
    }
    assert not gone, sorted(gone)
    assert not lost, lost
