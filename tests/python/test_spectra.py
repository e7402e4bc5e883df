"""Spectra of synthetic signals whose lines are known."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import pytest

import ballrace as br
from ballrace import spectra

if TYPE_CHECKING:
    from numpy.typing import NDArray

FS = 12_000.0


def times(duration: float) -> NDArray[np.float64]:
    return np.arange(round(duration * FS)) / FS


def blows(
    rate: float, duration: float, *, strength: float = 0.0, swing: float = 1.0
) -> NDArray[np.float64]:
    """Ring at 3 kHz after every blow; the blows come at ``rate`` and swell by ``strength`` at ``swing`` [Hz]."""
    t = times(duration)
    x = np.zeros_like(t)
    for k in range(math.floor(duration * rate)):
        since = t - k / rate
        height = 1.0 + strength * math.cos(2.0 * math.pi * swing * k / rate)
        after = (since >= 0.0) & (since < 0.02)
        ringing = np.exp(-800.0 * since[after]) * np.sin(2.0 * np.pi * 3000.0 * since[after])
        x[after] += height * ringing
    return x


@pytest.mark.parametrize("frequency", [100.0, 100.13, 100.5, 1234.567])
@pytest.mark.parametrize("samples", [6000, 6001, 7919])
def test_a_line_between_bins(frequency: float, samples: int) -> None:
    t = np.arange(samples) / FS
    x = 3.0 + 0.7 * np.sin(2.0 * np.pi * frequency * t + 0.4)
    f, value = spectra.line(x, FS, near=frequency + 1.3, width=4.0)
    # A bin is 2 Hz or less; what is left is the line's own image at negative frequencies.
    assert f == pytest.approx(frequency, abs=2e-5)
    assert value == pytest.approx(0.7, rel=1e-5)


def test_a_line_in_noise_reaches_its_bound() -> None:
    # Cramér and Rao: σ_f ≥ √6 σ / (π A T √n); the window costs a factor of about 1.5 at most.
    n, amplitude, sigma, frequency = 4000, 1.0, 1.0, 432.1
    t = np.arange(n) / FS
    bound = math.sqrt(6.0) * sigma / (math.pi * amplitude * (n / FS) * math.sqrt(n))
    generator = np.random.default_rng(1)
    errors = []
    for _ in range(40):
        x = amplitude * np.sin(2.0 * np.pi * frequency * t) + sigma * generator.normal(size=n)
        errors.append(spectra.line(x, FS, near=432.0, width=3.0)[0] - frequency)
    assert bound < np.sqrt(np.mean(np.square(errors))) < 1.8 * bound


def test_the_strongest_line_wins_within_the_width_only() -> None:
    t = times(2.0)
    x = np.sin(2.0 * np.pi * 50.0 * t) + 0.2 * np.sin(2.0 * np.pi * 60.0 * t)
    assert spectra.line(x, FS, near=55.0, width=8.0)[0] == pytest.approx(50.0, abs=1e-3)
    assert spectra.line(x, FS, near=60.0, width=4.0)[0] == pytest.approx(60.0, abs=1e-3)


def test_a_comb_is_sharper_than_its_first_line() -> None:
    t = times(1.0)
    generator = np.random.default_rng(2)
    single, family = [], []
    for _ in range(20):
        x = sum(np.cos(2.0 * np.pi * k * 107.3 * t + k) for k in range(1, 6))
        x = x + 3.0 * generator.normal(size=t.size)
        single.append(spectra.line(x, FS, near=107.0, width=1.0)[0] - 107.3)
        f, value = spectra.comb(x, FS, near=107.0, width=1.0, orders=range(1, 6))
        family.append(f - 107.3)
        np.testing.assert_allclose(value, 1.0, atol=0.25)
    assert np.std(family) < 0.3 * np.std(single)


def test_a_comb_of_sidebands() -> None:
    t = times(2.0)
    x = sum(np.cos(2.0 * np.pi * (k * 161.7 + 29.9) * t) for k in (1, 2, 3))
    f, value = spectra.comb(x, FS, near=162.0, width=1.5, orders=(1, 2, 3), offset=29.9)
    assert f == pytest.approx(161.7, abs=1e-4)
    np.testing.assert_allclose(value, 1.0, rtol=1e-4)


def test_spectrum_has_the_amplitude_and_no_mean() -> None:
    t = times(1.0)
    f, value = spectra.spectrum(5.0 + 2.0 * np.cos(2.0 * np.pi * 300.0 * t), FS)
    assert f[-1] == FS / 2.0
    assert value[300] == pytest.approx(2.0, rel=1e-6)
    assert value[:250].max() < 1e-5


@pytest.mark.parametrize("samples", [1200, 1201])
def test_envelope_of_a_modulated_tone(samples: int) -> None:
    t = np.arange(samples) / FS
    tone = np.cos(2.0 * np.pi * 3000.0 * t)
    np.testing.assert_allclose(spectra.squared_envelope(tone, FS)[100:-100], 1.0, atol=2e-2)
    if samples == 1200:
        np.testing.assert_allclose(spectra.squared_envelope(tone, FS), 1.0, atol=1e-12)


def test_the_band_keeps_out_what_lies_beside_it() -> None:
    t = times(1.0)
    swell = 1.0 + 0.5 * np.cos(2.0 * np.pi * 17.0 * t)
    x = swell * np.cos(2.0 * np.pi * 3000.0 * t) + 10.0 * np.cos(2.0 * np.pi * 500.0 * t)
    found = spectra.squared_envelope(x, FS, band=(2000.0, 4000.0))
    np.testing.assert_allclose(found, swell**2, atol=1e-9)


def test_blows_give_lines_at_their_rate() -> None:
    x = blows(107.645, 2.0)
    x += 0.1 * np.random.default_rng(3).normal(size=x.size)
    squared = spectra.squared_envelope(x, FS, band=(1500.0, 5500.0))
    f, _ = spectra.line(squared, FS, near=105.0, width=10.0)
    assert f == pytest.approx(107.645, rel=2e-4)
    f, value = spectra.comb(squared, FS, near=107.0, width=3.0, orders=(1, 2, 3, 4))
    assert f == pytest.approx(107.645, rel=5e-5)
    # The raw signal has its energy at the ringing, not at the rate.
    raw = spectra.line(x, FS, near=107.645, width=0.5)[1] / x.std()
    assert value[0] / squared.std() > 10.0 * raw


def test_swelling_blows_have_sidebands() -> None:
    x = blows(161.683, 3.0, strength=0.6, swing=29.9325)
    squared = spectra.squared_envelope(x, FS, band=(1500.0, 5500.0))
    frequencies, value = spectra.squared_envelope_spectrum(x, FS, band=(1500.0, 5500.0))
    for k in (1, 2):
        for side in (-1, 1):
            expected = k * 161.683 + side * 29.9325
            f, height = spectra.line(squared, FS, near=expected, width=5.0)
            assert f == pytest.approx(expected, rel=1e-3)
            assert height > 20.0 * spectra.floor(frequencies, value, expected, 20.0)[1]


def test_bad_arguments_are_refused() -> None:
    x = np.ones(100)
    for call in (
        lambda: spectra.squared_envelope(x, FS, band=(100.0, 7000.0)),
        lambda: spectra.squared_envelope(x, FS, band=(200.0, 100.0)),
        lambda: spectra.spectrum(np.ones((10, 10)), FS),
        lambda: spectra.spectrum(np.ones(3), FS),
        lambda: spectra.spectrum(np.full(100, np.nan), FS),
        lambda: spectra.spectrum(x, 0.0),
        lambda: spectra.line(x, FS, near=100.0, width=0.0),
        lambda: spectra.line(x, FS, near=1.0, width=2.0),
        lambda: spectra.line(x, FS, near=5999.0, width=2.0),
        lambda: spectra.comb(x, FS, near=100.0, width=1.0, orders=()),
        lambda: spectra.floor(np.arange(10.0), np.arange(10.0), 20.0, 1.0),
    ):
        with pytest.raises(br.SceneError):
            call()


def test_prewhitened_spectra_are_flat() -> None:
    """Truth: every amplitude is one by the cepstrum; over 50 Hz a resonance goes, and a tone stays."""
    t = np.arange(8192) / FS
    tone = np.sin(2 * np.pi * 1000.0 * FS / 12_000.0 * t)
    x = 20.0 * tone + np.random.default_rng(1).normal(size=t.size)
    flat = np.abs(np.fft.rfft(spectra.prewhitened(x, FS)))[1:-1]
    assert flat == pytest.approx(flat.mean(), rel=1e-9)
    wide = np.abs(np.fft.rfft(spectra.prewhitened(x, FS, width=50.0)))[1:-1]
    at = int(np.argmax(np.abs(np.fft.rfft(x))[1:-1]))
    assert wide[at] > 4.0 * np.median(wide)
    assert spectra.prewhitened(x, FS).std() == pytest.approx(1.0)
    assert not spectra.prewhitened(np.zeros(64), FS).any()
    with pytest.raises(br.SceneError, match=r"width = 0\.0"):
        spectra.prewhitened(x, FS, width=0.0)
