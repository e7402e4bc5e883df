"""The right-hand side against a second implementation, and that implementation against physics.

Truth: `reference.py`, written from the model page alone. States have the balls inside the defects'
arcs, where random states almost never are.
"""

import copy
import dataclasses
import importlib
import json
import math
import zlib
from typing import Any

import numpy as np
import pytest

from reference import INNER, OUTER, Body, Contact, Json, Reference, Vector, hertz, unit, wrap

TAU = 2 * math.pi
KINDS = ["healthy", "outer", "inner", "ball", "outer+ball", "overlap", "floor"]
LAWS = ["iso", "hertz_fixed"]
# Inside a defect fitted nodes depend on a search for the ends of the elements' zones; tests/analytic/fitted.rs
# holds them to a converged sum. Here they are compared on whole races.
FITTED = ["iso_fitted", "hertz_fitted"]
CASES = [(kind, law) for kind in KINDS for law in LAWS] + [("healthy", law) for law in FITTED]
# What must carry force, lest a comparison pass without having looked at a defect.
EXPECTED = {
    "healthy": ["race"],
    "outer": ["edge", "race_in_defect"],
    "inner": ["edge"],
    "ball": ["race+ball_edge", "race+in_ball_defect"],
    "outer+ball": ["edge+ball_edge"],
    "overlap": ["edge"],
    "floor": ["floor"],
}
FREE: Json = {"x": None, "y": None, "z": None, "theta": None}


@pytest.fixture(scope="module")
def core() -> Any:
    """The extension module."""
    return importlib.import_module("ballrace._core")


# ---------------------------------------------------------------------------- scenes


def spring(stiffness: float, damping: float) -> Json:
    return {"spring": {"stiffness": stiffness, "damping": damping}}


def make_row(side: int, place: float, balls: int) -> Json:
    return {
        "ball_count": balls,
        "ball_diameter": 11.9e-3,
        "pitch_diameter": 60e-3,
        "outer_conformity": 0.525,
        "inner_conformity": 0.515,
        "contact_angle": math.radians(15),
        "side": side,
        "axial_position": place,
        "clearance": -120e-6,  # 30 µm of interference at each race
        "axial_preload": 0.0,
        "start_angle": 0.3,
        "outer_shoulders": None,
        "inner_shoulders": None,
        "outer_waviness": [],
        "inner_waviness": [],
        "diameter_errors": [],
        "ball_mass": None,
        "ball_inertia": None,
        "ball_support": FREE,
    }


def make_scene(rows: int = 1, law: str = "iso", balls: int = 3) -> Json:
    """A healthy bearing without friction, supports, gravity or loads."""
    iso = {"iso16281": {"constant": 3.5948e10, "length_ratio": 0.5}}
    slices = {"iso": {"fixed": 40}, "hertz_fixed": {"fixed": 30}}
    material = {"density": 7850.0, "youngs_modulus": 206e9, "poisson_ratio": 0.3}
    ring = {"mass": 0.8, "inertia": None, "diameter": None, "width": None}
    moving = {"x": "free", "y": "free", "z": "free", "theta": "free"}
    places = [(1, -11e-3), (-1, 11e-3)][:rows]
    return {
        "schema": 1,
        "name": "reference",
        "rows": [make_row(side, place, balls) for side, place in places],
        "outer_ring": ring | {"support": moving},
        "inner_ring": ring | {"mass": 0.6, "support": FREE},
        "materials": {"rings": material, "balls": material},
        "contact": {
            "law": iso if law.startswith("iso") else "hertz",
            "slices": slices.get(law, {"fitted": 6}),
            "damping": 1.0,
            "clamp_pull": True,
        },
        "friction": "none",
        "cage": None,
        "drive": {"speed": 190.0},
        "gravity": [0.0, 0.0, 0.0],
        "loads": {},
        "unbalances": {},
        "defects": {},
        "probes": {},
        "solver": {"rtol": 1e-7, "first_step": None, "max_step": None},
    }


