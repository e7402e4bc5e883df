"""The scene: reading, checking and changing it."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields
from types import MappingProxyType
from typing import Any, Literal

from .. import _core
from .._base.arguments import whole_text
from .._base.document import LEFT_OUT, Part, decode, encode
from .._base.html import folded, paragraph, points
from .._io.files import as_path
from .._io.toml import check_depth, loads
from ..errors import SceneError
from .bearing import Ring, Row
from .cage import Cage, CageRing
from .contact import Contact
from .defect import Defect
from .drive import Drive
from .friction import Friction
from .load import Load, Moment, TableForce, Unbalance
from .lubricant import Lubricant
from .material import Materials
from .probe import Probe
from .solver import Solver
from .structure import Structure
from .time import TimeFunction

__all__ = ["Scene", "Spin"]


Spin = Literal["axial", "free"]
"""How balls spin: about the bearing's axis, or about any axis, as friction turns them."""


_NAMED = ("loads", "moments", "unbalances", "table_forces", "defects", "probes")
"""Parts of a scene whose entries have names."""


def _empty() -> MappingProxyType[str, Any]:
    return MappingProxyType({})


@dataclass(frozen=True, kw_only=True, repr=False)
class Scene(Part):
    """A whole bearing, its loads, its defects and what to record of it.

    Attributes
    ----------
    schema : int
        Version of the document, 1.
    name : str
        A title.
    rows : tuple of Row
        The rows of balls, at least one.
    outer_ring, inner_ring : Ring
        Mass of the ring, and how it is held.
    structure : Structure or None
        Structure on which the outer ring stands; None: its support ends on the ground.
    materials : Materials
        Materials of rings and balls.
    contact : Contact
        Contact of balls and races.
    friction : Friction
        Friction of balls and races.
    lubricant : Lubricant or None
        Oil of balls and races, whose traction replaces ``friction``; None: they are dry.
    spin : Spin or None
        How balls spin. ``"axial"``, or None: about the bearing's axis, at contacts with a ring that tilts about
        that ring's axis, one state for each ball. ``"free"``: about any axis, which follows from friction, three
        states for each ball. At a contact angle of 0 both are the same.
    cage : CageRing, Cage or None
        Cage; None: the balls are not linked.
    drive : Drive
        What turns the inner ring.
    outer_speed : TimeFunction or None
        Given speed of the outer ring [rad/s], counter-clockwise about z; must not jump. Its waviness, texture and
        defects turn with it; loads, gravity, its support and the axes of motion probes do not. None: it stands,
        or turns as its support lets it.
    gravity : tuple of three floats
        Gravity [m/s²].
    loads : mapping of str to Load
        Loads by name.
    moments : mapping of str to Moment
        Moments on rings by name.
    unbalances : mapping of str to Unbalance
        Unbalances by name.
    table_forces : mapping of str to TableForce
        Forces on rings that depend on the rings' places, by name.
    defects : mapping of str to Defect
        Defects by name.
    probes : mapping of str to Probe
        Probes by name. Empty: the motion of the outer ring if forces can move it along x, y or z, else of the
        inner ring, in the directions that can move; where both are held or follow given motions, the loads of all
        contacts (``row0`` and so on). With a structure also its sensors (``housing``) and the force on its seat
        (``seat``).
    solver : Solver
        Options of the integrator.

    Examples
    --------
    >>> import ballrace as br
    >>> scene = br.presets.wheel_bearing(axial_load=3000.0)
    >>> scene.loads["axial"].force
    3000.0
    >>> scene.replace({"loads.axial.force": -3000.0}).loads["axial"].force
    -3000.0
    """

    schema: int = 1
    name: str = ""
    rows: tuple[Row, ...]
    outer_ring: Ring = Ring()
    inner_ring: Ring = Ring()
    structure: Structure | None = field(default=None, metadata=LEFT_OUT)
    materials: Materials = Materials()
    contact: Contact = Contact()
    friction: Friction = "none"
    lubricant: Lubricant | None = field(default=None, metadata=LEFT_OUT)
    spin: Spin | None = field(default=None, metadata=LEFT_OUT)
    cage: CageRing | Cage | None = None
    drive: Drive
    outer_speed: TimeFunction | None = field(default=None, metadata=LEFT_OUT)
    gravity: tuple[float, float, float] = (0.0, -9.81, 0.0)
    loads: Mapping[str, Load] = field(default_factory=_empty)
    moments: Mapping[str, Moment] = field(default_factory=_empty, metadata=LEFT_OUT)
    unbalances: Mapping[str, Unbalance] = field(default_factory=_empty)
    table_forces: Mapping[str, TableForce] = field(default_factory=_empty, metadata=LEFT_OUT)
    defects: Mapping[str, Defect] = field(default_factory=_empty)
    probes: Mapping[str, Probe] = field(default_factory=_empty)
    solver: Solver = Solver()

    def __hash__(self) -> int:
        values = (getattr(self, each.name) for each in fields(self))
        return hash(tuple(frozenset(v.items()) if isinstance(v, Mapping) else v for v in values))

    def __repr__(self) -> str:
        balls = " + ".join(str(row.ball_count) for row in self.rows)
        named = {kind: getattr(self, kind) for kind in _NAMED}
        parts = [f"{balls} balls", *(f"{kind}: {_listed(v)}" for kind, v in named.items() if v)]
        return f"<Scene {self.name!r}: {'; '.join(parts)}>"

    def _repr_html_(self) -> str:
        """Return a drawing, what is unusual, and the document, as notebooks show it."""
        from .drawing import drawing

        title = paragraph(repr(self).strip("<>"))
        try:
            doubts, text = self.doubts(), self.to_toml()
        except SceneError as error:
            return title + points([f"not usable: {error}"])
        loads, defects = self.loads.values(), self.defects.values()
        drawn = drawing(self.rows, (self.outer_ring, self.inner_ring), defects, loads)
        return title + drawn + points(doubts) + folded("as TOML", text)

    @classmethod
    def from_toml(cls, text: str) -> Scene:
        """Read a scene from TOML and check it.

        Raises
        ------
        SceneError
            Names the first field that is unknown, missing or not usable.
        """
        whole_text("scene", text)
        try:
            check_depth(text)
        except ValueError as error:
            raise SceneError("scene", "not TOML that is read", str(error)) from None
        try:
            return cls._read(_core.scene_from_toml(text))
        except SceneError as error:
            raise _newer(error, loads, text) from None

    @classmethod
    def from_json(cls, text: str) -> Scene:
        """Read a scene from JSON and check it.

        Raises
        ------
        SceneError
            Names the first field that is unknown, missing or not usable.
        """
        try:
            return cls._read(_core.scene_from_json(whole_text("scene", text)))
        except SceneError as error:
            raise _newer(error, json.loads, text) from None

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Scene:
        """Read a scene from a file that ends in ``.toml`` or ``.json`` and check it.

        Raises
        ------
        SceneError
            Names the first field that is unknown, missing or not usable.
        OSError
            The file cannot be read.
        """
        path = as_path(path)
        readers = {".toml": cls.from_toml, ".json": cls.from_json}
        reader = readers.get(path.suffix.lower())
        if reader is None:
            raise SceneError("path", str(path), "a file that ends in .toml or .json")
        try:
            text = path.read_text(encoding="utf-8")
        except UnicodeDecodeError as error:
            raise SceneError("path", str(path), f"a text file in UTF-8 ({error})") from error
        return reader(text)

    def validate(self) -> Scene:
        """Check every field, and return the scene as the core reads it.

        Raises
        ------
        SceneError
            With the path, the value and what is allowed, for the first field that is not usable.
        """
        return self.from_json(self._document())

    def doubts(self) -> tuple[str, ...]:
        """Check the scene and return what is unusual about its numbers and probes; empty for an ordinary bearing.

        Runs, static solutions and campaigns warn of the same (:class:`ballrace.SceneWarning`), and of contacts
        beyond the static load rating.

        Raises
        ------
        SceneError
            A field is not usable.
        """
        return tuple(_core.scene_doubts(self._document()))

    def placed(self) -> Scene:
        """Check the scene and return it with a number for the axial place of every defect, as runs have it.

        Defects with ``axial_offset="contact"`` are placed by the static equilibrium, or at the nominal contact
        angle where there is no equilibrium or no load. ``out.scene`` of a run already has these numbers.

        Raises
        ------
        SceneError
            A field is not usable.
        """
        return self._read(_core.placed(self._document()))

    def to_toml(self, *, comments: bool = False) -> str:
        """Check the scene and return it as TOML.

        Parameters
        ----------
        comments : bool
            Whether a comment at every field says what it is, and in which unit.

        Raises
        ------
        SceneError
            A field is not usable.
        """
        text = _core.scene_to_toml(self._document())
        if not comments:
            return text
        from .comments import commented

        return commented(text, Scene)

    def to_json(self) -> str:
        """Check the scene and return it as JSON on one line, every field written out.

        Raises
        ------
        SceneError
            A field is not usable.
        """
        return _core.scene_from_json(self._document())

    def replace(self, changes: Mapping[str, object]) -> Scene:
        """Return a checked copy with some fields replaced, each by its dotted path.

        Parameters
        ----------
        changes : mapping of str to object
            Paths such as ``loads.axial.force`` or ``rows[0].clearance``, and new values: numbers, text,
            lists, or parts of a scene. A path such as ``defects.new`` adds an entry to loads, moments, unbalances,
            table_forces, defects or probes, and its value is the whole entry; to remove one, use
            :func:`dataclasses.replace`.

        Raises
        ------
        SceneError
            A path does not exist, or the new scene is not usable.
        """
        if not isinstance(changes, Mapping):
            raise SceneError("changes", repr(changes), "new values by their paths")
        pairs = [(checked_path(path), encode(value, path)) for path, value in changes.items()]
        return self._read(_core.scene_replace(self._document(), json.dumps(pairs)))

    @classmethod
    def _read(cls, text: str) -> Scene:
        scene = decode(Scene, json.loads(text))
        object.__setattr__(scene, "_text", text)
        return scene

    def _document(self) -> str:
        """JSON, not yet checked; kept, since a scene does not change."""
        text: str | None = self.__dict__.get("_text")
        if text is None:
            text = json.dumps(encode(self, ""))
            object.__setattr__(self, "_text", text)
        return text


