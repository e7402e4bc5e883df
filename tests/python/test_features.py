"""Features, spectra and orders are coded once; here they meet independent formulas, each other and a campaign."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
import scipy.signal
import scipy.stats

import ballrace as br
from ballrace import frequencies, spectra
from ballrace.scene import ContactsProbe, TorqueDrive

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from numpy.typing import NDArray

FS = 12_000.0
LENGTHS = [8, 9, 64, 1000, 6001, 7919, 50_000]


def noise(samples: int) -> NDArray[np.float64]:
    """Noise that stands high above zero, with a line."""
    t = np.arange(samples) / FS
    return 3.0 + np.random.default_rng(samples).normal(size=samples) + np.sin(1234.5 * t)


def assert_same(found: NDArray[np.float64], wanted: NDArray[np.float64]) -> None:
    np.testing.assert_allclose(found, wanted, rtol=0.0, atol=1e-12 * np.abs(wanted).max())


@pytest.mark.parametrize("samples", LENGTHS)
def test_squared_envelope_is_that_of_scipys_analytic_signal(samples: int) -> None:
    x = noise(samples)
    assert_same(spectra.squared_envelope(x, FS), np.abs(scipy.signal.hilbert(x)) ** 2)
    lines, f = np.fft.fft(x), np.abs(np.fft.fftfreq(samples, 1.0 / FS))
    in_band = np.fft.ifft(np.where((f >= 1510.0) & (f <= 3990.0), lines, 0.0)).real
    found = spectra.squared_envelope(x, FS, band=(1510.0, 3990.0))
    assert_same(found, np.abs(scipy.signal.hilbert(in_band)) ** 2)


@pytest.mark.parametrize("samples", LENGTHS)
def test_spectrum_is_numpys_under_a_hann_window(samples: int) -> None:
    x = noise(samples)
    window = np.sin(np.pi * (np.arange(samples) + 0.5) / samples) ** 2
    window /= window.sum()
    value = 2.0 * np.abs(np.fft.rfft(window * (x - np.sum(window * x))))
    f, found = spectra.spectrum(x, FS)
    assert_same(found, value)
    np.testing.assert_allclose(f, np.arange(samples // 2 + 1) * FS / samples, rtol=1e-14)


def test_plans_of_many_lengths_are_kept_and_dropped() -> None:
    # More samples than plans are kept of, and then the first length again.
    for samples in (600_000, 500_000, 400_000, 1000, 600_000):
        x = noise(samples)
        assert_same(spectra.squared_envelope(x, FS)[:50], np.abs(scipy.signal.hilbert(x)[:50]) ** 2)


@pytest.mark.parametrize("samples", LENGTHS)
def test_moments_are_scipys(samples: int) -> None:
    x = noise(samples)
    rms, peak = math.sqrt(np.mean(x**2)), np.abs(x).max()
    wanted = {
        "rms": rms,
        "peak": peak,
        "crest_factor": peak / rms,
        "kurtosis": scipy.stats.kurtosis(x, fisher=False),
    }
    assert br.features(x, FS) == pytest.approx(wanted, rel=1e-12)


def test_orders_are_those_of_the_formula() -> None:
    gamma = 11.906 * math.cos(0.23) / 60.0
    found = frequencies.orders(13, 11.906, 60.0, 0.23)
    assert found.ftf == pytest.approx((1.0 - gamma) / 2.0, rel=1e-12)
    assert found.bpfo == pytest.approx(13 * (1.0 - gamma) / 2.0, rel=1e-12)
    assert found.bpfi == pytest.approx(13 * (1.0 + gamma) / 2.0, rel=1e-12)
    assert found.bsf == pytest.approx((60.0 / 11.906 - gamma * math.cos(0.23)) / 2.0, rel=1e-12)


def test_arrays_of_any_kind() -> None:
    x = noise(1000)
    wide = np.stack([x, x], axis=1)
    for other in (list(x), wide[:, 0], x.astype(np.longdouble)):
        np.testing.assert_array_equal(
            spectra.squared_envelope(other, FS), spectra.squared_envelope(x, FS)
        )
        assert br.features(other, FS) == br.features(x, FS)


def test_a_run_an_array_and_a_campaign_say_the_same(tmp_path: Path) -> None:
    probe = ContactsProbe(row=0, quantities=("load",))
    scene = br.presets.deep_groove_6205().replace({"probes.all": probe})
    run: Any = {"duration": 0.1, "fs": FS}
    chosen: Any = {"skip": 0.01, "band": (500.0, 5000.0)}
    out = br.simulate(scene, **run)
    found = out.features(contact_loads=True, **chosen)
    done = br.campaign(
        [{"loads.radial.force": 500.0}], tmp_path / "c", scene=scene, progress=False,
        contact_loads=True, **run, **chosen,
    )  # fmt: skip
    (row,) = done.manifest.to_dicts()
    assert "row0.inner.load_min" in found
    assert found["outer.ay.row0.bpfo_envelope_harmonics"] is not None
    # 2.7 turns are 9.7 passes, so that errors are of 9 batches.
    assert found["batches"] == 9.0
    assert found["turns"] == pytest.approx(2.7, rel=1e-3)
    assert found["row0.passes"] == pytest.approx(9.7, rel=0.01)
    # The manifest leaves out what no case has.
    assert found == {name: row.get(name) for name in found}
    loads = [out[f"all.ball{i}.outer.load"][120:] for i in range(9)]
    assert found["row0.outer.load_max"] == np.max(loads)

    # An array knows nothing of how the balls went round, and takes them to roll at the nominal angle.
    alone = br.features(out["outer.ay"], FS, name="outer.ay", scene=scene, **chosen)
    of_column = {name: value for name, value in found.items() if name.startswith("outer.ay.")}
    extent = ["turns", "row0.passes", "batches"]
    assert list(alone) == [*of_column, *extent]
    # Its batches are cut by other passes, too.
    own = [name for name in of_column if "row0." not in name and not name.endswith("_se")]
    assert [alone[name] for name in own] == [of_column[name] for name in own]
    short = br.simulate(scene, duration=0.03, fs=FS, settle=0.0)
    column = short.features(columns="outer.ay")
    column.pop("largest_pressure")
    assert column["batches"] == 0
    assert br.features(short["outer.ay"], FS, name="outer.ay", scene=scene) == column
    unnamed = br.features(out["outer.ay"], FS, scene=scene, **chosen)
    assert [name for name in unnamed if not name.endswith("_se")][:5] == [
        "rms", "peak", "crest_factor", "kurtosis", "row0.ftf",
    ]  # fmt: skip
    out.write_parquet(tmp_path / "out.parquet")
    again = br.Signals.read_parquet(tmp_path / "out.parquet")
    assert again.features(contact_loads=True, **chosen) == found
    assert list(out.features(columns="outer.ay")) == [*alone, "largest_pressure"]


def test_what_a_signal_cannot_give_is_none() -> None:
    scene = br.presets.deep_groove_6205()
    found = br.features(np.zeros(100), FS, scene=scene)
    assert found["rms"] == 0.0
    assert found["kurtosis"] is None
    assert found["row0.bpfo"] is None
    driven = scene.replace({"drive": TorqueDrive(value=0.1)})
    assert br.features(noise(12_000), FS, scene=driven)["row0.bpfo"] is None


def test_bad_arguments_are_refused() -> None:
    x = np.ones(100)
    out = br.simulate(br.presets.deep_groove_6205(), duration=1e-3, start="rolling", settle=0.0)
    calls: list[tuple[str, Callable[[], object]]] = [
        ("x", lambda: br.features(np.ones((3, 3)), FS)),
        ("fs", lambda: br.features(x, 0.0)),
        ("scene", lambda: br.features(x, FS, scene="6205")),  # type: ignore[arg-type]
        ("skip", lambda: br.features(x, FS, skip=1.0)),
        ("band", lambda: br.features(x, FS, band=(0.0, 1e9))),
        ("band", lambda: out.features(band=(5.0, 2.0))),
        ("skip", lambda: out.features(skip=1e-3)),
        ("columns", lambda: out.features(columns=["outer.jerk"])),
        ("contact_loads", lambda: out.features(contact_loads=True)),
    ]
    for path, call in calls:
        with pytest.raises(br.SceneError) as caught:
            call()
        assert caught.value.path == path


def spalled(start_angle: float) -> br.Scene:
    """Return a 6205 with a spall of 1 mm, which is met by balls that all start a little later."""
    scene = br.bearing(
        "6205", radial_load=1500.0, speed_rpm=1800.0,
        defects=br.defects.spall(on="outer_race", width_mm=1.0, length_mm=2.0),
    )  # fmt: skip
    return scene.replace({"rows[0].start_angle": start_angle})


def test_errors_are_what_records_of_another_start_differ_by(tmp_path: Path) -> None:
    """Statistical: of 20 starts 1e-13 rad apart, records of 10 passes share nothing but their statistics."""
    table = [{"rows[0].start_angle": 1e-13 * k} for k in range(20)]
    done = br.campaign(
        table, tmp_path / "c", scene=spalled(0.0), duration=0.1, columns="outer.ay", progress=False
    )
    manifest = done.manifest
    assert (manifest["batches"] == 10).all()
    for name in ("rms", "peak", "kurtosis", "row0.bpfo_envelope", "row0.bpfo_envelope_harmonics"):
        values = manifest[f"outer.ay.{name}"].to_numpy()
        errors = manifest[f"outer.ay.{name}_se"].to_numpy()
        ratio = np.median(errors) / np.std(values, ddof=1)
        # Chance: the deviation of 20 is good to 16 %.
        assert 0.45 < ratio < 2.2, (name, ratio)


def test_a_record_that_is_too_short_says_so(tmp_path: Path) -> None:
    """20 ms are 0.6 turns and 2.1 passes: there are no errors, and the manifest drops their columns."""
    scene = spalled(0.0)
    found = br.simulate(scene, duration=0.02, settle=0.0).features(columns="outer.ay")
    assert found["turns"] == pytest.approx(0.6)
    assert found["row0.passes"] == pytest.approx(2.15, abs=0.02)
    assert found["batches"] == 0
    assert found["outer.ay.rms_se"] is found["outer.ay.row0.bpfo_envelope_se"] is None
    run: Any = {"scene": scene, "columns": "outer.ay", "settle": 0.0, "progress": False}
    short = br.campaign([{"duration": 0.02}], tmp_path / "short", **run).manifest
    assert short["batches"].to_list() == [0]
    assert not [name for name in short.columns if name.endswith("_se")]
    # One longer case is enough for the columns; of the others they stay empty.
    mixed = br.campaign([{"duration": 0.02}, {"duration": 0.08}], tmp_path / "m", **run).manifest
    assert mixed["batches"].to_list() == [0, 8]
    assert mixed["outer.ay.rms_se"].is_null().to_list() == [True, False]


def test_a_speed_that_changes_leaves_no_errors() -> None:
    """A run-up has lines over the angle, but no statistics of its own."""
    drive = br.scene.SpeedDrive(br.scene.Ramp(from_=100.0, to=200.0, start=0.0, end=1.0))
    x = noise(12_000)
    scene = br.presets.deep_groove_6205()
    found = br.features(x, FS, scene=scene.replace({"drive": drive}))
    assert found["turns"] == pytest.approx(150.0 / math.tau, rel=1e-3)
    assert found["batches"] == 0
    assert found["row0.bpfo"] is not None
    assert found["row0.bpfo_se"] is None
    turned = br.features(x, FS, scene=scene.replace({"drive": TorqueDrive(value=1.0)}))
    assert (turned["turns"], turned["row0.passes"], turned["batches"]) == (None, None, 0)
    assert "rms_se" not in br.features(x, FS)
