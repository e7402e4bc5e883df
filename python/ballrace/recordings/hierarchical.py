"""HDF5: data sets as columns or matrices, with their units; rate and the rest are attributes, or beside them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .._base.libraries import needed
from ..errors import FileError
from .limits import check_declared
from .sampled import cut
from .samples import Samples, from_header
from .tree import Leaf, Tree, from_tree, leaves

if TYPE_CHECKING:
    from pathlib import Path

    from .reading import Reading

_DEEPEST = 12
_MOST = 20_000
"""Groups in groups, and objects, that are looked at."""


def write(samples: Samples, temporary: Path, path: Path) -> None:
    """Write a data set a column with the attribute ``units``, and the rest as attributes of the file."""
    h5py = needed("h5py", path.name)
    with h5py.File(temporary, "w") as file:
        file.attrs["sampling_rate"] = samples.fs
        file.attrs["ballrace"] = samples.header()
        for name, x in samples.columns.items():
            file.create_dataset(name, data=x).attrs["units"] = samples.units.get(name, "")


def read(path: Path, reading: Reading) -> Samples:
    """Read the data sets that are signals.

    Raises
    ------
    FileError
        It is damaged, no HDF5, or holds no such data set.
    """
    tree = contents(path)
    header = tree.get("ballrace")
    if isinstance(header, str):
        arrays = {name: leaf.values for name, leaf in tree.items() if isinstance(leaf, Leaf)}
        return cut(path, from_header(path, header, arrays), reading)
    return from_tree(path, tree, reading, joint="/")


def contents(path: Path, *, matlab: bool = False) -> Tree:
    """Return what a file holds; of MATLAB's as MATLAB shows it: matrices turned, texts, cells and structs.

    Raises
    ------
    FileError
        It is damaged, or no HDF5.
    """
    h5py = needed("h5py", path.name)
    try:
        with h5py.File(path, "r") as file:
            tree = _Looking(path, file, h5py, matlab=matlab).tree()
            check_declared(path, sum(float(leaf.values.size) for leaf in leaves(tree)))
            loaded: Tree = _loaded(tree, matlab=matlab)
            return loaded
    except FileError:
        raise
    except (
        OSError,
        RuntimeError,
        ValueError,
        KeyError,
        TypeError,
        AttributeError,
        OverflowError,
    ) as error:
        raise FileError(str(path), f"not an HDF5 file, or damaged ({error})") from error


class _Looking:
    """A walk through the objects of a file, before anything large is read."""

    def __init__(self, path: Path, file: Any, h5py: Any, *, matlab: bool) -> None:
        self._path, self._file, self._h5py, self._matlab = path, file, h5py, matlab
        self._seen = 0
        _check_links(path, file, h5py)

    def tree(self) -> Tree:
        return self._group(self._file, 0)

    def _group(self, group: Any, depth: int) -> Tree:
        tree: Tree = _attributes(group)
        for name in group:
            if name.startswith("#"):  # what cells lead to
                continue
            value = self._node(group[name], depth + 1)
            if value is not None:
                tree[name] = value
        return self._struct_array(tree) if self._matlab and depth else tree

    def _struct_array(self, tree: Tree) -> Any:
        """Return an array of structs as a list, which MATLAB stores field by field."""
        fields = {name: value for name, value in tree.items() if isinstance(value, _References)}
        rest = {name: value.values for name, value in fields.items()}
        lengths = {len(value) for value in rest.values()}
        if not fields or len(lengths) != 1 or any(value.is_cell for value in fields.values()):
            return tree | rest
        (count,) = lengths
        return [{name: value[place] for name, value in rest.items()} for place in range(count)]

    def _node(self, node: Any, depth: int) -> Any:
        self._seen += 1
        if depth > _DEEPEST or self._seen > _MOST:
            raise FileError(
                str(self._path), "damaged: its groups are nested without end, or too many"
            )
        if isinstance(node, self._h5py.Group):
            return self._group(node, depth)
        if not isinstance(node, self._h5py.Dataset) or node.shape is None:
            return None
        kind, attributes = node.dtype.kind, _attributes(node)
        form = attributes.get("MATLAB_class", "")
        if attributes.get("MATLAB_empty", 0.0):
            return None
        if self._matlab and form == "char" and node.size <= 10_000:
            return "".join(map(chr, np.ravel(node[()], order="F")))
        if kind == "O" and self._h5py.check_ref_dtype(node.dtype) is not None:
            return self._references(node, depth, is_cell=form == "cell")
        if (kind == "O" and self._h5py.check_string_dtype(node.dtype) is not None) or kind == "S":
            return _attribute(node[()]) if node.size <= 1000 else None
        if kind not in "fiub":
            return None
        return Leaf(node, attributes)

    def _references(self, node: Any, depth: int, *, is_cell: bool) -> Any:
        if not self._matlab or node.size > _MOST:
            return None
        inner = [
            self._node(self._file[one], depth + 1) for one in np.ravel(node[()], order="F") if one
        ]
        found = _References(inner, is_cell=is_cell)
        return found if depth > 1 and not is_cell else found.values


class _References:
    """Target of a data set of references: a cell, or a field of an array of structs."""

    def __init__(self, values: list[Any], *, is_cell: bool) -> None:
        self.values, self.is_cell = values, is_cell


def _check_links(path: Path, file: Any, h5py: Any) -> None:
    """Refuse a file that leads to others: one from somebody else could have any file read.

    Raises
    ------
    FileError
        It does.
    """
    elsewhere: list[str] = []

    def look_at(name: str, link: Any) -> None:
        # HDF5 does not stand errors raised in here.
        if isinstance(link, h5py.ExternalLink):
            elsewhere.append(name)

    def look_into(name: str, node: Any) -> None:
        if isinstance(node, h5py.Dataset) and (node.external or node.is_virtual):
            elsewhere.append(name)

    file.visititems_links(look_at)
    file.visititems(look_into)
    if elsewhere:
        raise FileError(str(path), f"refused: what it has as {elsewhere[0]} is in another file")


def _attributes(node: Any) -> dict[str, Any]:
    """Return the attributes of an object."""
    return {name: _attribute(value) for name, value in node.attrs.items() if _is_plain(value)}


def _is_plain(value: Any) -> bool:
    return isinstance(value, str | bytes | int | float | np.generic | np.ndarray)


def _attribute(value: Any) -> Any:
    """Return an attribute or a small data set as a float, a text, a list of texts, or an array."""
    if isinstance(value, bytes | np.bytes_):
        return value.decode("utf-8", errors="replace")
    if isinstance(value, np.ndarray) and value.dtype.kind in "SO":
        texts = [_attribute(one) for one in np.ravel(value)]
        return texts[0] if value.ndim == 0 or len(texts) == 1 else texts
    if isinstance(value, np.ndarray):
        number = value.size == 1 and value.dtype.kind in "fiub"
        return float(value.ravel()[0]) if number else str(value.tolist())[:200]
    if isinstance(value, int | float | np.number):
        return float(value)
    return str(value)


def _loaded(tree: Any, *, matlab: bool) -> Any:
    """Return a tree with its arrays read; those of one number as a float."""
    match tree:
        case dict():
            return {name: _loaded(value, matlab=matlab) for name, value in tree.items()}
        case list():
            return [_loaded(value, matlab=matlab) for value in tree]
        case Leaf(values=node, attributes=attributes):
            values = np.asarray(node[()])
            if values.size == 1:
                return float(values.ravel()[0])
            return Leaf(values.T if matlab else values, attributes)
    return tree
