"""The machine around the outer ring, as a structure with modes."""

from __future__ import annotations

import csv
import math
import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from .._base.document import LEFT_OUT, Part
from .._io.files import as_path
from ..errors import SceneError

__all__ = ["Compliance", "Mode", "Structure"]

Compliance = (
    float
    | tuple[float, float, float]
    | tuple[
        tuple[float, float, float],
        tuple[float, float, float],
        tuple[float, float, float],
    ]
)
"""Compliance of a point [m/N]: the same along x, y and z, one number for each, or a symmetric 3 x 3 matrix."""

_NUMBERS = ("frequency", "damping", "mass")
_AXES = ("x", "y", "z")


@dataclass(frozen=True, kw_only=True)
class Mode(Part):
    """A mode of a structure, as finite elements or a modal test give it.

    A shape is the displacement of a point where the mode's coordinate is 1; shapes times c and the mass times c²
    are the same mode.

    Attributes
    ----------
    frequency : float
        Natural frequency [Hz], above 0.
    damping : float
        Damping ratio [1], from 0 to below 1.
    mass : float
        Modal mass [kg], above 0.
    seat : tuple of three floats
        Shape along x, y, z at the seat on which the outer ring stands [1].
    sensors : mapping of str to tuple of three floats
        Shapes at sensors by their names [1]; a mode does not move the sensors that it does not list.
    """

    frequency: float
    damping: float
    mass: float
    seat: tuple[float, float, float]
    sensors: Mapping[str, tuple[float, float, float]] = field(
        default_factory=lambda: MappingProxyType({})
    )

    def __hash__(self) -> int:
        own = (self.frequency, self.damping, self.mass, self.seat)
        return hash((own, frozenset(self.sensors.items())))


@dataclass(frozen=True, kw_only=True)
class Structure(Part):
    """The machine around the outer ring: a structure with modes, on which the ring stands.

    The springs of ``outer_ring.support`` along x, y and z end at the seat, a point of the structure, instead of on
    the ground, and the force of the ring on it drives the modes. A structure takes part in the dynamics; its
    sensors are the columns ``housing.<sensor>.ax``, ``ay`` and ``az`` [m/s²], the force on its seat ``seat.fx``,
    ``fy`` and ``fz`` [N].

    Attributes
    ----------
    modes : tuple of Mode
        The modes, at least one.
    static_compliance : Compliance or None
        Residual compliance of the seat [m/N]: what modes beyond those listed give under a static force, in series
        with the springs of the ring's support; None: nothing.

    Examples
    --------
    >>> import ballrace as br
    >>> foot = br.Mode(frequency=1200.0, damping=0.05, mass=2.0, seat=(0, 1, 0), sensors={"top": (0, 1, 0)})
    >>> scene = br.bearing("6205", speed_rpm=1800.0, housing=br.Structure(modes=[foot]))
    >>> out = br.simulate(scene, duration=0.002)
    >>> out["housing.top.ay"].shape == out["seat.fy"].shape
    True
    """

    modes: tuple[Mode, ...]
    static_compliance: Compliance | None = field(default=None, metadata=LEFT_OUT)

    @property
    def sensors(self) -> tuple[str, ...]:
        """Names of the sensors of all modes, in alphabetical order."""
        return tuple(sorted({name for mode in self.modes for name in mode.sensors}))

    @classmethod
    def from_table(cls, path: str | os.PathLike[str]) -> Structure:
        """Read the modes of a structure from a table of comma separated values, a mode a line.

        Parameters
        ----------
        path : path
            File whose first line names the columns, in any order: ``frequency`` [Hz], ``damping`` (ratio),
            ``mass`` (modal) [kg], ``seat.x``, ``seat.y``, ``seat.z`` (shape at the seat), and of each sensor
            ``<name>.x``, ``<name>.y``, ``<name>.z``. A shape's column that is left out is 0.

        Raises
        ------
        SceneError
            A column is missing or not known, or a value is not a number; it names line and column.
        OSError
            The file cannot be read.
        """
        path = as_path(path)
        with path.open(encoding="utf-8-sig", newline="") as file:
            lines = csv.DictReader(file, skipinitialspace=True)
            columns = [name.strip() for name in lines.fieldnames or ()]
            _check_columns(str(path), columns)
            lines.fieldnames = columns
            return cls(modes=tuple(_mode(f"{path}, line {lines.line_num}", line) for line in lines))

    def to_table(self, path: str | os.PathLike[str]) -> None:
        """Write the modes as :meth:`from_table` reads them; a static compliance is no part of the table.

        Raises
        ------
        OSError
            The file cannot be written.
        """
        points = ("seat", *self.sensors)
        names = [*_NUMBERS, *(f"{point}.{axis}" for point in points for axis in _AXES)]
        with as_path(path).open("w", encoding="utf-8", newline="") as file:
            lines = csv.writer(file)
            lines.writerow(names)
            for mode in self.modes:
                shapes = [
                    mode.seat,
                    *(mode.sensors.get(name, (0.0, 0.0, 0.0)) for name in self.sensors),
                ]
                numbers = [mode.frequency, mode.damping, mode.mass, *(c for s in shapes for c in s)]
                lines.writerow([repr(float(number)) for number in numbers])


def _check_columns(path: str, columns: list[str]) -> None:
    """Refuse a table that lacks a column, or has one twice or one that says nothing."""
    known = "frequency, damping, mass, and shapes such as seat.x, seat.y, seat.z, top.y"
    for name in columns:
        point, dot, axis = name.rpartition(".")
        is_shape = bool(point and dot) and axis in _AXES
        if columns.count(name) > 1 or not (is_shape or name in _NUMBERS):
            raise SceneError(f"{path}, columns", repr(name), f"each once: {known}")
    missing = [name for name in _NUMBERS if name not in columns]
    if missing or not any(name.startswith("seat.") for name in columns):
        lacking = ", ".join(missing or ["seat.x, seat.y or seat.z"])
        raise SceneError(f"{path}, columns", f"no {lacking}", known)


def _mode(place: str, line: dict[str | None, str | None]) -> Mode:
    """Return the mode of a line of a table."""
    if None in line or None in line.values():
        raise SceneError(place, "a line of another length", "a value for each column")
    values = {str(name): _number(f"{place}, {name}", str(text)) for name, text in line.items()}
    shapes: dict[str, dict[str, float]] = {}
    for name, value in values.items():
        if name not in _NUMBERS:
            point, _, axis = name.rpartition(".")
            shapes.setdefault(point, {})[axis] = value
    seat, *others = ("seat", *(point for point in shapes if point != "seat"))

    def shape(point: str) -> tuple[float, float, float]:
        x, y, z = (shapes[point].get(axis, 0.0) for axis in _AXES)
        return x, y, z

    return Mode(
        **{name: values[name] for name in _NUMBERS},
        seat=shape(seat),
        sensors={point: shape(point) for point in others},
    )


def _number(place: str, text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise SceneError(place, repr(text), "a finite number")
    return value
