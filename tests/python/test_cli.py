"""The command, as people call it."""

from __future__ import annotations

import contextlib
import functools
import importlib.util
import json
import operator
import os
import platform
import re
import stat
import subprocess
import sys
from pathlib import Path

import jsonschema
import numpy as np
import pytest

import ballrace as br
from ballrace import _core
from ballrace.cli import main
from ballrace.scene.schema import schema
from messages import leaves, put
from test_scene import scenes


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def scene_file(tmp_path: Path) -> Path:
    path = tmp_path / "scene.toml"
    path.write_text(br.presets.deep_groove_6205().to_toml())
    return path


def refused(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    """Run a command that must fail as bad input with one line, and return the line."""
    try:
        status = main(arguments)
    except SystemExit as stop:
        status = int(stop.code or 0)
        assert status == 2
        return capsys.readouterr().err
    assert status == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert len(captured.err.splitlines()) == 1
    return captured.err


def test_a_damaged_file_is_bad_input(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    (tmp_path / "bad.parquet").write_text("x")
    assert "not a Parquet file" in refused(capsys, "spectrum", str(tmp_path / "bad.parquet"))


def test_a_page_for_assistants(capsys: pytest.CaptureFixture[str]) -> None:
    """Its code runs with the guide's; here that it names functions that exist."""
    assert main(["skill"]) == 0
    page = capsys.readouterr().out
    assert page.startswith("---\nname: ballrace\ndescription: ")
    for name in re.findall(r"br\.([a-z_]+)\(", page):
        assert callable(getattr(br, name)), name


def test_demo(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert main(["demo", "--duration", "0.004"]) == 0
    captured = capsys.readouterr()
    assert "kurtosis" in captured.out
    assert captured.err == ""
    folder = tmp_path / "ballrace-demo"
    assert {p.name for p in folder.iterdir()} == {
        "axial_0N.parquet",
        "axial_3000N.parquet",
        "axial_-3000N.parquet",
        "demo.html",
    }
    out = br.Signals.read_parquet(folder / "axial_3000N.parquet")
    assert out.scene == br.presets.wheel_bearing(3000.0)
    page = (folder / "demo.html").read_text(encoding="utf-8")
    assert "Why thrust makes the impacts of a spall stronger" in page
    # Self-contained: no script is fetched.
    assert not re.search(r"<script[^>]*\ssrc=", page)


def test_demo_without_plotly(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    find = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda name: None if name == "plotly" else find(name)
    )
    assert main(["demo", "-o", "here", "--duration", "0.002"]) == 0
    assert 'pip install "ballrace[plot]"' in capsys.readouterr().out
    assert len(list((tmp_path / "here").iterdir())) == 3


def test_run(capsys: pytest.CaptureFixture[str], scene_file: Path) -> None:
    arguments = [
        "run",
        str(scene_file),
        "-o",
        "out.parquet",
        "--duration",
        "0.002",
        "--fs",
        "10000",
    ]
    assert main([*arguments, "--start", "rolling", "--rtol", "1e-5", "--threads", "1"]) == 0
    assert "20 samples" in capsys.readouterr().out
    out = br.Signals.read_parquet("out.parquet")
    assert out.fs == 10_000
    assert "outer.ay" in out


def test_scene_prints_a_bearing_of_the_catalogue(capsys: pytest.CaptureFixture[str]) -> None:
    """Truth: the function behind the command."""
    assert main(["scene", "6309/C3", "--radial-load", "3000", "--rpm", "1470"]) == 0
    printed = br.Scene.from_toml(capsys.readouterr().out)
    assert printed == br.bearing("6309", radial_load=3000.0, speed_rpm=1470.0, clearance="C3")
    assert "near are" in refused(capsys, "scene", "620")
    message = refused(capsys, "scene", "wheel-bearing", "--rpm", "100")
    assert "speed_rpm = 100: absent beside wheel-bearing" in message
    scenes = {
        "pedestal": br.bearing("6309", speed_rpm=1800.0),
        "none": br.bearing("6309", housing=None, speed_rpm=1800.0),
    }
    for housing, scene in scenes.items():
        assert main(["scene", "6309", "--housing", housing]) == 0
        assert br.Scene.from_toml(capsys.readouterr().out) == scene
    message = refused(capsys, "scene", "wheel-bearing", "--housing", "pedestal")
    assert "housing = pedestal: absent beside wheel-bearing" in message


def test_scene_prints_a_preset(capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("wheel-bearing", "wheel_bearing"):
        assert main(["scene", name]) == 0
        text = capsys.readouterr().out
        assert text.startswith("# ")
        assert br.Scene.from_toml(text) == br.presets.wheel_bearing()


def test_equilibrium_prints_a_table(capsys: pytest.CaptureFixture[str], scene_file: Path) -> None:
    assert main(["equilibrium", str(scene_file)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len([line for line in lines if line.startswith("row0.ball")]) == 9
    assert any(line.startswith("balanced to ") for line in lines)
    assert not any(line.startswith(("stiffness", "equivalent")) for line in lines)


def test_equilibrium_prints_stiffness_and_equivalent_loads(
    capsys: pytest.CaptureFixture[str], scene_file: Path
) -> None:
    """Truth: the functions behind the command."""
    assert main(["equilibrium", str(scene_file), "--stiffness", "--life"]) == 0
    lines = [line.split() for line in capsys.readouterr().out.splitlines()]
    scene = br.Scene.load(scene_file)
    printed = [[float(x) for x in line[1:]] for line in lines if line and line[0] in "xyz"]
    np.testing.assert_allclose(printed, 1e-6 * br.stiffness(scene).inner, atol=5.1e-4)
    loads = br.load_distribution(scene)
    (printed_loads,) = ([float(x) for x in line[1:]] for line in lines if line[:1] == ["row0"])
    expected = [loads.outer_equivalent[0], loads.inner_equivalent[0]]
    np.testing.assert_allclose(printed_loads, expected, atol=0.051)
    (printed_life,) = (line[-2:] for line in lines if line[:1] == ["ISO/TS"])
    life = br.rating_life(scene).reference
    assert life is not None
    assert float(printed_life[0]) == pytest.approx(life / 1e6, rel=1e-3)


def test_bad_input_is_one_line_and_leaves_nothing(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, scene_file: Path
) -> None:
    bad = tmp_path / "bad.toml"
    bad.write_text(scene_file.read_text().replace("ball_count = 9", "ball_count = 90"))
    broken = tmp_path / "broken.toml"
    broken.write_text("rows = [")
    before = set(tmp_path.iterdir())
    good = str(scene_file)
    assert "ball_diameter" in refused(capsys, "run", str(bad), "-o", "out.parquet")
    assert "TOML" in refused(capsys, "run", str(broken), "-o", "out.parquet")
    assert "none.toml" in refused(capsys, "run", "none.toml", "-o", "out.parquet")
    assert "nowhere" in refused(capsys, "run", good, "-o", "nowhere/out.parquet")
    assert str(tmp_path) in refused(capsys, "run", good, "-o", str(tmp_path))
    assert "duration" in refused(capsys, "run", good, "-o", "out.parquet", "--duration", "-1")
    assert "duration" in refused(capsys, "run", good, "-o", "out.parquet", "--duration", "1e12")
    assert "fs" in refused(capsys, "run", good, "-o", "out.parquet", "--fs", "nan")
    assert "rtol" in refused(capsys, "run", good, "-o", "out.parquet", "--rtol", "2")
    assert "threads" in refused(capsys, "run", good, "-o", "out.parquet", "--threads", "-1")
    assert "sideways" in refused(capsys, "run", good, "-o", "out.parquet", "--start", "sideways")
    assert "duration" in refused(capsys, "demo", "--duration", "nan")
    assert "nowhere" in refused(capsys, "demo", "-o", "nowhere/demo")
    assert "scene.toml" in refused(capsys, "demo", "-o", good)
    assert "roller" in refused(capsys, "scene", "roller")
    assert set(tmp_path.iterdir()) == before


def test_a_failed_run_exits_with_one(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    scene = br.presets.wheel_bearing().replace({"loads.axial.force": 1e9})
    (tmp_path / "heavy.toml").write_text(scene.to_toml())
    assert main(["run", "heavy.toml", "-o", "out.parquet"]) == 1
    assert "equilibrium" in capsys.readouterr().err
    assert not (tmp_path / "out.parquet").exists()


def test_as_a_module() -> None:
    command = [sys.executable, "-m", "ballrace", "scene", "deep-groove-6205"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert "ball_count = 9" in done.stdout
    done = subprocess.run(command[:3], capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert "usage: ballrace" in done.stderr


def test_a_reader_that_leaves_is_no_error() -> None:
    command = [sys.executable, "-m", "ballrace", "scene", "wheel-bearing"]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as child:
        assert child.stdout is not None
        assert child.stderr is not None
        child.stdout.close()
        assert child.stderr.read() == ""


def test_outputs_that_cannot_be_meant(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, scene_file: Path
) -> None:
    """Refused before anything runs: the input, what would be replaced, and names of other formats."""
    text = scene_file.read_text()
    good = str(scene_file)
    as_parquet = tmp_path / "scene.parquet"
    as_parquet.symlink_to(scene_file)
    plain = tmp_path / "scene"
    os.link(scene_file, plain)
    before = set(tmp_path.iterdir())
    assert "a file that ends in .parquet" in refused(capsys, "run", good, "-o", good)
    for same in (as_parquet, plain):
        assert "another file than the scene" in refused(capsys, "run", good, "-o", str(same))
    for name in ("out.csv", "out.mat", "out.html", "out.toml"):
        assert "a file that ends in .parquet" in refused(capsys, "run", good, "-o", name)
    assert scene_file.read_text() == text
    assert set(tmp_path.iterdir()) == before


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no such files")
def test_devices_and_pipes_are_not_replaced(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, scene_file: Path, out: br.Signals
) -> None:
    """Root could: the device node /dev/null became a regular file."""
    pipe = tmp_path / "pipe.parquet"
    os.mkfifo(pipe)
    targets = [pipe, Path(os.devnull)]
    null = tmp_path / "null.parquet"
    with contextlib.suppress(PermissionError):
        os.mknod(null, stat.S_IFCHR | 0o666, os.makedev(1, 3))
        targets.append(null)
    kinds = [stat.S_IFMT(path.stat().st_mode) for path in targets]
    for path in targets:
        message = refused(capsys, "run", str(scene_file), "-o", str(path))
        assert "is a device or a pipe, not a file" in message
        with pytest.raises(OSError, match="is a device or a pipe"):
            out.write_parquet(path)
    assert [stat.S_IFMT(path.stat().st_mode) for path in targets] == kinds


def test_a_link_is_followed(tmp_path: Path, out: br.Signals) -> None:
    (tmp_path / "far").mkdir()
    link = tmp_path / "out.parquet"
    link.symlink_to(tmp_path / "far" / "real.parquet")
    out.write_parquet(link)
    assert link.is_symlink()
    assert br.Signals.read_parquet(tmp_path / "far" / "real.parquet").names == out.names


COMMANDS = (
    "demo", "paper", "run", "scene", "equilibrium", "explain", "report", "spectrum", "frequencies", "schema",
    "doctor",
)  # fmt: skip


@pytest.mark.parametrize("command", COMMANDS)
def test_help_says_what_it_does_with_one_example(
    capsys: pytest.CaptureFixture[str], command: str
) -> None:
    with pytest.raises(SystemExit) as stop:
        main([command, "--help"])
    assert stop.value.code == 0
    text = capsys.readouterr().out
    assert f"ballrace {command}" in text.partition("example: ")[2]
    assert len(text.splitlines()[2]) > 20 or len(text.splitlines()) > 8


def test_version(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stop:
        main(["--version"])
    assert stop.value.code == 0
    assert re.fullmatch(r"ballrace \d+\.\d+\.\d+\S*\n", capsys.readouterr().out)


def test_frequencies(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["frequencies", "SKF 6205-2RS", "--rpm", "1797"]) == 0
    lines = dict(line.split() for line in capsys.readouterr().out.splitlines()[2:])
    wanted = br.fault_frequencies("6205", 1797.0)
    assert float(lines["BPFO"]) == pytest.approx(wanted.bpfo, abs=5e-5)
    assert main(["frequencies", "6205", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["BPFI"] == pytest.approx(wanted.orders.bpfi)
    assert found["unit"] == "per turn"
    assert "6205" in refused(capsys, "frequencies", "62055")
    assert "speed_rpm" in refused(capsys, "frequencies", "6205", "--rpm", "0")


def test_schema_knows_the_scenes_that_there_are(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["schema"]) == 0
    schema = json.loads(capsys.readouterr().out)
    validate = jsonschema.Draft202012Validator(schema)
    for name in br.presets.names():
        document = json.loads(getattr(br.presets, name)().to_json())
        assert list(validate.iter_errors(document)) == []
    document["rows"][0]["balls"] = 9
    (error,) = validate.iter_errors(document)
    assert "balls" in error.message


def test_schema_names_every_field(capsys: pytest.CaptureFixture[str]) -> None:
    """Truth: a document with every field written out has no key that the schema lacks, and no more."""
    assert main(["schema"]) == 0
    schema = json.loads(capsys.readouterr().out)
    document = json.loads(br.presets.wheel_bearing().to_json())
    assert set(document) <= set(schema["properties"])
    assert set(document["rows"][0]) <= set(schema["$defs"]["Row"]["properties"])
    assert schema["$defs"]["Iso16281"]["required"] == ["iso16281"]
    assert all("description" in field for field in schema["$defs"]["Row"]["properties"].values())


def test_schema_refuses_what_no_scene_may_have() -> None:
    """Truth: the core. What it refuses far out the schema refuses, but where a range depends on other fields."""
    validate = jsonschema.Draft202012Validator(schema())
    depending = {
        "amplitude", "axial_offset", "axial_preload", "ball", "balls", "clearance", "damping", "depth",
        "diameter_errors", "direction", "edge_radius", "given", "length", "orders", "outer_speed", "phase",
        "inner_shoulder_radius", "outer_shoulder_radius", "pocket_errors", "positions", "row", "schema", "seed",
        "side", "speed", "static_compliance", "stiffness", "tilt", "z",
    }  # fmt: skip
    # A sensor of a structure, by its own name.
    depending.add("top")
    in_time = {"ramp", "sine", "spline", "table", "force", "moment", "value"}
    seen: set[tuple[str, float]] = set()
    loose = set()
    for scene in scenes():
        document = json.loads(scene.to_json())
        assert not list(validate.iter_errors(document))
        for path in leaves(document):
            names = [key for key in path if isinstance(key, str)]
            number = functools.reduce(operator.getitem, path, document)
            if isinstance(number, bool) or not isinstance(number, int | float):
                continue
            for beyond in (-(10**13), 10**17):
                if (
                    (".".join(names), beyond) in seen
                    or names[-1] in depending
                    or in_time & {*names}
                ):
                    continue
                seen.add((".".join(names), beyond))
                changed = put(document, path, beyond)
                try:
                    br.Scene.from_json(json.dumps(changed))
                except br.SceneError:
                    if validate.is_valid(changed):
                        loose.add(names[-1])
    assert loose == set()
    assert len(seen) > 200


def test_doctor(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["doctor"]) == 0
    text = capsys.readouterr().out
    assert "vector instructions: " in text
    assert text.endswith("all is well\n")


@pytest.mark.parametrize(
    ("processor", "compatible", "reported"),
    [
        (("x86_64", ["baseline"]), False, True),
        (("AMD64", ["baseline"]), False, True),
        (("x86_64", ["baseline"]), True, False),
        (("x86_64", ["x86-64-v3", "baseline"]), False, False),
        (("arm64", ["baseline"]), False, False),
    ],
)
def test_doctor_reports_that_polars_needs_rtcompat(
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    processor: tuple[str, list[str]],
    compatible: bool,
    reported: bool,
) -> None:
    """Truth: the usual build of polars wants AVX2 on x86-64; its module `_polars_runtime_compat` does not."""
    machine, sets = processor
    found = importlib.util.find_spec

    def find_spec(name: str) -> object:
        if name == "_polars_runtime_compat":
            return object() if compatible else None
        return found(name)

    monkeypatch.setattr(_core, "instruction_sets", lambda: sets)
    monkeypatch.setattr(platform, "machine", lambda: machine)
    monkeypatch.setattr(importlib.util, "find_spec", find_spec)
    assert main(["doctor"]) == int(reported)
    assert ("polars[rtcompat]" in capsys.readouterr().out) == reported


def test_report_of_a_file_and_a_folder(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, out: br.Signals, wheel: br.Scene
) -> None:
    out.write_parquet(tmp_path / "out.parquet")
    assert main(["report", "out.parquet", "-o", "a.html", "--title", "Mine"]) == 0
    assert "<h1>Mine</h1>" in (tmp_path / "a.html").read_text(encoding="utf-8")
    br.campaign(br.grid({"loads.axial.force": [0.0]}), "runs", scene=wheel, duration=0.001)
    assert main(["report", "runs", "-o", "b.html"]) == 0
    assert "Campaign runs" in (tmp_path / "b.html").read_text(encoding="utf-8")
    capsys.readouterr()
    before = set(tmp_path.iterdir())
    assert "html" in refused(capsys, "report", "out.parquet", "-o", "a.pdf")
    assert "none.parquet" in refused(capsys, "report", "none.parquet", "-o", "c.html")
    assert "quiet" in refused(capsys, "report", "out.parquet", "-o", "c.html", "--columns", "quiet")
    assert set(tmp_path.iterdir()) == before


@pytest.fixture
def blows(tmp_path: Path) -> Path:
    """A measured record: blows at the inner race's rate of a 6205 at 1797 1/min."""
    rate, fs = br.fault_frequencies("6205", 1797.0).bpfi, 12_000.0
    since = (np.arange(24_000) / fs) % (1.0 / rate)
    x = np.exp(-800.0 * since) * np.sin(2 * np.pi * 3000.0 * since)
    br.Recording(columns={"sensor": x}, fs=fs).write(tmp_path / "blows.wav")
    return tmp_path / "blows.wav"


def test_a_rate_that_is_not_that_of_a_run(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    out = br.simulate(br.presets.deep_groove_6205(), duration=1e-3, fs=20e3)
    out.write_parquet(tmp_path / "out.parquet")
    text = refused(capsys, "diagnose", str(tmp_path / "out.parquet"), "--fs", "1000")
    assert "fs = 1000: the rate of the run, 20000 Hz, or absent" in text


def test_spectrum(capsys: pytest.CaptureFixture[str], tmp_path: Path, blows: Path) -> None:
    named = ["--bearing", "6205", "--rpm", "1797"]
    assert main(["spectrum", str(blows), *named]) == 0
    first = capsys.readouterr().out.splitlines()[1].split()
    assert float(first[0]) == pytest.approx(162.2, abs=0.5)
    assert first[2] == "BPFI"
    turning = tmp_path / "turning.csv"
    t = np.arange(12_000) / 12_000.0
    shaft = np.sin(2.0 * np.pi * 2.0 * 29.95 * t)
    turning.write_text("t,ay\n" + "".join(f"{a},{b}\n" for a, b in zip(t, shaft, strict=True)))
    assert main(["spectrum", str(turning), "--plain", *named]) == 0
    assert capsys.readouterr().out.splitlines()[1].split()[2] == "2·f_r"
    assert main(["spectrum", str(blows), "-o", "-", "--band", "2000", "4000"]) == 0
    rows = np.array(
        [line.split(",") for line in capsys.readouterr().out.splitlines()[1:]], dtype=float
    )
    x = br.read(blows)["sensor"]
    f, value = br.spectra.envelope_spectrum(x, 12_000.0, (2000.0, 4000.0))
    np.testing.assert_allclose(rows, np.column_stack([f, value]))
    assert main(["spectrum", str(blows), "--plain", "-o", "s.csv"]) == 0
    assert (tmp_path / "s.csv").read_text().startswith("frequency,value")
    assert main(["spectrum", str(blows), *named, "-o", "s.html"]) == 0
    assert "BPFI" in (tmp_path / "s.html").read_text(encoding="utf-8")
    capsys.readouterr()
    assert "band" in refused(capsys, "spectrum", str(blows), "--band", "9000", "1000")
    assert "column" in refused(capsys, "spectrum", str(blows), "--column", "x")
    assert "csv" in refused(capsys, "spectrum", str(blows), "-o", "s.pdf")
    assert "plain" in refused(capsys, "spectrum", str(blows), "--plain", "-o", "t.html")
    # It would say nothing: a record has no bearing of its own.
    assert "absent without --bearing" in refused(capsys, "spectrum", str(blows), "--rpm", "1797")
    assert not (tmp_path / "t.html").exists()


def test_streams(tmp_path: Path) -> None:
    """A scene, its signals and their report through pipes, without a file between."""
    command = f"{sys.executable} -m ballrace"
    line = (
        f"{command} scene deep-groove-6205 | {command} run - -o - --duration 0.02 --method dormand-prince"
        f" | {command} report - -o r.html"
    )
    done = subprocess.run(line, shell=True, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert "r.html" in done.stdout
    assert "6205" in (tmp_path / "r.html").read_text(encoding="utf-8")
    scene = br.presets.deep_groove_6205()
    for text in (scene.to_json(), scene.to_toml()):
        piped = subprocess.run(
            [sys.executable, "-m", "ballrace", "equilibrium", "-", "--json"],
            input=text, capture_output=True, text=True, check=True,
        )  # fmt: skip
        balls = json.loads(piped.stdout)["balls"]
        np.testing.assert_allclose(
            [b["outer_load"] for b in balls], br.equilibrium(scene).outer_load
        )


def test_a_terminal_gets_no_parquet(
    capsys: pytest.CaptureFixture[str], scene_file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    assert "no text to read" in refused(capsys, "run", str(scene_file), "-o", "-")


def test_explain_draws_the_scene(
    capsys: pytest.CaptureFixture[str], scene_file: Path, tmp_path: Path
) -> None:
    assert main(["explain", str(scene_file), "--drawing", "scene.html"]) == 0
    assert "contact angle" in (tmp_path / "scene.html").read_text(encoding="utf-8")
    capsys.readouterr()
    assert "html" in refused(capsys, "explain", str(scene_file), "--drawing", "scene.svg")


def test_diagnose(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    """A verdict from a file, with a page; what cannot be found of it is refused in one line."""
    rng = np.random.default_rng(1)
    rate = br.catalogue["6205"].orders.bpfo * 30.0
    x = 0.3 * rng.normal(size=24_000)
    at = np.rint((np.arange(200) + 0.005 * rng.normal(size=200)) * 12_000.0 / rate).astype(int)
    x[at[(at >= 0) & (at < x.size)]] += 5.0
    br.Recording(columns={"quiet": rng.normal(size=x.size), "DE": x}, fs=12_000.0).write(
        "record.csv"
    )
    known = ["diagnose", "record.csv", "--bearing", "6205"]
    assert main([*known, "--rpm", "1800", "--channel", "DE", "-o", "page.html"]) == 0
    printed = capsys.readouterr().out
    assert printed.startswith("6205: damaged, outer race\n")
    assert "give unit=" in printed
    assert (tmp_path / "page.html").is_file()
    exact = ["--speed-within", "0.001"]
    assert main([*known, "--rpm", "1800", *exact, "--exclude", "1.7", "--mains", "50"]) == 0
    assert capsys.readouterr().out.startswith("6205: healthy\n")
    assert "--rpm = none" in refused(capsys, *known)
    assert "speed_within = 0.5" in refused(capsys, *known, "--rpm", "1800", "--speed-within", "0.5")
    assert "channel = 'FE'" in refused(capsys, *known, "--rpm", "1800", "--channel", "FE")
    assert "designation = '62x'" in refused(capsys, *known[:3], "62x", "--rpm", "1800")
    assert ".html" in refused(capsys, *known, "--rpm", "1800", "-o", "page.txt")
    assert "missing.csv" in refused(capsys, "diagnose", "missing.csv", "--bearing", "6205")
    head = "Drehzahl;1797 1/min\nLogger;X 3\n\nt;a\n"
    rows = "".join(f"{1e-4 * k:.4f};{k % 7}\n" for k in range(2000))
    Path("pump.csv").write_text(head + rows, encoding="utf-8")
    text = refused(capsys, "diagnose", "pump.csv", "--bearing", "6205")
    assert "--rpm = none: the speed [1/min]" in text
    assert text.rstrip().endswith('; its head has "Drehzahl: 1797 1/min"')


def test_a_missing_library_is_one_line(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "marimo", None)
    assert main(["explore", "--no-browser"]) == 1
    message = capsys.readouterr().err
    assert message.startswith("ballrace: ballrace explore needs marimo"), message
    assert message.count("\n") == 1
    assert message.endswith('pip install "ballrace[app]"\n')


def test_what_a_file_does_not_say_is_said_on_the_command_line(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """A clock in µs, a decimal comma, two lines of something else, a part of the record."""
    x = np.sin(2.0 * np.pi * 50.0 * np.arange(2000) / 1000.0)
    lines = [f"{1000 * k};{value:.6f}".replace(".", ",") for k, value in enumerate(x)]
    path = tmp_path / "a.txt"
    path.write_text("\n".join(["1;2", "3;4", *lines]))
    assert "time_unit" in refused(capsys, "spectrum", str(path), "--skip", "2")
    said = ["--skip", "2", "--decimal", ",", "--time", "0", "--time-unit", "us", "--columns", "-1"]
    assert main(["spectrum", str(path), "--plain", *said, "--start", "0.5", "--stop", "1.5"]) == 0
    assert "50.00" in capsys.readouterr().out
    assert (
        main(["spectrum", str(path), "--plain", "--skip", "2", "--time", "none", "--fs", "1000"])
        == 0
    )
    capsys.readouterr()
    assert "columns" in refused(capsys, "spectrum", str(path), *said[:-1], "7")
