"""Explanation of what a scene is compiled to, what it costs, and what would make it cheaper."""

from __future__ import annotations

import json
import math
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from . import _core
from ._base.html import folded
from ._results.entries import Record
from .errors import SceneError
from .scene.scene import checked_scene

if TYPE_CHECKING:
    from collections.abc import Mapping

    from .bearings import OperatingClearance
    from .scene import Scene

__all__ = ["Explanation", "explain"]


class Explanation(Record):
    """Explanation of what a run of a scene integrates and evaluates; ``print`` shows it as a page of text.

    Attributes
    ----------
    bodies, states, kept : int
        Number of bodies, of their states, and of those that a run integrates.
    omissions : list of dict
        What is left out since it does not change the motion: ``what``, ``degrees`` of freedom, ``reason``.
    obstacles : list of dict
        What cannot be left out: ``what``, ``reason``.
    contacts : list of dict
        For every race its ``contacts`` and the ``evaluation`` of one of them.
    evaluated, constant, absent : list of str
        Forces that are evaluated in a run, that are set once before it, and that the scene does not have.
    cost : Record
        Measured on this machine on one thread: ``evaluations`` of the right-hand side for a simulated second, time
        for an ``evaluation`` with the integrator's share and for the ``right_hand_side`` alone, of that for
        ``contacts`` and ``cage`` [s], ``seconds`` for a simulated second.
    variants : list of dict
        Changes of the scene that make runs cheaper, the cheapest first, and changes of its oil in any case:
        ``change``, ``note`` on their effect on the result, states ``kept``, estimated ``seconds`` for a simulated
        second.
    law : Record or None
        What the ``law`` of the contacts implies at the start: the most loaded ``contact``, its ``load`` [N], its
        ``approach`` and ``hertz_approach``, that of Hertz's theory [m], and its largest Hertz ``pressure`` [Pa];
        None where no contact is loaded.
    oils : list of dict
        Rows with a lubricant: ``row``, name of the ``oil``, ``temperature`` [K], ``kinematic_viscosity`` [m²/s],
        whether reference load and speed are ``given`` or those of the equilibrium and the drive (``load_from``,
        ``speed_from``), and the ``films`` of both races, the fields as of :class:`ballrace.statics.RaceFilm`.
    textures : list of dict
        Surfaces with a texture: ``row``, ``surface``, ``amplitude`` at order 30 [m], ``slope``, ``orders``,
        ``knots`` of its table, ``roughness`` around the circumference and ``fine_roughness`` from order 15 on
        (root mean square) [m], length of the ``shortest`` waves, which average out in a contact [m], their
        ``frequency`` [Hz], and the ``largest_step`` that resolves them [s].
    pits : list of dict
        Pits and dents beneath the most loaded contact that meets them at the healthy bearing's equilibrium:
        ``name``, ``shape``, ``on``, ``size`` along rolling and across [m], ``load`` and size of the ``contact``,
        2b and 2a [N], [m], what is ``lost`` of the load at its middle and one approach, below 0 where a rim adds
        more [N], the ``depth`` of race worth as much [m], the share X of the contact's elastic energy that is
        ``released``, and the ``duration`` of a pass [s].
    doubts : list of dict
        Numbers that no bearing is likely to have, and columns that cannot change: ``path``, ``value``, ``usual``.
    defects : list of dict
        Where defects lie and what contacts carry there at the healthy bearing's equilibrium, the fields as of
        :class:`ballrace.signals.Touched`; ``passes`` counts the contacts looked at: over a turn of the inner race
        or the ball past all balls, or of a ball at the angle of a defect on the outer race.
    clearance : Record, where it was given
        Parts of the clearance in operation, the fields of
        :class:`ballrace.bearings.OperatingClearance` [m].
    notes : list of str
        What to know about the scene before a long run, such as that nothing drives the balls' orbit.
    """

    def __init__(self, entries: Mapping[str, Any], text: str) -> None:
        super().__init__(entries)
        self.__dict__["_text"] = text

    def __str__(self) -> str:
        text: str = self.__dict__["_text"]
        return text

    def _repr_html_(self) -> str:
        """Return the page of text, as notebooks show it."""
        return folded("What a run integrates, and what it costs", str(self), opened=True)


def explain(scene: Scene, *, clearance: OperatingClearance | None = None) -> Explanation:
    """Report what a run of a scene integrates and leaves out, what it costs, and what would make it cheaper.

    The scene is compiled and started from equilibrium, and some steps are timed: a fraction of a second; with oil
    up to some seconds.

    Parameters
    ----------
    scene : Scene
        The scene.
    clearance : OperatingClearance, optional
        Parts of the scene's clearance (:func:`ballrace.bearings.operating_clearance`), which are reported, too.

    Returns
    -------
    Explanation
        Its parts as attributes; ``print`` shows them.

    Raises
    ------
    SceneError
        A field of the scene is not usable, or its clearance is another.
    EquilibriumError
        There is no stable equilibrium to start from.

    Examples
    --------
    >>> import ballrace as br
    >>> found = br.explain(br.presets.deep_groove_6205())
    >>> found.states, found.kept
    (88, 62)
    >>> [omission["what"] for omission in found.omissions]
    ['held directions', 'rotation of the inner ring', 'z']
    >>> found.law.law, round(found.law.approach / found.law.hertz_approach, 2)
    ('hertz', 1.0)
    """
    document = checked_scene(scene).to_json()
    if clearance is not None:
        _check_clearance(scene, clearance)
    entries, text = _core.explain(document)
    fields = json.loads(entries)
    if clearance is not None:
        fields["clearance"] = {**asdict(clearance), "clearance": clearance.clearance}
        text = f"{text.rstrip()}\n{clearance}\n"
    return Explanation(fields, text)


def _check_clearance(scene: Scene, clearance: OperatingClearance) -> None:
    for k, row in enumerate(scene.rows):
        if not math.isclose(row.clearance, clearance.clearance, rel_tol=1e-9, abs_tol=1e-12):
            given = f"{clearance.clearance:g} of {clearance.designation}"
            allowed = f"the clearance in operation of row {k}, {row.clearance:g}; clearance.apply(scene) sets it"
            raise SceneError("clearance", given, allowed)
