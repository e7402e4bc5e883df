"""Files of the paper's cases: numbers, tables, signals and the page."""

from __future__ import annotations

import importlib.util
import json
import math
from typing import TYPE_CHECKING, Any

from .._base.libraries import pl
from .._io.files import check_writable
from .._io.whole import whole
from .comparison import AXIAL_LOADS
from .page import page

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from .case import Case
    from .study import Paper


def write(paper: Paper, folder: Path, *, numbers_only: bool = False) -> list[Path]:
    """Write ``paper.json`` and, unless it is to be alone, tables, signals and the page with the figures.

    The page (:func:`write_page`) is left out without plotly.

    Returns
    -------
    list of Path
        The files written.
    """
    check_writable(folder / "paper.json" if folder.exists() else folder)
    folder.mkdir(exist_ok=True)
    written = [folder / "paper.json"]
    with whole(written[-1]) as temporary:
        temporary.write_text(dumps(paper), encoding="utf-8")
    if numbers_only:
        return written
    for name, table in _tables(paper).items():
        written.append(folder / name)
        with whole(written[-1]) as temporary:
            table.write_csv(temporary)
    for name, case in paper.cases.items():
        written.append(folder / f"axial_{AXIAL_LOADS[name]:.0f}N.parquet")
        case.signals.write_parquet(written[-1])
    if importlib.util.find_spec("plotly") is not None:
        written.append(write_page(paper, folder))
    return written


def write_page(paper: Paper, folder: Path) -> Path:
    """Write the page with figures 5 to 11, ``paper.html``, and return its path; it needs plotly.

    Each figure stands under what the paper says of it beside our number.
    """
    path = folder / "paper.html"
    text = page(paper)
    check_writable(path if folder.exists() else folder)
    folder.mkdir(exist_ok=True)
    with whole(path) as temporary:
        temporary.write_text(text, encoding="utf-8")
    return path


def dumps(paper: Paper) -> str:
    """Return every number as JSON; what is not a number becomes null."""
    return json.dumps(_finite(paper.to_dict()), indent=2, ensure_ascii=False) + "\n"


def _finite(value: Any) -> Any:
    match value:
        case dict():
            return {key: _finite(entry) for key, entry in value.items()}
        case list():
            return [_finite(entry) for entry in value]
        case float() if not math.isfinite(value):
            return None
    return value


def _tables(paper: Paper) -> dict[str, pl.DataFrame]:
    def stacked(of: Callable[[Case], pl.DataFrame]) -> pl.DataFrame:
        return pl.concat(
            of(case).select(pl.lit(AXIAL_LOADS[name]).alias("axial_load"), pl.all())
            for name, case in paper.cases.items()
        )

    return {
        "comparison.csv": pl.DataFrame([line.to_dict() for line in paper.table]),
        "balls.csv": stacked(lambda case: case.snapshot.balls.to_polars()),
        "slices.csv": stacked(lambda case: pl.DataFrame(dict(case.snapshot.slices))),
    }
