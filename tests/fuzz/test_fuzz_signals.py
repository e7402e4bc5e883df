"""Any array ends in a finite result of the documented shape, or one typed error."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import hypothesis.strategies as st
import numpy as np
import polars as pl
from hypothesis.strategies import DrawFn

import ballrace as br
from budget import decided, fuzzed

spectra, measuring = br.spectra, br.measuring

VALUES = (
    0.0,
    -0.0,
    1.0,
    -1.0,
    1e-3,
    5e-324,
    1e-160,
    1e-30,
    1e30,
    1e80,
    1e160,
    -1.7976931348623157e308,
)
BAD = (math.nan, math.inf, -math.inf)
ODD: tuple[Any, ...] = (
    None,
    "x",
    [],
    {},
    1.0,
    True,
    object(),
    [[1.0, 2.0], [3.0]],
    ["a"] * 9,
    [None] * 9,
    b"xxxxxxxx",
    1j,
)
RATES = st.sampled_from(
    (12_000.0, 48_000, 1.0, 1e-300, 1e300, 0.0, -1.0, math.nan, math.inf, None, "x", True)
)
USUAL = st.one_of(*[st.just(12_000.0)] * 4, RATES)


def _signal(draw: DrawFn) -> Any:
    kind = draw(st.integers(0, 15))
    if kind == 0:
        return draw(st.sampled_from(ODD))
    n = draw(st.sampled_from((4096, 1000, 257, 256, 100, 64, 16, 9, 8, 7, 2, 1, 0)))
    rng = np.random.default_rng(draw(st.integers(0, 99)))
    match kind:
        case 1:
            x = np.full(n, draw(st.sampled_from(VALUES)))
        case 2:
            x = rng.choice(np.array(VALUES), size=n)
        case 3:
            x = np.where(rng.random(n) < 0.1, draw(st.sampled_from(BAD)), 1.0)
        case 4:
            x = np.sin(0.3 * np.arange(n)) * draw(st.sampled_from(VALUES))
        case 5:
            x = np.zeros(n)
            x[n // 2 : n // 2 + 1] = draw(st.sampled_from(VALUES))
        case _:
            x = rng.normal(size=n) * draw(st.sampled_from((1.0, 1.0, 1e-9, 1e9)))
    return _shape(draw, x)


def _shape(draw: DrawFn, x: Any) -> Any:
    """Return an array as another type, in another order, or of another shape."""
    match draw(st.integers(0, 20)):
        case 0:
            kind = draw(st.sampled_from((np.float32, np.float16, complex, object, str, bool)))
            with np.errstate(over="ignore", under="ignore"):
                return x.astype(kind)
        case 1:
            return np.nan_to_num(np.clip(x, -1e9, 1e9)).astype(np.int64)
        case 2:
            return np.repeat(x, 2)[::2]
        case 3:
            return x[::-1]
        case 4:
            return x[:, None] if x.size else x.reshape(0, 3)
        case 5:
            return x.tolist()
        case 6:
            return x.astype(">f8")
        case 7:
            return np.ma.masked_array(x, mask=np.arange(x.size) % 3 == 0)
        case 8:
            x.flags.writeable = False
    return x


def signals() -> st.SearchStrategy[Any]:
    """Arrays and what is none."""
    return st.composite(_signal)()


BANDS = st.one_of(
    st.none(),
    st.sampled_from(((100.0, 3000.0), (0.0, 6000.0), (500.0, 501.0))),
    st.sampled_from(
        ((3000.0, 100.0), (math.nan, 1.0), (1.0,), "ab", 5, (0.0, 1e-320), (), (None, None))
    ),
)
LENGTHS = st.one_of(
    st.sampled_from((None, 2, 8, 64)),
    st.sampled_from((None, 2, 3, 100)),
    st.sampled_from((None, 1, 4, 0, -1, 10**9, 2.5, math.nan, "x", True, np.int64(8))),
)
COUNTS = st.one_of(st.sampled_from((1, 2, 3)), st.sampled_from((1, 2, 3)), LENGTHS)
USEFUL = st.sampled_from((0.0, 1.0, 30.0, 50.0, 3000.0))
ODD_NUMBERS = st.sampled_from(
    (-1.0, 6000.0, 1e-320, 1e300, math.nan, math.inf, None, "x", True, [1.0])
)
NUMBERS = st.one_of(USEFUL, USEFUL, USEFUL, ODD_NUMBERS)
SCENES = st.sampled_from((None, br.presets.deep_groove_6205(), br.presets.wheel_bearing(), "x"))
ORDERS = br.frequencies.orders(9, 7.94e-3, 39.04e-3)


def numbers_of(found: Any) -> list[Any]:
    """Return the arrays and numbers of a result."""
    if isinstance(found, tuple | list):
        return [each for part in found for each in numbers_of(part)]
    if isinstance(found, dict):
        return numbers_of([value for value in found.values() if value is not None])
    return [np.asarray(found, dtype=np.float64)]


def finite(found: Any, name: str) -> str:
    """Check that a result holds finite numbers, and say what became of the call."""
    if isinstance(found, br.BallraceError):
        return f"{name}: {type(found).__name__}"
    for each in numbers_of(found):
        assert np.isfinite(each).all(), f"{name}: {each}"
    return f"{name}: ok"


def same_length(found: Any, n: int) -> None:
    if isinstance(found, np.ndarray):
        assert found.shape == (n,)


SPECTRA: dict[str, Callable[..., Any]] = {
    "spectrum": lambda x, fs, **_: spectra.spectrum(x, fs),
    "psd": lambda x, fs, length, **_: spectra.psd(x, fs, length),
    "spectrogram": lambda x, fs, length, hop, **_: spectra.spectrogram(x, fs, length, hop),
    "squared_envelope": lambda x, fs, band, **_: spectra.squared_envelope(x, fs, band),
    "envelope_spectrum": lambda x, fs, band, **_: spectra.envelope_spectrum(x, fs, band, squared=False),
    "line": lambda x, fs, a, b, **_: spectra.line(x, fs, a, b),
    "comb": lambda x, fs, a, b, **_: spectra.comb(x, fs, a, b),
    "floor": lambda x, fs, a, b, **_: spectra.floor(*spectra.spectrum(x, fs), a, b),
    "features": lambda x, fs, band, a, **_: br.features(x, fs, band=band, skip=a),
    "features of a scene": lambda x, fs, band, scene, **_: br.features(x, fs, band=band, scene=scene),
}  # fmt: skip


@fuzzed(
    name=st.sampled_from(sorted(SPECTRA)), x=signals(), fs=USUAL, band=BANDS, length=LENGTHS, hop=LENGTHS,
    a=NUMBERS, b=NUMBERS, scene=SCENES,
)  # fmt: skip
def test_any_array_has_a_spectrum_or_is_refused(name: str, **example: Any) -> str:
    return finite(decided(lambda: SPECTRA[name](**example)), name)


@fuzzed(x=signals(), fs=USUAL, narrowest=st.one_of(st.none(), st.none(), NUMBERS))
def test_any_array_has_a_kurtogram_or_is_refused(x: Any, fs: Any, narrowest: Any) -> str:
    found = decided(lambda: spectra.kurtogram(x, fs, narrowest))
    if isinstance(found, spectra.Kurtogram):
        low, high = found.best
        assert 0.0 <= low < high <= fs / 2.0 * (1.0 + 1e-12)
        return finite([found.level, found.low, found.high, found.kurtosis], "kurtogram")
    return type(found).__name__


@fuzzed(x=signals(), angle=signals(), rising=st.booleans(), per_turn=LENGTHS)
def test_any_array_goes_over_the_angle_or_is_refused(
    x: Any, angle: Any, rising: bool, per_turn: Any
) -> str:
    if rising and isinstance(x, np.ndarray) and x.ndim == 1:
        angle = 0.05 * np.arange(x.size) + 1e-6 * np.arange(x.size) ** 2
    return finite(decided(lambda: spectra.order_spectrum(x, angle, per_turn)), "order_spectrum")


@fuzzed(
    x=signals(),
    fs=USUAL,
    shaft=NUMBERS,
    harmonics=COUNTS,
    sidebands=COUNTS,
    slip=st.one_of(st.just(0.01), NUMBERS),
)
def test_any_spectrum_has_bands_or_is_refused(
    *, x: Any, fs: Any, shaft: Any, harmonics: Any, sidebands: Any, slip: Any
) -> str:
    if 10**9 in (harmonics, sidebands):
        harmonics = sidebands = 50
    bands = decided(
        lambda: spectra.fault_bands(ORDERS, shaft, harmonics=harmonics, sidebands=sidebands, slip=slip)
    )  # fmt: skip
    if isinstance(bands, br.BallraceError):
        return "no bands"
    found = decided(lambda: spectra.fault_band_metrics(*spectra.spectrum(x, fs), bands))
    if isinstance(found, dict):
        return finite([[m.peak, m.frequency, m.power] for m in found.values()], "bands")
    return type(found).__name__


@fuzzed(
    x=signals(), fs=USUAL, shaft=NUMBERS, length=LENGTHS, hop=LENGTHS,
    label=st.sampled_from((None, "a", 1)), bearing=st.sampled_from((None, "a", 1, 2.5)),
)  # fmt: skip
def test_any_array_is_a_recording_with_windows_or_is_refused(
    *, x: Any, fs: Any, shaft: Any, length: Any, hop: Any, label: Any, bearing: Any
) -> str:
    record = decided(lambda: br.Recording(columns={"a": x}, fs=fs, shaft=shaft))
    if not isinstance(record, br.Recording):
        return "refused"
    if length == 10**9 or hop == 10**9:
        length = None
    found = decided(lambda: record.to_windows(length, hop, label=label, bearing_id=bearing))
    if isinstance(found, br.BallraceError):
        return "no windows"
    step = length if hop is None else hop
    assert found.height == (record.n_samples - length) // step + 1
    assert found["a"].dtype == pl.Array(pl.Float32, int(length))
    return "windows"


CHAINS = st.builds(
    lambda path, fs, bits, reach, density: measuring.Chain(
        path=measuring.random_housing(seed=1) if path else None,
        sensor=measuring.Sensor(resonance=25_000.0),
        machine=measuring.Machine(noise_density=density),
        logger=measuring.Logger(fs=fs, range=reach, bits=bits),
    ),
    path=st.booleans(),
    fs=st.sampled_from((12_000.0, 1000.0, 100.0)),
    bits=st.sampled_from((8, 16, 24)),
    reach=st.sampled_from((1e-3, 50.0, 1e6, None)),
    density=st.sampled_from((0.0, 1e-3)),
)


@fuzzed(x=signals(), fs=st.sampled_from((12_000.0, 48_000.0, 1e-3, 0.0, None)), chain=CHAINS)
def test_any_array_is_measured_or_refused(x: Any, fs: Any, chain: Any) -> str:
    found = decided(lambda: br.measure(x, chain, fs=fs, seed=1))
    if isinstance(found, br.BallraceError):
        return type(found).__name__
    return finite(found.x, "measured")


CALLS: dict[str, Callable[..., Any]] = {
    "orders": lambda a, b, c, d: vars(br.frequencies.orders(a, b, c, d)),
    "spall": lambda a, b, c, _: br.defects.spall(on="ball", width_mm=a, length_mm=b, depth_mm=c).length,
    "dent": lambda a, b, *_: br.defects.dent(on="outer_race", diameter_mm=a, edge_radius_mm=b).length,
    "6205": lambda a, b, c, _: br.presets.deep_groove_6205(a, b, c).gravity,
    "wheel": lambda a, *_: br.presets.wheel_bearing(a).gravity,
    "curve": lambda a, *_: br.presets.cornering_wheel(a).gravity,
    "bearing": lambda a, b, c, _: br.bearing("6205", radial_load=a, axial_load=b, speed_rpm=c).gravity,
    "fault_frequencies": lambda a, *_: [br.fault_frequencies("6205", a).bpfo],
    "oil": lambda a, *_: [br.scene.Lubricant.named("vg68", temperature_c=a).properties().viscosity],
}  # fmt: skip


@fuzzed(name=st.sampled_from(sorted(CALLS)), numbers=st.tuples(NUMBERS, NUMBERS, NUMBERS, NUMBERS))
def test_any_number_is_taken_or_refused(name: str, numbers: tuple[Any, ...]) -> str:
    return finite(decided(lambda: CALLS[name](*numbers)), name)
