"""Moving parts in three dimensions, picture by picture, as whole numbers of 16 bits: a page has 5 kB for each."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from .._base.libraries import go
from ..frequencies.operating import operating_angle
from ..scene.defect import extent
from ..statics import equilibrium
from .ellipse import semi_axes
from .maps import SHADES
from .outlines import outlines, race_radius
from .solids import ball, patch, repeated, ring
from .style import COLOURS

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..signals import Signals

Array = NDArray[np.float64]
Race = Literal["outer", "inner"]

_RACES: tuple[Race, Race] = ("outer", "inner")
_LARGEST = 30_000
"""Whole number that stands for the outside radius."""

_OPEN = math.radians(80.0)
"""Sector that is cut out of the rings, from +x on."""

_SPOT = math.radians(40.0)
"""Reach of a spot on a ball, which shows that it rolls."""

_LIGHT = {"ambient": 0.65, "diffuse": 0.6, "specular": 0.1, "roughness": 0.9}


class Turning:
    """Traces of a row in a run: rings, which stay, and what moves with a sample; lengths in a unit of its own."""

    def __init__(self, out: Signals, row: int, enlarged: float) -> None:
        self._out, self._row, self._scene = out, row, out.scene
        self._of_row, self._shapes = out.scene.rows[row], outlines(out.scene)
        self._unit = 1e-3 * self._shapes.outside / _LARGEST
        self._radius = 0.5 * self._of_row.ball_diameter
        self._ball, self._patch, self._enlarged = ball(), patch(), enlarged
        self._angle = operating_angle(out.scene, row)
        count = self._of_row.ball_count
        names = [f"row{row}_ball{k}" for k in range(count)]
        self._places = np.array([[out[f"{name}.{axis}"] for axis in "xyz"] for name in names])
        self._turns = np.array([out[f"{name}.theta"] for name in names])
        self._loads = np.array(
            [[out[f"row{row}.ball{k}.{race}.load"] for k in range(count)] for race in _RACES]
        )
        self._pressures = self._pressed()
        self.largest_pressure = float(self._pressures.max())

    def _pressed(self) -> Array:
        """Return largest Hertz pressures [Pa], shape (2, balls, samples): they go with the cube root of a load."""
        eq = equilibrium(self._scene.replace({"defects": {}}))
        of = eq.row == self._row
        found = []
        for race, loads in zip(_RACES, self._loads, strict=True):
            load, pressure = getattr(eq, f"{race}_load")[of], getattr(eq, f"{race}_pressure")[of]
            heaviest = int(load.argmax())
            found.append(pressure[heaviest] * np.cbrt(loads / load[heaviest]))
        return np.array(found)

    def still(self) -> Iterator[Any]:
        """Give the rings, cut open, defects of an outer race that stands, and the cage, alike however it turns."""
        kinds = {"outer ring": ("outer", "#9fb3c8", 0.3), "inner ring": ("inner", "#8fa3ba", 0.55)}
        for name, (shape, colour, opacity) in kinds.items():
            outline = 1e-3 * _thinned(getattr(self._shapes, shape))
            mesh = ring(outline, _OPEN if shape == "outer" else 0.0, 2.0 * math.pi)
            yield go.Mesh3d(
                **self._axes(mesh.points), **_corners(mesh.triangles), color=colour, opacity=opacity, name=name,
                flatshading=True, hoverinfo="skip", lighting=_LIGHT,
            )  # fmt: skip
        around = np.linspace(0.0, 2.0 * math.pi, 97)
        cage = _arc(0.5 * self._of_row.pitch_diameter, around, self._of_row.axial_position)
        stands = {} if self._outer_turns else self._damages("outer_race", 0.0)
        for name, points in ({"cage": cage} | stands).items():
            yield go.Scatter3d(**self._axes(points), **_style(name))

    def at(self, k: int) -> list[Any]:
        """Return what changes of :meth:`first` at a sample, in its order: all but places along the axis."""
        shade = np.round(1e-6 * self._pressures[:, :, k].ravel()).astype(np.int16)
        patches = self._patches(k)
        found = [
            go.Mesh3d(self._across(self._balls(k))),
            go.Mesh3d(self._across(patches), intensity=np.repeat(shade, len(self._patch.points))),
        ]
        return found + [go.Scatter3d(self._across(line)) for line in self._lines(k).values()]

    def first(self, k: int) -> list[Any]:
        """Return balls, contact patches, the shaft's mark and defects of the inner race, whole."""
        count = self._of_row.ball_count
        balls, patches, *lines = self.at(k)
        bar = {"title": {"text": "largest pressure / GPa"}, "len": 0.6, "thickness": 12}
        balls.update(
            z=self._whole(self._balls(k))[:, 2], intensity=self._spots(), cmin=0, cmax=2, showscale=False,
            **_corners(repeated(self._ball.triangles, len(self._ball.points), count)),
            name="balls", hoverinfo="skip", lighting=_LIGHT,
            colorscale=[[0.0, "#e8edf2"], [0.5, "#4a6fa5"], [1.0, COLOURS[1]]],
        )  # fmt: skip
        patches.update(
            z=self._whole(self._patches(k))[:, 2], cmin=0, cmax=1e-6 * self.largest_pressure, colorscale=SHADES,
            **_corners(repeated(self._patch.triangles, len(self._patch.points), 2 * count)), name="contacts",
            colorbar=bar | _gigapascals(self.largest_pressure), hoverinfo="skip", lighting={"ambient": 1.0},
        )  # fmt: skip
        for line, (name, points) in zip(lines, self._lines(k).items(), strict=True):
            line.update(z=self._whole(points)[:, 2], **_style(name))
        return [balls, patches, *lines]

    def _spots(self) -> NDArray[np.int16]:
        """Return 1 where a ball's spot is, 2 where its damage is, at the corners of all balls."""
        points = self._ball.points
        spots = np.tile(points[:, 0] > math.cos(_SPOT), self._of_row.ball_count).astype(np.int16)
        for defect in self._scene.defects.values():
            if defect.on == "ball" and defect.row == self._row:
                towards = [math.cos(defect.angle), math.sin(defect.angle), 0.0]
                nearest = int((points @ towards).argmax())
                spots[int(defect.ball or 0) * len(points) + nearest] = 2
        return spots

    def _balls(self, k: int) -> Array:
        """Balls turn about the bearing's axis here, whatever else they do, so that z stays."""
        turned = self._turns[:, k, None]
        x, y, z = self._radius * self._ball.points.T
        across = np.cos(turned) * x - np.sin(turned) * y
        up = np.sin(turned) * x + np.cos(turned) * y
        points = np.stack([across, up, z + 0.0 * turned], -1) + self._places[:, None, :, k]
        whole: Array = points.reshape(-1, 3)
        return whole

    def _patches(self, k: int) -> Array:
        found = []
        for number, (race, outward) in enumerate(zip(_RACES, (1.0, -1.0), strict=True)):
            load, pressure = self._loads[number, :, k], self._pressures[number, :, k]
            a, b = semi_axes(self._of_row, race, load, pressure)
            found.append(self._ellipses(outward, a, b, k))
        return np.concatenate(found).reshape(-1, 3)

    def _ellipses(self, outward: float, a: Array, b: Array, k: int) -> Array:
        """Return the corners of a race's ellipses, across (a) and along the rolling direction (b), enlarged."""
        x, y, z = self._places[:, :, k].T
        phi = np.arctan2(y, x)
        radial = np.stack([np.cos(phi), np.sin(phi), 0.0 * phi], -1)
        along = np.stack([-np.sin(phi), np.cos(phi), 0.0 * phi], -1)
        axial = np.array([0.0, 0.0, 1.0])
        axial_share = self._of_row.side * outward * math.sin(self._angle)
        normal = outward * math.cos(self._angle) * radial + axial_share * axial
        across = np.cross(normal, along)
        middle = np.stack([x, y, z], -1) + 1.01 * self._radius * normal
        _, u, v = self._patch.points.T
        size = self._enlarged
        ellipse = (size * b)[:, None, None] * u[:, None] * along[:, None]
        ellipse = ellipse + (size * a)[:, None, None] * v[:, None] * across[:, None]
        corners: Array = middle[:, None] + ellipse
        return corners

    def _lines(self, k: int) -> dict[str, Array]:
        """Return the shaft's mark and defects of races that turn by their names."""
        theta = float(self._out["inner.theta"][k])
        found = {"shaft": self._mark(theta)} | self._damages("inner_race", theta)
        if self._outer_turns:
            found |= self._damages("outer_race", float(self._out["outer.theta"][k]))
        return found

    @property
    def _outer_turns(self) -> bool:
        return self._scene.outer_speed is not None

    def _mark(self, theta: float) -> Array:
        """Mark the bore, which shows how far the shaft has turned."""
        radius, z = (
            1e-3 * self._shapes.bore,
            1e-3 * np.array([self._shapes.left, self._shapes.right]),
        )
        return _arc(radius, np.full(2, theta), z)

    def _damages(self, on: str, theta: float) -> dict[str, Array]:
        radius = race_radius(self._of_row, on)
        found = {}
        for name, defect in self._scene.defects.items():
            if defect.on == on and defect.row == self._row:
                half = max(0.5 * extent(defect) / radius, 0.02)
                offset = defect.axial_offset if isinstance(defect.axial_offset, float) else 0.0
                arc = defect.angle + theta + np.linspace(-half, half, 5)
                found[name] = _arc(radius, arc, self._of_row.axial_position + offset)
        return found

    def _axes(self, points: Array) -> dict[str, NDArray[np.int16]]:
        return dict(zip("xyz", self._whole(points).T, strict=True))

    def _across(self, points: Array) -> dict[str, NDArray[np.int16]]:
        return dict(zip("xy", self._whole(points)[:, :2].T, strict=True))

    def _whole(self, metres: Array) -> NDArray[np.int16]:
        return np.round(metres / self._unit).astype(np.int16)


