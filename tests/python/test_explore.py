"""What the page of `ballrace explore` computes: scenes by its controls, statics, runs, records, files."""

from __future__ import annotations

import io
import json
import math
import re
import subprocess
import sys
import time
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import ballrace as br
from ballrace.explore import at_rest, beside, chosen, saved, sensor
from ballrace.explore.controls import controls, taken
from ballrace.explore.live import Live, solved
from ballrace.explore.picture import pictures
from ballrace.explore.running import Forecast, Runner
from ballrace.explore.settings import Settings

SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture
def begun() -> Settings:
    return Settings.of(br.bearing("6205", radial_load=1000.0, speed_rpm=1800.0))


def answered(settings: Settings) -> Live:
    return solved(settings.scene())


def drawings(live: Live) -> list[ET.Element]:
    return list(ET.fromstring(pictures(live)).iter(f"{SVG}svg"))


@pytest.mark.parametrize("name", br.presets.names())
def test_settings_that_nobody_moved_leave_the_scene_as_it_was(name: str) -> None:
    scene = getattr(br.presets, name)()
    again = Settings.of(scene).scene()
    # But for probes of what the page shows.
    assert again.replace({"probes": dict(scene.probes)}) == scene


def test_a_scene_that_records_nothing_records_what_the_page_shows() -> None:
    scene = Settings.of(br.bearing("6205", speed_rpm=1800.0).replace({"probes": {}})).scene()
    assert {"outer.ay", "inner.theta"} <= set(br.simulate(scene, duration=1e-3, settle=0.0))


MOVES: list[tuple[dict[str, Any], str, Any]] = [
    ({"radial_load": 1500.0}, "loads.radial.force", 1500.0),
    ({"axial_load": -300.0}, "loads.axial.force", -300.0),
    ({"speed_rpm": 3000.0}, "drive.speed", 100.0 * math.pi),
    ({"clearance": 30e-6}, "rows.0.clearance", 30e-6),
    ({"oil": "vg68", "temperature_c": 70.0}, "lubricant.temperature", 343.15),
    ({"moment": 2.0}, "moments.moment.moment", 2.0),
    ({"damage": "spall", "width_mm": 1.5}, "defects.damage.width", 1.5e-3),
    ({"damage": "line", "on": "inner_race"}, "defects.damage.on", "inner_race"),
    ({"damage": "pit", "width_mm": 0.2}, "defects.damage.shape", "pit"),
    ({"damage": "dent", "angle_deg": 90.0}, "defects.damage.angle", math.pi / 2.0),
    ({"housing_mass": 2.0}, "structure.modes.2.mass", 6.0),
]


@pytest.mark.parametrize(("moved", "path", "value"), MOVES, ids=lambda each: str(each)[:40])
def test_each_setting_changes_its_field(
    begun: Settings, moved: dict[str, Any], path: str, value: Any
) -> None:
    found: Any = begun.moved(**moved).scene()
    for part in path.split("."):
        if part.isdigit():
            found = found[int(part)]
        else:
            found = found[part] if hasattr(found, "keys") else getattr(found, part)
    assert found == pytest.approx(value)


def test_what_is_no_one_number_has_no_control() -> None:
    rising = br.scene.Ramp(from_=50.0, to=190.0, start=0.0, end=0.1)
    sine = br.scene.Sine(mean=800.0, amplitude=300.0, frequency=25.0, phase=0.0)
    scene = br.bearing("7208B", housing=None, speed_rpm=1800.0).replace(
        {"drive": br.scene.SpeedDrive(rising), "loads.radial.force": sine}
    )
    begun = Settings.of(scene)
    made = {each.field for each in controls(begun)}
    assert made == {"axial_load", "moment", "temperature_c", "width_mm", "angle_deg", "noise"}
    live = answered(begun)
    assert live.rates[0].shaft == 1.0
    assert "The speed changes" in at_rest.page(live)