def make_defect(scene: Json, on: str, **changes: Any) -> Json:
    """A defect in the loaded zone of the last row."""
    index = len(scene["rows"]) - 1
    row = scene["rows"][index]
    # Contacts lie at ±s R sin α₀ from the ball's centre; a defect of a ball covers both.
    place = row["side"] * row["ball_diameter"] / 2 * math.sin(row["contact_angle"])
    offset = {"outer_race": place + 0.21e-3, "inner_race": -place - 0.13e-3, "ball": 0.11e-3}[on]
    defect = {
        "on": on,
        "row": index,
        "ball": 0 if on == "ball" else None,
        "angle": -1.4,
        "axial_offset": offset,
        "length": 4.67e-3 if on == "ball" else 1.23e-3,
        "width": 0.8e-3,
        "edge_radius": 0.3e-3,
        "floor": None,
    }
    return defect | changes


def add_defects(scene: Json, kind: str) -> None:
    """The defects of one of the kinds of scene."""
    varying = {"positions": [-0.5e-3, 0.1e-3, 0.6e-3], "widths": [0.5e-3, 0.9e-3, 0.7e-3]}
    along_ball = {"positions": [-2e-3, 2e-3], "widths": [0.5e-3, 0.8e-3]}
    outer = make_defect(scene, "outer_race", width=varying)
    wide = make_defect(scene, "ball", angle=0.7, width=1.1e-3, edge_radius=0.2e-3)
    floor = {"depth": 3e-6, "elements": 4}
    defects = {
        "healthy": {},
        "outer": {"a": outer},
        "inner": {"a": make_defect(scene, "inner_race", angle=2.9)},
        "ball": {"a": make_defect(scene, "ball", angle=0.7, width=along_ball)},
        "outer+ball": {"a": make_defect(scene, "outer_race", width=0.6e-3), "b": wide},
        "overlap": {
            "a": outer,
            "b": make_defect(
                scene, "outer_race", angle=-1.385, width=0.5e-3, length=1.01e-3, edge_radius=0.2e-3
            ),
        },
        "floor": {
            "a": outer | {"floor": floor},
            "b": make_defect(scene, "ball", angle=0.7, floor={"depth": 4e-6, "elements": 2}),
        },
    }
    scene["defects"] = defects[kind]


AVERAGING = {"outer": 1e-30, "reference_load": 800.0}
"""A texture of nothing: it says by which contact waves are averaged, and makes a table of those of a race."""


def sprinkle_row(row: Json, rng: np.random.Generator) -> None:
    """What a row can have, each with even odds."""

    def chance() -> bool:
        return bool(rng.random() < 0.5)

    if chance():
        row["outer_shoulders"] = [0.48, 0.51]
    if chance():
        row["inner_shoulders"] = [0.49, 0.47]
    if chance():
        row["outer_waviness"] = [{"order": 7, "amplitude": 2e-6, "phase": 0.4}]
    if chance():
        row["inner_waviness"] = [
            {"order": 11, "amplitude": 1e-6, "phase": -0.3},
            {"order": 4, "amplitude": 2e-6, "phase": 1.0},
        ]
    if chance():
        row["diameter_errors"] = [rng.uniform(-5e-6, 5e-6) for _ in range(row["ball_count"])]
    if chance():
        row["axial_preload"] = 5e-6
    if chance():
        row["ball_mass"], row["ball_inertia"] = 7.1e-3, 1.1e-7
    if chance():
        row["ball_support"] = FREE | {"x": spring(1e4, 3.0), "theta": spring(0.1, 1e-4)}


