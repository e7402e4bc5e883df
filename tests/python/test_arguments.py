"""What is no number, no row of numbers or no table is refused by the argument's name: found by ``tests/fuzz``."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import ballrace as br

X = np.sin(np.arange(1000.0))
FS = 12_000.0
spectra, measuring = br.spectra, br.measuring
RECORD = br.Recording(columns={"a": X}, fs=FS)
ORDERS = br.frequencies.orders(9, 7.94e-3, 39.04e-3)
SCENE = br.presets.deep_groove_6205()

CALLS: list[tuple[str, Callable[[Any], object], tuple[Any, ...]]] = [
    ("x", lambda x: spectra.spectrum(x, FS),
     (None, "x", 1j * X, X.astype(str), 1e70 * X, np.ma.masked_less(X, 0))),
    ("x", lambda x: br.features(x, FS), (None, X.tolist()[:3], 1j * X, [10**400] * 9)),
    ("x", lambda x: br.measure(x, fs=FS), (None, "x", 1j * X, X * 1e70)),
    ("fs", lambda fs: spectra.psd(X, fs), (None, "x", True, 0.0, math.nan, 1e-300, 1e300)),
    ("fs", lambda fs: br.measure(X, fs=fs), (None, "x", True, 0.0)),
    ("fs", lambda fs: br.Recording(columns={"a": X}, fs=fs), (None, "x", 0.0)),
    ("shaft", lambda f: br.Recording(columns={"a": X}, fs=FS, shaft=f), ("x", -1.0, math.inf)),
    ("band", lambda band: spectra.squared_envelope(X, FS, band), (5, "ab", (1.0,), (None, None), (2.0, 1.0))),
    ("hop", lambda hop: spectra.spectrogram(X[:8], FS, 8, hop), (8,)),
    ("near", lambda f: spectra.line(X, FS, f, 1.0), (None, "x", math.nan)),
    ("width", lambda f: spectra.line(X, FS, 10.0, f), (None, "x", math.nan, 0.0)),
    ("at", lambda f: spectra.floor(*spectra.spectrum(X, FS), f, 10.0), (None, "x", math.nan)),
    ("narrowest", lambda f: spectra.kurtogram(X, FS, f), ("x", math.nan, 0.0)),
    ("angle", lambda a: spectra.order_spectrum(X, a), (None, "x", {})),
    ("angle", lambda a: spectra.order_spectrum(X, a, 2), (1e-6 * np.arange(1000),)),
    ("per_turn", lambda n: spectra.by_order(X, 0.1 * np.arange(1000), n), ("x", 2.5, 1, True)),
    ("shaft", lambda f: spectra.fault_bands(ORDERS, f), (None, "x", 0.0)),
    ("slip", lambda s: spectra.fault_bands(ORDERS, slip=s), (None, "x", 0.5)),
    ("label", lambda label: RECORD.to_windows(8, label=label), (1, 2.5)),
    ("bearing_id", lambda name: RECORD.to_windows(8, bearing_id=name), (2.5, [1])),
    ("ball_count", lambda n: br.frequencies.orders(n, 1.0, 5.0), (None, "x", math.nan)),
    ("ball_diameter", lambda d: br.frequencies.orders(9, d, 1.0), (None, "x", math.nan, 1e-320)),
    ("contact_angle", lambda a: br.frequencies.orders(9, 1.0, 5.0, a), (None, "x", math.nan)),
    ("width_mm", lambda w: br.defects.spall(on="ball", width_mm=w), (None, "x", math.nan)),
    ("speed_rpm", lambda n: br.fault_frequencies("6205", n), (None, "x", math.nan)),
    ("radial_load", lambda f: br.bearing("6205", radial_load=f, speed_rpm=1800.0), ("x", [1.0], -1.0)),
    ("speed_rpm", lambda n: br.bearing("6205", speed_rpm=n), ("x", math.inf)),
    ("outer_rpm", lambda n: br.bearing("6205", outer_rpm=n), ("x", math.inf)),
    ("outer_rpm", lambda n: br.fault_frequencies("6205", 0.0, outer_rpm=n), ("x", math.nan)),
    ("axial_load", br.presets.wheel_bearing, (None, "x", math.nan)),
    ("lateral", br.presets.cornering_wheel, (None, "x", math.inf)),
    ("radial_load", br.presets.angular_contact_pair, (None, "x", math.inf)),
    ("arrangement", lambda a: br.presets.angular_contact_pair(arrangement=a), (None, "tandem", 1)),
    ("speed_rpm", lambda n: br.presets.deep_groove_6205(speed_rpm=n), (None, "x", math.nan)),
    ("logger.fs", lambda fs: br.measure(X, fs=1e-3, logger=measuring.Logger(fs=fs)), (12_000.0,)),
    ("fs", lambda t: br.measure(X, fs=FS, sensor=measuring.Sensor(lower_limit=t)), (1e-9,)),
    ("values", br.grid, (None, 1.0, {}, {"": [1.0]}, {1: [1.0]})),
    ("a", lambda column: br.grid({"a": column}), (1.0, "text", [], None)),
    ("ranges", lambda ranges: br.sobol(ranges, 2, seed=1), (None, 1.0, {}, {"": (0.0, 1.0)})),
    ("a", lambda pair: br.latin_hypercube({"a": pair}, 2, seed=1), ([], 1, (0.0, "x"), (-1e308, 1.7e308))),
    ("n", lambda n: br.sobol({"a": (0.0, 1.0)}, n, seed=1), (None, "x", 2.5, True, 0)),
    ("seed", lambda seed: br.latin_hypercube({"a": (0.0, 1.0)}, 2, seed=seed), (None, "x", 2.5, -1)),
    ("seed", lambda seed: br.scatter(SCENE, 2, seed=seed), (None, "x", 2.5, -1)),
    ("clearance", lambda d: br.scatter(SCENE, 2, seed=1, clearance=d), (None, "x", 1e308)),
    ("changes", SCENE.replace, (None, [], {"": 1.0}, {1: 1.0})),
]  # fmt: skip


@pytest.mark.parametrize(("path", "call", "values"), CALLS)
def test_what_is_unusable_is_named(
    path: str, call: Callable[[Any], object], values: tuple[Any, ...]
) -> None:
    for value in values:
        with pytest.raises(br.SceneError) as caught:
            call(value)
        assert caught.value.path == path
        assert caught.value.allowed


def test_numbers_of_any_kind_are_taken() -> None:
    """Those of numpy, whole ones, arrays of objects, in any order of bytes and memory."""
    wanted = spectra.spectrum(X, FS)[1]
    for x in (X.tolist(), X.astype(object), X.astype(">f8"), np.repeat(X, 2)[::2]):
        np.testing.assert_array_equal(spectra.spectrum(x, 12_000)[1], wanted)
    assert br.grid({"a": np.arange(3)}).height == br.grid({"a": range(3)}).height == 3
    assert br.sobol({"a": np.array([0.0, 1.0]).tolist()}, 2, seed=1).height == 2


def test_a_grid_holds_cells_of_any_kind() -> None:
    """A number beside a list, or beside a part of a scene, stays what it is."""
    ramp = br.scene.Ramp(from_=1.0, to=2.0, start=0.0, end=1.0)
    columns: tuple[list[Any], ...] = (
        [np.float32(1.0), [1.0]], [1.0, ramp], ["a", 1.0], [b"a", "a"], [1.0, {"a": 1}], [SCENE, None],
        [np.float32(1.0), SCENE], [1.0, 1j], [np.complex64(1j)], [np.longdouble(1.0)], [range(3), [1.0]],
    )  # fmt: skip
    for column in columns:
        assert br.grid({"a": column})["a"].to_list() == column


def test_the_kurtosis_of_a_faint_signal_is_that_of_a_loud_one() -> None:
    """Analytic: the kurtosis has no unit; the powers of a signal of 1e-160 vanish."""
    faint, loud = (spectra.kurtogram(scale * X, FS).kurtosis for scale in (1e-160, 1.0))
    np.testing.assert_allclose(faint, loud, rtol=1e-9, atol=1e-12)


def test_windows_of_a_campaign_want_chains(tmp_path: Path) -> None:
    done = br.campaign(
        [{"duration": 1e-3}], tmp_path, scene=SCENE, settle=0.0, keep="signals", progress=False
    )
    unusable: tuple[Any, ...] = (None, 5, [None], {})
    for chains in unusable:
        with pytest.raises(br.SceneError, match="at least one Chain") as caught:
            done.windows(chains, 8)
        assert caught.value.path == "chains"
    for length in (None, "x", 0, 2.5):
        with pytest.raises(br.SceneError) as caught:
            done.windows(measuring.Chain(), length)  # type: ignore[arg-type]
        assert caught.value.path == "length"


def test_a_description_that_is_no_text_is_refused(tmp_path: Path) -> None:
    (tmp_path / "campaign.json").write_bytes(b"\x80\x81")
    with pytest.raises(br.CampaignError, match="damaged, not the description of a campaign"):
        br.Campaign.open(tmp_path)


def test_a_name_that_no_file_can_have_is_refused(tmp_path: Path) -> None:
    """Such as one with a NUL, which TOML and JSON can bring along; nothing is written."""
    out = br.simulate(SCENE, duration=1e-3, settle=0.0)
    figure, cases = br.plot.section(br.bearing("6205", speed_rpm=1800.0)), [{"duration": 1e-3}]
    calls: dict[str, list[Callable[[Any], object]]] = {
        "path": [br.Scene.load, br.Signals.read_parquet, br.Signals.scan_parquet, br.read,
                 out.write, out.write_parquet, out.report, RECORD.write,
                 lambda path: br.plot.write(figure, path)],
        "out": [lambda path: br.simulate(SCENE, duration=1e-3, out=path),
                lambda path: br.campaign(cases, path, scene=SCENE)],
        "folder": [br.Campaign.open],
    }  # fmt: skip
    for name, takers in calls.items():
        for call in takers:
            for unusable in (tmp_path / "a\0.parquet", "\ud800.parquet", 3, b"a.parquet"):
                with pytest.raises(br.SceneError, match="the name of a") as caught:
                    call(unusable)
                assert caught.value.path == name
    assert not list(tmp_path.iterdir())
