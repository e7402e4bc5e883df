"""Balls that spin about any axis: what Jones, Harris and Palmgren know of them, and what is refused.

Under thrust alone all balls live alike, so that one ball with its share of the thrust shows what a bearing's do.
"""

from __future__ import annotations

import dataclasses
import math
import warnings
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray

import ballrace as br
from ballrace import scene as s

# Balls at the speeds of textbooks slide under little load, which is doubted.
pytestmark = pytest.mark.filterwarnings(
    "ignore:row ., (thrust a ball|load of the most|gyroscopic moment|contact angles)",
    "ignore:spin = axial",
)

EXPLICIT = s.Solver(method="dormand-prince")
BALLS = 16
RPM = math.pi / 30.0


def ball_of_218(
    thrust: float,
    speed: float,
    *,
    conformities: tuple[float, float] = (0.5232, 0.5232),
    slip_speed: float = 0.1,
    spin: s.Spin = "free",
) -> br.Scene:
    """One of the sixteen balls of Harris' 218 with its share of the thrust."""
    row = s.Row(
        ball_count=1,
        ball_diameter=22.23e-3,
        pitch_diameter=125.26e-3,
        contact_angle=math.radians(40.0),
        outer_conformity=conformities[0],
        inner_conformity=conformities[1],
    )
    held = s.Support(x="fixed", y="fixed", z=s.Spring(damping=3e3))
    return br.Scene(
        rows=(row,),
        inner_ring=s.Ring(mass=5.0, support=held),
        friction=s.Coulomb(coefficient=0.1, slip_speed=slip_speed),
        spin=spin,
        drive=s.SpeedDrive(speed),
        gravity=(0.0, 0.0, 0.0),
        loads={"thrust": s.Load(ring="inner", direction=(0.0, 0.0, 1.0), force=thrust / BALLS)},
        probes={
            "ball": s.MotionProbe(body="row0.ball0"),
            "at": s.ContactsProbe(quantities=("load", "angle", "zone_width")),
        },
        solver=EXPLICIT,
    )


@dataclass(frozen=True)
class Late:
    """The last tenth of a run of one ball, in the ball's own directions: outwards, along the orbit, axial."""

    scene: br.Scene
    out: br.Signals

    def column(self, name: str) -> NDArray[np.float64]:
        found: NDArray[np.float64] = self.out[name][self.out.t >= 0.9 * self.out.t[-1]]
        return found

    def mean(self, name: str) -> float:
        return float(self.column(name).mean())

    @property
    def speed(self) -> float:
        assert isinstance(self.scene.drive, s.SpeedDrive)
        assert isinstance(self.scene.drive.speed, float)
        return self.scene.drive.speed

    @property
    def place(self) -> NDArray[np.float64]:
        return np.unwrap(np.arctan2(self.column("ball.y"), self.column("ball.x")))

    @property
    def orbit(self) -> float:
        return float(np.polyfit(self.out.t[-self.place.size :], self.place, 1)[0])

    def outwards(self, name: str) -> float:
        x, y = self.column(f"ball.{name}_x"), self.column(f"ball.{name}_y")
        return float((x * np.cos(self.place) + y * np.sin(self.place)).mean())

    def along_orbit(self, name: str) -> float:
        x, y = self.column(f"ball.{name}_x"), self.column(f"ball.{name}_y")
        return float((y * np.cos(self.place) - x * np.sin(self.place)).mean())

    def angle(self, race: str) -> float:
        return self.mean(f"at.ball0.{race}.angle")

    def pivoting(self) -> tuple[float, float]:
        """Angular velocities against the outer and the inner race about the contacts' normals, over the ring's."""
        outer, inner = self.angle("outer"), self.angle("inner")
        axial, outward = self.mean("ball.omega"), self.outwards("omega")
        against_outer = outward * math.cos(outer) + axial * math.sin(outer)
        against_inner = outward * math.cos(inner) + (axial - self.speed) * math.sin(inner)
        return abs(against_outer) / self.speed, abs(against_inner) / self.speed

    def pitch(self) -> float:
        """Harris' β: between the bearing's axis and that of the spin, as the cage sees it."""
        return math.atan2(self.outwards("omega"), self.orbit - self.mean("ball.omega"))

    def grip(self, race: str) -> float:
        """Load times length of a contact; ellipses here are so alike that their shape adds nothing."""
        return self.mean(f"at.ball0.{race}.load") * self.mean(f"at.ball0.{race}.zone_width")


