"""What a run gives back."""

from __future__ import annotations

import base64
import difflib
import io
import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._features import feature_options
from ._files import whole
from ._parquet import read_bytes, read_sealed, seal
from ._text import printable
from .errors import BallraceError, FileError
from .scene import Scene, Surface

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Sequence

    import polars as pl

    from ._core import _Signals

__all__ = ["Record", "Signals", "Touched"]

_FORMAT = "1"


class Record(Mapping[str, Any]):
    """A read-only mapping whose entries are attributes too: ``stats.nfev`` is ``stats["nfev"]``."""

    def __init__(self, entries: Mapping[str, Any]) -> None:
        self.__dict__["_entries"] = {
            name: Record(value) if isinstance(value, Mapping) else value
            for name, value in entries.items()
        }

    def __getitem__(self, name: str) -> Any:
        return self._entries[name]

    def __getattr__(self, name: str) -> Any:
        try:
            return self.__dict__["_entries"][name]
        except KeyError:
            known = ", ".join(self.__dict__.get("_entries", ()))
            raise AttributeError(f"no entry {name!r}; there are: {known}") from None

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError("a record cannot be changed")

    def __iter__(self) -> Iterator[str]:
        return iter(self._entries)

    def __len__(self) -> int:
        return len(self._entries)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._entries]

    def __repr__(self) -> str:
        return f"Record({', '.join(f'{name}={value!r}' for name, value in self.items())})"

    def to_dict(self) -> dict[str, Any]:
        """Return the entries as plain dicts."""
        return {k: v.to_dict() if isinstance(v, Record) else v for k, v in self.items()}


@dataclass(frozen=True, kw_only=True)
class Touched:
    """What became of a defect in a run.

    Attributes
    ----------
    name : str
        Name of the defect.
    on : {"outer_race", "inner_race", "ball"}
        Which surface.
    axial_offset : float
        Axial place of its middle, from the row's plane (races) or the ball's centre [m].
    placed : {"given", "contact", "nominal"}
        Where that number comes from: the scene, the contacts at equilibrium, or the nominal contact angle since
        there is no equilibrium or no load.
    passes : int
        How often a ball came by: a contact of the race, or one of the ball's two contacts, passed over its arc.
    touched : int
        In how many of these a contact was loaded within its length.
    largest_load : float
        Largest normal force of a contact within its length, to about a percent [N].
    contact_offset : float or None
        Where the most loaded contact ran that passed, measured as `axial_offset` [m]; None without load.
    """

    name: str
    on: Surface
    axial_offset: float
    placed: Literal["given", "contact", "nominal"]
    passes: int
    touched: int
    largest_load: float
    contact_offset: float | None

    @property
    def share(self) -> float | None:
        """Share of the passes that touched it, 0 to 1; None without a pass."""
        return self.touched / self.passes if self.passes else None


