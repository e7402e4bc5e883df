"""A campaign as a data set."""

from __future__ import annotations

import hashlib
import warnings
from typing import TYPE_CHECKING, Any

from ..errors import CampaignWarning, SceneError
from ..scene import MotionProbe
from .rows import AXES, row_of, sensor_row
from .writing import new_folder, write

if TYPE_CHECKING:
    import os
    from collections.abc import Iterator

    import numpy as np
    from numpy.typing import NDArray

    from ..campaigns import Campaign
    from ..measuring.named import Chains
    from ..scene import Scene

    Rows = Iterator[tuple[dict[str, Any], NDArray[np.float64]]]


def write_campaign(
    done: Campaign,
    path: str | os.PathLike[str],
    chains: Chains | None,
    *,
    title: str,
    licence: str,
    seed: int,
    per_case: int | None,
) -> None:
    """Write it; see :meth:`ballrace.campaigns.Campaign.to_bearing_datasets`."""
    folder = new_folder(path)
    for name, text in (("title", title), ("licence", licence)):
        if not isinstance(text, str):
            raise SceneError(name, repr(text), "text")
    cases, left_out = _labelled(done)
    scenes = {case_id: done.scene(case_id) for case_id in cases}
    if chains is None:
        signals = _of_rings(done, cases, scenes)
    else:
        signals = _of_sensors(done, cases, chains, seed=seed, per_case=per_case)
    versions = {case["version"] for case in cases.values()}
    card = {
        "title": title or f"simulated bearings, campaign {done.folder.name}",
        "license": licence,
        "citation": f"Simulated with ballrace {', '.join(sorted(filter(None, versions)))}.",
        "scenes": {case_id: _hash(scene) for case_id, scene in scenes.items()},
        "left_out": left_out,
    }
    write(folder, signals, card)
    if left_out:
        text = f"{left_out} cases have no label and are left out: no ball came to a defect in time"
        warnings.warn(text, CampaignWarning, stacklevel=3)


def _labelled(done: Campaign) -> tuple[dict[str, dict[str, Any]], int]:
    """Return the rows of cases with signals and labels by their ids, and how many have no labels."""
    table = done.manifest.drop_nulls("signals").unique("case_id", maintain_order=True)
    if table.is_empty():
        raise FileNotFoundError(f'{done.folder}: no signals; run with keep="signals"')
    known = table.drop_nulls([name for name in table.columns if name.startswith("fault_")])
    return {row["case_id"]: row for row in known.to_dicts()}, table.height - known.height


def _of_sensors(
    done: Campaign,
    cases: dict[str, dict[str, Any]],
    chains: Chains,
    *,
    seed: int,
    per_case: int | None,
) -> Rows:
    for line in done.measurements(chains, seed=seed, per_case=per_case):
        if line.case_id not in cases:
            continue
        yield (
            sensor_row(line, cases[line.case_id], f"{line.case_id}_{line.chain}"),
            line.measurement.x,
        )


def _of_rings(done: Campaign, cases: dict[str, dict[str, Any]], scenes: dict[str, Scene]) -> Rows:
    for case_id, case in cases.items():
        out, scene = done.run_of(case_id), scenes[case_id]
        shared = row_of(scene, case, float(out.t[out.n_samples // 2]))
        for name, axis in _columns(scene):
            own = {
                "recording_id": case_id, "channel": name, "fs": out.fs, "axis": axis,
                "quantity": "acceleration", "unit": "m/s^2",
                "sensor_mounting": "pedestal" if name.startswith("housing.") else "outer_ring",
            }  # fmt: skip
            if name in out:
                yield own | shared, out[name]


def _columns(scene: Scene) -> list[tuple[str, str]]:
    """Return the columns with accelerations of a structure's sensors, else of the outer ring, and their axes."""
    sensors = () if scene.structure is None else scene.structure.sensors
    points = [f"housing.{sensor}" for sensor in sensors] or [
        name
        for name, probe in scene.probes.items()
        if isinstance(probe, MotionProbe) and probe.body == "outer"
    ]
    return [
        (f"{point}.a{x}", axis) for point in points for x, axis in zip("xyz", AXES, strict=True)
    ]


def _hash(scene: Scene) -> str:
    return hashlib.sha256(scene.to_json().encode()).hexdigest()
