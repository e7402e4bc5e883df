"""Runs in pieces are runs in one piece; snapshots go on; what is changed between pieces acts from there."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import polars as pl
import pytest

import ballrace as br
from ballrace.duty import duty_cycle
from ballrace.scene.time import values_at

if TYPE_CHECKING:
    from collections.abc import Callable

DURATION = 0.004
GIVEN = "inner_ring.support.y.given"


def scene(force: Any = 500.0) -> br.Scene:
    return br.presets.deep_groove_6205(radial_load=force, speed_rpm=1800.0)


def ringed() -> br.Scene:
    """A scene whose cage is a ring."""
    return br.bearing("6205", radial_load=500.0, speed_rpm=1800.0)


SCENES = pytest.mark.parametrize("of", [scene, ringed], ids=["links", "ring"])


def same(one: br.Signals, two: br.Signals) -> None:
    assert one.names == two.names
    np.testing.assert_array_equal(one.t, two.t)
    for name in one.names:
        np.testing.assert_array_equal(one[name], two[name], err_msg=name)
    assert one.end_state is not None
    np.testing.assert_array_equal(one.end_state, two.end_state)


@SCENES
@pytest.mark.parametrize("pieces", [[DURATION], [1e-7, 3e-6, 1e-3, 1.00001e-3, DURATION]])
def test_pieces_give_the_bits_of_one_run(pieces: list[float], of: Callable[[], br.Scene]) -> None:
    """Truth: the run in one piece."""
    whole = br.simulate(of(), duration=DURATION)
    simulation = br.Simulation(of(), duration=DURATION)
    for end in pieces:
        simulation.advance_to(end)
        assert simulation.time == end
    same(simulation.finish(), whole)
    assert simulation.time == DURATION


def test_what_is_not_kept_is_in_the_pieces() -> None:
    """Truth: the run in one piece."""
    whole = br.simulate(scene(), duration=DURATION)
    simulation = br.Simulation(scene(), duration=DURATION, keep=False)
    pieces = [simulation.advance(0.25 * DURATION) for _ in range(4)]
    rest = simulation.finish()
    assert 0 < rest.n_samples < 20
    for name in whole.names:
        joined = np.concatenate([*(piece[name] for piece in pieces), rest[name]])
        np.testing.assert_array_equal(joined, whole[name])


def test_a_run_without_an_end_is_ended_where_it_stands() -> None:
    """Truth: a run of that duration, but for what the filter takes from beyond the end."""
    whole = br.simulate(scene(), duration=DURATION)
    simulation = br.Simulation(scene())
    simulation.advance_to(DURATION)
    out = simulation.finish()
    assert (out.n_samples, out.provenance.duration) == (whole.n_samples, DURATION)
    np.testing.assert_array_equal(out["outer.ay"][:-28], whole["outer.ay"][:-28])
    np.testing.assert_allclose(
        out["outer.vy"], whole["outer.vy"], atol=1e-3 * whole["outer.vy"].std()
    )


@SCENES
def test_a_snapshot_goes_on_from_a_file(of: Callable[[], br.Scene], tmp_path: Path) -> None:
    """Truth: the run in one piece."""
    whole = br.simulate(of(), duration=DURATION)
    simulation = br.Simulation(of(), duration=DURATION)
    simulation.advance_to(0.3 * DURATION)
    path = tmp_path / "half.parquet"
    taken = simulation.snapshot()
    taken.write(path)
    assert taken.time == simulation.time
    # What was taken does not change with what goes on.
    simulation.change({"loads.radial.force": 2000.0})
    simulation.advance_to(DURATION)
    for from_where in (taken, path):
        again = br.Simulation.restore(from_where)
        assert again.time == 0.3 * DURATION
        again.advance_to(DURATION)
        same(again.finish(), whole)


def test_a_damaged_or_foreign_snapshot_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "half.parquet"
    simulation = br.Simulation(scene())
    simulation.advance(1e-3)
    simulation.snapshot().write(path)
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 1
    (tmp_path / "damaged.parquet").write_bytes(data)
    with pytest.raises(br.FileError, match="damaged"):
        br.Simulation.restore(tmp_path / "damaged.parquet")
    out = br.simulate(scene(), duration=1e-3)
    out.write_parquet(tmp_path / "record.parquet")
    with pytest.raises(br.FileError, match="no snapshot"):
        br.Simulation.restore(tmp_path / "record.parquet")
    entries = pl.read_parquet_metadata(path)
    older = entries["ballrace_snapshot"].replace('"version":"', '"version":"0.1.')
    pl.DataFrame({"t": [0.0]}).write_parquet(path, metadata={**entries, "ballrace_snapshot": older})
    with pytest.raises(br.SceneError, match=r"snapshot\.version"):
        br.Simulation.restore(path)


@pytest.mark.parametrize("call", ["change", "set_loads"])
def test_a_load_that_is_changed_is_a_load_with_a_course(call: str) -> None:
    """Truth: a table with the same steps, within what the tolerance leaves."""
    step = br.scene.Table(times=(0.0, 2e-3, 2e-3, 1.0), values=(500.0, 500.0, 800.0, 800.0))
    course = scene().replace({"loads.radial.force": step})
    whole = br.simulate(course, duration=DURATION, settle=0.0, rtol=1e-9)
    simulation = br.Simulation(scene(), duration=DURATION, settle=0.0, rtol=1e-9)
    simulation.advance_to(2e-3)
    getattr(simulation, call)({"loads.radial.force": 800.0})
    simulation.advance_to(DURATION)
    out = simulation.finish()
    unchanged = br.simulate(scene(), duration=DURATION, settle=0.0, rtol=1e-9)
    error = np.abs(out["outer.vy"] - whole["outer.vy"]).max()
    effect = np.abs(unchanged["outer.vy"] - whole["outer.vy"]).max()
    assert error < 1e-3 * effect
    assert out.scene.loads["radial"].force == 800.0


def test_a_ring_that_is_led_takes_its_course() -> None:
    """Truth: the sine itself, and the run of a scene that has it."""
    sine = br.scene.Sine(mean=-2e-5, amplitude=4e-6, frequency=200.0, phase=0.0)
    changes = {"inner_ring.support.x": br.scene.Given(0.0), "solver.rtol": 1e-7}
    held = scene().replace(changes)
    whole = br.Simulation(held.replace({"inner_ring.support.y": br.scene.Given(sine)}))
    led = br.Simulation(held.replace({"inner_ring.support.y": br.scene.Given(-2e-5)}))
    turn = 2.0 * np.pi * 200.0
    for t in np.arange(1, 101) * 2e-5:
        place, speed = -2e-5 + 4e-6 * np.sin(turn * t), 4e-6 * turn * np.cos(turn * t)
        led.set_motions({"inner_ring.support.y.given": (place, speed)}, until=t)
        led.advance_to(t)
    whole.advance_to(t)
    assert abs(led.state[led.names.index("inner.y")] - place) < 1e-14
    forces = [simulation.wrench("inner")[1] for simulation in (led, whole)]
    # It began at rest, the other did not.
    assert forces[1] > 100.0
    assert abs(forces[0] - forces[1]) < 0.02 * forces[1]


def test_a_spline_through_points_is_smooth() -> None:
    """Analytic: a cubic, and straight on beyond; the loads of a life are those of its period."""
    times = np.linspace(0.0, 1.0, 5)
    spline = br.scene.Spline.through(times, 500.0 + 300.0 * times**3)
    found = values_at(spline, [0.3, 1.5, -0.5])
    np.testing.assert_allclose(
        found, [500.0 + 300.0 * 0.3**3, 800.0 + 900.0 * 0.5, 500.0], rtol=1e-12
    )
    cycle = duty_cycle(scene().replace({"loads.radial.force": spline}))
    mean = sum(share * values_at(part.loads["radial"].force, 0.0) for share, part in cycle)
    assert mean == pytest.approx(500.0 + 300.0 / 4.0, rel=1e-9)


def test_values_in_time_are_those_of_the_run() -> None:
    """Analytic: a ramp, a jump, a sine, points with a jump, a number; at a jump the value after it."""
    times = [0.0, 0.5, 1.0, 2.0]
    expected: list[tuple[br.scene.TimeFunction, list[float]]] = [
        (br.scene.Ramp(from_=0.0, to=4.0, start=0.0, end=1.0), [0.0, 2.0, 4.0, 4.0]),
        (br.scene.Ramp(from_=0.0, to=4.0, start=1.0, end=1.0), [0.0, 0.0, 4.0, 4.0]),
        (br.scene.Sine(mean=1.0, amplitude=2.0, frequency=0.5, phase=0.0), [1.0, 3.0, 1.0, 1.0]),
        (
            br.scene.Table(times=(0.0, 1.0, 1.0, 3.0), values=(0.0, 1.0, 5.0, 9.0)),
            [0.0, 0.5, 5.0, 7.0],
        ),
        (3.0, [3.0] * 4),
    ]
    for function, values in expected:
        np.testing.assert_allclose(values_at(function, times), values, atol=1e-12)
    assert values_at(3.0, np.zeros((2, 3))).shape == (2, 3)
    assert values_at(3.0, 1.0).shape == ()


def test_changes_act_on_what_is_read() -> None:
    """Truth: at rest the balls put the load on the outer ring, whose support bears it."""
    simulation = br.Simulation(scene())
    simulation.change({"loads.radial.force": 1500.0, "drive.speed": 200.0})
    assert simulation.state[simulation.names.index("inner.omega")] == 200.0
    simulation.advance(0.05)
    wrench = simulation.wrench("inner") + simulation.wrench("outer")
    loads = simulation.contacts["load"]
    assert loads.shape == (9, 2)
    assert 1300.0 < abs(simulation.wrench("outer")[1]) < 1700.0
    assert np.abs(wrench[:2]).max() < 100.0
    assert simulation.scene.loads["radial"].force == 1500.0


def test_a_run_begins_where_another_has_ended(tmp_path: Path) -> None:
    """Truth: the end state itself, which stands in files too."""
    first = br.simulate(scene(), duration=DURATION)
    path = tmp_path / "first.parquet"
    first.write_parquet(path)
    assert first.end_state is not None
    from_array = br.simulate(scene(), duration=1e-3, start=first.end_state)
    for start in (first, br.Signals.read_parquet(path), br.Signals.scan_parquet(path)):
        same(br.simulate(scene(), duration=1e-3, start=start), from_array)
    assert abs(from_array["outer.vy"][0] - first["outer.vy"][-1]) < first["outer.vy"].std()


def test_bad_input_is_refused_by_name() -> None:
    simulation = br.Simulation(scene(), duration=DURATION)
    with pytest.raises(br.SceneError, match=r"^t = 0"):
        simulation.finish()
    simulation.advance(1e-3)
    calls: list[tuple[Callable[[], object], str]] = [
        (lambda: simulation.advance_to(0.5e-3), r"^t = "),
        (lambda: simulation.advance_to(2 * DURATION), r"^t = "),
        (lambda: simulation.advance(-1e-3), r"^dt = "),
        (lambda: simulation.advance(float("nan")), r"^dt = "),
        (lambda: simulation.wrench("cage"), r"^ring = "),  # type: ignore[arg-type]
        (lambda: simulation.change({"rows[0].ball_count": 8}), "^changes = "),
        (lambda: simulation.change({"loads.radial.newton": 8.0}), "newton"),
        (lambda: simulation.change({"probes.more": br.scene.TorqueProbe()}), "^changes = "),
        (lambda: simulation.change(3), "^changes = "),  # type: ignore[arg-type]
        (lambda: simulation.set_loads(3), "^loads = "),  # type: ignore[arg-type]
        (lambda: simulation.set_loads({"loads.other.force": 1.0}), r"^loads\.other\.force = "),
        (lambda: simulation.set_motions(3, until=1.0), "^motions = "),  # type: ignore[arg-type]
        (lambda: simulation.set_motions({GIVEN: (0.0, 0.0)}, until=2e-3), f"^{GIVEN} = not there"),
        (lambda: simulation.set_motions({GIVEN: (0.0, np.nan)}, until=2e-3), f"^{GIVEN} = "),
        (lambda: simulation.set_motions({GIVEN: (0.0,)}, until=2e-3), f"^{GIVEN} = "),
        (lambda: simulation.set_motions({}, until=1e-3), "^until = 0.001"),
        (lambda: simulation.set_loads({"loads.radial.force": "big"}), r"^loads\.radial\.force = "),  # type: ignore[dict-item]
    ]
    for call, match in calls:
        with pytest.raises(br.SceneError, match=match):
            call()
    # It is as it was.
    simulation.advance_to(DURATION)
    same(simulation.finish(), br.simulate(scene(), duration=DURATION))
    with pytest.raises(br.SceneError, match=r"^simulation = finished"):
        simulation.advance(1e-3)


def test_what_is_stopped_goes_on_and_what_has_ended_does_not() -> None:
    """Truth: the run in one piece."""

    class StopError(Exception):
        pass

    def stop(_: float) -> None:
        raise StopError

    simulation = br.Simulation(scene(), duration=0.1)
    with pytest.raises(StopError):
        simulation.advance_to(0.1, progress=stop)
    reached = simulation.time
    assert 0.0 < reached < 0.1
    simulation.advance_to(0.1)
    same(simulation.finish(), br.simulate(scene(), duration=0.1))

    spent = br.Simulation(scene(), duration=0.1, max_steps=100, settle=0.0)
    for _ in range(2):
        with pytest.raises(br.BudgetError, match="max_steps"):
            spent.advance_to(0.1)