def sprinkle(scene: Json, rng: np.random.Generator) -> None:
    """Everything else a scene can have, each with even odds."""

    def chance() -> bool:
        return bool(rng.random() < 0.5)

    for row in scene["rows"]:
        sprinkle_row(row, rng)
        if row["outer_waviness"] or row["inner_waviness"]:
            row["texture"] = AVERAGING
    if chance():
        mounts = {q: spring(1e8, 2e3) for q in "xyz"}
        scene["outer_ring"]["support"] = mounts | {"theta": spring(1e4, 1.0)}
    else:
        scene["outer_ring"]["support"] = FREE | {"y": spring(1e8, 2e3), "z": "free"}
    if chance():
        scene["inner_ring"]["support"] = FREE | {q: spring(0.0, 500.0) for q in "xyz"}
    if chance():
        play = 0.2e-3 if chance() else 0.0
        scene["cage"] = {"stiffness": 1e6, "damping": 20.0, "play": play}
    speed = {"mean": 190.0, "amplitude": 5.0, "frequency": 40.0, "phase": 0.2}
    times = {"times": [0.0, 0.1, 0.1, 0.2], "values": [1.0, 2.0, 3.0, 0.0]}
    scene["drive"] = (
        {"speed": {"sine": speed}}
        if chance()
        else {"torque": {"value": {"table": times}, "initial_speed": 190.0}}
    )
    scene["gravity"] = [0.0, -9.81, 1.0]
    ramp = {"ramp": {"from": 100.0, "to": 4000.0, "start": 0.01, "end": 0.3}}
    scene["loads"] = {
        "radial": {"ring": "inner", "direction": [1.0, -3.0, 0.5], "force": ramp},
        "other": {"ring": "outer", "direction": [0.0, 0.0, -2.0], "force": 300.0},
    }
    scene["unbalances"] = {"u": {"ring": "inner", "moment": 1e-4, "angle": 0.4}}
    scene["contact"]["clamp_pull"] = bool(rng.random() < 0.7)


# ---------------------------------------------------------------------------- states


def draw_state(
    scene: Json, rng: np.random.Generator, displacement: complex = 0.0, jitter: float = 15e-6
) -> Vector:
    """A rolling state with ball 0 of a defect's row inside the defect's arc.

    `displacement` of the inner ring presses on the balls of one side; they follow by half.
    """
    Omega = float(rng.uniform(150, 230))
    q = [[*rng.uniform(-10e-6, 10e-6, 3), float(rng.uniform(-3, 3))] for _ in range(2)]
    q[INNER][0] += displacement.real
    q[INNER][1] += displacement.imag
    v = [
        [*rng.uniform(-0.2, 0.2, 3), float(rng.uniform(-1, 1))],
        [*rng.uniform(-0.2, 0.2, 3), Omega],
    ]
    defects = list(scene["defects"].values())
    for index, row in enumerate(scene["rows"]):
        D, d_m, Z = row["ball_diameter"], row["pitch_diameter"], row["ball_count"]
        alpha = row["contact_angle"]
        omega_c = Omega * (1 - D * math.cos(alpha) / d_m) / 2
        mine = [x for x in defects if x["row"] == index]
        on_ring = next((x for x in mine if x["on"] != "ball"), None)
        on_ball = next((x for x in mine if x["on"] == "ball"), None)
        ring, angle = OUTER, float(rng.uniform(-3, 3))
        if on_ring is not None:
            ring = OUTER if on_ring["on"] == "outer_race" else INNER
            half = least_width(on_ring) / (d_m + (D if ring == OUTER else -D))
            angle = on_ring["angle"] + q[ring][3] + 0.95 * half * float(rng.uniform(-1, 1))
        elif on_ball is not None:
            ring = int(rng.integers(2))
        centre = complex(q[ring][0], q[ring][1])
        for j in range(Z):
            phi = angle + TAU * j / Z + (float(rng.uniform(-0.008, 0.008)) if j else 0.0)
            radius = d_m / 2 + float(rng.uniform(-jitter, jitter))
            radius += (displacement / 2 * unit(-phi)).real
            c = centre + radius * unit(phi)
            theta = float(rng.uniform(-3, 3))
            if j == 0 and on_ball is not None:
                theta = turn_to_contact(row, on_ball, phi if ring == OUTER else phi + math.pi, rng)
                if on_ring and on_ring["floor"] is None and rng.random() < 0.85:
                    beyond = float(rng.uniform(-0.07e-3, 0.07e-3))
                    theta = meet_edges(row, on_ring, on_ball, (c, q[OUTER]), beyond)
            q.append([c.real, c.imag, row["axial_position"] + rng.uniform(-jitter, jitter), theta])
            w = omega_c * d_m / 2 * 1j * unit(phi)
            noise = rng.uniform(-1, 1, 3) * [1.0, 1.0, 0.3]
            spin = -omega_c * d_m / (D * math.cos(alpha)) * float(rng.uniform(0.9, 1.1))
            v.append([w.real + noise[0], w.imag + noise[1], noise[2], spin])
    return np.array([*np.ravel(q), *np.ravel(v)])


