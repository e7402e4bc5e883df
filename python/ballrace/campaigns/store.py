"""The folder of a campaign.

::

    campaign.json        scenes, arguments of the runs, options of the features: what makes it one campaign
    campaign.copy.json   the same once more
    cases.parquet        the table, with case ids
    manifest.parquet     table and results side by side, once all is done
    results/<hash>       rows of finished cases, named by the hash of what is in the file
    signals/<hash>       their signals
    tmp/                 files that are being written
    locks/               who is at work

A file is written in ``tmp/``, synced and renamed, so that files in the other folders are complete whatever
happens. Rows are written after the signals they name. Nothing is ever changed in place. Reading a shard checks
that its content has the hash it is named by; a campaign that goes on sets those that have not aside, as
``<hash>.parquet.damaged``, and runs their cases again. What cannot be read may be whole: it stops a campaign, and
is left as it is. Links are not followed.
"""

from __future__ import annotations

import hashlib
import json
import uuid
from collections.abc import Iterable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any
from warnings import warn

from .._base.libraries import pl
from .._io.parquet import read_sealed, to_bytes
from ..errors import CampaignError, CampaignWarning
from . import description
from .columns import schema
from .disk import hash_of, put, reading, refuse_link, sweep
from .locks import in_turn
from .shards import FEATURES, SHARD, check_shard, names, set_aside, shard_of_results

_FOLDERS = ("locks", "results", "signals", "tmp")
_AT_ONCE = 200
_TABLES = ("cases.parquet", "manifest.parquet")

DIGEST = "ballrace.digest"
"""Entry of a table's metadata: see :func:`digest_of`."""


class Store:
    """An existing folder of a campaign."""

    def __init__(self, root: Path) -> None:
        self.root = root.resolve()
        found, wrong = description.sound(self.root)
        if found is None and all(why == "missing" for why in wrong.values()):
            raise CampaignError(f"{root}: holds no campaign; campaign.json is missing")
        if found is None:
            raise CampaignError(
                f"{self.root / 'campaign.json'}: {wrong['campaign.json']}, and its copy is "
                f"{wrong['campaign.copy.json']}; run the campaign again, and both are written anew"
            )
        self.identity = found
        self.wrong = wrong
        self.key = description.digest(found)
        self._verified: set[tuple[str, int, int]] = set()
        for name in (*_FOLDERS, *_TABLES):
            refuse_link(self.root / name)

    @classmethod
    def prepare(cls, root: Path, identity: Mapping[str, Any]) -> Store:
        """Open the folder of a campaign, made now if there is none.

        Raises
        ------
        CampaignError
            The folder holds other files, or another campaign; or it is a file.
        OSError
            The folder cannot be made or written to.
        """
        if root.exists() and not root.is_dir():
            raise CampaignError(f"{root}: a file; give a folder, a new or an empty one")
        root.mkdir(parents=True, exist_ok=True)
        if description.sound(root)[0] is None:
            cls._found(root, identity)
        store = cls.opened(root, identity)
        for folder in _FOLDERS:
            (store.root / folder).mkdir(exist_ok=True)
        store._check_writable()
        sweep(store.root / "tmp")
        store._mend()
        return store

    def _mend(self) -> None:
        """Write the copies of the description anew that are missing or damaged, unless another process has."""
        if not self.wrong:
            return
        with in_turn(self.root / "locks", "description"):
            for name, why in description.sound(self.root)[1].items():
                if why != "missing":
                    text = f"{self.root / name}: {why}; it is written anew from its copy"
                    warn(text, CampaignWarning, 5)
                description.write(self.root, name, self.identity)

    @staticmethod
    def _found(root: Path, identity: Mapping[str, Any]) -> None:
        """Make the folder of a campaign; of several processes one does, in one step: that of its description."""
        wrong = description.sound(root)[1]
        strangers = sorted(path.name for path in root.iterdir() if not _is_ours(path.name))
        # What is there may be of a process that was faster.
        if strangers and not (root / "campaign.json").exists():
            found = ", ".join(strangers[:3])
            raise CampaignError(
                f"{root}: not a campaign's folder, it holds {found}; give a new or an empty one"
            )
        for folder in _FOLDERS:
            refuse_link(root / folder)
            (root / folder).mkdir(exist_ok=True)
        wanted = description.described(identity)
        _readmit(root, wrong, wanted)
        # Of several processes one does; the copy is made of what is there then. Where there are no links, the turn
        # keeps the others from replacing it, in which moment it would be missing.
        with in_turn(root / "locks", "description"):
            description.write(root, description.NAMES[0], wanted, new=True)

    @classmethod
    def opened(cls, root: Path, identity: Mapping[str, Any]) -> Store:
        """Open the folder of a campaign that is there.

        Raises
        ------
        CampaignError
            It holds another.
        """
        store = cls(root)
        store._check_same(description.described(identity))
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
        data = to_bytes(frame, metadata={FEATURES: json.dumps(self.identity.get("features"))})
        name = f"{hash_of(data)}.parquet"
        put(self.root, f"{folder}/{name}", data)
        return name

    def write_table(self, name: str, frame: pl.DataFrame) -> None:
        """Write or replace a table at the root."""
        put(self.root, name, to_bytes(frame, sealed=True, metadata={DIGEST: digest_of(frame)}))

    def read_table(self, name: str) -> pl.DataFrame:
        """Read a table at the root.

        Raises
        ------
        CampaignError
            It is not there, or damaged.
        """
        path = self.root / name
        try:
            return self.table(name)
        except FileNotFoundError:
            raise CampaignError(f"{path}: missing; run the campaign again") from None
        except ValueError as error:
            raise CampaignError(f"{path}: damaged ({error}); run the campaign again") from None

    def table(self, name: str) -> pl.DataFrame:
        """Return a table at the root.

        Raises
        ------
        FileNotFoundError
            It is not there.
        ValueError
            It is damaged.
        CampaignError
            It cannot be read.
        """
        with reading(self.root / name):
            return read_sealed(self.root / name)[0]

    def results(self, damaged: list[Path] | None = None) -> pl.DataFrame:
        """Return the rows of all finished cases, one a case.

        Shards that are damaged are appended to ``damaged`` if it is given, and their rows left out.

        Raises
        ------
        CampaignError
            A shard is damaged, or the folder cannot be read.
        """
        # A shard of an older version may lack columns.
        frames = [pl.DataFrame(schema=schema())]
        for name in sorted(names(self.root, "results")):
            path = self.root / "results" / name
            try:
                frames.append(shard_of_results(path)[0])
            except FileNotFoundError:
                continue  # another process has set it aside
            except ValueError as error:
                if damaged is None:
                    raise CampaignError(_damaged(path, str(error))) from None
                damaged.append(path)
        rows = _joined(frames)
        # Of a case that was run twice, the row with signals that are there counts, and one that did not run out
        # of budget; the order does not depend on the files'.
        kept = pl.col("signals").is_in(sorted(names(self.root, "signals"))).fill_null(value=False)
        order = (~kept, pl.col("budget").is_not_null(), "version", "signals", "wall_time")
        return rows.sort("case_id", *order).unique("case_id", keep="first", maintain_order=True)

    def signals(self, name: str) -> Path:
        """Return the path of a shard of signals, having checked that it is what was written.

        Raises
        ------
        CampaignError
            It is missing or damaged, cannot be read, or the name is none of a shard.
        """
        if not SHARD.fullmatch(name):
            # It could lead anywhere.
            text = f"{self.root}: not written by ballrace, rows name {name!r} as their signals"
            raise CampaignError(text)
        path = self.root / "signals" / name
        try:
            self._check_signals(path)
        except FileNotFoundError as error:
            raise CampaignError(_damaged(path, error.strerror or str(error))) from None
        except ValueError as error:
            raise CampaignError(_damaged(path, str(error))) from None
        return path

    def _check_signals(self, path: Path) -> None:
        """Check a shard of signals as :func:`check_shard` does, unless that has been done."""
        with reading(path):
            status = path.stat()
        known = (path.name, status.st_size, status.st_mtime_ns)
        if known not in self._verified:
            check_shard(path)
            self._verified.add(known)

    def damaged_signals(self, but: Iterable[str] = ()) -> list[Path]:
        """Return the shards of signals that are there but not what was written, ``but`` for those of others.

        Also those that no row names, as killed processes leave them.
        """
        damaged = []
        for name in sorted(names(self.root, "signals").difference(but)):
            path = self.root / "signals" / name
            try:
                self._check_signals(path)
            except FileNotFoundError:
                continue
            except ValueError:
                damaged.append(path)
        return damaged


