from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Literal, TypeAlias, TypedDict, final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Model",
    "Simulation",
    "amplitudes",
    "available_threads",
    "axis_held",
    "axis_ratio",
    "by_order",
    "campaign",
    "check_run",
    "check_samples",
    "dynamic_coefficients",
    "equilibrium",
    "explain",
    "fault_frequencies",
    "feature_columns",
    "hann_weighted",
    "instruction_sets",
    "load_distribution",
    "named_oils",
    "oil",
    "orders",
    "placed",
    "preset_angular_contact_pair",
    "preset_cornering_wheel",
    "preset_deep_groove_6205",
    "preset_wheel_bearing",
    "rolling",
    "rolling_frequencies",
    "run_features",
    "run_from_json",
    "scene_doubts",
    "scene_from_json",
    "scene_from_toml",
    "scene_ranges",
    "scene_replace",
    "scene_to_toml",
    "signal_features",
    "simulate",
    "squared_envelope",
    "stiffness",
    "time_values",
    "turning",
]

_Array: TypeAlias = NDArray[np.float64]
_Integers: TypeAlias = NDArray[np.int64]
_Force: TypeAlias = tuple[str, str, Callable[..., list[float]], float, float, list[float], bool]

@final
class Model:
    def __new__(cls, scene: str) -> Model: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def bodies(self) -> list[str]: ...
    def start(self, kind: str) -> _Array: ...
    def rhs(self, t: float, y: _Array) -> _Array: ...
    def forces(self, t: float, y: _Array) -> dict[str, _Array]: ...

@final
class Simulation:
    def __new__(
        cls,
        scene: str,
        run: str,
        state: _Array | None = None,
        progress: Callable[[float], object] | None = None,
        forces: list[_Force] = ...,
    ) -> Simulation: ...
    @staticmethod
    def restored(snapshot: str) -> Simulation: ...
    def snapshot(self) -> str: ...
    @property
    def time(self) -> float: ...
    @property
    def scene(self) -> str: ...
    @property
    def names(self) -> list[str]: ...
    def state(self) -> _Array: ...
    def contacts(self) -> dict[str, _Array]: ...
    def wrench(self, ring: str) -> _Array: ...
    def advance_to(
        self, t: float, progress: Callable[[float], object] | None = None
    ) -> dict[str, _Array]: ...
    def change(self, changes: str) -> None: ...
    def set_loads(self, loads: Sequence[tuple[str, float]]) -> None: ...
    def set_motions(self, motions: Sequence[tuple[str, Sequence[float]]], until: float) -> None: ...
    def finish(self, progress: Callable[[float], object] | None = None) -> _Signals: ...

class _Signals(TypedDict):
    fs: float
    t: _Array
    columns: list[tuple[str, str, _Array]]
    slices: dict[str, list[str] | NDArray[np.uint64] | _Array] | None
    stats: str
    warnings: list[tuple[Literal["accuracy", "scene", "asked"], str]]
    provenance: str
    scene: str
    end_state: _Array

class _Turning(TypedDict):
    row: _Integers
    ball: _Integers
    angle: _Array
    outer_load: _Array
    outer_angle: _Array
    inner_load: _Array
    inner_angle: _Array
    warnings: list[str]

class _Equilibrium(_Turning):
    outer: _Array
    inner: _Array
    outer_tilt: _Array
    inner_tilt: _Array
    outer_moment: _Array
    inner_moment: _Array
    radius: _Array
    z: _Array
    outer_deflection: _Array
    outer_zone_centre: _Array
    inner_deflection: _Array
    inner_zone_centre: _Array
    outer_pressure: _Array
    inner_pressure: _Array
    residual: float
    residual_share: float

class _Stiffness(TypedDict):
    inner: _Array
    rings: _Array
    inner_spatial: _Array
    rings_spatial: _Array
    equilibrium: _Equilibrium

class _DynamicCoefficients(TypedDict):
    stiffness: _Array
    damping: _Array
    equilibrium: _Equilibrium