@pytest.mark.parametrize("name", ["6205", "7208B", "3206", "618/5"])
def test_controls_stand_on_a_step_within_their_range_and_change_nothing(name: str) -> None:
    begun = Settings.of(br.bearing(name, speed_rpm=1800.0))
    made = controls(begun)
    for each in made:
        assert each.start <= each.value <= each.stop
        steps = (each.value - each.start) / each.step
        assert steps == pytest.approx(round(steps), abs=1e-6), each.field
        field = getattr(begun, each.field)
        assert abs(each.scale * each.value - field) <= 0.501 * each.scale * each.step
    shown = {each.field: each.value for each in made}
    assert taken(begun, made, shown) == begun
    moved = taken(begun, made, shown | {"radial_load": 17.0})
    assert moved == begun.moved(radial_load=17.0)


def test_bearings_by_name_by_size_and_from_a_file(tmp_path: Path) -> None:
    assert (
        chosen.named("SKF 6205-2RSH/C3").rows[0].clearance
        > br.bearing("6205", speed_rpm=1800.0).rows[0].clearance
    )
    assert chosen.named("wheel-bearing") == br.presets.wheel_bearing()
    assert chosen.named("6205", "bare ring") == br.bearing("6205", housing=None, speed_rpm=1800.0)
    with pytest.raises(br.SceneError, match=r"NU205.*roller"):
        chosen.named("NU205")
    scene, made = chosen.described(80.0, 170.0, 39.0, ball_count=8, ball_diameter_mm=28.58)
    assert scene.rows[0].ball_count == 8
    assert scene.rows[0].ball_diameter == pytest.approx(28.58e-3)
    assert "An estimate" in chosen.summary(scene, made)
    (tmp_path / "a.toml").write_text(
        br.bearing("6309", speed_rpm=1800.0).to_toml(), encoding="utf-8"
    )
    assert chosen.read_file(tmp_path / "a.toml") == br.bearing("6309", speed_rpm=1800.0)
    assert chosen.read_file(tmp_path / "a.csv") is None


def test_what_is_solved_is_what_the_functions_find(begun: Settings) -> None:
    """Of the bearing without its damage, whose ball would hang in it."""
    spalled = begun.moved(damage="spall", oil="vg68")
    live = answered(spalled)
    healthy = spalled.moved(damage="none").scene()
    assert live.equilibrium.outer_load == pytest.approx(br.equilibrium(healthy).outer_load)
    assert live.life is not None
    assert live.life.reference == pytest.approx(br.rating_life(healthy).reference)
    shown = at_rest.numbers(live)
    assert shown["largest load"] == f"{live.equilibrium.outer_load.max():.0f} N"
    hours = live.life.hours(live.life.reference)
    assert hours is not None
    assert float(
        re.sub(r"[^\d]", "", shown["L₁₀ᵣ, ISO/TS 16281"].rpartition(", ")[2])
    ) == pytest.approx(hours, rel=1e-3)
    assert f"{br.fault_frequencies(healthy).bpfo:.2f}" in at_rest.page(live)
    assert "Λ" in shown[next(name for name in shown if name.startswith("oil film"))]


def test_a_moment_tilts_the_ring_and_none_is_held(begun: Settings) -> None:
    held, tilted = answered(begun), answered(begun.moved(moment=3.0))
    assert "moment that holds the rings parallel" in at_rest.numbers(held)
    assert tilted.equilibrium.inner_tilt[0] > 0.0
    assert "tilt about x, y" in at_rest.numbers(tilted)


