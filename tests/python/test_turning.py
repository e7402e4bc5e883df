"""An outer ring that turns, through the package: frequencies, labels, sidebands, pictures, bad input."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import ballrace as br
from ballrace.diagnosis.combs import comb_of
from ballrace.diagnosis.kinematics import kinematics_of
from ballrace.diagnosis.null import null_orders
from ballrace.explore.controls import controls
from ballrace.explore.live import solved
from ballrace.explore.settings import Settings
from ballrace.report.words import operation
from ballrace.scene import Ramp, SpeedDrive, Surface, TorqueDrive
from ballrace.scene.turning import relative_speed
from ballrace.spectra import fault_bands

TURN = math.pi / 30.0
Array = NDArray[np.float64]


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
    assert br.shaft([("6204", 0.0), ("6204", 0.05)], speed_rpm=1500.0).drive == SpeedDrive(
        1500.0 * TURN
    )
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


def test_a_hub_runs_and_has_its_frequencies() -> None:
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
    assert out.defects["spall"].passes >= 4
    features = out.features(columns=["outer.ay"])
    assert features["turns"] == pytest.approx(1.5, rel=0.01)
    assert "outer.ay.row0.bpfo_sidebands" in features
    # The inner race stands in the load.
    assert features["outer.ay.row0.bpfi_sidebands"] is None
    channel = out.channel("outer.ay")
    assert channel.shaft == pytest.approx(30.0)
    assert kinematics_of(scene).orders.outer == pytest.approx(1.0)
    speeds = out.to_windows(length=256)["speed"].to_list()
    assert speeds == pytest.approx([-1800.0 * TURN] * len(speeds))
    assert "1800 1/min, outer ring" in operation(scene)[-1][1]


def test_a_measured_hub_has_a_comb_with_the_rings_turns() -> None:
    """Synthetic: blows at BPFO that swell with the outer ring's turns accuse the outer race."""
    orders = br.fault_frequencies("6205", 0.0, outer_rpm=1800.0).orders
    outer, inner = comb_of("outer_race", orders), comb_of("inner_race", orders)
    assert (outer.sideband, inner.sideband) == (1.0, 0.0)
    assert (1, -1) in outer.lines
    assert (1, -1) not in inner.lines


CHAIN = br.measuring.Chain(
    machine=br.measuring.Machine(),
    logger=br.measuring.Logger(fs=12_800.0, bits=16),
)
"""A sensor on the pedestal, in the noise of a measured motor."""


@pytest.mark.filterwarnings("ignore:row 0. its balls:ballrace.SceneWarning")
@pytest.mark.parametrize("part", [None, "outer_race", "inner_race"])
def test_hubs_are_judged_by_the_ring_that_turns(part: Surface | None) -> None:
    """Limits: 24 turns of a run of this package, as it is and measured; what is damaged is named, nothing else is.

    Balls pass the load on the inner ring, which stands: a healthy hub has lines of that race.
    """
    damaged = {} if part is None else {"d": br.defects.spall(on=part, width_mm=1.0)}
    out = br.simulate(hub(defects=damaged), duration=24.0 / 30.0, fs=25_600.0)
    for record in (out, br.measure(out, CHAIN, seed=1)):
        found = br.diagnose(record)
        assert found.parts == (() if part is None else (part,))
        assert (found.verdict == "damaged") is (part is not None)
        roles = {one: found.evidence[one].role for one in ("outer_race", "inner_race")}
        assert roles == {"outer_race": "inner_race", "inner_race": "outer_race"}
        lines = {line.label for each in found.evidence.values() for line in each.lines}
        assert not {"BPFI − f_r", "BPFI + f_r"} & lines
    if part is None:
        assert br.diagnose(out).evidence["inner_race"].z > 5.0


