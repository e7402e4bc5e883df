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

from typing import TYPE_CHECKING

from . import _arrays, defects, frequencies, presets, scene  # noqa: F401 (the first for its effect)
from ._later import later
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

if TYPE_CHECKING:
    from . import diagnosis, learn, machines, measuring, plot, spectra
    from ._features import features
    from ._results import Record, Touched
    from ._snapshot import Snapshot
    from .bearings import Bearing, Catalogue, Pedestal, bearing, catalogue
    from .campaigns import Campaign, campaign, grid, latin_hypercube, scatter, sobol
    from .channel import Channel
    from .datasets import BearingDataset, bearing_split, read_bearing_dataset
    from .diagnosis import Diagnosis, diagnose
    from .explanation import Explanation, explain
    from .frequencies.operating import FaultFrequencies, fault_frequencies
    from .machines import pair, shaft
    from .measuring import measure
    from .model import Model
    from .noise import NoiseTest, noise_test
    from .options import Run
    from .ratings.friction import FrictionTorque, friction_torque_palmgren, friction_torque_skf
    from .ratings.life import RatingLife, rating_life
    from .ratings.life_factor import LifeFactor
    from .recordings import RecordFolder, Recording, read, read_folder
    from .ring_force import RingForce, RingMotion
    from .rotor import StiffnessTable, stiffness_table
    from .run import simulate
    from .signals import Signals
    from .simulation import Simulation
    from .statics import (
        Equilibrium,
        LoadDistribution,
        RaceFilm,
        Stiffness,
        equilibrium,
        load_distribution,
        stiffness,
    )
    from .trending import Trend, trend
else:
    # What describes a scene is there; what is done with it is imported when it is first asked for.
    __getattr__ = later(
        __name__,
        {
            "_features": ("features",),
            "_snapshot": ("Snapshot",),
            "_results": ("Record", "Touched"),
            "bearings": ("Bearing", "Catalogue", "Pedestal", "bearing", "catalogue"),
            "campaigns": ("Campaign", "campaign", "grid", "latin_hypercube", "scatter", "sobol"),
            "channel": ("Channel",),
            "datasets": ("BearingDataset", "bearing_split", "read_bearing_dataset"),
            "diagnosis": ("Diagnosis", "diagnose"),
            "explanation": ("Explanation", "explain"),
            "frequencies.operating": ("FaultFrequencies", "fault_frequencies"),
            "learn": (),
            "machines": ("pair", "shaft"),
            "measuring": ("measure",),
            "model": ("Model",),
            "noise": ("NoiseTest", "noise_test"),
            "options": ("Run",),
            "plot": (),
            "ratings.friction": (
                "FrictionTorque",
                "friction_torque_palmgren",
                "friction_torque_skf",
            ),
            "ratings.life": ("RatingLife", "rating_life"),
            "ratings.life_factor": ("LifeFactor",),
            "recordings": ("RecordFolder", "Recording", "read", "read_folder"),
            "ring_force": ("RingForce", "RingMotion"),
            "rotor": ("StiffnessTable", "stiffness_table"),
            "run": ("simulate",),
            "signals": ("Signals",),
            "simulation": ("Simulation",),
            "spectra": (),
            "statics": (
                "Equilibrium",
                "LoadDistribution",
                "RaceFilm",
                "Stiffness",
                "equilibrium",
                "load_distribution",
                "stiffness",
            ),
            "trending": ("Trend", "trend"),
        },
    )

__all__ = [
    "AccuracyWarning",
    "BallraceError",
    "Bearing",
    "BearingDataset",
    "BudgetError",
    "Campaign",
    "CampaignError",
    "CampaignWarning",
    "Catalogue",
    "Channel",
    "Diagnosis",
    "Equilibrium",
    "EquilibriumError",
    "Explanation",
    "FaultFrequencies",
    "FileError",
    "FileWarning",
    "FrictionTorque",
    "IntegrationError",
    "InternalError",
    "LifeFactor",
    "LoadDistribution",
    "MemoryLimitError",
    "Model",
    "NoiseTest",
    "Pedestal",
    "RaceFilm",
    "RatingLife",
    "Record",
    "RecordFolder",
    "Recording",
    "RingForce",
    "RingMotion",
    "Run",
    "Scene",
    "SceneError",
    "SceneWarning",
    "Signals",
    "Simulation",
    "Snapshot",
    "Stiffness",
    "StiffnessTable",
    "Touched",
    "Trend",
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
    """List also what is not imported yet."""
    return sorted({*globals(), *__all__})
