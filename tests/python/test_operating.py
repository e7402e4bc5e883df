"""Fault frequencies at the operating contact angle and with measured slip; defects as they are spoken of."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import ballrace as br
from ballrace.scene import Coulomb, Dent, MotionProbe, Ramp, SpeedDrive, Spin, Surface, WidthProfile

# Balls at the speeds of textbooks slide under little load, which is doubted.
pytestmark = pytest.mark.filterwarnings(
    "ignore:row ., (thrust a ball|load of the most|gyroscopic moment|contact angles)",
    "ignore:spin = axial",
)


def test_of_a_name_they_are_the_published_ones() -> None:
    # Case Western Reserve University, 6205 at 1797 1/min.
    found = br.fault_frequencies("SKF 6205-2RS", 1797.0)
    assert (found.shaft, found.contact_angle, found.slip) == (29.95, 0.0, None)
    assert [found.bpfo, found.bpfi, 2.0 * found.bsf, found.ftf] == pytest.approx(
        [107.36, 162.19, 141.17, 11.93], abs=6e-3
    )
    assert found.orders.bpfo == pytest.approx(3.5848, abs=5e-5)
    assert br.fault_frequencies(br.catalogue["6205"], 1797.0) == found


def test_thrust_opens_the_angle_and_moves_them_as_kinematics_says() -> None:
    scene = br.bearing("6205", radial_load=0.0, axial_load=500.0, speed_rpm=600.0)
    found, eq = br.fault_frequencies(scene), br.equilibrium(scene)
    assert found.contact_angle == pytest.approx(
        0.5 * float(np.mean(eq.outer_angle) + np.mean(eq.inner_angle)), rel=1e-3
    )
    assert math.degrees(found.contact_angle) > 10.0
    gamma = 7.94 / 39.04 * math.cos(found.contact_angle)
    # But for the centres, which stand some micrometres outside the pitch circle.
    # Friction along contacts that are curved and long takes another 0.2 %.
    assert found.bpfo == pytest.approx(4.5 * 10.0 * (1.0 - gamma), rel=3e-3)
    outer, inner = np.mean(eq.outer_angle), np.mean(eq.inner_angle)
    levers = [0.5 * 7.94e-3 * math.cos(angle) for angle in (outer, inner)]
    r = float(np.mean(eq.radius))
    rolling = (r - levers[1]) / (r * (1.0 + levers[1] / levers[0]))
    assert found.ftf == pytest.approx(10.0 * rolling, rel=3e-3)
    nominal = br.fault_frequencies(scene, operating=False)
    assert nominal.contact_angle == 0.0
    assert found.bpfo > nominal.bpfo
    assert found.bpfi < nominal.bpfi


def test_of_a_run_the_cage_is_measured() -> None:
    """Thrust alone, friction and no play: the balls roll at the operating angle, and the cage with them."""
    scene = br.bearing("6205", radial_load=0.0, axial_load=400.0, speed_rpm=1800.0)
    probes = {"ball": MotionProbe(body="row0.ball2", components=("x", "y")), **scene.probes}
    scene = replace(scene.replace({"cage.ring.pocket_clearance": 0.0}), probes=probes)
    out = br.simulate(scene, duration=0.05, fs=10_000.0)
    found = br.fault_frequencies(out)
    turned = np.unwrap(np.arctan2(out["ball.y"], out["ball.x"]))
    rate = (turned[-1] - turned[0]) / (out.t[-1] - out.t[0]) / (2.0 * math.pi)
    assert found.ftf == pytest.approx(rate, rel=1e-3)
    assert not any("orbited at" in text for text in out.warnings)
    assert found.bpfo == pytest.approx(9.0 * found.ftf)
    assert found.bpfi == pytest.approx(9.0 * (30.0 - found.ftf))
    assert found.slip is not None
    assert abs(found.slip) < 2e-3
    rolling = br.fault_frequencies(scene)
    assert found.slip == pytest.approx(1.0 - found.ftf / rolling.ftf)
    # Nominal kinematics is farther off than rolling at the operating angle.
    assert abs(br.fault_frequencies(out, operating=False).ftf / rate - 1.0) > 5.0 * abs(found.slip)


def test_without_a_balls_motion_there_is_no_slip() -> None:
    out = br.simulate(br.bearing("6205", speed_rpm=1800.0), duration=1e-3)
    assert br.fault_frequencies(out).slip is None


def test_what_is_refused() -> None:
    scene = br.bearing("6205", speed_rpm=1800.0)
    run_up = replace(scene, drive=SpeedDrive(Ramp(from_=0.0, to=100.0, start=0.0, end=1.0)))
    for arguments, field in (
        (("6205",), "speed_rpm"),
        (("6205", 0.0), "speed_rpm"),
        ((run_up,), "speed_rpm"),
        (("62x5", 1.0), "designation"),
        ((3, 1.0), "of"),
    ):
        with pytest.raises(br.SceneError) as refused:
            br.fault_frequencies(*arguments)
        assert refused.value.path == field
    with pytest.raises(br.SceneError, match="row"):
        br.fault_frequencies(scene, row=1)
    assert br.fault_frequencies(run_up, 600.0).shaft == 10.0


FAST = [
    (("7205C", 0.0, 300.0, 25_000.0), 2e-4),
    (("7218B", 0.0, 17_800.0, 10_000.0), 1e-3),
    (("7205A5", 0.0, 300.0, 25_000.0), 2e-4),
    # Under a radial load no ball stays as it is: its axis lags behind the loads on its way, the more the faster.
    (("7205B", 100.0, 500.0, 3_000.0), 1e-3),
    (("7205B", 100.0, 500.0, 15_000.0), 1.4e-2),
]


@pytest.mark.parametrize("spin", ["free", "axial"])
@pytest.mark.parametrize(("case", "off"), FAST)
@pytest.mark.filterwarnings("ignore:row 0. its balls orbited")
def test_fast_balls_go_round_as_their_scene_predicts(
    case: tuple[str, float, float, float], off: float, spin: Spin
) -> None:
    """Truth: the run. Gyroscopic moments put it 1 to 6 % ahead of rolling without them."""
    name, radial, axial, speed = case
    scene = br.bearing(name, radial_load=radial, axial_load=axial, speed_rpm=speed)
    scene = replace(scene, spin=spin)
    out = br.simulate(scene, duration=0.03)
    of_scene, found = br.fault_frequencies(scene), br.fault_frequencies(out)
    assert found.ftf == pytest.approx(of_scene.ftf, rel=off)
    assert found.bpfo == pytest.approx(of_scene.bpfo, rel=off)


@pytest.mark.parametrize("spin", ["free", "axial"])
@pytest.mark.parametrize("name", ["7205C", "7218B"])
def test_fast_balls_start_as_they_go_on(name: str, spin: Spin) -> None:
    """Truth: the right-hand side. In the cage's frame nothing accelerates under pure thrust."""
    axial, speed = {"7205C": (300.0, 25_000.0), "7218B": (17_800.0, 10_000.0)}[name]
    scene = br.bearing(name, radial_load=0.0, axial_load=axial, speed_rpm=speed)
    scene = replace(scene, spin=spin, gravity=(0.0, 0.0, 0.0))
    model = br.Model(scene)
    y = np.asarray(model.start("equilibrium"))
    dy, half = np.asarray(model.rhs(0.0, y)), len(y) // 2
    at = {str(state): i for i, state in enumerate(model.names[:half])}
    place, velocity, acceleration = y[:half], y[half:], dy[half:]
    x, y_, z = (at[f"row0.ball0.{k}"] for k in "xyz")
    radius = math.hypot(place[x], place[y_])
    orbit = (place[x] * velocity[y_] - place[y_] * velocity[x]) / radius**2
    towards = orbit**2 * radius
    for i in (x, y_):
        assert acceleration[i] + orbit**2 * place[i] == pytest.approx(0.0, abs=1e-6 * towards)
    assert acceleration[z] == pytest.approx(0.0, abs=1e-6 * towards)
    turns = ["theta"] if spin == "axial" else ["turn_x", "turn_y", "theta"]
    spins = np.array([velocity[at[f"row0.ball0.{k}"]] for k in turns])
    changes = np.array([acceleration[at[f"row0.ball0.{k}"]] for k in turns])
    carried = np.zeros(1) if spin == "axial" else orbit * np.array([-spins[1], spins[0], 0.0])
    assert np.abs(changes - carried).max() < 1e-6 * orbit * np.linalg.norm(spins)