def blows(order: float, beside: float, relative: float, turns: tuple[float, ...]) -> Array:
    """Return blows in noise at an order of turns against each other, which swell at a rate, and lines of rings."""
    fs, rng = 16_000.0, np.random.default_rng(3)
    t = np.arange(int(80.0 / relative * fs)) / fs
    x: Array = 0.3 * rng.normal(size=t.size)
    x = x + 0.3 * sum(np.cos(2.0 * math.pi * k * f * t) for f in turns for k in (1, 2, 3))
    hits = np.arange(int(0.98 * order * relative * t[-1]))
    at = (hits + 0.005 * rng.normal(size=hits.size)) / (order * relative)
    at = at[at >= 0.0]
    x[np.rint(fs * at).astype(int)] += 3.0 + 3.0 * np.cos(2.0 * math.pi * beside * at)
    return x


@pytest.mark.parametrize(("inner", "outer"), [(0.0, 1800.0), (600.0, -1200.0), (2700.0, 900.0)])
def test_a_measured_hub_is_judged_by_both_speeds(inner: float, outer: float) -> None:
    """Synthetic: the race that turns through the load at the rate of the sidebands is named."""
    rates = br.fault_frequencies("6205", inner, outer_rpm=outer)
    turns = tuple(f for f in (rates.inner, rates.outer) if f)
    x = blows(rates.orders.bpfo, rates.outer, rates.shaft, turns)
    options = {"fs": 16_000.0, "speed_within": 1e-3}
    found = br.diagnose(x, "6205", inner, outer_rpm=outer, **options)  # type: ignore[arg-type]
    assert found.parts == ("outer_race",)
    assert found.shaft.rate == pytest.approx(30.0, rel=1e-3)
    lines = {line.label for line in found.evidence["outer_race"].lines}
    assert "BPFO" in lines
    assert {"BPFO − f_o", "BPFO + f_o"} & lines
    # The same by rates that know the speeds, and by a scene whose speeds are others.
    by_rates = br.diagnose(x, rates, **options)  # type: ignore[arg-type]
    assert by_rates.evidence["outer_race"].z == pytest.approx(
        found.evidence["outer_race"].z, rel=0.02
    )
    other = br.bearing("6205", outer_rpm=100.0)
    assert br.diagnose(x, other, inner, outer_rpm=outer, fs=16_000.0).parts == ("outer_race",)
    trended = br.trend([x] * 5, "6205", inner, outer_rpm=outer, fs=16_000.0, baseline=3)
    assert trended.table["parts"].to_list() == ["outer_race"] * 5


def test_nothing_is_judged_on_the_lines_of_a_ring() -> None:
    """Reliability: orders of the null keep off the multiples of both rings' turns, and so must the races' own."""
    orders = br.fault_frequencies("6205", 600.0, outer_rpm=-1200.0).orders
    drawn = null_orders(orders, "outer_race", np.random.default_rng(0))
    assert drawn.size == 600
    for turns in orders.turning:
        assert np.abs(drawn / turns - np.rint(drawn / turns)).min() >= 0.03
    noise = np.random.default_rng(0).normal(size=24_000)
    found = br.diagnose(noise, "6205", 900.0, outer_rpm=-900.0, fs=16_000.0)
    # BPFO 3.585 beside 7 half turns, BPFI 5.415 beside 11.
    assert "is too near the shaft's" in found.why


def test_a_cage_that_stands_has_no_lines() -> None:
    """Analytic: f_c = 0 where f_i (1 − γ) = −f_o (1 + γ); the races' lines are then those of the rings."""
    gamma = 7.94 / 39.04
    still = -1000.0 * (1.0 - gamma) / (1.0 + gamma)
    for outer, verdict in ((still, "undecided"), (1.1 * still, "damaged")):
        rates = br.fault_frequencies("6205", 1000.0, outer_rpm=outer)
        assert rates.ftf < 0.05 * rates.shaft
        x = blows(rates.orders.bpfi, rates.inner, rates.shaft, (rates.inner, rates.outer))
        found = br.diagnose(x, rates, fs=16_000.0)
        assert (found.verdict, "cage" in found.evidence) == (verdict, False)
        if outer == still:
            assert rates.bpfi == pytest.approx(9.0 * rates.inner)
            assert "lie on the shaft's" in found.why


