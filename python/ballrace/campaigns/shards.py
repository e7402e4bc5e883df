"""Files named by the hash of what is in them: rows of results, and their signals."""

from __future__ import annotations

import hashlib
import re
from contextlib import suppress
from typing import TYPE_CHECKING

from .._io.parquet import read_bytes
from ..errors import CampaignError
from .columns import check_results
from .disk import hash_of, reading, refuse_link

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    import polars as pl

SHARD = re.compile(r"[0-9a-f]{32}\.parquet")

FEATURES = "ballrace.features"
"""Entry of a shard's metadata: options of the features, which do not decide the ids of cases."""

_NOT_WRITTEN = "its content is not what was written"


def names(root: Path, folder: str) -> set[str]:
    """Return the names of the shards of a folder; files of other names are none of ours.

    Raises
    ------
    CampaignError
        The folder cannot be read, or has a link.
    """
    refuse_link(root / folder)
    try:
        paths = [path for path in (root / folder).iterdir() if SHARD.fullmatch(path.name)]
    except OSError as error:
        text = f"{root / folder}: cannot be read ({error.strerror or error})"
        raise CampaignError(f"{text}; nothing is known of the finished cases") from None
    for path in paths:
        refuse_link(path)
    return {path.name for path in paths}


def shard_of_results(path: Path) -> tuple[pl.DataFrame, str | None]:
    """Return the rows of a shard, and the options of the features that they were computed by, as JSON.

    Raises
    ------
    FileNotFoundError
        It is not there.
    ValueError
        It is damaged.
    CampaignError
        It cannot be read, or is a link.
    """
    refuse_link(path)
    with reading(path):
        data = path.read_bytes()
    if hash_of(data) != path.stem:
        raise ValueError(_NOT_WRITTEN)
    frame, metadata = read_bytes(data)
    check_results(frame)
    return frame, metadata.get(FEATURES)


def check_shard(path: Path) -> None:
    """Check a shard against the hash that it is named by; raises as :func:`shard_of_results` does."""
    refuse_link(path)
    with reading(path), path.open("rb") as file:
        found = hashlib.file_digest(file, lambda: hashlib.blake2b(digest_size=16))
    if found.hexdigest() != path.stem:
        raise ValueError(_NOT_WRITTEN)


def set_aside(damaged: Iterable[Path]) -> None:
    """Give damaged files a name by which they are not read; another process may have done so."""
    for path in damaged:
        with suppress(FileNotFoundError):
            path.replace(path.with_name(f"{path.name}.damaged"))