def test_a_race_that_controls_its_balls() -> None:
    """Truth: Jones, Harris: ω_c = Ω (1 − γ' cos α_i)/(1 + cos(α_i − α_o)) without pivoting on the outer race."""
    scene = br.bearing("7218B", radial_load=0.0, axial_load=17_800.0, speed_rpm=10_000.0)
    free, held = scene, replace(scene, spin="axial")
    assert free.spin == "free"
    eq = br.equilibrium(free, race_control="outer")
    found = br.fault_frequencies(free, race_control="outer")
    outer, inner = float(np.mean(eq.outer_angle)), float(np.mean(eq.inner_angle))
    gamma = scene.rows[0].ball_diameter / (2.0 * float(np.mean(eq.radius)))
    by_outer = (1.0 - gamma * math.cos(inner)) / (1.0 + math.cos(inner - outer))
    assert found.orders.ftf == pytest.approx(by_outer, rel=1e-3)
    # Friction lets the balls pivot on both races.
    assert br.fault_frequencies(free).orders.ftf == pytest.approx(by_outer, rel=0.02)
    # Where balls spin about z there is nothing to control.
    axial = br.fault_frequencies(held)
    assert br.fault_frequencies(held, race_control="outer") == axial
    with pytest.raises(br.SceneError, match="race_control"):
        br.equilibrium(free, race_control="inner")  # type: ignore[arg-type]


