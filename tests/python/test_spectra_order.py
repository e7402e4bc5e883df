"""Run-ups whose lines stand at known orders."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

import ballrace as br
from ballrace import spectra

if TYPE_CHECKING:
    from collections.abc import Callable


FS = 8000.0
T = np.arange(32_000) / FS
# From 10 to 30 turns a second in 4 s.
TURNS = 10.0 * T + 2.5 * T**2
ANGLE = 0.7 + 2.0 * np.pi * TURNS
ORDER = 3.585


def test_a_run_up_has_one_line_at_its_order() -> None:
    x = 2.0 * np.cos(2.0 * np.pi * ORDER * TURNS)
    order, value = spectra.order_spectrum(x, ANGLE)
    highest = int(np.argmax(value))
    assert order[highest] == pytest.approx(ORDER, abs=order[1])
    # Between bins a Hann window loses up to 15 %.
    assert 1.7 < value[highest] < 2.01
    # A Hann window's line is four bins wide; besides there is nothing.
    besides = np.abs(order - ORDER) > 6.0 * order[1]
    assert value[besides].max() < 0.02
    # Over time it is smeared over 36 to 108 Hz.
    assert spectra.spectrum(x, FS)[1].max() < 0.5


@pytest.mark.parametrize("order", [1.0, 20.0, 80.0])
def test_samples_over_the_angle_are_those_of_the_formula(order: float) -> None:
    """To 1e-3 up to 0.3 fs, which order 80 at 30 turns a second is; the record's ends aside."""
    turn, value = spectra.by_order(np.sin(2.0 * np.pi * order * TURNS), ANGLE)
    inner = slice(turn.size // 20, -turn.size // 20)
    np.testing.assert_allclose(
        value[inner], np.sin(2.0 * np.pi * order * turn[inner]), rtol=0.0, atol=1e-3
    )
    # As many samples a turn as the slowest turn has.
    assert 1.0 / turn[1] == pytest.approx(FS / 10.0, rel=1e-3)
    assert turn[-1] == pytest.approx(TURNS[-1], abs=turn[1])


def test_what_few_samples_a_turn_cannot_hold_is_filtered_off() -> None:
    kept, above = 10.0, 50.0
    x = np.cos(2.0 * np.pi * kept * TURNS) + np.cos(2.0 * np.pi * above * TURNS)
    order, value = spectra.order_spectrum(x, ANGLE, per_turn=64)
    assert order[-1] == pytest.approx(32.0, rel=1e-3)
    folded = np.abs(order - (64.0 - above)) < 0.3
    assert value[folded].max() < 2e-3
    assert value[np.abs(order - kept) < 0.1].max() == pytest.approx(1.0, rel=0.02)


def test_blows_of_a_run_up_stand_at_their_order() -> None:
    """The squared envelope is taken over time, where the ringing is, and its lines over the angle."""
    x = np.zeros_like(T)
    for k in range(1, int(TURNS[-1] * ORDER)):
        since = T - np.interp(k / ORDER, TURNS, T)
        after = (since >= 0.0) & (since < 0.02)
        x[after] += np.exp(-800.0 * since[after]) * np.sin(2.0 * np.pi * 2500.0 * since[after])
    squared = spectra.squared_envelope(x, FS, (1500.0, 3500.0))
    order, value = spectra.order_spectrum(squared, ANGLE, per_turn=64)
    for k in (1, 2, 3):
        near = np.abs(order - k * ORDER) < 0.5
        assert order[near][np.argmax(value[near])] == pytest.approx(k * ORDER, abs=1.5 * order[1])


def test_an_order_map_is_a_spectrogram_over_the_angle() -> None:
    turn, value = spectra.by_order(np.cos(2.0 * np.pi * ORDER * TURNS), ANGLE, per_turn=32)
    order, turns, density = spectra.spectrogram(value, 1.0 / turn[1], length=512)
    assert turns[-1] < TURNS[-1]
    assert np.abs(order[np.argmax(density, axis=0)] - ORDER).max() < order[1]


def test_a_simulated_shaft_has_its_angle() -> None:
    out = br.simulate(br.presets.deep_groove_6205(), duration=0.05, fs=20_000)
    turn, _ = spectra.by_order(out["outer.ay"], out["inner.theta"])
    assert turn[-1] == pytest.approx(0.05 * 30.0, rel=0.01)


def test_bad_arguments_are_refused() -> None:
    calls: list[tuple[str, Callable[[], object]]] = [
        ("angle", lambda: spectra.by_order(T, ANGLE[:-1])),
        ("angle", lambda: spectra.by_order(T, -ANGLE)),
        ("angle", lambda: spectra.by_order(T, np.where(T > 1.0, np.nan, ANGLE))),
        # All but standing: 1e6 samples a turn.
        ("angle", lambda: spectra.by_order(T, 2.0 * np.pi * (1e-4 * T + T**4))),
        ("per_turn", lambda: spectra.by_order(T, ANGLE, per_turn=1)),
        ("per_turn", lambda: spectra.order_spectrum(T, ANGLE, per_turn=7.5)),  # type: ignore[arg-type]
    ]
    for name, call in calls:
        with pytest.raises(br.SceneError) as caught:
            call()
        assert caught.value.path == name


def test_a_run_from_rest_has_its_line_from_a_twentieth_of_the_speed_on() -> None:
    """Analytic: a shaft that goes from rest to 30 turns a second in 4 s has a twentieth of that after 0.2 s."""
    turns = 3.75 * T**2
    x, angle = 2.0 * np.cos(2.0 * np.pi * ORDER * turns), 2.0 * np.pi * turns
    with pytest.raises(br.SceneError, match=r"turning\(angle\)"):
        spectra.by_order(x, angle, per_turn=64)
    part = spectra.turning(angle)
    assert (part.start / FS, part.stop) == (pytest.approx(0.2, abs=1.0 / FS), T.size)
    # No turn has more than twenty times the samples of the fastest.
    assert np.diff(turns[part]).min() * 20.001 > np.diff(turns).max()
    order, value = spectra.order_spectrum(x[part], angle[part], per_turn=64)
    assert order[int(np.argmax(value))] == pytest.approx(ORDER, abs=order[1])
    # To rest it is the beginning; a whole run-up stays whole, and so does one that turns back.
    stop = spectra.turning(-angle[::-1])
    assert (stop.start, stop.stop) == (0, T.size - part.start)
    for whole in (ANGLE, 3.75 * (T - 1.0) ** 2, np.zeros(9)):
        assert spectra.turning(whole) == slice(0, whole.size)


def test_features_and_the_order_map_of_a_run_from_rest_say_from_when() -> None:
    """Limit: the same run without its beginning has the same lines."""
    from ballrace import plot

    ramp = br.scene.Ramp(from_=0.0, to=314.0, start=0.0, end=0.2)
    scene = br.bearing(
        "6205",
        radial_load=1500.0,
        defects=br.defects.spall(on="outer_race", width_mm=1.0),
        speed_rpm=1800.0,
    ).replace({"drive": br.scene.SpeedDrive(ramp)})
    out = br.simulate(scene, duration=0.2, fs=25_000.0, settle=0.0)
    found = out.features(columns=["outer.ay"])
    assert found["outer.ay.lines_from"] == pytest.approx(0.01, abs=1e-4)
    # The cage turns twice in five turns of the shaft: not enough for a line of it.
    # Nor are there standard errors, since the speed changes.
    errors = {name: value for name, value in found.items() if name.endswith("_se")}
    assert errors
    assert not any(errors.values())
    lines = found.keys() - errors
    assert all(found[name] is not None for name in lines if ".ftf" not in name)
    again = br.features(out["outer.ay"], out.fs, name="outer.ay", scene=scene, skip=0.0101)
    assert "outer.ay.lines_from" not in again
    for name in ("bpfo_envelope", "bpfo_envelope_harmonics"):
        assert again[f"outer.ay.row0.{name}"] == pytest.approx(
            found[f"outer.ay.row0.{name}"], rel=0.02
        )
    # Of the outer race's fault, its line stands highest.
    highest = {
        fault: found[f"outer.ay.row0.{fault}_envelope"] for fault in ("bpfo", "bpfi", "2bsf")
    }
    assert max(highest, key=lambda fault: highest[fault] or 0.0) == "bpfo"
    fig = plot.order_map(out)
    assert "turns of the shaft from 0.01" in fig.layout.xaxis.title.text
