"""Arguments that several subcommands share, and their readers."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ..errors import SceneError
from ..recordings.reading import key_of
from ..scene import Scene

Commands = argparse._SubParsersAction


def added(
    commands: Commands[argparse.ArgumentParser],
    name: str,
    does: str,
    example: str,
    command: Callable[[argparse.Namespace], None],
) -> argparse.ArgumentParser:
    """Add a subcommand that says what it does with one example."""
    parser = commands.add_parser(
        name,
        help=does,
        description=f"{does[0].upper()}{does[1:]}.",
        epilog=f"example: {example}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.set_defaults(command=command)
    return parser


def add_scene(parser: argparse.ArgumentParser) -> None:
    """Add the argument of a scene."""
    parser.add_argument(
        "scene",
        type=Path,
        metavar="SCENE",
        help="scene, a .toml or .json file; - reads standard input",
    )


def add_signals(parser: argparse.ArgumentParser) -> None:
    """Add the argument of a file of signals, and what may have to be said about it."""
    parser.add_argument(
        "file", type=Path, metavar="FILE",
        help="signals: a text table, MATLAB, WAV, Parquet or any other format that ballrace.read reads; - reads "
        "Parquet from standard input",
    )  # fmt: skip
    parser.add_argument(
        "--fs", type=float, metavar="HZ", help="sampling rate, where the file does not have it"
    )
    file = parser.add_argument_group("of a file that does not say it itself")
    file.add_argument(
        "--skip", type=int, metavar="N", help="lines of a text before the names or the first row"
    )
    file.add_argument(
        "--columns", nargs="+", metavar="COLUMN",
        help="columns that are signals, by their names or places from 0 (default: all but times and counters)",
    )  # fmt: skip
    file.add_argument("--decimal", choices=(".", ","), help="decimal mark of a text")
    file.add_argument(
        "--time", nargs="+", metavar="COLUMN",
        help="column of the times, or columns of a clock, by names or places; none: no column is one",
    )  # fmt: skip
    file.add_argument(
        "--time-unit", metavar="UNIT", help="unit of the times: s, ms, us, ns, min, h, d or samples"
    )
    file.add_argument(
        "--start", type=float, metavar="SECONDS", help="read from here on (default: 0)"
    )
    file.add_argument(
        "--stop", type=float, metavar="SECONDS", help="read until here (default: all)"
    )


def said_of(options: argparse.Namespace) -> dict[str, Any]:
    """Return what :func:`add_signals` has taken as arguments of :func:`ballrace.read`, without the file."""
    said = {
        name: getattr(options, name)
        for name in ("fs", "skip", "decimal", "time_unit", "start", "stop")
    }
    for name in ("columns", "time"):
        keys = getattr(options, name)
        said[name] = None if keys is None else [key_of(key) for key in keys]
    if said["time"] == ["none"]:
        said["time"] = False
    return said


def add_speeds(parser: argparse.ArgumentParser, default: str, of: str = "") -> None:
    """Add the speeds of both rings, with what is taken without the inner one's, and what they are of."""
    what = f"; of {of}" if of else ""
    parser.add_argument(
        "--rpm", type=float, metavar="REV/MIN",
        help=f"speed of the inner ring (default: {default}, or 0 with --outer-rpm){what}",
    )  # fmt: skip
    parser.add_argument(
        "--outer-rpm", type=float, metavar="REV/MIN",
        help=f"speed of the outer ring, of hubs, idlers and planets (default: it stands){what}",
    )  # fmt: skip


def add_budget(parser: argparse.ArgumentParser, what: str) -> None:
    """Add the options that limit what a run may cost."""
    parser.add_argument(
        "--time-limit", type=float, metavar="SECONDS",
        help=f"wall time that {what} may take (default: any)",
    )  # fmt: skip
    parser.add_argument(
        "--max-steps", type=int, metavar="N",
        help=f"steps that {what} may take, rejected ones included (default: any)",
    )  # fmt: skip


def read_scene(path: Path) -> Scene:
    """Read a scene from a file, or from standard input where the name is ``-``: TOML, or JSON if it begins so.

    Raises
    ------
    SceneError
        It is no usable scene.
    OSError
        The file cannot be read.
    """
    if str(path) != "-":
        return Scene.load(path)
    try:
        text = sys.stdin.buffer.read().decode("utf-8")
    except UnicodeDecodeError as error:
        raise SceneError("scene", "standard input", f"text in UTF-8 ({error})") from error
    return Scene.from_json(text) if text.lstrip().startswith("{") else Scene.from_toml(text)
