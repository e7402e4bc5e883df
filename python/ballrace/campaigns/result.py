"""Results of a campaign: what is measured, written and reported of its cases."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .._base.html import paragraph
from .._io.files import as_path
from ..errors import SceneError
from .columns import FAULTS
from .kept import Kept
from .measured import Measured, features_table, measured, windows_table
from .store import Store

if TYPE_CHECKING:
    import os
    from collections.abc import Iterator, Sequence

    import polars as pl

    from ..measuring.named import Chains

_FEW = 10
"""Rows of the manifest that a notebook shows."""


class Campaign(Kept):
    """A campaign's folder, read: the manifest, and signals case by case.

    Returned by :func:`ballrace.campaign`; :meth:`open` reads a folder that one has left, finished or not.
    """

    @classmethod
    def open(cls, folder: str | os.PathLike[str]) -> Campaign:
        """Read the folder of a campaign.

        Raises
        ------
        CampaignError
            It holds none, or a file is damaged.
        """
        return cls(Store(as_path(folder, "folder")))

    def measurements(
        self, chains: Chains, *, seed: int = 0, per_case: int | None = None
    ) -> Iterator[Measured]:
        """Measure every case whose signals were kept, one after the other; nothing is run again.

        Parameters
        ----------
        chains : Chain, mapping of str to Chain, or sequence of Chain
            Measuring chains, such as one for each of many machines; those without a name are numbered from 0.
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
            out the time in which its path and sensor ring up, 1/(2 ζ f) for each of their modes or more.
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

    def __repr__(self) -> str:
        return f"<Campaign {self.status()}>"

    def _repr_html_(self) -> str:
        """Return how many cases have finished, and the first of the manifest, as notebooks show it."""
        return paragraph("Campaign", self.status()) + self.manifest.head(_FEW)._repr_html_()
