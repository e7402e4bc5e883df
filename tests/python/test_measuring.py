"""The stages of the measuring chain, each against what it must be."""

from __future__ import annotations

import math
import subprocess
import sys
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import pytest
import scipy.signal

import ballrace as br
from ballrace import measuring as m
from ballrace.measuring.coupling import coupling
from test_cwru import record

if TYPE_CHECKING:
    from numpy.typing import NDArray

FS = 50_000.0
MODES = tuple(
    br.Mode(frequency=f, damping=d, mass=mass, seat=(0.0, phi, 0.0), sensors={"top": (0.0, psi, 0.0)})
    for f, d, mass, phi, psi in (
        (900.0, 0.05, 2.0, 0.5, 0.4),
        (3100.0, 0.02, 0.5, 0.2, -0.3),
        (9000.0, 0.03, 0.1, 0.3, 0.2),
    )
)  # fmt: skip
PATH = br.Structure(modes=MODES)


def sine(f: float, seconds: float = 1.0) -> NDArray[np.float64]:
    t: NDArray[np.float64] = np.arange(round(seconds * FS)) / FS
    return np.sin(2.0 * np.pi * f * t)


def response(x: NDArray[np.float64], f: float, fs: float = FS) -> complex:
    """Complex amplitude over that of a unit sine, from the settled second half: whole periods."""
    x = x[x.size // 2 :]
    t = (np.arange(x.size) + x.size) / fs
    return complex(2.0 / x.size * np.sum(x * np.exp(-2.0j * np.pi * f * t)) * 1.0j)


def by_formula(f: NDArray[np.float64] | float) -> NDArray[np.complex128]:
    """Acceleration over force, from the modes' equations of motion, Laplace's s = i ω."""
    s = 2.0j * math.pi * np.asarray(f)
    total = np.zeros(s.shape, dtype=np.complex128)
    for mode in MODES:
        w, share = 2.0 * math.pi * mode.frequency, mode.seat[1] * mode.sensors["top"][1] / mode.mass
        total += share * s**2 / (s**2 + 2.0 * mode.damping * w * s + w**2)
    return total


# ------------------------------------------------------------------------------- linear stages


@pytest.mark.parametrize(
    "f", [20.0, 900.0, 2000.0, 3100.0, 5000.0, 9000.0, 15_000.0, 20_000.0, 24_000.0]
)
def test_a_sine_comes_with_the_gain_and_phase_of_the_modes(f: float) -> None:
    found = response(br.measure(sine(f), m.Chain(path=PATH), fs=FS).x, f)
    assert abs(found / by_formula(f) - 1.0) < 1e-3


def test_a_mode_answers_a_knock_as_its_equation_of_motion() -> None:
    """A soft knock, well within the band, against scipy's integration of m (q'' + 2ζωq' + ω²q) = Φ F."""
    t = np.arange(2000) / FS
    knock = np.exp(-0.5 * ((t - 0.004) / 0.0004) ** 2)
    mode = MODES[0]
    w, share = 2.0 * math.pi * mode.frequency, mode.seat[1] * mode.sensors["top"][1] / mode.mass
    system = scipy.signal.lti([share, 0.0, 0.0], [1.0, 2.0 * mode.damping * w, w**2])
    fine = np.linspace(0.0, t[-1], 20 * (t.size - 1) + 1)
    wanted = scipy.signal.lsim(system, np.exp(-0.5 * ((fine - 0.004) / 0.0004) ** 2), fine)[1][::20]
    found = br.measure(knock, m.Chain(path=br.Structure(modes=(mode,))), fs=FS).x
    np.testing.assert_allclose(found, wanted, atol=1e-4 * np.abs(wanted).max())


def test_a_path_with_the_modes_of_the_scene_is_its_sensor() -> None:
    """Truth: the sensor of the run, whose force on the seat drives the path; the coupling at 6 % of damping."""
    spall = br.defects.spall(on="outer_race", width_mm=2.0)
    kappa = {}
    for load in (49.0, 500.0):
        scene = br.bearing("6205", radial_load=load, speed_rpm=900.0, defects=spall)
        assert scene.structure is not None
        foot = replace(scene.structure, modes=scene.structure.modes[2:3])
        damped = replace(foot, modes=(replace(foot.modes[0], damping=0.06),))
        kappa[load] = coupling(scene.replace({"defects": {}}), damped)
    assert kappa == pytest.approx({49.0: 2.5, 500.0: 9.8}, rel=0.01)
    out = br.simulate(scene, duration=0.1)
    with pytest.warns(br.AccuracyWarning, match=r"κ = .*, above 0\.3"):
        found = br.measure(out, path=scene.structure)
    assert found.coupling is not None
    assert found.coupling > 0.3
    # At rest as the record begins, which dies down; and a sharp end is not band-limited.
    inside = slice(1000, -500)
    ours, sensor = found.x[inside], out["housing.sensor.ay"][inside]
    assert np.linalg.norm(ours - sensor) < 0.01 * np.linalg.norm(sensor)
    for seed in range(5):
        other = br.measure(out, path=m.random_housing(seed))
        assert other.coupling is not None
        assert other.coupling < 0.1


def test_ringing_does_not_come_round_to_the_beginning() -> None:
    x = np.zeros(1000)
    x[-1] = 1.0
    slow = br.Structure(modes=(replace(MODES[0], frequency=50.0, damping=0.005),))
    # Only what a sharp end of a band-limited signal has before itself.
    assert np.abs(br.measure(x, m.Chain(path=slow), fs=FS).x[:900]).max() < 1e-5


def test_a_measured_response_is_its_interpolation() -> None:
    f = np.arange(0.0, 25_001.0, 10.0)
    h = by_formula(f)
    measured = br.measure(sine(2000.0), m.Chain(path=m.MeasuredResponse(f, h)), fs=FS)
    assert abs(response(measured.x, 2000.0) / by_formula(2000.0) - 1.0) < 1e-3
    beyond = br.measure(
        sine(2000.0), m.Chain(path=m.MeasuredResponse([0.0, 1000.0], [1.0, 1.0])), fs=FS
    )
    assert abs(response(beyond.x, 2000.0)) < 1e-3


def test_an_impulse_response_is_a_convolution() -> None:
    rng = np.random.default_rng(1)
    x, taps = rng.standard_normal(3000), rng.standard_normal(700)
    found = br.measure(x, m.Chain(path=m.ImpulseResponse(taps, FS)), fs=FS).x
    np.testing.assert_allclose(found, np.convolve(x, taps)[:3000], atol=1e-10)


def test_the_sensor_has_its_resonance_and_its_lower_limit() -> None:
    sensor = m.Sensor(resonance=20_000.0, damping=0.025, lower_limit=5.0)
    top = response(br.measure(sine(20_000.0), m.Chain(sensor=sensor), fs=FS).x, 20_000.0)
    assert abs(top) == pytest.approx(1.0 / (2.0 * 0.025), rel=1e-3)
    assert abs(
        response(br.measure(sine(5.0, 4.0), m.Chain(sensor=sensor), fs=FS).x, 5.0)
    ) == pytest.approx(math.sqrt(0.5), rel=1e-3)


# ------------------------------------------------------------------------------- direction and source


def test_direction_projects_the_accelerations() -> None:
    xyz = np.random.default_rng(2).standard_normal((100, 3))
    found = br.measure(xyz, m.Chain(direction=(3.0, 0.0, -4.0)), fs=FS).x
    np.testing.assert_allclose(found, 0.6 * xyz[:, 0] - 0.8 * xyz[:, 2], rtol=1e-12)


def test_of_a_run_it_is_that_of_the_recorded_columns() -> None:
    out = br.simulate(br.bearing("6205", speed_rpm=1797.0), duration=0.01)
    assert np.array_equal(br.measure(out).x, out["housing.sensor.ay"])
    assert np.array_equal(br.measure(out, body="outer").x, out["outer.ay"])
    both = br.measure(out, m.Chain(direction=(1.0, 1.0, 0.0), body="inner")).x
    np.testing.assert_allclose(
        both, math.sqrt(0.5) * (out["inner.ax"] + out["inner.ay"]), rtol=1e-12
    )
    with pytest.raises(br.SceneError, match=r"row0\.ball0"):
        br.measure(out, m.Chain(body="row0.ball0"))


def test_without_a_stage_the_numbers_stay() -> None:
    x = np.random.default_rng(3).standard_normal(100)
    measured = br.measure(x, fs=FS)
    assert measured.range is None
    assert np.array_equal(measured.x, x)
    assert measured.x is not x
    assert measured.fs == FS
    assert (measured.pulses.size, measured.clipped) == (0, 0.0)


# ------------------------------------------------------------------------------- logger


def test_clipping() -> None:
    with pytest.warns(br.AccuracyWarning, match=r"67 % of the samples .* range of ±0.5 m/s²"):
        measured = br.measure(sine(100.0), m.Chain(logger=m.Logger(range=0.5)), fs=FS)
    assert measured.x.max() == 0.5
    assert measured.x.min() == -0.5
    # The sine is above one half for two thirds of the time.
    assert measured.clipped == pytest.approx(2.0 / 3.0, abs=2e-3)
    assert "range ±0.5 m/s^2, 67 % clipped" in repr(measured)
    # A sample in a thousand is no reason to warn.
    once = np.zeros(1000)
    once[7] = 2.0
    assert br.measure(once, fs=FS, logger=m.Logger(range=1.0)).clipped == 1e-3


@pytest.mark.parametrize(
    ("peak", "bits", "reach"),
    [(0.9, None, 1.0), (1.0, 16, 2.0), (1.0, None, 1.0), (31.0, 16, 50.0), (720.0, 12, 1000.0),
     (3e-4, 8, 5e-4), (6e5, 24, 1e6), (1e3, 2, 2000.0)],
)  # fmt: skip
def test_by_default_the_range_fits_the_signal(peak: float, bits: int | None, reach: float) -> None:
    """Limit: what is measured differs from the signal by half a step, at the peaks too, and nothing is clipped."""
    x = peak * sine(100.0)
    measured = br.measure(x, fs=FS, logger=m.Logger(bits=bits))
    assert (measured.range, measured.clipped) == (reach, 0.0)
    step = 0.0 if bits is None else 2.0 * reach / 2**bits
    assert np.abs(measured.x - x).max() <= 0.5 * step * (1.0 + 1e-9)
    assert f"range ±{reach:g} m/s^2>" in repr(measured)


def test_silence_has_a_range_too() -> None:
    assert not br.measure(np.zeros(10), fs=FS, logger=m.Logger(bits=16)).x.any()


def test_quantisation_has_its_step_and_the_noise_of_its_step() -> None:
    logger = m.Logger(range=2.0, bits=10)
    assert logger.step == 4.0 / 1024.0
    x = np.random.default_rng(4).uniform(-1.0, 1.0, 200_000)
    error = br.measure(x, m.Chain(logger=logger), fs=FS).x - x
    assert np.unique(np.rint((error + x) / logger.step - (error + x) / logger.step)).tolist() == [
        0.0
    ]
    assert np.abs(error).max() <= 0.5 * logger.step * (1.0 + 1e-9)
    assert error.var() == pytest.approx(logger.step**2 / 12.0, rel=0.02)


def test_the_converters_range_has_one_code_more_below() -> None:
    logger = m.Logger(range=1.0, bits=3)
    with pytest.warns(br.AccuracyWarning):
        found = br.measure(np.array([-5.0, 5.0]), m.Chain(logger=logger), fs=FS).x
    assert found.tolist() == [-1.0, 0.75]


@pytest.mark.parametrize("fs", [12_000.0, 25_600.0, 96_000.0])
def test_resampling_keeps_the_band_and_nothing_beyond(fs: float) -> None:
    logger = m.Chain(logger=m.Logger(fs=fs))
    kept = br.measure(sine(1000.0, 2.0), logger, fs=FS)
    assert kept.fs == fs
    assert abs(response(kept.x, 1000.0, fs) - 1.0) < 1e-3
    if fs < FS:
        # Would fold back into the band.
        beyond = br.measure(sine(0.5 * fs + 600.0, 2.0), logger, fs=FS).x
        assert np.abs(beyond[2000:-2000]).max() < 2e-4


def test_bandwidth_alone() -> None:
    chain = m.Chain(logger=m.Logger(bandwidth=8000.0))
    assert abs(response(br.measure(sine(8000.0), chain, fs=FS).x, 8000.0) - 1.0) < 1e-3
    assert abs(response(br.measure(sine(10_000.0), chain, fs=FS).x, 10_000.0)) < 2e-4


# ------------------------------------------------------------------------------- machine


@pytest.mark.parametrize("stage", ["machine", "logger"])
def test_noise_has_its_density(stage: str) -> None:
    density = 3e-4
    stages = {
        "machine": m.Machine(noise_density=density),
        "logger": m.Logger(noise_density=density),
    }
    x = br.measure(np.zeros(500_000), m.Chain(**{stage: stages[stage]}), fs=FS, seed=5).x  # type: ignore[arg-type]
    _, found = scipy.signal.welch(x, FS, nperseg=1024)
    assert np.mean(found[2:-2]) == pytest.approx(density, rel=0.01)
    assert found[2:-2].std() / density < 0.1


def test_noise_keeps_its_density_through_the_logger() -> None:
    chain = m.Chain(machine=m.Machine(noise_density=1e-2), logger=m.Logger(fs=12_000.0))
    x = br.measure(np.zeros(1_000_000), chain, fs=FS, seed=6).x
    f, found = scipy.signal.welch(x, 12_000.0, nperseg=512)
    assert np.mean(found[(f > 200.0) & (f < 4500.0)]) == pytest.approx(1e-2, rel=0.02)


def test_harmonics_of_shaft_and_mains() -> None:
    machine = m.Machine(
        shaft=(2.0, 0.5), mains=(0.0, 0.25), mains_frequency=50.0, noise_density=0.0
    )
    x = br.measure(np.zeros(50_000), m.Chain(machine=machine), fs=FS, shaft=30.0).x
    lines = 2.0 * np.abs(np.fft.rfft(x)) / x.size
    assert [lines[k] for k in (30, 60, 50, 100)] == pytest.approx([2.0, 0.5, 0.0, 0.25], abs=1e-9)


def test_modulated_noise_has_lines_of_the_shaft_in_its_envelope() -> None:
    machine = m.Machine(noise_density=1.0, modulation=(0.3,))
    x = br.measure(np.zeros(500_000), m.Chain(machine=machine), fs=FS, shaft=30.0, seed=8).x
    squared = x**2 / np.mean(x**2)
    line = 2.0 * abs(np.mean(squared * np.exp(-2.0j * np.pi * 30.0 * np.arange(x.size) / FS)))
    # (1 + m cos)² = 1 + m²/2 + 2 m cos + …
    assert line == pytest.approx(0.6 / (1.0 + 0.3**2 / 2.0), rel=0.03)


def test_by_default_a_machine_is_as_loud_as_a_measured_one() -> None:
    """Measured: the healthy record 97 of the Case Western Reserve data, its densities and envelope.

    Truth for the record's rate: three lines that record 105 of the same machine has at its 12 kHz.
    """
    x, fs = 9.81 * record("97"), 48_000.0
    frequency, amplitude = br.spectra.spectrum(x, fs)
    at_12, other = br.spectra.spectrum(9.81 * record("105"), 12_000.0)
    for low, high in ((140.0, 150.0), (158.0, 164.0), (188.0, 194.0)):
        lines = [
            float(f[(f > low) & (f < high)][np.argmax(a[(f > low) & (f < high)])])
            for f, a in ((frequency, amplitude), (at_12, other))
        ]
        assert lines[0] == pytest.approx(lines[1], rel=1e-3)
    ours = br.measure(np.zeros(x.size), fs=fs, machine=m.Machine(), shaft=29.93, seed=1).x
    f, measured = scipy.signal.welch(x, fs, nperseg=16_384)
    _, simulated = scipy.signal.welch(ours, fs, nperseg=16_384)
    for low, high in ((100, 700), (700, 2000), (2000, 5600), (5600, 11_200), (11_200, 22_400)):
        band = (f >= low) & (f < high)
        assert 0.5 < np.median(simulated[band]) / np.median(measured[band]) < 2.0, (low, high)
    for low, high in ((2000.0, 3000.0), (3000.0, 4000.0), (6000.0, 8000.0)):
        heights = [swollen(y, fs, (low, high), 29.93) for y in (ours, x)]
        assert 0.5 < heights[0] / heights[1] < 2.0, (low, high, heights)
    # Without a shaft whose angle is known there is nothing to swell it, and a fault of true size stands out of it.
    assert br.measure(np.zeros(1000), fs=fs, machine=m.Machine()).x.std() < 0.5


def swollen(x: NDArray[np.float64], fs: float, band: tuple[float, float], shaft: float) -> float:
    """Line of the squared envelope in a band at the shaft's frequency, over its mean."""
    envelope = br.spectra.squared_envelope(x, fs, band)
    f, amplitude = br.spectra.spectrum(envelope, fs)
    return float(amplitude[np.abs(f - shaft) < 0.5].max() / envelope.mean())


# ------------------------------------------------------------------------------- tachometer


def test_pulses_of_an_even_shaft() -> None:
    chain = m.Chain(tacho=m.Tacho(pulses=4))
    pulses = br.measure(np.zeros(50_000), chain, fs=FS, shaft=30.0).pulses
    np.testing.assert_allclose(pulses, np.arange(120) / 120.0, atol=1e-9)


def test_pulses_of_a_run_up() -> None:
    t = np.arange(100_000) / FS
    chain = m.Chain(tacho=m.Tacho())
    pulses = br.measure(np.zeros(t.size), chain, fs=FS, shaft=2.0 * np.pi * 20.0 * t**2).pulses
    np.testing.assert_allclose(pulses, np.sqrt(np.arange(pulses.size) / 20.0), atol=1e-6)


def test_jitter() -> None:
    chain = m.Chain(tacho=m.Tacho(pulses=10, jitter=1e-5))
    pulses = br.measure(np.zeros(1_000_000), chain, fs=FS, shaft=30.0, seed=9).pulses
    assert (pulses - np.arange(pulses.size) / 300.0).std() == pytest.approx(1e-5, rel=0.05)


def test_of_a_run_pulses_follow_the_inner_ring() -> None:
    out = br.simulate(br.bearing("6205", speed_rpm=3000.0), duration=0.05)
    pulses = br.measure(out, m.Chain(tacho=m.Tacho(pulses=2))).pulses
    np.testing.assert_allclose(np.diff(pulses), 0.01, rtol=1e-6)


# ------------------------------------------------------------------------------- seeds and mixing


CHAIN = m.Chain(
    path=PATH,
    machine=m.Machine(noise_density=1e-3, shaft=(1.0,), modulation=(0.2,)),
    sensor=m.Sensor(),
    logger=m.Logger(fs=12_000.0, noise_density=1e-5, range=20.0, bits=16),
    tacho=m.Tacho(jitter=1e-5),
)


def test_a_seed_decides_all_and_stages_do_not_disturb_each_other() -> None:
    def run(chain: m.Chain, seed: int) -> m.Measurement:
        return br.measure(sine(500.0, 0.1), chain, fs=FS, shaft=30.0, seed=seed)

    first, again, other = run(CHAIN, 1), run(CHAIN, 1), run(CHAIN, 2)
    assert np.array_equal(first.x, again.x)
    assert np.array_equal(first.pulses, again.pulses)
    assert not np.array_equal(first.x, other.x)
    quiet = replace(CHAIN, machine=None)
    assert np.array_equal(run(quiet, 1).pulses, first.pulses)
    # Noise of one stage is not that of another.
    jittery = br.measure(
        np.zeros(50_000),
        fs=FS,
        shaft=30.0,
        logger=m.Logger(noise_density=2.0 / FS),
        tacho=m.Tacho(jitter=1e-6),
    )
    errors = (jittery.pulses - np.arange(30) / 30.0) / 1e-6
    assert np.abs(np.sort(errors) - np.sort(jittery.x[:30])).max() > 0.1
    silent = replace(CHAIN, machine=None, logger=m.Logger(noise_density=1.0))
    without = replace(silent, logger=None)
    noisy = replace(silent, machine=m.Machine(noise_density=1.0))
    noise = run(silent, 1).x - run(without, 1).x
    assert np.allclose(noise, run(noisy, 1).x - run(replace(noisy, logger=None), 1).x)


def test_mixing_has_its_ratio_and_leaves_the_background() -> None:
    rng = np.random.default_rng(11)
    x, record = sine(300.0, 0.2), 3.0 + 0.7 * rng.standard_normal(40_000)
    mixed = m.mix_into(x, record, -6.0)
    added = mixed - record[: x.size]
    ratio = 10.0 * math.log10(added.var() / record[: x.size].var())
    assert ratio == pytest.approx(-6.0, abs=1e-9)
    # Anywhere in the record, by the seed.
    assert not np.array_equal(m.mix_into(x, record, -6.0, seed=1), mixed)
    measured = br.measure(x, fs=FS)
    assert np.array_equal(measured.mix_into(record, -6.0), mixed)
    with pytest.raises(br.SceneError, match="background"):
        m.mix_into(x, record[:100], 0.0)


def test_random_housings_differ_by_their_seeds() -> None:
    drawn = [m.random_housing(seed) for seed in range(20)]
    assert len({housing.modes for housing in drawn}) == 20
    for housing in drawn:
        assert all(800.0 <= mode.frequency <= 12_000.0 for mode in housing.modes)
        assert all(np.linalg.norm(mode.seat) == pytest.approx(0.005) for mode in housing.modes)


def test_walls_around_larger_bearings_are_heavier() -> None:
    """Truth: similarity. Twice as large they ring at half the frequency with eight times the mass."""
    small, large = (m.random_housing(1, outside_diameter=size).modes for size in (0.052, 0.104))
    assert m.random_housing(1).modes == small
    for one, other in zip(small, large, strict=True):
        assert other == replace(one, mass=4.0 * one.mass)
    (chain,) = m.random_chains(1, seed=5, outside_diameter=0.104, near=0.0).values()
    (usual,) = m.random_chains(1, seed=5, near=0.0).values()
    assert isinstance(chain.path, br.Structure)
    assert isinstance(usual.path, br.Structure)
    assert chain.path.modes[0].mass == pytest.approx(4.0 * usual.path.modes[0].mass)


def test_machines_by_chance_repeat_by_their_seeds_and_hold_their_ranges() -> None:
    made = [m.random_machine(seed) for seed in range(30)]
    assert made[3] == m.random_machine(3)
    assert len({machine.shaft for machine in made}) == 30
    level = [np.interp(1e3, *machine.noise_density) for machine in made]  # type: ignore[misc]
    measured = np.interp(1e3, *m.Machine().noise_density)  # type: ignore[misc]
    assert 0.01 <= min(level) / measured < 0.1
    assert 10.0 < max(level) / measured <= 100.0
    for machine in made:
        assert all(3e-3 <= a <= 1.0 for a in machine.shaft[:3])
        assert 20 <= np.count_nonzero(machine.shaft) <= 90
        assert 0.0 <= machine.wander <= 0.3
        for most, a in zip((0.3, 0.2, 0.1), machine.modulation or (), strict=True):
            assert 0.05 * most <= a <= most


def test_chains_by_chance_begin_alike_whatever_their_number() -> None:
    few, many = m.random_chains(2, seed=5), m.random_chains(4, seed=5)
    assert [many[name] for name in few] == list(few.values())
    assert len({repr(chain) for chain in many.values()}) == 4


def test_paths_by_chance_differ_in_their_number_of_modes_and_their_damping() -> None:
    paths = [chain.path for chain in m.random_chains(30, seed=5, near=0.0).values()]
    damped = [np.array([mode.damping for mode in path.modes]) for path in paths]  # type: ignore[union-attr]
    assert {len(each) for each in damped} <= set(range(5, 41))
    assert len({len(each) for each in damped}) > 15
    assert all(0.01 < each.min() <= each.max() <= 2.0 * each.min() for each in damped)
    assert max(each.max() for each in damped) > 0.07


def test_many_modes_pass_as_much_on_as_few() -> None:
    """Truth: independent modes add by their squares, so that √n times the mass makes up for n times as many."""
    force = np.random.default_rng(1).normal(size=(8192, 3))
    powers = []
    for modes in (5, 80):
        paths = [m.random_housing(seed, modes=modes, damping=(0.05, 0.05)) for seed in range(60)]
        powers.append(
            np.mean([br.measure(force, fs=51_200.0, path=path).x.var() for path in paths])
        )
    assert powers[1] == pytest.approx(powers[0], rel=0.3)


def test_half_of_the_sensors_are_on_the_structure_of_the_run_and_all_else_stays() -> None:
    drawn, far = m.random_chains(200, seed=5), m.random_chains(200, seed=5, near=0.0)
    near = [name for name, chain in drawn.items() if chain.path is None]
    assert 80 <= len(near) <= 120
    assert all(chain.path is not None for chain in far.values())
    assert all(replace(far[name], path=None) == drawn[name] for name in near)
    assert all(far[name] == drawn[name] for name in drawn if name not in near)


def test_a_floor_of_ones_own_leaves_lines_out() -> None:
    """White noise of 1e-4 with a strong tone: its density is found, at 0.5 to 2 times and tilted about 1 kHz."""
    noise = math.sqrt(0.5e-4 * FS) * np.random.default_rng(2).standard_normal(100_000)
    record = br.Channel(x=noise + sine(997.0, 2.0), fs=FS)
    for seed in range(5):
        made = m.random_machine(seed, background=record)
        assert 0.45e-4 < np.interp(1e3, *made.noise_density) < 2.2e-4  # type: ignore[misc]


def test_noise_that_wanders_is_slow_and_leaves_other_numbers_alone() -> None:
    t = np.zeros(200_000)
    steady = br.measure(t, fs=1e4, machine=m.Machine(noise_density=1e-2, shaft=(0.5,)), shaft=25.0)
    wander = m.Machine(noise_density=1e-2, shaft=(0.5,), wander=0.3)
    found = br.measure(t, fs=1e4, machine=wander, shaft=25.0)
    tone = br.measure(t, fs=1e4, machine=m.Machine(noise_density=0.0, shaft=(0.5,)), shaft=25.0).x
    plain = steady.x - tone
    loud = np.abs(plain) > 0.1
    log = np.log((found.x - tone)[loud] / plain[loud])  # the same noise, louder or quieter
    assert 0.15 < log.std() < 0.5
    assert np.abs(np.diff(log)).max() < 0.02


# ------------------------------------------------------------------------------- what is refused


@pytest.mark.parametrize(
    ("make", "field"),
    [
        (
            lambda: br.measure(np.zeros(9), fs=FS, path=br.Structure(modes=(replace(MODES[0], damping=0.0),))),
            "path.modes[0].damping",
        ),
        (lambda: br.measure(np.zeros(9), fs=FS, path=PATH, body="side"), "body"),
        (lambda: m.MeasuredResponse([1.0, 0.5], [1.0, 1.0]), "path.f"),
        (lambda: m.MeasuredResponse([1.0, 2.0], [1.0]), "path.h"),
        (lambda: m.ImpulseResponse([], 1.0), "path.taps"),
        (lambda: m.Sensor(resonance=-1.0), "sensor.resonance"),
        (lambda: m.Machine(noise_density=-1.0), "machine.noise_density"),
        (lambda: m.Machine(shaft=(math.nan,)), "machine.shaft"),
        (lambda: m.Machine(wander=-0.1), "machine.wander"),
        (lambda: m.random_machine(-1), "seed"),
        (lambda: m.random_machine(1, background="97.mat"), "background"),  # type: ignore[arg-type]
        (lambda: m.random_machine(1, background=br.Channel(x=np.ones(9), fs=1e3)), "background"),
        (lambda: m.random_chains(0, seed=1), "n"),
        (lambda: m.random_chains(1, seed=1, near=1.5), "near"),
        (lambda: m.random_chains(1, seed=1, outside_diameter=1e200), "outside_diameter"),
        (lambda: m.random_housing(1, outside_diameter=0.0), "outside_diameter"),
        (lambda: m.Logger(range=0.0), "logger.range"),
        (lambda: m.Logger(bits=1, range=1.0), "logger.bits"),
        (lambda: m.Tacho(pulses=0), "tacho.pulses"),
        (lambda: m.Chain(path=m.Sensor()), "path"),  # type: ignore[arg-type]
        (lambda: br.measure(np.zeros(10)), "fs"),
        (lambda: br.measure(np.array([1.0, math.nan]), fs=1.0), "x"),
        (lambda: br.measure(np.zeros(10), fs=1.0, seed=-1), "seed"),
        (lambda: br.measure(np.zeros(10), m.Chain(direction=(1.0, 0.0, 0.0)), fs=1.0), "direction"),
        (lambda: br.measure(np.zeros((10, 3)), m.Chain(direction=(0.0, 0.0, 0.0)), fs=1.0), "direction"),
        (lambda: br.measure(np.zeros(10), m.Chain(tacho=m.Tacho()), fs=1.0), "shaft"),
        (lambda: br.measure(np.zeros(10), fs=1.0, shaft=[1.0]), "shaft"),
        (lambda: br.measure(np.zeros(10), m.Chain(logger=m.Logger(fs=FS / math.pi)), fs=FS), "logger.fs"),
        (lambda: br.measure(np.zeros(10), m.Chain(logger=m.Logger(bandwidth=FS)), fs=FS), "logger.bandwidth"),
        (lambda: br.measure(np.zeros(10), m.Chain(path=m.ImpulseResponse([1.0], 2.0)), fs=FS), "path.fs"),
    ],
)  # fmt: skip
def test_what_is_refused_says_the_field(make: object, field: str) -> None:
    with pytest.raises(br.SceneError) as refused:
        make()  # type: ignore[operator]
    assert refused.value.path == field


# ------------------------------------------------------------------------------- coloured noise, keywords, tables


def test_coloured_noise_has_its_density() -> None:
    f = np.linspace(0.0, 25_000.0, 101)
    density = 1e-3 * (1.0 + np.sin(f / 4000.0)) + 1e-5
    machine = m.Machine(noise_density=(f, density))
    x = br.measure(np.zeros(1_000_000), machine=machine, fs=FS, seed=3).x
    at, found = scipy.signal.welch(x, FS, nperseg=1000)
    wanted = np.interp(at, f, density)
    strong = wanted[2:-2] > 1e-4
    np.testing.assert_allclose(found[2:-2][strong], wanted[2:-2][strong], rtol=0.2)
    assert np.mean(found[2:-2]) == pytest.approx(np.mean(wanted[2:-2]), rel=0.01)
    # At the first and the last sample too.
    drawn = [br.measure(np.zeros(500), machine=machine, fs=FS, seed=seed).x for seed in range(2000)]
    for ends in (0, -1):
        assert np.std([noise[ends] for noise in drawn]) == pytest.approx(x.std(), rel=0.05)
    for bad in ((f, density[:-1]), (f[::-1], density), (f, -density), (f,)):
        with pytest.raises(br.SceneError, match="noise_density"):
            m.Machine(noise_density=bad)  # type: ignore[arg-type]


def test_stages_may_be_given_one_by_one() -> None:
    x = sine(500.0, 0.1)
    stages = {"path": PATH, "sensor": m.Sensor()}
    chain = m.Chain(**stages)  # type: ignore[arg-type]
    assert np.array_equal(
        br.measure(x, fs=FS, path=PATH, sensor=m.Sensor()).x, br.measure(x, chain, fs=FS).x
    )
    without = br.measure(x, chain, fs=FS, path=None)
    assert without.chain.stages == ("sensor",)
    with pytest.raises(TypeError, match="pth"):
        br.measure(x, fs=FS, pth=PATH)  # type: ignore[call-arg]


def test_a_table_has_the_numbers_of_chains() -> None:
    found = m.table({"a": CHAIN, "b": m.Chain(logger=m.Logger(range=5.0))})
    first, second = found.rows(named=True)
    assert first["path.modes[1].frequency"] == 3100.0
    assert first["machine.shaft[0]"] == 1.0
    assert (first["logger.range"], second["logger.range"]) == (20.0, 5.0)
    assert second["path.modes[0].mass"] is None


def test_scipy_is_imported_by_the_logger_alone() -> None:
    """Nothing imports it before, so that the package itself comes quickly."""
    script = """
import sys
import numpy as np
import ballrace as br
br.measure(np.zeros(100), fs=1e4, path=br.measuring.random_housing(1), sensor=br.measuring.Sensor())
assert "scipy" not in sys.modules
br.measure(np.zeros(100), fs=1e4, logger=br.measuring.Logger(fs=5e3))
assert "scipy" in sys.modules
"""
    subprocess.run([sys.executable, "-c", script], check=True)