def late(scene: br.Scene, duration: float = 0.04) -> Late:
    with warnings.catch_warnings():
        # Fast balls go round otherwise than by rolling at one angle, which is what these tests look at.
        warnings.filterwarnings("ignore", "row 0: its balls orbited", br.SceneWarning)
        return Late(scene, br.simulate(scene, duration=duration, settle=0.0))


def jones(found: Late, race: str) -> tuple[float, float]:
    """Orbit over the ring's speed, and pitch angle, with control by a race (Harris, Rolling Bearing Analysis)."""
    outer, inner = found.angle("outer"), found.angle("inner")
    row = found.scene.rows[0]
    distance = np.hypot(found.column("ball.x"), found.column("ball.y")).mean()
    gamma = row.ball_diameter / (2.0 * distance)
    if race == "outer":
        orbit = (1.0 - gamma * math.cos(inner)) / (1.0 + math.cos(inner - outer))
        pitch = math.atan(math.sin(outer) / (math.cos(outer) + gamma))
    else:
        orbit = (math.cos(inner - outer) - gamma * math.cos(outer)) / (
            1.0 + math.cos(inner - outer)
        )
        pitch = math.atan(math.sin(inner) / (math.cos(inner) - gamma))
    return orbit, pitch


@pytest.fixture(scope="module")
def fast() -> Late:
    """A 218 at 10 000 1/min under 17.8 kN, where centrifugal forces part the contact angles by 17°."""
    return late(ball_of_218(17_800.0, 10_000.0 * RPM))


def test_a_fast_ball_runs_between_the_controls_of_both_races(fast: Late) -> None:
    """Truth: Jones and Harris. A ball that spins about the bearing's axis runs ahead of both."""
    (outer, outer_pitch), (inner, inner_pitch) = (jones(fast, race) for race in ("outer", "inner"))
    orbit = fast.orbit / fast.speed
    print(f"orbit {inner:.4f} {orbit:.4f} {outer:.4f}")
    print(f"pitch {outer_pitch:.4f} {fast.pitch():.4f} {inner_pitch:.4f}")
    assert outer - inner > 0.03
    assert inner < orbit < outer
    assert outer_pitch < fast.pitch() < inner_pitch
    axial = late(ball_of_218(17_800.0, 10_000.0 * RPM, spin="axial"))
    assert axial.orbit / axial.speed > outer + 0.02


def test_the_outer_race_gains_grip_with_speed(fast: Late) -> None:
    """Truth: centrifugal force loads the outer race alone, which Jones took for control by it."""
    slow = late(ball_of_218(17_800.0, 1000.0 * RPM))
    shares = [outer / (outer + inner) for outer, inner in (slow.pivoting(), fast.pivoting())]
    assert 0.45 < shares[0] < 0.6
    assert 0.05 < shares[1] < 0.3


def test_races_supply_what_turns_the_axis_of_spin(fast: Late) -> None:
    """Truth: a ball that is carried round needs the moment I ω_c ω_n about the way it goes (Harris' M_g)."""
    inertia = 0.4 * 7850.0 * math.pi / 6.0 * 22.23e-3**5 / 4.0
    wanted = inertia * fast.orbit * fast.outwards("omega")
    found = inertia * fast.along_orbit("alpha")
    print(f"moment {found:.5f} {wanted:.5f} N m")
    assert abs(wanted) > 0.1
    assert found == pytest.approx(wanted, rel=0.01)


