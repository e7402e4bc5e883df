"""A set of records of thousands of simulated bearings, in the layout of ``bearing-datasets``.

::

    python -m ballrace.learn.corpus FOLDER --bearings 2000 --seed 1 --seconds 10 --fs 25600

Each bearing is one of 6000 to 6316 with surfaces, balls, play and a machine of its own
(:class:`ballrace.learn.Recipe`), one measuring chain (:func:`ballrace.measuring.random_chains`, half of the
sensors on the pedestal itself), and one state in four: healthy, or a fault of the outer race, the inner race or a
ball. It is recorded under several loads and speeds. Of each sixteen bearings four are for testing, one in each
state; a larger set has the same split.

A bearing is finished when its file in ``bearings`` is there, which has its rows, scenes and chain. Ctrl-C leaves
the table and the card of all that are; the next call goes on, and a larger ``--bearings`` adds to the set.
"""

from __future__ import annotations

import argparse
import json
import math
import shutil
import sys
import time
import warnings
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import AbstractContextManager, nullcontext
from dataclasses import asdict, dataclass, fields, is_dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .._base.libraries import MissingLibraryError, needed
from .._base.numbers import counted, real
from .._core import available_threads
from .._io.files import as_path
from ..campaigns import campaign
from ..campaigns.executors import executor_of
from ..campaigns.measured import measured
from ..campaigns.progress import duration as spoken
from ..campaigns.work import version
from ..datasets.layout import COLUMNS, SCHEMA_VERSION
from ..datasets.reading import BearingDataset, read_bearing_dataset
from ..datasets.rows import sensor_row
from ..datasets.writing import as_page, card_of, digest_of, write_block, write_table
from ..errors import BallraceError, CampaignWarning, SceneError
from .corpus_plan import BLOCK, OWN, Plan, drawing_of, for_testing
from .data import SKIP

if TYPE_CHECKING:
    import os
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from ..campaigns import Campaign
    from ..measuring import Chain

_AT_ONCE = 4
"""Runs of a batch for each that runs at once: their signals are on disk until they are measured."""


def make_corpus(
    folder: str | os.PathLike[str],
    *,
    bearings: int = 100,
    seed: int = 0,
    seconds: float = 10.0,
    fs: float = 25_600.0,
    records: int = 4,
    workers: int | None = None,
    executor: Any = None,
    progress: bool = True,
) -> BearingDataset:
    """Simulate and measure bearings that are not there yet, and write the table of all that are.

    Parameters
    ----------
    folder : path
        Folder of the set, made if it does not exist.
    bearings : int
        How many the set has in the end.
    seed : int
        Seed of all that is drawn.
    seconds : float
        Length of a record, 0.1 to 600 [s].
    fs : float
        Sampling rate of the records, 1000 to 100 000 [Hz].
    records : int
        Records of a bearing, each under a load and at a speed of its own.
    workers : int, optional
        Runs at once on this machine; by default all cores, or those of the executor.
    executor : optional
        As of :func:`ballrace.campaign`, such as a Dask ``Client``: there runs are simulated, and measured here.
    progress : bool
        Whether a line a batch says how far it is.

    Returns
    -------
    BearingDataset
        The set.

    Raises
    ------
    SceneError
        An argument is not usable, or the folder has a set that was drawn by others.
    CampaignError
        A folder of runs is not usable.
    OSError
        The folder cannot be written.
    KeyboardInterrupt
        Ctrl-C; finished bearings are in the set.

    Warns
    -----
    CampaignWarning
        Bearings have no record.
    """
    plan = _plan(seed, seconds, fs, records)
    count = counted("bearings", bearings, 1)
    threads = None if workers is None else counted("workers", workers, 1)
    making = _Making(plan, _prepared(as_path(folder), plan), executor, threads)
    missing = [number for number in range(count) if not making.file(number).exists()]
    try:
        without = making.run(missing, progress)
    except KeyboardInterrupt:
        there = making.write_set()
        text = (
            f"interrupted; {there} of {count} bearings are in {making.folder}; call again to go on"
        )
        raise KeyboardInterrupt(text) from None
    making.write_set()
    if without:
        text = f"{making.folder}: {len(without)} bearings have no record, such as {without[0]}"
        warnings.warn(text, CampaignWarning, stacklevel=2)
    return read_bearing_dataset(making.folder)


def _plan(seed: int, seconds: float, fs: float, records: int) -> Plan:
    """Return what a set is drawn by, checked."""
    for name, value, least, most in (("seconds", seconds, 0.1, 600.0), ("fs", fs, 1e3, 1e5)):
        if not least <= real(value) <= most:
            raise SceneError(name, repr(value), f"{least:g} to {most:g}")
    count = counted("records", records, 1, 1000)
    return Plan(seed=counted("seed", seed, 0), seconds=float(seconds), fs=float(fs), records=count)