def _is_ours(name: str) -> bool:
    known = (*_FOLDERS, *_TABLES, *description.NAMES)
    return name.removesuffix(".damaged") in known


def _readmit(root: Path, wrong: Mapping[str, str], wanted: Mapping[str, Any]) -> None:
    """Make a description of the campaign that is called for the one of results whose own is lost.

    Their cases are known by the hash of scene and run, so those of another campaign do no harm; what was computed
    with other options of the features is set aside.
    """
    # Those that were missing may be there now, of a process that was faster.
    lost = [root / name for name, why in wrong.items() if why != "missing"]
    set_aside(lost)
    results = [root / "results" / name for name in names(root, "results")]
    if not lost and not results:
        return
    features = json.dumps(wanted.get("features"))
    for path in results:
        with suppress(FileNotFoundError, ValueError):  # those that are damaged are reported later
            if shard_of_results(path)[1] != features:
                set_aside([path])
    text = f"{root}: its description was lost, and that of this call replaces it; finished cases keep their ids"
    warn(text, CampaignWarning, 6)


def digest_of(frame: pl.DataFrame) -> str:
    """Return a hash of a table's names and cells that anyone can compute of it, with Python alone."""
    found = hashlib.sha256()
    for name in frame.columns:
        found.update(repr((name, frame[name].to_list())).encode())
    return found.hexdigest()


def _joined(frames: list[pl.DataFrame]) -> pl.DataFrame:
    """Join tables in parts, between which Ctrl-C is checked: polars takes more than a second for 5000 at once."""
    while len(frames) > 1:
        parts = range(0, len(frames), _AT_ONCE)
        frames = [pl.concat(frames[i : i + _AT_ONCE], how="diagonal") for i in parts]
    return frames[0]


def _damaged(path: Path, why: str) -> str:
    return f"{path}: damaged ({why}); run the campaign again, and its cases run again"


def _short(value: object) -> str:
    text = json.dumps(value)
    return text if len(text) <= 60 else f"{text[:57]}..."
