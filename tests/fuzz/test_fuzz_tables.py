"""Any table of cases, any sweep file and any folder end in rows that say what became of them, or one error."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import hypothesis.strategies as st
import numpy as np
import polars as pl
import pytest
from hypothesis.strategies import DrawFn

import ballrace as br
from ballrace.cli import campaigns as cli
from budget import decided, fuzzed
from strategies import EDGES, damaged

CORPUS = Path(__file__).parent / "corpus" / "sweeps"
SCENE = br.bearing(
    "6205",
    radial_load=500.0,
    defects={"spall": br.defects.spall(on="outer_race", width_mm=1.0)},
    speed_rpm=1800.0,
)
SHORT: dict[str, Any] = {
    "duration": 2e-4, "fs": 5e4, "start": "rolling", "settle": 0.0, "max_steps": 500, "time_limit": 5.0,
    "threads": 1, "progress": False,
}  # fmt: skip

NAMES = st.sampled_from(
    ("loads.radial.force", "loads.axial.force", "defects.spall.width", "defects.new", "rows[0].ball_count",
     "rows[0].clearance", "rows[1].clearance", "rows", "drive", "drive.speed", "name", "friction", "solver.rtol",
     "duration", "fs", "start", "rtol", "method", "bandwidth", "settle", "time_limit", "max_steps", "accuracy",
     "scene", "case_id", "status", "changes", "label", "radial_load", "", ".", "a.b", "[", "\0", "é", "threads")
)  # fmt: skip
NEAR = {
    "duration": 2e-4,
    "fs": 5e4,
    "settle": 0.0,
    "rtol": 1e-5,
    "max_steps": 300,
    "defects.spall.width": 1e-3,
}
CELLS = st.one_of(
    st.sampled_from((100.0, 500.0, 1e-3, 0.0, -1.0, 9, None, "", "rolling", "adams", "none", "x", True)),
    st.sampled_from((float("nan"), float("inf"), *EDGES)),
    st.sampled_from(([1.0], [], {"a": 1}, 10**30, -3, np.float32(1.0), np.int8(3), b"x", object(), {"ramp": 1})),
)  # fmt: skip
"""Cells of every kind."""


@st.composite
def tables(draw: DrawFn) -> Any:
    """Draw tables of every kind, most of their cells of some use."""
    names = draw(st.lists(NAMES, min_size=0, max_size=3, unique=True))
    height = draw(st.integers(0, 3))
    columns = {
        name: [NEAR[name] if name in NEAR and draw(st.booleans()) else draw(CELLS) for _ in range(height)]
        for name in names
    }  # fmt: skip
    match draw(st.integers(0, 6)):
        case 0:
            return columns
        case 1:
            return [{name: cells[i] for name, cells in columns.items()} for i in range(height)]
        case 2:
            return [
                {name: cells[i] for name, cells in columns.items() if i % 2} for i in range(height)
            ]
        case 3:
            return pl.DataFrame(
                {name: [_number(cell) for cell in cells] for name, cells in columns.items()}
            )
        case 4:
            pandas = pytest.importorskip("pandas")
            return pandas.DataFrame(columns)
        case 5:
            return pl.DataFrame(
                {name: [str(cell) for cell in cells] for name, cells in columns.items()}
            ).lazy()
    return draw(
        st.sampled_from(
            (None, 1, "x", [], {}, [1], [[1]], {"a": 1}, np.zeros(3), np.zeros((2, 2)), object())
        )
    )


def _number(cell: Any) -> float | None:
    return float(cell) if isinstance(cell, int | float) else None


@fuzzed(table=tables(), keep=st.sampled_from(("features", "signals")))
def test_any_table_runs_or_is_refused(table: Any, keep: Any) -> str:
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "out"
        found = decided(lambda: br.campaign(table, out, scene=SCENE, keep=keep, **SHORT))
        if isinstance(found, br.BallraceError):
            assert not out.exists(), "something was written"
            return type(found).__name__
        manifest = found.manifest
        assert set(manifest["status"]) <= {"ok", "failed"}
        assert manifest.filter(status="failed")["error"].null_count() == 0
        if "outer.ay.rms" in manifest.columns:
            assert manifest.filter(status="ok")["outer.ay.rms"].is_finite().all()
        again = decided(lambda: br.campaign(table, out, scene=SCENE, keep=keep, **SHORT))
        assert isinstance(again, br.Campaign)
        assert again.manifest.drop("wall_time").equals(manifest.drop("wall_time"))
        return " and ".join(sorted(set(manifest["status"])))


SWEEPS = tuple(path.read_text(encoding="utf-8") for path in sorted(CORPUS.glob("*.toml")))
CSV = "loads.radial.force,scene\n100.0,b\n200.0,b\n"


def sweep_is_decided(sweep: str, table: str) -> str:
    """Read a sweep, and run what it asks for if that is not much."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "sweep.toml"
        path.write_text(sweep, encoding="utf-8", errors="replace", newline="")
        (path.parent / "cases.csv").write_text(
            table, encoding="utf-8", errors="replace", newline=""
        )
        try:
            read = decided(lambda: cli.read(path))
        except OSError:
            return "no such file"
        if isinstance(read, br.BallraceError):
            assert isinstance(read, br.SceneError)
            return "refused"
        cases = read.pop("cases")
        if cases.height > 9:
            return "many"
        options = {**SHORT, **read}
        if isinstance(options["duration"], int | float):
            options["duration"] = min(options["duration"], 1e-3)
        found = decided(lambda: br.campaign(cases, path.parent / "out", **options))
        return type(found).__name__


