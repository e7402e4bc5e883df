"""The user's input: the scene, frozen dataclasses in SI units.

Every class mirrors a part of the document in TOML files. Objects are checked as a whole when
they are used (or by :meth:`Scene.validate`); an error names the path of the field, its value and what is
allowed there. Nothing here changes in place: make variants of a scene with :meth:`Scene.replace` or
:func:`dataclasses.replace`.

Where a field may be one of several things, its type says so: ``friction="none"`` or
``friction=Coulomb(coefficient=0.05, slip_speed=0.1)``.
"""

from __future__ import annotations

from .._base.later import listed
from .bearing import GothicArch, RaceProfile, Ring, RingName, Row, Waviness
from .cage import Cage, CageGuidance, CageRing
from .contact import (
    AccurateSlices,
    Contact,
    FittedSlices,
    FixedSlices,
    Iso16281,
    NormalLaw,
    Slices,
    SqueezeFilm,
)
from .defect import (
    AxialOffset,
    Cap,
    Defect,
    DefectShape,
    DefectWalls,
    Dent,
    Floor,
    Patch,
    Pit,
    SteepPatch,
    Surface,
    Width,
    WidthProfile,
)
from .drive import Drive, SpeedDrive, TorqueDrive
from .friction import Coulomb, Friction, Stribeck, Traction
from .load import Load, Moment, TableForce, Unbalance
from .lubricant import BaseOil, Lubricant, NamedOil, OilLayer, OilProperties
from .material import Material, Materials
from .probe import (
    CageProbe,
    Component,
    ContactQuantity,
    ContactsProbe,
    EnergyProbe,
    ForcesProbe,
    LubricationProbe,
    MomentsProbe,
    MotionProbe,
    Probe,
    SeatProbe,
    SlicesProbe,
    StructureProbe,
    TorqueProbe,
)
from .scene import Scene, Spin
from .solver import Method, Solver
from .structure import Compliance, Mode, Structure
from .support import CoupledSupport, Given, Mount, Spring, Support
from .texture import Texture
from .time import Ramp, Sine, Spline, Table, TimeFunction

__all__ = [
    "AccurateSlices",
    "AxialOffset",
    "BaseOil",
    "Cage",
    "CageGuidance",
    "CageProbe",
    "CageRing",
    "Cap",
    "Compliance",
    "Component",
    "Contact",
    "ContactQuantity",
    "ContactsProbe",
    "Coulomb",
    "CoupledSupport",
    "Defect",
    "DefectShape",
    "DefectWalls",
    "Dent",
    "Drive",
    "EnergyProbe",
    "FittedSlices",
    "FixedSlices",
    "Floor",
    "ForcesProbe",
    "Friction",
    "Given",
    "GothicArch",
    "Iso16281",
    "Load",
    "Lubricant",
    "LubricationProbe",
    "Material",
    "Materials",
    "Method",
    "Mode",
    "Moment",
    "MomentsProbe",
    "MotionProbe",
    "Mount",
    "NamedOil",
    "NormalLaw",
    "OilLayer",
    "OilProperties",
    "Patch",
    "Pit",
    "Probe",
    "RaceProfile",
    "Ramp",
    "Ring",
    "RingName",
    "Row",
    "Scene",
    "SeatProbe",
    "Sine",
    "Slices",
    "SlicesProbe",
    "Solver",
    "SpeedDrive",
    "Spin",
    "Spline",
    "Spring",
    "SqueezeFilm",
    "SteepPatch",
    "Stribeck",
    "Structure",
    "StructureProbe",
    "Support",
    "Surface",
    "Table",
    "TableForce",
    "Texture",
    "TimeFunction",
    "TorqueDrive",
    "TorqueProbe",
    "Traction",
    "Unbalance",
    "Waviness",
    "Width",
    "WidthProfile",
]

__dir__ = listed(__name__)