def test_of_a_fast_run_lines_are_sought_where_its_balls_pass() -> None:
    """Truth: the angles of the loaded balls, and the strongest line of a spall's envelope."""
    scene = br.bearing(
        "7205A5", radial_load=50.0, axial_load=400.0, speed_rpm=25_000.0,
        defects=br.defects.spall(on="outer_race", width_mm=0.8, length_mm=2.0),
    )  # fmt: skip
    balls = {
        f"ball{k}": MotionProbe(body=f"row0.ball{k}", components=("x", "y")) for k in range(12)
    }
    scene = replace(
        scene, spin="free", friction=Coulomb(coefficient=0.05, slip_speed=0.02),
        probes={**scene.probes, **balls},
    )  # fmt: skip
    out = br.simulate(scene, duration=0.1)
    of_scene, found = br.fault_frequencies(scene), br.fault_frequencies(out)
    angles = (np.unwrap(np.arctan2(out[f"{ball}.y"], out[f"{ball}.x"])) for ball in balls)
    turns = np.mean([angle[-1] - angle[0] for angle in angles]) / (2.0 * math.pi)
    assert found.ftf == pytest.approx(turns / (out.t[-1] - out.t[0]), rel=2e-4)
    assert found.ftf == pytest.approx(of_scene.ftf, rel=1e-2)
    assert found.slip == pytest.approx(1.0 - found.ftf / of_scene.ftf)
    frequency, height = br.spectra.envelope_spectrum(out["outer.ay"], out.fs)
    near = np.abs(frequency / of_scene.bpfo - 1.0) < 0.1
    strongest = frequency[near][np.argmax(height[near])]
    assert strongest == pytest.approx(found.bpfo, rel=5e-3)
    line = out.features(columns=["outer.ay"])["outer.ay.row0.bpfo_envelope"]
    assert line == pytest.approx(height[near].max(), rel=0.2)


# ------------------------------------------------------------------------------- defects


def test_a_spall_lies_where_the_contact_runs_and_is_met() -> None:
    spall = br.defects.spall(on="outer_race", width_mm=1.2, length_mm=2.0, edge_radius_mm=0.2)
    assert (spall.width, spall.length, spall.edge_radius) == pytest.approx((1.2e-3, 2e-3, 0.2e-3))
    assert (spall.axial_offset, spall.floor, spall.ball) == ("contact", None, None)
    scene = br.bearing("6205", axial_load=400.0, speed_rpm=6000.0, defects={"spall": spall})
    met = br.simulate(scene, duration=0.01).defects["spall"]
    assert met.placed == "contact"
    assert met.share == 1.0
    assert abs(met.axial_offset) > 1e-4


