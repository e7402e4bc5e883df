"""Records of a recipe: simulated, measured by several chains, the same number of each class that was met."""

from __future__ import annotations

import math
import os
import sys
import warnings
from dataclasses import dataclass, replace
from functools import cached_property
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import numpy as np

from .._base.numbers import counted, real
from .._base.polars import pl
from ..campaigns import Campaign, campaign
from ..campaigns.progress import duration as spoken
from ..channel import Channel
from ..errors import CampaignWarning, SceneError
from ..measuring import Chain, Logger
from ..measuring.named import Chains, named_chains
from .cases import Drawing
from .recipe import SURFACES, Recipe

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numpy.typing import NDArray

    from ..campaigns import Progress
    from .envelope_lines import EnvelopeLines

SKIP = 0.03
"""Beginning of a measurement in which path and sensor ring up [s]: five times 1/(2 ζ f) of 800 Hz at 1 %."""
OVERSAMPLED = 2
"""Rate of the runs over that of the records, which leaves room for modes and sensor."""
_ROUNDS = 4
"""How often more cases are drawn for a class whose faults are not met often enough."""
_SPARE = 1.25
_TRIALS, _MANY = 3, 100
"""Runs of each class that an estimate comes from where there are many to do; of few one."""


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Simulated:
    """Simulated records of a recipe.

    Attributes
    ----------
    recipe : Recipe
        What was drawn.
    campaign : Campaign
        The runs, on disk.
    cases : polars.DataFrame
        The runs that count, as many of each class: rows of the campaign's manifest with the column ``label``.
    chains : dict of str to Chain
        The machines: measuring chains of the records.
    fs : float
        Sampling rate of the records [Hz].
    window : float
        Length of a record [s].
    per_case : int
        How many of the machines measure each run.
    seed : int
        Seed of the noise, and of which machines measure which run.
    """

    recipe: Recipe
    campaign: Campaign
    cases: pl.DataFrame
    chains: dict[str, Chain]
    fs: float
    window: float
    per_case: int
    seed: int

    def __repr__(self) -> str:
        counts = self.windows["label"].value_counts(sort=True).sort("label").iter_rows()
        listed = ", ".join(f"{name} {count}" for name, count in counts)
        return f"<Simulated: {self.recipe.made.designation}, {self.window:g} s at {self.fs:g} Hz: {listed}>"

    @property
    def turns(self) -> float:
        """Turns of the shaft in a record, at the middle speed."""
        return self.window * sum(self.recipe.speed) / 120.0

    @cached_property
    def windows(self) -> pl.DataFrame:
        """The records, a line each.

        As of :meth:`ballrace.campaigns.Campaign.windows`, with ``label`` (the class, by what was met),
        ``bearing_id``, ``shape``, ``size_mm`` and ``shaft`` [Hz]. :func:`ballrace.learn.examples` makes arrays of
        it, :func:`ballrace.bearing_split` splits it by bearing.
        """
        records = self.campaign.windows(
            self.chains,
            round(self.window * self.fs),
            seed=self.seed,
            per_case=self.per_case,
            skip=SKIP,
            labels=(),
        )
        shaft = pl.col("drive.speed") / (2.0 * math.pi)
        labelled = self.cases.select(
            "case_id", "label", "bearing_id", "shape", "size_mm", shaft.alias("shaft")
        )
        return records.join(labelled, on="case_id", how="inner", maintain_order="left")

    def channels(self) -> Iterator[Channel]:
        """Yield the records, in the order of :attr:`windows`."""
        for x, shaft in self.windows.select("x", "shaft").iter_rows():
            samples = np.asarray(x, dtype=np.float64)
            yield Channel(x=samples, fs=self.fs, name="sensor", unit="m/s^2", shaft=shaft)

    def features(
        self, lines: EnvelopeLines | None = None
    ) -> tuple[NDArray[np.float32], NDArray[Any], NDArray[np.int64]]:
        """Return the features of all records, their classes and their bearings.

        Parameters
        ----------
        lines : EnvelopeLines, optional
            Which features; the bearing is the recipe's where it names none.

        Returns
        -------
        X : ndarray of float32, shape (n, features)
            Features.
        y : ndarray of str, shape (n,)
            Classes: ``healthy``, ``outer_race``, ``inner_race``, ``ball``.
        groups : ndarray of int64, shape (n,)
            Numbers of the bearings. Records of one bearing, of whatever class, belong on one side of a split.
        """
        from .envelope_lines import EnvelopeLines

        chosen = (EnvelopeLines() if lines is None else lines).of(self.recipe.made)
        found = chosen.fit_transform(list(self.channels())).astype(np.float32)
        return found, self.windows["label"].to_numpy(), self.windows["bearing_id"].to_numpy()


