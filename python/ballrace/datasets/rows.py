"""Rows of a data set's table for simulated records."""

from __future__ import annotations

import hashlib
import json
import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ..diagnosis.kinematics import kinematics_of
from ..recordings.scenes import origin_of
from ..scene import Ramp, SpeedDrive
from ..scene.defect import widest
from ..scene.turning import relative_speed

if TYPE_CHECKING:
    from collections.abc import Mapping

    from ..campaigns.measured import Measured
    from ..scene import Scene

_FAULTS = {"outer_race": "outer", "inner_race": "inner", "ball": "rolling_element"}
"""Name in the layout by the surface of a defect."""

AXES = ("horizontal", "vertical", "axial")
"""Names of x, y and z in the layout."""


def row_of(scene: Scene, case: Mapping[str, Any], middle: float) -> dict[str, Any]:
    """Return the columns that all signals of a case share, by its row of the manifest.

    What changes is that of the middle of the record [s].
    """
    return {
        "native_label": _native(scene),
        "sensor_location": "test_bearing",
        **_operation(scene, middle),
        **_fault(scene, case),
        "bearing_id": str(case["bearing_id"]) if "bearing_id" in case else _hash(scene),
        "bearing_model": scene.name or "unknown",
        **_orders(scene),
    }


def sensor_row(line: Measured, case: Mapping[str, Any], recording_id: str) -> dict[str, Any]:
    """Return the columns of what a chain measured of a case, by its row of the manifest."""
    found = line.measurement
    own = {
        "recording_id": recording_id, "channel": "sensor", "fs": found.fs,
        "axis": axis_of(found.chain.direction), "quantity": "acceleration", "unit": found.unit,
        "sensor_mounting": "outer_ring" if line.scene.structure is None else "pedestal",
    }  # fmt: skip
    return own | row_of(line.scene, case, found.start + 0.5 * found.x.size / found.fs)


def axis_of(direction: tuple[float, float, float] | None) -> str:
    """Return the name of a direction.

    Examples
    --------
    >>> axis_of(None), axis_of((0.0, 0.0, -1.0)), axis_of((1.0, 1.0, 0.0))
    ('vertical', 'axial', 'unknown')
    """
    along = np.flatnonzero((0.0, 1.0, 0.0) if direction is None else direction)
    return AXES[int(along[0])] if along.size == 1 else "unknown"


def _native(scene: Scene) -> str:
    defects = [f"{d.on} {1e3 * widest(d):g} mm" for d in scene.defects.values() if widest(d) > 0.0]
    return "+".join(sorted(defects)) or "healthy"


def _operation(scene: Scene, middle: float) -> dict[str, Any]:
    origin = origin_of(scene, None)
    forces = [np.multiply(load["direction"], load["force"]) for load in origin.load(middle) or []]
    load = float(np.linalg.norm(np.sum(forces, axis=0))) if forces else 0.0
    speed = origin.speed(middle)
    entries = {"load": load, "load_unit": "N", "operating_condition": f"{load:.0f} N"}
    if speed is None:  # a torque drives, and only the run knows
        return entries
    rpm = abs(speed) * 30.0 / math.pi
    entries["operating_condition"] = f"{rpm:.0f} rpm, {load:.0f} N"
    return entries | {"speed_rpm": rpm, "speed_profile": _profile(scene)}


def _profile(scene: Scene) -> str:
    if relative_speed(scene) is not None:
        return "constant"
    speed = scene.drive.speed if isinstance(scene.drive, SpeedDrive) else None
    if speed == 0.0:
        speed = scene.outer_speed
    if isinstance(speed, Ramp) and (scene.outer_speed is None or speed is scene.outer_speed):
        return "increasing" if abs(speed.to) > abs(speed.from_) else "decreasing"
    return "varying"


def _fault(scene: Scene, case: Mapping[str, Any]) -> dict[str, Any]:
    met = [surface for surface in _FAULTS if case[f"fault_{surface}"]]
    widths = [widest(d) for d in scene.defects.values() if d.on in met]
    size = round(1e3 * max(widths, default=0.0), 6)
    return {
        "fault_type": "+".join(_FAULTS[surface] for surface in met) or "normal",
        "fault_location": "+".join("test_bearing" for _ in met) or "none",
        "sensor_at_fault": bool(met),
        "fault_origin": "artificial" if met else "none",
        "fault_size_mm": size,
        "fault_severity": f"{size:g} mm" if met else "none",
    }


def _hash(scene: Scene) -> str:
    """Return what stands for a bearing: the hash of its rows and defects."""
    document = json.loads(scene.to_json())
    parts = json.dumps([document.get("rows"), document.get("defects")], sort_keys=True)
    return hashlib.sha256(parts.encode()).hexdigest()[:12]


def _orders(scene: Scene) -> dict[str, float]:
    row = next((d.row for d in scene.defects.values()), 0)
    orders = kinematics_of(scene, row).orders
    return {name: round(getattr(orders, name), 5) for name in ("bpfo", "bpfi", "bsf", "ftf")}
