"""Ball bearings simulated in three dimensions: faults, loads and vibration signals.

>>> import ballrace as br
>>> scene = br.presets.wheel_bearing(axial_load=3000.0)
>>> eq = br.equilibrium(scene)
>>> eq.outer_load.shape
(26,)

A :class:`Scene` describes a bearing, :func:`simulate` runs it and returns :class:`Signals`,
:func:`equilibrium` solves it at rest, :func:`stiffness` and :func:`load_distribution` compute what follows from
that, :class:`Model` has its equations for other integrators, and :func:`campaign` runs thousands of scenes.
All numbers are in SI units.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import defects, frequencies, presets, scene
from ._base import arrays as _arrays  # noqa: F401 (for its effect)
from ._base.later import later
from .errors import (
    AccuracyWarning,
    BallraceError,
    BudgetError,
    CampaignError,
    CampaignWarning,
    EquilibriumError,
    FileError,
    FileWarning,
    IntegrationError,
    InternalError,
    MemoryLimitError,
    SceneError,
    SceneWarning,
)
from .scene import Scene
from .scene.lubricant import lubricants
from .scene.structure import Mode, Structure

_MOVED = {
    "BearingDataset": "datasets",
    "Catalogue": "bearings",
    "Diagnosis": "diagnosis",
    "Equilibrium": "statics",
    "Explanation": "explanation",
    "FaultFrequencies": "frequencies.operating",
    "FrictionTorque": "ratings",
    "LifeFactor": "ratings",
    "LoadDistribution": "statics",
    "NoiseTest": "noise",
    "RaceFilm": "statics",
    "RatingLife": "ratings",
    "Record": "signals",
    "RecordFolder": "recordings",
    "RingMotion": "ring_force",
    "Snapshot": "simulation",
    "Stiffness": "statics",
    "StiffnessTable": "rotor",
    "Touched": "signals",
    "Trend": "trending",
}
"""Modules of results that nobody constructs, by their names."""

if TYPE_CHECKING:
    from . import diagnosis, learn, machines, measuring, plot, spectra
    from ._results.features import features
    from .bearings import Bearing, bearing, catalogue
    from .campaigns import Campaign, campaign, grid, latin_hypercube, scatter, sobol
    from .channel import Channel
    from .datasets import bearing_split, read_bearing_dataset
    from .diagnosis import diagnose
    from .explanation import explain
    from .frequencies.operating import fault_frequencies
    from .machines import pair, shaft
    from .measuring import measure
    from .model import Model
    from .noise import noise_test
    from .options import Run
    from .ratings import friction_torque_palmgren, friction_torque_skf, rating_life
    from .recordings import Recording, read, read_folder
    from .ring_force import RingForce
    from .rotor import stiffness_table
    from .run import simulate
    from .signals import Signals
    from .simulation import Simulation
    from .statics import equilibrium, load_distribution, stiffness
    from .trending import trend

    __version__: str
else:
    # What describes a scene is there; what is done with it is imported when it is first asked for.
    _found = later(
        __name__,
        {
            "_results.features": ("features",),
            "bearings": ("Bearing", "bearing", "catalogue"),
            "campaigns": ("Campaign", "campaign", "grid", "latin_hypercube", "scatter", "sobol"),
            "channel": ("Channel",),
            "datasets": ("bearing_split", "read_bearing_dataset"),
            "diagnosis": ("diagnose",),
            "explanation": ("explain",),
            "frequencies.operating": ("fault_frequencies",),
            "learn": (),
            "machines": ("pair", "shaft"),
            "measuring": ("measure",),
            "model": ("Model",),
            "noise": ("noise_test",),
            "options": ("Run",),
            "plot": (),
            "ratings": ("friction_torque_palmgren", "friction_torque_skf", "rating_life"),
            "recordings": ("Recording", "read", "read_folder"),
            "ring_force": ("RingForce",),
            "rotor": ("stiffness_table",),
            "run": ("simulate",),
            "signals": ("Signals",),
            "simulation": ("Simulation",),
            "spectra": (),
            "statics": ("equilibrium", "load_distribution", "stiffness"),
            "trending": ("trend",),
        },
        _MOVED,
    )

    def __getattr__(name: str) -> Any:
        """Return what is imported when it is first asked for."""
        if name != "__version__":
            return _found(name)
        from importlib.metadata import version

        return version("ballrace")


__all__ = [
    "AccuracyWarning",
    "BallraceError",
    "Bearing",
    "BudgetError",
    "Campaign",
    "CampaignError",
    "CampaignWarning",
    "Channel",
    "EquilibriumError",
    "FileError",
    "FileWarning",
    "IntegrationError",
    "InternalError",
    "MemoryLimitError",
    "Mode",
    "Model",
    "Recording",
    "RingForce",
    "Run",
    "Scene",
    "SceneError",
    "SceneWarning",
    "Signals",
    "Simulation",
    "Structure",
    "bearing",
    "bearing_split",
    "campaign",
    "catalogue",
    "defects",
    "diagnose",
    "diagnosis",
    "equilibrium",
    "explain",
    "fault_frequencies",
    "features",
    "frequencies",
    "friction_torque_palmgren",
    "friction_torque_skf",
    "grid",
    "latin_hypercube",
    "learn",
    "load_distribution",
    "lubricants",
    "machines",
    "measure",
    "measuring",
    "noise_test",
    "pair",
    "plot",
    "presets",
    "rating_life",
    "read",
    "read_bearing_dataset",
    "read_folder",
    "scatter",
    "scene",
    "shaft",
    "simulate",
    "sobol",
    "spectra",
    "stiffness",
    "stiffness_table",
    "trend",
]


def __dir__() -> list[str]:
    """List the public names, imported or not."""
    return sorted([*__all__, "__version__"])