def turn_to_contact(row: Json, defect: Json, facing: float, rng: np.random.Generator) -> float:
    """Angle of a ball that turns its defect to a direction."""
    share = 0.95 * float(rng.uniform(-1, 1))
    half = least_width(defect) / float(row["ball_diameter"])
    return facing - float(defect["angle"]) + share * half


def meet_edges(
    row: Json, on_ring: Json, on_ball: Json, places: tuple[complex, list[float]], beyond: float
) -> float:
    """Angle of a ball that lays an edge of its defect just beyond the nearer edge of the race's."""
    ball, ring = places
    D, R = float(row["ball_diameter"]), (row["pitch_diameter"] + row["ball_diameter"]) / 2
    half = least_width(on_ring) / (2 * R)
    circles = [
        complex(ring[0], ring[1])
        + (R + on_ring["edge_radius"]) * unit(on_ring["angle"] + side * half + ring[3])
        for side in (-1, 1)
    ]
    line = min((c - ball for c in circles), key=abs)
    reach = least_width(on_ball) / (D * math.cos(row["contact_angle"])) - 2 * abs(beyond) / D
    facing = math.atan2(line.imag, line.real) - float(on_ball["angle"])
    return facing + math.copysign(reach, beyond)


def least_width(defect: Json) -> float:
    width = defect["width"]
    return float(min(width["widths"])) if isinstance(width, dict) else float(width)


# ---------------------------------------------------------------------------- the comparison


def with_steep_friction(scene: Json) -> Json:
    """Return the scene with friction too steep for weights of its own at fitted nodes.

    The reference does not know such weights; `tests/analytic/friction.rs` tests them.
    """
    friction = scene["friction"]
    if friction == "none" or "fitted" not in scene["contact"]["slices"]:
        return scene
    steep = {law: values | {"slip_speed": 1e-3} for law, values in friction.items()}
    return scene | {"friction": steep}


def compare(core: Any, scene: Json, states: list[Vector], t: float = 0.123) -> list[Json]:
    """Compares accelerations; returns what carried force in the states that count."""
    scene = with_steep_friction(scene)
    reference, model = Reference(scene), core.Model(json.dumps(scene))
    assert list(model.names) == reference.names
    half, fixed = 4 * reference.body_count, reference.fixed().ravel()
    active: list[Json] = []
    for y in states:
        expected, actual = reference.rhs(t, y), np.asarray(model.rhs(t, y))
        if reference.nearest < 1e-12:
            continue
        active.append(dict(reference.active))
        np.testing.assert_array_equal(actual[:half], y[half:])
        difference = (actual - expected)[half:]
        assert np.all(np.abs(difference[fixed]) <= 1e-14 * np.abs(expected[half:][fixed]))
        # Compare forces: differences relative to the sum of the magnitudes on that body.
        mass, size = reference.mass.ravel()[~fixed], reference.magnitudes.ravel()[~fixed]
        error = np.abs(difference[~fixed]) * mass
        names = np.array(reference.names[:half])[~fixed]
        # A lightly loaded ball: 1e-16 m of round-off in a penetration, at 1e8 N/m.
        least = np.tile([1e-8, 1e-8, 1e-8, 1e-10], reference.body_count)[~fixed]
        allowed = np.maximum(1e-11 * size, least)
        worst = int(np.argmax(error / allowed))
        assert np.all(error <= allowed), (
            f"{names[worst]}: error {error[worst]:.3e} of {size[worst]:.3e}; "
            f"active {active[-1]}, threshold at {reference.nearest:.1e} m"
        )
    return active


