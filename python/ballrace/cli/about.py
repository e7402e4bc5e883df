"""``ballrace frequencies``, ``ballrace schema``, ``ballrace skill`` and ``ballrace doctor``."""

from __future__ import annotations

import importlib.metadata
import importlib.util
import json
import platform
from pathlib import Path
from typing import TYPE_CHECKING

from .. import _core
from ..bearings import catalogue
from ..errors import BallraceError
from ..frequencies.operating import fault_frequencies
from ..presets import deep_groove_6205
from ..run import simulate
from ..scene.schema import schema
from .arguments import Commands, add_speeds, added
from .text import print_table

if TYPE_CHECKING:
    import argparse

_EXTRAS = {
    "numpy": "", "polars": "", "scipy": "", "plotly": "plot", "h5py": "io", "pyuff": "io",
    "nptdms": "io", "fastexcel": "io", "distributed": "campaign", "marimo": "app",
}  # fmt: skip
"""Libraries by the extra that installs them; without one they always are."""


def add_commands(commands: Commands[argparse.ArgumentParser]) -> None:
    """Add the subcommands."""
    found = added(
        commands, "frequencies", "print the fault frequencies of a bearing of the catalogue",
        "ballrace frequencies 6205 --rpm 1797", _frequencies,
    )  # fmt: skip
    found.add_argument("bearing", metavar="NAME", help="designation, such as 6205 or 7205B")
    add_speeds(found, "orders of the shaft")
    found.add_argument("--json", action="store_true", help="print them as JSON")
    added(
        commands, "schema", "print the JSON Schema of scenes, for editors and other programs",
        "ballrace schema > scene.schema.json", _schema,
    )  # fmt: skip
    added(
        commands, "skill", "print a page that teaches assistants to use the package",
        "ballrace skill > SKILL.md", _skill,
    )  # fmt: skip
    added(commands, "doctor", "show what is installed, and try a run", "ballrace doctor", _doctor)


def version() -> str:
    """Return the installed version."""
    return importlib.metadata.version("ballrace")


def _frequencies(options: argparse.Namespace) -> None:
    row = catalogue[options.bearing]
    known = options.rpm is not None or options.outer_rpm is not None
    rates = fault_frequencies(row, options.rpm if known else 60.0, outer_rpm=options.outer_rpm)
    unit = "Hz" if known else "per turn"
    rings = {"shaft": rates.shaft}
    if options.outer_rpm is not None:
        rings = {"inner ring": rates.inner, "outer ring": rates.outer}
    values = {
        **rings, "FTF": rates.ftf, "BPFO": rates.bpfo, "BPFI": rates.bpfi, "BSF": rates.bsf,
        "2·BSF": 2.0 * rates.bsf,
    }  # fmt: skip
    if options.json:
        speeds = {"speed_rpm": options.rpm}
        if options.outer_rpm is not None:
            speeds["outer_rpm"] = options.outer_rpm
        document = {"bearing": row.designation, **speeds, "unit": unit, **values}
        print(json.dumps(document, indent=2, ensure_ascii=False))
        return
    ball, pitch = 1e3 * row.ball_diameter, 1e3 * row.pitch_diameter
    print(f"{row.designation}: {row.ball_count} balls of {ball:g} mm on {pitch:g} mm")
    print_table(["", unit], [[name, f"{value:.4f}"] for name, value in values.items()])


def _skill(options: argparse.Namespace) -> None:
    del options
    print(Path(__file__).with_name("skill.md").read_text(encoding="utf-8"), end="")


def _schema(options: argparse.Namespace) -> None:
    del options
    print(json.dumps(schema(), indent=2))


def _lacks_rtcompat() -> bool:
    """Whether polars is a build for instructions (AVX2, FMA) that this processor does not have."""
    on_x86 = platform.machine().lower() in {"x86_64", "amd64"}
    if not on_x86 or "x86-64-v3" in _core.instruction_sets():
        return False
    return importlib.util.find_spec("_polars_runtime_compat") is None


def _doctor(options: argparse.Namespace) -> None:
    del options
    print(f"ballrace {version()}, Python {platform.python_version()}, {platform.platform()}")
    print(f"threads: {_core.available_threads()}")
    lines = []
    for name, extra in _EXTRAS.items():
        there = importlib.util.find_spec(name) is not None
        state = (
            importlib.metadata.version(name)
            if there
            else f'missing: pip install "ballrace[{extra}]"'
        )
        lines.append([name, state])
    print_table(["library", "version"], lines)
    unfit = _lacks_rtcompat()
    if unfit:
        print(
            "polars: built for AVX2, which this processor lacks, so tables may end the process: "
            'pip install "polars[rtcompat]>=1.34"'
        )
    out = simulate(deep_groove_6205(), duration=0.002)
    distrust = out.provenance.distrust
    print(f"vector instructions: {out.provenance.simd}" + (f" ({distrust})" if distrust else ""))
    print(f"a run of 2 ms took {1e3 * out.stats.wall_time:.0f} ms, {out.stats.nfev} evaluations")
    if distrust or unfit:
        raise BallraceError("something of the above is not as it should be")
    print("all is well")
