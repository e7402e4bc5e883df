"""One interface of runs, measurements, recordings and arrays; units.

Truth: analytic for units; else the same numbers whichever way a signal is given.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import ballrace as br
from ballrace import spectra

FS = 8000.0
X = np.random.default_rng(1).normal(size=4096)
RECORD = br.Recording(columns={"a": 2.0 * X, "b": X}, fs=FS, units={"b": "g"}, shaft=25.0)
GIVEN: dict[str, br.channel.Recorded] = {
    "recording": br.Recording(columns={"b": X}, fs=FS),
    "channel": RECORD.channel("b"),
    "measurement": br.measuring.Measurement(x=X, fs=FS),
}
SPECTRA: dict[str, Any] = {
    "spectrum": spectra.spectrum, "psd": spectra.psd, "spectrogram": spectra.spectrogram,
    "squared_envelope": spectra.squared_envelope, "envelope_spectrum": spectra.envelope_spectrum,
    "squared_envelope_spectrum": spectra.squared_envelope_spectrum, "prewhitened": spectra.prewhitened,
    "line": lambda x, fs=None: spectra.line(x, fs, near=100.0, width=5.0),
    "comb": lambda x, fs=None: spectra.comb(x, fs, near=100.0, width=5.0)[1],
    "kurtogram": lambda x, fs=None: spectra.kurtogram(x, fs).kurtosis,
    "cyclic_coherence": lambda x, fs=None: spectra.cyclic_coherence(x, [50.0], fs),
    "improved_envelope_spectrum": lambda x, fs=None: spectra.improved_envelope_spectrum(x, [50.0], fs),
    "log_envelope_spectrum": spectra.log_envelope_spectrum, "separated": spectra.separated,
    "spectral_kurtosis": lambda x, fs=None: spectra.spectral_kurtosis(x, fs)[1],
    "features": lambda x, fs=None: list(br.features(x, fs).values()),
}  # fmt: skip


@pytest.mark.parametrize("given", GIVEN)
@pytest.mark.parametrize("name", SPECTRA)
def test_spectra_take_whatever_holds_a_signal(name: str, given: str) -> None:
    of_record, of_array = SPECTRA[name](GIVEN[given]), SPECTRA[name](X, FS)
    for ours, plain in zip(tuple(of_record), tuple(of_array), strict=True):
        assert np.array_equal(ours, plain)


@pytest.mark.parametrize("given", GIVEN)
def test_pictures_take_whatever_holds_a_signal(given: str) -> None:
    draw: Any
    for draw in (br.plot.psd, br.plot.envelope_spectrum, br.plot.spectrogram, br.plot.kurtogram):
        ours, plain = draw(GIVEN[given]), draw(X, fs=FS)
        assert np.array_equal(ours.data[0].x, plain.data[0].x)
    assert br.plot.impacts(GIVEN[given]).data
    angle = 2.0 * np.pi * 25.0 * np.arange(X.size) / FS
    assert br.plot.order_map(GIVEN[given], angle, highest=10.0).data
    if given != "recording":
        with pytest.raises(br.SceneError, match=r"^angle = 'inner.theta'"):
            br.plot.order_map(GIVEN[given])


def test_a_run_and_its_measurement_know_scene_speed_and_warnings() -> None:
    out = br.simulate(br.bearing("6205", speed_rpm=1797.0), duration=0.02)
    measured = br.measure(out)
    for record in (out, measured):
        channel = record.channel()
        assert channel.shaft == pytest.approx(29.95)
        assert channel.scene == out.scene
        assert channel.unit == "m/s^2"
    assert out.channel().warnings == out.warnings
    clipping = br.measuring.Measurement(x=X, fs=FS, clipped=0.1, range=1.0)
    assert "clipped" in clipping.channel().warnings[0]
    # Fault lines of a measured run are drawn as those of the run itself.
    assert len(br.plot.envelope_spectrum(measured).data) == len(br.plot.envelope_spectrum(out).data)


def test_units_are_those_of_the_field() -> None:
    """Truth: g is 9.80665 m/s²; a sine of amplitude a at f has the velocity a/(2πf)."""
    t = np.arange(80_000) / FS
    shaken = br.Channel(x=3.0 * np.sin(2 * np.pi * 160.0 * t), fs=FS, unit="g")
    assert shaken.to("m/s²").x.std() == pytest.approx(29.41995 / 2**0.5, rel=1e-9)
    assert shaken.to("mm/s").x.std() == pytest.approx(
        29.41995 / (2 * np.pi * 0.16 * 2**0.5), rel=1e-9
    )
    assert np.allclose(shaken.to("mm/s", band=(200.0, 1000.0)).x, 0.0, atol=1e-9)
    assert np.allclose(1e3 * shaken.to("mm/s").to("m/s").x, shaken.to("mm/s").x)
    for unit, wanted in (("g", "V"), ("", "g"), ("mm/s", "g")):
        with pytest.raises(br.SceneError, match="unit = "):
            br.Channel(x=X, fs=FS, unit=unit).to(wanted)
    with pytest.raises(br.SceneError, match="band = "):
        shaken.to("mm/s", band=(0.0, 1000.0))


def test_what_does_not_fit_is_refused_by_name() -> None:
    with pytest.raises(br.SceneError, match=r"fs = 1000\.0: left out: the record has 8000 Hz"):
        spectra.psd(RECORD, 1000.0)
    with pytest.raises(br.SceneError, match="fs = None"):
        spectra.psd(X)
    with pytest.raises(br.SceneError, match="near = nan"):
        spectra.line(RECORD)
    with pytest.raises(KeyError, match="no column 'c'"):
        RECORD.channel("c")
    with pytest.raises(KeyError, match="no column 'c'"):
        RECORD.channel("a").channel("c")
    assert RECORD.channel("b").channel("b").channel() is not None


def test_numbers_too_large_for_a_unit_are_refused() -> None:
    loud = br.Channel(x=np.array([0.0, 1e308]), fs=FS, unit="g")
    assert loud.to("g").x.max() == pytest.approx(1e308)
    with pytest.raises(br.SceneError, match=r"x = 1e\+308 g: numbers that are finite in m/s\^2"):
        loud.to("m/s^2")
    with pytest.raises(br.SceneError, match=r"x = 1e\+308 g: numbers that are finite in mm/s"):
        br.Channel(x=np.full(256, 1e308), fs=FS, unit="g").to("mm/s")


def test_a_name_of_a_column_is_text() -> None:
    names: Any = ["a"], ("a",), 3, {"a": 1}
    for name in names:
        with pytest.raises(br.SceneError, match=r"column = .*: the name of one, of a, b"):
            RECORD.channel(name)
        with pytest.raises(br.SceneError, match="column = "):
            br.diagnose(RECORD, "6205", 1800.0, column=name)
    with pytest.raises(KeyError, match="no column ''"):
        RECORD.channel("")
