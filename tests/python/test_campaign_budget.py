"""What a case may cost, what a table says of the rows to trust, and Ctrl-C while cases do not notice it."""

from __future__ import annotations

import math
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import polars as pl
import pytest

import ballrace as br
from ballrace.campaigns import Progress
from ballrace.campaigns.store import Store
from ballrace.campaigns.work import Writer
from ballrace.cli import main
from sweeps import SCENE, run, table

WARNED: dict[str, Any] = {"scene": SCENE.replace({"contact.damping": 5.0}), "rtol": 1e-3}
"""Steps that do not resolve the contacts."""


def test_a_run_ends_at_its_number_of_steps() -> None:
    options: dict[str, Any] = {"duration": 2e-3, "settle": 0.0}
    whole = br.simulate(SCENE, **options)
    steps = whole.stats.accepted + whole.stats.rejected
    again = br.simulate(SCENE, **options, max_steps=steps)
    assert (again["outer.ay"] == whole["outer.ay"]).all(), "a budget that suffices changes nothing"
    times = []
    for _ in range(2):
        with pytest.raises(br.BudgetError, match=r"max_steps = 50 is spent") as caught:
            br.simulate(SCENE, **options, max_steps=50)
        times.append(caught.value.time)
    assert isinstance(caught.value, br.IntegrationError)
    assert times[0] == times[1]
    assert 0.0 < times[0] < 2e-3
    assert (caught.value.budget, caught.value.limit) == ("max_steps", 50.0)
    with pytest.raises(br.BudgetError, match="max_steps"):
        br.simulate(SCENE, **options, max_steps=steps - 1)


@pytest.mark.parametrize("accuracy", [None, 1e-2])
def test_a_run_ends_at_its_time(accuracy: float | None) -> None:
    with pytest.raises(br.BudgetError, match=r"time_limit = 0\.05 is spent") as caught:
        br.simulate(SCENE, duration=1e3, fs=10.0, time_limit=0.05, accuracy=accuracy)
    assert caught.value.budget == "time_limit"
    assert math.isnan(caught.value.step)


@pytest.mark.parametrize("limits", [
    {"time_limit": 0.0}, {"time_limit": -1.0}, {"time_limit": math.nan}, {"max_steps": 0}, {"max_steps": 1.5},
])  # fmt: skip
def test_bad_limits(limits: dict[str, Any], tmp_path: Path) -> None:
    (name,) = limits
    with pytest.raises(br.SceneError, match=name):
        br.simulate(SCENE, duration=1e-3, **limits)
    with pytest.raises(br.SceneError, match=name):
        run(table(2), tmp_path / "runs", **limits)
    assert not (tmp_path / "runs").exists()


def test_a_case_beyond_its_budget_is_a_row_and_runs_with_a_larger_one(tmp_path: Path) -> None:
    cases = [{"duration": 1e-3}, {"duration": 4e-3}, {"duration": 3e-3, "max_steps": 5}]
    whole = run(cases[:2], tmp_path / "whole")
    steps = (whole.manifest["accepted"] + whole.manifest["rejected"]).to_list()
    limit = (steps[0] + steps[1]) // 2
    done = run(cases, tmp_path / "runs", max_steps=limit)
    assert done.manifest["status"].to_list() == ["ok", "failed", "failed"]
    assert done.failed["error"].to_list() == ["BudgetError", "BudgetError"]
    assert f"max_steps = {limit} is spent" in done.failed["message"][0]
    assert "max_steps = 5 is spent" in done.failed["message"][1], "a column replaces the argument"

    def finished(**options: Any) -> int:
        seen: list[Progress] = []
        run(cases, tmp_path / "runs", progress=seen.append, **options)
        return seen[-1].done if seen else 0

    assert finished(max_steps=limit) == 0
    assert finished(max_steps=limit - 1) == 0
    assert finished(max_steps=limit, time_limit=1e-3) == 0, (
        "another budget than the one that was spent"
    )
    assert finished(max_steps=10 * steps[1]) == 1
    done = br.Campaign.open(tmp_path / "runs")
    assert done.manifest["status"].to_list() == ["ok", "ok", "failed"]
    assert done.manifest["case_id"][:2].equals(whole.manifest["case_id"])
    assert done.manifest["outer.ay.rms"][:2].equals(whole.manifest["outer.ay.rms"])
    assert finished() == 0, "the case has its limit in the table"


def test_a_case_beyond_its_time_is_a_row(tmp_path: Path) -> None:
    cases = [{"duration": 1e3, "fs": 1.0}, {"duration": 1e-4}]
    done = run(cases, tmp_path, time_limit=0.3, skip=0.0, bandwidth=None)
    assert done.manifest["error"].to_list() == ["BudgetError", None]
    assert "time_limit = 0.3 is spent" in done.failed["message"][0]


def test_budgets_on_the_command_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scene = tmp_path / "scene.toml"
    scene.write_text(SCENE.to_toml())
    out = tmp_path / "out.parquet"
    assert main(["run", str(scene), "-o", str(out), "--max-steps", "20"]) == 1
    assert "max_steps = 20 is spent" in capsys.readouterr().err
    assert (
        main(
            [
                "run",
                str(scene),
                "-o",
                str(out),
                "--time-limit",
                "0.02",
                "--duration",
                "1e3",
                "--fs",
                "9",
            ]
        )
        == 1
    )
    assert "time_limit = 0.02 is spent" in capsys.readouterr().err
    assert not out.exists()
    sweep = tmp_path / "sweep.toml"
    sweep.write_text('scene = "scene.toml"\nduration = 1e-3\nmax_steps = 20\n[grid]\nlabel = [1]\n')
    runs = str(tmp_path / "runs")
    assert main(["campaign", str(sweep), "-o", runs]) == 0
    assert "1 × BudgetError" in capsys.readouterr().out
    assert main(["campaign", str(sweep), "-o", runs, "--max-steps", "100000"]) == 0
    assert "1 cases: 1 ok" in capsys.readouterr().out


