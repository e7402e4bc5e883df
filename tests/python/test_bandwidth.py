"""Signals are filtered before they are sampled: what is above half the rate does not fold into what is below."""

from __future__ import annotations

import warnings
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import pytest
from scipy import signal

import ballrace as br
from ballrace.cli import main

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

# Half the length of the filter in samples, and the attenuation for which its window is made [dB].
HALF, ATTENUATION = 14, 84.0
DURATION = 0.012
FS = 12_000.0
COLUMNS = ("outer.y", "outer.vy", "outer.ay")
AXES: tuple[br.scene.Component, ...] = ("y", "vy", "ay")


@pytest.fixture(scope="module")
def spalled() -> br.Scene:
    """A 6205 with a spall of the outer race below, which rings far above 6 kHz."""
    spall = replace(br.presets.wheel_bearing().defects["spall"], axial_offset=0.0)
    probes = {"outer": br.scene.MotionProbe(body="outer", components=AXES)}
    # One motion at all rates.
    changes = {"defects": {"spall": spall}, "probes": probes, "solver.rtol": 1e-7}
    return br.presets.deep_groove_6205().replace(changes)


@pytest.fixture(scope="module")
def fine(spalled: br.Scene) -> br.Signals:
    """Point samples at a hundred times the rate, and on for what the filter takes from beyond the end."""
    duration = DURATION + 1.5 * HALF / FS
    return br.simulate(spalled, duration=duration, fs=100 * FS, threads=1, bandwidth=None)


def by_scipy(x: NDArray[np.float64], factor: int) -> NDArray[np.float64]:
    """Decimate by scipy's own filter; the first `HALF` samples lack what was before them."""
    window = ("kaiser", signal.kaiser_beta(ATTENUATION))
    taps = signal.firwin(2 * HALF * factor - 1, 0.5 / factor, window=window, fs=1.0)
    return np.convolve(x, taps)[HALF * factor - 1 :: factor]


def rms(x: NDArray[np.float64]) -> float:
    return float(np.sqrt(np.mean(x**2)))


def test_a_run_equals_one_decimated_by_scipy(spalled: br.Scene, fine: br.Signals) -> None:
    """Independent: point samples at 1.2 MHz through scipy's low-pass, to what 0.004 dB leave; without delay.

    The accelerations are the model's there, and derivatives of velocities here. Point samples at 12 kHz are off by
    several times the signal.
    """
    out = br.simulate(spalled, duration=DURATION, fs=FS, threads=1)
    points = br.simulate(spalled, duration=DURATION, fs=FS, threads=1, bandwidth=None)
    for column in COLUMNS:
        truth = by_scipy(fine[column], 100)[: out.t.size]
        size = float(truth[HALF:].std())
        # The end is fed by the motion beyond it.
        assert rms((out[column] - truth)[HALF:]) < 2e-3 * size, column
        if column == "outer.ay":
            assert rms((points[column] - truth)[HALF:]) > 0.5 * size


def test_nothing_folds(spalled: br.Scene, fine: br.Signals) -> None:
    """Analytic: most of the power lies above fs/2; point samples hold all of it, ours a millionth."""
    x = fine["outer.ay"][100 * HALF : int(100 * FS * DURATION)]
    frequency, density = signal.welch(x, fine.fs, nperseg=8192)
    assert density[frequency > FS / 2.0].sum() > 0.6 * density.sum()
    bandwidths: tuple[Literal["auto"] | None, ...] = (None, "auto")
    points, out = (
        br.simulate(spalled, duration=DURATION, fs=FS, threads=1, bandwidth=bandwidth)["outer.ay"]
        for bandwidth in bandwidths
    )
    assert points[HALF:].var() == pytest.approx(x.var(), rel=0.3)
    folded = (out - by_scipy(fine["outer.ay"], 100)[: out.size])[HALF:-HALF]
    assert rms(folded) ** 2 < 1e-6 * x.var()


@pytest.mark.parametrize("fs", [FS, 50_000.0])
def test_effort_and_readings_do_not_change(spalled: br.Scene, fs: float) -> None:
    """Analytic: the filter takes no step; states are read at their instants, to the bit."""
    scene = spalled.replace(
        {
            "probes": {
                **spalled.probes,
                "energy": br.scene.EnergyProbe(),
                "contacts": br.scene.ContactsProbe(balls=(0,)),
                "forces": br.scene.ForcesProbe(body="outer"),
            }
        }
    )
    out = br.simulate(scene, duration=2e-3, fs=fs, threads=1)
    points = br.simulate(scene, duration=2e-3, fs=fs, threads=1, bandwidth=None)
    # A filtered record has less of what accelerations differ by from the rates of velocities.
    own = {"wall_time", "nfev_past_end", "acceleration_residual"}
    assert 0.0 < out.stats.acceleration_residual < points.stats.acceleration_residual
    assert {k: v for k, v in out.stats.items() if k not in own} == {
        k: v for k, v in points.stats.items() if k not in own
    }
    assert out.stats.nfev_past_end > 0
    assert points.stats.nfev_past_end == 0
    for column in out:
        same = np.array_equal(out[column], points[column], equal_nan=True)
        assert same != column.startswith("outer."), column