def check_active(active: list[Json], kind: str, states: int) -> None:
    assert len(active) >= states - 1  # hardly any state lies on a threshold
    for name in EXPECTED[kind]:
        share = sum(name in one for one in active) / len(active)
        assert share > 0.3, f"{name} carried force in {share:.0%} of the states"
    share = sum(set(one) != {"race"} for one in active) / len(active)
    assert kind == "healthy" or share >= 0.75


def combination(kind: str, rows: int, law: str, friction: str) -> tuple[Json, np.random.Generator]:
    """The scene of one combination, with its random numbers."""
    rng = np.random.default_rng(zlib.crc32(f"{kind} {rows} {law} {friction}".encode()))
    scene = make_scene(rows, law, balls=4 if rows == 1 else 3)
    add_defects(scene, kind)
    sprinkle(scene, rng)
    if friction == "coulomb":
        scene["friction"] = {"coulomb": {"coefficient": 0.05, "slip_speed": 0.1}}
    return scene, rng


@pytest.mark.parametrize("friction", ["none", "coulomb"])
@pytest.mark.parametrize("rows", [1, 2])
@pytest.mark.parametrize(("kind", "law"), CASES)
def test_right_hand_side(core: Any, kind: str, rows: int, law: str, friction: str) -> None:
    scene, rng = combination(kind, rows, law, friction)
    states = [draw_state(scene, rng) for _ in range(8)]
    check_active(compare(core, scene, states), kind, len(states))


FRICTIONS: list[Json] = [
    {
        "stribeck": {
            "static_coefficient": 0.12,
            "kinetic_coefficient": 0.05,
            "stribeck_speed": 0.3,
            "slip_speed": 0.05,
        }
    },
    {"traction": {"a": -0.03, "b": 0.4, "c": 2.0, "d": 0.04, "slip_speed": 0.05}},
]


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("friction", FRICTIONS, ids=["stribeck", "traction"])
def test_friction_laws(core: Any, friction: Json, law: str) -> None:
    rng = np.random.default_rng(5)
    scene = make_scene(1, law)
    add_defects(scene, "outer")
    scene["friction"] = friction
    states = [draw_state(scene, rng) for _ in range(3)]
    check_active(compare(core, scene, states), "outer", len(states))


@pytest.mark.parametrize("balls", [1, 2])
def test_few_balls(core: Any, balls: int) -> None:
    """One ball has no cage link, two have one."""
    rng = np.random.default_rng(balls)
    scene = make_scene(1, "hertz_fitted", balls)
    scene["cage"] = {"stiffness": 1e6, "damping": 20.0, "play": 0.0}
    check_active(compare(core, scene, [draw_state(scene, rng) for _ in range(3)]), "healthy", 3)


@pytest.mark.parametrize("axial_load", [0.0, 3000.0])
def test_wheel_bearing(core: Any, axial_load: float) -> None:
    scene = json.loads(core.preset_wheel_bearing(axial_load))
    scene["contact"]["slices"] = {"fixed": 100}
    rng = np.random.default_rng(int(axial_load))
    states = [draw_state(scene, rng, -60e-6j) for _ in range(4)]
    compare(core, scene, states)


def test_deep_groove(core: Any) -> None:
    scene = json.loads(core.preset_deep_groove_6205(500.0, 100.0, 1800.0))
    # Masses from dimensions are not the reference's business.
    scene["outer_ring"] |= {"mass": 0.1, "inertia": 5e-5}
    scene["inner_ring"] |= {"mass": 1.0, "inertia": 1e-4}
    rng = np.random.default_rng(6205)
    states = [draw_state(scene, rng, -40e-6j, 5e-6) for _ in range(6)]
    check_active(compare(core, scene, states), "healthy", len(states))


