"""What people read: names do not steer their terminal, and numbers are as they write them."""

from __future__ import annotations

import io
from pathlib import Path

import pytest

import ballrace as br
import messages
from ballrace._base.progress import Bar
from ballrace._base.text import printable
from ballrace.cli import main
from sweeps import SCENE, run

EVIL = "\x1b]0;owned\x07\x1b[2J\u202e\x9b31m"
"""Names the window, clears the screen, turns the direction of writing, colours."""


def harmless(text: str) -> bool:
    return printable(text) == text


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_printable_keeps_what_people_write() -> None:
    text = "5 µm, 1e-3 m/s², Kugel „7“ — 轴承\n\tnext"
    assert printable(text) == text
    assert printable(EVIL) == r"\x1b]0;owned\x07\x1b[2J\u202e\x9b31m"


def test_names_in_errors(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(br.SceneError) as caught:
        SCENE.replace({f"loads.{EVIL}.force": 1.0})
    assert harmless(str(caught.value))
    assert "x1b]0;owned" in str(caught.value)
    path = tmp_path / "scene.toml"
    text = SCENE.to_toml().replace('name = "', 'nam\\u001B = "', 1)
    path.write_text(text.replace("[loads.radial]", '[loads."\\u001B[31m"]\nforc = 1.0', 1))
    assert main(["run", str(path), "-o", str(tmp_path / "out.parquet")]) == 2
    assert harmless(capsys.readouterr().err)
    for error in (
        br.FileError(EVIL, EVIL),
        br.BudgetError(EVIL, 0.0, "time_limit", 1.0),
        br.CampaignError(EVIL),
    ):
        assert harmless(str(error))
    assert harmless(str(br.IntegrationError(EVIL, 0.0, 0.0, EVIL)))


def test_names_in_a_campaign(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    cases = [{"loads.radial.force": 300.0, "start": EVIL, "label \x1b7\x07": EVIL}]
    done = run(cases, tmp_path / EVIL.replace("/", ""), progress=True)
    assert harmless(done.manifest["message"][0])
    assert harmless(done.status())
    assert harmless(repr(done))
    printed = capsys.readouterr()
    assert harmless(printed.err)
    assert main(["campaign", "--status", str(done.folder)]) == 0
    assert harmless(capsys.readouterr().out)


def test_names_in_bars_and_reports(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    stream = Terminal()
    with Bar(EVIL, stream) as bar:
        bar.show(0.5)
    assert "\x1b]0;" not in stream.getvalue()
    scene = SCENE.replace({"name": EVIL})
    out = br.simulate(scene, duration=1e-4, start="rolling")
    assert harmless(repr(out))
    (tmp_path / "scene.toml").write_text(scene.to_toml())
    assert main(["explain", str(tmp_path / "scene.toml")]) == 0
    assert harmless(capsys.readouterr().out)


@pytest.mark.parametrize("value", [1e300, -1e300, 3e-300])
def test_large_numbers_print_as_such(value: float) -> None:
    with pytest.raises(br.SceneError) as caught:
        SCENE.replace({"rows[0].ball_diameter": value})
    exponent = str(value).partition("e")[2].replace("+", "")
    assert f"e{exponent}" in str(caught.value)
    assert len(str(caught.value)) < 200


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"rows[0].clearance": 0.1 + 0.2}, "rows[0].clearance = 0.3: from -794 µm to 3.97 mm"),
        ({"cage.play": -1.0}, "cage.play = -1: from 0 m to 1 m"),
        ({"contact.damping": 1e4}, "contact.damping = 10000: from 0 to 1000"),
        ({"rows[0].contact_angle": 30.0}, "contact_angle = 30: from 0 to 1.396 rad, which is 80°"),
        ({"rows[0].ball_count": 40}, "less than the distance of neighbouring balls, 3.063 mm, for"),
        ({"outer_ring.diameter": 0.01}, "above the groove bottom of rows[0], 46.98 mm"),
    ],
)
def test_limits_are_given_in_a_readers_numbers(changes: dict[str, object], message: str) -> None:
    with pytest.raises(br.SceneError) as caught:
        br.presets.deep_groove_6205().replace(changes)
    assert message in str(caught.value)


def test_what_cannot_be_carried_is_given_as_a_share() -> None:
    with pytest.raises(br.EquilibriumError, match=r"carried: [0-9.]+ % of the load is not"):
        br.equilibrium(br.presets.wheel_bearing(1e9))


def test_a_field_of_a_new_entry_says_how_to_give_one() -> None:
    scene = br.presets.deep_groove_6205()
    with pytest.raises(br.SceneError, match=r"to add one, set defects\.new as a whole"):
        scene.replace({"defects.new.width": 1e-3})


def test_messages_of_all_fields_are_those_reviewed() -> None:
    """Golden: a message that is new or changed is read as its reader would, and put there (``messages.py``)."""
    known = (Path(__file__).parents[1] / "documents" / "messages.txt").read_text("utf-8")
    assert messages.text().splitlines() == known.splitlines()
    for of_rust in ("invalid type", "f64", "u64", "usize", "struct ", "`"):
        assert of_rust not in known
