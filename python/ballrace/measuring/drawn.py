"""Random machines and chains, for sets of training records."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from .._base.libraries import scipy
from .._base.numbers import counted, real
from ..bearings.pedestal import OF_6205
from ..channel import Recorded
from ..errors import SceneError
from .chain import Chain
from .logger import Logger
from .machine import MEASURED_FLOOR, Machine
from .path import log_uniform, random_housing
from .sensor import Sensor

_LEVELS = (1e-2, 1e2)
"""Density of the noise over that of record 97, whose motor is a quiet one: 20 dB either way."""
_OWN_LEVELS = (0.5, 2.0)
"""The same over that of a record which the user has: load and speed move it, not the machine."""
_TILT = 1.0
"""Power of the frequency by which the measured floor may be tilted, either way, about 1 kHz."""
_SHAFT = (3e-3, 1.0)
"""Amplitudes of the shaft's orders 1 to 3 [m/s²]: from record 97 to 5 mm/s at 30 Hz."""
_MAINS = (2e-3, 0.2)
"""Amplitudes of the mains' multiples [m/s²]; record 97 has 0.003 to 0.14 at those of 60 Hz."""
_WEAK_ORDERS, _WEAK_SHARE = 240, 0.2
"""Orders of the shaft up to which weak lines stand in the floor, and the share of them that do."""
_WEAK = (0.5, 50.0)
"""Amplitude of a weak line over the root mean square of the floor in a band of 1 Hz at 1 kHz.

Of the orders of record 97 and of the healthy ones of HIT-SM a tenth is above 2.5 to 12, a hundredth above 8 to 52.
"""
_SWELLING, _CALMEST = (0.3, 0.2, 0.1), 0.05
"""Largest modulation by the shaft's orders 1 to 3, and the smallest over it; record 97 has 0.1 and 0.05."""
_WANDER = 0.3
"""Largest wander of the noise."""
_BAND, _MODES, _DAMPING = (800.0, 12_000.0), (5.0, 40.0), (0.015, 0.06)
"""Modes of paths [Hz], their number, and their damping in the middle of a path's own octave."""
_RESONANCE = (15_000.0, 40_000.0)
"""Mounted resonance of sensors [Hz]: from glued on to screwed down."""


def random_machine(seed: int, *, background: Recorded | None = None) -> Machine:
    """Return a random machine: shaft orders, mains, and noise with fast and slow modulation.

    The noise has the shape of a measured floor with a random slope, at 1/100 to 100 times the density of the quiet
    motor of record 97; or the floor of ``background`` at half to twice its density. The shaft has strong orders 1
    to 3 and a fifth of the others up to 240 as weak lines, as from real surfaces, couplings and motors; the mains
    have six multiples of 50 or 60 Hz. Shaft orders 1 to 3 modulate the noise by up to 0.3, 0.2 and 0.1, down to
    a twentieth of that. Levels are uniform on a logarithmic scale; the noise wanders by up to 0.3.

    Parameters
    ----------
    seed : int
        The same seed gives the same machine.
    background : Signals, Measurement, Recording or Channel, optional
        Record of the healthy machine [m/s²], of half a second or more.

    Raises
    ------
    SceneError
        An argument is not usable.

    Examples
    --------
    >>> made = random_machine(7)
    >>> made == random_machine(7), len(made.mains), made.mains_frequency in (50.0, 60.0)
    (True, 6, True)
    """
    floor = MEASURED_FLOOR if background is None else _floor_of(background)
    rng = np.random.default_rng(counted("seed", seed, 0))
    f, density = (np.asarray(part) for part in floor)
    levels = _LEVELS if background is None else _OWN_LEVELS
    density = density * log_uniform(rng, levels, 1) * (f / 1e3) ** rng.uniform(-_TILT, _TILT)
    weak = math.sqrt(float(np.interp(1e3, f, density)))
    return Machine(
        shaft=_orders(rng, weak),
        mains=tuple((log_uniform(rng, _MAINS, 6) * rng.integers(0, 2, 6)).tolist()),
        mains_frequency=float(rng.choice([50.0, 60.0])),
        noise_density=(f, density),
        modulation=tuple((np.array(_SWELLING) * log_uniform(rng, (_CALMEST, 1.0), 3)).tolist()),
        wander=float(_WANDER * rng.random()),
    )


