"""Tones taken out, cyclic coherence, log-envelope spectra, spectral kurtosis.

Truth: analytic. Of noise times 1 + cos the coherence is 2/3 at that rate and 1/6 at twice it, whatever filter it
went through; the logarithm of an envelope exp(a cos) is a line; a tone has the kurtosis −1, and noise exceeds the
limit at the share of frequencies that was asked for.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import pytest

import ballrace as br
from ballrace import spectra

if TYPE_CHECKING:
    from collections.abc import Callable

FS = 4000.0
RNG = np.random.default_rng(5)
T = np.arange(120_000) / FS
NOISE = RNG.normal(size=T.size)
SWELLING = (1.0 + np.cos(2 * np.pi * 11.0 * T)) * NOISE
RING = np.exp(-300.0 * T[:200]) * np.sin(2 * np.pi * 900.0 * T[:200])
RATES = [11.0, 22.0, 17.0, 33.0]


def test_tones_and_the_rest_are_taken_apart() -> None:
    tones = np.sin(2 * np.pi * 60.0 * T) + 0.5 * np.cos(2 * np.pi * 121.3 * T + 1.0)
    count = round(T[-1] * 13.0)
    blows = np.zeros(T.size)
    # Their distances vary by 2 %, so that their places are forgotten after some.
    blows[np.rint(np.cumsum(1.0 + 0.02 * RNG.normal(size=count - 20)) / 13.0 * FS).astype(int)] = (
        10.0
    )
    slipping = np.convolve(blows, RING)[: T.size] + 0.3 * NOISE
    found, rest = spectra.separated(tones + slipping, FS, length=2000)
    np.testing.assert_allclose(found + rest, tones + slipping, atol=1e-12)
    assert np.std(found - tones) < 0.3 * np.std(slipping)
    assert np.std(rest - slipping) < 0.3 * np.std(slipping)
    alone, nothing = spectra.separated(tones, FS, length=2000)
    assert np.std(nothing[2000:-2000]) < 0.01
    assert np.std(spectra.separated(NOISE, FS, length=500)[0]) < 0.25
    assert not np.any(spectra.separated(np.zeros(1000), FS)[0])
    assert alone.shape == T.shape


@pytest.mark.parametrize("resonant", [False, True])
def test_coherence_is_that_of_the_swelling_and_of_no_filter(resonant: bool) -> None:
    x = 1e6 * np.convolve(SWELLING, RING)[: T.size] if resonant else SWELLING
    f, value = spectra.cyclic_coherence(x, RATES, FS, length=64)
    inside = (f > 100.0) & (f < 1900.0)
    mean = value[:, inside].mean(axis=1)
    assert mean[:2] == pytest.approx([4 / 9, 1 / 36], abs=0.02)
    # Pieces that lie half over each other are worth a little less than each by itself.
    pieces = 2 * T.size / 64
    assert mean[2:].max() < 2.0 / pieces
    found = spectra.improved_envelope_spectrum(x, RATES, FS, (100.0, 1900.0), length=64)
    assert found == pytest.approx(mean, rel=1e-9)
    assert spectra.improved_envelope_spectrum(x, 11.0, FS).shape == (1,)


def test_a_logarithm_sees_past_large_blows() -> None:
    """Twenty blows by chance, a hundred times as high as the noise, fill the squared envelope's spectrum."""
    x = (1.0 + 0.5 * np.cos(2 * np.pi * 11.0 * T)) * NOISE
    x[RNG.integers(0, T.size, 20)] += 100.0
    at = round(11.0 * T.size / FS)

    def over_median(value: np.ndarray) -> float:
        return float(value[at] / np.median(value[at - 200 : at + 200]))

    plain = spectra.squared_envelope_spectrum(x, FS)[1]
    f, value = spectra.log_envelope_spectrum(x, FS)
    assert f[at] == pytest.approx(11.0)
    assert over_median(plain) < 5.0
    assert over_median(value) > 30.0
    assert not np.any(spectra.log_envelope_spectrum(np.zeros(1000), FS)[1])


@pytest.mark.parametrize("share", [0.01, 0.1])
def test_noise_exceeds_the_limit_of_kurtosis_as_often_as_was_asked_for(share: float) -> None:
    above = [
        float(np.mean(value > limit))
        for seed in range(40)
        for x in (np.random.default_rng(seed).normal(size=30_000),)
        for _, value, limit in (spectra.spectral_kurtosis(x, FS, 256, share),)
    ]
    assert np.mean(above) == pytest.approx(share, rel=0.3)


def test_kurtosis_is_high_where_blows_ring_and_low_at_tones() -> None:
    blows = np.zeros(T.size)
    blows[RNG.integers(0, T.size - 200, 60)] = 5.0
    x = np.convolve(blows, RING)[: T.size] + 0.1 * NOISE + np.sin(2 * np.pi * 500.0 * T)
    f, value, limit = spectra.spectral_kurtosis(x, FS, 128)
    assert abs(float(f[np.argmax(value)]) - 900.0) < 100.0
    assert value.max() > 10.0 * limit
    assert value[np.argmin(np.abs(f - 500.0))] == pytest.approx(-1.0, abs=0.05)
    assert (f[0], f[-1]) == (FS / 128, FS / 2 - FS / 128)
    assert not np.any(spectra.spectral_kurtosis(np.ones(4000), FS)[1])


def test_bad_arguments_are_refused() -> None:
    short = NOISE[:20]
    calls: list[tuple[str, Callable[[], object]]] = [
        ("x", lambda: spectra.separated(short, FS)),
        ("x", lambda: spectra.cyclic_coherence(short, 11.0, FS)),
        ("x", lambda: spectra.spectral_kurtosis(short, FS)),
        ("length", lambda: spectra.separated(NOISE, FS, length=4)),
        ("length", lambda: spectra.cyclic_coherence(NOISE, 11.0, FS, length=NOISE.size)),
        ("length", lambda: spectra.spectral_kurtosis(NOISE, FS, NOISE.size // 4)),
        ("rates", lambda: spectra.cyclic_coherence(NOISE, [0.0], FS)),
        ("rates", lambda: spectra.improved_envelope_spectrum(NOISE, [math.nan], FS)),
        ("rates", lambda: spectra.cyclic_coherence(NOISE, [], FS)),
        ("band", lambda: spectra.improved_envelope_spectrum(NOISE, 11.0, FS, (3.0, 1.0))),
        ("band", lambda: spectra.improved_envelope_spectrum(NOISE, 11.0, FS, (1.0, 1.1))),
        ("false_alarm", lambda: spectra.spectral_kurtosis(NOISE, FS, false_alarm=0.5)),
    ]
    for name, call in calls:
        with pytest.raises(br.SceneError) as caught:
            call()
        assert caught.value.path == name