@pytest.mark.parametrize("name", ["6000", "6310", "6804", "7204B", "7218B"])
@pytest.mark.parametrize("on", ["outer_race", "inner_race"])
def test_a_spall_fits_any_bearing(name: str, on: Surface) -> None:
    scene = br.bearing(name, defects=br.defects.spall(on=on, width_mm=1.2), speed_rpm=1800.0)
    br.simulate(scene, duration=1e-4, settle=0.0)


def test_a_dent_has_a_rim() -> None:
    dent = br.defects.dent(on="outer_race", diameter_mm=0.2, rim_height_mm=0.0003, ball=None)
    assert isinstance(dent, Dent)
    assert (dent.width, dent.length) == (0.2e-3, 0.0)
    assert (dent.depth, dent.rim_height) == pytest.approx((8e-6, 0.3e-6))
    assert br.defects.dent(on="ball", diameter_mm=0.2, rim_height_mm=0.0).rim_height == 0.0
    scene = br.bearing("6205", radial_load=500.0, defects=dent, speed_rpm=1800.0)
    met = br.simulate(scene, duration=0.02).defects["dent"]
    assert (met.placed, met.share) == ("contact", 1.0)
    with pytest.raises(br.SceneError, match="smaller than its contact"):
        br.simulate(scene.replace({"defects.dent.width": 3e-3}), duration=1e-4)
    with pytest.raises(br.SceneError, match=r"depth_mm = 0\.01: left out beside edge_radius_mm"):
        br.defects.dent(on="outer_race", diameter_mm=1.0, depth_mm=0.01, edge_radius_mm=0.3)


def test_a_wide_dent_is_a_round_patch() -> None:
    dent = br.defects.dent(on="outer_race", diameter_mm=1.0, edge_radius_mm=0.3)
    assert isinstance(dent.width, WidthProfile)
    z, w = np.asarray(dent.width.positions), np.asarray(dent.width.widths)
    np.testing.assert_allclose(z**2 + (0.5 * w) ** 2, (0.5e-3) ** 2, rtol=1e-9)
    assert (z[0], z[-1], dent.length) == pytest.approx((-0.5e-3, 0.5e-3, 1e-3))
    assert w.max() == pytest.approx(1e-3)


def test_a_line_is_narrow_and_sharp_and_lies_where_the_contact_runs() -> None:
    line = br.defects.line(on="inner_race")
    assert (line.width, line.length, line.edge_radius) == pytest.approx((0.2e-3, 2e-3, 0.05e-3))
    scene = br.bearing("7205B", speed_rpm=6000.0, defects={"line": line})
    # Narrower than its contact: circles do not meet all of it, and the run says so.
    with pytest.warns(br.SceneWarning, match="1.3 times the width of the contacts that meet it"):
        met = br.simulate(scene, duration=0.01, settle=0.0).defects["line"]
    assert (met.placed, met.share) == ("contact", 1.0)
    assert met.contact_width is not None
    assert 1.3 * met.contact_width > 0.2e-3


def test_depth_is_a_floor_and_a_ball_has_a_number() -> None:
    shallow = br.defects.spall(on="ball", width_mm=1.0, length_mm=1.0, depth_mm=0.05, ball=4)
    assert shallow.floor is not None
    assert shallow.floor.depth == pytest.approx(0.05e-3)
    assert shallow.ball == 4
    assert br.defects.spall(on="ball", width_mm=1.0).ball == 0
    br.bearing("6205", defects=shallow, speed_rpm=1800.0)


@pytest.mark.parametrize(
    "sizes", [{"width_mm": 0.0}, {"width_mm": 1.0, "depth_mm": -1.0}, {"width_mm": math.inf}]
)
def test_sizes_are_checked_by_their_names(sizes: dict[str, float]) -> None:
    with pytest.raises(br.SceneError, match="_mm"):
        br.defects.spall(on="outer_race", **sizes)  # type: ignore[arg-type]
