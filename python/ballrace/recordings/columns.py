"""Columns at one sampling rate, and their export: what runs and recordings have in common."""

from __future__ import annotations

import difflib
from abc import abstractmethod
from collections.abc import ItemsView, Iterable, Iterator, KeysView, Mapping, ValuesView
from typing import TYPE_CHECKING, Any, Self, TypeVar, overload

from .._base.libraries import needed, pl
from ..channel import Channel, default_column
from ..errors import SceneError
from .samples import Samples
from .windows import Origin, windows

if TYPE_CHECKING:
    import os

    import numpy as np
    import pandas as pd
    import xarray as xr
    from numpy.typing import NDArray

T = TypeVar("T")


class Columns:
    """Columns at one sampling rate: read-only arrays by their names, as of a mapping.

    ``[name]`` gives an array, ``[[name, other]]`` a record of these columns. Programs that know Arrow's interface
    for C take it as a table with the time ``t``: ``polars.DataFrame(record)``, ``pyarrow.table(record)``. It is no
    ``Mapping`` by its type: polars would take a table without the time, pandas one of names alone.
    """

    if TYPE_CHECKING:

        @property
        def fs(self) -> float:
            """Sampling rate [Hz]."""

        @property
        def t(self) -> NDArray[np.float64]:
            """Times [s]."""

        @property
        def units(self) -> Mapping[str, str]:
            """Unit of each column."""

        @property
        def _columns(self) -> Mapping[str, NDArray[np.float64]]: ...

    @overload
    def __getitem__(self, name: str) -> NDArray[np.float64]: ...
    @overload
    def __getitem__(self, name: list[str]) -> Self: ...
    def __getitem__(self, name: str | list[str]) -> NDArray[np.float64] | Self:
        if isinstance(name, list):
            return self._with({each: self[each] for each in name})
        try:
            return self._columns[name]
        except KeyError:
            raise no_column(name, self._columns) from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __contains__(self, name: object) -> bool:
        return name in self._columns

    def keys(self) -> KeysView[str]:
        """Return the names of the columns."""
        return KeysView(self)

    def values(self) -> ValuesView[NDArray[np.float64]]:
        """Return the columns."""
        return ValuesView(self)

    def items(self) -> ItemsView[str, NDArray[np.float64]]:
        """Return the names with the columns."""
        return ItemsView(self)

    @overload
    def get(self, name: str) -> NDArray[np.float64] | None: ...
    @overload
    def get(self, name: str, default: T) -> NDArray[np.float64] | T: ...
    def get(self, name: str, default: T | None = None) -> NDArray[np.float64] | T | None:
        """Return a column, or the default where it is not there."""
        try:
            return self[name]
        except KeyError:
            return default

    def channel(self, name: str | None = None) -> Channel:
        """Return one signal with all that is known of it.

        Parameters
        ----------
        name : str, optional
            Column; by default that of a structure's sensor, ``housing.<sensor>.ay``, else ``outer.ay``, else
            the first.

        Raises
        ------
        KeyError
            There is no such column.
        SceneError
            The name is no text, such as a list of names.

        Examples
        --------
        >>> import ballrace as br
        >>> out = br.simulate(br.presets.deep_groove_6205(), duration=0.001)
        >>> out.channel().to("g").unit
        'g'
        """
        if name is None:
            name = default_column(self)
        if not isinstance(name, str):
            raise SceneError("column", repr(name), f"the name of one, of {', '.join(self)}")
        start = float(self.t[0]) if self.t.size else 0.0
        return Channel(
            x=self[name],
            fs=self.fs,
            name=name,
            unit=self.units.get(name, ""),
            start=start,
            **self._known(),
        )

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object:
        """Return the table with the time ``t`` and all columns by Arrow's interface for C."""
        return self.to_polars().__arrow_c_stream__(requested_schema)

    def __array__(self, dtype: object = None, copy: bool | None = None) -> NDArray[np.float64]:
        """Refuse to be an array, which pandas would make a table of without names.

        Raises
        ------
        TypeError
            Always.
        """
        raise TypeError(
            "a record is no array: record.to_pandas(), record.to_polars() or record[name]"
        )

    def to_polars(self) -> pl.DataFrame:
        """Return a table with the time ``t`` and all columns."""
        return pl.DataFrame({"t": self.t, **self})

    def to_pandas(self) -> pd.DataFrame:
        """Return a pandas table with the time ``t`` and all columns.

        Raises
        ------
        ImportError
            pandas is not installed.
        """
        pandas = needed("pandas", "a pandas table", extra=None)
        return pandas.DataFrame({"t": self.t, **self})

    def to_xarray(self) -> xr.Dataset:
        """Return an xarray data set: a variable a column over the coordinate ``t``, with units as attributes.

        Its own attributes are ``sampling_rate`` and ``told``, a JSON text of all other metadata.

        Raises
        ------
        ImportError
            xarray is not installed.
        """
        xarray = needed("xarray", "an xarray data set", extra=None)
        variables = {name: ("t", self[name], {"units": self.units.get(name, "")}) for name in self}
        time = ("t", self.t, {"units": "s"})
        attributes = {"sampling_rate": self.fs, "told": self._samples().header()}
        found: xr.Dataset = xarray.Dataset(variables, coords={"t": time}, attrs=attributes)
        return found

    def to_windows(
        self,
        length: int,
        hop: int | None = None,
        *,
        columns: str | Iterable[str] | None = None,
        label: str | None = None,
        bearing_id: str | int | None = None,
    ) -> pl.DataFrame:
        """Return pieces of equal length as a table for learning, a row a window.

        Each row has all of its metadata, as tables of Hugging Face's ``datasets`` have; write them with
        ``write_parquet``. Split such data by ``bearing_id``: windows of one bearing resemble each other.

        Parameters
        ----------
        length : int
            Samples of a window.
        hop : int, optional
            Samples from one window to the next; by default ``length``. A remainder shorter than a window is left
            out.
        columns : str or iterable of str, optional
            Which columns; by default all accelerations (in m/s² or g), or all columns where there are none.
        label : str, optional
            What is damaged; by default the surfaces with defects in the scene of a run, such as ``"outer_race"``
            or ``"inner_race+ball"``, and ``"healthy"`` without; null for a recording.
        bearing_id : str or int, optional
            Which bearing it is.

        Returns
        -------
        polars.DataFrame
            An array of 32-bit samples a column by its name, ``start`` [s], ``label``, ``bearing_id``, ``speed`` of
            the inner ring [rad/s], ``load``, ``geometry`` and ``defect`` (lists of the scene's loads, rows and
            defects, in SI units), ``sampling_rate`` [Hz], ``units`` by column, and the ``version`` that
            simulated it. Loads and speed are those at the window's middle; null is what is not known.

        Raises
        ------
        SceneError
            An argument is not usable.

        Examples
        --------
        >>> import ballrace as br
        >>> out = br.simulate(br.presets.deep_groove_6205(), duration=0.02, fs=10_000.0)
        >>> table = out.to_windows(64, 32, columns="outer.ay", bearing_id="A")
        >>> table.height, table["outer.ay"][0].len(), table["label"][0]
        (5, 64, 'healthy')
        """
        names = self._chosen(columns)
        return windows(
            self._samples(names), self._origin(), length, hop, label=label, bearing_id=bearing_id
        )

    def write(
        self,
        path: str | os.PathLike[str],
        columns: str | Iterable[str] | Mapping[str, str] | None = None,
    ) -> None:
        """Write a file of the format that its name ends in (:mod:`ballrace.recordings`).

        The file appears at once when it is whole; one of the same name is replaced. :func:`ballrace.read` reads it
        back: the same numbers (of 32 bits in WAV), rate and units.

        Parameters
        ----------
        path : path
            File that ends in .csv, .txt, .wav, .mat, .uff, .unv, .h5, .hdf5, .parquet or .pq.
        columns : str, iterable of str or mapping of str to str, optional
            Which columns, or which by which new names: ``{"outer.ay": "DE"}`` gives a ``.mat`` file the keys
            ``X001_DE_time`` and ``X001RPM`` of the Case Western Reserve University's. By default all.

        Raises
        ------
        SceneError
            An argument is not usable, or the format cannot hold the columns; nothing was written.
        ImportError
            The library for this format is not installed (extra ``io``).
        OSError
            The folder does not exist or is not writable, or the disk is full.

        Examples
        --------
        >>> import ballrace as br, pathlib, tempfile
        >>> out = br.simulate(br.presets.deep_groove_6205(), duration=0.001)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     path = pathlib.Path(folder) / "run.mat"
        ...     out.write(path, columns={"outer.ay": "DE"})
        ...     again = br.read(path)
        >>> again.fs, again.units["DE"], bool((again["DE"] == out["outer.ay"]).all())
        (50000.0, 'm/s^2', True)
        """
        from .writing import write

        if isinstance(columns, Mapping):
            samples = self._samples(self._chosen(columns))
            samples.columns = {columns[old]: x for old, x in samples.columns.items()}
            samples.units = {columns[old]: unit for old, unit in samples.units.items()}
            if len(samples.columns) < len(columns):
                raise SceneError("columns", str(dict(columns)), "a new name each")
        else:
            samples = self._samples(None if columns is None else self._chosen(columns))
        write(samples, path)

    def _samples(self, names: Iterable[str] | None = None) -> Samples:
        """Return some of the columns, or all, with the metadata that files hold."""
        chosen = list(self if names is None else names)
        return Samples(
            columns={name: self[name] for name in chosen},
            fs=float(self.fs),
            units={name: self.units.get(name, "") for name in chosen},
            **self._metadata(),
        )

    def _chosen(self, columns: str | Iterable[str] | None) -> list[str]:
        if columns is None:
            accelerations = [name for name in self if self.units.get(name) in ("m/s^2", "g")]
            return accelerations or list(self)
        if not isinstance(columns, Iterable):
            raise SceneError("columns", repr(columns), f"columns: {', '.join(self)}")
        names = [columns] if isinstance(columns, str) else list(columns)
        for name in names:
            if name not in self:
                raise SceneError("columns", str(name), f"columns: {', '.join(self)}")
        if not names:
            raise SceneError("columns", "none", "at least one column")
        return names

    @abstractmethod
    def _with(self, columns: Mapping[str, NDArray[np.float64]]) -> Self:
        """Return the same record with other columns, of those that it has."""

    @abstractmethod
    def _known(self) -> dict[str, Any]:
        """Return what is known of all columns, by the fields of a channel."""

    @abstractmethod
    def _metadata(self) -> dict[str, Any]:
        """Return the metadata of all columns: the fields ``shaft`` and ``metadata`` of :class:`Samples`."""

    @abstractmethod
    def _origin(self) -> Origin:
        """Return the origin of windows, for their metadata."""


def no_column(name: object, columns: Iterable[str]) -> KeyError:
    """Return the error for a column that is not there; it names near ones."""
    columns = list(columns)
    near = [column for column in columns if column.casefold() == str(name).casefold()]
    near = near or difflib.get_close_matches(str(name), columns, n=5, cutoff=0.4)
    hint = f"near are {', '.join(near)}" if near else f"there are {', '.join(columns)}"
    return KeyError(f"no column {name!r}; {hint}")
