"""Stiffness and damping for models of rotors.

Truths: closed forms of a rigid shaft on two bearings against SciPy's eigenvalues; the decay of runs against the
eigenvalues of the linear model; ROSS for what is written for it.
"""

from __future__ import annotations

import inspect
import json
import math
import os
import shutil
import subprocess
import sys
import warnings
from dataclasses import replace
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
import scipy.linalg

import ballrace as br
from ballrace.errors import EquilibriumError
from ballrace.scene import MotionProbe, Support

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from ballrace.rotor import RossAxis

# 100 N on a 6205 at 4500 1/min are eight centrifugal forces a ball.
pytestmark = pytest.mark.filterwarnings("ignore:row 0, thrust a ball")


@pytest.fixture(scope="module")
def scene() -> br.Scene:
    return br.presets.deep_groove_6205(500.0, 200.0, 1800.0)


@pytest.fixture(scope="module")
def table(scene: br.Scene) -> br.rotor.StiffnessTable:
    return br.stiffness_table(
        scene, {"axial": [100.0, 400.0], "radial": 50.0}, speeds_rpm=[0.0, 1500.0, 3000.0, 4500.0]
    )


def test_a_table_has_a_matrix_for_each_load_and_speed(
    scene: br.Scene, table: br.rotor.StiffnessTable, tmp_path: Path
) -> None:
    """Truth: the definition of a case, and a scene of its own for one of them."""
    assert table.stiffness.shape == table.damping.shape == (2, 4, 5, 5)
    np.testing.assert_allclose(table.speeds, np.array([0.0, 1500.0, 3000.0, 4500.0]) * np.pi / 30.0)
    changes = {"loads.axial.force": 400.0, "loads.radial.force": 50.0, "drive.speed": 100.0 * np.pi}
    one = br.stiffness_table(scene.replace(changes))
    np.testing.assert_allclose(one.stiffness[0, 0], table.stiffness[1, 2], rtol=1e-12)
    assert one.loads["axial"] == [400.0]
    assert one.speeds == pytest.approx([100.0 * np.pi])
    wider = table.stiffness_6x6
    np.testing.assert_array_equal(wider[..., :5, :5], table.stiffness)
    assert not np.any(wider[..., 5, :])
    assert not np.any(wider[..., :, 5])
    assert not np.any(table.damping_6x6[..., 5, :])
    lines = table.to_polars()
    assert lines.height == 8
    assert lines["kza"].to_list() == table.stiffness[..., 2, 3].ravel().tolist()
    table.write(tmp_path / "bearing.csv")
    head = (tmp_path / "bearing.csv").read_text(encoding="utf-8").partition("\n")[0]
    assert head.startswith("axial,radial,speed,kxx,kxy,kxz,kxa,kxb,kyx")
    assert "2 loads, 4 speeds" in repr(table)


def test_bad_arguments_are_refused_by_name(scene: br.Scene) -> None:
    for arguments, message in (
        (
            {"loads": {"thrust": 1.0}},
            r"loads = 'thrust': names of the scene's loads: 'axial', 'radial'",
        ),
        (
            {"loads": {"axial": [1.0, 2.0], "radial": [1.0, 2.0, 3.0]}},
            "loads = axial: 2, radial: 3",
        ),
        ({"loads": [100.0]}, "loads = a list: a mapping"),
        ({"loads": {"axial": math.nan}}, r"loads\['axial'\]"),
        ({"speeds_rpm": []}, "speeds_rpm = an array of shape"),
        ({"speeds": 10.0}, "speeds = 10.0: speeds_rpm"),
        ({"positions": 0}, "positions = 0"),
    ):
        with pytest.raises(br.SceneError, match=message):
            br.stiffness_table(scene, **arguments)
    with pytest.raises(EquilibriumError) as raised:
        br.stiffness_table(scene, {"radial": [200.0, 1e7]})
    assert raised.value.__notes__ == ["in load case 1: radial = 1e+07 N"]
    oil = br.bearing(
        "6205", radial_load=500.0, lubricant="vg68", temperature_c=50.0, speed_rpm=1800.0
    )
    with pytest.raises(br.SceneError, match="reference_speed") as refused:
        br.stiffness_table(oil, speeds_rpm=[1000.0, 0.0])
    assert refused.value.__notes__[0].endswith("at 0 1/min")


