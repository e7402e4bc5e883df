"""Results of a run."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from . import _core
from ._base.html import paragraph, points, waveform
from ._base.interrupt import interrupted_once
from ._base.libraries import pl
from ._base.numbers import read_only
from ._base.text import printable
from ._io.files import PARQUET, as_path
from ._io.parquet import read_sealed, scan_sealed, sealing
from ._io.whole import whole
from ._results.entries import Record, Touched
from ._results.features import feature_options
from ._results.file import Scanned, described, metadata, samples, unless_damaged
from .recordings.columns import Columns
from .recordings.scenes import origin_of, shaft_of
from .scene import Scene

if TYPE_CHECKING:
    import os
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import NDArray

    from ._core import _Signals
    from .recordings.windows import Origin

__all__ = ["Record", "Signals", "Touched"]

_SHOWN = 6
"""Columns of a run that a notebook shows."""


class Signals(Columns):
    """Signals of a run on a uniform grid of times: a mapping from the names of columns to arrays.

    Made by :func:`ballrace.simulate` or :meth:`read_parquet`.

    Examples
    --------
    >>> import ballrace as br
    >>> out = br.simulate(br.presets.deep_groove_6205(), duration=0.001)
    >>> out["outer.ay"].shape == out.t.shape
    True
    >>> out.units["outer.ay"]
    'm/s^2'
    """

    def __init__(
        self,
        *,
        fs: float,
        t: NDArray[np.float64] | Scanned,
        columns: Mapping[str, NDArray[np.float64]],
        units: Mapping[str, str],
        scene: str,
        stats: Mapping[str, Any],
        provenance: Mapping[str, Any],
        warnings: Iterable[str] = (),
        slices: pl.DataFrame | Mapping[str, Any] | None = None,
        end_state: NDArray[np.float64] | None = None,
    ) -> None:
        self._fs = fs
        self._t = t if isinstance(t, Scanned) else read_only(t)
        held = columns if isinstance(columns, Scanned) else _read_only(columns)
        self._columns: Mapping[str, NDArray[np.float64]] = held
        self._units = dict(units)
        self._scene: str | Scene = scene
        self._stats = Record(stats)
        self._provenance = Record(provenance)
        self._warnings = tuple(warnings)
        self._slices = slices
        self._end_state = end_state

    @classmethod
    def _from_core(cls, raw: _Signals, written: Scanned | None = None) -> Signals:
        """Take over what a run gave; its samples from the file where they were written meanwhile."""
        return cls(
            fs=raw["fs"],
            t=raw["t"] if written is None else written,
            columns=written or {name: values for name, _, values in raw["columns"]},
            units={name: unit for name, unit, _ in raw["columns"]},
            scene=raw["scene"],
            stats=json.loads(raw["stats"]),
            provenance=json.loads(raw["provenance"]),
            warnings=[printable(text) for _, text in raw["warnings"]],
            slices=raw["slices"],
            end_state=raw["end_state"],
        )

    def __repr__(self) -> str:
        size = f"{len(self)} columns, {self.n_samples} samples at {self._fs:g} Hz"
        title = f"<Signals of {self.scene.name!r}: {size}"
        groups: dict[str, list[str]] = {}
        for name in self._columns:
            group, _, column = name.partition(".")
            groups.setdefault(group, []).append(column)
        lines = [f"  {group}: {_shortened(columns, 12)}" for group, columns in groups.items()]
        return printable("\n".join([title, *lines])) + ">"

    def _repr_html_(self) -> str:
        """Return warnings and some columns with their waveforms, accelerations first, as notebooks show it."""
        size = f"{len(self)} columns, {self.n_samples} samples at {self._fs:g} Hz"
        names = sorted(self, key=lambda name: self.units.get(name) != "m/s^2")[:_SHOWN]
        rest = len(self) - len(names)
        lines = "".join(waveform(name, self.units.get(name, ""), self[name]) for name in names)
        more = paragraph("", f"and {rest} more: print() names them") if rest else ""
        summary = paragraph(f"Signals of {self.scene.name!r}", size) + points(self.warnings)
        return f"{summary}<table>{lines}</table>{more}"

    @property
    def t(self) -> NDArray[np.float64]:
        """Times, shape (n_samples,) [s]."""
        return self._t.read("t") if isinstance(self._t, Scanned) else self._t

    @property
    def n_samples(self) -> int:
        """Number of samples of each column."""
        return self._t.rows if isinstance(self._t, Scanned) else self._t.size

    @property
    def fs(self) -> float:
        """Sampling rate [Hz]."""
        return self._fs

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the columns."""
        return tuple(self._columns)

    @property
    def units(self) -> Mapping[str, str]:
        """Unit of each column."""
        return MappingProxyType(self._units)

    @property
    def scene(self) -> Scene:
        """The scene that was run."""
        if isinstance(self._scene, str):
            self._scene = Scene.from_json(self._scene)
        return self._scene

    @property
    def end_state(self) -> NDArray[np.float64] | None:
        """States of all bodies at the end, shape (n_states,): the start of a run that goes on.

        None in files of version 0.2.
        """
        return self._end_state

    @property
    def stats(self) -> Record:
        """Statistics of the run: steps accepted and rejected, evaluations and so on."""
        return self._stats

    @property
    def provenance(self) -> Record:
        """Origin of these signals: versions, arguments, platform."""
        return self._provenance

    @property
    def defects(self) -> Mapping[str, Touched]:
        """How contacts met the defects that have a width, by their names."""
        records = self._provenance.to_dict()["defects"]
        return MappingProxyType({defect["name"]: Touched(**defect) for defect in records})

    @property
    def accuracy(self) -> Record | None:
        """Choice for a requested accuracy and its expected errors; None where none was requested.

        ``requested``, ``rtol``, ``nodes`` on outer and inner race; the errors of the accelerations that pilot
        runs of the first 3 ms showed, ``integration_error`` and ``node_error`` (None with fixed slices), whose sum
        is above ``requested`` where the motion is chaotic, which an AccuracyWarning reports; and the
        ``pilot_evaluations`` that this took, which ``stats`` does not count.
        """
        chosen = self._provenance.to_dict()["accuracy"]
        return None if chosen is None else Record(chosen)

    @property
    def warnings(self) -> tuple[str, ...]:
        """Reasons to check the results: texts of AccuracyWarning and SceneWarning; usually none."""
        return self._warnings

    @property
    def slices(self) -> pl.DataFrame | None:
        """Forces of single slices, a line each, as asked for by the probes ``slices``; None without them."""
        if isinstance(self._slices, Mapping):
            self._slices = pl.DataFrame(self._slices)
        return self._slices

    def features(
        self,
        *,
        columns: Sequence[str] | None = None,
        skip: float = 0.0,
        band: tuple[float, float] | None = None,
        contact_loads: bool = False,
    ) -> dict[str, float | None]:
        """Return the features of the run, by the names that they have in the table of a campaign.

        Parameters
        ----------
        columns : sequence of str, optional
            Columns whose features are computed; by default all accelerations. The features are listed under
            ``columns`` of :func:`ballrace.campaign`.
        skip : float
            Beginning of the run that is left out [s].
        band : tuple of two floats, optional
            Band of the envelope [Hz]; by default all frequencies.
        contact_loads : bool
            Whether the extremes of the contact loads are among them, ``row0.outer.load_max`` and so on [N]. Probes
            must have recorded the loads of all contacts, such as ``ContactsProbe(row=0, quantities=("load",))``.

        Returns
        -------
        dict of str to float or None
            Those of the columns in their units, squared for an envelope, and ``largest_pressure`` [Pa]; of a
            ``LubricationProbe`` the least film and λ, ``oil.inner.film_min``, and the mean torque and powers,
            ``oil.friction_torque_mean``. None where the run cannot give one: a line for which it is too short.

            Beside each, but for ``largest_pressure`` and ``lines_from``, its standard error, ``outer.ay.rms_se``:
            the scatter over runs whose starts differ by less than can be measured, not the difference to a longer
            run. None where the record has fewer than 8 turns of the shaft and fewer than 8 passes of balls over a
            place of the outer race, or its speed changes by more than 2 % or is not given. ``turns`` and
            ``row0.passes`` count them, ``batches`` is the number of parts that errors come from, 0 without.

        Raises
        ------
        SceneError
            An argument is not usable, or a column was not recorded.

        Examples
        --------
        >>> import ballrace as br
        >>> out = br.simulate(br.presets.deep_groove_6205(), duration=0.001)
        >>> list(out.features(columns=["outer.ay"]))[:2]
        ['outer.ay.rms', 'outer.ay.rms_se']
        """
        options = json.dumps(feature_options(columns, skip, band, contact_loads))
        pressure = self._stats.get("largest_pressure")
        rows = json.dumps(self._provenance.get("kinematics", []))
        scene = self.scene.to_json()
        found = _core.run_features(self._columns, self._fs, scene, pressure, rows, options)
        return dict(found)

    def write(
        self,
        path: str | os.PathLike[str],
        columns: str | Iterable[str] | Mapping[str, str] | None = None,
    ) -> None:
        """Write as :meth:`Recording.write` does; all columns into Parquet as :meth:`write_parquet` does."""
        suffix = as_path(path).suffix.lower()
        if columns is None and suffix and suffix in PARQUET:
            self.write_parquet(path)
        else:
            super().write(path, columns)

    def _with(self, columns: Mapping[str, NDArray[np.float64]]) -> Signals:
        return Signals(
            fs=self._fs, t=self.t, columns=columns, units={name: self._units[name] for name in columns},
            scene=self.scene.to_json(), stats=self._stats, provenance=self._provenance, warnings=self._warnings,
            slices=self._slices, end_state=self._end_state,
        )  # fmt: skip

    def _metadata(self) -> dict[str, Any]:
        entries = {"scene": self.scene.to_dict(), "provenance": self._provenance.to_dict()}
        return {"shaft": shaft_of(self.scene), "metadata": entries}

    def _known(self) -> dict[str, Any]:
        known = {"shaft": shaft_of(self.scene), "scene": self.scene, "warnings": self.warnings}
        return known | {"is_run": True}

    def _origin(self) -> Origin:
        return origin_of(self.scene, self._provenance.get("version"))

    def report(
        self,
        path: str | os.PathLike[str],
        *,
        columns: Sequence[str] | None = None,
        title: str | None = None,
    ) -> None:
        """Write a report of the run: one page that needs no network.

        It begins with the verdict of :func:`ballrace.diagnose` on the first acceleration that is shown, or why
        there is none. Then come warnings, the bearing drawn, the operating point, loads, pressures, rating life,
        the signal with its spectra and the lines of defects, features, what the model held and left out, and
        provenance.

        Parameters
        ----------
        path : str or path
            File to write, ``.html``; one of the same name is replaced.
        columns : sequence of str, optional
            Columns that are shown; by default one acceleration, of a sensor before that of the outer ring.
        title : str, optional
            Title of the page; by default the scene's name.

        Raises
        ------
        SceneError
            The name does not end in ``.html``, a column was not recorded, or plotly is not installed.
        OSError
            The file cannot be written.
        """
        from .report import run_page, write_page

        write_page(path, lambda: run_page(self, columns=columns, title=title))

    def write_parquet(self, path: str | os.PathLike[str]) -> None:
        """Write a Parquet file; units, scene, statistics and provenance go into its metadata.

        The file appears at once when it is whole; one of the same name is replaced. A hash of all of it stands
        where other readers of Parquet do not look.

        Raises
        ------
        OSError
            The folder does not exist or is not writable, or the disk is full.
        """
        with whole(path) as temporary, sealing(temporary, path):
            table, entries = self.to_polars(), metadata(self)
            interrupted_once(lambda: table.write_parquet(temporary, metadata=entries))

    @classmethod
    def read_parquet(cls, path: str | os.PathLike[str]) -> Signals:
        """Read a file that :meth:`write_parquet` wrote.

        Raises
        ------
        FileError
            The file is not such a file, or damaged; the message says which.
        OSError
            The file cannot be read.
        """
        path = as_path(path)
        table, entries = unless_damaged(path, lambda: read_sealed(path))
        fields = described(path, entries, table.columns)
        times = samples(path, table, "t")
        columns = {name: samples(path, table, name) for name in table.columns if name != "t"}
        return cls(t=times, columns=columns, **fields)

    @classmethod
    def scan_parquet(cls, path: str | os.PathLike[str]) -> Signals:
        """Open a file of signals, however long, without its samples in memory.

        :meth:`write_parquet` writes such files, and a run with `out`. A column, and the times, are read from the
        file whenever they are asked for; keep what is used more than once. The file is checked against its hash
        now, and must stay as it is.

        Raises
        ------
        FileError
            The file is not such a file, or damaged; the message says which. Later: it has changed.
        OSError
            The file cannot be read.

        Examples
        --------
        >>> import ballrace as br, pathlib, tempfile
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     path = pathlib.Path(folder) / "record.parquet"
        ...     _ = br.simulate(br.presets.deep_groove_6205(), duration=0.001, out=path)
        ...     out = br.Signals.scan_parquet(path)
        ...     (out.n_samples, out["outer.ay"].shape)
        (50, (50,))
        """
        path = as_path(path)
        entries = unless_damaged(path, lambda: scan_sealed(path))
        columns = Scanned(path)
        return cls(t=columns, columns=columns, **described(path, entries, list(columns)))


def _read_only(columns: Mapping[str, NDArray[np.float64]]) -> dict[str, NDArray[np.float64]]:
    return {name: read_only(x) for name, x in columns.items()}


def _shortened(names: list[str], limit: int) -> str:
    rest = len(names) - limit
    return " ".join(names[:limit]) + (f" … and {rest} more" if rest > 0 else "")