# ---------------------------------------------------------------------------- the reference itself


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("kind", KINDS)
def test_reference_conserves_momentum(kind: str, law: str) -> None:
    """Internal forces, friction included, sum to no force and no moment about z."""
    rng = np.random.default_rng(1)
    scene = make_scene(2, law)
    add_defects(scene, kind)
    scene["friction"] = {"coulomb": {"coefficient": 0.05, "slip_speed": 0.1}}
    scene["cage"] = {"stiffness": 1e6, "damping": 20.0, "play": 0.0}
    scene["rows"][1]["outer_waviness"] = [{"order": 7, "amplitude": 2e-6, "phase": 0.4}]
    scene["rows"][1]["texture"] = AVERAGING
    reference = Reference(scene)
    y = draw_state(scene, rng)
    forces, size = reference.evaluate(0.0, y)
    q = y[: forces.size].reshape(-1, 4)
    moments = forces[:, 3] + q[:, 0] * forces[:, 1] - q[:, 1] * forces[:, 0]
    assert np.all(np.abs(forces[:, :3].sum(axis=0)) < 1e-13 * size[:, :3].sum(axis=0))
    arms = np.abs(q[:, 0]) * size[:, 1] + np.abs(q[:, 1]) * size[:, 0]
    assert abs(moments.sum()) < 1e-13 * (size[:, 3] + arms).sum()


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("kind", KINDS)
def test_reference_is_indifferent_to_rotation(kind: str, law: str) -> None:
    """A turned bearing has turned forces: this also measures the round-off of the comparison."""
    rng = np.random.default_rng(2)
    scene = make_scene(2, law)
    add_defects(scene, kind)
    scene["friction"] = {"coulomb": {"coefficient": 0.05, "slip_speed": 0.1}}
    reference = Reference(scene)
    y = draw_state(scene, rng)
    before, size = reference.evaluate(0.0, y)
    assert EXPECTED[kind][0] in reference.active
    turned = y.reshape(2, -1, 4).copy()
    c, s = math.cos(0.7), math.sin(0.7)
    turned[..., :2] = turned[..., :2] @ np.array([[c, s], [-s, c]])
    turned[0, :, 3] += 0.7
    after, _ = reference.evaluate(0.0, turned.ravel())
    after[:, :2] = after[:, :2] @ np.array([[c, -s], [s, c]])
    size[:, :2] = size[:, :2].sum(axis=1, keepdims=True)
    assert np.all(np.abs(after - before) <= 1e-11 * size)


def test_reference_hertz_constants() -> None:
    """Literature: exact elliptic integrals, the tables of the reference cases."""
    scene = make_scene()

    def constants(D: float, d_m: float, f: float, angle: float, ring: int) -> Any:
        row = scene["rows"][0] | {"ball_diameter": D, "pitch_diameter": d_m}
        row |= {"outer_conformity": f, "inner_conformity": f, "contact_angle": math.radians(angle)}
        return hertz(row, ring, scene["materials"])

    mm = 1e-3
    per_mm = 1e-3**1.5
    for ring, K218, K209 in [(INNER, 1.2872e6, 1.020e6), (OUTER, 1.3390e6, 1.078e6)]:
        law = constants(22.23 * mm, 125.26 * mm, 0.5232, 40, ring)
        assert law.K * per_mm == pytest.approx(K218, rel=1e-4)
        law = constants(12.7 * mm, 65 * mm, 6.6 / 12.7, 0, ring)
        assert law.K * per_mm == pytest.approx(K209, rel=6e-4)
    for ring, k, kappa in [(INNER, 52515, 0.01340), (OUTER, 56360, 0.013765)]:
        law = constants(11.9 * mm, 63 * mm, 0.53, 0, ring)
        assert law.k * 1e-6 == pytest.approx(k, rel=2e-5)
        assert law.kappa * 1e-3 == pytest.approx(kappa, rel=5e-4)


