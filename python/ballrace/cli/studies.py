"""``ballrace demo`` and ``ballrace paper``."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import TYPE_CHECKING

from .. import demo, paper
from .._base.libraries import needed
from .._base.progress import Bar
from .._io.files import check_writable
from .arguments import Commands, added
from .text import print_table

if TYPE_CHECKING:
    import argparse


def add_commands(commands: Commands[argparse.ArgumentParser]) -> None:
    """Add both subcommands."""
    shown = added(
        commands, "demo", "run the wheel bearing under three loads; table, Parquet files and a report",
        "ballrace demo -o demo --duration 0.2", _demo,
    )  # fmt: skip
    _add_folder(shown, "ballrace-demo", 0.1)
    published = added(
        commands, "paper", "run the published cases: figures 5 to 11 and a table, published against ours",
        "ballrace paper -o paper", _paper,
    )  # fmt: skip
    _add_folder(published, "ballrace-paper", paper.DURATION)
    alone = published.add_mutually_exclusive_group()
    alone.add_argument(
        "--json", action="store_true", help="the numbers alone: print and write paper.json"
    )
    alone.add_argument(
        "--page", action="store_true",
        help="the page alone: figures 5 to 11, what the paper says of each beside ours, in paper.html",
    )  # fmt: skip


def _add_folder(parser: argparse.ArgumentParser, folder: str, duration: float) -> None:
    parser.add_argument(
        "-o", "--output", type=Path, default=Path(folder), metavar="FOLDER",
        help="folder for the results (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--duration", type=float, default=duration, metavar="SECONDS",
        help="simulated time of each case (default: %(default)s)",
    )  # fmt: skip


def _demo(options: argparse.Namespace) -> None:
    folder: Path = options.output
    check_writable(folder / "demo.html" if folder.exists() else folder)
    cases = {}
    for label, axial_load in demo.AXIAL_LOADS.items():
        with Bar(f"{label:<11}") as bar:
            cases[label] = demo.run_case(axial_load, options.duration, bar.show)
    print(demo.TITLE)
    print_table(demo.HEADER, demo.rows(cases))
    written = demo.write(cases, folder)
    _say(written, "page")


def _paper(options: argparse.Namespace) -> None:
    folder: Path = options.output
    first = "paper.html" if options.page else "paper.json"
    check_writable(folder / first if folder.exists() else folder)
    if options.page:
        needed("plotly", "the page", extra="plot")
    with Bar("paper") as bar:
        found = paper.run(duration=options.duration, progress=bar.show)
    if options.page:
        print(f"Written: {paper.write_page(found, folder)}")
        return
    written = paper.write(found, folder, numbers_only=options.json)
    if options.json:
        print(paper.dumps(found), end="")
        return
    print_table(paper.HEADER, paper.rows(found))
    print(f"\nSignals: {paper.SIGNALS}.")
    _say(written, "figures")


def _say(written: list[Path], missing: str) -> None:
    print("\nWritten:", *written, sep="\n  ")
    if importlib.util.find_spec("plotly") is None:
        print(f'\nFor the {missing}: pip install "ballrace[plot]"')
