"""The folder of a campaign.

::

    campaign.json        scenes, arguments of the runs, options of the features: what makes it one campaign
    cases.parquet        the table, with case ids
    manifest.parquet     table and results side by side, once all is done
    results/<hash>       rows of finished cases, named by the hash of what is in the file
    signals/<hash>       their signals
    tmp/                 files that are being written
    locks/               who is at work

A file is written in ``tmp/``, synced and renamed, so that what stands in the other folders is whole whatever
happens. Rows are written after the signals they name. Nothing is ever changed in place.
"""

from __future__ import annotations

import hashlib
import io
import json
import os
import re
import uuid
from typing import TYPE_CHECKING, Any

from ..errors import CampaignError

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    import polars as pl

_FORMAT = 1
_SHARD = re.compile(r"[0-9a-f]{32}\.parquet")
_FOLDERS = ("locks", "results", "signals", "tmp")

SURFACES = ("outer_race", "inner_race", "ball")
"""Surfaces that may have a defect."""

FAULTS = tuple(f"fault_{surface}" for surface in SURFACES)

BASE = ("case_id", *FAULTS, "status", "error", "message", "version", "accepted", "rejected", "nfev",
        "wall_time", "signals")  # fmt: skip
"""Columns of every row of results; features follow."""


class Store:
    """An existing folder of a campaign."""

    def __init__(self, root: Path) -> None:
        self.root = root.resolve()
        path = self.root / "campaign.json"
        try:
            text = path.read_text(encoding="utf-8")
        except FileNotFoundError:
            raise CampaignError(f"{root}: holds no campaign; campaign.json is missing") from None
        try:
            self.identity: dict[str, Any] = json.loads(text)
            form = self.identity["format"]
        except (ValueError, TypeError, KeyError):
            raise CampaignError(f"{path}: damaged, not the description of a campaign") from None
        if form != _FORMAT:
            raise CampaignError(f"{path}: format {form}; this version of ballrace reads {_FORMAT}")
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
        if (root / "campaign.json").exists():
            store = cls.opened(root, identity)
            for folder in _FOLDERS:
                (store.root / folder).mkdir(exist_ok=True)
            store._check_writable()
            return store
        root.mkdir(parents=True, exist_ok=True)
        strangers = sorted(path.name for path in root.iterdir() if path.name not in _FOLDERS)
        if strangers or any((root / "results").glob("*")):
            found = ", ".join(strangers[:3]) or "results"
            raise CampaignError(
                f"{root}: not a campaign's folder, it holds {found}; give a new or an empty one"
            )
        for folder in _FOLDERS:
            (root / folder).mkdir(exist_ok=True)
        put(root, "campaign.json", json.dumps(_description(identity), indent=1).encode())
        return cls(root)

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
        probe.unlink()

    def write(self, folder: str, frame: pl.DataFrame) -> str:
        """Write a shard and return its name."""
        buffer = io.BytesIO()
        frame.write_parquet(buffer)
        data = buffer.getvalue()
        name = f"{hashlib.blake2b(data, digest_size=16).hexdigest()}.parquet"
        put(self.root, f"{folder}/{name}", data)
        return name

    def write_table(self, name: str, frame: pl.DataFrame) -> None:
        """Write or replace a table at the root."""
        buffer = io.BytesIO()
        frame.write_parquet(buffer)
        put(self.root, name, buffer.getvalue())

    def read_table(self, name: str) -> pl.DataFrame:
        """Read a table at the root.

        Raises
        ------
        CampaignError
            It is not there, or damaged.
        """
        import polars as pl

        path = self.root / name
        try:
            return pl.read_parquet(path.read_bytes())
        except FileNotFoundError:
            raise CampaignError(f"{path}: missing; run the campaign again") from None
        except pl.exceptions.PolarsError as error:
            raise CampaignError(f"{path}: damaged ({error}); run the campaign again") from None

    def results(self) -> pl.DataFrame:
        """Return the rows of all finished cases, one a case.

        Raises
        ------
        CampaignError
            A shard is damaged.
        """
        import polars as pl

        # A shard of an older version may lack columns.
        frames = [pl.DataFrame(schema=schema())]
        frames += [self._read_result(path) for path in self._shards("results")]
        rows = pl.concat(frames, how="diagonal")
        # Of a case that was run twice, the row with signals counts; the order does not depend on the files'.
        order = ("case_id", pl.col("signals").is_null(), "version", "signals", "wall_time")
        return rows.sort(*order).unique("case_id", keep="first", maintain_order=True)

    def _read_result(self, path: Path) -> pl.DataFrame:
        import polars as pl

        data = path.read_bytes()
        if hashlib.blake2b(data, digest_size=16).hexdigest() != path.stem:
            raise CampaignError(_damaged(path, "its content is not what was written"))
        return pl.read_parquet(data)

    def kept_signals(self) -> set[str]:
        """Return the names of the shards of signals.

        Raises
        ------
        CampaignError
            One is damaged, as far as its beginning and end tell.
        """
        import polars as pl

        names = set()
        for path in self._shards("signals"):
            try:
                pl.read_parquet_schema(path)
            except pl.exceptions.PolarsError as error:
                raise CampaignError(_damaged(path, str(error))) from None
            names.add(path.name)
        return names

    def _shards(self, folder: str) -> list[Path]:
        """Return the shards of a folder; files of other names are none of ours."""
        return sorted(
            path for path in (self.root / folder).glob("*") if _SHARD.fullmatch(path.name)
        )


def _description(identity: Mapping[str, Any]) -> dict[str, Any]:
    """Return what ``campaign.json`` says, as it will be read."""
    described: dict[str, Any] = json.loads(json.dumps({"format": _FORMAT, **identity}))
    return described


def schema() -> dict[str, Any]:
    """Return the types of the columns that every row of results has."""
    import polars as pl

    counts = ("accepted", "rejected", "nfev")
    types = {**dict.fromkeys(counts, pl.Int64), **dict.fromkeys(FAULTS, pl.Boolean)}
    types["wall_time"] = pl.Float64
    return {name: types.get(name, pl.String) for name in BASE}


def put(root: Path, name: str, data: bytes) -> None:
    """Write a file within ``root`` that is there whole or not at all, also after a loss of power.

    Raises
    ------
    CampaignError
        It cannot be written.
    """
    temporary = root / "tmp" / uuid.uuid4().hex
    try:
        with temporary.open("xb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        temporary.replace(root / name)
        _sync((root / name).parent)
    except OSError as error:
        raise CampaignError(f"cannot write to {root}: {error.strerror or error}") from error
    finally:
        temporary.unlink(missing_ok=True)


def _sync(folder: Path) -> None:
    """Make the new name itself last, where a folder can be synced."""
    if os.name == "nt":
        return
    file = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(file)
    finally:
        os.close(file)


def _damaged(path: Path, why: str) -> str:
    return f"{path}: damaged ({why}); delete it and call again, and its cases run again"


def _short(value: object) -> str:
    text = json.dumps(value)
    return text if len(text) <= 60 else f"{text[:57]}..."
