"""Functional mock-up units: the description validates, coupling converges, states come back bit by bit.

The long tests build the library with cargo and drive it by FMPy, an importer of others, which
``tests/run --all`` installs.
"""

from __future__ import annotations

import json
import re
import shutil
import struct
import sys
import tomllib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib.metadata import PackageNotFoundError
from pathlib import Path
from typing import Any
from unittest.mock import Mock

import numpy as np
import pytest

import ballrace as br
from ballrace.cli import fmu, main
from release import ROOT
from tools import run

STEP = 1e-5


def scene() -> br.Scene:
    """A 6205 whose outer ring stands on springs, at the tolerance of an FMU, which has no band."""
    spring = br.scene.Spring(stiffness=2e7, damping=100.0)
    held = br.bearing("6205", radial_load=500.0, speed_rpm=1800.0, housing=None)
    changes = {"outer_ring.support.x": spring, "outer_ring.support.y": spring, "solver.rtol": 1e-7}
    return held.replace(changes)


def damaged() -> br.Scene:
    """Two rows, rings that tilt, oil and a spall."""
    shaft = br.presets.motor()
    crack = br.defects.spall(on="outer_race", width_mm=1.0)
    return shaft.replace({"defects.crack": crack, "solver.rtol": 1e-7})


@pytest.fixture
def command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., tuple[int, Path]]:
    """The command in an installation without a library, outside of any repository."""
    (tmp_path / "scene.toml").write_text(scene().to_toml(), encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(fmu, "_PACKAGED", tmp_path / "none" / fmu._NAME)
    monkeypatch.setattr(fmu, "distribution", Mock(side_effect=PackageNotFoundError))
    packed = tmp_path / "bearing.fmu"
    return lambda *more: (main(["fmu", "scene.toml", "-o", str(packed), *more]), packed)


def test_without_the_library_it_says_how_to_build_it(
    command: Callable[..., tuple[int, Path]], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    other = tmp_path / "other.so"
    other.write_text("no library", encoding="utf-8")
    for more, message in [
        (
            [],
            "add --build, or build it in ballrace's repository, cargo build --release --locked -p ballrace-fmu",
        ),
        (["--build"], f"{tmp_path}: neither ballrace's repository nor its unpacked sdist"),
        (["--library", "none.so"], "none.so: no such library"),
        (["--library", str(other)], f"{other}: no library of ballrace's FMUs"),
    ]:
        code, packed = command(*more)
        assert code == 2
        assert message in capsys.readouterr().err
        assert not packed.exists()


def test_a_wheel_takes_the_library_from_where_the_command_looks_for_it() -> None:
    pyproject = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    (include,) = pyproject["tool"]["maturin"]["include"]
    assert include["format"] == "wheel"
    place = Path("python", "ballrace", fmu._PACKAGED.relative_to(Path(br.__file__).parent))
    assert place.match(include["path"])
    script = (ROOT / "packaging" / "fmu_library").read_text(encoding="utf-8")
    assert f"{place.parent.as_posix()}/" in script
    assert f" {fmu._NAME}" in script


@pytest.mark.skipif(sys.platform == "win32", reason="a shell script stands for cargo")
def test_build_asks_cargo_in_the_repository(
    command: Callable[..., tuple[int, Path]], tmp_path: Path, capfd: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    """Where cargo says that it has put the library, there it is taken from, whatever the target folder."""
    repository = tmp_path / "ballrace"
    (repository / "fmu" / "src").mkdir(parents=True)
    (repository / "fmu" / "src" / "abi.rs").touch()
    (repository / "docs").mkdir()
    (tmp_path / "scene.toml").rename(repository / "docs" / "scene.toml")
    monkeypatch.chdir(repository / "docs")
    monkeypatch.setenv("PATH", str(tmp_path / "bin"))
    assert command("--build")[0] == 2
    assert f"{repository}: --build needs cargo" in capfd.readouterr().err
    built = tmp_path / "elsewhere" / fmu._NAME
    built.parent.mkdir()
    built.write_text("no library", encoding="utf-8")
    other = json.dumps({"filenames": [str(tmp_path / "libother.rlib")]})
    said = json.dumps({"filenames": [str(built)]})
    cargo = tmp_path / "bin" / "cargo"
    cargo.parent.mkdir()
    cargo.write_text(
        f"#!/bin/sh\n[ \"$4 $5\" = '-p ballrace-fmu' ] && echo '{other}' && echo '{said}' && pwd >&2\n",
        encoding="utf-8",
    )
    cargo.chmod(0o755)
    assert command("--build")[0] == 2
    err = capfd.readouterr().err
    assert err.startswith(f"{repository}\n")
    assert f"{built}: no library of ballrace's FMUs" in err
    cargo.write_text("#!/bin/sh\nexit 101\n", encoding="utf-8")
    assert command("--build")[0] == 2
    assert "has failed" in capfd.readouterr().err


@pytest.fixture(scope="module")
def library() -> Path:
    pytest.importorskip("fmpy", reason="fmpy is not installed")
    # With the bindings, beside which the crate has been compiled.
    packages = ("-p", "ballrace-python", "-p", "ballrace-fmu", "--target-dir", "target")
    built = run("cargo", "build", "-q", "--locked", *packages)
    assert built.returncode == 0, built.stderr
    found = (ROOT / "target" / "debug").glob("*ballrace_fmu.*")
    (only,) = [path for path in found if path.suffix in {".so", ".dylib", ".dll"}]
    return only


Pack = Callable[[br.Scene], Path]


@pytest.fixture(scope="module")
def pack(library: Path, tmp_path_factory: pytest.TempPathFactory) -> Pack:
    def packed(of: br.Scene) -> Path:
        folder = tmp_path_factory.mktemp("fmu")
        (folder / "scene.toml").write_text(of.to_toml(), encoding="utf-8")
        out = folder / "bearing.fmu"
        code = main(["fmu", str(folder / "scene.toml"), "-o", str(out), "--library", str(library)])
        assert code == 0
        return out

    return packed


class Driven:
    """An instance, driven as an importer does."""

    def __init__(self, packed: Path, folder: Path) -> None:
        import fmpy
        import fmpy.fmi3

        self.described = fmpy.read_model_description(str(packed))
        self.by_name = {v.name: v for v in self.described.modelVariables}
        self.log: list[tuple[int, str]] = []
        self.fmu = fmpy.fmi3.FMU3Slave(
            guid=self.described.guid,
            unzipDirectory=str(folder),
            modelIdentifier=self.described.coSimulation.modelIdentifier,
            instanceName="bearing",
        )
        self.fmu.instantiate(logMessage=self._log)
        self.time = 0.0

    def _log(self, _: Any, status: int, category: bytes, message: bytes) -> None:
        assert category in {b"logStatusError", b"logStatusWarning"}
        self.log.append((status, message.decode()))

    def begin(self) -> Driven:
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()
        return self

    def set(self, values: dict[str, float]) -> None:
        references = [self.by_name[name].valueReference for name in values]
        self.fmu.setFloat64(references, list(values.values()))

    def get(self, *names: str) -> list[float]:
        references = [self.by_name[name].valueReference for name in names]
        found: list[float] = self.fmu.getFloat64(references)
        return found

    def step(self, step: float = STEP) -> None:
        reached = self.fmu.doStep(self.time, step)
        self.time = reached[3]

    def everything(self) -> bytes:
        """All outputs, as bits."""
        found: list[float] = []
        for of in self.described.modelVariables:
            if of.causality == "output":
                count = int(np.prod([int(d.start) for d in of.dimensions]))
                found += self.fmu.getFloat64([of.valueReference], nValues=count)
        assert len(found) > 40
        return struct.pack(f"{len(found)}d", *found)


@contextmanager
def driven(packed: Path, count: int = 1) -> Iterator[list[Driven]]:
    """Instances of an FMU, in a folder where it is unpacked."""
    import fmpy

    folder = Path(fmpy.extract(str(packed)))
    made = [Driven(packed, folder) for _ in range(count)]
    yield made
    for one in made:
        one.fmu.freeInstance()
    shutil.rmtree(folder, ignore_errors=True)


@pytest.mark.long
@pytest.mark.parametrize(
    "of",
    [br.bearing("6205", speed_rpm=1800.0), scene(), damaged()],
    ids=["plain", "sprung", "motor"],
)
def test_the_description_validates_and_an_importer_runs_it(of: br.Scene, pack: Pack) -> None:
    """Literature: the schema of FMI 3.0 and the rules that FMPy checks."""
    import fmpy
    from fmpy.validation import validate_fmu

    packed = pack(of)
    assert validate_fmu(str(packed)) == []
    out = fmpy.simulate_fmu(
        str(packed), stop_time=1e-3, output_interval=1e-4, output=["outer.wrench.fy", "row0.inner.load"],
    )  # fmt: skip
    assert len(out) == 11
    assert np.isfinite(out["outer.wrench.fy"]).all()
    assert (out["row0.inner.load"].sum(axis=1) > 0.0).all()
    assert pack(of).read_bytes() == packed.read_bytes()


@pytest.mark.long
@pytest.mark.parametrize("of", [scene(), damaged()], ids=["sprung", "motor"])
def test_under_the_same_loads_it_is_the_run(of: br.Scene, pack: Pack) -> None:
    """Limits: with the same loads it has the bits of a :class:`ballrace.Simulation`, in states and wrenches."""
    simulation = br.Simulation(of, duration=1.0)
    with driven(pack(of)) as (bearing,):
        bearing.begin()
        for k in range(20):
            if k > 10 and "radial" in of.loads:
                force = {"loads.radial.force": 500.0 + k}
                bearing.set(force)
                simulation.set_loads(force)
            bearing.step()
            simulation.advance_to(bearing.time)
            names = [name for name in simulation.names if name.startswith(("outer.", "inner."))]
            state = dict(zip(simulation.names, simulation.state, strict=True))
            assert bearing.get(*names) == [state[name] for name in names]
            for ring in ("outer", "inner"):
                parts = [f"{ring}.wrench.{part}" for part in ("fx", "fy", "fz", "mx", "my", "mz")]
                assert bearing.get(*parts) == list(simulation.wrench(ring))


RING_MASS = 0.06
"""Of the outer ring [kg]."""

GRAVITY = 9.81
"""The scene's along −y [m/s²]; what is outside has its weight, too."""

OUTSIDE = {"stiffness": 1e7, "damping": 200.0}
"""What is added outside to the outer ring's spring [N/m] and damper [N s/m]."""


def coupled(packed: Path, mass: float, step: float, duration: float) -> np.ndarray:
    """The outer ring's y every 50 µs; outside a mass, a spring and a damper, whose force is held for a step."""
    every = round(50e-6 / step)
    found = []
    with driven(packed) as (bearing,):
        bearing.begin()
        for k in range(round(duration / step)):
            y, vy, ax, ay = bearing.get("outer.y", "outer.vy", "outer.ax", "outer.ay")
            if k % every == 0:
                found.append(y)
            force = mass * (ay + GRAVITY) + OUTSIDE["damping"] * vy + OUTSIDE["stiffness"] * y
            bearing.set({"outer.load.fx": -mass * ax, "outer.load.fy": -force})
            bearing.step(step)
    return np.array(found)


@pytest.mark.long
def test_a_ring_mass_outside_converges_to_the_run_with_it(pack: Pack) -> None:
    """Limits: of first order in the communication step, as a force that is held for a step must be."""
    of, duration = scene().replace({"solver.rtol": 1e-9}), 1e-3
    of, added = of.replace({"outer_ring.mass": RING_MASS}), 0.4 * RING_MASS
    whole = br.Simulation(of, duration=1.0)
    whole.change({
        "outer_ring.mass": RING_MASS + added,
        "outer_ring.support.y": br.scene.Spring(
            stiffness=2e7 + OUTSIDE["stiffness"], damping=100.0 + OUTSIDE["damping"]
        ),
    })  # fmt: skip
    at, truth = whole.names.index("outer.y"), []
    for k in range(round(duration / 50e-6)):
        whole.advance_to(k * 50e-6)
        truth.append(whole.state[at])
    packed = pack(of)
    size = np.ptp(truth)
    errors = [
        float(np.max(np.abs(coupled(packed, added, step, duration) - truth))) / size
        for step in (2e-6, 1e-6, 0.5e-6)
    ]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert errors[-1] < 1e-3
    assert (np.abs(orders - 1.0) < 0.05).all(), (errors, orders)


def led(packed: Path, step: float, duration: float) -> np.ndarray:
    """The wrench on the inner ring every 40 µs, led along a sine from outside."""
    found = []
    with driven(packed) as (bearing,):
        bearing.begin()
        for k in range(round(duration / step) + 1):
            if k % round(40e-6 / step) == 0:
                found.append(bearing.get("inner.wrench.fy")[0])
            phase = 2.0 * np.pi * SINE.frequency * bearing.time + SINE.phase
            bearing.set({
                "inner_ring.support.y.given": SINE.mean + SINE.amplitude * np.sin(phase),
                "inner_ring.support.y.given.rate": (
                    SINE.amplitude * 2.0 * np.pi * SINE.frequency * np.cos(phase)
                ),
            })  # fmt: skip
            bearing.step(step)
    return np.array(found)


SINE = br.scene.Sine(mean=-2e-5, amplitude=5e-6, frequency=200.0, phase=-np.pi / 2.0)
"""It begins at rest, as a ring does that is led."""


@pytest.mark.long
def test_a_ring_that_is_led_converges_to_the_run_that_leads_it(pack: Pack) -> None:
    """Limits: of third order in the communication step, as the acceleration since the step before goes on."""
    support = "inner_ring.support"
    held = scene().replace({f"{support}.x": br.scene.Given(0.0), "solver.rtol": 1e-9})
    whole = br.Simulation(held.replace({f"{support}.y": br.scene.Given(SINE)}), duration=1.0)
    truth = []
    for k in range(51):
        whole.advance_to(k * 40e-6)
        truth.append(whole.wrench("inner")[1])
    packed = pack(held.replace({f"{support}.y": br.scene.Given(SINE.mean - SINE.amplitude)}))
    errors = [
        float(np.abs(led(packed, step, 2e-3) - truth)[10:].max() / np.abs(truth).max())
        for step in (40e-6, 20e-6, 10e-6)
    ]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert errors[-1] < 3e-5, errors
    assert (orders > 2.5).all(), (errors, orders)


@pytest.mark.long
def test_a_ring_that_is_led_goes_on_from_its_state(pack: Pack) -> None:
    """Limits: bit by bit, with the speed of the step before; an input that stays leaves the run's bits."""
    place = "inner_ring.support.y.given"
    of = scene().replace({"inner_ring.support.y": br.scene.Given(-2e-5)})

    def moved(bearing: Driven, steps: range) -> list[bytes]:
        found = []
        for k in steps:
            bearing.set({place: -2e-5 - 1e-8 * k * k, f"{place}.rate": -2e-3 * k})
            bearing.step()
            found.append(bearing.everything())
        return found

    simulation = br.Simulation(of, duration=1.0)
    with driven(pack(of), 2) as (bearing, other):
        bearing.begin().step()
        simulation.advance_to(STEP)
        assert bearing.get("inner.wrench.fy")[0] == simulation.wrench("inner")[1]
        moved(bearing, range(10))
        time, state = bearing.time, bearing.fmu.getFMUState()
        first = moved(bearing, range(10, 20))
        words = bearing.fmu.serializeFMUState(state)
        other.fmu.setFMUState(other.fmu.deserializeFMUState(words))
        other.time = time
        assert moved(other, range(10, 20)) == first
        bearing.fmu.freeFMUState(state)


def shaken(bearing: Driven, steps: range) -> list[bytes]:
    """Steps under inputs of every kind, a parameter among them; all outputs after each."""
    found = []
    for k in steps:
        bearing.set({"outer.load.fy": 100.0 * np.sin(k), "loads.radial.force": 500.0 + 5.0 * k})
        if k % 7 == 6:
            bearing.set({"drive.speed": 188.0 + k, "rows[0].clearance": 1e-6 * k})
        bearing.step()
        found.append(bearing.everything())
    return found


@pytest.mark.long
def test_the_guides_program_runs(pack: Pack, monkeypatch: pytest.MonkeyPatch) -> None:
    """The mass outside, which has its weight, shakes the ring and does not run away."""
    page = (ROOT / "docs" / "fmu.md").read_text(encoding="utf-8")
    ((program),) = re.findall(r"^```python no-run\n(.*?)^```", page, re.DOTALL | re.MULTILINE)
    monkeypatch.chdir(pack(br.bearing("6205", radial_load=500.0, speed_rpm=1800.0)).parent)
    names: dict[str, Any] = {}
    exec(program, names)
    assert 1e-7 < abs(names["y"]) < 1e-4
    assert abs(names["vy"]) < 0.1
    names["bearing"].freeInstance()


@pytest.mark.long
def test_states_come_back_bit_by_bit(pack: Pack) -> None:
    """Limits: in the same instance, and through bytes in another one."""
    with driven(pack(scene()), 2) as (bearing, other):
        fmu = bearing.begin().fmu
        shaken(bearing, range(10))
        # With an input that no step has seen yet.
        bearing.set({"outer.load.fx": 30.0})
        time, state = bearing.time, fmu.getFMUState()
        first = shaken(bearing, range(10, 30))
        assert len(set(first)) == 20
        fmu.setFMUState(state)
        bearing.time = time
        assert shaken(bearing, range(10, 30)) == first
        words = fmu.serializeFMUState(state)
        other.fmu.setFMUState(other.fmu.deserializeFMUState(words))
        other.time = time
        assert shaken(other, range(10, 30)) == first
        fmu.freeFMUState(state)


@pytest.mark.long
def test_a_state_with_a_changed_bit_is_refused(pack: Pack) -> None:
    """Limits: every byte of it, a bit of each, and what was cut off."""
    with driven(pack(damaged())) as (bearing,):
        fmu = bearing.begin().fmu
        before = bearing.everything()
        state = fmu.getFMUState()
        words = fmu.serializeFMUState(state)
        fmu.freeFMUState(state)
        changed = [words[: len(words) // 2], words[:-1], words[:5], words + b" "]
        for at in range(len(words)):
            bit = 1 << (at % 8)
            changed.append(words[:at] + bytes([words[at] ^ bit]) + words[at + 1 :])
        for one in changed:
            with pytest.raises(Exception, match="fmi3DeserializeFMUState"):
                fmu.deserializeFMUState(one)
            assert bearing.log[-1][1].startswith("no state of this FMU")
        fmu.setFMUState(fmu.deserializeFMUState(words))
        assert bearing.everything() == before


@pytest.mark.long
def test_phases_are_those_of_the_standard(pack: Pack) -> None:
    """Literature: FMI 3.0, section 2.3: what ends or steps a simulation needs one that is initialised."""
    with driven(pack(scene())) as (bearing,):
        fmu = bearing.fmu

        def refused(call: Callable[[], Any], name: str, where: str) -> None:
            with pytest.raises(Exception, match=name):
                call()
            assert bearing.log[-1][1] == f"{name} may not be called {where}"

        before = "before fmi3EnterInitializationMode"
        refused(fmu.terminate, "fmi3Terminate", before)
        refused(fmu.enterStepMode, "fmi3EnterStepMode", before)
        refused(fmu.exitInitializationMode, "fmi3ExitInitializationMode", before)
        fmu.enterInitializationMode()
        refused(fmu.terminate, "fmi3Terminate", "in initialization mode")
        refused(
            fmu.enterInitializationMode, "fmi3EnterInitializationMode", "in initialization mode"
        )
        fmu.exitInitializationMode()
        fmu.enterStepMode()
        bearing.step()
        last = bearing.everything()
        fmu.terminate()
        # What it has computed can still be read.
        assert bearing.everything() == last
        refused(fmu.terminate, "fmi3Terminate", "after fmi3Terminate")
        refused(bearing.step, "fmi3DoStep", "after fmi3Terminate")
        fmu.reset()
        bearing.time = 0.0
        bearing.begin().step()
        assert bearing.everything() == last


@pytest.mark.long
def test_what_is_refused_is_logged_by_name_and_goes_on(pack: Pack) -> None:
    error = 3
    with driven(pack(scene())) as (bearing,):
        with pytest.raises(Exception, match="fmi3GetFloat64"):
            bearing.get("outer.y")
        with pytest.raises(Exception, match="fmi3DoStep"):
            bearing.step()
        bearing.fmu.enterInitializationMode()
        bearing.set({"rows[0].ball_diameter": -1.0})
        with pytest.raises(Exception, match="fmi3ExitInitializationMode"):
            bearing.fmu.exitInitializationMode()
        assert bearing.log[-1][0] == error
        assert bearing.log[-1][1].startswith("rows[0].ball_diameter = -1")
        bearing.fmu.reset()
        bearing.begin().step()
        good = bearing.everything()
        for name, value, message in [
            ("outer.load.fy", float("nan"), "outer.load.fy = NaN"),
            ("outer.y", 0.0, "outer.y is neither input nor parameter"),
        ]:
            with pytest.raises(Exception, match="fmi3SetFloat64"):
                bearing.set({name: value})
            assert bearing.log[-1][1].startswith(message)
        for name, value in [("outer.load.fy", 1e13), ("contact.damping", -1.0)]:
            before = bearing.get(name)[0]
            bearing.set({name: value})
            with pytest.raises(Exception, match="fmi3DoStep"):
                bearing.step()
            assert re.match(r"(loads.fmu_outer_fy.force|contact.damping) = -?1", bearing.log[-1][1])
            bearing.set({name: before})
            assert bearing.everything() == good
        with pytest.raises(Exception, match="fmi3DoStep"):
            bearing.fmu.doStep(0.5, STEP)
        assert "the simulation stands at 0.00001 s" in bearing.log[-1][1]
        with pytest.raises(Exception, match="fmi3GetFloat64"):
            bearing.fmu.getFloat64([10**6])
        assert bearing.log[-1] == (error, "no variable has the value reference 1000000")
        with pytest.raises(Exception, match="fmi3GetFloat64"):
            bearing.fmu.getFloat64([1, 2], nValues=1)
        with pytest.raises(Exception, match="fmi3SetFMUState"):
            bearing.fmu.setFMUState(None)
        with pytest.raises(Exception, match="fmi3EnterEventMode"):
            bearing.fmu.enterEventMode()
        assert bearing.log[-1] == (error, "fmi3EnterEventMode is not offered")
        bearing.step()
    tampered = pack(scene()).parent
    with driven(tampered / "bearing.fmu") as (bearing,):
        file = Path(bearing.fmu.unzipDirectory, "resources", "scene.toml")
        file.write_text(scene().replace({"gravity": (0.0, 0.0, 0.0)}).to_toml(), encoding="utf-8")
        with pytest.raises(Exception, match="Failed to instantiate"):
            Driven(tampered / "bearing.fmu", Path(bearing.fmu.unzipDirectory))
