"""Dynamics of rings that tilt: whirl and precession of a rotor, and a wheel bearing loaded at its tyre."""

from __future__ import annotations

import math
import warnings

import numpy as np
import pytest
from numpy.typing import NDArray

import ballrace as br
from ballrace import scene as s
from ballrace.paper.simulations import dynamic

POLAR, TRANSVERSE = 3.2e-4, 2e-4


def struck(speed: float, stiffness: float) -> br.Signals:
    """The motion of a rotor, on a tilt spring or free, after a moment of 0.2 ms; its ball stays off it."""
    row = s.Row(
        ball_count=1,
        ball_diameter=8e-3,
        pitch_diameter=40e-3,
        outer_conformity=0.53,
        inner_conformity=0.52,
        clearance=1e-4,
    )
    mount = s.Spring(stiffness=stiffness)
    support = s.Support(x="fixed", y="fixed", z="fixed", tilt_x=mount, tilt_y=mount)
    kick = s.Ramp(from_=1.0, to=0.0, start=2e-4, end=2e-4)
    scene = br.Scene(
        rows=(row,),
        inner_ring=s.Ring(mass=0.5, inertia=POLAR, transverse_inertia=TRANSVERSE, support=support),
        friction=s.Coulomb(coefficient=0.05, slip_speed=0.1),
        drive=s.SpeedDrive(speed),
        gravity=(0.0, 0.0, 0.0),
        moments={"kick": s.Moment(ring="inner", direction=(1.0, 0.0, 0.0), moment=kick)},
        probes={"rotor": s.MotionProbe(body="inner", components=("tilt_x", "tilt_y"))},
        solver=s.Solver(method="dormand-prince"),
    )
    return br.simulate(
        scene, duration=8e-3, fs=50_000, start="rolling", settle=0.0, bandwidth=None, rtol=1e-10
    )


def two_rates(z: NDArray[np.complex128], dt: float) -> tuple[float, float]:
    """Rates of the two circular motions that a complex signal is made of, by Prony's method, the lower first."""
    c, d = np.linalg.lstsq(np.stack([z[1:-1], z[:-2]], axis=1), z[2:], rcond=None)[0]
    low, high = np.sort(np.angle(np.roots([1.0, -c, -d])) / dt).tolist()
    return low, high


@pytest.mark.parametrize(("stiffness", "tolerance"), [(2e4, 1e-6), (0.0, 1e-5)])
def test_a_rotor_whirls_forward_and_backward(stiffness: float, tolerance: float) -> None:
    """Truth: ± g + √(g² + k/I_t), g = I_p Ω/(2 I_t), which without a spring is precession at I_p Ω/I_t."""
    out = struck(800.0, stiffness)
    free = out.t > 2.5e-4
    tilt = (out["rotor.tilt_x"] + 1j * out["rotor.tilt_y"])[free]
    assert 5e-5 < np.abs(tilt).max() < 3e-3
    backward, forward = two_rates(tilt, 1.0 / out.fs)
    g = POLAR * 800.0 / (2.0 * TRANSVERSE)
    root = math.sqrt(g**2 + stiffness / TRANSVERSE)
    print(f"forward {forward} {g + root}, backward {backward} {g - root}")
    assert forward == pytest.approx(g + root, rel=tolerance)
    assert backward == pytest.approx(g - root, rel=tolerance, abs=1e-2)


def over_the_spall(scene: br.Scene) -> float:
    """Load of the ball that stands over the spall of the wheel bearing's first row [N]."""
    still = br.equilibrium(scene)
    near = (still.row == 0) & (np.abs(still.angle + 0.5 * math.pi) < 0.3)
    return float(still.outer_load[near].max())


def test_a_load_at_the_tyre_moves_the_load_to_the_other_row() -> None:
    """Truth: moments. A side force presses on its own row; 0.3 m off the axis it lifts that row at the spall."""
    at_centre = [over_the_spall(br.presets.wheel_bearing(force)) for force in (-2100.0, 2100.0)]
    assert 0.0 < at_centre[0] < at_centre[1]
    at_tyre = [over_the_spall(br.presets.cornering_wheel(lateral)) for lateral in (-0.3, 0.3)]
    assert at_tyre[0] > 3.0 * at_centre[1]
    assert at_tyre[1] < 10.0


@pytest.mark.long
def test_what_the_tyre_does_to_the_line_of_the_envelope() -> None:
    """Truth: the load of the ball that passes the spall. Side forces of either sign exchange the lines."""
    probes = {
        "outer": s.MotionProbe(body="outer", components=("ay",)),
        "ball": s.MotionProbe(body="row0.ball0", components=("x", "y")),
    }

    def line(scene: br.Scene) -> float:
        changed = scene.replace({"probes": probes, "solver.method": "dormand-prince"})
        with warnings.catch_warnings():
            # Under the tyre's load no ball touches the spall, which is what is shown.
            warnings.filterwarnings("ignore", "defect .* was never touched", br.SceneWarning)
            # The side force leaves part of the balls unloaded, which fall 0.6 % behind.
            warnings.filterwarnings("ignore", "row .: its balls orbited", br.SceneWarning)
            return dynamic(br.simulate(changed, duration=0.1, settle=0.0)).line

    centre = [line(br.presets.wheel_bearing(7000.0 * lateral)) for lateral in (-0.3, 0.3)]
    tyre = [line(br.presets.cornering_wheel(lateral)) for lateral in (-0.3, 0.3)]
    print(f"at the centre {centre}, at the tyre {tyre}")
    assert centre[0] < 0.5 * centre[1]
    assert tyre[1] < 0.02 * tyre[0]