def _thinned(outline: Array) -> Array:
    """Return an outline with every second point, and all corners that are farther apart."""
    step = np.linalg.norm(np.diff(outline, axis=0), axis=1)
    small = np.append(step < 2.0 * np.median(step), False)
    kept = ~small | ~np.roll(small, 1) | (np.arange(len(outline)) % 2 == 0)
    thinned: Array = outline[kept]
    return thinned


def _arc(radius: float, angles: Array, z: Any) -> Array:
    return np.stack([radius * np.cos(angles), radius * np.sin(angles), z + 0.0 * angles], -1)


def _style(name: str) -> dict[str, Any]:
    colour, width = {"cage": ("#8a6d3b", 9), "shaft": ("#333333", 8)}.get(name, (COLOURS[1], 14))
    return {
        "mode": "lines",
        "name": name,
        "line": {"color": colour, "width": width},
        "hoverinfo": "skip",
    }


def _corners(triangles: NDArray[np.int64]) -> dict[str, NDArray[np.uint16]]:
    return dict(zip("ijk", triangles.T.astype(np.uint16), strict=True))


def _gigapascals(largest: float) -> dict[str, Any]:
    """Return the ticks of a scale whose whole numbers are MPa."""
    ticks = np.linspace(0.0, 1e-6 * largest, 5)
    return {"tickvals": ticks.tolist(), "ticktext": [f"{1e-3 * each:.2f}" for each in ticks]}