def _prepared(folder: Path, plan: Plan) -> Path:
    """Return the folder with what its set is drawn by."""
    path, wanted = folder / "corpus.json", asdict(plan)
    if path.exists():
        there = json.loads(path.read_text(encoding="utf-8"))
        for name, value in wanted.items():
            if there.get(name) != value:
                allowed = f"that of the set in {folder}, {there.get(name)!r}"
                raise SceneError(name, repr(value), allowed)
    elif folder.exists() and any(folder.iterdir()):
        raise SceneError("folder", str(folder), "a new or empty folder, or one of this command")
    for part in ("signals", "bearings"):
        (folder / part).mkdir(parents=True, exist_ok=True)
    _put(path, json.dumps(wanted, indent=1))
    return folder


def _put(path: Path, text: str) -> None:
    """Write a file whole or not at all."""
    written = path.with_name(f".{path.name}.tmp")
    written.write_text(text + "\n", encoding="utf-8")
    written.replace(path)


@dataclass
class _Making:
    """A set as it is being made."""

    plan: Plan
    folder: Path
    executor: Any
    threads: int | None

    def file(self, number: int) -> Path:
        """Return the file of a bearing that is there once it is finished."""
        return self.folder / "bearings" / f"{number:06}.json"

    def run(self, missing: list[int], progress: bool) -> list[int]:
        """Make bearings, batch by batch; return those without a record."""
        began, without = time.monotonic(), []
        size = max(1, math.ceil(_AT_ONCE * self._parallel() / self.plan.records))
        for first in range(0, len(missing), size):
            batch = missing[first : first + size]
            without += self._batch(batch)
            done = first + len(batch)
            if progress:
                left = (time.monotonic() - began) / done * (len(missing) - done)
                text = f"corpus: {done} of {len(missing)} bearings, {spoken(left)} to go\n"
                sys.stderr.write(text)
        shutil.rmtree(self.folder / "runs", ignore_errors=True)
        return without

    def _parallel(self) -> int:
        """Return how many runs there are at once."""
        threads = self.threads or (available_threads() if self.executor is None else 1)
        return threads * (1 if self.executor is None else executor_of(self.executor)[1] or 1)

    def _batch(self, batch: list[int]) -> list[int]:
        """Simulate, measure and write bearings; return those without a record."""
        found = {number: self.plan.rows(number) for number in batch}
        scenes = {
            f"{name} {kind}": scene
            for name in sorted({name for name, _ in found.values()})
            for kind, scene in drawing_of(name, self.plan.seed).scenes.items()
        }
        runs = self.folder / "runs" / f"{batch[0]}-{batch[-1]}-{len(batch)}"
        with warnings.catch_warnings():
            # Columns that are labels on purpose.
            warnings.filterwarnings("ignore", message="the column", category=CampaignWarning)
            rows = [row for _, own in found.values() for row in own]
            done = campaign(
                rows, runs, scene=scenes, threads=self.threads, executor=self.executor, **self.plan.options
            )  # fmt: skip
        with ThreadPoolExecutor(min(len(batch), available_threads())) as pool:
            written = list(
                pool.map(lambda number: self._write(done, number, found[number][0]), batch)
            )
        shutil.rmtree(runs)
        return [number for number, there in zip(batch, written, strict=True) if not there]

    def _write(self, done: Campaign, number: int, name: str) -> bool:
        """Measure and write a bearing; return whether it has a record."""
        cases = [
            case
            for case in done.manifest.filter(bearing_id=number, status="ok").iter_rows(named=True)
            # Labels are empty where no ball passed the fault.
            if None not in (value for key, value in case.items() if key.startswith("fault_"))
        ]
        if not cases:
            return False
        where, chain = self.plan.chain(number)
        by_id = {case["case_id"]: case for case in cases}
        runs = ((case_id, done.run_of(case_id)) for case_id in by_id)
        rows: list[dict[str, Any]] = []
        block: list[tuple[str, NDArray[np.float32]]] = []
        scenes: dict[str, Any] = {}
        for k, line in enumerate(
            measured(runs, {where: chain}, seed=self.plan.seed, per_case=None)
        ):
            row = self._row(line, by_id[line.case_id], f"{number:06}-{k:02}")
            samples = self._samples(line.measurement.x)
            name_of = f"{row['recording_id']}/{row['channel']}"
            place = {
                "signal_id": name_of, "n_samples": samples.size,
                "signal_file": f"{number:06}.parquet", "signal_row_group": 0, "signal_row": len(block),
            }  # fmt: skip
            rows.append(row | place | {"sha256": digest_of(samples)})
            block.append((name_of, samples))
            scenes[row["recording_id"]] = json.loads(line.scene.to_json())
        signals = self.folder / "signals" / f"{number:06}.parquet"
        temporary = signals.with_name(f".{signals.name}.tmp")
        write_block(temporary, block)
        temporary.replace(signals)
        document = {
            "designation": name, "ballrace": version(), "chain": _described(chain), "rows": rows, "scenes": scenes,
        }  # fmt: skip
        _put(self.file(number), json.dumps(document, indent=1))
        return True

    def _row(self, line: Any, case: dict[str, Any], recording_id: str) -> dict[str, Any]:
        number = int(case["bearing_id"])
        own = {
            "bearing_id": f"{number:06}",
            "split": "test" if number in for_testing(self.plan.seed, number // BLOCK) else "train",
            "radial_load": case["loads.radial.force"], "axial_load": case["loads.axial.force"],
            "damage_shape": case["shape"], "case_id": case["case_id"], "chain": line.chain,
            "range": line.measurement.range,
        }  # fmt: skip
        return sensor_row(line, case, recording_id) | own

    def _samples(self, x: NDArray[np.float64]) -> NDArray[np.float32]:
        """Return a record without its beginning, in which path and sensor ring up."""
        first = math.ceil(SKIP * self.plan.fs)
        return x[first : first + round(self.plan.seconds * self.plan.fs)].astype(np.float32)

    def write_set(self) -> int:
        """Write the table and the card of finished bearings; return how many there are."""
        files = sorted((self.folder / "bearings").glob("[0-9]*.json"))
        documents = [json.loads(path.read_text(encoding="utf-8")) for path in files]
        if not documents:
            return 0
        name = self.folder.resolve().name
        rows = [{"dataset": name} | row for document in documents for row in document["rows"]]
        columns = COLUMNS | OWN
        temporary = self.folder / ".table"
        temporary.mkdir(exist_ok=True)
        write_table(temporary, rows, columns)
        (temporary / "metadata.parquet").replace(self.folder / "metadata.parquet")
        temporary.rmdir()
        versions = sorted({document["ballrace"] for document in documents})
        card = card_of(name, rows, {row["signal_id"]: row["sha256"] for row in rows}, columns) | {
            "title": f"{len(documents)} simulated bearings, 6000 to 6316", "license": "unspecified",
            "citation": f"Simulated with ballrace {', '.join(versions)}.",
            "left_out": self.plan.records * len(documents) - len(rows), "n_bearings": len(documents),
            "hours": sum(row["n_samples"] / row["fs"] for row in rows) / 3600.0,
            "counts": _counts(rows), **asdict(self.plan),
        }  # fmt: skip
        assert card["schema_version"] == SCHEMA_VERSION
        _put(self.folder / "manifest.json", json.dumps(card, indent=1))
        _put(self.folder / "README.md", as_page(card))
        return len(documents)


def _counts(rows: list[dict[str, Any]]) -> dict[str, int]:
    """Return the numbers of records by split and class."""
    names = [f"{row['split']}, {row['fault_type']}" for row in rows]
    return {name: names.count(name) for name in sorted(set(names))}


def _described(chain: Chain) -> dict[str, Any]:
    """Return a chain as JSON has it."""
    found: dict[str, Any] = json.loads(json.dumps(chain, default=_plain))
    return found


def _plain(value: Any) -> Any:
    if is_dataclass(value):
        return {field.name: getattr(value, field.name) for field in fields(value)}
    return dict(value) if isinstance(value, Mapping) else np.asarray(value).tolist()


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command and return its exit status: 0, 1 a run that failed, 2 bad input, 130 Ctrl-C."""
    parser = argparse.ArgumentParser(
        prog="python -m ballrace.learn.corpus", description=(__doc__ or "").splitlines()[0]
    )
    parser.add_argument("folder", help="folder of the set, new or one to go on with")
    parser.add_argument(
        "--bearings", type=int, default=100, metavar="N", help="default: %(default)s"
    )
    parser.add_argument("--seed", type=int, default=0, help="default: %(default)s")
    parser.add_argument(
        "--seconds", type=float, default=10.0, help="of a record (default: %(default)g)"
    )
    parser.add_argument(
        "--fs", type=float, default=25_600.0, help="sampling rate [Hz] (default: %(default)g)"
    )
    parser.add_argument(
        "--records", type=int, default=4, help="of a bearing (default: %(default)s)"
    )
    parser.add_argument("--workers", type=int, help="runs at once (default: all cores)")
    parser.add_argument("--dask", metavar="ADDRESS", help="scheduler that the runs are sent to")
    options = vars(parser.parse_args(arguments))
    address = options.pop("dask")
    try:
        with _client(address) as executor:
            print(make_corpus(**options, executor=executor))
    except KeyboardInterrupt as error:
        print(error or "interrupted", file=sys.stderr)
        return 130
    except SceneError as error:
        print(error, file=sys.stderr)
        return 2
    except (BallraceError, MissingLibraryError, OSError) as error:
        print(error, file=sys.stderr)
        return 1
    return 0


def _client(address: str | None) -> AbstractContextManager[Any]:
    """Return a client of a scheduler of Dask, or None, closed behind it."""
    if address is None:
        return nullcontext()
    client: AbstractContextManager[Any] = needed("distributed", "a scheduler", "campaign").Client(
        address
    )
    return client


if __name__ == "__main__":
    sys.exit(main())
