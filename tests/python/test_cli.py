"""The command, as people call it."""

from __future__ import annotations

import contextlib
import importlib.util
import os
import re
import stat
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import ballrace as br
from ballrace.cli import main


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
    assert "Why thrust makes a spall louder" in page
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
        told = refused(capsys, "run", str(scene_file), "-o", str(path))
        assert "is a device or a pipe, not a file" in told
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
