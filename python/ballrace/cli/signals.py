"""``ballrace report`` and ``ballrace spectrum``: what a file of signals holds."""

from __future__ import annotations

import csv
import math
import shutil
import sys
import tempfile
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .. import spectra
from .._io.files import PARQUET, check_writable
from .._io.parquet import is_sealed
from .._io.whole import whole
from ..campaigns import Campaign
from ..errors import SceneError
from ..frequencies.operating import fault_frequencies, spin_of
from ..recordings import read
from ..signals import Signals
from .arguments import Commands, add_signals, add_speeds, added, said_of
from .text import print_size, print_table

if TYPE_CHECKING:
    import argparse
    from collections.abc import Iterator, Mapping

    from ..frequencies.operating import FaultFrequencies
    from ..recordings.columns import Columns

_STRONGEST = 10
_HARMONICS = 5


def add_commands(commands: Commands[argparse.ArgumentParser]) -> None:
    """Add both subcommands."""
    _add_report(commands)
    _add_spectrum(commands)


def _add_report(commands: Commands[argparse.ArgumentParser]) -> None:
    report = added(
        commands, "report", "write a report of a run or a campaign: one page that needs no network",
        "ballrace report out.parquet -o report.html", _report,
    )  # fmt: skip
    report.add_argument(
        "file", type=Path, metavar="FILE",
        help="Parquet file of a run, or folder of a campaign; - reads a file from standard input",
    )  # fmt: skip
    report.add_argument(
        "-o", "--output", type=Path, required=True, metavar="FILE", help="page to write, .html"
    )
    report.add_argument(
        "--columns", nargs="+", metavar="COLUMN",
        help="signals of a run, or features of a campaign, that are shown (default: chosen)",
    )  # fmt: skip
    report.add_argument("--title", help="title of the page (default: name of the scene or folder)")


def _add_spectrum(commands: Commands[argparse.ArgumentParser]) -> None:
    spectrum = added(
        commands, "spectrum", "print the strongest lines of a signal's envelope spectrum, or write it whole",
        "ballrace spectrum out.parquet --column outer.ay --band 2000 6000 -o spectrum.html", _spectrum,
    )  # fmt: skip
    add_signals(spectrum)
    spectrum.add_argument(
        "--column", help="column (default: a structure's sensor, else outer.ay, else the first)"
    )
    spectrum.add_argument(
        "--band",
        type=float,
        nargs=2,
        metavar=("LOW", "HIGH"),
        help="band of the envelope, Hz (default: all)",
    )
    spectrum.add_argument(
        "--plain", action="store_true", help="of the signal itself, not of its envelope"
    )
    spectrum.add_argument(
        "--bearing", metavar="NAME", help="of the catalogue, for fault lines of a measured signal"
    )
    add_speeds(spectrum, "that of the file", "fault lines")
    spectrum.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="FILE",
        help=".csv of all lines, or .html; - prints the CSV",
    )


@contextmanager
def local(path: Path) -> Iterator[Path]:
    """Give the name of a file, into which standard input goes where the name is ``-``."""
    if str(path) != "-":
        yield path
        return
    with tempfile.TemporaryDirectory() as folder:
        local = Path(folder) / "stdin.parquet"
        with local.open("wb") as file:
            shutil.copyfileobj(sys.stdin.buffer, file)
        yield local


def _report(options: argparse.Namespace) -> None:
    with local(options.file) as path:
        if path.is_dir():
            done = Campaign.open(path)
            done.report(options.output, features=options.columns, title=options.title)
        else:
            out = Signals.read_parquet(path)
            out.report(options.output, columns=options.columns, title=options.title)
    print_size(options.output)


def _spectrum(options: argparse.Namespace) -> None:
    band = None if options.band is None else (options.band[0], options.band[1])
    if options.plain and band is not None:
        raise SceneError("band", str(band), "absent with --plain: it is the band of the envelope")
    if options.output is not None and str(options.output) != "-":
        if options.output.suffix.lower() not in (".csv", ".html"):
            raise SceneError("output", str(options.output), "a file that ends in .csv or .html")
        check_writable(options.output)
    with local(options.file) as path:
        out = read_columns(path, said_of(options))
        rates = _rates(out, options.bearing, options.rpm, options.outer_rpm)
        name = options.column or out.channel().name
        if name not in out:
            raise SceneError("column", repr(name), f"one of {', '.join(out)}")
        if options.output is not None and options.output.suffix.lower() == ".html":
            _write_page(out, name, band, rates, options)
            return
        x, fs = out[name], out.fs
        found = spectra.spectrum(x, fs) if options.plain else spectra.envelope_spectrum(x, fs, band)
    lines = zip(found[0].tolist(), found[1].tolist(), strict=True)
    if options.output is None:
        spin = spin_of(out.scene, rates) if isinstance(out, Signals) and rates is not None else None
        _print_strongest(list(lines), rates, spin)
    elif str(options.output) == "-":
        csv.writer(sys.stdout, lineterminator="\n").writerows([("frequency", "value"), *lines])
    else:
        with whole(options.output) as temporary, temporary.open("w", newline="") as file:
            csv.writer(file).writerows([("frequency", "value"), *lines])


