"""Fault frequencies of a bearing as it runs: at the contact angle under its load, with the slip of its cage.

Where the balls roll, the load alone moves the frequencies from the nominal
ones: thrust opens the contact angle, which raises BPFO and lowers BPFI. Slip makes the cage slower than rolling
would, lowers BPFO and raises BPFI. At high speed the contact angles of both races differ and balls spin about an
axis of their own, which makes the cage faster by percents. Of a scene, speeds are those at which friction at both
races, the oil's drag and gyroscopic moments balance; of a run they are measured.
"""

from __future__ import annotations

import json
import math
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from .. import _core, frequencies
from .._base.numbers import counted, finite, real
from ..bearings import Bearing, catalogue
from ..errors import SceneError
from ..scene import MotionProbe, Scene
from ..scene.turning import constant_speeds
from ..signals import Signals

if TYPE_CHECKING:
    from collections.abc import Mapping

    from ..scene import Row
    from ..statics import RaceControl

_Speeds: TypeAlias = tuple[float, float]
"""Frequencies of outer and inner ring [Hz]."""


@dataclass(frozen=True, kw_only=True)
class FaultFrequencies:
    """Frequencies of a row of balls at a speed.

    All are rates, from 0 up, whichever way rings, cage and balls turn: lines of a spectrum have no sign.

    Attributes
    ----------
    shaft : float
        Relative turns of the rings, ``|f_i − f_o|`` [Hz]: those of the shaft where the outer ring stands, of a
        hub where the inner one does, and the sum of both where the rings turn in opposite directions.
    ftf, bpfo, bpfi, bsf : float
        Cage in space, ball passes on the outer and the inner race, spin of a ball in the cage [Hz]. A defect on a
        ball meets the races at twice ``bsf``; in a run, whose balls spin about the axis only, at BSF/cos α or
        twice that (:func:`ballrace.frequencies.operating.spin_of`).
    contact_angle : float
        The angle under load at rest [rad].
    slip : float or None
        How much slower the cage is than by rolling at this angle, as a share of it; negative where it is faster,
        None where it was not measured.
    inner, outer : float
        Turns of the inner and of the outer ring in space, f_r and f_o [Hz].
    """

    shaft: float
    ftf: float
    bpfo: float
    bpfi: float
    bsf: float
    contact_angle: float
    inner: float
    outer: float = 0.0
    slip: float | None = None

    @property
    def orders(self) -> frequencies.Orders:
        """The same in multiples of :attr:`shaft`."""
        rates = {field.name: getattr(self, field.name) for field in fields(frequencies.Orders)}
        return frequencies.Orders(**{name: rate / self.shaft for name, rate in rates.items()})


