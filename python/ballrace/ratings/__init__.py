"""Published formulas for a bearing: rating life, load ratings, friction torque."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .._base.later import later, listed

if TYPE_CHECKING:
    from .friction import FrictionTorque, friction_torque_palmgren, friction_torque_skf
    from .life import RatingLife, rating_life
    from .life_factor import LifeFactor
else:
    __getattr__ = later(
        __name__,
        {
            "friction": ("FrictionTorque", "friction_torque_palmgren", "friction_torque_skf"),
            "life": ("RatingLife", "rating_life"),
            "life_factor": ("LifeFactor",),
        },
    )

__all__ = [
    "FrictionTorque",
    "LifeFactor",
    "RatingLife",
    "friction_torque_palmgren",
    "friction_torque_skf",
    "rating_life",
]

__dir__ = listed(__name__)
