"""The way of the bindings to numpy's arrays, found as the package is imported.

They look for it at their first array, and Ctrl-C in the middle of that would be a panic of theirs.
"""

from __future__ import annotations

import numpy as np

from . import _core

try:
    _core.hann_weighted(np.zeros(1))
except BaseException as error:
    if type(error).__name__ == "PanicException":
        raise KeyboardInterrupt from None
    raise
