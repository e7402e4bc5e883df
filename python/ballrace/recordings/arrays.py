"""NPY and NPZ: arrays as numpy saves them, a vector, a matrix, or several by names."""

from __future__ import annotations

import zipfile
import zlib
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import FileError
from .limits import check_declared
from .tree import Leaf, Tree, from_tree

if TYPE_CHECKING:
    from pathlib import Path

    from .reading import Reading
    from .samples import Samples

_OTHER_WAY = 'np.load(path) and br.Recording(array, fs=fs, unit="g") take what it holds'


def read_npy(path: Path, reading: Reading) -> Samples:
    """Read one array; a structured one has its columns by names.

    Raises
    ------
    FileError
        It is damaged, holds objects, or no signal.
    """
    try:
        array = np.load(path, mmap_mode="r", allow_pickle=False)
        check_declared(path, float(array.size))
    except (ValueError, OSError, EOFError, SyntaxError, TypeError, OverflowError) as error:
        raise FileError(
            str(path), f"not an NPY file, or damaged ({error}); {_OTHER_WAY}"
        ) from error
    return from_tree(path, _tree(path.stem or "array", array), reading)


def read_npz(path: Path, reading: Reading) -> Samples:
    """Read several arrays by their names; single numbers may state the rate, texts are kept.

    Raises
    ------
    FileError
        It is damaged, holds objects, or no signal.
    """
    tree: Tree = {}
    try:
        with zipfile.ZipFile(path) as file:
            check_declared(path, sum(one.file_size for one in file.infolist()) / 8.0)
        with np.load(path, allow_pickle=False) as arrays:
            for name in arrays.files:
                tree |= _tree(name, arrays[name])
    except FileError:
        raise
    except (ValueError, OSError, EOFError, SyntaxError, KeyError, TypeError, OverflowError, NotImplementedError,
            RuntimeError, zipfile.BadZipFile, zlib.error) as error:  # fmt: skip
        raise FileError(
            str(path), f"not an NPZ file, or damaged ({error}); {_OTHER_WAY}"
        ) from error
    return from_tree(path, tree, reading)


def _tree(name: str, array: Any) -> Tree:
    """Return an array by its name; the columns of a structured one by theirs."""
    if not isinstance(array, np.ndarray):
        return {}
    if array.dtype.names:
        return {
            field: part
            for field in array.dtype.names
            for part in _tree(field, array[field]).values()
        }
    if array.dtype.kind == "U":
        texts = [str(text) for text in array.ravel()]
        return {name: texts[0] if array.size == 1 else texts}
    if array.dtype.kind == "M":
        array = array.astype("M8[ns]").astype(np.int64) * 1e-9
    if array.dtype.kind not in "fiub" or array.size == 0:
        return {}
    return {name: float(array.ravel()[0]) if array.size == 1 else Leaf(array)}