@pytest.mark.parametrize("conformities", [(0.55, 0.515), (0.515, 0.55)])
def test_the_race_with_more_grip_pivots_less_but_it_does(
    conformities: tuple[float, float],
) -> None:
    """Truth: friction of a trial outside of the package; there is no control by a race."""
    found = late(
        ball_of_218(50_000.0, 100.0, conformities=conformities, slip_speed=0.01), duration=0.03
    )
    rates = dict(zip(("outer", "inner"), found.pivoting(), strict=True))
    held, loose = sorted(rates, key=found.grip, reverse=True)
    assert (held == "inner") == (conformities[1] < conformities[0])
    # The trial at 100 rad/s: 17.5 and 49.4 rad/s, 21.1 and 45.9 exchanged; its slip speed moves that by 4 rad/s.
    trial = (0.494, 0.175) if held == "inner" else (0.211, 0.459)
    assert found.pivoting() == pytest.approx(trial, abs=0.04)
    assert 0.1 < rates[held] < 0.6 * rates[loose]


FACTORS = {
    # f₁ and the load on which it acts, for a thrust alone (Harris' tables for Palmgren's formula).
    "7205B": lambda F, made: (
        0.001 * (0.26 * F / made.static_rating) ** 0.33,
        0.9 * F / math.tan(made.contact_angle),
    ),
    "6205": lambda F, made: (0.0005 * (0.5 * F / made.static_rating) ** 0.55, 3.0 * F),
}


@pytest.mark.parametrize("name", FACTORS)
def test_friction_torque_under_thrust_is_palmgrens(name: str) -> None:
    """Truth: Palmgren's load torque, of measured bearings. With axial spin it is several times too large."""
    thrust, made = 2000.0, br.catalogue[name]
    f_1, load = FACTORS[name](thrust, made)
    known = br.friction_torque_palmgren(
        pitch_diameter=made.pitch_diameter,
        speed_rpm=1000.0,
        viscosity=35e-6,
        load=load,
        f_0=0.0,
        f_1=f_1,
    ).sliding
    # With a slip speed well below that of the pivoting contacts' ends, near 0.03 m/s.
    scene = dataclasses.replace(
        br.bearing(name, radial_load=0.0, axial_load=thrust, speed_rpm=1000.0),
        friction=s.Coulomb(coefficient=0.05, slip_speed=0.01),
        gravity=(0.0, 0.0, 0.0),
        probes={"torque": s.TorqueProbe()},
        solver=EXPLICIT,
    )
    torques = {}
    for spin in ("free", "axial"):
        out = br.simulate(scene.replace({"spin": spin}), duration=4e-3, settle=0.0, rtol=1e-9)
        torques[spin] = -out["torque.inner"][out.t > 3.5e-3].mean()
    print({spin: 1e3 * torque for spin, torque in torques.items()}, 1e3 * known)
    assert 0.5 < torques["free"] / known < 2.0
    assert 4.0 < torques["axial"] / known < 10.0
    if name == "6205":
        # SKF's sliding torque in a full film, also of μ 0.05, lies between: all slides, but nothing pivots.
        skf = br.friction_torque_skf(
            "62",
            bore=made.bore,
            outside_diameter=made.outside_diameter,
            speed_rpm=1000.0,
            viscosity=3e-3,
            radial_load=0.0,
            axial_load=thrust,
            static_rating=made.static_rating,
        )
        print(1e3 * skf.sliding)
        assert 1.2 * torques["free"] < skf.sliding < 0.8 * torques["axial"]


def test_in_the_plane_both_spins_are_the_same() -> None:
    """Limits: at a contact angle of 0 nothing turns a ball out of the axis."""
    scene = br.presets.deep_groove_6205(500.0).replace(
        {
            "probes": {
                "ball": s.MotionProbe(body="row0.ball0"),
                "outer": s.MotionProbe(body="outer", components=("x", "y", "ax", "ay")),
                "torque": s.TorqueProbe(),
            },
            # So loose that all steps are the longest, for both the same.
            "solver.method": "dormand-prince",
            "solver.rtol": 0.1,
            "solver.first_step": 1e-6,
            "solver.max_step": 1e-6,
            "solver.reduce": False,
        }
    )
    axial, free = (
        br.simulate(scene.replace({"spin": spin}), duration=5e-4, start="rolling")
        for spin in ("axial", "free")
    )
    assert set(free.units) - set(axial.units) == {
        f"ball.{name}_{axis}" for name in ("turn", "omega", "alpha") for axis in "xy"
    }
    for name in axial.units:
        if name[-1] != "z":  # which is 0 but for rounding
            scale = np.abs(axial[name]).max()
            np.testing.assert_allclose(free[name], axial[name], rtol=0.0, atol=1e-8 * scale)
    for axis in "xy":
        assert np.abs(free[f"ball.omega_{axis}"]).max() < 1e-9