def fault_frequencies(
    of: str | Bearing | Scene | Signals,
    speed_rpm: float | None = None,
    *,
    outer_rpm: float | None = None,
    row: int = 0,
    operating: bool = True,
    race_control: RaceControl = "friction",
) -> FaultFrequencies:
    """Return the fault frequencies of a bearing.

    Parameters
    ----------
    of : str, Bearing, Scene or Signals
        A designation of the catalogue or a bearing of it: at the nominal contact angle, since no load is given. A
        scene: at the speeds of cage and balls at which friction at both races under its load, the oil's drag and
        gyroscopic moments balance; without friction, those of balls that roll at the contact angles of both races.
        Signals of a run of a turn and more: mean speeds measured in the run, of the cage over all balls of the
        row, and of the spin where balls spin freely; from older files by a probe that records the motion of a
        ball.
    speed_rpm : float, optional
        Speed of the inner ring [1/min]; by default that of the scene, if it is given and constant. Of a bearing
        without a scene it is 0 where an ``outer_rpm`` is given.
    outer_rpm : float, optional
        Speed of the outer ring [1/min], of the other sign where the rings turn in opposite directions; by
        default that of the scene, or 0.
    row : int
        Row of balls, from 0.
    operating : bool
        False: at the nominal contact angle and without slip.
    race_control : {"friction", "outer"}
        Of a scene whose balls spin freely, as in :func:`ballrace.equilibrium`.

    Returns
    -------
    FaultFrequencies
        In hertz; in orders by ``.orders``.

    Raises
    ------
    SceneError
        The bearing is not known, there is no such row, or the speed has to be given.
    EquilibriumError
        The bearing cannot carry its load.

    Examples
    --------
    >>> import ballrace as br
    >>> found = br.fault_frequencies("6205", 1797.0)
    >>> round(found.bpfo, 2), round(found.bpfi, 2)
    (107.36, 162.19)
    >>> loaded = br.fault_frequencies(br.bearing("6205", radial_load=300.0, axial_load=200.0, speed_rpm=1797.0))
    >>> bool(loaded.bpfo > found.bpfo), bool(loaded.bpfi < found.bpfi)
    (True, True)

    A hub: the inner ring stands, and the turns of the outer ring modulate the impacts on its race.

    >>> hub = br.fault_frequencies("6205", outer_rpm=1797.0)
    >>> round(hub.bpfo, 2), round(hub.ftf, 2), hub.inner, hub.outer
    (107.36, 18.02, 0.0, 29.95)
    """
    if isinstance(of, str):
        of = catalogue[of]
    if isinstance(of, Bearing):
        if speed_rpm is None and outer_rpm is None:
            raise SceneError("speed_rpm", "None", "the speed of the inner ring [1/min]")
        return _rolling(of, of.contact_angle, ring_rates(speed_rpm or 0.0, outer_rpm or 0.0))
    scene = of.scene if isinstance(of, Signals) else of
    if not isinstance(scene, Scene):
        raise SceneError("of", f"a {type(of).__name__}", "a designation, Bearing, Scene or Signals")
    row = counted("row", row, 0, len(scene.rows) - 1)
    did = _measured(of, row) if isinstance(of, Signals) else None
    if did is not None and speed_rpm is None and outer_rpm is None:
        speeds = real(did["outer"]), real(did["inner"])
    else:
        speeds = scene_rates(scene, speed_rpm, outer_rpm)
    if not operating:
        return _rolling(scene.rows[row], scene.rows[row].contact_angle, speeds)
    if isinstance(of, Signals) and did is None:
        cage = cage_frequency(of, row)
        at = {"row": row, "inner": speeds[1], "outer": speeds[0], "spin": None, "rolling": None}
        did = None if cage is None else {**at, "cage": cage}
    return _under_load(scene, row, speeds, race_control, did)


def rates_at_a_turn(
    scene: Scene, row: int = 0, *, speeds: _Speeds | None = None, operating: bool = True
) -> FaultFrequencies:
    """Return the fault frequencies of a scene at a turn a second of the rings against each other, for its orders.

    The rings share it as some speeds of outer and inner ring do, by default those of the scene where they are
    given and constant; else the outer ring stands.
    """
    turns = scene.outer_speed is not None or speeds is not None
    outer, inner = speeds or constant_speeds(scene) or (0.0, 0.0)
    relative = abs(inner - outer)
    if not turns or relative == 0.0:
        return fault_frequencies(scene, 60.0, outer_rpm=0.0, row=row, operating=operating)
    inner_rpm, outer_rpm = 60.0 * inner / relative, 60.0 * outer / relative
    return fault_frequencies(scene, inner_rpm, outer_rpm=outer_rpm, row=row, operating=operating)


def operating_angle(scene: Scene, row: int = 0) -> float:
    """Return the contact angle of a row under load: the mean of both races, by the loads of the balls [rad].

    Without load it is the nominal one.
    """
    found = _core.rolling(scene._document(), "friction")[row]
    # Where balls only touch the outer race, thrown there, nothing drives them.
    return scene.rows[row].contact_angle if found is None else found[0]


def _under_load(
    scene: Scene,
    row: int,
    speeds: _Speeds,
    race_control: RaceControl,
    did: Mapping[str, float | None] | None = None,
) -> FaultFrequencies:
    """Return the frequencies of balls under load at the rings' speeds, with what a run measured of them."""
    kinematics = None if did is None else json.dumps(dict(did))
    found = _core.fault_frequencies(scene._document(), row, speeds, race_control, kinematics)
    return FaultFrequencies(**json.loads(found))


def cage_frequency(out: Signals, row: int = 0) -> float | None:
    """Return how often a row goes round, by the balls whose motion was recorded [Hz]; None without one."""
    rates = []
    for name, probe in out.scene.probes.items():
        of_row = isinstance(probe, MotionProbe) and probe.body.startswith(f"row{row}.")
        if of_row and f"{name}.x" in out and f"{name}.y" in out:
            angle = np.unwrap(np.arctan2(out[f"{name}.y"], out[f"{name}.x"]))
            rates.append(np.polyfit(out.t, angle, 1)[0] / (2.0 * math.pi))
    return float(np.mean(rates)) if rates else None