def test_warnings_are_in_the_table(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A row that came to its end, but is not to be trusted, says so and why; so do progress and status."""
    cases = [{"contact.damping": 5.0}, {"contact.damping": 0.0}]
    done = run(cases, tmp_path, scene=WARNED["scene"], rtol=1e-3, start="rolling", progress=True)
    with pytest.warns(br.AccuracyWarning) as caught:
        alone = br.simulate(WARNED["scene"], duration=2e-3, rtol=1e-3, start="rolling")
    row = done.manifest.row(0, named=True)
    assert row["status"] == "ok"
    assert row["warnings"] == "; ".join(alone.warnings) == "; ".join(str(w.message) for w in caught)
    assert "accelerations are uncertain by" in row["warnings"]
    assert row["acceleration_residual"] == alone.stats.acceleration_residual
    assert row["truncated_contacts"] == alone.stats.truncated_contacts
    assert row["simd"] == alone.provenance.simd
    assert done.manifest["warnings"][1] is None
    assert done.warned["case_id"].to_list() == [row["case_id"]]
    assert "2 ok (1 with warnings)" in done.status()
    assert "campaign: 2 of 2 cases, 1 with warnings, " in capsys.readouterr().err
    assert main(["campaign", "--status", str(tmp_path)]) == 0
    assert "1 with warnings, the first: accelerations are uncertain" in capsys.readouterr().out


def test_warnings_of_workers_are_counted(tmp_path: Path) -> None:
    seen: list[Progress] = []
    with ThreadPoolExecutor(1) as pool:
        run(
            [{}, {"duration": 1e-3}],
            tmp_path,
            **WARNED,
            start="rolling",
            executor=pool,
            progress=seen.append,
        )
    assert seen[-1].warned == br.Campaign.open(tmp_path).warned.height > 0


def test_shoulders_are_counted(tmp_path: Path) -> None:
    changes = {"rows[0].outer_shoulders": (0.5, 0.5), "rows[0].inner_shoulders": (0.5, 0.5)}
    scene = br.presets.deep_groove_6205(2000.0, 500.0).replace(changes)
    done = run([{}], tmp_path, scene=scene, duration=1e-3, start="rolling")
    row = done.manifest.row(0, named=True)
    assert row["truncated_contacts"] > 0
    assert "rode over a shoulder" in row["warnings"]


def test_the_contacts_of_a_failure_survive(tmp_path: Path, wheel: br.Scene) -> None:
    """An IntegrationError raised by a campaign, here or by a worker, is the one of the run alone."""
    scene = wheel.replace({"cage.damping": 1e9})
    options: dict[str, Any] = {"duration": 1e-3, "start": "rolling"}
    with pytest.raises(br.IntegrationError) as alone:
        br.simulate(scene, **options)
    assert alone.value.contacts
    with pytest.raises(br.IntegrationError) as here:
        run([{}], tmp_path / "here", scene=scene, **options, on_error="raise")
    with ThreadPoolExecutor(1) as pool, pytest.raises(br.IntegrationError) as there:
        run([{}], tmp_path / "there", scene=scene, **options, on_error="raise", executor=pool)
    for raised in (here.value, there.value):
        assert raised.contacts == alone.value.contacts
        assert (str(raised), raised.body) == (str(alone.value), alone.value.body)


def test_ctrl_c_while_results_are_written_loses_none(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Polars has a handler of its own: the write that follows a Ctrl-C may be stopped by it, too."""
    write = Store.write
    interrupted: list[str] = []

    def raise_twice(self: Store, folder: str, frame: pl.DataFrame) -> str:
        if len(interrupted) < 2:
            interrupted.append(folder)
            raise KeyboardInterrupt
        return write(self, folder, frame)

    def due(self: Writer) -> None:
        if self._rows:
            self.flush()

    monkeypatch.setattr(Store, "write", raise_twice)
    monkeypatch.setattr(Writer, "flush_when_due", due)
    with pytest.raises(KeyboardInterrupt, match="interrupted; 1 of 2 cases are safe"):
        run(
            [{"duration": 1e-4}, {"duration": 1e2, "fs": 1.0}],
            tmp_path,
            threads=1,
            bandwidth=None,
        )


PROGRAM = """
import sys
sys.path.insert(0, {here!r})
import sweeps

def on_progress(progress):
    print(progress.done, flush=True)

cases = [{{"duration": 1e-4}}] + [{{"duration": 1e3, "fs": 1.0 + i}} for i in range(2)]
sweeps.run(cases, {out!r}, progress=on_progress, start="rolling", bandwidth=None)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="Ctrl-C is sent in another way there")
def test_ctrl_c_keeps_what_has_finished(tmp_path: Path) -> None:
    """Sent as the first shard is due, a second after the first case."""
    program = PROGRAM.format(here=str(Path(__file__).parent), out=str(tmp_path / "runs"))
    with subprocess.Popen(
        [sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as child:
        assert child.stdout is not None
        assert child.stderr is not None
        while child.stdout.readline() != "1\n":
            pass
        time.sleep(1.0)
        child.send_signal(signal.SIGINT)
        printed = child.stderr.read()
    assert "KeyboardInterrupt: interrupted; 1 of 3 cases are safe" in printed
    assert br.Campaign.open(tmp_path / "runs").manifest["status"].to_list() == [
        "ok",
        "missing",
        "missing",
    ]
