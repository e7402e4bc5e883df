"""``ballrace campaign``: a table of cases from a file, run into a folder."""

from __future__ import annotations

import argparse
import re
from pathlib import Path
from typing import Any

from .. import presets
from .._base.libraries import pl
from .._base.text import printable
from .._io.files import as_path
from .._io.toml import loads
from ..campaigns.bearings import scatter
from ..campaigns.designs import check_cases, grid, latin_hypercube, sobol
from ..campaigns.result import Campaign
from ..campaigns.run import campaign
from ..campaigns.verify import verify
from ..errors import CampaignError, SceneError
from ..options import ARGUMENTS, BUDGET
from ..scene import Scene
from .arguments import Commands, add_budget

_ARGUMENTS = (
    *(name for name in ARGUMENTS if name != "threads"), "keep", "columns", "skip", "band", "contact_loads",
)  # fmt: skip
_BUILDERS = ("table", "grid", "latin_hypercube", "sobol", "scatter")
_PLAN = (
    "A sweep is a .toml file: scene (a file or a preset) or [scenes] by name; the arguments of ballrace.campaign "
    f"{', '.join(_ARGUMENTS)}; and what builds the table, crossed if there are several: table = FILE (.csv or "
    ".parquet), [grid] of lists, or of { from, to, count }, by dotted paths in quotes; [latin_hypercube] or "
    "[sobol] of [low, high] with n and seed; [scatter] with n, seed and standard deviations."
)


def add_commands(commands: Commands[argparse.ArgumentParser]) -> None:
    """Add the subcommand."""
    parser = commands.add_parser(
        "campaign", help="run a table of cases into a folder, or go on with one", description=_PLAN
    )
    parser.add_argument(
        "sweep", type=Path, nargs="?", metavar="SWEEP",
        help="sweep, a .toml file; with --verify the folder of a campaign",
    )  # fmt: skip
    parser.add_argument(
        "-o", "--output", type=Path, metavar="FOLDER", help="folder of the campaign"
    )
    parser.add_argument(
        "--status",
        type=Path,
        metavar="FOLDER",
        help="show the progress of the campaign in a folder",
    )
    parser.add_argument(
        "--verify", action="store_true",
        help="read every byte of a campaign's folder and say which files are damaged (then the status is 1)",
    )  # fmt: skip
    parser.add_argument(
        "--shard", type=_shard, default=(0, 1), metavar="I/N",
        help="run every N-th case from the I-th, I from 0: one job of a batch array",
    )  # fmt: skip
    parser.add_argument("--threads", type=int, help="cases at once (default: all cores)")
    parser.add_argument(
        "--dry-run", action="store_true", help="estimate time and disk space, and write nothing"
    )
    parser.add_argument(
        "--resume", choices=("auto", "strict", "no"), default="auto",
        help="cases finished by another version: go on, refuse; no: refuse any (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--on-error", choices=("record", "raise"), default="record",
        help="a case that fails is a row, or ends the campaign (default: %(default)s)",
    )  # fmt: skip
    add_budget(parser, "a case")
    defaults = {name: parser.get_default(name) for name in vars(parser.parse_args([]))}
    parser.set_defaults(command=lambda options: _command(options, defaults))


def _command(options: argparse.Namespace, defaults: dict[str, Any]) -> None:
    if options.status is not None:
        _refuse_others(options, defaults, "status")
        _show(Campaign.open(options.status))
        return
    if options.verify and options.sweep is not None:
        _refuse_others(options, defaults, "verify", "sweep")
        _verify(options.sweep)
        return
    if options.sweep is None or options.output is None:
        allowed = "SWEEP -o FOLDER, --status FOLDER, or FOLDER --verify"
        raise SceneError("campaign", "no sweep", allowed)
    if str(options.output) == "-":
        raise SceneError("output", "-", "a folder, not standard output")
    sweep = read(options.sweep)
    # What is asked for now goes before what the sweep says: a budget is no part of what a campaign is.
    for name in BUDGET:
        if getattr(options, name) is not None:
            sweep[name] = getattr(options, name)
    # What a plan may not say, the command does.
    found = campaign(
        sweep.pop("cases"),
        options.output,
        **sweep,
        threads=options.threads,
        shard=options.shard,
        resume=False if options.resume == "no" else options.resume,
        on_error=options.on_error,
        dry_run=options.dry_run,
    )
    if options.dry_run:
        print(found)
    else:
        _show(found)


def _refuse_others(options: argparse.Namespace, defaults: dict[str, Any], *own: str) -> None:
    """Refuse what would say nothing beside an option that only looks at a folder."""
    for name, default in defaults.items():
        if name not in own and getattr(options, name) != default:
            shown, allowed = str(getattr(options, name)), f"absent beside --{own[0]}"
            raise SceneError(name, shown, allowed)


def _show(found: Campaign) -> None:
    print(found.status())
    for text in found.warned["warnings"][:1]:
        print(f"  {found.warned.height} with warnings, the first: {printable(text)}")
    kinds = found.failed.group_by("error").len().sort("error")
    for error, count in kinds.iter_rows():
        first = found.failed.filter(error=error)["message"][0]
        print(printable(f"  {count} × {error}, the first: {first}"))