def test_drawings_are_to_scale(begun: Settings) -> None:
    live = answered(begun.moved(damage="spall", width_mm=1.5))
    cut, along, contacts = drawings(live)
    eq = live.equilibrium
    # Balls of a 6205 in metres, in the scale of the group that they are in.
    radii = [float(each.get("r", "nan")) for each in along.iter(f"{SVG}circle")]
    assert sum(r == pytest.approx(0.5 * 7.938e-3, rel=1e-3) for r in radii) == 9
    written = [each.text for each in along.iter(f"{SVG}text")]
    assert f"{eq.outer_load.max():.0f}" in written
    # The pressure of an ellipse, 3 Q/(2 π a b), is that which is written beside it.
    for ellipse, race in zip(contacts.iter(f"{SVG}ellipse"), ("outer", "inner"), strict=True):
        a, b = 1e-3 * float(ellipse.get("rx", "0")), 1e-3 * float(ellipse.get("ry", "0"))
        load = float(getattr(eq, f"{race}_load").max())
        largest = float(getattr(eq, f"{race}_pressure").max())
        assert 1.5 * load / (math.pi * a * b) == pytest.approx(largest, rel=1e-3)
    (spot,) = contacts.iter(f"{SVG}rect")
    assert float(spot.get("width", "0")) == pytest.approx(1.5)
    # Outside and bore of the polygons of the cut, in millimetres.
    listed = " ".join(each.get("points", "") for each in cut.iter(f"{SVG}polygon"))
    heights = [abs(float(pair.split(",")[1])) for pair in listed.split()]
    assert max(heights) == pytest.approx(26.0)
    assert min(heights) == pytest.approx(12.5)


def test_a_drawing_shows_each_row_and_escapes_names() -> None:
    live = answered(Settings.of(br.presets.wheel_bearing().replace({"name": "<b>&"})))
    assert len(drawings(live)) == 5
    ET.fromstring(at_rest.page(live))


def test_a_bearing_that_cannot_carry_its_load_says_so(begun: Settings) -> None:
    with pytest.raises(br.BallraceError):
        answered(begun.moved(radial_load=1e9))
    held = Settings.of(br.bearing("7208B", speed_rpm=1800.0))
    assert answered(held).doubts == ()
    assert "the rings come apart" in at_rest.page(answered(held.moved(axial_load=0.0)))


def test_only_the_newest_run_ends(begun: Settings) -> None:
    runner = Runner()
    first = runner.start(begun.scene(), duration=5.0)
    until = time.monotonic() + 20.0
    while first.state == "waiting" and time.monotonic() < until:
        time.sleep(0.01)
    second = runner.start(begun.moved(radial_load=900.0).scene(), duration=0.02)
    assert first.wait(20.0)
    assert (first.state, first.out) == ("stopped", None)
    assert second.wait(60.0)
    assert second.state == "done"
    assert second.out is not None
    assert second.out.n_samples == 512


def test_a_run_that_waits_is_replaced_before_it_begins(begun: Settings) -> None:
    runner = Runner()
    waiting = runner.start(begun.scene(), duration=5.0, delay=30.0)
    runner.stop()
    assert waiting.wait(5.0)
    assert (waiting.state, waiting.share) == ("stopped", 0.0)


def test_the_newest_scene_is_forecast(begun: Settings) -> None:
    forecast, scenes = Forecast(), [begun.moved(radial_load=500.0 + k).scene() for k in range(3)]
    assert forecast.seconds(None) is None
    for scene in scenes:
        forecast.ask(scene)
    until = time.monotonic() + 60.0
    while forecast.seconds(scenes[-1]) is None and time.monotonic() < until:
        time.sleep(0.05)
    seconds = forecast.seconds(scenes[-1])
    assert seconds is not None
    assert 0.01 < seconds < 60.0
    assert forecast.seconds(scenes[0]) is None


def test_a_run_that_fails_says_why() -> None:
    scene = br.bearing("6205", speed_rpm=1800.0).replace({"loads.radial.force": 1e9})
    run = Runner().start(scene, duration=0.01)
    assert run.wait(60.0)
    assert run.state == "failed"
    assert run.why


@pytest.fixture(scope="module")
def spalled() -> br.Signals:
    spall = br.defects.spall(on="outer_race", width_mm=1.5)
    scene = Settings.of(
        br.bearing("6205", radial_load=1000.0, defects=spall, speed_rpm=1800.0)
    ).scene()
    run = Runner().start(scene, duration=0.4)
    assert run.wait(120.0)
    assert run.out is not None
    return run.out


def test_noise_is_as_strong_as_it_says(spalled: br.Signals) -> None:
    quiet, noisy = sensor.sensed(spalled), sensor.sensed(spalled, 5.0)
    assert quiet.x == pytest.approx(spalled["housing.sensor.ay"])
    assert np.std(noisy.x - quiet.x) == pytest.approx(5.0, rel=0.03)


