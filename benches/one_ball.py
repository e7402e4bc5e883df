"""One ball with its share of a bearing under thrust alone, where all balls live alike; for `tilt.py`."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

import ballrace as br
from ballrace.paper.measures import orbit as orbit_of
from ballrace.scene import (
    ContactsProbe,
    Coulomb,
    Load,
    MotionProbe,
    Ring,
    Row,
    Scene,
    Solver,
    SpeedDrive,
    Spin,
    Spring,
    Support,
)

Race = Literal["outer", "inner"]
RACES: tuple[Race, ...] = ("outer", "inner")
EXPLICIT = Solver(method="dormand-prince")

BALLS = 16
"""Of a 218."""


def ball_of_218(
    thrust: float,
    speed: float,
    *,
    spin: Spin = "free",
    conformities: tuple[float, float] = (0.5232, 0.5232),
    slip_speed: float = 0.1,
) -> Scene:
    """Return one ball of a 218 with its share of the thrust: under thrust alone all balls live alike.

    Conformities are those of the outer and the inner race; the speed is in rad/s.
    """
    row = Row(
        ball_count=1, ball_diameter=22.23e-3, pitch_diameter=125.26e-3, contact_angle=math.radians(40.0),
        outer_conformity=conformities[0], inner_conformity=conformities[1],
    )  # fmt: skip
    held = Support(x="fixed", y="fixed", z=Spring(damping=3e3))
    return Scene(
        rows=(row,), inner_ring=Ring(mass=5.0, support=held), spin=spin, gravity=(0.0, 0.0, 0.0),
        friction=Coulomb(coefficient=0.1, slip_speed=slip_speed), drive=SpeedDrive(speed),
        loads={"thrust": Load(ring="inner", direction=(0.0, 0.0, 1.0), force=thrust / BALLS)},
        probes={
            "ball": MotionProbe(body="row0.ball0"),
            "at": ContactsProbe(quantities=("load", "angle", "zone_width")),
        },
        solver=EXPLICIT,
    )  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class Spun:
    """A ball as the end of a run finds it, speeds over the inner ring's.

    Attributes
    ----------
    orbit : float
        ω_c.
    axial, outward : float
        ω_z and ω_n, the ball's angular velocity along the axis and outwards.
    distance, radius : float
        Of the ball's centre from the axis, and of the ball [m].
    angles, loads, lengths : tuple of float
        Contact angles [rad], normal forces [N] and half-lengths of the contacts [m], outer and inner.
    """

    orbit: float
    axial: float
    outward: float
    distance: float
    radius: float
    angles: tuple[float, float]
    loads: tuple[float, float]
    lengths: tuple[float, float]

    @property
    def pitch(self) -> float:
        """Angle between the bearing's axis and that of the ball's spin as the cage sees it, Harris' β [rad]."""
        return math.atan2(self.outward, self.orbit - self.axial)

    @property
    def pivoting(self) -> tuple[float, float]:
        """Pivoting rates against the outer and the inner race."""
        outer, inner = self.angles
        return (
            self.outward * math.cos(outer) + self.axial * math.sin(outer),
            self.outward * math.cos(inner) + (self.axial - 1.0) * math.sin(inner),
        )

    def controlled_by(self, race: Race) -> Spun:
        """Return how Jones and Harris have it roll on both races, pivoting on the other one alone."""
        outer, inner = self.angles
        d, R, side = self.distance, self.radius, outer if race == "outer" else inner
        equations = [
            [d, R * math.cos(outer), -R * math.sin(outer)],
            [d, -R * math.cos(inner), R * math.sin(inner)],
            [0.0, math.sin(side), math.cos(side)],
        ]
        known = [0.0, d - R * math.cos(inner), 0.0 if race == "outer" else math.sin(inner)]
        orbit, axial, outward = np.linalg.solve(equations, known).tolist()
        return replace(self, orbit=orbit, axial=axial, outward=outward)


def spun(scene: Scene, duration: float) -> Spun:
    """Run ball 0 of a scene and return what the last tenth of it shows."""
    out = br.simulate(scene, duration=duration, settle=0.0)
    late = out.t >= 0.9 * duration
    x, y, omega = (out[f"ball.{name}"][late] for name in ("x", "y", "omega"))
    assert isinstance(scene.drive, SpeedDrive)
    assert isinstance(scene.drive.speed, float)
    outward = np.zeros_like(x)
    if scene.spin == "free":
        outward = (out["ball.omega_x"][late] * x + out["ball.omega_y"][late] * y) / np.hypot(x, y)

    def at(quantity: str) -> tuple[float, float]:
        outer, inner = (float(out[f"at.ball0.{race}.{quantity}"][late].mean()) for race in RACES)
        return outer, inner

    outer, inner = at("zone_width")
    return Spun(
        orbit=orbit_of(out.t[late], x, y)[0] / scene.drive.speed,
        axial=float(omega.mean()) / scene.drive.speed,
        outward=float(outward.mean()) / scene.drive.speed,
        distance=float(np.hypot(x, y).mean()), radius=0.5 * scene.rows[0].ball_diameter,
        angles=at("angle"), loads=at("load"), lengths=(0.5 * outer, 0.5 * inner),
    )  # fmt: skip
