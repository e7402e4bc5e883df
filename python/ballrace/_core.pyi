from collections.abc import Callable, Iterable
from typing import TypeAlias, TypedDict, final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Model",
    "available_threads",
    "campaign",
    "equilibrium",
    "explain",
    "feature_columns",
    "load_distribution",
    "preset_deep_groove_6205",
    "preset_wheel_bearing",
    "scene_from_json",
    "scene_from_toml",
    "scene_replace",
    "scene_to_toml",
    "simulate",
    "stiffness",
]

_Array: TypeAlias = NDArray[np.float64]

@final
class Model:
    def __new__(cls, scene: str) -> Model: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def bodies(self) -> list[str]: ...
    @property
    def dim(self) -> int: ...
    def start(self, kind: str) -> _Array: ...
    def rhs(self, t: float, y: _Array) -> _Array: ...
    def forces(self, t: float, y: _Array) -> dict[str, _Array]: ...

class _Signals(TypedDict):
    fs: float
    t: _Array
    columns: list[tuple[str, str, _Array]]
    slices: dict[str, list[str] | NDArray[np.uint64] | _Array] | None
    stats: str
    warnings: list[str]
    provenance: str
    scene: str

def simulate(
    scene: str,
    duration: float,
    fs: float,
    kind: str,
    state: _Array | None,
    rtol: float | None,
    accuracy: float | None,
    method: str | None,
    threads: int,
    progress: Callable[[float], object] | None,
) -> _Signals: ...
def campaign(
    cases: Iterable[tuple[str, str]],
    threads: int,
    options: str,
    keep_signals: bool,
    done: Callable[[list[tuple[int, str, _Signals | None]]], object],
) -> None: ...
def feature_columns(scene: str, options: str) -> list[str]: ...
def available_threads() -> int: ...
def equilibrium(scene: str) -> str: ...
def explain(scene: str) -> tuple[str, str]: ...
def stiffness(scene: str) -> str: ...
def load_distribution(scene: str, positions: int) -> str: ...
def scene_from_toml(text: str) -> str: ...
def scene_from_json(text: str) -> str: ...
def scene_to_toml(text: str) -> str: ...
def scene_replace(text: str, changes: str) -> str: ...
def preset_wheel_bearing(axial_load: float) -> str: ...
def preset_deep_groove_6205(radial_load: float, axial_load: float, speed_rpm: float) -> str: ...