def test_sound_has_the_record_in_it(spalled: br.Signals) -> None:
    from scipy.io import wavfile

    channel = sensor.sensed(spalled)
    rate, x = wavfile.read(io.BytesIO(sensor.sound(channel)))
    assert rate == channel.fs
    assert np.abs(x).max() == pytest.approx(0.9 * 32767, rel=1e-4)
    middle = slice(1000, -1000)
    scaled = channel.x - channel.x.mean()
    assert np.corrcoef(x[middle], scaled[middle])[0, 1] > 0.9999
    assert (abs(x[0]), abs(x[-1])) == (0, 0)


def test_figures_of_a_run_have_its_lines(spalled: br.Signals) -> None:
    channel, rates = sensor.sensed(spalled, 0.1), sensor.rates_of(spalled)
    names = [note.text for note in sensor.envelope(channel, rates).layout.annotations]
    assert any("BPFO" in name for name in names)
    assert sensor.waveform(channel, rates).data
    assert sensor.orders(channel, spalled).data[0].type == "heatmap"


def record(spalled: br.Signals, tmp_path: Path, name: str = "record.csv") -> bytes:
    path = tmp_path / name
    sensed = sensor.sensed(spalled, 1.0)
    br.Recording(columns={"a": sensed.x}, fs=sensed.fs, units={"a": "m/s^2"}).write(path)
    return path.read_bytes()


def test_a_dropped_record_gets_the_verdict_of_diagnose(spalled: br.Signals, tmp_path: Path) -> None:
    dropped = beside.received("pump <3>.csv", record(spalled, tmp_path))
    assert dropped.record.source == "pump <3>.csv"
    channel, found = beside.judged(dropped, "a", spalled.scene, speed_rpm=None, unit=None)
    healthy = spalled.scene.replace({"defects": {}})
    alone = br.diagnose(channel, healthy, 1800.0)
    assert (found.verdict, found.parts) == (alone.verdict, alone.parts)
    fig = beside.overlaid(sensor.sensed(spalled), channel, sensor.rates_of(spalled), found)
    names = [trace.name for trace in fig.data if trace.mode == "lines"]
    assert {"simulated", "measured"} <= set(names)
    for trace in fig.data:
        if trace.name in ("simulated", "measured"):
            assert max(trace.y) == pytest.approx(1.0, abs=0.05)
    assert beside.overlaid(None, channel, None, found).data[0].name == "measured"