def _shaken(scene: br.Scene, duration: float) -> tuple[NDArray[Any], NDArray[Any]]:
    """How a kick moves the inner ring, x + iy and z: half of the difference of opposite kicks along x and z."""
    model = br.Model(scene)
    moved = []
    for sign in (1.0, -1.0):
        state = model.start()
        for axis in "xz":
            state[model.names.index(f"inner.v{axis}")] += sign * 3e-5
        out = br.simulate(scene, duration=duration, start=state, settle=0.0, rtol=1e-7)
        moved.append((out["ring.x"] + 1j * out["ring.y"], out["ring.z"]))
    (across, along), (opposite, against) = moved
    return 0.5 * (across - opposite), 0.5 * (along - against)


def _poles(x: NDArray[Any], fs: float) -> NDArray[Any]:
    """Both poles of what rings in a record, by a matrix pencil [rad/s], by their imaginary parts."""
    hankel = scipy.linalg.hankel(x[: x.size // 2], x[x.size // 2 - 1 :])
    u, _, _ = np.linalg.svd(hankel, full_matrices=False)
    turned, *_ = np.linalg.lstsq(u[:-1, :2], u[1:, :2], rcond=None)
    poles: NDArray[Any] = np.log(np.linalg.eigvals(turned).astype(complex)) * fs
    return poles[np.argsort(poles.imag)]


def _modes(
    mass: float, k: NDArray[np.float64], c: NDArray[np.float64]
) -> tuple[NDArray[Any], NDArray[Any]]:
    """Eigenvalues and vectors of places and speeds."""
    system = np.block([[np.zeros_like(k), np.eye(len(k))], [-k / mass, -c / mass]])
    values, vectors = scipy.linalg.eig(system)
    return values, vectors


@pytest.mark.parametrize(("case", "within"), [("dry", 0.02), ("smooth", 0.02), ("oil", 0.04)])
def test_the_damping_is_the_decay_of_a_run(case: str, within: float) -> None:
    """Truth: runs. A ring of 9 kg under thrust, kicked by thousandths of its deflection.

    Forward and backward whirl decay apart: with friction forward whirl decays faster, without it slower.
    """
    scene = br.presets.deep_groove_6205(0.0, 300.0, 1800.0)
    if case == "oil":
        scene = br.bearing(
            "6205", radial_load=0.0, axial_load=300.0, housing=None,
            lubricant="vg68", temperature_c=50.0, speed_rpm=1800.0,
        )  # fmt: skip
    changes: dict[str, object] = {
        "gravity": (0.0, 0.0, 0.0),
        "outer_ring.support": Support(x="fixed", y="fixed", z="fixed"),
        "inner_ring.support": Support(x="free", y="free", z="free"),
        "inner_ring.mass": 9.0,
        "probes": {"ring": MotionProbe(body="inner")},
    }
    if case == "smooth":
        changes["friction"] = "none"
    scene = scene.replace(changes)
    table = br.stiffness_table(scene)
    k, c = table.stiffness[0, 0], table.damping[0, 0]
    across, along = _shaken(scene, 0.04)
    (wanted, _), found = _modes(9.0, k[2:3, 2:3], c[2:3, 2:3]), _poles(along[::5], 10e3)[-1]
    assert found.imag == pytest.approx(wanted.imag.max(), rel=3e-3)
    assert found.real == pytest.approx(wanted.real.max(), rel=within)
    # e^(iωt) (1, -i) goes round from x to y, as the shaft turns.
    values, vectors = _modes(9.0, k[:2, :2], c[:2, :2])
    upper = values.imag > 0.0
    turns = (vectors[1] / vectors[0]).imag
    forward, backward = values[upper & (turns < 0.0)][0], values[upper & (turns > 0.0)][0]
    slow, fast = _poles(across[::2], 25e3)
    assert fast.imag == pytest.approx(forward.imag, rel=1e-3)
    assert fast.real == pytest.approx(forward.real, rel=within)
    assert slow.real == pytest.approx(backward.real, rel=within)
    assert (fast.real < slow.real) == (case != "smooth")


def test_a_rigid_shaft_on_two_bearings_has_its_closed_form() -> None:
    """Truth: closed form. Both bearings alike and mirrored; bounce, and conical whirl with gyroscopic moments."""
    mass, polar, transverse, half, speed = 20.0, 0.05, 0.4, 0.15, 600.0
    pair = [br.presets.deep_groove_6205(0.0, sign * 400.0, 0.0) for sign in (1.0, -1.0)]
    still = [one.replace({"gravity": (0.0, 0.0, 0.0)}) for one in pair]
    matrices = [br.stiffness_table(one).stiffness[0, 0] for one in still]
    total = np.zeros((5, 5))
    for at, stiffness in zip((-half, half), matrices, strict=True):
        # x and y of a node at `at`: x + b at, y - a at.
        lead = np.eye(5)
        lead[0, 4], lead[1, 3] = at, -at
        total += lead.T @ stiffness @ lead
    inertia = np.diag([mass, mass, mass, transverse, transverse])
    gyroscopic = np.zeros((5, 5))
    gyroscopic[3, 4], gyroscopic[4, 3] = polar * speed, -polar * speed
    zero, one = np.zeros((5, 5)), np.eye(5)
    system = np.block(
        [[zero, one], [-np.linalg.solve(inertia, total), -np.linalg.solve(inertia, gyroscopic)]]
    )
    found = np.sort(scipy.linalg.eigvals(system).imag)[5:]
    first, second = matrices
    radial, axial = 2.0 * first[0, 0], 2.0 * first[2, 2]
    rocking = 2.0 * (first[3, 3] + half**2 * first[0, 0]) - 2.0 * half * (
        second[1, 3] - first[1, 3]
    )
    g = 0.5 * polar * speed / transverse
    conical = math.sqrt(g * g + rocking / transverse)
    wanted = [math.sqrt(radial / mass)] * 2 + [math.sqrt(axial / mass), conical - g, conical + g]
    np.testing.assert_allclose(found, np.sort(wanted), rtol=1e-3)


def test_ross_is_given_what_it_takes(table: br.rotor.StiffnessTable) -> None:
    """Truth: the table, and the signatures of ROSS 3.1's and 2.3's elements."""
    given = table.ross_arguments(load=1)
    assert sorted(given) == sorted(
        [f"{letter}{at}" for letter in "kc" for at in ("xx", "xy", "yx", "yy", "zz")] + ["speed"]
    )
    np.testing.assert_array_equal(given["kyx"], table.stiffness[1, :, 1, 0])
    np.testing.assert_array_equal(given["speed"], table.speeds)
    old = table.ross_arguments(load=1, axis="frequency")
    np.testing.assert_array_equal(old["frequency"], table.speeds)
    assert "speed" not in old
    with pytest.raises(br.SceneError, match="axis = 'w': 'speed' or 'frequency'"):
        table.ross_arguments(axis="w")  # type: ignore[arg-type]
    with pytest.raises(br.SceneError, match="load = 2: a whole number, 0 to 1"):
        table.ross_arguments(load=2)
    falling = replace(table, speeds=table.speeds[::-1])
    with pytest.raises(br.SceneError, match="rising"):
        falling.ross_arguments()


@pytest.mark.parametrize(
    ("taken", "axis"),
    [
        # As `inspect.signature` has them: of ROSS 3.1.0, and of 2.3.
        (
            "n kxx cxx mxx kyy kxy kyx cyy cxy cyx myy mxy myx kzz czz mzz speed frequency tag n_link "
            "scale_factor color interpolation radial_clearance",
            "speed",
        ),
        (
            "n kxx cxx mxx kyy kxy kyx cyy cxy cyx myy mxy myx kzz czz mzz frequency tag n_link scale_factor "
            "color",
            "frequency",
        ),
    ],
)
def test_speeds_go_along_the_rotors_axis(
    table: br.rotor.StiffnessTable, monkeypatch: pytest.MonkeyPatch, taken: str, axis: str
) -> None:
    """Truth: the recorded signatures. Since ROSS 3 an array along `frequency` belongs to the whirl."""
    parameters = [
        inspect.Parameter(name, inspect.Parameter.POSITIONAL_OR_KEYWORD, default=None)
        for name in taken.split()
    ]

    def element(**given: object) -> dict[str, object]:
        return given

    element.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "ross", SimpleNamespace(BearingElement=element))
    given = table.to_ross(3, load=1, tag="drive end")
    assert set(given) <= set(taken.split())
    assert {"speed", "frequency"} & set(given) == {axis}
    np.testing.assert_array_equal(given[axis], table.speeds)


_IN_ROSS = """
import json, sys
import numpy as np
import ross
given = json.load(sys.stdin)
speed = given.pop("at")
element = ross.BearingElement(n=0, **{name: np.array(values) for name, values in given.items()})
old = "speed" not in ross.BearingElement.__init__.__code__.co_varnames
# At a whirl that is not the rotor's speed.
at = (speed,) if old else (0.2 * speed, speed)
steel = ross.Material("stiff", rho=7800.0, E=2e14, G_s=8e13)
shaft = [ross.ShaftElement(L=0.1, idl=0.0, odl=0.05, material=steel, n=n) for n in range(2)]
other = ross.BearingElement(n=2, **{name: np.array(values) for name, values in given.items()})
modes = ross.Rotor(shaft, [], [element, other]).run_modal(speed=speed, num_modes=12)
print(json.dumps([element.K(*at).tolist(), element.C(*at).tolist(), modes.wn.tolist()]))
"""


def _with_ross() -> str:
    """An interpreter that has ROSS: this one, `BALLRACE_ROSS_PYTHON` or a Python 3.13; else a skip."""
    named = os.environ.get("BALLRACE_ROSS_PYTHON"), shutil.which("python3.13")
    for python in (sys.executable, *filter(None, named)):
        tried = subprocess.run([python, "-c", "import ross"], capture_output=True, check=False)
        if tried.returncode == 0:
            return python
    pytest.skip("no Python here has ross-rotordynamics; name one by BALLRACE_ROSS_PYTHON")


def test_ross_finds_the_same_rotor(table: br.rotor.StiffnessTable) -> None:
    """Truth: ROSS. An element has the table's matrices, and a stiff shaft on two of them bounces as it should."""
    python = _with_ross()
    version = "from importlib.metadata import version; print(version('ross-rotordynamics'))"
    found = subprocess.run([python, "-c", version], capture_output=True, text=True, check=True)
    axis: RossAxis = "frequency" if found.stdout.startswith("2") else "speed"
    speed = float(table.speeds[1])
    arguments = table.ross_arguments(load=1, axis=axis)
    given = {name: values.tolist() for name, values in arguments.items()} | {"at": speed}
    done = subprocess.run(
        [python, "-c", _IN_ROSS],
        input=json.dumps(given),
        capture_output=True,
        text=True,
        check=True,
    )
    stiffness, damping, natural = (
        np.array(each) for each in json.loads(done.stdout.splitlines()[-1])
    )
    ours = table.stiffness[1, 1]
    np.testing.assert_allclose(stiffness[:2, :2], ours[:2, :2], rtol=1e-6)
    np.testing.assert_allclose(stiffness[2, 2], ours[2, 2], rtol=1e-6)
    np.testing.assert_allclose(damping[0, 0], table.damping[1, 1, 0, 0], rtol=1e-3)
    mass = 7800.0 * math.pi * 0.025**2 * 0.2
    wanted = np.sqrt(2.0 * np.linalg.eigvalsh(ours[:2, :2]) / mass)
    for each in wanted:
        assert np.min(np.abs(natural / each - 1.0)) < 0.01


def test_without_ross_one_line_says_how_to_install_it(
    table: br.rotor.StiffnessTable, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "ross", None)
    with pytest.raises(
        ImportError, match=r"a bearing element of ROSS needs ross .*pip install ross-rotordynamics$"
    ):
        table.to_ross(0)


def test_a_table_warns_of_each_subject_once() -> None:
    """However many of its loads and speeds have it; the numbers are those of the first."""
    scene = br.bearing("6205", radial_load=40.0, axial_load=50.0, speed_rpm=1800.0)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        table = br.stiffness_table(scene, {"axial": [50.0, 80.0]}, speeds_rpm=[9000.0, 12000.0])
    texts = [str(each.message) for each in caught]
    subjects = [text.partition(" = ")[0] for text in texts]
    assert "row 0, thrust a ball" in subjects
    assert len(subjects) == len(set(subjects))
    assert texts == list(table.warnings)
    assert texts[subjects.index("row 0, thrust a ball")].endswith(
        "; in 4 of 4 equilibria of the table"
    )
