"""A record from any source."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._numbers import real, real_row, sampling_rate
from ..errors import SceneError
from .columns import Columns
from .windows import Origin

__all__ = ["Recording"]


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Recording(Columns):
    """A measured record: a mapping from the names of columns to arrays, at one sampling rate.

    Made by :func:`ballrace.read`, or from arrays.

    Attributes
    ----------
    columns : mapping of str to ndarray
        Columns, each of shape (n,).
    fs : float
        Sampling rate [Hz].
    units : mapping of str to str
        Unit of each column; empty where it is not known.
    shaft : float or None
        Mean rate of the shaft [Hz], if it is known.
    source : str
        The file it was read from.
    metadata : mapping
        Further metadata of the file.
    others : tuple of Recording
        Columns of the same file at other rates.

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

    columns: Mapping[str, NDArray[np.float64]]
    fs: float
    units: Mapping[str, str] = field(default_factory=dict)
    shaft: float | None = None
    source: str = ""
    metadata: Mapping[str, Any] = field(default_factory=dict)
    others: tuple[Recording, ...] = ()

    def __post_init__(self) -> None:
        for name in ("columns", "units", "metadata"):
            if not isinstance(getattr(self, name), Mapping):
                raise SceneError(name, type(getattr(self, name)).__name__, "a mapping by names")
        columns = {str(name): _checked(str(name), x) for name, x in self.columns.items()}
        if len({x.size for x in columns.values()}) != 1:
            sizes = ", ".join(f"{name}: {x.size}" for name, x in columns.items())
            raise SceneError("columns", sizes or "none", "at least one, all of one length")
        sampling_rate(self.fs)
        if self.shaft is not None and not 0.0 <= real(self.shaft) < math.inf:
            raise SceneError("shaft", repr(self.shaft), "a rate, or None")
        units = {name: str(self.units.get(name, "")) for name in columns}
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
        return f"<Recording: {size}: {names}>"

    @property
    def n_samples(self) -> int:
        """Number of samples of each column."""
        return next(iter(self.columns.values())).size

    @property
    def t(self) -> NDArray[np.float64]:
        """Times from the first sample, shape (n_samples,) [s]."""
        return np.arange(self.n_samples) / self.fs

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


def _checked(name: str, x: Any) -> NDArray[np.float64]:
    values = real_row(f"columns[{name!r}]", x)
    if values.ndim != 1 or values.size == 0:
        raise SceneError(f"columns[{name!r}]", f"an array of shape {values.shape}", "of shape (n,)")
    return values
