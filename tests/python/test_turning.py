"""An outer ring that turns, through the package: frequencies, labels, sidebands, pictures, bad input."""

from __future__ import annotations

import math

import numpy as np
import pytest

import ballrace as br
from ballrace.diagnosis.combs import comb_of
from ballrace.diagnosis.kinematics import kinematics_of
from ballrace.report.words import operation
from ballrace.scene import Ramp, SpeedDrive, TorqueDrive
from ballrace.scene.turning import relative_speed
from ballrace.spectra import fault_bands

TURN = math.pi / 30.0


def hub(**changes: object) -> br.Scene:
    damaged = br.defects.spall(on="outer_race", width_mm=1.0)
    scene = br.bearing("6205", radial_load=800.0, speed_rpm=0.0, outer_rpm=1800.0, defects=damaged)
    return scene.replace(changes) if changes else scene


ROLLING = [(0.0, 1800.0), (600.0, -900.0), (1800.0, 600.0), (0.0, -1800.0), (-1800.0, None)]
"""Speeds of inner and outer ring: a hub, opposite ways, the same way, and backwards."""


@pytest.mark.parametrize(("inner", "outer"), ROLLING)
def test_the_rates_are_those_of_two_rings_that_turn(inner: float, outer: float | None) -> None:
    """Analytic, f_c = ½ [f_i (1 − γ) + f_o (1 + γ)] and what follows (Harris & Kotzalas), without signs."""
    gamma = 7.94 / 39.04
    f_i, f_o = inner / 60.0, (outer or 0.0) / 60.0
    cage = 0.5 * (f_i * (1.0 - gamma) + f_o * (1.0 + gamma))
    relative = abs(f_i - f_o)
    wanted = {
        "shaft": relative,
        "inner": abs(f_i),
        "outer": abs(f_o),
        "ftf": abs(cage),
        "bpfo": 4.5 * (1.0 - gamma) * relative,
        "bpfi": 4.5 * (1.0 + gamma) * relative,
        "bsf": (1.0 - gamma**2) / (2.0 * gamma) * relative,
    }
    found = br.fault_frequencies("6205", inner, outer_rpm=outer)
    assert {name: getattr(found, name) for name in wanted} == pytest.approx(wanted)
    orders = vars(found.orders)
    assert orders == pytest.approx({name: wanted[name] / relative for name in orders})
    # Of a scene without load or friction the balls roll as well.
    scene = br.bearing("6205", speed_rpm=inner, outer_rpm=outer)
    nominal = br.fault_frequencies(scene, operating=False)
    assert {name: getattr(nominal, name) for name in wanted} == pytest.approx(wanted, rel=1e-3)
    loaded = br.fault_frequencies(scene)
    assert {name: getattr(loaded, name) for name in wanted} == pytest.approx(wanted, rel=2e-2)


def test_a_planet_is_a_hub_to_one_who_turns_with_the_carrier() -> None:
    """Analytic: the pin turns with the carrier, the load with the pin; places of the races are met as in space."""
    planet, carrier = -1100.0, 400.0
    in_space = br.fault_frequencies("6205", carrier, outer_rpm=planet)
    on_it = br.fault_frequencies("6205", outer_rpm=planet - carrier)
    for name in ("shaft", "bpfo", "bpfi", "bsf"):
        assert getattr(in_space, name) == pytest.approx(getattr(on_it, name))
    assert on_it.orders.turning == (1.0,)
    assert in_space.orders.turning == pytest.approx((4.0 / 15.0, 11.0 / 15.0))


def test_by_default_the_shaft_of_a_hub_stands() -> None:
    found = br.fault_frequencies("6205", outer_rpm=1800.0)
    assert found == br.fault_frequencies("6205", 0.0, outer_rpm=1800.0)
    made = br.shaft([("6204", 0.0), ("6204", 0.05)], outer_rpm=600.0)
    pair = br.pair("7205B", outer_rpm=-600.0)
    one = br.bearing("6204", outer_rpm=600.0)
    assert [scene.drive for scene in (made, pair, one)] == [SpeedDrive(0.0)] * 3
    assert [scene.outer_speed for scene in (made, pair, one)] == [
        600.0 * TURN,
        -600.0 * TURN,
        600.0 * TURN,
    ]
    assert br.shaft([("6204", 0.0), ("6204", 0.05)]).drive == SpeedDrive(1500.0 * TURN)
    both = br.pair("7205B", speed_rpm=300.0, outer_rpm=-600.0)
    assert both.drive == SpeedDrive(300.0 * TURN)
    with pytest.raises(
        br.SceneError, match=r"^outer_speed = 9.0: outer_rpm, the speed of the outer ring"
    ):
        br.shaft([("6204", 0.0), ("6204", 0.05)], outer_speed=9.0)  # type: ignore[call-arg]


def test_sidebands_stand_where_a_race_turns_past_the_load() -> None:
    orders = br.fault_frequencies("6205", 0.0, outer_rpm=1800.0).orders
    labels = {band.label for band in fault_bands(orders, harmonics=1)}
    assert {"BPFO − f_o", "BPFO + f_o", "BPFI"} <= labels
    assert not {"BPFI − f_r", "BPFI + f_r"} & labels
    still = {band.label for band in fault_bands(br.catalogue["6205"].orders, harmonics=1)}
    assert {"BPFI − f_r", "BPFO"} <= still
    assert "BPFO − f_o" not in still