class _LoadDistribution(_Turning):
    turn: _Array
    outer_tilt: _Array
    inner_tilt: _Array
    outer_moment: _Array
    inner_moment: _Array
    outer_equivalent: _Array
    inner_equivalent: _Array

def simulate(
    scene: str,
    run: str,
    state: _Array | None = None,
    progress: Callable[[float], object] | None = None,
    sink: Callable[[dict[str, _Array]], object] | None = None,
    forces: list[_Force] = ...,
) -> _Signals: ...
def campaign(
    cases: Iterable[tuple[str, str]],
    threads: int,
    sharing: int,
    options: str,
    keep_signals: bool,
    done: Callable[[list[tuple[int, str, _Signals | None]]], object],
) -> None: ...
def run_from_json(text: str) -> str: ...
def check_run(run: str, options: str) -> None: ...
def feature_columns(scene: str, options: str) -> list[str]: ...
def run_features(
    columns: Mapping[str, _Array],
    fs: float,
    scene: str,
    largest_pressure: float | None,
    kinematics: str,
    options: str,
) -> list[tuple[str, float | None]]: ...
def signal_features(
    x: _Array, fs: float, name: str, scene: str | None, options: str
) -> list[tuple[str, float | None]]: ...
def orders(
    ball_count: float, ball_diameter: float, pitch_diameter: float, contact_angle: float
) -> tuple[float, float, float, float]: ...
def axis_ratio(
    sigma: float,
    ball_diameter: float,
    pitch_diameter: float,
    conformity: float,
    contact_angle: float,
) -> float: ...
def check_samples(name: str, x: _Array) -> None: ...
def rolling_frequencies(
    ball_count: float,
    ball_diameter: float,
    pitch_diameter: float,
    contact_angle: float,
    speeds: tuple[float, float],
) -> str: ...
def squared_envelope(x: _Array, fs: float, band: tuple[float, float] | None) -> _Array: ...
def by_order(x: _Array, angle: _Array, per_turn: int | None) -> tuple[_Array, _Array]: ...
def turning(angle: _Array) -> tuple[int, int]: ...
def amplitudes(x: _Array, length: int) -> _Array: ...
def hann_weighted(x: _Array) -> _Array: ...
def available_threads() -> int: ...
def instruction_sets() -> list[str]: ...
def equilibrium(scene: str, race_control: str, forces: list[_Force] = ...) -> _Equilibrium: ...
def explain(scene: str) -> tuple[str, str]: ...
def stiffness(scene: str) -> _Stiffness: ...
def dynamic_coefficients(scene: str, positions: int) -> _DynamicCoefficients: ...
def load_distribution(scene: str, positions: int) -> _LoadDistribution: ...
def placed(scene: str) -> str: ...
def axis_held(scene: str) -> tuple[float, float, bool] | None: ...
def fault_frequencies(
    scene: str,
    row: int,
    speeds: tuple[float, float],
    race_control: str,
    kinematics: str | None,
) -> str: ...
def rolling(scene: str, race_control: str) -> list[tuple[float, float, float] | None]: ...
def named_oils() -> str: ...
def oil(lubricant: str) -> str: ...
def scene_doubts(text: str) -> list[str]: ...
def scene_from_toml(text: str) -> str: ...
def scene_from_json(text: str) -> str: ...
def scene_to_toml(text: str) -> str: ...
def time_values(function: str, times: _Array) -> _Array: ...
def scene_ranges() -> str: ...
def scene_replace(text: str, changes: str) -> str: ...
def preset_wheel_bearing(axial_load: float) -> str: ...
def preset_angular_contact_pair(
    face_to_face: bool, radial_load: float, axial_load: float, speed_rpm: float
) -> str: ...
def preset_cornering_wheel(lateral: float) -> str: ...
def preset_deep_groove_6205(radial_load: float, axial_load: float, speed_rpm: float) -> str: ...
