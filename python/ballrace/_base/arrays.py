"""The bindings' access to numpy's arrays, set up when the package is imported.

They would set it up at their first array, where Ctrl-C would make them panic.
"""

from __future__ import annotations

import numpy as np

from .. import _core

try:
    _core.hann_weighted(np.zeros(1))
except BaseException as error:
    if type(error).__name__ == "PanicException":
        raise KeyboardInterrupt from None
    raise