def test_a_hub_runs_and_tells_its_frequencies() -> None:
    """Rolling under load and what the run measured are within what slip and load zone do."""
    scene = hub()
    assert relative_speed(scene) == -1800.0 * TURN
    expected = br.fault_frequencies(scene)
    assert (expected.shaft, expected.inner, expected.outer) == pytest.approx((30.0, 0.0, 30.0))
    out = br.simulate(scene, duration=0.05)
    measured = br.fault_frequencies(out)
    assert measured.outer == pytest.approx(30.0)
    assert measured.ftf == pytest.approx(expected.ftf, rel=5e-3)
    assert measured.bpfo == pytest.approx(expected.bpfo, rel=1e-2)
    assert measured.slip == pytest.approx(0.0, abs=0.02)
    # A place of the outer race meets a ball as often as balls fall behind the ring.
    assert 30.0 - measured.ftf == pytest.approx(measured.bpfo / 9.0)
    assert out["outer.theta"][-1] == pytest.approx(1800.0 * TURN * out.t[-1], rel=1e-3)
    assert out.defects["defect"].passes >= 4
    told = out.features(columns=["outer.ay"])
    assert told["turns"] == pytest.approx(1.5, rel=0.01)
    assert "outer.ay.row0.bpfo_sidebands" in told
    # The inner race stands in the load.
    assert told["outer.ay.row0.bpfi_sidebands"] is None
    channel = out.channel("outer.ay")
    assert channel.shaft == pytest.approx(30.0)
    assert kinematics_of(scene).orders.outer == pytest.approx(1.0)
    speeds = out.to_windows(length=256)["speed"].to_list()
    assert speeds == pytest.approx([-1800.0 * TURN] * len(speeds))
    assert "1800 rev/min, outer ring" in operation(scene)[-1][1]


def test_a_measured_hub_has_a_comb_with_the_rings_turns() -> None:
    """Synthetic: blows at BPFO that swell with the outer ring's turns accuse the outer race."""
    orders = br.fault_frequencies("6205", 0.0, outer_rpm=1800.0).orders
    outer, inner = comb_of("outer_race", orders), comb_of("inner_race", orders)
    assert (outer.sideband, inner.sideband) == (1.0, 0.0)
    assert (1, -1) in outer.lines
    assert (1, -1) not in inner.lines


def test_pictures_turn_the_damage_of_the_outer_race() -> None:
    scene = hub()
    out = br.simulate(scene.replace({"probes": br.plot.probes(scene)}), duration=0.004)
    fig = br.plot.animation(out, frames=3)
    places = [
        next(trace.x for trace in frame.data if trace.name == "defect") for frame in fig.frames
    ]
    assert not np.allclose(places[0], places[-1])
    solid = br.plot.animation3d(out, frames=3)
    names = [trace.name for trace in solid.data]
    assert names.count("defect") == 1


def test_a_run_up_of_a_hub_has_an_order_map() -> None:
    speed = Ramp(from_=60.0, to=240.0, start=0.0, end=0.08)
    out = br.simulate(hub().replace({"outer_speed": speed}), duration=0.08)
    fig = br.plot.order_map(out)
    assert float(np.nanmax(fig.data[0].x)) == pytest.approx(0.08 * 150.0 / 2.0 / math.pi, rel=0.3)


def test_bad_speeds_are_refused_by_name() -> None:
    bad: list[tuple[dict[str, object], str]] = [
        ({"outer_speed": 1e9}, "outer_speed = "),
        (
            {"outer_speed": Ramp(from_=0.0, to=9.0, start=1.0, end=1.0)},
            "outer_speed = a jump in time",
        ),
        (
            {"outer_ring.support.theta": "free"},
            "outer_ring.support.theta = a mount: absent, since outer_speed",
        ),
    ]
    for changes, told in bad:
        with pytest.raises(br.SceneError, match="^" + told.replace("(", "\\(")):
            hub(**changes)
    with pytest.raises(br.SceneError, match=r"^outer_rpm = nan"):
        br.bearing("6205", outer_rpm=math.nan)
    with pytest.raises(br.SceneError, match=r"not that of the outer ring, 600"):
        br.fault_frequencies("6205", 600.0, outer_rpm=600.0)
    together = hub().replace({"drive": SpeedDrive(1800.0 * TURN)})
    with pytest.raises(br.SceneError, match=r"^speed_rpm = "):
        br.fault_frequencies(together)
    oiled = br.bearing("6205", outer_rpm=1800.0, lubricant="vg68", temperature_c=50.0)
    assert oiled.lubricant is not None
    with pytest.raises(br.SceneError, match=r"^lubricant.reference_speed"):
        br.bearing("6205", outer_rpm=1800.0, speed_rpm=1800.0, lubricant="vg68", temperature_c=50.0)


def test_a_torque_may_turn_the_inner_ring_while_the_outer_is_driven() -> None:
    drive = TorqueDrive(value=0.0, initial_speed=-50.0)
    scene = hub().replace({"drive": drive, "inner_ring.support.theta": "free"})
    out = br.simulate(scene, duration=0.002)
    # The balls drag the inner ring after the outer.
    assert out["inner.omega"][-1] > -50.0
    assert relative_speed(scene) is None


def test_the_ring_that_turns_meets_every_load() -> None:
    """Analytic: ISO/TS 16281, means of order 3 of a ring that turns under the load, of 10/3 of one that stands."""
    for inner, outer, orders in ((0.0, 1800.0, (3.0, 10.0 / 3.0)), (900.0, -900.0, (3.0, 3.0))):
        found = br.load_distribution(
            br.bearing("6205", radial_load=800.0, speed_rpm=inner, outer_rpm=outer)
        )
        for race, order in zip(("outer", "inner"), orders, strict=True):
            loads = getattr(found, f"{race}_load")
            mean = np.mean(loads**order) ** (1.0 / order)
            assert getattr(found, f"{race}_equivalent") == pytest.approx([mean], rel=1e-9)