def read_columns(path: Path, said: Mapping[str, Any]) -> Columns:
    """Read a run, which has its scene, or a record, about which something may have to be said.

    A run of which a part is asked for is read as a record.
    """
    out = None
    whole = all(value is None for name, value in said.items() if name != "fs")
    try:
        # One without a hash was written by something else, and is read in a child process.
        if whole and path.suffix.lower() in PARQUET and is_sealed(path):
            out = Signals.read_parquet(path)
    except SceneError:
        raise
    except ValueError:
        pass  # damaged, or a record: reading it shows
    if out is None:
        return read(path, **said, progress=True)
    if said["fs"] is not None and not math.isclose(said["fs"], out.fs, rel_tol=1e-3):
        raise SceneError("fs", f"{said['fs']:g}", f"the rate of the run, {out.fs:g} Hz, or absent")
    return out


def _rates(
    out: Columns, bearing: str | None, rpm: float | None, outer_rpm: float | None
) -> FaultFrequencies | None:
    if bearing is not None:
        shaft = getattr(out, "shaft", None)
        if rpm is None and outer_rpm is None and shaft is not None:
            rpm = 60.0 * shaft
        return fault_frequencies(bearing, rpm, outer_rpm=outer_rpm)
    speeds = {name: v for name, v in (("rpm", rpm), ("outer_rpm", outer_rpm)) if v is not None}
    if isinstance(out, Signals):
        try:
            return fault_frequencies(out, rpm, outer_rpm=outer_rpm)
        except SceneError:
            if speeds:
                raise
            return None  # the speed changes
    for name, speed in speeds.items():
        raise SceneError(
            name, f"{speed:g}", "absent without --bearing: a record has no lines of its own"
        )
    return None


def _write_page(
    out: Columns, name: str, band: tuple[float, float] | None, rates: FaultFrequencies | None,
    options: argparse.Namespace,
) -> None:  # fmt: skip
    from .. import plot

    if options.plain:
        raise SceneError("plain", "True", "a .csv file: the page shows the envelope with its lines")
    plot.write(plot.envelope_spectrum(out, name, band=band, rates=rates), options.output)
    print_size(options.output)


def _print_strongest(
    lines: list[tuple[float, float]], rates: FaultFrequencies | None, spin: tuple[float, int] | None
) -> None:
    """Print the highest summits, with the nearest line of defects or shaft within a line's width of each."""
    inner = range(1, len(lines) - 1)
    summits = [k for k in inner if lines[k - 1][1] < lines[k][1] >= lines[k + 1][1]]
    summits.sort(key=lambda k: -lines[k][1])
    width = 2.0 * (lines[1][0] - lines[0][0])
    known = () if rates is None else tuple(_known_lines(rates, spin, width))
    rows = []
    for k in summits[:_STRONGEST]:
        f, value = lines[k]
        near = sorted((abs(at - f), label) for low, at, high, label in known if low <= f <= high)
        rows.append([f"{f:.2f}", f"{value:.4g}", near[0][1] if near else ""])
    print_table(["frequency Hz", "value", "near"], rows)


def _known_lines(
    rates: FaultFrequencies, spin: tuple[float, int] | None, width: float
) -> Iterator[tuple[float, float, float, str]]:
    """Yield lowest frequency, centre, highest [Hz] and label of lines of defects and of the rings that turn."""
    for band in spectra.fault_bands(rates.orders, rates.shaft, harmonics=_HARMONICS, spin=spin):
        yield band.low - width, band.centre, band.high + width, band.label
    for ring, name in ((rates.inner, "f_r"), (rates.outer, "f_o")):
        for k in range(1, _HARMONICS + 1) if ring else ():
            yield k * ring - width, k * ring, k * ring + width, name if k == 1 else f"{k}·{name}"
