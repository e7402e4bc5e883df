"""Envelope spectra and densities of signals for which a formula gives them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

import ballrace as br
from ballrace import spectra

if TYPE_CHECKING:
    from collections.abc import Callable


FS = 12_000.0
TIMES = np.arange(24_000) / FS
# 1 + m cos: lines of the envelope m; of its square, 1 + 2 m cos + m² cos², 2 m and m²/2.
DEPTH, SWING = 0.4, 25.0
TONE = (1.0 + DEPTH * np.cos(2.0 * np.pi * SWING * TIMES)) * np.cos(2.0 * np.pi * 3000.0 * TIMES)


@pytest.mark.parametrize("band", [None, (2000.0, 4000.0)])
def test_lines_of_a_modulated_tone_are_exact(band: tuple[float, float] | None) -> None:
    f, value = spectra.squared_envelope_spectrum(TONE, FS, band)
    at = [round(k * SWING / f[1]) for k in (1, 2)]
    assert value[at] == pytest.approx([2.0 * DEPTH, DEPTH**2 / 2.0], abs=1e-9)
    f, value = spectra.envelope_spectrum(TONE, FS, band, squared=False)
    assert value[at] == pytest.approx([DEPTH, 0.0], abs=1e-9)
    np.testing.assert_array_equal(
        spectra.envelope_spectrum(TONE, FS, band), spectra.squared_envelope_spectrum(TONE, FS, band)
    )


@pytest.mark.parametrize("length", [None, 256, 4001])
def test_a_density_integrates_to_the_variance(length: int | None) -> None:
    noise = 7.0 + 3.0 * np.random.default_rng(1).normal(size=200_000)
    f, value = spectra.psd(noise, FS, length)
    assert f[-1] == pytest.approx(FS / 2.0, rel=1e-3)
    assert np.sum(value) * f[1] == pytest.approx(9.0, rel=0.02)
    # White: the lower half of the frequencies has half of it.
    half = value[f < FS / 4.0]
    assert np.sum(half) * f[1] == pytest.approx(4.5, rel=0.03)


def test_a_tone_has_its_power_in_the_density() -> None:
    f, value = spectra.psd(2.0 * np.cos(2.0 * np.pi * 1000.0 * TIMES), FS, 1200)
    assert np.sum(value) * f[1] == pytest.approx(2.0, rel=1e-6)
    assert f[np.argmax(value)] == pytest.approx(1000.0)


def test_a_chirp_rises_through_the_spectrogram() -> None:
    rise = 1500.0
    chirp = np.sqrt(2.0) * np.cos(2.0 * np.pi * (500.0 + rise / 2.0 * TIMES) * TIMES)
    f, t, value = spectra.spectrogram(chirp, FS, length=400, hop=100)
    assert value.shape == (f.size, t.size)
    assert f[1] == pytest.approx(FS / 400)
    assert np.diff(t) == pytest.approx(100 / FS)
    # No window reaches beyond the record.
    assert (t[0], t[-1]) == pytest.approx((200 / FS, 2.0 - 200 / FS), abs=1e-9)
    highest = f[np.argmax(value, axis=0)]
    assert np.abs(highest - (500.0 + rise * t)).max() < f[1]
    # The power of a tone of amplitude √2 at every time.
    assert value.sum(axis=0) * f[1] == pytest.approx(1.0, rel=1e-3)


def test_bad_arguments_are_refused() -> None:
    x = np.ones(100)
    calls: list[tuple[str, Callable[[], object]]] = [
        ("x", lambda: spectra.psd("signal", FS)),
        ("x", lambda: spectra.spectrogram(np.ones((10, 10)), FS)),
        ("fs", lambda: spectra.psd(x, 0.0)),
        ("length", lambda: spectra.psd(x, FS, 101)),
        ("length", lambda: spectra.psd(x, FS, 10.5)),  # type: ignore[arg-type]
        ("length", lambda: spectra.spectrogram(x, FS, 2)),
        ("hop", lambda: spectra.spectrogram(x, FS, 20, 0)),
        ("hop", lambda: spectra.spectrogram(x, FS, 20, 21)),
        ("band", lambda: spectra.envelope_spectrum(x, FS, (0.0, FS))),
    ]
    for name, call in calls:
        with pytest.raises(br.SceneError) as caught:
            call()
        assert caught.value.path == name
