"""Bodies of a bearing as meshes: rings turned from their outlines and cut open, balls, patches of contact."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles.

    Attributes
    ----------
    points : ndarray, shape (n, 3)
        Corners, in the unit of what they are made from.
    triangles : ndarray of int, shape (m, 3)
        Corners of each.
    """

    points: Array
    triangles: NDArray[np.int64]


def ring(outline: Array, start: float, end: float, steps: int = 60) -> Mesh:
    """Return what a closed outline (axial place and radius) sweeps from one angle to another [rad]."""
    line = outline[:-1] if np.allclose(outline[0], outline[-1]) else outline
    turn = np.linspace(start, end, steps + 1)[:, None]
    z, r = line[:, 0] + 0.0 * turn, line[:, 1]
    points = np.stack([r * np.cos(turn), r * np.sin(turn), z], axis=-1).reshape(-1, 3)
    rows, columns = np.meshgrid(np.arange(steps), np.arange(len(line)))
    a = (rows * len(line) + columns).ravel()
    b = (rows * len(line) + (columns + 1) % len(line)).ravel()
    above = np.stack([b, b + len(line), a + len(line)], -1)
    return Mesh(points, np.vstack([np.stack([a, b, a + len(line)], -1), above]))


def ball() -> Mesh:
    """Return a ball of radius 1 with 42 corners: an icosahedron, each edge halved once."""
    golden = 0.5 * (1.0 + math.sqrt(5.0))
    corners = np.array(
        [[0.0, s, t * golden] for s in (-1.0, 1.0) for t in (-1.0, 1.0)]
        + [[s, t * golden, 0.0] for s in (-1.0, 1.0) for t in (-1.0, 1.0)]
        + [[t * golden, 0.0, s] for s in (-1.0, 1.0) for t in (-1.0, 1.0)]
    )
    corners /= np.linalg.norm(corners, axis=1)[:, None]
    near = np.linalg.norm(corners[:, None] - corners, axis=2) < 1.2
    faces = [
        (i, j, k)
        for i in range(12) for j in range(i + 1, 12) for k in range(j + 1, 12)
        if near[i, j] and near[j, k] and near[i, k]
    ]  # fmt: skip
    points, found = list(corners), dict[tuple[int, int], int]()

    def halved(i: int, j: int) -> int:
        if (key := (min(i, j), max(i, j))) not in found:
            middle = points[i] + points[j]
            points.append(middle / np.linalg.norm(middle))
            found[key] = len(points) - 1
        return found[key]

    triangles = []
    for i, j, k in faces:
        a, b, c = halved(i, j), halved(j, k), halved(k, i)
        triangles += [(i, a, c), (j, b, a), (k, c, b), (a, b, c)]
    made = np.array(points)
    inward = np.linalg.det(made[triangles]) < 0.0
    turned = np.array(triangles)
    turned[inward] = turned[inward][:, ::-1]
    return Mesh(made, turned)


def patch() -> Mesh:
    """Return a hexagon, of corners 1 from its middle, in the plane of y and z."""
    turn = np.linspace(0.0, 2.0 * math.pi, 6, endpoint=False)
    k = np.arange(1, 5)
    rim = np.stack([0.0 * turn, np.cos(turn), np.sin(turn)], axis=-1)
    return Mesh(rim, np.stack([0 * k, k, k + 1], axis=-1))


def repeated(triangles: NDArray[np.int64], corners: int, count: int) -> NDArray[np.int64]:
    """Return the triangles of equal bodies one behind the other, each with so many corners."""
    return np.vstack([triangles + corners * k for k in range(count)])