def test_documents_without_spin_say_nothing_of_it() -> None:
    plain = br.presets.deep_groove_6205()
    for text in (plain.to_toml(), plain.to_json()):
        assert "spin" not in text
    free = plain.replace({"spin": "free"})
    assert br.Scene.from_toml(free.to_toml()) == free
    names = set(br.Model(free).names) - set(br.Model(plain).names)
    assert {"row0.ball0.omega_x", "row0.ball8.turn_y"} < names
    assert len(names) == 4 * plain.rows[0].ball_count


BALL = s.MotionProbe(body="row0.ball0", components=("omega_x",))
RING = s.MotionProbe(body="inner", components=("omega_x",))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"spin": "round"}, r'spin = "round".*"axial" or "free"'),
        (
            {"probes": {"ring": RING}},
            r"probes\.ring\.motion\.components = omega_x: a component of inner",
        ),
        ({"spin": "axial", "probes": {"ball": BALL}}, r'omega_x: .* need spin = "free"'),
    ],
)
def test_what_cannot_spin_freely_is_refused_by_name(
    changes: dict[str, object], message: str
) -> None:
    scene = br.presets.deep_groove_6205().replace(
        {"solver.method": "dormand-prince", "spin": "free"}
    )
    with pytest.raises(br.SceneError, match=message):
        br.simulate(scene.replace(changes), duration=1e-3)


@pytest.mark.parametrize("spin", ["axial", "free"])
def test_a_cap_is_met_where_its_ball_rolls(spin: s.Spin) -> None:
    """Truth: geometry. Contacts run at 40° from the bearing's plane, or near a rolling ball's equator."""
    bearing = br.bearing("7205B", radial_load=0.0, axial_load=1000.0, speed_rpm=1800.0)
    radius = 0.5 * bearing.rows[0].ball_diameter

    def meets(place: float) -> bool:
        # Ball 0 begins below the axis; the x axis, from which angles of its defects count, points along its orbit.
        cap = s.Defect(
            on="ball", ball=0, angle=0.0, shape="cap", width=1e-3, edge_radius=3e-4,
            axial_offset=place * radius,
        )  # fmt: skip
        scene = bearing.replace(
            {"spin": spin, "gravity": (0.0, 0.0, 0.0), "defects": {"cap": cap}, "solver": EXPLICIT}
        )
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", br.SceneWarning)  # Nothing touched one of them.
            out = br.simulate(scene, duration=0.02, settle=0.0)
        return bool(out.provenance.defects[0]["touched"])

    at_forty, at_equator = meets(math.sin(math.radians(40.0))), meets(0.0)
    assert (at_forty, at_equator) == (spin == "axial", spin == "free")


def test_a_patch_of_a_ball_that_spins_freely_is_refused() -> None:
    patch = s.Defect(on="ball", ball=0, angle=0.0, length=1e-3, width=1e-3, edge_radius=3e-4)
    scene = br.presets.deep_groove_6205().replace({"defects.patch": patch})
    with pytest.raises(
        br.SceneError, match=r'defects\.patch\.shape = "patch": "cap", "pit" or "dent" for a ball'
    ):
        scene.replace({"spin": "free"})


def test_a_run_goes_on_from_where_a_cap_has_settled() -> None:
    """Truth: a rotation is one after any number of steps. Some such runs were refused by their own start."""
    cap = br.defects.cap(width_mm=0.5, ball=3)
    scene = br.bearing(
        "6205",
        radial_load=500.0,
        axial_load=500.0,
        speed_rpm=1797.0,
        lubricant="vg68",
        temperature_c=50.0,
        defects=cap,
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", br.SceneWarning)  # Nothing touched it so soon.
        out = br.simulate(scene.replace({"spin": "free"}), duration=2e-3)
    assert np.isfinite(out["outer.ay"]).all()