@pytest.mark.parametrize(("law", "tolerance"), [("hertz_fitted", 1e-12), ("hertz_fixed", 2e-2)])
def test_reference_hertz_force(law: str, tolerance: float) -> None:
    """The slices sum to K δ^(3/2) along the line of the two circles' centres."""
    scene = make_scene(1, law, balls=1)
    reference = Reference(scene)
    g, constants = reference.grooves[0][OUTER], reference.hertz[0][OUTER]
    assert constants is not None
    delta, angle = 20e-6, 0.3
    L = g.r - 5.95e-3 + delta
    y = np.zeros(2 * 12)
    y[4 * INNER] = -1.0  # out of the way
    y[8:11] = [g.a + L * math.cos(angle), 0.0, g.z + L * math.sin(angle)]
    forces, _ = reference.evaluate(0.0, y)
    F = constants.K * delta**1.5
    expected = [-F * math.cos(angle), 0.0, -F * math.sin(angle), 0.0]
    np.testing.assert_allclose(forces[2], expected, atol=tolerance * F)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("side", [-1.0, 1.0])
@pytest.mark.parametrize("case", ["outer", "inner", "ball_outer", "ball_inner", "outer+ball"])
def test_reference_crosses_edges_without_jump(case: str, side: float, law: str) -> None:
    """Force and torque are continuous where the near edge takes over.

    `outer+ball`: the arc of the ball's own defect ends inside a defect of the outer race.
    """
    scene = make_scene(1, law, balls=1)
    scene["friction"] = {"coulomb": {"coefficient": 0.05, "slip_speed": 0.1}}
    scene["contact"]["damping"] = 0.2  # no contact pulls
    on_ball = "ball" in case
    ring = INNER if "inner" in case else OUTER
    if case != "outer+ball":
        on = "ball" if on_ball else ("inner_race" if ring == INNER else "outer_race")
        scene["defects"] = {"a": make_defect(scene, on, width=0.7e-3)}
    else:
        add_defects(scene, "outer+ball")
        scene["defects"]["a"]["width"] = 0.1e-3  # both edges' directions near the race's
    reference = Reference(scene)
    y = draw_state(scene, np.random.default_rng(3), jitter=5e-6)
    ball, its_ring, row = y[8:12], y[4 * ring : 4 * ring + 4], scene["rows"][0]
    angle = math.atan2(ball[1] - its_ring[1], ball[0] - its_ring[0])

    def forces(angle_of_body: float) -> Vector:
        z = y.copy()
        z[11 if on_ball else 4 * ring + 3] = angle_of_body
        return reference.evaluate(0.0, z)[0]

    defect = scene["defects"]["b" if case == "outer+ball" else "a"]
    if on_ball:
        start = angle + (math.pi if ring == INNER else 0.0) - defect["angle"]
        half = defect["width"] / row["ball_diameter"]
    else:
        start = angle - defect["angle"]
        half = defect["width"] / (row["pitch_diameter"] + row["ball_diameter"] * (1 - 2 * ring))
    # Slices cross one after the other: follow all of them. The largest step of a coarse walk must
    # fall to a hundredth on a walk a hundred times as fine; a jump would stay.
    coarse = start + side * half * np.linspace(0.4, 1.1, 201)
    path = np.array([forces(x) for x in coarse])
    size = np.abs(path).max(axis=0)
    active = size > 1e-6 * size.max(axis=0)
    steps = np.where(active, np.abs(np.diff(path, axis=0)) / np.where(active, size, 1.0), 0.0)
    assert np.sum(steps, axis=0).max() > 0.05  # the defect does matter
    worst = int(np.argmax(steps.max(axis=(1, 2))))
    fine = np.array([forces(x) for x in np.linspace(coarse[worst], coarse[worst + 1], 101)])
    shorter = np.where(active, np.abs(np.diff(fine, axis=0)) / np.where(active, size, 1.0), 0.0)
    assert shorter.max() < 0.03 * steps.max()


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("kind", ["outer", "inner", "ball", "outer+ball"])
def test_reference_without_width_is_healthy(kind: str, law: str) -> None:
    scene = make_scene(1, law)
    healthy = Reference(copy.deepcopy(scene))
    add_defects(scene, kind)
    for defect in scene["defects"].values():
        defect["width"] = 1e-9
    reference = Reference(scene)
    y = draw_state(scene, np.random.default_rng(4))
    forces, size = reference.evaluate(0.0, y)
    assert any("edge" in name for name in reference.active)
    expected, _ = healthy.evaluate(0.0, y)
    assert np.all(np.abs(forces - expected) < (1e-6) * size + 1e-9)


