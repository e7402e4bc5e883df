"""The vibration test that makers run on every bearing, ISO 15242-2, simulated.

The inner ring sits on a stiff spindle that turns with 1800 1/min, thrust presses the outer ring, which does not
turn but is free to vibrate, and its radial velocity is given in three bands.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ._base.numbers import positive, real
from .bearings import Bearing, bearing, catalogue
from .bearings.build import metal
from .channel import Channel
from .errors import SceneError
from .run import simulate
from .scene import Load, MotionProbe, Scene, Spring, Support, Texture
from .signals import Signals
from .spectra import bands_iso15242
from .spectra.standard_bands import BANDS_ISO15242, VelocityBand

if TYPE_CHECKING:
    from collections.abc import Mapping

    from .scene import Defect, Lubricant

__all__ = ["NoiseTest", "noise_test"]

_SPEED = 1800.0
"""Speed of the test [1/min]."""

_RATE = 2.56
"""Sampling rate over the highest frequency of the bands."""

_LOADS = (
    (25.0, (20.0, 30.0, 40.0)),
    (50.0, (70.0, 100.0, 140.0)),
    (100.0, (150.0, 225.0, 300.0)),
    (140.0, (400.0, 600.0, 800.0)),
    (170.0, (650.0, 975.0, 1300.0)),
    (200.0, (900.0, 1350.0, 1800.0)),
)
"""Outside diameter up to which [mm], and thrust at contact angles up to 10, 23 and 45° [N].

ISO 15242-2:2015, Table 1, the middle of its ranges (± 10 %), from memory: not compared with its print."""

_ANGLES = (10.0, 23.0, 45.0)

_DAMPING = 100.0
"""Damping of the outer ring of a 6205 by what presses it [N s/m], 3 % of its radial resonance: chosen."""

_QUIET = Texture(outer=1e-9, inner=1e-9, ball=3e-11)


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class NoiseTest:
    """Outcome of a simulated vibration test.

    Attributes
    ----------
    bands : tuple of VelocityBand
        Radial velocity of the outer ring in the low, medium and high band: the root of the mean square at three
        places 120° apart, which for a rigid ring is half the sum of those along x and y.
    axial_load : float
        Thrust on the outer ring [N].
    scene : Scene
        What was simulated.
    signals : Signals
        The motion of the outer ring.
    """

    bands: tuple[VelocityBand, ...]
    axial_load: float
    scene: Scene
    signals: Signals

    def __repr__(self) -> str:
        return f"<NoiseTest {self.scene.name}: {'; '.join(map(str, self.bands))}>"


def noise_test(
    name: str | Bearing,
    *,
    texture: Texture | None = _QUIET,
    defects: Defect | Mapping[str, Defect] | None = None,
    clearance: str | float | None = None,
    lubricant: str | Lubricant | None = None,
    temperature_c: float | None = None,
    axial_load: float | None = None,
    speed_rpm: float = _SPEED,
    duration: float = 1.0,
) -> NoiseTest:
    """Simulate the vibration test of ISO 15242-2 on a bearing.

    The inner ring is held on its spindle and turns; the outer ring stands still, free along x, y and z against
    a light damper (3 % of its radial resonance, chosen), under thrust. Its tilt is held, and it is rigid: lines
    of its bending, in the high band of large bearings, are missing.

    Parameters
    ----------
    name : str or Bearing
        As of :func:`ballrace.bearing`.
    texture : Texture or None
        Texture of races and balls; by default that of a quiet bearing, 1 nm at order 30 of the races and 0.03 nm
        of the balls, slope 2. None: smooth.
    defects, clearance, lubricant, temperature_c
        As of :func:`ballrace.bearing`. The standard requires a thin oil.
    axial_load : float, optional
        Thrust [N]; by default the standard's for the outside diameter, up to 200 mm, and the contact angle: 150 N
        for a 6205. The table's numbers were not compared with its print.
    speed_rpm : float
        Speed of the inner ring [1/min], of either sign; the bands are in proportion to it.
    duration : float
        Time over which it is measured, once settled [s].

    Raises
    ------
    SceneError
        An argument is not usable, or the standard has no thrust for the bearing's size.

    Examples
    --------
    >>> import ballrace as br
    >>> tested = br.noise_test("608", duration=0.1)
    >>> tested.axial_load, [band.high for band in tested.bands]
    (20.0, [300.0, 1800.0, 10000.0])
    """
    made = name if isinstance(name, Bearing) else catalogue[name]
    thrust = _thrust(made) if axial_load is None else positive("axial_load", axial_load, "N")
    share = positive("speed_rpm", abs(real(speed_rpm)), "1/min") / _SPEED
    ready = bearing(
        name, radial_load=0.0, axial_load=thrust, speed_rpm=speed_rpm, clearance=clearance,
        defects=defects, lubricant=lubricant, temperature_c=temperature_c, housing=None,
        texture=texture,
    )  # fmt: skip
    scene = _on_spindle(ready, thrust, made).validate()
    bands = tuple((low * share, high * share) for low, high in BANDS_ISO15242)
    signals = simulate(scene, duration=duration, fs=_RATE * bands[-1][1])
    return NoiseTest(bands=_radial(signals, bands), axial_load=thrust, scene=scene, signals=signals)


def _on_spindle(scene: Scene, thrust: float, made: Bearing) -> Scene:
    """Return the scene with its inner ring on a spindle and its outer ring pressed."""
    light = Spring(damping=_DAMPING * metal(made))
    outer = replace(scene.outer_ring, mass=None, support=Support(x=light, y=light, z=light))
    inner = replace(scene.inner_ring, support=Support(x="fixed", y="fixed", z="fixed"))
    return replace(
        scene,
        outer_ring=outer,
        inner_ring=inner,
        loads={"thrust": Load(ring="outer", direction=(0.0, 0.0, -1.0), force=thrust)},
        probes={"outer": MotionProbe(body="outer")},
    )


def _radial(signals: Signals, bands: tuple[tuple[float, float], ...]) -> tuple[VelocityBand, ...]:
    """Return the velocity in bands, as the mean square of all radial directions."""
    x, y = (
        bands_iso15242(Channel(x=np.asarray(signals[f"outer.{axis}"]), fs=signals.fs), bands=bands)
        for axis in ("ax", "ay")
    )
    return tuple(
        replace(one, velocity=math.hypot(one.velocity, other.velocity) / math.sqrt(2.0))
        for one, other in zip(x, y, strict=True)
    )


def _thrust(made: Bearing) -> float:
    """Return the thrust of the standard for a bearing [N]."""
    degrees = math.degrees(made.contact_angle)
    column = next((i for i, most in enumerate(_ANGLES) if degrees <= most + 1e-9), None)
    loads = next((loads for most, loads in _LOADS if 1e3 * made.outside_diameter <= most), None)
    if column is None or loads is None:
        allowed = (
            "a thrust [N]: the standard has none for an outside diameter above 200 mm or a contact angle above "
            f"45°; this one has {1e3 * made.outside_diameter:g} mm and {degrees:g}°"
        )
        raise SceneError("axial_load", "None", allowed)
    return loads[column]
