"""Structures with modes: documents, tables, columns, runs in pieces."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import ballrace as br
from ballrace import scene as s

FOOT = br.Mode(
    frequency=1200.0, damping=0.05, mass=2.0, seat=(0.0, 1.0, 0.0), sensors={"top": (0.0, 1.0, 0.0)}
)
WALL = br.Mode(
    frequency=4800.0, damping=0.03, mass=0.3, seat=(0.2, 0.5, 0.0),
    sensors={"top": (-0.5, -1.0, 0.0), "side": (1.0, 0.0, 0.0)},
)  # fmt: skip


def seated(**more: Any) -> br.Scene:
    structure = br.Structure(modes=(FOOT, WALL))
    return br.bearing("6205", radial_load=500.0, speed_rpm=1797.0, housing=structure, **more)


def test_documents_have_the_structure() -> None:
    """Truth: what was written. Scenes without one do not name it."""
    scene = seated()
    assert br.Scene.from_toml(scene.to_toml()) == scene == br.Scene.from_json(scene.to_json())
    assert scene.structure is not None
    assert scene.structure.sensors == ("side", "top")
    assert "structure" not in br.presets.deep_groove_6205().to_json()
    softer = scene.replace({"structure.static_compliance": [1e-9, 2e-9, 0.0]})
    assert softer.structure is not None
    assert softer.structure.static_compliance == (1e-9, 2e-9, 0.0)
    assert br.Scene.from_toml(softer.to_toml()) == softer
    assert hash(scene) != hash(scene.replace({"structure.modes[0].mass": 3.0}))


def test_a_table_is_read_as_written(tmp_path: Path) -> None:
    """Truth: what was written, and a table by hand in another order."""
    structure = br.Structure(modes=(FOOT, WALL))
    structure.to_table(tmp_path / "modes.csv")
    read = br.Structure.from_table(tmp_path / "modes.csv")
    assert read.modes[0].sensors == {**FOOT.sensors, "side": (0.0, 0.0, 0.0)}
    assert read.modes[1] == WALL
    assert read.sensors == structure.sensors
    text = "mass, frequency , damping, seat.y, top.y\n2, 1200, 0.05, 1, -1\n"
    (tmp_path / "short.csv").write_text(text, encoding="utf-8")
    (mode,) = br.Structure.from_table(tmp_path / "short.csv").modes
    assert (mode.mass, mode.seat, mode.sensors) == (2.0, (0.0, 1.0, 0.0), {"top": (0.0, -1.0, 0.0)})


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("frequency,damping,seat.y\n1,0,1\n", "columns = no mass"),
        ("frequency,damping,mass\n1,0,1\n", "columns = no seat.x, seat.y or seat.z"),
        ("frequency,damping,mass,seat\n1,0,1,1\n", "columns = 'seat'"),
        ("frequency,damping,mass,seat.y,seat.y\n1,0,1,1,1\n", "columns = 'seat.y'"),
        ("frequency,damping,mass,seat.y\n1,0,1\n", "line 2 = a line of another length"),
        ("frequency,damping,mass,seat.y\n1,0,1,much\n", "line 2, seat.y = 'much'"),
    ],
)
def test_a_wrong_table_is_refused(tmp_path: Path, text: str, message: str) -> None:
    """It names line and column."""
    (tmp_path / "modes.csv").write_text(text, encoding="utf-8")
    with pytest.raises(br.SceneError) as refused:
        br.Structure.from_table(tmp_path / "modes.csv")
    assert message in str(refused.value)


def test_what_cannot_be_is_refused() -> None:
    """Each by its field."""
    scene = seated()
    indefinite = [[1e-9, 2e-9, 0.0], [2e-9, 1e-9, 0.0], [0.0, 0.0, 0.0]]
    changes: list[tuple[str, object, str]] = [
        ("outer_ring.support.y", "fixed", "the structure moves the seat along y"),
        ("structure.static_compliance", indefinite, "semidefinite"),
        ("probes.housing", s.StructureProbe(sensors=("low",)), "of the structure: side, top"),
    ]
    for path, value, message in changes:
        with pytest.raises(br.SceneError, match=message):
            scene.replace({path: value})
    with pytest.raises(br.SceneError, match="give the scene a `structure`"):
        br.presets.deep_groove_6205().replace({"probes.seat": s.SeatProbe()})
    with pytest.raises(br.SceneError, match="housing"):
        br.bearing("6205", speed_rpm=1500.0, housing="stool")  # type: ignore[arg-type]


def test_sensors_measure_what_the_modes_do() -> None:
    """Truth: the equation of the foot, driven by the recorded force; the columns of a bearing."""
    scene = seated(defects=br.defects.spall(on="outer_race", width_mm=1.0))
    out = br.simulate(scene, duration=0.01, fs=400e3, bandwidth=None)
    assert [name for name in out.names if name.startswith(("housing", "seat"))] == [
        *(f"housing.{sensor}.a{axis}" for sensor in ("side", "top") for axis in "xyz"),
        *(f"seat.f{axis}" for axis in "xyz"),
    ]
    assert (out.units["housing.top.ay"], out.units["seat.fy"]) == ("m/s^2", "N")
    omega, h = 2.0 * np.pi * FOOT.frequency, 1.0 / out.fs
    # Without the wall's part, which the sensor aside has alone: a'' + 2 ζ ω a' + ω² a = F''/m.
    a = out["housing.top.ay"] + out["housing.side.ax"]
    left = np.diff(a, 2) / h**2 + FOOT.damping * omega * (a[2:] - a[:-2]) / h + omega**2 * a[1:-1]
    right = np.diff(out["seat.fy"], 2) / h**2 / FOOT.mass
    assert np.sqrt(np.mean((left - right) ** 2)) < 0.05 * np.sqrt(np.mean(right**2))


def test_a_run_in_pieces_is_the_run() -> None:
    """Truth: the run in one piece, to the bit."""
    scene = seated()
    whole = br.simulate(scene, duration=0.01)
    simulation = br.Simulation(scene, duration=0.01)
    simulation.advance_to(0.004)
    again = br.Simulation.restore(simulation.snapshot())
    again.advance_to(0.01)
    found = again.finish()
    for name in ("housing.top.ay", "seat.fy", "outer.ay"):
        assert np.array_equal(found[name], whole[name]), name


def test_explanation_and_campaign_know_it(tmp_path: Path) -> None:
    """Truth: a heavier foot moves less."""
    scene = seated()
    assert "structure" in str(br.explain(scene))
    table = [{"structure.modes[0].mass": mass} for mass in (2.0, 8.0)]
    done = br.campaign(
        table, tmp_path, scene=scene, duration=0.05, columns=["housing.top.ay"], progress=False
    )
    light, heavy = done.manifest["housing.top.ay.rms"].to_list()
    assert 0.0 < heavy < light


def test_grease_holds_balls_without_load() -> None:
    """Truth: the same bearing dry, whose unloaded balls strike their races again and again.

    On impacts of a spall, which loaded balls make, the film has little to say.
    """

    def shaken(width: float | None, **changes: Any) -> float:
        spall = None if width is None else br.defects.spall(on="outer_race", width_mm=width)
        scene = br.bearing(
            "6205", radial_load=500.0, speed_rpm=1797.0, housing=None, defects=spall
        ).replace(changes)
        return float(np.std(br.simulate(scene, duration=0.15)["outer.ay"][2500:]))

    dry = {"contact.squeeze": None}
    assert shaken(None) < 0.6 * shaken(None, **dry)
    assert shaken(1.0) > 0.7 * shaken(1.0, **dry)


def test_films_grow_with_the_balls() -> None:
    """Truth: the rule. Damping goes with the area of the balls; a 6205 has the defaults."""
    films = [br.bearing(name, speed_rpm=1000.0).contact.squeeze for name in ("6205", "6310")]
    small, large = (film for film in films if film is not None)
    assert small == s.SqueezeFilm()
    grown = br.catalogue["6310"].ball_diameter / br.catalogue["6205"].ball_diameter
    assert large.damping == pytest.approx(grown**2 * small.damping, rel=1e-12)
    assert large.thickness == small.thickness