def test_provenance_has_the_band(spalled: br.Scene) -> None:
    """Analytic: the band up to which signals are faithful, and the points read a sample; none without a filter."""

    def band_of(fs: float, bandwidth: Any) -> tuple[float | None, int]:
        out = br.simulate(spalled, duration=1e-3, fs=fs, threads=1, bandwidth=bandwidth)
        return out.provenance.bandwidth, out.provenance.oversampling

    # As long as the others: in a tenth of it no ball may have touched the spall, which is warned of.
    # Dormand–Prince's cap is one over the highest contact frequency.
    highest = br.simulate(spalled, duration=1e-3, method="dormand-prince")
    rate = 1.0 / highest.provenance.max_step
    assert band_of(FS, "auto") == (0.4 * FS, int(np.ceil(rate / FS)))
    assert band_of(FS, None) == (None, 1)
    assert band_of(1e6, "auto") == (0.5e6, 1)
    with pytest.raises(br.SceneError, match="bandwidth"):
        band_of(FS, "wide")


def test_the_last_samples_are_those_of_a_longer_run(spalled: br.Scene) -> None:
    """Limit: a run goes on past its end, so its end does not show."""
    short, long = (
        br.simulate(spalled, duration=duration, threads=1)["outer.ay"] for duration in (6e-3, 8e-3)
    )
    apart = short - long[: short.size]
    assert np.max(np.abs(apart)) < 1e-2 * long.std()


def test_point_samples_are_points(spalled: br.Scene) -> None:
    """Analytic: without a filter a sample does not depend on the rate, to the bit."""
    slow, fast = (
        br.simulate(spalled, duration=2e-3, fs=fs, threads=1, bandwidth=None)
        for fs in (50_000.0, 100_000.0)
    )
    assert all(np.array_equal(slow[column], fast[column][::2]) for column in COLUMNS)


def test_threads_give_the_same_bits() -> None:
    """Analytic: the filter is no matter of threads."""
    scene = br.presets.wheel_bearing(3000.0)
    one, two = (br.simulate(scene, duration=5e-4, threads=n) for n in (1, 2))
    assert all(np.array_equal(one[column], two[column]) for column in one)


def test_a_defect_above_the_band_is_reported() -> None:
    """Analytic: the line of the wheel bearing's spall is at 157 Hz; of a ball it is twice its spin."""
    scene = br.presets.wheel_bearing()
    line = br.frequencies.of_row(scene.rows[0]).at(30.0).bpfo
    with pytest.warns(br.SceneWarning, match=r"defects\.spall.*157\.\d Hz"):
        br.simulate(scene, duration=0.01, fs=1.99 * line)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        br.simulate(scene, duration=0.01, fs=2.01 * line)
        br.simulate(scene.replace({"defects": {}}), duration=0.01, fs=line)
        br.simulate(scene.replace({"defects.spall.width": 0.0}), duration=0.01, fs=line)


def test_a_slow_rate_has_its_limit(spalled: br.Scene) -> None:
    """Failure: coefficients for a million points a sample; point samples have no such limit."""
    with pytest.raises(br.SceneError, match="point samples"):
        br.simulate(spalled, duration=2.0, fs=1.0)


def test_campaigns_filter_unless_asked_not_to(spalled: br.Scene, tmp_path: Path) -> None:
    """Analytic: features are those of the filtered signal; a case may ask for point samples."""
    cases = {"bandwidth": [None, "none"]}
    done = br.campaign(
        cases, tmp_path / "runs", scene=spalled, duration=DURATION, fs=FS, progress=False
    )
    filtered, points = done.manifest["outer.ay.rms"]
    asked: list[tuple[float, Literal["auto"] | None]] = [(filtered, "auto"), (points, None)]
    for found, bandwidth in asked:
        out = br.simulate(spalled, duration=DURATION, fs=FS, threads=1, bandwidth=bandwidth)
        assert found == pytest.approx(float(out["outer.ay"].std()), rel=0.05)
    # 1.7 to 2.1, as starts a nanometre apart have it.
    assert points > 1.5 * filtered
    wide: Any = "wide"
    with pytest.raises(br.SceneError, match="bandwidth"):
        br.campaign(cases, tmp_path / "bad", scene=spalled, bandwidth=wide, progress=False)


def test_the_commands_take_it(spalled: br.Scene, tmp_path: Path) -> None:
    """Analytic: ``--bandwidth none``, and ``bandwidth = "none"`` in a sweep."""
    scene, written = tmp_path / "scene.toml", tmp_path / "out.parquet"
    scene.write_text(spalled.to_toml(), encoding="utf-8")
    arguments = ["run", str(scene), "-o", str(written), "--duration", "1e-3"]
    for more, bandwidth in (([], 20_000.0), (["--bandwidth", "none"], None)):
        assert main([*arguments, *more]) == 0
        assert br.Signals.read_parquet(written).provenance.bandwidth == bandwidth
    sweep = tmp_path / "sweep.toml"
    text = 'scene = "scene.toml"\nbandwidth = "none"\nduration = 1e-3\nkeep = "signals"\n'
    sweep.write_text(text + "grid.label = [1]\n", encoding="utf-8")
    assert main(["campaign", str(sweep), "-o", str(tmp_path / "runs")]) == 0
    done = br.campaigns.Campaign.open(tmp_path / "runs")
    points = br.simulate(spalled, duration=1e-3, threads=1, bandwidth=None)["outer.ay"]
    kept = done.signals(done.manifest["case_id"][0])["outer.ay"].to_numpy()
    assert np.array_equal(kept, points)
