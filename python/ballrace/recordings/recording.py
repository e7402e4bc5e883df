"""A record from any source."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import InitVar, dataclass, field, replace
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .._base.numbers import read_only, real, real_row, sampling_rate
from .._base.units import canonical
from ..errors import SceneError
from .columns import Columns
from .windows import Origin

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Recording(Columns):
    """A measured record: a mapping from the names of columns to arrays, at one sampling rate.

    Made by :func:`ballrace.read`, or from arrays: ``br.Recording(array, fs=25_600.0, unit="g")``.

    Attributes
    ----------
    columns : mapping of str to ndarray
        Columns, each of shape (n,). Given may also be an array alone: of shape (n,) it becomes the column ``x``,
        of shape (n, k) the columns ``x_1`` to ``x_k``.
    fs : float
        Sampling rate [Hz]; NaN in ``others`` where the file does not tell it.
    units : mapping of str to str
        Unit of each column; empty where it is not known. Common spellings (``m/s2``, ``G``) become one.
    shaft : float or None
        Mean rate of the shaft [Hz], if it is known.
    source : str
        The file it was read from.
    metadata : mapping
        Further metadata of the file.
    others : tuple of Recording
        Columns of the same file of other lengths or rates.
    unit : str
        Unit of all columns, given in place of ``units``; no attribute.

    Raises
    ------
    SceneError
        A field is not usable.

    Examples
    --------
    >>> import ballrace as br, numpy as np
    >>> record = br.Recording(columns={"sensor": np.zeros(12_000)}, fs=12_000.0, units={"sensor": "g"})
    >>> record
    <Recording: 1 columns, 12000 samples at 12000 Hz: sensor [g]>
    """

    columns: Mapping[str, NDArray[np.float64]] = field(kw_only=False)
    fs: float
    units: Mapping[str, str] = field(default_factory=dict)
    shaft: float | None = None
    source: str = ""
    metadata: Mapping[str, Any] = field(default_factory=dict)
    others: tuple[Recording, ...] = ()
    unit: InitVar[str] = ""

    if TYPE_CHECKING:

        def __init__(
            self,
            columns: Mapping[str, Any] | ArrayLike,
            *,
            fs: float,
            units: Mapping[str, str] = ...,
            shaft: float | None = None,
            source: str = "",
            metadata: Mapping[str, Any] = ...,
            others: tuple[Recording, ...] = (),
            unit: str = "",
        ) -> None: ...

    def __post_init__(self, unit: str) -> None:
        object.__setattr__(self, "columns", _by_names(self.columns))
        if unit:
            object.__setattr__(self, "units", self.units or dict.fromkeys(self.columns, unit))
        for name in ("columns", "units", "metadata"):
            if not isinstance(getattr(self, name), Mapping):
                allowed = "a mapping by names" + (", or an array" if name == "columns" else "")
                raise SceneError(name, type(getattr(self, name)).__name__, allowed)
        columns = {str(name): _checked(str(name), x) for name, x in self.columns.items()}
        if len({x.size for x in columns.values()}) != 1:
            sizes = ", ".join(f"{name}: {x.size}" for name, x in columns.items())
            raise SceneError("columns", sizes or "none", "at least one, all of one length")
        if not (isinstance(self.fs, float) and math.isnan(self.fs)):
            sampling_rate(self.fs)
        if self.shaft is not None and not 0.0 <= real(self.shaft) < math.inf:
            raise SceneError("shaft", repr(self.shaft), "a rate, or None")
        units = {name: canonical(str(self.units.get(name, ""))) for name in columns}
        object.__setattr__(self, "columns", MappingProxyType(columns))
        object.__setattr__(self, "units", MappingProxyType(units))

    def __reduce__(self) -> tuple[Any, ...]:
        mappings = {"columns": dict(self.columns), "units": dict(self.units)}
        rest = {
            name: getattr(self, name) for name in ("fs", "shaft", "source", "metadata", "others")
        }
        return _remade, (mappings | rest,)

    @property
    def _columns(self) -> Mapping[str, NDArray[np.float64]]:
        return self.columns

    def __repr__(self) -> str:
        size = f"{len(self)} columns, {self.n_samples} samples at {self.fs:g} Hz"
        names = ", ".join(f"{name} [{self.units[name] or '?'}]" for name in self)
        beside = ", ".join(
            f"{name} ({one.n_samples} samples)" for one in self.others for name in one
        )
        return f"<Recording: {size}: {names}{beside and f'; others: {beside}'}>"

    @property
    def n_samples(self) -> int:
        """Number of samples of each column."""
        return next(iter(self.columns.values())).size

    @property
    def t(self) -> NDArray[np.float64]:
        """Times from the first sample, shape (n_samples,) [s]."""
        return np.arange(self.n_samples) / self.fs

    def _with(self, columns: Mapping[str, NDArray[np.float64]]) -> Recording:
        units = {name: self.units[name] for name in columns}
        return replace(self, columns=columns, units=units)

    def _metadata(self) -> dict[str, Any]:
        shaft = None if self.shaft is None else float(self.shaft)
        return {"shaft": shaft, "metadata": dict(self.metadata)}

    def _known(self) -> dict[str, Any]:
        return {"shaft": self.shaft or None}

    def _origin(self) -> Origin:
        shaft = self.shaft
        return Origin() if shaft is None else Origin(speed=lambda _: 2.0 * math.pi * shaft)


def _remade(fields: dict[str, Any]) -> Recording:
    return Recording(**fields)


def _by_names(array: object) -> dict[str, Any]:
    """Return a vector, or the columns of a matrix, by names; anything else as it is."""
    if not hasattr(array, "__array__"):
        return array  # type: ignore[return-value]
    values = np.asanyarray(array)
    if values.ndim == 2 and values.dtype.kind in "biuf":
        return {f"x_{place + 1}": values[:, place] for place in range(values.shape[1])}
    return {"x": values} if values.dtype.kind in "biuf" else array  # type: ignore[return-value]


def _checked(name: str, x: Any) -> NDArray[np.float64]:
    values = real_row(f"columns[{name!r}]", x)
    if values.ndim != 1 or values.size == 0:
        raise SceneError(f"columns[{name!r}]", f"an array of shape {values.shape}", "of shape (n,)")
    return read_only(values)
