"""``ballrace diagnose``: a verdict from a file."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, get_args

from .._base.text import printable
from .._base.units import canonical
from ..diagnosis import diagnose
from ..diagnosis.result import header_of, reason, width_of
from ..diagnosis.severity import Machine
from ..errors import SceneError
from ..recordings import Recording
from ..report.writing import check_page
from ..scene import Scene
from .arguments import Commands, add_signals, add_speeds, added, said_of
from .signals import local, read_columns
from .text import print_size, print_table

if TYPE_CHECKING:
    import argparse

    from ..diagnosis.kinematics import AnyBearing
    from ..recordings.columns import Columns

_SPEED = re.compile(r"rpm|speed|drehzahl|1/min|min-1|r/min|u/min|tr/min|vitesse", re.IGNORECASE)
"""Pattern of a speed in the head of a file."""


def add_commands(commands: Commands[argparse.ArgumentParser]) -> None:
    """Add the subcommand."""
    found = added(
        commands, "diagnose", "diagnose the bearing of a record: healthy, damaged or undecided",
        "ballrace diagnose 105.mat --fs 12000 --channel DE --bearing 6205 --rpm 1797 -o page.html", _diagnose,
    )  # fmt: skip
    add_signals(found)
    found.add_argument(
        "--bearing", metavar="NAME", help="designation, as 6205, or scene, .toml or .json (default: the run's)"
    )  # fmt: skip
    add_speeds(found, "that of the file")
    found.add_argument(
        "--speed-within", type=float, metavar="SHARE",
        help="how far the speed may be off, 0 to 0.08 (default: as the record shows it, of a run 0)",
    )  # fmt: skip
    found.add_argument(
        "--channel",
        metavar="NAME",
        help="column (default: a structure's sensor, else outer.ay, else the first)",
    )
    found.add_argument(
        "--unit",
        type=canonical,
        choices=("m/s^2", "g"),
        help="unit, where the file does not have it",
    )
    found.add_argument(
        "--false-alarm", type=float, default=0.01, metavar="SHARE",
        help="share of healthy records that may be called damaged (default: %(default)s)",
    )  # fmt: skip
    found.add_argument("--mains", type=float, metavar="HZ", help="frequency of the mains, 50 or 60")
    found.add_argument(
        "--exclude", type=float, nargs="+", default=[], metavar="ORDER",
        help="orders that are not the bearing's, with their multiples: of belts, blades, gears",
    )  # fmt: skip
    found.add_argument(
        "--machine",
        choices=get_args(Machine),
        help="class of the machine, for the zone of ISO 20816-3",
    )
    found.add_argument("-o", "--output", type=Path, metavar="FILE", help="page to write, .html")


def _diagnose(options: argparse.Namespace) -> None:
    if options.output is not None:
        check_page(options.output, "output")
    with local(options.file) as path:
        record = read_columns(path, said_of(options))
        if options.channel is not None and options.channel not in record:
            raise SceneError("channel", repr(options.channel), f"one of {', '.join(record)}")
        try:
            found = diagnose(
                record, _bearing(options.bearing), options.rpm, outer_rpm=options.outer_rpm,
                column=options.channel, unit=options.unit, speed_within=options.speed_within,
                false_alarm=options.false_alarm, exclude=options.exclude, mains=options.mains,
                machine=options.machine,
            )  # fmt: skip
        except SceneError as error:
            if error.path != "speed_rpm" or options.rpm is not None:
                raise
            raise SceneError("--rpm", "none", f"{error.allowed}{_told_speed(record)}") from error
    parts = "".join(f", {part.replace('_', ' ')}" for part in found.parts)
    print(printable(f"{found.bearing}: {found.verdict}{parts}\n{reason(found)}"))
    if found.evidence:
        print_table(header_of(found.unit), found.rows())
    if found.width.part is not None:
        print(printable(width_of(found)))
    for note in found.notes:
        print(printable(note))
    if options.output is not None:
        found.report(options.output)
        print_size(options.output)


def _told_speed(record: Columns) -> str:
    """Return what the head of a file says of a speed, which is not taken unasked, in words; empty if nothing."""
    head = record.metadata.items() if isinstance(record, Recording) else ()
    found = (f"{key}: {value}" for key, value in head if _SPEED.search(f"{key} {value}"))
    return "".join(f'; its head has "{each}"' for each in found)


def _bearing(name: str | None) -> AnyBearing | None:
    if name is not None and name.lower().endswith((".toml", ".json")):
        return Scene.load(Path(name))
    return name
