"""A measuring chain: what lies between a vibrating machine and the numbers in a file.

:func:`ballrace.measure` takes a simulated or a measured acceleration through the stages below in this order,
each of which may be left out; without any the numbers stay as they are. All that is random follows from one
seed, separately for each stage: leaving one out does not change the noise of another.

>>> import ballrace as br
>>> chain = br.measuring.Chain(
...     path=br.measuring.random_housing(seed=1),
...     machine=br.measuring.Machine(shaft=(0.2, 0.1)),
...     logger=br.measuring.Logger(fs=12_000.0, bits=16),
... )
>>> out = br.simulate(br.bearing("6205", speed_rpm=1797.0), duration=0.02)
>>> measured = br.measure(out, chain, seed=1)
>>> measured.fs, measured.x.shape
(12000.0, (240,))

============  ==================================================================================
``source``    the signal: columns of a run along the sensor's direction, or an array; the shaft's angle
``path``      from the force on the seat to a sensor elsewhere: modes, a frequency or an impulse response
``coupling``  how much such modes would act back
``machine``   other vibration there: harmonics of shaft and mains, noise, modulated by the shaft
``noise``     of a given density
``sensor``    mounted resonance and lower limit of the accelerometer
``logger``    anti-aliasing, sampling rate, noise of the electronics, range, quantisation
``tacho``     pulses of a tachometer
``mixing``    onto a measured healthy record
``chain``     the stages one after the other
``named``     several chains, by their names
``drawn``     machines and chains by chance
============  ==================================================================================

Path and sensor are linear and are applied to the spectrum, the record padded until their ringing has died
down: for signals within the band that the sampling rate can hold, as simulated ones are, that is their
frequency response exactly, at every frequency, where recursive filters (held or impulse-invariant) miss by some
percent at a tenth of the sampling rate. They are at rest as the record begins.
"""

from __future__ import annotations

from .._base.later import listed
from .chain import Chain, Measurement, measure
from .drawn import random_chains, random_machine
from .logger import Logger
from .machine import Machine
from .mixing import mix_into
from .named import table
from .path import ImpulseResponse, MeasuredResponse, random_housing
from .sensor import Sensor
from .tacho import Tacho

__all__ = [
    "Chain",
    "ImpulseResponse",
    "Logger",
    "Machine",
    "MeasuredResponse",
    "Measurement",
    "Sensor",
    "Tacho",
    "measure",
    "mix_into",
    "random_chains",
    "random_housing",
    "random_machine",
    "table",
]

__dir__ = listed(__name__)
