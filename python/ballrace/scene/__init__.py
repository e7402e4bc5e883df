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

# ruff: noqa: F403 - each module lists what is public of it
from . import (
    bearing,
    cage,
    contact,
    defect,
    drive,
    friction,
    load,
    lubricant,
    material,
    probe,
    scene,
    solver,
    structure,
    support,
    texture,
    time,
)
from .bearing import *
from .cage import *
from .contact import *
from .defect import *
from .drive import *
from .friction import *
from .load import *
from .lubricant import *
from .material import *
from .probe import *
from .scene import *
from .solver import *
from .structure import *
from .support import *
from .texture import *
from .time import *

__all__: list[str] = []
__all__ += bearing.__all__
__all__ += cage.__all__
__all__ += contact.__all__
__all__ += defect.__all__
__all__ += drive.__all__
__all__ += friction.__all__
__all__ += load.__all__
__all__ += lubricant.__all__
__all__ += material.__all__
__all__ += probe.__all__
__all__ += scene.__all__
__all__ += solver.__all__
__all__ += structure.__all__
__all__ += support.__all__
__all__ += texture.__all__
__all__ += time.__all__

__dir__ = listed(__name__)
