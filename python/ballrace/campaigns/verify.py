"""Every byte of a campaign's folder, checked against the hashes in it."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path

from .._base.libraries import pl
from .._io.files import as_path
from .._io.parquet import scan_sealed
from ..errors import CampaignError
from . import description
from .shards import check_shard, names, shard_of_results


def verify(folder: str | os.PathLike[str]) -> pl.DataFrame:
    """Read every file of a campaign's folder, finished or not, damaged or not, and say which are what was written.

    Parameters
    ----------
    folder : path
        The folder.

    Returns
    -------
    polars.DataFrame
        A line a file: ``file``, its path within the folder, and ``problem``, empty for one that is sound.

    Raises
    ------
    CampaignError
        It is no folder of a campaign.
    """
    root = as_path(folder, "folder").resolve()
    if not any((root / name).exists() for name in (*description.NAMES, "cases.parquet")):
        raise CampaignError(f"{root}: holds no campaign; campaign.json is missing")
    return pl.DataFrame(
        list(_files(root)), schema={"file": pl.String, "problem": pl.String}, orient="row"
    )


def _files(root: Path) -> Iterator[tuple[str, str | None]]:
    for name in description.NAMES:
        yield name, _problem(description.read, root / name)
    yield "cases.parquet", _problem(scan_sealed, root / "cases.parquet")
    if (root / "manifest.parquet").exists():  # a campaign that goes on has none
        yield "manifest.parquet", _problem(scan_sealed, root / "manifest.parquet")
    for name in sorted(names(root, "results")):
        yield f"results/{name}", _problem(shard_of_results, root / "results" / name)
    there = names(root, "signals")
    for name in sorted(there | _lost(root, there)):
        yield f"signals/{name}", _problem(check_shard, root / "signals" / name)


def _problem(check: Callable[[Path], object], path: Path) -> str | None:
    try:
        check(path)
    except FileNotFoundError:
        return "missing"
    except ValueError as error:
        return f"damaged ({error})"
    except (CampaignError, OSError) as error:
        return str(error)
    return None


def _lost(root: Path, there: set[str]) -> set[str]:
    """Return the shards of signals that rows of sound shards name and that are not there.

    A case that ran again has rows of both times: those of the first may name what was set aside.
    """
    named: dict[str, set[str]] = {}
    for name in names(root, "results"):
        with suppress(OSError, ValueError, CampaignError):
            rows, _ = shard_of_results(root / "results" / name)
            for case, signals in rows.select("case_id", "signals").drop_nulls().iter_rows():
                named.setdefault(case, set()).add(signals)
    return {one for of_case in named.values() if not of_case & there for one in of_case}
