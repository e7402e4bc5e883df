"""The command `ballrace campaign`."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import ballrace as br
from ballrace.cli import main
from ballrace.cli.campaigns import _ARGUMENTS, _BUILDERS, read

SWEEP = """
scene = "deep-groove-6205"
duration = 1e-3
columns = ["outer.ay"]
table = "labels.csv"

[grid]
"loads.radial.force" = { from = 200.0, to = 400.0, count = 3 }

[scatter]
n = 2
seed = 1
clearance = 2e-6
"""


@pytest.fixture
def sweep(tmp_path: Path) -> Path:
    (tmp_path / "labels.csv").write_text("label,rtol\na,1e-6\nb,1.0\n")
    (tmp_path / "sweep.toml").write_text(SWEEP)
    return tmp_path / "sweep.toml"


def test_from_a_file_to_a_table(sweep: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = sweep.parent / "runs"
    assert main(["campaign", str(sweep), "-o", str(out), "--dry-run"]) == 0
    assert capsys.readouterr().out.startswith("12 of 12 cases to run: about ")
    assert not out.exists()

    assert main(["campaign", str(sweep), "-o", str(out), "--shard", "0/2", "--threads", "1"]) == 0
    assert "12 cases: 3 ok, 3 failed, 6 missing" in capsys.readouterr().out
    assert main(["campaign", "--status", str(out)]) == 0
    printed = capsys.readouterr().out
    assert "12 cases: 3 ok, 3 failed, 6 missing" in printed
    assert "3 × SceneError, the first: rtol = 1: 1e-12 to 1e-1, or absent" in printed

    assert main(["campaign", str(sweep), "-o", str(out), "--shard", "1/2"]) == 0
    manifest = br.Campaign.open(out).manifest
    assert manifest.columns[1:5] == ["label", "rtol", "loads.radial.force", "bearing_id"]
    assert manifest["loads.radial.force"].to_list()[:6] == [
        200.0,
        200.0,
        300.0,
        300.0,
        400.0,
        400.0,
    ]
    assert manifest["status"].to_list() == 6 * ["ok"] + 6 * ["failed"]
    assert "outer.ay.rms" in manifest.columns
    assert "outer.ax.rms" not in manifest.columns


def test_the_sweep_of_the_guide(tmp_path: Path) -> None:
    guide = (Path(__file__).parents[2] / "docs" / "campaigns.md").read_text(encoding="utf-8")
    found = re.search(r"^```toml\n(.*?)^```", guide, flags=re.DOTALL | re.MULTILINE)
    assert found
    (tmp_path / "sweep.toml").write_text(found[1])
    sweep = read(tmp_path / "sweep.toml")
    assert (sweep["cases"].height, sweep["duration"]) == (6, 0.02)
    assert sweep["scene"] == br.presets.wheel_bearing()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("scene = 3 =", "sweep = "),
        ('scene = "deep-groove-6205"', "cases = absent: at least one of table, grid"),
        ("[grid]\na = [1]", "scene = absent, as is scenes: either scene, a name or a file"),
        ('scene = "x.txt"\n[grid]\na = [1]', "a file that ends in .toml or .json"),
        ('scenes = { a = "wheel-bearing" }\nscene = "a"', "scene = given beside scenes: either scene"),
        ('scene = "wheel-bearing"\nduration.start = 1\n[grid]\na = [1]', "duration = {'start': 1}: a number"),
        ('colums = ["outer.ay"]', "colums = an entry of the sweep: one of scene"),
        ('scene = "wheel-bearing"\ntable = "a.xlsx"', "a file that ends in .csv or .parquet"),
        ('scene = "wheel-bearing"\n[grid]\n"a.b" = 3', "a.b = 3: a list of values, or { from"),
        ('scene = "wheel-bearing"\n[grid]\nx = [1]\n[sobol]\nx = [0, 1]\nn = 2\nseed = 1', "x = given twice"),
        ("a = " + "[" * 9999, "a TOML file (nested deeper than is read)"),
        (".".join("a" * 16_000) + " = 1", "a TOML file (line 1: a key of more than 64 parts)"),
        ('scene = "x"\n[grid]\na = [1]', "scene = x: one of wheel-bearing"),
        ('scenes = { b = "x" }\n[grid]\na = [1]', "scenes.b = x: one of wheel-bearing"),
        ('scenes = "wheel-bearing"\n[grid]\na = [1]', "scenes = wheel-bearing: a table of scenes by name"),
        ('scene = "wheel-bearing"\ngrid = 3', "grid = 3: a table, as described by ballrace campaign"),
        ('scene = "wheel-bearing"\nband = 3\nduration = 1e-3\n[grid]\n"rows[0].clearance" = [1e-5]',
         "band = 3: two frequencies [Hz]"),
        ('scene = "wheel-bearing"\ntable = "\\u0000.csv"', "table = \\x00.csv: the name of a file or folder"),
        ('scene = "wheel-bearing"\n[grid]\n"a.b" = { from = 0, to = 1, count = 1000000000000 }',
         "a.b.count = 1,000,000,000,000 cases: at most 10,000,000"),
        ('scene = "wheel-bearing"\n[sobol]\nx = [0, 1]\nn = 131072\nseed = 1\n'
         "[latin_hypercube]\ny = [0, 1]\nn = 100\nseed = 1", "cases = 13,107,200 cases: at most 10,000,000"),
        ('scene = "wheel-bearing"\n[scatter]\nn = 2', "scatter = "),
        ('scene = "wheel-bearing"\n[scatter]\nn = 2\nseed = 1\nsize = 1.0', "as described by ballrace campaign"),
    ],
)  # fmt: skip
def test_bad_sweeps(
    text: str, message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "sweep.toml").write_text(text)
    assert main(["campaign", str(tmp_path / "sweep.toml"), "-o", str(tmp_path / "runs")]) == 2
    assert message in capsys.readouterr().err
    assert not (tmp_path / "runs").exists()


VALUES = (
    "3", "-1", "1.5", "nan", "1e300", "9223372036854775807", "true", "2026-01-01", '""', '"x"',
    '"\\u0000"', '"a\\u0001b"', "[]", "[1]", '["a"]', "[[1]]", "{}", "{ a = 1 }",
)  # fmt: skip


@pytest.mark.parametrize("entry", ["scene", "scenes", *_ARGUMENTS, *_BUILDERS])
def test_any_value_of_any_entry_is_run_or_refused(entry: str, tmp_path: Path) -> None:
    """By an error of the package or of the file system; no other one reaches the user."""
    (tmp_path / "cases.csv").write_text("loads.radial.force\n100.0\n")
    others = {"scene": '"deep-groove-6205"', "duration": "2e-4", "table": '"cases.csv"'}
    others.pop("scene" if entry == "scenes" else entry, None)
    for number, value in enumerate(VALUES):
        sweep, out = tmp_path / "sweep.toml", tmp_path / f"out{number}"
        entries = {entry: value, **others}
        sweep.write_text("".join(f"{name} = {text}\n" for name, text in entries.items()))
        try:
            arguments = read(sweep)
            if arguments["duration"] not in (3, 1.5):  # These would take their time.
                br.campaign(arguments.pop("cases"), out, progress=False, **arguments)
        except (br.BallraceError, OSError):
            assert not out.exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--status", "runs", "sweep.toml"], "sweep = sweep.toml: absent beside --status"),
        (["--status", "runs", "--verify"], "verify = True: absent beside --status"),
        (["runs", "--verify", "-o", "other"], "output = other: absent beside --verify"),
        (["runs", "--verify", "--threads", "3"], "threads = 3: absent beside --verify"),
    ],
    ids=str,
)
def test_what_would_say_nothing_is_refused(
    arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["campaign", *arguments]) == 2
    assert message in capsys.readouterr().err


def test_bad_options(tmp_path: Path, sweep: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["campaign", str(sweep)]) == 2
    assert "SWEEP -o FOLDER" in capsys.readouterr().err
    assert main(["campaign", str(sweep), "-o", str(tmp_path)]) == 1
    assert "not a campaign's folder" in capsys.readouterr().err
    assert main(["campaign", str(sweep), "-o", "-"]) == 2
    assert "output = -: a folder" in capsys.readouterr().err
    assert main(["campaign", "--status", str(tmp_path / "nowhere")]) == 1
    assert "holds no campaign" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        main(["campaign", str(sweep), "-o", str(tmp_path / "runs"), "--shard", "half"])
    assert "'half' is not I/N" in capsys.readouterr().err
