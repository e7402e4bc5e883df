"""The command ``ballrace``."""

from __future__ import annotations

import argparse
import contextlib
import importlib.util
import json
import os
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, get_args

import numpy as np

from . import paper, presets
from ._features import features
from ._files import check_output, check_writable, whole
from ._progress import Bar
from ._text import printable
from .campaigns.cli import add_budget
from .campaigns.cli import add_command as add_campaign
from .errors import BallraceError, SceneError
from .explanation import explain
from .frequencies import of_row
from .options import ARGUMENTS, Run
from .run import simulate
from .scene import Method, Scene, SpeedDrive
from .statics import Equilibrium, equilibrium, load_distribution, stiffness

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from .signals import Signals

__all__ = ["main"]

_AXIAL_LOADS = {"axial 0": 0.0, "axial +3 kN": 3000.0, "axial -3 kN": -3000.0}
_COLUMN = "outer.ay"
_FS = 50_000.0
_DEFAULTS = Run()
_RUN_OPTIONS: dict[str, dict[str, Any]] = {
    "duration": {
        "type": float, "metavar": "SECONDS", "help": "simulated time (default: %(default)s)",
    },
    "fs": {"type": float, "metavar": "HZ", "help": "sampling rate (default: %(default)g)"},
    "start": {
        "choices": ("equilibrium", "rolling"), "help": "where the run starts (default: %(default)s)",
    },
    "rtol": {"type": float, "help": "relative tolerance (default: the scene's)"},
    "accuracy": {
        "type": float, "help": "error of accelerations to stay below, in place of --rtol",
    },
    "method": {"choices": get_args(Method), "help": "method of integration (default: the scene's)"},
    "settle": {
        "type": float, "metavar": "SECONDS",
        "help": "time before t = 0 in which the start dies down (default: as long as the scene needs; 0: none)",
    },
    "threads": {"type": int, "help": "threads (default: chosen; no influence on the result)"},
    "bandwidth": {
        "choices": ("auto", "none"),
        "help": "auto: signals through a low-pass of 0.4 fs; none: point samples (default: %(default)s)",
    },
}  # fmt: skip
"""Options of a run beside its budget, by the names of its arguments."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command and return its exit status.

    0 is success, 1 a run that failed, 2 bad input (nothing was written), 130 Ctrl-C.
    """
    options = _parser().parse_args(arguments)
    try:
        options.command(options)
        sys.stdout.flush()
    except KeyboardInterrupt as error:
        return _fail(str(error) or "interrupted", 130)
    except BrokenPipeError:
        # The reader of our output has gone: nothing more to say, also not while Python shuts down.
        with contextlib.suppress(OSError, ValueError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except SceneError as error:
        return _fail(str(error), 2)
    except BallraceError as error:
        return _fail(str(error), 1)
    except OSError as error:
        place = f"{error.filename}: " if error.filename else ""
        return _fail(f"{place}{error.strerror or error}", 2)
    return 0


def _fail(message: str, status: int) -> int:
    print(f"ballrace: {' '.join(printable(message).split())}", file=sys.stderr)
    return status


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="ballrace", description="Ball bearings simulated in three dimensions."
    )
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    demo = commands.add_parser(
        "demo", help="run the wheel bearing under three loads; table, Parquet files and a picture"
    )
    demo.add_argument(
        "-o", "--output", type=Path, default=Path("ballrace-demo"), metavar="FOLDER",
        help="folder for the results (default: %(default)s)",
    )  # fmt: skip
    demo.add_argument(
        "--duration", type=float, default=0.1, metavar="SECONDS",
        help="simulated time of each case (default: %(default)s)",
    )  # fmt: skip
    demo.set_defaults(command=_demo)

    published = commands.add_parser(
        "paper", help="run the published cases: figures 6 to 11 and a table, published against ours"
    )
    published.add_argument(
        "-o", "--output", type=Path, default=Path("ballrace-paper"), metavar="FOLDER",
        help="folder for the results (default: %(default)s)",
    )  # fmt: skip
    published.add_argument(
        "--json", action="store_true", help="the numbers alone: print and write paper.json"
    )
    published.add_argument(
        "--duration", type=float, default=paper.DURATION, metavar="SECONDS",
        help="simulated time of each case (default: %(default)s)",
    )  # fmt: skip
    published.set_defaults(command=_paper)

    run = commands.add_parser("run", help="run a scene and write its signals to a Parquet file")
    run.add_argument("scene", type=Path, metavar="SCENE", help="scene, a .toml or .json file")
    run.add_argument(
        "-o", "--output", type=Path, required=True, metavar="FILE", help="Parquet file to write"
    )
    for name, option in _RUN_OPTIONS.items():
        run.add_argument(f"--{name}", default=getattr(_DEFAULTS, name), **option)
    add_budget(run, "the run")
    run.set_defaults(command=_run)

    scene = commands.add_parser("scene", help="print a ready-made scene as TOML, to start from")
    scene.add_argument(
        "name", metavar="NAME", type=lambda name: name.replace("-", "_"), choices=presets.names(),
        help=" or ".join(name.replace("_", "-") for name in presets.names()),
    )  # fmt: skip
    scene.set_defaults(command=_scene)

    static = commands.add_parser(
        "equilibrium", help="solve a scene at rest and print the balls' loads"
    )
    static.add_argument("scene", type=Path, metavar="SCENE", help="scene, a .toml or .json file")
    static.add_argument(
        "--stiffness", action="store_true", help="print the tangent stiffness of the bearing, too"
    )
    static.add_argument(
        "--life", action="store_true",
        help="print the races' equivalent loads over a turn of the cage, too",
    )  # fmt: skip
    static.add_argument(
        "--json", action="store_true", help="print the solution as JSON, in SI units"
    )
    static.set_defaults(command=_equilibrium)

    told = commands.add_parser(
        "explain", help="tell what a scene is compiled to, what it costs and what would be cheaper"
    )
    told.add_argument("scene", type=Path, metavar="SCENE", help="scene, a .toml or .json file")
    told.add_argument("--json", action="store_true", help="print it as JSON")
    told.set_defaults(command=_explain)

    add_campaign(commands)
    return parser


