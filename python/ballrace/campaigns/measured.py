"""The kept signals of a campaign through measuring chains, without running anything again."""

from __future__ import annotations

import hashlib
import math
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._base.libraries import pl
from .._base.numbers import counted, positive, real
from .._results.features import features
from ..errors import AccuracyWarning, SceneError
from ..measuring.chain import CLIPPED, Measurement
from ..measuring.chain import measured as by_chain
from ..measuring.named import Chains, named_chains
from ..scene import Scene
from ..signals import Signals
from .columns import found_in


@dataclass(frozen=True, kw_only=True, eq=False)
class Measured:
    """A case as one chain measures it.

    Attributes
    ----------
    case_id, chain : str
        The case, and the name of the chain.
    scene : Scene
        The scene of the case.
    measurement : Measurement
        What was measured.
    """

    case_id: str
    chain: str
    scene: Scene
    measurement: Measurement

    def labels(self) -> dict[str, Any]:
        """Return what a line of a table says of it."""
        found = self.measurement
        return {
            "case_id": self.case_id,
            "chain": self.chain,
            "seed": found.seed,
            "sampling_rate": found.fs,
            "range": found.range,
            "clipped": found.clipped,
        }


def measured(
    runs: Iterator[tuple[str, Signals]], chains: Chains, *, seed: int, per_case: int | None
) -> Iterator[Measured]:
    """Measure runs, each with the id of its case, with every chain or some of them; warn once of those that clip.

    Raises
    ------
    SceneError
        There is no chain, or no such number of them.
    """
    named = named_chains(chains)
    if per_case is not None and not 1 <= real(per_case) <= len(named):
        raise SceneError("per_case", repr(per_case), f"None, or 1 to {len(named)}, the chains")
    count, clipped = 0, []
    for case_id, out in runs:
        for name in _drawn(list(named), per_case, f"{seed}/{case_id}"):
            own = _number(f"{seed}/{case_id}/{name}")
            found = by_chain(out, named[name], seed=own)
            count += 1
            clipped += [found.clipped] if found.clipped > CLIPPED else []
            yield Measured(case_id=case_id, chain=name, scene=out.scene, measurement=found)
    if clipped:
        text = (
            f"{len(clipped)} of {count} measurements have more than 0.1 % of their samples clipped, up to "
            f"{100.0 * max(clipped):.2g} %: their levels and lines are too small; leave out logger.range, and it "
            "fits each signal"
        )
        warnings.warn(text, AccuracyWarning, stacklevel=2)


def features_table(
    lines: Iterator[Measured], skip: float, band: tuple[float, float] | None
) -> pl.DataFrame:
    """Return a line for each measurement: its labels, and its features as ``sensor.rms`` and so on."""
    labels, found = [], []
    for line in lines:
        x, fs = line.measurement.x, line.measurement.fs
        labels.append(line.labels())
        found.append(features(x, fs, name="sensor", scene=line.scene, skip=skip, band=band))
    table = pl.DataFrame(found, infer_schema_length=None)
    left = pl.DataFrame(labels, infer_schema_length=None)
    return left.hstack(table.select(found_in(table, table.columns)))


def windows_table(
    lines: Iterator[Measured], length: int, hop: int | None, skip: float
) -> pl.DataFrame:
    """Return a table with a line for each window of each measurement.

    Raises
    ------
    SceneError
        The length, the hop or what is skipped is not usable.
    """
    length = counted("length", length, 1)
    hop = length if hop is None else counted("hop", hop, 1)
    positive("skip", skip, "s", zero=True)
    frames = []
    for line in lines:
        x = line.measurement.x
        first = math.ceil(skip * line.measurement.fs - 1e-9)
        starts = np.arange(first, x.size - length + 1, hop)
        if not starts.size:
            continue
        cut = np.lib.stride_tricks.sliding_window_view(x, length)[starts].astype(np.float32)
        labels = {name: [value] * starts.size for name, value in line.labels().items()}
        times = line.measurement.start + starts / line.measurement.fs
        frames.append(pl.DataFrame(labels | {"start": times, "x": cut}))
    if not frames:
        raise SceneError("length", str(length), "at most the samples of a measurement behind skip")
    return pl.concat(frames)


def _drawn(names: list[str], count: int | None, key: str) -> list[str]:
    """Return all names, or some of them by chance, in their order."""
    if count is None:
        return names
    rng = np.random.default_rng(_number(key))
    return [names[i] for i in sorted(rng.choice(len(names), count, replace=False))]


def _number(key: str) -> int:
    """Return a seed that belongs to a text, the same everywhere."""
    return int.from_bytes(hashlib.blake2b(key.encode(), digest_size=6).digest(), "big")


def as_signals(table: pl.DataFrame, fs: float, scene: Scene) -> Signals:
    """Return the kept samples of a case as signals of its scene."""
    columns = {name: table[name].to_numpy() for name in table.columns if name != "t"}
    return Signals(
        fs=fs,
        t=table["t"].to_numpy(),
        columns=columns,
        units={},
        scene=scene.to_json(),
        stats={},
        provenance={},
    )
