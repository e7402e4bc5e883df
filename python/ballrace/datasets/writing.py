"""The files of a data set, whole or not at all."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Collection, Iterable, Mapping
from datetime import UTC, datetime
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._base.interrupt import interrupted_once
from .._base.libraries import pl
from .._io.files import as_path
from .._io.parquet import writing_to
from ..errors import SceneError
from .layout import COLUMNS, SCHEMA_VERSION

_BLOCK = 8 << 20
"""Samples of a file, about [bytes]: what is read for one of its signals."""


def new_folder(path: str | os.PathLike[str]) -> Path:
    """Return the folder to be made.

    Raises
    ------
    SceneError
        There is one of that name, or the path is none.
    """
    path = as_path(path)
    if path.exists():
        raise SceneError("path", str(path), "a folder that is not there yet")
    return path


def write(
    path: Path,
    signals: Iterable[tuple[dict[str, Any], NDArray[np.float64]]],
    card: Mapping[str, Any],
) -> None:
    """Write signals, each with its row of the table, into a folder that appears when all is written.

    Raises
    ------
    SceneError
        There is no signal.
    OSError
        It cannot be written.
    """
    with TemporaryDirectory(prefix=f".{path.name}.", dir=path.parent) as folder:
        made = Path(folder) / path.name
        rows, digests = _write_signals(made / "signals", path.name, signals)
        if not rows:
            raise SceneError("path", str(path), "a campaign that kept labelled signals")
        write_table(made, rows)
        manifest = card_of(path.name, rows, digests) | dict(card)
        (made / "manifest.json").write_text(json.dumps(manifest, indent=1), encoding="utf-8")
        (made / "README.md").write_text(as_page(manifest), encoding="utf-8")
        made.rename(path)


def _write_signals(
    folder: Path, dataset: str, signals: Iterable[tuple[dict[str, Any], NDArray[np.float64]]]
) -> tuple[list[dict[str, Any]], dict[str, str]]:
    """Write the samples as 32-bit floats; return the rows with their places, and hashes of the samples."""
    folder.mkdir(parents=True)
    rows: list[dict[str, Any]] = []
    block: list[tuple[str, NDArray[np.float32]]] = []
    digests, files = {}, 0
    for row, x in signals:
        samples, name = x.astype(np.float32), f"{row['recording_id']}/{row['channel']}"
        digests[name] = digest_of(samples)
        place = {"signal_file": _file(files), "signal_row_group": 0, "signal_row": len(block)}
        rows.append({"dataset": dataset, "signal_id": name, "n_samples": x.size} | row | place)
        block.append((name, samples))
        if sum(part.nbytes for _, part in block) >= _BLOCK:
            write_block(folder / _file(files), block)
            block, files = [], files + 1
    if block:
        write_block(folder / _file(files), block)
    return rows, digests


def digest_of(samples: NDArray[np.float32]) -> str:
    """Return the hash of the samples of a signal."""
    return hashlib.sha256(b"float32" + samples.tobytes()).hexdigest()


def _file(number: int) -> str:
    return f"part-float32-{number:05}.parquet"


def write_block(path: Path, block: list[tuple[str, NDArray[np.float32]]]) -> None:
    """Write signals with their names into a file."""
    names, parts = zip(*block, strict=True)
    samples = pl.Series([pl.Series(part) for part in parts], dtype=pl.List(pl.Float32))
    table = pl.DataFrame({"signal_id": names, "signal": samples})
    with writing_to(path):
        interrupted_once(lambda: table.write_parquet(path, row_group_size=table.height))


def write_table(
    folder: Path, rows: list[dict[str, Any]], columns: Collection[str] = tuple(COLUMNS)
) -> None:
    """Write the table of signals with these columns in their order, as far as every row has them."""
    size = pl.col("fault_size_mm")
    level = pl.when(size == 0.0).then(0).otherwise(size.rank("dense").over("fault_type"))
    table = pl.DataFrame(rows, infer_schema_length=None)
    # A column holds something in every row, or is not there.
    table = table.select(each for each in table if not each.null_count())
    table = table.with_columns(level.cast(pl.Int64).alias("fault_severity_level"))
    table = table.select(name for name in columns if name in table.columns)
    path = folder / "metadata.parquet"
    with writing_to(path):
        interrupted_once(lambda: table.write_parquet(path))


def card_of(
    dataset: str, rows: list[dict[str, Any]], digests: Mapping[str, str], columns: Mapping[str, str] = COLUMNS
) -> dict[str, Any]:  # fmt: skip
    """Return the card: counts, what columns mean, and a hash of all signals by those of each."""
    listing = "".join(f"{name}:{digests[name]}\n" for name in sorted(digests))
    there = {name for row in rows for name in row} | {"fault_severity_level"}
    return {
        "dataset": dataset,
        "schema_version": SCHEMA_VERSION,
        "built_at": datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%S"),
        "content_hash": hashlib.sha256(listing.encode()).hexdigest(),
        "n_recordings": len({row["recording_id"] for row in rows}),
        "n_signals": len(rows),
        "columns": {name: meaning for name, meaning in columns.items() if name in there},
        "raw_files": [],
    }


def as_page(card: Mapping[str, Any]) -> str:
    """Return the card as a page."""
    lines = [
        f"# {card['dataset']}: {card['title']}",
        f"{card['n_recordings']} recordings, {card['n_signals']} signals, made on {card['built_at'][:10]}.",
        f"Licence: {card['license']}.",
        f"{card['citation']}",
        f"Left out: {card['left_out']} cases in which no ball came to a defect in time.",
        "`manifest.json` has the hash of each case's scene, and what the columns of `metadata.parquet` mean.",
    ]
    return "\n\n".join(lines) + "\n"