def _verify(folder: Path) -> None:
    """Say which files are not what was written; there are none without an error.

    Raises
    ------
    CampaignError
        There are some.
    """
    found = verify(folder)
    wrong = found.drop_nulls("problem")
    for name, problem in wrong.iter_rows():
        print(printable(f"{name}: {problem}"))
    if not wrong.is_empty():
        raise CampaignError(
            f"{folder}: {wrong.height} of {found.height} files are not what was written; run the campaign again"
        )
    print(printable(f"{folder}: all {found.height} files are what was written"))


def _shard(text: str) -> tuple[int, int]:
    match = re.fullmatch(r"(\d+)/(\d+)", text)
    if match is None:
        raise argparse.ArgumentTypeError(f"{text!r} is not I/N")
    return int(match[1]), int(match[2])


def read(path: Path) -> dict[str, Any]:
    """Read a sweep: the arguments ``cases`` and ``scene`` of :func:`ballrace.campaign`, and others it gives.

    Raises
    ------
    SceneError
        Something in it is not usable.
    OSError
        A file cannot be read.
    """
    try:
        sweep = loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise SceneError("sweep", str(path), f"a TOML file ({error})") from error
    known = ("scene", "scenes", *_ARGUMENTS, *_BUILDERS)
    for name in sweep:
        if name not in known:
            raise SceneError(name, "an entry of the sweep", f"one of {', '.join(known)}")
    scene = _scene(sweep, path.parent)
    arguments = {name: sweep[name] for name in _ARGUMENTS if name in sweep}
    return {"cases": _table(sweep, scene, path.parent), "scene": scene, **arguments}


def _scene(sweep: dict[str, Any], folder: Path) -> Scene | dict[str, Scene]:
    if ("scene" in sweep) == ("scenes" in sweep):
        value = "absent, as is scenes" if "scene" not in sweep else "given beside scenes"
        raise SceneError("scene", value, "either scene, a name or a file, or several in [scenes]")
    if "scene" in sweep:
        return _load("scene", sweep["scene"], folder)
    scenes = sweep["scenes"]
    if not (isinstance(scenes, dict) and scenes):
        raise SceneError("scenes", str(scenes), "a table of scenes by name")
    return {name: _load(f"scenes.{name}", value, folder) for name, value in scenes.items()}


def _load(field: str, name: object, folder: Path) -> Scene:
    preset = str(name).replace("-", "_")
    if preset in presets.names():
        made: Scene = getattr(presets, preset)()
        return made
    if not str(name).lower().endswith((".toml", ".json")):
        known = ", ".join(presets.names()).replace("_", "-")
        raise SceneError(field, str(name), f"one of {known}, or a file that ends in .toml or .json")
    return Scene.load(folder / as_path(str(name), field))


def _table(sweep: dict[str, Any], scene: Scene | dict[str, Scene], folder: Path) -> pl.DataFrame:
    """Build the tables that a sweep asks for, and cross them."""
    tables = [_built(name, sweep[name], scene, folder) for name in _BUILDERS if name in sweep]
    if not tables:
        raise SceneError("cases", "absent", f"at least one of {', '.join(_BUILDERS)}")
    crossed = tables[0]
    for table in tables[1:]:
        twice = set(crossed.columns) & set(table.columns)
        if twice:
            raise SceneError(min(twice), "given twice", "one entry for each column")
        check_cases("cases", crossed.height * table.height)
        crossed = crossed.join(table, how="cross")
    return crossed


def _built(name: str, entry: Any, scene: Scene | dict[str, Scene], folder: Path) -> pl.DataFrame:
    if name == "table":
        return _file(folder / as_path(str(entry), "table"))
    if not isinstance(entry, dict):
        raise SceneError(name, str(entry), "a table, as described by ballrace campaign --help")
    entry = dict(entry)
    try:
        if name == "grid":
            return grid({column: _values(column, value) for column, value in entry.items()})
        n, seed = entry.pop("n"), entry.pop("seed")
        if name == "scatter":
            drawing = scene if isinstance(scene, Scene) else next(iter(scene.values()))
            return scatter(drawing, n, seed=seed, **entry)
        build = latin_hypercube if name == "latin_hypercube" else sobol
        return build({column: (low, high) for column, (low, high) in entry.items()}, n, seed=seed)
    except (KeyError, TypeError, ValueError) as error:
        if isinstance(error, SceneError):
            raise
        raise SceneError(
            name, str(entry), f"as described by ballrace campaign --help ({error})"
        ) from error


def _values(column: str, value: Any) -> list[Any]:
    if isinstance(value, list):
        return value
    if not isinstance(value, dict) or set(value) != {"from", "to", "count"}:
        raise SceneError(column, str(value), "a list of values, or { from = …, to = …, count = … }")
    low, high, count = value["from"], value["to"], value["count"]
    if not (isinstance(count, int) and count >= 2):
        raise SceneError(f"{column}.count", str(count), "a number from 2")
    check_cases(f"{column}.count", count)
    return [low + (high - low) * i / (count - 1) for i in range(count)]


def _file(path: Path) -> pl.DataFrame:
    try:
        match path.suffix.lower():
            case ".csv":
                return pl.read_csv(path.read_bytes())
            case ".parquet":
                return pl.read_parquet(path.read_bytes())
    except (pl.exceptions.PolarsError, pl.exceptions.PanicException) as error:
        raise SceneError("table", str(path), f"a {path.suffix} table ({error})") from error
    raise SceneError("table", str(path), "a file that ends in .csv or .parquet")