def _listed(parts: Mapping[str, Any]) -> str:
    """Return names, of loads with their forces where these do not change."""
    steady = {
        name: f" {part.force:g} N"
        for name, part in parts.items()
        if isinstance(part, Load) and isinstance(part.force, int | float)
    }
    return ", ".join(name + steady.get(name, "") for name in parts)


def checked_path(path: object) -> str:
    """Return a path that is not empty; the core checks whether it exists."""
    if not isinstance(path, str) or not path:
        raise SceneError(
            "changes", repr(path), "paths such as loads.radial.force or rows[0].clearance"
        )
    return path


def _newer(error: SceneError, parse: Callable[[str], Any], text: str) -> SceneError:
    """Return why a document of a newer schema is refused: what looks wrong in it may be no mistake."""
    try:
        found = parse(text)["schema"]
    except (ValueError, LookupError, TypeError, RecursionError):
        return error
    if not isinstance(found, int) or found <= Scene.schema:
        return error
    allowed = f"at most {Scene.schema}; a newer ballrace wrote this, pip install --upgrade ballrace"
    return SceneError("schema", str(found), allowed)


def checked_scene(given: object) -> Scene:
    """Return a scene where one is meant.

    Raises
    ------
    SceneError
        It is something else; the message says how to come by a scene.
    """
    if isinstance(given, Scene):
        return given
    if isinstance(given, str | os.PathLike):
        allowed = (
            "a Scene; ballrace.Scene.load(path) reads one from a file, ballrace.presets has some"
        )
        raise SceneError("scene", repr(os.fspath(given)), allowed)
    raise SceneError(
        "scene", f"a {type(given).__name__}", "a Scene, as ballrace.Scene.load reads it"
    )
