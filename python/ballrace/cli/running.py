"""``ballrace run`` and ``ballrace scene``."""

from __future__ import annotations

import shutil
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, get_args

from .. import presets
from .._base.text import printable
from .._io.files import check_output
from ..bearings import bearing
from ..errors import SceneError
from ..options import ARGUMENTS, Run
from ..run import simulate
from ..scene import Method
from .arguments import Commands, add_budget, add_scene, add_speeds, added, read_scene

if TYPE_CHECKING:
    import argparse

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

_PRESETS = ", ".join(name.replace("_", "-") for name in presets.names())
_OPERATION = {
    "radial-load": ("N", "load of the inner ring along -y (default: a tenth of the static rating)"),
    "axial-load": ("N", "load of the inner ring along +z (default: what the bearing needs)"),
}
"""Loads of a bearing of the catalogue: metavar and help."""

_OF_CATALOGUE = "a bearing of the catalogue"


def add_commands(commands: Commands[argparse.ArgumentParser]) -> None:
    """Add both subcommands."""
    run = added(
        commands, "run", "run a scene and write its signals to a Parquet file",
        "ballrace scene deep-groove-6205 | ballrace run - -o out.parquet --duration 0.5", _run,
    )  # fmt: skip
    add_scene(run)
    run.add_argument(
        "-o", "--output", type=Path, required=True, metavar="FILE",
        help="Parquet file to write; - writes it to a pipe on standard output",
    )  # fmt: skip
    for name, option in _RUN_OPTIONS.items():
        run.add_argument(f"--{name}", default=getattr(_DEFAULTS, name), **option)
    add_budget(run, "the run")
    scene = added(
        commands, "scene", "print a scene as TOML, to start from: a ready-made one, or a bearing of the catalogue",
        "ballrace scene 6309/C3 --radial-load 3000 --rpm 1470 > scene.toml", _scene,
    )  # fmt: skip
    scene.add_argument("name", metavar="NAME", help=f"a designation, such as 6205, or {_PRESETS}")
    for name, (unit, meaning) in _OPERATION.items():
        scene.add_argument(
            f"--{name}", type=float, metavar=unit, help=f"{meaning}; of {_OF_CATALOGUE}"
        )
    add_speeds(scene, "1800", _OF_CATALOGUE)
    scene.add_argument(
        "--housing", choices=("pedestal", "none"),
        help="what the outer ring of a bearing of the catalogue stands on: a pedestal of its size, or the ground, "
        "near 5 kHz (default: pedestal); any other is the structure of the scene",
    )  # fmt: skip


def _run(options: argparse.Namespace) -> None:
    streamed = str(options.output) == "-"
    if streamed and sys.stdout.isatty():
        raise SceneError("output", "-", "a pipe or the name of a file; Parquet is no text to read")
    if not streamed:
        check_output(options.output, read=None if str(options.scene) == "-" else options.scene)
    options.bandwidth = None if options.bandwidth == "none" else options.bandwidth
    arguments = {name: getattr(options, name) for name in ARGUMENTS}
    scene = read_scene(options.scene)
    if not streamed:
        out = simulate(scene, **arguments, progress=True, out=options.output)
        print(f"{printable(str(options.output))}: {len(out)} columns, {out.n_samples} samples")
        return
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "out.parquet"
        simulate(scene, **arguments, progress=True, out=path)
        with path.open("rb") as file:
            shutil.copyfileobj(file, sys.stdout.buffer)


def _scene(options: argparse.Namespace) -> None:
    asked: dict[str, Any] = {
        "radial_load": options.radial_load, "axial_load": options.axial_load, "speed_rpm": options.rpm,
        "outer_rpm": options.outer_rpm, "housing": options.housing,
    }  # fmt: skip
    given = {name: value for name, value in asked.items() if value is not None}
    name = options.name.replace("-", "_")
    if name not in presets.names():
        try:
            bare: dict[str, Any] = {"housing": None} if options.housing == "none" else {}
            if options.rpm is None and options.outer_rpm is None:
                bare["speed_rpm"] = 1800.0
            scene = bearing(options.name, **(given | bare))
        except SceneError as error:
            if error.path != "designation":
                raise
            raise SceneError("name", options.name, f"{_PRESETS}, or {error.allowed}") from None
        what = f"{scene.name} of ballrace's catalogue"
    elif given:
        argument, value = next(iter(given.items()))
        allowed = f"absent beside {options.name}, which has loads, a speed and a housing of its own"
        shown = value if isinstance(value, str) else f"{value:g}"
        raise SceneError(argument, shown, allowed)
    else:
        scene, what = getattr(presets, name)(), f"The preset {name} of ballrace"
    print(f"# {what}; SI units. Fields that are left out: help(ballrace.scene).")
    print("# Run it: ballrace run scene.toml -o run.parquet\n")
    print(scene.to_toml(comments=True), end="")
