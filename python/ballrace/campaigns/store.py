"""The folder of a campaign.

::

    campaign.json        scenes, arguments of the runs, options of the features: what makes it one campaign
    cases.parquet        the table, with case ids
    manifest.parquet     table and results side by side, once all is done
    results/<hash>       rows of finished cases, named by the hash of what is in the file
    signals/<hash>       their signals
    tmp/                 files that are being written
    locks/               who is at work

A file is written in ``tmp/``, synced and renamed, so that files in the other folders are complete whatever
happens. Rows are written after the signals they name. Nothing is ever changed in place. Reading a shard checks
that its content has the hash it is named by; a campaign that goes on sets those that have not aside, as
``<hash>.parquet.damaged``, and runs their cases again.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import uuid
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from .._parquet import read_bytes, read_sealed, to_bytes
from ..errors import CampaignError
from .disk import put, sweep

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from pathlib import Path

    import polars as pl

_FORMAT = 1
_SHARD = re.compile(r"[0-9a-f]{32}\.parquet")
_FOLDERS = ("locks", "results", "signals", "tmp")
_AT_ONCE = 200
_NOT_WRITTEN = "its content is not what was written"

SURFACES = ("outer_race", "inner_race", "ball")
"""Surfaces that may have a defect."""

FAULTS = tuple(f"fault_{surface}" for surface in SURFACES)

STATISTICS = {
    "accepted": "Int64", "rejected": "Int64", "nfev": "Int64", "wall_time": "Float64",
    "acceleration_residual": "Float64", "truncated_contacts": "Int64", "simd": "String",
}  # fmt: skip
"""Results of the core for every run besides its features, by the name there, with the type of the column."""

BASE = (
    "case_id", *FAULTS, "status", "error", "message", "warnings", "version", *STATISTICS, "signals",
)  # fmt: skip
"""Columns of every row of results; features follow."""

BUDGET = {"budget": "String", "budget_limit": "Float64"}
"""Which limit a case has spent, and what it was: columns of results that the manifest leaves out."""


class Store:
    """An existing folder of a campaign."""

    def __init__(self, root: Path) -> None:
        self.root = root.resolve()
        path = self.root / "campaign.json"
        try:
            data = path.read_bytes()
        except FileNotFoundError:
            raise CampaignError(f"{root}: holds no campaign; campaign.json is missing") from None
        try:
            text = data.decode()
            self.identity: dict[str, Any] = json.loads(text)
            form = self.identity["format"]
        except (ValueError, TypeError, KeyError):
            raise CampaignError(
                f"{path}: damaged, not the description of a campaign; give another folder"
            ) from None
        if form != _FORMAT:
            raise CampaignError(
                f"{path}: format {form}, this version of ballrace reads {_FORMAT}; "
                "give another folder, or use the version that made this one"
            )
        self._verified: set[tuple[str, int, int]] = set()
        self.key = hashlib.blake2b(text.encode(), digest_size=16).hexdigest()

    @classmethod
    def prepare(cls, root: Path, identity: Mapping[str, Any]) -> Store:
        """Open the folder of a campaign, made now if there is none.

        Raises
        ------
        CampaignError
            The folder holds other files, or another campaign.
        OSError
            The folder cannot be made or written to.
        """
        if not (root / "campaign.json").exists():
            cls._found(root, identity)
        store = cls.opened(root, identity)
        for folder in _FOLDERS:
            (store.root / folder).mkdir(exist_ok=True)
        store._check_writable()
        sweep(store.root / "tmp")
        return store

    @staticmethod
    def _found(root: Path, identity: Mapping[str, Any]) -> None:
        """Make the folder of a campaign; of several processes one does, in one step: that of its description."""
        root.mkdir(parents=True, exist_ok=True)
        strangers = sorted(path.name for path in root.iterdir() if path.name not in _FOLDERS)
        if any((root / "results").glob("*")):
            strangers.append("results")
        # What is there may be of a process that was faster.
        if strangers and not (root / "campaign.json").exists():
            found = ", ".join(strangers[:3])
            raise CampaignError(
                f"{root}: not a campaign's folder, it holds {found}; give a new or an empty one"
            )
        for folder in _FOLDERS:
            (root / folder).mkdir(exist_ok=True)
        text = json.dumps(_description(identity), indent=1)
        put(root, "campaign.json", text.encode(), new=True)

    @classmethod
    def opened(cls, root: Path, identity: Mapping[str, Any]) -> Store:
        """Open the folder of a campaign that is there.

        Raises
        ------
        CampaignError
            It holds another.
        """
        store = cls(root)
        store._check_same(_description(identity))
        return store

    def _check_same(self, wanted: Mapping[str, Any]) -> None:
        for part in wanted:
            here, there = wanted[part], self.identity.get(part)
            if here == there:
                continue
            if isinstance(here, dict) and isinstance(there, dict):
                keys = [k for k in {**here, **there} if here.get(k) != there.get(k)]
                what = ", ".join(
                    f"{k} is {_short(there.get(k))} there and {_short(here.get(k))} here"
                    for k in keys
                )
            else:
                what = f"{_short(there)} there and {_short(here)} here"
            raise CampaignError(
                f"{self.root}: holds another campaign, {part}: {what}; give another folder"
            )

    def _check_writable(self) -> None:
        probe = self.root / "tmp" / uuid.uuid4().hex
        probe.touch()
        # Another process may have swept it away.
        probe.unlink(missing_ok=True)

    def write(self, folder: str, frame: pl.DataFrame) -> str:
        """Write a shard and return its name."""
        data = to_bytes(frame)
        name = f"{hashlib.blake2b(data, digest_size=16).hexdigest()}.parquet"
        put(self.root, f"{folder}/{name}", data)
        return name

    def write_table(self, name: str, frame: pl.DataFrame) -> None:
        """Write or replace a table at the root."""
        put(self.root, name, to_bytes(frame, sealed=True))

    def read_table(self, name: str) -> pl.DataFrame:
        """Read a table at the root.

        Raises
        ------
        CampaignError
            It is not there, or damaged.
        """
        path = self.root / name
        try:
            frame, _ = read_sealed(path)
        except FileNotFoundError:
            raise CampaignError(f"{path}: missing; run the campaign again") from None
        except (OSError, ValueError) as error:
            raise CampaignError(f"{path}: damaged ({error}); run the campaign again") from None
        return frame

    def results(self, damaged: list[Path] | None = None) -> pl.DataFrame:
        """Return the rows of all finished cases, one a case.

        Shards that are damaged are appended to ``damaged`` if it is given, and their rows left out.

        Raises
        ------
        CampaignError
            A shard is damaged, or the folder cannot be read.
        """
        from .._polars import pl

        # A shard of an older version may lack columns.
        frames = [pl.DataFrame(schema=schema())]
        for name in sorted(self.names("results")):
            try:
                frames.append(self._read_result(self.root / "results" / name))
            except CampaignError:
                if damaged is None:
                    raise
                damaged.append(self.root / "results" / name)
        rows = _joined(frames)
        # Of a case that was run twice, the row with signals that are there counts, and one that did not run out
        # of budget; the order does not depend on the files'.
        kept = pl.col("signals").is_in(sorted(self.names("signals"))).fill_null(value=False)
        order = (~kept, pl.col("budget").is_not_null(), "version", "signals", "wall_time")
        return rows.sort("case_id", *order).unique("case_id", keep="first", maintain_order=True)

    def _read_result(self, path: Path) -> pl.DataFrame:
        try:
            data = path.read_bytes()
        except OSError as error:
            raise CampaignError(_damaged(path, error.strerror or str(error))) from None
        if hashlib.blake2b(data, digest_size=16).hexdigest() != path.stem:
            raise CampaignError(_damaged(path, _NOT_WRITTEN))
        try:
            frame = read_bytes(data)
            _check_results(frame)
        except ValueError as error:
            raise CampaignError(_damaged(path, str(error))) from None
        return frame

    def signals(self, name: str) -> Path:
        """Return the path of a shard of signals, having checked that it is what was written.

        Raises
        ------
        CampaignError
            It is missing or damaged, or the name is none of a shard.
        """
        if not _SHARD.fullmatch(name):
            # It could lead anywhere.
            text = f"{self.root}: not written by ballrace, rows name {name!r} as their signals"
            raise CampaignError(text)
        path = self.root / "signals" / name
        try:
            with path.open("rb") as file:
                status = os.fstat(file.fileno())
                known = (name, status.st_size, status.st_mtime_ns)
                if known in self._verified:
                    return path
                found = hashlib.file_digest(file, lambda: hashlib.blake2b(digest_size=16))
        except OSError as error:
            raise CampaignError(_damaged(path, error.strerror or str(error))) from None
        if found.hexdigest() != path.stem:
            raise CampaignError(_damaged(path, _NOT_WRITTEN))
        self._verified.add(known)
        return path

    def damaged_signals(self, names: Iterable[str]) -> list[Path]:
        """Return those of the named shards of signals that are there but not what was written."""
        damaged = []
        for name in sorted(self.names("signals").intersection(names)):
            try:
                self.signals(name)
            except CampaignError:
                damaged.append(self.root / "signals" / name)
        return damaged

    def set_aside(self, damaged: Iterable[Path]) -> None:
        """Give damaged shards a name by which they are not read; another process may have done so."""
        for path in damaged:
            with suppress(FileNotFoundError):
                path.replace(path.with_name(f"{path.name}.damaged"))

    def names(self, folder: str) -> set[str]:
        """Return the names of the shards of a folder; files of other names are none of ours.

        Raises
        ------
        CampaignError
            The folder cannot be read.
        """
        try:
            paths = list((self.root / folder).iterdir())
        except OSError as error:
            text = f"{self.root / folder}: cannot be read ({error.strerror or error})"
            raise CampaignError(f"{text}; nothing is known of the finished cases") from None
        return {path.name for path in paths if _SHARD.fullmatch(path.name)}


def _description(identity: Mapping[str, Any]) -> dict[str, Any]:
    """Return what ``campaign.json`` says, as it will be read."""
    described: dict[str, Any] = json.loads(json.dumps({"format": _FORMAT, **identity}))
    return described


def schema() -> dict[str, Any]:
    """Return the types of the columns that every row of results has."""
    from .._polars import pl

    types = {**STATISTICS, **BUDGET, **dict.fromkeys(FAULTS, "Boolean")}
    return {name: getattr(pl, types.get(name, "String")) for name in (*BASE, *BUDGET)}


def without_empty_errors(table: pl.DataFrame) -> pl.DataFrame:
    """Leave out standard errors of features where no record is long enough for any."""
    if "batches" not in table.columns or table["batches"].max():
        return table
    features = {name for name in table.columns if f"{name}_se" in table.columns}
    return table.drop(f"{name}_se" for name in features)


def _joined(frames: list[pl.DataFrame]) -> pl.DataFrame:
    """Join tables in parts, between which Ctrl-C is checked: polars takes more than a second for 5000 at once."""
    from .._polars import pl

    while len(frames) > 1:
        parts = range(0, len(frames), _AT_ONCE)
        frames = [pl.concat(frames[i : i + _AT_ONCE], how="diagonal") for i in parts]
    return frames[0]


def _check_results(frame: pl.DataFrame) -> None:
    """Refuse a table that has the right hash but was not written as rows of results."""
    from .._polars import pl

    base = schema()
    if not {"case_id", "status"} <= set(frame.columns):
        raise ValueError("it has no rows of results")
    for name, found in frame.schema.items():
        if found != base.get(name, pl.Float64):
            raise ValueError(f"its column {name} is of type {found}")


def _damaged(path: Path, why: str) -> str:
    return f"{path}: damaged ({why}); run the campaign again, and its cases run again"


def _short(value: object) -> str:
    text = json.dumps(value)
    return text if len(text) <= 60 else f"{text[:57]}..."
