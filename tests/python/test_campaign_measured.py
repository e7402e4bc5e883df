"""A campaign's signals at many machines, without running anything again."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

import ballrace as br
from ballrace import measuring as m

if TYPE_CHECKING:
    from pathlib import Path

CHAINS = {
    f"machine {seed}": m.Chain(
        path=m.random_housing(seed),
        machine=m.Machine(noise_density=1e-2),
        logger=m.Logger(fs=12_500.0),
    )
    for seed in range(3)
}


@pytest.fixture(scope="module")
def done(tmp_path_factory: pytest.TempPathFactory) -> br.Campaign:
    folder: Path = tmp_path_factory.mktemp("campaign")
    spall = br.defects.spall(on="outer_race", width_mm=1.0)
    scene = br.bearing("6205", radial_load=1000.0, speed_rpm=6000.0, defects=spall)
    cases = br.grid({"loads.radial.force": [800.0, 1200.0]})
    return br.campaign(
        cases, folder, scene=scene, duration=0.02, fs=25_000.0, settle=0.0, keep="signals", progress=False
    )  # fmt: skip


def test_every_case_meets_every_chain(done: br.Campaign) -> None:
    table = done.measure(CHAINS, seed=1)
    assert table.height == 6
    pairs = table.select("case_id", "chain").rows()
    assert pairs == [(case, name) for case in done.manifest["case_id"] for name in CHAINS]
    assert table["sampling_rate"].unique().to_list() == [12_500.0]
    # Paths differ, and so does their noise.
    assert table["sensor.rms"].n_unique() == 6
    assert table["seed"].n_unique() == 6
    assert done.manifest.join(table, on="case_id").height == 6


def test_a_line_is_the_measurement_of_the_run(done: br.Campaign) -> None:
    line = done.measure(CHAINS, seed=1).row(4, named=True)
    out = br.simulate(done.scene(line["case_id"]), duration=0.02, fs=25_000.0, settle=0.0)
    alone = br.measure(out, CHAINS[line["chain"]], seed=line["seed"])
    wanted = br.features(alone.x, alone.fs, name="sensor", scene=out.scene)
    # 20 ms are too short for standard errors: the table leaves their columns out.
    assert {name: line.get(name) for name in wanted} == wanted
    assert wanted["batches"] == 0


def test_windows_are_cut_from_the_measurement(done: br.Campaign) -> None:
    table = done.windows(CHAINS, 64, 32, seed=1)
    first = next(iter(done.measurements(CHAINS, seed=1))).measurement
    each = (first.x.size - 64) // 32 + 1
    assert table.height == 6 * each
    row = table.row(2, named=True)
    assert row["start"] == pytest.approx(first.start + 64 / 12_500.0)
    assert np.array_equal(row["x"], np.float32(first.x[64:128]))


def test_what_clips_is_reported_once_and_in_the_manifest(done: br.Campaign) -> None:
    """Limit: a range of a tenth of what the signal reaches clips, one that fits it does not."""
    again = br.Campaign.open(done.folder)
    assert "measured_clipped" not in again.manifest.columns
    fitting = again.measure(m.Chain(logger=m.Logger(bits=16)))
    assert (fitting["clipped"] == 0.0).all()
    assert (fitting["range"] >= fitting["sensor.peak"]).all()
    assert (again.manifest["measured_clipped"] == 0.0).all()
    small = m.Logger(range=0.1 * float(fitting["range"].min()), bits=16)  # type: ignore[arg-type]
    chains = {"fits": m.Chain(logger=m.Logger(bits=16)), "clips": m.Chain(logger=small)}
    with pytest.warns(br.AccuracyWarning, match="2 of 4 measurements") as warned:
        table = again.windows(chains, 64)
    assert len(warned) == 1
    assert set(table.filter(chain="clips")["range"]) == {small.range}
    clipped = again.manifest["measured_clipped"]
    assert (clipped > 1e-3).all()
    assert (
        clipped.to_list()
        == table.filter(chain="clips")["clipped"].unique(maintain_order=True).to_list()
    )


def test_windows_leave_out_the_ring_up_and_know_their_labels(done: br.Campaign) -> None:
    """Truth: the measurement itself, from the sample behind what is left out, and the manifest's own columns."""
    chain = m.Chain(path=m.random_housing(1, modes=1, band=(200.0, 200.0)))
    all_, later = done.windows(chain, 100), done.windows(chain, 100, skip=0.0121)
    # Windows begin at the next sample behind what is left out: 302.5 samples of 500.
    assert later["start"].unique().to_list() == [pytest.approx(303 / 25_000.0)]
    first = next(iter(done.measurements(chain))).measurement
    assert np.array_equal(later.row(0, named=True)["x"], np.float32(first.x[303:403]))
    faults = ["fault_outer_race", "fault_inner_race", "fault_ball"]
    assert all_.columns[-3:] == faults
    assert all_["fault_inner_race"].to_list() == [False] * all_.height
    own = done.windows(chain, 100, labels=["loads.radial.force", "wall_time"])
    assert own.columns[-2:] == ["loads.radial.force", "wall_time"]
    assert own["loads.radial.force"].unique().sort().to_list() == [800.0, 1200.0]
    for labels, text in ((["start"], "windows have one"), (["no such"], "columns of the manifest")):
        with pytest.raises(br.SceneError, match=text):
            done.windows(chain, 100, labels=labels)
    for skip in (-1.0, 0.02):
        with pytest.raises(br.SceneError, match="skip"):
            done.windows(chain, 100, skip=skip)


def test_some_chains_for_each_case(done: br.Campaign) -> None:
    table = done.measure(list(CHAINS.values()), seed=3, per_case=2)
    assert table.height == 4
    assert table.equals(done.measure(list(CHAINS.values()), seed=3, per_case=2))
    assert set(table["chain"]) <= {"0", "1", "2"}


def test_what_is_refused(done: br.Campaign) -> None:
    with pytest.raises(br.SceneError, match="chains"):
        done.measure({})
    with pytest.raises(br.SceneError, match=r"at least one Chain of br\.measuring, which without"):
        done.windows(None, 512)  # type: ignore[arg-type]
    with pytest.raises(br.SceneError, match="per_case"):
        done.measure(CHAINS, per_case=4)
    with pytest.raises(br.SceneError, match="length"):
        done.windows(CHAINS, 10**6)
    with pytest.raises(br.SceneError, match="hop"):
        done.windows(CHAINS, 10, 0)
    with pytest.raises(br.SceneError, match="direction"):
        done.measure(m.Chain(body="row0.ball0"))