def dataset(
    recipe: Recipe,
    folder: str | os.PathLike[str],
    *,
    per_class: int,
    machines: Chains,
    fs: float = 12_000.0,
    window: float = 0.5,
    per_case: int = 3,
    seed: int = 0,
    threads: int | None = None,
    progress: bool | Callable[[Progress], object] = True,
) -> Simulated:
    """Simulate records of a recipe: the same number of runs for each class, each of another bearing.

    It is a campaign (:func:`ballrace.campaign`): called again after a kill, or with more runs for each class, it
    runs only what is missing. The class of a run is the fault that a loaded contact *met*: runs in which none met
    the fault do not count, and further cases take their place. Bearing k has one set of surfaces, balls and
    clearance, and is once healthy and once damaged in each way.

    Parameters
    ----------
    recipe : Recipe
        What is drawn.
    folder : path
        Folder of the campaign.
    per_class : int
        Runs of each class.
    machines : Chain, mapping of str to Chain, or sequence of Chain
        Measuring chains, such as :func:`ballrace.measuring.random_chains` makes.
    fs : float
        Sampling rate of the records, 1000 to 200 000 [Hz].
    window : float
        Length of a record, at least five turns at the lowest speed [s].
    per_case : int
        How many of the machines, drawn by chance, measure each run, which gives as many records.
    seed : int
        Seed of everything that is drawn.
    threads : int, optional
        As of :func:`ballrace.campaign`.
    progress : bool or callable
        As of :func:`ballrace.campaign`; with True the expected time and records an hour, from a run of each class,
        are printed before it starts.

    Raises
    ------
    SceneError
        An argument is not usable; it names it.
    CampaignError
        The folder belongs to something else.

    Warns
    -----
    CampaignWarning
        A class is met too rarely to be filled, or a case failed.

    Examples
    --------
    >>> import ballrace as br, tempfile
    >>> recipe = br.learn.Recipe("6205", faults={"outer": (0.5, 2.0)})
    >>> machines = br.measuring.random_chains(2, seed=1)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     data = br.learn.dataset(
    ...         recipe, folder, per_class=1, machines=machines, window=0.17, per_case=2, progress=False
    ...     )
    ...     data
    <Simulated: 6205, 0.17 s at 12000 Hz: healthy 2, outer_race 2>
    """
    if not isinstance(recipe, Recipe):
        raise SceneError("recipe", repr(recipe), "a Recipe of br.learn")
    for name, value, least, most in (
        ("fs", fs, 1e3, 2e5), ("window", window, 300.0 / recipe.speed[0], 60.0),
    ):  # fmt: skip
        if not least <= real(value) <= most:
            raise SceneError(name, repr(value), f"{least:g} to {most:g}")
    chains = {
        name: replace(chain, logger=replace(chain.logger or Logger(), fs=fs))
        for name, chain in named_chains(machines).items()
    }
    per_case = counted("per_case", per_case, 1, len(chains))
    count, seed = counted("per_class", per_class, 1), counted("seed", seed, 0)
    drawing = Drawing(recipe, seed)
    making = _Making(drawing=drawing, folder=folder, count=count, options={
        "duration": window + SKIP, "fs": OVERSAMPLED * fs, "keep": "signals", "columns": ["housing.sensor.ay"],
        "threads": threads,
    })  # fmt: skip
    if progress is True:
        making.write_estimate(per_case)
    done, cases = making.run(progress)
    return Simulated(
        recipe=recipe,
        campaign=done,
        cases=cases,
        chains=chains,
        fs=fs,
        window=window,
        per_case=per_case,
        seed=seed,
    )


