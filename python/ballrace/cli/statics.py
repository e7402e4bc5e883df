"""``ballrace equilibrium`` and ``ballrace explain``."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .._base.text import printable
from ..explanation import explain
from ..ratings.life import RatingLife, rating_life
from ..report.writing import check_page
from ..statics import Equilibrium, equilibrium, stiffness
from .arguments import Commands, add_scene, added, read_scene
from .text import numbers, print_table

if TYPE_CHECKING:
    import argparse

    from ..scene import Scene


def add_commands(commands: Commands[argparse.ArgumentParser]) -> None:
    """Add both subcommands."""
    static = added(
        commands, "equilibrium", "solve a scene at rest and print the balls' loads",
        "ballrace equilibrium scene.toml --stiffness --life", _equilibrium,
    )  # fmt: skip
    add_scene(static)
    static.add_argument(
        "--stiffness", action="store_true", help="print the tangent stiffness of the bearing, too"
    )
    static.add_argument(
        "--life", action="store_true",
        help="print the races' equivalent loads over a turn of the cage and the rating life, too",
    )  # fmt: skip
    static.add_argument(
        "--json", action="store_true", help="print the solution as JSON, in SI units"
    )
    parser = added(
        commands, "explain", "show what a scene is compiled to, what it costs and what would be cheaper",
        "ballrace explain scene.toml", _explain,
    )  # fmt: skip
    add_scene(parser)
    parser.add_argument("--json", action="store_true", help="print it as JSON")
    parser.add_argument(
        "--drawing", type=Path, metavar="FILE",
        help="write the bearing cut through its axis, too, with parts, angle, loads and defects named: .html",
    )  # fmt: skip


def _equilibrium(options: argparse.Namespace) -> None:
    scene = read_scene(options.scene)
    eq = equilibrium(scene)
    if options.json:
        _equilibrium_json(options, scene, eq)
        return
    _print_balls(eq)
    if options.stiffness:
        print()
        rows = zip("xyz", 1e-6 * stiffness(scene).inner, strict=True)
        lines = [[axis, *numbers(row, 3)] for axis, row in rows]
        print_table(["stiffness N/µm", "x", "y", "z"], lines)
    if options.life:
        print()
        life = rating_life(scene)
        races = zip(life.outer_equivalent, life.inner_equivalent, strict=True)
        lines = [
            [f"row{i}", f"{outer:.1f}", f"{inner:.1f}"] for i, (outer, inner) in enumerate(races)
        ]
        print_table(["equivalent load", "outer N", "inner N"], lines)
        print()
        lives = {
            "ISO 281, L10": life.basic,
            "ISO/TS 16281, L10r": life.reference,
            "the same, one cage position": life.one_position,
        }
        if life.modified is not None:
            lives["with its oil, L10mr"] = life.modified
        lines = [[name, *_lasts(life, turns)] for name, turns in lives.items()]
        print_table(["rating life", "million turns", "hours"], lines)


def _lasts(life: RatingLife, turns: float | None) -> list[str]:
    """Return a life in millions of turns and in hours, as far as it is known."""
    if turns is None:
        return ["-", "-"]
    hours = life.hours(turns)
    return [f"{turns / 1e6:.4g}", "-" if hours is None else f"{hours:.4g}"]


def _print_balls(eq: Equilibrium) -> None:
    for ring in ("outer", "inner"):
        x, y, z = 1e6 * getattr(eq, ring)
        print(f"{ring} ring: x {x:.3f} µm, y {y:.3f} µm, z {z:.3f} µm")
    print(f"balanced to {eq.residual:.1e} N, {eq.residual_share:.1e} of the largest load")
    print()
    columns = [
        [f"row{row}.ball{ball}" for row, ball in zip(eq.row, eq.ball, strict=True)],
        numbers(np.degrees(eq.angle), 1),
        numbers(eq.outer_load, 1),
        numbers(np.degrees(eq.outer_angle), 2),
        numbers(1e6 * eq.outer_deflection, 3),
        numbers(1e-6 * eq.outer_pressure, 0),
        numbers(eq.inner_load, 1),
        numbers(np.degrees(eq.inner_angle), 2),
        numbers(1e6 * eq.inner_deflection, 3),
        numbers(1e-6 * eq.inner_pressure, 0),
    ]
    contact = ["load N", "angle °", "defl. µm", "p MPa"]
    header = ["ball", "at °", *(f"{race} {q}" for race in ("outer", "inner") for q in contact)]
    print_table(header, [list(line) for line in zip(*columns, strict=True)])


def _equilibrium_json(options: argparse.Namespace, scene: Scene, eq: Equilibrium) -> None:
    document: dict[str, object] = {
        "outer": eq.outer.tolist(),
        "inner": eq.inner.tolist(),
        "balls": eq.to_polars().fill_nan(None).to_dicts(),
        "warnings": eq.warnings,
    }
    if options.stiffness:
        document["stiffness"] = stiffness(scene).inner.tolist()
    if options.life:
        life = rating_life(scene)
        document["outer_equivalent"] = list(life.outer_equivalent)
        document["inner_equivalent"] = list(life.inner_equivalent)
        document["rating_life"] = {
            "basic": life.basic,
            "reference": life.reference,
            "one_position": life.one_position,
            "modified": life.modified,
        }
    print(json.dumps(document, indent=2))


def _explain(options: argparse.Namespace) -> None:
    if options.drawing is not None:
        check_page(options.drawing, "drawing")
    scene = read_scene(options.scene)
    found = explain(scene)
    if options.drawing is not None:
        from .. import plot

        plot.write(plot.section(scene), options.drawing)
    print(json.dumps(found.to_dict(), indent=2) if options.json else printable(str(found)).rstrip())