def _demo(options: argparse.Namespace) -> None:
    folder: Path = options.output
    check_writable(folder / "demo.html" if folder.exists() else folder)
    outs: dict[str, Signals] = {}
    solved: dict[str, Equilibrium] = {}
    lines = []
    for label, axial_load in _AXIAL_LOADS.items():
        scene = presets.wheel_bearing(axial_load)
        began = time.perf_counter()
        with Bar(f"{label:<11}") as bar:
            out = simulate(scene, duration=options.duration, fs=_FS, progress=bar.show)
        seconds = time.perf_counter() - began
        outs[label], solved[label] = out, equilibrium(scene)
        lines.append(
            [label, *_features(out), f"{out.stats.accepted}", f"{out.stats.nfev}", f"{seconds:.1f}"]
        )
    print(
        f"Wheel bearing, 7 kN radial, defect on the outer ring: {_COLUMN} after the start has settled"
    )
    _print_table(
        [
            "case",
            "rms m/s²",
            "peak m/s²",
            "kurtosis",
            "impact m/s²",
            "steps",
            "evaluations",
            "wall s",
        ],
        lines,
    )
    folder.mkdir(exist_ok=True)
    written = []
    for label, out in outs.items():
        written.append(folder / f"axial_{_AXIAL_LOADS[label]:.0f}N.parquet")
        out.write_parquet(written[-1])
    if importlib.util.find_spec("plotly") is not None:
        written.append(folder / "demo.html")
        with whole(written[-1]) as temporary:
            temporary.write_text(_page(outs, solved), encoding="utf-8")
    print("\nWritten:", *written, sep="\n  ")
    if importlib.util.find_spec("plotly") is None:
        print('\nFor the picture: pip install "ballrace[plot]"')


def _features(out: Signals) -> list[str]:
    """Root mean square, peak, kurtosis and mean impact of the demo's column."""
    found = features(out[_COLUMN], out.fs)
    kurtosis = found["kurtosis"]
    shape = "nan" if kurtosis is None else f"{kurtosis:.1f}"
    impact = _mean_impact(out[_COLUMN], out.fs / _passing(out.scene))
    return [f"{found['rms']:.2f}", f"{found['peak']:.1f}", shape, f"{impact:.1f}"]


def _mean_impact(signal: NDArray[np.float64], passage: float) -> float:
    """Mean, over the passages of balls (in samples), of the largest magnitude in each."""
    parts = max(int(signal.size / passage), 1)
    edges = (np.arange(parts) * passage).astype(int)
    return float(np.mean(np.maximum.reduceat(np.abs(signal), edges)))


def _passing(scene: Scene) -> float:
    """Frequency of the balls of row 0 passing a place of the outer race [Hz]."""
    assert isinstance(scene.drive, SpeedDrive)
    assert isinstance(scene.drive.speed, float)
    return of_row(scene.rows[0]).at(scene.drive.speed / (2.0 * np.pi)).bpfo


def _page(outs: dict[str, Signals], solved: dict[str, Equilibrium]) -> str:
    from . import plot

    passing = _passing(next(iter(outs.values())).scene)
    accelerations = plot.load_cases(
        outs, _COLUMN, bpfo=passing,
        title=f"Vertical acceleration of the outer ring; grid lines one ball passage apart ({passing:.1f} Hz)",
    )  # fmt: skip
    loads = plot.load_distribution(
        solved, title="Load of each ball on the outer race at equilibrium", height=460
    )
    return "\n".join(
        [
            '<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>ballrace demo</title></head>',
            '<body style="font-family: sans-serif; max-width: 1200px; margin: 1rem auto">',
            "<h1>Wheel bearing with a defect on the outer ring</h1>",
            "<p>7 kN radial load, axial loads of 0, +3 and -3 kN, 30 turns a second.</p>",
            accelerations.to_html(full_html=False, include_plotlyjs=True),
            loads.to_html(full_html=False, include_plotlyjs=False),
            "</body></html>",
        ]
    )


