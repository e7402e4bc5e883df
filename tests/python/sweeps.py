"""A small campaign that the tests of campaigns share, and how tables of results are compared."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import ballrace as br

if TYPE_CHECKING:
    from pathlib import Path

    import polars as pl

DURATION = 2e-3
"""Of a case [s]; some 20 ms of work."""

SCENE = br.presets.deep_groove_6205(500.0, 0.0, 1800.0).replace({"gravity": [0.0, 0.0, 0.0]})


def table(count: int) -> pl.DataFrame:
    """Return radial loads of which the first, none at all, has no equilibrium: there is no weight either."""
    return br.grid({"loads.radial.force": [100.0 * i for i in range(count)]})


def run(cases: object, out: Path, *, duration: float = DURATION, **options: Any) -> br.Campaign:
    options = {
        "scene": SCENE,
        "progress": False,
        "duration": duration,
        "settle": 0.0,
        **options,
    }
    found = br.campaign(cases, out, **options)
    assert isinstance(found, br.Campaign)
    return found


def comparable(manifest: pl.DataFrame) -> pl.DataFrame:
    """Leave out what may differ between two runs of the same cases: the clock, and names of shards."""
    return manifest.drop("wall_time", "signals")


def same(a: br.Campaign, b: br.Campaign) -> bool:
    """Say whether two campaigns have the same table, bit for bit."""
    return comparable(a.manifest).equals(comparable(b.manifest), null_equal=True)


def finished(folder: Path) -> int:
    """Return the number of cases that are safe in a folder."""
    return br.Campaign.open(folder).manifest.filter(status="ok").height