def test_speeds_of_a_record_that_do_not_fit_are_refused_by_name() -> None:
    x = np.random.default_rng(0).normal(size=16_000)
    rates = br.fault_frequencies("6205", outer_rpm=1800.0)
    bad: list[tuple[tuple[object, ...], dict[str, float], str]] = [
        (("6205", 0.0), {}, r"^speed_rpm = 0.0: not 0, or 0 beside the outer_rpm"),
        (
            ("6205", 600.0),
            {"outer_rpm": 600.0},
            r"^speed_rpm = 600.0: .* not that of the outer ring",
        ),
        (("6205",), {"outer_rpm": math.inf}, r"^outer_rpm = inf"),
        ((rates,), {"outer_rpm": 1800.0}, r"^outer_rpm = 1800: absent"),
        (
            (hub(outer_speed=Ramp(from_=0.0, to=9.0, start=0.0, end=1.0)), 0.0),
            {},
            r"^outer_rpm = None",
        ),
    ]
    for arguments, named, message in bad:
        with pytest.raises(br.SceneError, match=message):
            br.diagnose(x, *arguments, fs=16_000.0, **named)  # type: ignore[arg-type]


def test_a_chain_goes_by_the_ring_that_turns() -> None:
    """Analytic: harmonics and pulses of the shaft, or of a hub; records know the turns against each other."""
    tone = br.measuring.Chain(
        machine=br.measuring.Machine(shaft=(1.0,), noise_density=0.0), tacho=br.measuring.Tacho()
    )
    for inner, outer, turns in [(0.0, -1800.0, 30.0), (600.0, -1200.0, 10.0)]:
        scene = br.bearing("6205", speed_rpm=inner, outer_rpm=outer)
        out = br.simulate(scene, duration=0.2)
        still, found = (br.measure(out, chain) for chain in (br.measuring.Chain(), tone))
        f, value = br.spectra.spectrum(found.x - still.x, found.fs)
        assert f[np.argmax(value)] == pytest.approx(turns)
        assert found.pulses.size == pytest.approx(0.2 * turns, abs=1.0)
        assert found.shaft == pytest.approx(30.0)


def test_the_page_of_explore_has_both_speeds() -> None:
    begun = Settings.of(br.bearing("6205", radial_load=800.0, outer_rpm=1800.0))
    assert (begun.speed_rpm, begun.outer_rpm) == pytest.approx((0.0, 1800.0))
    assert {"speed_rpm", "outer_rpm"} <= {each.field for each in controls(begun)}
    assert Settings.of(br.bearing("6205", speed_rpm=1800.0)).outer_rpm is None
    moved = begun.moved(outer_rpm=900.0).scene()
    assert moved.drive == SpeedDrive(0.0)
    assert moved.outer_speed == pytest.approx(900.0 * TURN)
    live = solved(moved)
    assert live.steady
    assert live.rates[0].outer == pytest.approx(15.0)
    rising = hub(outer_speed=Ramp(from_=0.0, to=190.0, start=0.0, end=0.1), defects={})
    assert not solved(rising).steady
    assert solved(rising).rates[0].shaft == 1.0


def test_a_report_has_the_turns_of_both_rings(tmp_path: Path) -> None:
    out = br.simulate(hub(), duration=0.05)
    out.report(tmp_path / "hub.html")
    page = (tmp_path / "hub.html").read_text()
    assert "inner ring, Hz" in page
    assert "outer ring, Hz" in page
    assert br.plot.order_map(out).layout.xaxis.title.text == "turns of the rings against each other"


def test_pictures_turn_the_damage_of_the_outer_race() -> None:
    scene = hub()
    out = br.simulate(scene.replace({"probes": br.plot.probes(scene)}), duration=0.004)
    fig = br.plot.animation(out, frames=3)
    places = [
        next(trace.x for trace in frame.data if trace.name == "spall") for frame in fig.frames
    ]
    assert not np.allclose(places[0], places[-1])
    solid = br.plot.animation3d(out, frames=3)
    names = [trace.name for trace in solid.data]
    assert names.count("spall") == 1


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
            "outer_speed = a jump: a speed without jumps",
        ),
        (
            {"outer_ring.support.theta": "free"},
            "outer_ring.support.theta = a mount: absent, since outer_speed",
        ),
    ]
    for changes, message in bad:
        with pytest.raises(br.SceneError, match="^" + message.replace("(", "\\(")):
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
