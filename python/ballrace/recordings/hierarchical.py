"""HDF5: a data set a column, with its unit; rate and the rest are attributes of the file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import FileError
from .libraries import needed
from .samples import RATES, Samples, from_told

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray


def write(samples: Samples, temporary: Path, path: Path) -> None:
    """Write a data set a column with the attribute ``units``, and the rest as attributes of the file."""
    h5py = needed("h5py", path.name)
    with h5py.File(temporary, "w") as file:
        file.attrs["sampling_rate"] = samples.fs
        file.attrs["ballrace"] = samples.told()
        for name, x in samples.columns.items():
            file.create_dataset(name, data=x).attrs["units"] = samples.units.get(name, "")


def read(path: Path) -> Samples:
    """Read all data sets of one dimension and of the length that most samples have.

    Raises
    ------
    FileError
        It is damaged, no HDF5, or holds no such data set.
    """
    arrays, units, told = contents(path)
    if "ballrace" in told:
        return from_told(path, str(told["ballrace"]), arrays)
    rate = next((told[name] for name in RATES if name in told), None)
    sizes = [x.size for x in arrays.values() if x.size > 1]
    longest = max(sizes, key=lambda size: size * sizes.count(size), default=0)
    columns = {name: x for name, x in arrays.items() if x.size == longest and longest}
    if not columns:
        raise FileError(str(path), "holds no data set that could be a signal")
    return Samples(columns=columns, fs=None if rate is None else float(rate), units=units)


def contents(
    path: Path,
) -> tuple[dict[str, NDArray[np.float64]], dict[str, str], dict[str, Any]]:
    """Return the vectors of a file, their units, and attributes and single numbers.

    Raises
    ------
    FileError
        It is damaged, or no HDF5.
    """
    h5py = needed("h5py", path.name)
    arrays: dict[str, NDArray[np.float64]] = {}
    units: dict[str, str] = {}

    def visit(name: str, node: Any) -> None:
        if (
            isinstance(node, h5py.Dataset)
            and node.dtype.kind in "fiu"
            and max(node.shape, default=1) == node.size
        ):
            arrays[name] = np.asarray(node[()], dtype=np.float64).ravel()
            units[name] = str(node.attrs.get("units", ""))

    try:
        with h5py.File(path, "r") as file:
            told = dict(file.attrs)
            file.visititems(visit)
    except (OSError, RuntimeError, ValueError, KeyError) as error:
        raise FileError(str(path), f"not an HDF5 file, or damaged ({error})") from error
    single = {name: float(x[0]) for name, x in arrays.items() if x.size == 1}
    return {name: x for name, x in arrays.items() if x.size > 1}, units, {**single, **told}