@dataclass(kw_only=True)
class _Making:
    """The campaign of a set of records, as it is being run."""

    drawing: Drawing
    folder: str | os.PathLike[str]
    count: int
    options: dict[str, Any]

    @property
    def kinds(self) -> list[str | None]:
        return [None, *self.drawing.recipe.faults]

    def run(self, progress: bool | Callable[[Progress], object]) -> tuple[Campaign, pl.DataFrame]:
        """Run cases until each class has enough that count; return the campaign and these."""
        wanted = dict.fromkeys(self.kinds, self.count)
        for _ in range(_ROUNDS):
            done = self._campaign(self._rows(wanted), progress=progress)
            cases = _counting(done.manifest)
            met = {kind: cases.filter(part=_part(kind)).height for kind in wanted}
            lacking = {kind: max(0, self.count - number) for kind, number in met.items()}
            if not any(lacking.values()):
                break
            wanted = {kind: n + math.ceil(_SPARE * lacking[kind]) for kind, n in wanted.items()}
        else:
            counts = ", ".join(f"{_part(kind)} {number}" for kind, number in met.items())
            text = f"{self.folder}: fewer than {self.count} runs of a class count: {counts}"
            warnings.warn(text, CampaignWarning, stacklevel=3)
        return done, pl.concat([cases.filter(part=_part(kind)).head(self.count) for kind in wanted])

    def write_estimate(self, per_case: int) -> None:
        """Write how long it takes, estimated from one run of each class."""
        rows = self._rows(dict.fromkeys(self.kinds, self.count))
        whole = self._campaign(rows, dry_run=True)
        if not whole.missing:
            return
        trials = _TRIALS if whole.missing > _MANY else 1
        firsts = [row for row in rows if row["bearing_id"] < trials]
        with TemporaryDirectory() as empty:
            each = [self._campaign([row], out=empty, dry_run=True).seconds for row in firsts]
        threads = self.options["threads"] or os.cpu_count() or 1
        seconds = sum(each) / len(each) * whole.missing / min(threads, whole.missing)
        rate = 3600.0 * per_case * whole.missing / seconds
        sys.stderr.write(
            f"dataset: {whole.missing} of {whole.total} runs to do, {per_case * whole.missing} records: about "
            f"{spoken(seconds)}, {rate:.0f} records an hour, {whole.bytes / 1e6:.3g} MB\n"
        )

    def _rows(self, wanted: dict[str | None, int]) -> list[dict[str, Any]]:
        return [self.drawing.row(kind, k) for kind, n in wanted.items() for k in range(n)]

    def _campaign(self, rows: list[dict[str, Any]], out: Any = None, **options: Any) -> Any:
        with warnings.catch_warnings():
            # Columns that are labels on purpose.
            warnings.filterwarnings("ignore", message="the column", category=CampaignWarning)
            return campaign(
                rows, out or self.folder, scene=self.drawing.scenes, **self.options, **options
            )


def _counting(manifest: pl.DataFrame) -> pl.DataFrame:
    """Return the cases that ran and met what they have, each with its class."""
    only = [
        pl.col(f"fault_{on}").fill_null(value=False) == (pl.col("part") == on)
        for on in SURFACES.values()
    ]
    return manifest.filter(pl.col("status") == "ok", *only).with_columns(
        pl.col("part").alias("label")
    )


def _part(kind: str | None) -> str:
    return "healthy" if kind is None else SURFACES[kind]
