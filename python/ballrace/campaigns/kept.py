"""Contents of a campaign's folder: its manifest, and scenes and signals case by case."""

from __future__ import annotations

import json
from functools import cached_property
from typing import TYPE_CHECKING, Any

from .._base.libraries import pl
from .._base.text import printable
from .._io.parquet import collected
from ..scene import Scene
from .cases import apply
from .columns import BASE, BUDGET, found_in
from .measured import as_signals
from .verify import verify

if TYPE_CHECKING:
    from pathlib import Path

    from ..signals import Signals
    from .store import Store


class Kept:
    """A campaign's folder, read; the part of :class:`ballrace.campaigns.Campaign` that only looks."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self._cases = store.read_table("cases.parquet")
        self._clipped: dict[str, float] = {}

    @property
    def folder(self) -> Path:
        """The folder."""
        return self._store.root

    @cached_property
    def _results(self) -> pl.DataFrame:
        return self._store.results()

    @property
    def manifest(self) -> pl.DataFrame:
        """Table of the cases, one row a case, in the order of the campaign's table.

        ``case_id``; the table's own columns; ``fault_outer_race``, ``fault_inner_race``, ``fault_ball``: whether a
        loaded contact met such a defect in the run, empty where no ball passed it or there was no run;
        ``status``: ``ok``, ``failed`` or ``missing``; ``error`` and ``message`` of a failed case; ``warnings``:
        why a case that ran needs a check, empty for most (those of :class:`ballrace.AccuracyWarning` and
        :class:`ballrace.SceneWarning`, joined by semicolons); ``version`` of the solver; ``accepted``,
        ``rejected``, ``nfev``: steps and evaluations; ``wall_time`` [s]; ``acceleration_residual``,
        ``truncated_contacts``: measures of accuracy, as in ``out.stats``; ``simd``: the vector instructions it
        used;
        ``signals``: the shard that holds them; the features with their standard errors, and ``turns``,
        ``row0.passes`` and ``batches`` that these come from (see :func:`ballrace.campaign`); and of every defect
        with a width, such as ``defects.spall``: ``.placed_at``, its axial place [m], ``.passes`` of balls,
        ``.touched``, the share of them in which a contact was loaded within it, and its ``.largest_load`` [N]
        (see :class:`ballrace.signals.Touched`); last ``measured_clipped``: the largest share of the samples of a
        case that was beyond the range of a logger in what this object has measured (:meth:`measurements`,
        :meth:`measure`, :meth:`windows`). Features that no case has are left out, such as lines for which all
        records are too short. The file ``manifest.parquet`` has all but ``measured_clipped``;
        its metadata have ``ballrace.digest``, by which those who read it without this package can check it (see
        the guide).
        """
        if not self._clipped:
            return self._finished
        columns = {"case_id": pl.String, "measured_clipped": pl.Float64}
        shares = pl.DataFrame(list(self._clipped.items()), schema=columns, orient="row")
        return self._finished.join(shares, on="case_id", how="left", maintain_order="left")

    @cached_property
    def _finished(self) -> pl.DataFrame:
        """The manifest as it is written."""
        results = self._results
        kept = (name for name in results.columns if name not in (*BASE, *BUDGET))
        features = sorted(found_in(results, kept))
        return (
            self._cases.drop("changes")
            .join(
                results.select(*BASE, *features),
                on="case_id",
                how="left",
                maintain_order="left",
            )
            .with_columns(pl.col("status").fill_null("missing"))
        )

    @property
    def failed(self) -> pl.DataFrame:
        """The rows of the manifest that failed."""
        return self.manifest.filter(status="failed")

    @property
    def warned(self) -> pl.DataFrame:
        """The rows of the manifest that ran but need a check."""
        return self.manifest.filter(pl.col("warnings").is_not_null())

    def scan(self) -> pl.LazyFrame:
        """Return the kept signals of all cases, lazily: ``case_id``, ``t`` [s] and the probes' columns.

        Sorted by case and time. Only what a query needs is read: filter by ``case_id`` and select columns before
        collecting. Before that every shard is checked against its hash, once: about a second a gigabyte.

        Raises
        ------
        FileNotFoundError
            No signals were kept.
        CampaignError
            A shard is missing or damaged.
        """
        kept = self.manifest.filter(pl.col("signals").is_not_null()).unique(
            "case_id", maintain_order=True
        )
        if kept.is_empty():
            raise FileNotFoundError(f'{self.folder}: no signals; run with keep="signals"')
        frames = []
        for (name,), rows in kept.group_by("signals", maintain_order=True):
            shard = pl.scan_parquet(self._store.signals(str(name)), glob=False)
            # Not those of a case that another shard has as well.
            frames.append(shard.filter(pl.col("case_id").is_in(rows["case_id"].to_list())))
        return pl.concat(frames, how="diagonal").sort("case_id", "t")

    def signals(self, case_id: str) -> pl.DataFrame:
        """Return the signals of a case: ``t`` [s] and the probes' columns.

        Raises
        ------
        KeyError
            There is no such case with signals.
        CampaignError
            The shard that holds them is missing or damaged.
        """
        row = self._finished.filter(pl.col("case_id") == case_id, pl.col("signals").is_not_null())
        if row.is_empty():
            raise KeyError(f"no case {case_id!r} with signals")
        shard = pl.scan_parquet(self._store.signals(row["signals"][0]), glob=False)
        return collected(shard.filter(pl.col("case_id") == case_id).drop("case_id").sort("t"))

    def scene(self, case_id: str) -> Scene:
        """Return the scene of a case.

        Raises
        ------
        KeyError
            There is no such case.
        SceneError
            The case failed because it has none that is usable.
        """
        return Scene.from_json(self._applied(case_id)[0])

    def _applied(self, case_id: str) -> tuple[str, str]:
        """Return the scene of a case and the arguments of its run, as JSON."""
        rows = self._cases.filter(case_id=case_id)
        if rows.is_empty():
            raise KeyError(f"no case {case_id!r}")
        changes: dict[str, Any] = json.loads(rows["changes"][0])
        identity = self._store.identity
        return apply(changes, identity["scenes"], identity["run"])

    def run_of(self, case_id: str) -> Signals:
        """Return the signals of a case with their scene and sampling rate, for functions that take a run.

        Units, statistics and provenance are empty: the manifest has what a campaign keeps of them.

        Raises
        ------
        KeyError
            There is no such case with signals.
        CampaignError
            The shard that holds them is missing or damaged.
        """
        table = self.signals(case_id)
        scene, run = self._applied(case_id)
        return as_signals(table, json.loads(run)["fs"], Scene.from_json(scene))

    @property
    def parameters(self) -> tuple[str, ...]:
        """Columns of the table that the campaign ran: fields of the scene, and labels."""
        return tuple(n for n in self._cases.columns if n not in ("case_id", "changes"))

    def status(self) -> str:
        """Return how many cases have finished, failed and are missing, in one line."""
        counts = dict(self.manifest["status"].value_counts().iter_rows())
        parts = [f"{counts.get(kind, 0)} {kind}" for kind in ("ok", "failed", "missing")]
        warned = f" ({self.warned.height} with warnings)" if self.warned.height else ""
        parts[0] += warned
        return printable(f"{self.folder}: {self.manifest.height} cases: {', '.join(parts)}")

    def verify(self) -> pl.DataFrame:
        """Read every byte of the folder and say which files are what was written.

        Called again, :func:`ballrace.campaign` mends what is not, and runs the cases of damaged shards again.

        Returns
        -------
        polars.DataFrame
            A line a file: ``file``, its path within the folder, and ``problem``, empty for one that is sound.

        Examples
        --------
        >>> import ballrace as br, tempfile
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     done = br.campaign([{}], folder, scene=br.presets.wheel_bearing(), duration=1e-3, progress=False)
        ...     done.verify()["problem"].to_list()
        [None, None, None, None, None]
        """
        return verify(self.folder)
