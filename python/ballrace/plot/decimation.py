"""Fewer points that look the same."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def min_max(t: Array, x: Array, points: int = 4000) -> tuple[Array, Array]:
    """Return the smallest and the largest sample of each of equal pieces, in their order in time.

    A picture of a few thousand pixels shows the same, every peak included.

    Parameters
    ----------
    t, x : ndarray, shape (n,)
        Times and samples.
    points : int
        Points that are left, at most; fewer samples stay as they are.

    Examples
    --------
    >>> t = np.arange(10_000.0)
    >>> x = np.zeros(10_000); x[1234] = 5.0
    >>> few_t, few_x = min_max(t, x, 100)
    >>> few_x.size, float(few_t[np.argmax(few_x)])
    (100, 1234.0)
    """
    if x.size <= points:
        return t, x
    edges = np.linspace(0, x.size, points // 2 + 1).astype(int)
    pieces = [(a, x[a:b]) for a, b in pairwise(edges.tolist())]
    extremes = [sorted((a + int(p.argmin()), a + int(p.argmax()))) for a, p in pieces]
    kept = np.array(extremes).ravel()
    return t[kept], x[kept]
