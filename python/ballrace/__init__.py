"""Ball bearings simulated in three dimensions: faults, loads and vibration signals.

>>> import ballrace as br
>>> scene = br.presets.wheel_bearing(axial_load=3000.0)
>>> eq = br.equilibrium(scene)
>>> eq.outer_load.shape
(26,)

A :class:`Scene` says what there is, :func:`simulate` runs it and returns :class:`Signals`,
:func:`equilibrium` solves it at rest, and :class:`Model` gives its equations to anyone's integrator.
All numbers are in SI units, at every face.
"""

from __future__ import annotations

from . import frequencies, presets, scene, spectra
from .errors import AccuracyWarning, BallraceError, EquilibriumError, IntegrationError, SceneError
from .model import Model
from .run import simulate
from .scene import Scene
from .signals import Record, Signals
from .statics import Equilibrium, equilibrium

__all__ = [
    "AccuracyWarning",
    "BallraceError",
    "Equilibrium",
    "EquilibriumError",
    "IntegrationError",
    "Model",
    "Record",
    "Scene",
    "SceneError",
    "Signals",
    "equilibrium",
    "frequencies",
    "presets",
    "scene",
    "simulate",
    "spectra",
]