class Signals(Mapping[str, NDArray[np.float64]]):
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
        t: NDArray[np.float64],
        columns: Mapping[str, NDArray[np.float64]],
        units: Mapping[str, str],
        scene: str,
        stats: Mapping[str, Any],
        provenance: Mapping[str, Any],
        warnings: Iterable[str] = (),
        slices: pl.DataFrame | Mapping[str, Any] | None = None,
    ) -> None:
        self._fs = fs
        self._t = t
        self._columns = dict(columns)
        self._units = dict(units)
        self._scene: str | Scene = scene
        self._stats = Record(stats)
        self._provenance = Record(provenance)
        self._warnings = tuple(warnings)
        self._slices = slices

    @classmethod
    def _from_core(cls, raw: _Signals) -> Signals:
        return cls(
            fs=raw["fs"],
            t=raw["t"],
            columns={name: values for name, _, values in raw["columns"]},
            units={name: unit for name, unit, _ in raw["columns"]},
            scene=raw["scene"],
            stats=json.loads(raw["stats"]),
            provenance=json.loads(raw["provenance"]),
            warnings=[printable(text) for _, text in raw["warnings"]],
            slices=raw["slices"],
        )

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        try:
            return self._columns[name]
        except KeyError:
            near = difflib.get_close_matches(str(name), self._columns, n=5, cutoff=0.4)
            hint = (
                f"near are {', '.join(near)}" if near else f"there are {', '.join(self._columns)}"
            )
            raise KeyError(f"no column {name!r}; {hint}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __contains__(self, name: object) -> bool:
        return name in self._columns

    def __eq__(self, other: object) -> bool:
        return self is other

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        title = f"<Signals of {self.scene.name!r}: {len(self)} columns, {self._t.size} samples at {self._fs:g} Hz"
        groups: dict[str, list[str]] = {}
        for name in self._columns:
            group, _, column = name.partition(".")
            groups.setdefault(group, []).append(column)
        lines = [f"  {group}: {_shortened(columns, 12)}" for group, columns in groups.items()]
        return printable("\n".join([title, *lines])) + ">"

    @property
    def t(self) -> NDArray[np.float64]:
        """Times, shape (n_samples,) [s]."""
        return self._t

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
    def stats(self) -> Record:
        """Statistics of the run: steps accepted and rejected, evaluations and so on."""
        return self._stats

    @property
    def provenance(self) -> Record:
        """What made these signals: versions, arguments, platform."""
        return self._provenance

    @property
    def defects(self) -> Mapping[str, Touched]:
        """What became of the defects that have a width, by their names: whether contacts met them."""
        told = self._provenance.to_dict()["defects"]
        return MappingProxyType({defect["name"]: Touched(**defect) for defect in told})

    @property
    def accuracy(self) -> Record | None:
        """What a requested accuracy chose and what error it expects of that; None where none was asked for.

        ``requested``, ``rtol``, ``nodes`` on outer and inner race; the errors of the accelerations that pilot
        runs of the first 3 ms showed, ``integration_error`` and ``node_error`` (None with fixed slices); and
        the ``pilot_evaluations`` that this took, which ``stats`` does not count.
        """
        chosen = self._provenance.to_dict()["accuracy"]
        return None if chosen is None else Record(chosen)

    @property
    def warnings(self) -> tuple[str, ...]:
        """Reasons to look twice, as :class:`AccuracyWarning` and :class:`SceneWarning` told them; usually none."""
        return self._warnings

    @property
    def slices(self) -> pl.DataFrame | None:
        """Forces of single slices, a line each, as asked for by the probes ``slices``; None without them."""
        if isinstance(self._slices, Mapping):
            import polars as pl

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
            Columns whose features are computed; by default all accelerations. :func:`ballrace.campaign` tells at
            ``columns`` which features there are.
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
            Those of the columns in their units, squared for an envelope, and ``largest_pressure`` [Pa]. None where
            the run cannot give one: a line for which it is too short.

        Raises
        ------
        SceneError
            An argument is not usable, or a column was not recorded.

        Examples
        --------
        >>> import ballrace as br
        >>> out = br.simulate(br.presets.deep_groove_6205(), duration=0.001)
        >>> list(out.features(columns=["outer.ay"]))[:2]
        ['outer.ay.rms', 'outer.ay.peak']
        """
        options = json.dumps(feature_options(columns, skip, band, contact_loads))
        pressure = self._stats.get("largest_pressure")
        found = _core.run_features(self, self._fs, self.scene.to_json(), pressure, options)
        return dict(found)

    def to_polars(self) -> pl.DataFrame:
        """Return a table with the time ``t`` and all columns."""
        import polars as pl

        return pl.DataFrame({"t": self._t, **self._columns})

    def write_parquet(self, path: str | os.PathLike[str]) -> None:
        """Write a Parquet file; units, scene, statistics and provenance go into its metadata.

        The file appears at once when it is whole; one of the same name is replaced. A hash of all of it stands
        where other readers of Parquet do not look.

        Raises
        ------
        OSError
            The folder does not exist or is not writable.
        """
        metadata = {
            "ballrace": _FORMAT,
            "sampling_rate": repr(float(self._fs)),
            "units": json.dumps({"t": "s", **self._units}),
            "scene": self.scene.to_json(),
            "stats": json.dumps(self._stats.to_dict()),
            "provenance": json.dumps(self._provenance.to_dict()),
            "warnings": json.dumps(self._warnings),
        }
        if self.slices is not None:
            table = io.BytesIO()
            self.slices.write_parquet(table)
            metadata["slices"] = base64.b64encode(table.getvalue()).decode()
        with whole(path) as temporary:
            self.to_polars().write_parquet(temporary, metadata=metadata)
            with temporary.open("r+b") as file:
                seal(file)

    @classmethod
    def read_parquet(cls, path: str | os.PathLike[str]) -> Signals:
        """Read a file that :meth:`write_parquet` wrote.

        Raises
        ------
        FileError
            The file is not such a file, or damaged; the message says what of it.
        OSError
            The file cannot be read.
        """
        path = Path(path)
        try:
            table, metadata = read_sealed(path)
        except ValueError as error:
            raise FileError(str(path), f"not a Parquet file, or damaged ({error})") from error
        if metadata.get("ballrace") != _FORMAT:
            raise FileError(
                str(path), "a Parquet file, but not written by this version of ballrace"
            )
        times = _samples(path, table, "t")
        return cls(
            t=times,
            columns={name: _samples(path, table, name) for name in table.columns if name != "t"},
            **_described(path, metadata, table.columns),
        )


def _samples(path: Path, table: pl.DataFrame, name: str) -> NDArray[np.float64]:
    import polars as pl

    if name not in table.columns:
        raise FileError(str(path), f"damaged: the column {name} is missing")
    column = table[name]
    if column.dtype != pl.Float64 or column.null_count():
        raise FileError(str(path), f"damaged: the column {name} has other entries than numbers")
    return column.to_numpy()


def _described(path: Path, metadata: Mapping[str, str], columns: list[str]) -> dict[str, Any]:
    """Return what the metadata of a file says beside its samples, as :class:`Signals` takes it."""
    readers: dict[str, Callable[[str], Any]] = {
        "sampling_rate": _rate, "units": _mapping, "scene": _scene, "stats": _mapping,
        "provenance": _mapping, "warnings": _texts, "slices": _table,
    }  # fmt: skip
    found = {}
    for entry, read in readers.items():
        text = metadata.get(entry, {"warnings": "[]", "slices": ""}.get(entry))
        if text is None:
            raise FileError(str(path), f"damaged: its metadata has no {entry}")
        try:
            found[entry] = read(text)
        except (ValueError, TypeError, BallraceError) as error:
            reason = f"damaged: the entry {entry} of its metadata cannot be read ({error})"
            raise FileError(str(path), reason) from error
    units = found.pop("units")
    missing = [name for name in columns if name not in units and name != "t"]
    if missing:
        raise FileError(str(path), f"damaged: its metadata has no unit of {missing[0]}")
    found["units"] = {name: str(units[name]) for name in columns if name != "t"}
    found["fs"] = found.pop("sampling_rate")
    return found


def _rate(text: str) -> float:
    fs = float(text)
    if not 0.0 < fs < float("inf"):
        raise ValueError(f"{text} is no rate")
    return fs


def _mapping(text: str) -> dict[str, Any]:
    document = json.loads(text)
    if not isinstance(document, dict):
        raise TypeError("it is no mapping")
    return document


def _scene(text: str) -> str:
    return Scene.from_json(text).to_json()


def _texts(text: str) -> list[str]:
    return [str(warning) for warning in json.loads(text)]


def _table(text: str) -> pl.DataFrame | None:
    return read_bytes(base64.b64decode(text)) if text else None


def _shortened(names: list[str], limit: int) -> str:
    rest = len(names) - limit
    return " ".join(names[:limit]) + (f" … and {rest} more" if rest > 0 else "")