def test_of_a_very_long_record_the_beginning_is_judged(
    spalled: br.Signals, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A verdict on all of a file of 30 MB took 15 GB of memory."""
    monkeypatch.setattr(beside, "_LONGEST", 8000)
    dropped = beside.received("pump.csv", record(spalled, tmp_path))
    channel, found = beside.judged(dropped, "a", spalled.scene, speed_rpm=None, unit=None)
    assert np.array_equal(channel.x, dropped.record["a"][:8000])
    healthy = spalled.scene.replace({"defects": {}})
    assert found.rows() == br.diagnose(channel, healthy, 1800.0).rows()
    text = beside.left_out(dropped, channel)
    assert text.startswith("Judged are the first 0.312 s of the record's 0.4 s")
    monkeypatch.setattr(beside, "_LONGEST", 10**9)
    channel, _ = beside.judged(dropped, "a", spalled.scene, speed_rpm=None, unit=None)
    assert beside.left_out(dropped, channel) == ""


def test_a_record_in_g_is_taken_as_what_it_is(spalled: br.Signals, tmp_path: Path) -> None:
    plain = np.column_stack([sensor.sensed(spalled).x / 9.80665])
    text = "\n".join(f"{each:.9g}" for each in plain[:, 0])
    dropped = beside.received("record.csv", text.encode(), spalled.fs)
    (column,) = dropped.record
    channel, _ = beside.judged(dropped, column, spalled.scene, speed_rpm=1800.0, unit="g")
    assert channel.unit == "m/s^2"
    assert np.std(channel.x) == pytest.approx(np.std(spalled["housing.sensor.ay"]), rel=1e-6)


def test_a_damaged_file_is_refused_by_its_own_name() -> None:
    with pytest.raises(br.FileError, match=r"pump\.mat") as caught:
        beside.received("pump.mat", b"nothing of the kind", 12_000.0)
    assert "/tmp" not in str(caught.value)


def test_what_a_dropped_file_does_not_say_is_said_by_controls() -> None:
    empty = {"skip": 0, "columns": "", "decimal": None, "time": "", "time_unit": None}
    assert (
        beside.received("a.csv", b"0.5\n" * 50, 1000.0, **beside.said_by(empty)).record.fs == 1000.0
    )
    lines = "".join(f"{40 * k};{k % 7},{k % 3}\n" for k in range(50))
    said = {"skip": 2, "columns": "1", "decimal": ",", "time": "0", "time_unit": "us"}
    dropped = beside.received("a.csv", f"1;2\n3;4\n{lines}".encode(), None, **beside.said_by(said))
    assert (list(dropped.record), dropped.record.fs) == (["column_2"], 25_000.0)
    assert beside.said_by(empty | {"time": " none", "columns": "a, -1"}) == {
        "skip": None, "decimal": None, "time_unit": None, "columns": ["a", -1], "time": False,
    }  # fmt: skip


def test_a_saved_scene_is_the_scene(begun: Settings) -> None:
    scene = begun.moved(damage="dent", moment=1.0, oil="vg68").scene()
    assert br.Scene.from_toml(saved.scene_file(scene).decode()) == scene


def test_a_saved_notebook_runs_and_does_what_the_page_did(begun: Settings) -> None:
    scene = begun.scene().replace({"name": "a \"\"\" ''' \\ name"})
    written = json.loads(saved.notebook(scene, 0.02, 1.5))
    variables: dict[str, Any] = {}
    for cell in written["cells"]:
        if cell["cell_type"] == "code":
            exec(cell["source"], variables)
    assert variables["scene"] == scene
    run = Runner().start(scene, duration=0.02)
    assert run.wait(60.0)
    assert run.out is not None
    assert variables["record"].x == pytest.approx(sensor.sensed(run.out, 1.5).x)


def test_a_saved_report_is_that_of_the_run(spalled: br.Signals) -> None:
    assert b"Ball loads, contact pressure and rating life" in saved.report(spalled)


def test_the_command_refuses_what_cannot_be_shown(tmp_path: Path) -> None:
    pytest.importorskip("marimo", reason="marimo is not installed")
    (tmp_path / "bad.toml").write_text("rows = 3", encoding="utf-8")
    for arguments, message in (
        (["bad.toml"], "rows"),
        (["missing.csv"], "missing.csv"),
        (["--port", "70000"], "1 to 65535"),
    ):
        done = subprocess.run(
            [sys.executable, "-m", "ballrace", "explore", "--no-browser", *arguments],
            cwd=tmp_path, capture_output=True, text=True, timeout=60.0, check=False,
        )  # fmt: skip
        assert (done.returncode, done.stdout) == (2, "")
        assert message in done.stderr


def test_without_marimo_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    from ballrace.explore.served import served

    monkeypatch.setitem(sys.modules, "marimo", None)
    with pytest.raises(ImportError, match=r"ballrace\[app\]"), served():
        pass


def test_a_faster_bearing_spins_freely() -> None:
    """Truth: `br.bearing` at that speed. The page began at 1800 rev/min, where the axis may be held."""
    slow = br.bearing("7208B", radial_load=0.0, axial_load=1000.0, speed_rpm=1800.0)
    fast = Settings.of(slow).moved(speed_rpm=10_000.0).scene()
    assert fast.spin == "free"
    assert Settings.of(fast).moved(speed_rpm=100.0).scene().spin is None
    held = Settings.of(slow.replace({"spin": "axial"})).moved(speed_rpm=10_000.0).scene()
    assert held.spin == "axial"
