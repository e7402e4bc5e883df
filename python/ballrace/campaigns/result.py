"""Results of a campaign."""

from __future__ import annotations

import json
from functools import cached_property
from typing import TYPE_CHECKING, Any

from .._html import paragraph
from .._io.files import as_path
from .._io.parquet import collected
from .._text import printable
from ..errors import SceneError
from ..scene import Scene
from .cases import apply
from .measured import Measured, as_signals, features_table, measured, windows_table
from .store import BASE, BUDGET, FAULTS, Store, without_empty_errors
from .verify import verify

if TYPE_CHECKING:
    import os
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    import polars as pl

    from ..measuring.named import Chains
    from ..signals import Signals

__all__ = ["Campaign"]

_FEW = 10
"""Rows of the manifest that a notebook shows."""


class Campaign:
    """A campaign's folder, read: the manifest, and signals case by case.

    Returned by :func:`ballrace.campaign`; :meth:`open` reads a folder that one has left, finished or not.
    """

    def __init__(self, store: Store) -> None:
        self._store = store
        self._cases = store.read_table("cases.parquet")
        self._clipped: dict[str, float] = {}

    @classmethod
    def open(cls, folder: str | os.PathLike[str]) -> Campaign:
        """Read the folder of a campaign.

        Raises
        ------
        CampaignError
            It holds none, or a file is damaged.
        """
        return cls(Store(as_path(folder, "folder")))

    @property
    def folder(self) -> Path:
        """The folder."""
        return self._store.root

    @cached_property
    def _results(self) -> pl.DataFrame:
        return self._store.results()

    @property
    def manifest(self) -> pl.DataFrame:
        """One row a case, in the order of the table.

        ``case_id``; the table's own columns; ``fault_outer_race``, ``fault_inner_race``, ``fault_ball``: whether a
        loaded contact met such a defect in the run, empty where no ball passed it or there was no run;
        ``status``: ``ok``, ``failed`` or ``missing``; ``error`` and ``message`` of a failed case; ``warnings``:
        why to look twice at one that ran, empty for most (those of :class:`ballrace.AccuracyWarning` and
        :class:`ballrace.SceneWarning`, joined by semicolons); ``version`` of the solver; ``accepted``,
        ``rejected``, ``nfev``: its effort; ``wall_time`` [s]; ``acceleration_residual``, ``truncated_contacts``:
        what accuracy is judged by, as in ``out.stats``; ``simd``: the vector instructions it ran on;
        ``signals``: the shard that holds them; the features with their standard errors, and ``turns``,
        ``row0.passes`` and ``batches`` that these come from (see :func:`ballrace.campaign`); and of every defect
        with a width, such as ``defects.spall``: ``.placed_at``, its axial place [m], ``.passes`` of balls,
        ``.touched``, the share of them in which a contact was loaded within it, and its ``.largest_load`` [N]
        (see :class:`ballrace.Touched`); last ``measured_clipped``: the largest share of the samples of a case that
        was beyond the range of a logger in what this object has measured (:meth:`measurements`, :meth:`measure`,
        :meth:`windows`), empty until then. The file ``manifest.parquet`` has all but that column; its metadata
        have ``ballrace.digest``, by which those who read it without this package can check it (see the guide).
        """
        from .._polars import pl

        shares = pl.DataFrame(
            {"case_id": list(self._clipped), "measured_clipped": list(self._clipped.values())},
            schema={"case_id": pl.String, "measured_clipped": pl.Float64},
        )
        return self._finished.join(shares, on="case_id", how="left", maintain_order="left")

    @cached_property
    def _finished(self) -> pl.DataFrame:
        """The manifest as it is written."""
        from .._polars import pl

        results = without_empty_errors(self._results)
        features = sorted(name for name in results.columns if name not in (*BASE, *BUDGET))
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
        """The rows of the manifest that ran, but want a second look."""
        from .._polars import pl

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
        from .._polars import pl

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
        from .._polars import pl

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

    def measurements(
        self, chains: Chains, *, seed: int = 0, per_case: int | None = None
    ) -> Iterator[Measured]:
        """Measure every case whose signals were kept, one after the other; nothing is run again.

        Parameters
        ----------
        chains : Chain, mapping of str to Chain, or sequence of Chain
            Measuring chains, such as one for each of many housings; those without a name are numbered from 0.
        seed : int
            Every case and chain has its own noise, which follows from this seed.
        per_case : int, optional
            How many of the chains, drawn by chance, measure each case; by default all.

        Yields
        ------
        Measured
            ``case_id``, ``chain``, ``scene`` and ``measurement``.

        Raises
        ------
        SceneError
            An argument is not usable, or a column was not recorded.
        """
        kept = self._finished.drop_nulls("signals")["case_id"].unique(maintain_order=True)
        runs = ((case_id, self.run_of(case_id)) for case_id in kept)
        for line in measured(runs, chains, seed=seed, per_case=per_case):
            before = self._clipped.get(line.case_id, 0.0)
            self._clipped[line.case_id] = max(before, line.measurement.clipped)
            yield line

    def measure(
        self,
        chains: Chains,
        *,
        seed: int = 0,
        per_case: int | None = None,
        skip: float = 0.0,
        band: tuple[float, float] | None = None,
    ) -> pl.DataFrame:
        """Return the features of all cases as measuring chains show them, a line a case and chain.

        Join it with the manifest by ``case_id`` for labels and parameters, and with
        :func:`ballrace.measuring.table` by ``chain`` for those of the chains.

        Parameters
        ----------
        chains, seed, per_case
            As for :meth:`measurements`.
        skip, band
            As for :func:`ballrace.features`.

        Returns
        -------
        DataFrame
            ``case_id``, ``chain``, ``seed``, ``sampling_rate`` [Hz], ``range`` [m/s²] and ``clipped`` as of a
            :class:`~ballrace.measuring.Measurement`, and the features ``sensor.rms``, … with standard errors where
            measurements are long enough for any, ``turns``, ``row0.passes`` and ``batches``.

        Raises
        ------
        SceneError
            An argument is not usable, or a column was not recorded.
        """
        lines = self.measurements(chains, seed=seed, per_case=per_case)
        return features_table(lines, skip, band)

    def windows(
        self,
        chains: Chains,
        length: int,
        hop: int | None = None,
        *,
        seed: int = 0,
        per_case: int | None = None,
        skip: float = 0.0,
        labels: Sequence[str] = FAULTS,
    ) -> pl.DataFrame:
        """Return windows of all cases as measuring chains show them, a line a window, with labels of their cases.

        Parameters
        ----------
        chains, seed, per_case
            As for :meth:`measurements`.
        length, hop : int
            Samples of a window, and from one to the next; by default they do not overlap.
        skip : float
            Beginning of each measurement that is left out [s]. The chain is at rest as a measurement begins: leave
            out the time in which its housing and sensor ring up, 1/(2 ζ f) for each of their modes or more.
        labels : sequence of str
            Columns of the manifest that every window gets: by default whether a loaded contact met such a defect
            in the run of its case, not in the window.

        Returns
        -------
        DataFrame
            ``case_id``, ``chain``, ``seed``, ``sampling_rate`` [Hz], ``range`` [m/s²] and ``clipped`` (of the
            whole measurement), ``start`` of the window [s], ``x``, an array of ``length`` 32-bit numbers [m/s²],
            and the labels. :func:`ballrace.learn.examples` makes writable arrays of it.

        Raises
        ------
        SceneError
            An argument is not usable, or no measurement is that long.
        """
        labelled = self._labels(labels)
        lines = self.measurements(chains, seed=seed, per_case=per_case)
        table = windows_table(lines, length, hop, skip)
        return table.join(labelled, on="case_id", how="left", maintain_order="left")

    def to_bearing_datasets(
        self,
        path: str | os.PathLike[str],
        chains: Chains | None = None,
        *,
        licence: str = "unspecified",
        title: str = "",
        seed: int = 0,
        per_case: int | None = None,
    ) -> None:
        """Write the kept signals as a labelled set in the layout of the package ``bearing-datasets`` (0.3.0).

        ``bearing_datasets.open(name, root)`` opens it beside the public measured sets, where ``path`` is
        ``root/name``; :func:`ballrace.read_bearing_dataset` needs no such package. Labels are those of defects
        that a loaded contact *met* in the run; cases in which no ball came to one in time have none and are left
        out. The table has the fault orders, the ``bearing_id`` (of the campaign's table, else a hash of rows and
        defects), units, the place of the sensor and the rank of the width; the card the hash of each scene.

        Parameters
        ----------
        path : path
            Folder to make; there must be none of this name. It appears when it is whole.
        chains : Chain, mapping of str to Chain, or sequence of Chain, optional
            Measuring chains, a recording a case and chain, as for :meth:`measurements`. By default the signals are
            the accelerations of the outer ring, which no sensor would show.
        licence : str
            Under which licence you give the set away, such as ``"CC-BY-4.0"``.
        title : str
            What the set is, in a line.
        seed, per_case
            As for :meth:`measurements`.

        Raises
        ------
        SceneError
            An argument is not usable, or there is no signal with a label.
        FileNotFoundError
            No signals were kept.
        CampaignError
            A shard is missing or damaged.
        OSError
            The folder cannot be written; nothing is left of it.

        Warns
        -----
        CampaignWarning
            Some cases were left out.
        """
        from ..datasets.campaign import write_campaign

        write_campaign(
            self, path, chains, title=title, licence=licence, seed=seed, per_case=per_case
        )

    def _labels(self, names: Sequence[str]) -> pl.DataFrame:
        """Return columns of the manifest beside the id of the case, a line a case.

        Raises
        ------
        SceneError
            There is no such column, or windows have one of that name.
        """
        chosen = (names,) if isinstance(names, str) else tuple(names)
        taken = ("case_id", "chain", "seed", "sampling_rate", "range", "clipped", "start", "x")
        for name in chosen:
            if name in taken:
                raise SceneError(
                    "labels", repr(name), "another column: windows have one of that name"
                )
            if name not in self._finished.columns:
                raise SceneError("labels", repr(name), "columns of the manifest")
        return self._finished.select("case_id", *chosen).unique("case_id", maintain_order=True)

    @property
    def parameters(self) -> tuple[str, ...]:
        """Columns of the table that the campaign ran: fields of the scene, and labels."""
        return tuple(n for n in self._cases.columns if n not in ("case_id", "changes"))

    def report(
        self,
        path: str | os.PathLike[str],
        *,
        features: Sequence[str] | None = None,
        title: str | None = None,
    ) -> None:
        """Write a report of the campaign: one page that needs no network, with maps, distributions and failures.

        Parameters
        ----------
        path : str or path
            File to write, ``.html``; one of the same name is replaced.
        features : sequence of str, optional
            Columns of the manifest that are drawn; by default a line of an envelope, a kurtosis and an rms.
        title : str, optional
            Title of the page; by default the folder's name.

        Raises
        ------
        SceneError
            The name does not end in ``.html``, there is no such column, or plotly is not installed.
        OSError
            The file cannot be written.
        """
        from ..report import campaign_page, write_page

        write_page(path, lambda: campaign_page(self, features=features, title=title))

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

    def __repr__(self) -> str:
        return f"<Campaign {self.status()}>"

    def _repr_html_(self) -> str:
        """Return how many cases have finished, and the first of the manifest, as notebooks show it."""
        return paragraph("Campaign", self.status()) + self.manifest.head(_FEW)._repr_html_()