def random_chains(
    n: int,
    *,
    seed: int,
    background: Recorded | None = None,
    outside_diameter: float = OF_6205,
    near: float = 0.5,
) -> dict[str, Chain]:
    """Return random measuring chains, each of another machine.

    Each has a sensor within 30° of the vertical with a mounted resonance of 15 to 40 kHz, a machine of
    :func:`random_machine` and a logger of 12, 16 or 24 bits at the sampling rate of the signal. The sensor is on
    the structure of the run, beside the bearing, or at the end of a path of :func:`random_housing` with 5 to 40
    modes from 0.8 to 12 kHz, damped by 1 to 8 %, all alike within an octave.

    Parameters
    ----------
    n : int
        How many.
    seed : int
        The same seed gives the same chains; a larger ``n`` adds further ones.
    background : Signals, Measurement, Recording or Channel, optional
        Record of a healthy machine [m/s²], whose noise floor they have; by default that of a measured motor.
    outside_diameter : float
        Outside diameter of the bearing [m], for the masses of :func:`random_housing`; by default a 6205's.
    near : float
        Chance of a sensor on the structure of the run, 0 to 1. Take 0 for arrays of the force on its seat: without
        a path an array is an acceleration.

    Raises
    ------
    SceneError
        An argument is not usable.

    Examples
    --------
    >>> chains = random_chains(3, seed=1)
    >>> list(chains), [chain.path is None for chain in chains.values()]
    (['machine 0', 'machine 1', 'machine 2'], [True, False, False])
    """
    n, seed = counted("n", n, 1), counted("seed", seed, 0)
    if not 0.0 <= real(near) <= 1.0:
        raise SceneError("near", repr(near), "a number, 0 to 1")
    return {f"machine {k}": _chain([seed, k], background, outside_diameter, near) for k in range(n)}


def _chain(
    key: list[int], background: Recorded | None, outside_diameter: float, near: float
) -> Chain:
    rng = np.random.default_rng(key)
    path, machine = (int(number) for number in rng.integers(0, 2**31, 2))
    aside = rng.uniform(-math.pi / 6.0, math.pi / 6.0)
    sensor = Sensor(resonance=float(log_uniform(rng, _RESONANCE, 1)[0]))
    logger = Logger(bits=int(rng.choice([12, 16, 24])))
    is_near = rng.random() < near
    damped = float(log_uniform(rng, _DAMPING, 1)[0])
    # Drawn also where it is not taken, which checks the diameter.
    led = random_housing(
        path,
        modes=round(float(log_uniform(rng, _MODES, 1)[0])),
        band=_BAND,
        damping=(damped / math.sqrt(2.0), damped * math.sqrt(2.0)),
        outside_diameter=outside_diameter,
    )
    return Chain(
        direction=(math.sin(aside), math.cos(aside), 0.0),
        path=None if is_near else led,
        machine=random_machine(machine, background=background),
        sensor=sensor,
        logger=logger,
    )


def _orders(rng: np.random.Generator, weak: float) -> tuple[float, ...]:
    """Return the amplitudes of the shaft's orders: three strong ones, and weak ones here and there [m/s²]."""
    lines = weak * log_uniform(rng, _WEAK, _WEAK_ORDERS)
    lines *= rng.random(_WEAK_ORDERS) < _WEAK_SHARE
    lines[:3] = log_uniform(rng, _SHAFT, 3)
    return tuple(lines.tolist())


def _floor_of(record: Recorded) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the floor of a record: medians of its density over half an octave, which leave lines out.

    Raises
    ------
    SceneError
        It is no record, or too short.
    """
    if not isinstance(record, Recorded):
        raise SceneError(
            "background", type(record).__name__, "a record, such as br.read gives, or None"
        )
    channel = record.channel()
    if not channel.n_samples >= 0.5 * channel.fs:
        raise SceneError(
            "background", f"{channel.n_samples / channel.fs:g} s", "half a second or more"
        )
    size = min(16_384, channel.n_samples)
    f, density = scipy.signal.welch(channel.x, channel.fs, nperseg=size)
    edges = np.geomspace(
        50.0, 0.48 * channel.fs, max(2, round(2.0 * math.log2(channel.fs / 100.0)))
    )
    pairs = list(pairwise(edges))
    inside = [density[(f >= low) & (f < high)] for low, high in pairs]
    kept = [
        (math.sqrt(low * high), float(np.median(d)))
        for (low, high), d in zip(pairs, inside, strict=True)
        if d.size
    ]
    middles, levels = zip(*kept, strict=True)
    return np.array(middles), np.array(levels)
