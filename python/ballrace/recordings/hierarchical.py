"""HDF5: a data set a column, with its unit; rate and the rest are attributes of the file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .._libraries import needed
from ..errors import FileError
from .limits import check_declared
from .samples import RATES, Samples, from_header

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray


def write(samples: Samples, temporary: Path, path: Path) -> None:
    """Write a data set a column with the attribute ``units``, and the rest as attributes of the file."""
    h5py = needed("h5py", path.name)
    with h5py.File(temporary, "w") as file:
        file.attrs["sampling_rate"] = samples.fs
        file.attrs["ballrace"] = samples.header()
        for name, x in samples.columns.items():
            file.create_dataset(name, data=x).attrs["units"] = samples.units.get(name, "")


def read(path: Path) -> Samples:
    """Read all data sets of one dimension and of the length that most samples have.

    Raises
    ------
    FileError
        It is damaged, no HDF5, or holds no such data set.
    """
    arrays, units, attributes = contents(path)
    if "ballrace" in attributes:
        return from_header(path, str(attributes["ballrace"]), arrays)
    rate = next((attributes[name] for name in RATES if name in attributes), None)
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
    try:
        with h5py.File(path, "r") as file:
            attributes = dict(file.attrs)
            nodes = _vectors(path, file, h5py)
            check_declared(path, sum(float(node.size) for node in nodes.values()))
            arrays = {n: np.asarray(x[()], dtype=np.float64).ravel() for n, x in nodes.items()}
            units = {name: str(node.attrs.get("units", "")) for name, node in nodes.items()}
    except FileError:
        raise
    except (OSError, RuntimeError, ValueError, KeyError, TypeError) as error:
        raise FileError(str(path), f"not an HDF5 file, or damaged ({error})") from error
    single = {name: float(x[0]) for name, x in arrays.items() if x.size == 1}
    return {name: x for name, x in arrays.items() if x.size > 1}, units, {**single, **attributes}


def _vectors(path: Path, file: Any, h5py: Any) -> dict[str, Any]:
    """Return the data sets that are vectors of numbers.

    Raises
    ------
    FileError
        It leads to another file: a file from somebody else could have any file read.
    """
    found: dict[str, Any] = {}

    elsewhere: list[str] = []

    def look_at(name: str, link: Any) -> None:
        # HDF5 does not stand errors raised in here.
        if isinstance(link, h5py.ExternalLink):
            elsewhere.append(name)

    def take(name: str, node: Any) -> None:
        if not isinstance(node, h5py.Dataset):
            return
        if node.external or node.is_virtual:
            elsewhere.append(name)
        elif node.shape is None or node.dtype.kind not in "fiu":
            return
        elif max(node.shape, default=1) == node.size:
            found[name] = node

    file.visititems_links(look_at)
    file.visititems(take)
    if elsewhere:
        raise FileError(str(path), f"refused: what it has as {elsewhere[0]} is in another file")
    return found