@fuzzed(sweep=damaged(SWEEPS), table=st.just(CSV) | damaged((CSV,)))
def test_any_sweep_is_read_or_refused(sweep: str, table: str) -> str:
    return sweep_is_decided(sweep, table)


@fuzzed(
    kind=st.sampled_from(("grid", "latin_hypercube", "sobol", "scatter")),
    columns=st.one_of(
        st.dictionaries(NAMES, st.one_of(st.lists(CELLS, max_size=3), st.tuples(CELLS, CELLS), CELLS), max_size=3),
        CELLS,
    ),
    n=st.sampled_from((1, 2, 5, 0, -1, 2.5, None, "x", True)),
    seed=st.sampled_from((0, 1, -1, 2.5, None, "x", 10**30)),
)  # fmt: skip
def test_any_builder_builds_or_refuses(kind: str, columns: Any, n: Any, seed: Any) -> str:
    def build() -> pl.DataFrame:
        if kind == "grid":
            return br.grid(columns)
        if kind == "scatter":
            drawn = columns.values() if isinstance(columns, dict) else (columns,)
            names = ("clearance", "ball_diameter", "groove_radius")
            return br.scatter(SCENE, n, seed=seed, **dict(zip(names, drawn, strict=False)))
        return {"sobol": br.sobol, "latin_hypercube": br.latin_hypercube}[kind](
            columns, n, seed=seed
        )

    found = decided(build)
    return f"{kind}: {type(found).__name__}"


@pytest.mark.parametrize("path", sorted(CORPUS.glob("*.toml")), ids=lambda path: path.name)
def test_the_corpus(path: Path) -> None:
    sweep_is_decided(path.read_text(encoding="utf-8"), CSV)


@fuzzed(
    damage=st.lists(
        st.tuples(st.integers(0, 30), st.floats(0.0, 1.0), st.binary(max_size=8)), min_size=1, max_size=2
    ),
    cut=st.booleans(),
)  # fmt: skip
def test_any_damaged_folder_is_mended_or_reported(
    damage: list[tuple[int, float, bytes]], cut: bool
) -> str:
    """Files of a finished campaign with bytes overwritten or cut: it is never read as something else."""
    table = {"loads.radial.force": [100.0, 500.0]}
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "out"
        whole = br.campaign(table, out, scene=SCENE, keep="signals", **SHORT).manifest
        files = sorted(path for path in out.rglob("*") if path.is_file() and path.stat().st_size)
        for which, place, written in damage:
            path = files[which % len(files)]
            data = path.read_bytes()
            at = int(place * len(data))
            path.write_bytes(data[:at] if cut else data[:at] + written + data[at + len(written) :])
        opened = decided(lambda: br.Campaign.open(out).manifest)
        again = decided(lambda: br.campaign(table, out, scene=SCENE, keep="signals", **SHORT))
        assert isinstance(again, br.Campaign), again
        kept = ("wall_time", "signals")
        assert again.manifest.drop(kept).equals(whole.drop(kept))
        for case_id in again.manifest["case_id"]:
            assert np.isfinite(again.signals(case_id)["outer.ay"].to_numpy()).all()
        return f"{type(opened).__name__}, then whole"