def _paper(options: argparse.Namespace) -> None:
    folder: Path = options.output
    check_writable(folder / "paper.json" if folder.exists() else folder)
    with Bar("paper") as bar:
        found = paper.run(duration=options.duration, progress=bar.show)
    written = paper.write(found, folder, numbers_only=options.json)
    if options.json:
        print(paper.dumps(found), end="")
        return
    _print_table(paper.HEADER, paper.rows(found))
    print(f"\nSignals: {paper.SIGNALS}.")
    print("\nWritten:", *written, sep="\n  ")
    if importlib.util.find_spec("plotly") is None:
        print('\nFor the figures: pip install "ballrace[plot]"')


def _run(options: argparse.Namespace) -> None:
    check_output(options.output, read=options.scene)
    options.bandwidth = None if options.bandwidth == "none" else options.bandwidth
    out = simulate(
        Scene.load(options.scene),
        **{name: getattr(options, name) for name in ARGUMENTS},
        progress=True,
        out=options.output,
    )
    print(f"{printable(str(options.output))}: {len(out)} columns, {out.n_samples} samples")


def _scene(options: argparse.Namespace) -> None:
    print(
        f"# The preset {options.name} of ballrace; SI units. What each field means: help(ballrace.scene)."
    )
    print(f"# Run it: ballrace run {options.name}.toml -o {options.name}.parquet\n")
    print(getattr(presets, options.name)().to_toml(), end="")


def _equilibrium(options: argparse.Namespace) -> None:
    scene = Scene.load(options.scene)
    eq = equilibrium(scene)
    if options.json:
        _equilibrium_json(options, scene, eq)
        return
    for ring in ("outer", "inner"):
        x, y, z = 1e6 * getattr(eq, ring)
        print(f"{ring} ring: x {x:.3f} µm, y {y:.3f} µm, z {z:.3f} µm")
    print(f"balanced to {eq.residual:.1e} N, {eq.residual_share:.1e} of the largest load")
    print()
    columns = [
        [f"row{row}.ball{ball}" for row, ball in zip(eq.row, eq.ball, strict=True)],
        _numbers(np.degrees(eq.angle), 1),
        _numbers(eq.outer_load, 1),
        _numbers(np.degrees(eq.outer_angle), 2),
        _numbers(1e6 * eq.outer_deflection, 3),
        _numbers(1e-6 * eq.outer_pressure, 0),
        _numbers(eq.inner_load, 1),
        _numbers(np.degrees(eq.inner_angle), 2),
        _numbers(1e6 * eq.inner_deflection, 3),
        _numbers(1e-6 * eq.inner_pressure, 0),
    ]
    contact = ["load N", "angle °", "defl. µm", "p MPa"]
    header = ["ball", "at °", *(f"{race} {q}" for race in ("outer", "inner") for q in contact)]
    _print_table(header, [list(line) for line in zip(*columns, strict=True)])
    if options.stiffness:
        print()
        rows = zip("xyz", 1e-6 * stiffness(scene).inner, strict=True)
        lines = [[axis, *_numbers(row, 3)] for axis, row in rows]
        _print_table(["stiffness N/µm", "x", "y", "z"], lines)
    if options.life:
        print()
        loads = load_distribution(scene)
        races = zip(loads.outer_equivalent, loads.inner_equivalent, strict=True)
        lines = [
            [f"row{i}", f"{outer:.1f}", f"{inner:.1f}"] for i, (outer, inner) in enumerate(races)
        ]
        _print_table(["equivalent load", "outer N", "inner N"], lines)


def _equilibrium_json(options: argparse.Namespace, scene: Scene, eq: Equilibrium) -> None:
    told: dict[str, object] = {
        "outer": eq.outer.tolist(),
        "inner": eq.inner.tolist(),
        "balls": eq.to_polars().fill_nan(None).to_dicts(),
        "warnings": eq.warnings,
    }
    if options.stiffness:
        told["stiffness"] = stiffness(scene).inner.tolist()
    if options.life:
        loads = load_distribution(scene)
        told["outer_equivalent"] = loads.outer_equivalent.tolist()
        told["inner_equivalent"] = loads.inner_equivalent.tolist()
    print(json.dumps(told, indent=2))


def _explain(options: argparse.Namespace) -> None:
    told = explain(Scene.load(options.scene))
    print(json.dumps(told.to_dict(), indent=2) if options.json else printable(str(told)).rstrip())


def _numbers(values: NDArray[np.float64], digits: int) -> list[str]:
    return [f"{value:.{digits}f}" if np.isfinite(value) else "-" for value in values]


def _print_table(header: list[str], lines: list[list[str]]) -> None:
    widths = [max(len(line[i]) for line in [header, *lines]) for i in range(len(header))]
    for first, *rest in [header, *lines]:
        cells = (cell.rjust(width) for cell, width in zip(rest, widths[1:], strict=True))
        print("  ".join([first.ljust(widths[0]), *cells]))