@pytest.mark.parametrize("kind", ["outer", "inner", "ball", "overlap", "floor"])
def test_reference_elastic_forces_have_a_potential(kind: str) -> None:
    """In the plane, in x, y and θ of the ball: the matrix of their derivatives is symmetric.

    Not so where a ball's defect meets a ring's.
    """
    scene = make_scene(1, "iso", balls=1)
    scene["contact"]["damping"] = 0.0
    add_defects(scene, kind)
    if kind == "floor":
        del scene["defects"]["b"]
    reference = Reference(scene)
    y = draw_state(scene, np.random.default_rng(8))
    assert EXPECTED[kind][0] in _active(reference, y)
    columns = []
    for i in (8, 9, 11):
        h = 1e-9 if i < 11 else 1e-7
        ahead, behind = y.copy(), y.copy()
        ahead[i] += h
        behind[i] -= h
        f = reference.evaluate(0.0, ahead)[0][2] - reference.evaluate(0.0, behind)[0][2]
        columns.append(f[[0, 1, 3]] / (2 * h))
    matrix = np.array(columns)
    # The torque in units of a force at the ball's radius.
    matrix *= np.outer([1, 1, 168], [1, 1, 168])
    assert np.abs(matrix - matrix.T).max() < 1e-5 * np.abs(matrix).max()


def _active(reference: Reference, y: Vector) -> list[str]:
    reference.evaluate(0.0, y)
    return list(reference.active)


@pytest.mark.parametrize("kind", ["ball", "outer+ball", "floor"])
def test_reference_tan_alpha_is_the_gradient_of_the_gap(kind: str) -> None:
    """tan α = −∂s/∂ζ at a fixed place on the ring."""
    scene = make_scene(1, "iso", balls=1)
    add_defects(scene, kind)
    reference = Reference(scene)
    y = draw_state(scene, np.random.default_rng(9)).reshape(2, -1, 4)
    outer, ball = (
        Body(i, complex(*q[:2]), q[2], q[3], complex(*v[:2]), v[2], v[3])
        for i, q, v in ((i, y[0, i], y[1, i]) for i in (0, 2))
    )
    zeta, h = 1.5e-3, 1e-8
    seen = 0
    places = [
        Contact(reference, 0, 0, dataclasses.replace(ball, z=ball.z - x), outer) for x in (-h, h)
    ]
    here = Contact(reference, 0, 0, ball, outer)
    gap = here.gap(
        here.ball_arcs(zeta), scene["defects"].get("b", scene["defects"]["a"])["angle"], 1.0
    )
    assert gap is not None
    for x in here.surfaces(zeta):
        for index in range(2 + len(gap.floor)):
            s = []
            for contact, step in zip(places, (-h, h), strict=True):
                near = contact.gap(contact.ball_arcs(zeta + step), gap.ends[0].angle + 1e-3, 1.0)
                assert near is not None
                mark = [*near.ends, *near.floor][index]
                s.append(contact.ball_circle(zeta + step, mark, x)[0][0])
            tan = here.ball_circle(zeta, [*gap.ends, *gap.floor][index], x)[3]
            assert tan == pytest.approx(-(s[1] - s[0]) / (2 * h), abs=1e-6)
            seen += 1
    assert seen >= 2


def test_reference_angles() -> None:
    assert wrap(3 * math.pi - 1e-3) == pytest.approx(math.pi - 1e-3)