def spin_of(scene: Scene, rates: FaultFrequencies, row: int = 0) -> tuple[float, int] | None:
    """Return how fast the balls of a run turn, and how often a turn the defect of one meets a race.

    A ball of the model spins about the axis only: against the cage at BSF/cos α. At the contact angle it touches
    the outer race R sin α to one side of its middle and the inner race as far to the other, so that a defect
    meets both only where it reaches from track to track; a real ball tumbles, and its defect meets both.

    Parameters
    ----------
    scene : Scene
        Scene of a run, ``out.scene``, whose defects stand where they are.
    rates : FaultFrequencies
        Those of the row, :func:`fault_frequencies`.
    row : int
        Row of balls, from 0.

    Returns
    -------
    tuple of float and int, or None
        Order of the turns against the cage, BSF/cos α over the shaft's rate, and 1 or 2; None where no ball of
        the row has a defect, or balls spin freely.

    Examples
    --------
    >>> import ballrace as br
    >>> scene = br.bearing("6205", radial_load=300.0, axial_load=140.0, speed_rpm=1800.0)
    >>> spalled = scene.replace({"defects.d": br.defects.spall(on="ball", width_mm=0.5)})
    >>> rates = br.fault_frequencies(spalled)
    >>> order, hits = spin_of(spalled, rates)
    >>> bool(order > rates.orders.bsf), hits
    (True, 1)
    """
    own = [d for d in scene.defects.values() if d.on == "ball" and d.row == row]
    if not own or scene.spin == "free":
        return None
    order = rates.orders.bsf / math.cos(rates.contact_angle)
    track = scene.rows[row].ball_diameter / 2.0 * math.sin(abs(rates.contact_angle))
    # Without a given place it is that of one contact.
    reach = [
        d.length / 2.0 - abs(track if d.axial_offset == "contact" else d.axial_offset) for d in own
    ]
    return order, 2 if any(each >= track for each in reach) else 1


def _rolling(of: Bearing | Row, angle: float, speeds: _Speeds) -> FaultFrequencies:
    row = of.ball_count, of.ball_diameter, of.pitch_diameter, angle
    return FaultFrequencies(**json.loads(_core.rolling_frequencies(*row, speeds)))


def _measured(out: Signals, row: int) -> Mapping[str, float | None] | None:
    """Return the mean speeds of a row that a run measured [Hz]."""
    return next((did for did in out.provenance.get("kinematics", ()) if did["row"] == row), None)


def ring_rates(inner_rpm: float, outer_rpm: float) -> _Speeds:
    """Return the rates of outer and inner ring with their signs [Hz], which are not the same.

    Raises
    ------
    SceneError
        One is not usable, or balls do not roll.
    """
    outer = finite("outer_rpm", outer_rpm, "1/min")
    inner = finite("speed_rpm", inner_rpm, "1/min")
    if inner == outer:
        excluded = "not 0" if outer == 0.0 else f"not that of the outer ring, {outer:g}"
        allowed = f"a speed of the inner ring [1/min], {excluded}"
        raise SceneError("speed_rpm", repr(inner_rpm), allowed)
    return outer / 60.0, inner / 60.0


def scene_rates(scene: Scene, speed_rpm: float | None, outer_rpm: float | None) -> _Speeds:
    """Return the rates of outer and inner ring that are given, else those of the scene, with their signs [Hz].

    Raises
    ------
    SceneError
        One has to be given, or is not usable.
    """
    known = constant_speeds(scene)
    turns = scene.outer_speed is not None
    if known is None and (speed_rpm is None or (outer_rpm is None and turns)):
        raise SceneError(
            "speed_rpm" if speed_rpm is None else "outer_rpm",
            "None",
            "the speed [1/min]: that of the scene is not given, or changes",
        )
    outer, inner = (speed * 30.0 / math.pi for speed in known or (0.0, 0.0))
    return ring_rates(
        inner if speed_rpm is None else speed_rpm, outer if outer_rpm is None else outer_rpm
    )
